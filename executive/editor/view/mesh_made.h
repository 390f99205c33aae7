/* mesh_made.h - a surface's triangles as the graphics memory takes them. Private to this folder. */
#ifndef BATTEN_VIEW_MESH_MADE_H
#define BATTEN_VIEW_MESH_MADE_H

#include "surface.h"
#include "trim.h"

struct mesh_vertex_made {
	float position[3]; /* from the thing's origin */
	float normal[3];
	float uv[2]; /* 0 to 1 over the domain */
};

struct mesh_made {
	struct mesh_vertex_made *vertices;   /* owned */
	unsigned *indices;                   /* owned; three a triangle, then two a border's edge */
	int n_vertices, n_indices, n_border; /* indices: of triangles; of borders */
};
void mesh_made_finish(struct mesh_made *m); /* a zeroed one is fine */

/* Triangles within chord of the surface. Thread: any. Errors: as tessellate. */
enum status mesh_made_init(struct mesh_made *out, const struct surface *s, const struct trim *trim,
                           struct vec3 origin, double chord, double angle);

#endif
