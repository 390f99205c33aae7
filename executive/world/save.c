/* save.c - things as a model for writers, and saved as .base. */
#include <stdlib.h>
#include <string.h>

#include "base.h"
#include "path.h"
#include "text.h"
#include "world_private.h"

static enum status same_unit(const struct Ful *first, const struct Ful *f, const struct report *r)
{
	if (first->unit_in_mm == f->unit_in_mm && first->scale == f->scale)
		return ST_OK;
	return report_error(r, ST_PARAMETER,
	                    "'%s' is in %s, '%s' in %s; one file has one unit, write them to two",
	                    first->name, first->unit ? first->unit : "an unknown unit", f->name,
	                    f->unit ? f->unit : "an unknown unit");
}

static enum status add_thing(struct model *m, const struct Ful *f, bool used)
{
	struct entity e;
	enum status st = entity_copy(&e, &f->entity);

	e.used = used;
	return st == ST_OK ? model_add(m, &e) : st;
}

/* Place among the entities of the thing `id`, of those `n` ids; -1: not there. */
static int place_of(const int *ids, int n, int id)
{
	for (int k = 0; k < n; k++)
		if (ids[k] == id)
			return k;
	return -1;
}

enum status world_model(const struct world *w, const int *ids, int n, struct model *out,
                        const struct report *r)
{
	int *all = malloc(2 * ((size_t)n + 1) * sizeof *all), n_all = n;
	enum status st = all ? ST_OK : ST_RESOURCE;
	bool said = false;

	model_init(out);
	if (st == ST_OK)
		memcpy(all, ids, (size_t)n * sizeof *all);
	for (int k = 0; k < n_all && st == ST_OK; k++) {
		const struct Ful *f = thing_get(w, all[k]);
		if (!f) {
			st = thing_missing(all[k], r);
			said = true;
			break;
		}
		if (k)
			said = (st = same_unit(thing_get(w, all[0]), f, r)) != ST_OK;
		if (f->on && place_of(all, n_all, f->on) < 0)
			all[n_all++] = f->on;
		if (st == ST_OK)
			st = add_thing(out, f, k >= n);
	}
	for (int k = 0; k < n_all && st == ST_OK; k++)
		out->entities[k].surface = place_of(all, n_all, thing_get(w, all[k])->on);
	if (st == ST_OK && n_all) {
		const struct Ful *f = thing_get(w, all[0]);
		out->unit_in_mm = f->unit_in_mm;
		out->scale = f->scale;
		st = model_set_text(&out->unit, f->unit);
	}
	free(all);
	if (st == ST_OK)
		model_number(out);
	else
		model_finish(out);
	return st == ST_OK || said ? st : out_of_memory(r);
}

/* Where a thing is saved that is not told where. Fresh. */
static enum status own_path(const struct world *w, const struct Ful *f, char **out,
                            const struct report *r)
{
	char *basic = f->file ? path_basic_name(f->file) : NULL;
	const bool own =
	        basic && f->alone && path_has_suffix(f->file, ".base") && !strcmp(basic, f->name);

	free(basic);
	if (own) {
		*out = strdup(f->file);
		return *out ? ST_OK : out_of_memory(r);
	}
	char *name = text_print("%s.base", f->name);
	*out = name ? path_join(w->folder, name) : NULL;
	free(name);
	if (!*out)
		return out_of_memory(r);
	if (!path_exists(*out))
		return ST_OK;
	report_error(
	        r, ST_PARAMETER,
	        "'%s' is there already and was not made of this thing; save under another name",
	        path_file_name(*out));
	free(*out);
	return ST_PARAMETER;
}

enum status world_save(struct world *w, int id, const char *path, const struct report *r)
{
	struct Ful *f = thing_get(w, id);
	struct model m;
	char *full = NULL;

	if (!f)
		return thing_missing(id, r);
	enum status st = ST_OK;
	if (!path)
		st = own_path(w, f, &full, r);
	else if (!(full = path_absolute(path, w->folder)))
		st = out_of_memory(r);
	if (st != ST_OK)
		return st;
	st = world_model(w, &id, 1, &m, r);
	if (st == ST_OK) {
		st = base_write(&m, full, r);
		model_finish(&m);
	}
	if (st == ST_OK) {
		free(f->file);
		f->file = full;
		full = NULL;
		f->alone = f->saved = true;
		f->entity.number = 1;
		f->entity.de = f->place = 0;
		history_saved(w, f);
		w->revision++;
	}
	free(full);
	return st;
}

void world_discard(struct world *w)
{
	for (int k = w->n - 1; k >= 0; k--) {
		struct Ful *f = w->things[k];
		if (f->saved)
			continue;
		f->saved = f->file != NULL;
		if (f->saved)
			continue;
		thing_take_out(w, k);
		ful_destroy(f);
	}
	history_finish(&w->undo);
	history_finish(&w->redo);
	thing_mend_current(w);
	w->revision++;
}
