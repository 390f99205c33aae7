/* bench_march.c - curves f = value by marching over a mesh.
 *
 * Each cell's edges that f changes sign on are met by straight segments; segments that share a place on an edge are
 * one curve.
 */
#include "bench_march.h"

#include <stdlib.h>

#include "bench.h"
#include "level_border.h"

enum { CELLS = 400, NODES = CELLS + 1 };

struct march {
	struct vec3 *points; /* owned; NODES x NODES, v fastest, as all */
	double *f;           /* owned */
	int *parent; /* owned; of each edge, 2 a vertex: along u, along v; -1: f does not change sign */
};

struct march *march_create(const struct surface *s, const struct level_field *f)
{
	struct march *m = calloc(1, sizeof *m);
	const size_t n = (size_t)NODES * NODES;
	if (!m || !(m->points = malloc(sizeof *m->points * n)) ||
	    !(m->parent = malloc(sizeof *m->parent * 2 * n)))
		bench_fail("out of memory");
	m->f = bench_room(n);
	struct level_field zero = *f;
	zero.value = 0;
	for (int i = 0; i < NODES; i++)
		for (int j = 0; j < NODES; j++) {
			const double u =
			        s->domain[0][0] + (s->domain[0][1] - s->domain[0][0]) * i / CELLS;
			const double v =
			        s->domain[1][0] + (s->domain[1][1] - s->domain[1][0]) * j / CELLS;
			m->points[i * NODES + j] = surface_point(s, u, v);
			m->f[i * NODES + j] = level_value(&zero, s, u, v);
		}
	return m;
}

void march_destroy(struct march *m)
{
	if (!m)
		return;
	free(m->points);
	free(m->f);
	free(m->parent);
	free(m);
}

static int root_of(int *parent, int x)
{
	while (parent[x] != x)
		x = parent[x] = parent[parent[x]];
	return x;
}

/* The vertex at the other end of an edge. */
static int edge_end(int edge)
{
	return edge / 2 + (edge % 2 ? 1 : NODES);
}

static struct vec3 edge_place(const struct march *m, int edge, double value)
{
	const int a = edge / 2, b = edge_end(edge);
	const double x = m->f[a] - value, y = m->f[b] - value;
	return vec3_along(m->points[a], x / (x - y), vec3_sub(m->points[b], m->points[a]));
}

static void segment(struct march *m, int a, int b, double value, int *curves, peer_place *place,
                    void *data)
{
	const int x = root_of(m->parent, a), y = root_of(m->parent, b);
	if (x != y) {
		m->parent[x] = y;
		(*curves)--;
	}
	if (!place)
		return;
	const struct vec3 p = edge_place(m, a, value), q = edge_place(m, b, value);
	place((double[3]){ p.x, p.y, p.z }, data);
	place((double[3]){ 0.5 * (p.x + q.x), 0.5 * (p.y + q.y), 0.5 * (p.z + q.z) }, data);
}

int march_curves(struct march *m, double value, peer_place *place, void *data)
{
	int curves = 0; /* edges with a place, less the segments that join two curves */
	for (int i = 0; i < NODES * NODES; i++)
		for (int d = 0; d < 2; d++) {
			const int edge = 2 * i + d;
			const bool there = d == 0 ? i / NODES < CELLS : i % NODES < CELLS;
			const bool cut =
			        there && (m->f[i] < value) != (m->f[edge_end(edge)] < value);
			m->parent[edge] = cut ? edge : -1;
			curves += cut;
		}
	for (int i = 0; i < CELLS; i++)
		for (int j = 0; j < CELLS; j++) {
			const int at = i * NODES + j;
			/* round the cell */
			const int edges[4] = { 2 * at, 2 * (at + NODES) + 1, 2 * (at + 1),
				               2 * at + 1 };
			int cut[4], n = 0;
			for (int k = 0; k < 4; k++)
				if (m->parent[edges[k]] >= 0)
					cut[n++] = edges[k];
			if (n == 2)
				segment(m, cut[0], cut[1], value, &curves, place, data);
			if (n < 4)
				continue;
			/* the middle is with the first corner, or not */
			const double middle = 0.25 * (m->f[at] + m->f[at + 1] + m->f[at + NODES] +
			                              m->f[at + NODES + 1]);
			const int with = (middle < value) == (m->f[at] < value) ? 1 : 3;
			segment(m, cut[0], cut[with], value, &curves, place, data);
			segment(m, cut[2], cut[4 - with], value, &curves, place, data);
		}
	return curves;
}
