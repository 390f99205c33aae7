/* surface_jobs.c - leaves that start workers on surfaces, and show what they made. */
#include <stdlib.h>
#include <string.h>

#include "number.h"
#include "path.h"
#include "private.h"
#include "text.h"

/* Those of each alone, where they take their place as one scene. */
static void hide_isophotes(struct world *w, const int *ids, int n)
{
	for (int k = world_overlays(w) - 1; k >= 0; k--) {
		const struct overlay *o = world_overlay(w, k);
		bool among = false;
		for (int i = 0; i < n; i++)
			among |= o->thing == ids[i];
		if (among && o->kind == OVERLAY_LINES && o->file &&
		    path_has_suffix(o->file, ".isophote"))
			world_hide(w, OVERLAY_LINES, o->thing);
	}
}

/* A worker on surfaces as one scene; its result belongs to the one there is, or to none. */
static enum status run_scene(struct act *a, const struct arguments *given, const char *suffix,
                             const struct overlay *like)
{
	int *ids, n = work_meant(a, given, &ids);
	json_t *parameters = work_parameters(given);
	struct work_done done;
	enum status st = n ? work_run(a, a->routine->worker, parameters, ids, n, suffix, &done)
	                   : ST_PARAMETER;

	if (st == ST_OK) {
		const int thing = like->kind == OVERLAY_IMAGE || n > 1 ? 0 : ids[0];
		if (!thing && !strcmp(a->routine->worker, "isophotes"))
			hide_isophotes(a->world, ids, n);
		st = work_show(a, &done.job, thing, like);
		work_done_finish(&done);
	}
	json_decref(parameters);
	free(ids);
	return st;
}

enum status job_image(struct act *a, const struct arguments *given)
{
	return run_scene(a, given, NULL, &(struct overlay){ .kind = OVERLAY_IMAGE });
}

enum status job_contours(struct act *a, const struct arguments *given)
{
	return run_scene(a, given, a->routine->detail ? ".cylinder" : NULL,
	                 &(struct overlay){ .kind = OVERLAY_LINES });
}

/* A worker on one surface. */
static enum status run_one(struct act *a, json_t *parameters, const char *worker, int id,
                           const struct overlay *like)
{
	struct work_done done;
	enum status st = work_run(a, worker, parameters, &id, 1, NULL, &done);

	if (st == ST_OK) {
		st = work_show(a, &done.job, id, like);
		work_done_finish(&done);
	}
	return st;
}

static enum status look_at_map(struct act *a, int id)
{
	struct display d = world_by_id(a->world, id)->display;

	d.look = LOOK_MAP;
	d.on = true;
	return world_set_display(a->world, id, &d);
}

enum status job_lines(struct act *a, const struct arguments *given)
{
	return run_scene(a, given, NULL, &(struct overlay){ .kind = OVERLAY_LINES });
}

enum status job_curvature(struct act *a, const struct arguments *given)
{
	const struct overlay like = { .kind = OVERLAY_MAP, .scale = COLORMAP_AUTOMATIC };
	json_t *parameters = work_parameters(given);
	int *ids, n = work_meant(a, given, &ids);
	enum status st = n ? ST_OK : ST_PARAMETER;

	for (int k = 0; k < n && st == ST_OK; k++) {
		st = run_one(a, parameters, a->routine->worker, ids[k], &like);
		if (st == ST_OK)
			st = look_at_map(a, ids[k]);
	}
	if (st == ST_OK)
		world_sight(a->world)->all_curvatures = true;
	json_decref(parameters);
	free(ids);
	return st;
}

/* Range, scale and symmetry of the key. */
static enum status take_key(const struct act *a, const struct arguments *given, struct overlay *o)
{
	const char *range = argument_text(given, "range"), *scale = argument_text(given, "scale");

	o->quantity = (enum quantity)a->routine->detail;
	o->scale = !scale || !strcmp(scale, "auto") ? COLORMAP_AUTOMATIC
	           : !strcmp(scale, "linear")       ? COLORMAP_LINEAR
	                                            : COLORMAP_ARSINH;
	o->symmetric =
	        quantity_table[o->quantity].is_signed && argument_yes(given, "symmetric", true);
	if (!range || !strcmp(range, "auto"))
		return ST_OK;
	o->range_given = true;
	if (!argument_pair(range, ',', &o->lo, &o->hi) || !(o->lo < o->hi))
		return report_error(&a->report, ST_PARAMETER,
		                    "range is '%s'; it must be LO,HI with LO below HI, or auto",
		                    range);
	return ST_OK;
}

/* The map that is there already, of the grid that is wanted: NULL, or fresh. */
static char *find_map(const struct act *a, const struct Ful *f)
{
	const char *wanted = world_default(a->world, "curvature", "grid");
	char hash[33], *grid = NULL, *path = NULL;
	char *name = work_name(a, &f->id, 1, ".map.exr");
	const bool current = name && path_exists(name) &&
	                     work_hash(a->world, &f->id, 1, hash) == ST_OK &&
	                     work_is_current(name, "curvature", hash, &grid);

	if (current && (!wanted || (grid && !strcmp(wanted, grid))))
		path = strdup(name);
	free(grid);
	free(name);
	return path;
}

