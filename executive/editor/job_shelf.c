/* job_shelf.c - copies of job records by id. */
#include "jobs_link.h"

#include <stdlib.h>
#include <string.h>

/* Where the id is, or would be. */
static int place_of(const struct job_shelf *s, int64_t id)
{
	int lo = 0, hi = s->n;

	while (lo < hi) {
		int mid = (lo + hi) / 2;
		if (s->jobs[mid].id < id)
			lo = mid + 1;
		else
			hi = mid;
	}
	return lo;
}

const struct Stats *job_shelf_find(const struct job_shelf *s, int64_t id)
{
	int at = place_of(s, id);

	return at < s->n && s->jobs[at].id == id ? &s->jobs[at] : NULL;
}

enum status job_shelf_put(struct job_shelf *s, const struct Stats *job)
{
	struct Stats copy;
	int at = place_of(s, job->id);
	enum status st = stats_copy(&copy, job);

	if (st != ST_OK)
		return st;
	if (at < s->n && s->jobs[at].id == job->id) {
		stats_finish(&s->jobs[at]);
		s->jobs[at] = copy;
		return ST_OK;
	}
	if (s->n == s->cap) {
		int cap = s->cap ? 2 * s->cap : 64;
		struct Stats *more = reallocarray(s->jobs, (size_t)cap, sizeof *more);
		if (!more) {
			stats_finish(&copy);
			return ST_RESOURCE;
		}
		s->jobs = more;
		s->cap = cap;
	}
	memmove(s->jobs + at + 1, s->jobs + at, (size_t)(s->n - at) * sizeof *s->jobs);
	s->jobs[at] = copy;
	s->n++;
	return ST_OK;
}

void job_shelf_finish(struct job_shelf *s)
{
	for (int i = 0; i < s->n; i++)
		stats_finish(&s->jobs[i]);
	free(s->jobs);
	*s = (struct job_shelf){ 0 };
}
