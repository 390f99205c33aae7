/* test_grid.c - grids agree with single points, whatever part of them is asked for. */
#include <math.h>
#include <stdatomic.h>
#include <string.h>

#include "cmocka_all.h"
#include "grid.h"
#include "parallel.h"
#include "shapes.h"

enum { ALL = (1u << N_GRID_CHANNELS) - 1 };

struct table {
	int nu, nv;
	double *u, *v, *out[N_GRID_CHANNELS];
};

static void table_init(struct table *t, const struct surface *s, int nu, int nv)
{
	t->nu = nu;
	t->nv = nv;
	t->u = malloc(sizeof(double) * nu);
	t->v = malloc(sizeof(double) * nv);
	assert_true(t->u && t->v);
	grid_lines(s->domain[0][0], s->domain[0][1], nu, t->u);
	grid_lines(s->domain[1][0], s->domain[1][1], nv, t->v);
	for (int c = 0; c < N_GRID_CHANNELS; c++) {
		t->out[c] = malloc(sizeof(double) * nu * nv);
		assert_non_null(t->out[c]);
	}
}

static void table_finish(struct table *t)
{
	free(t->u);
	free(t->v);
	for (int c = 0; c < N_GRID_CHANNELS; c++)
		free(t->out[c]);
}

static void table_fill(struct table *t, const struct surface *s, int nu, int nv)
{
	struct grid *g;
	table_init(t, s, nu, nv);
	assert_int_equal(grid_create(&g, s, t->u, nu, t->v, nv), ST_OK);
	assert_int_equal(grid_rows(g, ALL, 0, nv, 0, nu, t->out), ST_OK);
	grid_destroy(g);
}

static void single_point(const struct surface *s, double u, double v, double out[N_GRID_CHANNELS])
{
	struct surface_shape p;
	surface_shape(s, u, v, &p);
	memcpy(out, p.value, sizeof p.value);
	memcpy(out + GRID_POINT_X, &p.point, sizeof p.point);
	memcpy(out + GRID_NORMAL_X, &p.normal, sizeof p.normal);
}

static void lines_have_exact_ends(void **state)
{
	double x[7];
	(void)state;
	grid_lines(0.1, 0.7, 7, x);
	assert_true(x[0] == 0.1 && x[6] == 0.7 && fabs(x[3] - 0.4) < 1e-15);
	grid_lines(0.1, 0.7, 1, x);
	assert_true(x[0] == 0.1);
}

static void agrees_with_single_points(void **state)
{
	static const int orders[][2] = { { 2, 3 }, { 3, 4 }, { 4, 4 }, { 5, 3 },
		                         { 6, 6 }, { 7, 2 }, { 14, 5 } };
	(void)state;
	for (size_t o = 0; o < sizeof orders / sizeof *orders; o++)
		for (int how = 0; how < N_SHAPE_KNOTS; how++)
			for (int rational = 0; rational < 2; rational++) {
				const int n[2] = { orders[o][0] + 5, orders[o][1] + 3 };
				struct surface s = shape_surface(orders[o], n, rational, how, 19);
				struct table t;
				double one[N_GRID_CHANNELS];
				s.domain[0][0] += 0.1 * (s.domain[0][1] - s.domain[0][0]);
				table_fill(&t, &s, 37, 11);
				for (int j = 0; j < 11; j++)
					for (int i = 0; i < 37; i++) {
						single_point(&s, t.u[i], t.v[j], one);
						for (int c = 0; c < N_GRID_CHANNELS; c++) {
							double x = t.out[c][37 * j + i];
							double unit = fmax(
							        1, one[QUANTITY_ABSOLUTE] *
							                   one[QUANTITY_ABSOLUTE]);
							if (!(fabs(x - one[c]) < 1e-10 * unit))
								fail_msg(
								        "order %d knots %d rational %d channel %d at %d,%d: %.17g, alone %.17g",
								        orders[o][0], how, rational,
								        c, i, j, x, one[c]);
						}
					}
				table_finish(&t);
				surface_finish(&s);
			}
}

static void tiles_do_not_matter(void **state)
{
	uint64_t seed = 5;
	(void)state;
	for (int k = 0; k < 4; k++) {
		struct surface s =
		        k == 0   ? shape_wave10()
		        : k == 1 ? shape_rat20()
		        : k == 2 ? shape_sphere(1)
		                 : shape_surface((const int[2]){ 9, 3 }, (const int[2]){ 40, 30 },
		                                 true, KNOTS_UNEVEN, 8);
		const int nu = k == 3 ? 23 : 333, nv = 41;
		struct table t, part;
		struct grid *g;
		table_fill(&t, &s, nu, nv);
		table_init(&part, &s, nu, nv);
		assert_int_equal(grid_create(&g, &s, t.u, nu, t.v, nv), ST_OK);
		for (int m = 0; m < 150; m++) {
			const int first = (int)(shape_random(&seed) * nv);
			const int count = 1 + (int)(shape_random(&seed) * (nv - first));
			const int from = (int)(shape_random(&seed) * nu);
			const int width = 1 + (int)(shape_random(&seed) * (nu - from));
			const unsigned what = m < 20 ? ALL : 1u << (m % N_GRID_CHANNELS);
			for (int c = 0; c < N_GRID_CHANNELS; c++)
				part.out[c][0] = part.out[c][(size_t)count * width - 1] = 42;
			assert_int_equal(grid_rows(g, what, first, count, from, width, part.out),
			                 ST_OK);
			for (int c = 0; c < N_GRID_CHANNELS; c++) {
				if (!(what & GRID_BIT(c))) {
					assert_true(part.out[c][0] == 42);
					continue;
				}
				for (int j = 0; j < count; j++)
					assert_memory_equal(part.out[c] + (size_t)j * width,
					                    t.out[c] + (size_t)(first + j) * nu +
					                            from,
					                    sizeof(double) * width);
			}
		}
		grid_destroy(g);
		table_finish(&t);
		table_finish(&part);
		surface_finish(&s);
	}
}

