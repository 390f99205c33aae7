/* state.c - the table of states against events, and what each cell does. */
#include "state.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "job.h"

#define X(name, asked) asked,
const char *const job_event_asked[N_JOB_EVENTS] = { JOB_EVENT_MAP(X) };
#undef X

const char job_held_text[] = "the queue is held; 'batten release --all' lets it go on";

/* What did not fit ends with a whole character: half of one is no UTF-8, and the record no JSON. */
static void text_end(char *text, int wanted, int size)
{
	if (wanted < size)
		return;
	int n = size - 1;
	while (n && ((unsigned char)text[n - 1] & 0xc0) == 0x80)
		n--;
	if (n && (unsigned char)text[n - 1] >= 0x80)
		n--;
	text[n] = '\0';
}

void job_reason(struct job *job, const char *format, ...)
{
	char text[1024];
	va_list ap;
	if (!format) {
		free(job->stats.reason);
		job->stats.reason = NULL;
		return;
	}
	va_start(ap, format);
	text_end(text, vsnprintf(text, sizeof text, format, ap), sizeof text);
	va_end(ap);
	if (job->stats.reason && !strcmp(job->stats.reason, text))
		return;
	free(job->stats.reason);
	job->stats.reason = strdup(text);
}

/* The first fault is the one that counts. */
void job_fault(struct job *job, const char *format, ...)
{
	char text[1024];
	va_list ap;
	if (job->fault)
		return;
	va_start(ap, format);
	text_end(text, vsnprintf(text, sizeof text, format, ap), sizeof text);
	va_end(ap);
	job->fault = strdup(text);
}

static bool holds_slot(enum job_state s)
{
	return s == JOB_STARTING || s == JOB_RUNNING || s == JOB_ENDING;
}

void job_enter(struct job *job, enum job_state state)
{
	struct queue *q = job->q;
	enum job_state old = job->stats.state;
	if (job->in_line)
		line_remove(job);
	struct pool *pool = job_pool(job);
	pool->active += holds_slot(state) - holds_slot(old);
	pool->threads += job_threads(job) * (holds_slot(state) - holds_slot(old));
	q->count[old]--;
	q->count[state]++;
	job->stats.state = state;
	if (state == JOB_QUEUED)
		line_add(job);
	if (job_state_table[state].over) {
		job->stats.ended = q->ports.clock->date(q->ports.clock->data);
		q->unsettled |= q->dependents > 0;
	}
	job_changed(job, true);
}

static void do_hold(struct job *job, const char *by)
{
	job_enter(job, JOB_HELD);
	job_reason(job, "held by %s", by);
}

static void do_release(struct job *job, const char *by)
{
	(void)by;
	job_enter(job, JOB_QUEUED);
}

static void do_drop(struct job *job, const char *by)
{
	job_enter(job, JOB_KILLED);
	job_reason(job, "killed by %s before it ran", by);
}

static void do_refuse(struct job *job, const char *by)
{
	(void)by;
	job_enter(job, JOB_FAILED);
	job_reason(job, "%s", job->fault ? job->fault : "it could not be started");
}

static void do_launch(struct job *job, const char *by)
{
	(void)by;
	job->front = false;
	job_enter(job, JOB_STARTING);
	job_reason(job, NULL);
	job->deadline = queue_now(job->q) + job->q->limits.hello_grace;
}

static void do_greet(struct job *job, const char *by)
{
	(void)by;
	job->deadline = INFINITY;
	job_reason(job, NULL);
	job_enter(job, JOB_RUNNING);
}

static void do_stop(struct job *job, const char *by)
{
	job->stopping = true;
	job->deadline = INFINITY;
	job_reason(job, "suspended by %s", by);
	job_signal(job, LAUNCHER_STOP);
}

static void do_stopped(struct job *job, const char *by)
{
	(void)by;
	if (!job->stopping)
		job_reason(job, "stopped by a signal from outside");
	job->stopping = false;
	job->deadline = INFINITY;
	job->stopped_at = queue_now(job->q);
	job_enter(job, JOB_SUSPENDED);
}

static void do_continued(struct job *job, const char *by)
{
	(void)by;
	double now = queue_now(job->q);
	job->stopped_s += now - job->stopped_at;
	job_reason(job, NULL);
	job_enter(job, job->greeted ? JOB_RUNNING : JOB_STARTING);
	if (!job->greeted)
		job->deadline = now + job->q->limits.hello_grace;
	else if (job->finished || job->fault || job->exited || job->drained)
		job->deadline = now + job->q->limits.end_grace;
}

/* One that lost its process with an earlier service goes on from its part file, first in line. */
static void do_activate(struct job *job, const char *by)
{
	if (job->process) {
		job_signal(job, LAUNCHER_CONTINUE);
		do_continued(job, by);
		return;
	}
	job->front = true;
	job_enter(job, JOB_QUEUED);
}

static void do_kill(struct job *job, const char *by)
{
	if (!job->process) {
		do_drop(job, by);
		return;
	}
	job_reason(job, "killed by %s", by);
	job_end(job, CAUSE_KILL, STEP_CANCEL);
}

