/* keys.c - the sheet of all keys, in columns. */
#include <math.h>

#include "paint.h"

enum { ROW = 26, HEAD = 64, EDGE = 24, COLUMN = 300 };

/* Columns and rows that are shown. */
struct sheet {
	int columns, rows;
};

static struct sheet place(const struct box_px *b, const struct keys_model *m)
{
	const double room = b->width - 4 * EDGE;
	const int fit = (int)fmax(floor((b->height - 32 - HEAD - 16) / ROW), 1);
	const int most = (int)fmax(floor(room / COLUMN), 1);
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

void panel_keys(cairo_t *cr, const struct box_px *b, const struct keys_model *m,
                const struct look *k)
{
	const struct paint p = { cr, k, NULL };
	const double room = b->width - 4 * EDGE;
	if (room < 200)
		return;
	const struct sheet s = place(b, m);
	const int columns = s.columns, rows = s.rows, shown = columns * rows;
	const int last = m->n > shown ? m->n - shown : 0;
	const int first = m->scroll < 0 ? 0 : m->scroll > last ? last : m->scroll;
	const double column = fmin(room / columns, 400);
	const double width = column * columns + 2 * EDGE, height = HEAD + ROW * rows + 16;
	const double x = b->x + (b->width - width) / 2,
	             y = b->y + fmax((b->height - height) / 2, 8);

	double cap = 0;
	for (int i = 0; i < m->n; i++)
		cap = fmax(cap, paint_cap_width(&p, m->rows[i].key));
	cap = fmin(cap, column / 2);
	paint_card(&p, x, y, width, height, 10);
	paint_text(&p, LABEL_TITLE, TOKEN_TEXT, x + EDGE, y + 32, 0, "Keys");
	paint_cap(&p, x + width - EDGE, y + 32, 1, "Esc");
	if (last)
		paint_scroll(&p, x + width - 6, y + HEAD, ROW * rows, first, shown, m->n, 0);
	for (int i = 0; i < m->n && i < shown; i++) {
		const struct key_row *r = &m->rows[first + i];
		const double left = x + EDGE + column * (i / rows);
		const double middle = y + HEAD + ROW * (i % rows + 0.5);
		if (paint_cap_width(&p, r->key) <= cap)
			paint_cap(&p, left, middle, 0, r->key);
		else
			paint_cut(&p, LABEL_CAP, TOKEN_TEXT2, left, middle, 0, cap, r->key);
		paint_cut(&p, LABEL_FORM, r->off ? TOKEN_OFF : TOKEN_TEXT, left + cap + 12, middle,
		          0, column - cap - 28, r->does);
	}
}
