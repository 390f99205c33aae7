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
static const struct argument_row row_surfaces = {
	.name = "surfaces",
	.type = ARGUMENT_CHOICE,
	.prompt = "Surfaces",
	.choices = "current|shown",
	.help = "of the current surface, or of each that is shown"
};

/* Leaves that have always been for the whole scene: images, contours and reflection lines. */
static bool is_for_scene(const struct routine *t)
{
	return t->run == job_contours || t->run == job_image || t->run == contours_show ||
	       (t->run == job_lines && !strcmp(t->worker, "reflection")) ||
	       (t->run == surface_show_lines && t->detail);
}

static bool takes_surfaces(const struct routine *t)
{
	return t->run == surface_quantity || t->run == surface_show_lines || t->run == job_lines ||
	       t->run == job_curvature || t->run == surface_resolution || is_for_scene(t);
}

/* Rows that leaves have beside those of the table or of their worker; *rows has grown by them. */
static enum status add_rows(struct argument_row **rows, const struct routine *t,
                            const struct act *a)
{
	struct argument_row more[2];
	int n_more = 0;
	size_t n = 0;

	if (takes_surfaces(t)) { /* a script says what it means; a window shows what is there */
		more[n_more] = row_surfaces;
		more[n_more++].def = t->run == surface_resolution || (a->wait && !is_for_scene(t))
		                             ? "current"
		                             : "shown";
	}
	if (t->worker || t->run == surface_quantity) {
		more[n_more] = row_wait;
		more[n_more++].def = a->wait ? "yes" : "no";
	}
	while ((*rows)[n].name)
		n++;
	struct argument_row *all = reallocarray(*rows, n + (size_t)n_more + 1, sizeof *all);
	if (!all)
		return ST_RESOURCE;
	*rows = all;
	for (int k = 0; k < n_more; k++) {
		const bool good = row_own(&all[n], &more[k]);
		if (!good)
			row_free(&all[n]);
		all[n += good] = (struct argument_row){ 0 };
		if (!good)
			return ST_RESOURCE;
	}
	return ST_OK;
}

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
	if (st == ST_OK && !(*out = calloc(json_array_size(parameters) + 1, sizeof **out)))
		st = act_memory(a);
	json_array_foreach(parameters, k, o)
	{
		if (t->run == job_contours &&
		    contours_is_other(t->detail == 1, json_text(o, "name", "")))
			continue;
		if (st == ST_OK && (st = row_of_parameter(&(*out)[n], t, o, a->world)) == ST_OK)
			n++;
	}
	if (st != ST_OK && *out) {
		(*out)[n].name = NULL;
		routine_rows_free(*out);
		*out = NULL;
	}
	roster_finish(&roster);
	return st;
}

/* What the worker takes where nothing was set, of a setting that is stored for it. Fresh or NULL. */
static char *worker_default(const struct act *a, const char *stores)
{
	const size_t n = strcspn(stores, ".");
	char *name = strndup(stores, n),
	     *parameter = strndup(stores + n + 1, strcspn(stores + n + 1, " "));
	struct roster roster = { 0 };
	char *out = NULL;
	size_t k;
	json_t *o;

	if (name && parameter && roster_read(&roster, a->project, name, NULL) == ST_OK) {
		const struct roster_worker *w = roster_find(&roster, name);
		json_array_foreach(w ? json_object_get(w->description, "parameters") : NULL, k,
		                   o) if (!strcmp(json_text(o, "name", ""), parameter) &&
		                          *json_text(o, "default", "")) out =
		        strdup(json_text(o, "default", ""));
	}
	roster_finish(&roster);
	free(name);
	free(parameter);
	return out;
}

/* A window shows what holds now; a script sets what it names and no more. */
static void show_worker_defaults(struct argument_row *rows, const struct routine *t,
                                 const struct act *a)
{
	for (struct argument_row *row = rows; row->name; row++)
		if (t->run == setting_store && row->stores && !row->def)
			row->def = worker_default(a, row->stores);
}

enum status routine_rows(struct argument_row **out, const struct routine *t, struct act *a)
{
	enum status st;

	if (t->worker)
		st = rows_of_worker(out, t, a);
	else
		st = rows_copy(out, t->arguments, a->world);
	if (t->worker && st != ST_OK)
		return st;
	if (st == ST_OK)
		st = add_rows(out, t, a);
	if (st == ST_OK && !t->worker)
		st = rows_from_state(*out, t, a->world);
	if (st == ST_OK && !t->worker && !a->wait)
		show_worker_defaults(*out, t, a);
	if (st != ST_OK) {
		routine_rows_free(*out);
		*out = NULL;
		return act_memory(a);
	}
	return st;
}
