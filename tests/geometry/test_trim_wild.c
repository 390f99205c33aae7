/* test_trim_wild.c - trims that no program should write: each is measured, cut into triangles and mended, or
 * refused with a sentence. */
#include "cmocka_all.h"

#include <stdlib.h>

#include "tessellate.h"
#include "trim_shapes.h"

#define SQUARE "o .2 .2 .8 .2 .8 .8 .2 .8"
#define HOLE   "i .2 .2 .8 .2 .8 .8 .2 .8"

enum { REFUSED = -1, LEFT_OUT = -2, ANY = -3 };

/*
 * Of the unit square: loops of straight sides, outer (o) and inner (i), in capitals without the last one.
 * Where loops lie upon each other or cross, triangles fill what they go around an odd number of times, in
 * all; inside is what lies in an outer loop and in no inner one.
 */
/* clang-format off */
static const struct {
	const char *name, *loops;
	double inside, triangles, mended; /* areas */
} rows[] = {
	{ "square", SQUARE, 0.36, 0.36, 0.36 },
	{ "clockwise", "o .2 .8 .8 .8 .8 .2 .2 .2", 0.36, 0.36, 0.36 },
	{ "hole", HOLE, 0.64, 0.64, 0.64 },
	{ "hole counterclockwise", "i .2 .8 .8 .8 .8 .2 .2 .2", 0.64, 0.64, 0.64 },
	{ "bow-tie", "o .2 .2 .8 .8 .8 .2 .2 .8", 0.18, 0.18, 0.18 },
	{ "hole that is a bow-tie", "i .2 .2 .8 .8 .8 .2 .2 .8", 0.82, 0.82, 0.82 },
	{ "star", "o .5 .9 .26 .18 .88 .62 .12 .62 .74 .18", 0.123770958, LEFT_OUT, 0.123770958 },
	{ "around twice", "o .2 .2 .8 .2 .8 .8 .2 .8 .2 .2 .8 .2 .8 .8 .2 .8", 0, 0, 0 },
	{ "outer in outer", SQUARE " o .4 .4 .6 .4 .6 .6 .4 .6", 0.36, 0.32, 0.36 },
	{ "outer twice", SQUARE " " SQUARE, 0.36, 0, 0.36 },
	{ "hole twice", HOLE " " HOLE, 0.64, 1, 0.64 },
	{ "hole as large as the loop", SQUARE " " HOLE, 0, 0, 0 },
	{ "hole at a corner of the loop", SQUARE " i .2 .2 .5 .3 .3 .5", 0.32, 0.32, 0.32 },
	{ "hole along a side", SQUARE " i .2 .2 .5 .2 .5 .5 .2 .5", 0.27, 0.27, 0.27 },
	{ "hole across a side", SQUARE " i .1 .4 .5 .4 .5 .6 .1 .6", 0.3, 0.32, 0.3 },
	{ "two that cross", SQUARE " o .5 .5 .9 .5 .9 .9 .5 .9", 0.43, 0.34, 0.43 },
	{ "two with one corner", "o .2 .2 .5 .2 .5 .5 .2 .5 o .5 .5 .8 .5 .8 .8 .5 .8",
	  0.18, 0.18, 0.18 },
	{ "one that touches itself", "o .2 .2 .5 .2 .5 .5 .8 .5 .8 .8 .5 .8 .5 .5 .2 .5",
	  0.18, 0.18, 0.18 },
	{ "a spike", "o .2 .2 .8 .2 .8 .8 .9 .9 .8 .8 .2 .8", 0.36, 0.36, 0.36 },
	{ "a slit to a hole", "o .2 .2 .8 .2 .8 .8 .2 .8 .2 .2 .4 .4 .4 .6 .6 .6 .6 .4 .4 .4",
	  0.32, 0.32, 0.32 },
	{ "open", "O .2 .2 .8 .2 .8 .8 .2 .8", ANY, ANY, REFUSED },
	{ "one side", "O .2 .2 .8 .2", 0, 0, REFUSED },
	{ "two, both open", "O .2 .2 .8 .2 O .2 .8 .8 .8", 0, 0, REFUSED },
	{ "there and back", "o .2 .2 .8 .2", 0, 0, 0 },
	{ "a point", "o .2 .2 .2 .2", 0, 0, 0 },
	{ "a side without length", "o .2 .2 .8 .2 .8 .2 .8 .8 .2 .8", 0.36, 0.36, 0.36 },
	{ "outside", "o 2 2 3 2 3 3 2 3", 0, 0, REFUSED },
	{ "half outside", "o .5 .2 1.5 .2 1.5 .8 .5 .8", 0.3, 0.3, REFUSED },
	{ "larger than the domain", "o -1 -1 2 -1 2 2 -1 2", 1, 1, REFUSED },
	{ "huge", "o -1e300 -1e300 1e300 -1e300 1e300 1e300 -1e300 1e300", 1, 1, REFUSED },
	{ "a little outside", "o -.001 0 1 0 1 1 -.001 1", 1, 1, 1 },
	{ "the domain itself", "o 0 0 1 0 1 1 0 1", 1, 1, 1 },
	{ "hole that is the domain", "i 0 0 1 0 1 1 0 1", 0, 0, 0 },
	{ "tiny", "o .5 .5 .500000001 .5 .500000001 .500000001 .5 .500000001", 0, 0, 0 },
	{ "tinier than numbers", "o .5 .5 .5000000000000001 .5 .5000000000000001 .5000000000000001",
	  0, 0, 0 },
};
/* clang-format on */
enum { N_ROWS = sizeof rows / sizeof *rows };

