/* level_check.h - surfaces with known answers, and checks of curves that use none of the tracer's own
 * evaluation. */
#ifndef BATTEN_LEVEL_CHECK_H
#define BATTEN_LEVEL_CHECK_H

#include "cmocka_all.h"

#include "construct.h"
#include "level_shapes.h"
#include "refine.h"
#include "shapes.h"

static const double pi = 3.14159265358979323846;

static inline double cosine(double degrees)
{
	return degrees == 90 ? 0 : cos(degrees * pi / 180);
}

static inline struct surface wavy(void)
{
	struct surface s;
	assert_int_equal(shape_make(&s, 4, 30, shape_wavy), ST_OK);
	return s;
}

static inline struct surface sphere(void)
{
	return shape_sphere(2.5);
}

static inline struct surface torus(void)
{
	return shape_torus(3, 1);
}

static inline struct surface cylinder(void)
{
	struct curve c;
	struct surface s;
	assert_int_equal(make_arc(&c, vec3(1, 1, 1), vec3(1, 0, 0), vec3(0, 1, 0), 2, 0, 2 * pi),
	                 ST_OK);
	assert_int_equal(make_cylinder(&s, &c, vec3(0, 0, 5)), ST_OK);
	curve_finish(&c);
	return s;
}

static inline struct surface flat(void)
{
	struct surface s;
	const struct vec3 corner[4] = { { 0, 0, 1 }, { 4, 0, 1 }, { 0, 3, 1 }, { 4, 3, 1 } };
	assert_int_equal(make_bilinear(&s, corner), ST_OK);
	return s;
}

static inline double field_at(const struct surface *s, enum level_kind kind, struct vec3 d,
                              double value, double u, double v)
{
	struct vec3 p, su, sv;
	surface_tangents(s, u, v, &p, &su, &sv);
	if (kind == LEVEL_PLANE)
		return vec3_dot(p, d) - value;
	return vec3_dot(vec3_unit(vec3_cross(su, sv)), vec3_unit(d)) -
	       (kind == LEVEL_SILHOUETTE ? 0 : value);
}

/* Distance from p to the exact curve near (u, v): Newton for f = 0 and no offset along it. */
static inline double off_curve(const struct surface *s, enum level_kind kind, struct vec3 d,
                               double value, double u, double v, struct vec3 p)
{
	const double h = 1e-6;
	double range[2] = { s->domain[0][1] - s->domain[0][0], s->domain[1][1] - s->domain[1][0] };
	double hu = h * range[0], hv = h * range[1];
	struct vec3 q, su, sv;
	for (int step = 0; step < 4; step++) {
		double uu = fmin(fmax(u, s->domain[0][0] + hu), s->domain[0][1] - hu);
		double vv = fmin(fmax(v, s->domain[1][0] + hv), s->domain[1][1] - hv);
		double f = field_at(s, kind, d, value, u, v);
		double fu = (field_at(s, kind, d, value, uu + hu, v) -
		             field_at(s, kind, d, value, uu - hu, v)) /
		            (2 * hu);
		double fv = (field_at(s, kind, d, value, u, vv + hv) -
		             field_at(s, kind, d, value, u, vv - hv)) /
		            (2 * hv);
		surface_tangents(s, u, v, &q, &su, &sv);
		struct vec3 t = vec3_unit(vec3_along(vec3_scale(sv, fu), -fv, su));
		double a = vec3_dot(su, t), b = vec3_dot(sv, t), r = vec3_dot(vec3_sub(q, p), t);
		double det = fu * b - fv * a;
		u += (-f * b + fv * r) / det;
		v += (-fu * r + f * a) / det;
	}
	surface_tangents(s, u, v, &q, &su, &sv);
	return vec3_length(vec3_sub(p, q));
}

static inline void check_curves(const struct surface *s, const struct level_branch *b)
{
	assert_int_equal(curve_check((struct curve *)&b->uv, "uv", NULL), ST_OK);
	assert_int_equal(curve_check((struct curve *)&b->space, "space", NULL), ST_OK);
	assert_int_equal(b->uv.n, b->space.n);
	assert_memory_equal(b->uv.knots, b->space.knots, sizeof(double) * (b->uv.n + 4));
	for (int i = 0; i < b->uv.n; i++) {
		struct vec3 p = curve_get_point(&b->uv, i, NULL);
		for (int d = 0; d < 2; d++) {
			double x = d == 0 ? p.x : p.y, range = s->domain[d][1] - s->domain[d][0];
			assert_true(x > s->domain[d][0] - 1e-2 * range);
			assert_true(x < s->domain[d][1] + 1e-2 * range);
		}
	}
	assert_true(!b->closed || curve_closed(&b->space, 1e-9));
	assert_true(fabs(b->length - curve_length(&b->space, b->space.domain[0], b->space.domain[1],
	                                          1e-9)) < 1e-6 * b->length);
}

