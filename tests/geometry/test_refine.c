/* test_refine.c - refinement leaves the shape in place. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "arbitrary.h"
#include "refine.h"

/* Relative to points in [-2, 2]^3. */
static const double near = 4e-13;

static const struct {
	int order, n;
	bool rational, clamped, inner;
} cases[] = {
	{ 2, 2, false, true, false },   { 2, 9, true, true, false },
	{ 3, 7, true, false, false },   { 4, 4, false, true, false },
	{ 4, 13, false, true, true },   { 4, 13, true, false, true },
	{ 4, 30, false, false, false }, { 6, 17, true, true, false },
	{ 6, 17, true, false, true },   { 11, 24, true, false, false },
	{ 25, 25, true, true, false },  { 26, 26, false, true, false },
	{ 26, 31, true, false, true },
};
enum { N_CASES = sizeof cases / sizeof *cases };

static void make_case(struct curve *c, int i)
{
	assert_int_equal(any_curve(c, cases[i].order, cases[i].n, cases[i].rational,
	                           cases[i].clamped, cases[i].inner, 77 + (uint64_t)i),
	                 ST_OK);
}

static void check_valid(struct curve *c)
{
	double domain[2] = { c->domain[0], c->domain[1] };
	bool rational = c->rational;
	assert_int_equal(curve_check(c, "result", NULL), ST_OK);
	assert_true(c->domain[0] == domain[0] && c->domain[1] == domain[1]);
	assert_true(rational || !c->rational);
}

