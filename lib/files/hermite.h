/* hermite.h - a function of one parameter as a piecewise cubic. Private to this folder. */
#ifndef BATTEN_HERMITE_H
#define BATTEN_HERMITE_H

#include "curve.h"

struct hermite_node {
	double t;
	struct vec3 point;
	struct vec3 in, out; /* derivatives from the left and from the right */
};

struct hermite {
	/* Fill n->point, in and out at n->t, which lies between a and b; at the ends only what lies
	 * inside is needed. `guess` is where the point may be expected. */
	void (*at)(void *data, double a, double b, struct vec3 guess, struct hermite_node *n);
	/* How far a candidate is from what is meant at n->t, in the unit of the tolerance. */
	double (*off)(void *data, const struct hermite_node *n, struct vec3 candidate);
	void *data;
	double tolerance;
};

/*
 * Halve the spans between n >= 2 rising breaks until every cubic agrees in its middle and quarters;
 * spans are not halved below 1e-3 of the whole. `first` is the point at breaks[0]. *worst: the
 * largest disagreement left. Errors: ST_RESOURCE.
 */
enum status hermite_fit(const struct hermite *h, const double *breaks, int n, struct vec3 first,
                        struct curve *out, double *worst);

/* Breaks of a curve, and more between them where they are fewer than `least`, for hermite_fit. Fresh.
 * Errors: ST_RESOURCE. */
enum status hermite_breaks(const struct curve *c, int least, double **out, int *n);

#endif
