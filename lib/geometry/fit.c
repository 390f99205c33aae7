/* fit.c - interpolation: parameters, averaged knots, banded collocation.
 *
 * LAPACK's dgbtrf and dgbtrs, measured: 1.6 ms for a grid of 100 x 100 points and 2.1 ms for a curve
 * through 10,000, two thirds of it in calls on three numbers each. These matrices need no pivots. */
#include "fit.h"

#include <stdlib.h>
#include <string.h>

#include "banded.h"
#include "basis_inline.h"

/* One direction: where the points lie and the factored collocation matrix. */
struct collocation {
	int order, n;
	double *t;     /* parameters, owned */
	double *knots; /* n + order, owned */
	double *band;  /* n rows of 2 order - 1, owned */
};

static void collocation_finish(struct collocation *c)
{
	free(c->t);
	free(c->knots);
	free(c->band);
}

/* Room, with parameters still zero. Below and above the diagonal stand order - 1 entries at most. */
static enum status collocation_init(struct collocation *c, int order, int n)
{
	*c = (struct collocation){ .order = order, .n = n };
	c->t = calloc((size_t)n, sizeof *c->t);
	c->knots = calloc((size_t)n + (size_t)order, sizeof *c->knots);
	c->band = calloc((size_t)n, (2 * (size_t)order - 1) * sizeof *c->band);
	if (c->t && c->knots && c->band)
		return ST_OK;
	collocation_finish(c);
	return ST_RESOURCE;
}

/* Step for points this far apart. */
static double parameter_step(double distance, enum fit_parameters how)
{
	switch (how) {
	case FIT_UNIFORM:
		return 1;
	case FIT_CHORD:
		return distance;
	default:
		return sqrt(distance);
	}
}

/* With step i in t[i], i >= 1: sums over the whole, from 0 to 1. */
static void accumulate(double *t, int n)
{
	t[0] = 0;
	for (int i = 1; i < n; i++)
		t[i] += t[i - 1];
	for (int i = 1; i < n - 1; i++)
		t[i] /= t[n - 1];
	t[n - 1] = 1;
}

/* Rows of the matrix; the order is a constant where it is a common one. */
BATTEN_INLINE void collocation_fill(struct collocation *c, const int order)
{
	const int width = order - 1;
	double *row = c->band + width;
	/* the ends are interpolated: theirs stay to the bit, so that neighbours can share them */
	row[0] = 1;
	for (int i = 1, span = width; i < c->n - 1; i++) {
		double basis[ORDER_MAX];
		while (span < c->n - 1 && c->knots[span + 1] <= c->t[i])
			span++;
		basis_inline(order, c->knots, span, c->t[i], basis, NULL, NULL);
		row += 2 * width + 1;
		for (int k = 0; k < order; k++) {
			const int column = span - width + k - i;
			/* outside the band only where the value is zero: at knots and at the ends */
			if (abs(column) <= width)
				row[column] = basis[k];
		}
	}
	row[2 * width + 1] = 1;
}

/* With parameters set: knots by averaging, and the factors. Source: The NURBS Book, (9.8). */
static enum status collocation_factor(struct collocation *c)
{
	int p = c->order - 1;
	for (int i = 0; i < c->order; i++)
		c->knots[c->n + i] = 1;
	for (int j = 1; j < c->n - p; j++) {
		for (int i = j; i < j + p; i++)
			c->knots[j + p] += c->t[i];
		c->knots[j + p] /= p;
	}
	if (c->order == 4)
		collocation_fill(c, 4);
	else
		collocation_fill(c, c->order);
	return banded_factor(c->band, c->n, p) ? ST_OK : ST_INPUT;
}

/* Values at the parameters become control points: x holds n rows of `columns`. */
static void collocation_solve(const struct collocation *c, double *x, size_t columns)
{
	banded_solve(c->band, c->n, c->order - 1, x, columns);
}

