/* test_level_curvature_forms.c - lines of constant curvature: the same for every form of a shape; jumps. */
#include "level_check.h"

static void trace(const struct surface *s, enum quantity quantity, double value, double tolerance,
                  struct level_result *x)
{
	const struct level_field f = { .kind = LEVEL_CURVATURE,
		                       .quantity = quantity,
		                       .value = value };
	struct level *l;
	assert_int_equal(level_create(&l, s, &f, tolerance, NULL), ST_OK);
	assert_int_equal(shape_trace_level(l, x, NULL), ST_OK);
	level_destroy(l);
}

static struct surface wavy10(void)
{
	struct surface s;
	assert_int_equal(shape_make(&s, 4, 10, shape_wavy), ST_OK);
	return s;
}

static const enum quantity traced[] = { QUANTITY_GAUSSIAN, QUANTITY_MEAN,     QUANTITY_KMAX,
	                                QUANTITY_KMIN,     QUANTITY_NORMAL_U, QUANTITY_NORMAL_V };
enum { N_TRACED = sizeof traced / sizeof *traced };

static struct count count_lines(const struct surface *s, enum quantity quantity, double value)
{
	struct level_result x;
	trace(s, quantity, value, 1e-4, &x);
	struct count c = { x.n_branches, x.n_closed, x.n_undecided, x.length };
	level_result_finish(&x);
	return c;
}

/* Other forms of the same shape have the same lines. */
static void test_forms(void **state)
{
	(void)state;
	const double knots[] = { 0.31, 0.5, 0.77 };
	struct surface s = wavy10(), r;
	for (int q = 0; q < N_TRACED; q++) {
		const bool along = traced[q] == QUANTITY_NORMAL_U || traced[q] == QUANTITY_NORMAL_V;
		struct count c = count_lines(&s, traced[q], 0.16);
		assert_true(c.branches > 1);
		assert_int_equal(c.undecided, 0);
		const int way = q % 2;
		assert_int_equal(surface_insert(&r, &s, way, knots, 3), ST_OK);
		assert_same(c, count_lines(&r, traced[q], 0.16));
		surface_finish(&r);
		assert_int_equal(surface_elevate(&r, &s, 1 - way, 1), ST_OK);
		assert_same(c, count_lines(&r, traced[q], 0.16));
		surface_finish(&r);
		r = stretched(&s, 3.7);
		assert_same(c, count_lines(&r, traced[q], 0.16));
		surface_finish(&r);
		assert_int_equal(surface_copy(&r, &s), ST_OK);
		surface_reparametrise(&r, 0, -3, 100);
		/* exchanged, the normal is turned; and waves up are waves down */
		assert_int_equal(surface_exchange(&r), ST_OK);
		if (!along && traced[q] != QUANTITY_KMAX && traced[q] != QUANTITY_KMIN)
			assert_same(c, count_lines(&r, traced[q],
			                           traced[q] == QUANTITY_MEAN ? -0.16 : 0.16));
		else if (!along)
			assert_same(c, count_lines(&r,
			                           traced[q] == QUANTITY_KMAX ? QUANTITY_KMIN
			                                                      : QUANTITY_KMAX,
			                           -0.16));
		surface_finish(&r);
	}
	surface_finish(&s);
}

/* Curvature jumps at double knots of a cubic: pieces end there. */
static void test_jump(void **state)
{
	(void)state;
	struct surface s = shape_surface((const int[2]){ 4, 4 }, (const int[2]){ 8, 8 }, false,
	                                 KNOTS_DOUBLE, 6);
	struct level_result x;
	int on_line = 0;
	trace(&s, QUANTITY_MEAN, 0.05, 1e-5, &x);
	assert_int_equal(x.n_undecided, 0);
	for (size_t b = 0; b < x.n_branches; b++)
		for (int e = 0; e < 2 && !x.branches[b].closed; e++) {
			const struct curve *c = &x.branches[b].uv;
			const struct vec3 p = curve_get_point(c, e ? c->n - 1 : 0, NULL);
			const double uv[2] = { p.x, p.y };
			for (int d = 0; d < 2; d++)
				for (int i = s.order[d]; i < s.n[d]; i++)
					on_line += uv[d] == s.knots[d][i] &&
					           s.knots[d][i] == s.knots[d][i + 1];
		}
	assert_true(on_line > 0);
	level_result_finish(&x);
	surface_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_forms),
		cmocka_unit_test(test_jump),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
