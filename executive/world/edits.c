/* edits.c - what changes things: each edit can be taken back. */
#include <stdlib.h>
#include <string.h>

#include "text.h"
#include "world_private.h"

static const char *default_name(const struct entity *e)
{
	static const char *const names[N_ENTITY_KINDS] = { "curve", "surface", "curve", "points" };

	return names[e->kind];
}

/* Whose unit and color a new thing has. */
static const struct Ful *parent_of(const struct world *w, const struct origin *from)
{
	const int ids[] = { from->copy_of, from->offset_of, from->on };

	for (size_t k = 0; k < sizeof ids / sizeof *ids; k++)
		if (ids[k])
			return thing_get(w, ids[k]);
	return w->n ? w->things[0] : NULL;
}

static enum status set_origin(struct world *w, struct Ful *f, const struct origin *from)
{
	const struct Ful *parent = parent_of(w, from);

	f->copy_of = from->copy_of;
	f->offset_of = from->offset_of;
	f->on = from->on;
	f->offset = from->offset;
	if (!parent)
		return ST_OK;
	f->unit_in_mm = parent->unit_in_mm;
	f->scale = parent->scale;
	return model_set_text(&f->unit, parent->unit);
}

static enum status origin_check(const struct world *w, const struct entity *e,
                                const struct origin *from, const struct report *r)
{
	const int ids[] = { from->copy_of, from->offset_of, from->on };

	for (size_t k = 0; k < sizeof ids / sizeof *ids; k++)
		if (ids[k] && !thing_get(w, ids[k]))
			return thing_missing(ids[k], r);
	if (e->kind == ENTITY_CURVE_ON_SURFACE && !ful_is_surface(thing_get(w, from->on)))
		return report_error(r, ST_PARAMETER,
		                    "a curve on a surface needs that surface to be open");
	return ST_OK;
}

/* A name for a new thing: the one given, or that of its origin. */
static char *new_name(const struct world *w, const char *name, const struct entity *e,
                      const struct origin *from)
{
	const struct Ful *parent = from->copy_of || from->offset_of ? parent_of(w, from) : NULL;

	return name_unique(w, name ? name : parent ? parent->name : default_name(e));
}

enum status world_add_from(struct world *w, const char *what, const char *name, struct entity *e,
                           const struct origin *from, int *id, const struct report *r)
{
	static const struct origin none = { 0 };
	struct Ful *f = NULL;

	from = from ? from : &none;
	world_step_begin(w, what);
	enum status st = origin_check(w, e, from, r);
	bool said = st != ST_OK;
	if (st == ST_OK && name)
		said = (st = name_check(w, 0, name, r)) != ST_OK;
	if (st == ST_OK)
		st = history_room(w);
	if (st == ST_OK)
		st = ful_create(w, &f, e);
	else
		entity_finish(e);
	if (st == ST_OK) {
		f->name = new_name(w, name, &f->entity, from);
		st = f->name ? set_origin(w, f, from) : ST_RESOURCE;
	}
	if (st == ST_OK) {
		const int place = w->n;
		const int fresh = f->id;
		f->entity.number = 0;
		f->entity.de = 0;
		st = thing_append(w, f);
		f = NULL;
		if (st == ST_OK) {
			history_record(w, fresh, place, NULL);
			world_select(w, fresh, NULL);
			if (id)
				*id = fresh;
		}
	}
	ful_destroy(f);
	world_step_end(w, st == ST_OK);
	return st == ST_OK || said ? st : out_of_memory(r);
}

enum status world_add(struct world *w, const char *what, const char *name, struct entity *e,
                      int *id, const struct report *r)
{
	return world_add_from(w, what, name, e, NULL, id, r);
}

enum status world_replace(struct world *w, const char *what, int id, struct entity *e,
                          const struct report *r)
{
	const int at = thing_index(w, id);
	struct Ful *f = NULL;

	if (at < 0 || w->things[at]->entity.kind != e->kind) {
		entity_finish(e);
		return at < 0 ? thing_missing(id, r)
		              : report_error(r, ST_INTERNAL, "a %s cannot become a %s",
		                             entity_kind_name(w->things[at]->entity.kind),
		                             entity_kind_name(e->kind));
	}
	world_step_begin(w, what);
	enum status st = history_room(w);
	if (st == ST_OK)
		st = ful_copy(&f, w->things[at]);
	if (st == ST_OK) {
		struct Ful *before = w->things[at];
		const int number = f->entity.number,
		          de = f->entity.de; /* stay: it is still that one */
		entity_finish(&f->entity);
		f->entity = *e;
		f->entity.number = number;
		f->entity.de = de;
		f->entity.surface = -1;
		entity_init(e, e->kind);
		f->revision = ++w->revision;
		f->saved = false;
		w->things[at] = f;
		history_record(w, id, at, before);
		overlays_drop(w, id);
		thing_make_current(w, f);
	} else
		entity_finish(e);
	world_step_end(w, st == ST_OK);
	return st == ST_OK ? st : out_of_memory(r);
}

static enum status remove_one(struct world *w, int at)
{
	enum status st = history_room(w);

	if (st != ST_OK)
		return st;
	struct Ful *f = w->things[at];
	thing_take_out(w, at);
	history_record(w, f->id, at, f);
	return ST_OK;
}

enum status world_remove(struct world *w, const char *what, int id, const struct report *r)
{
	enum status st = ST_OK;

	if (!thing_get(w, id))
		return thing_missing(id, r);
	world_step_begin(w, what);
	for (int k = w->n - 1; k >= 0 && st == ST_OK; k--)
		if (w->things[k]->id == id || w->things[k]->on == id)
			st = remove_one(w, k);
	thing_mend_current(w);
	w->revision++;
	world_step_end(w, st == ST_OK);
	return st == ST_OK ? st : out_of_memory(r);
}

enum status world_rename(struct world *w, int id, const char *name, const struct report *r)
{
	const int at = thing_index(w, id);
	struct Ful *f = NULL;

	if (at < 0)
		return thing_missing(id, r);
	enum status st = name_check(w, id, name, r);
	if (st != ST_OK)
		return st;
	char *what = text_print("rename %s to %s", w->things[at]->name, name);
	world_step_begin(w, what ? what : "rename");
	free(what);
	st = history_room(w);
	if (st == ST_OK)
		st = ful_copy(&f, w->things[at]);
	if (st == ST_OK)
		st = model_set_text(&f->name, name);
	if (st == ST_OK) {
		history_record(w, id, at, w->things[at]);
		w->things[at] = f;
		w->revision++;
	} else
		ful_destroy(f);
	world_step_end(w, st == ST_OK);
	return st == ST_OK ? st : out_of_memory(r);
}

enum status world_set_unit(struct world *w, int id, const char *unit, double unit_in_mm,
                           const struct report *r)
{
	const int at = thing_index(w, id);
	struct Ful *f = NULL;

	if (at < 0)
		return thing_missing(id, r);
	world_step_begin(w, "set the unit");
	enum status st = history_room(w);
	if (st == ST_OK)
		st = ful_copy(&f, w->things[at]);
	if (st == ST_OK)
		st = model_set_text(&f->unit, unit);
	if (st == ST_OK) {
		f->unit_in_mm = unit_in_mm;
		f->saved = false;
		history_record(w, id, at, w->things[at]);
		w->things[at] = f;
		w->revision++;
	} else
		ful_destroy(f);
	world_step_end(w, st == ST_OK);
	return st == ST_OK ? st : out_of_memory(r);
}
