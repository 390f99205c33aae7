/* picture_lines.c - wire frames and curves, as PNG, SVG or PDF. */
#include <math.h>
#include <stdlib.h>
#include <unistd.h>

#include <cairo-pdf.h>

#include "picture.h"
#include "scene_lines.h"
#include "sheet.h"

static void draw_stroke(cairo_t *cr, const struct scene_line *l)
{
	for (size_t i = 0; i < l->stroke.n; i++) {
		const struct stroke_piece *q = &l->stroke.pieces[i];
		if (q->begins)
			cairo_move_to(cr, q->p[0][0], q->p[0][1]);
		cairo_curve_to(cr, q->p[1][0], q->p[1][1], q->p[2][0], q->p[2][1], q->p[3][0],
		               q->p[3][1]);
	}
	cairo_set_source_rgba(cr, l->style.color.r, l->style.color.g, l->style.color.b,
	                      l->style.opacity);
	cairo_set_line_width(cr, l->style.width);
	cairo_stroke(cr);
}

static void draw_plate(cairo_t *cr, const struct scene_text *t, struct rgb ground)
{
	const double radius = 4;
	double b[4];
	scene_plate(t, b);
	cairo_new_sub_path(cr);
	cairo_arc(cr, b[0] + b[2] - radius, b[1] + radius, radius, -M_PI / 2, 0);
	cairo_arc(cr, b[0] + b[2] - radius, b[1] + b[3] - radius, radius, 0, M_PI / 2);
	cairo_arc(cr, b[0] + radius, b[1] + b[3] - radius, radius, M_PI / 2, M_PI);
	cairo_arc(cr, b[0] + radius, b[1] + radius, radius, M_PI, 1.5 * M_PI);
	cairo_close_path(cr);
	cairo_set_source_rgba(cr, ground.r, ground.g, ground.b, 0.85);
	cairo_fill(cr);
}

static void draw(cairo_t *cr, const struct scene_lines *s)
{
	cairo_set_source_rgb(cr, s->ground.r, s->ground.g, s->ground.b);
	cairo_paint(cr);
	cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
	cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
	for (size_t i = 0; i < s->n_lines; i++)
		draw_stroke(cr, &s->lines[i]);
	for (size_t i = 0; i < s->n_texts; i++) {
		const struct scene_text *t = &s->texts[i];
		if (t->plate)
			draw_plate(cr, t, s->ground);
		label_draw(cr, t->style, t->color, t->x, t->y, 0, t->text);
	}
}

static void draw_sheet(cairo_t *cr, const struct scene_sheet *s)
{
	if (s->n == 1) {
		draw(cr, s->scenes);
		return;
	}
	cairo_set_source_rgb(cr, s->rule.r, s->rule.g, s->rule.b);
	cairo_paint(cr);
	for (int i = 0; i < s->n; i++) {
		const struct scene_lines *x = &s->scenes[i];
		cairo_save(cr);
		cairo_rectangle(cr, x->x, x->y, x->width, x->height);
		cairo_clip(cr);
		cairo_translate(cr, x->x, x->y);
		draw(cr, x);
		cairo_restore(cr);
	}
}

/* A point for a px. Its dates would differ from time to time: one is set. */
static enum status write_pdf(const struct scene_sheet *scenes, const char *path,
                             const struct report *r)
{
	struct sheet s = { .width = scenes->width, .height = scenes->height };
	s.surface = cairo_pdf_surface_create(path, scenes->width, scenes->height);
	cairo_pdf_surface_set_metadata(s.surface, CAIRO_PDF_METADATA_CREATE_DATE,
	                               "2000-01-01T00:00:00Z");
	s.cr = cairo_create(s.surface);
	draw_sheet(s.cr, scenes);
	cairo_show_page(s.cr);
	cairo_status_t drawn = cairo_status(s.cr);
	cairo_surface_finish(s.surface);
	if (!drawn)
		drawn = cairo_surface_status(s.surface);
	sheet_finish(&s);
	if (!drawn)
		return ST_OK;
	unlink(path);
	return report_error(r, ST_RESOURCE, "cannot write '%s': %s; make room and try again", path,
	                    cairo_status_to_string(drawn));
}

static enum status write_sheet(struct sheet *sheet, const struct scene_sheet *s, const char *path,
                               enum picture_format format, const struct report *r)
{
	if (format == PICTURE_PDF)
		return write_pdf(s, path, r);
	if (format == PICTURE_SVG)
		return svg_write(s, path, r);
	draw_sheet(sheet->cr, s);
	return sheet_write(sheet, path, r);
}

enum status picture_panes(const char *path, enum picture_format format, int width, int height,
                          const struct picture_pane *panes, int n, enum theme theme,
                          const struct report *r)
{
	const bool png = format == PICTURE_PNG;
	struct sheet sheet = { .surface = NULL };
	struct scene_sheet s = { .width = width,
		                 .height = height,
		                 .rule = theme_color(theme, TOKEN_LINE),
		                 .scenes = calloc((size_t)n + 1, sizeof *s.scenes) };
	if (!s.scenes)
		return report_error(r, ST_RESOURCE, "cannot draw '%s': no memory", path);
	enum status st = sheet_init(&sheet, path, png ? width : 0, png ? height : 0, r);
	for (int i = 0; i < n && !st; i++) {
		st = scene_lines_init(&s.scenes[i], panes[i].lines, theme, sheet.cr);
		if (st)
			report_error(r, st, "cannot draw '%s': %s", path, status_text(st));
		s.scenes[i].x = panes[i].x;
		s.scenes[i].y = panes[i].y;
		s.n++;
	}
	if (!st)
		st = write_sheet(&sheet, &s, path, format, r);
	for (int i = 0; i < s.n; i++)
		scene_lines_finish(&s.scenes[i]);
	free(s.scenes);
	sheet_finish(&sheet);
	return st;
}

enum status picture_lines(const char *path, enum picture_format format,
                          const struct picture_lines *lines, enum theme theme,
                          const struct report *r)
{
	const struct picture_pane pane = { .lines = lines };
	return picture_panes(path, format, lines->camera->width, lines->camera->height, &pane, 1,
	                     theme, r);
}

enum status picture_pane_draw(cairo_t *cr, const struct picture_lines *lines, enum theme theme)
{
	struct scene_lines scene;
	enum status st = scene_lines_init(&scene, lines, theme, cr);
	if (st)
		return st;
	draw(cr, &scene);
	scene_lines_finish(&scene);
	return ST_OK;
}