/* The space curve, and the image of the uv curve, against surface and exact curve. */
static inline void check_exact(const struct surface *s, enum level_kind kind, struct vec3 d,
                               double value, const struct level_branch *b, double tolerance,
                               int samples)
{
	double t0 = b->uv.domain[0], t1 = b->uv.domain[1];
	for (int k = 0; k < samples; k++) {
		double t = t0 + (t1 - t0) * (k + 0.37) / samples;
		struct vec3 uv = curve_point(&b->uv, t), p, su, sv;
		double u = fmin(fmax(uv.x, s->domain[0][0]), s->domain[0][1]);
		double v = fmin(fmax(uv.y, s->domain[1][0]), s->domain[1][1]);
		surface_tangents(s, u, v, &p, &su, &sv);
		/* near a pole differences say nothing */
		if (vec3_length(vec3_cross(su, sv)) < 1e-2 * vec3_length(su) * vec3_length(sv) ||
		    vec3_length(su) < 1e-2 || vec3_length(sv) < 1e-2)
			continue;
		assert_true(off_curve(s, kind, d, value, u, v, p) < tolerance);
		assert_true(off_curve(s, kind, d, value, u, v, curve_point(&b->space, t)) <
		            tolerance);
	}
}

struct count {
	size_t branches, closed, undecided;
	double length;
};

static inline struct count count_of(const struct surface *s, enum level_kind kind, struct vec3 d,
                                    double value)
{
	struct level_result x;
	assert_int_equal(shape_trace(s, kind, d, value, 1e-5, &x, NULL), ST_OK);
	struct count c = { x.n_branches, x.n_closed, x.n_undecided, x.length };
	assert_true(x.max_error <= 1.1e-5);
	for (size_t b = 0; b < x.n_branches; b++)
		check_curves(s, &x.branches[b]);
	level_result_finish(&x);
	return c;
}

static inline void assert_same(struct count a, struct count b)
{
	assert_int_equal(a.branches, b.branches);
	assert_int_equal(a.closed, b.closed);
	assert_int_equal(a.undecided, b.undecided);
	assert_true(fabs(a.length - b.length) < 1e-4 * (1 + a.length));
}

/* The right half (u >= 0.5) with a parameter that runs `factor` times as fast: the curve of the
 * surface stays, derivatives do not agree over the knot line any more. */
static inline struct surface stretched(const struct surface *s, double factor)
{
	struct surface r;
	const double half[3] = { 0.5, 0.5, 0.5 };
	assert_int_equal(surface_insert(&r, s, 0, half, s->order[0] - 1), ST_OK);
	for (int i = 0; i < r.n[0] + r.order[0]; i++)
		if (r.knots[0][i] > 0.5)
			r.knots[0][i] = 0.5 + factor * (r.knots[0][i] - 0.5);
	r.domain[0][1] = 0.5 + factor * (r.domain[0][1] - 0.5);
	return r;
}

/* Isophotes stay the same with knots inserted, in a higher degree, in other parameters, with u and v exchanged
 * and with one half run through faster. */
static inline void assert_forms(const struct surface *s, struct vec3 d, double value, int raise)
{
	const double knots[] = { 0.31, 0.5, 0.5, 0.77 };
	const struct count c = count_of(s, LEVEL_ISOPHOTE, d, value);
	struct surface r;
	for (int way = 0; way < 2; way++) {
		assert_int_equal(surface_insert(&r, s, way, knots, 4), ST_OK);
		assert_same(c, count_of(&r, LEVEL_ISOPHOTE, d, value));
		surface_finish(&r);
		assert_int_equal(surface_elevate(&r, s, way, raise), ST_OK);
		assert_same(c, count_of(&r, LEVEL_ISOPHOTE, d, value));
		surface_finish(&r);
	}
	assert_int_equal(surface_copy(&r, s), ST_OK);
	surface_reparametrise(&r, 0, -3, 100);
	assert_same(c, count_of(&r, LEVEL_ISOPHOTE, d, value));
	/* exchanged, the normal is turned */
	assert_int_equal(surface_exchange(&r), ST_OK);
	assert_same(c, count_of(&r, LEVEL_ISOPHOTE, d, -value));
	assert_same(c, count_of(&r, LEVEL_ISOPHOTE, vec3_scale(d, -4), value));
	surface_finish(&r);
	r = stretched(s, 3.7);
	assert_same(c, count_of(&r, LEVEL_ISOPHOTE, d, value));
	surface_finish(&r);
}

#endif
