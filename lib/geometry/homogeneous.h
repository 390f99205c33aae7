/* homogeneous.h - what curves and surfaces share: checks of points and domains, and the derivatives of
 * a rational form from those of its homogeneous one. Private to this folder. */
#ifndef BATTEN_HOMOGENEOUS_H
#define BATTEN_HOMOGENEOUS_H

#include <stdbool.h>

#include "report.h"
#include "vec.h"

/*
 * Points are finite, weights > 0. Equal weights are made 1, others set *rational. n1 is the length
 * of an inner row (1 for a curve), for the place in the sentence. Errors: ST_INPUT.
 */
enum status points_check(double *points, int n0, int n1, const char *what, bool *rational,
                         const struct report *r);

/*
 * The domain lies inside [a, b], the knots'; an empty one is set to it, one that sticks out by
 * rounding is cut. Errors: ST_INPUT.
 */
enum status domain_check(double domain[2], double a, double b, const char *what,
                         const struct report *r);

/*
 * Derivatives 0 .. d of x/w, y/w, z/w from homogeneous derivatives h[0..top], zero above.
 * Source: The NURBS Book, A4.2.
 */
void quotient_curve(int top, const double (*h)[4], int d, struct vec3 *out);

/*
 * Likewise for k + l <= d, out[k * (d + 1) + l], from h[k * stride + l], k <= top[0], l <= top[1].
 * Source: The NURBS Book, A4.4.
 */
void quotient_surface(const int top[2], const double (*h)[4], int stride, int d, struct vec3 *out);

#endif
