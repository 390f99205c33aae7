/* label.c - text on a Cairo surface. A context keeps a layout a style, so that a label costs the
 * shaping of its text and nothing else. */
#include "label.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <pango/pangocairo.h>

const char label_families[] = "Inter, DejaVu Sans, sans-serif";

#define X(name, size, weight, tabular) [LABEL_##name] = { size, weight, tabular },
static const struct {
	int size, weight;
	bool tabular;
} styles[N_LABEL_STYLES] = { LABEL_MAP(X) };
#undef X

enum { TEXT_MAX = 4000 }; /* bytes of a line: more than fits anywhere */

struct type {
	PangoLayout *layouts[N_LABEL_STYLES];
	int cuts;
};
static const cairo_user_data_key_t type_key;

double label_size(enum label_style style)
{
	return styles[style].size;
}

int label_weight(enum label_style style)
{
	return styles[style].weight;
}

double label_baseline(enum label_style style, double middle)
{
	const double half_capital = 0.3635; /* of the size, in Inter */
	return middle + half_capital * styles[style].size;
}

static void type_destroy(void *data)
{
	struct type *t = data;
	for (int i = 0; i < N_LABEL_STYLES; i++)
		if (t->layouts[i])
			g_object_unref(t->layouts[i]);
	free(t);
}

/* NULL for want of memory; labels then do without what is kept. */
static struct type *type_of(cairo_t *cr)
{
	struct type *t = cairo_get_user_data(cr, &type_key);
	if (t)
		return t;
	t = calloc(1, sizeof *t);
	if (t && cairo_set_user_data(cr, &type_key, t, type_destroy) != CAIRO_STATUS_SUCCESS) {
		free(t);
		t = NULL;
	}
	return t;
}

/* Without hinting, so that a text is as wide at every scale. */
static PangoLayout *layout_create(cairo_t *cr, enum label_style style)
{
	PangoLayout *l = pango_cairo_create_layout(cr);
	PangoContext *context = pango_layout_get_context(l);
	cairo_font_options_t *options = cairo_font_options_create();
	cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
	cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
	cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
	pango_cairo_context_set_font_options(context, options);
	pango_cairo_context_set_resolution(context, 72);
	pango_context_set_round_glyph_positions(context, FALSE);
	cairo_font_options_destroy(options);

	PangoFontDescription *font = pango_font_description_new();
	pango_font_description_set_family_static(
	        font, style == LABEL_MONO ? "DejaVu Sans Mono, monospace" : label_families);
	pango_font_description_set_absolute_size(font, styles[style].size * PANGO_SCALE);
	pango_font_description_set_weight(font, styles[style].weight);
	pango_layout_set_font_description(l, font);
	pango_font_description_free(font);

	if (styles[style].tabular) {
		PangoAttrList *attributes = pango_attr_list_new();
		pango_attr_list_insert(attributes, pango_attr_font_features_new("tnum=1"));
		pango_layout_set_attributes(l, attributes);
		pango_attr_list_unref(attributes);
	}
	return l;
}

/* Bytes that are no text become the mark for such; the end of a very long text is left out. */
static void set_text(PangoLayout *l, const char *text)
{
	size_t n = text ? strnlen(text, TEXT_MAX) : 0;
	if (n == TEXT_MAX)
		while (n > TEXT_MAX - 4 && (text[n] & 0xC0) == 0x80)
			n--;
	if (!n || g_utf8_validate(text, (gssize)n, NULL)) {
		pango_layout_set_text(l, n ? text : "", (int)n);
		return;
	}
	char *valid = g_utf8_make_valid(text, (gssize)n);
	pango_layout_set_text(l, valid, -1);
	g_free(valid);
}

/* A reference of the caller's. */
static PangoLayout *layout(cairo_t *cr, enum label_style style, const char *text)
{
	struct type *t = type_of(cr);
	PangoLayout *l = t ? t->layouts[style] : NULL;
	if (l) {
		pango_cairo_update_layout(cr, l);
	} else {
		l = layout_create(cr, style);
		if (t)
			t->layouts[style] = l;
	}
	if (t)
		g_object_ref(l);
	pango_layout_set_single_paragraph_mode(l, TRUE);
	pango_layout_set_width(l, -1);
	pango_layout_set_height(l, -1);
	pango_layout_set_ellipsize(l, PANGO_ELLIPSIZE_NONE);
	pango_layout_set_line_spacing(l, 0);
	set_text(l, text);
	return l;
}

