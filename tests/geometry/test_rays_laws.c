/* test_rays_laws.c - what holds of rays on any surface: grouping, ends, ties, limits. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "ray_shapes.h"
#include "report.h"

enum { RAYS = 20000 };

static void assert_same_hits(const struct ray_hit *a, const struct ray_hit *b, size_t n)
{
	for (size_t i = 0; i < n; i++) {
		assert_int_equal(a[i].surface, b[i].surface);
		assert_memory_equal(&a[i].t, &b[i].t, sizeof *a - offsetof(struct ray_hit, t));
	}
}

/* The same bytes whatever stands beside a ray. */
static void grouping_does_not_matter(void **state)
{
	struct surface s[2] = { shape_torus(1, 0.4), shape_sphere(0.7) };
	const struct surface *both[2] = { &s[0], &s[1] };
	struct ray_scene *scene;
	enum { N = 3000 };
	struct ray *rays = malloc(N * sizeof *rays), *mixed = malloc(N * sizeof *rays);
	struct ray_hit *whole = malloc(N * sizeof *whole), *part = malloc(N * sizeof *part);
	bool *blocked = malloc(N);
	uint64_t seed = 5;

	(void)state;
	assert_true(rays && mixed && whole && part && blocked);
	assert_int_equal(ray_scene_create(&scene, both, 2, 0, NULL), ST_OK);
	for (int i = 0; i < N; i++)
		rays[i] = random_ray(vec3(0, 0, 0), 1.2, &seed);
	ray_scene_hits(scene, rays, N, false, whole);
	ray_scene_hits(scene, rays, N, true, part);
	assert_same_hits(whole, part, N);
	for (int first = 0, size = 1; first < N; first += size, size = size % 19 + 1)
		ray_scene_hits(scene, rays + first, size < N - first ? size : N - first, size % 2,
		               part + first);
	assert_same_hits(whole, part, N);
	for (int i = 0; i < N; i++)
		mixed[i] = rays[(size_t)i * 1009 % N];
	ray_scene_hits(scene, mixed, N, true, part);
	for (int i = 0; i < N; i++)
		assert_same_hits(&part[i], &whole[(size_t)i * 1009 % N], 1);
	ray_scene_blocked(scene, rays, N, blocked);
	for (int i = 0; i < N; i++)
		assert_int_equal(blocked[i], whole[i].surface >= 0);
	ray_scene_destroy(scene);
	surface_finish(&s[0]);
	surface_finish(&s[1]);
	free(rays);
	free(mixed);
	free(whole);
	free(part);
	free(blocked);
}

/* A ray by itself finds what it finds in a group, of every kind of surface, from without and within. */
static void one_ray_finds_the_same(void **state)
{
	struct surface s[] = {
		shape_torus(1, 0.4), shape_sphere(0.7),
		shape_surface((int[2]){ 4, 3 }, (int[2]){ 6, 5 }, true, KNOTS_UNEVEN, 3),
		shape_surface((int[2]){ 6, 4 }, (int[2]){ 7, 4 }, false, KNOTS_CLAMPED, 4)
	};
	enum { N_SHAPES = sizeof s / sizeof *s };
	const struct surface *all[N_SHAPES] = { &s[0], &s[1], &s[2], &s[3] };
	struct ray_scene *scene;
	uint64_t seed = 7;
	int n_hits = 0;

	(void)state;
	assert_int_equal(ray_scene_create(&scene, all, N_SHAPES, 0, NULL), ST_OK);
	for (int i = 0; i < RAYS; i++) {
		struct ray r = random_ray(vec3(0, 0, 0), 1.5, &seed);
		struct ray_hit group = trace_one(scene, r), one;
		bool blocked;

		if (i % 2 && group.surface >= 0) { /* from within */
			r.origin = vec3_along(r.origin, group.t + 1e-4, r.direction);
			group = trace_one(scene, r);
		}
		ray_scene_hit(scene, &r, &one);
		assert_int_equal(one.surface, group.surface);
		ray_scene_blocked(scene, &r, 1, &blocked);
		assert_int_equal(blocked, one.surface >= 0);
		assert_int_equal(ray_scene_is_blocked(scene, &r), blocked);
		if (one.surface < 0)
			continue;
		n_hits++;
		/* along a surface that it touches a ray may find itself a little further on */
		double lean = fabs(vec3_dot(one.normal, r.direction));
		assert_true(fabs(one.t - group.t) <= 1e-11 / fmax(lean, 1e-4));
		assert_true(vec3_length(vec3_sub(one.point, group.point)) <=
		            1e-11 / fmax(lean, 1e-4));
	}
	assert_true(n_hits > RAYS / 4);
	ray_scene_destroy(scene);
	for (int k = 0; k < N_SHAPES; k++)
		surface_finish(&s[k]);
}

