/* trim_pieces.h - trimming loops as pieces that run one way in u and one way in v. Private to
 * geometry. */
#ifndef BATTEN_TRIM_PIECES_H
#define BATTEN_TRIM_PIECES_H

#include "trim.h"

/*
 * A Bezier piece, v rising. Pieces that follow each other in a loop have the same end point to the
 * bit, so that a line v = const. that meets [v[0], v[1]) of each piece meets a loop an even number
 * of times.
 */
struct trim_piece {
	double u[2], v[2]; /* at its start and end; v[0] <= v[1] */
	double lo_u, hi_u;
	int loop;
	int order;            /* 2: straight */
	const double *points; /* in trim_pieces.points: order x 3: w u, w v, w; NULL if straight */
};

struct trim_pieces {
	struct trim_piece *pieces; /* owned; those of a loop stand together */
	int n;
	double **points; /* owned, and each of them */
	int n_points;
};

/*
 * Loops that do not quite close, or are not quite in order, are closed by straight pieces. What
 * runs along the domain's border is moved out of the domain: points on the border then count as
 * the points inside beside them. Errors: ST_RESOURCE.
 */
enum status trim_pieces_init(struct trim_pieces *out, const struct trim *t,
                             const double (*domain)[2]);
void trim_pieces_finish(struct trim_pieces *p); /* a zeroed one is fine */

/* u, v and their derivatives at t in [0, 1]. */
void trim_piece_point(const struct trim_piece *p, double t, double uv[2], double d[2]);

/* t where coordinate c (0: u, 1: v) has that value; 0 or 1 where it lies beyond an end. */
double trim_piece_find(const struct trim_piece *p, int c, double value);

/* Parameters, rising, where coordinate d of a curve crosses base + k step for any whole k; *at is
 * fresh. Errors: ST_RESOURCE. */
enum status trim_curve_crossings(const struct curve *c, int d, double base, double step,
                                 double **at, int *n);

struct trim_test {
	struct trim_pieces pieces; /* owned */
	double domain[2][2];
	bool *outer; /* owned; of each loop */
	bool any_outer;
	int bands;  /* of equal height in v over the domain */
	int *first; /* owned, bands + 1: into list */
	int *list;  /* owned; pieces that a band holds, by loop */
};

/* As trim_test_inside; a point on a piece counts as just to the right of it (larger u). The place
 * may be outside the domain. */
bool trim_test_state(const struct trim_test *x, double u, double v);

/* What crossing a piece changes: 1 where the left side of its point at (u, v) is inside and the
 * right is not, -1 the other way, else 0. */
int trim_test_step(const struct trim_test *x, int piece, double u, double v);

/* Parameters of a piece between t[0] and t[1] where `others` (all that may meet that part of it)
 * cross or touch it, unsorted; between two that follow each other trim_test_step() does not change,
 * but where curves meet twice within a small part of both. *at is fresh. Errors: ST_RESOURCE. */
enum status trim_test_crossings(const struct trim_test *x, int piece, const double t[2],
                                const int *others, int n_others, double **at, int *n);

#endif
