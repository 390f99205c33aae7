/* test_on_surface.c - curves in a surface's parameters, seen in space. */
#include <math.h>
#include <string.h>

#include "cmocka_all.h"
#include "on_surface.h"
#include "shapes.h"

static struct curve line(double u0, double v0, double u1, double v1)
{
	struct curve c;
	assert_int_equal(curve_init(&c, 2, 2), ST_OK);
	shape_fill_knots(c.knots, 2, 2, KNOTS_CLAMPED);
	curve_set_point(&c, 0, vec3(u0, v0, 0), 1);
	curve_set_point(&c, 1, vec3(u1, v1, 0), 1);
	assert_int_equal(curve_check(&c, "line", NULL), ST_OK);
	return c;
}

static void derivatives_agree_with_differences(void **state)
{
	struct surface s =
	        shape_surface((const int[2]){ 5, 4 }, (const int[2]){ 7, 6 }, true, KNOTS_OPEN, 3);
	struct curve c = shape_curve(4, 4, true, KNOTS_CLAMPED, 8);
	const double h = 1e-3;
	(void)state;
	for (int i = 0; i < 4; i++) { /* bring it inside the domain */
		struct vec3 p = curve_get_point(&c, i, NULL);
		curve_set_point(&c, i,
		                vec3(s.domain[0][0] + 0.05 * p.x + 0.02,
		                     s.domain[1][0] + 0.05 * p.y + 0.02, 0),
		                1 + 0.2 * i);
	}
	const struct on_surface on = { &c, &s };
	for (int i = 1; i < 20; i++) {
		struct vec3 d[4], e[4][4];
		const double t = i / 20.0;
		on_surface_derivatives(&on, t, 3, d);
		for (int k = 0; k < 4; k++)
			on_surface_derivatives(&on, t + (k < 2 ? k - 2 : k - 1) * h, 3, e[k]);
		for (int k = 0; k < 3; k++) {
			struct vec3 near = vec3_sub(e[2][k], e[1][k]),
			            far = vec3_sub(e[3][k], e[0][k]);
			struct vec3 slope =
			        vec3_along(vec3_scale(near, 8 / (12 * h)), -1 / (12 * h), far);
			assert_true(vec3_length(vec3_sub(slope, d[k + 1])) <
			            1e-6 * (1 + vec3_length(d[k + 1])));
		}
		for (int k = 0; k < 3; k++) {
			struct vec3 fewer[4];
			on_surface_derivatives(&on, t, k, fewer);
			assert_true(vec3_length(vec3_sub(fewer[k], d[k])) <
			            1e-12 * (1 + vec3_length(d[k])));
		}
	}
	surface_finish(&s);
	curve_finish(&c);
}

static void circles_of_a_sphere(void **state)
{
	struct surface s = shape_sphere(2);
	struct on_surface_shape p;
	(void)state;
	/* a parallel: geodesic curvature tan(latitude) / R; N is outward and u runs eastward */
	for (int i = 1; i < 10; i++) {
		struct curve c = line(0, i / 10.0, 1, i / 10.0);
		on_surface_shape(&(struct on_surface){ &c, &s }, 0.3, &p);
		const double r = hypot(p.space.point.x, p.space.point.y);
		assert_true(fabs(p.space.curvature - 1 / r) < 1e-12);
		assert_true(fabs(p.normal_curvature + 0.5) < 1e-12);
		assert_true(fabs(p.geodesic_curvature - p.space.point.z / r / 2) < 1e-12);
		assert_false(p.space.limit);
		curve_finish(&c);
	}
	/* a meridian, up to the pole: a geodesic */
	struct curve c = line(0.3, 0, 0.3, 1);
	for (int i = 0; i <= 10; i++) {
		on_surface_shape(&(struct on_surface){ &c, &s }, i / 10.0, &p);
		assert_true(fabs(p.normal_curvature + 0.5) < 1e-9);
		assert_true(fabs(p.geodesic_curvature) < 1e-9);
		assert_true(fabs(p.space.torsion) < 1e-6);
	}
	curve_finish(&c);
	/* along the pole itself: no direction */
	c = line(0, 1, 1, 1);
	on_surface_shape(&(struct on_surface){ &c, &s }, 0.4, &p);
	assert_true(p.space.limit && isnan(p.space.curvature) && isnan(p.geodesic_curvature));
	assert_true(fabs(p.normal.z - 1) < 1e-9);
	curve_finish(&c);
	surface_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(derivatives_agree_with_differences),
		cmocka_unit_test(circles_of_a_sphere),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
