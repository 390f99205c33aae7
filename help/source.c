/* source.c - the help source, read. */
#include "source.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum part { PART_PURPOSE, PART_ARGUMENTS, PART_RESULT, PART_EXAMPLE, PART_SEE, N_PARTS };

static const char *const part_words[N_PARTS] = {
	[PART_PURPOSE] = "a text", [PART_ARGUMENTS] = ":arguments",
	[PART_RESULT] = ":result", [PART_EXAMPLE] = ":example",
	[PART_SEE] = ":see",
};

struct reader {
	const char *p, *end, *name;
	int line;
	const struct report *r;  /* borrowed */
	struct help_source *out; /* borrowed */
	size_t first;            /* of out->texts, of this file */
	struct help_text now;    /* the text being read */
	bool open;               /* there is one */
	enum part part;
	struct text body[N_PARTS];
	bool gap; /* a blank line came before this one */
};

static enum status fail(const struct reader *in, int line, const char *format, ...)
        __attribute__((format(printf, 3, 4)));

static enum status fail(const struct reader *in, int line, const char *format, ...)
{
	va_list list;
	char what[512];

	va_start(list, format);
	vsnprintf(what, sizeof what, format, list);
	va_end(list);
	return report_error(in->r, ST_INPUT, "cannot read help '%s' line %d: %s", in->name, line,
	                    what);
}

static enum status no_memory(const struct reader *in)
{
	return report_error(in->r, ST_RESOURCE, "cannot read help '%s': memory ran out", in->name);
}

bool help_code_parse(const char *code, char *letter, int *number)
{
	size_t n = strlen(code);

	if (n < 2 || n > 5 || (code[0] != 'N' && code[0] != 'V') || (code[1] == '0' && n > 2))
		return false;
	*letter = code[0];
	*number = 0;
	for (size_t k = 1; k < n; k++) {
		if (code[k] < '0' || code[k] > '9')
			return false;
		*number = 10 * *number + code[k] - '0';
	}
	return true;
}

int help_text_order(const void *a, const void *b)
{
	const struct help_text *x = a, *y = b;
	char p = 0, q = 0;
	int i = 0, j = 0;

	help_code_parse(x->code, &p, &i);
	help_code_parse(y->code, &q, &j);
	return p != q ? p - q : i - j;
}

void help_text_finish(struct help_text *t)
{
	for (int k = 0; k < t->n_arguments; k++) {
		free(t->arguments[k].name);
		free(t->arguments[k].range);
		free(t->arguments[k].meaning);
	}
	free(t->code);
	free(t->title);
	free(t->purpose);
	free(t->result);
	free(t->example);
	free(t->see);
	memset(t, 0, sizeof *t);
}

void help_source_finish(struct help_source *s)
{
	for (size_t k = 0; k < s->n; k++)
		help_text_finish(&s->texts[k]);
	free(s->texts);
	memset(s, 0, sizeof *s);
}

static bool keep(struct help_source *s, struct help_text *t)
{
	if (s->n == s->cap) {
		size_t cap = s->cap ? 2 * s->cap : 64;
		struct help_text *more = reallocarray(s->texts, cap, sizeof *more);
		if (!more)
			return false;
		s->texts = more;
		s->cap = cap;
	}
	s->texts[s->n++] = *t;
	memset(t, 0, sizeof *t);
	return true;
}

/* What a routine needs, and a menu cannot have. */
static enum status check_parts(const struct reader *in)
{
	bool routine = in->now.code[0] == 'V';

	for (int k = 0; k < N_PARTS; k++) {
		bool must =
		        k == PART_PURPOSE || (routine && (k == PART_RESULT || k == PART_EXAMPLE));
		bool may = routine || k == PART_PURPOSE || k == PART_SEE;

		if (must && !in->body[k].n)
			return fail(in, in->now.line, "%s has no %s", in->now.code, part_words[k]);
		if (!may && (in->body[k].n || (k == PART_ARGUMENTS && in->now.n_arguments)))
			return fail(in, in->now.line, "%s is a menu, which has no %s", in->now.code,
			            part_words[k]);
	}
	return ST_OK;
}

