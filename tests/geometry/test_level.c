/* test_level.c - curves f = 0 on a surface: known answers, failures. */
#include "level_check.h"

#include <string.h>

/* ---- known answers ---- */

static const struct known {
	const char *name;
	struct surface (*make)(void);
	enum level_kind kind;
	struct vec3 direction;
	double degrees; /* of a plane: its height */
	size_t branches, closed;
	double length; /* 0: not known */
	int seams;     /* over all branches; -1: not asked */
} knowns[] = {
	{ "waves, plane", wavy, LEVEL_PLANE, { 0, 0, 1 }, 0.4, 18, 18, 0, 0 },
	{ "waves, deep plane", wavy, LEVEL_PLANE, { 0, 0, 2 }, -1.5, 18, 18, 0, 0 },
	{ "waves, silhouette", wavy, LEVEL_SILHOUETTE, { 0.8, 0.36, 0.48 }, 90, 12, 0, 0, 0 },
	{ "waves, isophote", wavy, LEVEL_ISOPHOTE, { 0, 0, 1 }, 35, 85, 61, 0, 0 },
	{ "waves, isophote", wavy, LEVEL_ISOPHOTE, { 0, 0, 7 }, 50, 84, 60, 0, 0 },
	{ "waves, none", wavy, LEVEL_ISOPHOTE, { 0, 0, 1 }, 100, 0, 0, 0, 0 },
	{ "sphere, a circle of latitude",
	  sphere,
	  LEVEL_ISOPHOTE,
	  { 0, 0, 1 },
	  60,
	  1,
	  1,
	  2 * M_PI * 2.5 * 0.86602540378443865,
	  1 },
	{ "sphere, the equator, on knots",
	  sphere,
	  LEVEL_ISOPHOTE,
	  { 0, 0, 1 },
	  90,
	  1,
	  1,
	  2 * M_PI * 2.5,
	  1 },
	{ "sphere, over the seam twice",
	  sphere,
	  LEVEL_ISOPHOTE,
	  { 1, 0, 0 },
	  60,
	  1,
	  1,
	  2 * M_PI * 2.5 * 0.86602540378443865,
	  2 },
	{ "sphere, away from the seam",
	  sphere,
	  LEVEL_ISOPHOTE,
	  { 1, 0, 0 },
	  150,
	  1,
	  1,
	  2 * M_PI * 2.5 * 0.5,
	  0 },
	{ "sphere, through the poles",
	  sphere,
	  LEVEL_ISOPHOTE,
	  { 1, 0.3, 0 },
	  90,
	  1,
	  1,
	  2 * M_PI * 2.5,
	  2 },
	{ "sphere, through the poles, on knots",
	  sphere,
	  LEVEL_ISOPHOTE,
	  { 1, 0, 0 },
	  90,
	  1,
	  1,
	  2 * M_PI * 2.5,
	  2 },
	{ "sphere, along the seam",
	  sphere,
	  LEVEL_SILHOUETTE,
	  { 0, 1, 0 },
	  90,
	  1,
	  1,
	  2 * M_PI * 2.5,
	  -1 },
	{ "sphere, through one pole",
	  sphere,
	  LEVEL_ISOPHOTE,
	  { 0.6, 0, 0.8 },
	  36.869897645844021,
	  1,
	  1,
	  2 * M_PI * 2.5 * 0.6,
	  -1 },
	{ "sphere, plane through the poles",
	  sphere,
	  LEVEL_PLANE,
	  { 1, 0.2, 0 },
	  0,
	  1,
	  1,
	  2 * M_PI * 2.5,
	  2 },
	{ "torus, outside and inside",
	  torus,
	  LEVEL_ISOPHOTE,
	  { 0, 0, 1 },
	  90,
	  2,
	  2,
	  2 * M_PI * 6,
	  2 },
	{ "torus, two parallels", torus, LEVEL_ISOPHOTE, { 0, 0, 1 }, 60, 2, 2, 12 * M_PI, 2 },
	{ "torus, round both seams' crossing", torus, LEVEL_ISOPHOTE, { 1, 0, 0 }, 60, 2, 2, 0, 4 },
	{ "torus, plane through the axis", torus, LEVEL_PLANE, { 1, 2, 0 }, 0, 2, 2, 4 * M_PI, 2 },
	{ "torus, two circles", torus, LEVEL_PLANE, { 0, 0, 1 }, 0.5, 2, 2, 12 * M_PI, 2 },
	{ "cylinder, two lines", cylinder, LEVEL_ISOPHOTE, { 1, 0, 0 }, 60, 2, 0, 10, 0 },
	{ "cylinder, lines on knots", cylinder, LEVEL_ISOPHOTE, { 1, 0, 0 }, 90, 2, 0, 10, 0 },
	{ "cylinder, slanting plane", cylinder, LEVEL_PLANE, { 0.6, 0, 0.8 }, 2.8, 1, 1, 0, 1 },
	{ "flat, no level", flat, LEVEL_ISOPHOTE, { 0, 0, 1 }, 30, 0, 0, 0, 0 },
};

