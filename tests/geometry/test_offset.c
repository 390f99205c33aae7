/* test_offset.c - offsets against exact ones, their error figure, and what has no offset. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <string.h>

#include "arbitrary.h"
#include "construct.h"
#include "curvature.h"
#include "refine.h"

/* Largest distance from the exact offset at the same parameters, on lines of no special place. */
static double error_of(const struct surface *o, const struct surface *s, double d)
{
	double worst = 0;
	for (int i = 0; i < 97; i++) {
		for (int j = 0; j < 89; j++) {
			double u = in_range(s->domain[0], (i + 0.5) / 97);
			double v = in_range(s->domain[1], (j + 0.5) / 89);
			struct vec3 n;
			assert_true(surface_normal(s, u, v, &n));
			struct vec3 p = vec3_along(surface_point(s, u, v), d, n);
			worst = fmax(worst, distance(p, surface_point(o, u, v)));
		}
	}
	return worst;
}

static void check(const struct surface *s, double d, double tolerance, struct surface *out)
{
	double error = -1;
	assert_int_equal(make_offset(out, s, d, tolerance, &error, NULL), ST_OK);
	assert_int_equal(surface_check(out, "offset", NULL), ST_OK);
	assert_true(error >= 0 && error <= tolerance);
	double found = error_of(out, s, d);
	assert_true(found <= tolerance);
	assert_true(found <= 1.5 * error + 1e-13); /* the figure is true */
	for (int k = 0; k < 2; k++)
		assert_true(out->domain[k][0] == s->domain[k][0] &&
		            out->domain[k][1] == s->domain[k][1]);
}

static void test_sphere(void **state)
{
	(void)state;
	static const double distances[] = { 1, -3, 20 };
	struct surface s, o;
	assert_int_equal(make_sphere(&s, vec3(1, 2, 3), 5), ST_OK);
	for (int i = 0; i < 3; i++) {
		check(&s, distances[i], 1e-6, &o);
		for (int k = 0; k <= 900; k++) {
			double u = in_range(o.domain[0], k % 31 / 30.0);
			double v = in_range(o.domain[1], k / 900.0);
			double r = distance(surface_point(&o, u, v), vec3(1, 2, 3));
			assert_true(fabs(r - 5 - distances[i]) < 1e-6);
		}
		assert_true(surface_closed(&o, 0, 1e-12) && surface_degenerate(&o, 1, 1, 1e-12));
		surface_finish(&o);
	}
	surface_finish(&s);
}

static void test_torus(void **state)
{
	(void)state;
	struct surface s, o;
	assert_int_equal(make_torus(&s, vec3(0, 0, 0), 4, 1.5), ST_OK);
	check(&s, 0.75, 1e-8, &o);
	for (int k = 0; k <= 900; k++) {
		struct vec3 p = surface_point(&o, in_range(o.domain[0], k % 31 / 30.0),
		                              in_range(o.domain[1], k / 900.0));
		assert_true(fabs(hypot(hypot(p.x, p.y) - 4, p.z) - 2.25) < 1e-8);
	}
	surface_finish(&o);
	surface_finish(&s);
}

/* Plain spans stay whole: a plane wants no refinement, a cylinder only around. */
static void test_economy(void **state)
{
	(void)state;
	struct surface s, o;
	const struct vec3 corner[4] = { { 0, 0, 0 }, { 2, 0, 1 }, { 0, 3, 0 }, { 2, 3, 1 } };
	assert_int_equal(make_bilinear(&s, corner), ST_OK);
	check(&s, 2, 1e-10, &o);
	assert_true(o.n[0] == 6 && o.n[1] == 6);
	surface_finish(&o);
	surface_finish(&s);
	struct curve arc;
	assert_int_equal(make_arc(&arc, vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0), 3, 0, 2),
	                 ST_OK);
	assert_int_equal(make_cylinder(&s, &arc, vec3(0, 0, 7)), ST_OK);
	check(&s, 2, 1e-10, &o);
	assert_true(o.n[0] > 20 && o.n[1] == 6);
	surface_finish(&o);
	surface_finish(&s);
	curve_finish(&arc);
}

