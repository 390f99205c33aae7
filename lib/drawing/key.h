/* key.h - the key of a color map: quantity, unit, bar, ticks, range and scale in words. */
#ifndef BATTEN_KEY_H
#define BATTEN_KEY_H

#include "label.h"

struct key {
	struct colormap map;
	const char *symbol, *unit; /* "K", "1/m²"; unit may be NULL */
	double below, above;       /* shares of the area outside the range, 0 .. 1 */
	bool nothing;              /* somewhere there is no value */
	double bar;                /* height of the bar, px */
	enum theme theme;
};

double key_width(cairo_t *cr, const struct key *k);
double key_height(const struct key *k);
double key_bar_top(void); /* of the bar, below the key's */
void key_draw(cairo_t *cr, const struct key *k, double x, double y);

/* Ground of places without a value: grey, hatched; (x, y) in px. */
struct rgb key_hatch(int x, int y);

#endif
