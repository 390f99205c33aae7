/* render_lines.c - the world's lines for picture_lines: .svg and .pdf. */
#include <stdlib.h>

#include "refine.h"
#include "render.h"
#include "result.h"
#include "ticks.h"
#include "view_private.h"

/* What picture_lines borrows. */
struct lines {
	const struct world *world;
	const struct camera *camera;
	enum theme theme;
	struct rgb ground;
	const struct surface **surfaces; /* owned */
	struct curve *made;              /* owned, and each of them: pieces of trimmed surfaces */
	struct picture_curve *curves;    /* owned; made: index in `made` while that grows */
	int *made_at;         /* owned; of each curve its place in `made`, -1: borrowed */
	char **labels;        /* owned, and each */
	struct model *models; /* owned, and each */
	int n_surfaces, n_made, n_curves, n_labels, n_models;
	enum status status;
};

static void lines_finish(struct lines *l)
{
	for (int i = 0; i < l->n_made; i++)
		curve_finish(&l->made[i]);
	for (int i = 0; i < l->n_labels; i++)
		free(l->labels[i]);
	for (int i = 0; i < l->n_models; i++)
		model_finish(&l->models[i]);
	free((void *)l->surfaces);
	free(l->made);
	free(l->curves);
	free(l->made_at);
	free((void *)l->labels);
	free(l->models);
}

/* Room for one more; false: memory ran out. */
static bool grow(struct lines *l, void **p, int n, size_t size)
{
	void *q = reallocarray(*p, (size_t)n + 1, size);
	if (!q)
		l->status = ST_RESOURCE;
	else
		*p = q;
	return q != NULL;
}

static struct rgb mixed(const struct lines *l, struct rgb c, double strength)
{
	return (struct rgb){ c.r * strength + l->ground.r * (1 - strength),
		             c.g * strength + l->ground.g * (1 - strength),
		             c.b * strength + l->ground.b * (1 - strength) };
}

static void add_curve(struct lines *l, const struct curve *c, int made, struct rgb color,
                      double width, const char *label)
{
	if (!grow(l, (void **)&l->curves, l->n_curves, sizeof *l->curves) ||
	    !grow(l, (void **)&l->made_at, l->n_curves, sizeof *l->made_at))
		return;
	l->made_at[l->n_curves] = made;
	l->curves[l->n_curves++] = (struct picture_curve){
		.curve = c, .color = color, .width = width, .label = label
	};
}

/* Polylines as curves of order 2. */
static void add_polylines(struct lines *l, const struct poly *p, struct rgb color, double width)
{
	if (p->failed)
		l->status = ST_RESOURCE;
	for (int from = 0, to; from < p->n && l->status == ST_OK; from = to) {
		while (from < p->n && p->v[from].part < 0)
			from++;
		for (to = from; to < p->n && p->v[to].part >= 0;)
			to++;
		const int n = to - from;
		if (n < 2 || !grow(l, (void **)&l->made, l->n_made, sizeof *l->made))
			continue;
		struct curve *c = &l->made[l->n_made];
		l->status = curve_init(c, 2, n);
		if (l->status != ST_OK)
			return;
		for (int i = 0; i < n; i++) {
			curve_set_point(c, i, poly_at(p, from + i), 1);
			c->knots[i + 1] = i;
		}
		c->knots[n + 1] = n - 1;
		c->domain[1] = n - 1;
		add_curve(l, NULL, l->n_made++, color, width, NULL);
	}
}

