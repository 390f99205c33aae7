/* describe.c - the leaves as data. */
#include <string.h>

#include "json.h"
#include "private.h"

static json_t *choices_json(const char *choices)
{
	json_t *list = choices ? json_array() : json_null();

	for (const char *p = choices; p && *p; p += strcspn(p, "|"), p += *p == '|')
		json_array_append_new(list, json_stringn(p, strcspn(p, "|")));
	return list;
}

static json_t *row_json(const struct argument_row *row)
{
	const bool ranged = (row->type == ARGUMENT_NUMBER || row->type == ARGUMENT_INTEGER ||
	                     row->type == ARGUMENT_SIZE) &&
	                    row->min < row->max;
	json_t *o = json_object();

	json_set_text(o, "name", row->name);
	json_set_text(o, "type", argument_type_word[row->type]);
	json_set_text(o, "default", row->def);
	json_object_set_new(o, "min", ranged ? json_real_or_null(row->min) : json_null());
	json_object_set_new(o, "max", ranged ? json_real_or_null(row->max) : json_null());
	json_set_text(o, "unit", row->unit);
	json_object_set_new(o, "choices", choices_json(row->choices));
	json_set_text(o, "help", row->help);
	json_object_set_new(o, "optional", json_boolean(row->optional));
	return o;
}

json_t *routines_describe(struct act *a)
{
	json_t *list = json_array();

	for (const struct routine *t = routine_table; t->code; t++) {
		json_t *o = json_object(), *arguments = json_array();
		struct argument_row *rows = NULL;
		/* a worker that is missing or broken takes its leaf along, and no more */
		const bool there = routine_rows(&rows, t, a) == ST_OK;
		for (const struct argument_row *row = rows; row && row->name; row++)
			json_array_append_new(arguments, row_json(row));
		routine_rows_free(rows);
		json_set_text(o, "code", t->code);
		json_set_text(o, "kind", routine_kind_word[t->kind]);
		json_object_set_new(o, "available", json_boolean(t->run && there));
		json_object_set_new(o, "arguments", arguments);
		json_array_append_new(list, o);
	}
	return list;
}
