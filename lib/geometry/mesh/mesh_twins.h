/* mesh_twins.h - edges inside several faces that have the same two points. Private to this folder. */
#ifndef BATTEN_MESH_TWINS_H
#define BATTEN_MESH_TWINS_H

#include "mesh_private.h"

/* A triangle is to be parted at the middle of its edge from `corner` to the next. */
struct mesh_split {
	int triangle, corner;
	struct mesh_corner middle;
	double uv[2];
};

/*
 * Faces that share borders may each have an edge between the same two points of them, as both sides of a
 * lens cut coarsely: one edge of four triangles. Inside each face it is parted, where the faces
 * are apart. Only triangles that stay count. *out is one a triangle at most, by triangle; owned by the caller, also on failure.
 * Errors: ST_RESOURCE.
 */
enum status mesh_twins(struct mesh_build *b, const bool *stays, struct mesh_split **out, int *n);

#endif
