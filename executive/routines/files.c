/* files.c - opening, saving, exporting, naming, closing; undo and redo. */
#include <stdlib.h>
#include <string.h>

#include "model_write.h"
#include "path.h"
#include "private.h"
#include "text.h"

static void on_progress(void *data, double fraction)
{
	struct act *a = data;

	if (a->progress)
		a->progress(a->data, fraction, "reading");
}

/* The thing named, else the one selected last. */
static const struct Ful *named(const struct act *a, const struct arguments *given)
{
	const char *name = argument_text(given, "name");
	const struct Ful *f =
	        name ? world_find(a->world, name, &a->report) : world_selected(a->world);

	if (!f && !name)
		report_error(&a->report, ST_PARAMETER, "nothing is open");
	return f;
}

/* "hull.igs: 3 surfaces, 2 curves" */
void opened_say(struct act *a, const char *file, int before)
{
	static const char *const many[N_ENTITY_KINDS] = {
		[ENTITY_CURVE] = "curves",
		[ENTITY_SURFACE] = "surfaces",
		[ENTITY_CURVE_ON_SURFACE] = "curves on surfaces",
		[ENTITY_POINTS] = "point lists",
	};
	static const enum entity_kind order[] = { ENTITY_SURFACE, ENTITY_CURVE,
		                                  ENTITY_CURVE_ON_SURFACE, ENTITY_POINTS };
	int n[N_ENTITY_KINDS] = { 0 };
	struct text t = { 0 };

	for (int k = before; k < world_count(a->world); k++)
		n[world_at(a->world, k)->entity.kind]++;
	for (size_t k = 0; k < sizeof order / sizeof *order; k++)
		if (n[order[k]])
			text_addf(&t, "%s%d %s", t.n ? ", " : "", n[order[k]],
			          n[order[k]] == 1 ? entity_kind_name(order[k]) : many[order[k]]);
	if (world_count(a->world) == before + 1)
		act_say(a, "%s: %s", world_at(a->world, before)->name, t.s ? t.s + 2 : "");
	else if (world_count(a->world) > before)
		act_say(a, "%s: %s", path_file_name(file), t.s ? t.s : "");
	text_finish(&t);
}

enum status files_open(struct act *a, const struct arguments *given)
{
	const int before = world_count(a->world);
	const struct progress p = { on_progress, a, a->stop };
	const char *entity = argument_text(given, "entity");
	if (entity && !strcmp(entity, "all"))
		entity = NULL;
	enum status st = world_open(a->world, argument_text(given, "file"), entity, &p, &a->report);

	opened_say(a, argument_text(given, "file"), before);
	return st;
}

enum status files_save(struct act *a, const struct arguments *given)
{
	const struct Ful *f = named(a, given);

	if (!f)
		return ST_PARAMETER;
	enum status st = world_save(a->world, f->id, NULL, &a->report);
	if (st == ST_OK)
		act_say(a, "saved as %s", path_file_name(world_by_id(a->world, f->id)->file));
	return st;
}

enum status files_save_as(struct act *a, const struct arguments *given)
{
	const struct Ful *f = world_selected(a->world);
	const char *name = argument_text(given, "name");
	enum status st = ST_OK;

	if (!f)
		return report_error(&a->report, ST_PARAMETER, "nothing is open");
	const int id = f->id;
	char *file = text_print("%s.base", name), *path = file ? act_path(a, file) : NULL;
	free(file);
	if (!path)
		return act_memory(a);
	if (path_exists(path) && !argument_yes(given, "overwrite", false))
		st = report_error(&a->report, ST_PARAMETER,
		                  "'%s' is there already; give overwrite=yes, or another name",
		                  path_file_name(path));
	if (st == ST_OK)
		st = world_rename(a->world, id, name, &a->report);
	if (st == ST_OK && (st = world_save(a->world, id, path, &a->report)) != ST_OK)
		world_undo(a->world, NULL);
	if (st == ST_OK)
		act_say(a, "saved as %s", path_file_name(path));
	free(path);
	return st;
}

enum status files_rename(struct act *a, const struct arguments *given)
{
	const struct Ful *f = world_selected(a->world);

	return f ? world_rename(a->world, f->id, argument_text(given, "name"), &a->report)
	         : report_error(&a->report, ST_PARAMETER, "nothing is open");
}

/* It, or a curve on it, is not saved. */
static bool is_unsaved(const struct world *w, const struct Ful *f)
{
	for (int k = 0; k < world_count(w); k++) {
		const struct Ful *x = world_at(w, k);
		if ((x == f || x->on == f->id) && !x->saved)
			return true;
	}
	return false;
}

enum status files_close(struct act *a, const struct arguments *given)
{
	const struct Ful *f = named(a, given);

	if (!f)
		return ST_PARAMETER;
	if (is_unsaved(a->world, f) && !argument_yes(given, "discard", false))
		return report_error(&a->report, ST_PARAMETER,
		                    "'%s' is not saved; save it, or give discard=yes", f->name);
	char *what = text_print("close %s", f->name);
	enum status st = what ? world_remove(a->world, what, f->id, &a->report) : act_memory(a);
	free(what);
	return st;
}

