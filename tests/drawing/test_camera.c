/* test_camera.c - views fit, rays and projections are inverse, bad views are refused. */
#include "camera.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "construct.h"

static const struct box hull = { { -3, -1, 0 }, { 40, 5, 7 } };

static const char *const views[] = {
	"three-quarter",
	"front",
	"back",
	"left",
	"right",
	"top",
	"bottom",
	"30,20",
	"-120.5,-15e0",
	"0,90:orthographic",
	"three-quarter:perspective",
	"top:perspective@80",
	"12,-34:perspective@5",
};
enum { N_VIEWS = sizeof views / sizeof *views };

static const int sizes[][2] = { { 640, 480 }, { 480, 640 }, { 100, 100 }, { 1, 1 }, { 2000, 31 } };
enum { N_SIZES = sizeof sizes / sizeof *sizes };

static struct vec3 corner(const struct box *b, int i)
{
	return vec3(i & 1 ? b->hi.x : b->lo.x, i & 2 ? b->hi.y : b->lo.y,
	            i & 4 ? b->hi.z : b->lo.z);
}

static void near(double a, double b, double tolerance)
{
	if (!(fabs(a - b) <= tolerance))
		fail_msg("%.17g is not %.17g within %g", a, b, tolerance);
}

/* Everything lies inside the margins and something touches them. */
static void test_fit(void **state)
{
	(void)state;
	for (int i = 0; i < N_VIEWS; i++)
		for (int k = 0; k < N_SIZES; k++) {
			struct camera c;
			double w = sizes[k][0], h = sizes[k][1], used = 0;
			assert_int_equal(
			        camera_fit(&c, views[i], &hull, sizes[k][0], sizes[k][1], NULL),
			        ST_OK);
			for (int j = 0; j < 8; j++) {
				double x, y, depth;
				assert_true(camera_project(&c, corner(&hull, j), &x, &y, &depth));
				assert_true(depth > 0);
				used = fmax(used, fabs(2 * x / w - 1));
				used = fmax(used, fabs(2 * y / h - 1));
			}
			near(used, 0.88, 1e-9);
		}
}

/* A sphere fills the image to its margins from everywhere, up to the samples' distance. */
static void test_fit_surfaces(void **state)
{
	struct surface ball, speck;
	(void)state;
	assert_int_equal(make_sphere(&ball, vec3(3, -2, 50), 4), ST_OK);
	assert_int_equal(make_sphere(&speck, vec3(3, -2, 50), 1), ST_OK);
	const struct surface *both[] = { &ball, &speck };
	for (int i = 0; i < N_VIEWS; i++)
		for (int k = 0; k < N_SIZES; k++) {
			struct camera c;
			double x, y, depth, w = sizes[k][0], h = sizes[k][1], used[4] = { 0 };
			assert_int_equal(camera_fit_surfaces(&c, views[i], both, 2, sizes[k][0],
			                                     sizes[k][1], NULL),
			                 ST_OK);
			for (int a = 0; a <= 200; a++)
				for (int b = 0; b <= 200; b++) {
					struct vec3 p =
					        surface_point(&ball, ball.domain[0][1] * a / 200,
					                      ball.domain[1][0] * (200 - b) / 200 +
					                              ball.domain[1][1] * b / 200);
					assert_true(camera_project(&c, p, &x, &y, &depth));
					assert_true(depth > 0);
					used[0] = fmax(used[0], 2 * x / w - 1);
					used[1] = fmax(used[1], 1 - 2 * x / w);
					used[2] = fmax(used[2], 2 * y / h - 1);
					used[3] = fmax(used[3], 1 - 2 * y / h);
				}
			near(fmax(used[0], used[2]), 0.88, 0.01);
			near(used[0], used[1], 0.01);
			near(used[2], used[3], 0.01);
		}
	surface_finish(&ball);
	surface_finish(&speck);
}

