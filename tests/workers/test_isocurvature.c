/* test_isocurvature.c - the isocurvature worker on a torus: circles, figures, drawing, refusals. */
#include "bodies.h"

#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include "json.h"

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
		cmocka_unit_test(test_refused),
	};
	if (argc != 2)
		return 2;
	isocurvature = realpath(argv[1], NULL);
	int failed = cmocka_run_group_tests(tests, enter, bodies_leave);
	free(isocurvature);
	return failed;
}
