/* test_isocurvature.c - the isocurvature worker on a torus: circles, figures, drawing, refusals. */
#include "bodies.h"

#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include "curvature.h"
#include "json.h"
#include "refine.h"

static char *isocurvature;

static int enter(void **state)
{
	static struct place place;
	*state = &place;
	place_enter(&place);
	body_write("torus.base", NULL, body_torus(vec3(0, 0, 0), 3, 1));
	return 0;
}

static void ran(int status, struct ran r)
{
	if (r.exit_status != status)
		fail_msg("exit status %d: %s", r.exit_status, r.err);
	ran_finish(&r);
}

static double figure(const struct model *m, const char *name)
{
	json_t *figures = figures_of(m);
	const double x = json_number(figures, name, NAN);
	json_decref(figures);
	return x;
}

/* K = cos a / (3 + cos a) = 0.1 at cos a = 1/3: two circles; to both tolerances. */
static void test_circles(void **state)
{
	(void)state;
	struct model m;
	ran(0, run_hand(isocurvature, "torus.base", "--quantity", "K", "--level", "0.1",
	                "--tolerance", "1e-6", "--tolerance-uv", "1e-7", "--svg", NULL));
	assert_int_equal(model_read(&m, "torus.isocurvature", NULL, NULL), ST_OK);
	assert_true(figure(&m, "branches") == 2 && figure(&m, "closed") == 2);
	assert_true(figure(&m, "undecided") == 0);
	assert_true(figure(&m, "max_error") <= 1.01e-6);
	assert_true(figure(&m, "max_error_uv") <= 1.01e-7);
	assert_true(fabs(figure(&m, "length") - 4 * M_PI * (3 + 1.0 / 3)) < 1e-5);
	assert_int_equal(m.n, 3);
	assert_string_equal(entity_get_attribute(&m.entities[1], "K"), "0.1");
	model_finish(&m);
	assert_int_equal(access("torus.isocurvature.svg", R_OK), 0);
}

/* Several values; those out of reach have none. */
static void test_levels(void **state)
{
	(void)state;
	struct model m;
	ran(0, run_hand(isocurvature, "torus.base", "--quantity", "H", "--from", "-0.65", "--to",
	                "-0.2", "--count", "4", "-o", "mean", NULL));
	assert_int_equal(model_read(&m, "mean.isocurvature", NULL, NULL), ST_OK);
	/* H = -(3 + 2 cos a) / (2 (3 + cos a)) from -0.625 to -0.25: two of four */
	assert_true(figure(&m, "branches") == 4 && figure(&m, "closed") == 4);
	model_finish(&m);
}

/* An ellipsoid has four umbilics, told of whatever the value; curves of theirs end in them, two each. */
static void test_umbilics(void **state)
{
	(void)state;
	const double stretch[3][4] = { { 3, 0, 0, 0 }, { 0, 2, 0, 0 }, { 0, 0, 1, 0 } };
	struct surface s = body_sphere(vec3(0, 0, 0), 1);
	struct surface_shape pole;
	surface_transform(&s, stretch);
	surface_shape(&s, 0.1, 0.1, &pole);
	const char *value = pole.value[QUANTITY_MEAN] < 0 ? "-0.375" : "0.375";
	body_write("egg.base", NULL, s);
	for (int own = 0; own < 2; own++) {
		struct model m;
		ran(0, run_hand(isocurvature, "egg.base", "--quantity", "kmax", "--level",
		                own ? value : "7", NULL));
		assert_int_equal(model_read(&m, "egg.isocurvature", NULL, NULL), ST_OK);
		assert_true(figure(&m, "umbilics") == 4);
		assert_true(figure(&m, "umbilic_regions") == 0 &&
		            figure(&m, "umbilic_undecided") == 0);
		assert_true(figure(&m, "undecided") == (own ? 4 : 0));
		json_t *figures = figures_of(&m),
		       *points = json_object_get(figures, "umbilic_points");
		assert_int_equal(json_array_size(points), 4);
		for (size_t i = 0; i < 4; i++) {
			const json_t *row = json_array_get(points, i);
			near(fabs(json_number(row, "curvature", 0)), 0.375, 1e-9);
			near(json_number(row, "index", 0), 0.5, 0);
		}
		json_decref(figures);
		const struct entity *last = &m.entities[m.n - 1];
		assert_string_equal(entity_get_attribute(last, "umbilics"), "points");
		assert_string_equal(entity_get_attribute(last, "halves"), "1 1 1 1");
		assert_int_equal(last->points.n, 4);
		if (own) {
			const struct entity *boxes = &m.entities[m.n - 2];
			assert_string_equal(entity_get_attribute(boxes, "kinds"),
			                    "umbilic umbilic umbilic umbilic");
			assert_string_equal(entity_get_attribute(boxes, "ends"), "2 2 2 2");
		}
		model_finish(&m);
	}
}

static void test_refused(void **state)
{
	(void)state;
	ran(2, run_hand(isocurvature, "torus.base", "--quantity", "kabs", NULL));
	ran(2, run_hand(isocurvature, "torus.base", "--level", "1", "--from", "0", NULL));
	ran(2, run_hand(isocurvature, "torus.base", "--from", "1", NULL));
	ran(2, run_hand(isocurvature, "torus.base", "--from", "1", "--to", "0", NULL));
}

int main(int argc, char **argv)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_circles),
		cmocka_unit_test(test_levels),
		cmocka_unit_test(test_umbilics),
		cmocka_unit_test(test_refused),
	};
	if (argc != 2)
		return 2;
	isocurvature = realpath(argv[1], NULL);
	int failed = cmocka_run_group_tests(tests, enter, bodies_leave);
	free(isocurvature);
	return failed;
}
