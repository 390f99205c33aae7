/* shape.c - the view's copies of the world's things. */
#include "shape.h"

#include <stdlib.h>
#include <string.h>

#include "refine.h"

static void shape_empty(struct shape *x)
{
	ray_scene_destroy(x->rays);
	trim_test_destroy(x->inside);
	surface_finish(&x->surface);
	trim_finish(&x->trim);
	x->rays = NULL;
	x->inside = NULL;
	x->coarse.chord = x->fine.chord = x->tolerance = 0;
	x->coarse.triangles = x->fine.triangles = 0;
	x->coarse.failed = x->fine.failed = false;
}

static void shape_destroy(struct shape *x)
{
	if (!x)
		return;
	shape_empty(x);
	gpu_mesh_finish(&x->coarse.gpu);
	mesh_made_finish(&x->coarse.made);
	gpu_mesh_finish(&x->fine.gpu);
	for (int k = 0; k < N_SHAPE_LINES; k++) {
		poly_finish(&x->poly[k]);
		gpu_poly_finish(&x->lines[k]);
	}
	for (int k = 0; k < N_MOVED_LINES; k++) {
		poly_finish(&x->moved_poly[k]);
		gpu_ribbon_finish(&x->moved_lines[k]);
	}
	free(x);
}

void shapes_finish(struct shapes *s)
{
	for (int i = 0; i < s->n; i++)
		shape_destroy(s->all[i]);
	free((void *)s->all);
	*s = (struct shapes){ .all = NULL };
}

struct gpu_poly *shape_lines(struct shape *x, enum shape_lines which)
{
	if (!x->lines_loaded[which])
		gpu_poly_load(&x->lines[which], &x->poly[which]);
	x->lines_loaded[which] = true;
	return &x->lines[which];
}

const struct gpu_mesh *shape_mesh_gpu(struct shape_mesh *m)
{
	if (!m->loaded)
		gpu_mesh_load(&m->gpu, &m->made);
	m->loaded = true;
	return &m->gpu;
}

struct shape *shapes_find(const struct shapes *s, int id, int near)
{
	for (int away = 0; away < s->n + near; away++) {
		const int at[2] = { near - away, near + away };
		for (int k = 0; k < 2; k++)
			if (at[k] >= 0 && at[k] < s->n && s->all[at[k]]->id == id)
				return s->all[at[k]];
	}
	return NULL;
}

static void add_points(struct box *b, const double *points, size_t n)
{
	for (size_t i = 0; i < n; i++) {
		const double *p = points + 4 * i;
		box_add_point(b, vec3(p[0] / p[3], p[1] / p[3], p[2] / p[3]));
	}
}

static void add_curve_on(struct box *b, const struct curve *uv, const struct surface *s)
{
	enum { SAMPLES = 32 };
	for (int i = 0; i <= SAMPLES; i++) {
		double t = uv->domain[0] + (uv->domain[1] - uv->domain[0]) * i / SAMPLES;
		struct vec3 p = curve_point(uv, t);
		box_add_point(b, surface_point(s, fmin(fmax(p.x, s->domain[0][0]), s->domain[0][1]),
		                               fmin(fmax(p.y, s->domain[1][0]), s->domain[1][1])));
	}
}

bool thing_box(const struct world *w, const struct Ful *f, struct box *out)
{
	const struct entity *e = &f->entity;
	*out = box_empty();
	if (e->kind == ENTITY_SURFACE) {
		add_points(out, e->geometry.points, (size_t)e->geometry.n[0] * e->geometry.n[1]);
	} else if (e->kind == ENTITY_CURVE) {
		add_points(out, e->curve.points, (size_t)e->curve.n);
	} else if (e->kind == ENTITY_CURVE_ON_SURFACE) {
		const struct Ful *on = world_by_id(w, f->on);
		if (e->space.order > 0)
			add_points(out, e->space.points, (size_t)e->space.n);
		else if (on)
			add_curve_on(out, &e->curve, &on->entity.geometry);
	} else if (e->points.dimension == 3) {
		for (int i = 0; i < e->points.n; i++) {
			const double *p = e->points.values + 3 * (size_t)i;
			box_add_point(out, vec3(p[0], p[1], p[2]));
		}
	}
	return !box_is_empty(out) && isfinite(box_diagonal(out));
}

static enum status take(struct shape *x, const struct world *w, const struct Ful *f)
{
	shape_empty(x);
	x->revision = f->revision;
	if (!thing_box(w, f, &x->box))
		x->box = box_empty();
	x->origin = box_is_empty(&x->box) ? vec3(0, 0, 0) : box_center(&x->box);
	if (f->entity.kind != ENTITY_SURFACE)
		return ST_OK;
	enum status st = surface_copy(&x->surface, &f->entity.geometry);
	if (st == ST_OK)
		st = trim_copy(&x->trim, &f->entity.trim);
	if (st == ST_OK && x->trim.n)
		st = trim_test_create(&x->inside, &x->trim, &x->surface);
	return st;
}

