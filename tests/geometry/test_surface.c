/* test_surface.c - surfaces: checks, points and derivatives, borders, size and area. */
#include <math.h>
#include <string.h>

#include "cmocka_all.h"
#include "shapes.h"
#include "surface.h"

static double distance(struct vec3 a, struct vec3 b)
{
	return vec3_length(vec3_sub(a, b));
}

/* Partial derivative of the homogeneous form by plain summing in long double. */
static void plain_homogeneous(const struct surface *s, const double at[2], const int d[2],
                              long double h[4])
{
	double basis[2][ORDER_MAX * ORDER_MAX];
	int first[2];
	for (int e = 0; e < 2; e++) {
		int span =
		        knots_domain_span(s->order[e], s->n[e], s->knots[e], s->domain[e], at[e]);
		knots_basis(s->order[e], s->knots[e], span, at[e], d[e], basis[e]);
		first[e] = span - s->order[e] + 1;
	}
	for (int c = 0; c < 4; c++) {
		h[c] = 0;
		for (int i = 0; i < s->order[0]; i++)
			for (int j = 0; j < s->order[1]; j++)
				h[c] += (long double)basis[0][d[0] * s->order[0] + i] *
				        basis[1][d[1] * s->order[1] + j] *
				        s->points[4 * ((first[0] + i) * s->n[1] + first[1] + j) +
				                  c];
	}
}

static double choose(int n, int k)
{
	double c = 1;
	for (int i = 1; i <= k; i++)
		c = c * (n - k + i) / i;
	return c;
}

/* Leibniz: the derivatives of w S must be those of the homogeneous form. */
static void expect_derivatives(const struct surface *s, double u, double v, int d)
{
	struct vec3 out[8 * 8];
	surface_derivatives(s, u, v, d, out);
	for (int k = 0; k <= d; k++)
		for (int l = 0; k + l <= d; l++) {
			long double expected[4], sum[3] = { 0 };
			double scale = 0;
			plain_homogeneous(s, (const double[2]){ u, v }, (const int[2]){ k, l },
			                  expected);
			for (int i = 0; i <= k; i++)
				for (int j = 0; j <= l; j++) {
					long double w[4];
					plain_homogeneous(s, (const double[2]){ u, v },
					                  (const int[2]){ i, j }, w);
					if (!s->rational)
						w[3] = i + j == 0;
					struct vec3 p = out[(k - i) * (d + 1) + l - j];
					long double f = choose(k, i) * choose(l, j) * w[3];
					sum[0] += f * p.x;
					sum[1] += f * p.y;
					sum[2] += f * p.z;
					scale += fabs((double)f) * vec3_length(p);
				}
			/* high derivatives of high orders are small sums of large terms */
			const long double allowed = s->order[0] > 12 ? 1e-10L : 1e-12L;
			for (int c = 0; c < 3; c++)
				if (!(fabsl(sum[c] - expected[c]) <= allowed * scale))
					fail_msg("order %d,%d at %g,%g: derivative %d,%d",
					         s->order[0], s->order[1], u, v, k, l);
		}
}

static void derivatives_obey_leibniz(void **state)
{
	static const int orders[][2] = { { 2, 2 }, { 2, 4 }, { 4, 4 }, { 3, 3 },
		                         { 6, 6 }, { 5, 3 }, { 9, 7 }, { 26, 2 } };
	(void)state;
	for (size_t o = 0; o < sizeof orders / sizeof *orders; o++)
		for (int how = 0; how < N_SHAPE_KNOTS; how++)
			for (int rational = 0; rational < 2; rational++) {
				const int n[2] = { orders[o][0] + 3, orders[o][1] + 4 };
				struct surface s = shape_surface(orders[o], n, rational, how, 17);
				for (int i = 0; i <= 4; i++)
					for (int j = 0; j <= 4; j++) {
						double u =
						        s.domain[0][0] +
						        (s.domain[0][1] - s.domain[0][0]) * i / 4;
						double v =
						        s.domain[1][0] +
						        (s.domain[1][1] - s.domain[1][0]) * j / 4;
						expect_derivatives(&s, u, v, 4);
					}
				surface_finish(&s);
			}
}

static void short_calls_agree(void **state)
{
	static const int orders[][2] = { { 2, 3 }, { 3, 3 }, { 4, 4 }, { 6, 6 }, { 12, 5 } };
	uint64_t seed = 4;
	(void)state;
	for (size_t o = 0; o < sizeof orders / sizeof *orders; o++)
		for (int rational = 0; rational < 2; rational++) {
			const int n[2] = { orders[o][0] + 5, orders[o][1] + 2 };
			struct surface s = shape_surface(orders[o], n, rational, KNOTS_UNEVEN, 23);
			for (int i = 0; i < 200; i++) {
				double u = i == 0 ? 1 : shape_random(&seed);
				double v = i == 1 ? 1 : shape_random(&seed);
				struct vec3 d[4], p, du, dv;
				surface_derivatives(&s, u, v, 1, d);
				surface_tangents(&s, u, v, &p, &du, &dv);
				assert_true(distance(surface_point(&s, u, v), d[0]) < 2e-14 * n[0]);
				assert_true(distance(p, d[0]) < 2e-14 * n[0]);
				assert_true(distance(du, d[2]) < 1e-12 * vec3_length(du));
				assert_true(distance(dv, d[1]) < 1e-12 * vec3_length(dv));
			}
			surface_finish(&s);
		}
}

