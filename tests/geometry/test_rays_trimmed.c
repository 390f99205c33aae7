/* test_rays_trimmed.c - rays against surfaces of which trims leave a part. */
#include "box.h"
#include "cmocka_all.h"
#include "ray_shapes.h"
#include "trim_shapes.h"

enum { RAYS = 20000 };

/* Rays through a ball of that radius from far outside. */
static struct ray *any_rays(double radius, uint64_t seed)
{
	struct ray *rays = malloc(RAYS * sizeof *rays);
	assert_non_null(rays);
	for (int i = 0; i < RAYS; i++) {
		struct vec3 at = vec3_scale(random_direction(&seed), radius * shape_random(&seed));
		struct vec3 d = random_direction(&seed);
		rays[i] = (struct ray){ vec3_along(at, -10 * radius, d), d, 0, INFINITY };
	}
	return rays;
}

static struct ray_scene *trimmed_scene(const struct surface *s, const struct trim *t)
{
	struct ray_scene *scene;
	assert_int_equal(ray_scene_create_trimmed(&scene, &s, &t, 1, 0, NULL), ST_OK);
	return scene;
}

/* The first hit of the whole surface that the trim leaves. *sure: no hit before it, nor it, lies so
 * near to a loop that rounding decides. */
static struct ray_hit first_left(const struct ray_scene *whole, const struct trim_test *x,
                                 struct ray r, bool *sure)
{
	struct ray_hit h;
	const double e = 1e-7;
	*sure = true;
	for (;;) {
		ray_scene_hits(whole, &r, 1, true, &h);
		if (h.surface < 0)
			return h;
		int box = trim_test_box(x, (double[2]){ h.u - e, h.v - e },
		                        (double[2]){ h.u + e, h.v + e });
		*sure &= box != 0;
		if (trim_test_inside(x, h.u, h.v))
			return h;
		r.near = h.t + 1e-9;
	}
}

static void hits_are_the_first_that_are_left(void **state)
{
	const int order[2] = { 4, 5 }, n[2] = { 7, 8 };
	(void)state;
	for (int k = 0; k < 4; k++) {
		struct surface s = k == 0   ? shape_sphere(2)
		                   : k == 1 ? shape_torus(2, 0.7)
		                   : k == 2 ? shape_surface(order, n, true, KNOTS_UNEVEN, 3)
		                            : shape_wave10();
		struct trim t = { 0 };
		if (k % 2)
			trim_add_ellipse(&t, true, 0.5, 0.5, 0.45, 0.4, 0.3);
		for (int i = 0; i < 9; i++)
			trim_add_ellipse(&t, false, 0.25 + 0.25 * (i % 3), 0.25 + 0.25 * (i / 3),
			                 0.08 + 0.01 * (i % 4), 0.1 - 0.01 * (i % 5), 0.2 * i);
		struct trim_test *x;
		assert_int_equal(trim_test_create(&x, &t, &s), ST_OK);
		struct ray_scene *whole = trimmed_scene(&s, NULL), *left = trimmed_scene(&s, &t);
		struct box box = ray_scene_box(whole);
		struct ray *rays = any_rays(box_diagonal(&box) / 3, 17 + k);
		struct ray_hit *hits = malloc(RAYS * sizeof *hits);
		bool *blocked = malloc(RAYS * sizeof *blocked);
		int n_hit = 0, n_through = 0, n_unsure = 0;
		assert_non_null(hits);
		assert_non_null(blocked);
		for (int i = 0; i < RAYS; i++)
			rays[i].origin = vec3_add(rays[i].origin, box_center(&box));
		ray_scene_hits(left, rays, RAYS, false, hits);
		ray_scene_blocked(left, rays, RAYS, blocked);
		for (int i = 0; i < RAYS; i++) {
			bool sure;
			struct ray_hit h = first_left(whole, x, rays[i], &sure), first;
			ray_scene_hits(whole, &rays[i], 1, true, &first);
			n_unsure += !sure;
			if (!sure)
				continue;
			assert_int_equal(hits[i].surface, h.surface);
			assert_int_equal(blocked[i], h.surface >= 0);
			if (h.surface < 0) {
				n_through += first.surface >= 0;
				continue;
			}
			assert_float_equal(hits[i].t, h.t, 1e-8 * box_diagonal(&box));
			n_through += h.t > first.t + 1e-6;
			n_hit++;
		}
		assert_true(n_hit > RAYS / 20);
		assert_true(n_through > RAYS / 100);
		assert_true(n_unsure < RAYS / 1000);
		free(rays);
		free(hits);
		free(blocked);
		ray_scene_destroy(whole);
		ray_scene_destroy(left);
		trim_test_destroy(x);
		trim_finish(&t);
		surface_finish(&s);
	}
}

