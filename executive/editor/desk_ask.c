/* desk_ask.c - a leaf's arguments: form and prompt line are one input shown twice. */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "desk_inside.h"

void desk_ask_dirty(struct desk *d)
{
	desk_dirty(d, desk_bit(PART_MENU) | desk_bit(PART_FOOT) | desk_bit(PART_MOUSE));
}

enum form_kind desk_form_kind(const struct argument_row *row)
{
	switch (row->type) {
	case ARGUMENT_CHOICE:
		return FORM_CHOICE;
	case ARGUMENT_YESNO:
		return FORM_YESNO;
	default:
		return FORM_TEXT;
	}
}

bool desk_ask_textual(const struct desk *d)
{
	const struct ask *a = &d->ask;

	return a->routine && a->focus >= 0 && a->focus < a->n &&
	       desk_form_kind(&a->rows[a->focus]) == FORM_TEXT;
}

struct act desk_act(struct desk *d)
{
	return (struct act){ .world = d->world, .project = d->house.project };
}

void desk_ask_error(struct ask *a, int field, const char *text)
{
	free(a->error[field]);
	a->error[field] = text && *text ? strdup(text) : NULL;
}

/* ------------------------------------------------------------ begin and end */

void desk_ask_end(struct desk *d)
{
	struct ask *a = &d->ask;

	if (!a->routine)
		return;
	for (int i = 0; i < a->n; i++)
		if (a->error)
			free(a->error[i]);
	free(a->error);
	free(a->field);
	json_decref(a->candidates);
	routine_rows_free(a->rows);
	*a = (struct ask){ 0 };
	desk_ask_dirty(d);
}

static void fill_defaults(struct ask *a)
{
	for (int i = 0; i < a->n; i++) {
		typed_set(&a->field[i], a->rows[i].def ? a->rows[i].def : "");
		desk_ask_error(a, i, NULL);
	}
}

/* The first that has no value, else the first. */
static int first_to_ask(const struct ask *a)
{
	for (int i = 0; i < a->n; i++)
		if (!a->field[i].n && !a->rows[i].optional)
			return i;
	return 0;
}

/* What went wrong elsewhere is over for who asks for something else; F4 still has it. */
static void pass_message(struct desk *d, const struct routine *t)
{
	struct message_line *last = d->n_messages ? &d->messages[d->n_messages - 1] : NULL;

	if (last && !last->done && last->of != t)
		last->past = true;
}

void desk_ask(struct desk *d, const struct routine *t, const struct Menu_Entry *e)
{
	struct argument_row *rows = NULL;
	struct report_store store;
	struct act act = desk_act(d);
	int n = 0;

	report_store_init(&store);
	act.report = store.report;
	if (routine_rows(&rows, t, &act) != ST_OK) {
		desk_say(d, REPORT_ERROR, "%s", store.error);
		return;
	}
	while (rows && rows[n].name && n < FIELDS_MAX)
		n++;
	if (n && !strcmp(rows[n - 1].name, "wait")) /* the window never does */
		n--;
	if (!n) {
		routine_rows_free(rows);
		struct arguments none = { 0 };
		enum tool tool = desk_leaf_tool(t->code);
		desk_run(d, t, &none);
		if (tool != TOOL_NONE)
			desk_tool_begin(d, tool);
		return;
	}
	struct ask *a = &d->ask;
	*a = (struct ask){ .routine = t, .entry = e, .rows = rows, .n = n, .candidate = -1 };
	a->field = calloc((size_t)n, sizeof *a->field);
	a->error = calloc((size_t)n, sizeof *a->error);
	if (!a->field || !a->error) {
		desk_ask_end(d);
		desk_say(d, REPORT_ERROR, "memory ran out");
		return;
	}
	pass_message(d, t);
	fill_defaults(a);
	if (desk_leaf_tool(t->code) != TOOL_NONE)
		desk_tool_begin(d, desk_leaf_tool(t->code));
	desk_ask_focus(d, first_to_ask(a));
}

