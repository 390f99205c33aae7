/* iges_cursor.c - parameters one after the other, across the lines they are spread over. */
#include "iges_reader.h"

#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "number.h"

enum { TOKEN_MAX = 128, STEPS_A_LOOK = 0xfff /* lines between looks at the stop flag, less 1 */ };

enum status iges_refuse(struct iges *g, const char *format, ...)
{
	va_list args;
	va_start(args, format);
	vsnprintf(g->reason, sizeof g->reason, format, args);
	va_end(args);
	return ST_INPUT;
}

enum status iges_fail(struct iges_cursor *c, const char *format, ...)
{
	if (c->st != ST_OK)
		return c->st;
	va_list args;
	va_start(args, format);
	vsnprintf(c->g->reason, sizeof c->g->reason, format, args);
	va_end(args);
	return c->st = ST_INPUT;
}

enum status iges_pass(struct iges *g, enum status st)
{
	if (st == ST_OK || st == ST_RESOURCE || st == ST_CANCELLED)
		return st;
	if (g->store.error[0])
		snprintf(g->reason, sizeof g->reason, "%s", g->store.error);
	else if (!g->reason[0])
		snprintf(g->reason, sizeof g->reason, "its numbers describe nothing");
	g->store.error[0] = '\0';
	return ST_INPUT;
}

/* Go to P line i; false when there is none or the reader is to stop. */
static bool to_line(struct iges_cursor *c, int i)
{
	struct iges *g = c->g;
	if (i >= g->n_p || (i > c->last && iges_back_pointer(g, i) != c->de)) {
		iges_fail(c, "its parameters have no end (record delimiter '%c')",
		          g->header.record);
		return false;
	}
	if (c->de != g->at && --g->budget < 0) {
		iges_fail(c, "it and others refer to each other too many times");
		return false;
	}
	if (i > g->far)
		g->far = i;
	if ((++g->steps & STEPS_A_LOOK) == 0) {
		c->st = progress_step(g->progress, (double)g->far / g->n_p);
		if (c->st != ST_OK)
			return false;
	}
	c->line = i;
	c->s = c->text;
	c->end = c->text + iges_line(g, i, c->text);
	return true;
}

/* Next character that is not a blank, or 0 at the end; not taken. */
static char peek(struct iges_cursor *c)
{
	while (c->st == ST_OK) {
		while (c->s < c->end && *c->s == ' ')
			c->s++;
		if (c->s < c->end)
			return *c->s;
		if (!to_line(c, c->line + 1))
			break;
	}
	return 0;
}

/* Take the delimiter that must follow a parameter. */
static void take_delimiter(struct iges_cursor *c)
{
	char d = peek(c);
	if (d == c->g->header.record)
		c->ended = true;
	else if (d != c->g->header.delimiter)
		iges_fail(c, "'%c' where a delimiter '%c' is expected", d, c->g->header.delimiter);
	c->s++;
}

/* A number that runs over a line's end, is missing, or is none. */
static double real_slowly(struct iges_cursor *c)
{
	char token[TOKEN_MAX];
	int n = 0;
	double x = 0;
	for (char d; (d = peek(c)) != 0; c->s++) {
		if (d == c->g->header.delimiter || d == c->g->header.record)
			break;
		if (n == TOKEN_MAX - 1) {
			iges_fail(c, "a parameter longer than any number");
			return 0;
		}
		token[n++] = d;
	}
	token[n] = '\0';
	if (c->st != ST_OK)
		return 0;
	take_delimiter(c);
	if (n == 0)
		c->missing++;
	else if (!number_parse(token, &x))
		iges_fail(c, "'%.32s' where a number is expected", token);
	return x;
}

double iges_real(struct iges_cursor *c)
{
	if (c->ended || c->st != ST_OK) {
		c->missing++;
		return 0;
	}
	const char *s = c->s, *end = c->end;
	double x;
	while (s < end && *s == ' ')
		s++;
	if (s < end && number_read(&s, end, &x)) {
		while (s < end && *s == ' ')
			s++;
		if (s < end && (*s == c->g->header.delimiter || *s == c->g->header.record)) {
			c->ended = *s == c->g->header.record;
			c->s = s + 1;
			return x;
		}
	}
	return real_slowly(c);
}

int iges_int(struct iges_cursor *c)
{
	double x = iges_real(c);
	if (!(fabs(x) <= INT_MAX) || x != floor(x)) {
		iges_fail(c, "a number with decimals where a whole one is expected");
		return 0;
	}
	return (int)x;
}

int iges_count(struct iges_cursor *c, const char *what, int64_t lo, int64_t hi)
{
	int n = iges_int(c);
	if (n < lo || n > hi)
		iges_fail(c, "%s %d, expected %lld to %lld", what, n, (long long)lo,
		          (long long)(hi > lo ? hi : lo));
	return c->st == ST_OK ? n : 0;
}

