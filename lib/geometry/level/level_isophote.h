/* level_isophote.h - f of isophotes that are not at 90 degrees. */
#ifndef BATTEN_LEVEL_ISOPHOTE_H
#define BATTEN_LEVEL_ISOPHOTE_H

#include "level_private.h"

/* level_isophote.c: like level_field_make, but at 90 degrees. Isophotes whose cosine is at most LEVEL_OBLIQUE
 * are made from the normal's length; below LEVEL_COSINE_ZERO it is 0. */
#define LEVEL_OBLIQUE     0.02
#define LEVEL_COSINE_ZERO 1e-15
bool level_isophote_make(struct tracer *t, double *out);

/* f once more in a cell, from the normals there, and its bound: the smaller f's terms are there, the nearer. What
 * evaluating f there is off is in it. False where f is not made of squares. */
bool level_isophote_again(struct tracer *t, const struct cell *cell, double *out, struct bound *b);

/* The cell is a corner of the patch where the normal vanishes, and all others in it are away from the angle: nothing but
 * that corner keeps f from having a sign. Silhouettes, too. */
bool level_isophote_clear(struct tracer *t, const struct cell *cell);

/* What t->product must hold. */
size_t level_isophote_room(const struct level *l);

#endif
