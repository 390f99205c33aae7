/* circle.h - the unit circle's arc as a rational quadratic (private to geometry). */
#ifndef BATTEN_CIRCLE_H
#define BATTEN_CIRCLE_H

#include <stdbool.h>

/* Pieces of at most 90 degrees; x and y are homogeneous: weight times coordinate. */
struct circle {
	int pieces, n; /* n = 2 pieces + 1 points */
	double x[9], y[9], w[9], knots[12];
};

/* From angle a to b, knots too. False unless a < b <= a + 2 pi; a whole turn closes to the bit. */
bool circle_init(struct circle *c, double a, double b);

#endif
