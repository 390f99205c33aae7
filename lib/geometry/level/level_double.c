/* level_double.c - a curve along a border that two faces share is found on both, and one through the
 * corner of a third is a point there: keep one. */
#include "level_border.h"
#include "level_part.h"

#include <stdlib.h>
#include <string.h>

/* Shorter ones, in tolerances, are points: where a curve goes through a corner of a face. */
#define SPECK_SHARE 0.5

/* A branch that runs along a border all the way. */
struct runner {
	int face;
	size_t branch;
	struct level_span *spans; /* owned */
	size_t n;
	struct box box;
	bool gone; /* dropped, or parts of it are in its place; what it covers stays covered */
};

struct runners {
	struct list list; /* of struct runner, faces rising */
	double reach;     /* how near two must be to be one */
};

static struct vec3 span_point(const struct level_span *s, double x, struct vec3 *slope)
{
	const double y = 1 - x;
	double p[3], d[3];
	for (int k = 0; k < 3; k++) {
		const double a = s->space[0][k], b = s->space[1][k], c = s->space[2][k],
		             e = s->space[3][k];
		p[k] = y * y * (y * a + 3 * x * b) + x * x * (3 * y * c + x * e);
		d[k] = 3 * (y * y * (b - a) + 2 * x * y * (c - b) + x * x * (e - c));
	}
	*slope = vec3_of(d);
	return vec3_of(p);
}

/* A point of the span nearest to p, about; *x its place in [0, 1]. */
static double span_distance(const struct level_span *s, struct vec3 p, double *x)
{
	enum { STARTS = 4, STEPS = 10 };
	double best = INFINITY, at = 0;
	struct vec3 slope;
	for (int i = 0; i <= STARTS; i++) {
		const double d =
		        vec3_length(vec3_sub(span_point(s, (double)i / STARTS, &slope), p));
		if (d < best) {
			best = d;
			at = (double)i / STARTS;
		}
	}
	for (int i = 0; i < STEPS; i++) {
		const struct vec3 off = vec3_sub(span_point(s, at, &slope), p);
		const double m = vec3_dot(slope, slope);
		best = smaller(best, vec3_length(off));
		if (!(m > 0))
			break;
		at = smaller(larger(at - vec3_dot(off, slope) / m, 0), 1);
	}
	*x = at;
	return smaller(best, vec3_length(vec3_sub(span_point(s, at, &slope), p)));
}

/* The runner's parameter nearest to p, if within reach. */
static bool runner_find(const struct runner *r, struct vec3 p, double reach, double *t)
{
	double best = INFINITY;
	if (p.x < r->box.lo.x - reach || p.x > r->box.hi.x + reach || p.y < r->box.lo.y - reach ||
	    p.y > r->box.hi.y + reach || p.z < r->box.lo.z - reach || p.z > r->box.hi.z + reach)
		return false;
	for (size_t i = 0; i < r->n; i++) {
		const struct level_span *s = &r->spans[i];
		double x;
		const double size =
		        vec3_length(vec3_sub(vec3_of(s->space[3]), vec3_of(s->space[0]))) +
		        vec3_length(vec3_sub(vec3_of(s->space[1]), vec3_of(s->space[0]))) +
		        vec3_length(vec3_sub(vec3_of(s->space[2]), vec3_of(s->space[0])));
		if (vec3_length(vec3_sub(vec3_of(s->space[0]), p)) > size + reach)
			continue;
		const double d = span_distance(s, p, &x);
		if (d < best) {
			best = d;
			*t = s->t[0] + x * (s->t[1] - s->t[0]);
		}
	}
	return best <= reach;
}

/* Is p on the face's own border; on another face's, too? */
static bool at_border(const struct level_faces *f, int face, struct vec3 p, double reach,
                      bool *shared)
{
	enum { FEET = 12 };
	struct border_foot feet[FEET];
	const int n = border_feet(f, p, larger(reach, f->gap), feet, FEET);
	bool own = false;
	for (int i = 0; i < n; i++) {
		if (feet[i].face == face)
			own |= feet[i].distance <= reach;
		else
			*shared = true;
	}
	return own;
}

