/* arguments.c - values in script form: are they right, and what do they say? */
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "number.h"
#include "path.h"
#include "private.h"
#include "text.h"

enum { SIZE_MAX_PX = 65536 };

const char *argument_text(const struct arguments *g, const char *name)
{
	for (int k = 0; k < g->n; k++)
		if (!strcmp(g->name[k], name))
			return g->value[k];
	return NULL;
}

double argument_number(const struct arguments *g, const char *name, double fallback)
{
	const char *value = argument_text(g, name);
	double x;

	return value && number_parse(value, &x) ? x : fallback;
}

bool argument_yes(const struct arguments *g, const char *name, bool fallback)
{
	const char *value = argument_text(g, name);

	return value ? !strcmp(value, "yes") : fallback;
}

/* Numbers by comma, up to `most`, to the end of the text or a semicolon; how many, 0: not so. */
static int read_numbers(const char **p, double *out, int most)
{
	const char *end = *p + strlen(*p);
	int n = 0;

	while (n < most && number_read(p, end, &out[n]) && out[n] - out[n] == 0) {
		n++;
		if (**p != ',')
			return **p && **p != ';' ? 0 : n;
		++*p;
	}
	return 0;
}

bool argument_vector(const struct arguments *g, const char *name, struct vec3 *out)
{
	const char *p = argument_text(g, name);
	double v[3] = { 0 };

	if (!p || read_numbers(&p, v, 3) < 2)
		return false;
	*out = vec3(v[0], v[1], v[2]);
	return true;
}

bool argument_pair(const char *value, char between, double *a, double *b)
{
	const char *end = value + strlen(value);

	return number_read(&value, end, a) && value < end && *value++ == between &&
	       number_read(&value, end, b) && value == end && *a - *a == 0 && *b - *b == 0;
}

static bool is_color(const char *s)
{
	return *s == '#' && strspn(s + 1, "0123456789abcdefABCDEF") == 6 && strlen(s) == 7;
}

bool argument_color(const struct arguments *g, const char *name, struct rgb *out)
{
	const char *value = argument_text(g, name);

	if (!value || !is_color(value))
		return false;
	const unsigned long x = strtoul(value + 1, NULL, 16);
	*out = (struct rgb){ (double)(x >> 16) / 255, (double)(x >> 8 & 255) / 255,
		             (double)(x & 255) / 255 };
	return true;
}

/* What a check knows. */
struct check {
	const struct argument_row *row;
	const char *value;
	const struct world *world;
	const struct report *report;
};

static enum status wrong(const struct check *c, const char *format, ...)
        __attribute__((format(printf, 2, 3)));
static enum status wrong(const struct check *c, const char *format, ...)
{
	char expected[512];
	va_list args;

	va_start(args, format);
	vsnprintf(expected, sizeof expected, format, args);
	va_end(args);
	return report_error(c->report, ST_PARAMETER, "%s is '%s'; it must be %s", c->row->name,
	                    c->value, expected);
}

static enum status in_range(const struct check *c, double x)
{
	const struct argument_row *row = c->row;

	if (row->min > row->max || (x >= row->min && x <= row->max))
		return ST_OK;
	return wrong(c, "%.9g to %.9g%s%s", row->min, row->max, row->unit ? " " : "",
	             row->unit ? row->unit : "");
}

static enum status check_number(const struct check *c)
{
	double x;

	return number_parse(c->value, &x) ? in_range(c, x) : wrong(c, "a number");
}

static enum status check_integer(const struct check *c)
{
	int64_t x;

	return number_parse_integer(c->value, &x) ? in_range(c, (double)x)
	                                          : wrong(c, "a whole number");
}

static enum status check_choice(const struct check *c)
{
	const size_t n = strlen(c->value);

	for (const char *p = strchr(c->value, '|') ? NULL : c->row->choices; p;
	     p = strchr(p, '|'), p = p ? p + 1 : NULL)
		if (!strncmp(p, c->value, n) && (!p[n] || p[n] == '|') && n)
			return ST_OK;
	return wrong(c, "one of %s", c->row->choices);
}

