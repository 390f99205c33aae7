/* label.c - text on a Cairo surface. The surface keeps the layouts drawn last, so that what did not
 * change is not shaped again. */
#include "label.h"

#include <math.h>
#include <string.h>

#include <pango/pangocairo.h>

const char label_families[] = "Inter, DejaVu Sans, sans-serif";

#define X(name, size, weight, tabular) [LABEL_##name] = { size, weight, tabular },
static const struct {
	int size, weight;
	bool tabular;
} styles[N_LABEL_STYLES] = { LABEL_MAP(X) };
#undef X

enum {
	TEXT_MAX = 4000, /* bytes of a line: more than fits anywhere */
	SLOTS = 1024,    /* layouts kept: several screens of labels */
};

/* What a layout is made from. width -1: as long as the text; lines 0: one. */
struct slot {
	PangoLayout *layout; /* owned, as text; NULL: free */
	char *text;
	enum label_style style;
	int width, lines;
	PangoEllipsizeMode cut;
};
struct type {
	PangoContext *context;
	cairo_matrix_t matrix; /* that it knows of */
	struct slot slots[SLOTS];
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

static void slot_clear(struct slot *s)
{
	if (s->layout)
		g_object_unref(s->layout);
	g_free(s->text);
	*s = (struct slot){ 0 };
}

static void type_destroy(void *data)
{
	struct type *t = data;
	for (int i = 0; i < SLOTS; i++)
		slot_clear(&t->slots[i]);
	g_object_unref(t->context);
	g_free(t);
}

/* Without hinting, so that a text is as wide at every scale. */
static PangoContext *context_create(cairo_t *cr)
{
	PangoContext *context = pango_cairo_create_context(cr);
	cairo_font_options_t *options = cairo_font_options_create();
	cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
	cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
	cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
	pango_cairo_context_set_font_options(context, options);
	pango_cairo_context_set_resolution(context, 72);
	pango_context_set_round_glyph_positions(context, FALSE);
	cairo_font_options_destroy(options);
	return context;
}

/* NULL on a context that could not be made. */
static struct type *type_of(cairo_t *cr)
{
	cairo_surface_t *surface = cairo_get_target(cr);
	struct type *t = cairo_surface_get_user_data(surface, &type_key);
	if (t)
		return t;
	t = g_new0(struct type, 1);
	t->context = context_create(cr);
	if (cairo_surface_set_user_data(surface, &type_key, t, type_destroy) !=
	    CAIRO_STATUS_SUCCESS) {
		type_destroy(t);
		return NULL;
	}
	return t;
}

/* Bytes that are no text become the mark for such; the end of a very long text is left out. */
static void set_text(PangoLayout *l, const char *text)
{
	size_t n = strnlen(text, TEXT_MAX);
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

static PangoLayout *layout_create(PangoContext *context, enum label_style style)
{
	PangoLayout *l = pango_layout_new(context);
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
	pango_layout_set_single_paragraph_mode(l, TRUE);
	return l;
}

static void slot_fill(struct type *t, struct slot *s, const struct slot *wanted)
{
	const float leading = 1.25F;
	PangoLayout *l = layout_create(t->context, wanted->style);
	pango_layout_set_width(l, wanted->width);
	pango_layout_set_ellipsize(l, wanted->cut);
	if (wanted->lines) {
		pango_layout_set_wrap(l, PANGO_WRAP_WORD_CHAR);
		pango_layout_set_line_spacing(l, leading);
		pango_layout_set_height(l, wanted->lines > 0 ? -wanted->lines : -TEXT_MAX);
	}
	set_text(l, wanted->text);
	slot_clear(s);
	*s = *wanted;
	s->text = g_strdup(wanted->text);
	s->layout = l;
}

static unsigned hash(const struct slot *s)
{
	unsigned h = 2166136261U; /* FNV-1a */
	for (const char *c = s->text; *c; c++)
		h = (h ^ (unsigned char)*c) * 16777619U;
	h = (h ^ (unsigned)s->style) * 16777619U;
	h = (h ^ (unsigned)s->width) * 16777619U;
	return (h ^ (unsigned)(s->lines + 1)) * 16777619U;
}

/* Telling it of a matrix makes Pango lay out everything anew, so it is told of changes only. */
static void update_context(cairo_t *cr, struct type *t)
{
	cairo_matrix_t m;
	cairo_get_matrix(cr, &m);
	if (m.xx == t->matrix.xx && m.xy == t->matrix.xy && m.yx == t->matrix.yx &&
	    m.yy == t->matrix.yy)
		return;
	pango_cairo_update_context(cr, t->context);
	t->matrix = m;
}

/* Borrowed, until the next call; NULL on a context that could not be made. */
static PangoLayout *layout(cairo_t *cr, const struct slot *wanted)
{
	struct type *t = type_of(cr);
	if (!t)
		return NULL;
	const unsigned h = hash(wanted);
	struct slot *s = &t->slots[(h ^ h >> 16) % SLOTS];
	update_context(cr, t);
	if (!s->layout || s->style != wanted->style || s->width != wanted->width ||
	    s->lines != wanted->lines || s->cut != wanted->cut ||
	    strcmp(s->text, wanted->text) != 0)
		slot_fill(t, s, wanted);
	return s->layout;
}

static PangoLayout *line(cairo_t *cr, enum label_style style, const char *text)
{
	const struct slot wanted = { .text = (char *)(text ? text : ""),
		                     .style = style,
		                     .width = -1 };
	return layout(cr, &wanted);
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
	PangoLayout *l = line(cr, style, text);
	return l ? width_of(l) : 0;
}

void label_draw(cairo_t *cr, enum label_style style, struct rgb color, double x, double y,
                double align, const char *text)
{
	PangoLayout *l = line(cr, style, text);
	if (l)
		show(cr, l, color, x - (align > 0 ? align * width_of(l) : 0), y);
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
	PangoLayout *l = line(cr, style, text);
	if (!l || !text)
		return 0;
	if (width_of(l) > room + hair) {
		const struct slot shorter = { .text = (char *)text,
			                      .style = style,
			                      .width = room > 0 ? (int)(room * PANGO_SCALE) : 0,
			                      .cut = cut == LABEL_CUT_MIDDLE
			                                     ? PANGO_ELLIPSIZE_MIDDLE
			                                     : PANGO_ELLIPSIZE_END };
		count_cut(cr);
		l = layout(cr, &shorter);
	}
	const double width = width_of(l);
	if (width > room + hair)
		return 0;
	show(cr, l, color, x - align * width, y);
	return width;
}

static PangoLayout *wrapped(cairo_t *cr, enum label_style style, double width, int max_lines,
                            const char *text)
{
	const struct slot wanted = { .text = (char *)(text ? text : ""),
		                     .style = style,
		                     .width = (int)(fmax(width, 1) * PANGO_SCALE),
		                     .lines = max_lines > 0 ? max_lines : -1,
		                     .cut = max_lines > 0 ? PANGO_ELLIPSIZE_END
		                                          : PANGO_ELLIPSIZE_NONE };
	return layout(cr, &wanted);
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
	return l ? height_of(l) : 0;
}

double label_wrap(cairo_t *cr, enum label_style style, struct rgb color, double x, double y,
                  double width, int max_lines, const char *text)
{
	PangoLayout *l = wrapped(cr, style, width, max_lines, text);
	if (!l)
		return 0;
	if (pango_layout_is_ellipsized(l))
		count_cut(cr);
	show(cr, l, color, x, y + (double)pango_layout_get_baseline(l) / PANGO_SCALE);
	return height_of(l);
}

double label_caret(cairo_t *cr, enum label_style style, const char *text, int at)
{
	PangoLayout *l = line(cr, style, text);
	PangoRectangle place;
	if (!l)
		return 0;
	int n = (int)strlen(pango_layout_get_text(l));
	pango_layout_index_to_pos(l, at < 0 ? 0 : at < n ? at : n, &place);
	return (double)place.x / PANGO_SCALE;
}

int label_cuts(cairo_t *cr)
{
	struct type *t = cairo_surface_get_user_data(cairo_get_target(cr), &type_key);
	return t ? t->cuts : 0;
}
