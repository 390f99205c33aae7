/* test_construct.c - curves and surfaces against the equations they are made from. */
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
		cmocka_unit_test(test_lines),
		cmocka_unit_test(test_arc),
		cmocka_unit_test(test_conic),
		cmocka_unit_test(conics_run_as_the_standard_has_it),
		cmocka_unit_test(test_power_curve),
		cmocka_unit_test(test_power_surface),
		cmocka_unit_test(test_composite),
		cmocka_unit_test(test_ruled),
		cmocka_unit_test(test_swept),
		cmocka_unit_test(test_bodies),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
