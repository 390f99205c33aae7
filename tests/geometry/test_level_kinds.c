/* test_level_kinds.c - cylinders, eyes, highlight and reflection lines; bounds and marks. */
#include "cmocka_all.h"

#include <string.h>

#include "construct.h"
#include "level_private.h"
#include "level_shapes.h"
#include "refine.h"
#include "shapes.h"

/* ---- the kinds, against formulas on the surface itself ---- */

static struct vec3 normal_at(const struct surface *s, double u, double v, struct vec3 *p)
{
	struct vec3 a, b;
	surface_tangents(s, u, v, p, &a, &b);
	return vec3_unit(vec3_cross(a, b));
}

/* Length by which the ray or line misses what it should meet. */
static double miss(const struct surface *s, const struct level_field *f, double u, double v)
{
	struct vec3 p, n = normal_at(s, u, v, &p), l = vec3_unit(f->direction), c;
	struct vec3 d = vec3_sub(p, f->eye);
	if (f->kind == LEVEL_CYLINDER)
		return vec3_length(vec3_cross(vec3_sub(p, f->point), l)) - f->value;
	if (f->kind == LEVEL_EYE)
		return vec3_dot(n, d);
	if (f->kind == LEVEL_REFLECTION)
		n = vec3_along(d, -2 * vec3_dot(d, n), n);
	c = vec3_cross(n, l);
	return vec3_dot(c, vec3_sub(f->point, p)) / vec3_length(c) - f->value;
}

static const struct level_field fields[] = {
	{ LEVEL_CYLINDER, { 1, 0, 0 }, 0.3, { 0, 5, 0 }, { 0, 0, 0 }, 0 },
	{ LEVEL_CYLINDER, { 1, 2, 0.3 }, 1.3, { 3, 5, 0 }, { 0, 0, 0 }, 0 },
	{ LEVEL_EYE, { 0, 0, 0 }, 0, { 0, 0, 0 }, { 30, 18, 14 }, 0 },
	{ LEVEL_HIGHLIGHT, { 1, 2, 0.3 }, 0, { 3, 5, 10 }, { 0, 0, 0 }, 0 },
	{ LEVEL_HIGHLIGHT, { 1, 2, 0.3 }, 0.5, { 3, 5, 10 }, { 0, 0, 0 }, 0 },
	{ LEVEL_HIGHLIGHT, { 1, 2, 0.3 }, -0.5, { 3, 5, 10 }, { 0, 0, 0 }, 0 },
	{ LEVEL_REFLECTION, { 1, 0.2, 0.3 }, 0, { 3, 5, 10 }, { 20, -10, 15 }, 0 },
};

static void trace(const struct surface *s, const struct level_field *f, double tolerance,
                  struct level_result *x)
{
	struct level *l;
	assert_int_equal(level_create(&l, s, f, tolerance, NULL), ST_OK);
	assert_int_equal(shape_trace_level(l, x, NULL), ST_OK);
	level_destroy(l);
}

static void test_kinds(void **state)
{
	(void)state;
	struct surface s[2];
	assert_int_equal(shape_make(&s[0], 4, 14, shape_wavy), ST_OK);
	s[1] = shape_surface((const int[2]){ 3, 4 }, (const int[2]){ 8, 9 }, true, KNOTS_UNEVEN, 5);
	for (int k = 0; k < 2; k++) {
		for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
			struct level_result x;
			trace(&s[k], &fields[i], 1e-6, &x);
			assert_int_equal(x.n_undecided, 0);
			assert_true(k == 1 || x.n_branches > 0);
			assert_true(x.max_error <= 1.01e-6);
			for (size_t b = 0; b < x.n_branches; b++)
				for (int j = 0; j < 50; j++) {
					const struct curve *c = &x.branches[b].uv;
					struct vec3 q =
					        curve_point(c, c->domain[1] * (j + 0.5) / 50);
					/* a normal turns the far line by much: 1e-3 of slack */
					assert_true(fabs(miss(&s[k], &fields[i], q.x, q.y)) < 1e-3);
				}
			level_result_finish(&x);
		}
		surface_finish(&s[k]);
	}
}

