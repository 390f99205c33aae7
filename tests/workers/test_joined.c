/* test_joined.c - curves over several surfaces and on trimmed ones, by all workers that trace them. */
#include "bodies.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base.h"
#include "json.h"
#include "refine.h"

static const double radius = 2, sides[3] = { 3, 2, 1 };

static char *contours, *isophotes, *isocurvature, *reflection;

/* A surface in four, two of them turned about so that their normal stays. */
static void quarters_write(const char *path, struct surface whole)
{
	struct surface s[4];
	for (int i = 0; i < 4; i++) {
		double range[2][2];
		for (int d = 0; d < 2; d++) {
			const double *all = whole.domain[d],
			             part = all[0] + 0.4 * (all[1] - all[0]);
			const bool upper = d == 0 ? i / 2 : i % 2;
			range[d][0] = upper ? part : all[0];
			range[d][1] = upper ? all[1] : part;
		}
		assert_int_equal(surface_part(&s[i], &whole, (const double(*)[2])range), ST_OK);
		if (i % 3 == 0)
			for (int d = 0; d < 2; d++)
				surface_reverse(&s[i], d);
	}
	surface_finish(&whole);
	bodies_write(path, NULL, s, 4);
}

/* The rectangle of a side of the block, round counter-clockwise in u,v. */
static void rectangle_add(struct trim *t, const double lo[2], const double hi[2])
{
	struct trim_loop l = { .outer = true };
	const double at[5][2] = { { lo[0], lo[1] },
		                  { hi[0], lo[1] },
		                  { hi[0], hi[1] },
		                  { lo[0], hi[1] },
		                  { lo[0], lo[1] } };
	for (int i = 0; i < 4; i++) {
		struct curve c;
		assert_int_equal(curve_init(&c, 2, 2), ST_OK);
		c.knots[2] = c.knots[3] = 1;
		for (int k = 0; k < 2; k++)
			curve_set_point(&c, k, vec3(at[i + k][0], at[i + k][1], 0), 1);
		assert_int_equal(curve_check(&c, "side", NULL), ST_OK);
		assert_int_equal(trim_loop_add(&l, &c), ST_OK);
	}
	assert_int_equal(trim_add(t, &l), ST_OK);
}

/* A block from the origin: six planes that reach beyond it on all sides, trimmed to its own. */
static void block_write(const char *path)
{
	struct model m;
	model_init(&m);
	for (int i = 0; i < 6; i++) {
		const int n = i / 2, a = (n + 1) % 3, b = (n + 2) % 3;
		const double beyond = 0.5, lo[2] = { beyond / (sides[a] + 2 * beyond),
			                             beyond / (sides[b] + 2 * beyond) };
		const double hi[2] = { 1 - lo[0], 1 - lo[1] };
		double corner[4][3];
		for (int k = 0; k < 4; k++) {
			corner[k][n] = i % 2 ? sides[n] : 0;
			corner[k][a] = k % 2 ? sides[a] + beyond : -beyond;
			corner[k][b] = k / 2 ? sides[b] + beyond : -beyond;
		}
		struct vec3 c[4];
		for (int k = 0; k < 4; k++)
			c[k] = vec3(corner[k][0], corner[k][1], corner[k][2]);
		struct entity e = { .kind = ENTITY_SURFACE,
			            .surface = -1,
			            .geometry = body_corners(c[0], c[1], c[2], c[3]) };
		rectangle_add(&e.trim, lo, hi);
		e.trims = 1;
		assert_int_equal(model_add(&m, &e), ST_OK);
	}
	model_number(&m);
	assert_int_equal(base_write(&m, path, NULL), ST_OK);
	model_finish(&m);
}

static int enter(void **state)
{
	static struct place place;
	*state = &place;
	place_enter(&place);
	quarters_write("ball.base", body_sphere(vec3(0, 0, 0), radius));
	quarters_write("ring.base", body_torus(vec3(0, 0, 0), 3, 1));
	block_write("block.base");
	return 0;
}

static json_t *figures_read(const char *path, struct model *m)
{
	assert_int_equal(model_read(m, path, NULL, NULL), ST_OK);
	return figures_of(m);
}

static void expect(const char *path, int branches, int closed, double length)
{
	struct model m;
	json_t *f = figures_read(path, &m);
	assert_int_equal(json_int(f, "branches", -1), branches);
	assert_int_equal(json_int(f, "closed", -1), closed);
	assert_int_equal(json_int(f, "undecided", -1), 0);
	assert_int_equal(json_int(f, "creases", -1), 0);
	near(json_number(f, "length", NAN), length, 1e-4);
	assert_true(json_number(f, "max_step", NAN) < 1e-9);
	/* every part carries the number of a curve */
	for (int i = 4; i < m.n; i++) {
		const char *number = entity_get_attribute(&m.entities[i], "curve");
		assert_non_null(number);
		assert_in_range(atoi(number), 1, branches);
	}
	json_decref(f);
	model_finish(&m);
}

