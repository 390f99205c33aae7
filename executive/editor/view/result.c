/* result.c - isophotes, contours, reflection lines of a result file, drawn on their surface. */
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "live.h"
#include "number.h"
#include "path.h"
#include "result.h"
#include "ticks.h"
#include "view_private.h"

enum { EVERY = 3, LABELS_MAX = 64 };

void result_finish(struct result *r)
{
	for (int i = 0; i < r->n; i++) {
		poly_finish(&r->groups[i].poly);
		gpu_poly_finish(&r->groups[i].gpu);
		free(r->groups[i].label);
	}
	free(r->groups);
	free(r->file);
	*r = (struct result){ .file = NULL };
}

void results_finish(struct view *v)
{
	for (int i = 0; i < v->n_results; i++)
		result_finish(&v->results[i]);
	free(v->results);
	v->results = NULL;
	v->n_results = 0;
}

const char *result_value(const struct entity *e, double *value)
{
	static const char *const names[] = { "angle", "value", "line" };
	for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
		const char *text = entity_get_attribute(e, names[i]);
		if (text && number_parse(text, value))
			return names[i];
	}
	*value = 0;
	return NULL;
}

static bool is_line(const struct entity *e)
{
	return (e->kind == ENTITY_CURVE && !e->used) ||
	       (e->kind == ENTITY_CURVE_ON_SURFACE && (e->space.order > 0 || e->surface >= 0));
}

/* Lines of one value; named: they are labelled with it. */
static struct result_group *find_group(struct result *r, double value, bool named, bool angle)
{
	for (int i = 0; i < r->n; i++)
		if (r->groups[i].value == value)
			return &r->groups[i];
	struct result_group *all = reallocarray(r->groups, (size_t)r->n + 1, sizeof *all);
	if (!all)
		return NULL;
	r->groups = all;
	char text[TICK_TEXT];
	number_for_reader(text, value, 4);
	struct result_group *g = &all[r->n];
	*g = (struct result_group){ .value = value };
	g->label = text_print("%s%s", named ? text : "", named && angle ? "\u00b0" : "");
	if (!g->label)
		return NULL;
	r->n++;
	return g;
}

static int by_value(const void *a, const void *b)
{
	const struct result_group *p = a, *q = b;
	return (p->value > q->value) - (p->value < q->value);
}

/* Every third: of evenly spaced values the multiples of three steps, else by their place. */
static void choose_strong(struct result *r)
{
	struct result_group *g = r->groups;
	const double step = r->n > 1 ? (g[r->n - 1].value - g[0].value) / (r->n - 1) : 0;
	bool even = step > 0;
	for (int i = 0; i < r->n && even; i++) {
		double k = g[i].value / step;
		even = fabs(g[i].value - g[0].value - i * step) < 1e-6 * step &&
		       fabs(k - round(k)) < 1e-6;
	}
	for (int i = 0; i < r->n; i++) {
		long k = even ? lrint(g[i].value / step) : i;
		g[i].strong = r->n <= EVERY || k % EVERY == 0;
	}
}

static struct vec3 first_point(const struct model *m)
{
	for (int i = 0; i < m->n; i++) {
		struct box b;
		if (m->entities[i].kind == ENTITY_SURFACE &&
		    entity_box(&m->entities[i], &b) == ST_OK && !box_is_empty(&b))
			return box_center(&b);
	}
	return vec3(0, 0, 0);
}

static void load_groups(struct result *r)
{
	if (r->n)
		qsort(r->groups, (size_t)r->n, sizeof *r->groups, by_value);
	choose_strong(r);
	for (int i = 0; i < r->n; i++)
		gpu_poly_load(&r->groups[i].gpu, &r->groups[i].poly);
}

static enum status take_model(struct result *r, const struct model *m)
{
	const struct vec3 origin = first_point(m);
	const double tolerance = r->tolerance;
	for (int i = 0; i < m->n; i++) {
		const struct entity *e = &m->entities[i];
		if (!is_line(e))
			continue;
		double value;
		const char *name = result_value(e, &value);
		struct result_group *g = find_group(r, value, name, name && !strcmp(name, "angle"));
		if (!g)
			return ST_RESOURCE;
		if (!g->poly.n)
			poly_reset(&g->poly, origin);
		if (e->kind == ENTITY_CURVE)
			poly_add_curve(&g->poly, &e->curve, 0, tolerance);
		else if (e->space.order > 0)
			poly_add_curve(&g->poly, &e->space, 0, tolerance);
		else
			poly_add_curve_on(&g->poly, &e->curve, &m->entities[e->surface].geometry, 0,
			                  tolerance);
		if (g->poly.failed)
			return ST_RESOURCE;
	}
	load_groups(r);
	return ST_OK;
}

