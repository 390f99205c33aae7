/* base.c - reader of the .base text format; docs/formats.md has its grammar. */
#include "base.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "base_scan.h"

/* What has been said of the entity at hand. */
struct draft {
	struct entity e;
	struct curve *curve; /* the one that curve fields fill: in u, v or in space */
	unsigned seen;       /* bits of fields[] */
	int order[2], n[2];
	int dimension;
	bool loop; /* a curve of a trimming loop: nothing but its spline is told */
	const char *begin;
};

typedef void field_read(struct scanner *p, struct draft *d);

bool base_recognise(const char *bytes, size_t n)
{
	static const char first[] = "batten base";
	return n >= sizeof first && memcmp(bytes, first, sizeof first - 1) == 0;
}

static void read_attribute(struct scanner *p, struct entity *e)
{
	char *name = scan_string(p, "name of the attribute");
	char *value = scan_string(p, "value of the attribute");
	if (p->st == ST_OK)
		scan_keep(p, e ? entity_set_attribute(e, name, value)
		               : model_set_attribute(p->m, name, value));
	free(name);
	free(value);
}

static void field_name(struct scanner *p, struct draft *d)
{
	free(d->e.name);
	d->e.name = scan_string(p, "name");
}

static void field_de(struct scanner *p, struct draft *d)
{
	d->e.de = scan_integer(p, "directory entry", 1, INT_MAX);
}

static void field_source(struct scanner *p, struct draft *d)
{
	d->e.source_type = (unsigned)scan_integer(p, "IGES type of the source", 1, SOURCE_TYPE_MAX);
}

static void field_trims(struct scanner *p, struct draft *d)
{
	d->e.trims = scan_integer(p, "number of trimming loops", 0, INT_MAX);
}

static void field_face(struct scanner *p, struct draft *d)
{
	int de = scan_integer(p, "directory entry of a face", 1, INT_MAX);
	if (p->st == ST_OK)
		scan_keep(p, entity_add_face(&d->e, de));
}

static void field_used(struct scanner *p, struct draft *d)
{
	d->e.used = scan_flag(p, "used");
}

static void field_color(struct scanner *p, struct draft *d)
{
	double color[3] = { 0 };
	scan_numbers(p, color, 3, "color");
	d->e.has_color = true;
	for (int i = 0; i < 3; i++)
		d->e.color[i] = (float)color[i];
}

static void field_attribute(struct scanner *p, struct draft *d)
{
	read_attribute(p, &d->e);
}

static void field_surface(struct scanner *p, struct draft *d)
{
	d->e.surface =
	        scan_integer(p, "number of the surface in the file, 0 for none", 0, INT_MAX) - 1;
}

static int directions(const struct draft *d)
{
	return d->e.kind == ENTITY_SURFACE ? 2 : 1;
}

static void field_order(struct scanner *p, struct draft *d)
{
	for (int i = 0; i < directions(d); i++)
		d->order[i] = scan_integer(p, "order", ORDER_MIN, ORDER_MAX);
}

/* Order and counts are known: make room. */
static void field_ncontpts(struct scanner *p, struct draft *d)
{
	for (int i = 0; i < directions(d) && p->st == ST_OK; i++)
		d->n[i] = scan_integer(p, "number of control points", d->order[i],
		                       scan_numbers_left(p, i ? (int64_t)4 * d->n[0] : 4));
	if (p->st != ST_OK)
		return;
	if (d->e.kind == ENTITY_SURFACE)
		scan_keep(p, surface_init(&d->e.geometry, d->order, d->n));
	else
		scan_keep(p, curve_init(d->curve, d->order[0], d->n[0]));
}

static void field_periodic(struct scanner *p, struct draft *d)
{
	bool *out = d->e.kind == ENTITY_SURFACE ? d->e.geometry.periodic : &d->curve->periodic;
	for (int i = 0; i < directions(d); i++)
		out[i] = scan_flag(p, "periodic");
}

static void field_domain(struct scanner *p, struct draft *d)
{
	double *out = d->e.kind == ENTITY_SURFACE ? d->e.geometry.domain[0] : d->curve->domain;
	scan_numbers(p, out, 2 * directions(d), "domain");
}

static void field_knots(struct scanner *p, struct draft *d)
{
	scan_numbers(p, d->curve->knots, d->n[0] + d->order[0], "knot");
}

static void field_uknots(struct scanner *p, struct draft *d)
{
	scan_numbers(p, d->e.geometry.knots[0], d->n[0] + d->order[0], "knot in u");
}