static void test_known(void **state)
{
	(void)state;
	const double tolerance = 1e-5;
	for (size_t i = 0; i < sizeof knowns / sizeof *knowns; i++) {
		const struct known *k = &knowns[i];
		struct surface s = k->make();
		struct level_result x;
		double value = k->kind == LEVEL_PLANE ? k->degrees : cosine(k->degrees);
		int seams = 0;
		assert_int_equal(shape_trace(&s, k->kind, k->direction, value, tolerance, &x, NULL),
		                 ST_OK);
		if (x.n_branches != k->branches || x.n_closed != k->closed || x.n_undecided != 0)
			print_error("%s: %zu pieces, %zu closed, %zu undecided\n", k->name,
			            x.n_branches, x.n_closed, x.n_undecided);
		assert_int_equal(x.n_branches, k->branches);
		assert_int_equal(x.n_closed, k->closed);
		assert_int_equal(x.n_undecided, 0);
		if (x.max_error > tolerance)
			print_error("%s: error %g\n", k->name, x.max_error);
		assert_true(x.max_error <= tolerance);
		if (k->length > 0)
			assert_true(fabs(x.length - k->length) < 1e-4 * k->length);
		for (size_t b = 0; b < x.n_branches; b++) {
			seams += x.branches[b].seams;
			check_curves(&s, &x.branches[b]);
			check_exact(&s, k->kind, k->direction, value, &x.branches[b], tolerance,
			            k->branches > 20 ? 40 : 200);
		}
		if (k->seams >= 0 && seams != k->seams)
			print_error("%s: %d seams\n", k->name, seams);
		assert_true(k->seams < 0 || seams == k->seams);
		level_result_finish(&x);
		surface_finish(&s);
	}
}

static void test_wrong(void **state)
{
	(void)state;
	static const struct {
		enum level_kind kind;
		struct vec3 direction;
		double value, tolerance;
	} wrong[] = {
		{ LEVEL_ISOPHOTE, { 0, 0, 0 }, 0.5, 1e-5 },
		{ LEVEL_ISOPHOTE, { 0, NAN, 1 }, 0.5, 1e-5 },
		{ LEVEL_ISOPHOTE, { 0, 0, 1 }, 1.01, 1e-5 },
		{ LEVEL_ISOPHOTE, { 0, 0, 1 }, -2, 1e-5 },
		{ LEVEL_PLANE, { 0, 0, 1 }, NAN, 1e-5 },
		{ LEVEL_PLANE, { 0, 0, 1 }, 0.5, 0 },
		{ LEVEL_PLANE, { 0, 0, 1 }, 0.5, -1 },
		{ LEVEL_PLANE, { 0, 0, 1 }, 0.5, NAN },
		{ LEVEL_CYLINDER, { 0, 0, 1 }, 0, 1e-5 },
		{ LEVEL_CYLINDER, { 0, 0, 0 }, 1, 1e-5 },
		{ LEVEL_HIGHLIGHT, { 0, 0, 1 }, NAN, 1e-5 },
		{ LEVEL_REFLECTION, { 0, 0, 0 }, 0, 1e-5 },
	};
	struct surface s = sphere();
	for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
		struct report_store store;
		struct level *l = NULL;
		report_store_init(&store);
		struct level_field field = { .kind = wrong[i].kind,
			                     .direction = wrong[i].direction,
			                     .value = wrong[i].value };
		assert_int_equal(level_create(&l, &s, &field, wrong[i].tolerance, &store.report),
		                 ST_PARAMETER);
		assert_null(l);
		assert_int_equal(store.n_errors, 1);
	}
	surface_finish(&s);
}

