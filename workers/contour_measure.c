/* contour_measure.c - curves of one plane become figures, with mirror images and holes. */
#include "contour_measure.h"

#include <math.h>
#include <stdlib.h>

/* Relative; far below what tracing leaves. */
static const double accuracy = 1e-10;

/* A border: sides in a row. */
struct figure {
	const struct section_side *sides;
	int n;
	struct section section;
};

struct figures {
	struct figure *list; /* owned */
	size_t n;
	struct section_side *borders; /* owned: the curves of all chains in order */
	struct section_side *sides;   /* owned: each side, and its mirror image or none */
	struct curve *mirrors;        /* owned, one a side */
	size_t n_mirrors;
};

static void figures_finish(struct figures *f)
{
	for (size_t i = 0; i < f->n_mirrors; i++)
		curve_finish(&f->mirrors[i]);
	free(f->mirrors);
	free(f->sides);
	free(f->borders);
	free(f->list);
}

static enum status mirror_make(struct figures *f, const struct curve *c)
{
	struct curve *m = &f->mirrors[f->n_mirrors];
	enum status st = curve_copy(m, c);
	if (st != ST_OK)
		return st;
	f->n_mirrors++;
	for (int i = 0; i < m->n; i++)
		m->points[4 * i + 1] = -m->points[4 * i + 1];
	return ST_OK;
}

static void figure_add(struct figures *f, const struct section_side *sides, size_t n)
{
	f->list[f->n++] = (struct figure){ .sides = sides, .n = (int)n };
}

/*
 * A curve and its mirror image: two figures where it is closed; else one, the image running back,
 * with straight lines from end to end of both: across the keel, the deck, the transom.
 */
static enum status mirrored_add(struct figures *f, const struct section_side *sides, size_t n,
                                bool closed, struct section_side *at)
{
	for (size_t i = 0; i < n; i++) {
		enum status st = mirror_make(f, sides[i].curve);
		if (st != ST_OK)
			return st;
		const struct curve *m = &f->mirrors[f->n_mirrors - 1];
		at[i] = sides[i];
		at[2 * n - 1 - i] = (struct section_side){ m, !sides[i].reversed };
	}
	figure_add(f, at, closed ? n : 2 * n);
	if (closed)
		figure_add(f, at + n, n);
	return ST_OK;
}

static enum status figures_make(struct figures *f, const struct level_work *l, int value,
                                const struct contour_set *set, bool half)
{
	const struct level_chains *c = &l->chains[value];
	size_t n = 0;
	for (size_t i = 0; i < c->n; i++)
		n += c->list[i].n;
	f->borders = malloc(sizeof *f->borders * (n + 1));
	const bool by_name = set->kind < CONTOUR_PLANES;
	const bool mirrored = half && by_name && set->kind != CONTOUR_BUTTOCKS;
	f->list = calloc(2 * c->n + 1, sizeof *f->list);
	f->sides = calloc(2 * n + 1, sizeof *f->sides);
	f->mirrors = calloc(n + 1, sizeof *f->mirrors);
	if (!f->list || !f->borders || !f->sides || !f->mirrors)
		return ST_RESOURCE;
	for (size_t i = 0; i < n; i++) {
		const struct level_part *p = &c->parts[i];
		const struct level_result *x = level_work_result(l, value, p->face);
		f->borders[i] = (struct section_side){ &x->branches[p->branch].space, p->reversed };
	}
	enum status st = ST_OK;
	for (size_t i = 0; st == ST_OK && i < c->n; i++) {
		const struct level_chain *one = &c->list[i];
		const struct section_side *sides = f->borders + one->first;
		if (!by_name && !one->closed)
			continue;
		if (mirrored)
			st = mirrored_add(f, sides, one->n, one->closed, f->sides + 2 * one->first);
		else
			figure_add(f, sides, one->n);
	}
	return st;
}

/* Is figure i a hole: inside an odd number of others? */
static enum status hole_find(const struct figures *f, size_t i, struct vec3 normal, bool *hole)
{
	const struct curve *c = f->list[i].sides[0].curve;
	const struct vec3 p = curve_point(c, 0.5 * (c->domain[0] + c->domain[1]));
	*hole = false;
	for (size_t k = 0; k < f->n; k++) {
		int turns = 0;
		enum status st =
		        k == i ? ST_OK
		               : section_winding(f->list[k].sides, f->list[k].n, normal, p, &turns);
		if (st != ST_OK)
			return st;
		*hole ^= turns % 2 != 0;
	}
	return ST_OK;
}

static enum status figures_sum(struct contour_measure *out, struct figures *f, struct vec3 normal,
                               const struct section_lid *lid)
{
	struct vec3 moment = { 0, 0, 0 };
	for (size_t i = 0; i < f->n; i++) {
		struct section *s = &f->list[i].section;
		bool hole;
		enum status st =
		        section_measure(f->list[i].sides, f->list[i].n, normal, lid, accuracy, s);
		if (st == ST_OK)
			st = hole_find(f, i, normal, &hole);
		if (st != ST_OK)
			return st;
		const double sign = (s->area < 0) == hole ? 1 : -1;
		out->area += sign * s->area;
		moment = vec3_along(moment, sign, s->moment);
		out->girth += s->girth;
	}
	out->known = f->n > 0;
	if (out->area != 0)
		out->centroid = vec3_scale(moment, 1 / out->area);
	return ST_OK;
}

enum status contour_measure(struct contour_measure *out, const struct level_work *l, int i,
                            const struct contour_set *set, bool half, const struct section_lid *lid)
{
	struct figures f = { .n = 0 };
	*out = (struct contour_measure){ .centroid = { NAN, NAN, NAN } };
	if (set->kind == CONTOUR_CYLINDERS)
		return ST_OK;
	enum status st = figures_make(&f, l, i, set, half);
	if (st == ST_OK)
		st = figures_sum(out, &f, set->field.direction,
		                 set->kind == CONTOUR_STATIONS ? lid : NULL);
	figures_finish(&f);
	return st;
}
