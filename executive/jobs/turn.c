/* turn.c - the end of each turn of the loop: start, write down, tell; time; what a launcher tells. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "job.h"

/* A job's progress is told ten times a second at most; a ledger that failed is tried each second. */
static const double tell_s = 0.1, ledger_retry_s = 1;

/* Every state is in the ledger before it is told, and so outlasts the service. That jobs have ended
 * outlasts the machine's power too, but a little later: waiting for the disk at each end would keep
 * the slots of short jobs empty. One that is lost so is found up to date when it runs again. */
static const double sync_s = 0.1;

static size_t changes_gather(const struct queue *q, struct ledger_change *changes, bool sync)
{
	size_t n = 0;
	for (int i = 0; i < q->n_changed; i++) {
		const struct job *job = q->changed[i];
		sync &= job->stats.id != q->sync_id || !job->dirty;
		if (job->dirty)
			changes[n++] = (struct ledger_change){
				.id = job->stats.id,
				.stats = &job->stats,
				.front = job->front,
				.killed = job->process && job->cause == CAUSE_KILL,
			};
	}
	/* what was written before goes to the disk with what is written now */
	const struct job *last = sync ? queue_job(q, q->sync_id) : NULL;
	if (last)
		changes[n++] = (struct ledger_change){ .id = last->stats.id,
			                               .stats = &last->stats,
			                               .front = last->front };
	return n;
}

static void sync_plan(struct queue *q, bool synced)
{
	if (synced)
		q->sync_at = INFINITY;
	for (int i = 0; i < q->n_changed && !synced; i++) {
		const struct job *job = q->changed[i];
		if (!job->dirty || !job_state_table[job->stats.state].over)
			continue;
		q->sync_id = job->stats.id;
		q->sync_at = fmin(q->sync_at, queue_now(q) + sync_s);
	}
}

static enum status changes_write(struct queue *q)
{
	struct ledger_change *changes = calloc((size_t)q->n_changed + 2, sizeof *changes);
	struct report_store store;
	bool sync = queue_now(q) >= q->sync_at;
	report_store_init(&store);
	enum status st = changes ? ST_OK : ST_RESOURCE;
	size_t n = changes ? changes_gather(q, changes, sync) : 0;
	if (n)
		st = q->ports.ledger->write(q->ports.ledger->data, changes, n, sync, &store.report);
	free(changes);
	free(q->fault);
	q->fault = NULL;
	q->retry_at = INFINITY;
	if (st == ST_OK) {
		sync_plan(q, sync);
	} else {
		q->fault = strdup(store.error[0] ? store.error : status_text(st));
		q->retry_at = queue_now(q) + ledger_retry_s;
	}
	return st;
}

/* A state is told when it is written; progress needs no writing. What waits stays in the list. */
static void changes_tell(struct queue *q, bool written)
{
	double now = queue_now(q);
	int kept = 0, n = q->n_changed;
	for (int i = 0; i < n; i++) {
		struct job *job = q->changed[i];
		bool state = job->dirty && written;
		if (state || (job->news && !job->dirty && now >= job->told_at + tell_s)) {
			job->dirty = job->news = false;
			job->told_at = now;
			job_times(job);
			line_reason(job);
			q->ports.told(q->ports.told_data, &job->stats);
		} else {
			q->changed[kept++] = job;
		}
	}
	q->n_changed = kept;
}

void queue_turn(struct queue *q)
{
	bool written = true, failed;
	do {
		line_settle(q);
		line_start(q);
		line_settle(q); /* one that could not be started may be waited for */
		failed = q->fault != NULL;
		if (q->n_changed || failed || queue_now(q) >= q->sync_at)
			written = (!failed || queue_now(q) >= q->retry_at) &&
			          changes_write(q) == ST_OK;
		changes_tell(q, written);
	} while (failed && written);
	archive_let_go(q);
}

double queue_deadline(const struct queue *q)
{
	double first = fmin(q->fault ? q->retry_at : q->sync_at, q->look_at);
	for (int i = 0; i < q->n_active; i++)
		first = fmin(first, fmin(q->active[i]->deadline, job_wall_end(q->active[i])));
	for (int i = 0; i < q->n_changed; i++)
		if (q->changed[i]->news && !q->changed[i]->dirty)
			first = fmin(first, q->changed[i]->told_at + tell_s);
	return first;
}

/* Its exit was seen and only a pipe that somebody else holds is open: that is the end. */
static void finish_half(struct job *job)
{
	job->drained = true;
	job_step(job, EV_GONE, NULL);
}

