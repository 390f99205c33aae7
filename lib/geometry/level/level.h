/* level.h - all curves f(u,v) = 0 on a surface, for f made of the surface itself.
 *
 * f is brought into Bernstein form on every Bezier patch; boxes whose coefficients have one sign
 * hold no curve, boxes where f is monotone in one direction hold curves whose topology the border
 * signs tell; the rest is split. So closed loops inside a patch cannot be missed: a box that stays
 * neither at the smallest size is reported as undecided, never dropped.
 *
 * Work is done patch by patch, in any order and on any thread; level_join puts the arcs of all
 * patches together over patch borders, seams and poles.
 */
#ifndef BATTEN_LEVEL_H
#define BATTEN_LEVEL_H

#include <stddef.h>
#include <stdint.h>

#include "bezier.h"
#include "curvature.h"
#include "curve.h"
#include "surface.h"
#include "text.h"

enum level_kind {
	LEVEL_PLANE,      /* S . direction = value */
	LEVEL_ISOPHOTE,   /* N . direction / |direction| = value, value in [-1, 1] */
	LEVEL_SILHOUETTE, /* N . direction = 0 */
	LEVEL_CYLINDER,   /* distance from the line through `point` along `direction` = value > 0 */
	LEVEL_EYE,        /* N . (S - eye) = 0, the outline seen from a point */
	LEVEL_HIGHLIGHT,  /* the line along N through S passes the line through `point` along
	                     `direction` at the signed distance `value`, 0: meets it */
	LEVEL_REFLECTION, /* the ray from `eye` that S reflects meets that line, both as whole lines */
	LEVEL_CURVATURE, /* `quantity` = value; all but QUANTITY_ABSOLUTE */
	N_LEVEL_KINDS
};

/* What a kind does not name is not looked at. Points and lengths in the surface's units. */
struct level_field {
	enum level_kind kind;
	struct vec3 direction; /* any length but 0 */
	double value;
	struct vec3 point, eye;
	enum quantity quantity;
};

struct level; /* opaque: one surface, one field, its Bezier net; read-only after create */

/*
 * tolerance: largest distance in space between the fitted pieces and the exact curve, file units.
 * Errors: ST_PARAMETER (direction 0, value out of range, a point that is not finite, tolerance <=
 * 0), ST_RESOURCE.
 */
enum status level_create(struct level **out, const struct surface *s,
                         const struct level_field *field, double tolerance, const struct report *r);

/* An isophote next to 90 degrees, which is made in another way than others and wants more prepared. */
bool level_oblique(const struct level_field *field);

/*
 * Another value on the same surface, kind, direction and tolerance. It borrows what `first`
 * prepared: destroy it before. A value next to 90 degrees wants a first one that is, too (level_oblique): else it
 * is slow and its bounds are wide. For LEVEL_PLANE the value goes with the direction as a unit vector.
 * Errors: ST_PARAMETER, ST_RESOURCE.
 */
enum status level_create_like(struct level **out, const struct level *first, double value,
                              const struct report *r);
void level_destroy(struct level *l);

/*
 * Ask for another accuracy beside that in space: the largest distance between the curve in u,v and the
 * exact one, in the surface's parameters. Before the first patch; a level made like this one later
 * has it, too. Errors: ST_PARAMETER (not above 0).
 */
enum status level_set_tolerance_uv(struct level *l, double tolerance, const struct report *r);

size_t level_patches(const struct level *l);

/* Asked often while a patch is traced; true: it is to be given up. */
struct level_stop {
	bool (*asked)(void *data);
	void *data;
};

/*
 * Find and fit all arcs in one patch; append them as bytes (private form, the same on every run).
 * stop: NULL, never. Stopped, nothing is appended.
 * Thread: any number on one level. Errors: ST_CANCELLED, ST_RESOURCE.
 */
enum status level_patch(const struct level *l, size_t patch, const struct level_stop *stop,
                        struct text *out);

