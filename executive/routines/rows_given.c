/* rows_given.c - the rows asked for now: of a job those of its worker, with what is set as default. */
#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "private.h"
#include "roster.h"
#include "text.h"

/* worker's word for a type, ours */
static const struct {
	const char *word;
	enum argument_type type;
} types[] = {
	{ "integer", ARGUMENT_INTEGER }, { "real", ARGUMENT_NUMBER }, { "size", ARGUMENT_SIZE },
	{ "vector", ARGUMENT_VECTOR },   { "flag", ARGUMENT_YESNO },  { "choice", ARGUMENT_CHOICE },
	{ "color", ARGUMENT_COLOR },     { "view", ARGUMENT_VIEW },
};

static enum argument_type type_of(const char *word)
{
	for (size_t k = 0; k < sizeof types / sizeof *types; k++)
		if (!strcmp(types[k].word, word))
			return types[k].type;
	return ARGUMENT_TEXT;
}

/* A row with texts of its own. */
static bool row_own(struct argument_row *out, const struct argument_row *row)
{
	const char *const texts[] = { row->name,    row->prompt,  row->def, row->unit,
		                      row->choices, row->pattern, row->help };
	const char **const fields[] = { &out->name,    &out->prompt,  &out->def, &out->unit,
		                        &out->choices, &out->pattern, &out->help };
	bool good = true;

	*out = *row;
	for (size_t k = 0; k < sizeof texts / sizeof *texts; k++) {
		*fields[k] = texts[k] ? strdup(texts[k]) : NULL;
		good = good && !*fields[k] == !texts[k];
	}
	return good;
}

static void row_free(struct argument_row *row)
{
	const char *const texts[] = { row->name,    row->prompt,  row->def, row->unit,
		                      row->choices, row->pattern, row->help };

	for (size_t k = 0; k < sizeof texts / sizeof *texts; k++)
		free((char *)texts[k]);
}

void routine_rows_free(struct argument_row *rows)
{
	for (struct argument_row *row = rows; row && row->name; row++)
		row_free(row);
	free(rows);
}

static char *stored_default(const struct argument_row *row, const struct world *w)
{
	const size_t n = strcspn(row->stores, " ");
	char *name = strndup(row->stores, n), *point = name ? strchr(name, '.') : NULL;
	const char *value = NULL;

	if (point) {
		*point = 0;
		value = world_default(w, name, point + 1);
	}
	char *copy = value ? strdup(value) : NULL;
	free(name);
	return copy;
}

enum status rows_copy(struct argument_row **out, const struct argument_row *rows,
                      const struct world *w)
{
	size_t n = 0;

	while (rows && rows[n].name)
		n++;
	*out = calloc(n + 1, sizeof **out);
	if (!*out)
		return ST_RESOURCE;
	for (size_t k = 0; k < n; k++) {
		struct argument_row row = rows[k];
		char *stored = row.stores ? stored_default(&row, w) : NULL;
		if (stored)
			row.def = stored;
		bool good = row_own(&(*out)[k], &row);
		free(stored);
		if (!good) {
			row_free(&(*out)[k]);
			(*out)[k].name = NULL;
			routine_rows_free(*out);
			*out = NULL;
			return ST_RESOURCE;
		}
	}
	return ST_OK;
}

static char *choices_of(const json_t *o)
{
	const json_t *list = json_object_get(o, "choices");
	struct text t = { 0 };

	for (size_t k = 0; k < json_array_size(list); k++) {
		const char *word = json_string_value(json_array_get(list, k));
		text_addf(&t, "%s%s", k ? "|" : "", word ? word : "");
	}
	return text_take(&t);
}