/* Blocks may be cut anywhere between patches; damaged ones are refused. */
static void test_blocks(void **state)
{
	(void)state;
	enum { BLOCKS = 729 };
	struct surface s = wavy();
	struct level_field field = { .kind = LEVEL_ISOPHOTE,
		                     .direction = { 0, 0, 1 },
		                     .value = cosine(35) };
	struct level *l;
	struct text bytes[BLOCKS] = { { 0 } }, whole = { 0 };
	const char *blocks[BLOCKS];
	size_t sizes[BLOCKS];
	struct level_result x, y;
	assert_int_equal(level_create(&l, &s, &field, 1e-5, NULL), ST_OK);
	assert_int_equal(level_patches(l), BLOCKS);
	for (int i = BLOCKS; i-- > 0;)
		assert_int_equal(level_patch(l, i, NULL, &bytes[i]), ST_OK);
	for (int i = 0; i < BLOCKS; i++) {
		blocks[i] = bytes[i].s ? bytes[i].s : "";
		sizes[i] = bytes[i].n;
		assert_int_equal(level_patch(l, i, NULL, &whole), ST_OK);
	}
	assert_int_equal(level_join(l, blocks, sizes, BLOCKS, &x, NULL), ST_OK);
	assert_int_equal(level_join(l, &(const char *){ whole.s }, &whole.n, 1, &y, NULL), ST_OK);
	assert_int_equal(x.n_branches, y.n_branches);
	for (size_t b = 0; b < x.n_branches; b++) {
		const struct curve *p = &x.branches[b].space, *q = &y.branches[b].space;
		assert_int_equal(p->n, q->n);
		assert_memory_equal(p->points, q->points, sizeof(double) * 4 * p->n);
		assert_memory_equal(x.branches[b].uv.points, y.branches[b].uv.points,
		                    sizeof(double) * 4 * p->n);
		assert_memory_equal(p->knots, q->knots, sizeof(double) * (p->n + 4));
	}
	level_result_finish(&x);
	level_result_finish(&y);

	struct report_store store;
	report_store_init(&store);
	size_t cut = whole.n - 8;
	assert_int_equal(level_join(l, &(const char *){ whole.s }, &cut, 1, &x, &store.report),
	                 ST_INTERNAL);
	assert_int_equal(store.n_errors, 1);
	/* every early byte damaged in turn: refused or read, never followed out of bounds */
	for (size_t i = 0; i < 160; i++) {
		whole.s[i] ^= 0x55;
		enum status st = level_join(l, &(const char *){ whole.s }, &whole.n, 1, &x, NULL);
		assert_true(st == ST_OK || st == ST_INTERNAL);
		assert_true(i >= 8 || st == ST_INTERNAL);
		if (st == ST_OK)
			level_result_finish(&x);
		whole.s[i] ^= 0x55;
	}
	for (int i = 0; i < BLOCKS; i++)
		text_finish(&bytes[i]);
	text_finish(&whole);
	level_destroy(l);
	surface_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_known),
		cmocka_unit_test(test_wrong),
		cmocka_unit_test(test_blocks),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
