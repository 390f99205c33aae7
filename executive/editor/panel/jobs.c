/* jobs.c - the list of jobs: tabs, table, what can be done with those picked, and a log's end. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "job_text.h"
#include "jobs_log.h"
#include "paint.h"

enum { HEAD = 56, COLUMNS = 28, ROW = 28, GAP = 8, ACTIONS = 44, TABS = 4, N_ACTIONS = 5 };

/* Where columns begin; numbers end there. */
struct columns {
	double id, state, worker, file, file_room, bar, bar_room, percent, left, says, right;
};

static void place_columns(struct columns *c, const struct box_px *b)
{
	const double x = b->x + PAINT_PADDING;
	const bool wide = b->width >= 880;
	const double spare = fmax(b->width - 960, 0);
	c->id = x + 32;
	c->state = x + 64;
	c->worker = x + 172;
	c->file = x + 272;
	c->file_room = wide ? 116 + spare / 4 : 104;
	c->bar = c->file + c->file_room + 8;
	c->bar_room = wide ? 120 : 0;
	c->percent = c->bar + c->bar_room + 44;
	c->left = c->percent + 52;
	c->says = c->left + 24;
	c->right = b->x + b->width - PAINT_PADDING;
}

static double log_height(const struct box_px *b)
{
	return fmin(fmax(round(0.35 * b->height), 110), 340);
}

int panel_jobs_rows(const struct box_px *b)
{
	const double room = b->height - HEAD - COLUMNS - GAP - ACTIONS - log_height(b);
	return room < ROW ? 1 : (int)(room / ROW);
}

static void paint_tabs(const struct paint *p, const struct box_px *b, const struct jobs_model *m)
{
	static const char *const names[TABS] = { "All", "Active", "Waiting", "Ended" };
	const double middle = b->y + 28;
	double x = b->x + PAINT_PADDING;
	x += paint_text(p, LABEL_TITLE, TOKEN_TEXT, x, middle, 0, "Jobs") + 22;
	for (int i = 0; i < TABS; i++) {
		char count[16];
		snprintf(count, sizeof count, "%d", m->count[i]);
		const double name = paint_width(p, LABEL_NAME, names[i]);
		const double width = name + paint_width(p, LABEL_FORM, count) + 30;
		const bool chosen = m->tab == i;
		if (chosen || paint_hot(p, HIT_TAB, i, 0))
			paint_fill(p, x, middle - 13, width, 26, 6, TOKEN_HOVER);
		if (chosen && !paint_is_dark(p))
			paint_border(p, x, middle - 13, width, 26, 6, 1, TOKEN_LINE);
		paint_text(p, LABEL_NAME, chosen ? TOKEN_TEXT : TOKEN_TEXT2, x + 12, middle, 0,
		           names[i]);
		paint_text(p, LABEL_FORM, TOKEN_MUTED, x + 18 + name, middle, 0, count);
		if (paint_focused(p, HIT_TAB, i, 0))
			paint_ring(p, x - 2, middle - 15, width + 4, 30, 8);
		paint_hit(p, HIT_TAB, i, 0, x, middle - 13, width, 26);
		x += width + 4;
	}
	const double right = b->x + b->width - PAINT_PADDING;
	paint_cut(p, LABEL_FORM, TOKEN_MUTED, right, middle, 1, right - x - 12, m->slots);
}

static void paint_box(const struct paint *p, double x, double middle, bool picked, bool hot)
{
	if (picked) {
		paint_fill(p, x, middle - 7, 14, 14, 3, TOKEN_ACCENT);
		paint_check(p, x + 7, middle, 7.5, TOKEN_ONACCENT);
	} else {
		paint_fill(p, x, middle - 7, 14, 14, 3, TOKEN_FIELD);
		paint_border(p, x, middle - 7, 14, 14, 3, hot ? 1.5 : 1,
		             hot ? TOKEN_TEXT2 : TOKEN_EDGE);
	}
}

