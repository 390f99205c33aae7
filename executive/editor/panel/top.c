/* top.c - the top bar: project, and chips of jobs. */
#include <math.h>
#include <stdio.h>

#include "paint.h"

enum { CHIPS_X = 176, CHIP_GAP = 6, CHIP_MIN = 112, CHIP_MAX = 148, CHIP_Y = 6, MORE = 34 };

static void paint_chip(const struct paint *p, const struct chip *c, int index, double x,
                       double width)
{
	const double height = PAINT_TOP - 2 * CHIP_Y, text = x + 26, low = CHIP_Y + 26;
	paint_raised(p, x, CHIP_Y, width, height, 6);
	if (paint_hot(p, HIT_CHIP, index, 0)) {
		paint_fill(p, x, CHIP_Y, width, height, 6, TOKEN_HOVER);
		paint_border(p, x, CHIP_Y, width, height, 6, 1, TOKEN_EDGE);
	}
	glyph_draw(p, c->state, x + 14, CHIP_Y + 11, 5);
	paint_cut(p, LABEL_NAME, TOKEN_TEXT, text, CHIP_Y + 11, 0, width - 34, c->name);
	if (isnan(c->fraction)) {
		paint_cut(p, LABEL_NOTE, c->state == JOB_FAILED ? TOKEN_TEXT2 : TOKEN_MUTED, text,
		          low, 0, width - 34, c->note);
	} else {
		double note = paint_cut(p, LABEL_NOTE, TOKEN_TEXT2, x + width - 8, low, 1,
		                        width - 26 - 8 - 24, c->note);
		paint_bar(p, text, low - 2, width - 26 - 8 - note - 8, c->fraction,
		          glyph_color(p, c->state));
	}
	if (paint_focused(p, HIT_CHIP, index, 0))
		paint_ring(p, x - 2, CHIP_Y - 2, width + 4, height + 4, 8);
	paint_hit(p, HIT_CHIP, index, 0, x, CHIP_Y, width, height);
}

static void paint_chips(const struct paint *p, double right, const struct top_model *m)
{
	const double room = right - CHIPS_X;
	int n = m->n_chips;
	double width = fmin(CHIP_MAX, (room - CHIP_GAP * (n - 1.0)) / n);
	if (width < CHIP_MIN) {
		n = (int)fmax(floor((room - MORE) / (CHIP_MIN + CHIP_GAP)), 0);
		width = n ? (room - MORE - CHIP_GAP * (n - 1.0)) / n : 0;
	}
	for (int i = 0; i < n; i++)
		paint_chip(p, &m->chips[i], i, CHIPS_X + i * (width + CHIP_GAP), width);
	if (n < m->n_chips) {
		char more[24];
		const double left = right - MORE + 4;
		snprintf(more, sizeof more, m->n_chips - n > 999 ? "999+" : "+%d", m->n_chips - n);
		if (paint_hot(p, HIT_CHIP, -1, 0))
			paint_fill(p, left, CHIP_Y, MORE, PAINT_TOP - 2 * CHIP_Y, 6, TOKEN_HOVER);
		paint_text(p, LABEL_NAME, TOKEN_TEXT2, left + MORE / 2.0, PAINT_TOP / 2.0, 0.5,
		           more);
		paint_hit(p, HIT_CHIP, -1, 0, left, CHIP_Y, MORE, PAINT_TOP - 2 * CHIP_Y);
	}
}

void panel_top(cairo_t *cr, const struct box_px *b, const struct top_model *m, const struct look *k,
               struct hits *h)
{
	const struct paint p = { cr, k, h };
	const double project = CHIPS_X - PAINT_PADDING - 12;
	if (b->width <= 0)
		return;
	cairo_save(cr);
	cairo_translate(cr, b->x, b->y);
	const int before = h ? h->n : 0;
	paint_fill(&p, 0, 0, b->width, b->height, 0, TOKEN_BAR);
	paint_rule(&p, 0, b->height - 1, b->width);
	paint_path(&p, LABEL_HEADING, TOKEN_TEXT, PAINT_PADDING, 17, project, m->project);
	paint_cut(&p, LABEL_NOTE, TOKEN_MUTED, PAINT_PADDING, 33, 0, project, m->detail);
	if (m->n_chips > 0)
		paint_chips(&p, b->width - 8, m);
	else
		paint_cut(&p, LABEL_FORM, TOKEN_MUTED, CHIPS_X, PAINT_TOP / 2.0, 0,
		          b->width - CHIPS_X - PAINT_PADDING,
		          "No jobs. Long computations appear here with their progress.");
	cairo_restore(cr);
	for (int i = before; h && i < h->n; i++) {
		h->hit[i].x += b->x;
		h->hit[i].y += b->y;
	}
}
