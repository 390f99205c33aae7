/* base_format.c - writer of the .base text format; docs/formats.md has its grammar. */
#include "base.h"

#include <stdio.h>
#include <stdlib.h>

#include "file.h"

static void add_string(struct text *t, const char *s)
{
	text_add(t, "\"");
	for (; *s; s++) {
		unsigned char c = (unsigned char)*s;
		if (c == '"' || c == '\\')
			text_addf(t, "\\%c", c);
		else if (c == '\n')
			text_add(t, "\\n");
		else if (c < 0x20 || c == 0x7f)
			text_addf(t, "\\x%02x", c);
		else
			text_add_bytes(t, s, 1);
	}
	text_add(t, "\"");
}

static void add_named(struct text *t, const char *field, const char *value)
{
	text_addf(t, "\t%s ", field);
	add_string(t, value);
	text_add(t, "\n");
}

static void add_attributes(struct text *t, const char *indent, const struct attribute *a, int n)
{
	for (int i = 0; i < n; i++) {
		text_addf(t, "%sattribute ", indent);
		add_string(t, a[i].name);
		text_add(t, " ");
		add_string(t, a[i].value);
		text_add(t, "\n");
	}
}

/* n numbers, `each` a line (0: all on the line begun). */
static void add_values(struct text *t, const double *x, size_t n, int each)
{
	for (size_t i = 0; i < n; i++) {
		text_add(t, each && i % each == 0 ? "\n\t\t" : " ");
		text_add_number(t, x[i]);
	}
	text_add(t, "\n");
}

static void add_numbers(struct text *t, const char *field, const double *x, size_t n, int each)
{
	text_addf(t, "\t%s", field);
	add_values(t, x, n, each);
}

static const char *flag(bool yes)
{
	return yes ? "yes" : "no";
}

static void add_curve(struct text *t, const struct curve *c)
{
	text_addf(t, "\torder %d\n\tncontpts %d\n\tperiodic %s\n", c->order, c->n,
	          flag(c->periodic));
	add_numbers(t, "domain", c->domain, 2, 0);
	add_numbers(t, "knots", c->knots, (size_t)c->n + c->order, 0);
	add_numbers(t, "contpts", c->points, (size_t)4 * c->n, 4);
}

static void add_surface(struct text *t, const struct surface *s)
{
	text_addf(t, "\torder %d %d\n\tncontpts %d %d\n\tperiodic %s %s\n", s->order[0],
	          s->order[1], s->n[0], s->n[1], flag(s->periodic[0]), flag(s->periodic[1]));
	add_numbers(t, "domain", s->domain[0], 4, 0);
	add_numbers(t, "uknots", s->knots[0], (size_t)s->n[0] + s->order[0], 0);
	add_numbers(t, "vknots", s->knots[1], (size_t)s->n[1] + s->order[1], 0);
	add_numbers(t, "contpts", s->points, (size_t)4 * s->n[0] * s->n[1], 4);
}

static void add_trim(struct text *t, const struct trim *trim)
{
	for (int i = 0; i < trim->n; i++) {
		const struct trim_loop *l = &trim->loops[i];
		text_addf(t, "\tloop %s\n", l->outer ? "outer" : "inner");
		for (int j = 0; j < l->n; j++) {
			text_add(t, "\tcurve\n");
			add_curve(t, &l->curves[j]);
			text_add(t, "\tend\n");
		}
		text_add(t, "\tend\n");
	}
}

static void add_points(struct text *t, const struct point_list *l)
{
	text_addf(t, "\tdimension %d\n\tvalues %d", l->dimension, l->n);
	add_values(t, l->values, (size_t)l->n * l->dimension, l->dimension);
}

