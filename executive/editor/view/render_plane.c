/* render_plane.c - the plane of a surface's parameters as lines of a picture: its domain, knots, trims, the
 * curves on it, marks. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render.h"
#include "ticks.h"

enum { HEAD = 64, LEFT = 56, RIGHT = 24, FOOT = 40, SAMPLES_A_SPAN = 12, SAMPLES_MAX = 4096 };

static const double MARGIN = 0.04;

struct plane {
	struct plane_lines *p;
	const struct surface *g;
	double range[2][2];
	double x, y, side; /* px: the square in which the range lies */
	enum theme theme;
};

static double at_u(const struct plane *x, double u)
{
	return x->x + x->side * (u - x->range[0][0]) / (x->range[0][1] - x->range[0][0]);
}

static double at_v(const struct plane *x, double v)
{
	return x->y + x->side * (x->range[1][1] - v) / (x->range[1][1] - x->range[1][0]);
}

/* A line of n points in px; NULL: memory ran out. */
static struct curve *add_line(struct plane *x, int n, enum token color, double width)
{
	struct plane_lines *p = x->p;
	struct curve *curves = reallocarray(p->curves, (size_t)p->n_curves + 1, sizeof *p->curves);
	if (curves)
		p->curves = curves;
	struct picture_curve *styled =
	        reallocarray(p->styled, (size_t)p->n_curves + 1, sizeof *p->styled);
	if (styled)
		p->styled = styled;
	if (!curves || !styled || curve_init(&p->curves[p->n_curves], 2, n) != ST_OK) {
		p->failed = true;
		return NULL;
	}
	struct curve *c = &p->curves[p->n_curves];
	for (int i = 0; i < n; i++)
		c->knots[i + 1] = i;
	c->knots[n + 1] = n - 1;
	c->domain[1] = n - 1;
	p->styled[p->n_curves++] =
	        (struct picture_curve){ .color = theme_color(x->theme, color), .width = width };
	return c;
}

/* The camera looks down at px as they are. */
static void put(struct curve *c, int i, double px, double py)
{
	if (c)
		curve_set_point(c, i, vec3(px, -py, 0), 1);
}

static void add_segment(struct plane *x, double x0, double y0, double x1, double y1,
                        enum token color, double width)
{
	struct curve *c = add_line(x, 2, color, width);
	put(c, 0, x0, y0);
	put(c, 1, x1, y1);
}

static void add_curve(struct plane *x, const struct curve *c, enum token color, double width)
{
	int n = (c->n - c->order + 1) * SAMPLES_A_SPAN + 1;
	n = n > SAMPLES_MAX ? SAMPLES_MAX : n < 2 ? 2 : n;
	struct curve *line = add_line(x, n, color, width);
	for (int i = 0; i < n; i++) {
		const double share = (double)i / (n - 1);
		const struct vec3 q =
		        curve_point(c, c->domain[0] + share * (c->domain[1] - c->domain[0]));
		put(line, i, at_u(x, q.x), at_v(x, q.y));
	}
}

static void add_domain(struct plane *x)
{
	const double(*d)[2] = (const double(*)[2])x->g->domain;
	const double left = at_u(x, d[0][0]), right = at_u(x, d[0][1]);
	const double top = at_v(x, d[1][1]), low = at_v(x, d[1][0]);
	for (int k = 0; k < 2; k++) {
		double last = d[k][0];
		for (int i = 0; i < x->g->n[k] + x->g->order[k]; i++) {
			const double t = x->g->knots[k][i];
			if (!(t > last && t < d[k][1]))
				continue;
			last = t;
			if (k == 0)
				add_segment(x, at_u(x, t), top, at_u(x, t), low, TOKEN_LINE, 1);
			else
				add_segment(x, left, at_v(x, t), right, at_v(x, t), TOKEN_LINE, 1);
		}
	}
	struct curve *border = add_line(x, 5, TOKEN_EDGE, 1);
	const double px[] = { left, right, right, left, left }, py[] = { low, low, top, top, low };
	for (int i = 0; i < 5; i++)
		put(border, i, px[i], py[i]);
}

