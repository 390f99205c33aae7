/* test_curvature.c - the curvature worker against closed forms: values, figures, places, pictures. */
#include "bodies.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "exr.h"
#include "json.h"

static const double major = 20, minor = 5;

static char *curvature;

static int enter(void **state)
{
	static struct place place;
	*state = &place;
	place_enter(&place);
	body_write("torus.base", "mm", body_torus(vec3(1, 2, 3), major, minor));
	body_write("sphere.base", "mm", body_sphere(vec3(0, 0, 0), 2));
	body_write("saddle.base", "mm",
	           body_corners(vec3(0, 0, 0), vec3(4, 0, 0), vec3(0, 3, 0), vec3(4, 3, 2)));
	return 0;
}

/* K of the torus at a point of it. */
static double torus_gaussian(double x, double y)
{
	double out = hypot(x - 1, y - 2); /* from the axis */
	return (out - major) / (minor * minor * out);
}

/* The value at each sample is that of the surface there: x is u, y is v from the top down, and the
 * first and last samples lie on the ends of the domain. */
static void test_places(void **state)
{
	enum { NU = 70, NV = 131 }; /* more than one tile, none of them whole at the border */
	(void)state;
	run_well(curvature, "saddle.base", "--grid", "70x131", NULL);
	struct exr_picture p;
	assert_int_equal(exr_read(&p, "saddle.map.exr", NULL), ST_OK);
	assert_int_equal(p.width, NU);
	assert_int_equal(p.height, NV);
	assert_int_equal(p.n_channels, 7);
	const float *k = exr_plane(&p, "K"), *h = exr_plane(&p, "H");
	for (int y = 0; y < NV; y++)
		for (int x = 0; x < NU; x++) {
			/* S = (4 u, 3 v, 2 u v) */
			double u = x / (NU - 1.0), v = 1 - y / (NV - 1.0);
			double e = 16 + 4 * v * v, f = 4 * u * v, g = 9 + 4 * u * u;
			double area = e * g - f * f, m = 24 / sqrt(area);
			near(k[y * NU + x], -m * m / area, 1e-6 * m * m / area);
			near(h[y * NU + x], -f * m / area, 1e-6);
		}
	assert_string_equal(exr_text(&p, "unit"), "mm");
	assert_string_equal(exr_text(&p, "param.grid"), "70x131");
	exr_picture_finish(&p);
}

static double figure(const json_t *figures, const char *name)
{
	assert_true(json_is_number(json_object_get(figures, name)));
	return json_number(figures, name, NAN);
}

static json_t *picture_figures(const char *path)
{
	struct exr_picture p;
	json_t *figures;
	assert_int_equal(exr_read_attributes(&p, path, NULL), ST_OK);
	const char *text = exr_text(&p, "figures");
	assert_non_null(text);
	assert_int_equal(json_parse_object(text, strlen(text), path, &figures, NULL), ST_OK);
	exr_picture_finish(&p);
	return figures;
}

static void test_figures(void **state)
{
	(void)state;
	run_well(curvature, "torus.base", "--grid", "129x129", NULL);
	json_t *f = picture_figures("torus.map.exr");
	near(figure(f, "samples"), 129 * 129, 0);
	near(figure(f, "undefined"), 0, 0);
	near(figure(f, "K_min"), -1 / (minor * (major - minor)), 1e-14);
	near(figure(f, "K_max"), 1 / (minor * (major + minor)), 1e-14);
	near(fabs(figure(f, "kmax_max")) + fabs(figure(f, "kmin_min")),
	     1 / minor + 1 / (major - minor), 1e-13);
	near(figure(f, "kabs_max"), 1 / minor + 1 / (major - minor), 1e-14);
	json_t *uv = json_object_get(f, "K_min_uv");
	assert_int_equal(json_array_size(uv), 2);
	assert_non_null(json_object_get(f, "kn_v_max_uv"));
	json_decref(f);

	/* a sphere's poles have limits, so nothing is missing */
	run_well(curvature, "sphere.base", "--grid", "33x33", NULL);
	f = picture_figures("sphere.map.exr");
	near(figure(f, "undefined"), 0, 0);
	near(figure(f, "K_min"), 0.25, 1e-7);
	near(figure(f, "K_max"), 0.25, 1e-7);
	near(fabs(figure(f, "H_max")), 0.5, 1e-7);
	json_decref(f);
}

