/* test_curve.c - curves: checks, points and derivatives, lengths, curvature and torsion. */
#include <math.h>
#include <string.h>

#include "cmocka_all.h"
#include "curve.h"
#include "shapes.h"

/* Point by de Boor's recursion in long double, for comparison. */
static struct vec3 plain_point(const struct curve *c, double t)
{
	long double q[ORDER_MAX][4];
	const int p = c->order - 1;
	const int s = knots_domain_span(c->order, c->n, c->knots, c->domain, t);
	for (int i = 0; i <= p; i++)
		for (int m = 0; m < 4; m++)
			q[i][m] = c->points[4 * (s - p + i) + m];
	for (int r = 1; r <= p; r++)
		for (int i = p; i >= r; i--) {
			long double lo = c->knots[s - p + i], hi = c->knots[i + 1 + s - r];
			long double a = (t - lo) / (hi - lo);
			for (int m = 0; m < 4; m++)
				q[i][m] = (1 - a) * q[i - 1][m] + a * q[i][m];
		}
	return vec3((double)(q[p][0] / q[p][3]), (double)(q[p][1] / q[p][3]),
	            (double)(q[p][2] / q[p][3]));
}

static double distance(struct vec3 a, struct vec3 b)
{
	return vec3_length(vec3_sub(a, b));
}

static void points_agree_with_de_boor(void **state)
{
	(void)state;
	for (int order = ORDER_MIN; order <= ORDER_MAX; order += order < 8 ? 1 : 6)
		for (int how = 0; how < N_SHAPE_KNOTS; how++)
			for (int rational = 0; rational < 2; rational++) {
				const int n = order + 7;
				struct curve c = shape_curve(order, n, rational, how, 5);
				for (int i = 0; i <= 40; i++) {
					double t =
					        c.domain[0] + (c.domain[1] - c.domain[0]) * i / 40;
					struct vec3 p = plain_point(&c, t), d[3];
					curve_derivatives(&c, t, 2, d);
					assert_true(distance(curve_point(&c, t), p) < 1e-13 * n);
					assert_true(distance(d[0], p) < 1e-13 * n);
				}
				curve_finish(&c);
			}
}

/* Sixth-order central difference of derivative k - 1. */
static struct vec3 difference(const struct curve *c, double t, int k, double h)
{
	static const double weight[4] = { 0, 45.0 / 60, -9.0 / 60, 1.0 / 60 };
	struct vec3 sum = vec3(0, 0, 0), d[16];
	for (int i = -3; i <= 3; i++) {
		if (i == 0)
			continue;
		curve_derivatives(c, t + i * h, k - 1, d);
		sum = vec3_along(sum, (i > 0 ? 1 : -1) * weight[abs(i)] / h, d[k - 1]);
	}
	return sum;
}

static void derivatives_agree_with_differences(void **state)
{
	(void)state;
	for (int order = 2; order <= 9; order++)
		for (int rational = 0; rational < 2; rational++) {
			struct curve c =
			        shape_curve(order, order + 3, rational, KNOTS_UNEVEN, 11 + order);
			struct vec3 d[7];
			double t = 0.5 * (c.knots[order] + c.knots[order - 1]);
			double h = 0.02 * (c.knots[order] - c.knots[order - 1]);
			curve_derivatives(&c, t, 6, d);
			for (int k = 1; k <= 6; k++) {
				if (!rational && k >= order)
					assert_true(vec3_length(d[k]) == 0);
				struct vec3 e = difference(&c, t, k, h);
				assert_true(distance(d[k], e) <=
				            3e-6 * (vec3_length(d[k]) + vec3_length(d[k - 1]) / h));
			}
			curve_finish(&c);
		}
}

static struct curve circle(double radius)
{
	double x[9], y[9], w[9], k[12];
	struct curve c;
	assert_int_equal(curve_init(&c, 3, 9), ST_OK);
	shape_circle(x, y, w, k);
	memcpy(c.knots, k, sizeof k);
	for (int i = 0; i < 9; i++)
		curve_set_point(&c, i, vec3(radius * x[i], radius * y[i], 1), w[i]);
	assert_int_equal(curve_check(&c, "circle", NULL), ST_OK);
	return c;
}

static void circle_is_exact(void **state)
{
	struct curve c = circle(2);
	struct curve_shape shape;
	(void)state;
	assert_true(c.rational);
	assert_true(curve_closed(&c, 0));
	for (int i = 0; i <= 100; i++) {
		curve_shape(&c, i / 100.0, &shape);
		assert_true(fabs(hypot(shape.point.x, shape.point.y) - 2) < 1e-15 * 4);
		assert_true(fabs(shape.curvature - 0.5) < 1e-13);
		assert_true(fabs(shape.torsion) < 1e-11);
		assert_false(shape.limit);
	}
	assert_true(fabs(curve_length(&c, 0, 1, 1e-13) - 4 * M_PI) < 1e-12);
	assert_true(fabs(curve_length(&c, 0.25, 0.5, 1e-13) - M_PI) < 1e-12);
	curve_finish(&c);
}

static struct curve bezier(int order, const double (*p)[3])
{
	struct curve c;
	assert_int_equal(curve_init(&c, order, order), ST_OK);
	for (int i = 0; i < order; i++) {
		c.knots[order + i] = 1;
		curve_set_point(&c, i, vec3(p[i][0], p[i][1], p[i][2]), 1);
	}
	assert_int_equal(curve_check(&c, "bezier", NULL), ST_OK);
	return c;
}

