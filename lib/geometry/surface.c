/* surface.c - NURBS surfaces: making, checking, evaluating. */
#include "surface.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "basis_inline.h"
#include "homogeneous.h"

enum status surface_init(struct surface *s, const int order[2], const int n[2])
{
	*s = (struct surface){ .order = { order[0], order[1] }, .n = { n[0], n[1] } };
	if (order[0] < 1 || order[1] < 1 || n[0] < 1 || n[1] < 1 ||
	    (size_t)n[0] > (size_t)1 << 30 || (size_t)n[0] * n[1] > (size_t)1 << 30)
		return ST_RESOURCE;
	for (int d = 0; d < 2; d++)
		s->knots[d] = calloc((size_t)n[d] + order[d], sizeof(double));
	s->points = calloc((size_t)n[0] * n[1], 4 * sizeof(double));
	if (s->knots[0] && s->knots[1] && s->points)
		return ST_OK;
	surface_finish(s);
	return ST_RESOURCE;
}

void surface_finish(struct surface *s)
{
	if (!s)
		return;
	free(s->knots[0]);
	free(s->knots[1]);
	free(s->points);
	*s = (struct surface){ 0 };
}

enum status surface_copy(struct surface *out, const struct surface *s)
{
	struct surface fresh;
	enum status st = surface_init(&fresh, s->order, s->n);
	if (st != ST_OK)
		return st;
	for (int d = 0; d < 2; d++) {
		memcpy(fresh.knots[d], s->knots[d], sizeof(double) * (s->n[d] + s->order[d]));
		memcpy(fresh.domain[d], s->domain[d], sizeof s->domain[d]);
		fresh.periodic[d] = s->periodic[d];
	}
	memcpy(fresh.points, s->points, 4 * sizeof(double) * s->n[0] * s->n[1]);
	fresh.rational = s->rational;
	*out = fresh;
	return ST_OK;
}

enum status surface_check(struct surface *s, const char *what, const struct report *r)
{
	char name[200];
	for (int d = 0; d < 2; d++) {
		snprintf(name, sizeof name, "%s, %c", what, "uv"[d]);
		enum status st = knots_check(s->order[d], s->n[d], s->knots[d], name, r);
		if (st != ST_OK)
			return st;
	}
	enum status st = points_check(s->points, s->n[0], s->n[1], what, &s->rational, r);
	for (int d = 0; d < 2 && st == ST_OK; d++) {
		snprintf(name, sizeof name, "%s, %c", what, "uv"[d]);
		st = domain_check(s->domain[d], s->knots[d][s->order[d] - 1], s->knots[d][s->n[d]],
		                  name, r);
	}
	if (st != ST_OK)
		return st;
	if (!(surface_size(s) > 0)) {
		struct vec3 p = surface_get_point(s, 0, 0, NULL);
		return report_error(r, ST_INPUT,
		                    "%s: all %d control points are the point %g %g %g, expected a "
		                    "surface; leave it out",
		                    what, s->n[0] * s->n[1], p.x, p.y, p.z);
	}
	return ST_OK;
}

void surface_set_point(struct surface *s, int i, int j, struct vec3 p, double w)
{
	double *q = s->points + 4 * ((size_t)i * s->n[1] + j);
	q[0] = p.x * w;
	q[1] = p.y * w;
	q[2] = p.z * w;
	q[3] = w;
}

struct vec3 surface_get_point(const struct surface *s, int i, int j, double *w)
{
	const double *q = s->points + 4 * ((size_t)i * s->n[1] + j);
	if (w)
		*w = q[3];
	return vec3(q[0] / q[3], q[1] / q[3], q[2] / q[3]);
}

void surface_derivatives(const struct surface *s, double u, double v, int d, struct vec3 *out)
{
	double basis[2][ORDER_MAX * ORDER_MAX];
	double h[ORDER_MAX * ORDER_MAX][4];
	const int ku = s->order[0], kv = s->order[1];
	const double at[2] = { u, v };
	int span[2], top[2];
	for (int e = 0; e < 2; e++) {
		top[e] = d < s->order[e] ? d : s->order[e] - 1;
		span[e] = knots_domain_span(s->order[e], s->n[e], s->knots[e], s->domain[e], at[e]);
		knots_basis(s->order[e], s->knots[e], span[e], at[e], top[e], basis[e]);
	}
	const double *p = s->points + 4 * ((size_t)(span[0] - ku + 1) * s->n[1] + span[1] - kv + 1);
	/* Lengths are taken from the control point that weighs most here, so that differences of
	 * large coordinates do not eat up the derivatives. */
	const double *o = p + 4 * ((size_t)s->n[1] * basis_heaviest(basis[0], ku) +
	                           basis_heaviest(basis[1], kv));
	const struct point4 center = point4_center(o, s->rational);
	for (int l = 0; l <= top[1]; l++) {
		struct point4 row[ORDER_MAX];
		for (int i = 0; i < ku; i++) {
			const double *q = p + (size_t)4 * s->n[1] * i;
			row[i] = (struct point4){ { 0 }, { 0 } };
			for (int j = 0; j < kv; j++)
				row[i] = point4_along(row[i], basis[1][l * kv + j],
				                      point4_about(q + 4 * j, center));
		}
		for (int k = 0; k <= top[0] && k + l <= d; k++) {
			struct point4 sum = { { 0 }, { 0 } };
			for (int i = 0; i < ku; i++)
				sum = point4_along(sum, basis[0][k * ku + i], row[i]);
			memcpy(h[k * ORDER_MAX + l], &sum, sizeof sum);
		}
	}
	for (int k = 0; k <= d && !s->rational; k++)
		for (int l = 0; k + l <= d; l++) {
			const double *a = h[k * ORDER_MAX + l];
			out[k * (d + 1) + l] =
			        k <= top[0] && l <= top[1] ? vec3(a[0], a[1], a[2]) : vec3(0, 0, 0);
		}
	if (s->rational)
		quotient_surface(top, (const double(*)[4])h, ORDER_MAX, d, out);
	out[0] = vec3_add(out[0], point4_vector(center));
}

