/* json.c - what the program needs around jansson. */
#include "json.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "text.h"

const char *json_text(const json_t *o, const char *key, const char *fallback)
{
	const char *s = json_string_value(json_object_get(o, key));

	return s ? s : fallback;
}

int64_t json_int(const json_t *o, const char *key, int64_t fallback)
{
	const json_t *v = json_object_get(o, key);

	return json_is_integer(v) ? json_integer_value(v) : fallback;
}

double json_number(const json_t *o, const char *key, double fallback)
{
	const json_t *v = json_object_get(o, key);

	return json_is_number(v) ? json_number_value(v) : fallback;
}

bool json_flag(const json_t *o, const char *key, bool fallback)
{
	const json_t *v = json_object_get(o, key);

	return json_is_boolean(v) ? json_is_true(v) : fallback;
}

void json_set_text(json_t *o, const char *key, const char *value)
{
	json_object_set_new(o, key, value ? json_string(value) : json_null());
}

void json_set_int(json_t *o, const char *key, int64_t value)
{
	json_object_set_new(o, key, json_integer(value));
}

void json_set_number(json_t *o, const char *key, double value)
{
	json_object_set_new(o, key, json_real_or_null(value));
}

json_t *json_real_or_null(double x)
{
	return isfinite(x) ? json_real(x) : json_null();
}

enum status json_parse_object(const char *text, size_t n, const char *what, json_t **out,
                              const struct report *r)
{
	json_error_t error;
	json_t *o = json_loadb(text, n, JSON_REJECT_DUPLICATES, &error);

	if (!o)
		return report_error(
		        r,
		        json_error_code(&error) == json_error_out_of_memory ? ST_RESOURCE
		                                                            : ST_INPUT,
		        "%s, line %d: %s; expected a JSON object", what, error.line, error.text);
	if (!json_is_object(o)) {
		json_decref(o);
		return report_error(r, ST_INPUT, "%s: expected a JSON object", what);
	}
	*out = o;
	return ST_OK;
}

static void write_value(struct text *t, const json_t *v, int depth, bool indented);

static void new_line(struct text *t, int depth, bool indented)
{
	if (!indented)
		return;
	text_add(t, "\n");
	for (int i = 0; i < depth; i++)
		text_add(t, "  ");
}

static void write_string(struct text *t, const char *s)
{
	text_add(t, "\"");
	for (; *s; s++) {
		unsigned char c = (unsigned char)*s;
		if (c == '"' || c == '\\')
			text_addf(t, "\\%c", c);
		else if (c < 0x20)
			text_addf(t, "\\u%04x", c);
		else
			text_add_bytes(t, s, 1);
	}
	text_add(t, "\"");
}

/* Arrays of plain values stay on a line, as rows of numbers are read. */
static bool is_plain(const json_t *array)
{
	size_t i;
	json_t *v;

	json_array_foreach(array, i, v) if (json_is_object(v) || json_is_array(v)) return false;
	return true;
}

static void write_array(struct text *t, const json_t *array, int depth, bool indented)
{
	bool lines = indented && !is_plain(array);
	size_t i;
	json_t *v;

	text_add(t, "[");
	json_array_foreach(array, i, v)
	{
		if (i)
			text_add(t, lines || !indented ? "," : ", ");
		new_line(t, depth + 1, lines);
		write_value(t, v, depth + 1, indented);
	}
	if (json_array_size(array))
		new_line(t, depth, lines);
	text_add(t, "]");
}

static void write_object(struct text *t, const json_t *o, int depth, bool indented)
{
	const char *key;
	json_t *v;
	size_t n = 0;

	text_add(t, "{");
	json_object_foreach((json_t *)(uintptr_t)o, key, v)
	{
		if (n++)
			text_add(t, ",");
		new_line(t, depth + 1, indented);
		write_string(t, key);
		text_add(t, indented ? ": " : ":");
		write_value(t, v, depth + 1, indented);
	}
	if (n)
		new_line(t, depth, indented);
	text_add(t, "}");
}

static void write_value(struct text *t, const json_t *v, int depth, bool indented)
{
	switch (json_typeof(v)) {
	case JSON_OBJECT:
		write_object(t, v, depth, indented);
		break;
	case JSON_ARRAY:
		write_array(t, v, depth, indented);
		break;
	case JSON_STRING:
		write_string(t, json_string_value(v));
		break;
	case JSON_INTEGER:
		text_addf(t, "%" JSON_INTEGER_FORMAT, json_integer_value(v));
		break;
	case JSON_REAL: {
		/* a real stays a real for readers that tell them apart */
		size_t n = t->n;
		text_add_number(t, json_real_value(v));
		if (!t->failed && !strpbrk(t->s + n, ".e"))
			text_add(t, ".0");
		break;
	}
	case JSON_TRUE:
	case JSON_FALSE:
		text_add(t, json_is_true(v) ? "true" : "false");
		break;
	case JSON_NULL:
		text_add(t, "null");
		break;
	}
}

void json_write_at(struct text *t, const json_t *v, int depth)
{
	write_value(t, v, depth, true);
}

char *json_write(const json_t *o, bool indented)
{
	struct text t = { 0 };

	write_value(&t, o, 0, indented);
	return text_take(&t);
}
