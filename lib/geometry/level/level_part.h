/* level_part.h - parts of branches. Private to this folder. */
#ifndef BATTEN_LEVEL_PART_H
#define BATTEN_LEVEL_PART_H

#include "level_private.h"

/* One cubic of a branch in u,v and in space, Bezier points, over t[0] to t[1]. */
struct level_span {
	double t[2];
	double uv[4][2], space[4][3];
	bool cut; /* u or v jumps before it */
};

/* All spans of a branch, in order; *out is fresh. Errors: ST_RESOURCE. */
enum status level_spans(const struct level_branch *b, struct level_span **out, size_t *n);

void level_span_uv(const struct level_span *s, double t, double uv[2], double duv[2]);

/* Curves, length and seams of a branch from its spans; what else it has stays. Errors: ST_RESOURCE. */
enum status level_branch_of(struct level_branch *out, const struct level_span *s, size_t n);

/*
 * The part of a branch between two of its parameters; with to > the end of a closed one it goes on
 * over its start. The cubic in space is cut where it is nearest to the point that the one in u,v has
 * there, so that parts that follow each other meet. Marks: those of ends that stay.
 * Errors: ST_RESOURCE.
 */
enum status level_branch_part(struct level_branch *out, const struct level_branch *b,
                              const struct surface *s, double from, double to);

/* Put `branches` (a list of struct level_branch, moved in) in place of those of the result, and sum
 * up anew. */
void level_result_replace(struct level_result *x, struct list *branches);

#endif