/* Ids of the things named by comma, of all, or (NULL) of the one selected last; *ids is fresh. */
static enum status list_things(const struct act *a, const char *names, int **ids, int *n)
{
	const struct Ful *selected = world_selected(a->world);
	const bool all = names && !strcmp(names, "all");
	size_t room = (size_t)world_count(a->world) + 1;
	enum status st = ST_OK;

	for (const char *p = names; p && *p; p++)
		room += *p == ',';
	*n = 0;
	*ids = calloc(room, sizeof **ids);
	char *copy = names ? strdup(names) : NULL, *rest = copy, *one;
	if (!*ids || (names && !copy))
		st = act_memory(a);
	while (st == ST_OK && names && !all && (one = strsep(&rest, ","))) {
		const struct Ful *f = world_find(a->world, one, &a->report);
		if (f)
			(*ids)[(*n)++] = f->id;
		else
			st = ST_PARAMETER;
	}
	if (st == ST_OK && !names && selected)
		(*ids)[(*n)++] = selected->id;
	for (int k = 0; k < world_count(a->world) && all && st == ST_OK; k++)
		(*ids)[(*n)++] = world_at(a->world, k)->id;
	free(copy);
	return st;
}

/* Of the model only what the format can hold; how many were left out. */
static enum status keep_what_fits(struct model *m, const struct model_format *format, int *left_out)
{
	struct model kept;
	enum status st;

	*left_out = 0;
	if (format->all)
		return ST_OK;
	model_init(&kept);
	kept.unit_in_mm = m->unit_in_mm;
	kept.scale = m->scale;
	st = model_set_text(&kept.unit, m->unit);
	for (int k = 0; k < m->n && st == ST_OK; k++) {
		struct entity *e = &m->entities[k];
		if (e->used)
			continue;
		if (format->takes(e)) {
			e->surface = -1;
			st = model_add(&kept, e);
		} else
			++*left_out;
	}
	model_finish(m);
	*m = kept;
	model_number(m);
	return st;
}

enum status files_export(struct act *a, const struct arguments *given)
{
	char *path = act_path(a, argument_text(given, "to"));
	const struct model_format *format = path ? model_format_find(path, &a->report) : NULL;
	const struct mesh_wishes wishes = { 0 };
	struct mesh_figures figures = { 0 };
	struct model m;
	int *ids = NULL, n = 0, left_out = 0;
	enum status st =
	        format ? list_things(a, argument_text(given, "entities"), &ids, &n) : ST_PARAMETER;

	if (st == ST_OK)
		st = world_model(a->world, ids, n, &m, &a->report);
	if (st == ST_OK) {
		st = keep_what_fits(&m, format, &left_out);
		if (st != ST_OK)
			act_memory(a);
		else if (!m.n)
			st = report_error(&a->report, ST_PARAMETER,
			                  "'%s' holds %s, and nothing named is that",
			                  path_file_name(path), format->holds);
		if (st == ST_OK && left_out)
			report_warning(&a->report, "%d left out: '%s' holds %s", left_out,
			               path_file_name(path), format->holds);
		if (st == ST_OK)
			st = model_write(&m, format, path, &wishes, &figures, &a->report);
		if (st == ST_OK)
			act_say(a, "%s: %d entities", path_file_name(path), m.n);
		model_finish(&m);
	}
	mesh_figures_finish(&figures);
	free(ids);
	free(path);
	return st;
}

enum status files_picture(struct act *a, const struct arguments *given)
{
	double width = 0, height = 0;

	if (!a->picture)
		return report_error(&a->report, ST_RESOURCE,
		                    "there is no view to make a picture of; use batten-editor");
	argument_pair(argument_text(given, "size"), 'x', &width, &height);
	char *path = act_path(a, argument_text(given, "to"));
	const struct picture_wish wish = { .path = path,
		                           .view = argument_text(given, "view"),
		                           .beside = argument_text(given, "beside"),
		                           .views = argument_text(given, "views"),
		                           .width = (int)width,
		                           .height = (int)height };
	enum status st = path ? a->picture(a->world, &wish, &a->report) : act_memory(a);
	if (st == ST_OK)
		act_say(a, "picture in %s", path_file_name(path));
	free(path);
	return st;
}

enum status files_undo(struct act *a, const struct arguments *given)
{
	char *name = strdup(world_undo_name(a->world) ? world_undo_name(a->world) : "");
	enum status st = name ? world_undo(a->world, &a->report) : act_memory(a);

	(void)given;
	if (st == ST_OK)
		act_say(a, "undone: %s", name);
	free(name);
	return st;
}

enum status files_redo(struct act *a, const struct arguments *given)
{
	char *name = strdup(world_redo_name(a->world) ? world_redo_name(a->world) : "");
	enum status st = name ? world_redo(a->world, &a->report) : act_memory(a);

	(void)given;
	if (st == ST_OK)
		act_say(a, "done again: %s", name);
	free(name);
	return st;
}
