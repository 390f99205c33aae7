/* control.c - texts, key caps, buttons, toggles, and lines being typed. */
#include <ctype.h>
#include <math.h>
#include <string.h>
#include <strings.h>

#include "paint.h"

enum { CAP_MAX = 96, BUTTON_TEXT_MAX = 160 };

double paint_width(const struct paint *p, enum label_style style, const char *text)
{
	return label_width(p->cr, style, text);
}

double paint_text(const struct paint *p, enum label_style style, enum token token, double x,
                  double middle, double align, const char *text)
{
	return label_fit(p->cr, style, paint_color(p, token), x, label_baseline(style, middle),
	                 align, INFINITY, LABEL_CUT_END, text);
}

static double fit(const struct paint *p, enum label_style style, enum token token, double x,
                  double middle, double align, double room, enum label_cut cut, const char *text)
{
	const int before = label_cuts(p->cr);
	const double width = label_fit(p->cr, style, paint_color(p, token), x,
	                               label_baseline(style, middle), align, room, cut, text);
	if (label_cuts(p->cr) != before)
		paint_tip(p, x - align * width, middle - label_size(style), width,
		          2 * label_size(style), text);
	return width;
}

double paint_cut(const struct paint *p, enum label_style style, enum token token, double x,
                 double middle, double align, double room, const char *text)
{
	return fit(p, style, token, x, middle, align, room, LABEL_CUT_END, text);
}

double paint_path(const struct paint *p, enum label_style style, enum token token, double x,
                  double middle, double room, const char *text)
{
	return fit(p, style, token, x, middle, 0, room, LABEL_CUT_MIDDLE, text);
}

double paint_cap_width(const struct paint *p, const char *key)
{
	return fmin(fmax(18, paint_width(p, LABEL_CAP, key) + 10), CAP_MAX);
}

double paint_cap(const struct paint *p, double x, double middle, double align, const char *key)
{
	const double width = paint_cap_width(p, key), height = 18;
	x -= width * align;
	paint_fill(p, x, middle - height / 2, width, height, 4, TOKEN_FIELD);
	paint_border(p, x, middle - height / 2, width, height, 4, 1, TOKEN_LINE);
	paint_cut(p, LABEL_CAP, TOKEN_TEXT2, x + width / 2, middle, 0.5, width - 8, key);
	return width;
}

double paint_hint_width(const struct paint *p, const char *key, const char *word)
{
	return paint_cap_width(p, key) + 6 + paint_width(p, LABEL_NOTE, word);
}

double paint_hint(const struct paint *p, double x, double middle, const char *key, const char *word)
{
	double width = paint_cap(p, x, middle, 0, key) + 6;
	return width + paint_text(p, LABEL_NOTE, TOKEN_MUTED, x + width, middle, 0, word);
}

double paint_button_width(const struct paint *p, const struct button *b)
{
	const double text = paint_width(p, b->main ? LABEL_SECTION : LABEL_NAME, b->text);
	return 24 + fmin(text, BUTTON_TEXT_MAX) + (b->key ? paint_cap_width(p, b->key) : 0);
}

double paint_button(const struct paint *p, double x, double y, const struct button *b)
{
	const double width = paint_button_width(p, b), middle = y + PAINT_BUTTON / 2.0;
	const bool hot = !b->off && paint_hot(p, b->kind, b->index, b->part);
	const enum label_style style = b->main ? LABEL_SECTION : LABEL_NAME;
	enum token text = b->off ? TOKEN_OFF : TOKEN_TEXT;

	if (b->main && !b->off) {
		paint_fill(p, x, y, width, PAINT_BUTTON, 6, TOKEN_ACCENT);
		text = TOKEN_ONACCENT;
		if (hot)
			paint_border(p, x + 2, y + 2, width - 4, PAINT_BUTTON - 4, 4, 1,
			             TOKEN_ONACCENT);
	} else {
		paint_raised(p, x, y, width, PAINT_BUTTON, 6);
		if (b->on_card) {
			paint_fill(p, x, y, width, PAINT_BUTTON, 6, TOKEN_FIELD);
			paint_border(p, x, y, width, PAINT_BUTTON, 6, 1, TOKEN_LINE);
		}
		if (hot) {
			paint_fill(p, x, y, width, PAINT_BUTTON, 6, TOKEN_HOVER);
			paint_border(p, x, y, width, PAINT_BUTTON, 6, 1, TOKEN_EDGE);
		}
	}
	paint_cut(p, style, text, x + 12, middle, 0, BUTTON_TEXT_MAX, b->text);
	if (b->key && (b->main || b->off))
		paint_cut(p, LABEL_CAP, text, x + width - 12, middle, 1, CAP_MAX - 10, b->key);
	else if (b->key)
		paint_cap(p, x + width - 7, middle, 1, b->key);
	if (paint_focused(p, b->kind, b->index, b->part))
		paint_ring(p, x - 2, y - 2, width + 4, PAINT_BUTTON + 4, 8);
	if (!b->off)
		paint_hit(p, b->kind, b->index, b->part, x, y, width, PAINT_BUTTON);
	return width;
}

