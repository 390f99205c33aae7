/* basis_inline.h - basis functions for single points, short enough to be compiled into the caller.
 * With a constant order the compiler unrolls everything. Private to this folder. */
#ifndef BATTEN_BASIS_INLINE_H
#define BATTEN_BASIS_INLINE_H

#include "knots.h"
#include "vec.h"

#define BATTEN_INLINE static inline __attribute__((always_inline))

/*
 * b: the order functions of span s at t. d, dd: their first and second derivatives, left alone
 * where NULL (dd only with d).
 * Source: The NURBS Book, A2.2; a derivative is the difference of those of one order less.
 */
BATTEN_INLINE void basis_inline(const int order, const double *knots, int s, double t, double *b,
                                double *d, double *dd)
{
	const double *k = knots + s;
	double left[ORDER_MAX], right[ORDER_MAX], lower[ORDER_MAX];
	b[0] = 1;
	lower[0] = 0;
	for (int j = 1; j < order; j++) {
		left[j] = t - k[1 - j];
		right[j] = k[j] - t;
		double saved = 0, slope = 0, bend = 0;
		for (int i = 0; i < j; i++) {
			const double width = right[i + 1] + left[j - i], q = b[i] / width;
			b[i] = saved + right[i + 1] * q;
			saved = left[j - i] * q;
			if (dd && j == order - 1) {
				const double q2 = lower[i] / width;
				dd[i] = j * (bend - q2);
				bend = q2;
			}
			if (d && j == order - 1)
				d[i] = j * (slope - q);
			if (dd && j == order - 2)
				lower[i] = j * (slope - q);
			slope = q;
		}
		b[j] = saved;
		if (dd && j == order - 1)
			dd[j] = j * bend;
		if (d && j == order - 1)
			d[j] = j * slope;
		if (dd && j == order - 2)
			lower[j] = j * slope;
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

/* A homogeneous point in two vector registers, which every x86-64 has. */
typedef double pair __attribute__((vector_size(16)));
struct point4 {
	pair xy, zw;
};

BATTEN_INLINE struct point4 point4_load(const double *p)
{
	return (struct point4){ { p[0], p[1] }, { p[2], p[3] } };
}

/* a + s b */
BATTEN_INLINE struct point4 point4_along(struct point4 a, double s, struct point4 b)
{
	return (struct point4){ a.xy + s * b.xy, a.zw + s * b.zw };
}

BATTEN_INLINE struct vec3 point4_vector(struct point4 a)
{
	return vec3(a.xy[0], a.xy[1], a.zw[0]);
}

BATTEN_INLINE double point4_weight(struct point4 a)
{
	return a.zw[1];
}

/* The Cartesian place of a control point, with weight 0: what others are taken about. */
BATTEN_INLINE struct point4 point4_center(const double *p, bool rational)
{
	const double scale = rational ? 1 / p[3] : 1;
	return (struct point4){ { p[0] * scale, p[1] * scale }, { p[2] * scale, 0 } };
}

/* p - w center */
BATTEN_INLINE struct point4 point4_about(const double *p, struct point4 center)
{
	return point4_along(point4_load(p), -p[3], center);
}

#endif
