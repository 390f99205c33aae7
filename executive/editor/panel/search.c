/* search.c - all routines by name, code or help. */
#include <math.h>
#include <stdio.h>

#include "paint.h"

enum { WIDTH = 640, HEAD = 56, ROW = 44, FOOT = 40, TOP = 112, EDGE = 24, RESULTS = 8 };

static void paint_result(const struct paint *p, const struct search_model *m, int i, double x,
                         double y, double width)
{
	const struct search_result *r = &m->results[i];
	const bool chosen = i == m->chosen;
	const enum token name = r->greyed ? TOKEN_OFF : TOKEN_TEXT;
	const enum token note = r->greyed ? TOKEN_OFF : chosen ? TOKEN_TEXT2 : TOKEN_MUTED;
	double right = x + width - EDGE;
	if (chosen || paint_hot(p, HIT_RESULT, i, 0))
		paint_fill(p, x + 8, y, width - 16, ROW, 6, chosen ? TOKEN_TINT : TOKEN_HOVER);
	/* codes and kinds stand in columns */
	paint_cut(p, LABEL_CAP, r->greyed ? TOKEN_OFF : TOKEN_TEXT2, right, y + 22, 1, 40, r->code);
	right -= 44;
	right -= paint_cut(p, LABEL_NOTE, note, right, y + 22, 1, width / 4, r->kind) + 12;
	paint_found(p, LABEL_ENTRY, name, x + EDGE, y + 15, right - x - EDGE, r->name, m->typed);
	paint_cut(p, LABEL_NOTE, note, x + EDGE, y + 32, 0, right - x - EDGE, r->path);
	paint_hit(p, HIT_RESULT, i, 0, x + 8, y, width - 16, ROW);
}

static void paint_hints(const struct paint *p, double x, double middle, double room)
{
	static const struct {
		const char *key, *word;
	} hints[] = { { "↑ ↓", "choose" },
		      { "Enter", "run" },
		      { "F1", "help" },
		      { "Tab", "go to its menu" },
		      { "Esc", "close" } };
	const double end = x + room;
	for (size_t i = 0; i < sizeof hints / sizeof *hints; i++) {
		if (x + paint_hint_width(p, hints[i].key, hints[i].word) > end)
			return;
		x += paint_hint(p, x, middle, hints[i].key, hints[i].word) + 18;
	}
}

void panel_search(cairo_t *cr, double width, double height, const struct search_model *m,
                  const struct look *k, struct hits *h)
{
	const struct paint p = { cr, k, h };
	const int n = m->n < 0 ? 0 : m->n < RESULTS ? m->n : RESULTS;
	const double wide = fmin(WIDTH, width - 2 * EDGE);
	const int none = m->found <= 0 || !n;
	const double tall = HEAD + 16 + ROW * (n + none) + FOOT;
	const double x = floor((width - wide) / 2), y = fmax(fmin(TOP, height - EDGE - tall), EDGE);
	char found[64];
	if (wide < 200)
		return;
	paint_dim(&p, 0, 0, width, height);
	paint_card(&p, x, y, wide, tall, 10);
	paint_lens(&p, x + 27, y + 27, 5.5);
	snprintf(found, sizeof found, "%d of %d routines", m->found, m->all);
	const double count =
	        paint_text(&p, LABEL_FORM, TOKEN_MUTED, x + wide - 20, y + 28, 1, found);
	paint_typed(&p, LABEL_TYPED, x + 48, y + 28, wide - 48 - count - 36, m->typed, m->caret,
	            true);
	paint_rule(&p, x + 1, y + HEAD, wide - 2);
	for (int i = 0; i < n; i++)
		paint_result(&p, m, i, x, y + HEAD + 8 + ROW * (i + none), wide);
	if (none)
		paint_cut(&p, LABEL_ENTRY, TOKEN_MUTED, x + EDGE, y + HEAD + 8 + ROW / 2.0, 0,
		          wide - 2 * EDGE,
		          m->typed && m->typed[0] ? "No routine has that in its name or help"
		                                  : "Type a name, a code, or what it is about");
	paint_rule(&p, x + 1, y + tall - FOOT, wide - 2);
	paint_hints(&p, x + EDGE, y + tall - FOOT / 2.0, wide - 2 * EDGE);
}
