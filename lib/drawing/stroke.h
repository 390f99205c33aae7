/* stroke.h - a curve in space as cubic Bezier pieces in the image. */
#ifndef BATTEN_STROKE_H
#define BATTEN_STROKE_H

#include <stdbool.h>
#include <stddef.h>

#include "camera.h"
#include "curve.h"

struct stroke_piece {
	double p[4][2]; /* px */
	bool begins;    /* not joined to the piece before */
};

struct stroke {
	struct stroke_piece *pieces; /* owned */
	size_t n, cap;
};

void stroke_finish(struct stroke *s); /* a zeroed one is fine */

/*
 * Append the part of the curve that lies before the eye. Spans of a cubic (or lower) polynomial seen
 * without perspective are taken over exactly; others are cut until they lie within 0.05 px.
 * join: spans that fit into one piece within 0.05 px become one. Errors: ST_RESOURCE.
 */
enum status stroke_add(struct stroke *s, const struct camera *camera, const struct curve *curve,
                       bool join);

/* Length in px, of the pieces' control polygons and chords: a fair estimate. */
double stroke_length(const struct stroke *s);

/* Point at a share 0 .. 1 of the length; n > 0. */
void stroke_point(const struct stroke *s, double share, double out[2]);

#endif