/* Finest and coarsest, apart and joined. */
static const struct tessellate_limits limits[] = {
	{ .chord = 1e-3, .angle = 0.26, .join = 1e-6 },
	{ .chord = 1.5e-11, .angle = 0.26, .join = 0 },
	{ .chord = 1, .angle = 3, .join = 1e-2, .orient = true },
	{ .chord = 1e-6, .angle = 1e-3, .join = 1e-9, .orient = true },
};
enum { N_LIMITS = sizeof limits / sizeof *limits };

static void make(struct trim *t, const char *loops)
{
	*t = (struct trim){ 0 };
	for (const char *s = loops; *s;) {
		const bool open = *s == 'O' || *s == 'I';
		struct trim_loop l = { .outer = *s == 'o' || *s == 'O' };
		double p[40];
		int n = 0;
		s++;
		for (char *end; n < 40; s = end) {
			p[n] = strtod(s, &end);
			if (end == s)
				break;
			n++;
		}
		while (*s == ' ')
			s++;
		for (int i = 0; i < n - 2 * open; i += 2) {
			const int j = (i + 2) % n;
			trim_put(&l, trim_line(p[i], p[i + 1], p[j], p[j + 1]));
		}
		trim_close(t, l);
	}
}

static double area_of(const struct mesh *m)
{
	double sum = 0;
	for (int t = 0; t < m->n_triangles; t++) {
		const struct vec3 a = m->points[m->triangles[t][0].point];
		const struct vec3 b = m->points[m->triangles[t][1].point];
		const struct vec3 c = m->points[m->triangles[t][2].point];
		sum += 0.5 * vec3_length(vec3_cross(vec3_sub(b, a), vec3_sub(c, a)));
	}
	return sum;
}

static void assert_area(const char *name, const char *what, double found, double expected)
{
	if (expected != ANY && !(fabs(found - expected) < 1e-6))
		fail_msg("%s: %s %.9g, expected %.9g", name, what, found, expected);
}

static double measured(const struct trim *t, const struct surface *s)
{
	double area, error;
	assert_int_equal(trim_area(t, s, 1e-9, &area, &error), ST_OK);
	return area;
}

static void are_measured(void **state)
{
	struct surface s = shape_plane(1, 1);
	(void)state;
	for (int i = 0; i < N_ROWS; i++) {
		struct trim t;
		make(&t, rows[i].loops);
		const double area = measured(&t, &s);
		if (rows[i].mended != ANY)
			assert_area(rows[i].name, "measured", area, rows[i].inside);
		trim_finish(&t);
	}
	surface_finish(&s);
}

