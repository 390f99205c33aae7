/* canvas.h - a surface to paint screens on, and to look at its pixels. */
#ifndef BATTEN_CANVAS_H
#define BATTEN_CANVAS_H

#include <stdbool.h>

#include "panel.h"

struct canvas {
	cairo_surface_t *surface; /* owned, as all */
	cairo_t *cr;
	int width, height; /* device px */
	struct hits hits;
	struct look look;
};

/* width and height in logical px, with `margin` px of nothing on each side. */
void canvas_init(struct canvas *c, double width, double height, double scale, enum theme theme,
                 double margin);
void canvas_finish(struct canvas *c);
void canvas_clear(struct canvas *c); /* to nothing; hits, too */

unsigned canvas_pixel(const struct canvas *c, int x, int y); /* ARGB, premultiplied */

/* The smallest box in device px, without the margin, of all that differs between two canvases of one
 * size (b NULL: of all that is painted); false: nothing. */
bool canvas_extent(const struct canvas *a, const struct canvas *b, struct box_px *out);

/* What the test framework does not see as lost, for the leak sanitizer. */
void canvas_forget_fonts(void);

#endif
