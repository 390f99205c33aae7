/* curve_graph.c - two values of a curve over its length, drawn. */
#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <math.h>
#include <string.h>
#include <strings.h>

#include "curve_samples.h"
#include "file.h"
#include "label.h"
#include "path.h"
#include "text.h"
#include "theme.h"
#include "ticks.h"

/* px: the sheet, the room about a graph, between two */
enum { WIDTH = 960, HEIGHT = 600, LEFT = 90, RIGHT = 30, TOP = 70, BOTTOM = 50, BETWEEN = 60 };

/* One graph: where it is, which values. */
struct graph {
	cairo_t *cr;
	const struct curve_samples *samples;
	enum sample_column column;
	double x, y, width, height;
	double from[2], to[2]; /* values at the ends of both axes */
};

static void set_color(cairo_t *cr, enum token token)
{
	const struct rgb c = theme_color(THEME_LIGHT, token);

	cairo_set_source_rgb(cr, c.r, c.g, c.b);
}

static double place_x(const struct graph *g, double value)
{
	return g->x + g->width * (value - g->from[0]) / (g->to[0] - g->from[0]);
}

static double place_y(const struct graph *g, double value)
{
	return g->y + g->height * (g->to[1] - value) / (g->to[1] - g->from[1]);
}

/* Both ends of the values, zero between them; a little room where they are all the same. */
static void find_range(struct graph *g)
{
	const struct curve_samples *s = g->samples;

	g->from[0] = 0;
	g->to[0] = s->row[s->n - 1][SAMPLE_LENGTH];
	g->from[1] = g->to[1] = 0;
	for (int k = 0; k < s->n; k++) {
		g->from[1] = fmin(g->from[1], s->row[k][g->column]);
		g->to[1] = fmax(g->to[1], s->row[k][g->column]);
	}
	for (int axis = 0; axis < 2; axis++)
		if (!(g->to[axis] - g->from[axis] > 0))
			g->to[axis] = g->from[axis] + 1;
}

static void draw_axes(const struct graph *g)
{
	const struct rgb color = theme_color(THEME_LIGHT, TOKEN_MUTED);
	struct ticks t;

	cairo_set_line_width(g->cr, 1);
	ticks_linear(&t, g->from[0], g->to[0], 0.09);
	for (int k = 0; k < t.n; k++) {
		const double x = place_x(g, t.value[k]);
		set_color(g->cr, TOKEN_LINE);
		cairo_move_to(g->cr, x, g->y);
		cairo_line_to(g->cr, x, g->y + g->height);
		cairo_stroke(g->cr);
		label_draw(g->cr, LABEL_NOTE, color, x, g->y + g->height + 16, 0.5, t.text[k]);
	}
	ticks_linear(&t, g->from[1], g->to[1], 0.15);
	for (int k = 0; k < t.n; k++) {
		const double y = place_y(g, t.value[k]);
		set_color(g->cr, t.value[k] == 0 ? TOKEN_EDGE : TOKEN_LINE);
		cairo_move_to(g->cr, g->x, y);
		cairo_line_to(g->cr, g->x + g->width, y);
		cairo_stroke(g->cr);
		label_draw(g->cr, LABEL_NOTE, color, g->x - 8, label_baseline(LABEL_NOTE, y), 1,
		           t.text[k]);
	}
}

/* A value that is not there leaves a gap. */
static void draw_values(const struct graph *g)
{
	bool drawing = false;

	for (int k = 0; k < g->samples->n; k++) {
		const double *row = g->samples->row[k];
		const double x = place_x(g, row[SAMPLE_LENGTH]), y = place_y(g, row[g->column]);
		if (row[g->column] != row[g->column]) {
			drawing = false;
			continue;
		}
		if (drawing)
			cairo_line_to(g->cr, x, y);
		else
			cairo_move_to(g->cr, x, y);
		drawing = true;
	}
	set_color(g->cr, TOKEN_ACCENT);
	cairo_set_line_width(g->cr, 1.5);
	cairo_stroke(g->cr);
}