static void field_vknots(struct scanner *p, struct draft *d)
{
	scan_numbers(p, d->e.geometry.knots[1], d->n[1] + d->order[1], "knot in v");
}

static void field_contpts(struct scanner *p, struct draft *d)
{
	if (d->e.kind == ENTITY_SURFACE)
		scan_numbers(p, d->e.geometry.points, (int64_t)4 * d->n[0] * d->n[1],
		             "control point w x, w y, w z, w");
	else
		scan_numbers(p, d->curve->points, (int64_t)4 * d->n[0],
		             "control point w x, w y, w z, w");
}

static void field_dimension(struct scanner *p, struct draft *d)
{
	d->e.points.dimension = scan_integer(p, "dimension", 2, 3);
}

static void field_values(struct scanner *p, struct draft *d)
{
	struct point_list *l = &d->e.points;
	int n = scan_integer(p, "number of points", 1, scan_numbers_left(p, l->dimension));
	if (p->st != ST_OK)
		return;
	l->values = calloc((size_t)n * l->dimension, sizeof *l->values);
	if (!l->values) {
		scan_no_memory(p);
		return;
	}
	l->n = n;
	scan_numbers(p, l->values, (int64_t)n * l->dimension, "coordinate");
}

static void read_curve(struct scanner *p, struct trim_loop *out);

/* A loop: its sense and its curves. */
static void field_loop(struct scanner *p, struct draft *d)
{
	struct trim_loop l = { .outer = scan_word(p, "outer") };
	if (!l.outer && !scan_word(p, "inner"))
		scan_fail(p, "outer or inner");
	while (p->st == ST_OK && !(l.n && scan_word(p, "end"))) {
		if (scan_word(p, "curve"))
			read_curve(p, &l);
		else
			scan_fail(p, l.n ? "'curve' or 'end'" : "'curve', the first of the loop");
	}
	if (p->st == ST_OK)
		scan_keep(p, trim_add(&d->e.trim, &l));
	trim_loop_finish(&l);
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
	F_LOOP,
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
	[F_LOOP] = { "loop", field_loop, IN_SURFACE, N_FIELDS, true, false, false },
	[F_DIMENSION] = { "dimension", field_dimension, IN_POINTS, N_FIELDS, false, false, true },
	[F_VALUES] = { "values", field_values, IN_POINTS, F_DIMENSION, false, false, true },
};

static void check_complete(struct scanner *p, const struct draft *d)
{
	for (int f = 0; f < N_FIELDS; f++)
		if (fields[f].must && (fields[f].in & BIT(d->e.kind)) && !(d->seen & BIT(f)))
			scan_fail(p, "the field '%s' of this %s", fields[f].word,
			          entity_kind_name(d->e.kind));
}

/* `space`: what curve fields follow are of the curve in space. */
static void begin_space(struct scanner *p, struct draft *d)
{
	if (d->e.kind != ENTITY_CURVE_ON_SURFACE || d->curve == &d->e.space)
		scan_fail(p, "another field; 'space' stands once, in a curve_on_surface");
	check_complete(p, d);
	d->curve = &d->e.space;
	for (int f = 0; f < N_FIELDS; f++)
		if (fields[f].spline)
			d->seen &= ~BIT(f);
}

static void read_field(struct scanner *p, struct draft *d)
{
	enum field f = 0;
	while (f < N_FIELDS && !scan_word(p, fields[f].word))
		f++;
	if (f == N_FIELDS)
		scan_fail(p, "a field of a %s, 'attribute' or 'end'", entity_kind_name(d->e.kind));
	else if (!(fields[f].in & BIT(d->e.kind)))
		scan_fail(p, "a field that a %s has", entity_kind_name(d->e.kind));
	else if (d->loop && !fields[f].spline)
		scan_fail(p, "a field that a curve of a loop has");
	else if ((d->seen & BIT(f)) && !fields[f].repeats)
		scan_fail(p, "the field '%s' once", fields[f].word);
	else if (fields[f].after != N_FIELDS && !(d->seen & BIT(fields[f].after)))
		scan_fail(p, "the field '%s' before it", fields[fields[f].after].word);
	if (p->st != ST_OK)
		return;
	d->seen |= BIT(f);
	fields[f].read(p, d);
}