static enum status check_yesno(const struct check *c)
{
	return !strcmp(c->value, "yes") || !strcmp(c->value, "no") ? ST_OK : wrong(c, "yes or no");
}

static enum status check_text(const struct check *c)
{
	return *c->value ? ST_OK : wrong(c, "something");
}

static enum status check_thing(const struct check *c)
{
	const struct Ful *f = world_find(c->world, c->value, c->report);

	if (!f)
		return ST_PARAMETER;
	if ((c->row->type == ARGUMENT_SURFACE && !ful_is_surface(f)) ||
	    (c->row->type == ARGUMENT_CURVE && !ful_is_curve(f)))
		return wrong(c, "a %s, and that is a %s",
		             c->row->type == ARGUMENT_SURFACE ? "surface" : "curve",
		             entity_kind_name(f->entity.kind));
	return ST_OK;
}

static enum status check_vector(const struct check *c)
{
	const char *p = c->value;
	double v[3];

	return read_numbers(&p, v, 3) >= 2 && !*p ? ST_OK : wrong(c, "X,Y,Z or U,V");
}

static enum status check_points(const struct check *c)
{
	const char *p = c->value;
	double v[3];

	if (world_find(c->world, c->value, NULL))
		return ST_OK;
	while (read_numbers(&p, v, 3) >= 2) {
		if (!*p)
			return ST_OK;
		p++;
	}
	return wrong(c, "rows X,Y,Z by semicolon, or the name of a point list that is open");
}

static enum status check_size(const struct check *c)
{
	double a, b;

	if (!argument_pair(c->value, 'x', &a, &b) || a != (double)(long)a || b != (double)(long)b)
		return wrong(c, "two whole numbers as 640x480");
	if (c->row->min < c->row->max) {
		const enum status st = in_range(c, a);
		return st == ST_OK ? in_range(c, b) : st;
	}
	return a >= 1 && b >= 1 && a <= SIZE_MAX_PX && b <= SIZE_MAX_PX
	               ? ST_OK
	               : wrong(c, "1x1 to %dx%d", SIZE_MAX_PX, SIZE_MAX_PX);
}

static enum status check_view(const struct check *c)
{
	struct camera camera;
	struct box box = box_empty();

	box_add_point(&box, vec3(0, 0, 0));
	box_add_point(&box, vec3(1, 1, 1));
	return camera_fit(&camera, c->value, &box, 100, 100, c->report);
}

static enum status check_color(const struct check *c)
{
	return is_color(c->value) ? ST_OK : wrong(c, "a color as #7CC4F8");
}

static enum status check_jobs(const struct check *c)
{
	const char *p = c->value, *end = p + strlen(p);
	int64_t id;

	if (!strcmp(p, "all"))
		return ST_OK;
	while (number_read_integer(&p, end, &id) && id > 0) {
		if (p == end)
			return ST_OK;
		if (*p++ != ',')
			break;
	}
	return wrong(c, "numbers of jobs by comma, or all");
}

static enum status (*const checks[N_ARGUMENT_TYPES])(const struct check *) = {
	[ARGUMENT_NUMBER] = check_number, [ARGUMENT_INTEGER] = check_integer,
	[ARGUMENT_CHOICE] = check_choice, [ARGUMENT_YESNO] = check_yesno,
	[ARGUMENT_TEXT] = check_text,     [ARGUMENT_FILE] = check_text,
	[ARGUMENT_OUTPUT] = check_text,   [ARGUMENT_SURFACE] = check_thing,
	[ARGUMENT_CURVE] = check_thing,   [ARGUMENT_THING] = check_thing,
	[ARGUMENT_ENTITIES] = check_text, [ARGUMENT_VECTOR] = check_vector,
	[ARGUMENT_POINTS] = check_points, [ARGUMENT_SIZE] = check_size,
	[ARGUMENT_VIEW] = check_view,     [ARGUMENT_COLOR] = check_color,
	[ARGUMENT_JOBS] = check_jobs,
};

enum status argument_check(const struct argument_row *row, const char *value, const struct world *w,
                           const struct report *r)
{
	const struct check c = { row, value, w, r };

	if (row->optional && !strcmp(value, "auto"))
		return ST_OK;
	return checks[row->type](&c);
}
