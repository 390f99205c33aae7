/* ray_shapes.h - rays and scenes that tests share. */
#ifndef BATTEN_TEST_RAY_SHAPES_H
#define BATTEN_TEST_RAY_SHAPES_H

#include "ray_scene.h"
#include "shapes.h"

static inline struct vec3 random_direction(uint64_t *seed)
{
	struct vec3 d;

	do
		d = vec3(2 * shape_random(seed) - 1, 2 * shape_random(seed) - 1,
		         2 * shape_random(seed) - 1);
	while (vec3_length(d) > 1 || vec3_length(d) < 0.01);
	return vec3_unit(d);
}

/* A ray through a random point of a ball, from far outside. */
static inline struct ray random_ray(struct vec3 center, double radius, uint64_t *seed)
{
	struct vec3 d = random_direction(seed);
	struct vec3 p = vec3_along(center, radius * shape_random(seed), random_direction(seed));

	return (struct ray){ vec3_along(p, -7 * radius, d), d, 0, INFINITY };
}

static inline struct ray_scene *scene_of(const struct surface *s)
{
	struct ray_scene *scene;

	assert_int_equal(ray_scene_create(&scene, &s, 1, 0, NULL), ST_OK);
	return scene;
}

static inline struct ray_hit trace_one(const struct ray_scene *scene, struct ray r)
{
	struct ray_hit h;

	ray_scene_hits(scene, &r, 1, true, &h);
	return h;
}

#endif