/* A piece of a line, while others are at work; named as the whole one will be. */
static enum status take_piece(void *data, const struct level_head *head, const struct curve *c)
{
	static const bool named[N_LEVEL_KINDS] = { [LEVEL_PLANE] = true,
		                                   [LEVEL_ISOPHOTE] = true,
		                                   [LEVEL_CYLINDER] = true,
		                                   [LEVEL_HIGHLIGHT] = true,
		                                   [LEVEL_REFLECTION] = true };
	struct result *r = data;
	struct result_group *g =
	        find_group(r, head->value, named[head->kind], head->kind == LEVEL_ISOPHOTE);
	if (!g)
		return ST_RESOURCE;
	if (!g->poly.n)
		poly_reset(&g->poly, curve_point(c, 0));
	poly_add_curve(&g->poly, c, 0, r->tolerance);
	return g->poly.failed ? ST_RESOURCE : ST_OK;
}

/* A file that cannot be read has no lines until it changes: its job may not have begun. */
static enum status read_lines(struct result *r)
{
	struct model m;
	enum status st = ST_OK;
	if (path_has_suffix(r->file, ".part")) {
		st = live_lines(r->file, take_piece, r);
		load_groups(r);
		return st == ST_RESOURCE ? st : ST_OK;
	}
	if (model_read(&m, r->file, NULL, &report_none) != ST_OK)
		return ST_OK;
	st = take_model(r, &m);
	model_finish(&m);
	return st;
}

static enum status update(struct result *r, double tolerance)
{
	int64_t stamp[3] = { 0 };
	file_stamp(r->file, stamp);
	r->used = true;
	if (!memcmp(stamp, r->stamp, sizeof stamp) && r->tolerance <= 1.5 * tolerance &&
	    r->tolerance > 0)
		return ST_OK;
	char *file = r->file;
	r->file = NULL;
	result_finish(r);
	r->file = file;
	r->used = true;
	r->tolerance = tolerance;
	memcpy(r->stamp, stamp, sizeof stamp);
	return read_lines(r);
}

static struct result *find(struct view *v, const char *file)
{
	for (int i = 0; i < v->n_results; i++)
		if (!strcmp(v->results[i].file, file))
			return &v->results[i];
	struct result *all = reallocarray(v->results, (size_t)v->n_results + 1, sizeof *all);
	if (!all)
		return NULL;
	v->results = all;
	all[v->n_results] = (struct result){ .file = strdup(file) };
	return all[v->n_results].file ? &all[v->n_results++] : NULL;
}

static void draw_result(struct drawing *d, struct result *r, bool on_solid)
{
	const struct rgb dark = { 0x14 / 255.0, 0x18 / 255.0, 0x1C / 255.0 };
	for (int i = 0; i < r->n; i++) {
		struct result_group *g = &r->groups[i];
		const struct gpu_style style = { .color = on_solid ? dark
			                                           : drawing_color(d, TOKEN_TEXT),
			                         .alpha = g->strong ? 0.85 : 0.45,
			                         .width = g->strong ? 1.5 : 0.75,
			                         .lift = 2 };
		gpu_draw_lines(&d->frame, &g->gpu, &g->poly, &style);
	}
}

/* Labels that lie already, to keep clear of. */
struct labels {
	double box[LABELS_MAX][4];
	int n;
};

static bool is_free(const struct labels *l, const double b[4], const struct drawing *d)
{
	if (b[0] < 0 || b[1] < 0 || b[0] + b[2] > d->camera.width || b[1] + b[3] > d->camera.height)
		return false;
	for (int i = 0; i < l->n; i++) {
		const double *o = l->box[i];
		if (b[0] < o[0] + o[2] && o[0] < b[0] + b[2] && b[1] < o[1] + o[3] &&
		    o[1] < b[1] + b[3])
			return false;
	}
	return true;
}