/* One parameter of a description as a row, its default as it is set now. */
static enum status row_of_parameter(struct argument_row *out, const struct routine *t,
                                    const json_t *o, const struct world *w)
{
	const char *name = json_text(o, "name", "");
	const char *set = world_default(w, t->worker, name);
	const bool is_contours = !strcmp(t->worker, "contours");
	char *choices = json_is_array(json_object_get(o, "choices")) ? choices_of(o) : NULL;
	char *found = is_contours ? contours_default(w, t->detail == 1, name) : NULL;
	const bool ranged = json_is_number(json_object_get(o, "min")) &&
	                    json_is_number(json_object_get(o, "max"));
	const struct argument_row row = {
		.name = name,
		.type = type_of(json_text(o, "type", "")),
		.prompt = name,
		.def = found ? found
		       : set ? set
		             : json_text(o, "default", NULL),
		.min = ranged ? json_number(o, "min", 0) : 1,
		.max = ranged ? json_number(o, "max", 0) : 0,
		.unit = json_text(o, "unit", NULL),
		.choices = choices,
		.help = json_text(o, "help", NULL),
		.optional = true,
	};

	bool good = row_own(out, &row);
	free(choices);
	free(found);
	if (!good)
		row_free(out);
	return good ? ST_OK : ST_RESOURCE;
}

static const struct argument_row row_wait = {
	.name = "wait", .type = ARGUMENT_YESNO, .prompt = "Wait", .help = "until the job has ended"
};

enum status rows_of_worker(struct argument_row **out, const struct routine *t, struct act *a)
{
	struct roster roster = { 0 };
	enum status st = roster_read(&roster, a->project, t->worker, &a->report);
	const struct roster_worker *w = st == ST_OK ? roster_find(&roster, t->worker) : NULL;
	size_t n = 0, k;
	json_t *o;

	*out = NULL;
	if (st == ST_OK && (!w || w->broken))
		st = report_error(&a->report, ST_PARAMETER, "worker '%s' cannot be used: %s",
		                  t->worker, w ? w->broken : "there is none of that name");
	const json_t *parameters = w ? json_object_get(w->description, "parameters") : NULL;
	if (st == ST_OK && !(*out = calloc(json_array_size(parameters) + 2, sizeof **out)))
		st = act_memory(a);
	json_array_foreach(parameters, k, o)
	{
		if (t->run == job_contours &&
		    contours_is_other(t->detail == 1, json_text(o, "name", "")))
			continue;
		if (st == ST_OK && (st = row_of_parameter(&(*out)[n], t, o, a->world)) == ST_OK)
			n++;
	}
	if (st == ST_OK) {
		struct argument_row row = row_wait;
		row.def = a->wait ? "yes" : "no";
		st = row_own(&(*out)[n], &row) ? ST_OK : ST_RESOURCE;
	}
	if (st != ST_OK && *out) {
		(*out)[n].name = NULL;
		routine_rows_free(*out);
		*out = NULL;
	}
	roster_finish(&roster);
	return st;
}

/* One more row: wait, for leaves that may start a job. */
static enum status add_wait(struct argument_row **rows, const struct act *a)
{
	size_t n = 0;

	while ((*rows)[n].name)
		n++;
	struct argument_row *more = reallocarray(*rows, n + 2, sizeof *more);
	if (!more)
		return ST_RESOURCE;
	struct argument_row row = row_wait;
	row.def = a->wait ? "yes" : "no";
	*rows = more;
	more[n + 1] = (struct argument_row){ 0 };
	if (row_own(&more[n], &row))
		return ST_OK;
	row_free(&more[n]);
	more[n].name = NULL;
	return ST_RESOURCE;
}

enum status routine_rows(struct argument_row **out, const struct routine *t, struct act *a)
{
	if (t->worker)
		return rows_of_worker(out, t, a);
	enum status st = rows_copy(out, t->arguments, a->world);
	if (st == ST_OK && t->run == surface_quantity)
		st = add_wait(out, a);
	if (st == ST_OK)
		st = rows_from_state(*out, t, a->world);
	if (st != ST_OK) {
		routine_rows_free(*out);
		*out = NULL;
		return act_memory(a);
	}
	return st;
}
