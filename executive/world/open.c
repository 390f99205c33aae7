/* open.c - from a geometry file to things. */
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "path.h"
#include "text.h"
#include "world_private.h"

void world_stamp(const char *path, int64_t stamp[3])
{
	struct stat s = { 0 };

	stat(path, &s);
	stamp[0] = s.st_mtim.tv_sec;
	stamp[1] = s.st_mtim.tv_nsec;
	stamp[2] = s.st_size;
}

void world_set_reader(struct world *w, world_reader *read, void *data)
{
	w->read = read;
	w->read_data = data;
}

enum status world_read(const struct world *w, struct model *out, const char *path,
                       const struct progress *p, const struct report *r)
{
	return w->read ? w->read(w->read_data, out, path, p, r) : model_read(out, path, p, r);
}

static int count_numbered(const struct model *m)
{
	int n = 0;

	for (int k = 0; k < m->n; k++)
		n += m->entities[k].number > 0;
	return n;
}

static enum status add_trim(struct model *m, int surface, const struct curve *c)
{
	struct entity e;

	entity_init(&e, ENTITY_CURVE_ON_SURFACE);
	e.surface = surface;
	e.used = true;
	enum status st = curve_copy(&e.curve, c);
	return st == ST_OK ? model_add(m, &e) : st;
}

static enum status add_trims_of(struct model *m, int surface)
{
	enum status st = ST_OK;

	/* the entities move as the model grows */
	for (int i = 0; i < m->entities[surface].trim.n; i++)
		for (int c = 0; c < m->entities[surface].trim.loops[i].n && st == ST_OK; c++)
			st = add_trim(m, surface, &m->entities[surface].trim.loops[i].curves[c]);
	return st;
}

enum status world_add_trims(struct model *m)
{
	const int n = m->n;
	enum status st = ST_OK;

	for (int k = 0; k < n && st == ST_OK; k++)
		if (m->entities[k].kind == ENTITY_SURFACE)
			st = add_trims_of(m, k);
	return st;
}

/* Its place in the file as a name: hull, or hull-3 where the file holds several. */
static char *file_name_of(const char *basic, bool several, const struct entity *e)
{
	if (!several && e->number)
		return strdup(basic);
	if (e->number)
		return text_print("%s-%d", basic, e->number);
	if (e->de)
		return text_print("%s-D%d", basic, e->de);
	return text_print("%s-%s", basic, entity_kind_name(e->kind));
}

/* Mark in `chosen` what a list of selectors by comma names. */
static enum status choose(const struct model *m, const char *entities, bool *chosen,
                          const struct report *r)
{
	char *copy = strdup(entities), *rest = copy, *one;
	enum status st = copy ? ST_OK : out_of_memory(r);

	while (st == ST_OK && (one = strsep(&rest, ","))) {
		struct entity *e;
		st = model_find(m, one, &e, r);
		if (st == ST_OK)
			chosen[e - m->entities] = true;
	}
	free(copy);
	return st;
}

/* A curve on surface cannot be without its surface. */
static void choose_bases(const struct model *m, bool *chosen)
{
	for (int k = 0; k < m->n; k++)
		if (chosen[k] && m->entities[k].kind == ENTITY_CURVE_ON_SURFACE &&
		    m->entities[k].surface >= 0)
			chosen[m->entities[k].surface] = true;
}

/* The first of them is current; what was asked for is selected, not a surface that it needs. */
static void make_current(struct world *w, int before, int selected)
{
	for (int k = w->n - 1; k >= before; k--)
		thing_make_current(w, w->things[k]);
	if (thing_get(w, selected))
		thing_make_current(w, thing_get(w, selected));
}

static enum status take_one(struct world *w, struct model *m, int k, const char *path,
                            const char *basic, bool several, int *id)
{
	struct entity *e = &m->entities[k];
	char *wish = file_name_of(basic, several, e);
	struct Ful *f = NULL;
	enum status st = wish ? ful_create(w, &f, e) : ST_RESOURCE;

	if (st == ST_OK) {
		f->alone = !several && k == 0;
		f->saved = true;
		f->place = k;
		f->unit_in_mm = m->unit_in_mm;
		f->scale = m->scale;
		f->name = name_unique(w, wish);
		st = f->name ? model_set_text(&f->unit, m->unit) : ST_RESOURCE;
		if (st == ST_OK)
			st = model_set_text(&f->file, path);
		if (st == ST_OK) {
			world_stamp(path, f->stamp);
			*id = f->id;
			st = thing_append(w, f);
		} else
			ful_destroy(f);
	}
	free(wish);
	return st;
}

