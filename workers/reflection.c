/* reflection.c - reflection lines, highlight lines and silhouettes: what an eye sees of light lines. */
#include <stdlib.h>
#include <string.h>

#include "camera.h"
#include "level_curves.h"
#include "level_work.h"

enum { LINES_MAX = 1000 };

enum kind { KIND_REFLECTION, KIND_HIGHLIGHT, KIND_SILHOUETTE, N_KINDS };

static const struct {
	const char *name, *title;
} kinds[N_KINDS] = {
	[KIND_REFLECTION] = { "reflection", "Reflection lines" },
	[KIND_HIGHLIGHT] = { "highlight", "Highlight lines" },
	[KIND_SILHOUETTE] = { "silhouette", "Silhouette" },
};

static const struct param reflection_params[] = {
	{ .name = "kind",
	  .type = PARAM_CHOICE,
	  .def = "reflection",
	  .choices = "reflection highlight silhouette",
	  .help = "where light lines are seen mirrored from the eye, where normals meet them, or "
	          "the outline seen from the eye" },
	PARAM_ROW_VIEW("three-quarter"),
	{ .name = "eye",
	  .type = PARAM_VECTOR,
	  .unit = "file",
	  .help = "where the eye stands (where not given: where a perspective picture of the view "
	          "is taken from; for the silhouette of an orthographic view: far away)" },
	{ .name = "point",
	  .type = PARAM_VECTOR,
	  .unit = "file",
	  .help = "a point of the middle light line (from the surfaces' centre towards the eye, as "
	          "far as they are long, where not given)" },
	{ .name = "direction",
	  .type = PARAM_VECTOR,
	  .help = "direction of the light lines, any length (level, square to the way to the eye, "
	          "where not given)" },
	{ .name = "across",
	  .type = PARAM_VECTOR,
	  .help = "direction from one light line to the next, any length (square to the lines and "
	          "to the way to the surfaces, where not given)" },
	{ .name = "count",
	  .type = PARAM_INTEGER,
	  .def = "11",
	  .min = 1,
	  .max = LINES_MAX,
	  .help = "how many light lines" },
	{ .name = "spacing",
	  .type = PARAM_REAL,
	  .min = 0,
	  .max = INFINITY,
	  .unit = "file",
	  .help = "distance from one light line to the next (an eighth of the diagonal of the "
	          "surfaces' box where not given)" },
	PARAM_ROWS_LEVEL_TOLERANCE,
	PARAM_ROW_TRIMMED,
	PARAM_ROW_GAP,
	PARAM_ROW_CREASE,
	PARAM_ROW_SVG,
	{ .name = NULL },
};

struct state {
	struct level_work level; /* first, as level_work.h asks */
	enum kind kind;
	int n;
	double *numbers; /* owned: 1, 2, ... of the light lines */
	double tolerance;
	struct box box;
};

static void reflection_end(struct work *w)
{
	struct state *s = w->state;
	if (!s)
		return;
	level_work_finish(&s->level);
	free(s->numbers);
	free(s);
	w->state = NULL;
}

static enum status no_memory(const struct work *w)
{
	return report_error(&w->report, ST_RESOURCE, "no memory for reflection lines");
}

static enum status box_read(const struct work *w, struct state *s)
{
	s->box = box_empty();
	for (int i = 0; i < w->n_surfaces; i++) {
		struct box one;
		if (surface_box(w->surfaces[i], 0, &one) != ST_OK)
			return no_memory(w);
		box_add_box(&s->box, &one);
	}
	if (!(box_diagonal(&s->box) > 0))
		return report_error(&w->report, ST_INPUT,
		                    "the surface is a single point and mirrors nothing; choose "
		                    "another entity");
	return ST_OK;
}

/* The eye, or for a silhouette from far away the direction of view. */
static enum status eye_read(const struct work *w, const struct state *s, struct level_field *f)
{
	enum { SIDE = 1000 };
	struct camera camera;
	if (work_has(w, "eye")) {
		f->eye = work_vector(w, "eye");
		return ST_OK;
	}
	const char *view = work_text(w, "view");
	const size_t n = strcspn(view, ":@");
	const char *angle = strchr(view, '@');
	char *seen = strstr(view, ":perspective") || s->kind != KIND_SILHOUETTE
	                     ? text_print("%.*s:perspective%s", (int)n, view, angle ? angle : "")
	                     : text_print("%s", view);
	if (!seen)
		return no_memory(w);
	enum status st = camera_fit(&camera, seen, &s->box, SIDE, SIDE, &w->report);
	free(seen);
	if (st != ST_OK)
		return st;
	f->eye = camera.eye;
	if (camera.kind == CAMERA_ORTHOGRAPHIC) {
		f->kind = LEVEL_SILHOUETTE;
		f->direction = camera.ahead;
	}
	return ST_OK;
}

