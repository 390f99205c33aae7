/* selection.c - which jobs a request is about, and what is wrong with it. */
#include "selection.h"

#include <stdlib.h>
#include <string.h>

struct queue *request_queue(const struct request *q)
{
	return q->session->server->queue;
}

/* The first sentence is the one the client gets, with ERROR in place of END. */
static void request_say(void *data, enum report_level level, enum status st, const char *text)
{
	struct request *q = data;
	if (level != REPORT_ERROR || q->error)
		return;
	q->st = st;
	q->error = strdup(text);
}

struct report request_report(struct request *q)
{
	return (struct report){ .say = request_say, .data = q };
}

void request_fail(struct request *q, enum status st, const char *text)
{
	struct report r = request_report(q);
	report_error(&r, st, "%s", text);
}

static int by_id(const void *a, const void *b)
{
	int64_t x = *(const int64_t *)a, y = *(const int64_t *)b;
	return (x > y) - (x < y);
}

bool request_room(struct request *q, size_t n)
{
	q->jobs = calloc(n + 1, sizeof *q->jobs);
	if (!q->jobs)
		request_fail(q, ST_RESOURCE, "out of memory");
	return q->jobs;
}

bool selection_named(struct request *q, const json_t *ids)
{
	struct report r = request_report(q);
	if (!request_room(q, json_array_size(ids)))
		return false;
	for (size_t i = 0; i < json_array_size(ids); i++) {
		int64_t id = json_integer_value(json_array_get(ids, i));
		if (queue_has(request_queue(q), id))
			q->jobs[q->n++] = id;
		else
			report_error(&r, ST_INPUT,
			             "there is no job %lld; 'batten jobs --all' lists them",
			             (long long)id);
	}
	qsort(q->jobs, (size_t)q->n, sizeof *q->jobs, by_id);
	return true;
}

bool selection_in_group(const struct Stats *s, const char *group)
{
	return !group || (s->group && !strcmp(s->group, group));
}

static bool group_met(struct request *q, const char *group)
{
	const struct ledger_choice any = { .group = group, .newest = 1 };
	struct report r = request_report(q);
	int64_t *ids;
	size_t n;
	for (int i = 0; i < queue_count(request_queue(q)); i++)
		if (selection_in_group(queue_at(request_queue(q), i), group))
			return true;
	if (queue_over(request_queue(q), &any, &ids, &n, &r) != ST_OK)
		return false;
	free(ids);
	if (!n)
		report_error(&r, ST_INPUT, "there is no group '%s'", group);
	return n;
}

bool selection_where(struct request *q, const char *group, const struct selection *which)
{
	struct queue *jobs = request_queue(q);
	struct report r = request_report(q);
	int64_t *over = NULL;
	size_t n_over = 0;
	if (group && !group_met(q, group))
		return false;
	if (which->over) {
		struct ledger_choice choice = *which->over;
		choice.group = group;
		if (queue_over(jobs, &choice, &over, &n_over, &r) != ST_OK)
			return false;
	}
	if (!request_room(q, (size_t)queue_count(jobs) + n_over)) {
		free(over);
		return false;
	}
	for (int i = 0; i < queue_count(jobs); i++) {
		const struct Stats *s = queue_at(jobs, i);
		if (selection_in_group(s, group) && (!which->pass || which->pass(s, which->data)))
			q->jobs[q->n++] = s->id;
	}
	for (size_t i = 0; i < n_over; i++)
		q->jobs[q->n++] = over[i];
	free(over);
	if (n_over)
		qsort(q->jobs, (size_t)q->n, sizeof *q->jobs, by_id);
	return true;
}

bool selection_has(const struct request *q, int64_t id)
{
	return bsearch(&id, q->jobs, (size_t)q->n, sizeof *q->jobs, by_id);
}
