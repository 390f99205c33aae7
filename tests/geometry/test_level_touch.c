/* test_level_touch.c - levels that are only touched, cross themselves, or cover an area. */
#include "level_check.h"

static const struct {
	const char *name;
	struct surface (*make)(void);
	enum level_kind kind;
	struct vec3 direction;
	double degrees;
	size_t undecided;
	bool flat;
	enum level_mark mark; /* N_LEVEL_MARKS: point or region, as the pole's rounding has it */
} touches[] = {
	{ "a plateau", flat, LEVEL_ISOPHOTE, { 0, 0, 1 }, 0, 1, true, LEVEL_REGION },
	{ "a plateau, slanting",
	  flat,
	  LEVEL_ISOPHOTE,
	  { 0, 0.6, 0.8 },
	  36.869897645844021,
	  1,
	  true,
	  LEVEL_REGION },
	{ "a plane in the plane", flat, LEVEL_PLANE, { 0, 0, 1 }, 1, 1, true, LEVEL_REGION },
	{ "a point of a sphere",
	  sphere,
	  LEVEL_ISOPHOTE,
	  { 0.3, 0.4, 0.8 },
	  0,
	  1,
	  false,
	  LEVEL_POINT },
	{ "its pole", sphere, LEVEL_ISOPHOTE, { 0, 0, 1 }, 0, 1, false, N_LEVEL_MARKS },
	{ "the other pole", sphere, LEVEL_ISOPHOTE, { 0, 0, 1 }, 180, 1, false, N_LEVEL_MARKS },
	{ "the top of a torus", torus, LEVEL_ISOPHOTE, { 0, 0, 1 }, 0, 1, false, LEVEL_REGION },
	{ "a line of a cylinder",
	  cylinder,
	  LEVEL_ISOPHOTE,
	  { 0.6, 0.8, 0 },
	  0,
	  1,
	  false,
	  LEVEL_REGION },
	{ "a plane on a torus", torus, LEVEL_PLANE, { 0, 0, 1 }, 1, 1, false, LEVEL_REGION },
	{ "a plane on a sphere", sphere, LEVEL_PLANE, { 0, 0.6, 0.8 }, 2.5, 1, false, LEVEL_POINT },
};

/* What the level only touches is told as one box, without a curve. */
static void test_touch(void **state)
{
	(void)state;
	for (size_t i = 0; i < sizeof touches / sizeof *touches; i++) {
		struct surface s = touches[i].make();
		struct level_result x;
		double value = touches[i].kind == LEVEL_PLANE ? touches[i].degrees
		                                              : cosine(touches[i].degrees);
		assert_int_equal(shape_trace(&s, touches[i].kind, touches[i].direction, value, 1e-5,
		                             &x, NULL),
		                 ST_OK);
		if (x.n_undecided != touches[i].undecided || x.n_branches != 0)
			print_error("%s: %zu undecided, %zu pieces\n", touches[i].name,
			            x.n_undecided, x.n_branches);
		assert_int_equal(x.n_branches, 0);
		assert_int_equal(x.n_undecided, touches[i].undecided);
		assert_true(!touches[i].flat || x.undecided[0].flat);
		enum level_mark kind = x.undecided[0].kind;
		if (touches[i].mark == N_LEVEL_MARKS)
			assert_true(kind == LEVEL_POINT || kind == LEVEL_REGION);
		else
			assert_int_equal(kind, touches[i].mark);
		assert_int_equal(x.undecided[0].ends, 0);
		level_result_finish(&x);
		surface_finish(&s);
	}
}

/* A surface that is only a line has no normal, and nothing is known of it. */
static void test_no_area(void **state)
{
	(void)state;
	for (int rational = 0; rational < 2; rational++) {
		struct surface s = shape_surface((const int[2]){ 4, 4 }, (const int[2]){ 8, 8 },
		                                 rational, KNOTS_CLAMPED, 3);
		struct level_result x;
		for (int i = 0; i < 8; i++)
			for (int j = 0; j < 8; j++) {
				double w, t;
				t = surface_get_point(&s, i, j, &w).z;
				surface_set_point(&s, i, j, vec3(0.37 * t, 1.21 * t, 0.777 * t), w);
			}
		assert_int_equal(
		        shape_trace(&s, LEVEL_ISOPHOTE, vec3(0, 0, 1), 0.5, 1e-5, &x, NULL), ST_OK);
		assert_int_equal(x.n_branches, 0);
		assert_int_equal(x.n_undecided, 1);
		assert_true(x.undecided[0].flat);
		level_result_finish(&x);
		surface_finish(&s);
	}
}

