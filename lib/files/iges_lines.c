/* iges_lines.c - an IGES file as lines: which section each belongs to and where it begins. */
#include "iges_reader.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

struct line {
	const char *s;
	size_t at;   /* where it begins */
	size_t n;    /* bytes without line end and without blanks behind */
	char letter; /* of its section, 0: none */
	size_t data; /* columns before the letter */
};

static bool is_letter_of_section(char c)
{
	return c == 'S' || c == 'G' || c == 'D' || c == 'P' || c == 'T' || c == 'C' || c == 'B';
}

/* The seven columns of a sequence number; lines may be longer than 80. */
static bool is_number_field(const char *s)
{
	for (int i = 0; i < 7; i++)
		if (s[i] != ' ' && (s[i] < '0' || s[i] > '9'))
			return false;
	return true;
}

/* Where the line that begins at `at` ends and how long its end is; lines longer than is looked at are
 * gone through to their end. */
static size_t line_length(struct iges *g, const char *s, size_t got, size_t at, size_t *whole)
{
	if (g->stride) {
		size_t n = got < g->stride ? got : g->stride;
		*whole = n;
		return n;
	}
	const char *e = memchr(s, g->line_end, got);
	size_t n = e ? (size_t)(e - s) : got;
	*whole = n;
	for (size_t more = got; !e && more == LINE_MOST;) {
		s = iges_bytes_at(&g->bytes, at + *whole, LINE_MOST, &more);
		e = memchr(s, g->line_end, more);
		*whole += e ? (size_t)(e - s) : more;
	}
	*whole += e != NULL;
	return n;
}

/* From *at on; false at the end. Empty lines come with letter 0. */
static bool next_line(struct iges *g, size_t *at, struct line *l)
{
	size_t got, whole;
	const char *s = iges_bytes_at(&g->bytes, *at, LINE_MOST, &got);
	if (!got)
		return false;
	size_t n = line_length(g, s, got, *at, &whole);
	if (whole > got) /* it was gone through to its end: other blocks may have come */
		s = iges_bytes_at(&g->bytes, *at, n, &got);
	l->at = *at;
	*at += whole;
	n = got < n ? got : n;
	while (n && (s[n - 1] == ' ' || s[n - 1] == '\r' || s[n - 1] == '\n'))
		n--;
	*l = (struct line){ .s = s, .at = l->at, .n = n };
	if (n > LETTER_COLUMN && is_letter_of_section(s[LETTER_COLUMN]) &&
	    (n <= LETTER_COLUMN + 8 || is_number_field(s + LETTER_COLUMN + 1)))
		l->data = LETTER_COLUMN;
	else if (n >= 8 && is_letter_of_section(s[n - 8]))
		l->data = n - 8; /* bytes and columns differ: tabs, or letters of several bytes */
	else
		return true;
	l->letter = s[l->data];
	return true;
}

/* How lines end is the same in the whole file. */
static void find_line_end(struct iges *g)
{
	size_t look;
	const char *s = iges_bytes_at(&g->bytes, 0, LINE_MOST, &look);
	g->line_end = '\n';
	if (memchr(s, '\n', look))
		return;
	if (memchr(s, '\r', look))
		g->line_end = '\r';
	else
		g->stride = 80;
}

/* A line that an IGES file can begin with: its letter, and a number or nothing behind it. */
static bool is_first_line(const struct line *l)
{
	bool good = l->letter == 'S' || l->letter == 'G' || l->letter == 'C' || l->letter == 'B';
	for (size_t i = l->data + 1; good && i < l->n && i < l->data + 8; i++)
		good = l->s[i] == ' ' || (l->s[i] >= '0' && l->s[i] <= '9');
	return good;
}

bool iges_recognise(const char *bytes, size_t n)
{
	struct iges g = { .bytes = { .all = bytes, .n = n } };
	struct line l = { 0 };
	size_t at = 0;
	find_line_end(&g);
	while (l.n == 0 && next_line(&g, &at, &l))
		;
	return is_first_line(&l);
}

/* A line that does not go on with the last run begins one. */
static bool add_line_at(struct iges_lines *l, size_t at)
{
	struct line_run *r = l->n_runs ? &l->runs[l->n_runs - 1] : NULL;
	if (l->n == INT_MAX)
		return false;
	if (r && l->n - r->first == 1 && at - r->at <= UINT_MAX)
		r->stride = (unsigned)(at - r->at);
	else if (!r || at - r->at != (size_t)r->stride * (size_t)(l->n - r->first)) {
		if ((l->n_runs & (l->n_runs - 1)) == 0) {
			r = reallocarray(l->runs, l->n_runs ? (size_t)l->n_runs * 2 : 1, sizeof *r);
			if (!r)
				return false;
			l->runs = r;
		}
		l->runs[l->n_runs++] = (struct line_run){ at, l->n, 0 };
	}
	l->n++;
	return true;
}

