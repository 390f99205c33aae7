/* line.c - the line of queued jobs: its order, who may start, why the others wait. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "job.h"

/* A disk that is full is looked at again each second. */
static const double look_s = 1;

enum { MIB = 1 << 20 };

/* Those put first, then by priority, then by age. */
static bool before(const struct job *a, const struct job *b)
{
	if (a->front != b->front)
		return a->front;
	if (a->stats.priority != b->stats.priority)
		return a->stats.priority > b->stats.priority;
	return a->stats.id < b->stats.id;
}

struct pool *job_pool(const struct job *job)
{
	return &job->q->pools[stats_is_local(&job->stats) ? POOL_HERE : POOL_ELSEWHERE];
}

int job_threads(const struct job *job)
{
	return job->stats.threads * stats_processes(&job->stats);
}

int64_t job_memory_mib(const struct job *job)
{
	return job->stats.memory_mib * stats_processes(&job->stats);
}

/* From the end: a new job mostly belongs there. */
void line_add(struct job *job)
{
	struct pool *q = job_pool(job);
	struct job *after = q->tail;
	while (after && before(job, after))
		after = after->prev;
	job->prev = after;
	job->next = after ? after->next : q->first;
	if (job->next)
		job->next->prev = job;
	else
		q->tail = job;
	if (after)
		after->next = job;
	else
		q->first = job;
	job->in_line = true;
}

void line_remove(struct job *job)
{
	struct pool *q = job_pool(job);
	if (job->prev)
		job->prev->next = job->next;
	else
		q->first = job->next;
	if (job->next)
		job->next->prev = job->prev;
	else
		q->tail = job->prev;
	job->prev = job->next = NULL;
	job->in_line = false;
}

/* Elsewhere somebody else counts threads and memory. */
static bool is_here(const struct job *job)
{
	return job_pool(job) == &job->q->pools[POOL_HERE];
}

static bool slot_free(const struct queue *q, const struct pool *pool)
{
	bool here = pool == &q->pools[POOL_HERE];
	return pool->active < (here ? q->limits.jobs : q->limits.jobs_elsewhere);
}

static bool threads_free(const struct queue *q, const struct job *job)
{
	const struct pool *pool = job_pool(job);
	return !is_here(job) || !pool->active ||
	       pool->threads + job_threads(job) <= q->limits.threads;
}

static bool memory_free(const struct queue *q, const struct job *job)
{
	int64_t used = job_pool(job)->memory_mib, wants = job_memory_mib(job);
	int64_t limit = q->limits.memory_mib;
	return !is_here(job) || !limit || !wants || !used || used + wants <= limit;
}

/* What jobs that run will still write there. The part file that one has begun makes way for its output,
 * so until that is there all of it is to come. */
static int64_t room_promised(const struct queue *q, uint64_t disk)
{
	int64_t mib = 0;
	for (int i = 0; i < q->n_active; i++)
		for (int k = 0; k < q->active[i]->n_disks; k++)
			if (q->active[i]->disks[k] == disk)
				mib += q->active[i]->promised_mib;
	return mib;
}

/* Is there room for what it makes, beside what the others make? Looked at only when it could start
 * otherwise. */
static bool disk_free(struct queue *q, struct pool *pool, struct job *job)
{
	int64_t floor = q->limits.disk_floor_mib;
	struct room at[ROOMS];
	job->n_disks =
	        floor && q->ports.room ? q->ports.room(q->ports.room_data, &job->stats, at) : 0;
	job->promised_mib = job->n_disks ? (history_bytes(job) + MIB - 1) / MIB : 0;
	for (int i = 0; i < job->n_disks; i++) {
		int64_t promised = room_promised(q, at[i].disk);
		int64_t wanted = floor + job->promised_mib + promised;
		job->disks[i] = at[i].disk;
		if (at[i].mib >= wanted)
			continue;
		pool->room_mib = at[i].mib;
		pool->wanted_mib = wanted;
		pool->promised_mib = promised;
		q->look_at = queue_now(q) + look_s;
		return false;
	}
	return true;
}

static bool active_room(struct queue *q)
{
	if (q->n_active < q->active_cap)
		return true;
	int cap = q->active_cap ? 2 * q->active_cap : 16;
	struct job **p = realloc(q->active, (size_t)cap * sizeof *p);
	if (!p)
		return false;
	q->active = p;
	q->active_cap = cap;
	return true;
}

static void run_reset(struct job *job)
{
	struct Stats *s = &job->stats;
	job->process = true;
	job->exited = job->drained = job->greeted = job->finished = job->stopping = false;
	job->exit = (struct launcher_exit){ .cpu_s = NAN, .peak_kib = -1 };
	job->cause = CAUSE_NONE;
	job->step = STEP_BEGIN;
	job->error = ST_OK;
	job->began = queue_now(job->q);
	job->stopped_s = job->stopped_at = 0;
	job->pace_at = NAN;
	job->packets = job->notes = (struct bucket){ 0 };
	stats_drop_outputs(s);
	s->done = s->total = 0;
	free(s->phase);
	s->phase = NULL;
	s->started = job->q->ports.clock->date(job->q->ports.clock->data);
	s->cpu_s = NAN;
	s->peak_kib = -1;
}

