/* test_bezier.c - Bezier pieces lie where the surface lies and share their borders. */
#include <math.h>
#include <string.h>

#include "bezier.h"
#include "cmocka_all.h"
#include "shapes.h"

static struct vec3 patch_point(const struct bezier_net *b, int i, int j, double x, double y)
{
	double bu[ORDER_MAX], bv[ORDER_MAX], sum[4] = { 0 };
	const double *p = bezier_patch(b, i, j);
	bernstein(b->order[0], x, bu, NULL);
	bernstein(b->order[1], y, bv, NULL);
	for (int k = 0; k < b->order[0]; k++)
		for (int l = 0; l < b->order[1]; l++)
			for (int c = 0; c < 4; c++)
				sum[c] += bu[k] * bv[l] * p[4 * (k * b->order[1] + l) + c];
	return vec3(sum[0] / sum[3], sum[1] / sum[3], sum[2] / sum[3]);
}

static void expect_same_place(const struct surface *s, const struct bezier_net *b)
{
	for (int i = 0; i < b->spans[0]; i++)
		for (int j = 0; j < b->spans[1]; j++)
			for (int k = 0; k < 9; k++) {
				double x = 0.1 + k % 3 * 0.4, y = 0.1 + k / 3 * 0.4;
				double u = b->breaks[0][i] * (1 - x) + b->breaks[0][i + 1] * x;
				double v = b->breaks[1][j] * (1 - y) + b->breaks[1][j + 1] * y;
				struct vec3 p = patch_point(b, i, j, x, y);
				struct vec3 q = surface_point(s, u, v);
				assert_true(vec3_length(vec3_sub(p, q)) < 1e-13 * b->size);
			}
}

static void expect_shared(const struct bezier_net *b, int i, int j, int d, int ni, int nj)
{
	const double *p = bezier_patch(b, i, j), *q = bezier_patch(b, ni, nj);
	const int ou = b->order[0], ov = b->order[1];
	for (int m = 0; m < b->order[1 - d]; m++)
		assert_memory_equal(p + 4 * (d == 0 ? (ou - 1) * ov + m : m * ov + ov - 1),
		                    q + 4 * (d == 0 ? m : m * ov), 4 * sizeof(double));
}

static void expect_net(const struct surface *s, bool exact)
{
	struct bezier_net b;
	assert_int_equal(exact ? bezier_net_init_exact(&b, s) : bezier_net_init(&b, s), ST_OK);
	assert_true(b.breaks[0][0] == s->domain[0][0]);
	assert_true(b.breaks[1][b.spans[1]] == s->domain[1][1]);
	expect_same_place(s, &b);
	for (int i = 0; i < b.spans[0]; i++)
		for (int j = 0; j < b.spans[1]; j++) {
			if (i + 1 < b.spans[0])
				expect_shared(&b, i, j, 0, i + 1, j);
			if (j + 1 < b.spans[1])
				expect_shared(&b, i, j, 1, i, j + 1);
		}
	bezier_net_finish(&b);
	bezier_net_finish(&b);
}

static void nets_lie_on_surfaces(void **state)
{
	static const int orders[][2] = { { 2, 2 }, { 4, 3 }, { 6, 6 }, { 12, 4 }, { 26, 5 } };
	(void)state;
	for (size_t o = 0; o < sizeof orders / sizeof *orders; o++)
		for (int how = 0; how < N_SHAPE_KNOTS; how++)
			for (int part = 0; part < 2; part++) {
				const int n[2] = { orders[o][0] + 4, orders[o][1] + 3 };
				struct surface s = shape_surface(orders[o], n, o % 2, how, 31);
				for (int d = 0; d < 2 && part; d++) {
					double *t = s.domain[d], length = t[1] - t[0];
					t[0] += 0.13 * length;
					t[1] -= 0.37 * length;
				}
				expect_net(&s, false);
				expect_net(&s, true);
				surface_finish(&s);
			}
}

/* The corner of a patch from the knots' blossom, in whole numbers: order 3, spans of 1 and 2 beside ones of a million. */
static void exact_points_are_rounded_once(void **state)
{
	const double knots[] = { 0, 0, 0, 1000003, 1000004, 1000006, 2000017, 2000017, 2000017 };
	const double height[] = { 7, 900001, 900007, 13, 900011, 5 };
	struct surface s;
	struct bezier_net b;
	(void)state;
	assert_int_equal(surface_init(&s, (const int[2]){ 3, 3 }, (const int[2]){ 6, 6 }), ST_OK);
	for (int d = 0; d < 2; d++)
		memcpy(s.knots[d], knots, sizeof knots);
	for (int d = 0; d < 2; d++) {
		s.domain[d][0] = 0;
		s.domain[d][1] = 2000017;
	}
	for (int i = 0; i < 6; i++)
		for (int j = 0; j < 6; j++)
			surface_set_point(&s, i, j, vec3(height[i], height[j], 1), 1);
	assert_int_equal(surface_check(&s, "slender", NULL), ST_OK);
	assert_int_equal(bezier_net_init_exact(&b, &s), ST_OK);
	for (int i = 1; i < b.spans[0]; i++) {
		const double *k = knots + i + 1, *h = height + i; /* the knots about break i */
		const long double start =
		        ((long double)(k[2] - k[1]) * h[0] + (long double)(k[1] - k[0]) * h[1]) /
		        (k[2] - k[0]);
		for (int j = 0; j < b.spans[1]; j++)
			assert_true(fabsl(bezier_patch(&b, i, j)[0] - start) <=
			            1.2e-16L * fabsl(start));
	}
	bezier_net_finish(&b);
	surface_finish(&s);
}

