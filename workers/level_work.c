/* level_work.c - curves on surfaces cut into units, and put together again. */
#include "level_work.h"

#include <stdlib.h>
#include <string.h>

#include "box.h"

/* Borders this part of the size apart are one, where no gap is given. */
static const double gap_share = 1e-5;

/* Enough that progress moves. */
enum { UNITS_WANTED = 400 };

static const double tolerance_share = 1e-5;

double level_work_size(const struct work *w)
{
	double size = 0;
	for (int s = 0; s < w->n_surfaces; s++)
		size = fmax(size, surface_size(w->surfaces[s]));
	return size;
}

double level_work_tolerance(const struct work *w)
{
	return work_has(w, "tolerance") ? work_real(w, "tolerance")
	                                : tolerance_share * level_work_size(w);
}

void level_work_finish(struct level_work *l)
{
	for (size_t i = (size_t)l->n * l->n_surfaces; i-- > 0;) {
		if (l->results)
			level_result_finish(&l->results[i]);
		if (l->levels)
			level_destroy(l->levels[i]);
	}
	for (int i = 0; l->chains && i < l->n; i++)
		level_chains_finish(&l->chains[i]);
	level_faces_destroy(l->faces);
	free(l->chains);
	free(l->fields);
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

/* Do they differ in their value alone, and want the same prepared? */
static bool alike(const struct level_field *a, const struct level_field *b)
{
	return a->kind == b->kind && same(a->direction, b->direction) && same(a->point, b->point) &&
	       same(a->eye, b->eye) && level_oblique(a) == level_oblique(b);
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

/* How near borders must be to be one. */
static double gap_read(const struct work *w, double tolerance)
{
	struct box all = box_empty();
	if (work_has(w, "gap"))
		return work_real(w, "gap");
	for (int i = 0; i < w->n_surfaces; i++) {
		const struct surface *s = w->surfaces[i];
		for (int k = 0; k < s->n[0] * s->n[1]; k++)
			box_add_point(&all, surface_get_point(s, k / s->n[1], k % s->n[1], NULL));
	}
	return fmax(gap_share * box_diagonal(&all), 4 * tolerance);
}

static void warn_of_trims(const struct level_work *l, const struct work *w)
{
	int trimmed = 0;
	for (int s = 0; s < l->n_surfaces; s++)
		trimmed += w->entities[s]->trim.n > 0;
	if (trimmed > 0 && !l->trimmed)
		report_warning(&w->report,
		               "trims are ignored: the curves are those of %d whole surfaces",
		               l->n_surfaces);
}

static enum status faces_make(struct level_work *l, const struct work *w)
{
	struct level_face *faces = calloc((size_t)l->n_surfaces, sizeof *faces);
	if (!faces)
		return ST_RESOURCE;
	for (int i = 0; i < l->n_surfaces; i++) {
		faces[i].surface = w->surfaces[i];
		faces[i].trim = l->trimmed ? &w->entities[i]->trim : NULL;
	}
	enum status st = level_faces_create(&l->faces, faces, l->n_surfaces, l->gap);
	free(faces);
	return st;
}

enum status level_work_init(struct level_work *l, const struct work *w,
                            const struct level_field *fields, const double *names, int n,
                            double tolerance)
{
	const size_t all = (size_t)n * w->n_surfaces;
	*l = (struct level_work){ .n = n, .n_surfaces = w->n_surfaces };
	l->levels = calloc(all, sizeof *l->levels);
	l->results = calloc(all, sizeof *l->results);
	l->first = calloc((size_t)w->n_surfaces + 1, sizeof *l->first);
	l->heads = calloc((size_t)n, sizeof *l->heads);
	l->chains = calloc((size_t)n, sizeof *l->chains);
	l->fields = malloc(sizeof *fields * (size_t)n);
	if (!l->levels || !l->results || !l->first || !l->heads || !l->chains || !l->fields)
		return report_error(&w->report, ST_RESOURCE, "no memory for %d curves on surfaces",
		                    n);
	for (int i = 0; i < n; i++)
		l->heads[i] = (struct level_head){ fields[i].kind, names[i] };
	memcpy(l->fields, fields, sizeof *fields * (size_t)n);
	l->tolerance = tolerance;
	l->gap = gap_read(w, tolerance);
	l->trimmed = work_flag(w, "trimmed");
	warn_of_trims(l, w);
	enum status st = levels_create(l, w, fields, tolerance);
	size_t wanted = (UNITS_WANTED + all - 1) / all;
	for (int s = 0; st == ST_OK && s < w->n_surfaces; s++) {
		size_t patches = level_patches(l->levels[s]);
		l->first[s + 1] = l->first[s] + (patches < wanted ? patches : wanted);
	}
	return st;
}

size_t level_work_units(const struct work *w)
{
	const struct level_work *l = w->state;
	return l->first[l->n_surfaces] * (size_t)l->n;
}

static bool stop_asked(void *work)
{
	return work_cancelled(work);
}

enum status level_work_unit(struct work *w, size_t unit)
{
	const struct level_work *l = w->state;
	const size_t each = l->first[l->n_surfaces], place = unit % each;
	int s = 0;
	while (place >= l->first[s + 1])
		s++;
	const struct level *level = l->levels[unit / each * l->n_surfaces + s];
	const size_t groups = l->first[s + 1] - l->first[s], group = place - l->first[s];
	const size_t patches = level_patches(level), end = (group + 1) * patches / groups;
	const struct level_stop stop = { stop_asked, w };
	struct text bytes = { 0 };
	enum status st = ST_OK;
	level_head_add(&bytes, &l->heads[unit / each]);
	const size_t head = bytes.n;
	for (size_t p = group * patches / groups; st == ST_OK && p < end; p++)
		st = stop_asked(w) ? ST_CANCELLED : level_patch(level, p, &stop, &bytes);
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

/* In radians; the curves of planes and cylinders go over creases. */
static double crease_of(const struct level_work *l, const struct work *w)
{
	const enum level_kind kind = l->fields[0].kind;
	return kind == LEVEL_PLANE || kind == LEVEL_CYLINDER ? 0
	                                                     : work_real(w, "crease") * M_PI / 180;
}

/* The results of field i lose what trims cut away, and become chains over all surfaces. */
static enum status value_join(struct level_work *l, struct work *w, int i)
{
	const struct level_joining how = { &l->fields[i], l->tolerance,
		                           crease_of(l, w) * M_PI / 180 };
	struct level_result *x = l->results + (size_t)i * l->n_surfaces;
	enum status st = l->faces ? ST_OK : faces_make(l, w);
	for (int s = 0; st == ST_OK && s < l->n_surfaces; s++)
		st = work_cancelled(w) ? ST_CANCELLED
		                       : level_clip(l->faces, s, l->tolerance, &x[s]);
	if (st == ST_OK)
		st = level_chains_join(l->faces, &how, x, &l->chains[i]);
	if (st == ST_CANCELLED)
		return st;
	return st == ST_OK ? st : report_error(&w->report, st, "no memory to join curves");
}

enum status level_work_join(struct level_work *l, struct work *w)
{
	enum status st = ST_OK;
	for (int i = 0; st == ST_OK && i < l->n; i++) {
		work_phase(w, "join", (size_t)i, (size_t)l->n);
		for (int s = 0; st == ST_OK && s < l->n_surfaces; s++)
			st = work_cancelled(w) ? ST_CANCELLED : surface_join(l, w, i, s);
		if (st == ST_OK)
			st = value_join(l, w, i);
	}
	return st;
}
