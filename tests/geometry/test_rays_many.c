/* test_rays_many.c - rays against assemblies of hundreds of surfaces and surfaces of many spans:
 * answers by formula, no cracks, no speckles, silhouettes. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "construct.h"
#include "ray_scene.h"
#include "shapes.h"

enum { SIDE = 8, BALLS = SIDE * SIDE * SIDE, RAYS = 4000 };
static const double radius = 0.3;

static struct vec3 ball(int k)
{
	return vec3(k % SIDE, k / SIDE % SIDE, k / (SIDE * SIDE));
}

static void move(struct surface *s, struct vec3 by)
{
	for (int i = 0; i < s->n[0]; i++)
		for (int j = 0; j < s->n[1]; j++) {
			double w;
			struct vec3 p = surface_get_point(s, i, j, &w);

			surface_set_point(s, i, j, vec3_along(p, 1, by), w);
		}
}

/* Where the ray meets the nearest ball: INFINITY for none. *edge: how near it passes a silhouette. */
static double nearest_ball(const struct ray *r, int *which, double *edge)
{
	double t = INFINITY;

	*edge = INFINITY;
	*which = -1;
	for (int k = 0; k < BALLS; k++) {
		struct vec3 to = vec3_sub(ball(k), r->origin);
		double middle = vec3_dot(to, r->direction);
		double off = vec3_length(vec3_sub(to, vec3_scale(r->direction, middle)));
		double half = sqrt(fmax(radius * radius - off * off, 0));

		if (middle + half <= 0)
			continue;
		*edge = fmin(*edge, fabs(off - radius));
		if (off >= radius)
			continue;
		double at = middle - half > 0 ? middle - half : middle + half;
		if (at < t) {
			t = at;
			*which = k;
		}
	}
	return t;
}

static struct vec3 random_way(uint64_t *seed)
{
	struct vec3 d;

	do
		d = vec3(2 * shape_random(seed) - 1, 2 * shape_random(seed) - 1,
		         2 * shape_random(seed) - 1);
	while (vec3_length(d) > 1 || vec3_length(d) < 0.01);
	return vec3_unit(d);
}

/* 512 spheres, from without, between and within them, many rays just beside a silhouette. */
static void assembly_by_formula(void **state)
{
	struct surface *s = calloc(BALLS, sizeof *s);
	const struct surface **list = calloc(BALLS, sizeof *list);
	struct ray_scene *scene;
	uint64_t seed = 1;
	int hits = 0, inside = 0, beside = 0;

	(void)state;
	assert_true(s && list);
	for (int k = 0; k < BALLS; k++) {
		s[k] = shape_sphere(radius);
		move(&s[k], ball(k));
		list[k] = &s[k];
	}
	assert_int_equal(ray_scene_create(&scene, list, BALLS, 0, NULL), ST_OK);
	for (int i = 0; i < RAYS; i++) {
		struct ray r = { vec3(SIDE * shape_random(&seed), SIDE * shape_random(&seed),
			              SIDE * shape_random(&seed)),
			         random_way(&seed), 0, INFINITY };
		struct ray_hit h;
		double edge;
		int which;

		if (i % 2) { /* aimed just beside the silhouette of some ball */
			struct vec3 at = ball((int)(BALLS * shape_random(&seed)));
			struct vec3 side = vec3_unit(vec3_cross(random_way(&seed), r.direction));
			double by = (shape_random(&seed) < 0.5 ? 1 : -1) *
			            pow(10, -2 - 5 * shape_random(&seed));

			at = vec3_along(at, radius * (1 + by), side);
			r.origin = vec3_along(at, -0.4, r.direction);
		}
		double t = nearest_ball(&r, &which, &edge);
		ray_scene_hits(scene, &r, 1, i % 3 == 0, &h);
		if (edge < 1e-9)
			continue;
		assert_int_equal(h.surface, which);
		beside += edge < 1e-5;
		if (which < 0)
			continue;
		hits++;
		inside += vec3_length(vec3_sub(r.origin, ball(which))) < radius;
		/* a root that is nearly double has half the digits */
		assert_true(fabs(h.t - t) < 1e-10 / fmin(sqrt(edge), 1));
	}
	assert_true(hits > RAYS / 4 && inside > RAYS / 50 && beside > RAYS / 20);
	ray_scene_destroy(scene);
	for (int k = 0; k < BALLS; k++)
		surface_finish(&s[k]);
	free(list);
	free(s);
}

/* 526 x 13 points of height over a plane: a ray straight down meets the height there, everywhere, on
 * knot lines too, and comes out where there is no sheet. */
static void many_spans_by_height(void **state)
{
	enum { NU = 526, NV = 13 };
	struct surface s;
	struct ray_scene *scene;
	uint64_t seed = 2;
	const struct surface *one = &s;

	(void)state;
	assert_int_equal(surface_init(&s, (const int[2]){ 4, 4 }, (const int[2]){ NU, NV }), ST_OK);
	for (int d = 0; d < 2; d++)
		shape_fill_knots(s.knots[d], 4, d ? NV : NU, KNOTS_CLAMPED);
	for (int i = 0; i < NU; i++)
		for (int j = 0; j < NV; j++) {
			/* Greville abscissae: x = 20 u, y = v */
			const double *u = s.knots[0] + i, *v = s.knots[1] + j;

			surface_set_point(&s, i, j,
			                  vec3(20 * (u[1] + u[2] + u[3]) / 3,
			                       (v[1] + v[2] + v[3]) / 3,
			                       0.05 * shape_random(&seed)),
			                  1);
		}
	assert_int_equal(surface_check(&s, "sheet", NULL), ST_OK);
	assert_int_equal(ray_scene_create(&scene, &one, 1, 0, NULL), ST_OK);
	for (int i = 0; i < RAYS; i++) {
		bool on_line = i % 4 == 0;
		double u = on_line ? s.knots[0][4 + i % (NU - 4)] : shape_random(&seed);
		double v = shape_random(&seed);
		struct vec3 p = surface_point(&s, u, v);
		struct ray r = { vec3(p.x, p.y, 2), vec3(0, 0, -1), 0, INFINITY };
		struct ray_hit h;

		ray_scene_hits(scene, &r, 1, true, &h);
		assert_int_equal(h.surface, 0);
		assert_true(fabs(h.t - (2 - p.z)) < 1e-9);
		assert_true(fabs(h.u - u) < 1e-9 && fabs(h.v - v) < 1e-9);
		r.origin.y += 1.5;
		ray_scene_hits(scene, &r, 1, true, &h);
		assert_int_equal(h.surface, -1);
	}
	ray_scene_destroy(scene);
	surface_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(assembly_by_formula),
		cmocka_unit_test(many_spans_by_height),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