static void test_axes(void **state)
{
	(void)state;
	for (int i = 0; i < N_VIEWS; i++) {
		struct camera c;
		assert_int_equal(camera_fit(&c, views[i], &hull, 640, 480, NULL), ST_OK);
		struct vec3 back = vec3_cross(c.right, c.up);
		near(vec3_length(c.right), 1, 1e-15);
		near(vec3_length(c.up), 1, 1e-15);
		near(vec3_length(vec3_add(back, c.ahead)), 0, 1e-15);
		assert_true(c.right.z == 0 && c.up.z >= 0);
	}
}

static void test_named(void **state)
{
	static const struct {
		const char *view;
		struct vec3 ahead, right;
	} cases[] = {
		{ "front", { 0, 1, 0 }, { 1, 0, 0 } }, { "back", { 0, -1, 0 }, { -1, 0, 0 } },
		{ "left", { 1, 0, 0 }, { 0, -1, 0 } }, { "right", { -1, 0, 0 }, { 0, 1, 0 } },
		{ "top", { 0, 0, -1 }, { 1, 0, 0 } },  { "bottom", { 0, 0, 1 }, { 1, 0, 0 } },
		{ "270,0", { 0, 1, 0 }, { 1, 0, 0 } },
	};
	(void)state;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		struct camera c;
		assert_int_equal(camera_fit(&c, cases[i].view, &hull, 64, 64, NULL), ST_OK);
		near(vec3_length(vec3_sub(c.ahead, cases[i].ahead)), 0, 0);
		near(vec3_length(vec3_sub(c.right, cases[i].right)), 0, 0);
	}
}

/* A point on the ray through (x, y) is seen at (x, y). */
static void test_rays(void **state)
{
	static const double points[][2] = { { 0, 0 }, { 320, 240 }, { 0.5, 479.5 }, { 640, 480 } };
	(void)state;
	for (int i = 0; i < N_VIEWS; i++) {
		struct camera c;
		assert_int_equal(camera_fit(&c, views[i], &hull, 640, 480, NULL), ST_OK);
		for (size_t k = 0; k < sizeof points / sizeof *points; k++) {
			struct vec3 o, d;
			double x, y, depth;
			camera_ray(&c, points[k][0], points[k][1], &o, &d);
			near(vec3_length(d), 1, 1e-15);
			struct vec3 p = vec3_along(o, 17, d);
			assert_true(camera_project(&c, p, &x, &y, &depth));
			near(x, points[k][0], 1e-9);
			near(y, points[k][1], 1e-9);
			near(depth, 17 * vec3_dot(d, c.ahead), 1e-10);
			/* one pixel to the right is one pixel's length away */
			p = vec3_along(p, camera_pixel(&c, p), c.right);
			assert_true(camera_project(&c, p, &x, &y, &depth));
			near(x, points[k][0] + 1, 1e-9);
		}
	}
}

static void test_behind(void **state)
{
	struct camera c;
	double x, y, depth;
	(void)state;
	assert_int_equal(camera_fit(&c, "front:perspective", &hull, 64, 64, NULL), ST_OK);
	assert_false(camera_project(&c, vec3_along(c.eye, -1, c.ahead), &x, &y, &depth));
	assert_false(camera_project(&c, c.eye, &x, &y, &depth));
}

/* A point and lines seen end on give cameras that work. */
static void test_thin(void **state)
{
	static const struct box boxes[] = { { { 5, 5, 5 }, { 5, 5, 5 } },
		                            { { 0, -9, 0 }, { 0, 9, 0 } },
		                            { { 1, 0, 1 }, { 2, 0, 1 } } };
	static const char *const both[] = { "front", "front:perspective" };
	(void)state;
	for (int i = 0; i < 3; i++)
		for (int k = 0; k < 2; k++) {
			struct camera c;
			double x, y, depth;
			assert_int_equal(camera_fit(&c, both[k], &boxes[i], 64, 64, NULL), ST_OK);
			for (int j = 0; j < 8; j++) {
				assert_true(
				        camera_project(&c, corner(&boxes[i], j), &x, &y, &depth));
				assert_true(x >= 0 && x <= 64 && y >= 0 && y <= 64 && depth > 0);
			}
		}
}

