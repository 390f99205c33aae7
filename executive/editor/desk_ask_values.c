/* desk_ask_values.c - values offered for the field in focus: candidates, what was typed before, steps. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "desk_inside.h"
#include "number.h"

/* ------------------------------------------------------------ candidates */

void desk_ask_candidates(struct desk *d)
{
	struct ask *a = &d->ask;
	struct act act = desk_act(d);
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

	desk_ask_error(a, a->focus, NULL);
	desk_ask_candidates(d);
	desk_ask_dirty(d);
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

void desk_ask_remember(struct desk *d, const char *name, const char *value)
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

void desk_ask_recall(struct desk *d, int step)
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

/* ------------------------------------------------------------ steps */

/* A step of a number is its last digit's, of a choice the next one. */
bool desk_ask_step(struct desk *d, int up)
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

bool desk_ask_complete(struct desk *d)
{
	struct ask *a = &d->ask;
	const char *s = candidate(a, a->candidate < 0 ? 0 : a->candidate);

	/* where nothing is typed or chosen there is nothing to complete */
	if (!s || !strcmp(s, a->field[a->focus].s) || (a->candidate < 0 && !a->field[a->focus].n))
		return false;
	desk_ask_candidate(d, a->candidate < 0 ? 0 : a->candidate);
	return true;
}

bool desk_ask_up_down(struct desk *d, int down)
{
	struct ask *a = &d->ask;
	int n = (int)json_array_size(a->candidates);

	n = n > CANDIDATES_MAX ? CANDIDATES_MAX : n;
	if (n) {
		a->candidate = (a->candidate + down + n + (a->candidate < 0 && down < 0)) % n;
		desk_ask_dirty(d);
		return true;
	}
	if (!desk_ask_step(d, -down))
		desk_ask_recall(d, -down);
	return true;
}
