/* script.c - routines one a line: taken apart, run, errors with line and column. */
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "private.h"

enum { SCRIPT_MAX = 64 << 20 };

static bool is_blank(char c)
{
	return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/* Where the parser is; the text is changed on the way: ends of words, quotes taken away. */
struct cursor {
	char *begin, *p;
	const struct report *report;
};

static enum status wrong(const struct cursor *c, const char *at, const char *what)
{
	return report_error(c->report, ST_PARAMETER, "column %d: %s", (int)(at - c->begin) + 1,
	                    what);
}

static void skip_blanks(struct cursor *c)
{
	while (is_blank(*c->p))
		c->p++;
	if (*c->p == '#')
		*c->p = 0;
}

/* A value in quotes: to the quote that ends it. */
static enum status take_quoted(struct cursor *c, const char **value)
{
	const char *quote = c->p++;
	char *to = c->p;

	*value = to;
	while (*c->p && *c->p != '"') {
		if (*c->p == '\\' && (c->p[1] == '"' || c->p[1] == '\\'))
			c->p++;
		*to++ = *c->p++;
	}
	if (!*c->p)
		return wrong(c, quote, "a quote that does not end; put one behind the value");
	c->p++;
	if (*c->p && !is_blank(*c->p))
		return wrong(c, c->p, "something stands right behind a quote; put a blank between");
	*to = 0;
	return ST_OK;
}

/* A value without quotes: to the next blank. */
static void take_plain(struct cursor *c, const char **value)
{
	*value = c->p;
	while (*c->p && !is_blank(*c->p))
		c->p++;
	if (*c->p)
		*c->p++ = 0;
}

static enum status take_argument(struct cursor *c, struct arguments *a)
{
	const char *name = c->p;
	enum status st = ST_OK;

	while (*c->p && *c->p != '=' && !is_blank(*c->p) && *c->p != '"')
		c->p++;
	if (*c->p != '=' || c->p == name)
		return wrong(c, name, "expected KEY=VALUE");
	*c->p++ = 0;
	a->name[a->n] = name;
	if (*c->p == '"')
		st = take_quoted(c, &a->value[a->n]);
	else
		take_plain(c, &a->value[a->n]);
	a->n++;
	return st;
}

static enum status take_line(struct script_line *out, struct cursor *c)
{
	const char *code = c->p;
	enum status st = ST_OK;

	while (*c->p && !is_blank(*c->p))
		c->p++;
	if (*c->p)
		*c->p++ = 0;
	out->routine = routine_find(code);
	if (!out->routine)
		return report_error(
		        c->report, ST_PARAMETER,
		        "column %d: there is no routine '%s'; batten routines lists them",
		        (int)(code - c->begin) + 1, code);
	for (skip_blanks(c); *c->p && st == ST_OK; skip_blanks(c))
		st = take_argument(c, &out->given);
	return st;
}

enum status script_line_parse(struct script_line *out, const char *line, const struct report *r)
{
	size_t most = 0;

	for (const char *p = line; *p; p++)
		most += *p == '=';
	*out = (struct script_line){ .text = strdup(line) };
	out->given.name = calloc(most + 1, sizeof *out->given.name);
	out->given.value = calloc(most + 1, sizeof *out->given.value);
	enum status st = ST_OK;
	if (!out->text || !out->given.name || !out->given.value)
		st = report_error(r, ST_RESOURCE, "memory ran out");
	if (st == ST_OK) {
		struct cursor c = { out->text, out->text, r };
		skip_blanks(&c);
		if (*c.p)
			st = take_line(out, &c);
	}
	if (st != ST_OK)
		script_line_finish(out);
	return st;
}

void script_line_finish(struct script_line *l)
{
	free(l->given.name);
	free(l->given.value);
	free(l->text);
	*l = (struct script_line){ 0 };
}

/* A report that puts file and line before each sentence. */
struct placed {
	const struct report *report;
	const char *path;
	long line;
	const struct script_line *now; /* being run; NULL: being taken apart */
};

/* The column of the argument that a sentence is about; 0: of none. */
static int column_of(const struct placed *p, const char *text)
{
	for (int k = 0; p->now && k < p->now->given.n; k++) {
		const char *name = p->now->given.name[k];
		const size_t n = strlen(name);
		if (!strncmp(text, name, n) && !strncmp(text + n, " is ", 4))
			return (int)(name - p->now->text) + 1;
	}
	return 0;
}

static void say_placed(void *data, enum report_level level, enum status st, const char *text)
{
	const struct placed *p = data;

	const int column = column_of(p, text);

	if (level == REPORT_ERROR && column)
		report_error(p->report, st, "%s line %ld: %s (column %d)", p->path, p->line, text,
		             column);
	else if (level == REPORT_ERROR)
		report_error(p->report, st, "%s line %ld: %s", p->path, p->line, text);
	else if (level == REPORT_WARNING)
		report_warning(p->report, "%s line %ld: %s", p->path, p->line, text);
	else
		report_info(p->report, "%s line %ld: %s", p->path, p->line, text);
}

static enum status run_line(struct act *a, const char *text, struct placed *place)
{
	struct script_line line;
	enum status st = script_line_parse(&line, text, &a->report);

	if (st == ST_OK && line.routine) {
		place->now = &line;
		st = routine_call(line.routine, a, &line.given);
		place->now = NULL;
	}
	script_line_finish(&line);
	return st;
}

static enum status run_stream(struct act *a, FILE *in, struct placed *place, bool keep_going,
                              int *failed)
{
	char *line = NULL;
	size_t room = 0;
	ssize_t n;
	enum status all = ST_OK;

	while (!a->quit && (n = getline(&line, &room, in)) >= 0) {
		place->line++;
		enum status st = strlen(line) == (size_t)n
		                         ? run_line(a, line, place)
		                         : report_error(&a->report, ST_PARAMETER,
		                                        "a zero byte; a script is text");
		if (st == ST_OK)
			continue;
		all = all == ST_OK ? st : all;
		++*failed;
		if (!keep_going || st == ST_CANCELLED)
			break;
	}
	free(line);
	return all;
}

enum status script_run(struct act *a, const char *path, bool keep_going, int *failed)
{
	const struct report report = a->report;
	struct placed place = { .report = &report,
		                .path = strcmp(path, "-") ? path : "standard input" };
	char *bytes = NULL;
	size_t n = 0;
	enum status st = ST_OK;
	FILE *in = stdin;

	*failed = 0;
	if (strcmp(path, "-")) {
		/* at once: it may be the journal, which grows while it is replayed */
		st = file_read(path, SCRIPT_MAX, &bytes, &n, &report);
		in = st == ST_OK ? n ? fmemopen(bytes, n, "r") : fopen("/dev/null", "r") : NULL;
		if (st == ST_OK && !in)
			st = report_error(&report, status_from_errno(errno), "cannot read '%s': %s",
			                  path, strerror(errno));
	}
	if (st == ST_OK) {
		a->report = (struct report){ say_placed, &place };
		st = run_stream(a, in, &place, keep_going, failed);
		a->report = report;
	}
	if (in && in != stdin)
		fclose(in);
	free(bytes);
	return st;
}
