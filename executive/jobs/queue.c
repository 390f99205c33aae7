/* queue.c - the jobs: submitted, looked up, moved on, written down, told. */
#include "queue.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "job.h"

enum status queue_create(struct queue **out, const struct queue_ports *ports,
                         const struct queue_limits *limits)
{
	struct queue *q = calloc(1, sizeof *q);
	if (!q)
		return ST_RESOURCE;
	q->ports = *ports;
	q->limits = *limits;
	q->retry_at = q->sync_at = q->look_at = INFINITY;
	*out = q;
	return ST_OK;
}

void job_destroy(struct job *job)
{
	if (!job)
		return;
	stats_finish(&job->stats);
	free(job->fault);
	free(job);
}

void queue_destroy(struct queue *q)
{
	if (!q)
		return;
	for (int i = 0; i < q->n; i++)
		job_destroy(q->jobs[i]);
	free(q->jobs);
	free(q->active);
	free(q->changed);
	free(q->fault);
	stats_finish(&q->visitor);
	history_finish(q);
	free(q);
}

double queue_now(const struct queue *q)
{
	return q->ports.clock->elapsed(q->ports.clock->data);
}

/* Index of the first job whose id is not below id. */
static int queue_index(const struct queue *q, int64_t id)
{
	int low = 0, high = q->n;
	while (low < high) {
		int middle = low + (high - low) / 2;
		if (q->jobs[middle]->stats.id < id)
			low = middle + 1;
		else
			high = middle;
	}
	return low;
}

struct job *queue_job(const struct queue *q, int64_t id)
{
	int i = queue_index(q, id);
	return i < q->n && q->jobs[i]->stats.id == id ? q->jobs[i] : NULL;
}

static bool grow(void *array, int *cap, int need, size_t size)
{
	void **p = array;
	if (need <= *cap)
		return true;
	int more = *cap * 2 > need ? *cap * 2 : need + 16;
	void *fresh = realloc(*p, (size_t)more * size);
	if (!fresh)
		return false;
	*p = fresh;
	*cap = more;
	return true;
}

/* Room in `changed` is made with the job, so that a change cannot fail. */
static struct job *job_create(struct queue *q)
{
	if (!grow(&q->jobs, &q->cap, q->n + 1, sizeof(struct job *)) ||
	    !grow(&q->changed, &q->changed_cap, q->n + 1, sizeof(struct job *)))
		return NULL;
	struct job *job = calloc(1, sizeof *job);
	if (job) {
		job->q = q;
		job->deadline = INFINITY;
		job->pace_at = NAN;
		job->told_at = -INFINITY;
	}
	return job;
}

void job_changed(struct job *job, bool urgent)
{
	struct queue *q = job->q;
	if (!job->dirty && !job->news)
		q->changed[q->n_changed++] = job;
	if (urgent)
		job->dirty = true;
	else
		job->news = true;
}

/* What it waits for was there before it; -1 - i is job i of the same request. */
static enum status after_check(struct queue *q, const char *how, int64_t *ids, int n, int64_t id,
                               int64_t first, const struct report *r)
{
	for (int k = 0; k < n; k++) {
		if (ids[k] < 0 && ids[k] > -INT32_MAX)
			ids[k] = first - 1 - ids[k];
		if (ids[k] < 1 || ids[k] >= id || (ids[k] < first && !archive_fetch(q, ids[k])))
			return report_error(
			        r, ST_PARAMETER,
			        "--after %lld%s: there is no such job; 'batten jobs --all' "
			        "lists them",
			        (long long)ids[k], how);
	}
	return ST_OK;
}

/* Fields that a client gives; the rest is the queue's own. */
static enum status job_submitted(struct job *job, const struct Stats *given, int64_t first, int i,
                                 const struct report *r)
{
	struct queue *q = job->q;
	struct Stats *s = &job->stats;
	enum status st = stats_copy(s, given);
	if (st != ST_OK)
		return report_error(r, st, "cannot submit: out of memory");
	stats_drop_outputs(s);
	char **own[] = { &s->host, &s->reason, &s->phase, &s->log };
	for (size_t k = 0; k < sizeof own / sizeof *own; k++) {
		free(*own[k]);
		*own[k] = NULL;
	}
	s->id = first + i;
	s->state = q->held ? JOB_HELD : JOB_QUEUED;
	if (q->held)
		s->reason = strdup(job_held_text);
	s->done = s->total = s->pid = 0;
	s->started = s->ended = 0;
	s->eta_s = s->wall_s = s->suspended_s = s->cpu_s = NAN;
	s->peak_kib = -1;
	s->submitted = q->ports.clock->date(q->ports.clock->data);
	if (s->threads < 1)
		s->threads = q->limits.job_threads;
	if (s->memory_mib < 1)
		s->memory_mib = q->limits.job_memory_mib;
	if (!(s->wall_limit_s > 0))
		s->wall_limit_s = q->limits.job_wall_s;
	st = after_check(q, "", s->after, s->n_after, s->id, first, r);
	if (st == ST_OK)
		st = after_check(q, ":any", s->after_any, s->n_after_any, s->id, first, r);
	return st;
}

