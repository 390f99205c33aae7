/* job.c - what is known of one job, in the panel below the menu. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "job_text.h"
#include "paint.h"

enum { HEAD = 46, ROW = 24, VALUES = 112, ROWS_MAX = 24 };

struct facts {
	const char *name[ROWS_MAX];
	char value[ROWS_MAX][JOB_TEXT];
	int n;
};

static char *fact(struct facts *f, const char *name)
{
	static const size_t last = ROWS_MAX - 1;
	size_t at = (size_t)f->n < last ? (size_t)f->n++ : last;
	f->name[at] = name;
	return f->value[at];
}

static void times(struct facts *f, const struct Stats *s)
{
	char text[JOB_TEXT], stood[JOB_TEXT];
	job_clock(text, s->started);
	if (text[0])
		snprintf(fact(f, "Started"), JOB_TEXT, "%.64s", text);
	job_time(text, s->wall_s);
	job_time(stood, s->suspended_s);
	if (text[0])
		snprintf(fact(f, "Ran"), JOB_TEXT, "%.64s%s%.64s", text,
		         stood[0] ? ", suspended " : "", stood);
	job_time(text, s->cpu_s);
	if (text[0] && s->threads > 0)
		snprintf(fact(f, "CPU"), JOB_TEXT, "%.64s on %d thread%s", text, s->threads,
		         s->threads == 1 ? "" : "s");
	else if (text[0])
		snprintf(fact(f, "CPU"), JOB_TEXT, "%.64s", text);
	if (s->peak_kib >= 0)
		snprintf(fact(f, "Memory"), JOB_TEXT, "%.0f MiB at most",
		         ceil((double)s->peak_kib / 1024));
}

static void parameters(struct facts *f, const struct Stats *s)
{
	const char *name;
	json_t *value;
	json_object_foreach(s->parameters, name, value) if (json_is_string(value) && f->n < 12)
	        snprintf(fact(f, name), JOB_TEXT, "%.500s", json_string_value(value));
}

void panel_job(cairo_t *cr, const struct layout *l, const struct Stats *s, const struct look *k)
{
	const struct paint p = { cr, k, NULL };
	const struct box_px *b = &l->form;
	const double x = b->x + PAINT_PADDING, right = b->x + b->width - PAINT_PADDING;
	const bool known = (unsigned)s->state < N_JOB_STATES;
	struct facts f = { .n = 0 };
	char title[48];
	if (b->height < HEAD)
		return;
	snprintf(title, sizeof title, "Job %lld", (long long)s->id);
	snprintf(fact(&f, "State"), JOB_TEXT, "%s", known ? job_state_table[s->state].word : "");
	snprintf(fact(&f, "Input"), JOB_TEXT, "%.500s", job_file(s));
	if (s->reason && s->reason[0])
		snprintf(fact(&f, "Reason"), JOB_TEXT, "%.500s", s->reason);
	if (s->on)
		snprintf(fact(&f, "Runs on"), JOB_TEXT, "%.200s", s->host ? s->host : s->on);
	parameters(&f, s);
	times(&f, s);

	paint_rule(&p, x, b->y, right - x);
	const double name = paint_text(&p, LABEL_SECTION, TOKEN_TEXT, x, b->y + 22, 0, title);
	paint_cut(&p, LABEL_NOTE, TOKEN_MUTED, right, b->y + 22, 1, right - x - name - 12,
	          s->worker);
	double y = b->y + HEAD;
	for (int i = 0; i < f.n && y + ROW / 2.0 <= b->y + b->height; i++, y += ROW) {
		double value = x + VALUES;
		paint_cut(&p, LABEL_FORM, TOKEN_TEXT2, x, y, 0, VALUES - 8, f.name[i]);
		if (i == 0 && known) {
			glyph_draw(&p, s->state, value + 6, y, 5);
			label_draw(cr, LABEL_NAME, glyph_color(&p, s->state), value + 18,
			           label_baseline(LABEL_NAME, y), 0, f.value[i]);
			continue;
		}
		/* a reason has as many lines as it needs, up to six */
		const bool reason = !strcmp(f.name[i], "Reason");
		if (reason) {
			const double half = ROW / 2.0 - 3;
			y += fmax(label_wrap(cr, LABEL_FORM, paint_color(&p, TOKEN_TEXT), value,
			                     y - half, right - value, 6, f.value[i]) -
			                  2 * half,
			          0);
		} else {
			paint_cut(&p, LABEL_FORM, TOKEN_TEXT, value, y, 0, right - value,
			          f.value[i]);
		}
	}
}