static int rising(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

static void test_insert(void **state)
{
	(void)state;
	for (int i = 0; i < N_CASES; i++) {
		struct curve c, fine;
		make_case(&c, i);
		double x[64], lo = c.knots[c.order - 1], hi = c.knots[c.n];
		uint64_t seed = 5;
		int m = 0;
		while (m < 12)
			x[m++] = lo + any_number(&seed) * (hi - lo);
		if (c.order > 3) { /* a value twice, an interior knot once more */
			x[m] = x[m - 1];
			m++;
			if (c.n > c.order)
				x[m++] = c.knots[c.order];
		}
		if (!cases[i].clamped) {
			x[m++] = lo;
			x[m++] = hi;
		}
		qsort(x, (size_t)m, sizeof *x, rising);
		assert_int_equal(curve_insert(&fine, &c, x, m), ST_OK);
		assert_int_equal(fine.n, c.n + m);
		check_valid(&fine);
		assert_true(curves_apart(&c, &fine, c.domain) < near);
		curve_finish(&fine);
		curve_finish(&c);
	}
}

static void test_insert_refuses(void **state)
{
	(void)state;
	struct curve c, out;
	assert_int_equal(any_curve(&c, 4, 9, false, true, false, 3), ST_OK);
	double lo = c.domain[0], hi = c.domain[1], mid = (lo + hi) / 2;
	assert_int_equal(curve_insert(&out, &c, (double[]){ lo - 1 }, 1), ST_PARAMETER);
	assert_int_equal(curve_insert(&out, &c, (double[]){ hi + 1 }, 1), ST_PARAMETER);
	assert_int_equal(curve_insert(&out, &c, (double[]){ NAN }, 1), ST_PARAMETER);
	assert_int_equal(curve_insert(&out, &c, (double[]){ hi }, 1), ST_PARAMETER);
	assert_int_equal(curve_insert(&out, &c, (double[]){ hi - 0.1, lo + 0.1 }, 2), ST_PARAMETER);
	assert_int_equal(curve_insert(&out, &c, (double[]){ mid, mid, mid, mid }, 4), ST_PARAMETER);
	assert_int_equal(curve_part(&out, &c, mid, mid), ST_PARAMETER);
	assert_int_equal(curve_part(&out, &c, lo - 1, mid), ST_PARAMETER);
	assert_int_equal(curve_elevate(&out, &c, -1), ST_PARAMETER);
	assert_int_equal(curve_elevate(&out, &c, 23), ST_PARAMETER);
	curve_finish(&c);
}

static void test_part(void **state)
{
	(void)state;
	static const double ranges[][2] = { { 0, 1 }, { 0, 0.4 }, { 0.4, 1 }, { 0.31, 0.32 } };
	for (int i = 0; i < N_CASES; i++) {
		struct curve c, part;
		make_case(&c, i);
		for (int k = 0; k < 4; k++) {
			double a = in_range(c.domain, ranges[k][0]);
			double b = in_range(c.domain, ranges[k][1]);
			assert_int_equal(curve_part(&part, &c, a, b), ST_OK);
			check_valid(&part);
			assert_true(part.knots[0] == a && part.knots[c.order - 1] == a);
			assert_true(part.knots[part.n] == b &&
			            part.knots[part.n + c.order - 1] == b);
			assert_true(curves_apart(&c, &part, part.domain) < near);
			curve_finish(&part);
		}
		if (c.n > c.order && c.knots[c.order] > c.domain[0]) { /* from knot to knot */
			assert_int_equal(curve_part(&part, &c, c.knots[c.order], c.domain[1]),
			                 ST_OK);
			assert_true(curves_apart(&c, &part, part.domain) < near);
			curve_finish(&part);
		}
		curve_finish(&c);
	}
}

static void test_elevate(void **state)
{
	(void)state;
	for (int i = 0; i < N_CASES; i++) {
		for (int t = 0; t <= 3 && cases[i].order + t <= ORDER_MAX; t++) {
			struct curve c, up;
			make_case(&c, i);
			assert_int_equal(curve_elevate(&up, &c, t), ST_OK);
			assert_int_equal(up.order, c.order + t);
			check_valid(&up);
			assert_true(curves_apart(&c, &up, c.domain) < near);
			for (int k = c.order; k < c.n; k++) /* continuity is kept, not more */
				assert_int_equal(
				        knots_multiplicity(up.order, up.n, up.knots, c.knots[k]),
				        knots_multiplicity(c.order, c.n, c.knots, c.knots[k]) + t);
			curve_finish(&up);
			curve_finish(&c);
		}
	}
}

/* A knot `order` times: the two sides have nothing to do with each other. */
static void test_gap(void **state)
{
	(void)state;
	struct curve c, up, part;
	uint64_t seed = 9;
	assert_int_equal(curve_init(&c, 3, 6), ST_OK);
	memcpy(c.knots, (double[]){ 0, 0, 0, 1, 1, 1, 2, 2, 2 }, 9 * sizeof(double));
	any_points(c.points, 6, false, &seed);
	assert_int_equal(curve_check(&c, "gap", NULL), ST_OK);
	assert_int_equal(curve_elevate(&up, &c, 2), ST_OK);
	assert_int_equal(up.n, 10);
	assert_true(curves_apart(&c, &up, (double[2]){ 0, 1 - 1e-9 }) < near);
	assert_true(curves_apart(&c, &up, (double[2]){ 1, 2 }) < near);
	curve_finish(&up);
	assert_int_equal(curve_part(&part, &c, 0.5, 1), ST_OK);
	assert_true(distance(curve_point(&part, 1), curve_get_point(&c, 2, NULL)) == 0);
	curve_finish(&part);
	assert_int_equal(curve_part(&part, &c, 1, 1.5), ST_OK);
	assert_true(distance(curve_point(&part, 1), curve_get_point(&c, 3, NULL)) == 0);
	curve_finish(&part);
	curve_finish(&c);
}

static void test_match(void **state)
{
	(void)state;
	for (int i = 0; i < N_CASES; i++) {
		struct curve a, b, x, y;
		make_case(&a, i);
		make_case(&b, (i + 5) % N_CASES);
		assert_int_equal(curves_match(&x, &y, &a, &b), ST_OK);
		assert_int_equal(x.order, y.order);
		assert_int_equal(x.n, y.n);
		assert_memory_equal(x.knots, y.knots, (size_t)(x.n + x.order) * sizeof *x.knots);
		check_valid(&x);
		check_valid(&y);
		assert_true(curves_apart(&a, &x, a.domain) < near);
		curve_reparametrise(&b, a.domain[0], a.domain[1]);
		assert_true(curves_apart(&b, &y, a.domain) < 10 * near);
		curve_finish(&a);
		curve_finish(&b);
		curve_finish(&x);
		curve_finish(&y);
	}
}

/* Knots that differ by rounding only must not come twice. */
static void test_match_rounding(void **state)
{
	(void)state;
	struct curve a, b, x, y;
	assert_int_equal(any_curve(&a, 4, 20, false, true, false, 1), ST_OK);
	assert_int_equal(curve_copy(&b, &a), ST_OK);
	curve_reparametrise(&b, 1000.1, 1000.7);
	assert_int_equal(curves_match(&x, &y, &a, &b), ST_OK);
	assert_int_equal(x.n, 20);
	assert_int_equal(y.n, 20);
	curve_finish(&a);
	curve_finish(&b);
	curve_finish(&x);
	curve_finish(&y);
}

static void test_move(void **state)
{
	(void)state;
	for (int i = 0; i < N_CASES; i++) {
		struct curve c, moved;
		make_case(&c, i);
		assert_int_equal(curve_copy(&moved, &c), ST_OK);
		curve_reverse(&moved);
		check_valid(&moved);
		assert_true(moved.domain[0] == c.domain[0] && moved.domain[1] == c.domain[1]);
		for (int k = 0; k <= 50; k++) {
			double t = in_range(c.domain, k / 50.0);
			double back = c.domain[0] + c.domain[1] - t;
			back = fmin(fmax(back, c.domain[0]), c.domain[1]);
			assert_true(distance(curve_point(&c, t), curve_point(&moved, back)) <
			            1e-11);
		}
		curve_reparametrise(&moved, 7, 19);
		check_valid(&moved);
		assert_true(moved.domain[0] == 7 && moved.domain[1] == 19);
		assert_true(distance(curve_point(&moved, 7), curve_point(&c, c.domain[1])) < near);

		static const double turn[3][4] = { { 0, -1, 0, 5 },
			                           { 2, 0, 0, 6 },
			                           { 0, 0.5, 1, 7 } };
		struct vec3 p = curve_point(&moved, 10);
		curve_transform(&moved, turn);
		struct vec3 want = vec3(5 - p.y, 6 + 2 * p.x, 7 + 0.5 * p.y + p.z);
		assert_true(distance(curve_point(&moved, 10), want) < near);
		curve_finish(&moved);
		curve_finish(&c);
	}
}

static const struct {
	int order[2], n[2];
	bool rational, clamped, inner;
} surfaces[] = {
	{ { 2, 4 }, { 2, 7 }, false, true, false },  { { 4, 3 }, { 9, 6 }, true, true, true },
	{ { 3, 4 }, { 7, 12 }, true, false, false }, { { 5, 2 }, { 11, 4 }, false, false, true },
	{ { 26, 4 }, { 27, 5 }, true, true, false },
};

static void test_surface(void **state)
{
	(void)state;
	for (size_t i = 0; i < sizeof surfaces / sizeof *surfaces; i++) {
		struct surface s, t;
		assert_int_equal(any_surface(&s, surfaces[i].order, surfaces[i].n,
		                             surfaces[i].rational, surfaces[i].clamped,
		                             surfaces[i].inner, 31 + i),
		                 ST_OK);
		double all[2][2], some[2][2];
		for (int d = 0; d < 2; d++) {
			all[d][0] = s.knots[d][s.order[d] - 1];
			all[d][1] = s.knots[d][s.n[d]];
			some[d][0] = in_range(s.domain[d], 0.1 + 0.2 * d);
			some[d][1] = in_range(s.domain[d], 0.9);
		}
		for (int d = 0; d < 2; d++) {
			double x[2] = { in_range(all[d], 0.3), in_range(all[d], 0.7) };
			assert_int_equal(surface_insert(&t, &s, d, x, 2), ST_OK);
			assert_int_equal(t.n[d], s.n[d] + 2);
			assert_true(surfaces_apart(&s, &t, s.domain) < near);
			surface_finish(&t);
			if (s.order[d] < ORDER_MAX) {
				assert_int_equal(
				        surface_elevate(&t, &s, d, s.order[d] < 24 ? 2 : 0), ST_OK);
				assert_true(surfaces_apart(&s, &t, s.domain) < near);
				surface_finish(&t);
			}
			struct curve line;
			double at = in_range(s.domain[d], 0.37);
			assert_int_equal(surface_isoparametric(&line, &s, d, at), ST_OK);
			check_valid(&line);
			for (int k = 0; k <= 50; k++) {
				double w = in_range(line.domain, k / 50.0);
				struct vec3 p = d == 0 ? surface_point(&s, at, w)
				                       : surface_point(&s, w, at);
				assert_true(distance(curve_point(&line, w), p) < near);
			}
			curve_finish(&line);
			assert_int_equal(surface_isoparametric(&line, &s, d, all[d][1] + 1),
			                 ST_PARAMETER);

			assert_int_equal(surface_copy(&t, &s), ST_OK);
			surface_reverse(&t, d);
			assert_int_equal(surface_check(&t, "reversed", NULL), ST_OK);
			double u = in_range(s.domain[0], 0.25), v = in_range(s.domain[1], 0.6);
			struct vec3 p = surface_point(&s, u, v);
			double r[2] = { u, v };
			r[d] = s.domain[d][0] + s.domain[d][1] - r[d];
			assert_true(distance(surface_point(&t, r[0], r[1]), p) < 1e-11);
			surface_reparametrise(&t, d, -3, 4);
			r[d] = -3 + 7 * (1 - (d == 0 ? 0.25 : 0.6));
			assert_true(distance(surface_point(&t, r[0], r[1]), p) < 1e-11);
			surface_finish(&t);
		}
		assert_int_equal(surface_part(&t, &s, some), ST_OK);
		assert_int_equal(surface_check(&t, "part", NULL), ST_OK);
		assert_true(surfaces_apart(&s, &t, some) < near);
		surface_finish(&t);

		assert_int_equal(surface_copy(&t, &s), ST_OK);
		assert_int_equal(surface_exchange(&t), ST_OK);
		assert_int_equal(surface_check(&t, "exchanged", NULL), ST_OK);
		assert_true(distance(surface_point(&t, some[1][0], some[0][0]),
		                     surface_point(&s, some[0][0], some[1][0])) < near);
		surface_finish(&t);
		surface_finish(&s);
	}
}

/* Many values at once in a wide net. */
static void test_wide(void **state)
{
	(void)state;
	struct surface s, t;
	assert_int_equal(
	        any_surface(&s, (int[]){ 4, 4 }, (int[]){ 400, 300 }, true, true, false, 2), ST_OK);
	double *x = malloc(400 * sizeof *x);
	assert_non_null(x);
	int m = 0;
	for (int i = s.order[0]; i < s.n[0]; i++)
		if (s.knots[0][i] != s.knots[0][i - 1])
			x[m++] = s.knots[0][i];
	assert_int_equal(surface_insert(&t, &s, 0, x, m), ST_OK);
	assert_true(surfaces_apart(&s, &t, s.domain) < near);
	free(x);
	surface_finish(&t);
	surface_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_insert),
		cmocka_unit_test(test_insert_refuses),
		cmocka_unit_test(test_part),
		cmocka_unit_test(test_elevate),
		cmocka_unit_test(test_gap),
		cmocka_unit_test(test_match),
		cmocka_unit_test(test_match_rounding),
		cmocka_unit_test(test_move),
		cmocka_unit_test(test_surface),
		cmocka_unit_test(test_wide),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