/* What the trim leaves: its lines as chords, half a tenth of a px from them at most. */
static void add_trimmed(struct lines *l, const struct Ful *f)
{
	const struct surface *s = &f->entity.geometry;
	const struct trim *trim = &f->entity.trim;
	const int inner[2] = { f->display.lines_u, f->display.lines_v };
	struct poly wire = { .v = NULL }, edge = { .v = NULL };
	struct trim_test *inside = NULL;
	struct box b;
	if (!thing_box(l->world, f, &b))
		return;
	l->status = trim_test_create(&inside, trim, s);
	if (l->status != ST_OK)
		return;
	const double tolerance = 0.05 * camera_pixel(l->camera, box_center(&b));
	poly_reset(&wire, box_center(&b));
	poly_reset(&edge, box_center(&b));
	for (int k = 0; k < 2; k++)
		for (int i = 1; i <= inner[k]; i++)
			poly_add_isoparametric(&wire, s, inside, k,
			                       s->domain[k][0] +
			                               (s->domain[k][1] - s->domain[k][0]) * i /
			                                       (inner[k] + 1),
			                       0, tolerance);
	for (int i = 0; i < trim->n; i++)
		for (int k = 0; k < trim->loops[i].n; k++)
			poly_add_curve_on(&edge, &trim->loops[i].curves[k], s, 0, tolerance);
	add_polylines(l, &wire, mixed(l, theme_color(l->theme, TOKEN_TEXT), 0.25), 0.75);
	add_polylines(l, &edge, mixed(l, theme_color(l->theme, TOKEN_TEXT2), 0.6), 1);
	poly_finish(&wire);
	poly_finish(&edge);
	trim_test_destroy(inside);
}

/* A curve on a surface that has no curve in space, as chords. */
static void add_on_surface(struct lines *l, const struct Ful *f, struct rgb color, double width)
{
	const struct Ful *on = world_by_id(l->world, f->on);
	struct poly p = { .v = NULL };
	struct box b;
	if (!on || !thing_box(l->world, f, &b))
		return;
	poly_reset(&p, box_center(&b));
	poly_add_curve_on(&p, &f->entity.curve, &on->entity.geometry, 0,
	                  0.05 * camera_pixel(l->camera, box_center(&b)));
	add_polylines(l, &p, color, width);
	poly_finish(&p);
}

static void add_thing(struct lines *l, const struct Ful *f)
{
	const bool current = f == world_current(l->world, true);
	const struct rgb color = theme_color(l->theme, current ? TOKEN_CURRENT : TOKEN_TEXT);
	const double width = current ? 2 : 1.5;
	const struct entity *e = &f->entity;
	if (e->kind == ENTITY_SURFACE && e->trim.n) {
		add_trimmed(l, f);
	} else if (e->kind == ENTITY_SURFACE) {
		if (grow(l, (void **)&l->surfaces, l->n_surfaces, sizeof *l->surfaces))
			l->surfaces[l->n_surfaces++] = &e->geometry;
	} else if (e->kind == ENTITY_CURVE) {
		add_curve(l, &e->curve, -1, color, width, NULL);
	} else if (e->kind == ENTITY_CURVE_ON_SURFACE && e->space.order > 0) {
		add_curve(l, &e->space, -1, color, width, NULL);
	} else if (e->kind == ENTITY_CURVE_ON_SURFACE) {
		add_on_surface(l, f, color, width);
	}
}

/* Every third: the multiples of three steps where values are multiples of a step. */
static bool is_strong(double value, int group, double step)
{
	const double k = step > 0 ? value / step : NAN;
	const bool even = fabs(k - round(k)) < 1e-6;
	return (even ? lrint(k) : group) % 3 == 0;
}

/* From the first value to the next; 0: there is one only. */
static double step_of(const struct model *m)
{
	double first = NAN, value;
	for (int i = 0; i < m->n; i++) {
		if (!result_value(&m->entities[i], &value))
			continue;
		if (isnan(first))
			first = value;
		else if (value != first)
			return value - first;
	}
	return 0;
}

