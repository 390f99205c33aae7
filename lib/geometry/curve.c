/* curve.c - NURBS curves: making, checking, evaluating. */
#include "curve.h"

#include <stdlib.h>
#include <string.h>

#include "basis_inline.h"
#include "homogeneous.h"

enum status curve_init(struct curve *c, int order, int n)
{
	*c = (struct curve){ .order = order, .n = n };
	if (order < 1 || n < 1)
		return ST_RESOURCE;
	c->knots = calloc((size_t)n + order, sizeof *c->knots);
	c->points = calloc((size_t)n, 4 * sizeof *c->points);
	if (c->knots && c->points)
		return ST_OK;
	curve_finish(c);
	return ST_RESOURCE;
}

void curve_finish(struct curve *c)
{
	if (!c)
		return;
	free(c->knots);
	free(c->points);
	*c = (struct curve){ 0 };
}

enum status curve_copy(struct curve *out, const struct curve *c)
{
	struct curve fresh;
	enum status st = curve_init(&fresh, c->order, c->n);
	if (st != ST_OK)
		return st;
	memcpy(fresh.knots, c->knots, sizeof *c->knots * (c->n + c->order));
	memcpy(fresh.points, c->points, 4 * sizeof *c->points * c->n);
	fresh.rational = c->rational;
	fresh.periodic = c->periodic;
	memcpy(fresh.domain, c->domain, sizeof c->domain);
	*out = fresh;
	return ST_OK;
}

enum status curve_check(struct curve *c, const char *what, const struct report *r)
{
	enum status st = knots_check(c->order, c->n, c->knots, what, r);
	if (st == ST_OK)
		st = points_check(c->points, c->n, 1, what, &c->rational, r);
	if (st == ST_OK)
		st = domain_check(c->domain, c->knots[c->order - 1], c->knots[c->n], what, r);
	return st;
}

void curve_set_point(struct curve *c, int i, struct vec3 p, double w)
{
	double *q = c->points + (size_t)4 * i;
	q[0] = p.x * w;
	q[1] = p.y * w;
	q[2] = p.z * w;
	q[3] = w;
}

struct vec3 curve_get_point(const struct curve *c, int i, double *w)
{
	const double *q = c->points + (size_t)4 * i;
	if (w)
		*w = q[3];
	return vec3(q[0] / q[3], q[1] / q[3], q[2] / q[3]);
}

void curve_derivatives(const struct curve *c, double t, int d, struct vec3 *out)
{
	double basis[ORDER_MAX * ORDER_MAX];
	double h[ORDER_MAX][4];
	const int k = c->order, top = d < k ? d : k - 1;
	const int s = knots_domain_span(k, c->n, c->knots, c->domain, t);
	const double *p = c->points + (size_t)4 * (s - k + 1);
	knots_basis(k, c->knots, s, t, top, basis);
	/* Lengths are taken from the control point that weighs most here, so that differences of
	 * large coordinates do not eat up the derivatives. */
	const double *o = p + (size_t)4 * basis_heaviest(basis, k);
	const struct point4 center = point4_center(o, c->rational);
	for (int i = 0; i <= top; i++) {
		struct point4 sum = { { 0 }, { 0 } };
		for (int j = 0; j < k; j++)
			sum = point4_along(sum, basis[i * k + j], point4_about(p + 4 * j, center));
		memcpy(h[i], &sum, sizeof sum);
	}
	for (int i = 0; i <= d && !c->rational; i++)
		out[i] = i <= top ? vec3(h[i][0], h[i][1], h[i][2]) : vec3(0, 0, 0);
	if (c->rational)
		quotient_curve(top, (const double(*)[4])h, d, out);
	out[0] = vec3_add(out[0], point4_vector(center));
}

struct vec3 curve_point(const struct curve *c, double t)
{
	double basis[ORDER_MAX];
	const int k = c->order;
	const int s = knots_domain_span(k, c->n, c->knots, c->domain, t);
	const double *p = c->points + (size_t)4 * (s - k + 1);
	basis_inline(k, c->knots, s, t, basis, NULL, NULL);
	struct point4 sum = { { 0 }, { 0 } };
	for (int j = 0; j < k; j++)
		sum = point4_along(sum, basis[j], point4_load(p + 4 * j));
	const struct vec3 x = point4_vector(sum);
	return c->rational ? vec3_scale(x, 1 / point4_weight(sum)) : x;
}

bool curve_closed(const struct curve *c, double tolerance)
{
	struct vec3 a = curve_point(c, c->domain[0]), b = curve_point(c, c->domain[1]);
	return vec3_length(vec3_sub(a, b)) <= tolerance;
}
