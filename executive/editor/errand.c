/* errand.c - one call of a routine with all that comes of it. */
#include "errand.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

struct errand {
	const struct routine *routine;
	struct arguments given; /* owned strings */
	struct act act;
	struct report_store store;
	struct text said, warned;
	enum status status;
	bool threaded;
	pthread_t thread;
	void (*wake)(void *data);
	void *data; /* borrowed */
	double woke_at;
	atomic_bool stop, over;
	pthread_mutex_t mutex; /* of the two below */
	double fraction;
	char what[128];
};

static double now_s(void)
{
	struct timespec t;

	clock_gettime(CLOCK_MONOTONIC, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void add_line(struct text *t, const char *line)
{
	if (t->n)
		text_add(t, "\n");
	text_add(t, line);
}

static void say(void *data, const char *text)
{
	struct errand *e = data;

	add_line(&e->said, text);
}

static void report(void *data, enum report_level level, enum status st, const char *text)
{
	struct errand *e = data;

	if (level == REPORT_WARNING)
		add_line(&e->warned, text);
	else if (level == REPORT_INFO)
		add_line(&e->said, text);
	e->store.report.say(&e->store, level, st, text);
}

static void progress(void *data, double fraction, const char *what)
{
	struct errand *e = data;

	pthread_mutex_lock(&e->mutex);
	e->fraction = fraction;
	snprintf(e->what, sizeof e->what, "%s", what ? what : "");
	pthread_mutex_unlock(&e->mutex);
	double now = now_s();
	if (e->wake && now - e->woke_at > 0.1) {
		e->woke_at = now;
		e->wake(e->data);
	}
}

static enum status copy_given(struct arguments *out, const struct arguments *in)
{
	size_t n = (size_t)in->n + 1;

	out->name = calloc(n, sizeof *out->name);
	out->value = calloc(n, sizeof *out->value);
	if (!out->name || !out->value)
		return ST_RESOURCE;
	for (int i = 0; i < in->n; i++, out->n++) {
		out->name[i] = strdup(in->name[i]);
		out->value[i] = strdup(in->value[i]);
		if (!out->name[i] || !out->value[i])
			return ST_RESOURCE;
	}
	return ST_OK;
}

enum status errand_create(struct errand **out, const struct routine *t, struct world *w,
                          const struct project *p, const struct arguments *given,
                          errand_picture *picture)
{
	struct errand *e = calloc(1, sizeof *e);

	if (!e)
		return ST_RESOURCE;
	e->routine = t;
	e->fraction = NAN;
	pthread_mutex_init(&e->mutex, NULL);
	report_store_init(&e->store);
	e->act = (struct act){ .world = w,
		               .project = p,
		               .report = { report, e },
		               .say = say,
		               .progress = progress,
		               .data = e,
		               .stop = &e->stop,
		               .journal = true,
		               .picture = picture };
	if (copy_given(&e->given, given) != ST_OK) {
		errand_destroy(e);
		return ST_RESOURCE;
	}
	*out = e;
	return ST_OK;
}

void errand_destroy(struct errand *e)
{
	if (!e)
		return;
	if (e->threaded)
		pthread_join(e->thread, NULL);
	for (int i = 0; e->given.name && e->given.value && i <= e->given.n; i++) {
		free((char *)e->given.name[i]);
		free((char *)e->given.value[i]);
	}
	free(e->given.name);
	free(e->given.value);
	text_finish(&e->said);
	text_finish(&e->warned);
	pthread_mutex_destroy(&e->mutex);
	free(e);
}

void errand_run(struct errand *e)
{
	e->status = routine_call(e->routine, &e->act, &e->given);
	atomic_store(&e->over, true);
}

static void *errand_main(void *data)
{
	struct errand *e = data;

	errand_run(e);
	e->wake(e->data);
	return NULL;
}

enum status errand_start(struct errand *e, void (*wake)(void *data), void *data)
{
	e->wake = wake;
	e->data = data;
	e->threaded = pthread_create(&e->thread, NULL, errand_main, e) == 0;
	return e->threaded ? ST_OK : ST_RESOURCE;
}

bool errand_over(struct errand *e)
{
	return atomic_load(&e->over);
}

void errand_stop(struct errand *e)
{
	atomic_store(&e->stop, true);
}

double errand_progress(struct errand *e, char what[128])
{
	pthread_mutex_lock(&e->mutex);
	double fraction = e->fraction;
	memcpy(what, e->what, sizeof e->what);
	pthread_mutex_unlock(&e->mutex);
	return fraction;
}

int errand_jobs(const struct errand *e)
{
	return e->act.n_jobs;
}

const struct routine *errand_routine(const struct errand *e)
{
	return e->routine;
}

const struct arguments *errand_given(const struct errand *e)
{
	return &e->given;
}

enum status errand_status(const struct errand *e)
{
	return e->status;
}

const char *errand_error(const struct errand *e)
{
	return e->store.error;
}

const char *errand_said(const struct errand *e)
{
	return e->said.s ? e->said.s : "";
}

const char *errand_warning(const struct errand *e)
{
	return e->warned.s ? e->warned.s : "";
}
