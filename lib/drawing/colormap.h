/* colormap.h - values to colors: the signed (diverging) and the unsigned (sequential) map. */
#ifndef BATTEN_COLORMAP_H
#define BATTEN_COLORMAP_H

#include <stdbool.h>
#include <stddef.h>

#include "status.h"

struct rgb {
	double r, g, b; /* sRGB, 0 .. 1 */
};

enum colormap_scale { COLORMAP_LINEAR, COLORMAP_ARSINH, COLORMAP_AUTOMATIC };

struct colormap {
	bool is_signed;
	double lo, hi; /* values at the ends; a signed map has lo = -hi unless set by hand */
	bool by_hand;  /* lo and hi were given, not found from the values */
	bool one;      /* all values are the same; lo and hi stand about it */
	bool arsinh;   /* scale compressed as arsinh around 0 */
	double knee;   /* of the arsinh scale: where it leaves the line */
};

/*
 * Range from the values: 2 to 98 % of the finite ones, weights (may be NULL) their areas; symmetric
 * if signed, from 0 where an unsigned one begins within 5 % of it. A value that is the same everywhere lies well inside its range. Values below `rounding`
 * (same unit; 0: unknown) are zero but for rounding, and the range does not fall below it.
 * The automatic scale is arsinh where the 2-98 % range hides two thirds of the values in a tenth of
 * the colors. Errors: ST_RESOURCE, and *m is the map from 0 to 1.
 */
enum status colormap_fit(struct colormap *m, bool is_signed, enum colormap_scale scale,
                         double rounding, const float *values, const float *weights, size_t n);

/* Range set by hand, lo < hi; the knee of an arsinh scale is kept in proportion. */
void colormap_set_range(struct colormap *m, double lo, double hi);

/* Color of a value; its own colors below lo and above hi; grey for NaN. */
struct rgb colormap_color(const struct colormap *m, double value);

/* Color at a place between the ends, 0 .. 1. A signed map is neutral at zero where its range has a
 * zero, whatever the ends are. */
struct rgb colormap_at(const struct colormap *m, double position);

struct rgb colormap_below(const struct colormap *m);
struct rgb colormap_above(const struct colormap *m);
extern const struct rgb colormap_nothing; /* no value there */

/* Where a value lies between the ends, 0 .. 1 not clamped; and back. */
double colormap_position(const struct colormap *m, double value);
double colormap_value(const struct colormap *m, double position);

/* sRGB and linear light, 0 .. 1 (beyond: by the same formulas). */
double rgb_to_linear(double s);
double rgb_from_linear(double l);

#endif
