/* test_section.c - plane figures against formulas: circles, ellipses, segments, what a lid leaves. */
#include <math.h>
#include <stdlib.h>

#include "cmocka_all.h"
#include "construct.h"
#include "section.h"

static const struct vec3 up = { 0, 0, 1 };

static void near(double a, double b, double tolerance)
{
	if (!(fabs(a - b) <= tolerance))
		fail_msg("%.17g is not %.17g within %g", a, b, tolerance);
}

static void near_point(struct vec3 p, struct vec3 q, double tolerance)
{
	near(vec3_length(vec3_sub(p, q)), 0, tolerance);
}

static struct curve arc(struct vec3 c, double radius, double a, double b)
{
	struct curve out;
	assert_int_equal(make_arc(&out, c, vec3(1, 0, 0), vec3(0, 1, 0), radius, a, b), ST_OK);
	return out;
}

static struct curve line(struct vec3 a, struct vec3 b)
{
	struct curve out;
	assert_int_equal(make_line(&out, a, b), ST_OK);
	return out;
}

/* An arc closed by its chord, far from the origin, either way round, at any height. */
static void segments_of_a_circle(void **state)
{
	(void)state;
	static const double angles[] = { 0.3, 1, M_PI / 2, 2, M_PI, 4, 2 * M_PI };
	for (size_t i = 0; i < sizeof angles / sizeof *angles; i++)
		for (int reversed = 0; reversed < 2; reversed++) {
			const double a = angles[i], r = 3;
			const struct vec3 c = vec3(1000, -200, 7);
			struct curve k = arc(c, r, 0.7, 0.7 + a);
			struct section_side side = { &k, reversed };
			struct section s;
			assert_int_equal(section_measure(&side, 1, up, NULL, 1e-12, &s), ST_OK);
			const double area = r * r * (a - sin(a)) / 2;
			near(s.area, reversed ? -area : area, 1e-10);
			near(s.girth, r * a, 1e-10);
			near(s.closing, 2 * r * fabs(sin(a / 2)), 1e-9);
			/* centroid of a segment: 4 r sin^3(a/2) / 3 (a - sin a) from the centre */
			const double d = 4 * r * pow(sin(a / 2), 3) / (3 * (a - sin(a)));
			near_point(
			        s.centroid,
			        vec3(c.x + d * cos(0.7 + a / 2), c.y + d * sin(0.7 + a / 2), c.z),
			        1e-8);
			curve_finish(&k);
		}
}

/* Border of several curves, gaps between them closed; a plane that stands askew. */
static void chains(void **state)
{
	(void)state;
	const struct vec3 n = vec3_unit(vec3(1, 2, 2));
	const struct vec3 x = vec3_unit(vec3(2, -1, 0)), y = vec3_cross(n, x);
	struct vec3 p[4];
	for (int i = 0; i < 4; i++) {
		static const double corner[4][2] = { { 0, 0 }, { 4, 0 }, { 4, 3 }, { 0, 3 } };
		p[i] = vec3_along(vec3_along(vec3(5, 5, 5), corner[i][0], x), corner[i][1], y);
	}
	/* three sides, the second against its direction; the fourth is missing */
	struct curve c[3] = { line(p[0], p[1]), line(p[2], p[1]), line(p[2], p[3]) };
	struct section_side sides[3] = { { &c[0], false }, { &c[1], true }, { &c[2], false } };
	struct section s;
	assert_int_equal(section_measure(sides, 3, n, NULL, 1e-12, &s), ST_OK);
	near(s.area, 12, 1e-12);
	near(s.girth, 11, 1e-12);
	near(s.closing, 3, 1e-12);
	near_point(s.centroid, vec3_scale(vec3_add(p[0], p[2]), 0.5), 1e-12);
	int turns;
	assert_int_equal(section_winding(sides, 3, n, s.centroid, &turns), ST_OK);
	assert_int_equal(turns, 1);
	assert_int_equal(section_winding(sides, 3, vec3_scale(n, -1), s.centroid, &turns), ST_OK);
	assert_int_equal(turns, -1);
	assert_int_equal(section_winding(sides, 3, n, vec3_along(p[0], -0.01, x), &turns), ST_OK);
	assert_int_equal(turns, 0);
	for (int i = 0; i < 3; i++)
		curve_finish(&c[i]);
}

