/* refine.h - other forms of the same shape: knots inserted, degree raised, parts, turned about.
 * All outputs are fresh (caller finishes them); inputs are left alone. Errors: ST_RESOURCE,
 * ST_PARAMETER (a value outside the knots' domain, an order above ORDER_MAX).
 * Knots may be unclamped, and `domain` a part of theirs: it is kept unless said otherwise.
 * Accuracy: only convex combinations of points are made, so errors stay at a few roundings. */
#ifndef BATTEN_REFINE_H
#define BATTEN_REFINE_H

#include "curve.h"
#include "surface.h"

/* Insert the rising values x[0..m) (repeats allowed, final multiplicity at most order - 1).
 * Source: Boehm, CAD 12 (1980), 199-201; The NURBS Book, A5.4, A5.5. */
enum status curve_insert(struct curve *out, const struct curve *c, const double *x, int m);
enum status surface_insert(struct surface *out, const struct surface *s, int d, const double *x,
                           int m);

/* The part [a, b] (a surface: range[d] in both directions), clamped there, same parameters; it
 * becomes the domain. */
enum status curve_part(struct curve *out, const struct curve *c, double a, double b);
enum status surface_part(struct surface *out, const struct surface *s, const double (*range)[2]);

/* Raise the degree by t >= 0; unclamped knots are clamped first, at the ends of their domain.
 * Source: Prautzsch, CAGD 1 (1984), 193-198. */
enum status curve_elevate(struct curve *out, const struct curve *c, int t);
enum status surface_elevate(struct surface *out, const struct surface *s, int d, int t);

/* Same order and knots for both, clamped on the domain (parameters of b mapped linearly on a's
 * domain first). ST_PARAMETER where one has a gap (a knot `order` times) that the other has not. */
enum status curves_match(struct curve *out_a, struct curve *out_b, const struct curve *a,
                         const struct curve *b);

/* Linear change of parameter to [a, b], a < b. In place. */
void curve_reparametrise(struct curve *c, double a, double b);
void surface_reparametrise(struct surface *s, int d, double a, double b);

/* Reverse the direction (domain kept); exchange u and v (turns the normal). In place. */
void curve_reverse(struct curve *c);
void surface_reverse(struct surface *s, int d);
enum status surface_exchange(struct surface *s);

/* Isoparametric line d = t as a curve in the other parameter. */
enum status surface_isoparametric(struct curve *out, const struct surface *s, int d, double t);

/* Affine map by a 3 x 4 matrix (rows: x y z, last column moves). In place. */
void curve_transform(struct curve *c, const double m[3][4]);
void surface_transform(struct surface *s, const double m[3][4]);

#endif
