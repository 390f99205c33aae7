/* test_reflection.c - reflection, highlight lines and silhouettes against formulas and the laws of
 * mirrors. */
#include "bodies.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "construct.h"
#include "json.h"

static const double radius = 2;

static char *reflection;

static int enter(void **state)
{
	static struct place place;
	*state = &place;
	place_enter(&place);
	body_write("sphere.base", NULL, body_sphere(vec3(0, 0, 0), radius));
	body_write("flat.base", NULL,
	           body_corners(vec3(0, 0, 0), vec3(4, 0, 0), vec3(0, 3, 0), vec3(4, 3, 0)));
	struct surface s;
	struct curve arc;
	assert_int_equal(
	        make_arc(&arc, vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0), 3, 0, 2 * M_PI), ST_OK);
	assert_int_equal(make_cylinder(&s, &arc, vec3(0, 0, 8)), ST_OK);
	curve_finish(&arc);
	body_write("cylinder.base", NULL, s);
	return 0;
}

static json_t *result_read(struct model *m, const char *path)
{
	assert_int_equal(model_read(m, path, NULL, NULL), ST_OK);
	return figures_of(m);
}

static void expect_figures(json_t *f, int branches, int closed, double length, double tolerance)
{
	assert_int_equal(json_int(f, "branches", -1), branches);
	assert_int_equal(json_int(f, "closed", -1), closed);
	assert_int_equal(json_int(f, "undecided", -1), 0);
	near(json_number(f, "length", NAN), length, tolerance);
}

/* Seen from a point: a small circle; from far away: a great one. */
static void test_silhouette(void **state)
{
	(void)state;
	struct model m;
	run_well(reflection, "sphere.base", "--kind", "silhouette", "--eye", "6,0,8", "--tolerance",
	         "1e-6", NULL);
	json_t *f = result_read(&m, "sphere.reflect");
	const double d = radius * radius / 10, r = sqrt(radius * radius - d * d);
	expect_figures(f, 1, 1, 2 * M_PI * r, 1e-5);
	for (int k = 0; k <= 200; k++) {
		const struct curve *c = &m.entities[1].space;
		struct vec3 p = curve_point(c, c->domain[1] * k / 200);
		near(vec3_dot(p, vec3(0.6, 0, 0.8)), d, 1e-6);
	}
	assert_null(entity_get_attribute(&m.entities[1], "line"));
	json_decref(f);
	model_finish(&m);
	run_well(reflection, "sphere.base", "--kind", "silhouette", "--view", "30,20",
	         "--tolerance", "1e-6", NULL);
	f = result_read(&m, "sphere.reflect");
	expect_figures(f, 1, 1, 2 * M_PI * radius, 1e-5);
	json_decref(f);
	model_finish(&m);
	run_well(reflection, "sphere.base", "--kind", "silhouette", "--view", "30,20:perspective",
	         "--tolerance", "1e-6", NULL);
	f = result_read(&m, "sphere.reflect");
	assert_true(json_number(f, "length", NAN) < 2 * M_PI * radius - 0.1);
	json_decref(f);
	model_finish(&m);
}

/* All normals of a sphere go through its centre: those that meet a line make a great circle. */
static void test_highlight(void **state)
{
	(void)state;
	struct model m;
	run_well(reflection, "sphere.base", "--kind", "highlight", "--point", "0,1,5",
	         "--direction", "1,0,0", "--across", "0,1,0", "--spacing", "1", "--count", "3",
	         "--tolerance", "1e-6", NULL);
	json_t *f = result_read(&m, "sphere.reflect");
	assert_int_equal(json_array_size(json_object_get(f, "levels")), 3);
	near(json_number(f, "length", NAN), 3 * 2 * M_PI * radius, 1e-4);
	for (int i = 1; i < m.n; i++) {
		const struct entity *e = &m.entities[i];
		const double line = strtod(entity_get_attribute(e, "line"), NULL), y = line - 1;
		for (int k = 0; k <= 100; k++) {
			struct vec3 p = curve_point(&e->space, e->space.domain[1] * k / 100);
			near((5 * p.y - y * p.z) / hypot(5, y), 0, 2e-6);
		}
	}
	json_decref(f);
	model_finish(&m);
}

