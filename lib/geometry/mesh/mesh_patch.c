/* mesh_patch.c - the smooth patches between the sharp lines of a surface. */
#include <stdlib.h>

#include "curvature.h"
#include "mesh_private.h"

/* Knots that stand order - 1 times or more. */
enum status mesh_find_creases(struct mesh_creases *c, const struct surface *s)
{
	for (int d = 0; d < 2; d++) {
		const double *x = s->knots[d],
		             near = MESH_ON_CREASE * (s->domain[d][1] - s->domain[d][0]);
		const int many = s->order[d] - 1, all = s->n[d] + s->order[d];
		c->at[d] = malloc((size_t)all * sizeof *c->at[d]);
		if (!c->at[d])
			return ST_RESOURCE;
		for (int i = 0; i + many <= all; i++) {
			const double t = x[i];
			if (t == x[i + many - 1] && t > s->domain[d][0] + near &&
			    t < s->domain[d][1] - near &&
			    (c->n[d] == 0 || t > c->at[d][c->n[d] - 1]))
				c->at[d][c->n[d]++] = t;
		}
	}
	return ST_OK;
}

static int creases_below(const struct mesh_creases *c, int d, double t)
{
	int lo = 0, hi = c->n[d];
	while (lo < hi) {
		const int mid = lo + (hi - lo) / 2;
		if (c->at[d][mid] < t)
			lo = mid + 1;
		else
			hi = mid;
	}
	return lo;
}

int mesh_patch_of(const struct mesh_creases *c, const double uv[2])
{
	return creases_below(c, 0, uv[0]) * (c->n[1] + 1) + creases_below(c, 1, uv[1]);
}

struct vec3 mesh_patch_normal(const struct surface *s, const struct mesh_creases *c, int patch,
                              const double uv[2])
{
	/* With the patch as its domain the surface gives the patch's values at its border. */
	struct surface view = *s;
	const int each = c->n[1] + 1, k[2] = { patch / each, patch % each };
	double at[2];
	struct vec3 n;
	for (int d = 0; d < 2; d++) {
		if (k[d] > 0)
			view.domain[d][0] = c->at[d][k[d] - 1];
		if (k[d] < c->n[d])
			view.domain[d][1] = c->at[d][k[d]];
		at[d] = fmin(fmax(uv[d], view.domain[d][0]), view.domain[d][1]);
	}
	return surface_normal(&view, at[0], at[1], &n) ? n : vec3(NAN, NAN, NAN);
}
