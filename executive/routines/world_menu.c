/* world_menu.c - the World menu: background, what is current, jobs, perspective, the bell; and QUIT. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "message.h"
#include "number.h"
#include "private.h"

enum status world_background(struct act *a, const struct arguments *given)
{
	struct sight *s = world_sight(a->world);

	s->has_background = argument_color(given, "color", &s->background);
	world_touch(a->world);
	return ST_OK;
}

enum status world_choose(struct act *a, const struct arguments *given)
{
	const char *name =
	        argument_text(given, a->routine->detail == ENTITY_SURFACE ? "surface" : "curve");
	const struct Ful *f = world_find(a->world, name, &a->report);

	return f ? world_select(a->world, f->id, &a->report) : ST_PARAMETER;
}

enum status world_bell(struct act *a, const struct arguments *given)
{
	world_sight(a->world)->bell = argument_yes(given, "on", true);
	world_touch(a->world);
	return ST_OK;
}

enum status world_split(struct act *a, const struct arguments *given)
{
	struct sight *s = world_sight(a->world);
	const char *views = argument_text(given, "views");

	for (int k = 0; k < N_SPLITS; k++)
		if (!strcmp(views, view_split_words[k]))
			s->split = (enum view_split)k;
	s->all_curvatures = false;
	world_touch(a->world);
	return ST_OK;
}

static bool say_job(void *data, const struct Stats *s)
{
	const double fraction = stats_fraction(s);
	char share[16] = "";

	if (fraction == fraction && !job_state_table[s->state].over)
		snprintf(share, sizeof share, " %.0f %%", 100 * fraction);
	act_say(data, "%lld %s%s %s %s%s%s", (long long)s->id, job_state_table[s->state].word,
	        share, s->worker, s->file_name ? s->file_name : "", s->reason ? ": " : "",
	        s->reason ? s->reason : "");
	return true;
}

enum status world_list_jobs(struct act *a, const struct arguments *given)
{
	(void)given;
	return work_ask(a, MESSAGE_LIST, json_pack("{s:b}", "all", 1), say_job, a);
}

enum status world_jobs(struct act *a, const struct arguments *given)
{
	const char *p = argument_text(given, "jobs"), *end = p + strlen(p);
	json_t *ids = json_array();
	int64_t id;

	if (!strcmp(p, "all")) {
		json_decref(ids);
		return work_ask(a, (enum message_type)a->routine->detail,
		                json_pack("{s:b}", "all", 1), say_job, a);
	}
	while (number_read_integer(&p, end, &id)) {
		json_array_append_new(ids, json_integer(id));
		p += *p == ',';
	}
	return work_ask(a, (enum message_type)a->routine->detail, json_pack("{s:o}", "jobs", ids),
	                say_job, a);
}

/* Middle of what is shown, and half its diagonal. */
static double shown_middle(const struct world *w, struct vec3 *middle)
{
	struct box box = box_empty();

	for (int k = 0; k < world_count(w); k++) {
		struct box one;
		if (world_at(w, k)->display.on &&
		    entity_box(&world_at(w, k)->entity, &one) == ST_OK)
			box_add_box(&box, &one);
	}
	if (box_is_empty(&box))
		return 0;
	*middle = vec3_scale(vec3_add(box.lo, box.hi), 0.5);
	return box_diagonal(&box) / 2;
}

/* What is in the middle keeps its size, whatever the angle. */
static void set_field(struct camera *c, bool orthographic, double tangent, struct vec3 middle,
                      double radius)
{
	const double away = vec3_dot(vec3_sub(middle, c->eye), c->ahead);
	const double half = c->kind == CAMERA_PERSPECTIVE ? c->half * fmax(away, 0) : c->half;
	const struct vec3 centre = vec3_along(c->eye, away, c->ahead);

	if (!(half > 0))
		return;
	c->kind = orthographic ? CAMERA_ORTHOGRAPHIC : CAMERA_PERSPECTIVE;
	c->half = orthographic ? half : tangent;
	c->eye = vec3_along(centre, orthographic ? -2 * radius : -half / tangent, c->ahead);
}

enum status world_perspective(struct act *a, const struct arguments *given)
{
	struct sight *s = world_sight(a->world);
	const double field = argument_number(given, "field", 30);
	const double nearest = argument_number(given, "near", 0),
	             far = argument_number(given, "far", 0);
	struct vec3 middle = vec3(0, 0, 0);
	const double radius = shown_middle(a->world, &middle);

	if (far > 0 && far <= nearest)
		return report_error(&a->report, ST_PARAMETER, "far must be beyond near, or 0");
	if (!s->has_camera) {
		static const char *const name[] = { "view" }, *const value[] = { "three-quarter" };
		const struct arguments view = { (const char **)(size_t)name,
			                        (const char **)(size_t)value, 1 };
		enum status st = show_view(a, &view);
		if (st != ST_OK)
			return st;
	}
	set_field(&s->camera, argument_yes(given, "orthographic", false), tan(field * M_PI / 360),
	          middle, radius);
	s->near_ = nearest;
	s->far_ = far;
	world_touch(a->world);
	return ST_OK;
}

static enum status save_all(struct act *a)
{
	enum status st = ST_OK;

	for (int k = 0; k < world_count(a->world) && st == ST_OK; k++)
		if (!world_at(a->world, k)->saved)
			st = world_save(a->world, world_at(a->world, k)->id, NULL, &a->report);
	return st;
}

static int count_unsaved(const struct world *w)
{
	int n = 0;

	for (int k = 0; k < world_count(w); k++)
		n += !world_at(w, k)->saved;
	return n;
}

/* Jobs that are not over. */
static bool add_alive(void *data, const struct Stats *s)
{
	if (s->state == JOB_RUNNING || s->state == JOB_STARTING || s->state == JOB_QUEUED)
		json_array_append_new(data, json_integer(s->id));
	return true;
}

static enum status end_jobs(struct act *a, enum message_type how)
{
	json_t *ids = json_array();
	enum status st = work_ask(a, MESSAGE_LIST, json_pack("{s:b}", "all", 1), add_alive, ids);

	if (st == ST_OK && json_array_size(ids))
		st = work_ask(a, how, json_pack("{s:O}", "jobs", ids), NULL, NULL);
	json_decref(ids);
	return st;
}

enum status world_quit(struct act *a, const struct arguments *given)
{
	const char *unsaved = argument_text(given, "unsaved"), *jobs = argument_text(given, "jobs");
	const int n = count_unsaved(a->world);
	enum status st = ST_OK;

	if (n && !unsaved)
		return report_error(&a->report, ST_PARAMETER,
		                    "%d %s not saved; give unsaved=save or unsaved=discard", n,
		                    n == 1 ? "thing is" : "things are");
	if (n && !strcmp(unsaved, "save"))
		st = save_all(a);
	if (st == ST_OK && strcmp(jobs, "leave"))
		st = end_jobs(a, !strcmp(jobs, "kill") ? MESSAGE_KILL : MESSAGE_SUSPEND);
	if (st == ST_OK && n && !strcmp(unsaved, "discard"))
		world_discard(a->world);
	a->quit = st == ST_OK;
	return st;
}