static bool is_hidden(const struct drawing *d, struct vec3 p)
{
	const struct camera *c = &d->camera;
	const double pixel = drawing_pixel(d, p);
	struct vec3 to_eye = c->kind == CAMERA_ORTHOGRAPHIC ? vec3_scale(c->ahead, -1)
	                                                    : vec3_unit(vec3_sub(c->eye, p));
	const struct ray ray = { p, to_eye, 4 * pixel, INFINITY };
	for (int i = 0; i < d->n_shown; i++) {
		bool blocked = false;
		if (d->things[i]->entity.kind != ENTITY_SURFACE ||
		    d->things[i]->display.look == LOOK_WIRE)
			continue;
		const struct ray_scene *rays = shape_rays(d->shown[i]);
		if (rays)
			ray_scene_blocked(rays, &ray, 1, &blocked);
		if (blocked)
			return true;
	}
	return false;
}

/* On a long piece of the line, where there is room and it is seen. */
static void place_label(struct drawing *d, const struct result_group *g, struct labels *l)
{
	const double high = 18 * d->frame.scale;
	const double wide = text_width(d, g->label, LABEL_STRONG, true);
	const struct poly *p = &g->poly;
	for (int from = 0, to; from < p->n; from = to + 1) {
		double length = 0, x0 = 0, y0 = 0;
		for (to = from; to < p->n && (to == from || p->v[to].part >= 0); to++) {
			double x, y, depth;
			if (!camera_project(&d->camera, poly_at(p, to), &x, &y, &depth))
				break;
			length += to > from ? hypot(x - x0, y - y0) : 0;
			x0 = x;
			y0 = y;
		}
		if (length < 3 * wide)
			continue;
		static const double shares[] = { 0.5, 0.35, 0.65, 0.2, 0.8 };
		for (size_t k = 0; k < sizeof shares / sizeof *shares && l->n < LABELS_MAX; k++) {
			struct vec3 at = poly_at(p, from + (int)(shares[k] * (to - from)));
			double x, y, depth;
			if (!camera_project(&d->camera, at, &x, &y, &depth))
				continue;
			const double box[4] = { x - wide / 2, y - high / 2, wide, high };
			if (!is_free(l, box, d) || is_hidden(d, at))
				continue;
			text_draw(d, g->label, LABEL_STRONG, true, x, y);
			memcpy(l->box[l->n++], box, sizeof box);
			return;
		}
	}
}

enum status results_draw(struct drawing *d)
{
	struct view *v = d->view;
	enum status st = ST_OK;
	for (int i = 0; i < v->n_results; i++)
		v->results[i].used = false;
	const double tolerance = 0.15 * drawing_pixel(d, box_center(&d->box));
	for (int k = 0; k < world_overlays(d->world) && st == ST_OK; k++) {
		const struct overlay *o = world_overlay(d->world, k);
		const struct shape *x = shapes_find(&v->shapes, o->thing, 0);
		bool shown = !o->thing, solid = false;
		for (int i = 0; i < d->n_shown; i++) {
			if (o->thing && d->shown[i] != x)
				continue;
			shown = true;
			solid |= d->things[i]->entity.kind == ENTITY_SURFACE &&
			         d->things[i]->display.look != LOOK_WIRE;
		}
		if (o->kind != OVERLAY_LINES || !shown || !o->file)
			continue;
		struct result *r = find(v, o->file);
		st = r ? update(r, d->state->moving && r->tolerance > 0 ? r->tolerance : tolerance)
		       : ST_RESOURCE;
		if (st == ST_OK)
			draw_result(d, r, solid);
	}
	struct labels labels = { .n = 0 };
	for (int i = 0; i < v->n_results && st == ST_OK && !d->state->moving; i++)
		for (int k = 0; k < v->results[i].n && v->results[i].used; k++)
			if (v->results[i].groups[k].strong && v->results[i].groups[k].label[0])
				place_label(d, &v->results[i].groups[k], &labels);
	int n = 0;
	for (int i = 0; i < v->n_results; i++)
		if (v->results[i].used)
			v->results[n++] = v->results[i];
		else
			result_finish(&v->results[i]);
	v->n_results = n;
	return st == ST_OK ? st : report_error(d->report, st, "cannot draw: memory ran out");
}
