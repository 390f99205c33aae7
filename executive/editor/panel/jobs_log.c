/* jobs_log.c - the end of a log, its times apart and its warnings and errors in their colors. */
#include "jobs_log.h"

#include <ctype.h>
#include <string.h>

#include "job_text.h"

enum { HEAD = 34, LINE = 19, TIMES = 72 };

/* "14:03:06 text" and "2026-11-22T14:03:06Z text": the length of what is before the text. */
static size_t time_length(const char *line)
{
	static const char pattern[] = "00:00:00";
	const char *at = strchr(line, 'T');
	at = at && at - line == 10 && isdigit((unsigned char)line[0]) ? at + 1 : line;
	size_t n = 0;
	while (n < sizeof pattern - 1 &&
	       (pattern[n] == ':' ? at[n] == ':' : isdigit((unsigned char)at[n]) != 0))
		n++;
	if (n < sizeof pattern - 1)
		return 0;
	n += (size_t)(at - line);
	while (line[n] && line[n] != ' ')
		n++;
	return line[n] ? n : 0;
}

/* The level stands before the sentence: "error: ...", "offset: warning: ...". */
static struct rgb line_color(const struct paint *p, const char *text)
{
	const long near = 24; /* bytes: no further than behind a worker's name */
	const char *error = strstr(text, "error: "), *warning = strstr(text, "warning: ");
	if (error && error - text < near)
		return glyph_color(p, JOB_FAILED);
	if (warning && warning - text < near)
		return glyph_color(p, JOB_SUSPENDED);
	return paint_color(p, TOKEN_TEXT2);
}

static void paint_log_line(const struct paint *p, const struct box_px *b, const char *line,
                           bool times, double middle)
{
	const size_t n = time_length(line);
	double x = b->x + PAINT_PADDING + 4;
	if (n) {
		char time[16];
		const char *colon = memchr(line, ':', n);
		memcpy(time, colon - 2, 8);
		time[8] = 0;
		paint_text(p, LABEL_MONO, TOKEN_MUTED, x, middle, 0, time);
		line += n + 1;
	}
	if (times)
		x += TIMES;
	label_fit(p->cr, LABEL_MONO, line_color(p, line), x, label_baseline(LABEL_MONO, middle), 0,
	          b->x + b->width - PAINT_PADDING - x, LABEL_CUT_END, line);
}

void paint_log(const struct paint *p, const struct box_px *b, const struct jobs_model *m)
{
	const double middle = b->y + 20, right = b->x + b->width - PAINT_PADDING;
	double x = b->x + PAINT_PADDING;
	paint_fill(p, b->x, b->y, b->width, b->height, 0, TOKEN_FIELD);
	paint_rule(p, b->x, b->y, b->width);
	if (!m->log_title || !m->log_title[0]) {
		paint_text(p, LABEL_FORM, TOKEN_MUTED, x, middle, 0,
		           "The end of a job's log appears here.");
		return;
	}
	if (m->focus >= 0 && m->focus < m->n) {
		glyph_draw(p, m->jobs[m->focus]->state, x + 6, middle, 5);
		x += 20;
	}
	const double hint = paint_text(p, LABEL_NOTE, TOKEN_MUTED, right, middle, 1, "L opens all");
	paint_cut(p, LABEL_SECTION, TOKEN_TEXT, x, middle, 0, right - x - hint - 16, m->log_title);

	const int room = (int)((b->height - HEAD - 4) / LINE);
	const int n = m->n_log < room ? m->n_log : room, first = m->n_log - n;
	bool times = false;
	for (int i = first; i < m->n_log; i++)
		times |= time_length(m->log[i]) > 0;
	for (int i = 0; i < n; i++)
		paint_log_line(p, b, m->log[first + i], times, b->y + HEAD + LINE * (i + 0.5));
	const bool over =
	        m->focus >= 0 && m->focus < m->n && job_state_table[m->jobs[m->focus]->state].over;
	if (!m->n_log)
		paint_text(p, LABEL_FORM, TOKEN_MUTED, b->x + PAINT_PADDING + 4, b->y + HEAD + 10,
		           0, over ? "It wrote nothing." : "Nothing has been written yet.");
}