static enum status runner_add(struct runners *r, const struct level_faces *f, int face,
                              const struct level_branch *b, size_t branch, double reach)
{
	enum { SAMPLES = 3 };
	bool shared = false;
	const double middle = 0.5 * (b->space.domain[0] + b->space.domain[1]);
	if (!at_border(f, face, curve_point(&b->space, middle), reach, &shared) || !shared)
		return ST_OK;
	struct runner x = { .face = face, .branch = branch, .box = box_empty() };
	enum status st = level_spans(b, &x.spans, &x.n);
	bool along = st == ST_OK;
	for (size_t i = 0; along && i < x.n; i++)
		for (int k = 0; along && k <= SAMPLES; k++) {
			struct vec3 slope;
			along = at_border(f, face,
			                  span_point(&x.spans[i], (double)k / SAMPLES, &slope),
			                  reach, &shared);
		}
	for (size_t i = 0; along && i < x.n; i++)
		for (int k = 0; k < 4; k++)
			box_add_point(&x.box, vec3_of(x.spans[i].space[k]));
	struct runner *to = along ? list_add(&r->list, sizeof *to) : NULL;
	if (to)
		*to = x;
	else
		free(x.spans);
	return st == ST_OK && along && !to ? ST_RESOURCE : st;
}

static int by_value(const void *a, const void *b)
{
	const double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

static bool covered(const struct runners *r, size_t i, double a, double b)
{
	const struct runner *all = r->list.p, *x = &all[i];
	for (int k = 1; k < 4; k++) {
		const double t = a + 0.25 * k * (b - a);
		bool found = false;
		for (size_t s = 0; s < x->n && !found; s++) {
			struct vec3 slope;
			double at;
			if (t < x->spans[s].t[0] || t > x->spans[s].t[1])
				continue;
			const struct vec3 p = span_point(
			        &x->spans[s],
			        (t - x->spans[s].t[0]) / (x->spans[s].t[1] - x->spans[s].t[0]),
			        &slope);
			for (size_t o = 0; o < i && !found; o++)
				found = runner_find(&all[o], p, r->reach, &at);
		}
		if (!found)
			return false;
	}
	return true;
}

/* What of runner i no earlier one covers, put behind `kept`; false: all of it, nothing is put. */
static enum status runner_cut(const struct runners *r, size_t i, const struct level_branch *b,
                              const struct surface *s, struct list *kept, bool *whole)
{
	const struct runner *all = r->list.p, *x = &all[i];
	const double end = b->space.domain[1];
	double *at = malloc(sizeof *at * (2 * i + 2));
	size_t n = 0;
	enum status st = ST_OK;
	if (!at)
		return ST_RESOURCE;
	at[n++] = 0;
	for (size_t o = 0; o < i; o++)
		for (int e = 0; e < 2; e++) {
			const struct level_span *last = &all[o].spans[e ? all[o].n - 1 : 0];
			if (runner_find(x, vec3_of(last->space[e ? 3 : 0]), r->reach, &at[n]))
				n++;
		}
	at[n++] = end;
	qsort(at, n, sizeof *at, by_value);
	*whole = true;
	bool *over = calloc(n, sizeof *over);
	st = over ? ST_OK : ST_RESOURCE;
	for (size_t k = 0; st == ST_OK && k + 1 < n; k++) {
		over[k] = at[k + 1] - at[k] <= r->reach || covered(r, i, at[k], at[k + 1]);
		*whole &= !over[k] || at[k + 1] - at[k] <= r->reach;
	}
	for (size_t k = 0; st == ST_OK && !*whole && k + 1 < n; k++) {
		size_t last = k;
		if (over[k])
			continue;
		while (last + 2 < n && !over[last + 1])
			last++;
		struct level_branch *part = list_add(kept, sizeof *part);
		st = part ? level_branch_part(part, b, s, at[k], at[last + 1]) : ST_RESOURCE;
		if (st != ST_OK && part)
			kept->n--;
		k = last;
	}
	free(over);
	free(at);
	return st;
}

static void branch_finish(struct level_branch *b)
{
	curve_finish(&b->uv);
	curve_finish(&b->space);
	*b = (struct level_branch){ .length = 0 };
}

/* Runner i becomes its parts, which go behind the result's branches. */
static enum status runner_thin(struct runners *r, size_t i, const struct level_faces *f,
                               struct level_result *x)
{
	struct runner *one = (struct runner *)r->list.p + i;
	struct list kept = { 0 };
	bool whole = true;
	enum status st = runner_cut(r, i, &x->branches[one->branch], f->faces[one->face].surface,
	                            &kept, &whole);
	if (st == ST_OK && !whole) {
		struct level_branch *more =
		        realloc(x->branches, sizeof *more * (x->n_branches + kept.n));
		st = more ? ST_OK : ST_RESOURCE;
		if (more) {
			x->branches = more;
			branch_finish(&more[one->branch]);
			if (kept.n > 0)
				memcpy(more + x->n_branches, kept.p, sizeof *more * kept.n);
			x->n_branches += kept.n;
			kept.n = 0;
			one->gone = true;
		}
	}
	for (size_t k = 0; k < kept.n; k++)
		branch_finish((struct level_branch *)kept.p + k);
	free(kept.p);
	return st;
}

/* Close the gaps that dropped branches left. */
static enum status result_close(struct level_result *x)
{
	struct list kept = { 0 };
	for (size_t i = 0; i < x->n_branches; i++) {
		if (x->branches[i].uv.n == 0)
			continue;
		struct level_branch *b = list_add(&kept, sizeof *b);
		if (!b) {
			free(kept.p);
			return ST_RESOURCE;
		}
		*b = x->branches[i];
	}
	level_result_replace(x, &kept);
	return ST_OK;
}

/* Both its ends lie on borders that other faces share, and nothing is between them. */
static bool is_speck(const struct level_faces *f, int face, const struct level_branch *b,
                     double tolerance)
{
	if (b->closed || b->length > SPECK_SHARE * tolerance)
		return false;
	for (int e = 0; e < 2; e++) {
		bool shared = false;
		const struct vec3 p = curve_point(&b->space, b->space.domain[e]);
		if (!at_border(f, face, p, f->gap, &shared) || !shared)
			return false;
	}
	return true;
}

enum status level_specks_drop(const struct level_faces *f, double tolerance,
                              struct level_result *results)
{
	enum status st = ST_OK;
	for (int i = 0; st == ST_OK && i < f->n; i++) {
		bool any = false;
		for (size_t b = 0; b < results[i].n_branches; b++)
			if (is_speck(f, i, &results[i].branches[b], tolerance)) {
				branch_finish(&results[i].branches[b]);
				any = true;
			}
		if (any)
			st = result_close(&results[i]);
	}
	return st;
}

enum status level_doubles_drop(const struct level_faces *f, double tolerance,
                               struct level_result *results)
{
	struct runners r = { .reach = f->gap + 4 * tolerance };
	enum status st = ST_OK;
	for (int i = 0; i < f->n; i++)
		for (size_t b = 0; st == ST_OK && b < results[i].n_branches; b++)
			st = runner_add(&r, f, i, &results[i].branches[b], b,
			                4 * tolerance + 1e-9 * surface_size(f->faces[i].surface));
	struct runner *all = r.list.p;
	for (size_t i = 0; st == ST_OK && i < r.list.n; i++)
		st = runner_thin(&r, i, f, &results[all[i].face]);
	for (size_t i = 0; i < r.list.n; i++) {
		const int face = all[i].face;
		if (st == ST_OK && all[i].gone && (i + 1 == r.list.n || all[i + 1].face != face))
			st = result_close(&results[face]);
		else if (st == ST_OK && all[i].gone)
			all[i + 1].gone = true; /* the face's last runner closes for all of them */
		free(all[i].spans);
	}
	free(r.list.p);
	return st;
}
