/* shape.h - what the view keeps of each thing: triangles, lines, rays; made anew when the thing's
 * revision or what is asked of its lines changes. Private to this folder. */
#ifndef BATTEN_VIEW_SHAPE_H
#define BATTEN_VIEW_SHAPE_H

#include "gpu.h"
#include "ray_scene.h"
#include "world.h"

/* Polylines of a thing, each drawn in a style of its own. */
enum shape_lines {
	SHAPE_WIRE,   /* isoparametric lines between the borders */
	SHAPE_EDGE,   /* borders and trims */
	SHAPE_CURVE,  /* of a curve */
	SHAPE_NET,    /* control polygon or net */
	SHAPE_POINTS, /* control points, or those of a list: sprites, no lines */
	SHAPE_QUILLS, /* of the comb, where the curve bends to one side */
	SHAPE_QUILLS_OTHER,
	SHAPE_ENVELOPE, /* the line over the quills' ends */
	N_SHAPE_LINES,
	N_MOVED_LINES = SHAPE_CURVE + 1 /* those of which fewer chords do while it is moved */
};

/* Triangles, and how far they may be from the surface; 0: none yet. */
struct shape_mesh {
	struct gpu_mesh gpu;
	struct mesh_made made; /* kept of the coarse ones */
	bool loaded;           /* gpu has what was made */
	double chord;
	int triangles;
	bool failed; /* cannot be cut: nothing is drawn of it */
};

struct shape {
	int id;
	unsigned revision;
	bool seen;      /* in the world's list that is gone through */
	struct box box; /* of the control points */
	struct vec3 origin;
	struct surface surface;   /* owned copy, order 0: no surface; rays borrow it */
	struct trim trim;         /* owned copy */
	struct trim_test *inside; /* owned; NULL: all of it */
	struct ray_scene *rays;   /* owned; NULL: not needed yet */
	struct shape_mesh coarse, fine;
	struct poly poly[N_SHAPE_LINES];
	struct gpu_poly lines[N_SHAPE_LINES];
	bool lines_loaded[N_SHAPE_LINES];
	struct poly
	        moved_poly[N_MOVED_LINES]; /* what is drawn of them while something is dragged */
	struct gpu_ribbon moved_lines[N_MOVED_LINES];
	double moved_tolerance;  /* of these; 0: none yet */
	double tolerance;        /* of the lines; 0: none yet */
	bool has_wires;          /* among the lines */
	struct display made_for; /* what the lines were made for */
	unsigned on_revision;    /* of the surface that the curve lies on */
};

struct shapes {
	struct shape **all; /* owned, and each of them */
	int n, room;
	int newest;          /* id of those that were ever there */
	double coarse_chord; /* at which all are few enough; 0: not known */
};
void shapes_finish(struct shapes *s);

/* Take over what changed in the world, forget what is gone. Errors: ST_RESOURCE. */
enum status shapes_update(struct shapes *s, const struct world *w);
/* NULL: none. near: where it may be, its place in the world. */
struct shape *shapes_find(const struct shapes *s, int id, int near);

/* In the graphics memory when they are first drawn. */
struct gpu_poly *shape_lines(struct shape *x, enum shape_lines which);
const struct gpu_mesh *shape_mesh_gpu(struct shape_mesh *m);

/* Lines within tolerance (file units), but not twice as good for nothing; wires: those inside a surface
 * too. Errors: ST_RESOURCE. */
enum status shape_make_lines(struct shape *x, const struct world *w, const struct Ful *f,
                             bool wires, double tolerance);

/* Those lines with fewer chords, from what was made of them. Errors: ST_RESOURCE. */
enum status shape_make_moved_lines(struct shape *x, double tolerance);

/* Rays against the surface; NULL where it has none or memory ran out. */
const struct ray_scene *shape_rays(struct shape *x);

/* Bring the triangles of n shapes near enough for chord, all threads; most: of triangles, about. The
 * bends of shapes of less than some tens of `seen` in size count less.
 * Stops between shapes when `seconds` have passed; *more: not all was done.
 * Errors: ST_RESOURCE. */
enum status shapes_cut(struct shape *const *shapes, int n, bool coarse, double chord, double seen,
                       int most, double seconds, bool *more);

/* The coarse triangles of n shapes: chord, or more until they are `most` at most, once for all. */
enum status shapes_cut_coarse(struct shapes *s, struct shape *const *shapes, int n, double chord,
                              int most);

/* Box of all control points of a thing in space; false: none. Cheap. */
bool thing_box(const struct world *w, const struct Ful *f, struct box *out);

/* comb.c: quills of a curve c, on from it, drawn from u to v: ends in out[SHAPE_QUILLS...]. */
void comb_add(struct poly *out, const struct curve *c, const struct surface *on, double longest,
              int quills);

#endif