/* Counted elsewhere on a 3001 x 3001 grid by changes of sign. */
static void test_counts(void **state)
{
	(void)state;
	struct surface s;
	struct level_result x;
	size_t pieces = 0, open = 0;
	assert_int_equal(shape_make(&s, 4, 30, shape_wavy), ST_OK);
	for (int k = 0; k < 10; k++) {
		struct level_field f = fields[0];
		f.value = 0.3 + 0.45 * k;
		trace(&s, &f, 1e-5, &x);
		assert_int_equal(x.n_undecided, 0);
		pieces += x.n_branches;
		open += x.n_branches - x.n_closed;
		level_result_finish(&x);
	}
	assert_int_equal(pieces, 20);
	assert_int_equal(open, 20);
	trace(&s, &fields[2], 1e-5, &x);
	assert_int_equal(x.n_branches, 9);
	assert_int_equal(x.n_closed, 0);
	level_result_finish(&x);
	surface_finish(&s);
}

/* A sphere seen from outside: its outline is a circle; a cylinder about its axis: two circles. */
static void test_sphere(void **state)
{
	(void)state;
	struct surface s = shape_sphere(2.5);
	struct level_field eye = { .kind = LEVEL_EYE, .eye = { 3, 4, 0.5 } };
	struct level_field tube = { .kind = LEVEL_CYLINDER,
		                    .direction = { 0, 0, 3 },
		                    .value = 1.5 };
	struct level_result x;
	trace(&s, &eye, 1e-6, &x);
	double away = vec3_length(eye.eye), r = 2.5 * sqrt(1 - 2.5 * 2.5 / (away * away));
	assert_int_equal(x.n_branches, 1);
	assert_int_equal(x.n_closed, 1);
	assert_true(fabs(x.length - 2 * M_PI * r) < 1e-5);
	level_result_finish(&x);
	trace(&s, &tube, 1e-6, &x);
	assert_int_equal(x.n_branches, 2);
	assert_int_equal(x.n_closed, 2);
	assert_true(fabs(x.length - 2 * 2 * M_PI * 1.5) < 1e-5);
	level_result_finish(&x);
	surface_finish(&s);
}

/* Split, elevated, reparametrised: the same curves. */
static void test_forms(void **state)
{
	(void)state;
	const double knots[] = { 0.31, 0.5 };
	struct surface s, r;
	assert_int_equal(shape_make(&s, 4, 12, shape_wavy), ST_OK);
	for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
		struct level_result x, y;
		trace(&s, &fields[i], 1e-5, &x);
		for (int way = 0; way < 3; way++) {
			if (way == 0)
				assert_int_equal(surface_insert(&r, &s, 0, knots, 2), ST_OK);
			else if (way == 1)
				assert_int_equal(surface_elevate(&r, &s, 1, 1), ST_OK);
			else
				assert_int_equal(surface_copy(&r, &s), ST_OK);
			if (way == 2)
				surface_reparametrise(&r, 1, -3, 40);
			trace(&r, &fields[i], 1e-5, &y);
			assert_int_equal(x.n_branches, y.n_branches);
			assert_int_equal(x.n_closed, y.n_closed);
			assert_true(fabs(x.length - y.length) < 1e-4 * (1 + x.length));
			level_result_finish(&y);
			surface_finish(&r);
		}
		level_result_finish(&x);
	}
	surface_finish(&s);
}

/* ---- bounds ---- */

