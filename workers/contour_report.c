/* contour_report.c - contours as figures, as a table of sections, as a ship's lines. */
#include "contour_report.h"

#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "json.h"
#include "level_wires.h"
#include "lines_plan.h"

static json_t *level_figures(const struct work *w, const struct contour_state *s, int i,
                             const struct level_total *t)
{
	int place;
	const struct contour_set *set = contour_sets_at(&s->sets, i, &place);
	const struct contour_measure *m = &s->measures[i];
	json_t *o = json_object(), *centroid = json_null();
	json_set_text(o, "kind", s->kinds[i]);
	json_set_int(o, "number", set->first + place);
	json_set_number(o, "value", s->values[i]);
	level_total_set(w, t, o);
	if (m->known && isfinite(m->centroid.x)) {
		centroid = json_array();
		json_array_append_new(centroid, json_real_or_null(m->centroid.x));
		json_array_append_new(centroid, json_real_or_null(m->centroid.y));
		json_array_append_new(centroid, json_real_or_null(m->centroid.z));
	}
	json_set_number(o, "area", m->known ? m->area : NAN);
	json_object_set_new(o, "centroid", centroid);
	json_set_number(o, "girth", m->known ? m->girth : NAN);
	return o;
}

json_t *contour_figures(const struct work *w, const struct contour_state *s)
{
	struct level_total sum = { 0 };
	json_t *o = json_object(), *levels = json_array();
	for (int i = 0; i < s->sets.n_values; i++) {
		const struct level_total t = level_curves_total(&s->level, i);
		level_total_add(&sum, &t);
		json_array_append_new(levels, level_figures(w, s, i, &t));
	}
	level_curves_tell(w, s->tolerance, &sum);
	level_total_set(w, &sum, o);
	json_object_set_new(o, "levels", levels);
	return o;
}

static void column(struct text *t, bool known, double x)
{
	text_add(t, ",");
	if (known && isfinite(x))
		text_add_number(t, x);
}

enum status contour_table_write(void *data, const char *path, const struct report *r)
{
	const struct work *w = data;
	const struct contour_state *s = w->state;
	struct text t = { 0 };
	text_add(&t, "kind,number,value,branches,closed,length,area,centroid_x,centroid_y,"
	             "centroid_z,girth\n");
	for (int i = 0; i < s->sets.n_values; i++) {
		int place;
		const struct contour_set *set = contour_sets_at(&s->sets, i, &place);
		const struct contour_measure *m = &s->measures[i];
		const struct level_total sum = level_curves_total(&s->level, i);
		text_addf(&t, "%s,%d", s->kinds[i], set->first + place);
		column(&t, true, s->values[i]);
		text_addf(&t, ",%zu,%zu", sum.branches, sum.closed);
		column(&t, true, sum.length);
		column(&t, m->known, m->area);
		column(&t, m->known, m->centroid.x);
		column(&t, m->known, m->centroid.y);
		column(&t, m->known, m->centroid.z);
		column(&t, m->known, m->girth);
		text_add(&t, "\n");
	}
	enum status st = t.failed ? report_error(r, ST_RESOURCE, "no memory to write the table")
	                          : file_write(path, t.s, t.n, r);
	text_finish(&t);
	return st;
}

/* Half breadth of the part of a ship that is nearer to the end at `x` than a twentieth of its
 * length, by samples. */
static double end_breadth(const struct work *w, const struct box *box, double x)
{
	enum { SAMPLES = 40 };
	const double near = (box->hi.x - box->lo.x) / 20;
	double breadth = 0;
	for (int k = 0; k < w->n_surfaces; k++) {
		const struct surface *s = w->surfaces[k];
		for (int i = 0; i <= SAMPLES; i++)
			for (int j = 0; j <= SAMPLES; j++) {
				const double(*d)[2] = s->domain;
				struct vec3 p = surface_point(
				        s, d[0][0] + (d[0][1] - d[0][0]) * i / SAMPLES,
				        d[1][0] + (d[1][1] - d[1][0]) * j / SAMPLES);
				if (fabs(p.x - x) <= near)
					breadth = fmax(breadth, fabs(p.y));
			}
	}
	return breadth;
}

/* 1 where the bow is at +x, else -1. A stern is the fuller end, by its transom or its counter. */
static double bow_find(const struct work *w, const struct box *box)
{
	const char *bow = work_text(w, "bow");
	if (strcmp(bow, "auto") != 0)
		return bow[0] == '+' ? 1 : -1;
	return end_breadth(w, box, box->hi.x) > 1.01 * end_breadth(w, box, box->lo.x) ? -1 : 1;
}

/* Three views of a ship, from the curves of its stations, waterlines and buttocks. */
enum status contour_plan_write(void *data, const char *path, const struct report *r)
{
	struct work *w = data;
	const struct contour_state *s = w->state;
	size_t n = 0, at = 0;
	for (int i = 0; i < s->sets.n_values; i++)
		for (int k = 0; k < s->level.n_surfaces; k++)
			n += level_work_result(&s->level, i, k)->n_branches;
	struct plan_curve *curves = calloc(n + 1, sizeof *curves);
	if (!curves)
		return report_error(r, ST_RESOURCE, "no memory to draw the lines plan");
	for (int i = 0; i < s->sets.n_values; i++) {
		int place;
		const struct contour_set *set = contour_sets_at(&s->sets, i, &place);
		for (int k = 0; k < s->level.n_surfaces; k++) {
			const struct level_result *x = level_work_result(&s->level, i, k);
			for (size_t b = 0; b < x->n_branches; b++)
				curves[at++] = (struct plan_curve){ .curve = &x->branches[b].space,
					                            .of = set->kind,
					                            .place = place };
		}
	}
	struct level_wires wires;
	enum status st = level_wires_make(&wires, &s->level, w);
	if (st != ST_OK) {
		free(curves);
		return report_error(r, st, "no memory to draw the lines plan");
	}
	struct lines_plan plan = { .surfaces = wires.surfaces,
		                   .n_surfaces = wires.n_surfaces,
		                   .borders = wires.lines.borders,
		                   .n_borders = wires.lines.n_borders,
		                   .sets = &s->sets,
		                   .curves = curves,
		                   .n_curves = n,
		                   .forward = bow_find(w, &s->sets.box),
		                   .has_draught = work_has(w, "draught"),
		                   .unit = w->file_unit };
	if (plan.has_draught)
		plan.draught = work_real(w, "draught");
	st = lines_plan_write(&plan, path, r);
	level_wires_finish(&wires);
	free(curves);
	return st;
}
