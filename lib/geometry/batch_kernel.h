/* batch_kernel.h - the inner loops of a batch, built once for each vector level. Private to this
 * folder. A lane is one point; all lanes lie in one span. */
#ifndef BATTEN_BATCH_KERNEL_H
#define BATTEN_BATCH_KERNEL_H

#include "grid_kernel.h"

enum { BATCH_WIDTHS = ORDER_MAX * (ORDER_MAX - 1) / 2 };

/* One span of a surface. */
struct batch_span {
	int order[2];
	bool rational;
	const double *knots[2]; /* at the span's lower end; borrowed */
	double inverse[2]
	              [BATCH_WIDTHS]; /* of the knot intervals, as the basis functions use them */
	double center[3];             /* subtracted from the points; added to the results */
	double points[ORDER_MAX * ORDER_MAX][4]; /* u outer */
};

struct batch_kernel {
	const char *level; /* as vector_level() names it */

	/*
	 * Channels `what` of n <= GRID_BLOCK lanes, n a multiple of GRID_PAD, at u and v. Returns how
	 * many are not surely regular: they have area2 <= 0.
	 */
	size_t (*block)(const struct batch_span *span, unsigned what, const double *u,
	                const double *v, size_t n, struct grid_block *out);
};

extern const struct batch_kernel batch_kernel_baseline;
#ifdef GRID_LEVELS_X86
extern const struct batch_kernel batch_kernel_v3, batch_kernel_v4;
#endif

#endif
