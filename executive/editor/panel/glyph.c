/* glyph.c - glyphs of the states of jobs, drawn, so that no font decides their form. */
#include <math.h>
#include <stdlib.h>

#include "paint.h"

enum { BOX = 6 }; /* half of the box the paths below are made for */

typedef void glyph_paint(cairo_t *cr);

static void ring(cairo_t *cr, double radius)
{
	cairo_new_sub_path(cr);
	cairo_arc(cr, 0, 0, radius, 0, 2 * M_PI);
}

static void triangle(cairo_t *cr, double left, double right, double half)
{
	cairo_move_to(cr, left, -half);
	cairo_line_to(cr, right, 0);
	cairo_line_to(cr, left, half);
	cairo_close_path(cr);
}

static void queued(cairo_t *cr)
{
	ring(cr, 4.4);
	cairo_stroke(cr);
}

static void held(cairo_t *cr)
{
	ring(cr, 4.8);
	cairo_move_to(cr, -2.2, 0);
	cairo_line_to(cr, 2.2, 0);
	cairo_stroke(cr);
}

static void starting(cairo_t *cr)
{
	ring(cr, 4.8);
	cairo_stroke(cr);
	triangle(cr, -1.3, 2.4, 2.3);
	cairo_fill(cr);
}

static void running(cairo_t *cr)
{
	triangle(cr, -3.4, 4.8, 4.6);
	cairo_fill_preserve(cr);
	cairo_stroke(cr);
}

static void suspended(cairo_t *cr)
{
	cairo_rectangle(cr, -4.2, -5, 3, 10);
	cairo_rectangle(cr, 1.2, -5, 3, 10);
	cairo_fill(cr);
}

static void ending(cairo_t *cr)
{
	triangle(cr, -4.6, 1.6, 4.2);
	cairo_rectangle(cr, 2.6, -4.8, 2, 9.6);
	cairo_fill(cr);
}

static void done(cairo_t *cr)
{
	cairo_set_line_width(cr, 2);
	cairo_move_to(cr, -4.6, 0.4);
	cairo_line_to(cr, -1.4, 3.6);
	cairo_line_to(cr, 4.8, -3.6);
	cairo_stroke(cr);
}

static void failed(cairo_t *cr)
{
	cairo_set_line_width(cr, 2);
	cairo_move_to(cr, -3.8, -3.8);
	cairo_line_to(cr, 3.8, 3.8);
	cairo_move_to(cr, 3.8, -3.8);
	cairo_line_to(cr, -3.8, 3.8);
	cairo_stroke(cr);
}

static void killed(cairo_t *cr)
{
	cairo_rectangle(cr, -4, -4, 8, 8);
	cairo_fill(cr);
}

static void lost(cairo_t *cr)
{
	const double dash[] = { 1.6, 3 };
	cairo_set_dash(cr, dash, 2, 0);
	ring(cr, 4.8);
	cairo_stroke(cr);
	ring(cr, 1.3);
	cairo_fill(cr);
}

static glyph_paint *const glyphs[N_JOB_STATES] = {
	[JOB_QUEUED] = queued,   [JOB_HELD] = held,           [JOB_STARTING] = starting,
	[JOB_RUNNING] = running, [JOB_SUSPENDED] = suspended, [JOB_ENDING] = ending,
	[JOB_DONE] = done,       [JOB_FAILED] = failed,       [JOB_KILLED] = killed,
	[JOB_LOST] = lost,
};

static bool is_state(enum job_state state)
{
	return (unsigned)state < N_JOB_STATES;
}

struct rgb glyph_color(const struct paint *p, enum job_state state)
{
	if (!is_state(state))
		return paint_color(p, TOKEN_MUTED);
	const struct job_state_row *row = &job_state_table[state];
	unsigned long c = strtoul((paint_is_dark(p) ? row->dark : row->light) + 1, NULL, 16);
	return (struct rgb){ (double)(c >> 16 & 255) / 255, (double)(c >> 8 & 255) / 255,
		             (double)(c & 255) / 255 };
}

static void begin(const struct paint *p, double x, double y, double radius)
{
	cairo_save(p->cr);
	cairo_translate(p->cr, x, y);
	cairo_scale(p->cr, radius / BOX, radius / BOX);
	cairo_set_line_width(p->cr, 1.7);
	cairo_set_line_cap(p->cr, CAIRO_LINE_CAP_ROUND);
	cairo_set_line_join(p->cr, CAIRO_LINE_JOIN_ROUND);
	cairo_new_path(p->cr);
}

void glyph_draw(const struct paint *p, enum job_state state, double x, double y, double radius)
{
	if (!is_state(state))
		return;
	begin(p, x, y, radius);
	paint_set_rgb(p, glyph_color(p, state));
	glyphs[state](p->cr);
	cairo_restore(p->cr);
}

/* A triangle with its mark, in the color of what stands still. */
void glyph_warning(const struct paint *p, double x, double y, double radius)
{
	cairo_t *cr = p->cr;
	begin(p, x, y, radius);
	paint_set_rgb(p, glyph_color(p, JOB_SUSPENDED));
	cairo_move_to(cr, 0, -4.8);
	cairo_line_to(cr, 5.2, 4.4);
	cairo_line_to(cr, -5.2, 4.4);
	cairo_close_path(cr);
	cairo_set_line_width(cr, 1.4);
	cairo_stroke(cr);
	cairo_move_to(cr, 0, -1.6);
	cairo_line_to(cr, 0, 1.2);
	cairo_move_to(cr, 0, 2.8);
	cairo_line_to(cr, 0, 2.9);
	cairo_stroke(cr);
	cairo_restore(cr);
}
