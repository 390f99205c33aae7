/* candidates.c - what may stand for an argument, best first. */
#include <dirent.h>
#include <fnmatch.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "private.h"

enum { CANDIDATES_MAX = 200 };

/* Candidates found so far; jansson's list would be slow to sort. */
struct list {
	char **word; /* owned, and each */
	size_t n;
	bool failed;
};

static void add(struct list *l, const char *word, size_t n)
{
	char **more = reallocarray(l->word, l->n + 1, sizeof *more);

	if (more)
		l->word = more;
	if (!more || !(l->word[l->n] = strndup(word, n)))
		l->failed = true;
	else
		l->n++;
}

static bool matches(const char *name, const char *patterns)
{
	char *copy = strdup(patterns ? patterns : "*"), *rest = copy, *one;
	bool found = false;

	while (copy && !found && (one = strsep(&rest, " ")))
		found = *one && !fnmatch(one, name, FNM_PERIOD | FNM_CASEFOLD);
	free(copy);
	return found;
}

static void add_files(struct list *l, const char *folder, const char *patterns, const char *begin)
{
	DIR *d = opendir(folder);
	struct dirent *e;

	while (d && (e = readdir(d)))
		if (matches(e->d_name, patterns) && strcasestr(e->d_name, begin))
			add(l, e->d_name, strlen(e->d_name));
	if (d)
		closedir(d);
}

static bool is_meant(enum argument_type type, const struct Ful *f)
{
	return type == ARGUMENT_SURFACE  ? ful_is_surface(f)
	       : type == ARGUMENT_CURVE  ? ful_is_curve(f)
	       : type == ARGUMENT_POINTS ? f->entity.kind == ENTITY_POINTS
	                                 : true;
}

static void add_things(struct list *l, const struct world *w, enum argument_type type,
                       const char *begin)
{
	for (int k = 0; k < world_count(w); k++) {
		const struct Ful *f = world_at(w, k);
		if (is_meant(type, f) && !strncasecmp(f->name, begin, strlen(begin)))
			add(l, f->name, strlen(f->name));
	}
}

static void add_words(struct list *l, const char *words, const char *begin)
{
	for (const char *p = words; p && *p; p += strcspn(p, "|"), p += *p == '|')
		if (!strncasecmp(p, begin, strlen(begin)))
			add(l, p, strcspn(p, "|"));
}

/* What begins as typed comes first, then by name. */
static int compare(const void *x, const void *y, void *begin)
{
	const char *a = *(char *const *)x, *b = *(char *const *)y;
	const size_t n = strlen(begin);
	const int first = !strncasecmp(b, begin, n) - !strncasecmp(a, begin, n);

	return first ? first : strcmp(a, b);
}

json_t *argument_candidates(const struct argument_row *row, const char *begin, const struct act *a)
{
	struct list l = { 0 };
	json_t *out = json_array();

	switch (row->type) {
	case ARGUMENT_FILE:
	case ARGUMENT_OUTPUT:
		add_files(&l, world_folder(a->world), row->pattern, begin);
		break;
	case ARGUMENT_SURFACE:
	case ARGUMENT_CURVE:
	case ARGUMENT_THING:
	case ARGUMENT_POINTS:
		add_things(&l, a->world, row->type, begin);
		break;
	case ARGUMENT_CHOICE:
		add_words(&l, row->choices, begin);
		break;
	case ARGUMENT_YESNO:
		add_words(&l, "yes|no", begin);
		break;
	case ARGUMENT_VIEW:
		add_words(&l, "three-quarter|front|back|left|right|top|bottom", begin);
		break;
	case ARGUMENT_JOBS:
		add_words(&l, "all", begin);
		break;
	default:
		break;
	}
	if (l.n && (row->type == ARGUMENT_FILE || row->type == ARGUMENT_OUTPUT))
		qsort_r(l.word, l.n, sizeof *l.word, compare, (void *)(size_t)begin);
	for (size_t k = 0; k < l.n; k++) {
		if (k < CANDIDATES_MAX)
			json_array_append_new(out, json_string(l.word[k]));
		free(l.word[k]);
	}
	free(l.word);
	return out;
}
