/* things.c - the things that are open, which are current, how each is drawn. */
#include <stdlib.h>
#include <string.h>

#include "path.h"
#include "world_private.h"

enum { SEGMENTS = 0, LINES = 7, QUILLS = 100 };

enum status grow(void **array, int n, size_t size)
{
	if (n && (n & (n - 1)))
		return ST_OK;
	void *more = reallocarray(*array, n ? (size_t)n * 2 : 1, size);
	if (!more)
		return ST_RESOURCE;
	*array = more;
	return ST_OK;
}

enum status out_of_memory(const struct report *r)
{
	return report_error(r, ST_RESOURCE, "memory ran out");
}

enum status thing_missing(int id, const struct report *r)
{
	return report_error(r, ST_PARAMETER, "thing %d is not open", id);
}

bool ful_is_curve(const struct Ful *f)
{
	return f && (f->entity.kind == ENTITY_CURVE || f->entity.kind == ENTITY_CURVE_ON_SURFACE);
}

bool ful_is_surface(const struct Ful *f)
{
	return f && f->entity.kind == ENTITY_SURFACE;
}

enum status world_create(struct world **out, const char *folder)
{
	struct world *w = calloc(1, sizeof *w);

	if (!w)
		return ST_RESOURCE;
	w->folder = path_absolute(folder, NULL);
	if (!w->folder) {
		free(w);
		return ST_RESOURCE;
	}
	w->sight = (struct sight){ .light_azimuth = -60,
		                   .light_incidence = 45,
		                   .light_intensity = 1,
		                   .specular = { 1, 1, 1 },
		                   .bell = true };
	*out = w;
	return ST_OK;
}

void world_destroy(struct world *w)
{
	if (!w)
		return;
	for (int k = 0; k < w->n; k++)
		ful_destroy(w->things[k]);
	free(w->things);
	history_finish(&w->undo);
	history_finish(&w->redo);
	overlays_finish(w);
	presets_finish(w);
	free(w->folder);
	free(w);
}

const char *world_folder(const struct world *w)
{
	return w->folder;
}

void ful_destroy(struct Ful *f)
{
	if (!f)
		return;
	free(f->name);
	free(f->file);
	free(f->unit);
	entity_finish(&f->entity);
	free(f);
}

static size_t surface_numbers(const struct entity *e)
{
	size_t n = 4 * (size_t)e->geometry.n[0] * (size_t)e->geometry.n[1];

	for (int i = 0; i < e->trim.n; i++)
		for (int k = 0; k < e->trim.loops[i].n; k++)
			n += 5 * (size_t)e->trim.loops[i].curves[k].n;
	return n;
}

size_t ful_bytes(const struct Ful *f)
{
	const struct entity *e = &f->entity;
	size_t numbers;

	if (e->kind == ENTITY_SURFACE)
		numbers = surface_numbers(e);
	else if (e->kind == ENTITY_POINTS)
		numbers = (size_t)e->points.n * (size_t)e->points.dimension;
	else
		numbers = 5 * ((size_t)e->curve.n + (size_t)e->space.n);
	return sizeof *f + numbers * sizeof(double);
}

enum status ful_copy(struct Ful **out, const struct Ful *f)
{
	struct Ful *x = malloc(sizeof *x);

	if (!x)
		return ST_RESOURCE;
	*x = *f;
	x->name = x->file = x->unit = NULL;
	enum status st = entity_copy(&x->entity, &f->entity);
	if (st == ST_OK)
		st = model_set_text(&x->name, f->name);
	if (st == ST_OK)
		st = model_set_text(&x->file, f->file);
	if (st == ST_OK)
		st = model_set_text(&x->unit, f->unit);
	if (st == ST_OK)
		*out = x;
	else
		ful_destroy(x);
	return st;
}

enum status ful_create(struct world *w, struct Ful **out, struct entity *e)
{
	struct Ful *f = calloc(1, sizeof *f);

