/* packets.c - what a worker's packets do to its job. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "job.h"
#include "json.h"

/* Far above what a good worker sends, far below what would harm the others. */
enum {
	PACKETS_AT_ONCE = 500000,
	PACKETS_A_SECOND = 20000,
	NOTES_AT_ONCE = 1000,
	NOTES_A_SECOND = 20,
	OUTPUTS_MAX = 1000,
};

/* Take one out; false when it is empty. */
static bool bucket_take(struct bucket *b, double now, double at_once, double a_second)
{
	if (!b->at)
		b->level = at_once;
	else
		b->level = fmin(at_once, b->level + (now - b->at) * a_second);
	b->at = now;
	if (b->level < 1)
		return false;
	b->level -= 1;
	return true;
}

static double stopped_s(const struct job *job, double now)
{
	bool stopped = job->stats.state == JOB_SUSPENDED;
	return job->stopped_s + (stopped ? now - job->stopped_at : 0);
}

double job_running_s(const struct job *job)
{
	double now = queue_now(job->q);
	return now - job->began - stopped_s(job, now);
}

double job_wall_end(const struct job *job)
{
	double limit = job->stats.wall_limit_s;
	if (!(limit > 0) || job->stats.state != JOB_RUNNING || job->finished || job->fault)
		return INFINITY;
	return job->began + job->stopped_s + job->greeted_s + limit;
}

void job_times(struct job *job)
{
	struct Stats *s = &job->stats;
	if (!job->process)
		return;
	double now = queue_now(job->q);
	s->wall_s = now - job->began;
	s->suspended_s = stopped_s(job, now);
	double running = s->wall_s - s->suspended_s;
	double rate = (double)(s->done - job->pace_done) / (running - job->pace_at);
	if (rate > 0 && isfinite(rate) && s->total >= s->done)
		s->eta_s = (double)(s->total - s->done) / rate;
	else
		s->eta_s = fdim(history_seconds(job), running);
}

static void take_host(struct job *job, const json_t *o)
{
	const char *host = json_text(o, "host", NULL);
	char *copy = host ? strdup(host) : NULL;
	if (!copy)
		return;
	free(job->stats.host);
	job->stats.host = copy;
}

static void on_hello(struct job *job, const json_t *o)
{
	const struct launcher *l = job->q->ports.launcher;
	int64_t protocol = json_int(o, "protocol", 0);
	if (job->greeted) {
		job_fault(job, "worker %s said HELLO twice", job->stats.worker);
		job_step(job, EV_BREAK, NULL);
		return;
	}
	if (protocol != MESSAGE_PROTOCOL) {
		job_fault(job,
		          "worker %s speaks protocol %lld, this batten speaks %d; build them anew "
		          "together",
		          job->stats.worker, (long long)protocol, MESSAGE_PROTOCOL);
		job_step(job, EV_BREAK, NULL);
		return;
	}
	job->greeted = true;
	take_host(job, o);
	job->greeted_s = job_running_s(job);
	if (job->stats.state == JOB_ENDING)
		return;
	json_t *start = json_object();
	json_set_text(start, "job", l->job_file(l->data, job->stats.id));
	enum status st = l->send(l->data, job->stats.id, MESSAGE_START, start);
	json_decref(start);
	if (st != ST_OK) {
		job_fault(job, "worker %s does not take START", job->stats.worker);
		job_step(job, EV_BREAK, NULL);
		return;
	}
	job_step(job, EV_GREET, NULL);
}

static void on_progress(struct job *job, const json_t *o)
{
	struct Stats *s = &job->stats;
	take_host(job, o);
	int64_t done = json_int(o, "done", 0), total = json_int(o, "total", 0);
	const char *phase = json_text(o, "phase", NULL);
	bool same = s->phase && phase ? !strcmp(s->phase, phase) : !s->phase && !phase;
	if (!same) {
		free(s->phase);
		s->phase = phase ? strdup(phase) : NULL;
	}
	if (!same || total != s->total || done < s->done || isnan(job->pace_at)) {
		job->pace_at = job_running_s(job);
		job->pace_done = done;
	}
	s->done = done < 0 ? 0 : done;
	s->total = total < 0 ? 0 : total;
	job_changed(job, false);
}

