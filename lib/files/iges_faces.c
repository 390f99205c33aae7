/* iges_faces.c - what shows an entity: the faces on a surface with their trims, instances. */
#include "iges_reader.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "construct.h"
#include "project_curve.h"
#include "refine.h"

/* Loops that do not close within the file's tolerance are closed within this part of the size. */
static const double mend_within = 1e-3;

static void keep_note(void *data, enum report_level level, enum status st, const char *text)
{
	struct iges *g = data;
	(void)st;
	if (level == REPORT_ERROR)
		snprintf(g->store.error, sizeof g->store.error, "%s", text);
	else if (g->mended.count++ == 0)
		snprintf(g->mended.first, sizeof g->mended.first, "%s", text);
}

/* Mended within the file's tolerance, or within a larger one. */
static enum status mend(struct iges *g, int face, const struct surface *s, struct trim *t)
{
	const struct report notes = { keep_note, g };
	char what[32];
	double size = surface_size(s);
	snprintf(what, sizeof what, "D%d", face);
	enum status st = trim_mend(t, s, iges_tolerance(g, size), what, &notes);
	if (st == ST_INPUT)
		st = trim_mend(t, s, mend_within * size, what, &notes);
	return iges_pass(g, st);
}

/* The trim of a face; where it is lost that is counted and the whole surface is left. */
static enum status take_trim(struct iges *g, int face, int base, const struct surface *s,
                             struct trim *out)
{
	enum status st = iges_trim(g, face, base, s, out);
	if (st == ST_OK && out->n)
		st = mend(g, face, s, out);
	if (st != ST_INPUT)
		return st;
	trim_finish(out);
	char *reason = text_print("%s; the surface under it is read without its trims", g->reason);
	if (!reason)
		return ST_RESOURCE;
	st = model_skip(g->m, iges_entry(g, face)->type, face, reason);
	free(reason);
	return st;
}

static void move(const struct iges *g, const struct iges_use *u, struct entity *e)
{
	if (u->matrix < 0)
		return;
	const double(*m)[4] = (const double(*)[4])g->matrices[u->matrix];
	if (e->kind == ENTITY_SURFACE)
		surface_transform(&e->geometry, m);
	else if (e->kind == ENTITY_CURVE)
		curve_transform(&e->curve, m);
	else
		for (int i = 0; i < e->points.n; i++) {
			double *p = e->points.values + 3 * (size_t)i;
			const double q[3] = { p[0], p[1], p[2] };
			for (int k = 0; k < 3; k++)
				p[k] = m[k][0] * q[0] + m[k][1] * q[1] + m[k][2] * q[2] + m[k][3];
		}
}

/* The shape again, with what belongs to all its uses. */
static enum status copy_shape(struct entity *out, const struct entity *e)
{
	enum status st = ST_OK;
	entity_init(out, e->kind);
	out->source_type = e->source_type;
	out->has_color = e->has_color;
	memcpy(out->color, e->color, sizeof out->color);
	if (e->kind == ENTITY_SURFACE)
		st = surface_copy(&out->geometry, &e->geometry);
	else if (e->kind == ENTITY_CURVE)
		st = curve_copy(&out->curve, &e->curve);
	else {
		size_t n = (size_t)e->points.n * e->points.dimension;
		out->points = e->points;
		out->points.values = malloc(n ? n * sizeof(double) : 1);
		if (!out->points.values)
			return ST_RESOURCE;
		memcpy(out->points.values, e->points.values, n * sizeof(double));
	}
	if (st == ST_OK && e->name)
		st = model_set_text(&out->name, e->name);
	return st;
}

/* Names, colors and groups stand with the face as often as with the surface under it. */
static enum status name_face(struct iges *g, const struct iges_use *u, struct entity *e)
{
	enum status st = ST_OK;
	if (u->face && !e->name)
		st = iges_name(g, u->face, e);
	if (st == ST_OK && u->face && !e->has_color)
		st = iges_color(g, u->face, e);
	if (st == ST_OK && u->face)
		st = iges_group(g, u->face, e);
	return st;
}

/* The uses of an entry in the order they were found. Fresh. */
static enum status list_uses(const struct iges *g, const struct iges_entry *e,
                             struct iges_use **out, int *n)
{
	*n = 0;
	for (int i = e->uses; i >= 0; i = g->uses[i].next)
		++*n;
	*out = calloc((size_t)*n, sizeof **out);
	int k = *n;
	for (int i = e->uses; *out && i >= 0; i = g->uses[i].next)
		(*out)[--k] = g->uses[i];
	return *out ? ST_OK : ST_RESOURCE;
}

static int by_number(const void *a, const void *b)
{
	int x = *(const int *)a, y = *(const int *)b;
	return (x > y) - (x < y);
}

