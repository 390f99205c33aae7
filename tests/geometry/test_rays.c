/* test_rays.c - rays against surfaces with formulas and of any orders: exact hits, no cracks. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "construct.h"
#include "ray_shapes.h"

enum { RAYS = 20000 };

/* All crossings of a ray, nearest first; at most max. */
static int crossings(const struct ray_scene *scene, struct ray r, double step, double *t, int max)
{
	for (int n = 0; n < max; n++) {
		struct ray_hit h = trace_one(scene, r);

		if (h.surface < 0)
			return n;
		t[n] = h.t;
		r.near = h.t + step;
	}
	return max;
}

static void sphere_by_formula(void **state)
{
	const struct vec3 center = vec3(100, -20, 3);
	const double radius = 2;
	struct surface s;
	struct ray *rays = malloc(RAYS * sizeof *rays);
	struct ray_hit *hits = malloc(RAYS * sizeof *hits);
	uint64_t seed = 1;
	int n_hit = 0;

	(void)state;
	assert_non_null(rays);
	assert_non_null(hits);
	assert_int_equal(make_sphere(&s, center, radius), ST_OK);
	struct ray_scene *scene = scene_of(&s);
	for (int i = 0; i < RAYS; i++) {
		rays[i] = random_ray(center, 1.1 * radius, &seed);
		if (i % 4 == 0) /* from inside */
			rays[i].origin = vec3_along(center, 0.9 * radius * shape_random(&seed),
			                            random_direction(&seed));
	}
	ray_scene_hits(scene, rays, RAYS, false, hits);
	for (int i = 0; i < RAYS; i++) {
		struct vec3 o = vec3_sub(rays[i].origin, center);
		double b = vec3_dot(o, rays[i].direction);
		double q = b * b - vec3_dot(o, o) + radius * radius;

		if (fabs(q) < 1e-9)
			continue;
		assert_int_equal(hits[i].surface, q > 0 ? 0 : -1);
		if (q < 0)
			continue;
		double t = -b - sqrt(q);
		if (t < 0)
			t = -b + sqrt(q);
		n_hit++;
		assert_true(fabs(hits[i].t - t) * sqrt(q) < 1e-11);
		struct vec3 n = vec3_scale(vec3_sub(hits[i].point, center), 1 / radius);
		assert_true(fabs(vec3_length(n) - 1) < 1e-12);
		/* turned as Su x Sv is */
		assert_true(fabs(fabs(vec3_dot(n, hits[i].normal)) - 1) < 1e-12);
		struct vec3 p = surface_point(&s, hits[i].u, hits[i].v);
		assert_true(vec3_length(vec3_sub(p, hits[i].point)) < 1e-11);
	}
	assert_true(n_hit > RAYS / 2);
	ray_scene_destroy(scene);
	surface_finish(&s);
	free(rays);
	free(hits);
}

static void cylinder_by_formula(void **state)
{
	struct curve circle;
	struct surface s;
	uint64_t seed = 2;
	int n_hit = 0;

	(void)state;
	assert_int_equal(
	        make_arc(&circle, vec3(0, 0, 0), vec3(1, 0, 0), vec3(0, 1, 0), 1.5, 0, 2 * M_PI),
	        ST_OK);
	assert_int_equal(make_cylinder(&s, &circle, vec3(0, 0, 2)), ST_OK);
	struct ray_scene *scene = scene_of(&s);
	for (int i = 0; i < 4000; i++) {
		struct ray r = random_ray(vec3(0, 0, 1), 2, &seed);
		double a = r.direction.x * r.direction.x + r.direction.y * r.direction.y;
		double b = r.origin.x * r.direction.x + r.origin.y * r.direction.y;
		double c = r.origin.x * r.origin.x + r.origin.y * r.origin.y - 2.25;
		double q = b * b - a * c, expected = INFINITY;

		for (int k = 0; k < 2 && q > 0; k++) {
			double t = (-b + (k ? sqrt(q) : -sqrt(q))) / a;
			double z = r.origin.z + t * r.direction.z;

			if (z > 0 && z < 2 && t < expected)
				expected = t;
		}
		struct ray_hit h = trace_one(scene, r);
		assert_int_equal(h.surface, isfinite(expected) ? 0 : -1);
		if (h.surface == 0) {
			n_hit++;
			assert_true(fabs(h.t - expected) * sqrt(q) < 1e-10);
		}
	}
	assert_true(n_hit > 1000);
	ray_scene_destroy(scene);
	surface_finish(&s);
	curve_finish(&circle);
}

