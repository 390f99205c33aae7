/* key.c - the color key of a map at the view's right edge. */
#include <math.h>

#include "key.h"
#include "paint.h"

enum { INSET = 74, REACH = 14, TOP = 14, BAR = 14 };

void panel_key(cairo_t *cr, const struct box_px *view, const struct key_model *m,
               const struct look *k, struct hits *h)
{
	const struct paint p = { cr, k, h };
	const struct key key = { .map = m->map,
		                 .symbol = m->symbol ? m->symbol : "",
		                 .unit = m->unit,
		                 .below = m->below,
		                 .above = m->above,
		                 .nothing = m->nothing,
		                 .bar = panel_key_bar(view->height),
		                 .theme = k->theme };
	const double right = view->x + view->width, y = paint_snap(&p, view->y + TOP);
	if (!(m->map.lo < m->map.hi) || !isfinite(m->map.hi - m->map.lo)) {
		const double x =
		        right - PAINT_PADDING - paint_width(&p, LABEL_NOTE, "no values yet");
		paint_plate(&p, x - 8, y, right - x, 42);
		paint_text(&p, LABEL_HEADING, TOKEN_TEXT, x, y + 10, 0, key.symbol);
		paint_text(&p, LABEL_NOTE, TOKEN_MUTED, x, y + 28, 0, "no values yet");
		if (m->button) {
			const struct button b = { .text = m->button,
				                  .kind = HIT_BUTTON,
				                  .part = GROUP_KEY };
			paint_button(&p, right - PAINT_PADDING - paint_button_width(&p, &b), y + 48,
			             &b);
		}
		return;
	}
	const double width = key_width(cr, &key), bar = y + key_bar_top();
	const double x = paint_snap(&p, right - fmax(INSET, width + 12));
	paint_plate(&p, x - 8, y - 8, right - x + 4, key_height(&key) + 16);
	key_draw(cr, &key, x, y);
	const double half = key.bar / 2;
	paint_hit(&p, HIT_KEY_HIGH, 0, 0, x - 4, bar - REACH, BAR + 8, half + REACH);
	paint_hit(&p, HIT_KEY_LOW, 0, 0, x - 4, bar + half, BAR + 8, half + REACH);
	for (int end = 0; end < 2; end++)
		if (paint_hot(&p, end ? HIT_KEY_HIGH : HIT_KEY_LOW, 0, 0) ||
		    paint_focused(&p, end ? HIT_KEY_HIGH : HIT_KEY_LOW, 0, 0))
			paint_border(&p, x - 3, (end ? bar : bar + key.bar) - 3, BAR + 6, 6, 3, 1.5,
			             TOKEN_TEXT);
}