static void paint_heads(const struct paint *p, const struct columns *c, const struct box_px *b,
                        double y, bool all)
{
	const struct {
		double x, align;
		const char *text;
	} heads[] = {
		{ c->id, 0, "Id" },
		{ c->state, 0, "State" },
		{ c->worker, 0, "Worker" },
		{ c->file, 0, "File" },
		{ c->bar_room > 0 ? c->bar : c->percent, c->bar_room > 0 ? 0 : 1,
		  c->bar_room > 0 ? "Progress" : "Done" },
		{ c->left, 1, "Left" },
		{ c->says, 0, "Reason or result" },
	};
	const double box = b->x + PAINT_PADDING + 4;
	paint_box(p, box, y + 12, all, paint_hot(p, HIT_JOB_BOX, -1, 0));
	paint_hit(p, HIT_JOB_BOX, -1, 0, box - 6, y, 26, COLUMNS - 4);
	for (size_t i = 0; i < sizeof heads / sizeof *heads; i++)
		paint_text(p, LABEL_CAP, TOKEN_MUTED, heads[i].x, y + 12, heads[i].align,
		           heads[i].text);
	paint_rule(p, b->x + PAINT_PADDING, y + 25, b->width - 2 * PAINT_PADDING);
}

static void paint_progress(const struct paint *p, const struct columns *c, const struct Stats *s,
                           double middle)
{
	const double fraction = stats_fraction(s);
	char text[JOB_TEXT];
	if (s->state == JOB_QUEUED || s->state == JOB_HELD || isnan(fraction))
		return;
	if (c->bar_room > 0)
		paint_bar(p, c->bar, middle - 2, c->bar_room, fraction, glyph_color(p, s->state));
	snprintf(text, sizeof text, "%.0f %%", floor(100 * fraction));
	paint_text(p, LABEL_FORM, TOKEN_TEXT2, c->percent, middle, 1, text);
	if (!job_state_table[s->state].over) {
		job_time(text, s->eta_s);
		paint_text(p, LABEL_FORM, TOKEN_TEXT, c->left, middle, 1, text);
	}
}

static void paint_job(const struct paint *p, const struct columns *c, const struct box_px *b,
                      const struct jobs_model *m, int i, double y)
{
	const struct Stats *s = m->jobs[i];
	const double middle = y + ROW / 2.0, box = b->x + PAINT_PADDING + 4;
	const bool picked = m->picked && m->picked[i];
	const bool known = (unsigned)s->state < N_JOB_STATES;
	char text[JOB_TEXT];
	if (picked || paint_hot(p, HIT_JOB_ROW, i, 0))
		paint_fill(p, b->x + 8, y + 1, b->width - 16, ROW - 2, 6,
		           picked ? TOKEN_TINT : TOKEN_HOVER);
	if (i == m->focus)
		paint_border(p, b->x + 8, y + 1, b->width - 16, ROW - 2, 6, 1.5, TOKEN_ACCENT);
	paint_hit(p, HIT_JOB_ROW, i, 0, b->x + 8, y, b->width - 16, ROW);
	paint_box(p, box, middle, picked, paint_hot(p, HIT_JOB_BOX, i, 0));
	paint_hit(p, HIT_JOB_BOX, i, 0, box - 6, y, 26, ROW);

	snprintf(text, sizeof text, "%lld", (long long)s->id);
	paint_cut(p, LABEL_NAME, TOKEN_TEXT2, c->id, middle, 0, c->state - c->id - 4, text);
	if (known) {
		glyph_draw(p, s->state, c->state + 6, middle, 5.5);
		label_draw(p->cr, LABEL_NAME, glyph_color(p, s->state), c->state + 20,
		           label_baseline(LABEL_NAME, middle), 0, job_state_table[s->state].word);
	}
	paint_cut(p, LABEL_NAME, TOKEN_TEXT, c->worker, middle, 0, c->file - c->worker - 8,
	          s->worker);
	paint_path(p, LABEL_FORM, TOKEN_TEXT2, c->file, middle, c->file_room - 8, job_file(s));
	if (known)
		paint_progress(p, c, s, middle);
	job_says(text, s, m->now);
	paint_cut(p, LABEL_FORM,
	          s->state == JOB_FAILED || s->state == JOB_LOST ? TOKEN_TEXT : TOKEN_TEXT2,
	          c->says, middle, 0, c->right - c->says, text);
}

