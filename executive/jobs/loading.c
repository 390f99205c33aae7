/* loading.c - the jobs of an earlier service, as its ledger has them, become the queue's. */
#include <stdlib.h>
#include <string.h>

#include "job.h"

/* It had begun under an earlier service: does it go on by itself? */
static void job_resumed(struct job *job)
{
	long long id = job->stats.id;
	if (job->q->limits.resume == RESUME_ASK) {
		job_enter(job, JOB_HELD);
		job_reason(job, "the service ended while it ran; 'batten release %lld' goes on",
		           id);
	} else if (job->q->limits.resume == RESUME_NEVER) {
		job_enter(job, JOB_LOST);
		job_reason(job,
		           "the service ended while it ran; 'batten retry %lld' goes on from its "
		           "part file",
		           id);
	}
}

/* What had a process had it from a service that is no more. */
static void job_loaded(struct job *job, bool killed)
{
	struct queue *q = job->q;
	enum job_state state = job->stats.state;
	struct report_store store;
	if (job->stats.pid > 0) {
		q->ports.launcher->bury(q->ports.launcher->data, &job->stats);
		job_tidy(job);
	}
	job->stats.pid = 0;
	if (state == JOB_QUEUED && job->front && job->stats.started > 0)
		job_resumed(job);
	if (state != JOB_STARTING && state != JOB_RUNNING && state != JOB_ENDING)
		return;
	q->count[state]--;
	q->count[JOB_QUEUED]++;
	job->stats.state = JOB_QUEUED;
	job->front = true;
	job_changed(job, true);
	report_store_init(&store);
	if (killed) {
		job_enter(job, JOB_KILLED);
	} else if (q->ports.launcher->check(q->ports.launcher->data, &job->stats, &store.report) !=
	           ST_OK) {
		job_enter(job, JOB_LOST);
		job_reason(job, "the service ended while it ran, and it cannot go on: %s",
		           store.error);
	} else {
		job_resumed(job);
	}
}

static enum status loading_take(void *data, struct Stats *s, bool front, bool killed)
{
	struct queue *q = data;
	struct job *job = queue_take(q, s, front);
	if (!job)
		return ST_RESOURCE;
	job_loaded(job, killed);
	if (q->ports.loading)
		q->ports.loading(q->ports.loading_data, q->n);
	return ST_OK;
}

enum status queue_load(struct queue *q, const struct report *r)
{
	int64_t last = 0;
	enum status st =
	        q->ports.ledger->load(q->ports.ledger->data, loading_take, q, &last, &q->held, r);
	if (last > q->last)
		q->last = last;
	int n = q->n;
	struct job **live = calloc((size_t)n + 1, sizeof *live);
	if (!live)
		st = ST_RESOURCE;
	if (live && n)
		memcpy(live, q->jobs, (size_t)n * sizeof *live);
	for (int i = 0; i < n && st == ST_OK; i++)
		archive_fetch_awaited(live[i]);
	for (int i = 0; i < n && st == ST_OK; i++)
		if (!job_state_table[live[i]->stats.state].over)
			queue_admit(live[i]);
	free(live);
	if (st == ST_OK)
		archive_fetch_last(q);
	return st;
}
