/* ray_scene.c - the scene: leaves under a tree, and rays handed to the kernel of this
 * processor's vector level. */
#include "ray_scene.h"

#include <stdlib.h>
#include <string.h>

#include "parallel.h"
#include "ray_kernel.h"

/* The widest kernel that this process takes natively. */
static const struct ray_kernel *kernel_choose(void)
{
#if RAY_LEVELS
	const char *level = vector_level();

	if (!strcmp(level, ray_kernel_16.level))
		return &ray_kernel_16;
	if (!strcmp(level, ray_kernel_8.level))
		return &ray_kernel_8;
#endif
	return &ray_kernel_4;
}

static enum status tree_build(struct ray_scene *s)
{
	struct ray_cut *c = &s->cut;

	s->kernel = kernel_choose();
	if (c->memory && c->bytes >= c->memory)
		return ST_RESOURCE;
	enum status st = ray_tree_init(&s->tree, c->bounds, c->n_leaves,
	                               c->memory ? c->memory - c->bytes : 0);
	/* boxes were for building only */
	free(c->bounds);
	c->bounds = NULL;
	return st;
}

enum status ray_scene_create(struct ray_scene **out, const struct surface *const *surfaces, int n,
                             size_t memory, const struct report *r)
{
	return ray_scene_create_trimmed(out, surfaces, NULL, n, memory, r);
}

enum status ray_scene_create_trimmed(struct ray_scene **out, const struct surface *const *surfaces,
                                     const struct trim *const *trims, int n, size_t memory,
                                     const struct report *r)
{
	struct ray_scene *s = calloc(1, sizeof *s);

	*out = NULL;
	if (!s)
		return report_error(r, ST_RESOURCE, "no memory for a scene; allow more");

	enum status st = ray_cut_init(&s->cut, surfaces, trims, n, memory, r);
	if (st != ST_OK)
		goto fail;
	s->surfaces = calloc(n, sizeof *s->surfaces);
	if (s->surfaces) {
		memcpy((void *)s->surfaces, surfaces, n * sizeof *surfaces);
		st = tree_build(s);
	} else {
		st = ST_RESOURCE;
	}
	if (st != ST_OK) {
		report_error(
		        r, st,
		        "cannot build the tree over %zu pieces of surface: it takes more memory "
		        "than there is or is allowed; allow more or take fewer surfaces",
		        s->cut.n_leaves);
		goto fail;
	}
	*out = s;
	return ST_OK;
fail:
	ray_scene_destroy(s);
	return st;
}

void ray_scene_destroy(struct ray_scene *s)
{
	if (!s)
		return;
	ray_tree_finish(&s->tree);
	free((void *)s->surfaces);
	ray_cut_finish(&s->cut);
	free(s);
}

size_t ray_scene_memory(const struct ray_scene *s)
{
	return s->cut.bytes + s->tree.capacity * sizeof *s->tree.nodes;
}

size_t ray_scene_leaves(const struct ray_scene *s)
{
	return s->cut.n_leaves;
}

const struct trim_test *ray_scene_trim(const struct ray_scene *s, int surface)
{
	return s->cut.trims[surface];
}

struct box ray_scene_box(const struct ray_scene *s)
{
	return s->cut.box;
}

/* Rays that are ordered at a time: as many as their order fits the stack. */
enum { ORDER_CHUNK = 4096 };

static int octant(struct vec3 d)
{
	return (d.x < 0) | (d.y < 0) << 1 | (d.z < 0) << 2;
}

/* Rays of one octant stand together, else in the order they came. */
static void order_by_octant(const struct ray *rays, size_t n, uint32_t *order)
{
	size_t start[9] = { 0 };

	for (size_t i = 0; i < n; i++)
		start[octant(rays[i].direction) + 1]++;
	for (int k = 0; k < 8; k++)
		start[k + 1] += start[k];
	for (size_t i = 0; i < n; i++)
		order[start[octant(rays[i].direction)]++] = (uint32_t)i;
}

void ray_scene_hits(const struct ray_scene *s, const struct ray *rays, size_t n, bool coherent,
                    struct ray_hit *hits)
{
	if (coherent) {
		s->kernel->hits(s, rays, NULL, n, true, hits);
		return;
	}
	for (size_t first = 0; first < n; first += ORDER_CHUNK) {
		uint32_t order[ORDER_CHUNK];
		size_t count = n - first < ORDER_CHUNK ? n - first : ORDER_CHUNK;

		order_by_octant(rays + first, count, order);
		s->kernel->hits(s, rays + first, order, count, false, hits + first);
	}
}

void ray_scene_blocked(const struct ray_scene *s, const struct ray *rays, size_t n, bool *out)
{
	s->kernel->blocked(s, rays, n, out);
}

void ray_scene_hit(const struct ray_scene *s, const struct ray *ray, struct ray_hit *hit)
{
	s->kernel->hit(s, ray, hit);
}

bool ray_scene_is_blocked(const struct ray_scene *s, const struct ray *ray)
{
	return s->kernel->is_blocked(s, ray);
}
