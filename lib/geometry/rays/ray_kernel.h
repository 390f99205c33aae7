/* ray_kernel.h - packets of rays against leaves, built once for each vector level. Private. */
#ifndef BATTEN_RAY_KERNEL_H
#define BATTEN_RAY_KERNEL_H

#include <stdbool.h>
#include <stdint.h>

#include "ray_leaf.h"
#include "ray_scene.h"
#include "ray_tree.h"

struct ray_scene {
	struct ray_cut cut;
	struct ray_tree tree;                  /* owned */
	const struct surface *const *surfaces; /* owned array; its surfaces borrowed */
	const struct ray_kernel *kernel;
};

struct ray_kernel {
	const char *level; /* as vector_level() names it */
	int lanes;         /* rays of a packet */
	/* Rays order[0..n) (NULL: 0 .. n - 1) of `rays`; results go where the rays stand. */
	void (*hits)(const struct ray_scene *s, const struct ray *rays, const uint32_t *order,
	             size_t n, bool coherent, struct ray_hit *hits);
	void (*blocked)(const struct ray_scene *s, const struct ray *rays, size_t n, bool *out);
	void (*hit)(const struct ray_scene *s, const struct ray *r, struct ray_hit *out);
	bool (*is_blocked)(const struct ray_scene *s, const struct ray *r);
};

extern const struct ray_kernel ray_kernel_4, ray_kernel_8, ray_kernel_16;

#endif
