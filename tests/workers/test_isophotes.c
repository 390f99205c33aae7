/* test_isophotes.c - the isophotes worker against circles on a sphere: figures, file, drawing. */
#include "bodies.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "json.h"

static const double radius = 2;

static char *isophotes;

static int enter(void **state)
{
	static struct place place;
	*state = &place;
	place_enter(&place);
	body_write("sphere.base", "mm", body_sphere(vec3(0, 0, 0), radius));
	body_write("torus.base", "mm", body_torus(vec3(1, 2, 3), 20, 5));
	body_write("flat.base", "mm",
	           body_corners(vec3(0, 0, 0), vec3(4, 0, 0), vec3(0, 3, 0), vec3(4, 3, 0)));
	const struct vec3 p = vec3(1, 1, 1);
	body_write("point.base", "mm", body_corners(p, p, p, p));
	return 0;
}

static void curves_read(struct model *m, const char *path)
{
	assert_int_equal(model_read(m, path, NULL, NULL), ST_OK);
}

static double number_of(const struct entity *e, const char *name)
{
	const char *text = entity_get_attribute(e, name);
	assert_non_null(text);
	return strtod(text, NULL);
}

/* One angle: its circle, as curve on surface and in space. */
static void test_circle(void **state)
{
	(void)state;
	run_well(isophotes, "sphere.base", "--angle", "60", "--light", "0,0,3", "--tolerance",
	         "1e-6", NULL);
	struct model m;
	curves_read(&m, "sphere.isophote");
	json_t *f = figures_of(&m);
	assert_int_equal(json_object_size(f), 6);
	assert_int_equal(json_int(f, "branches", -1), 1);
	assert_int_equal(json_int(f, "closed", -1), 1);
	assert_int_equal(json_int(f, "undecided", -1), 0);
	near(json_number(f, "length", NAN), 2 * M_PI * radius * sin(M_PI / 3), 1e-5);
	assert_true(json_number(f, "max_error", NAN) <= 1e-6);
	json_decref(f);

	assert_int_equal(m.n, 2);
	assert_string_equal(m.unit, "mm");
	assert_string_equal(model_get_attribute(&m, "param.angle"), "60");
	assert_int_equal(m.entities[0].kind, ENTITY_SURFACE);
	const struct entity *e = &m.entities[1];
	assert_int_equal(e->kind, ENTITY_CURVE_ON_SURFACE);
	assert_int_equal(e->surface, 0);
	near(number_of(e, "angle"), 60, 0);
	assert_string_equal(entity_get_attribute(e, "closed"), "yes");
	assert_true(number_of(e, "max_error") <= 1e-6);
	assert_int_equal(e->curve.order, 4);
	assert_int_equal(e->space.order, 4);
	for (int k = 0; k <= 1000; k++) {
		double t = e->space.domain[1] * k / 1000;
		struct vec3 p = curve_point(&e->space, t), uv = curve_point(&e->curve, t);
		struct vec3 q = surface_point(&m.entities[0].geometry, uv.x, uv.y);
		near(p.z, radius / 2, 1e-6);
		near(q.z, radius / 2, 1e-6);
		near(hypot(p.x, p.y), radius * sin(M_PI / 3), 1e-6);
	}
	model_finish(&m);
}

/* Several angles: a row each, sums over all. */
static void test_levels(void **state)
{
	(void)state;
	run_well(isophotes, "torus.base", "--from", "30", "--to", "150", "--count", "5", "--svg",
	         NULL);
	struct model m;
	curves_read(&m, "torus.isophote");
	json_t *f = figures_of(&m), *levels = json_object_get(f, "levels"), *row;
	double length = 0;
	size_t i;
	assert_int_equal(json_object_size(f), 7);
	assert_int_equal(json_array_size(levels), 5);
	json_array_foreach(levels, i, row)
	{
		assert_int_equal(json_object_size(row), 7);
		near(json_number(row, "angle", NAN), 30 + 30 * (double)i, 1e-12);
		assert_int_equal(json_int(row, "branches", -1), 2);
		assert_int_equal(json_int(row, "closed", -1), 2);
		/* two parallels whose radii have the mean 20 */
		near(json_number(row, "length", NAN), 80 * M_PI, 1e-3);
		length += json_number(row, "length", NAN);
	}
	assert_int_equal(json_int(f, "branches", -1), 10);
	assert_int_equal(json_int(f, "closed", -1), 10);
	near(json_number(f, "length", NAN), length, 1e-9);
	assert_int_equal(m.n, 11);
	json_decref(f);
	model_finish(&m);
	size_t n;
	char *svg = slurp("torus.isophote.svg", &n);
	assert_non_null(strstr(svg, "<svg"));
	free(svg);
	run_well(isophotes, "torus.base", "-o", "all", NULL);
	curves_read(&m, "all.isophote");
	f = figures_of(&m);
	assert_int_equal(json_array_size(json_object_get(f, "levels")), 17);
	assert_int_equal(json_int(f, "branches", -1), 34);
	json_decref(f);
	model_finish(&m);
}

/* What is undecided is in the file, as boxes in u, v. */
static void test_undecided(void **state)
{
	(void)state;
	run_well(isophotes, "flat.base", "--angle", "0", NULL);
	struct model m;
	curves_read(&m, "flat.isophote");
	json_t *f = figures_of(&m);
	assert_int_equal(json_int(f, "branches", -1), 0);
	assert_int_equal(json_int(f, "undecided", -1), 1);
	assert_int_equal(m.n, 2);
	const struct entity *e = &m.entities[1];
	assert_int_equal(e->kind, ENTITY_POINTS);
	assert_int_equal(e->points.n, 2);
	assert_int_equal(e->points.dimension, 2);
	const double *v = e->points.values;
	assert_true(v[0] == 0 && v[1] == 0 && v[2] == 1 && v[3] == 1);
	json_decref(f);
	model_finish(&m);
}

static void test_same_bytes(void **state)
{
	(void)state;
	run_well(isophotes, "torus.base", "--light", "1,2,3", "--svg", "--threads", "1", "-o",
	         "one", NULL);
	run_well(isophotes, "torus.base", "--light", "1,2,3", "--svg", "--threads", "4", "-o",
	         "four", NULL);
	assert_same_file("one.isophote", "four.isophote");
	assert_same_file("one.isophote.svg", "four.isophote.svg");
}

static void test_wrong(void **state)
{
	static const struct refusal wrong[] = {
		{ "sphere.base", { "--angle", "181" }, 2, "angle" },
		{ "sphere.base", { "--angle", "30", "--from", "10" }, 2, "twice" },
		{ "sphere.base", { "--from", "50", "--to", "40" }, 2, "above" },
		{ "sphere.base", { "--count", "0" }, 2, "count" },
		{ "sphere.base", { "--tolerance", "0" }, 2, "tolerance" },
		{ "sphere.base", { "--light", "0,0,0" }, 2, "light" },
		{ "point.base", { "--angle", "30" }, 1, "point" },
	};
	(void)state;
	expect_refusals(isophotes, wrong, sizeof wrong / sizeof *wrong, "wrong.isophote");
}

int main(int argc, char **argv)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_circle),    cmocka_unit_test(test_levels),
		cmocka_unit_test(test_undecided), cmocka_unit_test(test_same_bytes),
		cmocka_unit_test(test_wrong),
	};
	if (argc < 2)
		return 2;
	isophotes = realpath(argv[1], NULL); /* tests work in another folder */
	int rc = cmocka_run_group_tests(tests, enter, bodies_leave);
	free(isophotes);
	return rc;
}
