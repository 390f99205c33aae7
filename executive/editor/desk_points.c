/* desk_points.c - control points and their weights dragged in the view. While the button is down the world
 * shows the changed point in a step that is taken back; letting go calls the routine, one step of undo. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "desk_inside.h"

enum { WEIGHT_PX = 80, LAYERS = 16 }; /* px up that double a weight; surfaces behind each other */

static const double WEIGHT_LEAST = 1e-9, WEIGHT_MOST = 1e9; /* as the routine has it */

static int point_count(const struct Ful *f)
{
	if (f->entity.kind == ENTITY_POINTS)
		return 0;
	return f->entity.kind == ENTITY_SURFACE ? f->entity.geometry.n[0] * f->entity.geometry.n[1]
	                                        : f->entity.curve.n;
}

static struct vec3 get_point(const struct entity *e, int index, double *weight)
{
	const int n = e->kind == ENTITY_SURFACE ? e->geometry.n[1] : 1;

	return e->kind == ENTITY_SURFACE
	               ? surface_get_point(&e->geometry, index / n, index % n, weight)
	               : curve_get_point(&e->curve, index, weight);
}

static void set_point(struct entity *e, int index, struct vec3 p, double weight)
{
	const int n = e->kind == ENTITY_SURFACE ? e->geometry.n[1] : 1;

	if (e->kind == ENTITY_SURFACE)
		surface_set_point(&e->geometry, index / n, index % n, p, weight);
	else
		curve_set_point(&e->curve, index, p, weight);
}

/* The form names the point that is held, and where it is or what it weighs: not both, since what is in
 * the form is done. */
static void show_in_form(struct desk *d, const struct Ful *f, struct vec3 p, double weight)
{
	const int n = f->entity.kind == ENTITY_SURFACE ? f->entity.geometry.n[1] : 0;

	if (n)
		desk_ask_set(d, "index", "%d,%d", d->pick.index / n, d->pick.index % n);
	else
		desk_ask_set(d, "index", "%d", d->pick.index);
	desk_ask_set(d, "to", "%s", "");
	desk_ask_set(d, "weight", "%s", "");
	if (d->weighing)
		desk_ask_set(d, "weight", "%.6g", weight);
	else if (f->entity.kind == ENTITY_CURVE_ON_SURFACE)
		desk_ask_set(d, "to", "%.9g,%.9g", p.x, p.y);
	else
		desk_ask_set(d, "to", "%.9g,%.9g,%.9g", p.x, p.y, p.z);
}

static const char *const kind_words[N_ENTITY_KINDS] = {
	[ENTITY_CURVE] = "curves in space",
	[ENTITY_SURFACE] = "surfaces",
	[ENTITY_CURVE_ON_SURFACE] = "curves on surfaces",
	[ENTITY_POINTS] = "point lists",
};

static bool of_kind(const struct desk *d, const struct Ful *f)
{
	return d->ask.routine && d->ask.routine->detail == (int)f->entity.kind;
}

/* The routine moves what is current. */
static void make_current(struct desk *d, const struct Ful *f)
{
	const bool curve = ful_is_curve(f);

	if (world_current(d->world, curve) != f)
		desk_run_code(d, curve ? "V160" : "V159", curve ? "curve" : "surface", f->name);
}

bool desk_point_press(struct desk *d, bool weighing)
{
	const struct Ful *f;

	desk_hover(d);
	f = d->pick.thing && d->pick.is_point ? world_by_id(d->world, d->pick.thing) : NULL;
	if (!f || d->pick.index < 0 || d->pick.index >= point_count(f)) {
		desk_say(d, REPORT_INFO, "No control point lies there.");
		return false;
	}
	if (!of_kind(d, f)) {
		desk_say(d, REPORT_INFO, "%s moves points of %s.", d->ask.routine->code,
		         kind_words[d->ask.routine->detail]);
		return false;
	}
	make_current(d, f);
	d->point_moved = false;
	d->weighing = weighing;
	d->point_from = d->point_to = get_point(&f->entity, d->pick.index, &d->weight_from);
	d->weight_to = d->weight_from;
	show_in_form(d, f, d->point_to, d->weight_to);
	return true;
}

