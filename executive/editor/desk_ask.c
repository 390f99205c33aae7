/* desk_ask.c - a leaf's arguments: form and prompt line are one input shown twice. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "desk_inside.h"
#include "number.h"

static void asked(struct desk *d)
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

static struct act act_of(struct desk *d)
{
	return (struct act){ .world = d->world, .project = d->house.project };
}

static void set_error(struct ask *a, int field, const char *text)
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
	asked(d);
}

static void fill_defaults(struct ask *a)
{
	for (int i = 0; i < a->n; i++) {
		typed_set(&a->field[i], a->rows[i].def ? a->rows[i].def : "");
		set_error(a, i, NULL);
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

void desk_ask(struct desk *d, const struct routine *t, const struct Menu_Entry *e)
{
	struct argument_row *rows = NULL;
	struct report_store store;
	struct act act = act_of(d);
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

/* ------------------------------------------------------------ candidates */

static void find_candidates(struct desk *d)
{
	struct ask *a = &d->ask;
	struct act act = act_of(d);
	const struct argument_row *row = &a->rows[a->focus];

	json_decref(a->candidates);
	a->candidates = NULL;
	a->candidate = -1;
	if (desk_form_kind(row) == FORM_TEXT)
		a->candidates = argument_candidates(row, a->field[a->focus].s, &act);
	/* one that is there in full already is no offer */
	if (json_array_size(a->candidates) == 1 &&
	    !strcmp(json_string_value(json_array_get(a->candidates, 0)), a->field[a->focus].s))
		json_array_clear(a->candidates);
}

static const char *candidate(const struct ask *a, int k)
{
	const char *s = json_string_value(json_array_get(a->candidates, (size_t)k));

	return k >= 0 && s ? s : NULL;
}

void desk_ask_changed(struct desk *d)
{
	struct ask *a = &d->ask;

	set_error(a, a->focus, NULL);
	find_candidates(d);
	asked(d);
}

void desk_ask_focus(struct desk *d, int field)
{
	struct ask *a = &d->ask;

	if (!a->routine || field < 0 || field >= a->n)
		return;
	a->focus = field;
	a->back = 0;
	typed_end(&a->field[field]);
	find_candidates(d);
	asked(d);
}

void desk_ask_candidate(struct desk *d, int k)
{
	struct ask *a = &d->ask;
	const char *s = a->routine ? candidate(a, k) : NULL;

	if (!s)
		return;
	char *copy = strdup(s); /* the candidates go with the change */
	if (copy)
		typed_set(&a->field[a->focus], copy);
	free(copy);
	desk_ask_changed(d);
	desk_tool_changed(d);
}

/* ------------------------------------------------------------ history */

static void remember(struct desk *d, const char *name, const char *value)
{
	struct remembered *h = d->history;

	for (int i = 0; i < d->n_history; i++)
		if (!strcmp(h[i].name, name) && !strcmp(h[i].value, value)) {
			struct remembered same = h[i];
			memmove(h + i, h + i + 1, (size_t)(d->n_history - i - 1) * sizeof *h);
			h[d->n_history - 1] = same;
			return;
		}
	struct remembered fresh = { strdup(name), strdup(value) };
	if (!fresh.name || !fresh.value) {
		free(fresh.name);
		free(fresh.value);
		return;
	}
	if (d->n_history == HISTORY_MAX) {
		free(h[0].name);
		free(h[0].value);
		memmove(h, h + 1, (HISTORY_MAX - 1) * sizeof *h);
		d->n_history--;
	}
	h[d->n_history++] = fresh;
}

static void recall(struct desk *d, int step)
{
	struct ask *a = &d->ask;
	int want = a->back + step, seen = 0;

	if (want < 0)
		return;
	if (want == 0) {
		a->back = 0;
		typed_set(&a->field[a->focus], a->rows[a->focus].def ? a->rows[a->focus].def : "");
		desk_ask_changed(d);
		return;
	}
	for (int i = d->n_history - 1; i >= 0; i--)
		if (!strcmp(d->history[i].name, a->rows[a->focus].name) && ++seen == want) {
			a->back = want;
			typed_set(&a->field[a->focus], d->history[i].value);
			desk_ask_changed(d);
			return;
		}
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
	set_error(&d->ask, i, NULL);
	asked(d);
}

/* A step of a number is its last digit's, of a choice the next one. */
static bool step_value(struct desk *d, int up)
{
	struct ask *a = &d->ask;
	const struct argument_row *row = &a->rows[a->focus];
	struct typed *t = &a->field[a->focus];
	double x;

	if (row->type == ARGUMENT_YESNO) {
		typed_set(t, strcmp(t->s, "yes") ? "yes" : "no");
	} else if (row->type == ARGUMENT_CHOICE && row->choices) {
		int at = 0, n = 1, k = 0;
		for (const char *p = row->choices; *p; p++)
			n += *p == '|';
		for (const char *p = row->choices; *p; k++) {
			size_t length = strcspn(p, "|");
			if (length == (size_t)t->n && !strncmp(p, t->s, length))
				at = k;
			p += length + (p[length] == '|');
		}
		desk_ask_choice(d, a->focus, (at + up + n) % n);
		return true;
	} else if ((row->type == ARGUMENT_NUMBER || row->type == ARGUMENT_INTEGER) &&
	           number_parse(t->s, &x)) {
		const char *point = strchr(t->s, '.');
		int digits = point && !strpbrk(t->s, "eE") ? (int)strlen(point + 1) : 0;
		double to = x + up * pow(10, -digits);
		char text[64];
		if (row->min <= row->max)
			to = fmin(fmax(to, row->min), row->max);
		snprintf(text, sizeof text, "%.*f", digits, to);
		typed_set(t, text);
	} else {
		return false;
	}
	desk_ask_changed(d);
	desk_tool_changed(d);
	return true;
}

