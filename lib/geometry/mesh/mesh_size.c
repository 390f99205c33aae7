/* mesh_size.c - how long a face is in u and v, and how many triangles it needs. */
#include <stdlib.h>

#include "curvature.h"
#include "mesh_face.h"

enum { SIDE = 4, LOOKS = SIDE * SIDE };

static void add_to_range(double range[2][2], const double uv[2])
{
	for (int d = 0; d < 2; d++) {
		range[d][0] = fmin(range[d][0], uv[d]);
		range[d][1] = fmax(range[d][1], uv[d]);
	}
}

/* What the loops of a face reach: their nodes, or their samples where they are not cut yet. */
static void find_range(const struct mesh_build *b, int face, double range[2][2])
{
	const struct surface *s = b->faces[face].surface;
	for (int d = 0; d < 2; d++) {
		range[d][0] = INFINITY;
		range[d][1] = -INFINITY;
	}
	for (int l = b->first_loop[face]; l < b->first_loop[face + 1]; l++)
		for (int k = b->loops[l].first; k >= 0; k = b->edges[k].next) {
			const struct mesh_edge *e = &b->edges[k];
			double uv[2];
			for (int i = 0; i < e->n_nodes; i++)
				add_to_range(range, e->nodes[i].uv);
			for (int i = 0; i < e->n_samples && !e->n_nodes; i++) {
				mesh_edge_uv(b, e, e->samples[i].t, uv);
				add_to_range(range, uv);
			}
		}
	for (int d = 0; d < 2; d++)
		if (!(range[d][1] > range[d][0])) {
			range[d][0] = s->domain[d][0];
			range[d][1] = s->domain[d][1];
		}
}

/* How many pieces the tolerances would make of it in each direction if it were everywhere as it is at
 * u, v. A flat direction counts a little, for shape. */
static void count_at(const struct mesh_build *b, int face, const double range[2][2], double u,
                     double v, double pieces[2])
{
	const struct tessellate_limits *l = b->limits;
	const struct surface *s = b->faces[face].surface;
	const double flat = 1 / (10 * surface_size(s));
	struct surface_shape x;
	double rate[2];
	surface_shape(s, u, v, &x);
	for (int d = 0; d < 2; d++) {
		const double k = fabs(x.value[QUANTITY_NORMAL_U + d]);
		rate[d] = k > 0 ? fmax(sqrt(k / (8 * l->chord)), k / l->angle) : 0;
	}
	const double least = flat + 0.1 * fmax(rate[0], rate[1]);
	pieces[0] = vec3_length(x.du) * (range[0][1] - range[0][0]) * fmax(rate[0], least);
	pieces[1] = vec3_length(x.dv) * (range[1][1] - range[1][0]) * fmax(rate[1], least);
}

/* Where to look: number i of LOOKS. */
static void place(const double range[2][2], int i, double uv[2])
{
	const double f[2] = { (i / SIDE + 0.5) / SIDE, (i % SIDE + 0.5) / SIDE };
	for (int d = 0; d < 2; d++)
		uv[d] = range[d][0] + f[d] * (range[d][1] - range[d][0]);
}

static int by_value(const void *a, const void *b)
{
	const double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

double mesh_estimate(const struct mesh_build *b, int face)
{
	double range[2][2], pieces[2], uv[2], all[LOOKS];
	find_range(b, face, range);
	for (int i = 0; i < LOOKS; i++) {
		place((const double(*)[2])range, i, uv);
		count_at(b, face, (const double(*)[2])range, uv[0], uv[1], pieces);
		all[i] = fmax(2 * pieces[0] * pieces[1], 0); /* NaN, where there is no shape: 0 */
	}
	/* the middle one: a single sharp bend says nothing of the rest */
	qsort(all, LOOKS, sizeof *all, by_value);
	return all[LOOKS / 2];
}

void mesh_face_measure(struct mesh_face *f)
{
	double pieces[2] = { 0, 0 };
	find_range(f->b, f->face, f->range);
	for (int i = 0; i < LOOKS; i++) {
		double uv[2], at[2];
		place((const double(*)[2])f->range, i, uv);
		count_at(f->b, f->face, (const double(*)[2])f->range, uv[0], uv[1], at);
		pieces[0] += at[0];
		pieces[1] += at[1];
	}
	/* in these units equal triangles are good ones; halves of halves stay whole */
	const double ratio = fmin(fmax(pieces[1] / pieces[0], 1.0 / 256), 256);
	f->side[0] = f->side[1] = NET_SIDE / 2;
	if (ratio < 1)
		f->side[1] = (int32_t)(ratio * NET_SIDE / 2048) * 1024;
	else if (ratio > 1)
		f->side[0] = (int32_t)(NET_SIDE / ratio / 2048) * 1024;
	for (int d = 0; d < 2; d++) {
		const struct surface *s = f->s;
		int n = 1;
		for (int i = 1; i < s->n[d] + s->order[d]; i++)
			n += s->knots[d][i] > s->knots[d][i - 1] &&
			     s->knots[d][i] > s->domain[d][0] && s->knots[d][i] < s->domain[d][1];
		f->span[d] = (s->domain[d][1] - s->domain[d][0]) / n;
	}
}
