/* isocurvature.c - curves on a surface along which a curvature is constant. */
#include <stdlib.h>
#include <string.h>

#include "curvature.h"
#include "level_curves.h"
#include "level_work.h"
#include "umbilic_points.h"
#include "worker.h"

enum { LEVELS_MAX = 1000 };

static const struct param isocurvature_params[] = {
	{ .name = "quantity",
	  .type = PARAM_CHOICE,
	  .def = "K",
	  .choices = "K H kmax kmin kn_u kn_v",
	  .help = "which curvature: Gaussian, mean, maximum, minimum, normal in u, normal in v" },
	{ .name = "level",
	  .type = PARAM_REAL,
	  .help = "its value along the curves (0 where nothing is given); instead of several" },
	{ .name = "from", .type = PARAM_REAL, .help = "first of several values" },
	{ .name = "to", .type = PARAM_REAL, .help = "last of several values" },
	{ .name = "count",
	  .type = PARAM_INTEGER,
	  .min = 2,
	  .max = LEVELS_MAX,
	  .help = "how many values from the first to the last (11 where not given)" },
	PARAM_ROWS_LEVEL_TOLERANCE,
	PARAM_ROW_TRIMMED,
	PARAM_ROW_GAP,
	PARAM_ROW_CREASE,
	PARAM_ROW_SVG,
	PARAM_ROW_VIEW("three-quarter"),
	{ .name = NULL },
};

struct isocurvature {
	struct level_work level; /* first, as level_work.h asks */
	enum quantity quantity;
	int n;
	double *values; /* owned */
	double tolerance;
};

static void isocurvature_end(struct work *w)
{
	struct isocurvature *s = w->state;
	if (!s)
		return;
	level_work_finish(&s->level);
	free(s->values);
	free(s);
	w->state = NULL;
}

static enum status values_read(const struct work *w, struct isocurvature *s)
{
	const bool several = work_has(w, "from") || work_has(w, "to") || work_has(w, "count");
	if (several && work_has(w, "level"))
		return report_error(&w->report, ST_PARAMETER,
		                    "values are given twice: take --level, or --from, --to and "
		                    "--count");
	if (several && !(work_has(w, "from") && work_has(w, "to")))
		return report_error(&w->report, ST_PARAMETER,
		                    "several values need --from and --to");
	double from = several                ? work_real(w, "from")
	              : work_has(w, "level") ? work_real(w, "level")
	                                     : 0;
	double to = several ? work_real(w, "to") : from;
	if (several && !(from < to))
		return report_error(&w->report, ST_PARAMETER,
		                    "--from %g is not below --to %g; exchange them", from, to);
	s->n = !several ? 1 : work_has(w, "count") ? (int)work_integer(w, "count") : 11;
	s->values = malloc(sizeof *s->values * (size_t)s->n);
	if (!s->values)
		return report_error(&w->report, ST_RESOURCE, "no memory for %d values", s->n);
	for (int i = 0; i < s->n; i++)
		s->values[i] = s->n > 1 ? from + (to - from) * i / (s->n - 1) : from;
	return ST_OK;
}

static enum status isocurvature_begin(struct work *w)
{
	struct isocurvature *s = calloc(1, sizeof *s);
	w->state = s;
	if (!s)
		return report_error(&w->report, ST_RESOURCE, "no memory for lines of curvature");
	if (!(level_work_size(w) > 0))
		return report_error(&w->report, ST_INPUT,
		                    "the surface is a single point and has no curvature; choose "
		                    "another entity");
	while (strcmp(quantity_table[s->quantity].channel, work_text(w, "quantity")) != 0)
		s->quantity++;
	s->tolerance = level_work_tolerance(w);
	enum status st = values_read(w, s);
	struct level_field *fields = calloc(LEVELS_MAX, sizeof *fields);
	if (st == ST_OK && !fields)
		st = report_error(&w->report, ST_RESOURCE, "no memory for lines of curvature");
	for (int i = 0; st == ST_OK && i < s->n; i++)
		fields[i] = (struct level_field){ .kind = LEVEL_CURVATURE,
			                          .quantity = s->quantity,
			                          .value = s->values[i] };
	if (st == ST_OK)
		st = level_work_init(&s->level, w, fields, s->values, s->n, s->tolerance);
	free(fields);
	return st;
}

static enum status isocurvature_finish(struct work *w)
{
	struct isocurvature *s = w->state;
	const struct quantity_row *row = &quantity_table[s->quantity];
	enum status st = level_work_join(&s->level, w);
	char *title = text_print("Constant %s", row->title);
	const double reach = fmax(fabs(s->values[0]), fabs(s->values[s->n - 1]));
	struct level_curves c = { .work = w,
		                  .value_name = row->channel,
		                  .title = title ? title : row->title,
		                  .unit = "",
		                  .map = { .is_signed = row->is_signed,
		                           .lo = reach > 0 ? -reach : -1,
		                           .hi = reach > 0 ? reach : 1 },
		                  .tolerance = s->tolerance,
		                  .values = s->values,
		                  .level = &s->level,
		                  .n = s->n };
	json_t *figures = st == ST_OK ? level_curves_figures(&c) : NULL;
	if (figures && (s->quantity == QUANTITY_KMAX || s->quantity == QUANTITY_KMIN))
		umbilic_points_set(&s->level, figures);
	if (st == ST_OK)
		st = work_figures(w, figures);
	if (st == ST_OK)
		st = work_output(w, ".isocurvature", level_curves_write, &c);
	if (st == ST_OK && work_flag(w, "svg"))
		st = work_output(w, ".isocurvature.svg", level_curves_draw, &c);
	free(title);
	return st;
}

static const struct worker_output isocurvature_outputs[] = {
	{ ".isocurvature", "curves", NULL },
	{ ".isocurvature.svg", "picture", "svg" },
	{ .extension = NULL },
};

const struct worker worker = {
	.name = "isocurvature",
	.title = "lines of constant curvature",
	.version = 3,
	.help = "Traces all curves on a surface along which a curvature keeps its value, as splines in "
	        "u,v and in space with their checked error; Gaussian curvature 0: the parabolic lines. With kmax "
	        "and kmin also the umbilics, the points where both are one.",
	.scene = true,
	.params = isocurvature_params,
	.outputs = isocurvature_outputs,
	.begin = isocurvature_begin,
	.units = level_work_units,
	.unit = level_work_unit,
	.finish = isocurvature_finish,
	.end = isocurvature_end,
};