static void domain_inside_the_knots(void **state)
{
	struct surface s = shape_surface((const int[2]){ 3, 3 }, (const int[2]){ 8, 8 }, false,
	                                 KNOTS_DOUBLE, 9);
	struct vec3 d[4], left[4];
	(void)state;
	/* u = 1/6 is a double knot: at a domain's upper end the derivative is the left one */
	const double knot = s.knots[0][4];
	assert_true(knot == s.knots[0][5] || s.knots[0][3] == knot);
	surface_derivatives(&s, knot - 1e-9, 0.3, 1, left);
	s.domain[0][1] = knot;
	surface_derivatives(&s, knot, 0.3, 1, d);
	assert_true(distance(d[2], left[2]) < 1e-5);
	s.domain[0][1] = 1;
	surface_derivatives(&s, knot, 0.3, 1, d);
	assert_true(distance(d[2], left[2]) > 1e-2);
	surface_finish(&s);
}

static void borders_and_sizes(void **state)
{
	struct surface sphere = shape_sphere(2.5), torus = shape_torus(3, 1), wave = shape_wave10();
	double error;
	(void)state;
	assert_true(surface_closed(&sphere, 0, 1e-12) && !surface_closed(&sphere, 1, 1e-12));
	assert_true(surface_closed(&torus, 0, 1e-12) && surface_closed(&torus, 1, 1e-12));
	assert_false(surface_closed(&wave, 0, 1e-12));
	assert_true(surface_degenerate(&sphere, 1, 0, 1e-12));
	assert_true(surface_degenerate(&sphere, 1, 1, 1e-12));
	assert_false(surface_degenerate(&sphere, 0, 0, 1e-12));
	assert_false(surface_degenerate(&torus, 1, 1, 1e-12));
	assert_true(surface_size(&sphere) == 5 && surface_size(&torus) == 8);
	double area = surface_area(&sphere, 1e-12, &error);
	assert_true(fabs(area - 25 * M_PI) < 1e-10 && error < 1e-9);
	area = surface_area(&torus, 1e-12, &error);
	assert_true(fabs(area - 12 * M_PI * M_PI) < 1e-10 && error < 1e-9);
	surface_finish(&sphere);
	surface_finish(&torus);
	surface_finish(&wave);
}

static void checks_table(void **state)
{
	static const struct {
		const char *name;
		int point, component;
		double value;
		const char *word; /* NULL: accepted */
	} rows[] = {
		{ "good", 0, 2, 0, NULL },
		{ "nan", 7, 2, NAN, "surface 3: control point 2,3 is" },
		{ "zero weight", 7, 3, 0, "surface 3: control point 2,3 has weight 0" },
		{ "infinite weight", 7, 3, INFINITY, "has weight inf" },
		{ "overflow", 7, 3, 1e-320, "expected numbers" },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
		struct surface s = shape_surface((const int[2]){ 4, 3 }, (const int[2]){ 6, 5 },
		                                 false, KNOTS_CLAMPED, 3);
		struct report_store store;
		report_store_init(&store);
		s.points[4 * rows[i].point + rows[i].component] = rows[i].value;
		enum status st = surface_check(&s, "surface 3", &store.report);
		if ((st == ST_OK) != (rows[i].word == NULL) ||
		    (rows[i].word && !strstr(store.error, rows[i].word)))
			fail_msg("%s: status %d, said '%s'", rows[i].name, st, store.error);
		surface_finish(&s);
	}
	struct surface s = shape_surface((const int[2]){ 4, 3 }, (const int[2]){ 6, 5 }, false,
	                                 KNOTS_CLAMPED, 3);
	struct report_store store;
	report_store_init(&store);
	s.knots[1][3] = 5;
	assert_int_equal(surface_check(&s, "surface 3", &store.report), ST_INPUT);
	assert_non_null(strstr(store.error, "surface 3, v: knot"));
	shape_fill_knots(s.knots[1], 3, 5, KNOTS_CLAMPED);
	for (int i = 0; i < 30; i++)
		surface_set_point(&s, i / 5, i % 5, vec3(1, 2, 3), 1 + i);
	assert_int_equal(surface_check(&s, "surface 3", &store.report), ST_INPUT);
	assert_non_null(strstr(store.error, "all 30 control points are the point 1 2 3"));
	surface_finish(&s);
	surface_finish(NULL);
	assert_int_equal(
	        surface_init(&s, (const int[2]){ 2, 2 }, (const int[2]){ 1 << 30, 1 << 30 }),
	        ST_RESOURCE);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(derivatives_obey_leibniz),
		cmocka_unit_test(short_calls_agree),
		cmocka_unit_test(domain_inside_the_knots),
		cmocka_unit_test(borders_and_sizes),
		cmocka_unit_test(checks_table),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
