/* uv.c - the plane of a surface's parameters: its domain, knots, and what lies on it. */
#include <math.h>

#include "paint.h"
#include "ticks.h"

enum { HEAD = 64, LEFT = 56, RIGHT = 24, FOOT = 40, POINT = 6 };

struct box_px panel_uv_square(const struct box_px *pane)
{
	const double width = pane->width - LEFT - RIGHT, height = pane->height - HEAD - FOOT;
	const double side = fmax(fmin(width, height), 40);

	return (struct box_px){ round(pane->x + LEFT + fmax(width - side, 0) / 2),
		                round(pane->y + HEAD + fmax(height - side, 0) / 2), round(side),
		                round(side) };
}

/* Where a place is. */
struct plane {
	const struct uv_model *m;
	struct box_px b;
};

static double at_u(const struct plane *x, double u)
{
	const double *r = x->m->range[0];
	return x->b.x + x->b.width * (u - r[0]) / (r[1] - r[0]);
}

static double at_v(const struct plane *x, double v)
{
	const double *r = x->m->range[1];
	return x->b.y + x->b.height * (r[1] - v) / (r[1] - r[0]);
}

static void paint_ground(const struct paint *p, const struct plane *x)
{
	const struct uv_model *m = x->m;
	const double left = at_u(x, m->domain[0][0]), right = at_u(x, m->domain[0][1]);
	const double top = at_v(x, m->domain[1][1]), low = at_v(x, m->domain[1][0]);

	paint_fill(p, left, top, right - left, low - top, 0, TOKEN_BAR);
	for (int d = 0; d < 2; d++)
		for (int i = 0; i < m->n_knots[d]; i++) {
			const double t = m->knots[d][i];
			if (!(t > m->domain[d][0] && t < m->domain[d][1]))
				continue;
			if (d == 0)
				paint_line(p, at_u(x, t), top, at_u(x, t), low, 1, TOKEN_LINE);
			else
				paint_line(p, left, at_v(x, t), right, at_v(x, t), 1, TOKEN_LINE);
		}
	paint_border(p, left, top, right - left, low - top, 0, 1, TOKEN_EDGE);
}

static void paint_lines(const struct paint *p, const struct plane *x)
{
	for (int k = 0; k < x->m->n_lines; k++) {
		const struct uv_line *l = &x->m->lines[k];
		cairo_new_path(p->cr);
		for (int i = 0; i < l->n; i++)
			cairo_line_to(p->cr, at_u(x, l->uv[2 * i]), at_v(x, l->uv[2 * i + 1]));
		if (l->kind == UV_LINE_NET) {
			const double dash[] = { 3, 3 };
			cairo_set_dash(p->cr, dash, 2, 0);
			paint_set(p, TOKEN_NET, 0.55);
			cairo_set_line_width(p->cr, 1);
		} else {
			paint_set(p, l->kind == UV_LINE_CURRENT ? TOKEN_CURRENT : TOKEN_TEXT2,
			          l->kind == UV_LINE_TRIM ? 0.6 : 1);
			cairo_set_line_width(p->cr, l->kind == UV_LINE_CURRENT ? 2 : 1.5);
		}
		cairo_stroke(p->cr);
		cairo_set_dash(p->cr, NULL, 0, 0);
	}
}

static void paint_points(const struct paint *p, const struct plane *x)
{
	for (int i = 0; i < x->m->n_points; i++) {
		const double px = at_u(x, x->m->points[2 * i]),
		             py = at_v(x, x->m->points[2 * i + 1]);
		const bool hot = i == x->m->hover;
		const double size = hot ? POINT + 4 : POINT;
		paint_fill(p, px - size / 2, py - size / 2, size, size, 0,
		           hot ? TOKEN_CURRENT : TOKEN_VIEW);
		paint_border(p, px - size / 2, py - size / 2, size, size, 0, hot ? 1.5 : 1,
		             TOKEN_CURRENT);
	}
	for (int i = 0; i < x->m->n_marks; i++) {
		const double px = at_u(x, x->m->marks[2 * i]), py = at_v(x, x->m->marks[2 * i + 1]);
		paint_circle(p, px, py, 4, 4.5, TOKEN_VIEW);
		paint_circle(p, px, py, 4, 1.75, TOKEN_TEXT);
	}
}

/* A line across from each edge, so that both numbers can be read. */
static void paint_probe(const struct paint *p, const struct plane *x)
{
	const double px = at_u(x, x->m->probe[0]), py = at_v(x, x->m->probe[1]);

	if (!x->m->has_probe)
		return;
	paint_line(p, px, x->b.y, px, x->b.y + x->b.height, 1, TOKEN_ACCENT);
	paint_line(p, x->b.x, py, x->b.x + x->b.width, py, 1, TOKEN_ACCENT);
	paint_circle(p, px, py, 6, 1.5, TOKEN_ACCENT);
}

static void paint_ticks(const struct paint *p, const struct plane *x)
{
	const struct box_px *b = &x->b;
	const double gap = fmin(0.5, 44 / b->width);
	struct ticks t;

	ticks_linear(&t, x->m->range[0][0], x->m->range[0][1], gap);
	for (int i = 0; i < t.n; i++)
		paint_text(p, LABEL_NOTE, TOKEN_MUTED, at_u(x, t.value[i]), b->y + b->height + 14,
		           0.5, t.text[i]);
	ticks_linear(&t, x->m->range[1][0], x->m->range[1][1], gap);
	for (int i = 0; i < t.n; i++)
		paint_text(p, LABEL_NOTE, TOKEN_MUTED, b->x - 8, at_v(x, t.value[i]), 1, t.text[i]);
	paint_text(p, LABEL_STRONG, TOKEN_MUTED, b->x + b->width / 2, b->y + b->height + 28, 0.5,
	           "u");
	paint_text(p, LABEL_STRONG, TOKEN_MUTED, b->x - 44, b->y + b->height / 2, 0.5, "v");
}

void panel_uv(cairo_t *cr, const struct box_px *pane, const struct uv_model *m,
              const struct look *k)
{
	const struct paint p = { cr, k, NULL };
	const struct plane x = { m, panel_uv_square(pane) };
	const struct rgb ground = theme_color(k->theme, TOKEN_VIEW);

	paint_set_rgb(&p, ground);
	cairo_rectangle(cr, pane->x, pane->y, pane->width, pane->height);
	cairo_fill(cr);
	if (!(m->range[0][0] < m->range[0][1] && m->range[1][0] < m->range[1][1])) {
		paint_text(&p, LABEL_ENTRY, TOKEN_MUTED, pane->x + pane->width / 2,
		           pane->y + pane->height / 2, 0.5, "No surface is current");
		return;
	}
	cairo_save(cr);
	cairo_rectangle(cr, x.b.x - 1, x.b.y - 1, x.b.width + 2, x.b.height + 2);
	cairo_clip(cr);
	paint_ground(&p, &x);
	paint_lines(&p, &x);
	paint_probe(&p, &x);
	paint_points(&p, &x);
	cairo_restore(cr);
	paint_ticks(&p, &x);
}
