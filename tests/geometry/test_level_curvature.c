/* test_level_curvature.c - lines of constant curvature: formulas, counts on grids, laws, failures. */
#include "arbitrary.h"
#include "level_check.h"
#include "level_grid.h"

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

/* The curvature along the curves is the value, as the kernel's own formulas have it. */
static void check_values(const struct surface *s, enum quantity quantity, double value,
                         double slack, const struct level_result *x)
{
	for (size_t b = 0; b < x->n_branches; b++) {
		const struct curve *c = &x->branches[b].uv;
		check_curves(s, &x->branches[b]);
		for (int k = 0; k < 50; k++) {
			struct vec3 at = curve_point(c, c->domain[1] * (k + 0.5) / 50);
			struct surface_shape p;
			surface_shape(s, at.x, at.y, &p);
			assert_true(fabs(p.value[quantity] - value) < slack);
		}
	}
}

/* A torus of radii 3 and 1, its normal outwards: at angle a of the small circle the curvatures are -1
 * and -cos a / (3 + cos a). A value gives two circles of radius 3 + cos a, or none. */
static const struct {
	enum quantity quantity;
	double value;
	double cosine; /* 2: none */
} tori[] = {
	{ QUANTITY_GAUSSIAN, 0.1, 1.0 / 3 },
	{ QUANTITY_GAUSSIAN, -0.45, -2.7 / 2.9 },
	{ QUANTITY_GAUSSIAN, 0.26, 2 },
	{ QUANTITY_GAUSSIAN, -0.51, 2 },
	{ QUANTITY_MEAN, -0.45, -0.3 / 1.1 },
	{ QUANTITY_MEAN, -0.2, 2 },
	{ QUANTITY_KMAX, 0.2, -0.5 },
	{ QUANTITY_KMAX, -0.1, 1.0 / 3 },
	{ QUANTITY_KMAX, 0, 0 },
	{ QUANTITY_KMIN, -0.9, 2 },
	{ QUANTITY_NORMAL_U, 0.2, -0.5 },
	{ QUANTITY_NORMAL_V, -0.5, 2 },
};

static void test_torus(void **state)
{
	(void)state;
	struct surface s = torus();
	struct surface_shape p;
	surface_shape(&s, 0.1, 0.1, &p);
	assert_true(p.value[QUANTITY_MEAN] < 0);
	for (size_t i = 0; i < sizeof tori / sizeof *tori; i++) {
		struct level_result x;
		trace(&s, tori[i].quantity, tori[i].value, 1e-6, &x);
		const bool none = tori[i].cosine == 2;
		assert_int_equal(x.n_branches, none ? 0 : 2);
		assert_int_equal(x.n_closed, x.n_branches);
		assert_int_equal(x.n_undecided, 0);
		assert_true(x.max_error <= 1e-6);
		assert_true(fabs(x.length - (none ? 0 : 4 * pi * (3 + tori[i].cosine))) < 1e-5);
		check_values(&s, tori[i].quantity, tori[i].value, 1e-5, &x);
		level_result_finish(&x);
	}
	surface_finish(&s);
}

/* In forms of high degree, whose normals' degree is above that of the polynomial for their length. */
static void test_high(void **state)
{
	(void)state;
	struct surface s = torus(), a, r;
	assert_int_equal(surface_elevate(&a, &s, 0, 8), ST_OK);
	assert_int_equal(surface_elevate(&r, &a, 1, 1), ST_OK);
	for (size_t i = 0; i < sizeof tori / sizeof *tori; i += 4) {
		struct level_result x;
		trace(&r, tori[i].quantity, tori[i].value, 1e-5, &x);
		assert_int_equal(x.n_branches, 2);
		assert_int_equal(x.n_closed, 2);
		assert_int_equal(x.n_undecided, 0);
		assert_true(fabs(x.length - 4 * pi * (3 + tori[i].cosine)) < 1e-4);
		level_result_finish(&x);
	}
	surface_finish(&s);
	surface_finish(&a);
	surface_finish(&r);
}

