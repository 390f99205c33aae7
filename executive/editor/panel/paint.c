/* paint.c - boxes, rules and small signs. */
#include "paint.h"

#include <math.h>

struct rgb paint_color(const struct paint *p, enum token token)
{
	return theme_color(p->look->theme, token);
}

void paint_set(const struct paint *p, enum token token, double alpha)
{
	struct rgb c = paint_color(p, token);
	cairo_set_source_rgba(p->cr, c.r, c.g, c.b, alpha);
}

void paint_set_rgb(const struct paint *p, struct rgb c)
{
	cairo_set_source_rgb(p->cr, c.r, c.g, c.b);
}

bool paint_is_dark(const struct paint *p)
{
	return p->look->theme == THEME_DARK;
}

static double scale(const struct paint *p)
{
	return p->look->scale > 0 ? p->look->scale : 1;
}

double paint_px(const struct paint *p, double length)
{
	return fmax(round(length * scale(p)), 1) / scale(p);
}

double paint_snap(const struct paint *p, double place)
{
	return round(place * scale(p)) / scale(p);
}

static void snap_box(const struct paint *p, double *x, double *y, double *width, double *height)
{
	double right = paint_snap(p, *x + *width), below = paint_snap(p, *y + *height);
	*x = paint_snap(p, *x);
	*y = paint_snap(p, *y);
	*width = fmax(right - *x, 0);
	*height = fmax(below - *y, 0);
}

static void round_path(cairo_t *cr, double x, double y, double width, double height, double radius)
{
	cairo_new_path(cr);
	radius = fmin(radius, fmin(width, height) / 2);
	if (radius <= 0) {
		cairo_rectangle(cr, x, y, width, height);
		return;
	}
	cairo_arc(cr, x + width - radius, y + radius, radius, -M_PI_2, 0);
	cairo_arc(cr, x + width - radius, y + height - radius, radius, 0, M_PI_2);
	cairo_arc(cr, x + radius, y + height - radius, radius, M_PI_2, M_PI);
	cairo_arc(cr, x + radius, y + radius, radius, M_PI, 3 * M_PI_2);
	cairo_close_path(cr);
}

void paint_round(const struct paint *p, double x, double y, double width, double height,
                 double radius)
{
	snap_box(p, &x, &y, &width, &height);
	round_path(p->cr, x, y, width, height, radius);
}

void paint_fill(const struct paint *p, double x, double y, double width, double height,
                double radius, enum token token)
{
	paint_round(p, x, y, width, height, radius);
	paint_set(p, token, 1);
	cairo_fill(p->cr);
}

void paint_border(const struct paint *p, double x, double y, double width, double height,
                  double radius, double line, enum token token)
{
	line = paint_px(p, line);
	snap_box(p, &x, &y, &width, &height);
	round_path(p->cr, x + line / 2, y + line / 2, fmax(width - line, 0), fmax(height - line, 0),
	           fmax(radius - line / 2, 0));
	paint_set(p, token, 1);
	cairo_set_line_width(p->cr, line);
	cairo_stroke(p->cr);
}

void paint_raised(const struct paint *p, double x, double y, double width, double height,
                  double radius)
{
	paint_fill(p, x, y, width, height, radius, TOKEN_RAISED);
	if (!paint_is_dark(p))
		paint_border(p, x, y, width, height, radius, 1, TOKEN_LINE);
}

/* The shadow is three rounded boxes about the card, 4 px lower; its middle, that the card hides, is
 * left out, for most of the time would go there. */
void paint_card(const struct paint *p, double x, double y, double width, double height,
                double radius)
{
	static const struct {
		double wider, alpha;
	} shadow[] = { { 10, 0.10 }, { 6, 0.14 }, { 3, 0.20 } };
	const double strength = paint_is_dark(p) ? 0.45 : 0.16;
	cairo_t *cr = p->cr;
	cairo_save(cr);
	cairo_set_fill_rule(cr, CAIRO_FILL_RULE_EVEN_ODD);
	for (int i = 0; i < 3; i++) {
		double w = shadow[i].wider;
		round_path(cr, x - w / 2, y - w / 2 + 4, width + w, height + w, radius + w / 2);
		if (width > 4 * radius && height > 4 * radius)
			cairo_rectangle(cr, x + radius, y + radius, width - 2 * radius,
			                height - 2 * radius);
		cairo_set_source_rgba(cr, 0, 0, 0, shadow[i].alpha * strength);
		cairo_fill(cr);
	}
	cairo_restore(cr);
	paint_fill(p, x, y, width, height, radius, TOKEN_RAISED);
	paint_border(p, x, y, width, height, radius, 1, TOKEN_LINE);
}