/* All faces that lie on it, each once. */
static enum status set_faces(const struct iges_use *u, int n, struct entity *out)
{
	enum status st = ST_OK;
	int *faces = calloc((size_t)n, sizeof *faces);
	if (!faces)
		return ST_RESOURCE;
	for (int i = 0; i < n; i++)
		faces[i] = u[i].face;
	qsort(faces, (size_t)n, sizeof *faces, by_number);
	for (int i = 0; i < n && st == ST_OK; i++)
		if (faces[i] && (i == 0 || faces[i] != faces[i - 1]))
			st = entity_add_face(out, faces[i]);
	free(faces);
	return st;
}

/* One more entity for a use: the shape, under the face's number or the instance's. */
static enum status add_copy(struct iges *g, const struct iges_use *u, const struct entity *shape,
                            const struct trim *t)
{
	struct entity e;
	enum status st = copy_shape(&e, shape);
	e.de = u->face && !u->via ? u->face : u->via;
	e.trims = u->loops;
	if (st == ST_OK && t)
		st = trim_copy(&e.trim, t);
	if (st == ST_OK)
		st = name_face(g, u, &e);
	if (st != ST_OK) {
		entity_finish(&e);
		return st;
	}
	move(g, u, &e);
	return model_add(&g->more, &e);
}

/*
 * A surface is shown by its first use under its own number, by others under theirs; so is it where
 * nothing but itself shows it. A curve or point of a subfigure stays as defined, used by that.
 */
enum status iges_show(struct iges *g, int de, struct entity *out)
{
	const struct iges_entry *e = iges_entry(g, de);
	struct iges_use *u = NULL;
	struct trim t = { 0 }, first = { 0 };
	int n;
	if (e->uses < 0)
		return ST_OK;
	out->source_type = e->type;
	enum status st = list_uses(g, e, &u, &n);
	bool surface = out->kind == ENTITY_SURFACE;
	for (int i = 0; i < n && st == ST_OK; i++) {
		if (u[i].face && (i == 0 || u[i].face != u[i - 1].face)) {
			trim_finish(&t);
			st = take_trim(g, u[i].face, de, &out->geometry, &t);
		} else if (!u[i].face) {
			trim_finish(&t);
		}
		if (st == ST_OK && surface && i == 0)
			st = trim_copy(&first, &t);
		else if (st == ST_OK)
			st = add_copy(g, &u[i], out, surface ? &t : NULL);
	}
	if (st == ST_OK && surface) {
		out->trim = first;
		first = (struct trim){ 0 };
		out->trims = u[0].loops;
		st = name_face(g, &u[0], out);
	}
	if (st == ST_OK)
		st = set_faces(u, n, out);
	if (st == ST_OK && surface)
		move(g, &u[0], out);
	trim_finish(&first);
	trim_finish(&t);
	free(u);
	return st;
}

/* Gaps in u,v up to this are closed. */
static double uv_gap(const struct surface *s)
{
	return mend_within *
	       hypot(s->domain[0][1] - s->domain[0][0], s->domain[1][1] - s->domain[1][0]);
}

/* Place in the model of the surface at `de` if that is where the file has it; -1: it is not. */
static int surface_place(struct iges *g, int de)
{
	const struct iges_entry *e = iges_entry(g, de);
	for (int i = e->uses; i >= 0; i = g->uses[i].next)
		if (g->uses[i].matrix >= 0)
			return -1;
	return e->place - 1;
}

enum status iges_curve_on_surface(struct iges *g, int de, struct entity *out)
{
	struct iges_cursor c;
	struct surface s = { 0 };
	struct trim_loop uv = { 0 };
	double m[3][4];
	bool any;
	entity_init(out, ENTITY_CURVE_ON_SURFACE);
	enum status st = iges_open(g, de, 142, &c);
	if (st != ST_OK)
		return st;
	iges_int(&c);
	int base = iges_int(&c);
	st = c.st == ST_OK ? iges_surface(g, base, 1, &s, NULL) : c.st;
	if (st != ST_OK)
		return st;
	double size = surface_size(&s);
	st = iges_trim_curves(g, de, &s, &uv);
	if (st == ST_OK)
		st = iges_pass(g, make_composite(&out->curve, uv.curves, uv.n, uv_gap(&s),
		                                 &g->store.report));
	if (st == ST_OK)
		st = project_lift(&s, &out->curve, iges_tolerance(g, size), &out->space);
	if (st == ST_OK)
		st = iges_matrix(g, iges_entry(g, de)->transform, m, &any);
	if (st == ST_OK && any)
		curve_transform(&out->space, (const double(*)[4])m);
	else if (st == ST_OK)
		out->surface = surface_place(g, base);
	trim_loop_finish(&uv);
	surface_finish(&s);
	return st;
}
