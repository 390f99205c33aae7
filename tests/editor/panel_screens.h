/* panel_screens.h - whole screens of the window out of its painters, without the view. */
#ifndef BATTEN_PANEL_SCREENS_H
#define BATTEN_PANEL_SCREENS_H

#include "panel.h"

typedef void screen_paint(cairo_t *cr, const struct layout *l, const struct look *k,
                          struct hits *h);
struct screen {
	const char *name;
	int menu_rows;
	screen_paint *paint;
};
extern const struct screen screens[];
extern const int n_screens;

/* The parts that every screen has, then its own. width and height in logical px, of a
 * context scaled already. */
void screen_draw(cairo_t *cr, const struct screen *s, double width, double height,
                 const struct look *k, struct hits *h);

/* Pieces small enough to keep pictures of. */
struct piece {
	const char *name;
	int width, height;
	enum theme theme;
	void (*paint)(cairo_t *cr, const struct look *k);
};
extern const struct piece pieces[];
extern const int n_pieces;

#endif