static void on_note(struct job *job, const json_t *o)
{
	const struct launcher *l = job->q->ports.launcher;
	if (!bucket_take(&job->notes, queue_now(job->q), NOTES_AT_ONCE, NOTES_A_SECOND)) {
		job_fault(job, "worker %s floods its log: more than %d notes at once",
		          job->stats.worker, NOTES_AT_ONCE);
		job_step(job, EV_BREAK, NULL);
		return;
	}
	l->note(l->data, job->stats.id, json_text(o, "level", "info"), json_text(o, "text", ""));
}

static void on_unit(struct job *job, const json_t *o)
{
	(void)o;
	job_changed(job, false);
}

static void on_result(struct job *job, const json_t *o)
{
	struct Stats *s = &job->stats;
	const json_t *figures = json_object_get(o, "figures");
	struct job_output *p = s->n_outputs < OUTPUTS_MAX
	                               ? realloc(s->outputs, ((size_t)s->n_outputs + 1) * sizeof *p)
	                               : NULL;
	if (!p) {
		job_fault(job, "worker %s states more than %d results", s->worker, OUTPUTS_MAX);
		job_step(job, EV_BREAK, NULL);
		return;
	}
	s->outputs = p;
	p[s->n_outputs++] = (struct job_output){
		.path = strdup(json_text(o, "path", "")),
		.kind = strdup(json_text(o, "kind", "")),
		.figures = json_is_object(figures) ? json_deep_copy(figures) : NULL,
	};
	job_changed(job, false);
}

static void on_error(struct job *job, const json_t *o)
{
	job->error = status_from_class(json_text(o, "class", ""));
	if (job->error == ST_OK)
		job->error = ST_INTERNAL;
	job_fault(job, "%s", json_text(o, "text", "the worker gave no reason"));
	if (job->stats.state == JOB_RUNNING)
		job->deadline = queue_now(job->q) + job->q->limits.end_grace;
}

static void on_done(struct job *job, const json_t *o)
{
	job->finished = true;
	job->stats.cpu_s = json_number(o, "cpu_s", NAN);
	job->stats.peak_kib = json_int(o, "peak_kib", -1);
	if (job->stats.state == JOB_RUNNING)
		job->deadline = queue_now(job->q) + job->q->limits.end_grace;
}

static const struct {
	enum message_type type;
	void (*take)(struct job *job, const json_t *o);
} takers[] = {
	{ MESSAGE_HELLO, on_hello }, { MESSAGE_PROGRESS, on_progress }, { MESSAGE_NOTE, on_note },
	{ MESSAGE_UNIT, on_unit },   { MESSAGE_RESULT, on_result },     { MESSAGE_ERROR, on_error },
	{ MESSAGE_DONE, on_done },
};

void job_packet(struct job *job, const struct message *m)
{
	if (job->cause == CAUSE_FAULT)
		return;
	if (!bucket_take(&job->packets, queue_now(job->q), PACKETS_AT_ONCE, PACKETS_A_SECOND)) {
		job_fault(job, "worker %s floods its pipe: more than %d packets at once",
		          job->stats.worker, PACKETS_AT_ONCE);
		job_step(job, EV_BREAK, NULL);
		return;
	}
	if (!job->greeted && m->type != MESSAGE_HELLO && m->type != MESSAGE_ERROR) {
		job_fault(job, "worker %s sent %s before HELLO", job->stats.worker,
		          message_row(m->type)->name);
		job_step(job, EV_BREAK, NULL);
		return;
	}
	for (size_t i = 0; i < sizeof takers / sizeof *takers; i++)
		if (takers[i].type == m->type)
			takers[i].take(job, m->body);
}
