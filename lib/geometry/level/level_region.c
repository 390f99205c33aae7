/* level_region.c - undecided boxes that touch are one mark; curves that end there are counted. */
#include "level_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Marks no larger than this part of the size are a point, if the tolerance is not larger. */
static const double point_share = 1e-4;

/* So much larger may one about a point without a normal be; one about an umbilic, where f is a difference of
 * squares that both vanish. */
#define SINGULAR_TIMES 10
#define UMBILIC_TIMES  100

const char *const level_mark_names[N_LEVEL_MARKS] = {
	[LEVEL_POINT] = "point",     [LEVEL_CROSSING] = "crossing", [LEVEL_SINGULAR] = "singular",
	[LEVEL_UMBILIC] = "umbilic", [LEVEL_REGION] = "region",     [LEVEL_GRAZE] = "graze",
};

static int box_compare(const void *x, const void *y)
{
	const struct level_box *a = x, *b = y;
	for (int d = 0; d < 2; d++)
		if (a->lo[d] != b->lo[d])
			return a->lo[d] < b->lo[d] ? -1 : 1;
	return 0;
}

static size_t root_of(size_t *parent, size_t i)
{
	while (parent[i] != i)
		i = parent[i] = parent[parent[i]];
	return i;
}

static bool boxes_touch(const struct level_box *a, const struct level_box *b, const double near[2])
{
	for (int d = 0; d < 2; d++)
		if (a->lo[d] > b->hi[d] + near[d] || b->lo[d] > a->hi[d] + near[d])
			return false;
	return true;
}

/* The lowest of a region is its root, so that regions keep the order of their first boxes. */
static void region_unite(size_t *parent, size_t a, size_t b)
{
	a = root_of(parent, a);
	b = root_of(parent, b);
	if (a < b)
		parent[b] = a;
	else
		parent[a] = b;
}

/* Sweep along u; `active` are the boxes that the sweep has not left. */
static void regions_sweep(const struct level_box *b, size_t n, const double near[2], size_t *parent,
                          size_t *active)
{
	size_t n_active = 0;
	for (size_t i = 0; i < n; i++) {
		size_t kept = 0;
		parent[i] = i;
		for (size_t k = 0; k < n_active; k++) {
			size_t a = active[k];
			if (b[a].hi[0] + near[0] < b[i].lo[0])
				continue;
			active[kept++] = a;
			if (boxes_touch(&b[a], &b[i], near))
				region_unite(parent, a, i);
		}
		n_active = kept;
		active[n_active++] = i;
	}
}

static void region_add(struct level_box *to, const struct level_box *b)
{
	for (int d = 0; d < 2; d++) {
		to->lo[d] = smaller(to->lo[d], b->lo[d]);
		to->hi[d] = larger(to->hi[d], b->hi[d]);
	}
	to->flat = to->flat && b->flat;
	if (b->kind != LEVEL_GRAZE)
		to->kind = b->kind;
}

/* The place in the patch that has u, v, and which it is. */
int level_patch_at(const struct level_surface *s, const double uv[2], double out[2])
{
	int place[2];
	for (int d = 0; d < 2; d++) {
		const double *b = s->net.breaks[d];
		int i = 0;
		while (i + 1 < s->net.spans[d] && uv[d] >= b[i + 1])
			i++;
		place[d] = i;
		out[d] = (uv[d] - b[i]) / (b[i + 1] - b[i]);
	}
	return place[0] * s->net.spans[1] + place[1];
}

void level_point_at(const struct level_surface *s, const double uv[2], double p[3])
{
	double at[2], x[4], xu[4], xv[4];
	int patch = level_patch_at(s, uv, at);
	const double *c = bezier_patch(&s->net, patch / s->net.spans[1], patch % s->net.spans[1]);
	form_evaluate4(c, s->net.order[0] - 1, s->net.order[1] - 1, at[0], at[1], x, xu, xv);
	for (int d = 0; d < 3; d++)
		p[d] = x[d] / x[3];
}

/* A place beyond a seam is one at the lower end. */
void level_into_domain(const struct level_surface *s, double uv[2])
{
	for (int d = 0; d < 2; d++)
		if (uv[d] > s->net.breaks[d][s->net.spans[d]])
			uv[d] = smaller(uv[d] - level_range(s, d),
			                s->net.breaks[d][s->net.spans[d]]);
}

/* From one corner to the others, twice: a box so small is nearly flat. */
static double box_size(const struct level_surface *s, const struct level_box *b)
{
	double p[3], q[3], most = 0;
	level_point_at(s, b->lo, p);
	for (int k = 1; k < 4; k++) {
		double uv[2] = { k & 1 ? b->hi[0] : b->lo[0], k & 2 ? b->hi[1] : b->lo[1] };
		level_into_domain(s, uv);
		level_point_at(s, uv, q);
		most = larger(most, vec3_length(vec3_sub(vec3_of(p), vec3_of(q))));
	}
	return 2 * most;
}

/* The mark that holds u, v, counted from 1; 0: none. */
static int mark_at(const struct level_surface *s, const struct level_result *x, const double uv[2],
                   const double near[2])
{
	for (size_t i = 0; i < x->n_undecided; i++) {
		const struct level_box *b = &x->undecided[i];
		bool in = b->kind != LEVEL_GRAZE;
		for (int d = 0; in && d < 2; d++)
			in = (uv[d] >= b->lo[d] - near[d] && uv[d] <= b->hi[d] + near[d]) ||
			     (s->net.closed[d] && uv[d] + level_range(s, d) <= b->hi[d] + near[d]);
		if (in)
			return (int)i + 1;
	}
	return 0;
}