/* Killed while it is being ended for another reason: what was settled stays so. */
static void do_kill_ending(struct job *job, const char *by)
{
	if (job->cause == CAUSE_LEAVE) {
		job->cause = CAUSE_KILL;
		job_reason(job, "killed by %s", by);
	}
}

static void do_break(struct job *job, const char *by)
{
	(void)by;
	job_end(job, CAUSE_FAULT, STEP_KILL);
}

static void do_break_ending(struct job *job, const char *by)
{
	(void)by;
	if (job->cause == CAUSE_LEAVE)
		job->cause = CAUSE_FAULT;
	job->step = STEP_TERMINATE;
	job_escalate(job);
}

static void do_late(struct job *job, const char *by)
{
	(void)by;
	job_escalate(job);
}

static void do_late_hello(struct job *job, const char *by)
{
	if (job->drained)
		job_fault(job, "worker %s closed its pipe before HELLO and did not end within %g s",
		          job->stats.worker, job->q->limits.end_grace);
	else
		job_fault(job, "no HELLO from worker %s within %g s; see 'batten log %lld'",
		          job->stats.worker, job->q->limits.hello_grace, (long long)job->stats.id);
	do_break(job, by);
}

static void do_late_end(struct job *job, const char *by)
{
	double grace = job->q->limits.end_grace;
	if (job->finished && !job->drained)
		job_fault(job, "worker %s said DONE and did not end within %g s", job->stats.worker,
		          grace);
	else
		job_fault(job, "worker %s closed its pipe and did not end within %g s",
		          job->stats.worker, grace);
	do_break(job, by);
}

static void do_leave(struct job *job, const char *by)
{
	(void)by;
	job_reason(job, "stopped at a unit: the service ended");
	job_end(job, CAUSE_LEAVE, STEP_CANCEL);
}

/* Its process ends with the service; suspended it stays. */
static void do_leave_suspended(struct job *job, const char *by)
{
	(void)by;
	job->cause = CAUSE_LEAVE;
	job->step = STEP_KILL;
	job_signal(job, LAUNCHER_KILL);
}

static void do_gone(struct job *job, const char *by)
{
	(void)by;
	job_gone(job);
}

static void do_retry(struct job *job, const char *by)
{
	(void)by;
	job->losses = 0;
	job->stats.ended = 0;
	job->stats.eta_s = NAN;
	job_reason(job, NULL);
	free(job->fault);
	job->fault = NULL;
	stats_drop_outputs(&job->stats);
	job->unsettled = line_unsettled(job);
	job->q->unsettled = true;
	job_enter(job, job->q->held ? JOB_HELD : JOB_QUEUED);
	if (job->q->held)
		job_reason(job, "%s", job_held_text);
}

typedef void job_action(struct job *job, const char *by);

/* An empty cell: not possible now. */
static job_action *const action[N_JOB_STATES][N_JOB_EVENTS] = {
	/* clang-format off */
	[JOB_QUEUED]    = {[EV_HOLD] = do_hold, [EV_KILL] = do_drop, [EV_LAUNCH] = do_launch,
	                   [EV_REFUSE] = do_refuse},
	[JOB_HELD]      = {[EV_RELEASE] = do_release, [EV_KILL] = do_drop, [EV_REFUSE] = do_refuse},
	[JOB_STARTING]  = {[EV_SUSPEND] = do_stop, [EV_STOPPED] = do_stopped, [EV_KILL] = do_kill,
	                   [EV_REFUSE] = do_refuse, [EV_GREET] = do_greet, [EV_BREAK] = do_break,
	                   [EV_LATE] = do_late_hello, [EV_LEAVE] = do_leave, [EV_GONE] = do_gone},
	[JOB_RUNNING]   = {[EV_SUSPEND] = do_stop, [EV_STOPPED] = do_stopped, [EV_KILL] = do_kill,
	                   [EV_BREAK] = do_break, [EV_LATE] = do_late_end, [EV_LEAVE] = do_leave,
	                   [EV_GONE] = do_gone},
	[JOB_SUSPENDED] = {[EV_ACTIVATE] = do_activate, [EV_CONTINUED] = do_continued,
	                   [EV_KILL] = do_kill, [EV_BREAK] = do_break, [EV_LATE] = do_late_end,
	                   [EV_LEAVE] = do_leave_suspended, [EV_GONE] = do_gone},
	[JOB_ENDING]    = {[EV_KILL] = do_kill_ending, [EV_BREAK] = do_break_ending,
	                   [EV_LATE] = do_late, [EV_GONE] = do_gone},
	[JOB_FAILED]    = {[EV_RETRY] = do_retry},
	[JOB_KILLED]    = {[EV_RETRY] = do_retry},
	[JOB_LOST]      = {[EV_RETRY] = do_retry},
	/* clang-format on */
};

bool job_can(enum job_state state, enum job_event event)
{
	return action[state][event] != NULL;
}

enum status job_step(struct job *job, enum job_event event, const char *by)
{
	job_action *act = action[job->stats.state][event];
	if (!act)
		return ST_INPUT;
	act(job, by);
	return ST_OK;
}