static enum status append(struct shapes *s, const struct Ful *f, struct shape **out)
{
	if (s->n == s->room) {
		int room = s->room ? 2 * s->room : 16;
		struct shape **all = reallocarray((void *)s->all, (size_t)room, sizeof *all);
		if (!all)
			return ST_RESOURCE;
		s->all = all;
		s->room = room;
	}
	struct shape *x = calloc(1, sizeof *x);
	if (!x)
		return ST_RESOURCE;
	x->id = f->id;
	x->revision = f->revision - 1;
	s->all[s->n++] = *out = x;
	s->newest = f->id > s->newest ? f->id : s->newest;
	return ST_OK;
}

enum status shapes_update(struct shapes *s, const struct world *w)
{
	enum status st = ST_OK;
	for (int i = 0; i < s->n; i++)
		s->all[i]->seen = false;
	for (int k = 0; k < world_count(w) && st == ST_OK; k++) {
		const struct Ful *f = world_at(w, k);
		/* they mostly stand in the same order */
		struct shape *x = f->id > s->newest ? NULL : shapes_find(s, f->id, k);
		if (!x)
			st = append(s, f, &x);
		if (st == ST_OK && x->revision != f->revision)
			st = take(x, w, f);
		if (st == ST_OK)
			x->seen = true;
	}
	int n = 0;
	for (int i = 0; i < s->n; i++)
		if (s->all[i]->seen)
			s->all[n++] = s->all[i];
		else
			shape_destroy(s->all[i]);
	s->n = n;
	return st;
}

const struct ray_scene *shape_rays(struct shape *x)
{
	const struct surface *surface = &x->surface;
	const struct trim *trim = x->trim.n ? &x->trim : NULL;
	if (!x->rays && surface->order[0] &&
	    ray_scene_create_trimmed(&x->rays, &surface, &trim, 1, 0, &report_none) != ST_OK)
		x->rays = NULL;
	return x->rays;
}

/* Isoparametric lines and borders; a border that is one point is no line. */
static void surface_lines(struct shape *x, const struct display *d, bool wires, double tolerance)
{
	const struct surface *s = &x->surface;
	const int inner[2] = { wires ? d->lines_u : 0, wires ? d->lines_v : 0 };
	for (int k = 0; k < 2; k++) {
		const double *range = s->domain[k];
		for (int i = 1; i <= inner[k]; i++)
			poly_add_isoparametric(&x->poly[SHAPE_WIRE], s, x->inside, k,
			                       range[0] +
			                               (range[1] - range[0]) * i / (inner[k] + 1),
			                       0, tolerance);
		for (int end = 0; end < 2 && !x->inside; end++)
			if (!surface_degenerate(s, k, end, tolerance))
				poly_add_isoparametric(&x->poly[SHAPE_EDGE], s, NULL, k, range[end],
				                       0, tolerance);
	}
	for (int i = 0; i < x->trim.n; i++)
		for (int k = 0; k < x->trim.loops[i].n; k++)
			poly_add_curve_on(&x->poly[SHAPE_EDGE], &x->trim.loops[i].curves[k], s, 0,
			                  tolerance);
}

static void surface_net(struct shape *x)
{
	const struct surface *s = &x->surface;
	for (int d = 0; d < 2; d++)
		for (int i = 0; i < s->n[d]; i++) {
			for (int j = 0; j < s->n[1 - d]; j++) {
				double weight;
				int at[2] = { d ? j : i, d ? i : j };
				poly_add(&x->poly[SHAPE_NET],
				         surface_get_point(s, at[0], at[1], &weight), j);
			}
			poly_end(&x->poly[SHAPE_NET]);
		}
	for (int i = 0; i < s->n[0]; i++)
		for (int j = 0; j < s->n[1]; j++) {
			double weight;
			poly_add(&x->poly[SHAPE_POINTS], surface_get_point(s, i, j, &weight), 0);
		}
	poly_end(&x->poly[SHAPE_POINTS]);
}

static void surface_combs(struct shape *x, const struct display *d)
{
	const struct surface *s = &x->surface;
	const int inner[2] = { d->lines_u, d->lines_v };
	const double longest = d->quill * box_diagonal(&x->box) / 4;
	for (int k = 0; k < 2; k++)
		for (int i = 0; i <= inner[k] + 1; i++) {
			struct curve c = { 0 };
			const double *range = s->domain[k];
			double t = range[0] + (range[1] - range[0]) * i / (inner[k] + 1);
			if (surface_isoparametric(&c, s, k, fmin(t, range[1])) == ST_OK)
				comb_add(x->poly, &c, NULL, longest, d->quills);
			curve_finish(&c);
		}
}

