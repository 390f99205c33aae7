/* mesh_settle.c - the mesh as it is given out: each place one point, no triangle that is nothing. */
#include <stdlib.h>
#include <string.h>

#include "mesh_private.h"

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

/* Put the triangles that stay into the mesh anew, with the points and normals that they use. */
static enum status put_again(struct mesh_build *b, const struct mesh *old, const bool *stays,
                             int *fresh)
{
	struct mesh *m = b->out;
	enum status st = ST_OK;
	for (int f = 0; f < old->n_parts && st == ST_OK; f++) {
		const struct mesh_part *part = &old->parts[f];
		const bool turned = b->turned && b->turned[f];
		m->parts[f].first = m->n_triangles;
		for (int t = part->first; t < part->first + part->count && st == ST_OK; t++) {
			struct mesh_corner corner[3];
			double uv[3][2];
			if (!stays[t])
				continue;
			for (int k = 0; k < 3 && st == ST_OK; k++) {
				const int from = turned ? 2 - k : k;
				const struct mesh_corner *c = &old->triangles[t][from];
				const struct vec3 n = old->normals[c->normal];
				if (fresh[c->point] < 0)
					st = mesh_add_point(b, old->points[c->point],
					                    &fresh[c->point]);
				corner[k].point = fresh[c->point];
				if (st == ST_OK)
					st = mesh_add_normal(b, corner[k].point,
					                     turned ? vec3_scale(n, -1) : n,
					                     &corner[k].normal);
				if (b->limits->parameters)
					memcpy(uv[k], old->parameters[t][from], sizeof uv[k]);
			}
			if (st == ST_OK)
				st = mesh_add_triangle(b, corner, (const double(*)[2])uv);
		}
		m->parts[f].count = m->n_triangles - m->parts[f].first;
	}
	return st;
}

enum status mesh_settle(struct mesh_build *b)
{
	struct mesh *m = b->out;
	struct mesh old = *m;
	bool *stays = calloc((size_t)old.n_triangles + 1, sizeof *stays);
	int *fresh = malloc(((size_t)old.n_points + 1) * sizeof *fresh);
	struct mesh_part *parts = calloc((size_t)old.n_parts, sizeof *parts);
	enum status st = stays && fresh && parts ? ST_OK : ST_RESOURCE;
	for (int t = 0; t < old.n_triangles; t++)
		for (int k = 0; k < 3; k++)
			old.triangles[t][k].point = mesh_point_root(b, old.triangles[t][k].point);
	for (int f = 0; f < old.n_parts && st == ST_OK; f++)
		st = choose(&old, &old.parts[f], stays);
	for (int i = 0; i < old.n_points && st == ST_OK; i++)
		fresh[i] = -1;
	if (st == ST_OK) {
		*m = (struct mesh){ .parts = parts, .n_parts = old.n_parts };
		b->points_room = b->normals_room = b->triangles_room = b->parameters_room = 0;
		st = put_again(b, &old, stays, fresh);
		mesh_finish(&old);
	} else {
		free(parts);
	}
	free(stays);
	free(fresh);
	return st;
}