static void add_things(struct plane *x, const struct world *w, const struct Ful *f)
{
	const struct Ful *current = world_current(w, true);
	for (int i = 0; i < f->entity.trim.n; i++)
		for (int k = 0; k < f->entity.trim.loops[i].n; k++)
			add_curve(x, &f->entity.trim.loops[i].curves[k], TOKEN_TEXT2, 1);
	for (int k = 0; k < world_count(w); k++) {
		const struct Ful *c = world_at(w, k);
		if (c->on == f->id && c->display.on)
			add_curve(x, &c->entity.curve, c == current ? TOKEN_CURRENT : TOKEN_TEXT2,
			          c == current ? 2 : 1.5);
	}
	for (int k = 0; k < world_marks(w); k++) {
		const struct mark *m = world_mark(w, k);
		const double px = at_u(x, m->u), py = at_v(x, m->v);
		if (m->thing != f->id)
			continue;
		add_segment(x, px - 4, py, px + 4, py, TOKEN_TEXT, 1.75);
		add_segment(x, px, py - 4, px, py + 4, TOKEN_TEXT, 1.75);
	}
}

static void add_text(struct plane *x, double px, double py, double align, const char *text)
{
	struct plane_lines *p = x->p;
	struct picture_text *all = reallocarray(p->texts, (size_t)p->n_texts + 1, sizeof *p->texts);
	char *copy = strdup(text);
	if (all)
		p->texts = all;
	if (!all || !copy) {
		free(copy);
		p->failed = true;
		return;
	}
	p->texts[p->n_texts++] = (struct picture_text){ px, py, align, copy };
}

static void add_ticks(struct plane *x)
{
	const double gap = fmin(0.5, 44 / x->side);
	struct ticks t;
	ticks_linear(&t, x->range[0][0], x->range[0][1], gap);
	for (int i = 0; i < t.n; i++)
		add_text(x, at_u(x, t.value[i]), x->y + x->side + 18, 0.5, t.text[i]);
	ticks_linear(&t, x->range[1][0], x->range[1][1], gap);
	for (int i = 0; i < t.n; i++)
		add_text(x, x->x - 8, at_v(x, t.value[i]) + 4, 1, t.text[i]);
	add_text(x, x->x + x->side / 2, x->y + x->side + 32, 0.5, "u");
	add_text(x, x->x - 44, x->y + x->side / 2 + 4, 0.5, "v");
}

/* One px is one of length, the upper left corner is the origin. */
static void place_camera(struct camera *c, int width, int height)
{
	*c = (struct camera){ .kind = CAMERA_ORTHOGRAPHIC,
		              .width = width,
		              .height = height,
		              .eye = vec3(width / 2.0, -height / 2.0, 1),
		              .right = vec3(1, 0, 0),
		              .up = vec3(0, 1, 0),
		              .ahead = vec3(0, 0, -1),
		              .half = (width < height ? width : height) / 2.0 };
}

enum status plane_lines_init(struct plane_lines *p, const struct world *w,
                             const struct render_tile *t, enum theme theme)
{
	const struct Ful *f = view_plane_surface(w);
	const int width = t->state.camera.width, height = t->state.camera.height;
	*p = (struct plane_lines){ .curves = NULL };
	place_camera(&p->camera, width, height);
	struct plane x = { .p = p, .theme = theme };
	const double wide = width - LEFT - RIGHT, high = height - HEAD - FOOT;
	x.side = fmax(fmin(wide, high), 40);
	x.x = LEFT + fmax(wide - x.side, 0) / 2;
	x.y = HEAD + fmax(high - x.side, 0) / 2;
	if (f) {
		x.g = &f->entity.geometry;
		for (int k = 0; k < 2; k++) {
			const double *d = x.g->domain[k], more = MARGIN * (d[1] - d[0]);
			x.range[k][0] = d[0] - more;
			x.range[k][1] = d[1] + more;
		}
		add_domain(&x);
		add_things(&x, w, f);
		add_ticks(&x);
	} else {
		add_text(&x, width / 2.0, height / 2.0, 0.5, "No surface is current");
	}
	for (int i = 0; i < p->n_curves; i++)
		p->styled[i].curve = &p->curves[i];
	p->lines = (struct picture_lines){ .camera = &p->camera,
		                           .curves = p->styled,
		                           .n_curves = (size_t)p->n_curves,
		                           .title = t->title.s,
		                           .note = t->note.s,
		                           .texts = p->texts,
		                           .n_texts = (size_t)p->n_texts };
	return p->failed ? ST_RESOURCE : ST_OK;
}

void plane_lines_finish(struct plane_lines *p)
{
	for (int i = 0; i < p->n_curves; i++)
		curve_finish(&p->curves[i]);
	for (int i = 0; i < p->n_texts; i++)
		free((char *)p->texts[i].text);
	free(p->curves);
	free(p->styled);
	free(p->texts);
	*p = (struct plane_lines){ .curves = NULL };
}