/*
 * One connected piece. Knots are threefold, so each span is a Bezier cubic; neighbours have the
 * same tangent. Where u or v jumps (over a seam, through a pole) the knot is fourfold in both
 * curves: uv jumps there, space does not. A closed one that goes over a seam begins there.
 * Equal t on both curves gives points that differ by the order of the tolerance along the curve.
 */
struct level_branch {
	struct curve uv;    /* owned: cubic B-spline in the surface's parameters, z = 0 */
	struct curve space; /* owned: cubic B-spline in space, same knots */
	bool closed;        /* has no ends */
	int seams;          /* how often uv jumps, from end to start of a closed one too */
	int mark[2];        /* the place in `undecided` where it begins and ends; -1: none */
	double length;      /* in space */
	/* no point of either curve is further from the exact one, of the one in u,v in the surface's
	 * parameters (docs/contours.md) */
	double max_error, max_error_uv;
};

/*
 * What stays undecided, by what is certain round it. Points and crossings are small: a part in 10,000
 * of the surface, or below the tolerance; singular ones ten times that. The branches that reach a crossing end in the same point
 * there, the middle of its box, if they can within the tolerance; else at its border.
 * One about an umbilic, no larger than a hundredth of the surface, is no crossing but an umbilic.
 */
enum level_mark {
	LEVEL_POINT,    /* no curve leaves it: a touch, or nothing */
	LEVEL_CROSSING, /* curves end in it */
	LEVEL_UMBILIC, /* small, and kmax = kmin at `at`, and there alone: curves may have a corner in it */
	LEVEL_SINGULAR, /* small, and the surface has no normal at `at`: curves that lead there end in it */
	LEVEL_REGION, /* larger: a plateau, a touch along a line, or places too near each other */
	LEVEL_GRAZE, /* whether a curve touches the border here, or a line where the derivatives of f
	                   jump, is undecided; its branches are as the computed f has them */
	N_LEVEL_MARKS
};

struct level_box {
	double lo[2], hi[2]; /* in u, v; over a seam hi is beyond the upper end */
	double at
	        [2]; /* where its branches end if they can: the middle, or the singular point, or the umbilic */
	bool flat; /* f is zero in it up to rounding */
	enum level_mark kind;
	int ends; /* of branches, in it: how many curves leave it */
};

extern const char *const level_mark_names[N_LEVEL_MARKS]; /* "crossing" */

/* Where kmax = kmin. */
enum level_umbilic_kind {
	LEVEL_UMBILIC_POINT,  /* one, in its box and its neighbourhood */
	LEVEL_UMBILIC_REGION, /* all of the box as far as rounding lets tell: a sphere, a plane */
	LEVEL_UMBILIC_UNDECIDED, /* one, several, or none */
	N_LEVEL_UMBILIC_KINDS
};

struct level_umbilic {
	enum level_umbilic_kind kind;
	double lo[2], hi[2], at[2]; /* u, v */
	double curvature;           /* both principal ones, at `at` */
	/* principal directions go round by so many halves of a turn about it: 1 lemon, -1 star; 0: not known (in a pole) */
	int halves;
};

extern const char *const level_umbilic_names[N_LEVEL_UMBILIC_KINDS]; /* "point" */

/* Umbilics are looked for with kmax and kmin alone: on the whole surface for a level that level_create made, for
 * others only in patches where something stayed undecided. */
struct level_result {
	struct level_branch *branches; /* owned */
	size_t n_branches, n_closed;
	struct level_box *undecided; /* owned; boxes that touch are one */
	size_t n_undecided;
	struct level_umbilic *umbilics; /* owned; points first */
	size_t n_umbilics;
	double length, max_error, max_error_uv;
};

/*
 * Join the arcs of all patches. Each of the blocks holds what level_patch appended for one patch or
 * several, one after another; patches rise through all blocks.
 * Branches come in an order that depends on nothing but the field and the surface.
 * Errors: ST_RESOURCE, ST_INTERNAL (bytes that no level_patch wrote).
 */
enum status level_join(const struct level *l, const char *const *blocks, const size_t *sizes,
                       size_t n_blocks, struct level_result *out, const struct report *r);
void level_result_finish(struct level_result *x);

#endif
