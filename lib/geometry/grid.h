/* grid.h - values on a regular grid of parameters, in bulk.
 *
 * Basis functions are made once for each line of the grid; a row is the control net contracted
 * with the basis of its v, then with those of all u, components kept as arrays that the compiler
 * vectorises. The kernel is built for several vector levels and chosen at run time
 * (vector_level() in parallel.h).
 */
#ifndef BATTEN_GRID_H
#define BATTEN_GRID_H

#include "curvature.h"

/* Channels of a grid; the quantities come first and in their order. */
enum grid_channel {
	GRID_QUANTITY = 0, /* + enum quantity */
	GRID_POINT_X = N_QUANTITIES,
	GRID_POINT_Y,
	GRID_POINT_Z,
	GRID_NORMAL_X,
	GRID_NORMAL_Y,
	GRID_NORMAL_Z,
	N_GRID_CHANNELS,
};
#define GRID_BIT(channel) (1u << (channel))

struct grid; /* opaque: a surface and the basis functions on the lines of a grid */

/*
 * Prepare the grid u[0..nu) x v[0..nv), values rising inside the domain. The surface is borrowed
 * and must outlive the grid; u and v are copied. Errors: ST_RESOURCE.
 */
enum status grid_create(struct grid **out, const struct surface *s, const double *u, int nu,
                        const double *v, int nv);
void grid_destroy(struct grid *g);

/*
 * Rows first .. first + count - 1 (a row has one v), columns from .. from + width - 1 (u).
 * out[c] for each channel c in the mask `what` receives count x width doubles, row after row;
 * other entries are not touched. Where Su x Sv vanishes the limit, NaN where there is none.
 * Thread: any number on one grid. Errors: ST_RESOURCE.
 */
enum status grid_rows(const struct grid *g, unsigned what, int first, int count, int from,
                      int width, double *const out[N_GRID_CHANNELS]);

/* n values from a to b, ends exact; n = 1 gives a. */
void grid_lines(double a, double b, int n, double *out);

#endif
