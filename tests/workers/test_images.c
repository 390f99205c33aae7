/* test_images.c - the shading and ray tracing workers against formulas: masks, points, normals,
 * light, shadows, mirrors. */
#include "bodies.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "exr.h"
#include "json.h"

static char *shading, *raytrace;

static int enter(void **state)
{
	static struct place place;

	*state = &place;
	place_enter(&place);
	body_write("sphere.base", NULL, body_sphere(vec3(0, 0, 0), 2));
	body_write("square.base", NULL, body_square(2, 0));
	bodies_write("stack.base", NULL, (struct surface[]){ body_square(2, 0), body_square(1, 1) },
	             2);
	bodies_write("ball.base", NULL,
	             (struct surface[]){ body_square(4, 0), body_sphere(vec3(0, 0, 1.5), 1) }, 2);
	return 0;
}

/* An image with its planes by name. */
struct seen {
	struct exr_picture picture;
	int n;
	const float *r, *g, *b, *a, *z, *normal[3], *point[3];
};

static void see(struct seen *s, const char *path)
{
	static const char *const names[2][3] = { { "N.X", "N.Y", "N.Z" }, { "P.X", "P.Y", "P.Z" } };

	assert_int_equal(exr_read(&s->picture, path, NULL), ST_OK);
	assert_int_equal(s->picture.n_channels, 11);
	s->n = s->picture.width * s->picture.height;
	s->r = exr_plane(&s->picture, "R");
	s->g = exr_plane(&s->picture, "G");
	s->b = exr_plane(&s->picture, "B");
	s->a = exr_plane(&s->picture, "A");
	s->z = exr_plane(&s->picture, "Z");
	for (int e = 0; e < 3; e++) {
		s->normal[e] = exr_plane(&s->picture, names[0][e]);
		s->point[e] = exr_plane(&s->picture, names[1][e]);
	}
}

/* A white sphere with the light at the viewer's: both workers must give N . L and nothing else,
 * without a speckle; what is not covered is empty. */
static void test_sphere(void **state)
{
	static const char *const outputs[2] = { "sphere.shade.exr", "sphere.trace.exr" };

	(void)state;
	for (int k = 0; k < 2; k++) {
		struct seen s;
		size_t covered = 0;

		if (k == 0)
			run_well(shading, "sphere.base", "--view", "front", "--size", "200x160",
			         "--samples", "1", "--light", "0,-3,0", "--ambient", "0",
			         "--diffuse", "1", "--specular", "0", "--color", "#FFFFFF", NULL);
		else
			run_well(raytrace, "sphere.base", "--view", "front", "--size", "200x160",
			         "--samples", "1", "--light", "0,-3,0", "--ambient", "0",
			         "--diffuse", "1", "--specular", "0", "--color", "#FFFFFF",
			         "--mirror", "0", NULL);
		see(&s, outputs[k]);
		for (int i = 0; i < s.n; i++) {
			double p[3], along = 0;

			if (s.a[i] == 0) {
				assert_true(s.r[i] == 0 && s.g[i] == 0 && s.b[i] == 0);
				assert_true(isinf(s.z[i]));
				continue;
			}
			covered++;
			near((double)s.a[i], 1, 0);
			for (int e = 0; e < 3; e++) {
				p[e] = (double)s.point[e][i];
				along += p[e] * (double)s.normal[e][i];
			}
			near(sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]), 2, 1e-6);
			near(fabs(along), 2, 1e-6);
			near((double)s.r[i], -p[1] / 2, 1e-3);
			near((double)s.g[i], (double)s.r[i], 0);
			/* the eye stands at -y */
			near((double)s.z[i] - p[1], (double)s.z[s.n / 2 + 100] + 2, 2e-3);
		}
		/* 6 % of margin a side of the smaller side */
		near((double)covered, M_PI * 70.4 * 70.4, 200);
		near(figure_of(&s.picture, "pixels"), (double)covered, 0);
		near(figure_of(&s.picture, "rays"), k ? 200 * 160 + (double)covered : 200 * 160, 0);
		near(figure_of(&s.picture, "surfaces"), 1, 0);
		assert_true(figure_of(&s.picture, "depth_min") <
		            figure_of(&s.picture, "depth_max"));
		exr_picture_finish(&s.picture);
	}
}

