/* bezier.h - the Bezier pieces of curves and surfaces. */
#ifndef BATTEN_BEZIER_H
#define BATTEN_BEZIER_H

#include "curve.h"
#include "surface.h"

/*
 * All patches of a surface over its domain: spans[0] x spans[1] patches, each order[0] x order[1]
 * homogeneous points (u outer). Neighbours share their border points to the bit, but at a knot that
 * stands `order` times, where the surface may break; the two ends of a direction that is closed
 * (homogeneous points within 1e-9 of the size) share theirs too.
 * Patch (a, b) covers [breaks[0][a], breaks[0][a+1]] x [breaks[1][b], breaks[1][b+1]].
 */
struct bezier_net {
	int order[2], spans[2];
	bool rational, closed[2];
	double size;       /* largest extent of the points' box */
	double *breaks[2]; /* owned, spans[d] + 1 */
	double *points;    /* owned */
};

/*
 * Source: blossoming (Ramshaw 1987); works for any knots, also unclamped, and a domain that is a
 * part of the knots'. Errors: ST_RESOURCE.
 */
enum status bezier_net_init(struct bezier_net *out, const struct surface *s);

/* The same from sums of 64 binary digits: ten times slower, and each number is within two roundings of the size of the
 * points that it is a mean of. For spans so narrow that their points' differences matter. */
enum status bezier_net_init_exact(struct bezier_net *out, const struct surface *s);
void bezier_net_finish(struct bezier_net *b);

static inline size_t bezier_patch_size(const struct bezier_net *b) /* in doubles */
{
	return (size_t)4 * b->order[0] * b->order[1];
}

static inline const double *bezier_patch(const struct bezier_net *b, int i, int j)
{
	return b->points + bezier_patch_size(b) * ((size_t)i * b->spans[1] + j);
}

/* Likewise for a curve: `spans` pieces of `order` points. */
struct bezier_chain {
	int order, spans;
	bool rational;
	double *breaks; /* owned, spans + 1 */
	double *points; /* owned, spans x order x 4 */
};
enum status bezier_chain_init(struct bezier_chain *out, const struct curve *c);
void bezier_chain_finish(struct bezier_chain *b);

/* Bernstein polynomials of degree order-1 at t in [0, 1]; d (may be NULL) their derivatives. */
void bernstein(int order, double t, double *b, double *d);

#endif