bool iges_part(struct iges_cursor *c, int *de)
{
	*de = iges_int(c);
	const struct iges_entry *e = iges_entry(c->g, *de);
	return c->st == ST_OK && !(e && (e->type == 116 || e->type == 132));
}

int64_t iges_left(const struct iges_cursor *c)
{
	if (c->ended || c->st != ST_OK)
		return 0;
	return (int64_t)(c->g->n_p - 1 - c->line) * DATA_COLUMNS + (c->end - c->s);
}

void iges_reals(struct iges_cursor *c, double *out, size_t n, int group, size_t stride)
{
	size_t missing = c->missing;
	for (size_t i = 0; i < n && c->st == ST_OK && c->missing == missing;
	     i += group, out += stride)
		for (int k = 0; k < group; k++)
			out[k] = iges_real(c);
	if (c->missing != missing)
		iges_fail(c, "it ends too early or leaves numbers out");
}

void iges_few(struct iges_cursor *c, double *out, int n)
{
	for (int i = 0; i < n; i++) {
		if (c->ended)
			iges_fail(c, "it ends too early");
		out[i] = iges_real(c);
	}
}

void iges_string(struct iges_cursor *c, struct text *out)
{
	int64_t n = 0;
	if (c->ended || c->st != ST_OK)
		return;
	for (char d; (d = peek(c)) >= '0' && d <= '9' && n < INT_MAX / 10; c->s++)
		n = 10 * n + (d - '0');
	if (c->st == ST_OK && n && *c->s == 'H')
		c->s++;
	else if (n)
		iges_fail(c, "a number where a string is expected");
	if (n > iges_left(c))
		iges_fail(c, "a string longer than the file");
	while (n > 0 && c->st == ST_OK) {
		int64_t here = c->end - c->s < n ? c->end - c->s : n;
		text_add_bytes(out, c->s, (size_t)here);
		c->s += here;
		n -= here;
		if (n > 0)
			to_line(c, c->line + 1);
	}
	if (c->st == ST_OK)
		take_delimiter(c);
}

/* First P line of each entity by the pointers that P lines have back to the directory. */
static enum status find_first_lines(struct iges *g)
{
	g->first_lines = calloc((size_t)g->n_entries, sizeof *g->first_lines);
	if (!g->first_lines)
		return ST_RESOURCE;
	for (int i = g->n_p - 1; i >= 0; i--) {
		int de = iges_back_pointer(g, i);
		if (de % 2 == 1 && de / 2 < g->n_entries)
			g->first_lines[de / 2] = i + 1;
	}
	return ST_OK;
}

/* Stand at P line `line` (from 1) if it begins with the entity's type. */
static bool begins_at(struct iges *g, const struct iges_entry *e, int de, int line,
                      struct iges_cursor *c)
{
	if (line < 1 || line > g->n_p)
		return false;
	*c = (struct iges_cursor){ .g = g, .de = de, .line = line - 1 };
	c->last = e->lines > 0 && e->lines <= g->n_p - line ? line - 2 + e->lines : line - 1;
	return to_line(c, line - 1) && iges_int(c) == e->type && c->st == ST_OK && !c->missing;
}

enum status iges_open(struct iges *g, int de, int type, struct iges_cursor *c)
{
	struct iges_entry *e = iges_entry(g, de);
	de = iges_mend_pointer(g, de);
	*c = (struct iges_cursor){ .g = g, .de = de };
	if (!e)
		return iges_refuse(g, "it refers to directory entry %d, which is not there", de);
	if (type && e->type != type)
		return iges_refuse(g, "it refers to D%d of type %d where type %d is expected", de,
		                   e->type, type);
	bool there = e->data >= 1 && e->data <= g->n_p;
	if (there && iges_back_pointer(g, e->data - 1) == de && begins_at(g, e, de, e->data, c))
		return ST_OK;
	if (!g->first_lines && find_first_lines(g) != ST_OK)
		return ST_RESOURCE;
	int line = g->first_lines[de / 2];
	if (line && line != e->data && begins_at(g, e, de, line, c)) {
		iges_warn(g, WARN_BACK_POINTER, de);
		return ST_OK;
	}
	if (there && begins_at(g, e, de, e->data, c)) {
		c->last = c->g->n_p - 1; /* its pointers back say nothing */
		if (iges_back_pointer(g, e->data - 1) > 0)
			iges_warn(g, WARN_LENT, de);
		return ST_OK;
	}
	if (g->budget < 0 && g->reason[0])
		return ST_INPUT;
	return c->st == ST_CANCELLED || c->st == ST_RESOURCE
	               ? c->st
	               : iges_refuse(g, "its parameters (line P%d) do not begin with its type",
	                             e->data);
}

enum status iges_open_nested(struct iges *g, int de, int depth, struct iges_cursor *c)
{
	if (depth > NESTING_MAX)
		return iges_refuse(g,
		                   "entities that are made of each other in a circle, or more "
		                   "than %d deep",
		                   NESTING_MAX);
	return iges_open(g, de, 0, c);
}
