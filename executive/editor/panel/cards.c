/* cards.c - over the view: its heading, and what is known of the place under the mouse. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "paint.h"
#include "ticks.h"

enum { ROW = 19, ROWS_MAX = 6, HEAD = 36, CARD = 240, INSET = 12, VALUE = 160 };

/* Letters keep their contrast where geometry lies below. */
void paint_plate(const struct paint *p, double x, double y, double width, double height)
{
	paint_round(p, x, y, width, height, 6);
	paint_set(p, TOKEN_VIEW, 0.8);
	cairo_fill(p->cr);
}

void panel_heading(cairo_t *cr, const struct box_px *view, const char *title, const char *note,
                   bool strong, const struct look *k)
{
	const struct paint p = { cr, k, NULL };
	const double x = view->x + PAINT_PADDING, y = view->y + 24;
	const double room = view->width - 2 * PAINT_PADDING;
	const bool noted = note && note[0];
	double width = paint_width(&p, LABEL_HEADING, title);
	if (noted)
		width = fmax(width, paint_width(&p, LABEL_NOTE, note));
	paint_plate(&p, x - 8, y - 12, fmin(width, room) + 16, noted ? 42 : 24);
	paint_cut(&p, LABEL_HEADING, strong ? TOKEN_TEXT : TOKEN_MUTED, x, y, 0, room, title);
	if (noted)
		paint_cut(&p, LABEL_NOTE, TOKEN_MUTED, x, y + 18, 0, room, note);
}

struct probe_row {
	const char *name;
	char value[VALUE];
	int line; /* of a circle: 1 solid, 2 dashed */
};

static void number(char out[TICK_TEXT], double x, int decimals)
{
	const double size = fabs(x);
	if (!isfinite(x)) {
		snprintf(out, TICK_TEXT, "–");
	} else if (size >= 1e6 || (size > 0 && size < 1e-3)) {
		number_for_reader(out, x, 4);
	} else {
		char plain[TICK_TEXT - 8];
		snprintf(plain, sizeof plain, "%.*f", decimals, size);
		snprintf(out, TICK_TEXT, "%s%s", x < 0 && size > 0 ? "−" : "", plain);
	}
}

static void three(struct probe_row *r, const char *name, const double x[3])
{
	char text[3][TICK_TEXT];
	for (int i = 0; i < 3; i++)
		number(text[i], x[i], 4);
	r->name = name;
	snprintf(r->value, VALUE, "%.40s  %.40s  %.40s", text[0], text[1], text[2]);
}

static void one(struct probe_row *r, const char *name, double x, const char *unit,
                const char *power)
{
	char text[TICK_TEXT];
	number(text, x, 4);
	r->name = name;
	if (unit)
		snprintf(r->value, VALUE, "%s 1/%.16s%s", text, unit, power);
	else
		snprintf(r->value, VALUE, "%s", text);
}

static void circle(struct probe_row *r, const char *name, double curvature, const char *unit,
                   int line)
{
	char k[TICK_TEXT], radius[TICK_TEXT];
	one(r, name, curvature, unit, "");
	r->line = line;
	if (curvature == 0 || !isfinite(1 / curvature))
		return;
	number(radius, 1 / curvature, 3);
	snprintf(k, sizeof k, "%.46s", r->value);
	snprintf(r->value, VALUE, "%s    R %s%s%.16s", k, radius, unit ? " " : "",
	         unit ? unit : "");
}

static int describe(struct probe_row rows[ROWS_MAX], const struct probe_model *m)
{
	int n = 0;
	memset(rows, 0, ROWS_MAX * sizeof *rows);
	three(&rows[n++], "point", m->point);
	if (!m->has_uv)
		return n;
	three(&rows[n++], "normal", m->normal);
	one(&rows[n++], "K", m->K, m->unit, "²");
	one(&rows[n++], "H", m->H, m->unit, "");
	circle(&rows[n++], "k max", m->kmax, m->unit, 1);
	circle(&rows[n++], "k min", m->kmin, m->unit, 2);
	return n;
}

static void paint_probe_row(const struct paint *p, const struct probe_row *r, double x, double y,
                            double width)
{
	static const double dash[] = { 3, 3 };
	double name = x + INSET;
	if (r->line) {
		cairo_set_dash(p->cr, dash, r->line == 2 ? 2 : 0, 0);
		paint_line(p, name + 1, y, name + 13, y, 1.75, TOKEN_TEXT);
		cairo_set_dash(p->cr, NULL, 0, 0);
		name += 20;
	}
	paint_text(p, LABEL_NOTE, TOKEN_MUTED, name, y, 0, r->name);
	paint_text(p, LABEL_NOTE, TOKEN_TEXT, x + width - INSET, y, 1, r->value);
}

void panel_probe(cairo_t *cr, const struct box_px *view, double x, double y,
                 const struct probe_model *m, const struct look *k)
{
	const struct paint p = { cr, k, NULL };
	struct probe_row rows[ROWS_MAX];
	char uv[2 * TICK_TEXT + 16] = "", u[TICK_TEXT], v[TICK_TEXT];
	const int n = describe(rows, m);
	double width = CARD;
	for (int i = 0; i < n; i++)
		width = fmax(width, 2 * INSET + 66 + paint_width(&p, LABEL_NOTE, rows[i].value));
	if (m->has_uv) {
		number(u, m->u, 4);
		number(v, m->v, 4);
		snprintf(uv, sizeof uv, "u %s   v %s", u, v);
	}
	const double height = HEAD + ROW * n + 36, edge = 8;
	const double right = view->x + view->width - edge, below = view->y + view->height - edge;
	double left = x + 36, top = y + 30;
	if (left + width > right)
		left = x - 36 - width;
	if (top + height > below)
		top = y - 30 - height;
	left = fmax(fmin(left, right - width), view->x + edge);
	top = fmax(fmin(top, below - height), view->y + edge);

	paint_card(&p, left, top, width, height, 8);
	double head =
	        paint_text(&p, LABEL_NOTE, TOKEN_TEXT2, left + width - INSET, top + 18, 1, uv);
	paint_cut(&p, LABEL_SECTION, TOKEN_TEXT, left + INSET, top + 18, 0,
	          width - 2 * INSET - head - 12, m->title);
	paint_rule(&p, left + INSET, top + 32, width - 2 * INSET);
	for (int i = 0; i < n; i++)
		paint_probe_row(&p, &rows[i], left, top + 47 + ROW * i, width);
	paint_text(&p, LABEL_NOTE, TOKEN_MUTED, left + INSET, top + height - 15, 0,
	           m->kept ? "kept" : "click keeps this mark");
}
