/* key.c - the key of a color map. */
#include "key.h"

#include <math.h>
#include <stdio.h>

#include "ticks.h"

enum {
	BAR = 14,
	TRIANGLE = 9,
	GAP = 3,
	LINE = 16,
	SPACE = 16,
	HEAD = 42,
	WORDS_MAX = 6,
	WORD_SIZE = 128
};

struct words {
	int n;
	char line[WORDS_MAX][WORD_SIZE];
};

static void say(struct words *w, const char *format, const char *a, const char *b)
{
	snprintf(w->line[w->n++], WORD_SIZE, format, a, b);
}

static void describe(struct words *w, const struct key *k)
{
	const struct colormap *m = &k->map;
	char a[TICK_TEXT], b[TICK_TEXT];
	w->n = 0;
	number_for_reader(a, m->lo, 3);
	number_for_reader(b, m->hi, 3);
	say(w, "%s to %s", a, b);
	if (m->by_hand)
		say(w, "%s%s", "range by hand", "");
	else if (m->one)
		say(w, "%s%s", "same everywhere", "");
	else
		say(w, "%s%s", m->is_signed || m->lo > 0 ? "2 to 98 % of area" : "98 % of area",
		    "");
	if (m->is_signed && m->lo == -m->hi)
		say(w, "%s%s", "symmetric", "");
	number_for_reader(a, m->knee, 3);
	if (m->arsinh)
		say(w, "%s%s", "arsinh, knee at ", a);
	else
		say(w, "%s%s", "linear", "");
}

static void share_text(char out[TICK_TEXT], double share)
{
	if (share < 0.001)
		snprintf(out, TICK_TEXT, "< 0.1 %%");
	else
		snprintf(out, TICK_TEXT, "%.1f %%", 100 * share);
}

double key_height(const struct key *k)
{
	struct words w;
	describe(&w, k);
	return HEAD + 2 * (TRIANGLE + GAP) + k->bar + SPACE + LINE * (w.n + k->nothing);
}

double key_bar_top(void)
{
	return HEAD + TRIANGLE + GAP;
}

double key_width(cairo_t *cr, const struct key *k)
{
	struct words w;
	struct ticks t;
	double width = BAR + 10 + label_width(cr, LABEL_NOTE, "100.0 %");
	describe(&w, k);
	for (int i = 0; i < w.n; i++)
		width = fmax(width, label_width(cr, LABEL_NOTE, w.line[i]));
	ticks_colormap(&t, &k->map, 28 / k->bar);
	for (int i = 0; i < t.n; i++)
		width = fmax(width, BAR + 10 + label_width(cr, LABEL_NOTE, t.text[i]));
	return ceil(width);
}

struct rgb key_hatch(int x, int y)
{
	struct rgb c = colormap_nothing;
	double darker = (x + y) % 6 < 2 ? 0.8 : 1;
	return (struct rgb){ c.r * darker, c.g * darker, c.b * darker };
}

static void set(cairo_t *cr, struct rgb c)
{
	cairo_set_source_rgb(cr, c.r, c.g, c.b);
}

/* Rows end at device pixels, so the colors are the map's own and no seams show at any scale. */
static void draw_bar(cairo_t *cr, const struct key *k, double x, double y)
{
	int rows = (int)k->bar;
	cairo_save(cr);
	cairo_set_antialias(cr, CAIRO_ANTIALIAS_NONE);
	for (int i = 0; i < rows; i++) {
		set(cr, colormap_at(&k->map, 1 - (i + 0.5) / rows));
		cairo_rectangle(cr, x, y + i, BAR, 1);
		cairo_fill(cr);
	}
	cairo_restore(cr);
}

/* Colors beyond an end, with the share of the area that has them. */
static void draw_beyond(cairo_t *cr, const struct key *k, double x, double y, double tip,
                        struct rgb color, double share)
{
	cairo_move_to(cr, x + BAR / 2.0, y + tip);
	cairo_line_to(cr, x + BAR, y);
	cairo_line_to(cr, x, y);
	cairo_close_path(cr);
	set(cr, color);
	cairo_fill_preserve(cr);
	cairo_set_line_width(cr, 1);
	set(cr, theme_color(k->theme, TOKEN_EDGE));
	cairo_stroke(cr);
	if (share > 0) {
		char text[TICK_TEXT];
		share_text(text, share);
		label_draw(cr, LABEL_NOTE, theme_color(k->theme, TOKEN_MUTED), x + BAR + 10,
		           label_baseline(LABEL_NOTE, y + tip + (tip < 0 ? -4 : 4)), 0, text);
	}
}

static void draw_ticks(cairo_t *cr, const struct key *k, double x, double y)
{
	struct ticks t;
	ticks_colormap(&t, &k->map, 28 / k->bar);
	cairo_set_line_width(cr, 1);
	for (int i = 0; i < t.n; i++) {
		double at = y + k->bar * (1 - colormap_position(&k->map, t.value[i]));
		double row = fmin(floor(at), y + k->bar - 1) + 0.5;
		set(cr, theme_color(k->theme, TOKEN_EDGE));
		cairo_move_to(cr, x + BAR, row);
		cairo_line_to(cr, x + BAR + 5, row);
		cairo_stroke(cr);
		label_draw(cr, LABEL_NOTE, theme_color(k->theme, TOKEN_TEXT), x + BAR + 10,
		           label_baseline(LABEL_NOTE, row), 0, t.text[i]);
	}
}

static void draw_nothing(cairo_t *cr, const struct key *k, double x, double baseline)
{
	for (int i = 0; i < BAR; i++)
		for (int j = 0; j < 9; j++) {
			set(cr, key_hatch(i, j));
			cairo_rectangle(cr, x + i, baseline - 8 + j - 0.5, 1, 1);
			cairo_fill(cr);
		}
	label_draw(cr, LABEL_NOTE, theme_color(k->theme, TOKEN_MUTED), x + BAR + 10, baseline, 0,
	           "no value");
}

void key_draw(cairo_t *cr, const struct key *k, double x, double y)
{
	struct words w;
	describe(&w, k);
	label_draw(cr, LABEL_HEADING, theme_color(k->theme, TOKEN_TEXT), x, y + 10, 0, k->symbol);
	if (k->unit)
		label_draw(cr, LABEL_NOTE, theme_color(k->theme, TOKEN_MUTED), x, y + 27, 0,
		           k->unit);
	y += HEAD + TRIANGLE;
	draw_beyond(cr, k, x, y, -TRIANGLE, colormap_above(&k->map), k->above);
	y += GAP;
	draw_bar(cr, k, x, y);
	draw_ticks(cr, k, x, y);
	y += k->bar + GAP;
	draw_beyond(cr, k, x, y, TRIANGLE, colormap_below(&k->map), k->below);
	y += TRIANGLE + SPACE;
	for (int i = 0; i < w.n; i++)
		label_draw(cr, LABEL_NOTE, theme_color(k->theme, TOKEN_MUTED), x, y + LINE * i + 11,
		           0, w.line[i]);
	if (k->nothing)
		draw_nothing(cr, k, x, y + LINE * w.n + 11.5);
}
