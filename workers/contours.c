/* contours.c - where planes and cylinders cut surfaces: stations, waterlines, buttocks of a ship. */
#include <stdlib.h>

#include "contour_report.h"
#include "level_curves.h"

static const struct param contours_params[] = {
	PARAM_ROWS_CONTOURS,
	{ .name = "draught",
	  .type = PARAM_REAL,
	  .unit = "file",
	  .help = "height of the design waterline: stations are measured below it" },
	PARAM_ROWS_LEVEL_TOLERANCE,
	PARAM_ROW_TRIMMED,
	PARAM_ROW_GAP,
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
	free(s->measures);
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
	s->measures = calloc((size_t)n, sizeof *s->measures);
	if (!fields || !s->values || !s->kinds || !s->measures) {
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
	return levels_begin(w, s);
}

static enum status sections_make(struct work *w, struct contour_state *s)
{
	const struct section_lid lid = { { 0, 0, 1 },
		                         work_has(w, "draught") ? work_real(w, "draught") : 0 };
	enum status st = ST_OK;
	for (int i = 0; st == ST_OK && i < s->sets.n_values; i++) {
		int place;
		const struct contour_set *set = contour_sets_at(&s->sets, i, &place);
		st = contour_measure(&s->measures[i], &s->level, i, set, s->sets.half,
		                     work_has(w, "draught") ? &lid : NULL);
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
		                  .level = &s->level,
		                  .n = s->sets.n_values,
		                  .kinds = s->kinds };
	st = work_figures(w, contour_figures(w, s));
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
	.version = 3,
	.help = "Traces all curves in which planes or cylinders cut the surfaces, joined over their "
	        "borders, with area, centroid and girth of sections; stations, waterlines and "
	        "buttocks of a ship as a lines plan.",
	.scene = true,
	.params = contours_params,
	.outputs = contours_outputs,
	.begin = contours_begin,
	.units = level_work_units,
	.unit = level_work_unit,
	.finish = contours_finish_work,
	.end = contours_end,
};
