/* mesh_settle.c - the mesh as it is given out: each place one point, no triangle that is nothing. */
#include <stdlib.h>
#include <string.h>

#include "mesh_twins.h"

/* A triangle by its points, lowest first. */
struct by_points {
	int p[3], triangle;
};

static int compare(const void *a, const void *b)
{
	const struct by_points *x = a, *y = b;
	for (int k = 0; k < 3; k++)
		if (x->p[k] != y->p[k])
			return x->p[k] < y->p[k] ? -1 : 1;
	return x->triangle - y->triangle;
}

static void sort_points(int p[3])
{
	for (int i = 0; i < 2; i++)
		for (int k = 0; k < 2 - i; k++)
			if (p[k] > p[k + 1]) {
				const int swap = p[k];
				p[k] = p[k + 1];
				p[k + 1] = swap;
			}
}

static bool same_points(const struct by_points *x, const struct by_points *y)
{
	return !memcmp(x->p, y->p, sizeof x->p);
}

/* Which triangles of a part stay: not those with two corners at one point; nor two between the same
 * three points, as a sliver of a face has them where its sides are one line. */
static enum status choose(const struct mesh *m, const struct mesh_part *part, bool *stays)
{
	struct by_points *list = malloc(((size_t)part->count + 1) * sizeof *list);
	int n = 0;
	if (!list)
		return ST_RESOURCE;
	for (int t = part->first; t < part->first + part->count; t++) {
		struct by_points x = { .triangle = t };
		for (int k = 0; k < 3; k++)
			x.p[k] = m->triangles[t][k].point;
		sort_points(x.p);
		stays[t] = x.p[0] != x.p[1] && x.p[1] != x.p[2];
		if (stays[t])
			list[n++] = x;
	}
	qsort(list, (size_t)n, sizeof *list, compare);
	for (int i = 0; i + 1 < n; i++)
		if (same_points(&list[i], &list[i + 1])) {
			stays[list[i].triangle] = stays[list[i + 1].triangle] = false;
			i++;
		}
	free(list);
	return ST_OK;
}

/* A mesh being written anew. */
struct again {
	struct mesh_build *b;
	const struct mesh *old;
	const bool *stays;
	int *fresh; /* of each old point the new one; -1: none yet */
	const struct mesh_split *splits;
	int n_splits;
};

static enum status put_triangle(struct again *x, const struct mesh_corner old[3],
                                const double uv[3][2], bool turned)
{
	struct mesh_corner corner[3];
	double at[3][2];
	enum status st = ST_OK;
	for (int k = 0; k < 3 && st == ST_OK; k++) {
		const int from = turned ? 2 - k : k;
		const struct mesh_corner *c = &old[from];
		const struct vec3 n = x->old->normals[c->normal];
		if (x->fresh[c->point] < 0)
			st = mesh_add_point(x->b, x->old->points[c->point], &x->fresh[c->point]);
		corner[k].point = x->fresh[c->point];
		if (st == ST_OK)
			st = mesh_add_normal(x->b, corner[k].point, turned ? vec3_scale(n, -1) : n,
			                     &corner[k].normal);
		memcpy(at[k], uv[from], sizeof at[k]);
	}
	return st == ST_OK ? mesh_add_triangle(x->b, corner, (const double(*)[2])at) : st;
}

/* Both halves of a triangle. */
static enum status put_halves(struct again *x, int t, const struct mesh_split *split, bool turned)
{
	enum status st = ST_OK;
	for (int half = 0; half < 2 && st == ST_OK; half++) {
		struct mesh_corner corner[3];
		double uv[3][2];
		const int at = (split->corner + !half) % 3; /* the end that the middle replaces */
		memcpy(corner, x->old->triangles[t], sizeof corner);
		memcpy(uv, x->old->parameters[t], sizeof uv);
		corner[at] = split->middle;
		memcpy(uv[at], split->uv, sizeof uv[at]);
		st = put_triangle(x, corner, (const double(*)[2])uv, turned);
	}
	return st;
}

/* Put the triangles that stay into the mesh anew, with the points and normals that they use. */
static enum status put_again(struct again *x)
{
	struct mesh *m = x->b->out;
	enum status st = ST_OK;
	for (int f = 0, next = 0; f < x->old->n_parts && st == ST_OK; f++) {
		const struct mesh_part *part = &x->old->parts[f];
		const bool turned = x->b->turned && x->b->turned[f];
		m->parts[f].first = m->n_triangles;
		for (int t = part->first; t < part->first + part->count && st == ST_OK; t++) {
			const bool split = next < x->n_splits && x->splits[next].triangle == t;
			if (split && x->stays[t])
				st = put_halves(x, t, &x->splits[next], turned);
			else if (x->stays[t])
				st = put_triangle(x, x->old->triangles[t],
				                  (const double(*)[2])x->old->parameters[t],
				                  turned);
			next += split;
		}
		m->parts[f].count = m->n_triangles - m->parts[f].first;
	}
	return st;
}

enum status mesh_settle(struct mesh_build *b)
{
	struct mesh *m = b->out;
	struct mesh_split *splits = NULL;
	int n_splits = 0;
	for (int t = 0; t < m->n_triangles; t++)
		for (int k = 0; k < 3; k++)
			m->triangles[t][k].point = mesh_point_root(b, m->triangles[t][k].point);
	bool *stays = calloc((size_t)m->n_triangles + 1, sizeof *stays);
	enum status st = stays ? ST_OK : ST_RESOURCE;
	for (int f = 0; f < m->n_parts && st == ST_OK; f++)
		st = choose(m, &m->parts[f], stays);
	if (st == ST_OK)
		st = mesh_twins(b, stays, &splits, &n_splits);
	struct mesh old = *m;
	int *fresh = malloc(((size_t)old.n_points + 1) * sizeof *fresh);
	struct mesh_part *parts = calloc((size_t)old.n_parts, sizeof *parts);
	if (!fresh || !parts)
		st = ST_RESOURCE;
	for (int i = 0; i < old.n_points && st == ST_OK; i++)
		fresh[i] = -1;
	if (st == ST_OK) {
		struct again x = { b, &old, stays, fresh, splits, n_splits };
		*m = (struct mesh){ .parts = parts, .n_parts = old.n_parts };
		b->points_room = b->normals_room = b->triangles_room = b->parameters_room = 0;
		b->parameters = b->limits->parameters;
		st = put_again(&x);
		mesh_finish(&old);
	} else {
		free(parts);
	}
	free(splits);
	free(stays);
	free(fresh);
	return st;
}
