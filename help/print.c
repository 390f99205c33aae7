/* print.c - a help text for a terminal. */
#include <stdio.h>
#include <string.h>

#include "help.h"
#include "text.h"

/* Columns of n bytes of UTF-8: every byte that begins a character. */
static int columns(const char *s, size_t n)
{
	int c = 0;

	for (size_t k = 0; k < n; k++)
		c += (s[k] & 0xc0) != 0x80;
	return c;
}

/* Fill lines with the words of s, `indent` columns in; `at` is where the line stands. */
static void fill(struct text *out, const char *s, int indent, int at, int width)
{
	bool begin = true;

	while (*s) {
		if (s[0] == '\n') {
			text_add(out, "\n");
			if (s[1] == '\n')
				text_add(out, "\n");
			s += 1 + (s[1] == '\n');
			at = 0;
			begin = true;
			continue;
		}
		if (*s == ' ') {
			s++;
			continue;
		}
		size_t n = strcspn(s, " \n");
		int w = columns(s, n);

		if (!begin && at + 1 + w > width) {
			text_add(out, "\n");
			at = 0;
			begin = true;
		}
		if (begin) {
			text_addf(out, "%*s", indent > at ? indent - at : 0, "");
			at = indent > at ? indent : at;
		} else {
			text_add(out, " ");
			at++;
		}
		text_add_bytes(out, s, n);
		at += w;
		s += n;
		begin = false;
	}
	text_add(out, "\n");
}

static void print_arguments(struct text *out, const struct help_text *t, int width)
{
	int column = 0;

	for (int k = 0; k < t->n_arguments; k++) {
		int w = columns(t->arguments[k].name, strlen(t->arguments[k].name));
		column = w > column ? w : column;
	}
	for (int k = 0; k < t->n_arguments; k++) {
		const struct help_argument *a = &t->arguments[k];

		text_addf(out, "  %s", a->name);
		fill(out, a->range, column + 4, 2 + columns(a->name, strlen(a->name)), width);
		fill(out, a->meaning, column + 6, 0, width);
	}
}

static void print_see(struct text *out, const struct help *h, const char *see)
{
	while (*(see += strspn(see, " "))) {
		size_t n = strcspn(see, " ");
		char code[8] = "";

		memcpy(code, see, n < sizeof code ? n : sizeof code - 1);
		const struct help_text *t = help_find(h, code);
		text_addf(out, "  %-5s %s\n", code, t ? t->title : "");
		see += n;
	}
}

char *help_print(const struct help *h, const struct help_text *t, int width)
{
	struct text out = { 0 };

	text_addf(&out, "%s  %s\n\n", t->code, t->title);
	fill(&out, t->purpose, 0, 0, width);
	if (t->n_arguments) {
		text_add(&out, "\nWhat it asks for\n");
		print_arguments(&out, t, width);
	}
	if (*t->result) {
		text_add(&out, "\nWhat comes out\n");
		fill(&out, t->result, 0, 0, width);
	}
	if (*t->example) {
		text_add(&out, "\nIn a script\n");
		fill(&out, t->example, 2, 0, 10000); /* lines of a script are not broken */
	}
	if (*t->see) {
		text_add(&out, "\nSee also\n");
		print_see(&out, h, t->see);
	}
	return text_take(&out);
}
