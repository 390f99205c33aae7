/* scene_lines.c - isoparametric lines, curves and their labels laid out in the image. */
#include "scene_lines.h"

#include <math.h>
#include <stdlib.h>

#include "refine.h"

enum { SPACING = 44, LINES_MAX = 16, PAD = 16 };

void scene_lines_finish(struct scene_lines *s)
{
	for (size_t i = 0; i < s->n_lines; i++)
		stroke_finish(&s->lines[i].stroke);
	free(s->lines);
	free(s->texts);
	*s = (struct scene_lines){ .lines = NULL };
}

static enum status add_isoparametric(struct stroke *out, const struct camera *camera,
                                     const struct surface *surface, int d, double t)
{
	struct curve line;
	enum status st = surface_isoparametric(&line, surface, d, t);
	if (st)
		return st;
	st = stroke_add(out, camera, &line, true);
	curve_finish(&line);
	return st;
}

/* Into how many parts to cut direction d, so that lines lie some SPACING px apart. */
static enum status count_parts(int *parts, const struct camera *camera,
                               const struct surface *surface, int d)
{
	struct stroke across = { .pieces = NULL };
	const double *other = surface->domain[1 - d];
	enum status st = add_isoparametric(&across, camera, surface, 1 - d,
	                                   other[0] + (other[1] - other[0]) / 2);
	double n = round(stroke_length(&across) / SPACING);
	*parts = (int)fmin(fmax(n, 1), LINES_MAX);
	stroke_finish(&across);
	return st;
}

static enum status add_surface(struct scene_line *wire, struct scene_line *border,
                               const struct camera *camera, const struct surface *surface)
{
	for (int d = 0; d < 2; d++) {
		const double *domain = surface->domain[d];
		int parts = 1;
		enum status st = count_parts(&parts, camera, surface, d);
		for (int i = 0; i <= parts && !st; i++) {
			struct scene_line *line = i == 0 || i == parts ? border : wire;
			double t = i == parts ? domain[1]
			                      : domain[0] + (domain[1] - domain[0]) * i / parts;
			st = add_isoparametric(&line->stroke, camera, surface, d, t);
		}
		if (st)
			return st;
	}
	return ST_OK;
}

void scene_plate(const struct scene_text *t, double box[4])
{
	double middle = t->y - label_baseline(t->style, 0);
	box[0] = t->x - 4;
	box[1] = middle - 8;
	box[2] = t->width + 8;
	box[3] = 16;
}

static bool overlap(const double a[4], const double b[4])
{
	return a[0] < b[0] + b[2] && b[0] < a[0] + a[2] && a[1] < b[1] + b[3] && b[1] < a[1] + a[3];
}

static bool has_room(const struct scene_lines *s, const struct scene_text *t)
{
	double box[4], other[4];
	scene_plate(t, box);
	if (box[0] < 0 || box[1] < 0 || box[0] + box[2] > s->width || box[1] + box[3] > s->height)
		return false;
	for (size_t i = 0; i < s->n_texts; i++) {
		scene_plate(&s->texts[i], other);
		if (overlap(box, other))
			return false;
	}
	return true;
}

/* On the line's middle if that is free, else elsewhere on it, else nowhere. */
static void add_label(struct scene_lines *s, const struct stroke *stroke, const char *label,
                      struct rgb color, cairo_t *cr)
{
	static const double shares[] = { 0.5, 0.35, 0.65, 0.2, 0.8 };
	struct scene_text t = { .style = LABEL_NOTE, .color = color, .plate = true, .text = label };
	t.width = label_width(cr, t.style, label);
	if (stroke_length(stroke) < 2.5 * t.width)
		return;
	for (size_t i = 0; i < sizeof shares / sizeof *shares; i++) {
		double at[2];
		stroke_point(stroke, shares[i], at);
		t.x = at[0] - t.width / 2;
		t.y = label_baseline(t.style, at[1]);
		if (has_room(s, &t)) {
			s->texts[s->n_texts++] = t;
			return;
		}
	}
}

static void add_heading(struct scene_lines *s, const char *text, enum label_style style, double y,
                        struct rgb color, cairo_t *cr)
{
	if (text)
		s->texts[s->n_texts++] = (struct scene_text){ .x = PAD,
			                                      .y = y,
			                                      .width = label_width(cr, style, text),
			                                      .style = style,
			                                      .color = color,
			                                      .text = text };
}

static void add_small(struct scene_lines *s, const struct picture_text *t, struct rgb color,
                      cairo_t *cr)
{
	const double width = label_width(cr, LABEL_NOTE, t->text);
	s->texts[s->n_texts++] = (struct scene_text){ .x = t->x - t->align * width,
		                                      .y = t->y,
		                                      .width = width,
		                                      .style = LABEL_NOTE,
		                                      .color = color,
		                                      .text = t->text };
}

enum status scene_lines_init(struct scene_lines *s, const struct picture_lines *lines,
                             enum theme theme, cairo_t *cr)
{
	struct line_style wire = { theme_color(theme, TOKEN_TEXT), 0.75, 0.25 };
	struct line_style border = { theme_color(theme, TOKEN_TEXT2), 1, 0.6 };
	*s = (struct scene_lines){ .width = lines->camera->width,
		                   .height = lines->camera->height,
		                   .ground = theme_color(theme, TOKEN_VIEW) };
	s->lines = calloc(2 + lines->n_curves, sizeof *s->lines);
	s->texts = calloc(2 + lines->n_curves + lines->n_texts, sizeof *s->texts);
	if (!s->lines || !s->texts) {
		scene_lines_finish(s);
		return ST_RESOURCE;
	}
	s->n_lines = 2 + lines->n_curves;
	s->lines[0] = (struct scene_line){ .style = wire, .what = "wire" };
	s->lines[1] = (struct scene_line){ .style = border, .what = "border" };
	add_heading(s, lines->title, LABEL_HEADING, PAD + 10, theme_color(theme, TOKEN_TEXT), cr);
	add_heading(s, lines->note, LABEL_NOTE, PAD + 28, theme_color(theme, TOKEN_MUTED), cr);
	for (size_t i = 0; i < lines->n_texts; i++)
		add_small(s, &lines->texts[i], theme_color(theme, TOKEN_MUTED), cr);

	enum status st = ST_OK;
	for (int i = 0; i < lines->n_surfaces && !st; i++)
		st = add_surface(&s->lines[0], &s->lines[1], lines->camera, lines->surfaces[i]);
	for (size_t i = 0; i < lines->n_wires && !st; i++)
		st = stroke_add(&s->lines[0].stroke, lines->camera, &lines->wires[i], true);
	for (size_t i = 0; i < lines->n_borders && !st; i++)
		st = stroke_add(&s->lines[1].stroke, lines->camera, &lines->borders[i], true);
	for (size_t i = 0; i < lines->n_curves && !st; i++) {
		const struct picture_curve *c = &lines->curves[i];
		struct scene_line *line = &s->lines[2 + i];
		*line = (struct scene_line){ .style = { c->color, c->width, 1 }, .what = "curve" };
		st = stroke_add(&line->stroke, lines->camera, c->curve, false);
		if (!st && c->label && line->stroke.n)
			add_label(s, &line->stroke, c->label, theme_color(theme, TOKEN_TEXT), cr);
	}
	if (st)
		scene_lines_finish(s);
	return st;
}