void desk_ask_defaults(struct desk *d)
{
	if (!d->ask.routine)
		return;
	fill_defaults(&d->ask);
	desk_ask_changed(d);
	desk_tool_changed(d);
}

/* ------------------------------------------------------------ values */

int desk_ask_find(const struct desk *d, const char *name)
{
	for (int i = 0; d->ask.routine && i < d->ask.n; i++)
		if (!strcmp(d->ask.rows[i].name, name))
			return i;
	return -1;
}

const char *desk_ask_get(const struct desk *d, const char *name)
{
	int i = desk_ask_find(d, name);

	return i < 0 ? NULL : d->ask.field[i].s;
}

void desk_ask_set(struct desk *d, const char *name, const char *format, ...)
{
	char value[256];
	va_list list;
	int i = desk_ask_find(d, name);

	if (i < 0)
		return;
	va_start(list, format);
	vsnprintf(value, sizeof value, format, list);
	va_end(list);
	typed_set(&d->ask.field[i], value);
	desk_ask_error(&d->ask, i, NULL);
	desk_ask_dirty(d);
}

/* A step of a number is its last digit's, of a choice the next one. */

void desk_ask_focus(struct desk *d, int field)
{
	struct ask *a = &d->ask;

	if (!a->routine || field < 0 || field >= a->n)
		return;
	a->focus = field;
	a->back = 0;
	typed_end(&a->field[field]);
	desk_ask_candidates(d);
	desk_ask_dirty(d);
}

/* ------------------------------------------------------------ accepting */

/* Every field right? The first that is not gets the focus. */
static bool check_all(struct desk *d)
{
	struct ask *a = &d->ask;
	int bad = -1;

	for (int i = a->n - 1; i >= 0; i--) {
		struct report_store store;
		const struct argument_row *row = &a->rows[i];
		report_store_init(&store);
		desk_ask_error(a, i, NULL);
		if (!a->field[i].n && row->optional)
			continue;
		if (!a->field[i].n && !row->def) {
			desk_ask_error(a, i, "a value is needed");
			bad = i;
		} else if (a->field[i].n &&
		           argument_check(row, a->field[i].s, d->world, &store.report) != ST_OK) {
			desk_ask_error(a, i, store.error);
			bad = i;
		}
	}
	if (bad < 0)
		return true;
	char *kept = a->error[bad];
	a->focus = bad;
	typed_place(&a->field[bad], (int)argument_wrong_at(&a->rows[bad], a->field[bad].s));
	desk_ask_candidates(d);
	desk_say(d, REPORT_ERROR, "%s: %s.", a->rows[bad].prompt, kept);
	desk_ask_dirty(d);
	return false;
}

/* What is typed, borrowed; and into the history with it. */
static void collect(struct desk *d, const struct ask *a, struct arguments *given)
{
	for (int i = 0; i < a->n; i++) {
		if (!a->field[i].n)
			continue;
		given->name[given->n] = a->rows[i].name;
		given->value[given->n++] = a->field[i].s;
		desk_ask_remember(d, a->rows[i].name, a->field[i].s);
	}
}

void desk_ask_accept(struct desk *d)
{
	const char *name[FIELDS_MAX], *value[FIELDS_MAX];
	struct arguments given = { name, value, 0 };
	struct ask *a = &d->ask;

	if (!a->routine || desk_busy(d) || !check_all(d))
		return;
	collect(d, a, &given);
	/* the form goes before the routine runs: what it changes is not taken back with the form */
	struct ask kept = *a;
	*a = (struct ask){ 0 };
	desk_tool_end(d);
	desk_run(d, kept.routine, &given);
	struct ask fresh = *a;
	*a = kept;
	desk_ask_end(d);
	*a = fresh;
	desk_ask_dirty(d);
}

void desk_ask_run(struct desk *d)
{
	const char *name[FIELDS_MAX], *value[FIELDS_MAX];
	struct arguments given = { name, value, 0 };

	if (!d->ask.routine || desk_busy(d) || !check_all(d))
		return;
	collect(d, &d->ask, &given);
	desk_run(d, d->ask.routine, &given);
}
