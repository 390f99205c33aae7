/* ray_scene.h - rays against many NURBS surfaces, directly: no triangles.
 *
 * Surfaces are cut into Bezier leaves; a tree over the leaves' boxes finds the leaves a ray may
 * meet, our own Newton iteration on the two planes through the ray finds where, and a step in
 * double finishes the hit that is kept.
 * Source of the two planes: Kajiya, Ray tracing parametric patches (SIGGRAPH 1982).
 */
#ifndef BATTEN_RAY_SCENE_H
#define BATTEN_RAY_SCENE_H

#include <stddef.h>

#include "box.h"
#include "surface.h"
#include "trim.h"

struct ray {
	struct vec3 origin, direction; /* direction of unit length */
	double near, far;              /* hits with near < t < far */
};

struct ray_hit {
	int surface; /* index in the scene, -1: nothing hit */
	double t;    /* distance along the ray */
	double u, v; /* surface parameters */
	struct vec3 point;
	struct vec3 normal; /* unit, N = Su x Sv turned or not as the surface has it */
};

struct ray_scene; /* opaque; read-only after create */

/*
 * The surfaces are borrowed and must outlive the scene.
 * memory: bytes the scene may take, 0 for no limit. Errors: ST_RESOURCE, ST_INPUT (nothing to see).
 * Accuracy: hits are on the surface to 1e-9 of the scene's size or better.
 */
enum status ray_scene_create(struct ray_scene **out, const struct surface *const *surfaces, int n,
                             size_t memory, const struct report *r);
/*
 * The same of what trims leave: trims[i] belongs to surfaces[i], NULL or one without loops: all of
 * it. Where a surface is trimmed away rays go through. The trims are not needed afterwards.
 */
enum status ray_scene_create_trimmed(struct ray_scene **out, const struct surface *const *surfaces,
                                     const struct trim *const *trims, int n, size_t memory,
                                     const struct report *r);
void ray_scene_destroy(struct ray_scene *s);

/* What a scene takes, in bytes, and how many leaves it has. */
size_t ray_scene_memory(const struct ray_scene *s);
size_t ray_scene_leaves(const struct ray_scene *s);

/* The test of a surface's trim, borrowed; NULL: it has none. */
const struct trim_test *ray_scene_trim(const struct ray_scene *s, int surface);

/* Of what the trims leave. */
struct box ray_scene_box(const struct ray_scene *s);

/*
 * Nearest hit of each of n rays. coherent: neighbours go much the same way (camera, one light).
 * Results do not depend on how rays are grouped. Thread: any number on one scene.
 */
void ray_scene_hits(const struct ray_scene *s, const struct ray *rays, size_t n, bool coherent,
                    struct ray_hit *hits);

/* One ray, several times quicker than a group of one; the same to rounding (1e-11 of the scene's
 * size, more where the ray only touches). */
void ray_scene_hit(const struct ray_scene *s, const struct ray *ray, struct ray_hit *hit);
bool ray_scene_is_blocked(const struct ray_scene *s, const struct ray *ray);

/* Is anything between near and far; out[i] true if so. */
void ray_scene_blocked(const struct ray_scene *s, const struct ray *rays, size_t n, bool *out);

#endif
