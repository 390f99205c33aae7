/* test_fit.c - interpolants pass through their points and reproduce what they can. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "arbitrary.h"
#include "construct.h"
#include "fit.h"
#include "refine.h"

static const enum fit_parameters ways[] = { FIT_UNIFORM, FIT_CHORD, FIT_CENTRIPETAL };

/* Parameters by the formula, for comparison. */
static void parameters(const struct vec3 *p, int n, enum fit_parameters how, double *t)
{
	t[0] = 0;
	for (int i = 1; i < n; i++) {
		double d = distance(p[i], p[i - 1]);
		t[i] = t[i - 1] + (how == FIT_UNIFORM ? 1 : how == FIT_CHORD ? d : sqrt(d));
	}
	for (int i = 1; i < n; i++)
		t[i] /= t[n - 1];
}

static void test_curve(void **state)
{
	(void)state;
	static const struct {
		int order, n;
	} cases[] = { { 2, 2 }, { 2, 9 }, { 3, 8 }, { 4, 4 }, { 4, 200 }, { 6, 40 }, { 10, 15 } };
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		int n = cases[i].n;
		struct vec3 p[200];
		double t[200];
		for (int k = 0; k < n; k++) {
			double a = 5.0 * k / n + 0.02 * sin(9.0 * k);
			p[k] = vec3(cos(a), sin(a), 0.3 * a);
		}
		for (int w = 0; w < 3; w++) {
			struct curve c;
			assert_int_equal(fit_curve(&c, p, n, cases[i].order, ways[w], NULL), ST_OK);
			assert_int_equal(curve_check(&c, "fit", NULL), ST_OK);
			assert_true(c.domain[0] == 0 && c.domain[1] == 1);
			parameters(p, n, ways[w], t);
			for (int k = 0; k < n; k++)
				assert_true(distance(curve_point(&c, k == n - 1 ? 1 : t[k]), p[k]) <
				            1e-12);
			curve_finish(&c);
		}
	}
}

/* A straight line by chord parameters is met everywhere; order of convergence on a circle. */
static void test_accuracy(void **state)
{
	(void)state;
	struct vec3 p[65];
	struct curve c;
	for (int i = 0; i < 9; i++)
		p[i] = vec3(i * i, 2 * i * i, 1 - i * i);
	assert_int_equal(fit_curve(&c, p, 9, 5, FIT_CHORD, NULL), ST_OK);
	for (int k = 0; k <= 100; k++) {
		double t = k / 100.0;
		assert_true(distance(curve_point(&c, t), vec3(64 * t, 128 * t, 1 - 64 * t)) <
		            1e-12);
	}
	curve_finish(&c);
	double before = 0;
	for (int n = 16; n <= 64; n *= 2) {
		double worst = 0;
		for (int i = 0; i <= n; i++)
			p[i] = vec3(cos(3.0 * i / n), sin(3.0 * i / n), 0);
		assert_int_equal(fit_curve(&c, p, n + 1, 4, FIT_CHORD, NULL), ST_OK);
		for (int k = 0; k <= 1000; k++)
			worst = fmax(worst, fabs(vec3_length(curve_point(&c, k / 1000.0)) - 1));
		curve_finish(&c);
		assert_true(before == 0 || worst < before / 12); /* order 4: 16 in the limit */
		before = worst;
	}
	assert_true(before < 1e-6);
}

static void test_surface(void **state)
{
	(void)state;
	enum { NU = 14, NV = 9 };
	struct vec3 p[NU * NV];
	for (int w = 0; w < 3; w++) {
		struct surface s;
		for (int i = 0; i < NU; i++)
			for (int j = 0; j < NV; j++)
				p[i * NV + j] = vec3(i, 2 * j, sin(0.4 * i) * cos(0.5 * j));
		/* evenly spaced in x and y, so all three ways are near to one another */
		assert_int_equal(fit_surface(&s, p, NU, NV, (int[]){ 4, 3 }, ways[w], NULL), ST_OK);
		assert_int_equal(surface_check(&s, "fit", NULL), ST_OK);
		if (ways[w] == FIT_UNIFORM) {
			for (int i = 0; i < NU; i++)
				for (int j = 0; j < NV; j++)
					assert_true(distance(surface_point(&s, (double)i / (NU - 1),
					                                   (double)j / (NV - 1)),
					                     p[i * NV + j]) < 1e-12);
		}
		for (int c = 0; c < 4; c++) {
			int i = c & 1 ? NU - 1 : 0, j = c & 2 ? NV - 1 : 0;
			assert_true(distance(surface_get_point(&s, i, j, NULL), p[i * NV + j]) ==
			            0);
		}
		for (int k = 0; k <= 400; k++) { /* near the function everywhere */
			struct vec3 q = surface_point(&s, (k % 20) / 19.0, (k / 20) / 20.0);
			assert_true(fabs(q.z - sin(0.4 * q.x) * cos(0.25 * q.y)) < 0.02);
		}
		surface_finish(&s);
	}
	/* a row that is one point */
	struct surface s;
	for (int i = 0; i < NU; i++)
		for (int j = 0; j < NV; j++)
			p[i * NV + j] = vec3(j * cos(0.3 * i), j * sin(0.3 * i), j * j);
	assert_int_equal(fit_surface(&s, p, NU, NV, (int[]){ 4, 4 }, FIT_CHORD, NULL), ST_OK);
	assert_true(surface_degenerate(&s, 1, 0, 1e-14));
	surface_finish(&s);
}

