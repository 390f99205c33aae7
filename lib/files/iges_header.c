/* iges_header.c - the global section: delimiters, unit, scale. */
#include "iges_reader.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "number.h"

enum {
	SCALE_FIELD = 13,
	FLAG_FIELD = 14,
	UNIT_FIELD = 15,
	RESOLUTION_FIELD = 19,
	N_HEADER_FIELDS = 26,
};

/* Unit flags of field 14: name as we write it, other names, millimetres. */
static const struct {
	const char *name, *other;
	double mm;
} units[] = {
	[1] = { "in", "inch", 25.4 },      [2] = { "mm", "millimeter", 1 },
	[3] = { NULL, NULL, 0 }, /* field 15 names it */
	[4] = { "ft", "foot", 304.8 },     [5] = { "mi", "mile", 1609344 },
	[6] = { "m", "meter", 1000 },      [7] = { "km", "kilometer", 1e6 },
	[8] = { "mil", "mils", 0.0254 },   [9] = { "um", "micron", 1e-3 },
	[10] = { "cm", "centimeter", 10 }, [11] = { "uin", "microinch", 25.4e-6 },
};
enum { N_UNITS = sizeof units / sizeof units[0], BY_NAME = 3 };

struct field {
	const char *s;
	size_t n;
	bool text; /* written as a Hollerith string */
};

struct fields {
	struct field at[N_HEADER_FIELDS + 1]; /* from 1 */
	int miscounted;                       /* first field whose string length is wrong, or 0 */
};

static bool can_delimit(char c)
{
	return c > ' ' && c < 0x7f && !isalnum((unsigned char)c) && c != '+' && c != '-' &&
	       c != '.';
}

/* One of the first two fields, which name the delimiters: "1Hx" or nothing. */
static const char *read_delimiter(const char *s, const char *end, char *out)
{
	while (s < end && *s == ' ')
		s++;
	if (end - s >= 3 && s[0] == '1' && s[1] == 'H' && can_delimit(s[2])) {
		*out = s[2];
		s += 3;
	}
	return s;
}

/* A field from s on; returns where it ends: at a delimiter, or the section's end. */
static const char *read_field(const struct iges *g, const char *s, const char *end, struct field *f,
                              bool *miscounted)
{
	int64_t n = 0;
	const char *p;
	while (s < end && *s == ' ')
		s++;
	*f = (struct field){ s, 0, false };
	p = s;
	if (p < end && isdigit((unsigned char)*p) && number_read_integer(&p, end, &n) && p < end &&
	    *p == 'H') {
		p++;
		bool beyond = n > end - p;
		*f = (struct field){ p, beyond ? (size_t)(end - p) : (size_t)n, true };
		p += f->n;
		while (p < end && *p == ' ')
			p++;
		*miscounted =
		        beyond || (p < end && *p != g->header.delimiter && *p != g->header.record);
	} else {
		p = s;
	}
	while (p < end && *p != g->header.delimiter && *p != g->header.record)
		p++;
	if (!f->text)
		f->n = (size_t)(p - s);
	while (f->n && f->s[f->n - 1] == ' ')
		f->n--;
	return p;
}

static void read_fields(struct iges *g, struct fields *f)
{
	const char *s = g->global.s, *end = s + g->global.n;
	g->header.delimiter = ',';
	g->header.record = ';';
	s = read_delimiter(s, end, &g->header.delimiter);
	if (s < end && *s == g->header.delimiter)
		s = read_delimiter(s + 1, end, &g->header.record);
	if (g->header.record == g->header.delimiter) {
		g->header.delimiter = ',';
		g->header.record = ';';
	}
	for (int i = 3; i <= N_HEADER_FIELDS && s < end && *s == g->header.delimiter; i++) {
		bool miscounted = false;
		s = read_field(g, s + 1, end, &f->at[i], &miscounted);
		if (miscounted && !f->miscounted)
			f->miscounted = i;
	}
}

