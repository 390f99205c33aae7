/* test_trimmed.c - what workers make of trimmed surfaces. */
#include "bodies.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base.h"
#include "exr.h"
#include "json.h"

static char *shading, *raytrace, *curvature;

/* An inner loop: the circle of that radius about the middle of the domain, four arcs. */
static void add_hole(struct trim *t, const struct surface *s, double radius)
{
	struct trim_loop l = { .outer = false };
	double u = 0.5 * (s->domain[0][0] + s->domain[0][1]);
	double v = 0.5 * (s->domain[1][0] + s->domain[1][1]);

	for (int i = 0; i < 4; i++) {
		static const int x[5] = { 1, 0, -1, 0, 1 };
		const int y[5] = { 0, 1, 0, -1, 0 };
		struct curve c;

		assert_int_equal(curve_init(&c, 3, 3), ST_OK);
		for (int k = 3; k < 6; k++)
			c.knots[k] = 1;
		curve_set_point(&c, 0, vec3(u + radius * x[i], v + radius * y[i], 0), 1);
		curve_set_point(
		        &c, 1,
		        vec3(u + radius * (x[i] + x[i + 1]), v + radius * (y[i] + y[i + 1]), 0),
		        sqrt(0.5));
		curve_set_point(&c, 2, vec3(u + radius * x[i + 1], v + radius * y[i + 1], 0), 1);
		assert_int_equal(curve_check(&c, "arc", NULL), ST_OK);
		assert_int_equal(trim_loop_add(&l, &c), ST_OK);
	}
	assert_int_equal(trim_add(t, &l), ST_OK);
}

