/* parameter.c - check a value in command-line form against its row in a worker's description. */
#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "number.h"
#include "roster.h"
#include "text.h"

/* What a check knows; the sentence is made where it fails. */
struct check {
	const struct roster_worker *worker;
	const char *name, *value;
	const json_t *row;
	const struct report *report;
};

static enum status wrong(const struct check *c, const char *expected)
{
	return report_error(c->report, ST_PARAMETER, "--%s is '%s', expected %s", c->name, c->value,
	                    expected);
}

/* Limits of each number, where the row has them. min == max: no limit. */
static enum status in_range(const struct check *c, double x)
{
	double min = json_number(c->row, "min", 0), max = json_number(c->row, "max", 0);
	const char *unit = json_text(c->row, "unit", "");
	if (min == max || (x >= min && x <= max))
		return ST_OK;
	return report_error(c->report, ST_PARAMETER, "--%s is '%s', expected %.17g to %.17g%s%s",
	                    c->name, c->value, min, max, *unit ? " " : "", unit);
}

static enum status check_numbers(const struct check *c, const char *separator, int count,
                                 bool whole, const char *expected)
{
	const char *p = c->value, *end = p + strlen(p);
	for (int i = 0; i < count; i++) {
		double x = 0;
		int64_t n = 0;
		if (i && (p == end || *p++ != *separator))
			return wrong(c, expected);
		if (whole ? !number_read_integer(&p, end, &n) : !number_read(&p, end, &x))
			return wrong(c, expected);
		if (x - x != 0)
			return wrong(c, expected);
		enum status st = in_range(c, whole ? (double)n : x);
		if (st != ST_OK)
			return st;
	}
	return p == end ? ST_OK : wrong(c, expected);
}

static enum status check_integer(const struct check *c)
{
	return check_numbers(c, "", 1, true, "a whole number");
}

static enum status check_real(const struct check *c)
{
	return check_numbers(c, "", 1, false, "a number");
}

static enum status check_size(const struct check *c)
{
	return check_numbers(c, "x", 2, true, "two whole numbers as 640x480");
}

static enum status check_vector(const struct check *c)
{
	return check_numbers(c, ",", 3, false, "three numbers as 1,0,0.5");
}

static enum status check_flag(const struct check *c)
{
	return !strcmp(c->value, "yes") || !strcmp(c->value, "no") ? ST_OK : wrong(c, "yes or no");
}

static enum status check_color(const struct check *c)
{
	const char *v = c->value;
	return *v == '#' && strspn(v + 1, "0123456789abcdefABCDEF") == 6 && strlen(v) == 7
	               ? ST_OK
	               : wrong(c, "a color as #7CC4F8");
}

static enum status check_choice(const struct check *c)
{
	const json_t *choices = json_object_get(c->row, "choices");
	struct text list = { 0 };
	bool found = false;
	for (size_t i = 0; i < json_array_size(choices); i++) {
		const char *word = json_string_value(json_array_get(choices, i));
		found |= word && !strcmp(word, c->value);
		if (word)
			text_addf(&list, "%s%s", list.n ? ", " : "one of ", word);
	}
	enum status st = found ? ST_OK : wrong(c, list.s ? list.s : "one of its choices");
	text_finish(&list);
	return st;
}

/* Types that are not here (text, view) are the worker's own to judge. */
static const struct {
	const char *type;
	enum status (*check)(const struct check *c);
} checks[] = {
	{ "choice", check_choice },   { "color", check_color }, { "flag", check_flag },
	{ "integer", check_integer }, { "real", check_real },   { "size", check_size },
	{ "vector", check_vector },
};

enum status roster_check(const struct roster_worker *w, const char *parameter, const char *value,
                         const struct report *r)
{
	struct check c = { .worker = w, .name = parameter, .value = value, .report = r };
	const json_t *rows = json_object_get(w->description, "parameters");
	struct text names = { 0 };
	for (size_t i = 0; i < json_array_size(rows) && !c.row; i++) {
		const json_t *row = json_array_get(rows, i);
		const char *name = json_text(row, "name", "");
		if (!strcmp(name, parameter))
			c.row = row;
		text_addf(&names, "%s--%s", i ? ", " : "", name);
	}
	enum status st = ST_OK;
	if (!c.row)
		st = report_error(r, ST_PARAMETER, "worker %s has no parameter --%s, it has %s",
		                  w->name, parameter, names.s ? names.s : "none");
	const char *type = json_text(c.row, "type", "");
	for (size_t i = 0; c.row && i < sizeof checks / sizeof *checks; i++)
		if (!strcmp(type, checks[i].type))
			st = checks[i].check(&c);
	text_finish(&names);
	return st;
}
