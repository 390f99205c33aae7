/* trim.h - the part of a surface that its trimming loops leave.
 *
 * A loop is a closed chain of curves in the surface's u,v plane, each starting where the one before
 * ends. A point belongs to the trimmed surface if it is inside an outer loop (or there is none: the
 * whole domain) and outside every inner one. trim_test and trim_area have it so also where loops cross
 * or lie upon each other; tessellate() fills what all loops go around an odd number of times.
 */
#ifndef BATTEN_TRIM_H
#define BATTEN_TRIM_H

#include "curve.h"
#include "surface.h"

struct trim_loop {
	struct curve *curves; /* owned; x and y are u and v, z = 0 */
	int n;
	bool outer;
};

struct trim {
	struct trim_loop *loops; /* owned */
	int n;
};

void trim_finish(struct trim *t); /* a zeroed one is fine */
void trim_loop_finish(struct trim_loop *loop);
enum status trim_copy(struct trim *out, const struct trim *t);

/* Append a loop to a trim, a curve to a loop (moved in: empty afterwards, also on failure). A zeroed
 * loop may begin. Errors: ST_RESOURCE. */
enum status trim_add(struct trim *t, struct trim_loop *loop);
enum status trim_loop_add(struct trim_loop *loop, struct curve *c);

/*
 * Check and mend: curves put in order and direction (outer loops counter-clockwise, inner ones
 * clockwise), gaps up to `tolerance` (in space, file units) closed, what runs along the domain's
 * border but for less than the tolerance laid on it, loops over the seam of a closed surface, or a
 * little (a hundredth of the domain) out of an open one, cut there. Of loops that are the same curve
 * by curve one is kept. A loop that winds around a closed surface leaves what is on its left; two of
 * them leave what lies between. What was mended is said as a note; what cannot be is an error and leaves
 * *t as it was. That a loop does not cross itself is not checked; if it does, what it goes around
 * an odd number of times is inside. `what` names the face.
 * Errors: ST_INPUT (a loop not closed, leaving the domain), ST_RESOURCE.
 */
enum status trim_mend(struct trim *t, const struct surface *s, double tolerance, const char *what,
                      const struct report *r);

/* Fast tests of points: a trim prepared for one surface; read-only, any thread. */
struct trim_test;
enum status trim_test_create(struct trim_test **out, const struct trim *t, const struct surface *s);
void trim_test_destroy(struct trim_test *x); /* NULL is fine */

/* Is (u, v) left? Exact but for points nearer to a loop than 1e-12 of the domain. Where a loop runs
 * along the domain's border, points of the border are as those inside beside them. */
bool trim_test_inside(const struct trim_test *x, double u, double v);

/* For boxes of parameters: 1 wholly inside, -1 wholly outside, 0 a loop runs through. */
int trim_test_box(const struct trim_test *x, const double lo[2], const double hi[2]);

/* A range of parameters that holds all that is left; false: nothing is. */
bool trim_test_range(const struct trim_test *x, double range[2][2]);

/* Area of what is left, to a relative accuracy; *error is an estimate. Errors: ST_RESOURCE. */
enum status trim_area(const struct trim *t, const struct surface *s, double accuracy, double *area,
                      double *error);

#endif
