/* call.c - a routine with its arguments: checked, filled in, run, written down. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "path.h"
#include "private.h"
#include "text.h"

void act_say(const struct act *a, const char *format, ...)
{
	char *text = NULL;
	va_list args;

	if (!a->say)
		return;
	va_start(args, format);
	int n = vasprintf(&text, format, args);
	va_end(args);
	if (n >= 0)
		a->say(a->data, text);
	if (n >= 0)
		free(text);
}

enum status act_memory(const struct act *a)
{
	return report_error(&a->report, ST_RESOURCE, "memory ran out");
}

const struct Ful *act_current(const struct act *a, bool curve)
{
	const struct Ful *f = world_current(a->world, curve);

	if (!f)
		report_error(&a->report, ST_PARAMETER,
		             "there is no current %s; open one, or select it",
		             curve ? "curve" : "surface");
	return f;
}

const struct Ful *act_current_kind(const struct act *a, enum entity_kind kind)
{
	const struct Ful *f = act_current(a, kind != ENTITY_SURFACE);

	if (!f || f->entity.kind == kind)
		return f;
	report_error(&a->report, ST_PARAMETER, "the current curve '%s' is a %s; select a %s",
	             f->name, entity_kind_name(f->entity.kind), entity_kind_name(kind));
	return NULL;
}

char *act_path(const struct act *a, const char *name)
{
	return path_absolute(name, world_folder(a->world));
}

static const struct argument_row *find_row(const struct argument_row *rows, const char *name)
{
	for (; rows->name; rows++)
		if (!strcmp(rows->name, name))
			return rows;
	return NULL;
}

static enum status check_names(const struct routine *t, const struct argument_row *rows,
                               const struct arguments *given, const struct report *r)
{
	struct text names = { 0 };

	for (int k = 0; k < given->n; k++) {
		for (int j = 0; j < k; j++)
			if (!strcmp(given->name[j], given->name[k]))
				return report_error(r, ST_PARAMETER, "%s: %s is given twice",
				                    t->code, given->name[k]);
		if (find_row(rows, given->name[k]))
			continue;
		for (const struct argument_row *row = rows; row->name; row++)
			text_addf(&names, "%s%s", names.n ? ", " : "", row->name);
		enum status st = report_error(r, ST_PARAMETER, "%s has no argument %s; it has %s",
		                              t->code, given->name[k], names.n ? names.s : "none");
		text_finish(&names);
		return st;
	}
	return ST_OK;
}

/* Is it a word of the choice, rather than the want of a value? */
static bool auto_is_a_value(const struct argument_row *row)
{
	return row->stores || (row->choices && strstr(row->choices, "auto"));
}

/* As it is to be done again. Who did not say whether to wait saw the result come before going on with it,
 * or will: the next lines may need it. */
static enum status write_down(const struct act *a, const struct routine *t,
                              const struct arguments *full, const struct arguments *given)
{
	const bool said = argument_text(given, "wait") != NULL;
	const char *jobs = argument_text(full, "jobs");

	if (t->run == world_jobs && jobs && strcmp(jobs, "all"))
		return journal_remark(a, t, full);

	for (int k = 0; k < full->n && !said; k++)
		if (!strcmp(full->name[k], "wait"))
			full->value[k] = "yes";
	return journal_write(a, t, full);
}

/* What the journal of a session says of jobs that were killed there. */
static bool is_killed(const char *name, const char *value)
{
	return !strcmp(name, "wait") && value && !strcmp(value, "killed");
}

/* The value of each row: given, or the default; rows that are left out are not in the list. */
static enum status fill_in(const struct routine *t, const struct argument_row *rows,
                           const struct arguments *given, struct arguments *full,
                           const struct act *a)
{
	enum status st = ST_OK;

	for (const struct argument_row *row = rows; row->name && st == ST_OK; row++) {
		const char *value = argument_text(given, row->name);
		if (!value)
			value = row->def;
		if (!value && !row->optional)
			return report_error(&a->report, ST_PARAMETER, "%s needs %s=: %s", t->code,
			                    row->name, row->help);
		if (!value)
			continue;
		if (!is_killed(row->name, value))
			st = argument_check(row, value, a->world, &a->report);
		if (row->optional && !strcmp(value, "auto") && !auto_is_a_value(row))
			continue;
		full->name[full->n] = row->name;
		full->value[full->n++] = value;
	}
	return st;
}

