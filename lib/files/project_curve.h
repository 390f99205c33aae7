/* project_curve.h - curves that lie on a surface, in space and in its u,v plane, one made from the other.
 * Private to this folder. */
#ifndef BATTEN_PROJECT_CURVE_H
#define BATTEN_PROJECT_CURVE_H

#include "curve.h"
#include "surface.h"

/* Looks for points on one surface. Not for several threads. */
struct projector;

/* s is borrowed. Errors: ST_RESOURCE. */
enum status projector_create(struct projector **out, const struct surface *s);
void projector_destroy(struct projector *p); /* NULL is fine */

/*
 * The u,v curve of a curve in space: lines where they do, and on parallelograms what is exact, else
 * cubics that leave c by `tolerance` more than c leaves the surface. Over the seam of a closed
 * surface it goes on beyond the domain. *distance: the largest found between c and what is made; beyond `reach` the rest is not
 * looked at, and what is made is of no use.
 * Errors: ST_RESOURCE.
 */
enum status projector_curve(struct projector *p, const struct curve *c, double tolerance,
                            double reach, struct curve *out, double *distance);

/* Length of a direction after which the surface begins anew, 0 where it is not closed. */
double projector_period(const struct projector *p, int d);

/* The curve in space of a u,v curve, cubics within tolerance; exact on parallelograms and along
 * lines of one parameter. Errors: ST_RESOURCE. */
enum status project_lift(const struct surface *s, const struct curve *uv, double tolerance,
                         struct curve *out);

#endif