static void test_refused(void **state)
{
	static const char *const bad[] = {
		"side",
		"top ",
		"12",
		"12,",
		"12,34,56",
		"0,91",
		"1e99,0",
		"nan,0",
		"front:",
		"front:persp",
		"front@",
		"front:orthographic@30",
		"front:perspective@",
		"front:perspective@0",
		"front:perspective@180",
	};
	(void)state;
	struct camera c;
	struct report_store said;
	for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
		report_store_init(&said);
		if (camera_fit(&c, bad[i], &hull, 64, 64, &said.report) != ST_PARAMETER)
			fail_msg("'%s' was taken", bad[i]);
		assert_int_equal(said.n_errors, 1);
		assert_non_null(strstr(said.error, bad[i]));
	}
	struct box nothing = box_empty();
	assert_int_equal(camera_fit(&c, "front", &nothing, 64, 64, NULL), ST_INPUT);
	assert_int_equal(camera_fit(&c, "front", &hull, 0, 64, NULL), ST_PARAMETER);
	assert_int_equal(camera_fit(&c, NULL, &hull, 64, 64, NULL), ST_OK);
	assert_int_equal(camera_fit(&c, "", &hull, 64, 64, NULL), ST_OK);
}

/* A camera written is the same camera read, whatever is to be seen; only the size is the caller's. */
static void test_written(void **state)
{
	static const char *const wrong[] = {
		"camera:",
		"camera:1,2,3,1,0,0,0,1,0,0,0,-1,2",
		"camera:1,2,3,1,0,0,0,1,0,0,0,-1,2:wide",
		"camera:1,2,3,1,0,0,0,1,0,0,0,-1,0:perspective",
		"camera:1,2,3,1,0,0,0,1,0,0,0,1,2:perspective",
		"camera:1,2,3,1,0,0,0,2,0,0,0,-1,2:perspective",
		"camera:1e999,2,3,1,0,0,0,1,0,0,0,-1,2:perspective",
		"camera:1,2,3,1,0,0,0,1,0,0,0,-1,2,7:perspective",
		"camera:1,2,3,1,0,0,0,1,0,0,0,-1,2:perspective ",
	};
	char text[CAMERA_TEXT_SIZE], again[CAMERA_TEXT_SIZE];
	struct surface ball;
	const struct surface *one = &ball;
	struct camera c, d;

	(void)state;
	assert_int_equal(make_sphere(&ball, vec3(1, 2, 3), 5), ST_OK);
	for (int i = 0; i < N_VIEWS; i++) {
		assert_int_equal(camera_fit(&c, views[i], &hull, 640, 480, NULL), ST_OK);
		c.eye = vec3_along(c.eye, 1.0 / 3, c.up);
		camera_write(text, &c);
		assert_true(strlen(text) < CAMERA_TEXT_SIZE);
		assert_int_equal(camera_fit_surfaces(&d, text, &one, 1, 300, 700, NULL), ST_OK);
		camera_write(again, &d);
		assert_string_equal(text, again);
		assert_memory_equal(&c.eye, &d.eye, sizeof c.eye);
		assert_memory_equal(&c.ahead, &d.ahead, sizeof c.ahead);
		assert_true(c.half == d.half && c.kind == d.kind);
		assert_int_equal(d.width, 300);
		assert_int_equal(d.height, 700);
	}
	surface_finish(&ball);
	for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
		assert_int_equal(camera_fit(&d, wrong[i], &hull, 640, 480, NULL), ST_PARAMETER);
	assert_int_equal(camera_fit(&d, "camera:1,2,3,1,0,0,0,1,0,0,0,-1,2:perspective", &hull, 640,
	                            480, NULL),
	                 ST_OK);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_fit),     cmocka_unit_test(test_fit_surfaces),
		cmocka_unit_test(test_axes),    cmocka_unit_test(test_named),
		cmocka_unit_test(test_rays),    cmocka_unit_test(test_behind),
		cmocka_unit_test(test_thin),    cmocka_unit_test(test_refused),
		cmocka_unit_test(test_written),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
