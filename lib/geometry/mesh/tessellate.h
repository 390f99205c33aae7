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
	struct vec3 *points; /* owned; each place once: faces that join share them */
	struct vec3
	        *normals; /* owned; of the surface, Su x Sv unless turned about, unit; sharp edges
	                       * have several at a point */
	struct mesh_corner (*triangles)[3]; /* owned; counterclockwise about the normals */
	double (*parameters)[3][2]; /* owned; u, v of the corners in their face, where asked for */
	int n_points, n_normals, n_triangles;
	struct mesh_part *parts; /* owned, one a face */
	int n_parts;
	double gap; /* the widest between borders that were joined */
};

void mesh_finish(struct mesh *m); /* a zeroed one is fine */

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

/* What a caller hears while it works, and says. */
struct tessellate_watch {
	void (*step)(void *data, double fraction); /* may be NULL */
	void *data;
	const atomic_bool *stop; /* may be NULL */
};

/* As many are no use to anyone: more than that is an error. */
enum { TESSELLATE_MOST = 20 * 1000 * 1000 };

/*
 * Triangles of n faces. A border that several faces share, or that a closed surface has twice, is
 * cut once, as finely as the strictest of them needs; a border that is one point gives no triangle
 * without area. Borders that meet within less are joined before those that meet within more, up to
 * `join`; where one ends and the other goes on the latter is parted. Sharp lines inside a surface are
 * edges of triangles. Points lie on their surface, but on a joined border, where they are one
 * surface's and within 2 join of the other. Loops that would cross where they are cut coarsely are
 * cut finer than asked for; a face whose loops cross for all that is left out, with a warning.
 * Accuracy: chord is checked at points of every edge and triangle, as dense as the surface's spans;
 * angle holds where edges are longer than chord.
 * `watch` may be NULL.
 * Errors: ST_RESOURCE (memory, TESSELLATE_MOST), ST_PARAMETER (limits), ST_CANCELLED.
 */
enum status tessellate(struct mesh *out, const struct tessellate_face *faces, int n,
                       const struct tessellate_limits *limits, const struct tessellate_watch *watch,
                       const struct report *r);

#endif
