/* change.c - an edit of one thing, with what lies on it. */
#include <stdlib.h>

#include "change.h"

enum status change_begin(const struct act *a, const struct Ful *f, struct entity *e)
{
	return entity_copy(e, &f->entity) == ST_OK ? ST_OK : act_memory(a);
}

/* Curves on a surface that has changed are where they were in u, v; in space they are elsewhere. */
static enum status forget_space(struct act *a, const char *what, int surface)
{
	enum status st = ST_OK;

	for (int k = 0; k < world_count(a->world) && st == ST_OK; k++) {
		const struct Ful *f = world_at(a->world, k);
		struct entity e;
		if (f->on != surface || f->entity.kind != ENTITY_CURVE_ON_SURFACE ||
		    !f->entity.space.order)
			continue;
		st = change_begin(a, f, &e);
		if (st == ST_OK) {
			curve_finish(&e.space);
			e.space = (struct curve){ 0 };
			st = world_replace(a->world, what, f->id, &e, &a->report);
		}
	}
	return st;
}

enum status change_end(struct act *a, const char *what, int id, struct entity *e, bool moved)
{
	enum status st = ST_OK;

	if (moved && e->kind == ENTITY_CURVE_ON_SURFACE) {
		curve_finish(&e->space);
		e->space = (struct curve){ 0 };
	}
	const bool surface = e->kind == ENTITY_SURFACE;
	world_step_begin(a->world, what);
	if (moved && surface)
		st = forget_space(a, what, id);
	if (st == ST_OK)
		st = world_replace(a->world, what, id, e, &a->report);
	else
		entity_finish(e);
	world_step_end(a->world, st == ST_OK);
	return st;
}

enum status change_failed(const struct act *a, enum status st, const char *what)
{
	return st == ST_RESOURCE ? act_memory(a) : report_error(&a->report, st, "%s", what);
}