void queue_insert(struct queue *q, struct job *job)
{
	int at = queue_index(q, job->stats.id);
	memmove(&q->jobs[at + 1], &q->jobs[at], (size_t)(q->n - at) * sizeof *q->jobs);
	q->jobs[at] = job;
	q->n++;
	q->count[job->stats.state]++;
	q->dependents += line_depends(job);
	if (job->stats.id > q->last)
		q->last = job->stats.id;
}

struct job *queue_take(struct queue *q, struct Stats *s, bool front)
{
	struct job *job = job_create(q);
	if (!job) {
		stats_finish(s);
		return NULL;
	}
	job->stats = *s;
	job->front = front;
	queue_insert(q, job);
	return job;
}

/* A job's first state: in the line, or waiting for jobs that have failed already. */
void queue_admit(struct job *job)
{
	job->unsettled = line_unsettled(job);
	job->q->unsettled |= job->unsettled > 0;
	if (job->stats.state == JOB_QUEUED)
		line_add(job);
}

enum status queue_submit(struct queue *q, const struct Stats *s, int n, int64_t *first,
                         const struct report *r)
{
	const struct launcher *l = q->ports.launcher;
	struct ledger_change *changes = calloc((size_t)n + 1, sizeof *changes);
	struct job **fresh = calloc((size_t)n + 1, sizeof *fresh);
	enum status st = changes && fresh ? ST_OK : ST_RESOURCE;
	int made = 0;
	int64_t last = q->last;
	*first = q->last < INT64_MAX ? q->last + 1 : q->last;
	if (q->leaving)
		st = report_error(r, ST_RESOURCE, "the service is ending; submit again");
	else if (q->last > INT64_MAX - n)
		st = report_error(
		        r, ST_RESOURCE,
		        "the ledger holds a job of number %lld, which is the last there can be; "
		        "move '.batten/jobs.db' away",
		        (long long)q->last);
	for (int i = 0; i < n && st == ST_OK; i++) {
		struct job *job = fresh[made] = job_create(q);
		if (!job) {
			st = report_error(r, ST_RESOURCE, "cannot submit: out of memory");
			break;
		}
		made++;
		st = job_submitted(job, &s[i], *first, i, r);
		if (st == ST_OK)
			st = l->check(l->data, &job->stats, r);
		if (st == ST_OK) {
			queue_insert(q, job);
			changes[i] =
			        (struct ledger_change){ .id = job->stats.id, .stats = &job->stats };
		}
	}
	if (st == ST_OK && n)
		st = q->ports.ledger->write(q->ports.ledger->data, changes, (size_t)n, true, r);
	if (st != ST_OK) {
		while (q->n && q->jobs[q->n - 1]->stats.id >= *first) {
			const struct job *gone = q->jobs[--q->n];
			q->count[gone->stats.state]--;
			q->dependents -= line_depends(gone);
		}
		q->last = last;
		for (int i = 0; i < made; i++)
			job_destroy(fresh[i]);
	}
	for (int i = 0; i < made && st == ST_OK; i++) {
		queue_admit(fresh[i]);
		job_changed(fresh[i], true);
	}
	free(changes);
	free(fresh);
	return st;
}

enum status queue_event(struct queue *q, int64_t id, enum job_event event, const char *by,
                        const struct report *r)
{
	struct job *job = archive_fetch(q, id);
	if (!job)
		return report_error(r, ST_INPUT,
		                    "there is no job %lld; 'batten jobs --all' lists them",
		                    (long long)id);
	archive_fetch_awaited(job);
	q->retry_at = 0; /* somebody waits: a ledger that failed is tried at once */
	if (job_step(job, event, by) != ST_OK)
		return report_error(r, ST_INPUT, "job %lld is %s and cannot be %s", (long long)id,
		                    job_state_table[job->stats.state].word, job_event_asked[event]);
	return ST_OK;
}