static void poles_have_their_limits(void **state)
{
	struct surface s = shape_sphere(2.5);
	struct table t;
	double worst = 0;
	(void)state;
	table_fill(&t, &s, 201, 201);
	for (int j = 0; j < 201; j++)
		for (int i = 0; i < 201; i++) {
			const int at = 201 * j + i;
			const bool pole = j == 0 || j == 200;
			worst = pole ? worst
			             : fmax(worst, fabs(t.out[QUANTITY_GAUSSIAN][at] - 0.16));
			assert_true(fabs(t.out[QUANTITY_GAUSSIAN][at] - 0.16) <
			            (pole ? 1e-9 : 3e-13));
			for (int q = QUANTITY_KMAX; q < N_QUANTITIES; q++)
				assert_true(fabs(t.out[q][at] + 0.4) < 1e-8);
			if (pole)
				assert_true(fabs(t.out[GRID_NORMAL_Z][at] - (j ? 1 : -1)) < 1e-12);
		}
	assert_true(worst < 3e-13);
	/* one normal for the whole of a pole, to the bit */
	for (int i = 1; i < 201; i++)
		assert_true(t.out[GRID_NORMAL_X][i] == t.out[GRID_NORMAL_X][0]);
	table_finish(&t);
	surface_finish(&s);
}

static void known_sums_of_curvature(void **state)
{
	static const double expected[2] = { -16329.3385, -12449.7708 };
	(void)state;
	for (int k = 0; k < 2; k++) {
		struct surface s = k ? shape_rat20() : shape_wave10();
		struct table t;
		double sum = 0;
		table_fill(&t, &s, 1000, 1000);
		for (int i = 0; i < 1000000; i++)
			sum += t.out[QUANTITY_GAUSSIAN][i];
		assert_true(fabs(sum - expected[k]) < 5e-5);
		table_finish(&t);
		surface_finish(&s);
	}
}

static void no_surface_gives_nan(void **state)
{
	struct surface s = shape_surface((const int[2]){ 4, 3 }, (const int[2]){ 6, 5 }, false,
	                                 KNOTS_CLAMPED, 3);
	struct table t;
	(void)state;
	for (int i = 0; i < 30; i++)
		surface_set_point(&s, i / 5, i % 5, vec3(i, 2 * i, -i), 1);
	table_fill(&t, &s, 30, 20);
	for (int i = 0; i < 600; i++) {
		assert_true(isnan(t.out[QUANTITY_MEAN][i]) && isnan(t.out[GRID_NORMAL_X][i]));
		assert_true(isfinite(t.out[GRID_POINT_X][i]));
	}
	table_finish(&t);
	surface_finish(&s);
}

static void one_line_and_one_point(void **state)
{
	struct surface s = shape_rat20();
	struct table t;
	(void)state;
	table_fill(&t, &s, 1, 50);
	assert_true(fabs(t.out[GRID_POINT_X][0]) < 1e-14);
	table_finish(&t);
	table_fill(&t, &s, 50, 1);
	assert_true(fabs(t.out[GRID_POINT_X][49] - 10) < 1e-14);
	table_finish(&t);
	table_fill(&t, &s, 1, 1);
	assert_true(fabs(t.out[GRID_POINT_X][0]) < 1e-14);
	table_finish(&t);
	surface_finish(&s);
}

struct threaded {
	struct grid *g;
	struct table *t;
};

static enum status row_unit(void *data, size_t unit, int thread)
{
	struct threaded *x = data;
	double *out[N_GRID_CHANNELS];
	(void)thread;
	for (int c = 0; c < N_GRID_CHANNELS; c++)
		out[c] = x->t->out[c] + unit * x->t->nu;
	return grid_rows(x->g, ALL, (int)unit, 1, 0, x->t->nu, out);
}

static void threads_share_a_grid(void **state)
{
	struct surface s = shape_torus(3, 1);
	struct table t, again;
	struct threaded x = { .t = &again };
	(void)state;
	table_fill(&t, &s, 100, 60);
	table_init(&again, &s, 100, 60);
	assert_int_equal(grid_create(&x.g, &s, t.u, 100, t.v, 60), ST_OK);
	assert_int_equal(parallel_run(4, 60, NULL, row_unit, &x), ST_OK);
	for (int c = 0; c < N_GRID_CHANNELS; c++)
		assert_memory_equal(t.out[c], again.out[c], sizeof(double) * 6000);
	grid_destroy(x.g);
	grid_destroy(NULL);
	table_finish(&t);
	table_finish(&again);
	surface_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(lines_have_exact_ends),
		cmocka_unit_test(agrees_with_single_points),
		cmocka_unit_test(tiles_do_not_matter),
		cmocka_unit_test(poles_have_their_limits),
		cmocka_unit_test(known_sums_of_curvature),
		cmocka_unit_test(no_surface_gives_nan),
		cmocka_unit_test(one_line_and_one_point),
		cmocka_unit_test(threads_share_a_grid),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
