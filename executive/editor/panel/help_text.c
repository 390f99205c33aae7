/* help_text.c - a text of help taken apart, by lines. */
#include "help_text.h"

#include <ctype.h>
#include <string.h>
#include <strings.h>

static const struct {
	const char *word, *head; /* head: as shown; NULL: none */
	enum help_section section;
} sections[] = {
	{ "purpose", NULL, SECTION_TEXT },
	{ "arguments", "What it asks for", SECTION_ARGUMENTS },
	{ "result", "What comes out", SECTION_TEXT },
	{ "example", "In a script", SECTION_EXAMPLE },
	{ "see also", "See also", SECTION_SEE },
	{ "see", "See also", SECTION_SEE },
};
enum { N_SECTIONS = sizeof sections / sizeof *sections };

struct line {
	const char *s;
	size_t n;      /* without blanks at the end */
	size_t indent; /* blanks at its beginning, not in s */
};

void help_reader_init(struct help_reader *r, const char *text)
{
	*r = (struct help_reader){ .at = text ? text : "" };
}

void help_reader_finish(struct help_reader *r)
{
	text_finish(&r->text);
	text_finish(&r->value);
	text_finish(&r->meaning);
}

/* The line there, and what follows it; `at` is not at the end. */
static const char *line_at(const char *at, struct line *l)
{
	const char *end = strchrnul(at, '\n');
	l->indent = strspn(at, " \t");
	if (at + l->indent > end)
		l->indent = (size_t)(end - at);
	l->s = at + l->indent;
	l->n = (size_t)(end - l->s);
	while (l->n && isspace((unsigned char)l->s[l->n - 1]))
		l->n--;
	return *end ? end + 1 : end;
}

/* Which section begins with this line: its index, -1. A section of the help source, ":see V80", may go
 * on in the line; its bytes until there are *head. */
static int section_begins(const struct line *l, size_t *head)
{
	const char *s = l->s;
	size_t n = l->n;
	if (n && s[n - 1] == ':')
		n--;
	if (n && s[0] == ':') {
		s++;
		n--;
	}
	*head = l->n;
	for (int i = 0; i < N_SECTIONS; i++) {
		const size_t word = strlen(sections[i].word);
		if (n == word && !strncasecmp(s, sections[i].word, n))
			return i;
		if (s > l->s && n > word && s[word] == ' ' && !strncmp(s, sections[i].word, word)) {
			*head = word + 1;
			return i;
		}
	}
	return -1;
}

static int section_of(const struct line *l)
{
	size_t head;
	return section_begins(l, &head);
}

static bool is_head(const struct line *l, const char *next)
{
	enum { LONGEST = 60 };
	struct line after = { 0 };
	if (!l->n || l->n > LONGEST || l->s[l->n - 1] != ':' || l->indent)
		return false;
	if (*next)
		line_at(next, &after);
	return after.n == 0 || after.indent > 0;
}

static bool is_blank(char c)
{
	return c == ' ' || c == '\t';
}

/* Bytes before a bar between blanks, two blanks or a tab; *next: where the next cell begins. */
static size_t cell(const char *s, size_t n, size_t *next)
{
	size_t i = 0;
	while (i < n && s[i] != '\t' &&
	       !(s[i] == ' ' && i + 1 < n && (s[i + 1] == ' ' || s[i + 1] == '|')))
		i++;
	*next = i;
	while (*next < n && is_blank(s[*next]))
		++*next;
	if (*next < n && s[*next] == '|')
		++*next;
	while (*next < n && is_blank(s[*next]))
		++*next;
	return i;
}

static void add_line(struct text *t, const char *s, size_t n)
{
	if (t->n)
		text_add(t, " ");
	text_add_bytes(t, s, n);
}

