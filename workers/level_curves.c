/* level_curves.c - curves on a surface as figures, as a .base file and as a drawing. */
#include "level_curves.h"

#include <stdio.h>
#include <stdlib.h>

#include "base.h"
#include "json.h"
#include "level_wires.h"
#include "picture.h"
#include "umbilic_points.h"

enum { LABEL_SIZE = 32 };

#define TOLD_FROM 1.01

static const struct level_result *result_of(const struct level_curves *c, int i, int surface)
{
	return level_work_result(c->level, i, surface);
}

struct level_total level_curves_total(const struct level_work *l, int i)
{
	const struct level_chains *c = &l->chains[i];
	struct level_total t = {
		.branches = c->n, .closed = c->n_closed, .creases = c->creases, .step = c->step
	};
	for (int s = 0; s < l->n_surfaces; s++) {
		const struct level_result *x = level_work_result(l, i, s);
		t.length += x->length;
		t.max_error = fmax(t.max_error, x->max_error);
		t.max_error_uv = fmax(t.max_error_uv, x->max_error_uv);
		t.undecided += x->n_undecided;
	}
	return t;
}

void level_total_add(struct level_total *to, const struct level_total *t)
{
	to->branches += t->branches;
	to->closed += t->closed;
	to->undecided += t->undecided;
	to->creases += t->creases;
	to->length += t->length;
	to->max_error = fmax(to->max_error, t->max_error);
	to->max_error_uv = fmax(to->max_error_uv, t->max_error_uv);
	to->step = fmax(to->step, t->step);
}

void level_total_set(const struct work *w, const struct level_total *t, json_t *o)
{
	json_set_int(o, "branches", (int64_t)t->branches);
	json_set_int(o, "closed", (int64_t)t->closed);
	json_set_number(o, "length", t->length);
	json_set_number(o, "max_error", t->max_error);
	if (work_real(w, "tolerance-uv") > 0)
		json_set_number(o, "max_error_uv", t->max_error_uv);
	json_set_int(o, "undecided", (int64_t)t->undecided);
	json_set_int(o, "creases", (int64_t)t->creases);
	if (w->n_surfaces > 1)
		json_set_number(o, "max_step", t->step);
}

json_t *level_curves_figures(const struct level_curves *c)
{
	struct level_total sum = { 0 };
	json_t *o = json_object(), *levels = json_array();
	for (int i = 0; i < c->n; i++) {
		const struct level_total one = level_curves_total(c->level, i);
		json_t *row = json_object();
		if (c->value_name)
			json_set_number(row, c->value_name, c->values[i]);
		level_total_set(c->work, &one, row);
		json_array_append_new(levels, row);
		level_total_add(&sum, &one);
	}
	level_curves_tell(c->work, c->tolerance, &sum);
	level_total_set(c->work, &sum, o);
	if (c->n > 1)
		json_object_set_new(o, "levels", levels);
	else
		json_decref(levels);
	return o;
}

void level_curves_tell(const struct work *w, double tolerance, const struct level_total *all)
{
	const double tolerance_uv = work_real(w, "tolerance-uv");
	/* what rounding adds to a tolerance near it is not worth a word */
	if (all->max_error > TOLD_FROM * tolerance)
		report_warning(
		        &w->report,
		        "some curves are known to be within %g of the exact ones, not within "
		        "the tolerance of %g; max_error of each tells which",
		        all->max_error, tolerance);
	if (tolerance_uv > 0 && all->max_error_uv > TOLD_FROM * tolerance_uv)
		report_warning(
		        &w->report,
		        "some curves in u,v are known to be within %g of the exact ones, not "
		        "within the tolerance of %g; max_error_uv of each tells which",
		        all->max_error_uv, tolerance_uv);
}

static enum status attribute_number(struct entity *e, const char *name, double x)
{
	struct text t = { 0 };
	text_add_number(&t, x);
	enum status st = t.failed ? ST_RESOURCE : entity_set_attribute(e, name, t.s);
	text_finish(&t);
	return st;
}

/* What value a piece belongs to. */
static enum status value_set(const struct level_curves *c, int i, struct entity *e)
{
	enum status st = ST_OK;
	if (c->kinds)
		st = entity_set_attribute(e, "kind", c->kinds[i]);
	return st == ST_OK && c->value_name ? attribute_number(e, c->value_name, c->values[i]) : st;
}