/* A corner of a patch in the box has no normal. */
static bool singular_in(const struct level_surface *s, struct level_box *b, const double near[2])
{
	const int m = s->degree[0], n = s->degree[1];
	for (size_t i = 0; s->normals && i < (size_t)s->net.spans[0] * s->net.spans[1]; i++)
		for (int k = 0; k < 4; k++) {
			const double corner[2] = { k / 2, k % 2 };
			const double *c = s->normals + level_normals_size(s) * i +
			                  (size_t)4 * ((k / 2 ? m : 0) * (n + 1) + (k % 2 ? n : 0));
			double uv[2];
			level_globalise(s, (int)i, corner, uv);
			if (vec3_length(vec3_of(c)) > 3 * s->normal_error[i] ||
			    uv[0] < b->lo[0] - near[0] || uv[0] > b->hi[0] + near[0] ||
			    uv[1] < b->lo[1] - near[1] || uv[1] > b->hi[1] + near[1])
				continue;
			memcpy(b->at, uv, sizeof uv);
			return true;
		}
	return false;
}

static void marks_name(struct joint *j, struct level_result *out, const double near[2])
{
	const struct level_surface *s = j->level->surface;
	double small = larger(j->level->tolerance, point_share * s->net.size);
	for (size_t e = 0; e < 2 * j->n_strands; e++) {
		struct joint_end x;
		struct link *l = &j->links[e];
		if (l->kind != LINK_END)
			continue;
		joint_end_get(j, e, &x);
		l->mark = mark_at(s, out, x.uv, near);
		if (l->mark)
			out->undecided[l->mark - 1].ends++;
	}
	for (size_t i = 0; i < out->n_undecided; i++) {
		struct level_box *b = &out->undecided[i];
		for (int d = 0; d < 2; d++)
			b->at[d] = 0.5 * (b->lo[d] + b->hi[d]);
		level_into_domain(s, b->at);
		const struct level_umbilic *u = box_size(s, b) <= UMBILIC_TIMES * small
		                                        ? level_umbilic_in(s, out, b)
		                                        : NULL;
		if (u)
			memcpy(b->at, u->at, sizeof u->at);
		if (b->kind != LEVEL_GRAZE)
			b->kind = u ? LEVEL_UMBILIC
			          : box_size(s, b) <= SINGULAR_TIMES * small &&
			                          singular_in(s, b, near)
			                  ? LEVEL_SINGULAR
			          : box_size(s, b) > small ? LEVEL_REGION
			          : b->ends > 0            ? LEVEL_CROSSING
			                                   : LEVEL_POINT;
	}
	j->marks = out->undecided;
}

/* Regions that meet over a seam are one, which goes on beyond the upper end. */
static void seams_unite(const struct level_surface *s, struct level_box *all, size_t *n,
                        const double near[2])
{
	for (int d = 0; d < 2; d++) {
		const double lo = s->net.breaks[d][0], hi = s->net.breaks[d][s->net.spans[d]];
		for (size_t i = 0; s->net.closed[d] && i < *n; i++) {
			struct level_box *a = &all[i];
			if (a->hi[d] < hi - near[d] || a->hi[d] > hi + near[d] ||
			    a->lo[d] <= lo + near[d])
				continue;
			for (size_t k = 0; k < *n; k++) {
				struct level_box b = all[k];
				if (k == i || b.lo[d] > lo + near[d] || b.hi[d] >= hi - near[d] ||
				    a->lo[1 - d] > b.hi[1 - d] + near[1 - d] ||
				    b.lo[1 - d] > a->hi[1 - d] + near[1 - d])
					continue;
				b.lo[d] += hi - lo;
				b.hi[d] += hi - lo;
				region_add(a, &b);
				memmove(&all[k], &all[k + 1], sizeof *all * (--*n - k));
				i -= k < i;
				break;
			}
		}
	}
}

static void near_of(const struct level_surface *s, double near[2])
{
	for (int d = 0; d < 2; d++)
		near[d] = 1e-9 * level_range(s, d);
}

enum status level_boxes_unite(const struct level_surface *s, struct level_box *b, size_t n,
                              struct level_box **out, size_t *n_out)
{
	double near[2];
	near_of(s, near);
	qsort(b, n, sizeof *b, box_compare);
	struct level_box *to = malloc(sizeof *to * n);
	size_t *parent = malloc(sizeof *parent * 2 * n);
	if (!to || !parent) {
		free(to);
		free(parent);
		return ST_RESOURCE;
	}
	size_t *active = parent + n, *place = active;
	regions_sweep(b, n, near, parent, active);
	*n_out = 0;
	for (size_t i = 0; i < n; i++) {
		size_t root = root_of(parent, i);
		if (root == i) {
			place[i] = *n_out;
			to[(*n_out)++] = b[i];
		} else {
			region_add(&to[place[root]], &b[i]);
		}
	}
	free(parent);
	seams_unite(s, to, n_out, near);
	*out = to;
	return ST_OK;
}

enum status level_regions(struct joint *j, struct level_result *out)
{
	double near[2];
	if (j->boxes.n == 0)
		return ST_OK;
	near_of(j->level->surface, near);
	enum status st = level_boxes_unite(j->level->surface, j->boxes.p, j->boxes.n,
	                                   &out->undecided, &out->n_undecided);
	if (st == ST_OK)
		marks_name(j, out, near);
	return st;
}