/* Lines of a result file: every third value stronger, with its label on its longest line. */
static void add_result(struct lines *l, const char *file, const struct report *r)
{
	const struct rgb text = theme_color(l->theme, TOKEN_TEXT);
	if (!grow(l, (void **)&l->models, l->n_models, sizeof *l->models))
		return;
	struct model *m = &l->models[l->n_models];
	l->status = model_read(m, file, NULL, r);
	if (l->status != ST_OK)
		return;
	l->n_models++;
	const double step = step_of(m);
	double last = NAN;
	int group = -1;
	for (int i = 0; i < m->n && l->status == ST_OK; i++) {
		const struct entity *e = &m->entities[i];
		const bool on = e->kind == ENTITY_CURVE_ON_SURFACE && e->space.order > 0;
		double value;
		if (!on && !(e->kind == ENTITY_CURVE && !e->used))
			continue;
		const char *name = result_value(e, &value);
		const bool first = !(value == last);
		group += first;
		last = value;
		const bool strong = is_strong(value, group, step);
		char *label = NULL, number[TICK_TEXT];
		number_for_reader(number, value, 4);
		if (name && first && strong &&
		    grow(l, (void **)&l->labels, l->n_labels, sizeof *l->labels)) {
			label = text_print("%s%s", number, *name == 'a' ? "\u00b0" : "");
			if (label)
				l->labels[l->n_labels++] = label;
		}
		add_curve(l, on ? &e->space : &e->curve, -1, mixed(l, text, strong ? 0.85 : 0.45),
		          strong ? 1.5 : 0.75, label);
	}
}

/* What one view shows. */
static enum status lines_init(struct lines *l, struct picture_lines *out, const struct world *w,
                              const struct render_tile *t, enum theme theme, const struct report *r)
{
	const int only = t->state.only;
	*l = (struct lines){ .world = w, .camera = &t->state.camera, .theme = theme };
	l->ground = theme_color(theme, TOKEN_VIEW);
	for (int k = 0; k < world_count(w) && l->status == ST_OK; k++)
		if (only ? world_at(w, k)->id == only : world_at(w, k)->display.on)
			add_thing(l, world_at(w, k));
	for (int k = 0; k < world_overlays(w) && l->status == ST_OK; k++) {
		const struct overlay *o = world_overlay(w, k);
		if (o->kind == OVERLAY_LINES && o->file && (!only || o->thing == only))
			add_result(l, o->file, r);
	}
	for (int i = 0; i < l->n_curves; i++)
		if (l->made_at[i] >= 0)
			l->curves[i].curve = &l->made[l->made_at[i]];
	*out = (struct picture_lines){ .camera = l->camera,
		                       .surfaces = l->surfaces,
		                       .n_surfaces = l->n_surfaces,
		                       .curves = l->curves,
		                       .n_curves = (size_t)l->n_curves,
		                       .title = t->title.s,
		                       .note = t->note.s };
	return l->status;
}

enum status render_lines(const struct world *w, const char *path, enum picture_format format,
                         const struct render_tiles *tiles, const struct render_options *o,
                         const struct report *r)
{
	enum { MOST = 2 };
	struct lines l[MOST] = { { .world = w } };
	struct plane_lines plane = { .curves = NULL };
	struct picture_lines lines[MOST];
	struct picture_pane panes[MOST];
	enum status st = ST_OK;
	int n = 0;
	for (; n < tiles->n && n < MOST && st == ST_OK; n++) {
		const struct render_tile *t = &tiles->tile[n];
		if (t->is_plane)
			st = plane_lines_init(&plane, w, t, o->theme);
		else
			st = lines_init(&l[n], &lines[n], w, t, o->theme, r);
		panes[n] = (struct picture_pane){ t->is_plane ? &plane.lines : &lines[n],
			                          (int)lrint(t->x / o->scale),
			                          (int)lrint(t->y / o->scale) };
	}
	if (st == ST_RESOURCE)
		report_error(r, st, "cannot draw: memory ran out");
	if (st == ST_OK)
		st = picture_panes(path, format, (int)fmax(lrint(o->width / o->scale), 1),
		                   (int)fmax(lrint(o->height / o->scale), 1), panes, n, o->theme,
		                   r);
	for (int i = 0; i < n; i++)
		lines_finish(&l[i]);
	plane_lines_finish(&plane);
	return st;
}
