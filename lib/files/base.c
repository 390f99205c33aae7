/* base.c - reader of the .base text format; docs/formats.md has its grammar. */
#include "base.h"

#include <limits.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "number.h"

struct parser {
	const char *start, *s, *end;
	const char *token; /* where the last token began: errors point there */
	const char *name;
	struct model *m;
	const struct progress *progress;
	const struct report *r;
	enum status st; /* a parser that has failed stays failed */
};

/* What has been said of the entity at hand. */
struct draft {
	struct entity e;
	struct curve *curve; /* the one that curve fields fill: in u, v or in space */
	unsigned seen;       /* bits of fields[] */
	int order[2], n[2];
	int dimension;
	const char *begin;
};

typedef void field_read(struct parser *p, struct draft *d);

bool base_recognise(const char *bytes, size_t n)
{
	static const char first[] = "batten base";
	return n >= sizeof first && memcmp(bytes, first, sizeof first - 1) == 0;
}

static bool is_blank(char c)
{
	return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

static void skip_blanks(struct parser *p)
{
	while (p->s < p->end) {
		if (is_blank(*p->s)) {
			p->s++;
		} else if (*p->s == '#') {
			const char *eol = memchr(p->s, '\n', (size_t)(p->end - p->s));
			p->s = eol ? eol : p->end;
		} else {
			break;
		}
	}
	p->token = p->s;
}

static const char *token_end(const struct parser *p)
{
	const char *e = p->token;
	while (e < p->end && !is_blank(*e) && *e != '#')
		e++;
	return e;
}

static int line_of(const struct parser *p, const char *at, int *column)
{
	int line = 1;
	const char *bol = p->start;
	for (const char *q; (q = memchr(bol, '\n', (size_t)(at - bol))) != NULL; bol = q + 1)
		line++;
	*column = (int)(at - bol) + 1;
	return line;
}

static void fail(struct parser *p, const char *expected, ...) __attribute__((format(printf, 2, 3)));
static void fail(struct parser *p, const char *expected, ...)
{
	if (p->st != ST_OK)
		return;
	char what[256];
	va_list args;
	va_start(args, expected);
	vsnprintf(what, sizeof what, expected, args);
	va_end(args);
	int column, line = line_of(p, p->token, &column);
	int n = (int)(token_end(p) - p->token);
	if (p->token >= p->end)
		p->st = report_error(p->r, ST_INPUT,
		                     "%s:%d:%d: found the end of the file, expected %s", p->name,
		                     line, column, what);
	else
		p->st = report_error(p->r, ST_INPUT, "%s:%d:%d: found '%.*s'%s, expected %s",
		                     p->name, line, column, n > 40 ? 40 : n, p->token,
		                     n > 40 ? " (and more)" : "", what);
}

static void fail_memory(struct parser *p)
{
	if (p->st == ST_OK)
		p->st = report_error(p->r, ST_RESOURCE, "cannot read '%s': no memory", p->name);
}

static void keep(struct parser *p, enum status st)
{
	if (st != ST_OK)
		fail_memory(p);
}

/* The token at hand is that word; it is taken. */
static bool take_word(struct parser *p, const char *word)
{
	skip_blanks(p);
	size_t n = (size_t)(token_end(p) - p->token);
	if (n != strlen(word) || memcmp(p->token, word, n) != 0)
		return false;
	p->s = p->token + n;
	return true;
}

static double read_number(struct parser *p, const char *what)
{
	double x = 0;
	if (p->st != ST_OK)
		return 0;
	skip_blanks(p);
	if (!number_read(&p->s, p->end, &x) || p->s != token_end(p) || !isfinite(x))
		fail(p, "%s: a number", what);
	return x;
}

static int read_integer(struct parser *p, const char *what, int64_t lo, int64_t hi)
{
	int64_t x = 0;
	if (p->st != ST_OK)
		return 0;
	skip_blanks(p);
	if (!number_read_integer(&p->s, p->end, &x) || p->s != token_end(p) || x < lo || x > hi)
		fail(p, "%s: a whole number from %lld to %lld", what, (long long)lo, (long long)hi);
	return (int)x;
}

/* How many numbers can still follow: one byte and a blank each. */
static int64_t numbers_left(const struct parser *p, int each)
{
	int64_t n = ((int64_t)(p->end - p->s) / 2 + 1) / each;
	return n < INT_MAX - ORDER_MAX ? n : INT_MAX - ORDER_MAX;
}

static bool read_flag(struct parser *p, const char *what)
{
	if (p->st != ST_OK)
		return false;
	bool yes = take_word(p, "yes");
	if (!yes && !take_word(p, "no"))
		fail(p, "%s: yes or no", what);
	return yes;
}

static int hex_digit(char c)
{
	return c >= '0' && c <= '9' ? c - '0' : c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/* The character that stands behind a backslash at *s. */
static bool read_escape(const char **s, const char *end, char *out)
{
	if (*s >= end)
		return false;
	*out = *(*s)++;
	if (*out == '"' || *out == '\\')
		return true;
	if (*out == 'n') {
		*out = '\n';
		return true;
	}
	if (*out != 'x' || end - *s < 2)
		return false;
	int hi = hex_digit((*s)[0]), lo = hex_digit((*s)[1]);
	*s += 2;
	*out = (char)(hi * 16 + lo);
	return hi >= 0 && lo >= 0 && *out != '\0';
}

/* A string in quotes; fresh. NULL when the parser has failed. */
static char *read_string(struct parser *p, const char *what)
{
	if (p->st != ST_OK)
		return NULL;
	skip_blanks(p);
	const char *s = p->s;
	struct text t = { 0 };
	bool good = s < p->end && *s++ == '"';
	text_add(&t, "");
	while (good && s < p->end && *s != '"') {
		char c = *s++;
		good = c == '\\' ? read_escape(&s, p->end, &c) : c != '\n' && c != '\0';
		text_add_bytes(&t, &c, 1);
	}
	if (!good || s >= p->end) {
		text_finish(&t);
		fail(p, "%s: a string in double quotes, closed on its line", what);
		return NULL;
	}
	p->s = s + 1;
	char *out = text_take(&t);
	if (!out)
		fail_memory(p);
	return out;
}

static void read_attribute(struct parser *p, struct entity *e)
{
	char *name = read_string(p, "name of the attribute");
	char *value = read_string(p, "value of the attribute");
	if (p->st == ST_OK)
		keep(p, e ? entity_set_attribute(e, name, value)
		          : model_set_attribute(p->m, name, value));
	free(name);
	free(value);
}

static void read_numbers(struct parser *p, double *out, int64_t n, const char *what)
{
	for (int64_t i = 0; i < n && p->st == ST_OK; i++) {
		out[i] = read_number(p, what);
		if ((i & 0xffff) == 0xffff) {
			enum status st =
			        progress_step(p->progress, (double)(p->s - p->start) /
			                                           (double)(p->end - p->start));
			if (st != ST_OK)
				p->st = st;
		}
	}
}

static void field_name(struct parser *p, struct draft *d)
{
	free(d->e.name);
	d->e.name = read_string(p, "name");
}

static void field_de(struct parser *p, struct draft *d)
{
	d->e.de = read_integer(p, "directory entry", 1, INT_MAX);
}

static void field_source(struct parser *p, struct draft *d)
{
	d->e.source_type = read_integer(p, "IGES type of the source", 1, INT_MAX);
}

static void field_trims(struct parser *p, struct draft *d)
{
	d->e.trims = read_integer(p, "number of trimming loops", 0, INT_MAX);
}

static void field_face(struct parser *p, struct draft *d)
{
	int de = read_integer(p, "directory entry of a face", 1, INT_MAX);
	if (p->st == ST_OK)
		keep(p, entity_add_face(&d->e, de));
}

static void field_used(struct parser *p, struct draft *d)
{
	d->e.used = read_flag(p, "used");
}

static void field_color(struct parser *p, struct draft *d)
{
	d->e.has_color = true;
	read_numbers(p, d->e.color, 3, "color");
}

static void field_attribute(struct parser *p, struct draft *d)
{
	read_attribute(p, &d->e);
}

static void field_surface(struct parser *p, struct draft *d)
{
	d->e.surface =
	        read_integer(p, "number of the surface in the file, 0 for none", 0, INT_MAX) - 1;
}

static int directions(const struct draft *d)
{
	return d->e.kind == ENTITY_SURFACE ? 2 : 1;
}

static void field_order(struct parser *p, struct draft *d)
{
	for (int i = 0; i < directions(d); i++)
		d->order[i] = read_integer(p, "order", ORDER_MIN, ORDER_MAX);
}

/* Order and counts are known: make room. */
static void field_ncontpts(struct parser *p, struct draft *d)
{
	for (int i = 0; i < directions(d); i++)
		d->n[i] = read_integer(p, "number of control points", d->order[i],
		                       numbers_left(p, i ? 4 * d->n[0] : 4));
	if (p->st != ST_OK)
		return;
	if (d->e.kind == ENTITY_SURFACE)
		keep(p, surface_init(&d->e.geometry, d->order, d->n));
	else
		keep(p, curve_init(d->curve, d->order[0], d->n[0]));
}

static void field_periodic(struct parser *p, struct draft *d)
{
	bool *out = d->e.kind == ENTITY_SURFACE ? d->e.geometry.periodic : &d->curve->periodic;
	for (int i = 0; i < directions(d); i++)
		out[i] = read_flag(p, "periodic");
}

static void field_domain(struct parser *p, struct draft *d)
{
	double *out = d->e.kind == ENTITY_SURFACE ? d->e.geometry.domain[0] : d->curve->domain;
	read_numbers(p, out, 2 * directions(d), "domain");
}

static void field_knots(struct parser *p, struct draft *d)
{
	read_numbers(p, d->curve->knots, d->n[0] + d->order[0], "knot");
}

static void field_uknots(struct parser *p, struct draft *d)
{
	read_numbers(p, d->e.geometry.knots[0], d->n[0] + d->order[0], "knot in u");
}

static void field_vknots(struct parser *p, struct draft *d)
{
	read_numbers(p, d->e.geometry.knots[1], d->n[1] + d->order[1], "knot in v");
}

static void field_contpts(struct parser *p, struct draft *d)
{
	if (d->e.kind == ENTITY_SURFACE)
		read_numbers(p, d->e.geometry.points, (int64_t)4 * d->n[0] * d->n[1],
		             "control point w x, w y, w z, w");
	else
		read_numbers(p, d->curve->points, (int64_t)4 * d->n[0],
		             "control point w x, w y, w z, w");
}

static void field_dimension(struct parser *p, struct draft *d)
{
	d->e.points.dimension = read_integer(p, "dimension", 2, 3);
}

static void field_values(struct parser *p, struct draft *d)
{
	struct point_list *l = &d->e.points;
	int n = read_integer(p, "number of points", 1, numbers_left(p, l->dimension));
	if (p->st != ST_OK)
		return;
	l->values = calloc((size_t)n * l->dimension, sizeof *l->values);
	if (!l->values) {
		fail_memory(p);
		return;
	}
	l->n = n;
	read_numbers(p, l->values, (int64_t)n * l->dimension, "coordinate");
}

#define BIT(kind) (1u << (kind))
enum {
	IN_CURVES = BIT(ENTITY_CURVE) | BIT(ENTITY_CURVE_ON_SURFACE),
	IN_SURFACE = BIT(ENTITY_SURFACE),
	IN_SPLINES = IN_CURVES | IN_SURFACE,
	IN_POINTS = BIT(ENTITY_POINTS),
	IN_ALL = IN_SPLINES | IN_POINTS,
};

enum field {
	F_NAME,
	F_DE,
	F_SOURCE,
	F_TRIMS,
	F_FACE,
	F_USED,
	F_COLOR,
	F_ATTRIBUTE,
	F_SURFACE,
	F_ORDER,
	F_NCONTPTS,
	F_PERIODIC,
	F_DOMAIN,
	F_KNOTS,
	F_UKNOTS,
	F_VKNOTS,
	F_CONTPTS,
	F_DIMENSION,
	F_VALUES,
	N_FIELDS,
};

/* after: the field that must stand before; repeats: may stand several times; spline: stands once
 * for the curve in u, v and once more for the one in space; must: the entity is nothing without. */
static const struct {
	const char *word;
	field_read *read;
	unsigned in;
	enum field after;
	bool repeats, spline, must;
} fields[N_FIELDS] = {
	[F_NAME] = { "name", field_name, IN_ALL, N_FIELDS, false, false, false },
	[F_DE] = { "de", field_de, IN_ALL, N_FIELDS, false, false, false },
	[F_SOURCE] = { "source", field_source, IN_ALL, N_FIELDS, false, false, false },
	[F_TRIMS] = { "trims", field_trims, IN_SURFACE, N_FIELDS, false, false, false },
	[F_FACE] = { "face", field_face, IN_SURFACE, N_FIELDS, true, false, false },
	[F_USED] = { "used", field_used, IN_ALL, N_FIELDS, false, false, false },
	[F_COLOR] = { "color", field_color, IN_ALL, N_FIELDS, false, false, false },
	[F_ATTRIBUTE] = { "attribute", field_attribute, IN_ALL, N_FIELDS, true, false, false },
	[F_SURFACE] = { "surface", field_surface, BIT(ENTITY_CURVE_ON_SURFACE), N_FIELDS, false,
	                false, false },
	[F_ORDER] = { "order", field_order, IN_SPLINES, N_FIELDS, false, true, true },
	[F_NCONTPTS] = { "ncontpts", field_ncontpts, IN_SPLINES, F_ORDER, false, true, true },
	[F_PERIODIC] = { "periodic", field_periodic, IN_SPLINES, F_NCONTPTS, false, true, false },
	[F_DOMAIN] = { "domain", field_domain, IN_SPLINES, F_NCONTPTS, false, true, false },
	[F_KNOTS] = { "knots", field_knots, IN_CURVES, F_NCONTPTS, false, true, true },
	[F_UKNOTS] = { "uknots", field_uknots, IN_SURFACE, F_NCONTPTS, false, false, true },
	[F_VKNOTS] = { "vknots", field_vknots, IN_SURFACE, F_NCONTPTS, false, false, true },
	[F_CONTPTS] = { "contpts", field_contpts, IN_SPLINES, F_NCONTPTS, false, true, true },
	[F_DIMENSION] = { "dimension", field_dimension, IN_POINTS, N_FIELDS, false, false, true },
	[F_VALUES] = { "values", field_values, IN_POINTS, F_DIMENSION, false, false, true },
};

static void check_complete(struct parser *p, const struct draft *d)
{
	for (int f = 0; f < N_FIELDS; f++)
		if (fields[f].must && (fields[f].in & BIT(d->e.kind)) && !(d->seen & BIT(f)))
			fail(p, "the field '%s' of this %s", fields[f].word,
			     entity_kind_name(d->e.kind));
}

/* `space`: what curve fields follow are of the curve in space. */
static void begin_space(struct parser *p, struct draft *d)
{
	if (d->e.kind != ENTITY_CURVE_ON_SURFACE || d->curve == &d->e.space)
		fail(p, "another field; 'space' stands once, in a curve_on_surface");
	check_complete(p, d);
	d->curve = &d->e.space;
	for (int f = 0; f < N_FIELDS; f++)
		if (fields[f].spline)
			d->seen &= ~BIT(f);
}

static void read_field(struct parser *p, struct draft *d)
{
	enum field f = 0;
	while (f < N_FIELDS && !take_word(p, fields[f].word))
		f++;
	if (f == N_FIELDS)
		fail(p, "a field of a %s, 'attribute' or 'end'", entity_kind_name(d->e.kind));
	else if (!(fields[f].in & BIT(d->e.kind)))
		fail(p, "a field that a %s has", entity_kind_name(d->e.kind));
	else if ((d->seen & BIT(f)) && !fields[f].repeats)
		fail(p, "the field '%s' once", fields[f].word);
	else if (fields[f].after != N_FIELDS && !(d->seen & BIT(fields[f].after)))
		fail(p, "the field '%s' before it", fields[fields[f].after].word);
	if (p->st != ST_OK)
		return;
	d->seen |= BIT(f);
	fields[f].read(p, d);
}

static enum status check_shape(struct parser *p, struct draft *d)
{
	int column, line = line_of(p, d->begin, &column);
	char *what =
	        text_print("%s:%d:%d: this %s", p->name, line, column, entity_kind_name(d->e.kind));
	enum status st = what ? ST_OK : ST_RESOURCE;
	if (st == ST_OK && d->e.kind == ENTITY_SURFACE)
		st = surface_check(&d->e.geometry, what, p->r);
	else if (st == ST_OK && d->e.kind != ENTITY_POINTS)
		st = curve_check(&d->e.curve, what, p->r);
	if (st == ST_OK && d->e.space.order)
		st = curve_check(&d->e.space, what, p->r);
	free(what);
	return st;
}

static void read_entity(struct parser *p)
{
	struct draft d = { .begin = p->token };
	int kind = 0;
	while (kind < N_ENTITY_KINDS && !take_word(p, entity_kind_name(kind)))
		kind++;
	if (kind == N_ENTITY_KINDS) {
		fail(p, "a type: curve, surface, curve_on_surface or points");
		return;
	}
	entity_init(&d.e, kind);
	d.curve = &d.e.curve;
	while (p->st == ST_OK && !take_word(p, "end")) {
		if (take_word(p, "space"))
			begin_space(p, &d);
		else
			read_field(p, &d);
	}
	check_complete(p, &d);
	if (p->st == ST_OK)
		p->st = check_shape(p, &d);
	if (p->st == ST_OK)
		keep(p, model_add(p->m, &d.e));
	entity_finish(&d.e);
}

static void read_unit(struct parser *p)
{
	free(p->m->unit);
	p->m->unit = read_string(p, "name of the unit");
	p->m->unit_in_mm = read_number(p, "millimetres in the unit, 0 if not known");
	if (p->st == ST_OK && p->m->unit_in_mm < 0)
		fail(p, "millimetres in the unit, not below 0");
	if (p->st == ST_OK && p->m->unit[0] == '\0')
		keep(p, model_set_text(&p->m->unit, NULL));
}

static void read_header(struct parser *p)
{
	if (!take_word(p, "batten") || !take_word(p, "base"))
		fail(p, "'batten base 1', the first line of a .base file");
	if (p->st == ST_OK && !take_word(p, "1"))
		fail(p, "version 1; a newer batten may read this file");
}

/* Curves on surface name surfaces that are there. */
static void check_references(struct parser *p)
{
	for (int i = 0; i < p->m->n && p->st == ST_OK; i++) {
		int s = p->m->entities[i].surface;
		if (s >= 0 && (s >= p->m->n || p->m->entities[s].kind != ENTITY_SURFACE))
			p->st = report_error(
			        p->r, ST_INPUT,
			        "cannot read '%s': the curve on surface that is entity %d "
			        "names entity %d as its surface, which is none",
			        p->name, i + 1, s + 1);
	}
}

enum status base_parse(struct model *m, const char *bytes, size_t n, const char *name,
                       const struct progress *progress, const struct report *r)
{
	struct parser p = { .start = bytes,
		            .s = bytes,
		            .end = bytes + n,
		            .token = bytes,
		            .name = name,
		            .m = m,
		            .progress = progress,
		            .r = r,
		            .st = ST_OK };
	int64_t count = -1;
	read_header(&p);
	while (p.st == ST_OK && !(skip_blanks(&p), p.s >= p.end)) {
		if (take_word(&p, "type"))
			(skip_blanks(&p), read_entity(&p));
		else if (take_word(&p, "unit"))
			read_unit(&p);
		else if (take_word(&p, "scale"))
			m->scale = read_number(&p, "scale");
		else if (take_word(&p, "attribute"))
			read_attribute(&p, NULL);
		else if (take_word(&p, "entities"))
			count = read_integer(&p, "number of entities", 0, INT_MAX);
		else
			fail(&p, "'type', 'unit', 'scale', 'attribute' or 'entities'");
	}
	if (p.st == ST_OK && count >= 0 && count != m->n)
		fail(&p, "%d entities, of which %d are here: the file is cut short", (int)count,
		     m->n);
	if (p.st == ST_OK && m->n == 0)
		fail(&p, "'type', the beginning of an entity");
	if (p.st == ST_OK)
		check_references(&p);
	if (p.st == ST_OK)
		model_number(m);
	return p.st;
}