static enum status check_order(int order, int n, const char *what, const struct report *r)
{
	if (order < ORDER_MIN || order > ORDER_MAX)
		return report_error(r, ST_PARAMETER, "order %d, expected %d to %d", order,
		                    ORDER_MIN, ORDER_MAX);
	if (n < order)
		return report_error(r, ST_INPUT, "%d %s, expected at least the order, %d", n, what,
		                    order);
	return ST_OK;
}

static enum status singular(const struct report *r)
{
	return report_error(r, ST_INPUT, "the points' parameters are too uneven to interpolate");
}

enum status fit_curve(struct curve *out, const struct vec3 *p, int n, int order,
                      enum fit_parameters how, const struct report *r)
{
	enum status st = check_order(order, n, "points", r);
	if (st != ST_OK)
		return st;
	struct collocation c;
	st = collocation_init(&c, order, n);
	if (st != ST_OK)
		return st;
	for (int i = 1; i < n && st == ST_OK; i++) {
		double d = vec3_length(vec3_sub(p[i], p[i - 1]));
		if (!(d > 0) || !isfinite(d))
			st = report_error(r, ST_INPUT,
			                  "points %d and %d coincide or are not finite", i, i + 1);
		c.t[i] = parameter_step(d, how);
	}
	if (st == ST_OK) {
		accumulate(c.t, n);
		st = collocation_factor(&c);
		if (st == ST_INPUT)
			singular(r);
	}
	if (st == ST_OK)
		st = curve_init(out, order, n);
	if (st == ST_OK) {
		for (int i = 0; i < n; i++)
			curve_set_point(out, i, p[i], 1);
		collocation_solve(&c, out->points, 4);
		for (int i = 0; i < n; i++)
			out->points[4 * i + 3] = 1;
		memcpy(out->knots, c.knots, (size_t)(n + order) * sizeof *c.knots);
		out->domain[1] = 1;
	}
	collocation_finish(&c);
	return st;
}

static struct vec3 net_point(const double *q)
{
	return q[3] == 1 ? vec3(q[0], q[1], q[2]) : vec3(q[0] / q[3], q[1] / q[3], q[2] / q[3]);
}

/*
 * Mean parameters over the lines of a net: point i of line j is at p + 4 (i a + j b), homogeneous.
 * Lines that are one point (a pole) have no say.
 */
static enum status net_parameters(double *t, const double *p, int n, size_t a, int lines, size_t b,
                                  enum fit_parameters how, const struct report *r)
{
	double *line = malloc((size_t)n * sizeof *line);
	if (!line)
		return ST_RESOURCE;
	enum status st = ST_OK;
	for (int j = 0; j < lines; j++) {
		double sum = 0;
		struct vec3 last = net_point(p + 4 * (size_t)j * b);
		for (int i = 1; i < n; i++) {
			struct vec3 next = net_point(p + 4 * ((size_t)i * a + (size_t)j * b));
			line[i] = parameter_step(vec3_length(vec3_sub(next, last)), how);
			sum += line[i];
			last = next;
		}
		if (!isfinite(sum))
			st = ST_INPUT;
		for (int i = 1; i < n && sum > 0; i++)
			t[i] += line[i] / sum;
	}
	free(line);
	for (int i = 1; i < n; i++)
		if (st == ST_INPUT || !(t[i] > 0))
			return report_error(r, ST_INPUT,
			                    "rows %d and %d of points coincide or are not finite",
			                    i, i + 1);
	accumulate(t, n);
	return st;
}

/* Replace the points of direction d (homogeneous, u outer) by control points of c. */
static void net_solve(const struct collocation *c, double *p, const int n[2], int d)
{
	const size_t row = (size_t)4 * n[1];
	if (d == 0)
		collocation_solve(c, p, row);
	else
		for (int i = 0; i < n[0]; i++)
			collocation_solve(c, p + i * row, 4);
}

static void set_knots(struct surface *s, int d, const double *knots, double a, double b)
{
	memcpy(s->knots[d], knots, (size_t)(s->n[d] + s->order[d]) * sizeof *knots);
	s->domain[d][0] = a;
	s->domain[d][1] = b;
}

