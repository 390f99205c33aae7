/* level_work.c - curves on surfaces cut into units, and put together again. */
#include "level_work.h"

#include <stdlib.h>

/* Enough that progress moves. */
enum { UNITS_WANTED = 400 };

static const double tolerance_share = 1e-5;

double level_work_tolerance(const struct work *w)
{
	double size = 0;
	for (int s = 0; s < w->n_surfaces; s++)
		size = fmax(size, surface_size(w->surfaces[s]));
	return work_has(w, "tolerance") ? work_real(w, "tolerance") : tolerance_share * size;
}

void level_work_finish(struct level_work *l)
{
	for (size_t i = (size_t)l->n * l->n_surfaces; i-- > 0;) {
		if (l->results)
			level_result_finish(&l->results[i]);
		if (l->levels)
			level_destroy(l->levels[i]);
	}
	free(l->results);
	free(l->levels);
	free(l->first);
	free(l->heads);
	*l = (struct level_work){ .n = 0 };
}

static bool same(struct vec3 a, struct vec3 b)
{
	return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Do they differ in their value alone? */
static bool alike(const struct level_field *a, const struct level_field *b)
{
	return a->kind == b->kind && same(a->direction, b->direction) && same(a->point, b->point) &&
	       same(a->eye, b->eye);
}

static enum status levels_create(struct level_work *l, const struct work *w,
                                 const struct level_field *fields, double tolerance)
{
	enum status st = ST_OK;
	const double uv = work_real(w, "tolerance-uv");
	int base = 0; /* whom the others borrow from */
	for (int i = 0; i < l->n; i++) {
		struct level **row = l->levels + (size_t)i * l->n_surfaces;
		struct level **from = l->levels + (size_t)base * l->n_surfaces;
		bool like = i > 0 && alike(&fields[i], &fields[base]);
		if (!like)
			base = i;
		for (int s = 0; st == ST_OK && s < l->n_surfaces; s++) {
			st = like ? level_create_like(&row[s], from[s], fields[i].value, &w->report)
			          : level_create(&row[s], w->surfaces[s], &fields[i], tolerance,
			                         &w->report);
			if (st == ST_OK && uv > 0)
				st = level_set_tolerance_uv(row[s], uv, &w->report);
		}
	}
	return st;
}

enum status level_work_init(struct level_work *l, const struct work *w,
                            const struct level_field *fields, const double *names, int n,
                            double tolerance)
{
	const size_t all = (size_t)n * w->n_surfaces;
	int trimmed = 0;
	for (int s = 0; s < w->n_surfaces; s++)
		trimmed += w->entities[s]->trim.n > 0;
	if (trimmed)
		report_warning(&w->report,
		               "trims are ignored: the curves are those of %d whole surfaces",
		               w->n_surfaces);
	*l = (struct level_work){ .n = n, .n_surfaces = w->n_surfaces };
	l->levels = calloc(all, sizeof *l->levels);
	l->results = calloc(all, sizeof *l->results);
	l->first = calloc((size_t)w->n_surfaces + 1, sizeof *l->first);
	l->heads = calloc((size_t)n, sizeof *l->heads);
	if (!l->levels || !l->results || !l->first || !l->heads)
		return report_error(&w->report, ST_RESOURCE, "no memory for %d curves on surfaces",
		                    n);
	for (int i = 0; i < n; i++)
		l->heads[i] = (struct level_head){ fields[i].kind, names[i] };
	enum status st = levels_create(l, w, fields, tolerance);
	size_t wanted = (UNITS_WANTED + all - 1) / all;
	for (int s = 0; st == ST_OK && s < w->n_surfaces; s++) {
		size_t patches = level_patches(l->levels[s]);
		l->first[s + 1] = l->first[s] + (patches < wanted ? patches : wanted);
	}
	return st;
}

size_t level_work_units(const struct level_work *l)
{
	return l->first[l->n_surfaces] * (size_t)l->n;
}

enum status level_work_unit(const struct level_work *l, struct work *w, size_t unit)
{
	const size_t each = l->first[l->n_surfaces], place = unit % each;
	int s = 0;
	while (place >= l->first[s + 1])
		s++;
	const struct level *level = l->levels[unit / each * l->n_surfaces + s];
	const size_t groups = l->first[s + 1] - l->first[s], group = place - l->first[s];
	const size_t patches = level_patches(level), end = (group + 1) * patches / groups;
	struct text bytes = { 0 };
	enum status st = ST_OK;
	level_head_add(&bytes, &l->heads[unit / each]);
	const size_t head = bytes.n;
	for (size_t p = group * patches / groups; st == ST_OK && p < end; p++)
		st = work_cancelled(w) ? ST_CANCELLED : level_patch(level, p, &bytes);
	if (st == ST_OK && bytes.failed)
		st = ST_RESOURCE;
	if (st == ST_OK)
		st = work_put(w, unit, bytes.s, bytes.n > head ? bytes.n : 0);
	else if (st == ST_RESOURCE)
		st = report_error(&w->report, st, "no memory to trace curves");
	text_finish(&bytes);
	return st;
}

static enum status surface_join(struct level_work *l, struct work *w, int i, int s)
{
	const size_t groups = l->first[s + 1] - l->first[s];
	const size_t unit = (size_t)i * l->first[l->n_surfaces] + l->first[s];
	const size_t at = (size_t)i * l->n_surfaces + s;
	const char **blocks = calloc(groups, sizeof *blocks);
	size_t *sizes = calloc(groups, sizeof *sizes);
	enum status st =
	        blocks && sizes ? ST_OK
	                        : report_error(&w->report, ST_RESOURCE, "no memory to join curves");
	for (size_t g = 0; st == ST_OK && g < groups; g++) {
		st = work_get(w, unit + g, &blocks[g], &sizes[g]);
		size_t head = st == ST_OK ? level_head_size(blocks[g], sizes[g]) : 0;
		if (head) {
			blocks[g] += head;
			sizes[g] -= head;
		}
	}
	if (st == ST_OK)
		st = level_join(l->levels[at], blocks, sizes, groups, &l->results[at], &w->report);
	free(blocks);
	free(sizes);
	return st;
}

enum status level_work_join(struct level_work *l, struct work *w)
{
	enum status st = ST_OK;
	for (int i = 0; st == ST_OK && i < l->n; i++) {
		work_phase(w, "join", (size_t)i, (size_t)l->n);
		for (int s = 0; st == ST_OK && s < l->n_surfaces; s++)
			st = work_cancelled(w) ? ST_CANCELLED : surface_join(l, w, i, s);
	}
	return st;
}
