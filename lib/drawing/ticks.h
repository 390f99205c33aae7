/* ticks.h - where to mark a scale, at round numbers, and how to write them. */
#ifndef BATTEN_TICKS_H
#define BATTEN_TICKS_H

#include "colormap.h"

enum { TICKS_MAX = 32, TICK_TEXT = 48 };

struct ticks {
	int n;
	double value[TICKS_MAX]; /* rising */
	char text[TICKS_MAX][TICK_TEXT];
};

/* Multiples of 1, 2 or 5 times a power of ten in [lo, hi], as many as fit with at least `gap` (a
 * share of hi - lo) between them. lo < hi. */
void ticks_linear(struct ticks *t, double lo, double hi, double gap);

/* Likewise along the key of a map; on an arsinh scale 0 and 1, 2, 5 times powers of ten. */
void ticks_colormap(struct ticks *t, const struct colormap *m, double gap);

/* Write x with that many significant digits, true minus, powers of ten as such where long. */
void number_for_reader(char out[TICK_TEXT], double x, int digits);

#endif
