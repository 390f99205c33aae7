/* desk_probe.c - what lies under the mouse: hovered, probed, picked. */
#include "desk_inside.h"

bool desk_pick_at(struct desk *d, bool points, struct pick *out)
{
	int i = desk_tile_at(d, d->x, d->y);

	*out = (struct pick){ 0 };
	if (i < 0 || !d->ports.pick || d->errand)
		return false;
	const struct desk_tile *t = &d->tiles[i];
	if (t->is_uv)
		return desk_uv_pick(d, points, out);
	return d->ports.pick(d->ports.data, &t->view, d->x - t->box.x, d->y - t->box.y, points,
	                     d->skip, out) &&
	       out->thing;
}

void desk_hover(struct desk *d)
{
	if (d->tool != TOOL_POINTS && d->tool != TOOL_PICK)
		return;
	struct pick was = d->pick;
	int i = desk_tile_at(d, d->x, d->y);
	desk_pick_at(d, d->tool == TOOL_POINTS, &d->pick);
	if (d->pick.thing == was.thing && d->pick.is_point == was.is_point &&
	    d->pick.index == was.index)
		return;
	for (int k = 0; k < d->n_tiles; k++) {
		struct view_state *v = &d->tiles[k].view;
		const bool here = k == i || d->split == SPLIT_UV;
		v->hover_thing = here ? d->pick.thing : 0;
		v->hover_point = here && d->pick.is_point ? d->pick.index : -1;
	}
	desk_dirty(d, DESK_VIEW | desk_bit(PART_OVER));
}

/* The circles of curvature, where the probe is. */
static void show_probe(struct desk *d)
{
	const struct Ful *f = world_by_id(d->world, d->pick.thing);
	bool on = d->probe_shown && f && f->entity.kind == ENTITY_SURFACE;

	for (int i = 0; i < d->n_tiles; i++)
		d->tiles[i].view.probe =
		        on ? (struct mark){ f->id, d->pick.u, d->pick.v } : (struct mark){ 0 };
	desk_dirty(d, desk_bit(PART_PROBE) | desk_bit(PART_OVER) | DESK_VIEW);
}

void desk_probe_hide(struct desk *d)
{
	d->probe_shown = false;
	show_probe(d);
}

void desk_probe(struct desk *d)
{
	struct pick p;
	bool found = desk_pick_at(d, false, &p);

	d->pick = p;
	d->probe_shown = found;
	d->probe_kept = false;
	d->probe_x = d->x;
	d->probe_y = d->y;
	show_probe(d);
}

void desk_probe_keep(struct desk *d)
{
	const struct Ful *f = world_by_id(d->world, d->pick.thing);
	struct mark m = { d->pick.thing, d->pick.u, d->pick.v };

	if (!d->probe_shown || !f)
		return;
	d->probe_kept = f->entity.kind == ENTITY_SURFACE && world_keep_mark(d->world, &m) == ST_OK;
	desk_dirty(d, desk_bit(PART_PROBE) | DESK_VIEW);
}

/* A picked thing goes into the field that asks for one. */
void desk_pick_give(struct desk *d)
{
	struct pick p;
	const struct Ful *f = desk_pick_at(d, false, &p) ? world_by_id(d->world, p.thing) : NULL;

	if (!f) {
		desk_say(d, REPORT_INFO, "Nothing lies there.");
		return;
	}
	if (d->ask.routine)
		desk_ask_set(d, d->ask.rows[d->ask.focus].name, "%s", f->name);
}

/* Does the field in focus want something that can be picked? */
bool desk_pick_wanted(const struct desk *d)
{
	if (!d->ask.routine || d->ask.focus >= d->ask.n)
		return false;
	enum argument_type type = d->ask.rows[d->ask.focus].type;
	return type == ARGUMENT_SURFACE || type == ARGUMENT_CURVE || type == ARGUMENT_THING;
}
