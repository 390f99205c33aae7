/* csv.c - points as columns of numbers. */
#include "csv.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "number.h"

enum { COLUMNS_MAX = 64 };

struct field {
	const char *s, *end;
};

struct csv {
	const char *start, *end, *line; /* line: where the one at hand begins */
	const char *name;
	const struct report *r;
	int number; /* of the line at hand, from 1 */
	struct field fields[COLUMNS_MAX];
	int n;                /* fields of the line at hand */
	int n_columns;        /* of the first line with any; 0: none yet */
	int pick[3], n_picks; /* the columns that are coordinates */
};

static enum status csv_fail(const struct csv *c, const char *at, const char *found, int length,
                            const char *expected)
{
	return report_error(c->r, ST_INPUT, "%s:%d:%d: found '%.*s', expected %s", c->name,
	                    c->number, (int)(at - c->line) + 1, length > 40 ? 40 : length, found,
	                    expected);
}

static bool is_blank(char c)
{
	return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v';
}

static bool is_mark(char c)
{
	return c == ',' || c == ';';
}

/* The next line behind `s`, without comment and line end; false at the end of the text. */
static bool next_line(struct csv *c, const char **s, struct field *line)
{
	if (*s >= c->end)
		return false;
	const char *stop = memchr(*s, '\n', (size_t)(c->end - *s));
	if (!stop)
		stop = c->end;
	const char *comment = memchr(*s, '#', (size_t)(stop - *s));
	c->line = *s;
	c->number++;
	*line = (struct field){ *s, comment ? comment : stop };
	*s = stop < c->end ? stop + 1 : c->end;
	while (line->s < line->end && is_blank(*line->s))
		line->s++;
	while (line->end > line->s && is_blank(line->end[-1]))
		line->end--;
	return true;
}

/* Fields of a line; an empty one stands between two commas. */
static enum status split(struct csv *c, struct field line)
{
	const char *s = line.s;
	c->n = 0;
	while (s < line.end) {
		const char *from = s, *mark = NULL;
		bool quoted = *s == '"';
		if (quoted)
			s++;
		while (s < line.end && (quoted ? *s != '"' : !is_blank(*s) && !is_mark(*s)))
			s++;
		if (quoted && s < line.end)
			s++;
		if (c->n == COLUMNS_MAX)
			return csv_fail(c, from, from, (int)(s - from), "at most 64 columns");
		c->fields[c->n++] = (struct field){ from, s };
		while (s < line.end && (is_blank(*s) || (!mark && is_mark(*s)))) {
			if (!is_blank(*s))
				mark = s;
			s++;
		}
		if (mark && s == line.end && c->n == COLUMNS_MAX)
			break;
		if (mark && s == line.end) /* a comma at the end: an empty field */
			c->fields[c->n++] = (struct field){ mark + 1, mark + 1 };
	}
	return ST_OK;
}

static bool is_number(struct field f, double *x)
{
	return number_read(&f.s, f.end, x) && f.s == f.end && isfinite(*x);
}

static bool is_name(struct field f, char letter)
{
	if (f.end - f.s >= 2 && *f.s == '"' && f.end[-1] == '"') {
		f.s++;
		f.end--;
	}
	return f.end - f.s == 1 && tolower((unsigned char)*f.s) == letter;
}

static int find_name(const struct csv *c, char letter)
{
	for (int i = 0; i < c->n; i++)
		if (is_name(c->fields[i], letter))
			return i;
	return -1;
}

/* A line of names: which columns are x y z, or u v. False where it names neither. */
static bool pick_by_name(struct csv *c)
{
	static const char *const sets[] = { "xyz", "uv" };
	for (int k = 0; k < 2; k++) {
		c->n_picks = (int)strlen(sets[k]);
		bool all = true;
		for (int i = 0; i < c->n_picks; i++)
			all &= (c->pick[i] = find_name(c, sets[k][i])) >= 0;
		if (all)
			return true;
	}
	c->n_picks = 0;
	return false;
}

static bool is_heading(const struct csv *c)
{
	double x;
	for (int i = 0; i < c->n; i++)
		if (is_number(c->fields[i], &x) || c->fields[i].s == c->fields[i].end ||
		    !(isalpha((unsigned char)*c->fields[i].s) || *c->fields[i].s == '"'))
			return false;
	return c->n >= 2;
}

/* The first line: names, or how many columns there are. *heading: it holds no numbers. */
static enum status begin(struct csv *c, bool *heading)
{
	*heading = is_heading(c);
	if (!(*heading && pick_by_name(c))) {
		if (c->n < 2 || c->n > 3)
			return csv_fail(c, c->fields[0].s, c->fields[0].s,
			                (int)(c->fields[c->n - 1].end - c->fields[0].s),
			                "two columns (u v) or three (x y z), or a first line that "
			                "names them");
		c->n_picks = c->n;
		for (int i = 0; i < c->n; i++)
			c->pick[i] = i;
	}
	c->n_columns = c->n;
	return ST_OK;
}

