/* help_routines.c - help of the editor's menus and routines, on a terminal. */
#include "help_routines.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "help.h"
#include "json.h"
#include "project.h"

enum { WIDTH = 80, HITS_MAX = 12 };

/* What the texts and the menus of this project are. */
struct texts {
	struct help *help;
	struct menu_set menus;
};

static void texts_finish(struct texts *t)
{
	help_destroy(t->help);
	menu_set_finish(&t->menus);
}

static enum status texts_load(struct texts *t, const struct report *r)
{
	struct project p;
	enum status st = project_find(&p, NULL, r);

	memset(t, 0, sizeof *t);
	if (st != ST_OK)
		return st;
	st = help_load(&t->help, p.folder, r);
	if (st == ST_OK)
		st = menu_set_load(&t->menus, p.folder, r);
	project_finish(&p);
	if (st != ST_OK)
		return st;
	if (help_complaint(t->help))
		report_warning(r, "%s", help_complaint(t->help));
	for (int k = 0; k < N_MENUS; k++)
		if (t->menus.complaint[k])
			report_warning(r, "%s", t->menus.complaint[k]);
	return ST_OK;
}

bool is_routine_code(const char *word)
{
	char letter = (char)toupper((unsigned char)word[0]);

	return (letter == 'N' || letter == 'V') && word[1] &&
	       !word[1 + strspn(word + 1, "0123456789")];
}

/* Where the entry is: "MAIN > ...", NULL where a changed menu has it no more. Caller frees. */
static char *path_of(const struct texts *t, const char *code)
{
	enum menu_root root;
	const struct Menu_Entry *e = menu_set_find(&t->menus, code, &root);

	return e ? menu_path(root, e) : NULL;
}

static json_t *see_to_json(const char *see)
{
	json_t *all = json_array();

	while (*(see += strspn(see, " "))) {
		size_t n = strcspn(see, " ");
		json_array_append_new(all, json_stringn(see, n));
		see += n;
	}
	return all;
}

static json_t *text_to_json(const struct texts *t, const struct help_text *text)
{
	char *path = path_of(t, text->code);
	json_t *o = json_object(), *arguments = json_array();

	json_set_text(o, "code", text->code);
	json_set_text(o, "title", text->title);
	json_set_text(o, "path", path);
	json_set_text(o, "purpose", text->purpose);
	for (int k = 0; k < text->n_arguments; k++) {
		const struct help_argument *a = &text->arguments[k];

		json_array_append_new(arguments, json_pack("{s:s, s:s, s:s}", "name", a->name,
		                                           "range", a->range, "help", a->meaning));
	}
	json_object_set_new(o, "arguments", arguments);
	json_set_text(o, "result", *text->result ? text->result : NULL);
	json_set_text(o, "example", *text->example ? text->example : NULL);
	json_object_set_new(o, "see", see_to_json(text->see));
	free(path);
	return o;
}

static int print_text(const struct texts *t, const struct help_text *text, bool json,
                      const struct report *r)
{
	if (json)
		return print_json(json_pack("{s:[o], s:n, s:i}", "help", text_to_json(t, text),
		                            "worker", "found", 1));
	char *path = path_of(t, text->code), *page = help_print(t->help, text, WIDTH);
	int status = page ? 0 : status_exit(report_error(r, ST_RESOURCE, "memory ran out"));

	if (page)
		printf("%s%s%s", path ? path : "", path ? "\n" : "", page);
	free(path);
	free(page);
	return status;
}

int help_code(const char *code, bool json, const struct report *r)
{
	struct texts t;
	enum status st = texts_load(&t, r);
	int status = status_exit(st);

	if (st == ST_OK) {
		const struct help_text *text = help_find(t.help, code);
		status = text ? print_text(&t, text, json, r)
		              : status_exit(report_error(
		                        r, ST_PARAMETER,
		                        "there is no menu and no routine %s; batten help WORD "
		                        "searches all texts",
		                        code));
	}
	texts_finish(&t);
	return status;
}

static void print_hits(const struct texts *t, const struct help_hit *hits, size_t shown, size_t n)
{
	for (size_t k = 0; k < shown; k++) {
		char *path = path_of(t, hits[k].text->code);

		printf("  %-5s %s\n", hits[k].text->code, hits[k].text->title);
		if (path)
			printf("        %s\n", path);
		free(path);
	}
	if (n > shown)
		printf("  and %zu more\n", n - shown);
	printf("batten help %s explains %s\n", hits[0].text->code,
	       n == 1 ? "it" : "the first, and so on");
}

static int print_found(const struct texts *t, const char *words, json_t *worker, bool json,
                       size_t *n_found)
{
	struct help_hit hits[HITS_MAX];
	size_t n = help_search(t->help, &t->menus, words, hits, HITS_MAX);
	size_t shown = n < HITS_MAX ? n : HITS_MAX;

	*n_found = n;
	if (json && (n || worker)) {
		json_t *all = json_array();

		for (size_t k = 0; k < shown; k++)
			json_array_append_new(all, text_to_json(t, hits[k].text));
		return print_json(json_pack("{s:o, s:O?, s:I}", "help", all, "worker", worker,
		                            "found", (json_int_t)n));
	}
	if (n) {
		printf("%sroutines and menus:\n", worker ? "\n" : "");
		print_hits(t, hits, shown, n);
	}
	return 0;
}

int help_words(const char *words, json_t *worker, bool json, size_t *n_found,
               const struct report *r)
{
	struct texts t;
	enum status st = texts_load(&t, r);
	int status = status_exit(st);

	*n_found = 0;
	if (st == ST_OK)
		status = print_found(&t, words, worker, json, n_found);
	texts_finish(&t);
	return status;
}
