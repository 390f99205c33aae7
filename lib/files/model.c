/* model.c - the lists of a model: entities, what was skipped, warnings, attributes. */
#include "model.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Room for one more in an array that doubles: n elements are in it. */
static enum status array_grow(void **p, int n, size_t size)
{
	if (n && (n & (n - 1)))
		return ST_OK;
	size_t room = n ? (size_t)n * 2 : 1;
	void *q = reallocarray(*p, room, size);
	if (!q)
		return ST_RESOURCE;
	*p = q;
	return ST_OK;
}

enum status model_set_text(char **field, const char *text)
{
	char *copy = NULL;
	if (text && !(copy = strdup(text)))
		return ST_RESOURCE;
	free(*field);
	*field = copy;
	return ST_OK;
}

static void attributes_finish(struct attribute *a, int n)
{
	for (int i = 0; i < n; i++) {
		free(a[i].name);
		free(a[i].value);
	}
	free(a);
}

/* *added: there is one more than the n before. */
static enum status attributes_set(struct attribute **a, int n, const char *name, const char *value,
                                  bool *added)
{
	*added = false;
	for (int i = 0; i < n; i++)
		if (strcmp((*a)[i].name, name) == 0)
			return model_set_text(&(*a)[i].value, value);
	enum status st = n < ATTRIBUTES_MAX ? array_grow((void **)a, n, sizeof **a) : ST_RESOURCE;
	if (st != ST_OK)
		return st;
	struct attribute fresh = { strdup(name), strdup(value) };
	if (!fresh.name || !fresh.value) {
		free(fresh.name);
		free(fresh.value);
		return ST_RESOURCE;
	}
	(*a)[n] = fresh;
	*added = true;
	return ST_OK;
}

static const char *attributes_get(const struct attribute *a, int n, const char *name)
{
	for (int i = 0; i < n; i++)
		if (strcmp(a[i].name, name) == 0)
			return a[i].value;
	return NULL;
}

void entity_init(struct entity *e, enum entity_kind kind)
{
	*e = (struct entity){ .kind = kind, .surface = -1 };
}

void entity_finish(struct entity *e)
{
	if (!e)
		return;
	free(e->name);
	switch (e->kind) {
	case ENTITY_CURVE:
	case ENTITY_CURVE_ON_SURFACE:
		curve_finish(&e->curve);
		curve_finish(&e->space);
		break;
	case ENTITY_SURFACE:
		surface_finish(&e->geometry);
		trim_finish(&e->trim);
		free(e->faces);
		break;
	case ENTITY_POINTS:
		free(e->points.values);
		break;
	case N_ENTITY_KINDS:
		break;
	}
	attributes_finish(e->attributes, e->n_attributes);
	entity_init(e, e->kind);
}

enum status entity_set_attribute(struct entity *e, const char *name, const char *value)
{
	bool added;
	enum status st = attributes_set(&e->attributes, e->n_attributes, name, value, &added);
	e->n_attributes += added;
	return st;
}

const char *entity_get_attribute(const struct entity *e, const char *name)
{
	return attributes_get(e->attributes, e->n_attributes, name);
}

enum status entity_add_face(struct entity *e, int de)
{
	if (e->kind != ENTITY_SURFACE)
		return ST_INTERNAL;
	const int n = e->faces ? e->faces->n : 0;
	if ((n & (n - 1)) == 0) {
		const size_t room = n ? (size_t)n * 2 : 1;
		struct face_list *more = realloc(e->faces, sizeof *more + room * sizeof *more->de);
		if (!more)
			return ST_RESOURCE;
		e->faces = more;
	}
	e->faces->de[n] = de;
	e->faces->n = n + 1;
	return ST_OK;
}

const char *entity_kind_name(enum entity_kind kind)
{
	static const char *const name[N_ENTITY_KINDS] = {
		[ENTITY_CURVE] = "curve",
		[ENTITY_SURFACE] = "surface",
		[ENTITY_CURVE_ON_SURFACE] = "curve_on_surface",
		[ENTITY_POINTS] = "points",
	};
	return name[kind];
}

