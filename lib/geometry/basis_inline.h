/* basis_inline.h - basis functions for single points, short enough to be compiled into the caller.
 * With a constant order the compiler unrolls everything. Private to this folder. */
#ifndef BATTEN_BASIS_INLINE_H
#define BATTEN_BASIS_INLINE_H

#include <string.h>

#include "knots.h"

#define BATTEN_INLINE static inline __attribute__((always_inline))

/*
 * b: the order functions of span s at t. d: their first derivatives, left alone where NULL.
 * Source: The NURBS Book, A2.2; the derivative is the difference of those of one order less.
 */
BATTEN_INLINE void basis_inline(const int order, const double *knots, int s, double t, double *b,
                                double *d)
{
	const double *k = knots + s;
	double left[ORDER_MAX], right[ORDER_MAX];
	b[0] = 1;
	for (int j = 1; j < order; j++) {
		left[j] = t - k[1 - j];
		right[j] = k[j] - t;
		double saved = 0, slope = 0;
		for (int i = 0; i < j; i++) {
			double q = b[i] / (right[i + 1] + left[j - i]);
			b[i] = saved + right[i + 1] * q;
			saved = left[j - i] * q;
			if (d && j == order - 1) {
				d[i] = j * (slope - q);
				slope = q;
			}
		}
		b[j] = saved;
		if (d && j == order - 1)
			d[j] = j * slope;
	}
}

/* Index of the largest of the functions. */
static inline int basis_heaviest(const double *basis, int order)
{
	int best = 0;
	for (int i = 1; i < order; i++)
		if (basis[i] > basis[best])
			best = i;
	return best;
}

/* A sum of homogeneous points: four doubles that stay in vector registers. */
typedef double point4 __attribute__((vector_size(32)));

/* *sum += b p */
BATTEN_INLINE void point4_add(point4 *sum, double b, const double *p)
{
	point4 x;
	memcpy(&x, p, sizeof x);
	*sum += b * x;
}

#endif
