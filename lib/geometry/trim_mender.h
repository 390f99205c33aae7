/* trim_mender.h - what the mending of loops and the cutting at seams share. Private to this
 * folder. */
#ifndef BATTEN_TRIM_MENDER_H
#define BATTEN_TRIM_MENDER_H

#include "trim.h"

struct mender {
	const struct surface *s; /* borrowed */
	double tolerance;        /* in space */
	double length[2];        /* of the domain */
	double speed[2];         /* largest |Su|, |Sv| */
	double near[2]; /* change of parameter that moves a point less than the tolerance */
	bool closed[2];
	const char *what;
	const struct report *r;
	int loop;                              /* at hand, from 1 */
	int gaps, turned, moved, cut, doubled; /* what was mended */
	double largest;                        /* gap, in space */
	double beyond;                         /* how far a loop leaves an open border, in space */
};

/* A curve's end (0: start, 1: end; clamped), read, set, and all of it moved in direction d. */
void trim_curve_end(const struct curve *c, int end, double uv[2]);
void trim_curve_set_end(struct curve *c, int end, const double uv[2]);
void trim_curve_move(struct curve *c, int d, double by);

/* Say what is wrong with the loop at hand. */
enum status trim_fail(const struct mender *m, const char *fault);

/* Curves c[0..n) in order and direction into *out, moved by periods. *whole false: there is a gap.
 * Errors: ST_RESOURCE. */
enum status trim_chain(struct mender *m, const struct curve *c, int n, bool turn_first,
                       struct trim_loop *out, bool *whole);

/* Close the gaps of a chain; winds[d]: whole periods from its start to its end.
 * Errors: ST_INPUT (its ends do not meet), ST_RESOURCE. */
enum status trim_close_gaps(struct mender *m, struct trim_loop *l, double winds[2]);

/* Append the straight line between two points. Errors: ST_RESOURCE. */
enum status trim_add_line(struct trim_loop *l, const double from[2], const double to[2]);

/*
 * A loop in order and direction that may run over the seams of direction d any number of times, as
 * if the domain went on there: cut at the seams, and closed along them. Of a direction that is not
 * closed the parts inside the domain are kept. Loops are appended to out.
 * Errors: ST_INPUT, ST_RESOURCE.
 */
enum status trim_seam_cut(struct mender *m, const struct trim_loop *loop, int d, struct trim *out);

/*
 * A chain that ends a whole period after its start in direction d, `way` 1 or -1: as one that runs
 * from border to border. Errors: ST_INPUT (it crosses the seam more than once), ST_RESOURCE.
 */
enum status trim_seam_open(struct mender *m, const struct trim_loop *loop, int d, int way,
                           struct trim_loop *out);

/* Of settled loops that lie upon each other, curve by curve within the tolerance, keep one.
 * Errors: ST_RESOURCE. */
enum status trim_drop_doubled(struct mender *m, struct trim *t);

#endif