static double width_of(PangoLayout *l)
{
	PangoRectangle logical;
	pango_layout_get_extents(l, NULL, &logical);
	return (double)logical.width / PANGO_SCALE;
}

static void show(cairo_t *cr, PangoLayout *l, struct rgb color, double x, double baseline)
{
	cairo_set_source_rgb(cr, color.r, color.g, color.b);
	cairo_move_to(cr, x, baseline - (double)pango_layout_get_baseline(l) / PANGO_SCALE);
	pango_cairo_show_layout(cr, l);
	cairo_new_path(cr);
}

double label_width(cairo_t *cr, enum label_style style, const char *text)
{
	PangoLayout *l = layout(cr, style, text);
	double width = width_of(l);
	g_object_unref(l);
	return width;
}

void label_draw(cairo_t *cr, enum label_style style, struct rgb color, double x, double y,
                double align, const char *text)
{
	PangoLayout *l = layout(cr, style, text);
	show(cr, l, color, x - (align > 0 ? align * width_of(l) : 0), y);
	g_object_unref(l);
}

static void count_cut(cairo_t *cr)
{
	struct type *t = type_of(cr);
	if (t)
		t->cuts++;
}

double label_fit(cairo_t *cr, enum label_style style, struct rgb color, double x, double y,
                 double align, double room, enum label_cut cut, const char *text)
{
	const double hair = 0.01; /* px; widths are sums of fractions */
	PangoLayout *l = layout(cr, style, text);
	double width = width_of(l);
	if (width > room + hair) {
		count_cut(cr);
		pango_layout_set_ellipsize(l, cut == LABEL_CUT_MIDDLE ? PANGO_ELLIPSIZE_MIDDLE
		                                                      : PANGO_ELLIPSIZE_END);
		pango_layout_set_width(l, room > 0 ? (int)(room * PANGO_SCALE) : 0);
		width = width_of(l);
	}
	if (width > room + hair)
		width = 0;
	else
		show(cr, l, color, x - align * width, y);
	g_object_unref(l);
	return width;
}

static PangoLayout *wrapped(cairo_t *cr, enum label_style style, double width, int max_lines,
                            const char *text)
{
	const float leading = 1.25F;
	PangoLayout *l = layout(cr, style, text);
	pango_layout_set_wrap(l, PANGO_WRAP_WORD_CHAR);
	pango_layout_set_line_spacing(l, leading);
	pango_layout_set_width(l, (int)(fmax(width, 1) * PANGO_SCALE));
	if (max_lines > 0) {
		pango_layout_set_height(l, -max_lines);
		pango_layout_set_ellipsize(l, PANGO_ELLIPSIZE_END);
	}
	return l;
}

static double height_of(PangoLayout *l)
{
	PangoRectangle logical;
	pango_layout_get_extents(l, NULL, &logical);
	return (double)logical.height / PANGO_SCALE;
}

double label_wrap_height(cairo_t *cr, enum label_style style, double width, int max_lines,
                         const char *text)
{
	PangoLayout *l = wrapped(cr, style, width, max_lines, text);
	double height = height_of(l);
	g_object_unref(l);
	return height;
}

double label_wrap(cairo_t *cr, enum label_style style, struct rgb color, double x, double y,
                  double width, int max_lines, const char *text)
{
	PangoLayout *l = wrapped(cr, style, width, max_lines, text);
	if (pango_layout_is_ellipsized(l))
		count_cut(cr);
	show(cr, l, color, x, y + (double)pango_layout_get_baseline(l) / PANGO_SCALE);
	double height = height_of(l);
	g_object_unref(l);
	return height;
}

double label_caret(cairo_t *cr, enum label_style style, const char *text, int at)
{
	PangoLayout *l = layout(cr, style, text);
	PangoRectangle place;
	int n = (int)strlen(pango_layout_get_text(l));
	pango_layout_index_to_pos(l, at < 0 ? 0 : at < n ? at : n, &place);
	double x = (double)place.x / PANGO_SCALE;
	g_object_unref(l);
	return x;
}

int label_cuts(cairo_t *cr)
{
	struct type *t = cairo_get_user_data(cr, &type_key);
	return t ? t->cuts : 0;
}