static void closed_ends_are_shared(void **state)
{
	struct surface s = shape_torus(3, 1), sphere = shape_sphere(1);
	struct bezier_net b;
	(void)state;
	s.points[4 * (8 * 9 + 3) + 1] += 1e-12; /* as files have it */
	assert_int_equal(bezier_net_init(&b, &s), ST_OK);
	assert_true(b.closed[0] && b.closed[1]);
	for (int i = 0; i < 4; i++) {
		expect_shared(&b, 3, i, 0, 0, i);
		expect_shared(&b, i, 3, 1, i, 0);
	}
	bezier_net_finish(&b);
	assert_int_equal(bezier_net_init(&b, &sphere), ST_OK);
	assert_true(b.closed[0] && !b.closed[1] && b.rational);
	bezier_net_finish(&b);
	surface_finish(&s);
	surface_finish(&sphere);
}

static void a_break_stays_a_break(void **state)
{
	struct surface s;
	struct bezier_net b;
	(void)state;
	assert_int_equal(surface_init(&s, (const int[2]){ 2, 2 }, (const int[2]){ 4, 2 }), ST_OK);
	memcpy(s.knots[0], (const double[]){ 0, 0, 1, 1, 2, 2 }, 6 * sizeof(double));
	memcpy(s.knots[1], (const double[]){ 0, 0, 1, 1 }, 4 * sizeof(double));
	for (int i = 0; i < 4; i++)
		for (int j = 0; j < 2; j++)
			surface_set_point(&s, i, j, vec3(i, j, i < 2 ? 0 : 5), 1);
	assert_int_equal(surface_check(&s, "broken", NULL), ST_OK);
	assert_int_equal(bezier_net_init(&b, &s), ST_OK);
	expect_same_place(&s, &b);
	assert_true(bezier_patch(&b, 0, 0)[4 * 2 + 2] == 0 && bezier_patch(&b, 1, 0)[2] == 5);
	bezier_net_finish(&b);
	surface_finish(&s);
}

static void chains_lie_on_curves(void **state)
{
	(void)state;
	for (int order = 2; order <= 26; order += 3)
		for (int how = 0; how < N_SHAPE_KNOTS; how++) {
			struct curve c = shape_curve(order, order + 6, order % 2, how, 41);
			struct bezier_chain b;
			double w[ORDER_MAX];
			c.domain[0] += 0.2 * (c.domain[1] - c.domain[0]);
			assert_int_equal(bezier_chain_init(&b, &c), ST_OK);
			for (int i = 0; i < b.spans; i++) {
				const double *p = b.points + 4 * order * i;
				double sum[4] = { 0 };
				bernstein(order, 0.3, w, NULL);
				for (int k = 0; k < 4 * order; k++)
					sum[k % 4] += w[k / 4] * p[k];
				struct vec3 q =
				        curve_point(&c, 0.7 * b.breaks[i] + 0.3 * b.breaks[i + 1]);
				assert_true(fabs(sum[0] / sum[3] - q.x) < 1e-13 * c.n);
				assert_true(fabs(sum[1] / sum[3] - q.y) < 1e-13 * c.n);
				if (i + 1 < b.spans)
					assert_memory_equal(p + 4 * order - 4, p + 4 * order,
					                    4 * sizeof(double));
			}
			bezier_chain_finish(&b);
			bezier_chain_finish(&b);
			curve_finish(&c);
		}
}

static void bernstein_laws(void **state)
{
	(void)state;
	for (int order = 1; order <= 26; order++)
		for (int i = 0; i <= 10; i++) {
			double b[26], d[26], x[26], y[26], sum = 0, slope = 0, t = i / 10.0,
			                                   h = 1e-6;
			bernstein(order, t, b, d);
			bernstein(order, t + h, x, NULL);
			bernstein(order, t - h, y, NULL);
			for (int k = 0; k < order; k++) {
				sum += b[k];
				slope += d[k];
				assert_true(fabs((x[k] - y[k]) / (2 * h) - d[k]) < 1e-6 * order);
			}
			assert_true(fabs(sum - 1) < 1e-14 && fabs(slope) < 1e-13 * order);
		}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(nets_lie_on_surfaces),
		cmocka_unit_test(exact_points_are_rounded_once),
		cmocka_unit_test(closed_ends_are_shared),
		cmocka_unit_test(a_break_stays_a_break),
		cmocka_unit_test(chains_lie_on_curves),
		cmocka_unit_test(bernstein_laws),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