static void start(struct job *job)
{
	struct queue *q = job->q;
	const struct launcher *l = q->ports.launcher;
	struct report_store store;
	report_store_init(&store);
	job_step(job, EV_LAUNCH, NULL);
	enum status st =
	        active_room(q) ? l->start(l->data, &job->stats, &store.report) : ST_RESOURCE;
	if (st != ST_OK) {
		job->deadline = INFINITY;
		job_fault(job, "%s", store.error[0] ? store.error : status_text(st));
		job_step(job, EV_REFUSE, NULL);
		free(job->fault);
		job->fault = NULL;
		return;
	}
	run_reset(job);
	q->active[q->n_active++] = job;
	job_pool(job)->memory_mib += job_memory_mib(job);
}

/* In order: a job that finds no room is not overtaken, or a wide one would wait for ever. */
static void pool_start(struct queue *q, struct pool *pool)
{
	pool->blocked = NULL;
	pool->room_mib = -1;
	for (struct job *job = pool->first, *next; job; job = next) {
		next = job->next;
		if (job->unsettled)
			continue;
		if (!slot_free(q, pool))
			return;
		if (!threads_free(q, job) || !memory_free(q, job) || !disk_free(q, pool, job)) {
			pool->blocked = job;
			return;
		}
		start(job);
	}
}

void line_start(struct queue *q)
{
	for (int i = 0; i < N_POOLS && !q->leaving && !q->fault; i++)
		pool_start(q, &q->pools[i]);
}

bool line_depends(const struct job *job)
{
	return job->stats.n_after || job->stats.n_after_any;
}

static int n_awaited(const struct job *job)
{
	return job->stats.n_after + job->stats.n_after_any;
}

/* One that it waits for still; NULL: forgotten, or come to the end that it waited for. */
static const struct job *awaited(const struct job *job, int i)
{
	const struct Stats *s = &job->stats;
	bool any = i >= s->n_after;
	const struct job *other =
	        queue_job(job->q, any ? s->after_any[i - s->n_after] : s->after[i]);
	if (!other || other->stats.state == JOB_DONE)
		return NULL;
	return any && job_state_table[other->stats.state].over ? NULL : other;
}

int line_unsettled(const struct job *job)
{
	int n = 0;
	for (int i = 0; i < n_awaited(job); i++)
		n += awaited(job, i) != NULL;
	return n;
}

/* Jobs wait only for earlier ones, so one pass settles whole chains. */
void line_settle(struct queue *q)
{
	if (!q->unsettled)
		return;
	q->unsettled = false;
	for (int i = 0; i < q->n; i++) {
		struct job *job = q->jobs[i];
		if (!job->unsettled || !job_can(job->stats.state, EV_REFUSE) || job->process)
			continue;
		int unsettled = line_unsettled(job);
		if (unsettled != job->unsettled)
			job_changed(job, true);
		job->unsettled = unsettled;
		for (int k = 0; k < n_awaited(job); k++) {
			const struct job *other = awaited(job, k);
			enum job_state state = other ? other->stats.state : JOB_DONE;
			if (!other || !job_state_table[state].over || job->fault)
				continue;
			job_fault(job,
			          "not run: job %lld, which it waits for, is %s; retry that one "
			          "first",
			          (long long)other->stats.id, job_state_table[state].word);
			job_step(job, EV_REFUSE, NULL);
		}
		free(job->fault);
		job->fault = NULL;
	}
	/* a chain's later members were settled in this pass: nothing is left to do */
	q->unsettled = false;
}

static void reason_after(struct job *job)
{
	char list[128] = "";
	int n = 0, shown = 0;
	for (int i = 0; i < n_awaited(job) && n < (int)sizeof list - 24; i++) {
		const struct job *other = awaited(job, i);
		if (!other)
			continue;
		n += snprintf(list + n, sizeof list - (size_t)n, "%s%lld", shown++ ? ", " : "",
		              (long long)other->stats.id);
	}
	job_reason(job, "after %s%s", list, shown < job->unsettled ? ", ..." : "");
}

static void reason_room(struct job *job, const struct pool *pool)
{
	char running[64] = "";
	if (pool->promised_mib)
		snprintf(running, sizeof running, ", %lld of these by jobs that run",
		         (long long)pool->promised_mib);
	bool like = pool->wanted_mib > pool->promised_mib + job->q->limits.disk_floor_mib;
	job_reason(job, "disk: %lld MiB left where it writes, %lld wanted%s%s; make room",
	           (long long)pool->room_mib, (long long)pool->wanted_mib,
	           like ? " by what its like took" : "", running);
}

void line_reason(struct job *job)
{
	const struct queue *q = job->q;
	const struct pool *pool = job_pool(job);
	if (job->stats.state != JOB_QUEUED)
		return;
	if (q->leaving)
		job_reason(job, "the service ends; it runs after the next start");
	else if (q->fault)
		job_reason(job, "the ledger takes nothing: %s", q->fault);
	else if (job->unsettled)
		reason_after(job);
	else if (!slot_free(q, pool))
		job_reason(job, "slots full");
	else if (!threads_free(q, job))
		job_reason(job, "threads: %d of %d in use, it wants %d", pool->threads,
		           q->limits.threads, job_threads(job));
	else if (!memory_free(q, job))
		job_reason(job, "memory: %lld of %lld MiB in use, it wants %lld",
		           (long long)pool->memory_mib, (long long)q->limits.memory_mib,
		           (long long)job_memory_mib(job));
	else if (pool->blocked == job && pool->room_mib >= 0)
		reason_room(job, pool);
	else if (pool->blocked)
		job_reason(job, "behind job %lld", (long long)pool->blocked->stats.id);
	else
		job_reason(job, NULL);
}