/* The text that was being read is complete. */
static enum status end_text(struct reader *in)
{
	if (!in->open)
		return ST_OK;
	in->open = false;
	enum status st = check_parts(in);
	if (st != ST_OK)
		return st;
	for (size_t k = in->first; k < in->out->n; k++)
		if (!strcmp(in->out->texts[k].code, in->now.code))
			return fail(in, in->now.line,
			            "found %s a second time (the first is in line %d)",
			            in->now.code, in->out->texts[k].line);
	in->now.purpose = text_take(&in->body[PART_PURPOSE]);
	in->now.result = text_take(&in->body[PART_RESULT]);
	in->now.example = text_take(&in->body[PART_EXAMPLE]);
	in->now.see = text_take(&in->body[PART_SEE]);
	if (!in->now.purpose || !in->now.result || !in->now.example || !in->now.see ||
	    !keep(in->out, &in->now))
		return no_memory(in);
	return ST_OK;
}

static enum status begin_text(struct reader *in, const char *s, size_t n)
{
	enum status st = end_text(in);
	const char *blank = memchr(s, ' ', n);
	char letter;
	int number;

	if (st != ST_OK)
		return st;
	if (!blank || blank == s || blank + 1 == s + n)
		return fail(in, in->line, "found '@%.*s', expected @, an index and a title",
		            (int)(n < 40 ? n : 40), s);
	in->now = (struct help_text){ .line = in->line };
	in->now.code = strndup(s, (size_t)(blank - s));
	while (blank < s + n && *blank == ' ')
		blank++;
	in->now.title = strndup(blank, (size_t)(s + n - blank));
	in->open = true;
	in->part = PART_PURPOSE;
	if (!in->now.code || !in->now.title)
		return no_memory(in);
	if (!help_code_parse(in->now.code, &letter, &number))
		return fail(in, in->line, "found '%.40s', expected an index as V79 or N31",
		            in->now.code);
	return ST_OK;
}

static enum status begin_part(struct reader *in, const char *s, size_t n)
{
	size_t word = 0;
	int k = PART_ARGUMENTS;

	while (word < n && s[word] != ' ')
		word++;
	while (k < N_PARTS &&
	       (strlen(part_words[k]) != word || memcmp(part_words[k], s, word) != 0))
		k++;
	if (k == N_PARTS)
		return fail(in, in->line,
		            "found '%.*s', expected :arguments, :result, :example or :see",
		            (int)(n < 40 ? n : 40), s);
	if (!in->open || k <= (int)in->part)
		return fail(in, in->line, "found %s %s", part_words[k],
		            in->open ? "after a part that comes behind it, or twice"
		                     : "before the first text");
	in->part = (enum part)k;
	if (k != PART_SEE) {
		if (word != n)
			return fail(in, in->line, "found more behind %s, expected the next line",
			            part_words[k]);
		return ST_OK;
	}
	while (word < n) {
		size_t from = word + 1;
		char code[8] = "", letter;
		int number;

		for (word = from; word < n && s[word] != ' ';)
			word++;
		if (word - from < sizeof code)
			memcpy(code, s + from, word - from);
		if (!help_code_parse(code, &letter, &number))
			return fail(in, in->line, "found '%.*s', expected indices as V80 or N31",
			            (int)(word - from < 40 ? word - from : 40), s + from);
		text_addf(&in->body[PART_SEE], "%s%s", in->body[PART_SEE].n ? " " : "", code);
	}
	return in->body[PART_SEE].n ? ST_OK : fail(in, in->line, "found :see without an index");
}

static char *field(const char *s, const char *end)
{
	while (s < end && *s == ' ')
		s++;
	while (end > s && end[-1] == ' ')
		end--;
	return strndup(s, (size_t)(end - s));
}

static bool is_argument_name(const char *s)
{
	return *s >= 'a' && *s <= 'z' && !s[strspn(s, "abcdefghijklmnopqrstuvwxyz0123456789_-")];
}

static enum status add_argument(struct reader *in, const char *s, size_t n)
{
	const char *end = s + n, *first = memchr(s, '|', n);
	const char *second = first ? memchr(first + 1, '|', (size_t)(end - first - 1)) : NULL;
	struct help_text *t = &in->now;

