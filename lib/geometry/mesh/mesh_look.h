/* mesh_look.h - is a mesh closed, and where is it not. */
#ifndef BATTEN_MESH_LOOK_H
#define BATTEN_MESH_LOOK_H

#include "tessellate.h"

/* Open edges that hang together. */
struct mesh_border {
	int edges;
	double length;
	double width;   /* mean distance of its sides: next to nothing for a gap between faces */
	struct vec3 at; /* one of its points */
	int parts[2];   /* two of the faces along it; the second -1: one only */
};

struct mesh_looks {
	int open;                    /* edges of one triangle */
	int multiple;                /* edges of more than two */
	int turned;                  /* edges of two that do not agree which side is which */
	struct mesh_border *borders; /* owned; the longest first */
	int n_borders;
};

/* Edges go by their points, not by where those are. *out is empty on failure. Errors: ST_RESOURCE. */
enum status mesh_look(struct mesh_looks *out, const struct mesh *m);
void mesh_looks_finish(struct mesh_looks *x); /* a zeroed one is fine */

#endif