enum status queue_priority(struct queue *q, int64_t id, int priority, const struct report *r)
{
	struct job *job = queue_job(q, id);
	if (!job || job_state_table[job->stats.state].over)
		return report_error(r, ST_INPUT, "there is no job %lld that has not ended",
		                    (long long)id);
	if (job->in_line)
		line_remove(job);
	job->stats.priority = priority;
	if (job->stats.state == JOB_QUEUED)
		line_add(job);
	job_changed(job, true);
	return ST_OK;
}

enum status queue_top(struct queue *q, int64_t id, const struct report *r)
{
	struct job *job = queue_job(q, id);
	if (!job || (job->stats.state != JOB_QUEUED && job->stats.state != JOB_HELD))
		return report_error(r, ST_INPUT, "job %lld does not wait: it cannot be put first",
		                    (long long)id);
	const struct job *first = job_pool(job)->first;
	if (!first || first == job)
		return ST_OK;
	if (job->in_line)
		line_remove(job);
	job->front |= first->front;
	if (job->stats.priority <= first->stats.priority)
		job->stats.priority = first->stats.priority + 1;
	if (job->stats.state == JOB_QUEUED)
		line_add(job);
	job_changed(job, true);
	return ST_OK;
}

enum status queue_hold(struct queue *q, bool held, const struct report *r)
{
	enum status st =
	        q->held == held ? ST_OK : q->ports.ledger->hold(q->ports.ledger->data, held, r);
	if (st == ST_OK)
		q->held = held;
	return st;
}

/* Close the gaps that forgotten jobs leave, in one pass. */
static int without_forgotten(struct job **jobs, int n)
{
	int kept = 0;
	for (int i = 0; i < n; i++)
		if (!jobs[i]->forgotten)
			jobs[kept++] = jobs[i];
	return kept;
}

void queue_drop_forgotten(struct queue *q)
{
	int n = q->n;
	struct job **gone = calloc((size_t)n + 1, sizeof *gone);
	int n_gone = 0;
	for (int i = 0; i < n && gone; i++)
		if (q->jobs[i]->forgotten)
			gone[n_gone++] = q->jobs[i];
	for (int i = 0; i < N_POOLS; i++)
		if (q->pools[i].blocked && q->pools[i].blocked->forgotten)
			q->pools[i].blocked = NULL;
	if (gone) {
		q->n_changed = without_forgotten(q->changed, q->n_changed);
		q->n = without_forgotten(q->jobs, q->n);
	}
	for (int i = 0; i < n_gone; i++) {
		q->count[gone[i]->stats.state]--;
		q->dependents -= line_depends(gone[i]);
		job_destroy(gone[i]);
	}
	free(gone);
}

enum status queue_forget(struct queue *q, const int64_t *ids, int n, const struct report *r)
{
	struct ledger_change *changes = calloc((size_t)n + 1, sizeof *changes);
	enum status st = changes ? ST_OK : ST_RESOURCE;
	for (int i = 0; i < n && st == ST_OK; i++) {
		const struct job *job = queue_job(q, ids[i]);
		changes[i].id = ids[i];
		/* one that is not in memory has ended */
		if (job && !job_state_table[job->stats.state].over)
			st = report_error(r, ST_INPUT, "job %lld has not ended", (long long)ids[i]);
	}
	if (st == ST_OK && n)
		st = q->ports.ledger->write(q->ports.ledger->data, changes, (size_t)n, false, r);
	for (int i = 0; i < n && st == ST_OK; i++) {
		struct job *job = queue_job(q, ids[i]);
		if (job)
			job->forgotten = true;
	}
	if (st == ST_OK)
		queue_drop_forgotten(q);
	free(changes);
	return st;
}

void queue_leave(struct queue *q)
{
	q->leaving = true;
	for (int i = q->n_active - 1; i >= 0; i--)
		job_step(q->active[i], EV_LEAVE, NULL);
}

int queue_unended(const struct queue *q, const char *group, bool *all_done)
{
	int n = 0;
	*all_done = true;
	for (int i = 0; i < q->n; i++) {
		const struct Stats *s = &q->jobs[i]->stats;
		if (!s->group || strcmp(s->group, group))
			continue;
		n += !job_state_table[s->state].over;
		*all_done &= s->state == JOB_DONE;
	}
	const struct ledger_choice bad = {
		.group = group,
		.states = 1U << JOB_FAILED | 1U << JOB_KILLED | 1U << JOB_LOST,
		.newest = 1,
	};
	int64_t *ids = NULL;
	size_t n_bad = 0;
	if (!n && *all_done && queue_over(q, &bad, &ids, &n_bad, NULL) == ST_OK)
		*all_done = !n_bad;
	free(ids);
	return n;
}
