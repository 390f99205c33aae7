/* level_umbilics.c - the umbilics of all patches: found once each, boxes that touch as one. */
#include <stdlib.h>
#include <string.h>

#include "level_private.h"

/* Two on sides of patches so near each other, of the size, are one. */
#define SAME_SHARE 1e-7

/* So near a side, of the patch, is on it. */
#define ON_SIDE 1e-7

const char *const level_umbilic_names[N_LEVEL_UMBILIC_KINDS] = {
	[LEVEL_UMBILIC_POINT] = "point",
	[LEVEL_UMBILIC_REGION] = "region",
	[LEVEL_UMBILIC_UNDECIDED] = "undecided",
};

/* One that is on the side of a patch may be another patch's, too. */
struct point {
	struct level_umbilic x;
	struct vec3 p;
	bool on_side;
};

static enum status point_make(const struct level_surface *s, const struct patch_umbilic *u,
                              struct point *out)
{
	double p[3];
	*out = (struct point){ .x = { .kind = LEVEL_UMBILIC_POINT, .halves = u->x.turn },
		               .on_side = u->x.kind == UMBILIC_POLE };
	level_globalise(s, u->patch, u->x.lo, out->x.lo);
	level_globalise(s, u->patch, u->x.hi, out->x.hi);
	level_globalise(s, u->patch, u->x.at, out->x.at);
	level_point_at(s, out->x.at, p);
	out->p = vec3_of(p);
	for (int d = 0; d < 2; d++)
		out->on_side |= u->x.at[d] < ON_SIDE || u->x.at[d] > 1 - ON_SIDE;
	return level_mean_at(s, u->patch, u->x.at, &out->x.curvature);
}

static bool same(const struct level_surface *s, const struct point *a, const struct point *b)
{
	return a->on_side && b->on_side && a->x.halves == b->x.halves &&
	       vec3_length(vec3_sub(a->p, b->p)) <= SAME_SHARE * s->net.size;
}

static enum status points_add(const struct joint *j, struct list *out)
{
	const struct level_surface *s = j->level->surface;
	const struct patch_umbilic *all = j->umbilics.p;
	struct list points = { 0 };
	enum status st = ST_OK;
	for (size_t i = 0; st == ST_OK && i < j->umbilics.n; i++) {
		struct point one;
		bool known = false;
		if (all[i].x.kind != UMBILIC_ONE && all[i].x.kind != UMBILIC_POLE)
			continue;
		st = point_make(s, &all[i], &one);
		for (size_t k = 0; st == ST_OK && k < points.n && !known; k++)
			known = same(s, (const struct point *)points.p + k, &one);
		if (st != ST_OK || known)
			continue;
		struct point *kept = list_next(&points, sizeof *kept);
		struct level_umbilic *to = kept ? list_next(out, sizeof *to) : NULL;
		if (!to) {
			st = ST_RESOURCE;
			break;
		}
		*kept = one;
		*to = one.x;
	}
	list_finish(&points);
	return st;
}

static enum status boxes_add(const struct joint *j, struct list *out)
{
	const struct level_surface *s = j->level->surface;
	const struct patch_umbilic *all = j->umbilics.p;
	struct level_box *boxes = calloc(j->umbilics.n, sizeof *boxes), *made = NULL;
	size_t n = 0, n_made = 0;
	if (!boxes)
		return ST_RESOURCE;
	for (size_t i = 0; i < j->umbilics.n; i++) {
		if (all[i].x.kind != UMBILIC_FLAT && all[i].x.kind != UMBILIC_UNSURE)
			continue;
		level_globalise(s, all[i].patch, all[i].x.lo, boxes[n].lo);
		level_globalise(s, all[i].patch, all[i].x.hi, boxes[n].hi);
		boxes[n++].flat = all[i].x.kind == UMBILIC_FLAT;
	}
	enum status st = n > 0 ? level_boxes_unite(s, boxes, n, &made, &n_made) : ST_OK;
	for (size_t i = 0; st == ST_OK && i < n_made; i++) {
		struct level_umbilic *to = list_add(out, sizeof *to);
		if (!to) {
			st = ST_RESOURCE;
			break;
		}
		to->kind = made[i].flat ? LEVEL_UMBILIC_REGION : LEVEL_UMBILIC_UNDECIDED;
		memcpy(to->lo, made[i].lo, sizeof to->lo);
		memcpy(to->hi, made[i].hi, sizeof to->hi);
		for (int d = 0; d < 2; d++)
			to->at[d] = 0.5 * (to->lo[d] + to->hi[d]);
		double uv[2], at[2];
		memcpy(uv, to->at, sizeof uv);
		level_into_domain(s, uv);
		const int patch = level_patch_at(s, uv, at);
		st = level_mean_at(s, patch, at, &to->curvature);
	}
	free(boxes);
	free(made);
	return st;
}

enum status level_umbilics_join(struct joint *j, struct level_result *out)
{
	struct list all = { 0 };
	if (j->umbilics.n == 0)
		return ST_OK;
	enum status st = points_add(j, &all);
	if (st == ST_OK)
		st = boxes_add(j, &all);
	out->umbilics = all.p;
	out->n_umbilics = all.n;
	return st;
}

/* In a box as wide as two of the mark's, which may go beyond a seam. */
static bool is_in(const struct level_surface *s, const struct level_box *b,
                  const struct level_umbilic *u)
{
	for (int d = 0; d < 2; d++) {
		const double more = 0.5 * (b->hi[d] - b->lo[d]);
		const double lo = b->lo[d] - more, hi = b->hi[d] + more;
		bool in = false;
		for (int k = -1; k <= 1; k++) {
			const double by = s->net.closed[d] ? k * level_range(s, d) : 0;
			in |= u->hi[d] + by >= lo && u->lo[d] + by <= hi;
		}
		if (!in)
			return false;
	}
	return true;
}

const struct level_umbilic *level_umbilic_in(const struct level_surface *s,
                                             const struct level_result *x,
                                             const struct level_box *b)
{
	const struct level_umbilic *found = NULL;
	for (size_t i = 0; i < x->n_umbilics; i++) {
		if (!is_in(s, b, &x->umbilics[i]))
			continue;
		if (found || x->umbilics[i].kind != LEVEL_UMBILIC_POINT)
			return NULL;
		found = &x->umbilics[i];
	}
	return found;
}
