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
#include "curve.h"
#include "surface.h"
#include "text.h"

enum level_kind {
	LEVEL_PLANE,      /* S . direction = value */
	LEVEL_ISOPHOTE,   /* N . direction / |direction| = value, value in [-1, 1] */
	LEVEL_SILHOUETTE, /* N . direction = 0 */
};

struct level_field {
	enum level_kind kind;
	struct vec3 direction; /* any length but 0 */
	double value;
};

struct level; /* opaque: one surface, one field, its Bezier net; read-only after create */

/*
 * tolerance: largest distance in space between the fitted pieces and the exact curve, file units.
 * Errors: ST_PARAMETER (direction 0, value out of range, tolerance <= 0), ST_RESOURCE.
 */
enum status level_create(struct level **out, const struct surface *s,
                         const struct level_field *field, double tolerance,
                         const struct report *r);
void level_destroy(struct level *l);

size_t level_patches(const struct level *l);

/*
 * Find and fit all arcs in one patch; append them as bytes (private form, the same on every run).
 * Thread: any number on one level. Errors: ST_RESOURCE.
 */
enum status level_patch(const struct level *l, size_t patch, struct text *out);

/* One connected piece. */
struct level_branch {
	struct curve uv;    /* owned: cubic B-spline in the surface's parameters, z = 0 */
	struct curve space; /* owned: cubic B-spline in space, same knots */
	bool closed;        /* has no ends; over a seam uv jumps by the period, see seams */
	int seams;          /* how often uv goes over a seam: it is then cut there, in `cuts` */
	double length;      /* in space */
	double max_error;   /* largest distance found from surface and exact curve, dense sampling */
};

struct level_box {
	double lo[2], hi[2]; /* in u, v */
	bool flat;           /* f is zero in it up to rounding */
};

struct level_result {
	struct level_branch *branches; /* owned */
	size_t n_branches, n_closed;
	struct level_box *undecided; /* owned */
	size_t n_undecided;
	double length, max_error;
};

/*
 * Join the arcs of all patches; bytes[i], n[i] are what level_patch gave for patch i.
 * Branches come in an order that depends on nothing but the field and the surface.
 * Errors: ST_RESOURCE, ST_INTERNAL (bytes that no level_patch wrote).
 */
enum status level_join(const struct level *l, const char *const *bytes, const size_t *n,
                       struct level_result *out, const struct report *r);
void level_result_finish(struct level_result *x);

#endif
