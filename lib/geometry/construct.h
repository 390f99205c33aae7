/* construct.h - curves and surfaces made from a description. Outputs are fresh; lengths in the
 * caller's unit, angles in radians. Inputs may be unclamped and their domain a part of the knots'.
 * Errors: ST_RESOURCE, ST_PARAMETER (what is wrong in report); the output is then untouched or
 * empty and need not be finished. */
#ifndef BATTEN_CONSTRUCT_H
#define BATTEN_CONSTRUCT_H

#include <stdint.h>

#include "curve.h"
#include "surface.h"

enum status make_line(struct curve *out, struct vec3 a, struct vec3 b); /* domain [0, 1] */

/* Circular arc about c in the plane of unit vectors x, y, from angle a to b (a < b <= a + 2 pi);
 * domain [a, b]; rational quadratic pieces of at most 90 degrees.
 * Source: The NURBS Book, A7.1. */
enum status make_arc(struct curve *out, struct vec3 c, struct vec3 x, struct vec3 y, double radius,
                     double a, double b);

/* Polyline through n >= 2 points, knots uniform, domain [0, 1]. */
enum status make_polyline(struct curve *out, const struct vec3 *p, int n);

/* Conic A x^2 + B xy + C y^2 + D x + E y + F = 0 in the plane z = zt, from p to q
 * (IGES 104): an ellipse counterclockwise about +z, the whole of it where p and q are one point;
 * p and q must lie on the conic, on one branch of a hyperbola. z of p and q is not used.
 * Parameters are the standard's: of a parabola the coordinate across its axis; of an ellipse the angle of
 * its half axes and of a hyperbola that of secant and tangent, as arcs have theirs (make_arc). */
enum status make_conic(struct curve *out, const double coefficients[6], double zt, struct vec3 p,
                       struct vec3 q, const struct report *r);

/* Piecewise power-basis polynomial (IGES 112, 114): segment i has coefficients c[i][dim][power]
 * of (t - breaks[i]). degree 1 .. 3. Knots take the continuity that the segments really have, C0 at
 * least; segments that do not join within tolerance are an error, smaller gaps are closed in their
 * middle. A surface has nu x nv patches; the coefficient of (u - u[i])^k (v - v[j])^l stands at
 * c[i * nv + j][dim][k + 4 l]; `u` holds nu + 1 breaks, `v` nv + 1. */
enum status make_power_curve(struct curve *out, const double *breaks, int segments,
                             const double (*c)[3][4], double tolerance, const struct report *r);
enum status make_power_surface(struct surface *out, const double *u, int nu, const double *v,
                               int nv, const double (*c)[3][16], double tolerance,
                               const struct report *r);

/* Join curves end to start within tolerance into one (degrees raised, parameters put one after the
 * other from 0, lengths kept; IGES 102). `n` curves; gaps are closed in their middle. */
enum status make_composite(struct curve *out, const struct curve *c, int n, double tolerance,
                           const struct report *r);

/*
 * (1 - v) a(u) + v b(u), v in [0, 1]; b's parameter is mapped linearly on a's domain. Exact also for
 * rational curves: where the weights differ both get the common denominator, which doubles the
 * degree (ST_PARAMETER beyond ORDER_MAX). Source: The NURBS Book, section 8.4.
 */
enum status make_ruled(struct surface *out, const struct curve *a, const struct curve *b);

/* Curve (u) moved along d, v in [0, 1] (IGES 122). */
enum status make_cylinder(struct surface *out, const struct curve *c, struct vec3 d);

/* Curve turned about the line through p along unit axis, counterclockwise from angle
 * a to b <= a + 2 pi: u is the curve's parameter, v runs over [a, b] (as IGES 120 has them; angles
 * and v agree at the ends and the joints, every 90 degrees at most). A point of the curve on the
 * axis gives a pole. Source: The NURBS Book, A8.1. */
enum status make_revolution(struct surface *out, const struct curve *c, struct vec3 p,
                            struct vec3 axis, double a, double b);

/* Bilinear patch, corners (0,0) (1,0) (0,1) (1,1). */
enum status make_bilinear(struct surface *out, const struct vec3 corner[4]);

/* Offset by distance along N, approximated to tolerance (absolute); *error is the largest distance
 * found by checking. ST_INPUT where the distance exceeds the smallest radius. */
enum status make_offset(struct surface *out, const struct surface *s, double distance,
                        double tolerance, double *error, const struct report *r);

/* How much work may be done: points looked at, and whether to stop, asked every few thousand. */
struct effort {
	int64_t points;
	bool (*stop)(void *data); /* may be NULL */
	void *data;
};

/* Likewise with limits. Errors: also ST_PARAMETER (too much work), ST_CANCELLED (stopped). */
enum status make_offset_within(struct surface *out, const struct surface *s, double distance,
                               double tolerance, const struct effort *effort, double *error,
                               const struct report *r);

/* About the z axis through c, N outward: u is the longitude in [0, 2 pi], v the latitude in
 * [-pi/2, pi/2] or the angle about the torus's tube in [0, 2 pi]; major > minor > 0. */
enum status make_sphere(struct surface *out, struct vec3 c, double radius);
enum status make_torus(struct surface *out, struct vec3 c, double major, double minor);

#endif
