/* test_batch.c - many points at once agree with single ones, however they are split. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "batch.h"
#include "cmocka_all.h"
#include "shapes.h"

enum { ALL = (1u << N_GRID_CHANNELS) - 1, MANY = 40000 };

struct table {
	size_t n;
	double *uv, *out[N_GRID_CHANNELS];
};

/* Random points of the domain, some of them on knots and on its border. */
static void table_init(struct table *t, const struct surface *s, size_t n)
{
	uint64_t seed = 11;
	t->n = n;
	t->uv = malloc(sizeof(double) * 2 * n);
	assert_non_null(t->uv);
	for (int c = 0; c < N_GRID_CHANNELS; c++) {
		t->out[c] = malloc(sizeof(double) * n);
		assert_non_null(t->out[c]);
	}
	for (size_t i = 0; i < 2 * n; i++) {
		const int d = (int)(i % 2);
		const double *ends = s->domain[d];
		const double x = ends[0] + (ends[1] - ends[0]) * shape_random(&seed);
		const double how = shape_random(&seed);
		t->uv[i] = x;
		if (how < 0.1)
			t->uv[i] = s->knots[d][knots_span(s->order[d], s->n[d], s->knots[d], x)];
		if (how < 0.02)
			t->uv[i] = ends[how < 0.01];
		t->uv[i] = fmin(fmax(t->uv[i], ends[0]), ends[1]);
	}
}

static void table_finish(struct table *t)
{
	free(t->uv);
	for (int c = 0; c < N_GRID_CHANNELS; c++)
		free(t->out[c]);
}

static void single_point(const struct surface *s, const double uv[2], double out[N_GRID_CHANNELS])
{
	struct surface_shape p;
	surface_shape(s, uv[0], uv[1], &p);
	memcpy(out, p.value, sizeof p.value);
	memcpy(out + GRID_POINT_X, &p.point, sizeof p.point);
	memcpy(out + GRID_NORMAL_X, &p.normal, sizeof p.normal);
}

static void compare_with_single(const struct surface *s, const char *what, double tolerance)
{
	struct table t;
	table_init(&t, s, 500);
	assert_int_equal(surface_shapes(s, t.uv, t.n, ALL, t.out), ST_OK);
	for (size_t i = 0; i < t.n; i++) {
		double one[N_GRID_CHANNELS];
		single_point(s, t.uv + 2 * i, one);
		const double k = one[QUANTITY_ABSOLUTE], unit = k > 1 ? k * k : 1;
		for (int c = 0; c < N_GRID_CHANNELS; c++) {
			const double x = t.out[c][i];
			if (isnan(one[c]) ? !isnan(x) : !(fabs(x - one[c]) < tolerance * unit))
				fail_msg("%s: channel %d at %.17g, %.17g is %.17g, alone %.17g",
				         what, c, t.uv[2 * i], t.uv[2 * i + 1], x, one[c]);
		}
	}
	table_finish(&t);
}

static void agrees_with_single_points(void **state)
{
	static const int orders[][2] = { { 2, 3 }, { 3, 3 }, { 3, 4 }, { 4, 4 }, { 2, 2 },
		                         { 5, 3 }, { 6, 6 }, { 7, 2 }, { 14, 5 } };
	(void)state;
	for (size_t o = 0; o < sizeof orders / sizeof *orders; o++)
		for (int how = 0; how < N_SHAPE_KNOTS; how++)
			for (int rational = 0; rational < 2; rational++) {
				const int n[2] = { orders[o][0] + 5, orders[o][1] + 3 };
				char what[80];
				struct surface s = shape_surface(orders[o], n, rational, how, 19);
				s.domain[0][0] += 0.1 * (s.domain[0][1] - s.domain[0][0]);
				s.domain[1][1] -= 0.3 * (s.domain[1][1] - s.domain[1][0]);
				snprintf(what, sizeof what, "orders %d, %d, knots %d, rational %d",
				         orders[o][0], orders[o][1], how, rational);
				compare_with_single(&s, what, 1e-9);
				surface_finish(&s);
			}
}

static void poles_have_their_limits(void **state)
{
	(void)state;
	struct surface s = shape_sphere(2.5), torus = shape_torus(3, 1);
	double out[N_GRID_CHANNELS], *channels[N_GRID_CHANNELS];
	for (int c = 0; c < N_GRID_CHANNELS; c++)
		channels[c] = &out[c];
	for (int end = 0; end < 2; end++) {
		const double uv[2] = { 0.3, end };
		assert_int_equal(surface_shapes(&s, uv, 1, ALL, channels), ST_OK);
		assert_true(fabs(out[QUANTITY_GAUSSIAN] - 0.16) < 1e-9);
		assert_true(fabs(out[GRID_NORMAL_Z] - (end ? 1 : -1)) < 1e-9);
		assert_true(fabs(out[GRID_POINT_Z] - (end ? 2.5 : -2.5)) < 1e-15);
	}
	compare_with_single(&s, "sphere", 1e-9);
	compare_with_single(&torus, "torus", 1e-9);
	surface_finish(&s);
	surface_finish(&torus);
}

static void splits_do_not_matter(void **state)
{
	uint64_t seed = 3;
	(void)state;
	for (int k = 0; k < 4; k++) {
		struct surface s =
		        k == 0   ? shape_wave10()
		        : k == 1 ? shape_rat20()
		        : k == 2 ? shape_sphere(1)
		                 : shape_surface((const int[2]){ 9, 3 }, (const int[2]){ 40, 30 },
		                                 true, KNOTS_UNEVEN, 8);
		struct table t, part;
		table_init(&t, &s, MANY);
		table_init(&part, &s, MANY);
		assert_int_equal(surface_shapes(&s, t.uv, MANY, ALL, t.out), ST_OK);
		for (int m = 0; m < 40; m++) {
			const size_t first = (size_t)(shape_random(&seed) * MANY);
			const size_t most = m < 3 ? MANY : 300;
			const size_t left = MANY - first < most ? MANY - first : most;
			const size_t n = (size_t)(shape_random(&seed) * (double)(left + 1));
			const unsigned what = m < 20 ? ALL : 1u << (m % N_GRID_CHANNELS);
			for (int c = 0; c < N_GRID_CHANNELS; c++)
				part.out[c][0] = 42;
			assert_int_equal(surface_shapes(&s, t.uv + 2 * first, n, what, part.out),
			                 ST_OK);
			for (int c = 0; c < N_GRID_CHANNELS; c++)
				if (what & GRID_BIT(c))
					assert_memory_equal(part.out[c], t.out[c] + first,
					                    sizeof(double) * n);
				else
					assert_true(part.out[c][0] == 42);
		}
		table_finish(&t);
		table_finish(&part);
		surface_finish(&s);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(agrees_with_single_points),
		cmocka_unit_test(poles_have_their_limits),
		cmocka_unit_test(splits_do_not_matter),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
