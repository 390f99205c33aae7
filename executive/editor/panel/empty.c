/* empty.c - no geometry is open: a batten on its pins, and ways to begin. */
#include <math.h>

#include "paint.h"

enum { WIDTH = 360, ROW = 34, STEP = 40, RECENT_MAX = 6, PINS = 5 };

static double batten(double t)
{
	return -74 - 44 * pow(sin(t * M_PI), 1.2);
}

static void paint_batten(const struct paint *p, double x, double y)
{
	enum { POINTS = 80 };
	static const double pins[PINS] = { 0.02, 0.25, 0.5, 0.75, 0.98 };
	cairo_t *cr = p->cr;
	cairo_new_path(cr);
	for (int i = 0; i <= POINTS; i++) {
		const double t = (double)i / POINTS;
		cairo_line_to(cr, x - 150 + 300 * t, y + batten(t));
	}
	cairo_set_line_width(cr, 2);
	cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
	cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
	paint_set(p, TOKEN_EDGE, 1);
	cairo_stroke(cr);
	for (int i = 0; i < PINS; i++) {
		const double at = x - 150 + 300 * pins[i], below = y + batten(pins[i]) + 7;
		paint_dot(p, at, below, 4, TOKEN_VIEW);
		paint_circle(p, at, below, 4, 1.5, TOKEN_EDGE);
	}
}

static void paint_way(const struct paint *p, double x, double y, int index, const char *text,
                      const char *note, const char *key)
{
	const bool hot = paint_hot(p, HIT_BUTTON, index, GROUP_EMPTY), first = index == 0;
	const double middle = y + ROW / 2.0;
	double right = x + WIDTH - 10;
	paint_fill(p, x, y, WIDTH, ROW, 6, hot ? TOKEN_HOVER : TOKEN_RAISED);
	paint_border(p, x, y, WIDTH, ROW, 6, first ? 1.5 : 1,
	             first ? TOKEN_ACCENT
	             : hot ? TOKEN_EDGE
	                   : TOKEN_LINE);
	if (key)
		right -= paint_cap(p, right, middle, 1, key) + 8;
	const double note_room = note ? paint_width(p, LABEL_NOTE, note) + 10 : 0;
	double after = x + 14 +
	               label_fit(p->cr, LABEL_PROMPT, paint_color(p, TOKEN_TEXT), x + 14,
	                         label_baseline(LABEL_PROMPT, middle), 0,
	                         right - x - 14 - note_room, LABEL_CUT_MIDDLE, text);
	if (note)
		paint_text(p, LABEL_NOTE, TOKEN_MUTED, after + 10, middle, 0, note);
	if (paint_focused(p, HIT_BUTTON, index, GROUP_EMPTY))
		paint_ring(p, x - 2, y - 2, WIDTH + 4, ROW + 4, 8);
	paint_hit(p, HIT_BUTTON, index, GROUP_EMPTY, x, y, WIDTH, ROW);
}

void panel_empty(cairo_t *cr, const struct box_px *b, const struct empty_model *m,
                 const struct look *k, struct hits *h)
{
	const struct paint p = { cr, k, h };
	const int recent = m->n < RECENT_MAX ? m->n : RECENT_MAX, ways = recent + 2;
	const double x = b->x + b->width / 2, all = 118 + 28 + STEP * ways;
	double y = b->y + fmax((b->height - all) / 2 - 6, 12) + 118;
	if (b->width <= 0)
		return;
	paint_batten(&p, x, y);
	paint_text(&p, LABEL_TITLE, TOKEN_TEXT, x, y - 30, 0.5, "No geometry is open");
	paint_text(&p, LABEL_ENTRY, TOKEN_TEXT2, x, y - 2, 0.5,
	           "Drop an IGES or .base file here, or choose one of these.");
	y += 28;
	paint_way(&p, x - WIDTH / 2.0, y, 0, "Open a file", "IGES, .base, .g2", "Ctrl O");
	for (int i = 0; i < recent; i++)
		paint_way(&p, x - WIDTH / 2.0, y += STEP, i + 1, m->recent[i], NULL, NULL);
	paint_way(&p, x - WIDTH / 2.0, y + STEP, ways - 1, "Start from a patch",
	          "plane, cylinder, sphere, torus", "V7");
}
