/* knots.h - knot vectors: checks, spans, breaks, basis functions.
 *
 * A knot vector of order k (degree k - 1) over n control points has n + k knots that do not
 * decrease. It may be clamped (k equal knots at the ends) or not, uniform or not. The curve is
 * defined between knots[k-1] and knots[n].
 */
#ifndef BATTEN_KNOTS_H
#define BATTEN_KNOTS_H

#include <stdbool.h>
#include <stddef.h>

#include "report.h"

enum { ORDER_MIN = 2, ORDER_MAX = 26 };

/*
 * What a knot vector must satisfy: order in range, n >= order, finite, not decreasing, no knot more
 * than order times, a domain of positive length.
 * Errors: ST_INPUT, with the place in the sentence; `what` names the thing ("surface 3, u").
 */
enum status knots_check(int order, int n, const double *knots, const char *what,
                        const struct report *r);

/*
 * Span that holds t: s with knots[s] <= t < knots[s+1], order-1 <= s < n; at and beyond the upper
 * end of the domain the last span that is not empty, below the lower end the first.
 */
int knots_span(int order, int n, const double *knots, double t);

/* As knots_span, but t at an interior knot belongs to the span that ends there. */
int knots_span_left(int order, int n, const double *knots, double t);

/*
 * Span whose polynomial stands for t in a domain that is a part of the knots': as knots_span, but
 * at and beyond the domain's upper end the span that ends there, below its lower end the one that
 * begins there.
 */
int knots_domain_span(int order, int n, const double *knots, const double domain[2], double t);

/*
 * Basis functions of span s at t and their derivatives to order d: out[k * order + j] is the k-th
 * derivative of N_{s-order+1+j}. d may exceed the degree (zeros).
 * Source: Piegl and Tiller, The NURBS Book (2nd ed. 1997), A2.3.
 * Accuracy: a few rounding errors for each function, relative to its largest over the span.
 */
void knots_basis(int order, const double *knots, int s, double t, int d, double *out);

/* How many knots are equal to t; 0: none is. */
int knots_multiplicity(int order, int n, const double *knots, double t);

/*
 * Distinct values that bound the spans inside [a, b]: a, the knots between, b.
 * out must hold n + 2. Returns how many were written (spans + 1).
 */
int knots_breaks(int order, int n, const double *knots, double a, double b, double *out);

/* Greville abscissa of control point i. */
double knots_greville(int order, const double *knots, int i);

#endif
