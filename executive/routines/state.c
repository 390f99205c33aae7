/* state.c - what can be run now, and what the settings are set to. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "number.h"
#include "private.h"
#include "text.h"

static const char *need_surface(const struct world *w)
{
	return world_current(w, false) ? NULL : "no surface";
}

static const char *need_curve(const struct world *w)
{
	return world_current(w, true) ? NULL : "no curve";
}

static const char *need_space_curve(const struct world *w)
{
	const struct Ful *f = world_current(w, true);

	return f && f->entity.kind == ENTITY_CURVE ? NULL : "no curve in space";
}

static const char *need_curve_on_surface(const struct world *w)
{
	const struct Ful *f = world_current(w, true);

	return f && f->entity.kind == ENTITY_CURVE_ON_SURFACE ? NULL : "no curve on a surface";
}

static const char *need_thing(const struct world *w)
{
	return world_count(w) ? NULL : "nothing is open";
}

static const char *need_undo(const struct world *w)
{
	return world_undo_name(w) ? NULL : "nothing to undo";
}

static const char *need_redo(const struct world *w)
{
	return world_redo_name(w) ? NULL : "nothing to redo";
}

static const struct {
	const char *need;
	const char *(*why)(const struct world *w);
} needs[] = {
	{ "surface", need_surface },
	{ "curve", need_curve },
	{ "space curve", need_space_curve },
	{ "curve on surface", need_curve_on_surface },
	{ "thing", need_thing },
	{ "undo", need_undo },
	{ "redo", need_redo },
};

const char *routine_greyed(const struct routine *t, const struct world *w)
{
	if (!t->run)
		return "later version";
	for (size_t k = 0; t->needs && k < sizeof needs / sizeof *needs; k++)
		if (!strcmp(needs[k].need, t->needs))
			return needs[k].why(w);
	return NULL;
}

/* The thing whose display a leaf sets. */
static const struct Ful *shown_by(const struct routine *t, const struct world *w)
{
	const bool curve = t->arguments != rows_surface_resolution && t->run != surface_on &&
	                   t->detail != ENTITY_SURFACE;

	return world_current(w, curve);
}

static void color_text(char out[16], struct rgb c)
{
	snprintf(out, 16, "#%02lX%02lX%02lX", lrint(255 * c.r), lrint(255 * c.g), lrint(255 * c.b));
}

/* What an argument is now, in script form; false: the table's default stands. */
static bool value_now(const struct routine *t, const char *name, const struct world *w,
                      char out[NUMBER_SIZE])
{
	const struct Ful *f = shown_by(t, w);
	const struct display *d = f ? &f->display : NULL;
	static const char *const lines[] = { "solid", "dashed", "dotted" };
	const struct sight *s = world_sight((struct world *)w);

	if (t->run == world_bell) {
		strcpy(out, s->bell ? "no" : "yes"); /* it toggles */
		return true;
	}
	if (t->run == image_on) {
		strcpy(out, s->no_image ? "yes" : "no");
		return true;
	}
	if (t->run == world_split) {
		strcpy(out, view_split_words[s->split]);
		return true;
	}
	if (t->run == world_background && s->has_background) {
		color_text(out, s->background);
		return true;
	}
	if (!d)
		return false;
	if (t->run == show_segments || (t->run == surface_resolution && !strcmp(name, "segments")))
		snprintf(out, NUMBER_SIZE, "%d", d->segments);
	else if (t->run == surface_resolution && !strncmp(name, "lines_", 6))
		snprintf(out, NUMBER_SIZE, "%d",
		         !strcmp(name, "lines_u") ? d->lines_u : d->lines_v);
	else if (t->run == show_samples)
		snprintf(out, NUMBER_SIZE, "%d", d->quills);
	else if (t->run == show_porcupine && !strcmp(name, "scale"))
		number_write(out, d->quill);
	else if (t->run == show_color && d->has_color)
		color_text(out, d->color);
	else if (t->run == show_line_type)
		strcpy(out, lines[d->line]);
	else if (t->run == surface_on)
		strcpy(out, d->on ? "no" : "yes");
	else
		return false;
	return true;
}

enum status rows_from_state(struct argument_row *rows, const struct routine *t,
                            const struct world *w)
{
	char now[NUMBER_SIZE];

	for (struct argument_row *row = rows; row->name; row++) {
		if (!value_now(t, row->name, w, now))
			continue;
		char *copy = strdup(now);
		if (!copy)
			return ST_RESOURCE;
		free((char *)row->def);
		row->def = copy;
	}
	return ST_OK;
}

/* Nothing was set, so what holds is what workers or the theme take. */
static bool by_default(const struct routine *t, const struct argument_row *rows)
{
	for (const struct argument_row *row = rows; row->name; row++)
		if (row->stores)
			return true;
	return t->run == show_color || t->run == world_background;
}

/* "400x200" reads better as "400 × 200". */
static void add_value(struct text *t, const struct argument_row *row, const char *value)
{
	const char *x = row->type == ARGUMENT_SIZE ? strchr(value, 'x') : NULL;

	text_add(t, t->n ? ", " : "");
	if (x)
		text_addf(t, "%.*s × %s", (int)(x - value), value, x + 1);
	else
		text_add(t, value);
}

static bool is_switch(const struct routine *t)
{
	return t->run == world_bell || t->run == surface_on || t->run == image_on;
}

void routine_state(const struct routine *t, const struct world *w, char out[48])
{
	struct argument_row *rows = NULL;
	struct text now = { 0 };
	char value[NUMBER_SIZE];

	*out = 0;
	if (t->kind != ROUTINE_SETTING && !is_switch(t) && t->run != world_split)
		return;
	if (rows_copy(&rows, t->arguments, w) != ST_OK)
		return;
	for (const struct argument_row *row = rows; row->name; row++) {
		const bool exact = t->run == surface_resolution && !strcmp(row->name, "segments") &&
		                   value_now(t, row->name, w, value) && !strcmp(value, "0");
		if (exact)
			continue; /* nothing to tell: as exact as can be seen */
		if (is_switch(t) && value_now(t, row->name, w, value))
			text_add(&now, !strcmp(value, "no") ? "on" : "off");
		else if (value_now(t, row->name, w, value))
			add_value(&now, row, value);
		else if (row->stores && row->def)
			add_value(&now, row, row->def);
	}
	if (!now.n && by_default(t, rows))
		text_add(&now, "default");
	/* cut between characters */
	size_t n = now.n < 47 ? now.n : 47;
	while (n && n < now.n && ((unsigned char)now.s[n] & 0xc0) == 0x80)
		n--;
	if (now.s)
		memcpy(out, now.s, n);
	out[n] = 0;
	text_finish(&now);
	routine_rows_free(rows);
}
