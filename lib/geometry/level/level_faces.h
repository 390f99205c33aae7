/* level_faces.h - curves on several faces: clipped to their trims, joined over shared borders.
 *
 * A face is a surface and what its trims leave of it. Its border is made of the trimming curves, or of
 * the sides of the surface's domain; seams of closed surfaces and sides that are one point are none.
 * Where the borders of two faces are no farther apart than the gap, in whatever parametrisation and
 * direction, and however far they run together, the faces share them.
 */
#ifndef BATTEN_LEVEL_FACES_H
#define BATTEN_LEVEL_FACES_H

#include "level.h"
#include "trim.h"

/* Both borrowed. trim NULL or without loops: all of the surface. */
struct level_face {
	const struct surface *surface;
	const struct trim *trim;
};

struct level_faces; /* opaque: faces, their borders in space, an index of them; read-only */

/* gap: in space, file units; 0: borders are shared where they are the same to rounding. Errors:
 * ST_RESOURCE. */
enum status level_faces_create(struct level_faces **out, const struct level_face *faces, int n,
                               double gap);
void level_faces_destroy(struct level_faces *f); /* NULL is fine */

/*
 * Take from a result on face i what its trims cut away. What is left ends on the trim, to 1e-12 of
 * the domain; where a branch runs within the tolerance of a trimming curve, it is on the face.
 * A touch parts nothing. Undecided boxes wholly outside go, too.
 * tolerance: of the curves, in space. Errors: ST_RESOURCE.
 */
enum status level_clip(const struct level_faces *f, int i, double tolerance,
                       struct level_result *x);

/* Lines of faces to be drawn, cubic B-splines in space. */
struct level_lines {
	struct curve *wires, *borders; /* owned */
	size_t n_wires, n_borders;
};

/*
 * Put face i's border and so many isoparametric lines in each direction, clipped, behind a zeroed or
 * begun *out. tolerance: how near the curves are to be, by their middles. Errors: ST_RESOURCE.
 */
enum status level_face_lines(const struct level_faces *f, int i, int wires, double tolerance,
                             struct level_lines *out);
void level_lines_finish(struct level_lines *x); /* a zeroed one is fine */

/* One branch in a chain. */
struct level_part {
	int face;
	size_t branch; /* of the face's result */
	bool reversed; /* run through from its end to its start */
};

/* Branches one behind the other. */
struct level_chain {
	size_t first, n; /* in parts */
	bool closed;     /* has no ends */
};

struct level_chains {
	struct level_part *parts; /* owned; every branch of all results once */
	struct level_chain *list; /* owned */
	size_t n, n_closed;
	size_t joins;   /* places where two branches were joined */
	size_t creases; /* ends on a border that another face shares with another normal (for lines of
	                   curvature: another curvature) */
	size_t nodes;   /* places where three or more branches of several faces end: crossings */
	double step;    /* the largest distance between ends that were joined */
};

/* How the field goes on over a border. */
struct level_joining {
	const struct level_field *field;
	double tolerance; /* of the curves, in space */
	double crease;    /* normals that differ by less, in radians, make no crease */
};

/*
 * Join the branches of one field on all faces, results[i] those on face i. A branch that runs along
 * a border which another face has one along, too, stays with the first of them alone; results are
 * changed where that is so; specks, no longer than half the tolerance and on shared borders, go, too. Planes and cylinders go over creases; all other curves end there on both
 * sides, and so do those whose sign turns with the normal where two faces' normals are opposite.
 * The chains depend on nothing but faces, field and results. Errors: ST_RESOURCE.
 */
enum status level_chains_join(const struct level_faces *f, const struct level_joining *how,
                              struct level_result *results, struct level_chains *out);
void level_chains_finish(struct level_chains *c); /* a zeroed one is fine */

#endif
