/* description.c - is what a worker says of itself right? Members: docs/adding-a-worker.md. */
#include "description.h"

#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "text.h"

/* Options of `batten run` and of every verb: a parameter of that name could not be given. */
static const char *const taken[] = {
	"account", "after",  "force",     "group",    "help",   "json",    "memory",
	"on",      "output", "partition", "priority", "shards", "threads", "time",
};

static const char *const types[] = {
	"choice", "color", "flag", "integer", "real", "size", "text", "vector", "view",
};

static bool is_among(const char *word, const char *const *list, size_t n)
{
	for (size_t i = 0; i < n; i++)
		if (!strcmp(list[i], word))
			return true;
	return false;
}

static bool is_name(const char *s)
{
	return *s >= 'a' && *s <= 'z' &&
	       strspn(s, "abcdefghijklmnopqrstuvwxyz0123456789-") == strlen(s);
}

/* Missing, null, or a number. */
static bool is_limit(const json_t *row, const char *key)
{
	const json_t *x = json_object_get(row, key);
	return !x || json_is_null(x) || json_is_number(x);
}

static bool is_text_or_none(const json_t *row, const char *key)
{
	const json_t *x = json_object_get(row, key);
	return !x || json_is_null(x) || json_is_string(x);
}

static char *choices_fault(const json_t *row, const char *name)
{
	const json_t *choices = json_object_get(row, "choices");
	if (!json_array_size(choices))
		return text_print("parameter '%s' is a choice without choices", name);
	for (size_t i = 0; i < json_array_size(choices); i++)
		if (!json_is_string(json_array_get(choices, i)))
			return text_print("choices of parameter '%s' are not texts", name);
	return NULL;
}

static char *default_fault(const struct roster_worker *w, const json_t *row, const char *name)
{
	const json_t *value = json_object_get(row, "default");
	struct report_store store;
	report_store_init(&store);
	if (!value || json_is_null(value))
		return NULL;
	if (!json_is_string(value))
		return text_print("default of parameter '%s' is not a text", name);
	if (roster_check(w, name, json_string_value(value), &store.report) == ST_OK)
		return NULL;
	return text_print("default of parameter '%s' is wrong: %s", name, store.error);
}

static char *parameter_fault(const struct roster_worker *w, const json_t *rows, size_t i)
{
	const json_t *row = json_array_get(rows, i);
	const char *name = json_text(row, "name", NULL), *type = json_text(row, "type", NULL);
	if (!name || !type)
		return text_print("parameter %zu has no name or type", i + 1);
	if (!is_name(name))
		return text_print("parameter '%s' is not named in small letters, digits and '-'",
		                  name);
	if (is_among(name, taken, sizeof taken / sizeof *taken))
		return text_print("parameter '%s' has the name of an option of batten", name);
	for (size_t k = 0; k < i; k++)
		if (!strcmp(name, json_text(json_array_get(rows, k), "name", "")))
			return text_print("parameter '%s' is there twice", name);
	if (!is_among(type, types, sizeof types / sizeof *types))
		return text_print("parameter '%s' has the type '%s', which is none", name, type);
	if (!is_limit(row, "min") || !is_limit(row, "max"))
		return text_print("min or max of parameter '%s' is not a number", name);
	if (!is_text_or_none(row, "help") || !is_text_or_none(row, "unit"))
		return text_print("help or unit of parameter '%s' is not a text", name);
	char *fault = strcmp(type, "choice") ? NULL : choices_fault(row, name);
	return fault ? fault : default_fault(w, row, name);
}

/* A file beside the user's own: its name may not lead elsewhere. */
static char *output_fault(const json_t *row, size_t i)
{
	const char *extension = json_text(row, "extension", NULL);
	if (!extension || extension[0] != '.' || !extension[1] || strchr(extension, '/'))
		return text_print("output %zu has no extension as '.table.csv'", i + 1);
	if (!json_text(row, "kind", NULL))
		return text_print("output '%s' has no kind", extension);
	return NULL;
}

static char *fault_of(const struct roster_worker *w)
{
	const json_t *o = w->description;
	const char *own = json_text(o, "name", NULL);
	const json_t *parameters = json_object_get(o, "parameters");
	const json_t *outputs = json_object_get(o, "outputs");
	char *fault = NULL;
	if (!own || strcmp(own, w->name))
		return text_print("it is '%s'", own ? own : "nothing");
	if (!json_is_integer(json_object_get(o, "version")))
		return strdup("no version, a whole number");
	if (!json_text(o, "title", NULL))
		return strdup("no title");
	if (!json_is_array(parameters))
		return strdup("no list of parameters");
	for (size_t i = 0; i < json_array_size(parameters) && !fault; i++)
		fault = parameter_fault(w, parameters, i);
	if (!fault && !json_array_size(outputs))
		return strdup("no list of outputs");
	for (size_t i = 0; i < json_array_size(outputs) && !fault; i++)
		fault = output_fault(json_array_get(outputs, i), i);
	return fault;
}

char *description_fault(const struct roster_worker *w)
{
	char *fault = fault_of(w);
	char *whole = fault ? text_print("--describe says: %s", fault) : NULL;
	free(fault);
	return whole;
}
