/* isophotes.c - curves on a surface along which the normal keeps its angle to the light. */
#include <stdlib.h>

#include "level.h"
#include "level_curves.h"
#include "worker.h"

/* A unit is a group of patches at one angle: enough of them that progress moves. */
enum { UNITS_WANTED = 400, ANGLES_MAX = 1000 };

/* Where no tolerance is given: this part of the surface's size. */
static const double tolerance_share = 1e-5;

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
	{ .name = "tolerance",
	  .type = PARAM_REAL,
	  .min = 0,
	  .max = INFINITY,
	  .unit = "file",
	  .help = "largest distance from the exact curve (1e-5 of the surface's size where not "
	          "given)" },
	PARAM_ROW_SVG,
	PARAM_ROW_VIEW("three-quarter"),
	{ .name = NULL },
};

struct isophotes {
	int n_angles;
	double *angles;        /* owned, degrees */
	struct level **levels; /* owned, one an angle; the others borrow from the first */
	size_t groups;         /* of patches */
	double tolerance;
	struct level_result *results; /* owned, one an angle; filled by finish */
};

static void isophotes_end(struct work *w)
{
	struct isophotes *s = w->state;
	if (!s)
		return;
	for (int i = s->n_angles; i-- > 0;) {
		if (s->results)
			level_result_finish(&s->results[i]);
		if (s->levels)
			level_destroy(s->levels[i]);
	}
	free(s->results);
	free(s->levels);
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
	s->levels = calloc(s->n_angles, sizeof *s->levels);
	s->results = calloc(s->n_angles, sizeof *s->results);
	if (!s->angles || !s->levels || !s->results)
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
	double size = surface_size(w->surfaces[0]);
	w->state = s;
	if (!s)
		return report_error(&w->report, ST_RESOURCE, "no memory for isophotes");
	if (!(size > 0))
		return report_error(&w->report, ST_INPUT,
		                    "the surface is a single point and has no isophotes; choose "
		                    "another entity");
	enum status st = angles_read(w, s);
	if (st == ST_OK)
		st = work_light(w, &light);
	s->tolerance =
	        work_has(w, "tolerance") ? work_real(w, "tolerance") : tolerance_share * size;
	for (int i = 0; st == ST_OK && i < s->n_angles; i++) {
		struct level_field f = { .kind = LEVEL_ISOPHOTE,
			                 .direction = light,
			                 .value = cos(s->angles[i] * M_PI / 180) };
		st = i == 0 ? level_create(&s->levels[0], w->surfaces[0], &f, s->tolerance,
		                           &w->report)
		            : level_create_like(&s->levels[i], s->levels[0], f.value, &w->report);
	}
	if (st != ST_OK)
		return st;
	size_t patches = level_patches(s->levels[0]);
	size_t wanted = (UNITS_WANTED + (size_t)s->n_angles - 1) / (size_t)s->n_angles;
	s->groups = patches < wanted ? patches : wanted;
	return ST_OK;
}

static size_t isophotes_units(const struct work *w)
{
	const struct isophotes *s = w->state;
	return s->groups * (size_t)s->n_angles;
}

static enum status isophotes_unit(struct work *w, size_t unit)
{
	const struct isophotes *s = w->state;
	const struct level *l = s->levels[unit / s->groups];
	size_t group = unit % s->groups, patches = level_patches(l);
	size_t end = (group + 1) * patches / s->groups;
	struct text bytes = { 0 };
	enum status st = ST_OK;
	for (size_t p = group * patches / s->groups; st == ST_OK && p < end; p++)
		st = work_cancelled(w) ? ST_CANCELLED : level_patch(l, p, &bytes);
	if (st == ST_OK)
		st = work_put(w, unit, bytes.s ? bytes.s : "", bytes.n);
	else if (st == ST_RESOURCE)
		st = report_error(&w->report, st, "no memory to trace isophotes");
	text_finish(&bytes);
	return st;
}

static enum status angle_join(struct work *w, int i)
{
	struct isophotes *s = w->state;
	const char **blocks = calloc(s->groups, sizeof *blocks);
	size_t *sizes = calloc(s->groups, sizeof *sizes);
	enum status st = blocks && sizes
	                         ? ST_OK
	                         : report_error(&w->report, ST_RESOURCE, "no memory for isophotes");
	for (size_t g = 0; st == ST_OK && g < s->groups; g++)
		st = work_get(w, (size_t)i * s->groups + g, &blocks[g], &sizes[g]);
	if (st == ST_OK)
		st = level_join(s->levels[i], blocks, sizes, s->groups, &s->results[i], &w->report);
	free(blocks);
	free(sizes);
	return st;
}

static enum status isophotes_finish(struct work *w)
{
	const struct isophotes *s = w->state;
	enum status st = ST_OK;
	for (int i = 0; st == ST_OK && i < s->n_angles; i++) {
		work_phase(w, "join", (size_t)i, (size_t)s->n_angles);
		st = work_cancelled(w) ? ST_CANCELLED : angle_join(w, i);
	}
	struct level_curves c = { .work = w,
		                  .value_name = "angle",
		                  .title = "Isophotes",
		                  .unit = "\u00b0",
		                  .map = { .lo = 0, .hi = 180 },
		                  .tolerance = s->tolerance,
		                  .values = s->angles,
		                  .results = s->results,
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
	.version = 1,
	.help = "Traces all curves on a surface along which the normal keeps its angle to the "
	        "light, as splines in u,v and in space with their checked error.",
	.params = isophotes_params,
	.outputs = isophotes_outputs,
	.begin = isophotes_begin,
	.units = isophotes_units,
	.unit = isophotes_unit,
	.finish = isophotes_finish,
	.end = isophotes_end,
};