/* A circle below a lid that is over, through, or under it; open arcs end above the lid. */
static void lids(void **state)
{
	(void)state;
	const double r = 2;
	struct curve whole = arc(vec3(3, 1, 0), r, 0, 2 * M_PI);
	struct curve open = arc(vec3(3, 1, 0), r, M_PI - 0.2, 2 * M_PI + 0.2);
	for (double h = -2.5; h <= 2.5; h += 0.5) {
		const struct section_lid lid = { { 0, 1, 0 }, 1 + h };
		const double d = fmax(-r, fmin(r, h));
		const double area = r * r * acos(-d / r) + d * sqrt(r * r - d * d);
		struct section s;
		assert_int_equal(section_measure(&(struct section_side){ &whole, false }, 1, up,
		                                 &lid, 1e-12, &s),
		                 ST_OK);
		near(s.area, area, 1e-9);
		near(s.girth, 2 * r * acos(-d / r), 1e-6);
		if (h > 0.3)
			continue;
		struct section t;
		assert_int_equal(section_measure(&(struct section_side){ &open, false }, 1, up,
		                                 &lid, 1e-12, &t),
		                 ST_OK);
		near(t.area, area, 1e-9);
		near(t.girth, s.girth, 1e-6);
	}
	curve_finish(&whole);
	curve_finish(&open);
}

/* Where a curve that is known passes through planes. */
static void crossings(void **state)
{
	(void)state;
	struct curve c = arc(vec3(0, 0, 0), 1, 0, 2 * M_PI);
	for (int i = -11; i <= 11; i++) {
		const double h = i / 10.0 + 0.03;
		double *t;
		int n;
		assert_int_equal(curve_crossings(&c, vec3(0, 1, 0), h, &t, &n), ST_OK);
		assert_int_equal(n, fabs(h) < 1 ? 2 : 0);
		for (int k = 0; k < n; k++)
			near(curve_point(&c, t[k]).y, h, 1e-13);
		free(t);
	}
	curve_finish(&c);

	/* a zigzag, with a corner on the plane */
	struct vec3 p[7];
	for (int i = 0; i < 7; i++)
		p[i] = vec3(i, i % 2 ? 1 : -1, i == 3 ? 0 : 5);
	assert_int_equal(make_polyline(&c, p, 7), ST_OK);
	double *t;
	int n;
	assert_int_equal(curve_crossings(&c, vec3(0, 1, 0), 0, &t, &n), ST_OK);
	assert_int_equal(n, 6);
	for (int i = 0; i < n; i++)
		near(curve_point(&c, t[i]).x, i + 0.5, 1e-12);
	free(t);
	assert_int_equal(curve_crossings(&c, vec3(0, 0, 1), 0, &t, &n), ST_OK);
	assert_int_equal(n, 0); /* touched, not crossed */
	free(t);
	curve_finish(&c);
}

/* Nothing encloses nothing; a border run there and back has no area. */
static void nothing(void **state)
{
	(void)state;
	struct section s;
	assert_int_equal(section_measure(NULL, 0, up, NULL, 1e-9, &s), ST_OK);
	assert_true(s.area == 0 && s.girth == 0 && isnan(s.centroid.x));
	struct curve c = arc(vec3(0, 0, 0), 1, 0, 1);
	struct section_side sides[2] = { { &c, false }, { &c, true } };
	assert_int_equal(section_measure(sides, 2, up, NULL, 1e-12, &s), ST_OK);
	near(s.area, 0, 1e-15);
	near(s.girth, 2, 1e-12);
	near(s.closing, 0, 1e-15);
	curve_finish(&c);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(segments_of_a_circle),
		cmocka_unit_test(chains),
		cmocka_unit_test(lids),
		cmocka_unit_test(crossings),
		cmocka_unit_test(nothing),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
