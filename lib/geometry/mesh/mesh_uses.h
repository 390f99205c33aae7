/* mesh_uses.h - the triangles at each edge. Private to this folder. */
#ifndef BATTEN_MESH_USES_H
#define BATTEN_MESH_USES_H

#include "tessellate.h"

/* An edge of a triangle, kept at the lower of its two points. */
struct mesh_use {
	int high, triangle, corner; /* from that corner to the next */
	bool up;                    /* it runs from the lower point to the higher one */
};

struct mesh_uses {
	int *first;            /* owned; of each point its first use, and one behind the last */
	struct mesh_use *list; /* owned; of each point by the higher one, then by triangle */
};

/* Errors: ST_RESOURCE; finish it for all that. */
enum status mesh_uses_init(struct mesh_uses *x, const struct mesh *m);
void mesh_uses_finish(struct mesh_uses *x);

/* The part that a triangle belongs to. */
int mesh_part_of(const struct mesh *m, int triangle);

#endif