void desk_ask_choice(struct desk *d, int field, int part)
{
	struct ask *a = &d->ask;

	if (!a->routine || field < 0 || field >= a->n)
		return;
	const struct argument_row *row = &a->rows[field];
	a->focus = field;
	if (row->type == ARGUMENT_YESNO) {
		typed_set(&a->field[field], strcmp(a->field[field].s, "yes") ? "yes" : "no");
	} else {
		const char *p = row->choices ? row->choices : "";
		char value[64];
		for (int k = 0; k < part && *p; k++) {
			p += strcspn(p, "|");
			p += *p == '|';
		}
		snprintf(value, sizeof value, "%.*s", (int)strcspn(p, "|"), p);
		typed_set(&a->field[field], value);
	}
	desk_ask_changed(d);
	desk_tool_changed(d);
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
		set_error(a, i, NULL);
		if (!a->field[i].n && row->optional)
			continue;
		if (!a->field[i].n && !row->def) {
			set_error(a, i, "a value is needed");
			bad = i;
		} else if (a->field[i].n &&
		           argument_check(row, a->field[i].s, d->world, &store.report) != ST_OK) {
			set_error(a, i, store.error);
			bad = i;
		}
	}
	if (bad < 0)
		return true;
	char *kept = a->error[bad];
	a->focus = bad;
	find_candidates(d);
	desk_say(d, REPORT_ERROR, "%s: %s.", a->rows[bad].prompt, kept);
	asked(d);
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
		remember(d, a->rows[i].name, a->field[i].s);
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
	desk_tool_end(d, true);
	desk_run(d, kept.routine, &given);
	struct ask fresh = *a;
	*a = kept;
	desk_ask_end(d);
	*a = fresh;
	asked(d);
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

/* ------------------------------------------------------------ keys */

static bool complete(struct desk *d)
{
	struct ask *a = &d->ask;
	const char *s = candidate(a, a->candidate < 0 ? 0 : a->candidate);

	/* where nothing is typed or chosen there is nothing to complete */
	if (!s || !strcmp(s, a->field[a->focus].s) || (a->candidate < 0 && !a->field[a->focus].n))
		return false;
	desk_ask_candidate(d, a->candidate < 0 ? 0 : a->candidate);
	return true;
}

static bool up_down(struct desk *d, int down)
{
	struct ask *a = &d->ask;
	int n = (int)json_array_size(a->candidates);

	n = n > CANDIDATES_MAX ? CANDIDATES_MAX : n;
	if (n) {
		a->candidate = (a->candidate + down + n + (a->candidate < 0 && down < 0)) % n;
		asked(d);
		return true;
	}
	if (!step_value(d, -down))
		recall(d, -down);
	return true;
}

bool desk_ask_key(struct desk *d, enum desk_key key, unsigned mods)
{
	struct ask *a = &d->ask;
	struct typed *t = &a->field[a->focus];
	bool text = desk_ask_textual(d), changed = false;

	switch ((int)key) {
	case KEY_ENTER:
		if (a->candidate >= 0)
			desk_ask_candidate(d, a->candidate);
		else
			desk_ask_accept(d);
		return true;
	case KEY_TAB:
		if ((mods & MOD_SHIFT) || !text || !complete(d))
			desk_ask_focus(d, (a->focus + (mods & MOD_SHIFT ? a->n - 1 : 1)) % a->n);
		return true;
	case KEY_UP:
		return up_down(d, -1);
	case KEY_DOWN:
		return up_down(d, 1);
	case KEY_LEFT:
		if (text)
			typed_left(t);
		else
			step_value(d, -1);
		asked(d);
		return true;
	case KEY_RIGHT:
		if (!text)
			step_value(d, 1);
		else if (!typed_right(t))
			complete(d);
		asked(d);
		return true;
	case KEY_HOME:
		asked(d);
		return text && (typed_home(t), true);
	case KEY_END:
		asked(d);
		return text && (typed_end(t), true);
	case KEY_BACKSPACE:
		changed = mods & MOD_CTRL ? typed_backspace_word(t) : typed_backspace(t);
		break;
	case KEY_DELETE:
		changed = typed_delete(t);
		break;
	case KEY_CTRL_A + 'U' - 'A':
		changed = typed_clear(t);
		break;
	case KEY_CTRL_A + 'R' - 'A':
		desk_ask_defaults(d);
		return true;
	case KEY_CTRL_A + 'P' - 'A':
		recall(d, 1);
		return true;
	case KEY_CTRL_A + 'N' - 'A':
		recall(d, -1);
		return true;
	case KEY_CTRL_A + 'V' - 'A':
		if (text && d->ports.paste && d->ports.paste(d->ports.data)) {
			typed_insert_text(t, d->ports.paste(d->ports.data));
			changed = true;
		}
		break;
	case KEY_CTRL_A + 'C' - 'A':
		if (d->ports.copy)
			d->ports.copy(d->ports.data, t->s);
		return true;
	default:
		return false;
	}
	if (changed) {
		desk_ask_changed(d);
		desk_tool_changed(d);
	}
	return true;
}

bool desk_ask_text(struct desk *d, uint32_t c)
{
	struct ask *a = &d->ask;

	if (!a->routine)
		return false;
	if (!desk_ask_textual(d))
		return c == ' ' && step_value(d, 1);
	if (typed_insert(&a->field[a->focus], c)) {
		desk_ask_changed(d);
		desk_tool_changed(d);
	}
	return true;
}