/* Largest extent of n homogeneous points. */
static double points_extent(const double *p, size_t n)
{
	struct box b = box_empty();
	for (size_t i = 0; i < n; i++)
		box_add_point(&b, vec3_scale(vec3(p[4 * i], p[4 * i + 1], p[4 * i + 2]),
		                             1 / p[4 * i + 3]));
	return box_is_empty(&b) ? 0 : box_diagonal(&b);
}

static enum status curve_tight_box(const struct curve *c, struct box *out)
{
	return curve_box(c, 1e-9 * points_extent(c->points, (size_t)c->n), out);
}

enum status entity_box(const struct entity *e, struct box *out)
{
	const struct surface *s = &e->geometry;
	const struct point_list *l = &e->points;
	*out = box_empty();
	switch (e->kind) {
	case ENTITY_CURVE:
		return curve_tight_box(&e->curve, out);
	case ENTITY_CURVE_ON_SURFACE:
		return curve_tight_box(e->space.order ? &e->space : &e->curve, out);
	case ENTITY_SURFACE:
		return surface_box(s, 1e-9 * points_extent(s->points, (size_t)s->n[0] * s->n[1]),
		                   out);
	case ENTITY_POINTS:
		for (int i = 0; i < l->n; i++) {
			const double *p = l->values + (size_t)i * l->dimension;
			box_add_point(out, vec3(p[0], p[1], l->dimension > 2 ? p[2] : 0));
		}
		return ST_OK;
	case N_ENTITY_KINDS:
		break;
	}
	return ST_INTERNAL;
}

void model_init(struct model *m)
{
	*m = (struct model){ .scale = 1 };
}

void model_finish(struct model *m)
{
	if (!m)
		return;
	free(m->file);
	free(m->unit);
	for (int i = 0; i < m->n; i++)
		entity_finish(&m->entities[i]);
	free(m->entities);
	for (int i = 0; i < m->n_skipped; i++)
		free(m->skipped[i].reason);
	free(m->skipped);
	for (int i = 0; i < m->n_warnings; i++)
		free(m->warnings[i]);
	free(m->warnings);
	attributes_finish(m->attributes, m->n_attributes);
	model_init(m);
}

enum status model_add(struct model *m, struct entity *e)
{
	enum status st = array_grow((void **)&m->entities, m->n, sizeof *m->entities);
	if (st != ST_OK) {
		entity_finish(e);
		return st;
	}
	m->entities[m->n++] = *e;
	entity_init(e, e->kind);
	return ST_OK;
}

/* A file full of faults, each told with its own numbers, gets this many rows and no more. */
enum { SKIPPED_ROWS_MAX = 256 };

enum status model_skip(struct model *m, int type, int de, const char *reason)
{
	if (m->n_skipped >= SKIPPED_ROWS_MAX)
		reason = "one of too many faults to list";
	for (int i = m->n_skipped - 1; i >= 0; i--)
		if (m->skipped[i].type == type && strcmp(m->skipped[i].reason, reason) == 0) {
			m->skipped[i].count++;
			return ST_OK;
		}
	enum status st = array_grow((void **)&m->skipped, m->n_skipped, sizeof *m->skipped);
	if (st != ST_OK)
		return st;
	struct skipped row = { type, 1, de, strdup(reason) };
	if (!row.reason)
		return ST_RESOURCE;
	m->skipped[m->n_skipped++] = row;
	return ST_OK;
}

enum status model_warn(struct model *m, const char *format, ...)
{
	enum status st = array_grow((void **)&m->warnings, m->n_warnings, sizeof *m->warnings);
	if (st != ST_OK)
		return st;
	char *text = NULL;
	va_list args;
	va_start(args, format);
	int n = vasprintf(&text, format, args);
	va_end(args);
	if (n < 0)
		return ST_RESOURCE;
	m->warnings[m->n_warnings++] = text;
	return ST_OK;
}

enum status model_set_attribute(struct model *m, const char *name, const char *value)
{
	bool added;
	enum status st = attributes_set(&m->attributes, m->n_attributes, name, value, &added);
	m->n_attributes += added;
	return st;
}

const char *model_get_attribute(const struct model *m, const char *name)
{
	return attributes_get(m->attributes, m->n_attributes, name);
}

void model_number(struct model *m)
{
	int number = 0;
	for (int i = 0; i < m->n; i++)
		m->entities[i].number = m->entities[i].used ? 0 : ++number;
}
