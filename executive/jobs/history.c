/* history.c - what earlier jobs of a worker took: the time left of one that has told nothing yet. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "job.h"

static struct history *history_find(const struct queue *q, const char *worker)
{
	for (int i = 0; i < q->n_history; i++)
		if (!strcmp(q->history[i].worker, worker))
			return &q->history[i];
	return NULL;
}

static struct history *history_make(struct queue *q, const char *worker)
{
	struct history *h = reallocarray(q->history, (size_t)q->n_history + 1, sizeof *h);
	if (!h)
		return NULL;
	q->history = h;
	h += q->n_history;
	*h = (struct history){ .worker = strdup(worker) };
	if (!h->worker)
		return NULL;
	q->n_history++;
	return h;
}

static struct likeness *likeness_find(struct queue *q, const struct Stats *s)
{
	for (int i = 0; i < LIKENESSES; i++) {
		struct likeness *l = &q->likenesses[i];
		if (l->worker && !strcmp(l->worker, s->worker) &&
		    json_equal(l->parameters, s->parameters))
			return l;
	}
	return NULL;
}

static void likeness_drop(struct likeness *l)
{
	free(l->worker);
	json_decref(l->parameters);
	*l = (struct likeness){ 0 };
}

static void likeness_add(struct queue *q, const struct Stats *s)
{
	struct likeness *l = likeness_find(q, s);
	if (!l) {
		l = &q->likenesses[q->next_likeness];
		q->next_likeness = (q->next_likeness + 1) % LIKENESSES;
		likeness_drop(l);
		l->worker = strdup(s->worker);
		l->parameters = json_incref(s->parameters); /* a submitted job's never change */
	}
	l->bytes = s->bytes > l->bytes ? s->bytes : l->bytes;
}

int64_t history_bytes(const struct job *job)
{
	const struct Stats *s = &job->stats;
	const struct likeness *l = s->worker && s->parameters ? likeness_find(job->q, s) : NULL;
	return l ? l->bytes : 0;
}

/* One found up to date made no units and says nothing. */
void history_add(struct job *job)
{
	const struct Stats *s = &job->stats;
	double seconds = s->wall_s - s->suspended_s;
	if (s->worker && s->parameters && s->bytes >= 0)
		likeness_add(job->q, s);
	if (!s->worker || s->total < 1 || !(seconds > 0))
		return;
	struct history *h = history_find(job->q, s->worker);
	if (!h)
		h = history_make(job->q, s->worker);
	if (!h)
		return;
	h->seconds += seconds * job_threads(job);
	h->units += (double)s->total;
	h->jobs++;
}

double history_seconds(const struct job *job)
{
	const struct Stats *s = &job->stats;
	const struct history *h = s->worker ? history_find(job->q, s->worker) : NULL;
	if (!h)
		return NAN;
	double seconds =
	        s->total > 0 ? h->seconds / h->units * (double)s->total : h->seconds / h->jobs;
	return seconds / job_threads(job);
}

void history_finish(struct queue *q)
{
	for (int i = 0; i < q->n_history; i++)
		free(q->history[i].worker);
	free(q->history);
	for (int i = 0; i < LIKENESSES; i++)
		likeness_drop(&q->likenesses[i]);
}