static void write_model(const char *path, struct surface *s, const double *holes, int n)
{
	struct model m;

	model_init(&m);
	for (int i = 0; i < n; i++) {
		struct entity e = { .kind = ENTITY_SURFACE, .surface = -1, .geometry = s[i] };

		if (holes[i] > 0)
			add_hole(&e.trim, &s[i], holes[i]);
		e.trims = e.trim.n;
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
	/* a square with a hole of radius 1 over a smaller one without */
	write_model("stack.base", (struct surface[]){ body_square(2, 1), body_square(0.8, 0) },
	            (double[]){ 0.25, 0 }, 2);
	struct surface ball = body_sphere(vec3(0, 0, 0), 2);
	write_model("ball.base", &ball,
	            (double[]){ 0.25 * (ball.domain[1][1] - ball.domain[1][0]) }, 1);
	return 0;
}

/* Through the hole the square below is seen, and past it nothing; and the light falls so, too. */
static void test_hole_is_seen_through(void **state)
{
	static const char *const outputs[2] = { "stack.shade.exr", "stack.trace.exr" };

	(void)state;
	for (int k = 0; k < 4; k++) {
		struct exr_picture p;
		bool trimmed = k < 2;

		run_well(k % 2 ? raytrace : shading, "stack.base", "--view", "top:orthographic",
		         "--size", "240x240", "--samples", "1", "--force", "--trimmed",
		         trimmed ? "yes" : "no", NULL);
		assert_int_equal(exr_read(&p, outputs[k % 2], NULL), ST_OK);
		const float *x = exr_plane(&p, "P.X"), *y = exr_plane(&p, "P.Y");
		const float *z = exr_plane(&p, "P.Z"), *a = exr_plane(&p, "A");
		int through = 0, past = 0, upper = 0;

		for (int i = 0; i < p.width * p.height; i++) {
			double r = hypot((double)x[i], (double)y[i]);

			if (a[i] <= 0) {
				past++;
			} else if (z[i] < 0.5f) {
				assert_true(r < 1.001 && fmax(fabsf(x[i]), fabsf(y[i])) < 0.801f);
				through++;
			} else {
				assert_true(!trimmed || r > 0.999);
				upper++;
			}
		}
		assert_int_equal(through > 0, trimmed);
		if (trimmed) {
			/* of the smaller square all but its corners is seen */
			double corner = 0, n = 4000;
			for (int i = 0; i < n; i++)
				corner += fmax(0, 0.8 - sqrt(1 - pow(0.8 * (i + 0.5) / n, 2))) *
				          0.8 / n;
			double seen = 2.56 - 4 * corner, all = 16 - M_PI + seen;
			double share = (double)through / (upper + through);
			assert_true(fabs(share - seen / all) < 0.003);
		}
		assert_true(past > 0);
		assert_true(figure_of(&p, "trimmed") == trimmed);
		assert_true(figure_of(&p, "surfaces") == 2);
		exr_picture_finish(&p);
	}
}

static void test_threads_do_not_matter(void **state)
{
	(void)state;
	run_well(shading, "stack.base", "--size", "200x150", "--edges", "--threads", "1", "-o", "a",
	         NULL);
	run_well(shading, "stack.base", "--size", "200x150", "--edges", "--threads", "3", "-o", "b",
	         NULL);
	assert_same_file("a.shade.exr", "b.shade.exr");
	run_well(curvature, "ball.base", "--grid", "200x100", "--threads", "1", "-o", "a", NULL);
	run_well(curvature, "ball.base", "--grid", "200x100", "--threads", "3", "-o", "b", NULL);
	assert_same_file("a.map.exr", "b.map.exr");
}

/* --edges draws the hole's rim: dark pixels there and nowhere inside the square. */
static void test_edges_follow_the_loop(void **state)
{
	struct exr_picture p;
	int on = 0, off = 0;

	(void)state;
	run_well(shading, "stack.base#1", "--view", "top:orthographic", "--size", "400x400",
	         "--samples", "1", "--edges", "--line-width", "3", "-o", "rim", NULL);
	assert_int_equal(exr_read(&p, "rim.shade.exr", NULL), ST_OK);
	const float *x = exr_plane(&p, "P.X"), *y = exr_plane(&p, "P.Y");
	const float *a = exr_plane(&p, "A"), *g = exr_plane(&p, "G");

	for (int i = 0; i < p.width * p.height; i++) {
		double r = hypot((double)x[i], (double)y[i]);
		double border = 2 - fmax(fabs((double)x[i]), fabs((double)y[i]));

		if (a[i] <= 0 || border < 0.2)
			continue;
		if (r < 1.015) {
			assert_true(g[i] < 0.2f);
			on++;
		} else if (r > 1.1) {
			assert_true(g[i] > 0.2f);
			off++;
		}
	}
	assert_true(on > 100 && off > 10000);
	exr_picture_finish(&p);
}

/* Outside there are no values, and extremes are of the inside alone. */
static void test_curvature_counts_the_inside(void **state)
{
	(void)state;
	for (int trimmed = 0; trimmed < 2; trimmed++) {
		struct exr_picture p;
		int nan = 0, expected = 0;

		run_well(curvature, "ball.base", "--grid", "201x101", "--png", "--force",
		         "--trimmed", trimmed ? "yes" : "no", NULL);
		assert_int_equal(exr_read(&p, "ball.map.exr", NULL), ST_OK);
		const float *k = exr_plane(&p, "K");
		struct model m;
		assert_int_equal(model_read(&m, "ball.base", NULL, NULL), ST_OK);
		const double(*d)[2] = m.entities[0].geometry.domain;
		double radius = 0.25 * (d[1][1] - d[1][0]);
		for (int j = 0; j < 101; j++)
			for (int i = 0; i < 201; i++) {
				double u = (i / 200.0 - 0.5) * (d[0][1] - d[0][0]);
				double v = (j / 100.0 - 0.5) * (d[1][1] - d[1][0]);
				double r = hypot(u, v) / radius;
				bool in = isnan(k[(100 - j) * 201 + i]);

				nan += in;
				if (fabs(r - 1) < 1e-9)
					continue;
				expected += r < 1;
				if (trimmed)
					assert_int_equal(in, r < 1);
				else
					assert_false(in);
			}
		model_finish(&m);
		assert_true(expected > 1000);
		assert_true(figure_of(&p, "outside") == nan);
		assert_true(figure_of(&p, "undefined") == 0);
		assert_true(fabs(figure_of(&p, "K_max") - 0.25) < 1e-9);
		exr_picture_finish(&p);
	}
}

int main(int argc, char **argv)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_hole_is_seen_through),
		cmocka_unit_test(test_threads_do_not_matter),
		cmocka_unit_test(test_edges_follow_the_loop),
		cmocka_unit_test(test_curvature_counts_the_inside),
	};

	if (argc < 4)
		return 2;
	shading = realpath(argv[1], NULL); /* tests work in other folders */
	raytrace = realpath(argv[2], NULL);
	curvature = realpath(argv[3], NULL);
	return cmocka_run_group_tests(tests, enter, bodies_leave);
}