/* Parameters and factors for direction d of the points of s. */
static enum status net_collocation(struct collocation *c, const struct surface *s, int d,
                                   enum fit_parameters how, const struct report *r)
{
	size_t nv = (size_t)s->n[1];
	enum status st = collocation_init(c, s->order[d], s->n[d]);
	if (st != ST_OK)
		return st;
	st = net_parameters(c->t, s->points, s->n[d], d == 0 ? nv : 1, s->n[1 - d], d == 0 ? 1 : nv,
	                    how, r);
	if (st == ST_OK) {
		st = collocation_factor(c);
		if (st == ST_INPUT)
			singular(r);
	}
	return st;
}

static void set_weights(struct surface *s)
{
	for (size_t i = 0; i < (size_t)s->n[0] * (size_t)s->n[1]; i++)
		s->points[4 * i + 3] = 1;
}

enum status fit_surface(struct surface *out, const struct vec3 *p, int nu, int nv,
                        const int order[2], enum fit_parameters how, const struct report *r)
{
	const int n[2] = { nu, nv };
	enum status st = check_order(order[0], nu, "points in u", r);
	if (st == ST_OK)
		st = check_order(order[1], nv, "points in v", r);
	if (st != ST_OK)
		return st;
	struct surface s;
	st = surface_init(&s, order, n);
	if (st != ST_OK)
		return st;
	for (int i = 0; i < nu; i++)
		for (int j = 0; j < nv; j++)
			surface_set_point(&s, i, j, p[(size_t)i * nv + j], 1);
	/* both before the first solution: parameters come from points, not from control points */
	struct collocation c[2] = { { 0 }, { 0 } };
	for (int d = 0; d < 2 && st == ST_OK; d++)
		st = net_collocation(&c[d], &s, d, how, r);
	for (int d = 0; d < 2 && st == ST_OK; d++) {
		net_solve(&c[d], s.points, n, d);
		set_knots(&s, d, c[d].knots, 0, 1);
	}
	collocation_finish(&c[0]);
	collocation_finish(&c[1]);
	if (st != ST_OK) {
		surface_finish(&s);
		return st;
	}
	set_weights(&s);
	*out = s;
	return ST_OK;
}

enum status fit_loft(struct surface *out, const struct curve *sections, int n, int order_v,
                     enum fit_parameters how, const struct report *r)
{
	enum status st = check_order(order_v, n, "sections", r);
	if (st != ST_OK)
		return st;
	const struct curve *first = &sections[0];
	bool rational = false;
	size_t n_knots = (size_t)first->n + (size_t)first->order;
	for (int i = 0; i < n; i++) {
		const struct curve *c = &sections[i];
		rational |= c->rational;
		if (c->order != first->order || c->n != first->n ||
		    memcmp(c->knots, first->knots, n_knots * sizeof *c->knots) != 0)
			return report_error(r, ST_PARAMETER,
			                    "section %d has not the order and knots of section 1",
			                    i + 1);
	}
	struct surface s;
	st = surface_init(&s, (int[2]){ first->order, order_v }, (int[2]){ first->n, n });
	if (st != ST_OK)
		return st;
	for (int i = 0; i < first->n; i++)
		for (int j = 0; j < n; j++)
			memcpy(s.points + 4 * ((size_t)i * n + j), sections[j].points + 4 * i,
			       4 * sizeof *s.points);
	set_knots(&s, 0, first->knots, first->domain[0], first->domain[1]);
	s.rational = rational;
	struct collocation c = { 0 };
	st = net_collocation(&c, &s, 1, how, r);
	if (st == ST_OK) {
		net_solve(&c, s.points, s.n, 1);
		set_knots(&s, 1, c.knots, 0, 1);
	}
	collocation_finish(&c);
	if (!rational)
		set_weights(&s);
	for (size_t i = 0; i < (size_t)s.n[0] * (size_t)n && st == ST_OK; i++)
		if (!(s.points[4 * i + 3] > 0))
			st = report_error(r, ST_INPUT,
			                  "the sections' weights change too fast to be lofted");
	if (st != ST_OK) {
		surface_finish(&s);
		return st;
	}
	*out = s;
	return ST_OK;
}
