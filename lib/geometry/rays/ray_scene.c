/* ray_scene.c - the scene: leaves under Embree's tree, and rays handed to the kernel of this
 * processor's vector level. */
#include "ray_scene.h"

#include <stdlib.h>
#include <string.h>

#include "parallel.h"
#include "ray_kernel.h"

/* Embree asks before it takes memory and tells when it gives some back (bytes < 0). */
static bool tree_memory(void *data, ssize_t bytes, bool post)
{
	struct ray_scene *s = data;
	size_t now = s->tree_bytes + (size_t)bytes;

	s->tree_bytes = now;
	if (bytes > 0 && !post && s->cut.memory && s->cut.bytes + now > s->cut.memory) {
		s->tree_bytes = now - (size_t)bytes;
		return false;
	}
	return true;
}

static void leaf_box(const struct RTCBoundsFunctionArguments *args)
{
	const struct ray_scene *s = args->geometryUserPtr;
	const struct ray_bounds *b = &s->cut.bounds[args->primID];

	*args->bounds_o = (struct RTCBounds){
		.lower_x = b->lo[0],
		.lower_y = b->lo[1],
		.lower_z = b->lo[2],
		.upper_x = b->hi[0],
		.upper_y = b->hi[1],
		.upper_z = b->hi[2],
	};
}

/* The widest kernel that both this process and the tree take natively. */
static const struct ray_kernel *kernel_choose(RTCDevice device)
{
#if RAY_LEVELS
	const char *level = vector_level();

	if (!strcmp(level, ray_kernel_16.level) &&
	    rtcGetDeviceProperty(device, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED))
		return &ray_kernel_16;
	if (!strcmp(level, ray_kernel_16.level) || !strcmp(level, ray_kernel_8.level))
		return &ray_kernel_8;
#else
	(void)device;
#endif
	return &ray_kernel_4;
}

static enum status tree_build(struct ray_scene *s)
{
	s->device = rtcNewDevice("threads=1,set_affinity=0");
	if (!s->device)
		return ST_RESOURCE;
	rtcSetDeviceMemoryMonitorFunction(s->device, tree_memory, s);
	s->kernel = kernel_choose(s->device);
	s->tree = rtcNewScene(s->device);
	RTCGeometry g = rtcNewGeometry(s->device, RTC_GEOMETRY_TYPE_USER);
	rtcSetSceneFlags(s->tree, RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_COMPACT);
	rtcSetGeometryUserPrimitiveCount(g, (unsigned)s->cut.n_leaves);
	rtcSetGeometryUserData(g, s);
	rtcSetGeometryBoundsFunction(g, leaf_box, NULL);
	rtcSetGeometryIntersectFunction(g, s->kernel->intersect);
	rtcSetGeometryOccludedFunction(g, s->kernel->occluded);
	rtcCommitGeometry(g);
	rtcAttachGeometry(s->tree, g);
	rtcReleaseGeometry(g);
	rtcCommitScene(s->tree);
	if (rtcGetDeviceError(s->device) != RTC_ERROR_NONE)
		return ST_RESOURCE;
	/* boxes were for building only */
	free(s->cut.bounds);
	s->cut.bounds = NULL;
	return ST_OK;
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
	if (s->tree)
		rtcReleaseScene(s->tree);
	if (s->device)
		rtcReleaseDevice(s->device);
	free((void *)s->surfaces);
	ray_cut_finish(&s->cut);
	free(s);
}

size_t ray_scene_memory(const struct ray_scene *s)
{
	return s->cut.bytes + s->tree_bytes;
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
	s->kernel->blocked(s, rays, NULL, n, out);
}

void ray_scene_hit(const struct ray_scene *s, const struct ray *ray, struct ray_hit *hit)
{
	s->kernel->hit(s, ray, hit);
}

bool ray_scene_is_blocked(const struct ray_scene *s, const struct ray *ray)
{
	return s->kernel->is_blocked(s, ray);
}
