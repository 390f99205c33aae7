/* label.c - a line of text on a Cairo surface. */
#include "label.h"

#include <pango/pangocairo.h>

const char label_families[] = "Inter, DejaVu Sans, sans-serif";

static const struct {
	int size, weight;
} styles[N_LABEL_STYLES] = {
	[LABEL_HEADING] = { 13, 600 },
	[LABEL_STRONG] = { 11, 600 },
	[LABEL_NOTE] = { 11, 400 },
};

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

/* Without hinting, so that a text is as wide at every scale. */
static PangoLayout *layout(cairo_t *cr, enum label_style style, const char *text)
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
	pango_font_description_set_family_static(font, label_families);
	pango_font_description_set_absolute_size(font, styles[style].size * PANGO_SCALE);
	pango_font_description_set_weight(font, styles[style].weight);
	pango_layout_set_font_description(l, font);
	pango_font_description_free(font);

	PangoAttrList *attributes = pango_attr_list_new();
	pango_attr_list_insert(attributes, pango_attr_font_features_new("tnum=1"));
	pango_layout_set_attributes(l, attributes);
	pango_attr_list_unref(attributes);
	pango_layout_set_text(l, text, -1);
	return l;
}

static double width_of(PangoLayout *l)
{
	PangoRectangle logical;
	pango_layout_get_extents(l, NULL, &logical);
	return (double)logical.width / PANGO_SCALE;
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
	double baseline = (double)pango_layout_get_baseline(l) / PANGO_SCALE;
	cairo_set_source_rgb(cr, color.r, color.g, color.b);
	cairo_move_to(cr, x - align * width_of(l), y - baseline);
	pango_cairo_show_layout(cr, l);
	g_object_unref(l);
}
