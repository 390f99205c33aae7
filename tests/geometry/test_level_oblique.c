/* test_level_oblique.c - isophotes next to 90 degrees, and to 0: known ones, in other forms, and as many as on a grid. */
#include "arbitrary.h"
#include "level_check.h"
#include "level_grid.h"

/* How far from 90 degrees; above 1.15 isophotes are made of squares. */
static const double away[] = { 1e-6, 1e-3, 0.01, 0.1, 1, -1e-3, -0.1, -1.1, -1.2 };
enum { N_AWAY = sizeof away / sizeof *away };

/* The cosine of 90 - degrees. */
static double cosine_beside(double degrees)
{
	return sin(degrees * pi / 180);
}

static struct level_result trace(const struct surface *s, struct vec3 light, double value,
                                 double tolerance)
{
	struct level_result x;
	assert_int_equal(shape_trace(s, LEVEL_ISOPHOTE, light, value, tolerance, &x, NULL), ST_OK);
	assert_int_equal(x.n_undecided, 0);
	assert_true(x.max_error <= tolerance);
	/* lengths are looked at to 1e-9 there */
	for (size_t b = 0; x.length > 1 && b < x.n_branches; b++)
		check_curves(s, &x.branches[b]);
	return x;
}

/* Points of a branch are off the circle about z of that radius and height, and of its like below, by no more than
 * the bound. */
static double off_circle(const struct level_branch *b, struct vec3 z, double radius, double height)
{
	double most = 0;
	for (int k = 0; k < 500; k++) {
		const double t0 = b->space.domain[0], t1 = b->space.domain[1];
		struct vec3 p = curve_point(&b->space, t0 + (t1 - t0) * (k + 0.37) / 500);
		const double h = vec3_dot(p, z);
		const double r = vec3_length(vec3_along(p, -h, z));
		most = fmax(most, hypot(r - radius, h - height));
	}
	return most;
}

static void test_sphere(void **state)
{
	(void)state;
	const struct vec3 light = vec3_unit(vec3(0.3, -0.2, 0.9));
	struct surface s = sphere();
	for (int i = 0; i < N_AWAY; i++)
		for (int k = 0; k < 2; k++) {
			const double c = cosine_beside(away[i]), radius = 2.5 * sqrt(1 - c * c);
			struct level_result x = trace(&s, light, c, k ? 1e-8 : 1e-5);
			assert_int_equal(x.n_branches, 1);
			assert_int_equal(x.n_closed, 1);
			assert_true(fabs(x.length - 2 * pi * radius) < 1e-6);
			assert_true(off_circle(&x.branches[0], light, radius, 2.5 * c) <=
			            x.max_error + 1e-14);
			level_result_finish(&x);
		}
	surface_finish(&s);
}

/* Along the axis: the circles of latitude where the tube's normal has that angle. */
static void test_torus(void **state)
{
	(void)state;
	const struct vec3 axis = { 0, 0, 1 }, other = { 0.3, 0.2, 0.9 };
	struct surface s = torus();
	for (int i = 0; i < N_AWAY; i++) {
		const double c = cosine_beside(away[i]), inside = sqrt(1 - c * c);
		struct level_result x = trace(&s, axis, c, 1e-6);
		assert_int_equal(x.n_branches, 2);
		assert_int_equal(x.n_closed, 2);
		for (int b = 0; b < 2; b++) {
			const bool outer = x.branches[b].length > 6 * pi;
			const double radius = 3 + (outer ? inside : -inside);
			assert_true(fabs(x.branches[b].length - 2 * pi * radius) < 1e-5);
			assert_true(off_circle(&x.branches[b], axis, radius, c) <=
			            x.branches[b].max_error + 1e-14);
		}
		level_result_finish(&x);
		x = trace(&s, other, c, 1e-6);
		assert_int_equal(x.n_closed, 2);
		for (int b = 0; b < 2; b++)
			check_exact(&s, LEVEL_ISOPHOTE, other, c, &x.branches[b], 1e-6, 60);
		level_result_finish(&x);
	}
	surface_finish(&s);
}

/* Both ways to make f meet at one angle, on one surface that is made ready for either. */
static void test_change(void **state)
{
	(void)state;
	struct level_field f = { .kind = LEVEL_ISOPHOTE,
		                 .direction = vec3(0.8, 0.36, 0.48),
		                 .value = 0.02 };
	const struct level_field beyond = { .kind = LEVEL_ISOPHOTE,
		                            .direction = f.direction,
		                            .value = 0.02 + 1e-9 };
	const struct level_field right = { .kind = LEVEL_ISOPHOTE, .direction = f.direction };
	const int order[2] = { 4, 4 }, n[2] = { 9, 9 };
	struct surface s = shape_surface(order, n, false, KNOTS_CLAMPED, 3);
	assert_true(level_oblique(&f));
	assert_false(level_oblique(&beyond));
	assert_false(level_oblique(&right));
	struct count c = count_of(&s, f.kind, f.direction, f.value);
	assert_true(c.branches > 3);
	assert_same(c, count_of(&s, f.kind, f.direction, beyond.value));
	for (int k = 0; k < 3; k++) {
		struct level *first, *like;
		struct level_result x;
		f.value = (const double[]){ 0.5, 0, -0.01 }[k];
		assert_int_equal(level_create(&first, &s, &f, 1e-5, NULL), ST_OK);
		assert_int_equal(level_create_like(&like, first, 0.02, NULL), ST_OK);
		assert_int_equal(shape_trace_level(like, &x, NULL), ST_OK);
		assert_same(c, (struct count){ x.n_branches, x.n_closed, x.n_undecided, x.length });
		level_result_finish(&x);
		level_destroy(like);
		level_destroy(first);
	}
	surface_finish(&s);
}

