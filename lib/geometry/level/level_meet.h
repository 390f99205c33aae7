/* level_meet.h - where branches meet trimming curves in u,v. Private to this folder. */
#ifndef BATTEN_LEVEL_MEET_H
#define BATTEN_LEVEL_MEET_H

#include "level_part.h"
#include "trim_pieces.h"

/* A crossing (t[0] = t[1]), or an interval in which the branch is no farther from a piece than near. */
struct level_meet {
	double t[2];
};

/* How u and v are measured: lengths in space of a unit of each, about; what counts as near. */
struct level_metric {
	double scale[2], near;
};

/*
 * All places where a span meets a piece, in the span's parameter, put behind `out`. None is missed: boxes
 * that meet are halved until they part, until the two cross at an angle that allows one crossing
 * alone, or until all of the span's part is near.
 */
void level_meet_piece(const struct level_span *s, const struct trim_piece *p,
                      const struct level_metric *m, struct list *out);

/* How far u, v is from the nearest of these pieces, measured so; no more than `most`. */
double level_meet_distance(const struct trim_pieces *p, const double uv[2],
                           const struct level_metric *m, double most);

#endif
