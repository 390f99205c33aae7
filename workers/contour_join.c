/* contour_join.c - ends that meet, nearest first; then the chains that they make. */
#include "contour_join.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

static const size_t none = SIZE_MAX;

/* End k is the start (even) or the end (odd) of piece k / 2. */
struct end {
	struct vec3 p;
	size_t k;
};

struct meeting {
	double distance;
	size_t a, b; /* a < b */
};

struct meetings {
	struct meeting *list; /* owned */
	size_t n, cap;
};

void contours_finish(struct contours *c)
{
	free(c->sides);
	free(c->pieces);
	free(c->list);
	*c = (struct contours){ .n = 0 };
}

static int by_x(const void *pa, const void *pb)
{
	const struct end *a = pa, *b = pb;
	if (a->p.x != b->p.x)
		return a->p.x < b->p.x ? -1 : 1;
	return a->k < b->k ? -1 : 1;
}

static int by_distance(const void *pa, const void *pb)
{
	const struct meeting *a = pa, *b = pb;
	if (a->distance != b->distance)
		return a->distance < b->distance ? -1 : 1;
	if (a->a != b->a)
		return a->a < b->a ? -1 : 1;
	return a->b < b->b ? -1 : a->b > b->b;
}

static enum status meeting_add(struct meetings *m, struct meeting one)
{
	if (m->n == m->cap) {
		size_t cap = m->cap ? 2 * m->cap : 16;
		struct meeting *more = realloc(m->list, sizeof *more * cap);
		if (!more)
			return ST_RESOURCE;
		m->list = more;
		m->cap = cap;
	}
	m->list[m->n++] = one;
	return ST_OK;
}

/* All pairs of ends within the gap, nearest first. */
static enum status meetings_find(struct meetings *m, struct end *ends, size_t n,
                                 const struct curve *const *pieces, double gap)
{
	qsort(ends, n, sizeof *ends, by_x);
	for (size_t i = 0; i < n; i++)
		for (size_t j = i + 1; j < n && ends[j].p.x - ends[i].p.x <= gap; j++) {
			const size_t a = ends[i].k, b = ends[j].k;
			const double d = vec3_length(vec3_sub(ends[i].p, ends[j].p));
			const struct curve *c = pieces[a / 2];
			if (d > gap)
				continue;
			if (a / 2 == b / 2 &&
			    !(curve_length(c, c->domain[0], c->domain[1], 1e-2) > 4 * gap))
				continue;
			enum status st =
			        meeting_add(m, (struct meeting){ d, a < b ? a : b, a < b ? b : a });
			if (st != ST_OK)
				return st;
		}
	if (m->n > 0)
		qsort(m->list, m->n, sizeof *m->list, by_distance);
	return ST_OK;
}

/* Run from end k through its piece and on, until there is no further one. */
static void chain_walk(struct contours *c, const struct curve *const *pieces, const size_t *partner,
                       bool *done, size_t *at, size_t k)
{
	struct contour *one = &c->list[c->n++];
	*one = (struct contour){ .first = *at };
	for (; k != none && !done[k / 2]; k = partner[k ^ 1]) {
		done[k / 2] = true;
		c->pieces[*at] = k / 2;
		c->sides[(*at)++] = (struct section_side){ pieces[k / 2], k & 1 };
	}
	one->n = *at - one->first;
	one->closed = k != none;
	c->n_closed += one->closed;
}

static void chains_make(struct contours *c, const struct curve *const *pieces, const bool *closed,
                        size_t *partner, bool *done, size_t n)
{
	size_t at = 0;
	for (size_t i = 0; i < n; i++)
		if (closed[i])
			for (size_t e = 0; e < 2; e++)
				partner[2 * i + e] = 2 * i + 1 - e;
	/* those with ends first, from the end whose piece comes first */
	for (size_t k = 0; k < 2 * n; k++)
		if (partner[k] == none && !done[k / 2])
			chain_walk(c, pieces, partner, done, &at, k);
	for (size_t i = 0; i < n; i++)
		if (!done[i])
			chain_walk(c, pieces, partner, done, &at, 2 * i);
}

enum status contours_join(struct contours *out, const struct curve *const *pieces,
                          const bool *closed, size_t n, double gap)
{
	struct meetings m = { 0 };
	struct end *ends = malloc(sizeof *ends * 2 * (n + 1));
	size_t *partner = malloc(sizeof *partner * 2 * (n + 1)), n_ends = 0;
	bool *done = calloc(n + 1, sizeof *done);
	enum status st = ST_RESOURCE;
	*out = (struct contours){ .n = 0 };
	out->sides = malloc(sizeof *out->sides * (n + 1));
	out->pieces = malloc(sizeof *out->pieces * (n + 1));
	out->list = malloc(sizeof *out->list * (n + 1));
	if (!ends || !partner || !done || !out->sides || !out->pieces || !out->list)
		goto out;
	for (size_t k = 0; k < 2 * n; k++) {
		const struct curve *c = pieces[k / 2];
		partner[k] = none;
		if (!closed[k / 2])
			ends[n_ends++] = (struct end){ curve_point(c, c->domain[k & 1]), k };
	}
	st = meetings_find(&m, ends, n_ends, pieces, gap);
	if (st != ST_OK)
		goto out;
	for (size_t i = 0; i < m.n; i++) {
		const size_t a = m.list[i].a, b = m.list[i].b;
		if (partner[a] == none && partner[b] == none) {
			partner[a] = b;
			partner[b] = a;
		}
	}
	chains_make(out, pieces, closed, partner, done, n);
out:
	free(m.list);
	free(ends);
	free(partner);
	free(done);
	if (st != ST_OK)
		contours_finish(out);
	return st;
}
