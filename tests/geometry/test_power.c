/* test_power.c - curves and surfaces of power bases against their polynomials; composites. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <string.h>

#include "arbitrary.h"
#include "construct.h"
#include "refine.h"

static const double pi = 3.14159265358979323846;

static void check_curve(struct curve *c)
{
	assert_int_equal(curve_check(c, "result", NULL), ST_OK);
}

static void check_surface(struct surface *s)
{
	assert_int_equal(surface_check(s, "result", NULL), ST_OK);
}

static double power(const double a[4], double t)
{
	return a[0] + t * (a[1] + t * (a[2] + t * a[3]));
}

/* Taylor coefficients of x^3 - 2 x^2 + x at b. */
static void cubic_at(double b, double out[4])
{
	out[0] = b * b * b - 2 * b * b + b;
	out[1] = 3 * b * b - 4 * b + 1;
	out[2] = 3 * b - 2;
	out[3] = 1;
}

static void test_power_curve(void **state)
{
	(void)state;
	const double breaks[] = { -1, 0.5, 1, 3, 4 };
	double c[4][3][4] = { 0 };
	for (int i = 0; i < 4; i++) {
		cubic_at(breaks[i], c[i][0]);
		c[i][1][0] = breaks[i];
		c[i][1][1] = 1;
	}
	/* z: a jump of the second derivative at 0.5, of the first at 1, only of the third at 3 */
	static const double z[4][4] = {
		{ 0, 0, 0, 0 }, { 0, 0, 2, 0 }, { 0.5, 0, 1, 0 }, { 4.5, 4, 1, 7 }
	};
	for (int i = 0; i < 4; i++)
		memcpy(c[i][2], z[i], sizeof z[i]);
	struct curve out;
	assert_int_equal(make_power_curve(&out, breaks, 4, c, 1e-6, NULL), ST_OK);
	check_curve(&out);
	assert_int_equal(out.order, 4);
	assert_int_equal(knots_multiplicity(4, out.n, out.knots, 0.5), 2);
	assert_int_equal(knots_multiplicity(4, out.n, out.knots, 1), 3);
	assert_int_equal(knots_multiplicity(4, out.n, out.knots, 3), 1);
	for (int i = 0; i < 4; i++) {
		for (int k = 0; k <= 20; k++) {
			double h = (breaks[i + 1] - breaks[i]) * k / 20;
			struct vec3 want = { power(c[i][0], h), power(c[i][1], h),
				             power(c[i][2], h) };
			assert_true(distance(curve_point(&out, breaks[i] + h), want) < 3e-13);
		}
	}
	curve_finish(&out);

	/* a gap: closed where it is small, else an error that says how wide it is */
	struct report_store said;
	report_store_init(&said);
	c[2][1][0] += 1e-7;
	assert_int_equal(make_power_curve(&out, breaks, 4, c, 1e-6, NULL), ST_OK);
	assert_true(fabs(curve_point(&out, 1).y - (1 + 0.5e-7)) < 1e-14);
	curve_finish(&out);
	assert_int_equal(make_power_curve(&out, breaks, 4, c, 1e-8, &said.report), ST_PARAMETER);
	assert_non_null(strstr(said.error, "segments 2 and 3"));
	assert_int_equal(make_power_curve(&out, (double[]){ 0, 1, 1 }, 2, c, 1, NULL),
	                 ST_PARAMETER);
	c[1][0][2] = NAN;
	assert_int_equal(make_power_curve(&out, breaks, 4, c, 1e-6, NULL), ST_PARAMETER);

	/* straight segments take order 2 */
	static const double straight[2][3][4] = { { { 0, 1 } }, { { 1, 2 } } };
	assert_int_equal(make_power_curve(&out, (double[]){ 0, 1, 2 }, 2, straight, 0, NULL),
	                 ST_OK);
	assert_int_equal(out.order, 2);
	assert_true(curve_point(&out, 1.5).x == 2);
	curve_finish(&out);
}

