/* mesh_twins.c - edges inside several faces that have the same two points. */
#include "mesh_twins.h"

#include <stdlib.h>
#include <string.h>

#include "mesh_uses.h"

struct twins {
	struct mesh_build *b;
	bool *parted; /* owned; of each triangle */
	struct mesh_split *list;
	int n, room;
};

static enum status add_split(struct twins *x, int face, const struct mesh_use *use, int point,
                             const double uv[2])
{
	struct mesh_build *b = x->b;
	const struct surface *s = b->faces[face].surface;
	const struct mesh_creases *c = &b->creases[face];
	const double(*at)[2] = (const double(*)[2])b->out->parameters[use->triangle];
	const double center[2] = { (at[0][0] + at[1][0] + at[2][0]) / 3,
		                   (at[0][1] + at[1][1] + at[2][1]) / 3 };
	struct mesh_split fresh = { .triangle = use->triangle,
		                    .corner = use->corner,
		                    .middle = { .point = point },
		                    .uv = { uv[0], uv[1] } };
	struct vec3 n = mesh_patch_normal(s, c, mesh_patch_of(c, center), uv);
	if (!isfinite(n.x))
		n = b->out->normals[b->out->triangles[use->triangle][use->corner].normal];
	enum status st = mesh_add_normal(b, point, n, &fresh.middle.normal);
	if (st == ST_OK)
		st = mesh_grow((void **)&x->list, &x->room, x->n + 1, sizeof *x->list);
	if (st == ST_OK)
		x->list[x->n++] = fresh;
	x->parted[use->triangle] = true;
	return st;
}

/* Two triangles of one face on both sides of an edge inside of it. */
static enum status part_between(struct twins *x, int face, const struct mesh_use *one,
                                const struct mesh_use *two)
{
	struct mesh_build *b = x->b;
	const double(*p)[2] = (const double(*)[2])b->out->parameters[one->triangle];
	const double(*q)[2] = (const double(*)[2])b->out->parameters[two->triangle];
	const double *from = p[one->corner], *to = p[(one->corner + 1) % 3];
	/* on a seam it has two places in u, v */
	if (one->up == two->up || x->parted[one->triangle] || x->parted[two->triangle] ||
	    memcmp(from, q[(two->corner + 1) % 3], sizeof *p) ||
	    memcmp(to, q[two->corner], sizeof *p))
		return ST_OK;
	const double uv[2] = { 0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1]) };
	int point;
	enum status st =
	        mesh_add_point(b, surface_point(b->faces[face].surface, uv[0], uv[1]), &point);
	if (st == ST_OK)
		st = add_split(x, face, one, point, uv);
	return st == ST_OK ? add_split(x, face, two, point, uv) : st;
}

static int by_triangle(const void *a, const void *b)
{
	return ((const struct mesh_split *)a)->triangle - ((const struct mesh_split *)b)->triangle;
}

enum status mesh_twins(struct mesh_build *b, const bool *stays, struct mesh_split **out, int *n)
{
	struct twins x = { .b = b };
	struct mesh_uses uses = { 0 };
	const int points = b->out->n_points;
	enum status st = mesh_uses_init(&uses, b->out);
	x.parted = calloc((size_t)b->out->n_triangles + 1, sizeof *x.parted);
	if (!x.parted)
		st = ST_RESOURCE;
	for (int p = 0; p < points && st == ST_OK; p++)
		for (int i = uses.first[p], k; i < uses.first[p + 1] && st == ST_OK; i = k) {
			struct mesh_use *at = uses.list + i;
			const int high = at[0].high;
			int m = 0;
			for (k = i; k < uses.first[p + 1] && uses.list[k].high == high; k++)
				if (stays[uses.list[k].triangle])
					at[m++] = uses.list[k];
			/* triangles of one face stand one behind the other */
			for (int j = 0; m > 2 && j + 1 < m && st == ST_OK; j++) {
				const int face = mesh_part_of(b->out, at[j].triangle);
				if (face == mesh_part_of(b->out, at[j + 1].triangle))
					st = part_between(&x, face, &at[j], &at[j + 1]);
			}
		}
	if (x.n)
		qsort(x.list, (size_t)x.n, sizeof *x.list, by_triangle);
	free(x.parted);
	mesh_uses_finish(&uses);
	*out = x.list;
	*n = x.n;
	return st;
}