/* Hits lie on the torus and have the curvature of the place they are at. */
static void test_view(void **state)
{
	(void)state;
	run_well(curvature, "torus.base", "--grid", "16x16", "--view", "20,40:perspective",
	         "--size", "150x100", NULL);
	struct exr_picture p;
	assert_int_equal(exr_read(&p, "torus.view.exr", NULL), ST_OK);
	assert_int_equal(p.n_channels, 14);
	const float *k = exr_plane(&p, "K"), *z = exr_plane(&p, "Z"), *px = exr_plane(&p, "P.X"),
	            *py = exr_plane(&p, "P.Y"), *pz = exr_plane(&p, "P.Z");
	int hits = 0, hole = 0;
	for (int i = 0; i < 150 * 100; i++) {
		if (isinf(z[i])) {
			assert_true(isnan(k[i]));
			continue;
		}
		double ring = hypot(px[i] - 1, py[i] - 2) - major;
		near(hypot(ring, pz[i] - 3), minor, 1e-4);
		near(k[i], torus_gaussian(px[i], py[i]), 1e-6);
		hits++;
	}
	for (int y = 45; y < 55; y++)
		for (int x = 70; x < 80; x++)
			hole += isinf(z[y * 150 + x]);
	assert_true(hits > 2000);
	assert_true(hole > 50);
	exr_picture_finish(&p);
	assert_true(there("torus.view.png"));
}

/* All files, with any number of threads. */
static void test_same_bytes(void **state)
{
	static const char *const extensions[] = { "map.exr", "map.png", "view.exr", "view.png" };
	(void)state;
	run_well(curvature, "torus.base", "--grid", "150x90", "--png", "--view", "top", "--size",
	         "130x130", "--threads", "1", "-o", "one", NULL);
	run_well(curvature, "torus.base", "--grid", "150x90", "--png", "--view", "top", "--size",
	         "130x130", "--threads", "4", "-o", "four", NULL);
	for (int i = 0; i < 4; i++) {
		char a[32], b[32];
		snprintf(a, sizeof a, "one.%s", extensions[i]);
		snprintf(b, sizeof b, "four.%s", extensions[i]);
		assert_same_file(a, b);
	}
}

/* What the picture shows is a parameter; the values are not touched by it. */
static void test_quantities(void **state)
{
	static const char *const names[] = { "K", "H", "kabs", "kmax", "kmin", "kn_u", "kn_v" };
	(void)state;
	for (int i = 0; i < 7; i++) {
		run_well(curvature, "saddle.base", "--grid", "9x9", "--png", "--quantity", names[i],
		         "--scale", i % 2 ? "linear" : "arsinh", "-o", names[i], NULL);
		char path[32];
		snprintf(path, sizeof path, "%s.map.png", names[i]);
		assert_true(there(path));
	}
	run_well(curvature, "saddle.base", "--grid", "9x9", "--png", "--range", "-1,2.5e0", "-o",
	         "range", NULL);
	assert_true(there("range.map.png"));
	run_well(curvature, "saddle.base", "--grid", "1x1", "--png", "-o", "single", NULL);
	run_well(curvature, "saddle.base", "--grid", "1x5", "--png", "-o", "column", NULL);
}

static void test_refused(void **state)
{
	static const struct {
		const char *option, *value, *word;
	} cases[] = {
		{ "--range", "1", "LO,HI" },         { "--range", "2,1", "LO,HI" },
		{ "--range", "1,2,3", "LO,HI" },     { "--range", "nan,1", "LO,HI" },
		{ "--range", "-1e999,1", "LO,HI" },  { "--quantity", "k", "kmax" },
		{ "--scale", "log", "arsinh" },      { "--grid", "0x4", "grid" },
		{ "--view", "sideways", "AZIMUTH" },
	};
	(void)state;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		struct ran r = run_hand(curvature, "torus.base", "-o", "refused", cases[i].option,
		                        cases[i].value, NULL);
		assert_int_equal(r.exit_status, 2);
		if (!strstr(r.err, cases[i].word))
			fail_msg("'%s' is not in '%s'", cases[i].word, r.err);
		assert_false(there("refused.map.exr"));
		ran_finish(&r);
	}
	struct ran r = run_hand(curvature, "torus.base", "--grid", "20000x2", "--png", NULL);
	assert_int_equal(r.exit_status, 2);
	ran_finish(&r);
	r = run_hand(curvature, "torus.base", "--view", "top", "--size", "40000x2", NULL);
	assert_int_equal(r.exit_status, 2);
	ran_finish(&r);
}

int main(int argc, char **argv)
{
	if (argc < 2)
		return 2;
	curvature = realpath(argv[1], NULL); /* tests work in other folders */
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_places, enter, bodies_leave),
		cmocka_unit_test_setup_teardown(test_figures, enter, bodies_leave),
		cmocka_unit_test_setup_teardown(test_view, enter, bodies_leave),
		cmocka_unit_test_setup_teardown(test_same_bytes, enter, bodies_leave),
		cmocka_unit_test_setup_teardown(test_quantities, enter, bodies_leave),
		cmocka_unit_test_setup_teardown(test_refused, enter, bodies_leave),
	};
	int rc = cmocka_run_group_tests(tests, NULL, NULL);
	free(curvature);
	return rc;
}
