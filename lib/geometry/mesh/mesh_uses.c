/* mesh_uses.c - the triangles at each edge. */
#include "mesh_uses.h"

#include <stdlib.h>

static int ends_of(const struct mesh *m, int triangle, int corner, struct mesh_use *use)
{
	const int p = m->triangles[triangle][corner].point;
	const int q = m->triangles[triangle][(corner + 1) % 3].point;
	*use = (struct mesh_use){ p < q ? q : p, triangle, corner, p < q };
	return p < q ? p : q;
}

static int by_high(const void *a, const void *b)
{
	const struct mesh_use *p = a, *q = b;
	return p->high != q->high ? p->high - q->high : p->triangle - q->triangle;
}

enum status mesh_uses_init(struct mesh_uses *x, const struct mesh *m)
{
	struct mesh_use use;
	x->first = calloc((size_t)m->n_points + 2, sizeof *x->first);
	x->list = malloc((3 * (size_t)m->n_triangles + 1) * sizeof *x->list);
	if (!x->first || !x->list)
		return ST_RESOURCE;
	for (int t = 0; t < m->n_triangles; t++)
		for (int k = 0; k < 3; k++)
			x->first[ends_of(m, t, k, &use) + 2]++;
	for (int p = 0; p < m->n_points; p++)
		x->first[p + 2] += x->first[p + 1];
	/* first[low + 1] is where that point's next one goes, and at last where they end */
	for (int t = 0; t < m->n_triangles; t++)
		for (int k = 0; k < 3; k++) {
			const int low = ends_of(m, t, k, &use);
			x->list[x->first[low + 1]++] = use;
		}
	for (int p = 0; p < m->n_points; p++)
		qsort(x->list + x->first[p], (size_t)(x->first[p + 1] - x->first[p]),
		      sizeof *x->list, by_high);
	return ST_OK;
}

void mesh_uses_finish(struct mesh_uses *x)
{
	free(x->first);
	free(x->list);
}

int mesh_part_of(const struct mesh *m, int triangle)
{
	int lo = 0, hi = m->n_parts - 1;
	while (lo < hi) {
		const int mid = lo + (hi - lo) / 2;
		if (m->parts[mid].first + m->parts[mid].count <= triangle)
			lo = mid + 1;
		else
			hi = mid;
	}
	return lo;
}
