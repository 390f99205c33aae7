/* foot.c - the message and the prompt, and what the typed may become. */
#include <math.h>

#include "paint.h"

enum { HINTS = 4, CANDIDATES_MAX = 8, ROW = 28 };

static void paint_level(const struct paint *p, const struct foot_model *m, double x, double middle)
{
	if (m->level == REPORT_ERROR)
		glyph_draw(p, JOB_FAILED, x, middle, 4.5);
	else if (m->level == REPORT_WARNING)
		glyph_warning(p, x, middle, 5);
	else if (m->done)
		glyph_draw(p, JOB_DONE, x, middle, 4.5);
	else
		paint_dot(p, x, middle, 2.5, TOKEN_MUTED);
}

static void paint_message(const struct paint *p, const struct box_px *b, const struct foot_model *m)
{
	const double middle = b->y + 12.5, x = b->x + PAINT_PADDING;
	double right = b->x + b->width - PAINT_PADDING;
	if (!m->message || !m->message[0])
		return;
	/* what happened comes first, the hint has what it leaves */
	const double wanted = paint_width(p, LABEL_FORM, m->message);
	if (m->message_hint && m->message_hint[0])
		right -= paint_cut(p, LABEL_NOTE, TOKEN_MUTED, right, middle, 1,
		                   fmax(right - x - 20 - wanted - 24, (right - x) / 5),
		                   m->message_hint) +
		         24;
	paint_level(p, m, x + 6, middle);
	paint_cut(p, LABEL_FORM, TOKEN_TEXT2, x + 20, middle, 0, right - x - 20, m->message);
}

/* Hints from the right as far as there is room, the last ones first. Gives where they begin. */
static double paint_hints(const struct paint *p, const struct foot_model *m, double left,
                          double right, double middle)
{
	for (int i = HINTS - 1; i >= 0; i--) {
		if (!m->hints[i].key)
			continue;
		const char *word = m->hints[i].word ? m->hints[i].word : "";
		double width = paint_hint_width(p, m->hints[i].key, word);
		if (right - width < left)
			return right;
		paint_hint(p, right - width, middle, m->hints[i].key, word);
		right -= width + 12;
	}
	return right;
}

static void paint_candidates(const struct paint *p, const struct box_px *view, double x,
                             const struct foot_model *m)
{
	const int n = m->n_candidates < CANDIDATES_MAX ? m->n_candidates : CANDIDATES_MAX;
	double width = 356;
	for (int i = 0; i < n; i++) {
		double wide = paint_width(p, LABEL_HEADING, m->candidates[i]) + 44;
		if (m->candidate_notes && m->candidate_notes[i])
			wide += paint_width(p, LABEL_NOTE, m->candidate_notes[i]);
		width = fmax(width, wide);
	}
	width = fmin(width, view->width - 2 * PAINT_PADDING);
	x = fmax(fmin(x - 12, view->x + view->width - PAINT_PADDING - width), view->x + 4);
	const double height = 8 + ROW * n, y = view->y + view->height - 8 - height;
	paint_card(p, x, y, width, height, 8);
	for (int i = 0; i < n; i++) {
		const double top = y + 4 + ROW * i, middle = top + ROW / 2.0;
		double right = x + width - 16;
		const bool chosen = i == m->candidate;
		if (chosen || paint_hot(p, HIT_CANDIDATE, i, 0))
			paint_fill(p, x + 4, top, width - 8, ROW, 5,
			           chosen ? TOKEN_TINT : TOKEN_HOVER);
		if (m->candidate_notes && m->candidate_notes[i] && m->candidate_notes[i][0])
			right -= paint_cut(p, LABEL_NOTE, chosen ? TOKEN_TEXT2 : TOKEN_MUTED, right,
			                   middle, 1, width / 2, m->candidate_notes[i]) +
			         12;
		paint_found(p, LABEL_ENTRY, TOKEN_TEXT, x + 12, middle, right - x - 12,
		            m->candidates[i], m->typed);
		paint_hit(p, HIT_CANDIDATE, i, 0, x + 4, top, width - 8, ROW);
	}
}

void panel_foot(cairo_t *cr, const struct layout *l, const struct foot_model *m,
                const struct look *k, struct hits *h)
{
	const struct paint p = { cr, k, h };
	const struct box_px *b = &l->prompt;
	if (b->width <= 0)
		return;
	paint_fill(&p, b->x, l->message.y, b->width, l->message.height + b->height, 0, TOKEN_BAR);
	paint_rule(&p, b->x, l->message.y, b->width);
	paint_rule(&p, b->x, b->y, b->width);
	paint_message(&p, &l->message, m);

	const double middle = b->y + 18.5, right = b->x + b->width - PAINT_PADDING;
	double x = b->x + PAINT_PADDING;
	x += paint_cut(&p, LABEL_PROMPT, TOKEN_TEXT2, x, middle, 0, b->width / 2, m->prompt) + 8;
	const double typed = x;
	const double rest = m->rest && m->rest[0] ? paint_width(&p, LABEL_PROMPT, m->rest) + 3 : 0;
	const double range =
	        m->range && m->range[0] ? paint_width(&p, LABEL_NOTE, m->range) + 16 : 0;
	const double wanted = paint_width(&p, LABEL_PROMPT, m->typed) + rest + range + 24;
	double end = paint_hints(&p, m, x + wanted, right, middle);
	if (range > 0 && end - x > 2 * range)
		end -= paint_cut(&p, LABEL_NOTE, TOKEN_MUTED, end, middle, 1, range, m->range) + 16;
	x = paint_typed(&p, LABEL_PROMPT, x, middle, end - x, m->typed, m->caret, m->caret_on);
	if (rest > 0)
		paint_cut(&p, LABEL_PROMPT, TOKEN_MUTED, x + 3, middle, 0, end - x - 3, m->rest);
	if (m->n_candidates > 0)
		paint_candidates(&p, &l->view, typed, m);
}
