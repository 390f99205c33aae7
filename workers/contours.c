/* contours.c - where planes and cylinders cut surfaces: stations, waterlines, buttocks of a ship. */
#include <stdlib.h>

#include "contour_report.h"
#include "level_curves.h"

/* Where no gap is given: this part of the box. */
static const double gap_share = 1e-5;

static const struct param contours_params[] = {
	PARAM_ROWS_CONTOURS,
	{ .name = "draught",
	  .type = PARAM_REAL,
	  .unit = "file",
	  .help = "height of the design waterline: stations are measured below it" },
	PARAM_ROWS_LEVEL_TOLERANCE,
	{ .name = "gap",
	  .type = PARAM_REAL,
	  .min = 0,
	  .max = INFINITY,
	  .unit = "file",
	  .help = "curves on neighbouring surfaces are one where their ends are no farther apart "
	          "(1e-5 of the size, four times the tolerance at least, where not given)" },
	PARAM_ROW_SVG,
	PARAM_ROW_VIEW("three-quarter"),
	{ .name = "bow",
	  .type = PARAM_CHOICE,
	  .def = "auto",
	  .choices = "auto +x -x",
	  .help = "where the bow is, for the lines plan (auto: the finer end)" },
	{ .name = "csv",
	  .type = PARAM_FLAG,
	  .def = "no",
	  .help = "make a table of the sections, too: area, centroid, girth" },
	{ .name = NULL },
};

static void contours_end(struct work *w)
{
	struct contour_state *s = w->state;
	if (!s)
		return;
	for (int i = 0; s->joined && i < s->sets.n_values; i++)
		contours_finish(&s->joined[i]);
	free(s->joined);
	free(s->measures);
	free(s->curves);
	free(s->values);
	free(s->kinds);
	level_work_finish(&s->level);
	contour_sets_finish(&s->sets);
	free(s);
	w->state = NULL;
}

static enum status no_memory(const struct work *w)
{
	return report_error(&w->report, ST_RESOURCE, "no memory for contours");
}

static enum status levels_begin(struct work *w, struct contour_state *s)
{
	const int n = s->sets.n_values;
	struct level_field *fields = calloc((size_t)n, sizeof *fields);
	s->values = calloc((size_t)n, sizeof *s->values);
	s->kinds = calloc((size_t)n, sizeof *s->kinds);
	s->joined = calloc((size_t)n, sizeof *s->joined);
	s->measures = calloc((size_t)n, sizeof *s->measures);
	if (!fields || !s->values || !s->kinds || !s->joined || !s->measures) {
		free(fields);
		return no_memory(w);
	}
	for (int i = 0; i < n; i++) {
		int place;
		const struct contour_set *set = contour_sets_at(&s->sets, i, &place);
		fields[i] = set->field;
		fields[i].value = s->values[i] = set->values[place];
		s->kinds[i] = contour_names[set->kind];
	}
	enum status st = level_work_init(&s->level, w, fields, s->values, n, s->tolerance);
	free(fields);
	return st;
}

static enum status contours_begin(struct work *w)
{
	struct contour_state *s = calloc(1, sizeof *s);
	w->state = s;
	if (!s)
		return no_memory(w);
	enum status st = contour_sets_read(&s->sets, w);
	if (st != ST_OK)
		return st;
	s->tolerance = level_work_tolerance(w);
	s->gap = work_has(w, "gap")
	                 ? work_real(w, "gap")
	                 : fmax(gap_share * box_diagonal(&s->sets.box), 4 * s->tolerance);
	return levels_begin(w, s);
}

static size_t contours_units(const struct work *w)
{
	const struct contour_state *s = w->state;
	return level_work_units(&s->level);
}

static enum status contours_unit(struct work *w, size_t unit)
{
	const struct contour_state *s = w->state;
	return level_work_unit(&s->level, w, unit);
}