/* A plane mirror shows the lights where the mirrored eye sees them through it: straight lines. */
static void test_plane_mirror(void **state)
{
	(void)state;
	struct model m;
	run_well(reflection, "flat.base", "--eye", "1,1,2", "--point", "0,2,5", "--direction",
	         "2,0,0", "--across", "0,3,0", "--spacing", "1", "--count", "3", "--tolerance",
	         "1e-6", "--svg", NULL);
	json_t *f = result_read(&m, "flat.reflect");
	expect_figures(f, 3, 0, 12, 1e-5);
	for (int i = 1; i <= 3; i++) {
		const struct entity *e = &m.entities[i];
		const double y = 1 + (i - 1) * 2.0 / 7;
		near(strtod(entity_get_attribute(e, "line"), NULL), i, 0);
		for (int k = 0; k <= 50; k++)
			near(curve_point(&e->space, e->space.domain[1] * k / 50).y, y, 1e-6);
	}
	json_decref(f);
	model_finish(&m);
	size_t n;
	char *svg = slurp("flat.reflect.svg", &n);
	assert_non_null(strstr(svg, "Reflection lines"));
	free(svg);
}

/* On curved mirrors: the ray from the eye, reflected at each point found, meets the line. */
static void test_mirror(void **state)
{
	static const struct {
		const char *input, *output;
		bool sphere;
	} rows[] = { { "sphere.base", "sphere.reflect", true },
		     { "cylinder.base", "cylinder.reflect", false } };
	const struct vec3 eye = { 9, -7, 6 }, across = { 0, 1, 0 };
	const struct vec3 direction = vec3_unit(vec3(1, 1, 0.5));
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
		struct model m;
		run_well(reflection, rows[i].input, "--eye", "9,-7,6", "--point", "7,2,9",
		         "--direction", "1,1,0.5", "--across", "0,1,0", "--spacing", "2", "--count",
		         "4", "--tolerance", "1e-7", NULL);
		json_t *f = result_read(&m, rows[i].output);
		assert_true(json_int(f, "branches", -1) >= 4);
		assert_true(json_number(f, "max_error", NAN) <= 1e-7);
		for (int k = 1; k < m.n; k++) {
			const struct entity *e = &m.entities[k];
			if (e->kind != ENTITY_CURVE_ON_SURFACE)
				continue;
			const double line = strtod(entity_get_attribute(e, "line"), NULL);
			const struct vec3 q = vec3_along(vec3(7, 2, 9), 2 * (line - 2.5), across);
			for (int j = 0; j <= 60; j++) {
				struct vec3 p = curve_point(&e->space, e->space.domain[1] * j / 60);
				struct vec3 n = vec3_unit(rows[i].sphere ? p : vec3(p.x, p.y, 0));
				struct vec3 in = vec3_unit(vec3_sub(p, eye));
				struct vec3 out = vec3_along(in, -2 * vec3_dot(in, n), n);
				struct vec3 normal = vec3_cross(out, direction);
				near(vec3_dot(normal, vec3_sub(q, p)), 0, 1e-5);
			}
		}
		json_decref(f);
		model_finish(&m);
	}
}

static void test_same_bytes(void **state)
{
	static const char *const kinds[] = { "reflection", "highlight", "silhouette" };
	(void)state;
	for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
		run_well(reflection, "cylinder.base", "--kind", kinds[i], "--svg", "--threads", "1",
		         "-o", "one", NULL);
		run_well(reflection, "cylinder.base", "--kind", kinds[i], "--svg", "--threads", "4",
		         "-o", "four", NULL);
		assert_same_file("one.reflect", "four.reflect");
		assert_same_file("one.reflect.svg", "four.reflect.svg");
	}
}

static void test_wrong(void **state)
{
	static const struct refusal wrong[] = {
		{ "sphere.base", { "--kind", "shine" }, 2, "kind" },
		{ "sphere.base", { "--direction", "0,0,0" }, 2, "direction" },
		{ "sphere.base", { "--direction", "1,0,0", "--across", "2,0,0" }, 2, "across" },
		{ "sphere.base", { "--spacing", "0" }, 2, "spacing" },
		{ "sphere.base", { "--count", "0" }, 2, "count" },
		{ "sphere.base", { "--view", "behind" }, 2, "view" },
		{ "sphere.base", { "--tolerance", "0" }, 2, "tolerance" },
	};
	(void)state;
	expect_refusals(reflection, wrong, sizeof wrong / sizeof *wrong, "wrong.reflect");
}

int main(int argc, char **argv)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_silhouette),   cmocka_unit_test(test_highlight),
		cmocka_unit_test(test_plane_mirror), cmocka_unit_test(test_mirror),
		cmocka_unit_test(test_same_bytes),   cmocka_unit_test(test_wrong),
	};
	if (argc < 2)
		return 2;
	reflection = realpath(argv[1], NULL); /* tests work in another folder */
	int rc = cmocka_run_group_tests(tests, enter, bodies_leave);
	free(reflection);
	return rc;
}