/* The middle line, and the way from one to the next; f->eye is known. */
static enum status lines_read(const struct work *w, const struct state *s, struct level_field *f,
                              struct vec3 *step)
{
	const struct vec3 centre = box_center(&s->box), size = vec3_sub(s->box.hi, s->box.lo);
	const struct vec3 ahead = vec3_unit(vec3_sub(f->eye, centre));
	const double spacing =
	        work_has(w, "spacing") ? work_real(w, "spacing") : box_diagonal(&s->box) / 8;
	const bool above = hypot(ahead.x, ahead.y) < 1e-6;
	f->direction = work_has(w, "direction")
	                       ? work_vector(w, "direction")
	                       : vec3_unit(above ? vec3(1, 0, 0) : vec3(-ahead.y, ahead.x, 0));
	f->point = work_has(w, "point")
	                   ? work_vector(w, "point")
	                   : vec3_along(centre, fmax(size.x, fmax(size.y, size.z)), ahead);
	if (!(vec3_length(f->direction) > 0))
		return report_error(&w->report, ST_PARAMETER,
		                    "--direction: expected a direction, found no length");
	*step = work_has(w, "across") ? work_vector(w, "across")
	                              : vec3_cross(vec3_sub(f->point, centre), f->direction);
	if (s->n > 1 &&
	    !(vec3_length(vec3_cross(vec3_unit(*step), vec3_unit(f->direction))) > 1e-9))
		return report_error(&w->report, ST_PARAMETER,
		                    "the light lines lie one upon the other; give --across a "
		                    "direction that is not theirs");
	if (s->n > 1 && !(spacing > 0))
		return report_error(&w->report, ST_PARAMETER,
		                    "--spacing is 0; give a distance between the light lines");
	*step = vec3_scale(vec3_unit(*step), spacing);
	return ST_OK;
}

static enum status levels_begin(struct work *w, struct state *s)
{
	static const enum level_kind levels[N_KINDS] = {
		[KIND_REFLECTION] = LEVEL_REFLECTION,
		[KIND_HIGHLIGHT] = LEVEL_HIGHLIGHT,
		[KIND_SILHOUETTE] = LEVEL_EYE,
	};
	struct level_field first = { .kind = levels[s->kind], .direction = { 0, 0, 1 } };
	struct vec3 step = { 0, 0, 0 };
	enum status st = eye_read(w, s, &first);
	if (st == ST_OK && s->kind != KIND_SILHOUETTE)
		st = lines_read(w, s, &first, &step);
	if (st != ST_OK)
		return st;
	struct level_field *fields = calloc((size_t)s->n, sizeof *fields);
	s->numbers = malloc(sizeof *s->numbers * (size_t)s->n);
	if (!fields || !s->numbers) {
		free(fields);
		return no_memory(w);
	}
	for (int i = 0; i < s->n; i++) {
		s->numbers[i] = i + 1;
		fields[i] = first;
		fields[i].point = vec3_along(first.point, i - 0.5 * (s->n - 1), step);
	}
	st = level_work_init(&s->level, w, fields, s->numbers, s->n, s->tolerance);
	free(fields);
	return st;
}

static enum status reflection_begin(struct work *w)
{
	struct state *s = calloc(1, sizeof *s);
	w->state = s;
	if (!s)
		return no_memory(w);
	while (strcmp(kinds[s->kind].name, work_text(w, "kind")) != 0)
		s->kind++;
	s->n = s->kind == KIND_SILHOUETTE ? 1 : (int)work_integer(w, "count");
	s->tolerance = level_work_tolerance(w);
	enum status st = box_read(w, s);
	return st == ST_OK ? levels_begin(w, s) : st;
}

static enum status reflection_finish(struct work *w)
{
	struct state *s = w->state;
	enum status st = level_work_join(&s->level, w);
	struct level_curves c = { .work = w,
		                  .value_name = s->kind == KIND_SILHOUETTE ? NULL : "line",
		                  .title = kinds[s->kind].title,
		                  .unit = "",
		                  .map = { .lo = 0, .hi = s->n + 1 },
		                  .tolerance = s->tolerance,
		                  .values = s->numbers,
		                  .level = &s->level,
		                  .n = s->n };
	if (st == ST_OK)
		st = work_figures(w, level_curves_figures(&c));
	if (st == ST_OK)
		st = work_output(w, ".reflect", level_curves_write, &c);
	if (st == ST_OK && work_flag(w, "svg"))
		st = work_output(w, ".reflect.svg", level_curves_draw, &c);
	return st;
}

static const struct worker_output reflection_outputs[] = {
	{ ".reflect", "curves", NULL },
	{ ".reflect.svg", "picture", "svg" },
	{ .extension = NULL },
};

const struct worker worker = {
	.name = "reflection",
	.title = "reflection lines",
	.version = 3,
	.help = "Traces reflection lines, highlight lines or silhouettes of surfaces, as splines in "
	        "u,v and in space with their checked error.",
	.scene = true,
	.params = reflection_params,
	.outputs = reflection_outputs,
	.begin = reflection_begin,
	.units = level_work_units,
	.unit = level_work_unit,
	.finish = reflection_finish,
	.end = reflection_end,
};