void paint_ring(const struct paint *p, double x, double y, double width, double height,
                double radius)
{
	paint_border(p, x, y, width, height, radius, 1.5, TOKEN_ACCENT);
}

void paint_toggle(const struct paint *p, double x, double middle, bool on)
{
	paint_fill(p, x, middle - 8, 28, 16, 8, on ? TOKEN_ACCENT : TOKEN_EDGE);
	paint_dot(p, on ? x + 20 : x + 8, middle, 6, on ? TOKEN_ONACCENT : TOKEN_BAR);
}

double paint_typed(const struct paint *p, enum label_style style, double x, double middle,
                   double room, const char *text, int caret, bool caret_on)
{
	const double width = paint_width(p, style, text);
	const double at = label_caret(p->cr, style, text, caret);
	const double half = 0.62 * label_size(style), line = 1.5;
	if (!text)
		text = "";
	if (room < 8)
		return x;
	/* the caret needs its own width beside the text */
	double left = width + 2 > room ? fmin(fmax(at - 0.75 * room, 0), width + 2 - room) : 0;
	cairo_save(p->cr);
	if (width + 2 > room) {
		cairo_rectangle(p->cr, x, middle - 2 * half, room, 4 * half);
		cairo_clip(p->cr);
	}
	paint_text(p, style, TOKEN_TEXT, x - left, middle, 0, text);
	cairo_restore(p->cr);
	if (caret_on) {
		paint_set(p, TOKEN_ACCENT, 1);
		cairo_rectangle(p->cr, paint_snap(p, x - left + at + 0.5), middle - half,
		                paint_px(p, line), 2 * half);
		cairo_fill(p->cr);
	}
	return x + fmin(width, room);
}

static const char between[] = " › ";

/* Later steps say more of where one is: earlier ones give way. */
void paint_crumbs(const struct paint *p, double x, double middle, double room, const char *crumbs)
{
	enum { CRUMBS_MAX = 12, CRUMB_SIZE = 128 };
	char step[CRUMBS_MAX][CRUMB_SIZE];
	double width[CRUMBS_MAX], gap = paint_width(p, LABEL_NOTE, "›") + 16, all = 0;
	int n = 0, first = 0;
	for (const char *at = crumbs ? crumbs : ""; n < CRUMBS_MAX && *at; n++) {
		const char *end = strstr(at, between);
		size_t length = end ? (size_t)(end - at) : strlen(at), kept = length;
		if (kept >= CRUMB_SIZE)
			kept = CRUMB_SIZE - 1;
		memcpy(step[n], at, kept);
		step[n][kept] = 0;
		width[n] = paint_width(p, LABEL_NOTE, step[n]);
		all += width[n] + (n ? gap : 0);
		at += end ? length + sizeof between - 1 : length;
	}
	const double dots = paint_width(p, LABEL_NOTE, "…");
	while (first < n - 1 && all > room - (first ? dots + gap : 0))
		all -= width[first++] + gap;
	if (first) {
		paint_text(p, LABEL_NOTE, TOKEN_MUTED, x, middle, 0, "…");
		paint_text(p, LABEL_NOTE, TOKEN_MUTED, x + dots + 8, middle, 0, "›");
		x += dots + gap;
		room -= dots + gap;
	}
	for (int i = first; i < n; i++) {
		bool hot = paint_hot(p, HIT_CRUMB, i, 0);
		double drawn = paint_cut(p, LABEL_NOTE, hot ? TOKEN_TEXT : TOKEN_MUTED, x, middle,
		                         0, room, step[i]);
		paint_hit(p, HIT_CRUMB, i, 0, x - 4, middle - 9, drawn + 8, 18);
		if (paint_focused(p, HIT_CRUMB, i, 0))
			paint_ring(p, x - 4, middle - 9, drawn + 8, 18, 4);
		x += drawn;
		room -= drawn + gap;
		if (i < n - 1)
			paint_text(p, LABEL_NOTE, TOKEN_MUTED, x + 8, middle, 0, "›");
		x += gap;
	}
}

double paint_found(const struct paint *p, enum label_style style, enum token token, double x,
                   double middle, double room, const char *text, const char *found)
{
	enum { PART = 256 };
	const char *at = found && *found ? strcasestr(text, found) : NULL;
	const size_t before = at ? (size_t)(at - text) : 0, length = at ? strlen(found) : 0;
	if (!at || before >= PART || length >= PART || paint_width(p, style, text) > 0.9 * room)
		return paint_cut(p, style, token, x, middle, 0, room, text);
	char part[PART];
	memcpy(part, text, before);
	part[before] = 0;
	double width = before ? paint_text(p, style, token, x, middle, 0, part) : 0;
	memcpy(part, at, length);
	part[length] = 0;
	width += paint_text(p, LABEL_HEADING, token, x + width, middle, 0, part);
	return width + paint_text(p, style, token, x + width, middle, 0, at + length);
}
