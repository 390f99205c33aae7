/* test_conic.c - conics against their equations, and with the parameters of the standard. */
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

/* Value of a conic at p over the sum of its terms' sizes and 1. */
static double conic_residual(const double k[6], struct vec3 p)
{
	double t[6] = { k[0] * p.x * p.x, k[1] * p.x * p.y, k[2] * p.y * p.y,
		        k[3] * p.x,       k[4] * p.y,       k[5] };
	double sum = 0, size = 1;
	for (int i = 0; i < 6; i++) {
		sum += t[i];
		size += fabs(t[i]);
	}
	return fabs(sum) / size;
}

static void test_conic(void **state)
{
	(void)state;
	const double s = sqrt(0.5);
	const struct {
		double k[6];
		struct vec3 p, q, middle; /* middle: a point the arc goes through */
	} cases[] = {
		/* x^2/9 + y^2/4 = 1: quarter, the long way round, whole */
		{ { 4, 0, 9, 0, 0, -36 }, { 3, 0, 0 }, { 0, 2, 0 }, { 3 * s, 2 * s, 0 } },
		{ { 4, 0, 9, 0, 0, -36 }, { 0, 2, 0 }, { 3, 0, 0 }, { -3 * s, -2 * s, 0 } },
		{ { -4, 0, -9, 0, 0, 36 }, { -3, 0, 0 }, { -3, 0, 0 }, { 3, 0, 0 } },
		/* the same turned by 45 degrees and moved to (10, 20) */
		{ { 6.5, -5, 6.5, -130 + 100, 50 - 260, 650 - 1000 + 2600 - 36 },
		  { 10 + 3 * s, 20 + 3 * s, 0 },
		  { 10 - 2 * s, 20 + 2 * s, 0 },
		  { 10 + 0.5, 20 + 2.5, 0 } },
		/* x = y^2 / 4, x y = 1, x^2 - y^2 = 1 */
		{ { 0, 0, 1, -4, 0, 0 }, { 4, 4, 0 }, { 1, -2, 0 }, { 0, 0, 0 } },
		{ { 0, 1, 0, 0, 0, -1 }, { 4, 0.25, 0 }, { 0.5, 2, 0 }, { 1, 1, 0 } },
		{ { 1, 0, -1, 0, 0, -1 }, { sqrt(10), 3, 0 }, { sqrt(2), -1, 0 }, { 1, 0, 0 } },
	};
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		struct curve c;
		assert_int_equal(make_conic(&c, cases[i].k, 7, cases[i].p, cases[i].q, NULL),
		                 ST_OK);
		check_curve(&c);
		struct vec3 p = cases[i].p, q = cases[i].q, m = cases[i].middle;
		p.z = q.z = m.z = 7;
		assert_true(distance(curve_point(&c, c.domain[0]), p) < 1e-13);
		assert_true(distance(curve_point(&c, c.domain[1]), q) < 1e-13);
		double nearest = 1e9;
		for (int k = 0; k <= 4000; k++) {
			struct vec3 at = curve_point(&c, in_range(c.domain, k / 4000.0));
			assert_true(conic_residual(cases[i].k, at) < 1e-14);
			nearest = fmin(nearest, distance(at, m));
		}
		assert_true(nearest < 5e-3);
		curve_finish(&c);
	}
	struct curve c;
	const double hyperbola[6] = { 1, 0, -1, 0, 0, -1 }, nothing[6] = { 1, 0, 1, 0, 0, 1 };
	const double line[6] = { 0, 0, 0, 1, 1, 1 }, ellipse[6] = { 4, 0, 9, 0, 0, -36 };
	struct vec3 right = { 1, 0, 0 }, left = { -1, 0, 0 };
	struct report_store said;
	report_store_init(&said);
	assert_int_equal(make_conic(&c, hyperbola, 0, right, left, &said.report), ST_PARAMETER);
	assert_int_equal(make_conic(&c, hyperbola, 0, right, right, &said.report), ST_PARAMETER);
	assert_int_equal(make_conic(&c, nothing, 0, right, left, &said.report), ST_PARAMETER);
	assert_int_equal(make_conic(&c, line, 0, right, left, &said.report), ST_PARAMETER);
	assert_int_equal(make_conic(&c, ellipse, 0, right, left, &said.report), ST_PARAMETER);
	assert_int_equal(said.n_errors, 5);
}

/* Parameters of conics in standard position, as IGES 5.3 has them: the range, and the point at t, which
 * where t is an angle is met at the ends and in the middle of one piece. */
