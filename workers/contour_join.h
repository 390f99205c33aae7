/* contour_join.h - pieces of one contour on several surfaces, put together where their ends meet. */
#ifndef BATTEN_CONTOUR_JOIN_H
#define BATTEN_CONTOUR_JOIN_H

#include "section.h"

/* A curve of several pieces, one behind the other. */
struct contour {
	size_t first, n; /* among the sides */
	bool closed;
};

struct contours {
	struct section_side *sides; /* owned, all pieces in order; curves borrowed */
	size_t *pieces;             /* owned: which piece each side is */
	struct contour *list;       /* owned */
	size_t n, n_closed;
};

/*
 * Join n pieces: ends that are nearest to each other and at most `gap` apart. closed[i]: piece i
 * has no ends. A piece shorter than four gaps does not close with itself.
 * The result depends on nothing but the pieces and their order. Errors: ST_RESOURCE.
 */
enum status contours_join(struct contours *out, const struct curve *const *pieces,
                          const bool *closed, size_t n, double gap);
void contours_finish(struct contours *c); /* a zeroed one is fine */

#endif