/* A branch, and the number of the curve over all surfaces that it is a part of. */
static enum status branch_add(const struct level_curves *c, int i, int surface,
                              const struct level_branch *b, size_t number, struct model *m)
{
	struct entity e;
	entity_init(&e, ENTITY_CURVE_ON_SURFACE);
	e.surface = surface;
	enum status st = curve_copy(&e.curve, &b->uv);
	if (st == ST_OK)
		st = curve_copy(&e.space, &b->space);
	if (st == ST_OK)
		st = value_set(c, i, &e);
	if (st == ST_OK)
		st = attribute_number(&e, "curve", (double)number);
	if (st == ST_OK)
		st = entity_set_attribute(&e, "closed", b->closed ? "yes" : "no");
	if (st == ST_OK)
		st = attribute_number(&e, "length", b->length);
	if (st == ST_OK)
		st = attribute_number(&e, "max_error", b->max_error);
	if (st == ST_OK && work_real(c->work, "tolerance-uv") > 0)
		st = attribute_number(&e, "max_error_uv", b->max_error_uv);
	if (st == ST_OK)
		st = model_add(m, &e);
	entity_finish(&e);
	return st;
}

/* What is known of each box, and how many curves leave it. */
static enum status boxes_name(struct entity *e, const struct level_result *x)
{
	struct text kinds = { 0 }, ends = { 0 };
	for (size_t k = 0; k < x->n_undecided; k++) {
		text_add(&kinds, k ? " " : "");
		text_add(&kinds, level_mark_names[x->undecided[k].kind]);
		text_add(&ends, k ? " " : "");
		text_add_number(&ends, x->undecided[k].ends);
	}
	enum status st = kinds.failed || ends.failed ? ST_RESOURCE : ST_OK;
	if (st == ST_OK)
		st = entity_set_attribute(e, "kinds", kinds.s);
	if (st == ST_OK)
		st = entity_set_attribute(e, "ends", ends.s);
	text_finish(&kinds);
	text_finish(&ends);
	return st;
}

/* Undecided boxes as pairs of corners in u, v. */
static enum status boxes_add(const struct level_curves *c, int i, int surface, struct model *m)
{
	const struct level_result *x = result_of(c, i, surface);
	struct entity e;
	if (x->n_undecided == 0)
		return ST_OK;
	entity_init(&e, ENTITY_POINTS);
	enum status st = ST_RESOURCE;
	e.points.dimension = 2;
	e.points.values = malloc(sizeof *e.points.values * 4 * x->n_undecided);
	if (e.points.values) {
		e.points.n = 2 * (int)x->n_undecided;
		for (size_t k = 0; k < x->n_undecided; k++)
			for (int d = 0; d < 2; d++) {
				e.points.values[4 * k + d] = x->undecided[k].lo[d];
				e.points.values[4 * k + 2 + d] = x->undecided[k].hi[d];
			}
		st = value_set(c, i, &e);
	}
	if (st == ST_OK)
		st = entity_set_attribute(&e, "undecided", "corners of boxes");
	if (st == ST_OK)
		st = boxes_name(&e, x);
	if (st == ST_OK && c->work->n_surfaces > 1)
		st = attribute_number(&e, "surface", surface + 1);
	if (st == ST_OK)
		st = model_add(m, &e);
	entity_finish(&e);
	return st;
}

static enum status surface_add(const struct level_work *l, const struct work *w, int i,
                               struct model *m)
{
	struct entity e;
	entity_init(&e, ENTITY_SURFACE);
	e.used = true;
	enum status st = surface_copy(&e.geometry, w->surfaces[i]);
	if (st == ST_OK && l->trimmed) {
		st = trim_copy(&e.trim, &w->entities[i]->trim);
		e.trims = e.trim.n;
	}
	if (st == ST_OK && w->entities[i]->name)
		st = model_set_text(&e.name, w->entities[i]->name);
	if (st == ST_OK)
		st = model_add(m, &e);
	entity_finish(&e);
	return st;
}

/* Surface by surface the curves of value i, and what stayed undecided. */
static enum status value_fill(const struct level_curves *c, int i, struct model *m)
{
	const struct level_chains *chains = &c->level->chains[i];
	const int n = c->level->n_surfaces;
	size_t *first = calloc((size_t)n + 1, sizeof *first);
	enum status st = first ? ST_OK : ST_RESOURCE;
	for (int s = 0; first && s < n; s++)
		first[s + 1] = first[s] + result_of(c, i, s)->n_branches;
	size_t *number = first ? calloc(first[n] + 1, sizeof *number) : NULL;
	for (size_t k = 0; number && k < chains->n; k++)
		for (size_t p = 0; p < chains->list[k].n; p++) {
			const struct level_part *x = &chains->parts[chains->list[k].first + p];
			number[first[x->face] + x->branch] = k + 1;
		}
	if (!number)
		st = ST_RESOURCE;
	for (int s = 0; st == ST_OK && s < n; s++) {
		const struct level_result *x = result_of(c, i, s);
		for (size_t b = 0; st == ST_OK && b < x->n_branches; b++)
			st = branch_add(c, i, s, &x->branches[b], number[first[s] + b], m);
		if (st == ST_OK)
			st = boxes_add(c, i, s, m);
	}
	free(number);
	free(first);
	return st;
}