/* The things of a model that has been read, those of `chosen`; `first` of them was asked for first. Entities
 * are moved. */
static enum status take(struct world *w, struct model *m, const char *path, const bool *chosen,
                        int first, const struct report *r)
{
	const int before = w->n;
	const bool several = count_numbered(m) > 1;
	char *basic = path_basic_name(path);
	int *ids = calloc((size_t)m->n + 1, sizeof *ids),
	    *on = calloc((size_t)m->n + 1, sizeof *on);
	enum status st = basic && ids && on ? ST_OK : ST_RESOURCE;

	for (int k = 0; k < m->n && st == ST_OK; k++)
		on[k] = m->entities[k].surface; /* a thing keeps no place in a file */
	for (int k = 0; k < m->n && st == ST_OK; k++)
		if (chosen[k])
			st = take_one(w, m, k, path, basic, several, &ids[k]);
	for (int k = 0; k < m->n && st == ST_OK; k++)
		if (ids[k] && on[k] >= 0)
			thing_get(w, ids[k])->on = ids[on[k]];
	if (st != ST_OK)
		while (w->n > before)
			ful_destroy(w->things[--w->n]);
	if (st == ST_OK)
		make_current(w, before, ids[first]);
	w->revision++;
	free(basic);
	free(ids);
	free(on);
	return st == ST_OK ? st : out_of_memory(r);
}

/* The curves that trim a surface stand for it where curves on surfaces are wanted. */
static void choose_trims(const struct model *m, int first, bool given, bool *chosen)
{
	for (int k = first; k < m->n; k++)
		chosen[k] = !given || chosen[m->entities[k].surface];
	for (int k = 0; k < first; k++)
		for (int c = first; c < m->n && given && chosen[k]; c++)
			if (m->entities[c].surface == k)
				chosen[k] = false;
}

/* Those of the kinds wanted. Errors: ST_INPUT where there is none. */
static enum status choose_kinds(const struct model *m, unsigned kinds, bool given, bool *chosen,
                                const struct report *r)
{
	int n = 0;

	for (int k = 0; k < m->n; k++) {
		const struct entity *e = &m->entities[k];
		const bool wanted = kinds & 1u << e->kind;
		if (!given)
			chosen[k] |= wanted && e->number > 0;
		else if (chosen[k] && !wanted)
			return report_error(r, ST_INPUT, "entity %d of '%s' is a %s", e->number,
			                    m->file, entity_kind_name(e->kind));
		n += chosen[k];
	}
	return n ? ST_OK : report_error(r, ST_INPUT, "'%s' has no entity of that kind", m->file);
}

enum status world_open_kinds(struct world *w, const char *path, const char *entities,
                             unsigned kinds, const struct progress *p, const struct report *r)
{
	struct model m;
	char *full = path_absolute(path, w->folder);

	if (!full)
		return out_of_memory(r);
	enum status st = world_read(w, &m, full, p, r);
	if (st != ST_OK) {
		free(full);
		return st;
	}
	const bool trims = kinds == 1u << ENTITY_CURVE_ON_SURFACE;
	const int n = m.n;
	if (trims)
		st = world_add_trims(&m);
	bool *chosen = calloc((size_t)m.n + 1, sizeof *chosen);
	if (!chosen || st != ST_OK)
		st = out_of_memory(r);
	if (st == ST_OK && entities)
		st = choose(&m, entities, chosen, r);
	if (st == ST_OK && trims)
		choose_trims(&m, n, entities != NULL, chosen);
	if (st == ST_OK)
		st = choose_kinds(&m, kinds, entities != NULL, chosen, r);
	if (st == ST_OK) {
		int first = 0;
		while (!chosen[first]) /* choose_kinds has found one */
			first++;
		choose_bases(&m, chosen);
		st = take(w, &m, full, chosen, first, r);
	}
	for (int k = 0; k < m.n_warnings; k++)
		report_warning(r, "%s", m.warnings[k]);
	for (int k = 0; k < m.n_skipped; k++)
		report_warning(r, "skipped %d of type %d from D%d: %s", m.skipped[k].count,
		               m.skipped[k].type, m.skipped[k].first_de, m.skipped[k].reason);
	free(chosen);
	free(full);
	model_finish(&m);
	return st;
}

enum status world_open(struct world *w, const char *path, const char *entities,
                       const struct progress *p, const struct report *r)
{
	return world_open_kinds(w, path, entities, ~0u, p, r);
}