/* The part of a sphere above a height, seen from below: its inside, ending at the height. */
static void a_cap_of_a_sphere(void **state)
{
	struct surface s = shape_sphere(1);
	struct trim t = { 0 };
	double v = 0.7, z = surface_point(&s, 0, v).z, edge = sqrt(1 - z * z);
	(void)state;
	trim_add_box(&t, true, 0, v, 1, 1);
	struct ray_scene *scene = trimmed_scene(&s, &t);
	struct box box = ray_scene_box(scene);
	/* the scene is no larger than what is left, but for the nets of its leaves */
	assert_true(box.lo.z > z - 0.1 && box.hi.x < edge + 0.1 && box.lo.y > -edge - 0.1);
	for (int i = 0; i < 2000; i++) {
		double r = 1.1 * i / 2000, a = 0.37 * i;
		struct ray ray = { vec3(r * cos(a), r * sin(a), -5), vec3(0, 0, 1), 0, INFINITY };
		struct ray_hit h;
		ray_scene_hits(scene, &ray, 1, true, &h);
		if (fabs(r - edge) < 1e-9)
			continue;
		assert_int_equal(h.surface, r < edge ? 0 : -1);
		if (r < edge)
			assert_float_equal(h.point.z, sqrt(1 - r * r), 1e-9);
	}
	ray_scene_destroy(scene);
	trim_finish(&t);
	surface_finish(&s);
}

/* A small face on a plane a million times larger is as exact as alone. */
static void a_small_face_on_a_large_plane(void **state)
{
	struct surface s = shape_plane(1e6, 1e6);
	struct trim t = { 0 };
	(void)state;
	trim_add_box(&t, true, 0.5, 0.5, 0.5 + 1e-6, 0.5 + 1e-6);
	struct ray_scene *scene = trimmed_scene(&s, &t);
	for (int i = -20; i < 120; i++)
		for (int j = -20; j < 120; j++) {
			double x = (i + 0.5) / 100, y = (j + 0.5) / 100;
			struct ray ray = { vec3(5e5 + x, 5e5 + y, 9), vec3(0, 0, -1), 0, INFINITY };
			struct ray_hit h;
			bool in = x > 0 && x < 1 && y > 0 && y < 1;
			ray_scene_hits(scene, &ray, 1, true, &h);
			assert_int_equal(h.surface, in ? 0 : -1);
		}
	ray_scene_destroy(scene);
	trim_finish(&t);
	surface_finish(&s);
}

static void nothing_left_is_an_error(void **state)
{
	struct surface s = shape_plane(1, 1);
	const struct surface *one = &s;
	struct ray_scene *scene;
	struct report_store store;
	(void)state;
	for (int k = 0; k < 2; k++) {
		struct trim t = { 0 };
		const struct trim *trims[1] = { &t };
		if (k)
			trim_add_box(&t, true, 1.5, 0, 2, 1);
		else
			trim_add_box(&t, false, 0, 0, 1, 1);
		report_store_init(&store);
		assert_int_equal(ray_scene_create_trimmed(&scene, &one, trims, 1, 0, &store.report),
		                 ST_INPUT);
		assert_non_null(strstr(store.error, "trimmed away"));
		assert_int_equal(store.n_errors, 1);
		assert_null(scene);
		trim_finish(&t);
	}
	surface_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(hits_are_the_first_that_are_left),
		cmocka_unit_test(a_cap_of_a_sphere),
		cmocka_unit_test(a_small_face_on_a_large_plane),
		cmocka_unit_test(nothing_left_is_an_error),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
