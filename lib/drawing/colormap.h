/* colormap.h - values to colors: the signed (diverging) and the unsigned (sequential) map. */
#ifndef BATTEN_COLORMAP_H
#define BATTEN_COLORMAP_H

#include <stdbool.h>
#include <stddef.h>

struct rgb {
	double r, g, b; /* sRGB, 0 .. 1 */
};

struct colormap {
	bool is_signed;
	double lo, hi; /* values at the ends; a signed map has lo = -hi unless set by hand */
	bool arsinh;   /* scale compressed as arsinh around 0 */
	double knee;   /* of the arsinh scale: where it leaves the line */
};

/*
 * Range from the values: 2 to 98 % of the finite ones, weights (may be NULL) their areas; symmetric
 * if signed. arsinh is chosen where the 2-98 % range hides more than nine tenths of the values in
 * less than a tenth of the colors. Errors: ST_RESOURCE through a NULL range (lo = hi = 0).
 */
void colormap_fit(struct colormap *m, bool is_signed, const float *values, const float *weights,
                  size_t n);

/* Color of a value; its own colors below lo and above hi; grey for NaN. */
struct rgb colormap_color(const struct colormap *m, double value);

/* Where a value lies between the ends, 0 .. 1 not clamped; and back. */
double colormap_position(const struct colormap *m, double value);
double colormap_value(const struct colormap *m, double position);

#endif
