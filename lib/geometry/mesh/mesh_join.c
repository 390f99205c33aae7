/* mesh_join.c - edges that are one line in space, found within ever larger distances: what meets
 * within less is not touched by what meets within more. */
#include <stdlib.h>

#include "mesh_private.h"

enum { LEVELS = MESH_ROUNDS - 1, LEVEL_STEP = 4 };

int mesh_vertex_root(struct mesh_build *b, int vertex)
{
	struct mesh_vertex *v = b->vertices;
	while (v[vertex].root != vertex)
		vertex = v[vertex].root = v[v[vertex].root].root;
	return vertex;
}

void mesh_vertex_unite(struct mesh_build *b, int vertex, int other)
{
	const int p = mesh_vertex_root(b, vertex), q = mesh_vertex_root(b, other);
	b->vertices[p > q ? p : q].root = p > q ? q : p;
}

static bool is_small(const struct mesh_edge *e, double within)
{
	for (int i = 1; i < e->n_samples; i++)
		if (!(vec3_length(vec3_sub(e->samples[i].p, e->samples[0].p)) <= within))
			return false;
	return true;
}

/* Edges that are one point: at first all as small as that, later those whose ends are one vertex. */
static void find_degenerate(struct mesh_build *b, double within, bool first)
{
	for (int k = 0; k < b->n_edges; k++) {
		struct mesh_edge *e = &b->edges[k];
		if (e->joined || e->degenerate || !is_small(e, within))
			continue;
		if (first)
			mesh_vertex_unite(b, e->vertex[0], e->vertex[1]);
		e->degenerate =
		        mesh_vertex_root(b, e->vertex[0]) == mesh_vertex_root(b, e->vertex[1]);
	}
}

/* An edge and the vertices it runs between. */
struct pair {
	int low, high, edge;
};

static int by_vertices(const void *a, const void *b)
{
	const struct pair *p = a, *q = b;
	if (p->low != q->low)
		return p->low - q->low;
	return p->high != q->high ? p->high - q->high : p->edge - q->edge;
}

/* The widest gap between an edge and its master, at a few places. */
static double gap_between(const struct mesh_build *b, const struct mesh_edge *e,
                          const struct mesh_edge *m)
{
	double widest = 0, t;
	for (int i = 0; i <= 4; i++) {
		const struct vec3 p =
		        mesh_edge_point(b, e, e->t[0] + 0.25 * i * (e->t[1] - e->t[0]));
		widest = fmax(widest, mesh_edge_nearest(b, m, p, m->t[0], m->t[1], &t));
	}
	return widest;
}

/* Edges between the same vertices that run along each other get one master. */
static enum status find_masters(struct mesh_build *b, double level)
{
	struct pair *p = malloc(((size_t)b->n_edges + 1) * sizeof *p);
	int n = 0;
	if (!p)
		return ST_RESOURCE;
	for (int k = 0; k < b->n_edges; k++) {
		const struct mesh_edge *e = &b->edges[k];
		if (e->joined || e->degenerate)
			continue;
		const int v = mesh_vertex_root(b, e->vertex[0]),
		          w = mesh_vertex_root(b, e->vertex[1]);
		p[n++] = (struct pair){ v < w ? v : w, v < w ? w : v, k };
	}
	qsort(p, (size_t)n, sizeof *p, by_vertices);
	for (int i = 0; i < n; i++) {
		struct mesh_edge *e = &b->edges[p[i].edge];
		for (int k = i - 1;
		     k >= 0 && !e->joined && p[k].low == p[i].low && p[k].high == p[i].high; k--) {
			struct mesh_edge *m = &b->edges[p[k].edge];
			if (m->master != p[k].edge ||
			    !mesh_runs_along(b, e, e->t, m, m->t, level, &e->reversed))
				continue;
			if (p[i].low != p[i].high)
				e->reversed = mesh_vertex_root(b, e->vertex[0]) !=
				              mesh_vertex_root(b, m->vertex[0]);
			e->master = p[k].edge;
			e->joined = m->joined = true;
			m->ring = p[i].low == p[i].high;
			b->gap = fmax(b->gap, gap_between(b, e, m));
		}
	}
	free(p);
	return ST_OK;
}

static void settle_vertices(struct mesh_build *b)
{
	for (int k = 0; k < b->n_edges; k++)
		for (int i = 0; i < 2; i++)
			b->edges[k].vertex[i] = mesh_vertex_root(b, b->edges[k].vertex[i]);
}

/* Small edges that were joined between two vertices which became one later are one point. */
static void drop_small(struct mesh_build *b)
{
	for (int k = 0; k < b->n_edges; k++) {
		struct mesh_edge *e = &b->edges[k];
		const struct mesh_edge *m = &b->edges[e->master];
		if (!e->joined || m->ring || e->vertex[0] != e->vertex[1] ||
		    !is_small(m, 4 * b->limits->join))
			continue;
		e->degenerate = true;
	}
	for (int k = 0; k < b->n_edges; k++)
		if (b->edges[k].joined && b->edges[k].degenerate) {
			b->edges[k].joined = b->edges[k].reversed = false;
			b->edges[k].master = k;
		}
}

/* Members of each group, one group behind the other. */
static enum status find_groups(struct mesh_build *b)
{
	b->groups = calloc((size_t)b->n_edges + 2, sizeof *b->groups);
	b->members = malloc(((size_t)b->n_edges + 1) * sizeof *b->members);
	if (!b->groups || !b->members)
		return ST_RESOURCE;
	for (int k = 0; k < b->n_edges; k++)
		b->groups[b->edges[k].master + 1]++;
	for (int k = 0; k < b->n_edges; k++)
		b->groups[k + 1] += b->groups[k];
	for (int k = b->n_edges - 1; k >= 0; k--)
		b->members[--b->groups[b->edges[k].master + 1]] = k;
	/* groups[k + 1] is now where the group of k begins */
	for (int k = 0; k < b->n_edges; k++)
		b->groups[k] = b->groups[k + 1];
	b->groups[b->n_edges] = b->n_edges;
	return ST_OK;
}

static enum status join_within(struct mesh_build *b, double level, bool leave)
{
	enum status st = mesh_touch(b, level, leave);
	if (st == ST_OK)
		st = find_masters(b, level);
	find_degenerate(b, level, false);
	b->round++;
	return st;
}

enum status mesh_join(struct mesh_build *b)
{
	enum status st = ST_OK;
	double level = b->limits->join;
	for (int k = 1; k < LEVELS; k++)
		level /= LEVEL_STEP;
	find_degenerate(b, level, true);
	for (int k = 0; k < LEVELS && st == ST_OK; k++, level *= LEVEL_STEP)
		st = join_within(b, level, false);
	if (st == ST_OK)
		st = join_within(b, b->limits->join, true);
	settle_vertices(b);
	drop_small(b);
	return st == ST_OK ? find_groups(b) : st;
}