/* Its time is up: asked to stop at a unit, then made to. */
static void out_of_time(struct job *job)
{
	job_fault(job,
	          "over its limit of %g s; 'batten retry %lld' goes on from its part file for as "
	          "long again",
	          job->stats.wall_limit_s, (long long)job->stats.id);
	job_end(job, CAUSE_FAULT, STEP_CANCEL);
}

void queue_tick(struct queue *q)
{
	double now = queue_now(q);
	if (now >= q->look_at)
		q->look_at = INFINITY;
	for (int i = q->n_active - 1; i >= 0; i--) {
		struct job *job = q->active[i];
		if (now >= job_wall_end(job))
			out_of_time(job);
		if (now < job->deadline)
			continue;
		job->deadline = INFINITY;
		if (job->exited)
			finish_half(job);
		else
			job_step(job, EV_LATE, NULL);
	}
}

/* One of the two was seen; the other has end_grace from now. */
static void half_seen(struct job *job)
{
	double limit = queue_now(job->q) + job->q->limits.end_grace;
	if (job->exited && job->drained)
		job_step(job, EV_GONE, NULL);
	else if (job->stats.state != JOB_SUSPENDED || job->exited)
		job->deadline = fmin(job->deadline, limit);
}

static struct job *running(void *data, int64_t id)
{
	struct job *job = queue_job(data, id);
	return job && job->process ? job : NULL;
}

static void sink_packet(void *data, int64_t id, const struct message *m)
{
	struct job *job = running(data, id);
	if (job)
		job_packet(job, m);
}

static void sink_broken(void *data, int64_t id, const char *reason)
{
	struct job *job = running(data, id);
	if (!job)
		return;
	job_fault(job, "worker %s sent what is no packet: %s", job->stats.worker, reason);
	job_step(job, EV_BREAK, NULL);
}

static void sink_drained(void *data, int64_t id)
{
	struct job *job = running(data, id);
	if (!job || job->drained)
		return;
	job->drained = true;
	half_seen(job);
}

static void sink_exited(void *data, int64_t id, const struct launcher_exit *e)
{
	struct job *job = running(data, id);
	if (!job || job->exited)
		return;
	job->exited = true;
	job->exit = *e;
	half_seen(job);
}

static void sink_stopped(void *data, int64_t id, bool stopped)
{
	struct job *job = running(data, id);
	if (job && !job->exited)
		job_step(job, stopped ? EV_STOPPED : EV_CONTINUED, NULL);
}

static void sink_refused(void *data, int64_t id)
{
	struct job *job = running(data, id);
	if (!job || !job->stopping)
		return;
	const struct queue_limits *limits = &job->q->limits;
	double now = queue_now(job->q);
	bool ends = job->finished || job->fault || job->exited || job->drained;
	job->stopping = false;
	job->deadline = !job->greeted ? now + limits->hello_grace
	                : ends        ? now + limits->end_grace
	                              : INFINITY;
	job_reason(job, NULL);
	job_changed(job, true);
}

static void sink_waits(void *data, int64_t id, const char *reason)
{
	struct job *job = running(data, id);
	if (!job || job->greeted || job->stats.state != JOB_STARTING)
		return;
	job->deadline = reason ? INFINITY : queue_now(job->q) + job->q->limits.hello_grace;
	if (reason)
		job_reason(job, "%s", reason);
	else
		job_reason(job, NULL);
	job_changed(job, true);
}

struct launcher_sink queue_sink(struct queue *q)
{
	return (struct launcher_sink){
		.data = q,
		.packet = sink_packet,
		.broken = sink_broken,
		.drained = sink_drained,
		.exited = sink_exited,
		.stopped = sink_stopped,
		.refused = sink_refused,
		.waits = sink_waits,
	};
}

bool queue_stopping(const struct queue *q, int64_t id)
{
	const struct job *job = queue_job(q, id);
	return job && (job->stopping || job->stats.state == JOB_ENDING);
}

int queue_count(const struct queue *q)
{
	return q->n;
}

const struct Stats *queue_at(const struct queue *q, int i)
{
	return &q->jobs[i]->stats;
}

bool queue_busy(const struct queue *q)
{
	return q->count[JOB_QUEUED] || queue_active(q);
}

int queue_processes(const struct queue *q)
{
	return q->n_active;
}

int queue_active(const struct queue *q)
{
	return q->count[JOB_STARTING] + q->count[JOB_RUNNING] + q->count[JOB_ENDING];
}

const char *queue_fault(const struct queue *q)
{
	return q->fault;
}