static void test_forms(void **state)
{
	(void)state;
	const struct vec3 d = { 0.8, 0.36, 0.48 };
	for (int k = 0; k < 4; k++) {
		const int order[2] = { 4, 4 }, n[2] = { 8, 8 };
		const double value = cosine_beside((const double[]){ 0.1, -0.01, 1e-4, 0.9 }[k]);
		struct surface s = shape_surface(order, n, k % 2, KNOTS_CLAMPED, k + 20);
		assert_true(count_of(&s, LEVEL_ISOPHOTE, d, value).branches > 1);
		assert_forms(&s, d, value, 1 + k % 2);
		surface_finish(&s);
	}
}

static const struct {
	int order[2], n[2];
	bool rational;
	enum shape_knots knots;
	uint64_t seed;
	double away[2];
} grid_cases[] = {
	{ { 4, 4 }, { 8, 8 }, false, KNOTS_CLAMPED, 1, { 0.1, -0.001 } },
	{ { 4, 4 }, { 9, 7 }, true, KNOTS_UNEVEN, 2, { 0.01, -0.1 } },
	{ { 3, 5 }, { 8, 8 }, false, KNOTS_OPEN, 3, { 1e-5, 0.5 } },
	{ { 3, 4 }, { 7, 7 }, true, KNOTS_CLAMPED, 4, { 1e-3, -1 } },
	{ { 5, 5 }, { 8, 8 }, true, KNOTS_CLAMPED, 5, { 1e-3, 0.05 } },
	{ { 4, 5 }, { 9, 8 }, false, KNOTS_DOUBLE, 6, { 0.1, -0.01 } },
	{ { 7, 6 }, { 7, 7 }, false, KNOTS_CLAMPED, 7, { 0.02, -1e-4 } },
	{ { 2, 4 }, { 3, 8 }, false, KNOTS_CLAMPED, 8, { 0.1, -0.01 } },
};

static void test_grid(void **state)
{
	(void)state;
	const struct vec3 light = { 0.8, 0.36, 0.48 };
	double *f = malloc(sizeof *f * ROW * ROW), *normal = malloc(sizeof *normal * ROW * ROW);
	int *parent = malloc(sizeof *parent * EDGES);
	assert_true(normal && f && parent);
	for (size_t c = 0; c < sizeof grid_cases / sizeof *grid_cases; c++) {
		struct surface s =
		        shape_surface(grid_cases[c].order, grid_cases[c].n, grid_cases[c].rational,
		                      grid_cases[c].knots, grid_cases[c].seed);
		for (int i = 0; i < ROW * ROW; i++)
			normal[i] = field_at(&s, LEVEL_ISOPHOTE, light, 0,
			                     in_range(s.domain[0], (double)(i / ROW) / GRID),
			                     in_range(s.domain[1], (double)(i % ROW) / GRID));
		for (int k = 0; k < 2; k++) {
			const double value = cosine_beside(grid_cases[c].away[k]);
			for (int i = 0; i < ROW * ROW; i++)
				f[i] = normal[i] - value;
			size_t expected = grid_pieces(f, parent);
			struct count got = count_of(&s, LEVEL_ISOPHOTE, light, value);
			if (got.branches != expected)
				print_error("case %zu, %g from 90: %zu pieces, on the grid %zu\n",
				            c, grid_cases[c].away[k], got.branches, expected);
			assert_int_equal(got.branches, expected);
			assert_int_equal(got.undecided, 0);
		}
		surface_finish(&s);
	}
	free(normal);
	free(f);
	free(parent);
}