	if (!f) {
		entity_finish(e);
		return ST_RESOURCE;
	}
	f->id = ++w->last_id;
	f->revision = ++w->revision;
	f->scale = 1;
	f->entity = *e;
	f->entity.surface = -1;
	entity_init(e, e->kind);
	f->display = (struct display){ .on = true,
		                       .segments = SEGMENTS,
		                       .lines_u = LINES,
		                       .lines_v = LINES,
		                       .quill = 0.2,
		                       .quills = QUILLS };
	if (f->entity.has_color) {
		f->display.has_color = true;
		f->display.color =
		        (struct rgb){ f->entity.color[0], f->entity.color[1], f->entity.color[2] };
	}
	*out = f;
	return ST_OK;
}

enum status thing_append(struct world *w, struct Ful *f)
{
	enum status st = grow((void **)&w->things, w->n, sizeof *w->things);

	if (st == ST_OK)
		w->things[w->n++] = f;
	else
		ful_destroy(f);
	return st;
}

void thing_take_out(struct world *w, int index)
{
	w->n--;
	memmove(w->things + index, w->things + index + 1,
	        (size_t)(w->n - index) * sizeof *w->things);
}

int world_count(const struct world *w)
{
	return w->n;
}

const struct Ful *world_at(const struct world *w, int k)
{
	return k >= 0 && k < w->n ? w->things[k] : NULL;
}

int thing_index(const struct world *w, int id)
{
	for (int k = 0; k < w->n; k++)
		if (w->things[k]->id == id)
			return k;
	return -1;
}

struct Ful *thing_get(const struct world *w, int id)
{
	const int k = thing_index(w, id);

	return k < 0 ? NULL : w->things[k];
}

const struct Ful *world_by_id(const struct world *w, int id)
{
	return thing_get(w, id);
}

const struct Ful *world_current(const struct world *w, bool curve)
{
	return thing_get(w, w->current[curve]);
}

void thing_make_current(struct world *w, const struct Ful *f)
{
	w->selected = f->id;
	if (ful_is_curve(f) || ful_is_surface(f))
		w->current[ful_is_curve(f)] = f->id;
}

const struct Ful *world_selected(const struct world *w)
{
	const struct Ful *f = thing_get(w, w->selected);

	f = f ? f : world_current(w, false);
	return f ? f : world_current(w, true);
}

static bool made_from(const struct Ful *f, int id)
{
	return id && (f->copy_of == id || f->offset_of == id);
}

bool world_family(const struct world *w, const struct Ful **parent, const struct Ful **child)
{
	const struct Ful *f = world_selected(w);

	*parent = f;
	*child = NULL;
	for (int k = w->n - 1; f && k >= 0 && !*child; k--)
		if (made_from(w->things[k], f->id))
			*child = w->things[k];
	const struct Ful *origin =
	        f && !*child ? thing_get(w, f->offset_of ? f->offset_of : f->copy_of) : NULL;
	if (origin) {
		*parent = origin;
		*child = f;
	}
	return *child;
}

/* A current thing that is no longer open gives way to the last of its kind. */
void thing_mend_current(struct world *w)
{
	for (int curve = 0; curve < 2; curve++) {
		if (thing_get(w, w->current[curve]))
			continue;
		w->current[curve] = 0;
		for (int k = 0; k < w->n; k++)
			if (curve ? ful_is_curve(w->things[k]) : ful_is_surface(w->things[k]))
				w->current[curve] = w->things[k]->id;
	}
}

enum status world_select(struct world *w, int id, const struct report *r)
{
	const struct Ful *f = thing_get(w, id);

	if (!f)
		return thing_missing(id, r);
	thing_make_current(w, f);
	w->revision++;
	return ST_OK;
}

enum status world_set_display(struct world *w, int id, const struct display *d)
{
	struct Ful *f = thing_get(w, id);

	if (!f)
		return ST_PARAMETER;
	f->display = *d;
	w->revision++;
	return ST_OK;
}

unsigned world_revision(const struct world *w)
{
	return w->revision;
}

void world_touch(struct world *w)
{
	w->revision++;
}

bool world_unsaved(const struct world *w)
{
	for (int k = 0; k < w->n; k++)
		if (!w->things[k]->saved)
			return true;
	return false;
}

struct sight *world_sight(struct world *w)
{
	return &w->sight;
}