/* With the fewest digits that read back as the same float. */
static void add_color(struct text *t, const float color[3])
{
	char digits[32];
	text_add(t, "\tcolor");
	for (int i = 0; i < 3; i++) {
		int n = 6;
		do
			snprintf(digits, sizeof digits, "%.*g", n, (double)color[i]);
		while (n++ < 9 && strtof(digits, NULL) != color[i]);
		text_addf(t, " %s", digits);
	}
	text_add(t, "\n");
}

/* `surface`: place of the entity's surface in the file, from 1, 0 for none. */
static void add_entity(struct text *t, const struct entity *e, bool used, int surface)
{
	text_addf(t, "\ntype %s\n", entity_kind_name(e->kind));
	if (e->name)
		add_named(t, "name", e->name);
	if (e->de)
		text_addf(t, "\tde %d\n", e->de);
	if (e->source_type)
		text_addf(t, "\tsource %d\n", e->source_type);
	if (e->trims)
		text_addf(t, "\ttrims %d\n", e->trims);
	for (int i = 0; e->kind == ENTITY_SURFACE && e->faces && i < e->faces->n; i++)
		text_addf(t, "\tface %d\n", e->faces->de[i]);
	if (used)
		text_add(t, "\tused yes\n");
	if (e->has_color)
		add_color(t, e->color);
	add_attributes(t, "\t", e->attributes, e->n_attributes);
	if (e->kind == ENTITY_CURVE_ON_SURFACE)
		text_addf(t, "\tsurface %d\n", surface);
	if (e->kind == ENTITY_SURFACE) {
		add_surface(t, &e->geometry);
		add_trim(t, &e->trim);
	} else if (e->kind == ENTITY_POINTS) {
		add_points(t, &e->points);
	} else {
		add_curve(t, &e->curve);
	}
	if (e->kind == ENTITY_CURVE_ON_SURFACE && e->space.order) {
		text_add(t, "\tspace\n");
		add_curve(t, &e->space);
	}
	text_add(t, "end\n");
}

static void add_header(struct text *t, const struct model *m, int n)
{
	text_add(t, "batten base 1\n");
	if (m->unit || m->unit_in_mm > 0) {
		text_add(t, "unit ");
		add_string(t, m->unit ? m->unit : "");
		text_add(t, " ");
		text_add_number(t, m->unit_in_mm);
		text_add(t, "\n");
	}
	text_add(t, "scale ");
	text_add_number(t, m->scale);
	text_addf(t, "\nentities %d\n", n);
}

void base_format_piece(const struct model *m, int piece, struct text *out)
{
	if (piece == 0) {
		add_header(out, m, m->n);
		add_attributes(out, "", m->attributes, m->n_attributes);
		return;
	}
	const struct entity *e = &m->entities[piece - 1];
	add_entity(out, e, e->used, e->surface + 1);
}

void base_format(const struct model *m, struct text *out)
{
	for (int piece = 0; piece <= m->n; piece++)
		base_format_piece(m, piece, out);
}

void base_format_entity(const struct model *m, const struct entity *e, struct text *out)
{
	bool surface = e->kind == ENTITY_CURVE_ON_SURFACE && e->surface >= 0;
	add_header(out, m, surface ? 2 : 1);
	add_entity(out, e, false, surface ? 2 : 0);
	if (surface)
		add_entity(out, &m->entities[e->surface], true, 0);
}

enum status base_write(const struct model *m, const char *path, const struct report *r)
{
	struct whole_file f;
	struct text t = { 0 };
	enum status st = whole_file_create(&f, path, r);
	if (st != ST_OK)
		return st;
	for (int piece = 0; piece <= m->n && !t.failed; piece++) {
		text_reset(&t);
		base_format_piece(m, piece, &t);
		if (!t.failed)
			fwrite(t.s, 1, t.n, f.stream); /* the commit looks for errors */
	}
	if (t.failed) {
		whole_file_abandon(&f);
		st = report_error(r, ST_RESOURCE, "cannot write '%s': no memory", path);
	} else {
		st = whole_file_commit(&f, r);
	}
	text_finish(&t);
	return st;
}
