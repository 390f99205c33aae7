/* keys.c - the sheet of all keys, in columns as wide as what stands in them. */
#include <math.h>
#include <string.h>

#include "paint.h"

enum {
	ROW = 26,
	HEAD = 64,
	EDGE = 24,
	GAP = 32,
	COLUMNS_MAX = 4,
	ROWS_MAX = 16,
	KEY_TEXT = 40,
	COLUMN = 300
};

struct column {
	double caps, text; /* widths */
};

/* Keys stand in the text with two blanks between; returns the width of all. draw: at x. */
static double paint_keys(const struct paint *p, const char *keys, bool draw, double x,
                         double middle)
{
	double at = 0;
	while (keys && *keys) {
		char one[KEY_TEXT] = "";
		const char *next = strstr(keys, "  ");
		const size_t n = next ? (size_t)(next - keys) : strlen(keys);
		size_t kept = n < sizeof one ? n : sizeof one - 1;
		while (kept < n && kept && (keys[kept] & 0xC0) == 0x80)
			kept--; /* no half of a character */
		memcpy(one, keys, kept);
		at += at > 0 ? 4 : 0;
		if (draw)
			paint_cap(p, x + at, middle, 0, one);
		at += paint_cap_width(p, one);
		keys += next ? n + 2 : n;
	}
	return at;
}

/* Columns and rows that are shown. */
struct sheet {
	int columns, rows;
};

static struct sheet place(const struct box_px *b, const struct keys_model *m)
{
	const double room = b->width - 4 * EDGE;
	const int high = (int)fmax(floor((b->height - 32 - HEAD - 16) / ROW), 1);
	const int fit = high < ROWS_MAX ? high : ROWS_MAX;
	const int wide = (int)fmax(floor(room / COLUMN), 1);
	const int most = wide < COLUMNS_MAX ? wide : COLUMNS_MAX;
	struct sheet s = { .columns = (m->n + fit - 1) / fit };

	s.columns = s.columns < 1 ? 1 : s.columns > most ? most : s.columns;
	/* no more columns than needed, and all as long */
	s.rows = (m->n + s.columns - 1) / s.columns;
	s.rows = s.rows < 1 ? 1 : s.rows > fit ? fit : s.rows;
	return s;
}

int panel_keys_rows(const struct box_px *b, const struct keys_model *m)
{
	const struct sheet s = place(b, m);

	return s.columns * s.rows;
}

/* Of rows from first on. */
static void measure(const struct paint *p, const struct keys_model *m, int first, struct sheet s,
                    struct column c[COLUMNS_MAX])
{
	memset(c, 0, COLUMNS_MAX * sizeof *c);
	for (int i = 0; first + i < m->n && i < s.rows * s.columns; i++) {
		const struct key_row *r = &m->rows[first + i];
		struct column *k = &c[i / s.rows];
		k->caps = fmax(k->caps, paint_keys(p, r->key, false, 0, 0));
		if (r->does)
			k->text = fmax(k->text, paint_width(p, LABEL_FORM, r->does));
	}
}

/* The widths of all columns; where that is more than there is room for, texts are cut alike. */
static double arrange(struct column *c, int columns, double room)
{
	double caps = (columns - 1) * GAP, texts = 0;
	for (int k = 0; k < columns; k++) {
		caps += c[k].caps + 12;
		texts += c[k].text;
	}
	const double share = texts > 0 ? fmin(fmax(room - caps, 0) / texts, 1) : 1;
	for (int k = 0; k < columns; k++)
		c[k].text *= share;
	return caps + texts * share;
}

void panel_keys(cairo_t *cr, const struct box_px *b, const struct keys_model *m,
                const struct look *k)
{
	const struct paint p = { cr, k, NULL };
	const double room = b->width - 4 * EDGE;
	struct column c[COLUMNS_MAX];
	if (room < 200)
		return;
	const struct sheet s = place(b, m);
	const int rows = s.rows, shown = s.columns * rows;
	const int last = m->n > shown ? m->n - shown : 0;
	const int first = m->scroll < 0 ? 0 : m->scroll > last ? last : m->scroll;
	measure(&p, m, first, s, c);
	const double width = arrange(c, s.columns, room) + 2 * EDGE,
	             height = HEAD + ROW * rows + 16;
	const double x = b->x + (b->width - width) / 2;
	const double y = b->y + fmax((b->height - height) / 2, 8);

	paint_dim(&p, b->x, b->y, b->width, b->height);
	paint_card(&p, x, y, width, height, 10);
	paint_text(&p, LABEL_TITLE, TOKEN_TEXT, x + EDGE, y + 32, 0, "Keys");
	paint_cap(&p, x + width - EDGE, y + 32, 1, "Esc");
	if (last)
		paint_scroll(&p, x + width - 6, y + HEAD, ROW * rows, first, shown, m->n, 0);
	double left = x + EDGE;
	for (int i = 0; first + i < m->n && i < shown; i++) {
		const struct key_row *r = &m->rows[first + i];
		const struct column *now = &c[i / rows];
		const double middle = y + HEAD + ROW * (i % rows + 0.5);
		if (i && i % rows == 0)
			left += c[i / rows - 1].caps + 12 + c[i / rows - 1].text + GAP;
		paint_keys(&p, r->key, true, left, middle);
		paint_cut(&p, LABEL_FORM, r->off ? TOKEN_OFF : TOKEN_TEXT, left + now->caps + 12,
		          middle, 0, ceil(now->text) + 1, r->does);
	}
}
