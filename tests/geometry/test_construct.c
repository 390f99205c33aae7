/* test_construct.c - lines, arcs and surfaces against the equations they are made from. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>

#include "arbitrary.h"
#include "construct.h"
#include "refine.h"

static void check_curve(struct curve *c)
{
	assert_int_equal(curve_check(c, "result", NULL), ST_OK);
}

static void check_surface(struct surface *s)
{
	assert_int_equal(surface_check(s, "result", NULL), ST_OK);
}

static void test_lines(void **state)
{
	(void)state;
	struct curve c;
	struct vec3 p[4] = { { 1, 2, 3 }, { 4, 2, 3 }, { 4, 8, 3 }, { 0, 8, -3 } };
	assert_int_equal(make_line(&c, p[0], p[2]), ST_OK);
	check_curve(&c);
	assert_true(distance(curve_point(&c, 0.25), vec3(1.75, 3.5, 3)) < 1e-15);
	curve_finish(&c);
	assert_int_equal(make_polyline(&c, p, 4), ST_OK);
	check_curve(&c);
	for (int i = 0; i < 4; i++)
		assert_true(distance(curve_point(&c, c.knots[i + 1]), p[i]) == 0);
	curve_finish(&c);
	assert_int_equal(make_polyline(&c, p, 1), ST_PARAMETER);
}

static void test_arc(void **state)
{
	(void)state;
	static const struct {
		double a, b;
		int points;
	} cases[] = { { 0, 2 * M_PI, 9 },    { 0.3, 0.3 + M_PI / 2, 3 }, { -1, 2, 5 },
		      { -4, -4 + 1e-3, 3 },  { 1, 1 + 1.6, 5 },          { M_PI, 2 * M_PI, 5 },
		      { 5, 5 + 2 * M_PI, 9 } };
	struct vec3 x = { 0.6, 0, 0.8 }, y = { 0, 1, 0 }, center = { 3, -2, 1 };
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		struct curve c;
		double a = cases[i].a, b = cases[i].b, radius = 2;
		assert_int_equal(make_arc(&c, center, x, y, radius, a, b), ST_OK);
		check_curve(&c);
		assert_int_equal(c.n, cases[i].points);
		for (int k = 0; k <= 300; k++) {
			double t = in_range(c.domain, k / 300.0);
			struct vec3 d = vec3_sub(curve_point(&c, t), center);
			assert_true(fabs(vec3_length(d) - radius) < 4e-15);
			assert_true(fabs(vec3_dot(d, vec3_cross(x, y))) < 4e-15);
		}
		for (int k = 0; k < 2; k++) {
			double t = k ? b : a;
			struct vec3 want = vec3_along(vec3_along(center, radius * cos(t), x),
			                              radius * sin(t), y);
			assert_true(distance(curve_point(&c, t), want) < 4e-15);
		}
		if (b - a == 2 * M_PI)
			assert_true(distance(curve_point(&c, a), curve_point(&c, b)) == 0);
		curve_finish(&c);
	}
	struct curve c;
	assert_int_equal(make_arc(&c, center, x, y, 1, 1, 1), ST_PARAMETER);
	assert_int_equal(make_arc(&c, center, x, y, 1, 0, 7), ST_PARAMETER);
	assert_int_equal(make_arc(&c, center, x, y, 0, 0, 1), ST_PARAMETER);
	assert_int_equal(make_arc(&c, center, x, y, 1, 0, NAN), ST_PARAMETER);
}

static void test_ruled(void **state)
{
	(void)state;
	static const struct {
		int order, n;
		bool rational, clamped, inner;
	} cases[] = { { 4, 7, false, true, false },
		      { 3, 6, true, false, true },
		      { 5, 5, true, true, false },
		      { 2, 4, false, true, false } };
	for (int i = 0; i < 4; i++) {
		for (int j = 0; j < 4; j++) {
			struct curve a, b;
			struct surface s;
			assert_int_equal(any_curve(&a, cases[i].order, cases[i].n,
			                           cases[i].rational, cases[i].clamped,
			                           cases[i].inner, 1),
			                 ST_OK);
			assert_int_equal(any_curve(&b, cases[j].order, cases[j].n,
			                           cases[j].rational, cases[j].clamped,
			                           cases[j].inner, 2),
			                 ST_OK);
			assert_int_equal(make_ruled(&s, &a, &b), ST_OK);
			check_surface(&s);
			curve_reparametrise(&b, a.domain[0], a.domain[1]);
			for (int k = 0; k <= 100; k++) {
				double u = in_range(a.domain, k / 100.0);
				struct vec3 p = curve_point(&a, u), q = curve_point(&b, u);
				for (int l = 0; l <= 4; l++) {
					struct vec3 want = vec3_along(p, l / 4.0, vec3_sub(q, p));
					assert_true(distance(surface_point(&s, u, l / 4.0), want) <
					            1e-12);
				}
			}
			surface_finish(&s);
			curve_finish(&a);
			curve_finish(&b);
		}
	}
	/* the product's degree has no room */
	struct curve a, b;
	struct surface s;
	assert_int_equal(any_curve(&a, 20, 20, true, true, false, 1), ST_OK);
	assert_int_equal(any_curve(&b, 20, 20, true, true, false, 2), ST_OK);
	assert_int_equal(make_ruled(&s, &a, &b), ST_PARAMETER);
	curve_finish(&a);
	curve_finish(&b);
}