/* A camera under that name. In the room that full has for all rows. */
static void fill_in_camera(struct arguments *full, const char *name, char room[CAMERA_TEXT_SIZE],
                           const struct camera *camera, const char *otherwise)
{
	if (argument_text(full, name))
		return;
	if (camera)
		camera_write(room, camera);
	else
		strcpy(room, otherwise);
	full->name[full->n] = name;
	full->value[full->n++] = room;
}

/* A picture that was not told a view is made from where the window looks when it begins, and of what it has
 * beside each other; the journal says which, so that it is the same picture again. */
static void fill_in_sight(struct arguments *full, char room[2][CAMERA_TEXT_SIZE],
                          const struct world *w)
{
	const struct sight *s = world_sight((struct world *)w);
	const char *shown = world_shows_seven(w) ? "curvatures" : view_split_words[s->split];

	for (int k = 0; k < full->n; k++)
		if (!strcmp(full->name[k], "views")) {
			if (!strcmp(full->value[k], "shown"))
				full->value[k] = shown;
			shown = full->value[k];
		}
	fill_in_camera(full, "view", room[0], s->has_camera ? &s->camera : NULL, "three-quarter");
	if (!strcmp(shown, view_split_words[SPLIT_SIDE]))
		fill_in_camera(full, "beside", room[1], s->has_beside ? &s->beside : NULL, "top");
}

static enum status call_with_rows(const struct routine *t, struct act *a,
                                  const struct argument_row *rows, const struct arguments *given)
{
	size_t n = 0;
	while (rows[n].name)
		n++;
	struct arguments full = { calloc(n + 1, sizeof *full.name),
		                  calloc(n + 1, sizeof *full.value), 0 };
	char camera[2][CAMERA_TEXT_SIZE];
	enum status st = full.name && full.value ? ST_OK : act_memory(a);

	if (st == ST_OK)
		st = check_names(t, rows, given, &a->report);
	if (st == ST_OK)
		st = fill_in(t, rows, given, &full, a);
	if (st == ST_OK && t->run == files_picture)
		fill_in_sight(&full, camera, a->world);
	if (st == ST_OK) {
		a->routine = t;
		a->n_jobs = 0;
		a->killed = is_killed("wait", argument_text(&full, "wait"));
		a->wait = a->killed || argument_yes(&full, "wait", a->wait);
		st = t->run(a, &full);
	}
	if (st == ST_OK && a->journal)
		st = write_down(a, t, &full, given);
	free(full.name);
	free(full.value);
	return st;
}

enum status routine_call(const struct routine *t, struct act *a, const struct arguments *given)
{
	const char *why = routine_greyed(t, a->world);
	struct argument_row *rows = NULL;
	const bool wait = a->wait;

	if (why)
		return report_error(&a->report, ST_PARAMETER, "%s cannot be run: %s", t->code, why);
	enum status st = routine_rows(&rows, t, a);
	if (st == ST_OK)
		st = call_with_rows(t, a, rows, given);
	routine_rows_free(rows);
	a->wait = wait;
	a->killed = false;
	return st;
}

/* Store a value under each of the names "worker.parameter" by blanks. */
static enum status store(struct world *w, const char *names, const char *value)
{
	enum status st = ST_OK;

	while (*names && st == ST_OK) {
		const size_t n = strcspn(names, " ");
		char *name = strndup(names, n), *point = name ? strchr(name, '.') : NULL;
		if (!point)
			st = ST_RESOURCE;
		else {
			*point = 0;
			st = world_set_default(w, name, point + 1, value);
		}
		free(name);
		names += n + (names[n] == ' ');
	}
	return st;
}

enum status setting_store(struct act *a, const struct arguments *given)
{
	enum status st = ST_OK;

	if (!given->n)
		return report_error(&a->report, ST_PARAMETER, "%s: give at least one of its values",
		                    a->routine->code);
	for (const struct argument_row *row = a->routine->arguments; row->name && st == ST_OK;
	     row++) {
		const char *value = argument_text(given, row->name);
		if (value && row->stores)
			st = store(a->world, row->stores, strcmp(value, "auto") ? value : NULL);
	}
	return st == ST_OK ? st : act_memory(a);
}