/* The product of two forms in long double is within the bound of that in double. */
static void test_rounding(void **state)
{
	(void)state;
	enum { M = 5, N = 4, SIZE = (M + 1) * (N + 1), LARGE = (2 * M + 1) * (2 * N + 1) };
	double binomial[(2 * M + 1) * (2 * M + 2) / 2], worst = 0;
	uint64_t seed = 1;
	for (int n = 0; n <= 2 * M; n++)
		for (int k = 0; k <= n; k++)
			binomial[n * (n + 1) / 2 + k] =
			        k == 0 || k == n ? 1
			                         : binomial[n * (n - 1) / 2 + k - 1] +
			                                   binomial[n * (n - 1) / 2 + k];
	for (int trial = 0; trial < 200; trial++) {
		double a[SIZE], b[SIZE], sa[SIZE], sb[SIZE], out[LARGE] = { 0 };
		long double exact[LARGE] = { 0 };
		for (int i = 0; i < SIZE; i++) {
			a[i] = sa[i] = 2 * shape_random(&seed) - 1;
			b[i] = sb[i] = 1e3 + shape_random(&seed);
		}
		form_scale(sa, M, N, binomial, false);
		form_scale(sb, M, N, binomial, false);
		form_product(sa, M, N, sb, M, N, 1, out);
		form_scale(out, 2 * M, 2 * N, binomial, true);
		const double *bm = binomial_row(binomial, M), *bn = binomial_row(binomial, N);
		const double *cm = binomial_row(binomial, 2 * M),
		             *cn = binomial_row(binomial, 2 * N);
		for (int i = 0; i < SIZE; i++)
			for (int j = 0; j < SIZE; j++) {
				int i0 = i / (N + 1), i1 = i % (N + 1), j0 = j / (N + 1),
				    j1 = j % (N + 1);
				exact[(i0 + j0) * (2 * N + 1) + i1 + j1] +=
				        (long double)bm[i0] * bn[i1] * bm[j0] * bn[j1] /
				        (cm[i0 + j0] * cn[i1 + j1]) * a[i] * b[j];
			}
		struct bound x = { form_most(a, SIZE), 0 }, y = { form_most(b, SIZE), 0 };
		struct bound xy = bound_product(x, y, 2 * M, 2 * N);
		for (int i = 0; i < LARGE; i++) {
			double off = (double)fabsl(out[i] - exact[i]);
			assert_true(off <= xy.error);
			assert_true(fabs(out[i]) <= xy.size * (1 + 1e-12));
			worst = fmax(worst, off / xy.error);
		}
	}
	assert_true(worst > 1e-3); /* and the bound says something */
}

/* Distance of p from the circle of radius r about the z axis at height z. */
static double off_circle(struct vec3 p, double r, double z)
{
	return hypot(hypot(p.x, p.y) - r, p.z - z);
}

/* On a sphere the exact curves are circles: dense samples of both curves are within the bound. */
static void test_bound(void **state)
{
	(void)state;
	struct surface s = shape_sphere(2.5);
	double largest = 0;
	for (int k = 0; k < 12; k++) {
		double tolerance = pow(10, -2 - k % 6), z = -2 + 0.37 * k, r = sqrt(6.25 - z * z);
		struct level_field f = { .kind = LEVEL_PLANE,
			                 .direction = { 0, 0, 1 },
			                 .value = z };
		struct level_result x;
		if (k % 2) {
			f.kind = LEVEL_ISOPHOTE;
			f.value = z / 2.5;
		}
		trace(&s, &f, tolerance, &x);
		assert_int_equal(x.n_branches, 1);
		assert_true(x.max_error <= tolerance * 1.0001 + 1e-9);
		const struct level_branch *b = &x.branches[0];
		for (int i = 0; i < 3000; i++) {
			double t = b->uv.domain[1] * (i + 0.5) / 3000;
			struct vec3 uv = curve_point(&b->uv, t);
			double a = off_circle(curve_point(&b->space, t), r, z);
			double c =
			        off_circle(surface_point(&s, fmin(fmax(uv.x, 0), 1), uv.y), r, z);
			assert_true(fmax(a, c) <= b->max_error);
			largest = fmax(largest, fmax(a, c) / b->max_error);
		}
		level_result_finish(&x);
	}
	assert_true(largest > 0.02);
	surface_finish(&s);
}