	if (s[0] == ' ' && t->n_arguments) { /* goes on with the meaning above */
		char *rest = field(s, end), **old = &t->arguments[t->n_arguments - 1].meaning;
		char *whole = rest ? text_print("%s %s", *old, rest) : NULL;
		free(rest);
		if (!whole)
			return no_memory(in);
		free(*old);
		*old = whole;
		return ST_OK;
	}
	if (!second)
		return fail(in, in->line, "found '%.*s', expected NAME | RANGE | MEANING",
		            (int)(n < 60 ? n : 60), s);
	if (t->n_arguments == HELP_ARGUMENTS_MAX)
		return fail(in, in->line, "%s has more than %d arguments", t->code,
		            HELP_ARGUMENTS_MAX);
	struct help_argument *a = &t->arguments[t->n_arguments++];
	*a = (struct help_argument){ field(s, first), field(first + 1, second),
		                     field(second + 1, end) };
	if (!a->name || !a->range || !a->meaning)
		return no_memory(in);
	if (!is_argument_name(a->name))
		return fail(in, in->line,
		            "found the argument '%.40s', expected a name in small letters",
		            a->name);
	if (!*a->range || !*a->meaning)
		return fail(in, in->line, "the argument '%s' has no range or no meaning", a->name);
	for (int k = 0; k < t->n_arguments - 1; k++)
		if (!strcmp(t->arguments[k].name, a->name))
			return fail(in, in->line, "found the argument '%s' a second time", a->name);
	return ST_OK;
}

/* A line of text joins its paragraph; an example keeps its lines. */
static enum status add_line(struct reader *in, const char *s, size_t n)
{
	struct text *t = &in->body[in->part];

	if (!in->open)
		return fail(in, in->line,
		            "found '%.*s' before the first text, expected @INDEX TITLE",
		            (int)(n < 40 ? n : 40), s);
	if (in->part == PART_SEE)
		return fail(in, in->line, "found more behind :see, expected @INDEX TITLE");
	if (in->part == PART_ARGUMENTS)
		return add_argument(in, s, n);
	if (t->n)
		text_add(t, in->part == PART_EXAMPLE ? "\n" : in->gap ? "\n\n" : " ");
	text_add_bytes(t, s, n);
	return t->failed ? no_memory(in) : ST_OK;
}

static enum status take_line(struct reader *in)
{
	const char *stop = memchr(in->p, '\n', (size_t)(in->end - in->p)), *s = in->p;
	size_t n = (size_t)((stop ? stop : in->end) - s);
	enum status st;

	in->line++;
	in->p = stop ? stop + 1 : in->end;
	while (n && (s[n - 1] == ' ' || s[n - 1] == '\r'))
		n--;
	for (size_t k = 0; k < n; k++)
		if ((unsigned char)s[k] < 0x20 || s[k] == 0x7f)
			return fail(in, in->line,
			            "byte %zu is 0x%02x, expected text without control characters",
			            k + 1, (unsigned char)s[k]);
	if (!n) {
		in->gap = true;
		return ST_OK;
	}
	if (s[0] == '#')
		return ST_OK;
	if (s[0] == '@')
		st = begin_text(in, s + 1, n - 1);
	else if (s[0] == ':')
		st = begin_part(in, s, n);
	else
		st = add_line(in, s, n);
	in->gap = false;
	return st;
}

enum status help_source_parse(struct help_source *s, const char *bytes, size_t n, const char *name,
                              const struct report *r)
{
	struct reader in = {
		.p = bytes, .end = bytes + n, .name = name, .r = r, .out = s, .first = s->n
	};
	enum status st = ST_OK;

	while (st == ST_OK && in.p != in.end)
		st = take_line(&in);
	if (st == ST_OK)
		st = end_text(&in);
	help_text_finish(&in.now);
	for (int k = 0; k < N_PARTS; k++)
		text_finish(&in.body[k]);
	return st;
}

static void write_part(struct text *out, enum part k, const char *body)
{
	if (*body)
		text_addf(out, "%s\n%s\n", part_words[k], body);
}

void help_text_write(const struct help_text *t, struct text *out)
{
	text_addf(out, "@%s %s\n%s\n", t->code, t->title, t->purpose);
	if (t->n_arguments)
		text_addf(out, "%s\n", part_words[PART_ARGUMENTS]);
	for (int k = 0; k < t->n_arguments; k++)
		text_addf(out, "%s | %s | %s\n", t->arguments[k].name, t->arguments[k].range,
		          t->arguments[k].meaning);
	write_part(out, PART_RESULT, t->result);
	write_part(out, PART_EXAMPLE, t->example);
	if (*t->see)
		text_addf(out, "%s %s\n", part_words[PART_SEE], t->see);
}