static void test_nearest_surface(void **state)
{
	struct seen s;

	(void)state;
	run_well(shading, "stack.base", "--view", "top", "--size", "100x100", NULL);
	see(&s, "stack.shade.exr");
	for (int i = 0; i < s.n; i++) {
		double x = (double)s.point[0][i], y = (double)s.point[1][i];

		if (s.a[i] < 1)
			continue;
		near((double)s.point[2][i], fabs(x) < 1 && fabs(y) < 1 ? 1 : 0, 1e-6);
		near(fabs((double)s.normal[2][i]), 1, 1e-6);
	}
	near(figure_of(&s.picture, "surfaces"), 2, 0);
	near(figure_of(&s.picture, "depth_max") - figure_of(&s.picture, "depth_min"), 1, 1e-6);
	exr_picture_finish(&s.picture);
}

/* Dark runs of a row of pixels, inside the square. */
static int dark_runs(const struct seen *s, int row)
{
	int runs = 0;
	bool was = false;

	for (int x = 0; x < s->picture.width; x++) {
		int i = row * s->picture.width + x;
		bool dark = s->a[i] == 1 && s->r[i] < 0.75f * s->r[s->n / 2 + 7];

		runs += dark && !was;
		was = dark;
	}
	return runs;
}

static void test_lines(void **state)
{
	struct seen s;

	(void)state;
	run_well(shading, "square.base", "--view", "top", "--size", "211x211", "--wire", "5x3",
	         "--line-width", "2", NULL);
	see(&s, "square.shade.exr");
	assert_int_equal(dark_runs(&s, 105), 6);
	exr_picture_finish(&s.picture);
	run_well(shading, "square.base", "--view", "top", "--size", "211x211", "--edges",
	         "--line-width", "2", NULL);
	see(&s, "square.shade.exr");
	assert_int_equal(dark_runs(&s, 105), 2);
	exr_picture_finish(&s.picture);
}

/* The light straight above a ball: its shadow on the square is a disk, exactly. */
static void test_shadow(void **state)
{
	struct seen s;
	int dark = 0, bright = 0;

	(void)state;
	run_well(raytrace, "ball.base", "--light", "0,0,1", "--view", "-90,30", "--size", "240x160",
	         "--samples", "1", "--ambient", "0", "--mirror", "0", "--specular", "0", NULL);
	see(&s, "ball.trace.exr");
	for (int i = 0; i < s.n; i++) {
		double x = (double)s.point[0][i], y = (double)s.point[1][i];

		if (s.a[i] < 1 || fabs((double)s.point[2][i]) > 1e-6)
			continue;
		double r = hypot(x, y);
		if (fabs(r - 1) < 1e-3)
			continue;
		assert_int_equal(s.r[i] > 0, r > 1);
		dark += r < 1;
		bright += r > 1;
	}
	assert_true(dark > 100 && bright > 1000);
	exr_picture_finish(&s.picture);
	run_well(raytrace, "ball.base", "--light", "0,0,1", "--view", "-90,30", "--size", "240x160",
	         "--samples", "1", "--ambient", "0", "--mirror", "0", "--shadows", "no", NULL);
	see(&s, "ball.trace.exr");
	for (int i = 0; i < s.n; i++)
		if (s.a[i] == 1 && fabs((double)s.point[2][i]) < 1e-6)
			assert_true(s.r[i] > 0);
	exr_picture_finish(&s.picture);
}

/* A perfect mirror shows stripes, or the ball; without anything around it is black. */
static void test_mirror(void **state)
{
	struct seen s;
	int bright = 0, dark = 0, between = 0;

	(void)state;
	run_well(raytrace, "sphere.base", "--mirror", "1", "--size", "160x160", "--samples", "1",
	         NULL);
	see(&s, "sphere.trace.exr");
	for (int i = 0; i < s.n; i++) {
		if (s.a[i] < 1)
			continue;
		bright += s.g[i] > 0.9f;
		dark += s.g[i] < 0.05f;
		between += s.g[i] >= 0.05f && s.g[i] <= 0.9f;
	}
	assert_true(bright > 2000 && dark > 2000 && between < (bright + dark) / 4);
	exr_picture_finish(&s.picture);

	run_well(raytrace, "square.base", "--mirror", "1", "--environment", "none", "--size",
	         "40x40", NULL);
	see(&s, "square.trace.exr");
	for (int i = 0; i < s.n; i++)
		near((double)s.r[i], 0, 1e-6);
	exr_picture_finish(&s.picture);

	double rays[2];
	for (int depth = 0; depth < 2; depth++) {
		run_well(raytrace, "ball.base", "--view", "-90,30", "--depth", depth ? "1" : "0",
		         "--environment", "sky", "--size", "80x80", "--shadows", "no", NULL);
		see(&s, "ball.trace.exr");
		rays[depth] = figure_of(&s.picture, "rays");
		exr_picture_finish(&s.picture);
	}
	near(rays[0], 80 * 80 * 9, 0);
	assert_true(rays[1] > rays[0]);
}