/* A small circle about each point whose normal is the light. */
static void test_small(void **state)
{
	(void)state;
	const struct vec3 light = vec3_unit(vec3(0.3, -0.2, 0.9));
	const double degrees[] = { 1e-4, 1e-3, 0.01, 0.1, 179.99, 179.999 };
	struct surface s = sphere(), r = torus();
	for (size_t i = 0; i < sizeof degrees / sizeof *degrees; i++) {
		const double c = cosine(degrees[i]), sine = sqrt((1 - c) * (1 + c));
		const double tolerance = 0.01 * sine;
		struct level_result x = trace(&s, light, c, tolerance);
		assert_int_equal(x.n_branches, 1);
		assert_int_equal(x.n_closed, 1);
		assert_true(fabs(x.length - 5 * pi * sine) < 1e-3 * x.length);
		assert_true(off_circle(&x.branches[0], light, 2.5 * sine, 2.5 * c) <=
		            x.max_error + 1e-14);
		level_result_finish(&x);
		x = trace(&r, light, c, tolerance);
		assert_int_equal(x.n_branches, 2);
		assert_int_equal(x.n_closed, 2);
		/* the torus is nowhere more bent than its tube of radius 1 */
		for (int k = 0; k < 200; k++) {
			const struct curve *at = &x.branches[k % 2].space;
			const double t0 = at->domain[0], t1 = at->domain[1];
			struct vec3 p = curve_point(at, t0 + (t1 - t0) * (k + 0.37) / 200);
			struct vec3 ring = vec3_scale(vec3_unit(vec3(p.x, p.y, 0)), 3);
			struct vec3 n = vec3_unit(vec3_sub(p, ring));
			const double angle = asin(vec3_length(vec3_cross(n, light)));
			assert_true(fabs(angle - asin(sine)) <= x.max_error + 1e-14);
		}
		level_result_finish(&x);
	}
	surface_finish(&r);
	surface_finish(&s);
}

/* As many loops as at an angle that a grid can count. */
static void test_small_many(void **state)
{
	(void)state;
	const struct vec3 light = { 0.1, 0.2, 0.9 };
	double *f = malloc(sizeof *f * ROW * ROW);
	int *parent = malloc(sizeof *parent * EDGES);
	assert_true(f && parent);
	struct surface s = wavy();
	for (int i = 0; i < ROW * ROW; i++)
		f[i] = field_at(&s, LEVEL_ISOPHOTE, light, cosine(6),
		                in_range(s.domain[0], (double)(i / ROW) / GRID),
		                in_range(s.domain[1], (double)(i % ROW) / GRID));
	const size_t loops = grid_pieces(f, parent);
	assert_int_equal(loops, 72);
	for (int k = 0; k < 4; k++) {
		const double degrees = (const double[]){ 1e-4, 1e-3, 0.02, 0.5 }[k];
		struct level_result x;
		assert_int_equal(
		        shape_trace(&s, LEVEL_ISOPHOTE, light, cosine(degrees), 1e-5, &x, NULL),
		        ST_OK);
		assert_int_equal(x.n_branches, loops);
		assert_int_equal(x.n_closed, loops);
		assert_int_equal(x.n_undecided, 0);
		assert_true(x.max_error <= 1e-5);
		level_result_finish(&x);
	}
	surface_finish(&s);
	free(f);
	free(parent);
}

/* Two edges leave a corner along one line, so that its normals are those of a fan: angles beside it are decided there,
 * those in it end in the corner. */
static void test_corner(void **state)
{
	(void)state;
	const double height[3][3] = { { 0, 0, 0.4 }, { 0, 0.7, 0.1 }, { 0.2, 0.9, -0.3 } };
	const struct vec3 light = vec3_unit(vec3(0.1, 0.3, 0.9));
	struct surface s;
	int ended = 0, clear = 0;
	assert_int_equal(surface_init(&s, (const int[2]){ 3, 3 }, (const int[2]){ 3, 3 }), ST_OK);
	for (int d = 0; d < 2; d++)
		for (int i = 0; i < 6; i++)
			s.knots[d][i] = i / 3;
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++)
			surface_set_point(&s, i, j,
			                  vec3(i + 0.5 * j * (1 + (i > 0)),
			                       i * 0.2 * (i - 1) + j * (j - 1) * 0.8 + i * j * 0.5,
			                       height[i][j]),
			                  1);
	assert_int_equal(surface_check(&s, "corner", NULL), ST_OK);
	double lo = 1, hi = -1;
	for (int k = 0; k <= 200; k++) {
		const double a = 0.5 * pi * k / 200;
		const double f =
		        field_at(&s, LEVEL_ISOPHOTE, light, 0, 1e-5 * cos(a), 1e-5 * sin(a));
		lo = fmin(lo, f);
		hi = fmax(hi, f);
	}
	assert_true(hi - lo > 0.1);
	for (int degrees = 1; degrees < 180; degrees += 3) {
		const double value = cosine(degrees);
		struct level_result x;
		if (fabs(value - lo) < 1e-3 || fabs(value - hi) < 1e-3)
			continue;
		assert_int_equal(shape_trace(&s, LEVEL_ISOPHOTE, light, value, 1e-5, &x, NULL),
		                 ST_OK);
		if (value > lo && value < hi) {
			assert_int_equal(x.n_undecided, 1);
			assert_int_equal(x.undecided[0].kind, LEVEL_SINGULAR);
			assert_true(x.undecided[0].ends > 0);
			ended++;
		} else {
			assert_int_equal(x.n_undecided, 0);
			clear++;
		}
		level_result_finish(&x);
	}
	assert_true(ended > 3 && clear > 3);
	surface_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_sphere),     cmocka_unit_test(test_torus),
		cmocka_unit_test(test_change),     cmocka_unit_test(test_forms),
		cmocka_unit_test(test_grid),       cmocka_unit_test(test_small),
		cmocka_unit_test(test_small_many), cmocka_unit_test(test_corner),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