static void paint_actions(const struct paint *p, const struct box_px *b, const struct jobs_model *m,
                          double y)
{
	static const struct {
		const char *text, *key;
	} actions[N_ACTIONS] = { { "Suspend", "S" },
		                 { "Activate", "A" },
		                 { "Kill", "K" },
		                 { "Retry", "R" },
		                 { "Open result", "O" } };
	const double middle = y + ACTIONS / 2.0, right = b->x + b->width - PAINT_PADDING;
	static const char hint[] = "each acts on those it applies to";
	int picked = 0;
	char text[32];
	for (int i = 0; m->picked && i < m->n; i++)
		picked += m->picked[i];
	snprintf(text, sizeof text, "%d selected", picked);
	paint_rule(p, b->x, y, b->width);
	double x = b->x + PAINT_PADDING;
	x += fmax(paint_text(p, LABEL_SECTION, TOKEN_TEXT, x, middle, 0, text) + 16, 88);
	for (int i = 0; i < N_ACTIONS; i++) {
		const struct button button = { .text = actions[i].text,
			                       .key = actions[i].key,
			                       .off = !m->can[i],
			                       .kind = HIT_BUTTON,
			                       .index = i,
			                       .part = GROUP_JOBS };
		x += paint_button(p, x, middle - PAINT_BUTTON / 2.0, &button) + 8;
	}
	if (right - x > paint_width(p, LABEL_NOTE, hint) + 8)
		paint_text(p, LABEL_NOTE, TOKEN_MUTED, right, middle, 1, hint);
}

static const char *nothing(const struct jobs_model *m)
{
	static const char *const none[TABS] = {
		"No jobs. Long computations appear here with their progress.",
		"No job is active now.",
		"No job waits.",
		"No job has ended yet.",
	};
	return none[m->count[0] > 0 && m->tab > 0 && m->tab < TABS ? m->tab : 0];
}

void panel_jobs(cairo_t *cr, const struct box_px *b, const struct jobs_model *m,
                const struct look *k, struct hits *h)
{
	const struct paint p = { cr, k, h };
	struct columns c;
	if (b->width <= 0)
		return;
	const int shown = panel_jobs_rows(b), last = m->n > shown ? m->n - shown : 0;
	const int first = m->scroll < 0 ? 0 : m->scroll > last ? last : m->scroll;
	bool all = m->n > 0 && m->picked;
	for (int i = 0; all && i < m->n; i++)
		all = m->picked[i];
	place_columns(&c, b);
	paint_fill(&p, b->x, b->y, b->width, b->height, 0, TOKEN_VIEW);
	paint_hit(&p, HIT_NONE, 0, 0, b->x, b->y, b->width, b->height);
	paint_tabs(&p, b, m);
	double y = b->y + HEAD;
	paint_heads(&p, &c, b, y, all);
	y += COLUMNS;
	if (!m->n)
		paint_cut(&p, LABEL_ENTRY, TOKEN_MUTED, b->x + b->width / 2, y + ROW * shown / 2.0,
		          0.5, b->width - 2 * PAINT_PADDING, nothing(m));
	for (int i = 0; i < shown && first + i < m->n; i++)
		paint_job(&p, &c, b, m, first + i, y + ROW * i);
	paint_scroll(&p, b->x + b->width - 2, y, ROW * shown, first, shown, m->n, GROUP_JOBS);
	const double log = b->y + b->height - log_height(b);
	paint_actions(&p, b, m, log - ACTIONS);
	const struct box_px below = { b->x, log, b->width, b->y + b->height - log };
	paint_log(&p, &below, m);
}
