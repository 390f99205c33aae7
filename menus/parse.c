/* parse.c - the menu file: for each entry the number of its sub-entries (1 for a leaf), its name, its
 * title (menus only), its index; then its sub-entries; at the end 0 and END MENU. */
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "entry.h"
#include "file.h"
#include "menu.h"
#include "number.h"

enum { FILE_MAX = 1 << 20 };

struct reader {
	const char *p, *end, *source;
	int line; /* of what was read last */
	const struct Menu_Entry *top;
	const struct report *r; /* borrowed */
};

/* A line without the blanks around it. */
struct line {
	const char *s;
	size_t n;
};

static enum status fail(const struct reader *in, const char *format, ...)
        __attribute__((format(printf, 2, 3)));

static enum status fail(const struct reader *in, const char *format, ...)
{
	va_list list;
	char what[512];

	va_start(list, format);
	vsnprintf(what, sizeof what, format, list);
	va_end(list);
	return report_error(in->r, ST_INPUT, "cannot read menu '%s' line %d: %s", in->source,
	                    in->line, what);
}

/* Bytes of the UTF-8 character at s, 0 where there is none: cut short, overlong, a surrogate, or a
 * control character, which no name may hold. */
static size_t utf8_length(const unsigned char *s, size_t n)
{
	static const uint32_t least[5] = { 0, 0, 0x80, 0x800, 0x10000 };
	size_t k = s[0] < 0x80 ? 1 : s[0] >= 0xf0 ? 4 : s[0] >= 0xe0 ? 3 : 2;
	uint32_t c = k == 1 ? s[0] : s[0] & (0xffu >> (k + 1));

	if (k > n || (s[0] >= 0x80 && s[0] < 0xc0) || s[0] > 0xf4)
		return 0;
	for (size_t i = 1; i < k; i++) {
		if ((s[i] & 0xc0) != 0x80)
			return 0;
		c = c << 6 | (s[i] & 0x3f);
	}
	if (c < 0x20 || (c >= 0x7f && c < 0xa0) || c < least[k] || (c >= 0xd800 && c < 0xe000) ||
	    c > 0x10ffff)
		return 0;
	return k;
}

static enum status check_characters(const struct reader *in, struct line l)
{
	for (size_t i = 0; i < l.n;) {
		size_t k = utf8_length((const unsigned char *)l.s + i, l.n - i);

		if (!k)
			return fail(in,
			            "byte %zu is 0x%02x, expected text in UTF-8 without control "
			            "characters",
			            i + 1, (unsigned char)l.s[i]);
		i += k;
	}
	return ST_OK;
}

static bool is_blank(char c)
{
	return c == ' ' || c == '\t' || c == '\r';
}

/* The next line; `expected` says what for. */
static enum status take_line(struct reader *in, const char *expected, struct line *out)
{
	in->line++;
	if (in->p == in->end)
		return fail(in, "found the end of the file, expected %s", expected);
	const char *stop = memchr(in->p, '\n', (size_t)(in->end - in->p));
	const char *s = in->p, *e = stop ? stop : in->end;

	in->p = stop ? stop + 1 : in->end;
	while (s < e && is_blank(*s))
		s++;
	while (e > s && is_blank(e[-1]))
		e--;
	if (s == e)
		return fail(in, "found a blank line, expected %s; take the line out", expected);
	*out = (struct line){ s, (size_t)(e - s) };
	return check_characters(in, *out);
}

/* How much of a line a sentence shows. */
static int shown(struct line l)
{
	return l.n > 60 ? 60 : (int)l.n;
}

static enum status take_count(struct reader *in, const char *expected, int *out)
{
	struct line l;
	int64_t n;
	enum status st = take_line(in, expected, &l);

	if (st != ST_OK)
		return st;
	const char *p = l.s, *end = l.s + l.n;
	if (!number_read_integer(&p, end, &n) || p != end || n < 0 || n > MENU_SUB_MAX)
		return fail(in, "found '%.*s', expected %s", shown(l), l.s, expected);
	*out = (int)n;
	return ST_OK;
}

static enum status take_name(struct reader *in, const char *expected, char out[MENU_NAME_MAX + 1])
{
	struct line l;
	enum status st = take_line(in, expected, &l);

	if (st != ST_OK)
		return st;
	if (l.n > MENU_NAME_MAX)
		return fail(in, "found '%.*s', %zu bytes, expected %s of at most %d bytes",
		            shown(l), l.s, l.n, expected, MENU_NAME_MAX);
	memcpy(out, l.s, l.n);
	out[l.n] = 0;
	return ST_OK;
}

/* Two entries of one menu cannot be told apart by the same name. */
static enum status check_name_is_new(const struct reader *in, const struct Menu_Entry *e)
{
	for (int k = 0; e->parent && k < e->parent->n_sub; k++) {
		const struct Menu_Entry *other = e->parent->sub[k];

		if (other != e && !strcmp(other->name, e->name))
			return fail(in,
			            "found '%s' a second time in the menu '%s', expected another "
			            "name",
			            e->name, e->parent->name);
	}
	return ST_OK;
}

/* A letter and a number without leading zeros. */
static bool is_index(struct line l, char letter)
{
	if (l.n < 2 || l.n > 5 || l.s[0] != letter || (l.s[1] == '0' && l.n > 2))
		return false;
	for (size_t i = 1; i < l.n; i++)
		if (l.s[i] < '0' || l.s[i] > '9')
			return false;
	return true;
}

