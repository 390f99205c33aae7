/* g2_elementary.h - lines, circles, planes, cylinders ... of .g2 as NURBS. Private to this folder. */
#ifndef BATTEN_G2_ELEMENTARY_H
#define BATTEN_G2_ELEMENTARY_H

#include "model.h"

enum { G2_ELEMENTARY_MAX = 40 /* numbers that one has, and a few more */ };

/* Is that class one of them? *kind: what it becomes. */
bool g2_is_elementary(int class, enum entity_kind *kind);

/*
 * Make the curve or surface of *e, which is initialised, from the object's numbers, exactly; only
 * that arcs run by NURBS parameters instead of the angle, the same at the ends and every 90 degrees
 * at most. Errors: ST_INPUT with *reason (a constant), ST_RESOURCE.
 */
enum status g2_make_elementary(int class, const double *x, int n, struct entity *e,
                               const char **reason);

#endif