/* Same bytes on one thread and on three, and pictures that are there. */
static void test_same_bytes(void **state)
{
	char *const workers[2] = { shading, raytrace };
	static const char *const names[2] = { "shade", "trace" };

	(void)state;
	for (int k = 0; k < 2; k++) {
		char a[2][32], png[2][32];

		for (int i = 0; i < 2; i++) {
			snprintf(a[i], sizeof a[i], "%c.%s.exr", 'a' + i, names[k]);
			snprintf(png[i], sizeof png[i], "%c.%s.png", 'a' + i, names[k]);
			run_well(workers[k], "ball.base", "--size", "150x100", "--threads",
			         i ? "3" : "1", "-o", i ? "b" : "a", "--png", "--view",
			         "three-quarter:perspective", NULL);
			assert_true(there(png[i]));
		}
		assert_same_file(a[0], a[1]);
		assert_same_file(png[0], png[1]);
	}
}

static void test_refused(void **state)
{
	static const struct {
		const char *option, *value, *word;
	} cases[] = {
		{ "--size", "0x10", "size" },     { "--samples", "0", "samples" },
		{ "--view", "sideways", "view" }, { "--light", "0,0,0", "direction" },
		{ "--color", "red", "color" },    { "--samples", "99", "samples" },
	};
	char *const workers[2] = { shading, raytrace };

	(void)state;
	for (int k = 0; k < 2; k++)
		for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
			struct ran r = run_hand(workers[k], "sphere.base", "-o", "refused",
			                        cases[i].option, cases[i].value, NULL);

			assert_int_equal(r.exit_status, 2);
			if (!strstr(r.err, cases[i].word))
				fail_msg("'%s' is not in '%s'", cases[i].word, r.err);
			assert_false(there("refused.shade.exr") || there("refused.trace.exr"));
			ran_finish(&r);
		}
	struct ran r = run_hand(raytrace, "sphere.base", "--stripe-direction", "0,0,0", NULL);
	assert_int_equal(r.exit_status, 2);
	ran_finish(&r);
	r = run_hand(shading, "sphere.base", "--size", "40000x4", "--png", NULL);
	assert_int_equal(r.exit_status, 2);
	ran_finish(&r);

	/* a surface without extent */
	struct surface s = body_sphere(vec3(1, 1, 1), 2);
	for (int i = 0; i < s.n[0]; i++)
		for (int j = 0; j < s.n[1]; j++)
			surface_set_point(&s, i, j, vec3(1, 1, 1), 1);
	bodies_write("point.base", NULL, &s, 1);
	r = run_hand(shading, "point.base", NULL);
	assert_int_equal(r.exit_status, 1);
	assert_non_null(strstr(r.err, "point"));
	assert_false(there("point.shade.exr"));
	ran_finish(&r);
}

int main(int argc, char **argv)
{
	if (argc < 3)
		return 2;
	shading = realpath(argv[1], NULL); /* tests work in other folders */
	raytrace = realpath(argv[2], NULL);
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_sphere, enter, bodies_leave),
		cmocka_unit_test_setup_teardown(test_nearest_surface, enter, bodies_leave),
		cmocka_unit_test_setup_teardown(test_lines, enter, bodies_leave),
		cmocka_unit_test_setup_teardown(test_shadow, enter, bodies_leave),
		cmocka_unit_test_setup_teardown(test_mirror, enter, bodies_leave),
		cmocka_unit_test_setup_teardown(test_same_bytes, enter, bodies_leave),
		cmocka_unit_test_setup_teardown(test_refused, enter, bodies_leave),
	};
	int rc = cmocka_run_group_tests(tests, NULL, NULL);

	free(shading);
	free(raytrace);
	return rc;
}