static void draw_graph(cairo_t *cr, const struct curve_samples *s, enum sample_column column,
                       int place, const char *title)
{
	const double height = (HEIGHT - TOP - BOTTOM - BETWEEN) / 2.0;
	struct graph g = { .cr = cr,
		           .samples = s,
		           .column = column,
		           .x = LEFT,
		           .y = TOP + place * (height + BETWEEN),
		           .width = WIDTH - LEFT - RIGHT,
		           .height = height };

	find_range(&g);
	draw_axes(&g);
	draw_values(&g);
	label_draw(cr, LABEL_STRONG, theme_color(THEME_LIGHT, TOKEN_TEXT2), g.x, g.y - 10, 0,
	           title);
}

static void draw(cairo_t *cr, const struct curve_samples *s, const char *name, const char *unit)
{
	const char *const titles[2][2] = { { "Curvature", "Torsion" },
		                           { "Normal curvature", "Geodesic curvature" } };
	struct text t = { 0 };

	set_color(cr, TOKEN_RAISED);
	cairo_paint(cr);
	label_draw(cr, LABEL_HEADING, theme_color(THEME_LIGHT, TOKEN_TEXT), LEFT, 30, 0, name);
	for (int k = 0; k < 2; k++) {
		text_reset(&t);
		text_addf(&t, "%s%s%s", titles[s->on_surface][k], unit ? ", 1/" : "",
		          unit ? unit : "");
		draw_graph(cr, s, (s->on_surface ? SAMPLE_NORMAL : SAMPLE_CURVATURE) + (unsigned)k,
		           k, t.s ? t.s : "");
	}
	text_reset(&t);
	text_addf(&t, "length%s%s", unit ? ", " : "", unit ? unit : "");
	label_draw(cr, LABEL_NOTE, theme_color(THEME_LIGHT, TOKEN_MUTED), WIDTH - RIGHT,
	           HEIGHT - 12, 1, t.s ? t.s : "");
	text_finish(&t);
}

static cairo_status_t take_bytes(void *data, const unsigned char *bytes, unsigned n)
{
	struct text *t = data;

	text_add_bytes(t, bytes, n);
	return t->failed ? CAIRO_STATUS_NO_MEMORY : CAIRO_STATUS_SUCCESS;
}

/* Cairo numbers its pages through the life of the process; nothing refers to the number. */
static void forget_number(struct text *t)
{
	static const char before[] = "<g id=\"surface";
	char *at = t->s ? strstr(t->s, before) : NULL, *digits = at ? at + strlen(before) : NULL;
	const size_t n = digits ? strspn(digits, "0123456789") : 0;

	if (!n)
		return;
	memmove(digits, digits + n, t->n - (size_t)(digits + n - t->s) + 1);
	t->n -= n;
}

enum status curve_graph_write(const struct curve_samples *s, const char *name, const char *unit,
                              const char *path, const struct report *r)
{
	const bool svg = !strcasecmp(path_extension(path), ".svg");
	struct text bytes = { 0 };
	cairo_surface_t *surface;

	if (!svg && strcasecmp(path_extension(path), ".pdf"))
		return report_error(r, ST_PARAMETER, "'%s': a graph is .svg or .pdf, a table .csv",
		                    path_file_name(path));
	if (svg)
		surface = cairo_svg_surface_create_for_stream(take_bytes, &bytes, WIDTH, HEIGHT);
	else {
		surface = cairo_pdf_surface_create_for_stream(take_bytes, &bytes, WIDTH, HEIGHT);
		/* the same at any time */
		cairo_pdf_surface_set_metadata(surface, CAIRO_PDF_METADATA_CREATE_DATE,
		                               "2000-01-01T00:00:00Z");
	}
	cairo_t *cr = cairo_create(surface);
	draw(cr, s, name, unit);
	cairo_show_page(cr);
	cairo_status_t drawn = cairo_status(cr);
	cairo_destroy(cr);
	cairo_surface_finish(surface);
	drawn = drawn ? drawn : cairo_surface_status(surface);
	cairo_surface_destroy(surface);
	if (svg)
		forget_number(&bytes);
	enum status st = drawn || bytes.failed
	                         ? report_error(r, ST_RESOURCE, "cannot draw '%s': %s", path,
	                                        cairo_status_to_string(drawn))
	                         : file_write(path, bytes.s, bytes.n, r);
	text_finish(&bytes);
	return st;
}
