/* refine_match.c - two curves brought to one order and one knot vector. */
#include <stdlib.h>
#include <string.h>

#include "refine.h"

/* Knots of two sources that are equal up to the rounding of a linear map; part of the domain. */
static const double same_knot = 1e-13;

static enum status replace(struct curve *c, enum status st, struct curve *next)
{
	if (st != ST_OK)
		return st;
	curve_finish(c);
	*c = *next;
	return ST_OK;
}

/* Clamped on its domain, of the given order, parameters [a, b]. */
static enum status prepare(struct curve *out, const struct curve *c, int order, double a, double b)
{
	struct curve next;
	enum status st = curve_part(out, c, c->domain[0], c->domain[1]);
	if (st != ST_OK)
		return st;
	st = replace(out, curve_elevate(&next, out, order - c->order), &next);
	if (st != ST_OK) {
		curve_finish(out);
		return st;
	}
	if (a != out->domain[0] || b != out->domain[1])
		curve_reparametrise(out, a, b);
	return ST_OK;
}

/* Set the knots of b that a has, up to rounding, to a's value. */
static void snap_knots(struct curve *b, const struct curve *a)
{
	double near = same_knot * (a->domain[1] - a->domain[0]);
	int m = a->n + a->order;
	for (int i = 0, j = 0; i < b->n + b->order; i++) {
		double t = b->knots[i];
		while (j + 1 < m && fabs(a->knots[j + 1] - t) <= fabs(a->knots[j] - t))
			j++;
		if (fabs(a->knots[j] - t) <= near)
			b->knots[i] = a->knots[j];
	}
}

/* Interior knots that b has more often than a; out holds as many as b has knots. */
static int knots_lacking(const struct curve *a, const struct curve *b, double *out)
{
	int m = 0, i = a->order, end = b->n;
	for (int j = b->order; j < end; j++) {
		while (i < a->n && a->knots[i] < b->knots[j])
			i++;
		if (i < a->n && a->knots[i] == b->knots[j])
			i++;
		else
			out[m++] = b->knots[j];
	}
	return m;
}

enum status curves_match(struct curve *out_a, struct curve *out_b, const struct curve *a,
                         const struct curve *b)
{
	int order = a->order > b->order ? a->order : b->order;
	struct curve x, y, next;
	enum status st = prepare(&x, a, order, a->domain[0], a->domain[1]);
	if (st != ST_OK)
		return st;
	st = prepare(&y, b, order, a->domain[0], a->domain[1]);
	if (st != ST_OK) {
		curve_finish(&x);
		return st;
	}
	snap_knots(&y, &x);

	double *missing_x = malloc(((size_t)x.n + (size_t)y.n) * sizeof *missing_x);
	if (missing_x) {
		double *missing_y = missing_x + y.n;
		int mx = knots_lacking(&x, &y, missing_x);
		int my = knots_lacking(&y, &x, missing_y);
		st = replace(&x, curve_insert(&next, &x, missing_x, mx), &next);
		if (st == ST_OK)
			st = replace(&y, curve_insert(&next, &y, missing_y, my), &next);
	} else {
		st = ST_RESOURCE;
	}
	free(missing_x);
	if (st != ST_OK) {
		curve_finish(&x);
		curve_finish(&y);
		return st;
	}
	*out_a = x;
	*out_b = y;
	return ST_OK;
}