/* Rays that start outside cross a closed surface an even number of times. */
static void closed_surfaces_have_no_holes(void **state)
{
	struct surface shapes[3] = { shape_sphere(1), shape_torus(1, 0.4), shape_torus(1, 0.1) };
	uint64_t seed = 3;

	(void)state;
	for (int k = 0; k < 3; k++) {
		struct ray_scene *scene = scene_of(&shapes[k]);
		int seen[6] = { 0 };

		for (int i = 0; i < 5000; i++) {
			struct ray r = random_ray(vec3(0, 0, 0), 1.2, &seed);
			double t[6];
			int n = crossings(scene, r, 1e-9, t, 6);

			assert_true(n < 6);
			assert_int_equal(n % 2, 0);
			seen[n]++;
			r.origin = vec3(1, 0, 0.01); /* in the tube, or near the sphere's side */
			if (k > 0)
				assert_int_equal(crossings(scene, r, 1e-9, t, 6) % 2, 1);
		}
		assert_true(seen[0] > 0 && seen[2] > 0);
		assert_true(k == 0 ? seen[4] == 0 : seen[4] > 0);
		ray_scene_destroy(scene);
		surface_finish(&shapes[k]);
	}
}

/* Parallel rays over a net of points that goes exactly through seams, poles and patch borders. */
static void rays_through_borders_and_poles(void **state)
{
	static const struct vec3 ways[] = { { 0, 0, -1 }, { 0, 0, 1 }, { -1, 0, 0 },
		                            { 0, 1, 0 },  { 1, 1, 0 }, { 1, 1, 1 } };
	struct surface s = shape_sphere(1);
	struct ray_scene *scene = scene_of(&s);

	(void)state;
	for (size_t k = 0; k < sizeof ways / sizeof *ways; k++) {
		struct vec3 d = vec3_unit(ways[k]);
		struct vec3 side =
		        vec3_unit(vec3_cross(d, fabs(d.z) > 0.9 ? vec3(1, 0, 0) : vec3(0, 0, 1)));
		struct vec3 up = vec3_cross(side, d);

		for (int i = -16; i <= 16; i++)
			for (int j = -16; j <= 16; j++) {
				double x = i / 17.0, y = j / 17.0, r = x * x + y * y;
				struct vec3 o =
				        vec3_along(vec3_along(vec3_scale(d, -3), x, side), y, up);
				struct ray_hit h =
				        trace_one(scene, (struct ray){ o, d, 0, INFINITY });

				if (r > 0.9999)
					continue;
				assert_int_equal(h.surface, 0);
				assert_true(fabs(h.t - (3 - sqrt(1 - r))) < 1e-10);
				assert_true(fabs(fabs(vec3_dot(h.normal, h.point)) - 1) < 1e-6);
			}
	}
	ray_scene_destroy(scene);
	surface_finish(&s);
}

/* Right through a pole, where the patch seems to run on with its other side up. */
static void normals_at_poles_point_out(void **state)
{
	static const double sizes[] = { 1, 1e-9, 1e9 };
	uint64_t seed = 17;

	(void)state;
	for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
		struct surface s = shape_sphere(sizes[k]);
		struct ray_scene *scene = scene_of(&s);
		for (int i = 0; i < 150; i++) {
			const double z = i % 2 ? sizes[k] : -sizes[k];
			struct vec3 d = random_direction(&seed);
			struct ray r = { vec3_along(vec3(0, 0, z), -4 * sizes[k], d), d, 0,
				         INFINITY };
			struct ray_hit one, group = trace_one(scene, r);

			if (fabs(d.z) < 0.01)
				continue;
			ray_scene_hit(scene, &r, &one);
			assert_int_equal(group.surface, 0);
			assert_int_equal(one.surface, 0);
			assert_true(fabs(vec3_dot(group.normal, group.point) / sizes[k] - 1) <
			            1e-6);
			assert_true(fabs(vec3_dot(one.normal, one.point) / sizes[k] - 1) < 1e-6);
		}
		ray_scene_destroy(scene);
		surface_finish(&s);
	}
}

