/* test_level_laws.c - the same curves for the same shape, and as many as on a grid. */
#include "arbitrary.h"
#include "level_check.h"
#include "level_grid.h"

/* Other forms of the same shape have the same curves. */
static void test_forms(void **state)
{
	(void)state;
	const struct vec3 d = { 0.3, 0.2, 0.9 };
	struct surface s, r;
	assert_int_equal(shape_make(&s, 4, 14, shape_wavy), ST_OK);
	for (int k = 0; k < 3; k++) {
		const double value = cosine(25 + 15 * k);
		struct count c = count_of(&s, LEVEL_ISOPHOTE, d, value);
		assert_true(c.branches > 5);
		assert_forms(&s, d, value, 2);
		r = stretched(&s, 1.0);
		assert_same(c, count_of(&r, LEVEL_ISOPHOTE, d, value));
		surface_finish(&r);
	}
	surface_finish(&s);
}

/* Knots that lie a ten-millionth apart make slivers of patches, whose points' rounding is most of their normals'. */
static void test_slivers(void **state)
{
	(void)state;
	const struct vec3 d = { 0.8, 0.36, 0.48 };
	const double knots[] = { 0.3, 0.3 + 1e-7, 0.3 + 3e-7, 0.62, 0.62 + 1e-7 };
	const int order[2] = { 4, 4 }, n[2] = { 8, 8 };
	struct surface s = shape_surface(order, n, false, KNOTS_CLAMPED, 6), r, q;
	assert_int_equal(surface_insert(&r, &s, 0, knots, 5), ST_OK);
	assert_int_equal(surface_insert(&q, &r, 1, knots, 5), ST_OK);
	for (int k = 0; k < 4; k++) {
		const double value = cosine((const double[]){ 40, 70, 89.9, 90 }[k]);
		struct level_result x;
		struct count c = count_of(&s, LEVEL_ISOPHOTE, d, value);
		assert_int_equal(shape_trace(&q, LEVEL_ISOPHOTE, d, value, 1e-5, &x, NULL), ST_OK);
		assert_same(c, (struct count){ x.n_branches, x.n_closed, x.n_undecided, x.length });
		assert_true(x.max_error <= 1e-5);
		level_result_finish(&x);
	}
	surface_finish(&q);
	surface_finish(&r);
	surface_finish(&s);
}

/* The same shape at the highest orders: the degree of f is 98, rational 88. */
static void test_high_order(void **state)
{
	(void)state;
	const int order[2] = { 4, 4 }, n[2] = { 4, 4 };
	for (int rational = 0; rational < 2; rational++) {
		struct surface s = shape_surface(order, n, rational, KNOTS_CLAMPED, 11), r, q;
		struct count c = count_of(&s, LEVEL_ISOPHOTE, vec3(0, 0, 1), cosine(30));
		int raise = rational ? 12 : 22;
		assert_true(c.branches > 0);
		assert_int_equal(surface_elevate(&r, &s, 0, raise), ST_OK);
		assert_int_equal(surface_elevate(&q, &r, 1, raise), ST_OK);
		assert_same(c, count_of(&q, LEVEL_ISOPHOTE, vec3(0, 0, 1), cosine(30)));
		surface_finish(&q);
		surface_finish(&r);
		surface_finish(&s);
	}
}

static const struct {
	int order[2], n[2];
	bool rational;
	enum shape_knots knots;
	uint64_t seed;
	double degrees[2];
} grid_cases[] = {
	{ { 4, 4 }, { 8, 8 }, false, KNOTS_CLAMPED, 1, { 30, 55 } },
	{ { 4, 4 }, { 9, 7 }, true, KNOTS_UNEVEN, 2, { 25, 45 } },
	{ { 3, 5 }, { 8, 8 }, false, KNOTS_OPEN, 3, { 35, 50 } },
	{ { 3, 4 }, { 7, 7 }, true, KNOTS_CLAMPED, 4, { 30, 90 } },
	{ { 6, 6 }, { 9, 9 }, true, KNOTS_CLAMPED, 5, { 20, 35 } },
	{ { 4, 6 }, { 10, 9 }, false, KNOTS_DOUBLE, 6, { 20, 40 } },
	{ { 9, 8 }, { 9, 8 }, true, KNOTS_CLAMPED, 7, { 15, 25 } },
	{ { 2, 4 }, { 2, 8 }, false, KNOTS_CLAMPED, 8, { 30, 45 } },
};

static void test_grid(void **state)
{
	(void)state;
	const struct vec3 light = { 0.1, 0.2, 1 };
	struct vec3 *normal = malloc(sizeof *normal * ROW * ROW);
	double *f = malloc(sizeof *f * ROW * ROW);
	int *parent = malloc(sizeof *parent * EDGES);
	assert_true(normal && f && parent);
	for (size_t c = 0; c < sizeof grid_cases / sizeof *grid_cases; c++) {
		struct surface s =
		        shape_surface(grid_cases[c].order, grid_cases[c].n, grid_cases[c].rational,
		                      grid_cases[c].knots, grid_cases[c].seed);
		for (int i = 0; i < ROW * ROW; i++) {
			struct vec3 p, su, sv;
			surface_tangents(&s, in_range(s.domain[0], (double)(i / ROW) / GRID),
			                 in_range(s.domain[1], (double)(i % ROW) / GRID), &p, &su,
			                 &sv);
			normal[i] = vec3_unit(vec3_cross(su, sv));
		}
		for (int k = 0; k < 2; k++) {
			double value = cosine(grid_cases[c].degrees[k]);
			for (int i = 0; i < ROW * ROW; i++)
				f[i] = vec3_dot(normal[i], vec3_unit(light)) - value;
			size_t expected = grid_pieces(f, parent);
			struct count got = count_of(&s, LEVEL_ISOPHOTE, light, value);
			if (got.branches != expected)
				print_error("case %zu, %g degrees: %zu pieces, on the grid %zu\n",
				            c, grid_cases[c].degrees[k], got.branches, expected);
			assert_int_equal(got.branches, expected);
			assert_int_equal(got.undecided, 0);
		}
		surface_finish(&s);
	}
	free(normal);
	free(f);
	free(parent);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_forms),
		cmocka_unit_test(test_slivers),
		cmocka_unit_test(test_high_order),
		cmocka_unit_test(test_grid),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
