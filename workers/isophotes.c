/* isophotes.c - curves on a surface along which the normal keeps its angle to the light. */
#include <stdlib.h>

#include "level_curves.h"
#include "level_work.h"
#include "worker.h"

enum { ANGLES_MAX = 1000 };

static const struct param isophotes_params[] = {
	{ .name = "angle",
	  .type = PARAM_REAL,
	  .min = 0,
	  .max = 180,
	  .unit = "deg",
	  .help = "angle between normal and light; instead of several angles" },
	{ .name = "from",
	  .type = PARAM_REAL,
	  .min = 0,
	  .max = 180,
	  .unit = "deg",
	  .help = "first of several angles (10 where not given)" },
	{ .name = "to",
	  .type = PARAM_REAL,
	  .min = 0,
	  .max = 180,
	  .unit = "deg",
	  .help = "last of several angles (170 where not given)" },
	{ .name = "count",
	  .type = PARAM_INTEGER,
	  .min = 1,
	  .max = ANGLES_MAX,
	  .help = "how many angles (17 where not given: every 10 degrees)" },
	PARAM_ROWS_LIGHT("0", "0"),
	PARAM_ROWS_LEVEL_TOLERANCE,
	PARAM_ROW_TRIMMED,
	PARAM_ROW_GAP,
	PARAM_ROW_CREASE,
	PARAM_ROW_SVG,
	PARAM_ROW_VIEW("three-quarter"),
	{ .name = NULL },
};

struct isophotes {
	struct level_work level; /* first, as level_work.h asks */
	int n_angles;
	double *angles; /* owned, degrees */
	double tolerance;
};

static void isophotes_end(struct work *w)
{
	struct isophotes *s = w->state;
	if (!s)
		return;
	level_work_finish(&s->level);
	free(s->angles);
	free(s);
	w->state = NULL;
}

static enum status angles_read(const struct work *w, struct isophotes *s)
{
	bool one = work_has(w, "angle");
	if (one && (work_has(w, "from") || work_has(w, "to") || work_has(w, "count")))
		return report_error(&w->report, ST_PARAMETER,
		                    "angles are given twice: take --angle, or --from, --to and "
		                    "--count");
	double from = one ? work_real(w, "angle") : work_has(w, "from") ? work_real(w, "from") : 10;
	double to = one ? from : work_has(w, "to") ? work_real(w, "to") : 170;
	s->n_angles = one ? 1 : work_has(w, "count") ? (int)work_integer(w, "count") : 17;
	if (from > to)
		return report_error(&w->report, ST_PARAMETER,
		                    "--from %g is above --to %g; exchange them", from, to);
	s->angles = malloc(sizeof *s->angles * s->n_angles);
	if (!s->angles)
		return report_error(&w->report, ST_RESOURCE, "no memory for %d angles",
		                    s->n_angles);
	for (int i = 0; i < s->n_angles; i++)
		s->angles[i] = s->n_angles > 1 ? from + (to - from) * i / (s->n_angles - 1) : from;
	return ST_OK;
}

static enum status isophotes_begin(struct work *w)
{
	struct isophotes *s = calloc(1, sizeof *s);
	struct vec3 light;
	w->state = s;
	if (!s)
		return report_error(&w->report, ST_RESOURCE, "no memory for isophotes");
	if (!(level_work_size(w) > 0))
		return report_error(&w->report, ST_INPUT,
		                    "the surface is a single point and has no isophotes; choose "
		                    "another entity");
	s->tolerance = level_work_tolerance(w);
	enum status st = angles_read(w, s);
	if (st == ST_OK)
		st = work_light(w, &light);
	struct level_field *fields = calloc(ANGLES_MAX, sizeof *fields);
	if (st == ST_OK && !fields)
		st = report_error(&w->report, ST_RESOURCE, "no memory for isophotes");
	for (int i = 0; st == ST_OK && i < s->n_angles; i++)
		fields[i] = (struct level_field){ .kind = LEVEL_ISOPHOTE,
			                          .direction = light,
			                          .value = cos(s->angles[i] * M_PI / 180) };
	if (st == ST_OK)
		st = level_work_init(&s->level, w, fields, s->angles, s->n_angles, s->tolerance);
	free(fields);
	return st;
}

static enum status isophotes_finish(struct work *w)
{
	struct isophotes *s = w->state;
	enum status st = level_work_join(&s->level, w);
	struct level_curves c = { .work = w,
		                  .value_name = "angle",
		                  .title = "Isophotes",
		                  .unit = "\u00b0",
		                  .map = { .lo = 0, .hi = 180 },
		                  .tolerance = s->tolerance,
		                  .values = s->angles,
		                  .level = &s->level,
		                  .n = s->n_angles };
	if (st == ST_OK)
		st = work_figures(w, level_curves_figures(&c));
	if (st == ST_OK)
		st = work_output(w, ".isophote", level_curves_write, &c);
	if (st == ST_OK && work_flag(w, "svg"))
		st = work_output(w, ".isophote.svg", level_curves_draw, &c);
	return st;
}

static const struct worker_output isophotes_outputs[] = {
	{ ".isophote", "curves", NULL },
	{ ".isophote.svg", "picture", "svg" },
	{ .extension = NULL },
};

const struct worker worker = {
	.name = "isophotes",
	.title = "isophotes",
	.version = 3,
	.help = "Traces all curves on a surface along which the normal keeps its angle to the "
	        "light, as splines in u,v and in space with their checked error.",
	.scene = true,
	.params = isophotes_params,
	.outputs = isophotes_outputs,
	.begin = isophotes_begin,
	.units = level_work_units,
	.unit = level_work_unit,
	.finish = isophotes_finish,
	.end = isophotes_end,
};
