/* interpolate.h - one direction of a spline that interpolates on spans that can be halved (private
 * to geometry). */
#ifndef BATTEN_INTERPOLATE_H
#define BATTEN_INTERPOLATE_H

#include "surface.h"

enum { SIDE_ORDER = 6 };

struct side {
	int spans, n;      /* n control points */
	double *breaks;    /* spans + 1; owned, like the others */
	int *multiplicity; /* knots at each break */
	double *error;     /* of each span, for side_halve */
	double *knots;     /* n + SIDE_ORDER */
	double *at;        /* n Greville abscissae, where values are taken */
	double *band;      /* factors: n rows of 2 SIDE_ORDER - 1, the diagonal in the middle */
};

/* Spans of s in direction d over its domain, one derivative less over its knots than s has, but
 * continuous. Errors: ST_RESOURCE. */
enum status side_init(struct side *out, const struct surface *s, int d);
void side_finish(struct side *s); /* a zeroed one is fine */

/* Halve the spans whose error is above the limit. Errors: ST_RESOURCE; s is then as before. */
enum status side_halve(struct side *s, double limit);

/* x: n rows of `columns` values at the abscissae become control points. */
void side_solve(const struct side *s, double *x, size_t columns);

#endif