static void test_loft(void **state)
{
	(void)state;
	struct curve sections[6];
	struct surface s;
	for (int rational = 0; rational < 2; rational++) {
		for (int i = 0; i < 6; i++) {
			if (rational)
				assert_int_equal(make_arc(&sections[i], vec3(0, 0, i),
				                          vec3(1, 0, 0), vec3(0, 1, 0), 1 + 0.1 * i,
				                          0, 2),
				                 ST_OK);
			else
				assert_int_equal(
				        any_curve(&sections[i], 4, 8, false, true, false, 3),
				        ST_OK);
			curve_transform(&sections[i], (double[3][4]){ { 1, 0, 0, 0.1 * i },
			                                              { 0, 1, 0, 0 },
			                                              { 0, 0, 1, i } });
		}
		assert_int_equal(fit_loft(&s, sections, 6, 4, FIT_CHORD, NULL), ST_OK);
		assert_int_equal(surface_check(&s, "loft", NULL), ST_OK);
		assert_true(s.rational == (bool)rational);
		/* equal steps: section i lies at i / 5 */
		for (int i = 0; i < 6; i++) {
			struct curve line;
			assert_int_equal(surface_isoparametric(&line, &s, 1, i == 5 ? 1 : i / 5.0),
			                 ST_OK);
			assert_true(curves_apart(&line, &sections[i], line.domain) < 1e-12);
			curve_finish(&line);
		}
		surface_finish(&s);
		for (int i = 0; i < 6; i++)
			curve_finish(&sections[i]);
	}
}

static void test_refuses(void **state)
{
	(void)state;
	struct vec3 p[16] = { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, 0 }, { 2, 1, 0 }, { 3, 3, 3 } };
	struct curve c;
	struct surface s;
	struct report_store said;
	report_store_init(&said);
	assert_int_equal(fit_curve(&c, p, 5, 4, FIT_CHORD, &said.report), ST_INPUT);
	assert_non_null(strstr(said.error, "points 2 and 3"));
	assert_int_equal(fit_curve(&c, p, 2, 4, FIT_CHORD, &said.report), ST_INPUT);
	assert_int_equal(fit_curve(&c, p, 2, 1, FIT_CHORD, &said.report), ST_PARAMETER);
	p[3].x = NAN;
	assert_int_equal(fit_curve(&c, p + 2, 3, 3, FIT_CHORD, &said.report), ST_INPUT);
	memset(p, 0, sizeof p);
	assert_int_equal(fit_surface(&s, p, 4, 4, (int[]){ 4, 4 }, FIT_CHORD, &said.report),
	                 ST_INPUT);
	assert_int_equal(fit_surface(&s, p, 4, 3, (int[]){ 4, 4 }, FIT_CHORD, &said.report),
	                 ST_INPUT);
	struct curve two[2];
	assert_int_equal(make_line(&two[0], vec3(0, 0, 0), vec3(1, 0, 0)), ST_OK);
	assert_int_equal(make_arc(&two[1], vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0), 1, 0, 1),
	                 ST_OK);
	assert_int_equal(fit_loft(&s, two, 2, 2, FIT_CHORD, &said.report), ST_PARAMETER);
	assert_non_null(strstr(said.error, "section 2"));
	curve_finish(&two[0]);
	curve_finish(&two[1]);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_curve),   cmocka_unit_test(test_accuracy),
		cmocka_unit_test(test_surface), cmocka_unit_test(test_loft),
		cmocka_unit_test(test_refuses),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
