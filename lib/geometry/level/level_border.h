/* level_border.h - borders of faces in space, and which are near a point. Private to this folder. */
#ifndef BATTEN_LEVEL_BORDER_H
#define BATTEN_LEVEL_BORDER_H

#include "box.h"
#include "level_faces.h"
#include "level_private.h"

/* A side of the domain (uv NULL) over its parameter t, or a trimming curve. */
struct border_edge {
	int face;
	int d, end;             /* side d = lower or upper */
	const struct curve *uv; /* borrowed */
	double t[2];
	double length; /* in space, about */
};

/* A part of an edge that is nearly straight. */
struct border_segment {
	int edge;
	double t[2];
	struct box box; /* holds it */
};

/* Of a tree of boxes: the left child follows, a leaf has right = 0 and segments [from, to). */
struct border_node {
	struct box box;
	int from, to, right;
};

struct level_faces {
	struct level_face *faces; /* owned array */
	int n;
	double gap, flat;         /* flat: how straight the parts of edges are */
	struct trim_test **tests; /* owned, one a face; NULL: not trimmed */
	struct list edges, segments, nodes;
};

/* Where a border is nearest to a point. */
struct border_foot {
	int edge, face;
	double t, uv[2], distance;
	struct vec3 p, along; /* unit; zero where the edge stands still */
};

void border_edge_uv(const struct level_faces *f, int edge, double t, double uv[2], double duv[2]);

/* The feet of p on all edges within radius, at most one an edge, nearest first; at most `max`.
 * Returns how many. */
int border_feet(const struct level_faces *f, struct vec3 p, double radius, struct border_foot *out,
                int max);

/* The field less its value at u, v, as level.h defines it; NaN where there is none. */
double level_value(const struct level_field *f, const struct surface *s, double u, double v);

/*
 * Of branches that run along a border shared with a face before theirs, what a branch of that one
 * covers is taken out. Errors: ST_RESOURCE.
 */
enum status level_doubles_drop(const struct level_faces *f, double tolerance,
                               struct level_result *results);

/* Take out branches no longer than half the tolerance that lie on shared borders. Errors: ST_RESOURCE. */
enum status level_specks_drop(const struct level_faces *f, double tolerance,
                              struct level_result *results);

#endif
