/* ending.c - how a worker is brought to its end, and what its job then is. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "job.h"

/* times that a job's process may be lost before the job is */
enum { LOSSES_MAX = 3 };

/* The service must be gone within 5 s. */
static const double leave_grace_s = 2;

static const struct launcher *launcher(const struct job *job)
{
	return job->q->ports.launcher;
}

void job_signal(struct job *job, enum launcher_signal signal)
{
	launcher(job)->signal(launcher(job)->data, job->stats.id, signal);
}

/* One step further. A stopped worker must go on to hear it; SIGKILL is said again as long as needed. */
void job_escalate(struct job *job)
{
	const struct queue_limits *limits = &job->q->limits;
	double grace = limits->end_grace;
	if (job->step < STEP_KILL)
		job->step++;
	if (job->step == STEP_CANCEL) {
		launcher(job)->send(launcher(job)->data, job->stats.id, MESSAGE_CANCEL, NULL);
		job_signal(job, LAUNCHER_CONTINUE);
		grace = limits->cancel_grace;
	} else if (job->step == STEP_TERMINATE) {
		job_signal(job, LAUNCHER_TERMINATE);
		grace = limits->term_grace;
	} else {
		job_signal(job, LAUNCHER_KILL);
	}
	if (job->cause == CAUSE_LEAVE)
		grace = fmin(grace, leave_grace_s);
	job->deadline = queue_now(job->q) + grace;
}

void job_end(struct job *job, enum job_cause cause, enum ending step)
{
	if (job->stats.state == JOB_SUSPENDED)
		job->stopped_s += queue_now(job->q) - job->stopped_at;
	job->cause = cause;
	job->stopping = false;
	job->step = step - 1;
	job_enter(job, JOB_ENDING);
	job_escalate(job);
}

/* In words, from how it ended, where it said nothing itself. */
static void explain(struct job *job)
{
	const struct launcher_exit *e = &job->exit;
	const char *worker = job->stats.worker;
	long long id = job->stats.id;
	if (e->signal == 9)
		job_fault(job,
		          "worker %s was killed from outside (signal 9), perhaps for want of "
		          "memory; 'batten retry %lld' goes on from its part file",
		          worker, id);
	else if (e->signal)
		job_fault(job,
		          "worker %s ended by signal %d (%s); see 'batten log %lld', 'batten "
		          "retry %lld' goes on from its part file",
		          worker, e->signal, strsignal(e->signal), id, id);
	else if (!job->greeted && (e->status == 126 || e->status == 127))
		job_fault(job, "worker %s could not be started; see 'batten log %lld'", worker, id);
	else if (!job->greeted)
		job_fault(job, "worker %s ended with status %d before HELLO; see 'batten log %lld'",
		          worker, e->status, id);
	else if (e->status)
		job_fault(
		        job,
		        "worker %s ended with status %d and did not say why; see 'batten log %lld'",
		        worker, e->status, id);
	else if (!job->finished)
		job_fault(job, "worker %s ended without DONE; see 'batten log %lld'", worker, id);
	else
		job_fault(job, "worker %s said DONE without a RESULT; see 'batten log %lld'",
		          worker, id);
}

static void leave_process(struct job *job)
{
	struct queue *q = job->q;
	for (int i = 0; i < q->n_active; i++)
		if (q->active[i] == job)
			q->active[i--] = q->active[--q->n_active];
	job_pool(job)->memory_mib -= job_memory_mib(job);
	job_times(job);
	job->process = false;
	job->deadline = INFINITY;
	job->stats.pid = 0;
	job->stats.eta_s = NAN;
	if (isfinite(job->exit.cpu_s))
		job->stats.cpu_s = job->exit.cpu_s;
	if (job->exit.peak_kib >= 0)
		job->stats.peak_kib = job->exit.peak_kib;
	launcher(job)->forget(launcher(job)->data, job->stats.id);
}

void job_tidy(struct job *job)
{
	const struct queue_ports *ports = &job->q->ports;
	if (ports->tidy)
		ports->tidy(ports->room_data, &job->stats);
}

/* It was not its own doing: it goes on from its part file, but not for ever. */
static void lose(struct job *job)
{
	if (++job->losses < LOSSES_MAX) {
		job->front = true;
		job_enter(job, JOB_QUEUED);
		return;
	}
	job_enter(job, JOB_LOST);
	job_reason(job, "%s, %d times; 'batten retry %lld' goes on from its part file",
	           job->fault ? job->fault : "its process went away", LOSSES_MAX,
	           (long long)job->stats.id);
}

void job_gone(struct job *job)
{
	bool clean = !job->exit.signal && !job->exit.status;
	bool complete = job->greeted && job->finished && job->stats.n_outputs && clean;
	/* one that is stopped before it was told what to do can only say so by its status */
	bool cancelled =
	        job->error == ST_CANCELLED || (!job->error && job->greeted && !job->exit.signal &&
	                                       job->exit.status == status_exit(ST_CANCELLED));
	enum job_cause cause = job->cause;

	leave_process(job);
	if (!clean)
		job_tidy(job);
	if (*job->exit.why && cause == CAUSE_NONE) {
		free(job->fault);
		job->fault = strdup(job->exit.why);
		cancelled = false;
	}
	if (complete && cause != CAUSE_FAULT && !job->error) {
		job_enter(job, JOB_DONE);
		job_reason(job, NULL);
		if (job->q->ports.size)
			job->stats.bytes = job->q->ports.size(job->q->ports.room_data, &job->stats);
		history_add(job);
	} else if (cause == CAUSE_KILL) {
		job_enter(job, JOB_KILLED);
	} else if (cause == CAUSE_LEAVE && job->stats.state == JOB_SUSPENDED) {
		job_changed(job, true);
	} else if (cause == CAUSE_LEAVE && (!job->error || cancelled)) {
		job->front = true;
		job_enter(job, JOB_QUEUED);
	} else if (job->exit.lost && cause == CAUSE_NONE) {
		lose(job);
	} else if (cancelled && cause == CAUSE_NONE) {
		job_enter(job, JOB_KILLED);
		job_reason(job,
		           "stopped from outside; 'batten retry %lld' goes on from its part file",
		           (long long)job->stats.id);
	} else {
		explain(job);
		job_enter(job, JOB_FAILED);
		job_reason(job, "%s", job->fault ? job->fault : "out of memory");
	}
	free(job->fault);
	job->fault = NULL;
}
