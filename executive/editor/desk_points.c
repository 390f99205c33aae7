/* desk_points.c - control points dragged in the view. While the button is down the world shows the
 * moved point in a step that is taken back; letting go calls the routine, one step of undo. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "desk_inside.h"

static struct vec3 point_at(const struct Ful *f, int index)
{
	if (f->entity.kind == ENTITY_SURFACE) {
		int n = f->entity.geometry.n[1];
		return surface_get_point(&f->entity.geometry, index / n, index % n, NULL);
	}
	return curve_get_point(&f->entity.curve, index, NULL);
}

static int point_count(const struct Ful *f)
{
	if (f->entity.kind == ENTITY_POINTS)
		return 0;
	return f->entity.kind == ENTITY_SURFACE ? f->entity.geometry.n[0] * f->entity.geometry.n[1]
	                                        : f->entity.curve.n;
}

/* The form names the point that is held and where it is. */
static void show_in_form(struct desk *d, const struct Ful *f, struct vec3 p)
{
	int n = f->entity.kind == ENTITY_SURFACE ? f->entity.geometry.n[1] : 0;

	if (n)
		desk_ask_set(d, "index", "%d,%d", d->pick.index / n, d->pick.index % n);
	else
		desk_ask_set(d, "index", "%d", d->pick.index);
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

bool desk_point_press(struct desk *d)
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
	if (world_current(d->world, ful_is_curve(f)) != f)
		world_select(d->world, f->id, &report_none); /* the routine moves what is current */
	d->point_moved = false;
	d->point_to = point_at(f, d->pick.index);
	show_in_form(d, f, d->point_to);
	return true;
}

/* In the plane through the point that the eye looks at squarely. */
static bool under_mouse(const struct desk *d, struct vec3 from, struct vec3 *to)
{
	const struct desk_tile *t = &d->tiles[d->tile];
	struct vec3 origin, direction, ahead = t->view.camera.ahead;

	camera_ray(&t->view.camera, d->x - t->box.x, d->y - t->box.y, &origin, &direction);
	double down = vec3_dot(direction, ahead);
	if (fabs(down) < 1e-9)
		return false;
	double along = vec3_dot(vec3_sub(from, origin), ahead) / down;
	*to = vec3_add(origin, vec3_scale(direction, along));
	return true;
}

static void set_point(struct entity *e, int index, struct vec3 p)
{
	double w;

	if (e->kind == ENTITY_SURFACE) {
		int n = e->geometry.n[1];
		surface_get_point(&e->geometry, index / n, index % n, &w);
		surface_set_point(&e->geometry, index / n, index % n, p, w);
	} else {
		curve_get_point(&e->curve, index, &w);
		curve_set_point(&e->curve, index, p, w);
	}
}

void desk_point_move(struct desk *d)
{
	const struct Ful *f = world_by_id(d->world, d->pick.thing);
	struct entity e;

	if (!f || f->entity.kind == ENTITY_CURVE_ON_SURFACE ||
	    !under_mouse(d, point_at(f, d->pick.index), &d->point_to))
		return;
	if (d->point_moved) /* from where it was, and no heap of steps */
		world_step_end(d->world, false);
	d->point_moved = false;
	f = world_by_id(d->world, d->pick.thing);
	if (!f || entity_copy(&e, &f->entity) != ST_OK)
		return;
	set_point(&e, d->pick.index, d->point_to);
	world_step_begin(d->world, "move point");
	d->point_moved = true;
	if (world_replace(d->world, "move point", f->id, &e, &report_none) == ST_OK)
		show_in_form(d, world_by_id(d->world, d->pick.thing), d->point_to);
	desk_dirty(d, DESK_VIEW);
}

void desk_point_release(struct desk *d, bool keep)
{
	const struct Ful *f = world_by_id(d->world, d->pick.thing);

	if (!d->point_moved)
		return;
	d->point_moved = false;
	world_step_end(d->world, false);
	if (!f)
		return;
	if (!keep) {
		show_in_form(d, f, point_at(f, d->pick.index));
		return;
	}
	desk_ask_run(d); /* the form stays, for the next point */
}
