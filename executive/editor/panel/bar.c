/* bar.c - what stays wrong until it is solved: a bar under the top bar, with one button. */
#include <math.h>

#include "paint.h"

enum { LINES = 4, TEXT = PAINT_PADDING + 22 };

static struct button button_of(const struct bar_model *m)
{
	return (struct button){ .text = m->button, .kind = HIT_BAR, .on_card = true };
}

/* The room of the sentence; a long one has lines. */
static double text_width(const struct paint *p, const struct box_px *b, const struct bar_model *m)
{
	const struct button button = button_of(m);
	const double room = b->width - TEXT - PAINT_PADDING;
	return m->button ? room - paint_button_width(p, &button) - 16 : room;
}

double panel_bar_height(cairo_t *cr, const struct box_px *b, const struct bar_model *m)
{
	const struct look look = { .scale = 1 };
	const struct paint p = { cr, &look, NULL };
	const double tall = label_wrap_height(cr, LABEL_FORM, text_width(&p, b, m), LINES, m->text);
	return ceil(fmax(tall + 20, 40));
}

void panel_bar(cairo_t *cr, const struct box_px *b, const struct bar_model *m, const struct look *k,
               struct hits *h)
{
	const struct paint p = { cr, k, h };
	const struct button button = button_of(m);
	const double x = b->x + PAINT_PADDING, width = text_width(&p, b, m);
	if (width < PAINT_PADDING)
		return;
	const double height = panel_bar_height(cr, b, m), middle = b->y + height / 2;
	paint_fill(&p, b->x, b->y, b->width, height, 0, TOKEN_RAISED);
	paint_rule(&p, b->x, b->y + height - 1, b->width);
	paint_hit(&p, HIT_NONE, 0, 0, b->x, b->y, b->width, height);
	paint_round(&p, b->x, b->y, 3, height - 1, 0);
	paint_set_rgb(&p, glyph_color(&p, m->level == REPORT_ERROR     ? JOB_FAILED
	                                  : m->level == REPORT_WARNING ? JOB_SUSPENDED
	                                                               : JOB_RUNNING));
	cairo_fill(cr);
	if (m->level == REPORT_ERROR)
		glyph_draw(&p, JOB_FAILED, x + 6, middle, 5);
	else if (m->level == REPORT_WARNING)
		glyph_warning(&p, x + 6, middle, 6);
	else
		paint_dot(&p, x + 6, middle, 3, TOKEN_ACCENT);
	const double tall = label_wrap_height(cr, LABEL_FORM, width, LINES, m->text);
	label_wrap(cr, LABEL_FORM, paint_color(&p, TOKEN_TEXT), b->x + TEXT, middle - tall / 2,
	           width, LINES, m->text);
	if (m->button)
		paint_button(&p, b->x + TEXT + width + 16, middle - PAINT_BUTTON / 2.0, &button);
}
