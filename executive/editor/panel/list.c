/* list.c - plain lists: messages, and questions before work would be lost. */
#include <math.h>

#include "paint.h"

enum { WIDTH = 640, LINE = 24, HEAD = 56, FOOT = 60, EDGE = 24 };

void paint_dim(const struct paint *p, double x, double y, double width, double height)
{
	cairo_set_source_rgba(p->cr, 0, 0, 0, paint_is_dark(p) ? 0.5 : 0.14);
	cairo_rectangle(p->cr, x, y, width, height);
	cairo_fill(p->cr);
	paint_hit(p, HIT_NONE, 0, 0, x, y, width, height);
}

int panel_list_rows(const struct box_px *b, const struct list_model *m)
{
	const double foot = m->n_buttons ? FOOT : 12;
	const double rows = floor((b->height - 2 * EDGE - HEAD - foot) / LINE);
	return rows < 1 ? 1 : (int)fmin(rows, m->n);
}

static double paint_buttons(const struct paint *p, const struct list_model *m, double right,
                            double y)
{
	/* the last is the safe one and stands at the right, as what Escape does */
	for (int i = m->n_buttons - 1; i >= 0; i--) {
		const bool safe = i == m->n_buttons - 1;
		const struct button b = { .text = m->buttons[i],
			                  .key = safe ? "Esc" : NULL,
			                  .main = safe,
			                  .on_card = true,
			                  .kind = HIT_BUTTON,
			                  .index = i,
			                  .part = GROUP_LIST };
		right -= paint_button_width(p, &b);
		paint_button(p, right, y, &b);
		right -= 8;
	}
	return right;
}

void panel_list(cairo_t *cr, const struct box_px *b, const struct list_model *m,
                const struct look *k, struct hits *h)
{
	const struct paint p = { cr, k, h };
	const int shown = panel_list_rows(b, m), last = m->n > shown ? m->n - shown : 0;
	const int first = m->scroll < 0 ? 0 : m->scroll > last ? last : m->scroll;
	const double foot = m->n_buttons ? FOOT : 12, width = fmin(WIDTH, b->width - 2 * EDGE);
	const double height = HEAD + LINE * fmax(shown, 1) + foot;
	const double x = b->x + (b->width - width) / 2,
	             y = b->y + fmax((b->height - height) / 2, 0);
	if (width < 160)
		return;
	if (m->n_buttons)
		paint_dim(&p, b->x, b->y, b->width, b->height);
	paint_card(&p, x, y, width, height, 10);
	paint_hit(&p, HIT_NONE, 0, 0, x, y, width, height);
	double right = x + width - EDGE;
	if (!m->n_buttons)
		right -= paint_cap(&p, right, y + 30, 1, "Esc") + 12;
	paint_cut(&p, LABEL_TITLE, TOKEN_TEXT, x + EDGE, y + 30, 0, right - x - EDGE, m->title);
	for (int i = 0; i < shown && first + i < m->n; i++)
		paint_cut(&p, LABEL_FORM, TOKEN_TEXT2, x + EDGE, y + HEAD + LINE * (i + 0.5), 0,
		          width - 2 * EDGE, m->lines[first + i]);
	if (!m->n)
		paint_text(&p, LABEL_FORM, TOKEN_MUTED, x + EDGE, y + HEAD + LINE / 2.0, 0,
		           "There is nothing here yet.");
	paint_scroll(&p, x + width - 8, y + HEAD, LINE * shown, first, shown, m->n, GROUP_LIST);
	paint_buttons(&p, m, x + width - EDGE, y + height - 16 - PAINT_BUTTON);
}
