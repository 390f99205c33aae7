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

/* Jobs named, and what is asked of the service about them. */
struct steering {
	struct act *act;
	enum message_type type;
	const int64_t *ids; /* as given */
	bool *known;        /* each of them */
	int n;
	json_t *now, *waiting; /* those that it can be done to, and to those that wait */
};

/* What waits cannot be stopped or go on: it is held, or released. */
static void sort_job(struct steering *x, const struct Stats *s)
{
	const bool suspend = x->type == MESSAGE_SUSPEND, activate = x->type == MESSAGE_ACTIVATE;
	const bool waits = suspend ? s->state == JOB_QUEUED : activate && s->state == JOB_HELD;
	const bool can = suspend    ? s->state == JOB_RUNNING || s->state == JOB_STARTING
	                 : activate ? s->state == JOB_SUSPENDED
	                            : !job_state_table[s->state].over;

	if (can || waits)
		json_array_append_new(waits ? x->waiting : x->now, json_integer(s->id));
	else
		act_say(x->act, "%lld is %s already", (long long)s->id,
		        job_state_table[s->state].word);
}

static bool take_state(void *data, const struct Stats *s)
{
	struct steering *x = data;

	for (int k = 0; k < x->n; k++)
		if (x->ids[k] == s->id && !x->known[k]) {
			x->known[k] = true;
			sort_job(x, s);
		}
	return true;
}

/* list is stolen. */
static enum status ask_about(struct act *a, enum message_type type, json_t *list)
{
	if (json_array_size(list))
		return work_ask(a, type, json_pack("{s:o}", "jobs", list), say_job, a);
	json_decref(list);
	return ST_OK;
}

static enum status steer(struct steering *x)
{
	const enum message_type of_waiting =
	        x->type == MESSAGE_SUSPEND ? MESSAGE_HOLD : MESSAGE_RELEASE;
	enum status st =
	        work_ask(x->act, MESSAGE_LIST, json_pack("{s:b}", "all", 1), take_state, x);

	for (int k = 0; k < x->n; k++)
		if (!x->known[k]) /* the service says so */
			json_array_append_new(x->now, json_integer(x->ids[k]));
	if (st == ST_OK)
		st = ask_about(x->act, of_waiting, json_incref(x->waiting));
	if (st == ST_OK)
		st = ask_about(x->act, x->type, json_incref(x->now));
	return st;
}

enum status world_jobs(struct act *a, const struct arguments *given)
{
	const char *p = argument_text(given, "jobs"), *end = p + strlen(p);
	const size_t room = strlen(p) + 1;
	struct steering x = { .act = a,
		              .type = (enum message_type)a->routine->detail,
		              .known = calloc(room, sizeof *x.known),
		              .now = json_array(),
		              .waiting = json_array() };
	int64_t *ids = calloc(room, sizeof *ids);
	enum status st = ids && x.known ? ST_OK : act_memory(a);

	while (st == ST_OK && number_read_integer(&p, end, &ids[x.n])) {
		x.n++;
		p += *p == ',';
	}
	x.ids = ids;
	if (st == ST_OK && x.n)
		st = steer(&x);
	else if (st == ST_OK) /* all */
		st = work_ask(a, x.type, json_pack("{s:b}", "all", 1), say_job, a);
	json_decref(x.now);
	json_decref(x.waiting);
	free(x.known);
	free(ids);
	return st;
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
		                    "%d %s not saved; give unsaved=save, discard or keep", n,
		                    n == 1 ? "thing is" : "things are");
	if (n && !strcmp(unsaved, "save"))
		st = save_all(a);
	if (st == ST_OK && strcmp(jobs, "leave"))
		st = end_jobs(a, !strcmp(jobs, "kill") ? MESSAGE_KILL : MESSAGE_SUSPEND);
	if (st == ST_OK && n && !strcmp(unsaved, "discard"))
		world_discard(a->world);
	/* the journal goes on with what the next session does with it */
	a->quit = st == ST_OK && !(unsaved && !strcmp(unsaved, "keep"));
	return st;
}