static void test_power_surface(void **state)
{
	(void)state;
	const double u[] = { 0, 1, 3, 4 }, v[] = { -2, 0, 1 };
	double c[6][3][16] = { 0 };
	for (int i = 0; i < 3; i++) {
		for (int j = 0; j < 2; j++) {
			double(*q)[16] = c[2 * i + j], a[4], b[4];
			cubic_at(u[i], a);
			cubic_at(v[j], b);
			q[0][0] = u[i];
			q[0][1] = 1;
			q[1][0] = v[j];
			q[1][4] = 1;
			for (int k = 0; k < 16; k++)
				q[2][k] = a[k % 4] * b[k / 4];
			if (i == 2) /* a crease over u = 3 */
				q[2][1] += 1;
		}
	}
	struct surface s;
	assert_int_equal(make_power_surface(&s, u, 3, v, 2, c, 1e-9, NULL), ST_OK);
	check_surface(&s);
	assert_int_equal(s.order[0], 4);
	assert_int_equal(knots_multiplicity(4, s.n[0], s.knots[0], 1), 1);
	assert_int_equal(knots_multiplicity(4, s.n[0], s.knots[0], 3), 3);
	assert_int_equal(knots_multiplicity(4, s.n[1], s.knots[1], 0), 1);
	for (int i = 0; i <= 40; i++) {
		for (int j = 0; j <= 30; j++) {
			double x = i / 10.0, y = -2 + j / 10.0, a[4], b[4];
			cubic_at(x, a);
			cubic_at(y, b);
			struct vec3 want = { x, y, a[0] * b[0] + (x > 3 ? x - 3 : 0) };
			assert_true(distance(surface_point(&s, x, y), want) < 1e-12);
		}
	}
	surface_finish(&s);
	c[3][0][0] += 0.5;
	struct report_store said;
	report_store_init(&said);
	assert_int_equal(make_power_surface(&s, u, 3, v, 2, c, 1e-9, &said.report), ST_PARAMETER);
	assert_non_null(strstr(said.error, "apart"));
}

static void test_composite(void **state)
{
	(void)state;
	struct curve part[3], c;
	assert_int_equal(make_line(&part[0], vec3(-3, 2, 0), vec3(1, 2, 0)), ST_OK);
	assert_int_equal(make_arc(&part[1], vec3(1, 0, 0), vec3(0, 1, 0), vec3(1, 0, 0), 2, 0, pi),
	                 ST_OK);
	assert_int_equal(any_curve(&part[2], 5, 9, true, false, true, 4), ST_OK);
	struct vec3 from = curve_point(&part[2], part[2].domain[0]);
	curve_transform(&part[2], (double[3][4]){ { 1, 0, 0, 1 - from.x },
	                                          { 0, 1, 0, -2 - from.y + 1e-9 },
	                                          { 0, 0, 1, -from.z } });
	assert_int_equal(make_composite(&c, part, 3, 1e-8, NULL), ST_OK);
	check_curve(&c);
	assert_int_equal(c.order, 5);
	double start = 0;
	for (int i = 0; i < 3; i++) {
		double length = part[i].domain[1] - part[i].domain[0];
		for (int k = 0; k <= 100; k++) {
			double h = length * k / 100;
			assert_true(distance(curve_point(&c, fmin(start + h, c.domain[1])),
			                     curve_point(&part[i], part[i].domain[0] + h)) < 2e-9);
		}
		start += length;
	}
	assert_true(fabs(c.domain[1] - start) < 1e-14 && c.domain[0] == 0);
	curve_finish(&c);
	struct report_store said;
	report_store_init(&said);
	assert_int_equal(make_composite(&c, part, 3, 1e-10, &said.report), ST_PARAMETER);
	assert_non_null(strstr(said.error, "part 3"));
	assert_int_equal(make_composite(&c, part, 0, 1e-10, &said.report), ST_PARAMETER);
	for (int i = 0; i < 3; i++)
		curve_finish(&part[i]);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_power_curve),
		cmocka_unit_test(test_power_surface),
		cmocka_unit_test(test_composite),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