/* Where curves cross, the crossing is told and the curves end there. */
static void test_crossing(void **state)
{
	(void)state;
	struct surface s = torus();
	struct level_result x;
	assert_int_equal(shape_trace(&s, LEVEL_ISOPHOTE, vec3(1, 0, 0), 0, 1e-5, &x, NULL), ST_OK);
	/* u = 90, 270 degrees cross v = 90, 270 degrees: on the corners of patches */
	assert_true(fabs(x.length - (2 * 2 * pi + 2 * 2 * pi * 3)) < 1e-3);
	level_result_finish(&x);
	surface_finish(&s);
	s = wavy();
	assert_int_equal(shape_trace(&s, LEVEL_PLANE, vec3(0, 0, 1), 0, 1e-5, &x, NULL), ST_OK);
	/* seven lines each way, the border's four among them */
	int found[5] = { 0 };
	assert_int_equal(x.n_branches, 2 * 7 * 6);
	assert_int_equal(x.n_undecided, 49);
	for (size_t i = 0; i < x.n_undecided; i++) {
		const struct level_box *b = &x.undecided[i];
		assert_int_equal(b->kind, LEVEL_CROSSING);
		assert_in_range(b->ends, 2, 4);
		found[b->ends]++;
	}
	assert_int_equal(found[4], 25);
	assert_int_equal(found[3], 20);
	assert_int_equal(found[2], 4);
	/* branches of a crossing end in one point */
	for (size_t b = 0; b < x.n_branches; b++)
		for (int e = 0; e < 2; e++) {
			const struct curve *c = &x.branches[b].uv;
			struct vec3 p = curve_get_point(c, e ? c->n - 1 : 0, NULL);
			assert_in_range(x.branches[b].mark[e], 0, 48);
			const struct level_box *m = &x.undecided[x.branches[b].mark[e]];
			assert_true(p.x == 0.5 * (m->lo[0] + m->hi[0]));
			assert_true(p.y == 0.5 * (m->lo[1] + m->hi[1]));
		}
	assert_true(x.max_error <= 1e-5);
	level_result_finish(&x);
	surface_finish(&s);
}

/* Two edges leave a corner along one line: no normal there, but those of a fan beside it. It is named where curves of
 * them end in it, not drawn as a region. */
static void test_singular(void **state)
{
	(void)state;
	struct surface s;
	assert_int_equal(surface_init(&s, (int[2]){ 3, 3 }, (int[2]){ 3, 3 }), ST_OK);
	for (int d = 0; d < 2; d++)
		for (int i = 0; i < 6; i++)
			s.knots[d][i] = i >= 3;
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++)
			surface_set_point(
			        &s, i, j,
			        vec3(i - j, i * j, 0.2 * i * j * (i + 1) + 0.25 * i * (i - 1)), 1);
	assert_int_equal(surface_check(&s, "corner", NULL), ST_OK);
	int named = 0;
	for (int degrees = 5; degrees < 60; degrees += 5) {
		struct level_result x;
		assert_int_equal(shape_trace(&s, LEVEL_ISOPHOTE, vec3(0, 0, 1), cosine(degrees),
		                             1e-5, &x, NULL),
		                 ST_OK);
		for (size_t i = 0; i < x.n_undecided; i++) {
			named++;
			assert_int_equal(x.undecided[i].kind, LEVEL_SINGULAR);
			assert_true(x.undecided[i].at[0] == 0 && x.undecided[i].at[1] == 0);
		}
		level_result_finish(&x);
	}
	assert_true(named > 0);
	surface_finish(&s);
}

