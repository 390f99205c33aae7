/* umbilic_points.c - where kmax = kmin on a worker's surfaces, as figures and in its file. */
#include "umbilic_points.h"

#include <stdlib.h>

#include "json.h"

enum { TOLD_MAX = 1000 };

/* They do not depend on the value: the first one's level has looked for all. */
static const struct level_result *result_of(const struct level_work *l, int surface)
{
	return level_work_result(l, 0, surface);
}

static bool is_point(const struct level_umbilic *x)
{
	return x->kind == LEVEL_UMBILIC_POINT;
}

/* What there is to say of each of one sort, in a word or a number. */
struct words {
	struct text kinds, curvatures, halves;
};

static enum status words_set(struct entity *e, const struct level_result *x, bool points)
{
	struct words w = { { 0 }, { 0 }, { 0 } };
	const char *between = "";
	for (size_t i = 0; i < x->n_umbilics; i++) {
		const struct level_umbilic *u = &x->umbilics[i];
		if (is_point(u) != points)
			continue;
		text_addf(&w.kinds, "%s%s", between, level_umbilic_names[u->kind]);
		text_add(&w.curvatures, between);
		text_add_number(&w.curvatures, u->curvature);
		text_addf(&w.halves, "%s%d", between, u->halves);
		between = " ";
	}
	enum status st =
	        w.kinds.failed || w.curvatures.failed || w.halves.failed ? ST_RESOURCE : ST_OK;
	if (st == ST_OK && !points)
		st = entity_set_attribute(e, "kinds", w.kinds.s);
	if (st == ST_OK && points)
		st = entity_set_attribute(e, "curvatures", w.curvatures.s);
	if (st == ST_OK && points)
		st = entity_set_attribute(e, "halves", w.halves.s);
	text_finish(&w.kinds);
	text_finish(&w.curvatures);
	text_finish(&w.halves);
	return st;
}

static enum status sort_add(const struct level_work *l, int surface, bool points, struct model *m)
{
	const struct level_result *x = result_of(l, surface);
	struct entity e;
	size_t n = 0;
	for (size_t i = 0; i < x->n_umbilics; i++)
		n += is_point(&x->umbilics[i]) == points;
	if (n == 0)
		return ST_OK;
	entity_init(&e, ENTITY_POINTS);
	enum status st = ST_RESOURCE;
	e.points.dimension = 2;
	e.points.values = malloc(sizeof *e.points.values * 4 * n);
	if (e.points.values) {
		double *to = e.points.values;
		e.points.n = (int)(points ? n : 2 * n);
		for (size_t i = 0; i < x->n_umbilics; i++) {
			const struct level_umbilic *u = &x->umbilics[i];
			if (is_point(u) != points)
				continue;
			for (int k = points ? 2 : 0; k < (points ? 3 : 2); k++)
				for (int d = 0; d < 2; d++)
					*to++ = k == 2 ? u->at[d] : k ? u->hi[d] : u->lo[d];
		}
		st = entity_set_attribute(&e, "umbilics", points ? "points" : "corners of boxes");
	}
	if (st == ST_OK)
		st = words_set(&e, x, points);
	if (st == ST_OK && l->n_surfaces > 1) {
		struct text t = { 0 };
		text_addf(&t, "%d", surface + 1);
		st = t.failed ? ST_RESOURCE : entity_set_attribute(&e, "surface", t.s);
		text_finish(&t);
	}
	if (st == ST_OK)
		st = model_add(m, &e);
	entity_finish(&e);
	return st;
}

enum status umbilic_points_add(const struct level_work *l, struct model *m)
{
	enum status st = ST_OK;
	for (int s = 0; st == ST_OK && s < l->n_surfaces; s++) {
		st = sort_add(l, s, true, m);
		if (st == ST_OK)
			st = sort_add(l, s, false, m);
	}
	return st;
}

void umbilic_points_set(const struct level_work *l, json_t *figures)
{
	size_t number[N_LEVEL_UMBILIC_KINDS] = { 0 };
	json_t *points = json_array();
	for (int s = 0; s < l->n_surfaces; s++) {
		const struct level_result *x = result_of(l, s);
		for (size_t i = 0; i < x->n_umbilics; i++) {
			const struct level_umbilic *u = &x->umbilics[i];
			number[u->kind]++;
			if (!is_point(u) || number[u->kind] > TOLD_MAX)
				continue;
			json_t *row = json_object();
			if (l->n_surfaces > 1)
				json_set_int(row, "surface", s + 1);
			json_set_number(row, "u", u->at[0]);
			json_set_number(row, "v", u->at[1]);
			json_set_number(row, "curvature", u->curvature);
			json_set_number(row, "index", 0.5 * u->halves);
			json_array_append_new(points, row);
		}
	}
	json_set_int(figures, "umbilics", (int64_t)number[LEVEL_UMBILIC_POINT]);
	json_set_int(figures, "umbilic_regions", (int64_t)number[LEVEL_UMBILIC_REGION]);
	json_set_int(figures, "umbilic_undecided", (int64_t)number[LEVEL_UMBILIC_UNDECIDED]);
	json_object_set_new(figures, "umbilic_points", points);
}