static const struct Menu_Entry *find_index(const struct Menu_Entry *e, const char *index)
{
	while (e && strcmp(e->index, index) != 0)
		e = menu_next(e);
	return e;
}

static enum status take_index(struct reader *in, struct Menu_Entry *e, bool leaf)
{
	struct line l;
	const char *expected = leaf ? "an index of a routine (V and a number)"
	                            : "an index of a menu (N and a number)";
	enum status st = take_line(in, expected, &l);

	if (st != ST_OK)
		return st;
	if (!is_index(l, leaf ? 'V' : 'N'))
		return fail(in, "found '%.*s' for '%s', expected %s", shown(l), l.s, e->name,
		            expected);
	memcpy(e->index, l.s, l.n);
	e->index[l.n] = 0;
	e->line = in->line;
	/* the help of a menu is found by its index, so two menus cannot share one */
	const struct Menu_Entry *other = leaf || !in->top ? NULL : find_index(in->top, e->index);
	if (other && other != e)
		return fail(in, "found %s, which is '%s' of line %d, expected an index of its own",
		            e->index, other->name, other->line);
	return ST_OK;
}

static enum status take_entry(struct reader *in, struct Menu_Entry *parent, int depth,
                              struct Menu_Entry **out);

static enum status take_subs(struct reader *in, struct Menu_Entry *e, int n, int depth)
{
	e->sub = calloc((size_t)n, sizeof *e->sub);
	if (!e->sub)
		return report_error(in->r, ST_RESOURCE, "memory ran out");
	for (int k = 0; k < n; k++) {
		struct Menu_Entry *sub;
		enum status st = take_entry(in, e, depth + 1, &sub);

		if (st != ST_OK)
			return st;
	}
	return ST_OK;
}

/*
 * One entry and all below it. It hangs in its parent before its own entries are read, so that the
 * tree so far can be searched and is freed from the top when something fails.
 */
static enum status take_entry(struct reader *in, struct Menu_Entry *parent, int depth,
                              struct Menu_Entry **out)
{
	char expected[128];
	int n = 0;

	if (parent)
		snprintf(expected, sizeof expected,
		         "the number of sub-entries of an entry of '%s' (1 for a leaf, up to %d)",
		         parent->name, MENU_SUB_MAX);
	else
		snprintf(expected, sizeof expected, "the number of entries of the menu (2 to %d)",
		         MENU_SUB_MAX);
	enum status st = take_count(in, expected, &n);
	if (st != ST_OK)
		return st;
	if (n < (parent ? 1 : 2))
		return fail(in, "found %d, expected %s", n, expected);
	if (depth > MENU_DEPTH_MAX)
		return fail(in, "found a menu in %d others, expected %d at most", depth,
		            MENU_DEPTH_MAX);
	struct Menu_Entry *e = calloc(1, sizeof *e);
	if (!e)
		return report_error(in->r, ST_RESOURCE, "memory ran out");
	e->parent = parent;
	*out = e;
	if (parent)
		parent->sub[parent->n_sub++] = e;
	else
		in->top = e;
	st = take_name(in, "a name", e->name);
	if (st == ST_OK)
		st = check_name_is_new(in, e);
	if (st == ST_OK && n > 1)
		st = take_name(in, "a menu title", e->title);
	if (st == ST_OK)
		st = take_index(in, e, n == 1);
	if (st == ST_OK && n > 1)
		st = take_subs(in, e, n, depth);
	return st;
}

static enum status take_end(struct reader *in)
{
	struct line l;
	const char *expected = "0 and END MENU (the menu is complete, or a number of sub-entries "
	                       "above is too small)";
	enum status st = take_line(in, expected, &l);

	if (st == ST_OK && (l.n != 1 || l.s[0] != '0'))
		return fail(in, "found '%.*s', expected %s", shown(l), l.s, expected);
	if (st == ST_OK)
		st = take_line(in, "END MENU", &l);
	if (st == ST_OK && (l.n != 8 || memcmp(l.s, "END MENU", 8) != 0))
		return fail(in, "found '%.*s', expected END MENU", shown(l), l.s);
	if (st == ST_OK && in->p != in->end) {
		in->line++;
		return fail(in, "found more behind END MENU, expected the end of the file");
	}
	return st;
}

enum status menu_parse(struct menu **out, const char *text, size_t n, const char *source,
                       const struct report *r)
{
	struct reader in = { .p = text, .end = text + n, .source = source, .r = r };
	struct menu *m = calloc(1, sizeof *m);

	*out = NULL;
	if (m)
		m->source = strdup(source);
	if (!m || !m->source) {
		menu_destroy(m);
		return report_error(r, ST_RESOURCE, "cannot read menu '%s': memory ran out",
		                    source);
	}
	enum status st = take_entry(&in, NULL, 0, &m->top);
	if (st == ST_OK)
		st = take_end(&in);
	if (st != ST_OK) {
		menu_destroy(m);
		return st;
	}
	*out = m;
	return ST_OK;
}

enum status menu_read(struct menu **out, const char *path, const struct report *r)
{
	char *text;
	size_t n;
	enum status st = file_read(path, FILE_MAX, &text, &n, r);

	*out = NULL;
	if (st != ST_OK)
		return st;
	st = menu_parse(out, text, n, path, r);
	free(text);
	return st;
}

enum status menu_read_built_in(struct menu **out, enum menu_root root, const struct report *r)
{
	const struct built_in *b = &built_in_menus[root];

	return menu_parse(out, b->text, b->n, "built in", r);
}