static void conics_run_as_the_standard_has_it(void **state)
{
	(void)state;
	const double r = 1 / sqrt(2), far = atan(100), wide = 1.4;
	const struct {
		double k[6];
		struct vec3 p, q;
		double domain[2];
		double t;
		struct vec3 at;
	} rows[] = {
		/* x^2/9 + y^2/4 = 1: angles from 0 to 2 pi */
		{ { 4, 0, 9, 0, 0, -36 },
		  { 0, -2, 0 },
		  { 3, 0, 0 },
		  { 1.5 * M_PI, 2 * M_PI },
		  1.75 * M_PI,
		  { 3 * r, -2 * r, 0 } },
		/* y = x^2 / 2, both ways; x = 2 y^2 */
		{ { 1, 0, 0, 0, -2, 0 }, { -1, 0.5, 0 }, { 3, 4.5, 0 }, { -1, 3 }, 2, { 2, 2, 0 } },
		{ { 1, 0, 0, 0, -2, 0 },
		  { 3, 4.5, 0 },
		  { -1, 0.5, 0 },
		  { -3, 1 },
		  -2,
		  { 2, 2, 0 } },
		{ { 0, 0, -2, 1, 0, 0 },
		  { 8, 2, 0 },
		  { 2, 1, 0 },
		  { -2, -1 },
		  -1.5,
		  { 4.5, 1.5, 0 } },
		/* x^2/9 - y^2/4 = 1: 3 sec t, 2 tan t; up, down, the left branch, far out */
		{ { 4, 0, -9, 0, 0, -36 },
		  { 3, 0, 0 },
		  { 3 / r, 2, 0 },
		  { 0, M_PI / 4 },
		  M_PI / 8,
		  { 3 / cos(M_PI / 8), 2 * tan(M_PI / 8), 0 } },
		{ { -4, 0, 9, 0, 0, 36 },
		  { 3 / r, 2, 0 },
		  { 3, 0, 0 },
		  { -M_PI / 4, 0 },
		  -M_PI / 8,
		  { 3 / cos(M_PI / 8), 2 * tan(M_PI / 8), 0 } },
		{ { 4, 0, -9, 0, 0, -36 },
		  { -3, 0, 0 },
		  { -3 / r, 2, 0 },
		  { M_PI, 1.25 * M_PI },
		  1.125 * M_PI,
		  { -3 / cos(M_PI / 8), 2 * tan(M_PI / 8), 0 } },
		{ { 4, 0, -9, 0, 0, -36 },
		  { -3 / r, 2, 0 },
		  { -3, 0, 0 },
		  { -1.25 * M_PI, -M_PI },
		  -1.125 * M_PI,
		  { -3 / cos(M_PI / 8), 2 * tan(M_PI / 8), 0 } },
		{ { 4, 0, -9, 0, 0, -36 },
		  { 3 / cos(far), -200, 0 },
		  { 3 / cos(far), 200, 0 },
		  { -far, far },
		  far / 2,
		  { 3 / cos(far / 2), 2 * tan(far / 2), 0 } },
		/* y^2/4 - x^2/9 = 1: 3 tan t, 2 sec t; rightwards, leftwards below */
		{ { -4, 0, 9, 0, 0, -36 },
		  { 0, 2, 0 },
		  { 3 * tan(wide), 2 / cos(wide), 0 },
		  { 0, wide },
		  wide / 2,
		  { 3 * tan(wide / 2), 2 / cos(wide / 2), 0 } },
		{ { -4, 0, 9, 0, 0, -36 },
		  { 3, -2 / r, 0 },
		  { 0, -2, 0 },
		  { -1.25 * M_PI, -M_PI },
		  -1.125 * M_PI,
		  { 3 * tan(M_PI / 8), -2 / cos(M_PI / 8), 0 } },
	};
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
		struct curve c;
		assert_int_equal(make_conic(&c, rows[i].k, 0, rows[i].p, rows[i].q, NULL), ST_OK);
		check_curve(&c);
		for (int k = 0; k < 2; k++)
			if (!(fabs(c.domain[k] - rows[i].domain[k]) < 1e-14))
				fail_msg("row %zu: domain %.17g %.17g", i, c.domain[0],
				         c.domain[1]);
		const struct vec3 at = curve_point(&c, rows[i].t);
		if (!(distance(at, rows[i].at) < 1e-13 * (1 + vec3_length(rows[i].at))))
			fail_msg("row %zu: %.17g %.17g, expected %.17g %.17g", i, at.x, at.y,
			         rows[i].at.x, rows[i].at.y);
		curve_finish(&c);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_conic),
		cmocka_unit_test(conics_run_as_the_standard_has_it),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