/* Join the pieces of value i over the surfaces, and number them for the file. */
static enum status value_join(struct contour_state *s, int i, size_t *numbers, size_t *n)
{
	size_t at = 0;
	*n = 0;
	for (int k = 0; k < s->level.n_surfaces; k++)
		*n += level_work_result(&s->level, i, k)->n_branches;
	const struct curve **pieces = malloc(sizeof *pieces * (*n + 1));
	bool *closed = malloc(sizeof *closed * (*n + 1));
	enum status st = pieces && closed ? ST_OK : ST_RESOURCE;
	for (int k = 0; st == ST_OK && k < s->level.n_surfaces; k++) {
		const struct level_result *x = level_work_result(&s->level, i, k);
		for (size_t b = 0; b < x->n_branches; b++, at++) {
			pieces[at] = &x->branches[b].space;
			closed[at] = x->branches[b].closed;
		}
	}
	struct contours *c = &s->joined[i];
	if (st == ST_OK)
		st = contours_join(c, pieces, closed, *n, s->gap);
	for (size_t k = 0; st == ST_OK && k < c->n; k++)
		for (size_t j = 0; j < c->list[k].n; j++)
			numbers[c->pieces[c->list[k].first + j]] = k + 1;
	free(pieces);
	free(closed);
	return st;
}

static enum status sections_make(struct work *w, struct contour_state *s)
{
	const struct section_lid lid = { { 0, 0, 1 },
		                         work_has(w, "draught") ? work_real(w, "draught") : 0 };
	size_t all = 0, at = 0;
	for (int i = 0; i < s->level.n * s->level.n_surfaces; i++)
		all += s->level.results[i].n_branches;
	s->curves = malloc(sizeof *s->curves * (all + 1));
	enum status st = s->curves ? ST_OK : ST_RESOURCE;
	for (int i = 0; st == ST_OK && i < s->sets.n_values; i++) {
		int place;
		size_t n;
		const struct contour_set *set = contour_sets_at(&s->sets, i, &place);
		st = value_join(s, i, s->curves + at, &n);
		if (st == ST_OK)
			st = contour_measure(&s->measures[i], &s->joined[i], set, s->sets.half,
			                     work_has(w, "draught") ? &lid : NULL);
		at += n;
	}
	return st == ST_OK ? st : no_memory(w);
}

static enum status contours_finish_work(struct work *w)
{
	struct contour_state *s = w->state;
	enum status st = level_work_join(&s->level, w);
	if (st == ST_OK)
		st = sections_make(w, s);
	if (st != ST_OK)
		return st;
	const int last = s->sets.n_values - 1;
	const bool one = last == 0;
	struct level_curves c = { .work = w,
		                  .value_name = "value",
		                  .title = s->sets.set[0].kind == CONTOUR_CYLINDERS
		                                   ? "Cylinder contours"
		                                   : "Plane contours",
		                  .unit = "",
		                  .map = { .lo = s->values[0] - one, .hi = s->values[last] + one },
		                  .tolerance = s->tolerance,
		                  .values = s->values,
		                  .results = s->level.results,
		                  .n = s->sets.n_values,
		                  .kinds = s->kinds,
		                  .curves = s->curves };
	level_curves_tell(w, s->tolerance, s->level.results,
	                  (size_t)s->level.n * s->level.n_surfaces);
	st = work_figures(w, contour_figures(s));
	if (st == ST_OK)
		st = work_output(w, ".contour", level_curves_write, &c);
	if (st == ST_OK && work_flag(w, "svg"))
		st = s->sets.set[0].kind < CONTOUR_PLANES
		             ? work_output(w, ".contour.svg", contour_plan_write, w)
		             : work_output(w, ".contour.svg", level_curves_draw, &c);
	if (st == ST_OK && work_flag(w, "csv"))
		st = work_output(w, ".sections.csv", contour_table_write, w);
	return st;
}

static const struct worker_output contours_outputs[] = {
	{ ".contour", "curves", NULL },
	{ ".contour.svg", "picture", "svg" },
	{ ".sections.csv", "table", "csv" },
	{ .extension = NULL },
};

const struct worker worker = {
	.name = "contours",
	.title = "contours",
	.version = 2,
	.help = "Traces all curves in which planes or cylinders cut the surfaces, joined over their "
	        "borders, with area, centroid and girth of sections; stations, waterlines and "
	        "buttocks of a ship as a lines plan. Trims are ignored.",
	.scene = true,
	.params = contours_params,
	.outputs = contours_outputs,
	.begin = contours_begin,
	.units = contours_units,
	.unit = contours_unit,
	.finish = contours_finish_work,
	.end = contours_end,
};
