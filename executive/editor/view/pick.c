/* pick.c - what lies under a place: surfaces by rays, curves and points by their distance in px. */
#include <stdlib.h>

#include "on_surface.h"
#include "view_private.h"

enum { REACH = 8, LAYERS_MAX = 16, SEARCHES = 48 };

/* What was found, and how near to the eye it counts: a curve on a surface comes before it. */
struct found {
	struct pick pick;
	double depth;
};

struct search {
	struct drawing drawing;
	double x, y;         /* device px */
	struct found *found; /* owned */
	int n, room;
	bool failed;
};

static void add(struct search *s, const struct pick *p, double depth)
{
	if (s->n == s->room) {
		int room = s->room ? 2 * s->room : 16;
		struct found *all = reallocarray(s->found, (size_t)room, sizeof *all);
		if (!all) {
			s->failed = true;
			return;
		}
		s->found = all;
		s->room = room;
	}
	s->found[s->n++] = (struct found){ *p, depth };
}

static int by_depth(const void *a, const void *b)
{
	const struct found *p = a, *q = b;
	if (p->depth != q->depth)
		return p->depth < q->depth ? -1 : 1;
	return p->pick.thing - q->pick.thing;
}

/* The ray of the place, from before all that there is. */
static struct ray ray_of(const struct search *s)
{
	const struct drawing *d = &s->drawing;
	struct ray r = { .near = 0, .far = INFINITY };
	camera_ray(&d->camera, s->x, s->y, &r.origin, &r.direction);
	if (d->camera.kind == CAMERA_ORTHOGRAPHIC)
		r.origin = vec3_along(r.origin, d->near, r.direction);
	return r;
}

static double depth_at(const struct search *s, struct vec3 p)
{
	const struct camera *c = &s->drawing.camera;
	return vec3_dot(vec3_sub(p, c->eye), c->ahead);
}

/* Rays are made ready of surfaces whose box is under the mouse, not of all. */
static bool meets_box(const struct ray *r, const struct box *b)
{
	const double o[3] = { r->origin.x, r->origin.y, r->origin.z };
	const double v[3] = { r->direction.x, r->direction.y, r->direction.z };
	const double lo[3] = { b->lo.x, b->lo.y, b->lo.z }, hi[3] = { b->hi.x, b->hi.y, b->hi.z };
	const double room = 1e-9 * box_diagonal(b);
	double near = -INFINITY, far = INFINITY;
	for (int k = 0; k < 3; k++) {
		if (v[k] == 0 && (o[k] < lo[k] - room || o[k] > hi[k] + room))
			return false;
		if (v[k] == 0)
			continue;
		const double t0 = (lo[k] - room - o[k]) / v[k], t1 = (hi[k] + room - o[k]) / v[k];
		near = fmax(near, fmin(t0, t1));
		far = fmin(far, fmax(t0, t1));
	}
	return near <= far;
}

/* All layers of a surface that the ray goes through. */
static void try_surface(struct search *s, const struct Ful *f, struct shape *x)
{
	struct ray r = ray_of(s);
	const struct ray_scene *rays = meets_box(&r, &x->box) ? shape_rays(x) : NULL;
	for (int i = 0; rays && i < LAYERS_MAX; i++) {
		struct ray_hit hit;
		ray_scene_hits(rays, &r, 1, true, &hit);
		if (hit.surface < 0)
			return;
		const struct pick p = {
			.thing = f->id, .index = -1, .u = hit.u, .v = hit.v, .point = hit.point
		};
		add(s, &p, depth_at(s, hit.point));
		r.near = hit.t + 1e-6 * box_diagonal(&x->box);
	}
}

/* Distance in px, and whether the point is before the eye. */
static bool distance_to(const struct search *s, struct vec3 p, double *out)
{
	double x, y, depth;
	if (!camera_project(&s->drawing.camera, p, &x, &y, &depth))
		return false;
	*out = hypot(x - s->x, y - s->y);
	return true;
}

static struct vec3 curve_at(const struct search *s, const struct Ful *f, double t)
{
	const struct entity *e = &f->entity;
	const struct Ful *on = f->on ? world_by_id(s->drawing.world, f->on) : NULL;
	if (e->kind == ENTITY_CURVE_ON_SURFACE && on) {
		const struct on_surface c = { &e->curve, &on->entity.geometry };
		struct vec3 p;
		on_surface_derivatives(&c, t, 0, &p);
		return p;
	}
	return curve_point(e->kind == ENTITY_CURVE_ON_SURFACE ? &e->space : &e->curve, t);
}