/* The net of a span, contracted with the basis of v and then of u; du, dv only where `first`. */
BATTEN_INLINE void evaluate(const struct surface *s, double u, double v, const int ku, const int kv,
                            const bool first, struct point4 *p, struct point4 *du,
                            struct point4 *dv)
{
	double bu[ORDER_MAX], cu[ORDER_MAX], bv[ORDER_MAX], cv[ORDER_MAX];
	const int a = knots_domain_span(ku, s->n[0], s->knots[0], s->domain[0], u);
	const int b = knots_domain_span(kv, s->n[1], s->knots[1], s->domain[1], v);
	basis_inline(ku, s->knots[0], a, u, bu, first ? cu : NULL, NULL);
	basis_inline(kv, s->knots[1], b, v, bv, first ? cv : NULL, NULL);
	const double *q = s->points + 4 * ((size_t)(a - ku + 1) * s->n[1] + b - kv + 1);
	const struct point4 zero = { { 0 }, { 0 } };
	struct point4 sum = zero, sum_u = zero, sum_v = zero;
	for (int i = 0; i < ku; i++, q += (size_t)4 * s->n[1]) {
		struct point4 row = zero, row_v = zero;
		for (int j = 0; j < kv; j++) {
			const struct point4 x = point4_load(q + 4 * j);
			row = point4_along(row, bv[j], x);
			if (first)
				row_v = point4_along(row_v, cv[j], x);
		}
		sum = point4_along(sum, bu[i], row);
		if (first) {
			sum_u = point4_along(sum_u, cu[i], row);
			sum_v = point4_along(sum_v, bu[i], row_v);
		}
	}
	*p = sum;
	*du = sum_u;
	*dv = sum_v;
}

/* The commonest orders get code of their own, unrolled. */
BATTEN_INLINE void evaluate_any(const struct surface *s, double u, double v, const bool first,
                                struct point4 *p, struct point4 *du, struct point4 *dv)
{
	const int ku = s->order[0], kv = s->order[1];
	if (ku == 4 && kv == 4)
		evaluate(s, u, v, 4, 4, first, p, du, dv);
	else if (ku == 3 && kv == 3)
		evaluate(s, u, v, 3, 3, first, p, du, dv);
	else if (ku == 6 && kv == 6)
		evaluate(s, u, v, 6, 6, first, p, du, dv);
	else
		evaluate(s, u, v, ku, kv, first, p, du, dv);
}

struct vec3 surface_point(const struct surface *s, double u, double v)
{
	struct point4 p, none;
	evaluate_any(s, u, v, false, &p, &none, &none);
	const struct vec3 x = point4_vector(p);
	return s->rational ? vec3_scale(x, 1 / point4_weight(p)) : x;
}

void surface_tangents(const struct surface *s, double u, double v, struct vec3 *p, struct vec3 *du,
                      struct vec3 *dv)
{
	struct point4 a, b, c;
	evaluate_any(s, u, v, true, &a, &b, &c);
	*p = point4_vector(a);
	*du = point4_vector(b);
	*dv = point4_vector(c);
	if (!s->rational)
		return;
	const double w = 1 / point4_weight(a);
	*p = vec3_scale(*p, w);
	*du = vec3_scale(vec3_along(*du, -point4_weight(b), *p), w);
	*dv = vec3_scale(vec3_along(*dv, -point4_weight(c), *p), w);
}

double surface_size(const struct surface *s)
{
	struct vec3 lo = surface_get_point(s, 0, 0, NULL), hi = lo;
	for (int i = 0; i < s->n[0]; i++)
		for (int j = 0; j < s->n[1]; j++) {
			struct vec3 p = surface_get_point(s, i, j, NULL);
			lo = vec3(fmin(lo.x, p.x), fmin(lo.y, p.y), fmin(lo.z, p.z));
			hi = vec3(fmax(hi.x, p.x), fmax(hi.y, p.y), fmax(hi.z, p.z));
		}
	return fmax(hi.x - lo.x, fmax(hi.y - lo.y, hi.z - lo.z));
}
