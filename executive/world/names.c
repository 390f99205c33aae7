/* names.c - names of things: unique, fit for file names, found again. */
#include <stdlib.h>
#include <string.h>

#include "path.h"
#include "text.h"
#include "world_private.h"

enum { NAME_MAX_BYTES = 120, LISTED = 12 };

/* A name is part of a file's name, and stands in lists by comma. */
static bool is_fit(char c)
{
	return (unsigned char)c > 0x20 && c != 0x7f && !strchr("/#,;\"\\", c);
}

static bool is_taken(const struct world *w, int but, const char *name)
{
	for (int k = 0; k < w->n; k++)
		if (w->things[k]->id != but && !strcmp(w->things[k]->name, name))
			return true;
	return false;
}

char *name_unique(const struct world *w, const char *wish)
{
	char *base = strndup(*wish ? wish : "thing", NAME_MAX_BYTES);

	for (char *c = base; c && *c; c++)
		if (!is_fit(*c) || (c == base && *c == '.'))
			*c = '_';
	if (!base || !is_taken(w, 0, base))
		return base;
	for (int k = 2;; k++) {
		char *name = text_print("%s-%d", base, k);
		if (!name || !is_taken(w, 0, name)) {
			free(base);
			return name;
		}
		free(name);
	}
}

enum status name_check(const struct world *w, int id, const char *name, const struct report *r)
{
	bool fit = *name && *name != '.' && strlen(name) <= NAME_MAX_BYTES;

	for (const char *c = name; *c; c++)
		fit = fit && is_fit(*c);
	if (!fit)
		return report_error(
		        r, ST_PARAMETER,
		        "'%s' cannot be a name; it becomes a file's: no blanks and none of "
		        "/ # , ; \" \\, no point in front, %d bytes at most",
		        name, NAME_MAX_BYTES);
	if (is_taken(w, id, name))
		return report_error(r, ST_PARAMETER,
		                    "'%s' is the name of another thing; choose one that is free",
		                    name);
	return ST_OK;
}

/* FILE#3, FILE#D15: of that file, as it was given or by its name alone. */
static bool is_entity_of(const struct Ful *f, const char *name)
{
	const char *mark = strrchr(name, '#');
	const size_t n = mark ? (size_t)(mark - name) : 0;

	if (!mark || !f->file)
		return false;
	if ((strncmp(f->file, name, n) || f->file[n]) &&
	    (strncmp(path_file_name(f->file), name, n) || path_file_name(f->file)[n]))
		return false;
	mark++;
	if (*mark == 'D' && f->entity.de)
		return atoi(mark + 1) == f->entity.de;
	return f->entity.number && atoi(mark) == f->entity.number;
}

static const struct Ful *find_label(const struct world *w, const char *name)
{
	const struct Ful *found = NULL;

	for (int k = 0; k < w->n; k++) {
		const char *label = w->things[k]->entity.name;
		if (!label || strcmp(label, name))
			continue;
		if (found)
			return NULL;
		found = w->things[k];
	}
	return found;
}

static void say_missing(const struct world *w, const char *name, const struct report *r)
{
	struct text t = { 0 };

	for (int k = 0; k < w->n && k < LISTED; k++)
		text_addf(&t, "%s%s", k ? ", " : "", w->things[k]->name);
	if (w->n > LISTED)
		text_addf(&t, " and %d more", w->n - LISTED);
	report_error(r, ST_PARAMETER, "'%s' is not open; open are: %s", name,
	             w->n && t.s ? t.s : "nothing");
	text_finish(&t);
}

const struct Ful *world_find(const struct world *w, const char *name, const struct report *r)
{
	for (int k = 0; k < w->n; k++)
		if (!strcmp(w->things[k]->name, name))
			return w->things[k];
	for (int k = 0; k < w->n; k++)
		if (is_entity_of(w->things[k], name))
			return w->things[k];
	const struct Ful *f = find_label(w, name);
	if (!f)
		say_missing(w, name, r);
	return f;
}
