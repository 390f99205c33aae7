/* tessellate.h - triangles of surfaces, as near as asked for and without gaps. */
#ifndef BATTEN_TESSELLATE_H
#define BATTEN_TESSELLATE_H

#include <stdatomic.h>

#include "surface.h"
#include "trim.h"

/* Places in mesh.points and mesh.normals. */
struct mesh_corner {
	int point, normal;
};

/* Triangles of one face: first .. first + count - 1. */
struct mesh_part {
	int first, count;
};

struct mesh {
	struct vec3 *points;  /* owned; each place once: faces that join share them */
	struct vec3 *normals; /* owned; of the surface, unit; sharp edges have several at a point */
	struct mesh_corner (*triangles)[3]; /* owned; counterclockwise about Su x Sv */
	double (*parameters)[3][2]; /* owned; u, v of the corners in their face, where asked for */
	int n_points, n_normals, n_triangles;
	struct mesh_part *parts; /* owned, one a face */
	int n_parts;
};

void mesh_finish(struct mesh *m); /* a zeroed one is fine */

/* Edges that are not shared by exactly two triangles, by place: 0 where the mesh is closed.
 * Errors: ST_RESOURCE. */
enum status mesh_open_edges(const struct mesh *m, int *out);

struct tessellate_face {
	const struct surface *surface; /* borrowed */
	const struct trim *trim;       /* borrowed; NULL or no loops: all of the surface */
};

struct tessellate_limits {
	double chord;    /* largest distance between surface and triangles, > 0; file units */
	double angle;    /* largest angle between normals at the ends of an edge, > 0; radians */
	double join;     /* borders nearer than this are one, >= 0; file units */
	bool parameters; /* the corners' u, v too */
	bool orient;     /* turn faces about so that neighbours agree and closed shapes look out */
};

/*
 * Triangles of n faces. A border that several faces share, or that a closed surface has twice, is
 * cut once, as finely as the strictest of them needs; a border that is one point gives no triangle
 * without area. Sharp lines inside a surface are edges of triangles. Points lie on their surface,
 * but on a joined border, where they are one surface's and within 2 join of the other.
 * Accuracy: chord is checked at points of every edge and triangle, as dense as the surface's spans;
 * angle holds where edges are longer than chord.
 * Errors: ST_RESOURCE, ST_PARAMETER (limits), ST_INPUT (a face whose loops cannot be cut), ST_CANCELLED.
 */
enum status tessellate(struct mesh *out, const struct tessellate_face *faces, int n,
                       const struct tessellate_limits *limits, const atomic_bool *stop,
                       const struct report *r);

#endif