/* In the plane through the point that the eye looks at squarely. */
static bool on_plane(const struct desk *d, struct vec3 *to)
{
	const struct desk_tile *t = &d->tiles[d->tile];
	struct vec3 origin, direction, ahead = t->view.camera.ahead;

	camera_ray(&t->view.camera, d->x - t->box.x, d->y - t->box.y, &origin, &direction);
	double down = vec3_dot(direction, ahead);
	if (fabs(down) < 1e-9)
		return false;
	double along = vec3_dot(vec3_sub(d->point_from, origin), ahead) / down;
	*to = vec3_add(origin, vec3_scale(direction, along));
	return true;
}

/* u and v where the eye sees that surface under the mouse. */
static bool on_surface(struct desk *d, int surface, struct vec3 *to)
{
	const int skip = d->skip;
	struct pick p;
	double uv[2];
	bool found = false;

	if (d->tiles[d->tile].is_uv) {
		found = desk_uv_at(d, d->x, d->y, uv);
		*to = found ? vec3(uv[0], uv[1], 0) : *to;
		return found;
	}
	for (d->skip = 0; d->skip < LAYERS && !found; d->skip++) {
		if (!desk_pick_at(d, false, &p))
			break;
		found = p.thing == surface;
		if (found)
			*to = vec3(p.u, p.v, 0);
	}
	d->skip = skip;
	return found;
}

static bool follow_mouse(struct desk *d, const struct Ful *f)
{
	if (d->weighing) {
		d->weight_to = d->weight_from * exp2((d->down_y - d->y) / WEIGHT_PX);
		d->weight_to = fmin(fmax(d->weight_to, WEIGHT_LEAST), WEIGHT_MOST);
		return true;
	}
	if (f->entity.kind == ENTITY_CURVE_ON_SURFACE)
		return on_surface(d, f->on, &d->point_to);
	return on_plane(d, &d->point_to);
}

/* What follows from its points: whether its weights differ. */
static enum status mend(struct entity *e)
{
	return e->kind == ENTITY_SURFACE ? surface_check(&e->geometry, "", &report_none)
	                                 : curve_check(&e->curve, "", &report_none);
}

void desk_point_move(struct desk *d)
{
	const struct Ful *f = world_by_id(d->world, d->pick.thing);
	struct entity e;

	if (!f || !follow_mouse(d, f))
		return;
	if (d->point_moved) /* from what it was, and no heap of steps */
		world_step_end(d->world, false);
	d->point_moved = false;
	f = world_by_id(d->world, d->pick.thing);
	if (!f || entity_copy(&e, &f->entity) != ST_OK)
		return;
	set_point(&e, d->pick.index, d->point_to, d->weight_to);
	if (e.kind == ENTITY_CURVE_ON_SURFACE) { /* in space it is elsewhere now */
		curve_finish(&e.space);
		e.space = (struct curve){ 0 };
	}
	if (mend(&e) != ST_OK) {
		entity_finish(&e);
		return;
	}
	world_step_begin(d->world, "move point");
	d->point_moved = true;
	if (world_replace(d->world, "move point", f->id, &e, &report_none) == ST_OK)
		show_in_form(d, world_by_id(d->world, d->pick.thing), d->point_to, d->weight_to);
	desk_dirty(d, DESK_VIEW | desk_bit(PART_OVER));
}

void desk_point_release(struct desk *d, bool keep)
{
	if (!d->point_moved)
		return;
	d->point_moved = false;
	world_step_end(d->world, false); /* what was shown meanwhile goes */
	const struct Ful *f = world_by_id(d->world, d->pick.thing);
	if (!f)
		return;
	if (!keep) {
		show_in_form(d, f, d->point_from, d->weight_from);
		return;
	}
	desk_ask_run(d); /* the form stays, for the next point */
}