void paint_rule(const struct paint *p, double x, double y, double width)
{
	paint_set(p, TOKEN_LINE, 1);
	cairo_rectangle(p->cr, x, paint_snap(p, y), width, paint_px(p, 1));
	cairo_fill(p->cr);
}

void paint_rule_down(const struct paint *p, double x, double y, double height)
{
	paint_set(p, TOKEN_LINE, 1);
	cairo_rectangle(p->cr, paint_snap(p, x), y, paint_px(p, 1), height);
	cairo_fill(p->cr);
}

void paint_dot(const struct paint *p, double x, double y, double radius, enum token token)
{
	cairo_new_path(p->cr);
	cairo_arc(p->cr, x, y, radius, 0, 2 * M_PI);
	paint_set(p, token, 1);
	cairo_fill(p->cr);
}

void paint_circle(const struct paint *p, double x, double y, double radius, double line,
                  enum token token)
{
	cairo_new_path(p->cr);
	cairo_arc(p->cr, x, y, radius, 0, 2 * M_PI);
	paint_set(p, token, 1);
	cairo_set_line_width(p->cr, line);
	cairo_stroke(p->cr);
}

static void stroke(const struct paint *p, double line, enum token token)
{
	cairo_set_line_width(p->cr, line);
	cairo_set_line_cap(p->cr, CAIRO_LINE_CAP_ROUND);
	cairo_set_line_join(p->cr, CAIRO_LINE_JOIN_ROUND);
	paint_set(p, token, 1);
	cairo_stroke(p->cr);
}

void paint_line(const struct paint *p, double x0, double y0, double x1, double y1, double line,
                enum token token)
{
	cairo_move_to(p->cr, x0, y0);
	cairo_line_to(p->cr, x1, y1);
	stroke(p, line, token);
}

/* Its tip at x - 1. */
void paint_chevron(const struct paint *p, double x, double y, enum token token)
{
	cairo_move_to(p->cr, x - 5, y - 4);
	cairo_line_to(p->cr, x - 1, y);
	cairo_line_to(p->cr, x - 5, y + 4);
	stroke(p, 1.5, token);
}

/* Centred; `size` wide. */
void paint_check(const struct paint *p, double x, double y, double size, enum token token)
{
	const double s = size / 9;
	cairo_move_to(p->cr, x - 4.5 * s, y + 0.2 * s);
	cairo_line_to(p->cr, x - 1.5 * s, y + 3.2 * s);
	cairo_line_to(p->cr, x + 4.5 * s, y - 3.4 * s);
	stroke(p, 1.8, token);
}

/* The middle of its glass at (x, y). */
void paint_lens(const struct paint *p, double x, double y, double size)
{
	const double line = size > 5 ? 1.6 : 1.4;
	paint_circle(p, x, y, size, line, TOKEN_MUTED);
	paint_line(p, x + 0.75 * size, y + 0.75 * size, x + 1.5 * size, y + 1.5 * size, line,
	           TOKEN_MUTED);
}

void paint_bar(const struct paint *p, double x, double y, double width, double fraction,
               struct rgb color)
{
	const double height = 4;
	if (width < height)
		return;
	paint_fill(p, x, y, width, height, height / 2, TOKEN_LINE);
	if (!(fraction > 0))
		return;
	paint_round(p, x, y, fmax(height, width * fmin(fraction, 1)), height, height / 2);
	paint_set_rgb(p, color);
	cairo_fill(p->cr);
}

void paint_scroll(const struct paint *p, double x, double y, double height, int first, int shown,
                  int all, int part)
{
	const double width = 4;
	if (shown >= all || height < 24)
		return;
	const double thumb = fmax(height * shown / all, 20);
	const double at = y + (height - thumb) * first / (all - shown);
	paint_fill(p, x - width, at, width, thumb, width / 2,
	           paint_hot(p, HIT_SCROLL, 0, part) ? TOKEN_MUTED : TOKEN_EDGE);
	paint_hit(p, HIT_SCROLL, 0, part, x - 12, y, 12, height);
}