/* A wavy graph, unclamped, with its domain inside the knots'. */
static enum status make_wave(struct surface *s, int order, int twice)
{
	enum { N = 9 };
	enum status st = surface_init(s, (int[]){ order, 4 }, (int[]){ N, N });
	if (st != ST_OK)
		return st;
	for (int i = 0; i < N; i++)
		for (int j = 0; j < N; j++)
			surface_set_point(s, i, j, vec3(i, j, 0.6 * sin(1.1 * i) * cos(0.7 * j)),
			                  1);
	for (int d = 0; d < 2; d++) {
		for (int i = 0; i < N + s->order[d]; i++)
			s->knots[d][i] = i + 0.2 * (i % 3);
		s->domain[d][0] = s->knots[d][4] + 0.1;
		s->domain[d][1] = s->knots[d][N - 1] - 0.1;
	}
	if (twice)
		s->knots[0][6] = s->knots[0][5];
	return ST_OK;
}

static void test_wave(void **state)
{
	(void)state;
	struct surface s, o;
	for (int order = 3; order <= 5; order++) {
		for (int twice = 0; twice <= (order > 3); twice++) {
			assert_int_equal(make_wave(&s, order, twice), ST_OK);
			check(&s, 0.3, 1e-5, &o);
			surface_finish(&o);
			surface_finish(&s);
		}
	}
}

static void test_cone(void **state)
{
	(void)state;
	struct curve line;
	struct surface s, o;
	assert_int_equal(make_line(&line, vec3(0, 0, 0), vec3(3, 0, 4)), ST_OK);
	assert_int_equal(make_revolution(&s, &line, vec3(0, 0, 0), vec3(0, 0, 1), 0, 6), ST_OK);
	check(&s, -0.5, 1e-7, &o); /* N points inward and up */
	/* the tip becomes a circle, as each line of the cone moves by itself */
	for (int i = 0; i <= 20; i++) {
		struct vec3 p = surface_point(&o, 0, 6 * i / 20.0);
		assert_true(fabs(hypot(p.x, p.y) - 0.4) < 1e-6 && fabs(p.z + 0.3) < 1e-6);
	}
	surface_finish(&o);
	double error; /* inside, all radii down to 0 are in the way */
	assert_int_equal(make_offset(&o, &s, 0.5, 1e-7, &error, NULL), ST_INPUT);
	surface_finish(&s);
	curve_finish(&line);
}

static void test_refuses(void **state)
{
	(void)state;
	struct surface s, o;
	struct report_store said;
	double error;
	report_store_init(&said);
	assert_int_equal(make_sphere(&s, vec3(0, 0, 0), 2), ST_OK);
	assert_int_equal(make_offset(&o, &s, -2.5, 1e-3, &error, &said.report), ST_INPUT);
	assert_non_null(strstr(said.error, "radius 2"));
	assert_int_equal(make_offset(&o, &s, 1, 0, &error, &said.report), ST_PARAMETER);
	assert_int_equal(make_offset(&o, &s, NAN, 1, &error, &said.report), ST_PARAMETER);
	assert_int_equal(make_offset(&o, &s, 1, 1e-17, &error, &said.report), ST_PARAMETER);
	surface_finish(&s);

	struct curve bent;
	const struct vec3 p[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 } };
	assert_int_equal(make_polyline(&bent, p, 3), ST_OK);
	assert_int_equal(make_cylinder(&s, &bent, vec3(0, 0, 1)), ST_OK);
	assert_int_equal(make_offset(&o, &s, 0.1, 1e-3, &error, &said.report), ST_INPUT);
	assert_non_null(strstr(said.error, "crease at u 0.5"));
	surface_finish(&s);
	curve_finish(&bent);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_sphere),  cmocka_unit_test(test_torus),
		cmocka_unit_test(test_economy), cmocka_unit_test(test_wave),
		cmocka_unit_test(test_cone),    cmocka_unit_test(test_refuses),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