/* What lies on both ends of a seam is one mark. */
static void test_seam(void **state)
{
	(void)state;
	struct surface s = sphere();
	struct level_result x;
	const struct vec3 on = surface_point(&s, s.domain[0][0], 0.4 * s.domain[1][1]);
	assert_int_equal(shape_trace(&s, LEVEL_PLANE, vec3_unit(on), 2.5, 1e-5, &x, NULL), ST_OK);
	assert_int_equal(x.n_branches, 0);
	assert_int_equal(x.n_undecided, 1);
	assert_int_equal(x.undecided[0].kind, LEVEL_POINT);
	assert_true(x.undecided[0].lo[0] < s.domain[0][1]);
	assert_true(x.undecided[0].hi[0] > s.domain[0][1]);
	level_result_finish(&x);
	surface_finish(&s);
}

/* How far from the level, of the size. */
static const double nearly[] = { 1e-9, 1e-7, 1e-5 };
enum { N_NEARLY = sizeof nearly / sizeof *nearly };

static double noise_size; /* of the heights */

/* Numbers without a rule: what is left of a plane in a file with few digits. */
static double noise(int i, int j, int n)
{
	const unsigned k = 2654435761u * (unsigned)(i * n + j + 1);
	return noise_size * ((k >> 8) / 8388608.0 - 1);
}

static size_t pieces_of(const struct level_result *x)
{
	size_t n = 0;
	for (size_t b = 0; b < x->n_branches; b++)
		n += (size_t)x->branches[b].uv.n / 3;
	return n;
}

/* A face that is plane but for its last digits, the light in it: no more noise is followed than the tolerance allows. */
static void test_nearly_plane(void **state)
{
	(void)state;
	for (int i = 0; i < N_NEARLY; i++)
		for (int k = 0; k < 3; k++) {
			const double tolerance = 10 * (k == 0 ? 1e-4 : k == 1 ? 1e-6 : 1e-8);
			struct surface s;
			struct level_result x;
			noise_size = 10 * nearly[i];
			assert_int_equal(shape_make(&s, 4, 7, noise), ST_OK);
			assert_int_equal(shape_trace(&s, LEVEL_ISOPHOTE, vec3(0.6, 0.8, 0), 0,
			                             tolerance, &x, NULL),
			                 ST_OK);
			assert_true(x.max_error <= tolerance);
			assert_true(pieces_of(&x) <= 400);
			/* the curve's course would be rounding's */
			if (nearly[i] == 1e-9 && k == 2) {
				assert_int_equal(x.n_branches, 0);
				assert_int_equal(x.n_undecided, 1);
				assert_int_equal(x.undecided[0].kind, LEVEL_REGION);
			}
			level_result_finish(&x);
			surface_finish(&s);
		}
}

/* The height -x^2 / 20, less a wave that tilts the border x = 0 by its size. */
static double arched(int i, int j, int n)
{
	const double x = 10.0 * i / (n - 1);
	return -x * x / 20 + noise_size * x * ((j % 3) - 1);
}

/* A border nearly in the level: curves are where it is, with few pieces, as near as asked for. */
static void test_nearly_border(void **state)
{
	(void)state;
	for (int i = 0; i < N_NEARLY; i++)
		for (int k = 0; k < 2; k++) {
			const double tolerance = k ? 1e-7 : 1e-4;
			struct surface s;
			struct level_result x;
			noise_size = nearly[i];
			assert_int_equal(shape_make(&s, 3, 8, arched), ST_OK);
			/* the light is the border's normal turned by a right angle */
			const double h = s.points[4 * 8 + 2] - s.points[2];
			const double w = s.points[4 * 8] - s.points[0];
			assert_int_equal(shape_trace(&s, LEVEL_SILHOUETTE, vec3(w, 0, h), 0,
			                             tolerance, &x, NULL),
			                 ST_OK);
			assert_true(x.max_error <= tolerance);
			assert_true(pieces_of(&x) <= 400);
			for (size_t b = 0; b < x.n_branches; b++)
				for (int q = 0; q <= 20; q++) {
					const struct curve *c = &x.branches[b].space;
					const double t = c->domain[1] * q / 20;
					assert_true(fabs(curve_point(c, t).x) <=
					            100 * nearly[i] + tolerance);
				}
			level_result_finish(&x);
			surface_finish(&s);
		}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_touch),         cmocka_unit_test(test_no_area),
		cmocka_unit_test(test_crossing),      cmocka_unit_test(test_singular),
		cmocka_unit_test(test_seam),          cmocka_unit_test(test_nearly_plane),
		cmocka_unit_test(test_nearly_border),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
