/* help.h - the texts behind every menu and every routine: looked up by index, searched by words. */
#ifndef BATTEN_HELP_H
#define BATTEN_HELP_H

#include <stddef.h>

#include "menu.h"
#include "report.h"

enum { HELP_ARGUMENTS_MAX = 32 };

struct help_argument {
	char *name;    /* "grid" */
	char *range;   /* "NxM, 1 to 65536 each" */
	char *meaning; /* what it is */
};

/* One text. Strings are UTF-8, never NULL, "" where the part is missing. Paragraphs are lines without
 * breaks, a blank line between two. */
struct help_text {
	char *code;    /* "V79", "N31" */
	char *title;   /* "All curvatures of a surface" */
	char *purpose; /* paragraphs */
	struct help_argument arguments[HELP_ARGUMENTS_MAX];
	int n_arguments;
	char *result;  /* paragraphs: what comes out */
	char *example; /* lines of a script */
	char *see;     /* codes with blanks between: "V80 V174 N31" */
	int line;      /* in the help source */
};

struct help; /* all of them */

/*
 * Read the texts that were compiled with the program, then those of the user's and the project's own
 * (batten/help/own.help in the configuration folder, .batten/help/own.help), which replace texts or
 * add some. `project` is the project folder, NULL for none. A broken file of the user's is told by
 * help_complaint and left out.
 * Owner:  *out is the caller's, ended by help_destroy; texts are borrowed from it.
 * Errors: ST_INPUT (the program's own files are missing or of another version), ST_RESOURCE.
 */
enum status help_load(struct help **out, const char *project, const struct report *r);

/* Likewise from these: the folder with batten.msg and batten.ptr, then files in source form that may
 * be missing. */
enum status help_read(struct help **out, const char *folder, const char *const *own, size_t n_own,
                      const struct report *r);
void help_destroy(struct help *h);

/* The sentence about a broken file of the user's, or NULL. Borrowed. */
const char *help_complaint(const struct help *h);

/* The text of "V79" or "N31"; small letters do, too. NULL where there is none. Borrowed. */
const struct help_text *help_find(const struct help *h, const char *code);

size_t help_count(const struct help *h);
const struct help_text *help_at(const struct help *h, size_t k); /* N first, by number */

struct help_hit {
	const struct help_text *text; /* borrowed */
	int score;                    /* larger is better */
};

/*
 * The texts in which each of the words occurs, best first: code, then entry name and title, then the
 * texts themselves. `menus` gives the names of the entries; NULL: titles only. Gives back how many
 * there are in all; at most `max` are written to hits.
 */
size_t help_search(const struct help *h, const struct menu_set *menus, const char *words,
                   struct help_hit *hits, size_t max);

/*
 * The routines with names or titles most like what was typed, the likest first, for when help_search()
 * finds nothing; score is less by one for each letter that differs. Gives back how many were written to
 * hits, at most `max`; of no letters none.
 */
size_t help_nearest(const struct help *h, const struct menu_set *menus, const char *typed,
                    struct help_hit *hits, size_t max);

/* A text of h for a terminal, lines of at most `width` columns. Caller frees; NULL: memory ran out. */
char *help_print(const struct help *h, const struct help_text *t, int width);

/*
 * A text of h for the window, which lays it out itself: paragraphs, a line each; then, where they are
 * there, the lines Arguments, Result, Example and See also with theirs below them. An argument is
 * NAME, tab, RANGE, tab, MEANING; a link CODE, blank, TITLE. Caller frees; NULL: memory ran out.
 */
char *help_page(const struct help *h, const struct help_text *t);

#endif