/* Where the entity stands is looked for only when it is needed: that takes a walk from the start. */
static enum status check_shape(struct scanner *p, struct draft *d)
{
	struct report_store store;
	const char *what = entity_kind_name(d->e.kind);
	enum status st = ST_OK;
	report_store_init(&store);
	if (d->e.kind == ENTITY_SURFACE)
		st = surface_check(&d->e.geometry, what, &store.report);
	else if (d->e.kind != ENTITY_POINTS)
		st = curve_check(&d->e.curve, what, &store.report);
	if (st == ST_OK && d->e.kind == ENTITY_CURVE_ON_SURFACE && d->e.space.order)
		st = curve_check(&d->e.space, "its curve in space", &store.report);
	if (st == ST_OK)
		return ST_OK;
	int column, line = scan_line(p, d->begin, &column);
	return report_error(p->r, st, "%s:%d:%d: %s", p->name, line, column, store.error);
}

/* All up to `end`. */
static void read_fields(struct scanner *p, struct draft *d)
{
	d->curve = &d->e.curve;
	while (p->st == ST_OK && !scan_word(p, "end")) {
		if (scan_word(p, "space"))
			begin_space(p, d);
		else
			read_field(p, d);
	}
	check_complete(p, d);
	if (p->st == ST_OK)
		p->st = check_shape(p, d);
}

/* A curve of a loop. */
static void read_curve(struct scanner *p, struct trim_loop *out)
{
	struct draft d = { .begin = p->token, .loop = true };
	entity_init(&d.e, ENTITY_CURVE);
	read_fields(p, &d);
	if (p->st == ST_OK)
		scan_keep(p, trim_loop_add(out, &d.e.curve));
	entity_finish(&d.e);
}

static void read_entity(struct scanner *p)
{
	struct draft d = { .begin = p->token };
	int kind = 0;
	while (kind < N_ENTITY_KINDS && !scan_word(p, entity_kind_name(kind)))
		kind++;
	if (kind == N_ENTITY_KINDS) {
		scan_fail(p, "a type: curve, surface, curve_on_surface or points");
		return;
	}
	entity_init(&d.e, kind);
	read_fields(p, &d);
	if (kind == ENTITY_SURFACE && d.e.trims < d.e.trim.n)
		d.e.trims = d.e.trim.n;
	if (p->st == ST_OK)
		scan_keep(p, model_add(p->m, &d.e));
	entity_finish(&d.e);
}

static void read_unit(struct scanner *p)
{
	free(p->m->unit);
	p->m->unit = scan_string(p, "name of the unit");
	p->m->unit_in_mm = scan_number(p, "millimetres in the unit, 0 if not known");
	if (p->st == ST_OK && p->m->unit_in_mm < 0)
		scan_fail(p, "millimetres in the unit, not below 0");
	if (p->st == ST_OK && p->m->unit[0] == '\0')
		scan_keep(p, model_set_text(&p->m->unit, NULL));
}

static void read_header(struct scanner *p)
{
	if (!scan_word(p, "batten") || !scan_word(p, "base"))
		scan_fail(p, "'batten base 1', the first line of a .base file");
	if (p->st == ST_OK && !scan_word(p, "1"))
		scan_fail(p, "version 1; a newer batten may read this file");
}

/* Curves on surface name surfaces that are there. */
static void check_references(struct scanner *p)
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
	struct scanner p;
	int64_t count = -1;
	scan_init(&p, bytes, n, name, m, progress, r);
	read_header(&p);
	while (p.st == ST_OK && !(scan_blanks(&p), p.s >= p.end)) {
		if (scan_word(&p, "type"))
			(scan_blanks(&p), read_entity(&p));
		else if (scan_word(&p, "unit"))
			read_unit(&p);
		else if (scan_word(&p, "scale"))
			m->scale = scan_number(&p, "scale");
		else if (scan_word(&p, "attribute"))
			read_attribute(&p, NULL);
		else if (scan_word(&p, "entities"))
			count = scan_integer(&p, "number of entities", 0, INT_MAX);
		else
			scan_fail(&p, "'type', 'unit', 'scale', 'attribute' or 'entities'");
	}
	if (p.st == ST_OK && count >= 0 && count != m->n)
		scan_fail(&p, "%d entities, of which %d are here: the file is cut short",
		          (int)count, m->n);
	if (p.st == ST_OK && m->n == 0)
		scan_fail(&p, "'type', the beginning of an entity");
	if (p.st == ST_OK)
		check_references(&p);
	if (p.st == ST_OK)
		model_number(m);
	return p.st;
}
