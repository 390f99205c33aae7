/* tip.c - the whole of a text that had no room. */
#include <math.h>

#include "paint.h"

enum { WIDEST = 420, EDGE = 8, INSET = 10, LINES = 8 };

void panel_tip(cairo_t *cr, double width, double height, double x, double y, const char *text,
               const struct look *k)
{
	const struct paint p = { cr, k, NULL };
	const double room = fmin(WIDEST, width - 2 * EDGE - 2 * INSET);
	if (!text || room < WIDEST / 4.0)
		return;
	const double wide = fmin(ceil(paint_width(&p, LABEL_FORM, text)), room);
	const double tall = label_wrap_height(cr, LABEL_FORM, wide, LINES, text);
	const double w = wide + 2 * INSET, h = ceil(tall) + 12;
	/* below the mouse, or above it where that leaves the window */
	const double left = fmax(fmin(x + 12, width - EDGE - w), EDGE);
	const double top = y + 20 + h > height - EDGE ? fmax(y - 12 - h, EDGE) : y + 20;
	paint_card(&p, left, top, w, h, 6);
	label_wrap(cr, LABEL_FORM, paint_color(&p, TOKEN_TEXT), left + INSET, top + 6, wide, LINES,
	           text);
}