/* Constant everywhere: nothing, or one region for a value that is reached. */
static void test_constant(void **state)
{
	(void)state;
	struct surface shapes[3] = { sphere(), cylinder(), flat() };
	const double reached[3][2] = { { 0.16, -0.4 }, { 0, -0.25 }, { 0, 0 } };
	for (int k = 0; k < 3; k++) {
		for (int m = 0; m < 2; m++) {
			struct level_result x;
			const enum quantity q = m ? QUANTITY_MEAN : QUANTITY_GAUSSIAN;
			trace(&shapes[k], q, 0.3, 1e-5, &x);
			assert_int_equal(x.n_branches, 0);
			assert_int_equal(x.n_undecided, 0);
			level_result_finish(&x);
			trace(&shapes[k], q, reached[k][m], 1e-5, &x);
			assert_int_equal(x.n_branches, 0);
			assert_int_equal(x.n_undecided, 1);
			assert_int_equal(x.undecided[0].kind, LEVEL_REGION);
			level_result_finish(&x);
		}
		surface_finish(&shapes[k]);
	}
}

static struct surface ellipsoid(void)
{
	const double stretch[3][4] = { { 1.2, 0, 0, 0 }, { 0, 0.8, 0, 0 }, { 0, 0, 0.4, 0 } };
	struct surface s = sphere();
	surface_transform(&s, stretch);
	return s;
}

static struct surface wavy10(void)
{
	struct surface s;
	assert_int_equal(shape_make(&s, 4, 10, shape_wavy), ST_OK);
	return s;
}

static struct surface bent(void)
{
	return shape_surface((const int[2]){ 4, 5 }, (const int[2]){ 7, 8 }, false, KNOTS_UNEVEN,
	                     2);
}

static struct surface weighted(void)
{
	return shape_surface((const int[2]){ 4, 4 }, (const int[2]){ 6, 6 }, true, KNOTS_CLAMPED,
	                     4);
}

/* Counted by changes of sign. A grid cannot tell pieces on an ellipsoid's pole, so its levels stay off
 * it, and a piece over its seam is cut there: counted on the grid with the seam's sides apart. */
static const struct {
	const char *name;
	struct surface (*make)(void);
	double part[2]; /* between the least and the largest value on the grid */
} counted[] = {
	{ "waves", wavy10, { 0.31, 0.65 } },
	{ "bent", bent, { 0.55, 0.77 } },
	{ "weighted", weighted, { 0.4, 0.8 } },
};
static const enum quantity traced[] = { QUANTITY_GAUSSIAN, QUANTITY_MEAN,     QUANTITY_KMAX,
	                                QUANTITY_KMIN,     QUANTITY_NORMAL_U, QUANTITY_NORMAL_V };
enum { N_TRACED = sizeof traced / sizeof *traced };

