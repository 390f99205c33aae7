/* refine_move.c - changes in place that keep the number of points: parameters, direction, place. */
#include <string.h>

#include "refine.h"

/* Linear map of [from[0], from[1]] on [a, b], its ends exact and order kept under rounding. */
static void map_knots(double *t, int m, double domain[2], double a, double b)
{
	double lo = domain[0], hi = domain[1], slope = (b - a) / (hi - lo);
	for (int i = 0; i < m; i++) {
		double x = a + (t[i] - lo) * slope;
		if (t[i] >= lo && t[i] <= hi)
			x = t[i] == hi ? b : fmin(x, b);
		else if (t[i] > hi)
			x = fmax(x, b);
		t[i] = x;
	}
	domain[0] = a;
	domain[1] = b;
}

void curve_reparametrise(struct curve *c, double a, double b)
{
	map_knots(c->knots, c->n + c->order, c->domain, a, b);
}

void surface_reparametrise(struct surface *s, int d, double a, double b)
{
	map_knots(s->knots[d], s->n[d] + s->order[d], s->domain[d], a, b);
}

/* t becomes lo + hi - t, the ends of the domain exact. */
static void reverse_knots(double *t, int m, const double domain[2])
{
	double lo = domain[0], hi = domain[1];
	for (int i = 0; i < m; i++) {
		if (t[i] <= lo)
			t[i] = hi + (lo - t[i]);
		else if (t[i] >= hi)
			t[i] = lo - (t[i] - hi);
		else
			t[i] = fmax(lo, fmin(hi, lo + (hi - t[i])));
	}
	for (int i = 0; i < m / 2; i++) {
		double x = t[i];
		t[i] = t[m - 1 - i];
		t[m - 1 - i] = x;
	}
}

static void swap_points(double *a, double *b)
{
	double x[4];
	memcpy(x, a, sizeof x);
	memcpy(a, b, sizeof x);
	memcpy(b, x, sizeof x);
}

void curve_reverse(struct curve *c)
{
	reverse_knots(c->knots, c->n + c->order, c->domain);
	for (int i = 0; i < c->n / 2; i++)
		swap_points(c->points + 4 * i, c->points + 4 * (c->n - 1 - i));
}

void surface_reverse(struct surface *s, int d)
{
	reverse_knots(s->knots[d], s->n[d] + s->order[d], s->domain[d]);
	int nu = s->n[0], nv = s->n[1];
	for (int i = 0; i < (d == 0 ? nu / 2 : nu); i++) {
		for (int j = 0; j < (d == 1 ? nv / 2 : nv); j++) {
			int k = d == 0 ? nu - 1 - i : i, l = d == 1 ? nv - 1 - j : j;
			swap_points(s->points + 4 * ((size_t)i * nv + j),
			            s->points + 4 * ((size_t)k * nv + l));
		}
	}
}

static void transform_points(double *q, size_t n, const double m[3][4])
{
	for (size_t i = 0; i < n; i++, q += 4) {
		double x[3];
		for (int k = 0; k < 3; k++)
			x[k] = m[k][0] * q[0] + m[k][1] * q[1] + m[k][2] * q[2] + m[k][3] * q[3];
		memcpy(q, x, sizeof x);
	}
}

void curve_transform(struct curve *c, const double m[3][4])
{
	transform_points(c->points, (size_t)c->n, m);
}

void surface_transform(struct surface *s, const double m[3][4])
{
	transform_points(s->points, (size_t)s->n[0] * (size_t)s->n[1], m);
}
