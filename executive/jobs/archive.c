/* archive.c - jobs that are over: they lie in the ledger, and only a few of them in memory. */
#include <stdlib.h>
#include <string.h>

#include "job.h"

/* So many that are done are looked at for what they took. */
enum { LEARNT = 500 };

static enum status archive_take(void *data, struct Stats *s, bool front, bool killed)
{
	(void)killed;
	return queue_take(data, s, front) ? ST_OK : ST_RESOURCE;
}

struct job *archive_fetch(struct queue *q, int64_t id)
{
	struct job *job = queue_job(q, id);
	const struct ledger *l = q->ports.ledger;
	if (job)
		return job;
	return l->find(l->data, id, archive_take, q, NULL) == ST_OK ? queue_job(q, id) : NULL;
}

void archive_fetch_awaited(struct job *job)
{
	const struct Stats *s = &job->stats;
	for (int i = 0; i < s->n_after; i++)
		archive_fetch(job->q, s->after[i]);
	for (int i = 0; i < s->n_after_any; i++)
		archive_fetch(job->q, s->after_any[i]);
}

void archive_fetch_last(struct queue *q)
{
	const struct ledger_choice choice = { .states = 1U << JOB_DONE, .newest = LEARNT };
	int64_t *ids;
	size_t n;
	if (queue_over(q, &choice, &ids, &n, NULL) != ST_OK)
		return;
	for (size_t i = 0; i < n; i++) {
		struct job *job = archive_fetch(q, ids[i]);
		if (job)
			history_add(job);
	}
	free(ids);
}

static void mark_needed(struct queue *q, const int64_t *ids, int n)
{
	for (int i = 0; i < n; i++) {
		struct job *other = queue_job(q, ids[i]);
		if (other)
			other->needed = true;
	}
}

static int count_over(const struct queue *q)
{
	int n = 0;
	for (int state = 0; state < N_JOB_STATES; state++)
		if (job_state_table[state].over)
			n += q->count[state];
	return n;
}

void archive_let_go(struct queue *q)
{
	int over = count_over(q), kept = q->limits.over_kept;
	if (over <= 2 * kept)
		return;
	for (int i = 0; i < q->n; i++)
		q->jobs[i]->needed = false;
	for (int i = 0; i < q->n; i++) {
		const struct Stats *s = &q->jobs[i]->stats;
		if (job_state_table[s->state].over)
			continue;
		mark_needed(q, s->after, s->n_after);
		mark_needed(q, s->after_any, s->n_after_any);
	}
	for (int i = 0; i < q->n && over > kept; i++) {
		struct job *job = q->jobs[i];
		bool written = !job->dirty && !job->news && job->stats.id != q->sync_id;
		if (!job_state_table[job->stats.state].over || job->needed || job->process ||
		    !written)
			continue;
		job->forgotten = true;
		over--;
	}
	queue_drop_forgotten(q);
}

bool queue_holds(const struct queue *q, int64_t id)
{
	return queue_job(q, id);
}

static enum status visitor_take(void *data, struct Stats *s, bool front, bool killed)
{
	struct queue *q = data;
	(void)front;
	(void)killed;
	q->visitor = *s;
	return ST_OK;
}

const struct Stats *queue_find(struct queue *q, int64_t id)
{
	const struct ledger *l = q->ports.ledger;
	struct job *job = queue_job(q, id);
	if (job) {
		job_times(job);
		line_reason(job);
		return &job->stats;
	}
	stats_finish(&q->visitor);
	if (l->find(l->data, id, visitor_take, q, NULL) != ST_OK || !q->visitor.id)
		return NULL;
	return &q->visitor;
}

bool queue_has(struct queue *q, int64_t id)
{
	return queue_find(q, id);
}

bool queue_write(struct queue *q, int64_t id, bool full, struct text *out)
{
	const struct ledger *l = q->ports.ledger;
	if (!queue_job(q, id) && l->text(l->data, id, out))
		return true;
	const struct Stats *s = queue_find(q, id);
	if (s && full)
		stats_write(out, s);
	else if (s)
		stats_write_brief(out, s);
	return s;
}

enum status queue_over(const struct queue *q, const struct ledger_choice *choice, int64_t **ids,
                       size_t *n, const struct report *r)
{
	const struct ledger *l = q->ports.ledger;
	enum status st = l->choose(l->data, choice, ids, n, r);
	size_t kept = 0;
	for (size_t i = 0; st == ST_OK && i < *n; i++)
		if (!queue_job(q, (*ids)[i]))
			(*ids)[kept++] = (*ids)[i];
	*n = st == ST_OK ? kept : 0;
	return st;
}
