/* grid_kernel.h - the inner loops of a grid, built once for each vector level. Private to this
 * folder.
 *
 * A lane is one column of the grid. Lanes of one span stand together, their number rounded up to a
 * multiple of GRID_PAD; every loop runs over whole multiples of it, without a remainder loop. So a
 * value does not depend on which lanes are asked for beside it, also where products and sums fuse.
 */
#ifndef BATTEN_GRID_KERNEL_H
#define BATTEN_GRID_KERNEL_H

#include "grid.h"

enum { GRID_PAD = 8, GRID_BLOCK = 128, GRID_DERIVATIVES = 6 };

/* The part of a row that lies in one span of u. */
struct grid_strip {
	int order;
	bool rational;
	const double
	        *basis[3]; /* of u, by derivative; function a of a lane at [a * stride + lane] */
	size_t stride;
	double net[3][ORDER_MAX]
	          [4];    /* control points contracted with the basis of v, by derivative */
	double center[3]; /* subtracted from the net; added to the points */
	double floor;     /* |Su x Sv|^2 up to which a lane is left to the slow way */
};

/* Arrays of components and results, all in the first level of cache. */
struct grid_block {
	_Alignas(64) double d[GRID_DERIVATIVES][4][GRID_BLOCK]; /* S Su Sv Suu Suv Svv */
	_Alignas(64) double channel[N_GRID_CHANNELS][GRID_BLOCK];
	_Alignas(64) double area2[GRID_BLOCK];
};

struct grid_kernel {
	const char *level; /* as vector_level() names it */

	/*
	 * Contract order[0] x order[1] points about strip->center; basis of v by derivative,
	 * order[1] a row; row_step in doubles between points of neighbouring u.
	 */
	void (*net)(struct grid_strip *strip, const double *points, size_t row_step, int order_v,
	            const double *basis_v);

	/*
	 * Channels `what` of n <= GRID_BLOCK lanes from `lane`, n a multiple of GRID_PAD.
	 * Returns how many have |Su x Sv|^2 <= floor; 0 where only points are asked for.
	 */
	size_t (*block)(const struct grid_strip *strip, unsigned what, size_t lane, size_t n,
	                struct grid_block *out);
};

extern const struct grid_kernel grid_kernel_baseline;
#ifdef GRID_LEVELS_X86
extern const struct grid_kernel grid_kernel_v3, grid_kernel_v4;
#endif

/* Channels that need first, and second derivatives. */
static const unsigned grid_second = (1u << N_QUANTITIES) - 1;
static const unsigned grid_first = (1u << N_QUANTITIES) - 1 + GRID_BIT(GRID_NORMAL_X) +
                                   GRID_BIT(GRID_NORMAL_Y) + GRID_BIT(GRID_NORMAL_Z);

#endif
