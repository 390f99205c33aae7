/* test_box.c - boxes: their algebra, and the true extents of curves and surfaces. */
#include <math.h>

#include "box.h"
#include "cmocka_all.h"
#include "shapes.h"

static void algebra(void **state)
{
	struct box a = box_empty(), b = box_empty();
	(void)state;
	assert_true(box_is_empty(&a) && box_diagonal(&a) == 0);
	box_add_box(&a, &b);
	assert_true(box_is_empty(&a));
	box_add_point(&a, vec3(1, 2, 3));
	assert_false(box_is_empty(&a));
	box_add_point(&b, vec3(3, 0, 3));
	box_add_box(&a, &b);
	assert_true(a.lo.x == 1 && a.lo.y == 0 && a.hi.x == 3 && a.hi.y == 2 && a.hi.z == 3);
	assert_true(box_center(&a).x == 2 && fabs(box_diagonal(&a) - sqrt(8)) < 1e-15);
}

static void expect_box(const struct box *b, struct vec3 lo, struct vec3 hi, double tolerance)
{
	const double got[6] = { b->lo.x, b->lo.y, b->lo.z, b->hi.x, b->hi.y, b->hi.z };
	const double expected[6] = { lo.x, lo.y, lo.z, hi.x, hi.y, hi.z };
	for (int i = 0; i < 6; i++)
		if (!(fabs(got[i] - expected[i]) <= tolerance))
			fail_msg("side %d: %.17g, expected %.17g", i, got[i], expected[i]);
}

static void exact_shapes(void **state)
{
	struct surface torus = shape_torus(3, 1), sphere = shape_sphere(2.5);
	struct box b;
	(void)state;
	assert_int_equal(surface_box(&torus, 0, &b), ST_OK);
	expect_box(&b, vec3(-4, -4, -1), vec3(4, 4, 1), 1e-11);
	assert_int_equal(surface_box(&sphere, 0, &b), ST_OK);
	expect_box(&b, vec3(-2.5, -2.5, -2.5), vec3(2.5, 2.5, 2.5), 1e-11);
	/* an eighth: 0 <= u <= 1/8 is 45 degrees */
	sphere.domain[0][1] = 0.125;
	sphere.domain[1][0] = 0.5;
	assert_int_equal(surface_box(&sphere, 0, &b), ST_OK);
	expect_box(&b, vec3(0, 0, 0), vec3(2.5, 2.5 * sqrt(0.5), 2.5), 1e-11);
	surface_finish(&torus);
	surface_finish(&sphere);
}

/* The box holds a dense sample of the surface and is no larger than that by more than it may. */
static void holds_all_and_no_more(void **state)
{
	(void)state;
	for (int how = 0; how < N_SHAPE_KNOTS; how++)
		for (int order = 2; order < 8; order += 2) {
			struct surface s =
			        shape_surface((const int[2]){ order, order + 1 },
			                      (const int[2]){ 9, 9 }, order % 4, how, 12);
			struct box exact, loose, sample = box_empty();
			for (int i = 0; i <= 300; i++)
				for (int j = 0; j <= 300; j++)
					box_add_point(
					        &sample,
					        surface_point(&s,
					                      s.domain[0][0] + (s.domain[0][1] -
					                                        s.domain[0][0]) *
					                                               i / 300,
					                      s.domain[1][0] + (s.domain[1][1] -
					                                        s.domain[1][0]) *
					                                               j / 300));
			assert_int_equal(surface_box(&s, 0, &exact), ST_OK);
			assert_int_equal(surface_box(&s, 0.01, &loose), ST_OK);
			struct box both = exact;
			box_add_box(&both, &sample);
			expect_box(&exact, both.lo, both.hi, 1e-12);
			expect_box(&exact, sample.lo, sample.hi, 3e-2);
			expect_box(&loose, exact.lo, exact.hi, 0.01);
			surface_finish(&s);
		}
}

/* z = -(u - v)^2 is largest on a whole line askew to the parameters. */
static void extreme_on_a_skew_line(void **state)
{
	struct surface s;
	struct box b;
	(void)state;
	assert_int_equal(surface_init(&s, (const int[2]){ 3, 3 }, (const int[2]){ 3, 3 }), ST_OK);
	for (int d = 0; d < 2; d++)
		shape_fill_knots(s.knots[d], 3, 3, KNOTS_CLAMPED);
	/* -(u - v)^2 in Bernstein form */
	static const double z[3][3] = { { 0, 0, -1 }, { 0, 0.5, 0 }, { -1, 0, 0 } };
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++)
			surface_set_point(&s, i, j, vec3(0.5 * i, 0.5 * j, z[i][j]), 1);
	assert_int_equal(surface_check(&s, "ridge", NULL), ST_OK);
	assert_int_equal(surface_box(&s, 0, &b), ST_OK);
	expect_box(&b, vec3(0, 0, -1), vec3(1, 1, 0), 1e-8);
	surface_finish(&s);
}

static void curves(void **state)
{
	struct curve c = shape_curve(4, 9, true, KNOTS_OPEN, 6);
	struct box b, sample = box_empty();
	(void)state;
	for (int i = 0; i <= 20000; i++)
		box_add_point(&sample, curve_point(&c, c.domain[0] + (c.domain[1] - c.domain[0]) *
		                                                             i / 20000));
	assert_int_equal(curve_box(&c, 0, &b), ST_OK);
	expect_box(&b, sample.lo, sample.hi, 1e-7);
	curve_finish(&c);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(algebra),
		cmocka_unit_test(exact_shapes),
		cmocka_unit_test(holds_all_and_no_more),
		cmocka_unit_test(extreme_on_a_skew_line),
		cmocka_unit_test(curves),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