/* The parameter between a and b where the curve comes nearest to the place; golden section. */
static double nearest_between(const struct search *s, const struct Ful *f, double a, double b)
{
	const double part = 0.38196601125010515;
	for (int i = 0; i < SEARCHES; i++) {
		double t0 = a + part * (b - a), t1 = b - part * (b - a);
		double d0 = INFINITY, d1 = INFINITY;
		distance_to(s, curve_at(s, f, t0), &d0);
		distance_to(s, curve_at(s, f, t1), &d1);
		if (d0 < d1)
			b = t1;
		else
			a = t0;
	}
	return (a + b) / 2;
}

/* Distance of the place from the chord in px. */
static double chord_distance(const struct search *s, struct vec3 p, struct vec3 q)
{
	double x0, y0, x1, y1, depth;
	if (!camera_project(&s->drawing.camera, p, &x0, &y0, &depth) ||
	    !camera_project(&s->drawing.camera, q, &x1, &y1, &depth))
		return INFINITY;
	double dx = x1 - x0, dy = y1 - y0, l = dx * dx + dy * dy;
	double t = l > 0 ? ((s->x - x0) * dx + (s->y - y0) * dy) / l : 0;
	t = fmin(fmax(t, 0), 1);
	return hypot(x0 + t * dx - s->x, y0 + t * dy - s->y);
}

static void try_curve(struct search *s, const struct Ful *f, const struct shape *x)
{
	const struct poly *p = &x->poly[SHAPE_CURVE];
	const double reach = REACH * s->drawing.frame.scale;
	double best = reach;
	int at = -1;
	for (int i = 0; i + 1 < p->n; i++) {
		if (p->v[i].part < 0 || p->v[i + 1].part < 0)
			continue;
		double away = chord_distance(s, poly_at(p, i), poly_at(p, i + 1));
		if (away < best) {
			best = away;
			at = i;
		}
	}
	if (at < 0)
		return;
	double u = nearest_between(s, f, p->t[at], p->t[at + 1]);
	struct vec3 point = curve_at(s, f, u);
	const struct pick pick = { .thing = f->id, .index = -1, .u = u, .point = point };
	const double pixel = drawing_pixel(&s->drawing, point);
	add(s, &pick, depth_at(s, point) + (best - reach) * pixel);
}

static void try_points(struct search *s, const struct Ful *f, const struct shape *x)
{
	const struct poly *p = &x->poly[SHAPE_POINTS];
	const double reach = REACH * s->drawing.frame.scale;
	for (int i = 1; i + 1 < p->n; i++) {
		double away;
		struct vec3 at = poly_at(p, i);
		if (!distance_to(s, at, &away) || away > reach)
			continue;
		const struct pick pick = {
			.thing = f->id, .is_point = true, .index = i - 1, .point = at
		};
		/* nets are drawn before everything */
		const double pixel = drawing_pixel(&s->drawing, at);
		add(s, &pick, depth_at(s, at) + (away - 2 * reach) * pixel - 1e3 * s->drawing.far);
	}
}

static enum status search_all(struct search *s, bool points)
{
	struct drawing *d = &s->drawing;
	enum status st = ST_OK;
	for (int i = 0; i < d->n_shown && st == ST_OK; i++) {
		const struct Ful *f = d->things[i];
		struct shape *x = d->shown[i];
		const bool list = f->entity.kind == ENTITY_POINTS;
		const bool net = points && f->display.net;
		/* a surface is found by rays */
		if ((net || f->entity.kind != ENTITY_SURFACE) &&
		    !(x->tolerance > 0 && x->made_for.net == f->display.net))
			st = shape_make_lines(x, d->world, f, true,
			                      0.1 * drawing_pixel(d, box_center(&d->box)));
		if (st != ST_OK)
			break;
		if (net || list)
			try_points(s, f, x);
		if (f->entity.kind == ENTITY_SURFACE)
			try_surface(s, f, x);
		else if (!list)
			try_curve(s, f, x);
	}
	return st == ST_OK && s->failed ? ST_RESOURCE : st;
}

enum status view_pick(struct view *v, const struct world *w, const struct view_state *s, double x,
                      double y, bool points, int skip, struct pick *out)
{
	const double scale = s->scale > 0 ? s->scale : 1;
	struct search search = { .x = x * scale, .y = y * scale };
	*out = (struct pick){ .index = -1 };
	enum status st = drawing_init(&search.drawing, v, w, s, (int)lrint(s->camera.width * scale),
	                              (int)lrint(s->camera.height * scale), &report_none);
	if (st != ST_OK)
		return st;
	st = search_all(&search, points);
	if (search.n)
		qsort(search.found, (size_t)search.n, sizeof *search.found, by_depth);
	if (st == ST_OK && skip >= 0 && skip < search.n)
		*out = search.found[skip].pick;
	free(search.found);
	drawing_finish(&search.drawing);
	return st;
}