/* Rays that leave a surface do not meet it where they start, and meet all else. */
static void near_and_far(void **state)
{
	struct surface s = shape_sphere(1);
	struct ray_scene *scene = scene_of(&s);
	uint64_t seed = 6;

	(void)state;
	for (int i = 0; i < 3000; i++) {
		struct vec3 d = random_direction(&seed);
		struct ray_hit h = trace_one(scene, random_ray(vec3(0, 0, 0), 0.9, &seed));
		double slope = vec3_dot(d, h.point), chord = -2 * slope;
		struct ray r = { h.point, d, 1e-6, INFINITY };
		bool blocked;

		assert_int_equal(h.surface, 0);
		if (fabs(chord) < 1e-5)
			continue;
		ray_scene_blocked(scene, &r, 1, &blocked);
		assert_int_equal(blocked, slope < 0);
		h = trace_one(scene, r);
		assert_int_equal(h.surface, slope < 0 ? 0 : -1);
		if (slope > 0)
			continue;
		assert_true(fabs(h.t - chord) < 1e-9);
		r.far = chord - 1e-9;
		ray_scene_blocked(scene, &r, 1, &blocked);
		assert_false(blocked);
		r.far = chord + 1e-9;
		ray_scene_blocked(scene, &r, 1, &blocked);
		assert_true(blocked);
	}
	ray_scene_destroy(scene);
	surface_finish(&s);
}

/* Of two surfaces in one place the first is hit, everywhere. */
static void ties_go_to_the_first(void **state)
{
	struct surface a = shape_torus(1, 0.4), b = shape_torus(1, 0.4);
	const struct surface *both[2] = { &a, &b };
	struct ray_scene *scene;
	uint64_t seed = 8;

	(void)state;
	assert_int_equal(ray_scene_create(&scene, both, 2, 0, NULL), ST_OK);
	for (int i = 0; i < 2000; i++)
		assert_true(trace_one(scene, random_ray(vec3(0, 0, 0), 1, &seed)).surface <= 0);
	ray_scene_destroy(scene);
	surface_finish(&a);
	surface_finish(&b);
}

static void what_cannot_be_seen(void **state)
{
	struct surface point = shape_sphere(1), sphere = shape_sphere(1);
	const struct surface *s = &point;
	struct ray_scene *scene;
	struct report_store store;

	(void)state;
	report_store_init(&store);
	for (int i = 0; i < point.n[0]; i++)
		for (int j = 0; j < point.n[1]; j++)
			surface_set_point(&point, i, j, vec3(1, 2, 3), 1);
	assert_int_equal(ray_scene_create(&scene, &s, 1, 0, &store.report), ST_INPUT);
	assert_null(scene);
	assert_non_null(strstr(store.error, "nothing to see"));
	assert_int_equal(ray_scene_create(&scene, NULL, 0, 0, &store.report), ST_INPUT);
	s = &sphere;
	assert_int_equal(ray_scene_create(&scene, &s, 1, 0, NULL), ST_OK);
	size_t taken = ray_scene_memory(scene);
	assert_true(taken > ray_scene_leaves(scene) * 64);
	ray_scene_destroy(scene);
	for (size_t memory = 1000; memory < taken; memory += taken / 7) {
		report_store_init(&store);
		assert_int_equal(ray_scene_create(&scene, &s, 1, memory, &store.report),
		                 ST_RESOURCE);
		assert_null(scene);
		assert_int_equal(store.n_errors, 1);
	}
	assert_int_equal(ray_scene_create(&scene, &s, 1, 4 * taken, NULL), ST_OK);
	ray_scene_destroy(scene);
	ray_scene_destroy(NULL);
	surface_finish(&point);
	surface_finish(&sphere);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(grouping_does_not_matter),
		cmocka_unit_test(one_ray_finds_the_same),
		cmocka_unit_test(near_and_far),
		cmocka_unit_test(ties_go_to_the_first),
		cmocka_unit_test(what_cannot_be_seen),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
