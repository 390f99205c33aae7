/* compile.c - the help compiler, run by the build: of the help source it makes the message file (the
 * texts), the pointer file (where each text begins) and the include file (a define for each text,
 * and the table of their codes). Fails where a menu entry has no text or a text no entry. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "source.h"

enum { SOURCE_MAX = 1 << 24 };

struct work {
	struct help_source source;
	struct menu *menus[N_MENUS];
	const char *name; /* of the source */
	struct report report;
	int faults;
};

static void fault(struct work *w, int line, const char *code, const char *what)
{
	report_error(&w->report, ST_INPUT, "help '%s' line %d: %s %s", w->name, line, code, what);
	w->faults++;
}

static const struct help_text *find(const struct work *w, const char *code)
{
	for (size_t k = 0; k < w->source.n; k++)
		if (!strcmp(w->source.texts[k].code, code))
			return &w->source.texts[k];
	return NULL;
}

static bool in_menus(const struct work *w, const char *code)
{
	for (int k = 0; k < N_MENUS; k++)
		if (menu_find(w->menus[k], code))
			return true;
	return false;
}

static void check_entries(struct work *w)
{
	for (int k = 0; k < N_MENUS; k++)
		for (const struct Menu_Entry *e = w->menus[k]->top; e; e = menu_next(e))
			if (!find(w, e->index)) {
				report_error(&w->report, ST_INPUT,
				             "menu '%s' line %d: '%s' (%s) has no text in '%s'",
				             w->menus[k]->source, e->line, e->name, e->index,
				             w->name);
				w->faults++;
			}
	for (size_t k = 0; k < w->source.n; k++)
		if (!in_menus(w, w->source.texts[k].code))
			fault(w, w->source.texts[k].line, w->source.texts[k].code, "is in no menu");
}

static void check_see(struct work *w, const struct help_text *t)
{
	char copy[1024], *rest, *code;

	snprintf(copy, sizeof copy, "%s", t->see);
	for (code = strtok_r(copy, " ", &rest); code; code = strtok_r(NULL, " ", &rest))
		if (!find(w, code) || !strcmp(code, t->code))
			fault(w, t->line, t->code,
			      "says to see an index without a text, or itself");
}

static bool has_argument(const struct help_text *t, const char *name, size_t n)
{
	for (int k = 0; k < t->n_arguments; k++)
		if (strlen(t->arguments[k].name) == n && !memcmp(t->arguments[k].name, name, n))
			return true;
	return false;
}

/* The words of a script's line: CODE NAME=VALUE..., a value may stand in "...". */
static void check_example_line(struct work *w, const struct help_text *t, const char *line,
                               bool *own)
{
	size_t n = strcspn(line, " ");
	char code[8] = "";

	if (n < sizeof code)
		memcpy(code, line, n);
	const struct help_text *of = find(w, code);
	if (!of || code[0] != 'V') {
		fault(w, t->line, t->code,
		      "has an example line that does not begin with a routine");
		return;
	}
	*own |= of == t;
	for (const char *p = line + n; *(p += strspn(p, " "));) {
		size_t name = strcspn(p, "= ");
		if (p[name] != '=' || !has_argument(of, p, name))
			fault(w, t->line, t->code,
			      "has an example with an argument that is not listed");
		bool quoted = p[name] == '=' && p[name + 1] == '"';
		p += name + (quoted ? 2 : 0);
		p += quoted ? strcspn(p, "\"") + 1 : strcspn(p, " ");
	}
}

static void check_example(struct work *w, const struct help_text *t)
{
	char copy[2048], *rest, *line;
	bool own = t->code[0] == 'N';

	snprintf(copy, sizeof copy, "%s", t->example);
	for (line = strtok_r(copy, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest))
		check_example_line(w, t, line, &own);
	if (!own)
		fault(w, t->line, t->code, "has an example without itself");
}

static enum status write_outputs(struct work *w, char *const *names)
{
	struct text message = { 0 }, pointer = { 0 }, include = { 0 };
	const size_t n = w->source.n;

	text_addf(&pointer, "batten help 1, %zu texts: index, first byte, bytes\n", n);
	text_addf(&include,
	          "/* Made by the help compiler. Define HELP_SET_UP in the one file that holds the "
	          "table. */\n#define HELP_TEXTS %zu\n",
	          n);
	for (size_t k = 0; k < n; k++) {
		size_t from = message.n;

		help_text_write(&w->source.texts[k], &message);
		text_addf(&pointer, "%s %zu %zu\n", w->source.texts[k].code, from,
		          message.n - from);
		text_addf(&include, "#define HELP_%s %zu\n", w->source.texts[k].code, k);
	}
	text_add(&include, "extern const char *const help_codes[HELP_TEXTS];\n#ifdef HELP_SET_UP\n"
	                   "const char *const help_codes[HELP_TEXTS] = {\n");
	for (size_t k = 0; k < n; k++)
		text_addf(&include, "\t\"%s\",\n", w->source.texts[k].code);
	text_add(&include, "};\n#endif\n");
	const struct text *all[] = { &message, &pointer, &include };
	enum status st = ST_OK;
	for (int k = 0; k < 3 && st == ST_OK; k++)
		st = all[k]->failed ? report_error(&w->report, ST_RESOURCE, "memory ran out")
		                    : file_write(names[k], all[k]->s, all[k]->n, &w->report);
	text_finish(&message);
	text_finish(&pointer);
	text_finish(&include);
	return st;
}

static enum status compile(struct work *w, char **argv)
{
	char *bytes;
	size_t n;
	enum status st = file_read(w->name, SOURCE_MAX, &bytes, &n, &w->report);

	if (st != ST_OK)
		return st;
	st = help_source_parse(&w->source, bytes, n, w->name, &w->report);
	free(bytes);
	for (int k = 0; k < N_MENUS && st == ST_OK; k++)
		st = menu_read(&w->menus[k], argv[k], &w->report);
	if (st != ST_OK)
		return st;
	qsort(w->source.texts, w->source.n, sizeof *w->source.texts, help_text_order);
	check_entries(w);
	for (size_t k = 0; k < w->source.n; k++) {
		check_see(w, &w->source.texts[k]);
		check_example(w, &w->source.texts[k]);
	}
	return w->faults ? ST_INPUT : write_outputs(w, argv + N_MENUS);
}

int main(int argc, char **argv)
{
	struct work w = { .report = report_stderr("help-compiler") };

	if (argc != 2 + N_MENUS + 3) {
		fprintf(stderr,
		        "usage: help-compiler SOURCE MAIN UV COSFAIR WORLD MESSAGES POINTERS "
		        "INCLUDE\n");
		return 2;
	}
	w.name = argv[1];
	enum status st = compile(&w, argv + 2);
	help_source_finish(&w.source);
	for (int k = 0; k < N_MENUS; k++)
		menu_destroy(w.menus[k]);
	return status_exit(st);
}
