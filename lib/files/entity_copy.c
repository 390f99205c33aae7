/* entity_copy.c - an entity with all that it owns, twice. */
#include "model.h"

#include <stdlib.h>
#include <string.h>

static enum status copy_points(struct point_list *out, const struct point_list *p)
{
	const size_t n = (size_t)p->n * (size_t)p->dimension;

	if (!p->values || !n)
		return ST_OK;
	out->values = malloc(n * sizeof *out->values);
	if (!out->values)
		return ST_RESOURCE;
	memcpy(out->values, p->values, n * sizeof *out->values);
	out->n = p->n;
	out->dimension = p->dimension;
	return ST_OK;
}

static enum status copy_geometry(struct entity *out, const struct entity *e)
{
	enum status st = ST_OK;

	if (e->kind == ENTITY_POINTS)
		return copy_points(&out->points, &e->points);
	if (e->kind == ENTITY_SURFACE) {
		st = surface_copy(&out->geometry, &e->geometry);
		for (int k = 0; e->faces && k < e->faces->n && st == ST_OK; k++)
			st = entity_add_face(out, e->faces->de[k]);
		return st == ST_OK ? trim_copy(&out->trim, &e->trim) : st;
	}
	if (e->curve.order)
		st = curve_copy(&out->curve, &e->curve);
	if (st == ST_OK && e->space.order)
		st = curve_copy(&out->space, &e->space);
	return st;
}

enum status entity_copy(struct entity *out, const struct entity *e)
{
	enum status st;

	entity_init(out, e->kind);
	out->number = e->number;
	out->used = e->used;
	out->de = e->de;
	out->source_type = e->source_type;
	out->trims = e->trims;
	out->has_color = e->has_color;
	memcpy(out->color, e->color, sizeof out->color);
	out->surface = e->surface;
	st = model_set_text(&out->name, e->name);
	for (int k = 0; k < e->n_attributes && st == ST_OK; k++)
		st = entity_set_attribute(out, e->attributes[k].name, e->attributes[k].value);
	if (st == ST_OK)
		st = copy_geometry(out, e);
	if (st != ST_OK)
		entity_finish(out);
	return st;
}
