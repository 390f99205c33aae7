/* surface.h - a NURBS surface (the thesis's fgeom). Direction 0 is u, 1 is v, everywhere. */
#ifndef BATTEN_SURFACE_H
#define BATTEN_SURFACE_H

#include "knots.h"
#include "vec.h"

/* Points are homogeneous (w x, w y, w z, w), u outer, v inner: point (i, j) is at 4 (i n[1] + j).
 * Invariant (surface_check): as for a curve, in both directions. */
struct surface {
	int order[2];
	int n[2];
	bool rational;
	bool periodic[2];    /* declared so by its source */
	double domain[2][2]; /* the part that is meant: domain[0] = u from, to */
	double *knots[2];    /* owned, n[d] + order[d] */
	double *points;      /* owned, n[0] x n[1] x 4 */
};

/* Room for a surface, knots and points zero, domain empty. Errors: ST_RESOURCE. */
enum status surface_init(struct surface *s, const int order[2], const int n[2]);
void surface_finish(struct surface *s); /* a zeroed one is fine */
enum status surface_copy(struct surface *out, const struct surface *s);

/* As curve_check; a surface whose points are all one point is an error too. */
enum status surface_check(struct surface *s, const char *what, const struct report *r);

/* Point (i, j) as Cartesian coordinates and weight. */
void surface_set_point(struct surface *s, int i, int j, struct vec3 p, double w);
struct vec3 surface_get_point(const struct surface *s, int i, int j, double *w); /* w may be NULL */

/*
 * Point and partial derivatives with k + l <= d: out[k * (d + 1) + l] is d^(k+l)S / du^k dv^l;
 * the others are left alone. At a knot: from the right, at the end from the left.
 * Source: The NURBS Book, A3.6, A4.4.
 */
void surface_derivatives(const struct surface *s, double u, double v, int d, struct vec3 *out);
struct vec3 surface_point(const struct surface *s, double u, double v);

/* Point, S_u and S_v, the commonest call, without the general one's cost. */
void surface_tangents(const struct surface *s, double u, double v, struct vec3 *p, struct vec3 *du,
                      struct vec3 *dv);

/* The ends of the domain in direction d join within tolerance, over the whole border. */
bool surface_closed(const struct surface *s, int d, double tolerance);

/* Border d = lower (end 0) or upper (end 1) is one point within tolerance: a pole. */
bool surface_degenerate(const struct surface *s, int d, int end, double tolerance);

/* Largest extent of the control net's box: the size that relative tolerances refer to. */
double surface_size(const struct surface *s);

/* Area over the domain to a relative accuracy; *error is the last step's change. NaN for want of
 * memory. */
double surface_area(const struct surface *s, double accuracy, double *error);

#endif