/* Of the places of a grid so many are inside. */
static void are_tested_for_points(void **state)
{
	enum { SIDE = 200 };
	struct surface s = shape_plane(1, 1);
	(void)state;
	for (int i = 0; i < N_ROWS; i++) {
		struct trim t;
		struct trim_test *test;
		int inside = 0;
		make(&t, rows[i].loops);
		assert_int_equal(trim_test_create(&test, &t, &s), ST_OK);
		for (int k = 0; k < SIDE * SIDE; k++)
			inside += trim_test_inside(test, (k / SIDE + 0.49) / SIDE,
			                           (k % SIDE + 0.51) / SIDE);
		const double share = (double)inside / (SIDE * SIDE);
		if (rows[i].inside != ANY && fabs(share - rows[i].inside) > 0.005)
			fail_msg("%s: %g of the places, expected %g", rows[i].name, share,
			         rows[i].inside);
		trim_test_destroy(test);
		trim_finish(&t);
	}
	surface_finish(&s);
}

/* Straight sides on a plane need few triangles, however near they are to be. */
static void are_cut_into_triangles(void **state)
{
	struct surface s = shape_plane(1, 1);
	(void)state;
	for (int i = 0; i < N_ROWS; i++) {
		struct trim t;
		make(&t, rows[i].loops);
		const struct tessellate_face face = { &s, &t };
		const bool left_out = rows[i].triangles == LEFT_OUT;
		for (int k = 0; k < N_LIMITS; k++) {
			struct report_store store;
			struct mesh m;
			report_store_init(&store);
			assert_int_equal(tessellate(&m, &face, 1, &limits[k], NULL, &store.report),
			                 ST_OK);
			assert_int_equal(store.n_warnings, left_out);
			assert_area(rows[i].name, "of triangles", area_of(&m),
			            left_out ? 0 : rows[i].triangles);
			assert_true(m.n_triangles < 1000);
			mesh_finish(&m);
		}
		trim_finish(&t);
	}
	surface_finish(&s);
}

/* What is refused is left as it was. */
static void are_mended_or_refused(void **state)
{
	struct surface s = shape_plane(1, 1);
	(void)state;
	for (int i = 0; i < N_ROWS; i++) {
		struct report_store store;
		struct trim t;
		const bool refused = rows[i].mended == REFUSED;
		make(&t, rows[i].loops);
		report_store_init(&store);
		assert_int_equal(trim_mend(&t, &s, 1e-6, rows[i].name, &store.report),
		                 refused ? ST_INPUT : ST_OK);
		assert_int_equal(store.n_errors, refused);
		if (refused && strncmp(store.error, rows[i].name, strlen(rows[i].name)) != 0)
			fail_msg("%s: '%s'", rows[i].name, store.error);
		assert_area(rows[i].name, "then measured", measured(&t, &s),
		            refused ? rows[i].inside : rows[i].mended);
		trim_finish(&t);
	}
	surface_finish(&s);
}

static void hear(void *data, enum report_level level, enum status st, const char *text)
{
	int *notes = data;
	(void)st;
	*notes += level == REPORT_INFO && strstr(text, "face 3: ") && strstr(text, "twice");
}

/* What is there twice is kept once, wherever it begins and whichever way it runs; what is as mended is also
 * cut into triangles so. */