/* A job is making it: what has come is shown in another quantity. */
static bool show_arriving(struct act *a, int id, struct overlay *o)
{
	for (int k = 0; k < world_overlays(a->world); k++) {
		const struct overlay *there = world_overlay(a->world, k);
		if (there->kind != OVERLAY_MAP || there->thing != id || !there->job)
			continue;
		char *file = strdup(there->file);
		o->job = there->job;
		o->file = file;
		const bool shown = file && world_show(a->world, o) == ST_OK;
		free(file);
		o->job = 0;
		o->file = NULL;
		return shown;
	}
	return false;
}

static enum status show_quantity(struct act *a, int id, const struct overlay *like)
{
	const char *grid = world_default(a->world, "curvature", "grid");
	struct overlay o = *like;
	enum status st;

	o.thing = id;
	o.file = find_map(a, world_by_id(a->world, id));
	if (o.file) {
		st = world_show(a->world, &o) == ST_OK ? ST_OK : act_memory(a);
		free(o.file);
	} else if (!a->wait && show_arriving(a, id, &o)) {
		st = ST_OK;
	} else {
		json_t *parameters = json_object();
		if (grid)
			json_object_set_new(parameters, "grid", json_string(grid));
		st = run_one(a, parameters, "curvature", id, &o);
		json_decref(parameters);
	}
	return st == ST_OK ? look_at_map(a, id) : st;
}

enum status surface_quantity(struct act *a, const struct arguments *given)
{
	struct overlay o = { .kind = OVERLAY_MAP };
	int *ids, n = work_meant(a, given, &ids);
	enum status st = n ? take_key(a, given, &o) : ST_PARAMETER;

	for (int k = 0; k < n && st == ST_OK; k++)
		st = show_quantity(a, ids[k], &o);
	if (st == ST_OK) {
		work_seen(a->world, OVERLAY_MAP);
		world_sight(a->world)->all_curvatures = false;
		if (n == 1)
			act_say(a, "%s of %s", quantity_table[o.quantity].title,
			        world_by_id(a->world, *ids)->name);
		else
			act_say(a, "%s of %d surfaces", quantity_table[o.quantity].title, n);
	}
	free(ids);
	return st;
}

/* Show lines that a worker made, where they lie under their name. */
static enum status show_result(struct act *a, const struct arguments *given, const int *ids, int n,
                               const char *suffix, const char *worker, const char *code)
{
	char hash[33], *path = n ? work_name(a, ids, n, suffix) : NULL;
	const int thing = n > 1 ? 0 : n ? ids[0] : 0;
	enum status st = ST_OK;

	if (!n)
		return ST_PARAMETER;
	if (!path)
		return act_memory(a);
	if (!argument_yes(given, "on", true)) {
		world_hide(a->world, OVERLAY_LINES, thing);
		free(path);
		return ST_OK;
	}
	if (!path_exists(path))
		st = report_error(&a->report, ST_INPUT, "'%s' is not there; %s computes it",
		                  path_file_name(path), code);
	if (st == ST_OK)
		st = work_hash(a->world, ids, n, hash);
	if (st == ST_OK && !work_is_current(path, worker, hash, NULL))
		report_warning(&a->report,
		               "'%s' was not made of what is open now; %s computes it anew",
		               path_file_name(path), code);
	if (st == ST_OK)
		work_seen(a->world, OVERLAY_LINES);
	if (st == ST_OK)
		st = world_show(
		        a->world,
		        &(struct overlay){ .kind = OVERLAY_LINES, .thing = thing, .file = path });
	free(path);
	return st;
}

static bool has_result(const struct act *a, int id, const char *suffix)
{
	char *path = work_name(a, &id, 1, suffix);
	const bool there = path && path_exists(path);

	free(path);
	return there;
}

static bool is_of_scene(const struct act *a, const int *ids, int n)
{
	char hash[33], *path = work_name(a, ids, n, ".isophote");
	const bool is = path && path_exists(path) && work_hash(a->world, ids, n, hash) == ST_OK &&
	                work_is_current(path, "isophotes", hash, NULL);

	free(path);
	return is;
}

/* Of several surfaces those of them as one scene, else of those that have some alone. */
static enum status show_isophotes(struct act *a, const struct arguments *given, const int *ids,
                                  int n)
{
	enum status st = ST_OK;
	int some = 0;

	if (n > 1)
		hide_isophotes(a->world, ids, n);
	if (n == 1 || !argument_yes(given, "on", true) || is_of_scene(a, ids, n))
		return show_result(a, given, ids, n, ".isophote", "isophotes", "V90");
	for (int k = 0; k < n && st == ST_OK; k++)
		if (has_result(a, ids[k], ".isophote")) {
			st = show_result(a, given, &ids[k], 1, ".isophote", "isophotes", "V90");
			some++;
		}
	return some || st != ST_OK ? st
	                           : show_result(a, given, ids, n, ".isophote", "isophotes", "V90");
}

enum status surface_show_lines(struct act *a, const struct arguments *given)
{
	const bool reflection = a->routine->detail;
	int *ids, n = work_meant(a, given, &ids);
	enum status st = n ? ST_OK : ST_PARAMETER;

	if (n && reflection)
		st = show_result(a, given, ids, n, ".reflect", "reflection", "V94");
	else if (n)
		st = show_isophotes(a, given, ids, n);
	free(ids);
	return st;
}

enum status contours_show(struct act *a, const struct arguments *given)
{
	const bool cylinders = a->routine->detail;
	int *ids, n = work_meant(a, given, &ids);

	enum status st = show_result(a, given, ids, n, cylinders ? ".cylinder.contour" : ".contour",
	                             "contours", cylinders ? "V170" : "V168");
	free(ids);
	return st;
}