static bool same_word(const struct field *f, const char *word)
{
	return word && f->n == strlen(word) && strncasecmp(f->s, word, f->n) == 0;
}

/* Flag of a unit's name, 0: none that we know. */
static int flag_of_name(const struct field *f)
{
	for (int i = 1; i < N_UNITS; i++)
		if (f->n && (same_word(f, units[i].name) || same_word(f, units[i].other)))
			return i;
	return 0;
}

static enum status read_unit(struct iges *g, const struct fields *f)
{
	const struct field *flag = &f->at[FLAG_FIELD], *name = &f->at[UNIT_FIELD];
	const char *s = flag->s;
	int64_t n = 0;
	int named = flag_of_name(name);
	enum status st = ST_OK;
	if (flag->n && !flag->text && number_read_integer(&s, flag->s + flag->n, &n) && n >= 1 &&
	    n < N_UNITS) {
		g->header.unit_flag = (int)n;
		if (named && n != BY_NAME && named != n)
			st = model_warn(g->m,
			                "the header's unit flag says %s, its unit name %.*s; "
			                "the flag is taken",
			                units[n].name, (int)name->n, name->s);
	} else if (flag->text && flag_of_name(flag)) {
		g->header.unit_flag = flag_of_name(flag);
		st = model_warn(g->m,
		                "the header has '%.*s' in the place of the unit flag; taken as the "
		                "unit",
		                (int)flag->n, flag->s);
	} else if (named) {
		g->header.unit_flag = BY_NAME;
	} else {
		g->header.unit_flag = 1;
		st = model_warn(g->m,
		                "the header names no unit that is known; inches are taken, which "
		                "is the standard's default");
	}
	int unit = g->header.unit_flag == BY_NAME && named ? named : g->header.unit_flag;
	g->m->unit_in_mm = units[unit].mm;
	if (st == ST_OK && unit != BY_NAME)
		return model_set_text(&g->m->unit, units[unit].name);
	if (st != ST_OK || name->n == 0)
		return st;
	g->m->unit = strndup(name->s, name->n);
	return g->m->unit ? ST_OK : ST_RESOURCE;
}

static enum status read_scale(struct iges *g, const struct fields *f)
{
	const struct field *field = &f->at[SCALE_FIELD];
	const char *s = field->s;
	double x = 0;
	if (field->n == 0)
		return ST_OK;
	if (!number_read(&s, field->s + field->n, &x) || !(x > 0) || !isfinite(x))
		return model_warn(g->m,
		                  "the header's model space scale '%.*s' is no positive number; "
		                  "1 is taken",
		                  (int)field->n, field->s);
	g->m->scale = x;
	if (x == 1)
		return ST_OK;
	char text[NUMBER_SIZE];
	number_write(text, x);
	return model_warn(g->m,
	                  "the header states a model space scale of %s; coordinates are left as "
	                  "they are in the file",
	                  text);
}

static void read_resolution(struct iges *g, const struct field *f)
{
	const char *s = f->s;
	double x = 0;
	if (f->n && number_read(&s, f->s + f->n, &x) && x > 0)
		g->header.resolution = x;
}

enum status iges_read_header(struct iges *g)
{
	struct fields f = { 0 };
	enum status st = ST_OK;
	text_add(&g->global, "");
	if (g->global.failed)
		return ST_RESOURCE;
	read_fields(g, &f);
	if (g->global.n == 0)
		st = model_warn(g->m, "the file has no header (G section)");
	if (st == ST_OK && f.miscounted)
		st = model_warn(g->m,
		                "the string in field %d of the header is not as long as it says; "
		                "the fields behind it (unit, scale) may be wrong",
		                f.miscounted);
	if (st == ST_OK)
		st = read_unit(g, &f);
	if (st == ST_OK)
		st = read_scale(g, &f);
	read_resolution(g, &f.at[RESOLUTION_FIELD]);
	return st;
}
