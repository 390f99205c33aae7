/* curve.h - a NURBS curve (the thesis's egeom). */
#ifndef BATTEN_CURVE_H
#define BATTEN_CURVE_H

#include "knots.h"
#include "vec.h"

/*
 * Points are homogeneous: w x, w y, w z, w. Curves in a u,v plane keep z = 0.
 * Invariant (curve_check): as knots_check; finite points; weights > 0; domain inside the knots'.
 */
struct curve {
	int order;        /* degree + 1, ORDER_MIN .. ORDER_MAX */
	int n;            /* control points */
	bool rational;    /* some weights differ */
	bool periodic;    /* declared so by its source; the shape does not depend on it */
	double domain[2]; /* the part that is meant, in the knots' parameters */
	double *knots;    /* owned, n + order */
	double *points;   /* owned, n x 4 */
};

/* Room for a curve, knots and points zero, domain [0, 0]. Errors: ST_RESOURCE. */
enum status curve_init(struct curve *c, int order, int n);
void curve_finish(struct curve *c); /* a zeroed one is fine */
enum status curve_copy(struct curve *out, const struct curve *c);

/*
 * Check all invariants, set `rational`, set an empty domain to the knots', cut what sticks out by
 * rounding. Weights that are all equal are divided out. Errors: ST_INPUT.
 */
enum status curve_check(struct curve *c, const char *what, const struct report *r);

/* Set point i from Cartesian coordinates and weight. */
void curve_set_point(struct curve *c, int i, struct vec3 p, double w);
struct vec3 curve_get_point(const struct curve *c, int i, double *w); /* w may be NULL */

/*
 * Point and derivatives with respect to t to order d, d + 1 vectors; t inside the domain
 * (outside, the end span's polynomial goes on). At a knot: from the right, at the end from the left.
 * Source: The NURBS Book, A3.2, A4.2.
 */
void curve_derivatives(const struct curve *c, double t, int d, struct vec3 *out);
struct vec3 curve_point(const struct curve *c, double t);

/* Curvature and torsion at t. limit: the first derivative vanishes there and the values are
 * limits along the curve; NaN where there is none. Units: 1 / length. */
struct curve_shape {
	struct vec3 point, d1, d2;
	double curvature, torsion;
	bool limit;
};
void curve_shape(const struct curve *c, double t, struct curve_shape *out);

/* Length between a and b, to a relative accuracy (Gauss-Legendre a span, halved until it holds);
 * NaN for want of memory. */
double curve_length(const struct curve *c, double a, double b, double accuracy);

/* End points of the domain coincide within tolerance (same unit as the points). */
bool curve_closed(const struct curve *c, double tolerance);

#endif