/* The last run that begins at or before line i. */
static int find_run(const struct iges_lines *l, int i)
{
	int lo = 0, hi = l->n_runs - 1;
	while (lo < hi) {
		int middle = lo + (hi - lo + 1) / 2;
		if (l->runs[middle].first <= i)
			lo = middle;
		else
			hi = middle - 1;
	}
	return lo;
}

static bool is_in_run(const struct iges_lines *l, int run, int i)
{
	return run < l->n_runs && l->runs[run].first <= i &&
	       (run + 1 == l->n_runs || i < l->runs[run + 1].first);
}

size_t iges_lines_at(struct iges_lines *l, int i)
{
	if (l->n_runs > 1 && !is_in_run(l, l->last, i))
		l->last = is_in_run(l, l->last + 1, i) ? l->last + 1 : find_run(l, i);
	const struct line_run *r = &l->runs[l->last];
	return r->at + (size_t)r->stride * (size_t)(i - r->first);
}

void iges_lines_finish(struct iges_lines *l)
{
	free(l->runs);
	*l = (struct iges_lines){ 0 };
}

static enum status add_line(struct iges *g, const struct line *l)
{
	bool good = true;
	switch (l->letter) {
	case 'C':
		return report_error(g->r, ST_INPUT,
		                    "cannot read '%s': it is in IGES's compressed form; "
		                    "export it again in the fixed (80 column) form",
		                    g->name);
	case 'B':
		return report_error(g->r, ST_INPUT,
		                    "cannot read '%s': it is in IGES's binary form; "
		                    "export it again as ASCII",
		                    g->name);
	case 'G':
		text_add_bytes(&g->global, l->s, l->data);
		good = !g->global.failed;
		break;
	case 'D':
		good = add_line_at(&g->d_lines, l->at);
		break;
	case 'P':
		good = add_line_at(&g->p_lines, l->at);
		g->odd_lines |= l->data != LETTER_COLUMN;
		break;
	case 'T':
		memcpy(g->terminate, l->s, l->data < HEADER_COLUMNS ? l->data : HEADER_COLUMNS);
		break;
	}
	return good ? ST_OK
	            : report_error(g->r, ST_RESOURCE, "cannot read '%s': no memory", g->name);
}

enum status iges_index(struct iges *g)
{
	struct line l = { 0 };
	size_t at = 0;
	int lines = 0;
	bool ended = false;
	find_line_end(g);
	while (!ended && next_line(g, &at, &l)) {
		enum status st = l.letter ? add_line(g, &l) : ST_OK;
		if (st == ST_OK && (++lines & 0xffff) == 0)
			st = progress_step(g->progress, 0);
		if (st != ST_OK)
			return st;
		ended = l.letter == 'T';
	}
	g->n_d = g->d_lines.n;
	g->n_p = g->p_lines.n;
	if (!ended && g->bytes.failed)
		return ST_RESOURCE; /* said by the caller */
	if (!ended)
		return report_error(
		        g->r, ST_INPUT,
		        "cannot read '%s': it is cut short: the last line (T in column 73) "
		        "is missing; copy or export it again",
		        g->name);
	return ST_OK;
}

int iges_line(struct iges *g, int i, char out[DATA_MOST])
{
	size_t at = iges_lines_at(&g->p_lines, i), n = DATA_COLUMNS, got;
	if (g->odd_lines) {
		struct line l = { 0 };
		size_t next = at;
		next_line(g, &next, &l);
		n = l.data > HEADER_COLUMNS - DATA_COLUMNS
		            ? l.data - (HEADER_COLUMNS - DATA_COLUMNS)
		            : 0;
		n = n < DATA_MOST ? n : DATA_MOST;
	}
	const char *s = iges_bytes_at(&g->bytes, at, n, &got);
	memcpy(out, s, got);
	return (int)got;
}

int iges_back_pointer(struct iges *g, int i)
{
	size_t begin = iges_lines_at(&g->p_lines, i), at = begin + DATA_COLUMNS, got;
	if (g->odd_lines) {
		struct line l = { 0 };
		size_t next = begin;
		next_line(g, &next, &l);
		at = l.at + (l.data > HEADER_COLUMNS - DATA_COLUMNS
		                     ? l.data - (HEADER_COLUMNS - DATA_COLUMNS)
		                     : 0);
	}
	const char *s = iges_bytes_at(&g->bytes, at, HEADER_COLUMNS - DATA_COLUMNS, &got);
	int de = 0;
	for (size_t k = 0; k < got; k++) {
		char c = s[k];
		if (c >= '0' && c <= '9' && de < INT_MAX / 10 - 1)
			de = 10 * de + (c - '0');
		else if (c != ' ')
			return 0;
	}
	return de;
}
