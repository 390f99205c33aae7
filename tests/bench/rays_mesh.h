/* rays_mesh.h - the peer: Embree on triangles of the same surfaces, with interpolated normals. */
#ifndef BATTEN_BENCH_RAYS_MESH_H
#define BATTEN_BENCH_RAYS_MESH_H

#include <embree3/rtcore.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "rays_view.h"

struct mesh {
	RTCDevice device;
	RTCScene scene;
	float *normals;    /* owned, 3 a vertex */
	uint32_t *corners; /* Embree's, 3 a triangle */
	size_t bytes;
};

/* Every Bezier span as n x n pairs of triangles; tight: no ray slips between two. */
void mesh_build(struct mesh *m, const struct scene *s, int n, bool tight);
void mesh_finish(struct mesh *m);

/* The view into SIZE x SIZE pixels and depths, in packets, or a ray a call; how many rays. */
size_t mesh_frame(const struct mesh *m, const struct view *v, float *image, float *depth);
size_t mesh_singles(const struct mesh *m, const struct view *v, float *image);

#endif
