/* surface_show.c - how surfaces are drawn, and results read from files. */
#include <stdlib.h>
#include <string.h>

#include "exr.h"
#include "path.h"
#include "private.h"

enum status surface_resolution(struct act *a, const struct arguments *given)
{
	int *ids, n = work_meant(a, given, &ids);
	enum status st = n ? ST_OK : ST_PARAMETER;

	for (int k = 0; k < n && st == ST_OK; k++) {
		struct display d = world_by_id(a->world, ids[k])->display;
		d.lines_u = (int)argument_number(given, "lines_u", d.lines_u);
		d.lines_v = (int)argument_number(given, "lines_v", d.lines_v);
		d.segments = (int)argument_number(given, "segments", d.segments);
		st = world_set_display(a->world, ids[k], &d);
	}
	free(ids);
	return st;
}

enum status surface_on(struct act *a, const struct arguments *given)
{
	const struct Ful *f = act_current(a, false);

	if (!f)
		return ST_PARAMETER;
	struct display d = f->display;
	d.on = argument_yes(given, "on", true);
	return world_set_display(a->world, f->id, &d);
}

enum status image_on(struct act *a, const struct arguments *given)
{
	world_sight(a->world)->no_image = !argument_yes(given, "on", true);
	world_touch(a->world);
	return ST_OK;
}

enum status surface_light(struct act *a, const struct arguments *given)
{
	struct sight *s = world_sight(a->world);
	enum status st = setting_store(a, given);

	if (st != ST_OK)
		return st;
	s->light_azimuth = argument_number(given, "azimuth", s->light_azimuth);
	s->light_incidence = argument_number(given, "incidence", s->light_incidence);
	s->light_intensity = argument_number(given, "intensity", s->light_intensity);
	world_touch(a->world);
	return ST_OK;
}

/* Is it an image that can be read, with that channel? Its path is fresh. */
static enum status find_image(const struct act *a, const char *name, const char *channel,
                              char **path)
{
	struct exr_picture p;
	bool found = false;

	*path = act_path(a, name);
	if (!*path)
		return act_memory(a);
	enum status st = exr_read_attributes(&p, *path, &a->report);
	if (st == ST_OK) {
		for (int k = 0; k < p.n_channels; k++)
			found |= !strcmp(p.names[k], channel);
		exr_picture_finish(&p);
		if (!found)
			st = report_error(&a->report, ST_INPUT,
			                  "'%s' has no channel %s; expected %s", name, channel,
			                  a->routine->arguments->help);
	}
	if (st != ST_OK) {
		free(*path);
		*path = NULL;
	}
	return st;
}

/* Show a file, which is moved in. */
static enum status show_file(struct act *a, const struct overlay *like, char *path)
{
	struct overlay o = *like;

	o.file = path;
	work_seen(a->world, like->kind);
	enum status st = world_show(a->world, &o) == ST_OK ? ST_OK : act_memory(a);
	free(path);
	return st;
}

enum status surface_image(struct act *a, const struct arguments *given)
{
	char *path;
	enum status st = find_image(a, argument_text(given, "file"), "R", &path);

	return st == ST_OK ? show_file(a, &(struct overlay){ .kind = OVERLAY_IMAGE }, path) : st;
}

enum status surface_map_file(struct act *a, const struct arguments *given)
{
	const struct Ful *f = act_current(a, false);
	char *path;

	if (!f)
		return ST_PARAMETER;
	enum status st = find_image(a, argument_text(given, "file"), "K", &path);
	if (st != ST_OK)
		return st;
	struct display d = f->display;
	d.look = LOOK_MAP;
	st = show_file(a,
	               &(struct overlay){ .kind = OVERLAY_MAP,
	                                  .thing = f->id,
	                                  .symmetric = true,
	                                  .scale = COLORMAP_AUTOMATIC },
	               path);
	return st == ST_OK ? world_set_display(a->world, f->id, &d) : st;
}

/* Lines of all that are shown, as one scene? */
static bool is_of_shown(struct act *a, const struct model *m)
{
	const char *made_of = model_get_attribute(m, "input_hash");
	int *ids, n = work_scene(a, &ids);
	char hash[33];
	const bool is = made_of && n > 1 && work_hash(a->world, ids, n, hash) == ST_OK &&
	                !strcmp(hash, made_of);

	free(ids);
	return is;
}

enum status surface_lines_file(struct act *a, const struct arguments *given)
{
	const struct Ful *f = act_current(a, false);
	const char *name = argument_text(given, "file");
	struct model m;

	if (!f)
		return ST_PARAMETER;
	char *path = act_path(a, name);
	if (!path)
		return act_memory(a);
	enum status st = model_read(&m, path, NULL, &a->report);
	if (st == ST_OK) {
		const int thing = is_of_shown(a, &m) ? 0 : f->id;
		act_say(a, "%s: %d entities", path_file_name(path), m.n);
		model_finish(&m);
		return show_file(a, &(struct overlay){ .kind = OVERLAY_LINES, .thing = thing },
		                 path);
	}
	free(path);
	return st;
}
