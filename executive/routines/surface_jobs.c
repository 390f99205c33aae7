/* surface_jobs.c - leaves that start workers on surfaces, and show what they made. */
#include <stdlib.h>
#include <string.h>

#include "number.h"
#include "path.h"
#include "private.h"
#include "text.h"

/* A worker on all surfaces shown; its result belongs to the one there is, or to none. */
static enum status run_scene(struct act *a, const struct arguments *given, const char *suffix,
                             const struct overlay *like)
{
	int *ids, n = work_scene(a, &ids);
	json_t *parameters = work_parameters(given);
	struct work_done done;
	enum status st = n ? work_run(a, a->routine->worker, parameters, ids, n, suffix, &done)
	                   : ST_PARAMETER;

	if (st == ST_OK) {
		const int thing = like->kind == OVERLAY_IMAGE || n > 1 ? 0 : ids[0];
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

/* A worker on the current surface. */
static enum status run_current(struct act *a, json_t *parameters, const char *worker,
                               const struct overlay *like)
{
	const struct Ful *f = act_current(a, false);
	struct work_done done;

	if (!f)
		return ST_PARAMETER;
	const int id = f->id;
	enum status st = work_run(a, worker, parameters, &id, 1, NULL, &done);
	if (st == ST_OK) {
		st = work_show(a, &done.job, id, like);
		work_done_finish(&done);
	}
	return st;
}

static enum status look_at_map(struct act *a)
{
	const struct Ful *f = world_current(a->world, false);
	struct display d = f->display;

	d.look = LOOK_MAP;
	d.on = true;
	return world_set_display(a->world, f->id, &d);
}

enum status job_lines(struct act *a, const struct arguments *given)
{
	const struct overlay like = { .kind = OVERLAY_LINES };

	if (!strcmp(a->routine->worker, "reflection"))
		return run_scene(a, given, NULL, &like);
	json_t *parameters = work_parameters(given);
	enum status st = run_current(a, parameters, a->routine->worker, &like);
	json_decref(parameters);
	return st;
}

enum status job_curvature(struct act *a, const struct arguments *given)
{
	json_t *parameters = work_parameters(given);
	enum status st =
	        run_current(a, parameters, "curvature",
	                    &(struct overlay){ .kind = OVERLAY_MAP, .scale = COLORMAP_AUTOMATIC });

	json_decref(parameters);
	if (st == ST_OK) {
		world_sight(a->world)->all_curvatures = true;
		st = look_at_map(a);
	}
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

enum status surface_quantity(struct act *a, const struct arguments *given)
{
	const struct Ful *f = act_current(a, false);
	struct overlay o = { .kind = OVERLAY_MAP };
	enum status st = f ? take_key(a, given, &o) : ST_PARAMETER;

	if (st != ST_OK)
		return st;
	char *map = find_map(a, f);
	if (map) {
		o.thing = f->id;
		o.file = map;
		st = world_show(a->world, &o) == ST_OK ? ST_OK : act_memory(a);
	} else {
		json_t *parameters = json_object();
		const char *grid = world_default(a->world, "curvature", "grid");
		if (grid)
			json_object_set_new(parameters, "grid", json_string(grid));
		st = run_current(a, parameters, "curvature", &o);
		json_decref(parameters);
	}
	free(map);
	if (st == ST_OK) {
		world_sight(a->world)->all_curvatures = false;
		st = look_at_map(a);
	}
	if (st == ST_OK)
		act_say(a, "%s of %s", quantity_table[o.quantity].title,
		        world_current(a->world, false)->name);
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
		st = world_show(
		        a->world,
		        &(struct overlay){ .kind = OVERLAY_LINES, .thing = thing, .file = path });
	free(path);
	return st;
}

enum status surface_show_lines(struct act *a, const struct arguments *given)
{
	const struct Ful *f = act_current(a, false);

	if (!f)
		return ST_PARAMETER;
	if (!a->routine->detail)
		return show_result(a, given, &f->id, 1, ".isophote", "isophotes", "V90");
	int *ids, n = work_scene(a, &ids);
	enum status st = show_result(a, given, ids, n, ".reflect", "reflection", "V94");
	free(ids);
	return st;
}

enum status contours_show(struct act *a, const struct arguments *given)
{
	const bool cylinders = a->routine->detail;
	int *ids, n = work_scene(a, &ids);

	enum status st = show_result(a, given, ids, n, cylinders ? ".cylinder.contour" : ".contour",
	                             "contours", cylinders ? "V170" : "V168");
	free(ids);
	return st;
}