static void are_kept_once(void **state)
{
	/* clang-format off */
	static const struct {
		const char *loops;
		int left;
		double area;
	} cases[] = {
		{ SQUARE " " SQUARE, 1, 0.36 },
		{ SQUARE " o .2 .8 .8 .8 .8 .2 .2 .2", 1, 0.36 },
		{ SQUARE " o .8 .8 .2 .8 .2 .2 .8 .2", 1, 0.36 },
		{ SQUARE " o .2000005 .2 .8 .2000005 .8 .8 .2 .7999995", 1, 0.36 },
		{ SQUARE " " SQUARE " " SQUARE, 1, 0.36 },
		{ HOLE " " HOLE, 1, 0.64 },
		{ HOLE " i .8 .8 .8 .2 .2 .2 .2 .8", 1, 0.64 },
		{ HOLE " i .8 .8 .9 .8 .9 .9 .8 .9 " HOLE " i .8 .8 .9 .8 .9 .9 .8 .9", 2, 0.63 },
		{ SQUARE " " HOLE, 2, 0 },
		{ SQUARE " o .2001 .2 .8 .2 .8 .8 .2 .8", 2, ANY },
		{ HOLE " i .2 .2 .8 .2 .8 .8 .5 .8 .2 .8", 2, ANY },
		{ "i .1 .1 .2 .1 .2 .2 .1 .2 i .1 .3 .2 .3 .2 .4 .1 .4", 2, 0.98 },
	};
	/* clang-format on */
	struct surface s = shape_plane(1, 1);
	(void)state;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		struct mesh m;
		struct trim t;
		int notes = 0;
		const struct report report = { hear, &notes };
		make(&t, cases[i].loops);
		const struct tessellate_face face = { &s, &t };
		const int given = t.n;
		assert_int_equal(trim_mend(&t, &s, 1e-6, "face 3", &report), ST_OK);
		if (t.n != cases[i].left)
			fail_msg("%s: %d loops left", cases[i].loops, t.n);
		assert_int_equal(notes, t.n < given);
		assert_int_equal(tessellate(&m, &face, 1, &limits[0], NULL, &report), ST_OK);
		assert_area(cases[i].loops, "of triangles", area_of(&m), cases[i].area);
		mesh_finish(&m);
		trim_finish(&t);
	}
	surface_finish(&s);
}

/* A round hole over the side of a round loop, at any distance of the two: the loop without the lens. */
static void circles_that_cross(void **state)
{
	const double r = 0.2, apart[5] = { 1e-3, 0.03, 0.1, 0.3, 0.39 };
	struct surface s = shape_plane(1, 1);
	(void)state;
	for (int i = 0; i < 5; i++) {
		const double d = apart[i];
		const double lens = 2 * r * r * acos(d / 2 / r) - d / 2 * sqrt(4 * r * r - d * d);
		struct trim t = { 0 };
		trim_add_ellipse(&t, true, 0.4, 0.5, r, r, 0.3);
		trim_add_ellipse(&t, false, 0.4 + d * cos(i), 0.5 + d * sin(i), r, r, 0.7);
		const double off = measured(&t, &s) - (M_PI * r * r - lens);
		if (!(fabs(off) < 1e-9))
			fail_msg("%g apart: off by %g", d, off);
		trim_finish(&t);
	}
	surface_finish(&s);
}

/* A bow-tie of curves, cut as finely as numbers allow: its pieces go into the net in n log n steps. */
static void a_bow_tie_of_many_pieces(void **state)
{
	enum { N = 16 };
	struct surface s = shape_plane(1, 1);
	struct trim t = { 0 };
	struct trim_loop l = { .outer = true };
	struct curve c;
	struct report_store store;
	struct mesh m;
	const struct tessellate_limits finest = { .chord = 1e-9, .angle = 1, .join = 0 };
	(void)state;
	assert_int_equal(curve_init(&c, 4, N + 3), ST_OK);
	for (int i = 0; i < N + 7; i++)
		c.knots[i] = i;
	c.domain[0] = 3;
	c.domain[1] = N + 3;
	for (int i = 0; i < N + 3; i++) {
		const double a = 2 * M_PI * (i % N) / N;
		curve_set_point(&c, i, vec3(0.5 + 0.3 * sin(a), 0.5 + 0.3 * sin(a) * cos(a), 0), 1);
	}
	assert_int_equal(curve_check(&c, "eight", NULL), ST_OK);
	trim_put(&l, c);
	trim_close(&t, l);
	report_store_init(&store);
	const struct tessellate_face face = { &s, &t };
	assert_int_equal(tessellate(&m, &face, 1, &finest, NULL, &store.report), ST_OK);
	assert_int_equal(store.n_warnings, 0);
	assert_true(m.n_triangles > 50000);
	assert_true(fabs(area_of(&m) - measured(&t, &s)) < 1e-8);
	mesh_finish(&m);
	trim_finish(&t);
	surface_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(are_measured),
		cmocka_unit_test(are_tested_for_points),
		cmocka_unit_test(are_cut_into_triangles),
		cmocka_unit_test(are_mended_or_refused),
		cmocka_unit_test(are_kept_once),
		cmocka_unit_test(circles_that_cross),
		cmocka_unit_test(a_bow_tie_of_many_pieces),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