/* Any orders: from a point of the surface straight back, the ray must hit there or before. */
static void orders_and_knots(void **state)
{
	static const struct {
		int order[2], n[2];
		bool rational;
		enum shape_knots knots;
	} rows[] = {
		{ { 2, 2 }, { 2, 2 }, false, KNOTS_CLAMPED },
		{ { 2, 3 }, { 4, 5 }, true, KNOTS_UNEVEN },
		{ { 4, 4 }, { 9, 7 }, false, KNOTS_OPEN },
		{ { 4, 4 }, { 6, 6 }, true, KNOTS_DOUBLE },
		{ { 5, 3 }, { 8, 6 }, true, KNOTS_OPEN },
		{ { 6, 8 }, { 7, 9 }, false, KNOTS_UNEVEN },
		{ { 13, 4 }, { 14, 5 }, false, KNOTS_CLAMPED },
		{ { 26, 26 }, { 26, 26 }, true, KNOTS_CLAMPED },
		{ { 26, 2 }, { 28, 3 }, false, KNOTS_OPEN },
	};

	(void)state;
	for (size_t k = 0; k < sizeof rows / sizeof *rows; k++) {
		struct surface s = shape_surface(rows[k].order, rows[k].n, rows[k].rational,
		                                 rows[k].knots, 11 + k);
		struct ray_scene *scene = scene_of(&s);
		double size = surface_size(&s);
		uint64_t seed = 17 + k;
		int same = 0;

		for (int i = 0; i < 600; i++) {
			double u = s.domain[0][0] +
			           shape_random(&seed) * (s.domain[0][1] - s.domain[0][0]);
			double v = s.domain[1][0] +
			           shape_random(&seed) * (s.domain[1][1] - s.domain[1][0]);
			struct vec3 p, du, dv, d = random_direction(&seed);

			surface_tangents(&s, u, v, &p, &du, &dv);
			if (fabs(vec3_dot(vec3_unit(vec3_cross(du, dv)), d)) < 1e-3)
				continue; /* along the surface: two hits are as good as one */
			struct ray r = { vec3_along(p, -2 * size, d), d, 0, INFINITY };
			struct ray_hit h = trace_one(scene, r);

			assert_int_equal(h.surface, 0);
			assert_true(h.t < 2 * size + 1e-9 * size);
			same += fabs(h.t - 2 * size) < 1e-9 * size;
			struct vec3 q = surface_point(&s, h.u, h.v);
			assert_true(vec3_length(vec3_sub(q, h.point)) < 1e-10 * size);
			q = vec3_along(r.origin, h.t, d);
			assert_true(vec3_length(vec3_sub(q, h.point)) < 1e-10 * size);
		}
		assert_true(same > 300);
		ray_scene_destroy(scene);
		surface_finish(&s);
	}
}

/* A bicubic whose side is one point, as lids of teapots have. */
static void collapsed_side(void **state)
{
	struct surface s;

	(void)state;
	assert_int_equal(surface_init(&s, (const int[2]){ 4, 4 }, (const int[2]){ 4, 4 }), ST_OK);
	for (int d = 0; d < 2; d++)
		for (int i = 4; i < 8; i++)
			s.knots[d][i] = 1;
	for (int i = 0; i < 4; i++)
		for (int j = 0; j < 4; j++) {
			static const double x[4] = { 1, 1, 0.56, 0 }, y[4] = { 0, 0.56, 1, 1 };
			double r = i / 3.0;

			surface_set_point(&s, i, j,
			                  vec3(r * x[j], r * y[j], i < 2 ? 1 : 1 - 0.5 * r), 1);
		}
	assert_int_equal(surface_check(&s, "lid", NULL), ST_OK);
	struct ray_scene *scene = scene_of(&s);
	for (int i = 0; i <= 60; i++)
		for (int j = 0; j <= 60; j++) {
			double r = i / 61.0, a = M_PI / 2 * (j + 0.5) / 61;
			struct ray ray = { vec3(0.9 * r * cos(a), 0.9 * r * sin(a), 5),
				           vec3(0, 0, -1), 0, INFINITY };
			struct ray_hit h = trace_one(scene, ray);

			assert_int_equal(h.surface, 0);
			assert_true(fabs(vec3_length(h.normal) - 1) < 1e-9);
			assert_true(fabs(h.normal.z) > 0.3);
		}
	ray_scene_destroy(scene);
	surface_finish(&s);
}

static void part_of_the_domain(void **state)
{
	struct surface s;
	const struct vec3 corner[4] = { { 0, 0, 0 }, { 4, 0, 0 }, { 0, 4, 0 }, { 4, 4, 0 } };

	(void)state;
	assert_int_equal(make_bilinear(&s, corner), ST_OK);
	s.domain[0][0] = 0.25;
	s.domain[0][1] = 0.5;
	s.domain[1][1] = 0.75;
	struct ray_scene *scene = scene_of(&s);
	for (int i = 0; i < 40; i++)
		for (int j = 0; j < 40; j++) {
			double x = (i + 0.5) / 10, y = (j + 0.5) / 10;
			struct ray_hit h = trace_one(
			        scene, (struct ray){ { x, y, 2 }, { 0, 0, -1 }, 0, INFINITY });

			assert_int_equal(h.surface, x > 1 && x < 2 && y < 3 ? 0 : -1);
			if (h.surface == 0)
				assert_true(fabs(h.u - x / 4) < 1e-12 && fabs(h.v - y / 4) < 1e-12);
		}
	struct box box = ray_scene_box(scene);
	assert_true(fabs(box.lo.x - 1) < 1e-4 && fabs(box.hi.y - 3) < 1e-4);
	ray_scene_destroy(scene);
	surface_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(sphere_by_formula),
		cmocka_unit_test(cylinder_by_formula),
		cmocka_unit_test(closed_surfaces_have_no_holes),
		cmocka_unit_test(rays_through_borders_and_poles),
		cmocka_unit_test(normals_at_poles_point_out),
		cmocka_unit_test(orders_and_knots),
		cmocka_unit_test(collapsed_side),
		cmocka_unit_test(part_of_the_domain),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