static void shape_table(void **state)
{
	static const struct {
		const char *name;
		int order;
		double p[6][3], t, curvature, torsion;
		bool limit;
	} rows[] = {
		/* (t, t^2, t^3): curvature 2, torsion 3 at 0 */
		{ "twisted cubic",
		  4,
		  { { 0, 0, 0 }, { 1 / 3., 0, 0 }, { 2 / 3., 1 / 3., 0 }, { 1, 1, 1 } },
		  0,
		  2,
		  3,
		  false },
		{ "line", 2, { { 0, 0, 0 }, { 1, 2, 3 } }, 0.5, 0, NAN, false },
		/* (t^2, t^4, 0), a parabola run through at a speed that vanishes */
		{ "parabola from rest",
		  5,
		  { { 0, 0, 0 }, { 0, 0, 0 }, { 1 / 6., 0, 0 }, { 0.5, 0, 0 }, { 1, 1, 0 } },
		  0,
		  2,
		  0,
		  true },
		/* (t^2, t^3, 0): a cusp, the curvature grows without bound */
		{ "cusp",
		  4,
		  { { 0, 0, 0 }, { 0, 0, 0 }, { 1 / 3., 0, 0 }, { 1, 1, 0 } },
		  0,
		  NAN,
		  0,
		  true },
		/* (t, t^3, 0): an inflection has torsion as its plane has */
		{ "inflection",
		  4,
		  { { 0, 0, 0 }, { 1 / 3., 0, 0 }, { 2 / 3., 0, 0 }, { 1, 1, 0 } },
		  0,
		  0,
		  0,
		  false },
		{ "line from rest",
		  4,
		  { { 0, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 }, { 2, 0, 0 } },
		  0,
		  0,
		  NAN,
		  true },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
		struct curve c = bezier(rows[i].order, rows[i].p);
		struct curve_shape s;
		curve_shape(&c, rows[i].t, &s);
		const double got[2] = { s.curvature, s.torsion };
		const double expected[2] = { rows[i].curvature, rows[i].torsion };
		for (int k = 0; k < 2; k++)
			if (isnan(expected[k]) ? !isnan(got[k])
			                       : !(fabs(got[k] - expected[k]) < 1e-7))
				fail_msg("%s: %s is %.17g", rows[i].name,
				         k ? "torsion" : "curvature", got[k]);
		if (s.limit != rows[i].limit)
			fail_msg("%s: limit %d", rows[i].name, s.limit);
		curve_finish(&c);
	}
}

static void checks_table(void **state)
{
	static const struct {
		const char *name;
		int point, component; /* what is spoilt */
		double value, domain[2];
		const char *word; /* NULL: accepted */
	} rows[] = {
		{ "whole", 0, 0, 0, { 0, 0 }, NULL },
		{ "part", 0, 0, 0, { 0.25, 0.5 }, NULL },
		{ "rounding", 0, 0, 0, { -1e-12, 1 }, NULL },
		{ "nan", 2, 1, NAN, { 0, 0 }, "control point 3 is" },
		{ "infinite", 2, 1, INFINITY, { 0, 0 }, "control point 3 is" },
		{ "zero weight", 3, 3, 0, { 0, 0 }, "control point 4 has weight 0" },
		{ "weight below 0", 3, 3, -1, { 0, 0 }, "has weight -1" },
		{ "weight nan", 3, 3, NAN, { 0, 0 }, "has weight nan" },
		{ "turned domain", 0, 0, 0, { 0.5, 0.25 }, "expected from < to" },
		{ "domain outside", 0, 0, 0, { 0.5, 1.25 }, "is not inside" },
		{ "domain nan", 0, 0, 0, { 0.5, NAN }, "domain from" },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
		struct curve c = shape_curve(4, 6, false, KNOTS_CLAMPED, 3);
		struct report_store store;
		report_store_init(&store);
		c.points[4 * rows[i].point + rows[i].component] = rows[i].value;
		memcpy(c.domain, rows[i].domain, sizeof c.domain);
		enum status st = curve_check(&c, "curve 7", &store.report);
		if ((st == ST_OK) != (rows[i].word == NULL))
			fail_msg("%s: status %d", rows[i].name, st);
		if (rows[i].word && !strstr(store.error, rows[i].word))
			fail_msg("%s: said '%s'", rows[i].name, store.error);
		curve_finish(&c);
	}
}

static void equal_weights_count_as_none(void **state)
{
	struct curve c = shape_curve(4, 6, false, KNOTS_CLAMPED, 3);
	struct vec3 before = curve_point(&c, 0.3);
	(void)state;
	for (int i = 0; i < 6; i++)
		curve_set_point(&c, i, curve_get_point(&c, i, NULL), 2);
	assert_int_equal(curve_check(&c, "curve", NULL), ST_OK);
	assert_false(c.rational);
	assert_true(distance(curve_point(&c, 0.3), before) < 1e-15);
	curve_finish(&c);
}

static void copy_is_its_own(void **state)
{
	struct curve a = shape_curve(4, 6, true, KNOTS_OPEN, 3), b;
	(void)state;
	assert_int_equal(curve_copy(&b, &a), ST_OK);
	assert_memory_equal(a.points, b.points, sizeof(double) * 24);
	assert_memory_equal(a.knots, b.knots, sizeof(double) * 10);
	assert_true(b.rational && b.domain[0] == a.domain[0] && b.domain[1] == a.domain[1]);
	curve_finish(&a);
	assert_true(isfinite(curve_point(&b, b.domain[0]).x));
	curve_finish(&b);
	curve_finish(&b);
	curve_finish(NULL);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(points_agree_with_de_boor),
		cmocka_unit_test(derivatives_agree_with_differences),
		cmocka_unit_test(circle_is_exact),
		cmocka_unit_test(shape_table),
		cmocka_unit_test(checks_table),
		cmocka_unit_test(equal_weights_count_as_none),
		cmocka_unit_test(copy_is_its_own),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