static void curve_lines(struct shape *x, const struct entity *e, const struct surface *on,
                        const struct display *d, double tolerance)
{
	const struct curve *c = &e->curve;
	if (e->kind == ENTITY_CURVE_ON_SURFACE && on)
		poly_add_curve_on(&x->poly[SHAPE_CURVE], c, on, d->segments, tolerance);
	else if (e->kind == ENTITY_CURVE_ON_SURFACE && e->space.order > 0)
		poly_add_curve(&x->poly[SHAPE_CURVE], c = &e->space, d->segments, tolerance);
	else if (e->kind == ENTITY_CURVE)
		poly_add_curve(&x->poly[SHAPE_CURVE], c, d->segments, tolerance);
	else
		return;
	if (d->porcupine)
		comb_add(x->poly, c, c == &e->curve && e->kind != ENTITY_CURVE ? on : NULL,
		         d->quill * box_diagonal(&x->box), d->quills);
	for (int i = 0; i < c->n; i++) {
		double weight;
		struct vec3 p = curve_get_point(c, i, &weight);
		if (on && c == &e->curve)
			p = surface_point(on, fmin(fmax(p.x, on->domain[0][0]), on->domain[0][1]),
			                  fmin(fmax(p.y, on->domain[1][0]), on->domain[1][1]));
		poly_add(&x->poly[SHAPE_NET], p, i);
		poly_add(&x->poly[SHAPE_POINTS], p, i);
	}
	poly_end(&x->poly[SHAPE_NET]);
	poly_end(&x->poly[SHAPE_POINTS]);
}

static void list_points(struct shape *x, const struct point_list *list)
{
	for (int i = 0; i < list->n && list->dimension == 3; i++) {
		const double *p = list->values + 3 * (size_t)i;
		poly_add(&x->poly[SHAPE_POINTS], vec3(p[0], p[1], p[2]), i);
	}
	poly_end(&x->poly[SHAPE_POINTS]);
}

static bool same_display(const struct display *a, const struct display *b)
{
	return a->segments == b->segments && a->lines_u == b->lines_u && a->lines_v == b->lines_v &&
	       a->porcupine == b->porcupine && a->quill == b->quill && a->quills == b->quills &&
	       a->net == b->net;
}

enum status shape_make_lines(struct shape *x, const struct world *w, const struct Ful *f,
                             bool wires, double tolerance)
{
	const struct entity *e = &f->entity;
	const struct Ful *on = f->on ? world_by_id(w, f->on) : NULL;
	const unsigned on_revision = on ? on->revision : 0;
	if (x->tolerance > 0 && x->tolerance <= 1.5 * tolerance && x->tolerance >= tolerance / 8 &&
	    same_display(&x->made_for, &f->display) && x->on_revision == on_revision &&
	    (x->has_wires || !wires))
		return ST_OK;
	for (int k = 0; k < N_SHAPE_LINES; k++)
		poly_reset(&x->poly[k], x->origin);
	if (e->kind == ENTITY_SURFACE) {
		surface_lines(x, &f->display, wires, tolerance);
		if (f->display.net)
			surface_net(x);
		if (f->display.porcupine)
			surface_combs(x, &f->display);
	} else if (e->kind == ENTITY_POINTS) {
		list_points(x, &e->points);
	} else {
		curve_lines(x, e, on ? &on->entity.geometry : NULL, &f->display, tolerance);
	}
	enum status st = ST_OK;
	for (int k = 0; k < N_SHAPE_LINES; k++) {
		if (x->poly[k].failed)
			st = ST_RESOURCE;
		x->lines_loaded[k] = false;
	}
	x->tolerance = tolerance;
	x->moved_tolerance = 0;
	x->has_wires = wires;
	x->made_for = f->display;
	x->on_revision = on_revision;
	return st;
}

enum status shape_make_moved_lines(struct shape *x, double tolerance)
{
	enum status st = ST_OK;
	if (x->moved_tolerance > 0 && x->moved_tolerance <= 2 * tolerance &&
	    x->moved_tolerance >= tolerance / 2)
		return ST_OK;
	for (int k = 0; k < N_MOVED_LINES; k++) {
		poly_thin(&x->moved_poly[k], &x->poly[k], tolerance);
		if (x->moved_poly[k].failed ||
		    gpu_ribbon_load(&x->moved_lines[k], &x->moved_poly[k]) != ST_OK)
			st = ST_RESOURCE;
	}
	x->moved_tolerance = tolerance;
	return st;
}