/* What crosses from quarter to quarter is one curve. */
static void test_quarters(void **state)
{
	(void)state;
	const double circle = 2 * M_PI * radius;
	run_well(contours, "ball.base", "--plane", "1,2,2", "--from", "0.5", "--tolerance", "1e-6",
	         NULL);
	expect("ball.contour", 1, 1, circle * sqrt(1 - 0.0625));
	run_well(contours, "ball.base", "--cylinder", "0,0,1", "--from", "1", "--tolerance", "1e-6",
	         "-o", "drilled", NULL);
	expect("drilled.contour", 2, 2, circle);
	run_well(isophotes, "ball.base", "--angle", "60", "--light", "1,1,1", "--tolerance", "1e-6",
	         NULL);
	expect("ball.isophote", 1, 1, circle * sin(M_PI / 3));
	run_well(reflection, "ball.base", "--kind", "silhouette", "--view", "30,20:orthographic",
	         "--tolerance", "1e-6", NULL);
	expect("ball.reflect", 1, 1, circle);
	/* two circles about the axis, of radius 3 + 1 / 3 */
	run_well(isocurvature, "ring.base", "--quantity", "K", "--level", "0.1", "--tolerance",
	         "1e-6", NULL);
	expect("ring.isocurvature", 2, 2, 4 * M_PI * (3 + 1.0 / 3));
}

static void test_same_bytes(void **state)
{
	(void)state;
	run_well(isophotes, "ring.base", "--svg", "--threads", "1", "-o", "one", NULL);
	run_well(isophotes, "ring.base", "--svg", "--threads", "4", "-o", "four", NULL);
	assert_same_file("one.isophote", "four.isophote");
	assert_same_file("one.isophote.svg", "four.isophote.svg");
	run_well(contours, "block.base", "--plane", "1,1,1", "--threads", "1", "-o", "one", NULL);
	run_well(contours, "block.base", "--plane", "1,1,1", "--threads", "4", "-o", "four", NULL);
	assert_same_file("one.contour", "four.contour");
}

/* Sections of a block of trimmed planes: figures with area, centroid and girth. */
static void test_block(void **state)
{
	(void)state;
	struct model m;
	json_t *f, *row, *c;
	size_t i;
	run_well(contours, "block.base", "--plane", "0,0,1", "--from", "0.25", "--spacing", "0.25",
	         "--count", "3", NULL);
	f = figures_read("block.contour", &m);
	json_array_foreach(json_object_get(f, "levels"), i, row)
	{
		assert_int_equal(json_int(row, "branches", -1), 1);
		assert_int_equal(json_int(row, "closed", -1), 1);
		near(json_number(row, "area", NAN), 6, 1e-9);
		near(json_number(row, "girth", NAN), 10, 1e-9);
		c = json_object_get(row, "centroid");
		near(json_number_value(json_array_get(c, 0)), 1.5, 1e-9);
		near(json_number_value(json_array_get(c, 1)), 1, 1e-9);
		near(json_number_value(json_array_get(c, 2)), 0.25 * (double)(i + 1), 1e-9);
	}
	json_decref(f);
	model_finish(&m);
	/* x + y + z = 3: a parallelogram over the strip from x + y = 2 to 3, of area 2 */
	run_well(contours, "block.base", "--plane", "1,1,1", "--point", "1.5,1,0.5", NULL);
	f = figures_read("block.contour", &m);
	row = json_array_get(json_object_get(f, "levels"), 0);
	assert_int_equal(json_int(row, "closed", -1), 1);
	near(json_number(row, "area", NAN), 2 * sqrt(3), 1e-9);
	near(json_number(row, "girth", NAN), 2 * (2 * sqrt(2) + sqrt(2)), 1e-9);
	/* faces are written with their trims */
	assert_int_equal(m.entities[0].trim.n, 1);
	json_decref(f);
	model_finish(&m);
	/* the top itself: its four edges are there once, and it is a region */
	run_well(contours, "block.base", "--plane", "0,0,1", "--from", "1", "-o", "top", NULL);
	f = figures_read("top.contour", &m);
	near(json_number(f, "length", NAN), 10, 1e-9);
	assert_int_equal(json_int(f, "branches", -1), 1);
	assert_int_equal(json_int(f, "closed", -1), 1);
	assert_int_equal(json_int(f, "undecided", -1), 1);
	json_decref(f);
	model_finish(&m);
}

/* Without the trims: all of the planes, and that is said. */
static void test_untrimmed(void **state)
{
	(void)state;
	struct ran r = run_hand(contours, "block.base", "--plane", "0,0,1", "--from", "0.5",
	                        "--trimmed", "no", "-o", "whole", NULL);
	assert_int_equal(r.exit_status, 0);
	assert_non_null(
	        strstr(r.err, "trims are ignored: the curves are those of 6 whole surfaces"));
	ran_finish(&r);
	struct model m;
	json_t *f = figures_read("whole.contour", &m);
	near(json_number(f, "length", NAN), 2 * (4 + 3), 1e-9);
	assert_int_equal(m.entities[0].trim.n, 0);
	json_decref(f);
	model_finish(&m);
}

int main(int argc, char **argv)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_quarters),
		cmocka_unit_test(test_same_bytes),
		cmocka_unit_test(test_block),
		cmocka_unit_test(test_untrimmed),
	};
	if (argc != 5)
		return 2;
	contours = realpath(argv[1], NULL); /* tests work in another folder */
	isophotes = realpath(argv[2], NULL);
	isocurvature = realpath(argv[3], NULL);
	reflection = realpath(argv[4], NULL);
	int failed = cmocka_run_group_tests(tests, enter, bodies_leave);
	free(contours);
	free(isophotes);
	free(isocurvature);
	free(reflection);
	return failed;
}
