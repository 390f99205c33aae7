/* refine.c - refinement of curves and surfaces: each direction as a strip. */
#include "refine.h"

#include <stdlib.h>
#include <string.h>

#include "strip.h"

typedef enum status strip_change(struct strip *out, const struct strip *in, const void *how);

struct values {
	const double *x;
	int m;
};

static enum status change_insert(struct strip *out, const struct strip *in, const void *how)
{
	const struct values *v = how;
	return strip_insert(out, in, v->x, v->m);
}

static enum status change_part(struct strip *out, const struct strip *in, const void *how)
{
	const double *range = how;
	return strip_part(out, in, range[0], range[1]);
}

static enum status change_elevate(struct strip *out, const struct strip *in, const void *how)
{
	if (strip_clamped(in))
		return strip_elevate(out, in, *(const int *)how);
	struct strip clamped;
	enum status st = strip_part(&clamped, in, in->knots[in->order - 1], in->knots[in->n]);
	if (st != ST_OK)
		return st;
	st = strip_elevate(out, &clamped, *(const int *)how);
	strip_finish(&clamped);
	return st;
}

static enum status curve_change(struct curve *out, const struct curve *c, strip_change *change,
                                const void *how)
{
	struct strip in = { c->order, c->n, 4, c->knots, c->points }, made;
	enum status st = change(&made, &in, how);
	if (st != ST_OK)
		return st;
	*out = *c;
	out->order = made.order;
	out->n = made.n;
	out->knots = made.knots;
	out->points = made.points;
	return ST_OK;
}

static void transpose(double *out, const double *in, int rows, int columns)
{
	for (int i = 0; i < rows; i++)
		for (int j = 0; j < columns; j++)
			memcpy(out + 4 * ((size_t)j * rows + i), in + 4 * ((size_t)i * columns + j),
			       4 * sizeof *out);
}

static enum status surface_change(struct surface *out, const struct surface *s, int d,
                                  strip_change *change, const void *how)
{
	int e = 1 - d; /* the direction that stays */
	size_t dim = 4 * (size_t)s->n[e], other_knots = (size_t)s->n[e] + (size_t)s->order[e];
	struct strip in = { s->order[d], s->n[d], dim, s->knots[d], s->points }, made = { 0 };
	double *turned = NULL, *back = NULL;
	double *other = malloc(other_knots * sizeof *other);
	enum status st = other ? ST_OK : ST_RESOURCE;
	if (st == ST_OK && d == 1) {
		turned = malloc((size_t)s->n[1] * dim * sizeof *turned);
		if (!turned) {
			st = ST_RESOURCE;
		} else {
			transpose(turned, s->points, s->n[0], s->n[1]);
			in.points = turned;
		}
	}
	if (st == ST_OK)
		st = change(&made, &in, how);
	if (st == ST_OK && d == 1) {
		back = malloc((size_t)made.n * dim * sizeof *back);
		if (!back) {
			st = ST_RESOURCE;
		} else {
			transpose(back, made.points, made.n, s->n[0]);
			free(made.points);
			made.points = back;
		}
	}
	free(turned);
	if (st != ST_OK) {
		strip_finish(&made);
		free(other);
		return st;
	}
	memcpy(other, s->knots[e], other_knots * sizeof *other);
	*out = *s;
	out->order[d] = made.order;
	out->n[d] = made.n;
	out->knots[d] = made.knots;
	out->knots[e] = other;
	out->points = made.points;
	return ST_OK;
}

enum status curve_insert(struct curve *out, const struct curve *c, const double *x, int m)
{
	return curve_change(out, c, change_insert, &(struct values){ x, m });
}

enum status surface_insert(struct surface *out, const struct surface *s, int d, const double *x,
                           int m)
{
	return surface_change(out, s, d, change_insert, &(struct values){ x, m });
}

enum status curve_part(struct curve *out, const struct curve *c, double a, double b)
{
	enum status st = curve_change(out, c, change_part, (double[2]){ a, b });
	if (st != ST_OK)
		return st;
	out->periodic = c->periodic && a == c->domain[0] && b == c->domain[1];
	out->domain[0] = a;
	out->domain[1] = b;
	return ST_OK;
}

enum status surface_part(struct surface *out, const struct surface *s, const double (*range)[2])
{
	struct surface half;
	enum status st = surface_change(&half, s, 0, change_part, range[0]);
	if (st != ST_OK)
		return st;
	st = surface_change(out, &half, 1, change_part, range[1]);
	surface_finish(&half);
	if (st != ST_OK)
		return st;
	for (int d = 0; d < 2; d++) {
		out->periodic[d] = s->periodic[d] && range[d][0] == s->domain[d][0] &&
		                   range[d][1] == s->domain[d][1];
		out->domain[d][0] = range[d][0];
		out->domain[d][1] = range[d][1];
	}
	return ST_OK;
}

enum status curve_elevate(struct curve *out, const struct curve *c, int t)
{
	return curve_change(out, c, change_elevate, &t);
}

enum status surface_elevate(struct surface *out, const struct surface *s, int d, int t)
{
	return surface_change(out, s, d, change_elevate, &t);
}

enum status surface_exchange(struct surface *s)
{
	double *points = malloc((size_t)s->n[0] * (size_t)s->n[1] * 4 * sizeof *points);
	if (!points)
		return ST_RESOURCE;
	transpose(points, s->points, s->n[0], s->n[1]);
	free(s->points);
	struct surface old = *s;
	s->points = points;
	for (int d = 0; d < 2; d++) {
		s->order[d] = old.order[1 - d];
		s->n[d] = old.n[1 - d];
		s->periodic[d] = old.periodic[1 - d];
		s->knots[d] = old.knots[1 - d];
		memcpy(s->domain[d], old.domain[1 - d], sizeof s->domain[d]);
	}
	return ST_OK;
}

enum status surface_isoparametric(struct curve *out, const struct surface *s, int d, double t)
{
	int e = 1 - d, p = s->order[d] - 1;
	if (!(t >= s->knots[d][p] && t <= s->knots[d][s->n[d]]))
		return ST_PARAMETER;
	enum status st = curve_init(out, s->order[e], s->n[e]);
	if (st != ST_OK)
		return st;
	double basis[ORDER_MAX];
	int span = knots_span(s->order[d], s->n[d], s->knots[d], t);
	knots_basis(s->order[d], s->knots[d], span, t, 0, basis);
	for (int i = 0; i < s->n[e]; i++) {
		for (int j = 0; j <= p; j++) {
			int at[2];
			at[d] = span - p + j;
			at[e] = i;
			const double *q = s->points + 4 * ((size_t)at[0] * s->n[1] + at[1]);
			for (int k = 0; k < 4; k++)
				out->points[4 * i + k] += basis[j] * q[k];
		}
	}
	memcpy(out->knots, s->knots[e],
	       ((size_t)s->n[e] + (size_t)s->order[e]) * sizeof *out->knots);
	memcpy(out->domain, s->domain[e], sizeof out->domain);
	out->rational = s->rational;
	out->periodic = s->periodic[e];
	return ST_OK;
}