/* ---- marks ---- */

/* z = x^2 - y^2 + lift as one patch over [-1, 1]^2: a saddle, two branches, or a touch of the
 * border. */
static struct surface saddle(double lift, double sign)
{
	struct surface s;
	assert_int_equal(surface_init(&s, (const int[2]){ 3, 3 }, (const int[2]){ 3, 3 }), ST_OK);
	shape_fill_knots(s.knots[0], 3, 3, KNOTS_CLAMPED);
	shape_fill_knots(s.knots[1], 3, 3, KNOTS_CLAMPED);
	const double square[3] = { 1, -1, 1 };
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++)
			surface_set_point(&s, i, j,
			                  vec3(i - 1, j - 1, square[i] - sign * square[j] + lift),
			                  1);
	assert_int_equal(surface_check(&s, "saddle", NULL), ST_OK);
	return s;
}

static const struct {
	double lift, sign;
	size_t branches, marks;
	enum level_mark kind;
	int ends;
} saddles[] = {
	{ 0, 1, 4, 1, LEVEL_CROSSING, 4 }, { 1e-6, 1, 2, 0, 0, 0 },
	{ -1e-6, 1, 2, 0, 0, 0 },          { 1e-9, 1, 2, 0, 0, 0 },
	{ 0, -1, 0, 1, LEVEL_POINT, 0 },   { 1e-6, -1, 0, 0, 0, 0 },
	{ -1e-6, -1, 1, 0, 0, 0 },
};

static void test_saddles(void **state)
{
	(void)state;
	for (size_t i = 0; i < sizeof saddles / sizeof *saddles; i++) {
		struct surface s = saddle(saddles[i].lift, saddles[i].sign);
		struct level_field f = { .kind = LEVEL_PLANE, .direction = { 0, 0, 1 } };
		struct level_result x;
		trace(&s, &f, 1e-6, &x);
		assert_int_equal(x.n_branches, saddles[i].branches);
		size_t marks = 0;
		for (size_t m = 0; m < x.n_undecided; m++)
			marks += x.undecided[m].kind != LEVEL_GRAZE;
		assert_int_equal(marks, saddles[i].marks);
		if (marks) {
			assert_int_equal(x.undecided[0].kind, saddles[i].kind);
			assert_int_equal(x.undecided[0].ends, saddles[i].ends);
		}
		level_result_finish(&x);
		surface_finish(&s);
	}
}

/* z = 1 - x^2 - y^2 = 0 touches all four borders: each touch is told. */
static void test_graze(void **state)
{
	(void)state;
	struct surface s = saddle(-1, -1);
	struct level_field f = { .kind = LEVEL_PLANE, .direction = { 0, 0, 1 } };
	struct level_result x;
	int sides = 0;
	trace(&s, &f, 1e-6, &x);
	for (size_t m = 0; m < x.n_undecided; m++) {
		const struct level_box *b = &x.undecided[m];
		int side = b->lo[0] == 0   ? 1
		           : b->hi[0] == 1 ? 2
		           : b->lo[1] == 0 ? 4
		           : b->hi[1] == 1 ? 8
		                           : 0;
		assert_true(side != 0);
		sides |= side;
	}
	assert_int_equal(sides, 15);
	assert_true(fabs(x.length - 2 * M_PI) < 1e-5);
	level_result_finish(&x);
	surface_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_kinds),    cmocka_unit_test(test_counts),
		cmocka_unit_test(test_sphere),   cmocka_unit_test(test_forms),
		cmocka_unit_test(test_rounding), cmocka_unit_test(test_bound),
		cmocka_unit_test(test_saddles),  cmocka_unit_test(test_graze),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