/* The surfaces first, then value by value the curves on each and what stayed undecided. */
static enum status curves_fill(const struct level_curves *c, struct model *m)
{
	const struct work *w = c->work;
	struct text t = { 0 };
	int n;
	const struct work_attribute *a = work_attributes(w, &n);
	enum status st = w->file_unit ? model_set_text(&m->unit, w->file_unit) : ST_OK;
	for (int i = 0; st == ST_OK && i < n; i++)
		st = model_set_attribute(m, a[i].name, a[i].value);
	text_add_number(&t, c->tolerance);
	if (st == ST_OK)
		st = t.failed ? ST_RESOURCE : model_set_attribute(m, "tolerance", t.s);
	text_finish(&t);
	for (int s = 0; st == ST_OK && s < w->n_surfaces; s++)
		st = surface_add(c->level, w, s, m);
	for (int i = 0; st == ST_OK && i < c->n; i++)
		st = value_fill(c, i, m);
	if (st == ST_OK)
		st = umbilic_points_add(c->level, m);
	return st;
}

enum status level_curves_write(void *data, const char *path, const struct report *r)
{
	struct model m;
	model_init(&m);
	m.scale = 1;
	enum status st = curves_fill(data, &m);
	if (st != ST_OK)
		report_error(r, st, "no memory to write the curves");
	else
		st = base_write(&m, path, r);
	model_finish(&m);
	return st;
}

/* The curves of value i, colored, the longest labelled; returns their number. */
static size_t curves_draw(const struct level_curves *c, int i, char *label,
                          struct picture_curve *out)
{
	double longest = 0;
	size_t n = 0, labelled = 0;
	for (int s = 0; s < c->work->n_surfaces; s++) {
		const struct level_result *x = result_of(c, i, s);
		for (size_t b = 0; b < x->n_branches; b++, n++) {
			out[n].curve = &x->branches[b].space;
			out[n].color = colormap_color(&c->map, c->values[i]);
			out[n].width = 1.5;
			if (x->branches[b].length > longest) {
				longest = x->branches[b].length;
				labelled = n;
			}
		}
	}
	snprintf(label, LABEL_SIZE, "%.4g%s", c->values[i], c->unit);
	if (longest > 0 && c->value_name)
		out[labelled].label = label;
	return n;
}

enum status level_curves_draw(void *data, const char *path, const struct report *r)
{
	const struct level_curves *c = data;
	const struct work *w = c->work;
	struct camera camera;
	struct level_wires wires = { .n_surfaces = 0 };
	size_t n = 0, at = 0;
	for (int i = 0; i < c->n; i++)
		for (int k = 0; k < w->n_surfaces; k++)
			n += result_of(c, i, k)->n_branches;
	struct picture_curve *curves = calloc(n + 1, sizeof *curves);
	char *labels = calloc((size_t)c->n, LABEL_SIZE);
	enum status st = curves && labels ? level_wires_make(&wires, c->level, w) : ST_RESOURCE;
	if (st != ST_OK)
		st = report_error(r, st, "no memory to draw the curves");
	else
		st = camera_fit_surfaces(&camera, work_text(w, "view"), w->surfaces, w->n_surfaces,
		                         1600, 1000, r);
	if (st == ST_OK) {
		for (int i = 0; i < c->n; i++)
			at += curves_draw(c, i, labels + LABEL_SIZE * i, curves + at);
		struct picture_lines lines = { .camera = &camera,
			                       .surfaces = wires.surfaces,
			                       .n_surfaces = wires.n_surfaces,
			                       .wires = wires.lines.wires,
			                       .borders = wires.lines.borders,
			                       .n_wires = wires.lines.n_wires,
			                       .n_borders = wires.lines.n_borders,
			                       .curves = curves,
			                       .n_curves = n,
			                       .title = c->title };
		st = picture_lines(path, PICTURE_SVG, &lines, THEME_LIGHT, r);
	}
	level_wires_finish(&wires);
	free(labels);
	free(curves);
	return st;
}