bool csv_recognise(const char *bytes, size_t n)
{
	struct csv c = { .start = bytes, .end = bytes + n, .name = "" };
	const char *s = bytes;
	struct field line;
	double x;
	for (int seen = 0; seen < 2 && next_line(&c, &s, &line);) {
		if (line.s == line.end)
			continue;
		if (split(&c, line) != ST_OK || (seen == 1 && c.n != c.n_columns))
			return false;
		if (seen == 0 && is_heading(&c)) {
			c.n_columns = c.n;
			seen = 1;
			continue;
		}
		if (seen == 0 && (c.n < 2 || c.n > 3))
			return false;
		for (int i = 0; i < c.n; i++)
			if (!is_number(c.fields[i], &x) && (seen == 0 || c.n <= 3))
				return false;
		return true;
	}
	return false;
}

static enum status take_row(struct csv *c, struct point_list *l, size_t *room)
{
	if (c->n != c->n_columns)
		return report_error(c->r, ST_INPUT,
		                    "%s:%d:%d: found %d columns, expected %d as before", c->name,
		                    c->number, (int)(c->fields[0].s - c->line) + 1, c->n,
		                    c->n_columns);
	if ((size_t)l->n == *room) {
		size_t more = *room ? 2 * *room : 64;
		double *p = more < (size_t)1 << 30
		                    ? reallocarray(l->values, more, l->dimension * sizeof *p)
		                    : NULL;
		if (!p)
			return report_error(c->r, ST_RESOURCE, "cannot read '%s': memory ran out",
			                    c->name);
		l->values = p;
		*room = more;
	}
	for (int i = 0; i < l->dimension; i++) {
		struct field f = c->fields[c->pick[i]];
		if (!is_number(f, &l->values[(size_t)l->n * l->dimension + i]))
			return csv_fail(c, f.s, f.s, (int)(f.end - f.s), "a number");
	}
	l->n++;
	return ST_OK;
}

static enum status read_rows(struct csv *c, struct point_list *l, const struct progress *p)
{
	enum status st = ST_OK;
	const char *s = c->start;
	struct field line;
	size_t room = 0;
	while (st == ST_OK && next_line(c, &s, &line)) {
		bool heading = false;
		if (c->number % 4096 == 0)
			st = progress_step(p, (double)(s - c->start) / (double)(c->end - c->start));
		if (st != ST_OK || line.s == line.end)
			continue;
		st = split(c, line);
		if (st == ST_OK && !c->n_columns)
			st = begin(c, &heading);
		l->dimension = c->n_picks;
		if (st == ST_OK && !heading)
			st = take_row(c, l, &room);
	}
	return st;
}

enum status csv_parse(struct model *m, const char *bytes, size_t n, const char *name,
                      const struct progress *p, const struct report *r)
{
	struct csv c = { .start = bytes, .end = bytes + n, .line = bytes, .name = name, .r = r };
	struct entity e;
	entity_init(&e, ENTITY_POINTS);
	enum status st = progress_step(p, 0);
	if (st == ST_OK)
		st = read_rows(&c, &e.points, p);
	if (st == ST_OK && !e.points.n)
		st = report_error(r, ST_INPUT, "cannot read '%s': it has no line of numbers", name);
	if (st == ST_OK && c.n_columns > c.n_picks)
		st = model_warn(m, "%d columns that are not coordinates were left out",
		                c.n_columns - c.n_picks);
	if (st == ST_OK && (st = model_add(m, &e)) == ST_OK)
		model_number(m);
	else if (st == ST_RESOURCE)
		report_error(r, st, "cannot read '%s': memory ran out", name);
	entity_finish(&e);
	return st;
}

static void add_rows(struct text *t, const struct point_list *l)
{
	for (int i = 0; i < l->n; i++)
		for (int k = 0; k < l->dimension; k++) {
			text_add_number(t, l->values[(size_t)i * l->dimension + k]);
			text_add(t, k + 1 < l->dimension ? "," : "\n");
		}
}

enum status csv_write(const struct model *m, const char *path, const struct report *r)
{
	struct text t = { 0 };
	int dimension = 0;
	for (int i = 0; i < m->n; i++) {
		const struct entity *e = &m->entities[i];
		if (e->kind != ENTITY_POINTS)
			continue;
		if (dimension && dimension != e->points.dimension) {
			text_finish(&t);
			return report_error(r, ST_INPUT,
			                    "cannot write '%s': some points have x y z, others "
			                    "u v; write them to two files",
			                    path);
		}
		if (!dimension) {
			if (m->unit && e->points.dimension == 3)
				text_addf(&t, "# unit %s\n", m->unit);
			text_add(&t, e->points.dimension == 3 ? "x,y,z\n" : "u,v\n");
		}
		dimension = e->points.dimension;
		add_rows(&t, &e->points);
	}
	enum status st;
	if (!dimension)
		st = report_error(r, ST_INPUT, "cannot write '%s': a .csv file holds points", path);
	else if (t.failed)
		st = report_error(r, ST_RESOURCE, "cannot write '%s': memory ran out", path);
	else
		st = file_write(path, t.s, t.n, r);
	text_finish(&t);
	return st;
}