static void read_row(struct help_reader *r, const struct line *l)
{
	struct text *cells[] = { &r->text, &r->value, &r->meaning };
	const char *s = l->s;
	size_t left = l->n;
	for (int i = 0; i < 3 && left; i++) {
		size_t next = left, n = i < 2 ? cell(s, left, &next) : left;
		text_add_bytes(cells[i], s, n);
		s += next;
		left -= next;
	}
	struct line more;
	while (*r->at) {
		const char *next = line_at(r->at, &more);
		if (!more.n || more.indent <= l->indent || section_of(&more) >= 0)
			break;
		add_line(&r->meaning, more.s, more.n);
		r->at = next;
	}
}

static bool ends(const char *at, const struct line *l)
{
	return !l->n || section_of(l) >= 0 || is_head(l, at);
}

static void read_paragraph(struct help_reader *r, const struct line *first)
{
	struct line l;
	text_add_bytes(&r->text, first->s, first->n);
	while (*r->at) {
		const char *next = line_at(r->at, &l);
		if (ends(next, &l))
			break;
		add_line(&r->text, l.s, l.n);
		r->at = next;
	}
}

static void read_example(struct help_reader *r, const struct line *first)
{
	struct line l;
	text_add_bytes(&r->text, first->s, first->n);
	while (*r->at) {
		const char *next = line_at(r->at, &l);
		if (section_of(&l) >= 0)
			break;
		if (l.n) {
			text_add(&r->text, "\n");
			text_add_bytes(&r->text, l.s, l.n);
		}
		r->at = next;
	}
}

/* "V81", "N31": length of the code there, 0. */
static size_t code_at(const char *s, size_t n)
{
	size_t i = 1;
	if (!n || (s[0] != 'V' && s[0] != 'N'))
		return 0;
	while (i < n && isdigit((unsigned char)s[i]))
		i++;
	return i > 1 && (i == n || is_blank(s[i]) || s[i] == ',') ? i : 0;
}

/* "V81 MEAN": up to a comma or the next code; the reader goes on behind it. */
static void read_link(struct help_reader *r, const struct line *l)
{
	size_t code = 0, n = 0;
	while (code < l->n && !is_blank(l->s[code]) && l->s[code] != ',')
		code++;
	for (n = code; n < l->n && l->s[n] != ','; n++)
		if (is_blank(l->s[n]) && code_at(l->s + n + 1, l->n - n - 1))
			break;
	text_add_bytes(&r->text, l->s, code);
	size_t name = code, end = n;
	while (name < end && is_blank(l->s[name]))
		name++;
	while (end > name && is_blank(l->s[end - 1]))
		end--;
	text_add_bytes(&r->value, l->s + name, end - name);
	if (n < l->n)
		r->at = l->s + n + 1;
}

static enum help_block read_block(struct help_reader *r, const struct line *l)
{
	size_t head;
	int section = section_begins(l, &head);
	if (section >= 0 && head < l->n)
		r->at = l->s + head;
	if (section >= 0) {
		r->section = sections[section].section;
		if (sections[section].head)
			text_add(&r->text, sections[section].head);
		return HELP_HEAD;
	}
	if (r->section != SECTION_EXAMPLE && is_head(l, r->at)) {
		r->section = SECTION_TEXT;
		text_add_bytes(&r->text, l->s, l->n - 1);
		return HELP_HEAD;
	}
	switch (r->section) {
	case SECTION_ARGUMENTS:
		read_row(r, l);
		return HELP_ROW;
	case SECTION_EXAMPLE:
		read_example(r, l);
		return HELP_EXAMPLE;
	case SECTION_SEE:
		read_link(r, l);
		return HELP_LINK;
	default:
		read_paragraph(r, l);
		return HELP_PARAGRAPH;
	}
}

enum help_block help_reader_next(struct help_reader *r)
{
	struct line l;
	while (*r->at) {
		text_reset(&r->text);
		text_reset(&r->value);
		text_reset(&r->meaning);
		r->at = line_at(r->at, &l);
		if (!l.n)
			continue;
		enum help_block block = read_block(r, &l);
		if (r->text.failed || r->value.failed || r->meaning.failed)
			return HELP_END;
		if (r->text.n) /* purpose has no head, and ",," no link */
			return block;
	}
	return HELP_END;
}