static void test_grid(void **state)
{
	(void)state;
	double *values[N_QUANTITIES], *f = malloc(sizeof *f * ROW * ROW);
	int *parent = malloc(sizeof *parent * EDGES);
	assert_true(f && parent);
	for (int q = 0; q < N_QUANTITIES; q++)
		assert_non_null(values[q] = malloc(sizeof(double) * ROW * ROW));
	for (size_t c = 0; c < sizeof counted / sizeof *counted; c++) {
		struct surface s = counted[c].make();
		for (int i = 0; i < ROW * ROW; i++) {
			struct surface_shape p;
			surface_shape(&s, in_range(s.domain[0], (double)(i / ROW) / GRID),
			              in_range(s.domain[1], (double)(i % ROW) / GRID), &p);
			for (int q = 0; q < N_QUANTITIES; q++)
				values[q][i] = p.value[q];
		}
		for (int q = 0; q < N_TRACED; q++) {
			double lo = INFINITY, hi = -INFINITY;
			for (int i = 0; i < ROW * ROW; i++) {
				lo = fmin(lo, values[traced[q]][i]);
				hi = fmax(hi, values[traced[q]][i]);
			}
			for (int k = 0; k < 2; k++) {
				const double value = lo + (hi - lo) * counted[c].part[k];
				struct level_result x;
				for (int i = 0; i < ROW * ROW; i++)
					f[i] = values[traced[q]][i] - value;
				const size_t expected = grid_pieces(f, parent);
				trace(&s, traced[q], value, 1e-5, &x);
				if (x.n_branches != expected || x.n_undecided)
					print_error("%s, %s %g: %zu pieces, on the grid %zu, %zu "
					            "undecided\n",
					            counted[c].name, quantity_table[traced[q]].json,
					            value, x.n_branches, expected, x.n_undecided);
				assert_int_equal(x.n_branches, expected);
				assert_int_equal(x.n_undecided, 0);
				assert_true(x.max_error <= 1e-5);
				check_values(&s, traced[q], value, 1e-3 * (hi - lo), &x);
				level_result_finish(&x);
			}
		}
		surface_finish(&s);
	}
	for (int q = 0; q < N_QUANTITIES; q++)
		free(values[q]);
	free(f);
	free(parent);
}

/* Half axes 3, 2, 1: K = 1 / (a b c (x^2 / a^4 + y^2 / b^4 + z^2 / c^4))^2. Near the ends of the
 * longest axis it is largest: a loop about each; below the middle axis' value a loop about each end of
 * the shortest; the poles are there, and one of each pair lies over the seam. */
static void test_ellipsoid(void **state)
{
	(void)state;
	struct surface s = ellipsoid();
	const double at[2] = { 1.2, 0.1 }; /* largest 9 / 4, middle 4 / 9, least 1 / 36 */
	for (int k = 0; k < 2; k++) {
		struct level_result x;
		trace(&s, QUANTITY_GAUSSIAN, at[k], 1e-6, &x);
		assert_int_equal(x.n_branches, 2);
		assert_int_equal(x.n_closed, 2);
		assert_int_equal(x.n_undecided, 0);
		assert_true(x.max_error <= 1e-6);
		for (size_t b = 0; b < 2; b++)
			for (int i = 0; i < 40; i++) {
				const struct curve *c = &x.branches[b].space;
				struct vec3 p = curve_point(c, c->domain[1] * i / 40);
				double g = p.x * p.x / 81 + p.y * p.y / 16 + p.z * p.z;
				assert_true(fabs(1 / (36 * g * g) - at[k]) < 1e-4);
			}
		level_result_finish(&x);
	}
	surface_finish(&s);
}

static void test_wrong(void **state)
{
	(void)state;
	static const struct {
		enum quantity quantity;
		double value;
		int raise;
	} wrong[] = {
		{ QUANTITY_ABSOLUTE, 0.5, 0 },
		{ N_QUANTITIES, 0.5, 0 },
		{ QUANTITY_MEAN, NAN, 0 },
		{ QUANTITY_GAUSSIAN, 0.1, 12 },
	};
	for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
		struct surface s = sphere(), r;
		struct report_store store;
		struct level *l = NULL;
		const struct level_field f = { .kind = LEVEL_CURVATURE,
			                       .quantity = wrong[i].quantity,
			                       .value = wrong[i].value };
		assert_int_equal(surface_elevate(&r, &s, 0, wrong[i].raise), ST_OK);
		report_store_init(&store);
		assert_int_equal(level_create(&l, &r, &f, 1e-5, &store.report), ST_PARAMETER);
		assert_null(l);
		assert_int_equal(store.n_errors, 1);
		surface_finish(&r);
		surface_finish(&s);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_torus),    cmocka_unit_test(test_high),
		cmocka_unit_test(test_constant), cmocka_unit_test(test_ellipsoid),
		cmocka_unit_test(test_grid),     cmocka_unit_test(test_wrong),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