static void test_swept(void **state)
{
	(void)state;
	struct curve c;
	struct surface s;
	assert_int_equal(any_curve(&c, 4, 9, true, false, true, 8), ST_OK);
	struct vec3 d = { 1, -2, 5 }, p = { 0.5, 0.25, -1 }, axis = { 2.0 / 3, 1.0 / 3, -2.0 / 3 };
	assert_int_equal(make_cylinder(&s, &c, d), ST_OK);
	check_surface(&s);
	for (int k = 0; k <= 50; k++) {
		double u = in_range(c.domain, k / 50.0), v = fmod(k * 0.37, 1);
		assert_true(distance(surface_point(&s, u, v),
		                     vec3_along(curve_point(&c, u), v, d)) < 1e-14);
	}
	surface_finish(&s);

	static const double sweeps[][2] = { { 0, 2 * M_PI }, { 0.5, 1.25 }, { -2, 2 } };
	for (int i = 0; i < 3; i++) {
		double a = sweeps[i][0], b = sweeps[i][1];
		assert_int_equal(make_revolution(&s, &c, p, axis, a, b), ST_OK);
		check_surface(&s);
		for (int k = 0; k <= 50; k++) {
			double u = in_range(c.domain, k / 50.0);
			struct vec3 q = vec3_sub(curve_point(&c, u), p);
			struct vec3 along = vec3_scale(axis, vec3_dot(q, axis));
			struct vec3 x = vec3_sub(q, along), y = vec3_cross(axis, x);
			for (int l = 0; l <= 10; l++) {
				double v = in_range(s.domain[1], l / 10.0);
				struct vec3 at = vec3_sub(surface_point(&s, u, v), p);
				/* same height, same radius; angle a, b and the middle by formula */
				assert_true(distance(vec3_scale(axis, vec3_dot(at, axis)), along) <
				            1e-14);
				assert_true(fabs(vec3_length(vec3_sub(at, along)) -
				                 vec3_length(x)) < 1e-14);
				if (l % 5 == 0) {
					struct vec3 want =
					        vec3_add(along, vec3_add(vec3_scale(x, cos(v)),
					                                 vec3_scale(y, sin(v))));
					assert_true(distance(at, want) < 1e-14);
				}
			}
		}
		surface_finish(&s);
	}
	assert_int_equal(make_revolution(&s, &c, p, vec3(0, 0, 0), 0, 1), ST_PARAMETER);
	assert_int_equal(make_revolution(&s, &c, p, axis, 1, 0), ST_PARAMETER);
	curve_finish(&c);
}

static void test_bodies(void **state)
{
	(void)state;
	struct surface s;
	struct vec3 c = { 1, 2, 3 }, q, du, dv;
	assert_int_equal(make_sphere(&s, c, 5), ST_OK);
	check_surface(&s);
	assert_true(surface_closed(&s, 0, 0) && surface_degenerate(&s, 1, 0, 1e-14));
	for (int i = 0; i <= 1600; i++) {
		double u = in_range(s.domain[0], i % 41 / 40.0),
		       v = in_range(s.domain[1], i / 1600.0);
		surface_tangents(&s, u, v, &q, &du, &dv);
		assert_true(fabs(distance(q, c) - 5) < 1e-14);
		assert_true(vec3_dot(vec3_cross(du, dv), vec3_sub(q, c)) >= -1e-12);
	}
	surface_finish(&s);

	assert_int_equal(make_torus(&s, c, 4, 1.5), ST_OK);
	check_surface(&s);
	assert_true(surface_closed(&s, 0, 0) && surface_closed(&s, 1, 0));
	for (int i = 0; i <= 1600; i++) {
		double u = in_range(s.domain[0], i % 41 / 40.0),
		       v = in_range(s.domain[1], i / 1600.0);
		surface_tangents(&s, u, v, &q, &du, &dv);
		struct vec3 d = vec3_sub(q, c);
		double ring = hypot(d.x, d.y), f = (ring - 4) * (ring - 4) + d.z * d.z;
		assert_true(fabs(sqrt(f) - 1.5) < 1e-14);
		struct vec3 outward = { d.x - 4 * d.x / ring, d.y - 4 * d.y / ring, d.z };
		assert_true(vec3_dot(vec3_cross(du, dv), outward) > 0);
	}
	surface_finish(&s);
	assert_int_equal(make_torus(&s, c, 1, 1), ST_PARAMETER);
	assert_int_equal(make_torus(&s, c, 1, 0), ST_PARAMETER);
	assert_int_equal(make_sphere(&s, c, -1), ST_PARAMETER);

	const struct vec3 corner[4] = { { 0, 0, 0 }, { 2, 0, 0 }, { 0, 3, 0 }, { 2, 3, 4 } };
	assert_int_equal(make_bilinear(&s, corner), ST_OK);
	check_surface(&s);
	assert_true(distance(surface_point(&s, 0.5, 0.25), vec3(1, 0.75, 0.5)) < 1e-15);
	surface_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_lines),  cmocka_unit_test(test_arc),
		cmocka_unit_test(test_ruled),  cmocka_unit_test(test_swept),
		cmocka_unit_test(test_bodies),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
