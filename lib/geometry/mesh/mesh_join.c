/* mesh_join.c - places where edges end, and edges that are one line in space. */
#include <stdlib.h>

#include "box.h"
#include "mesh_private.h"

/* One end of an edge. */
struct end {
	struct vec3 p;
	int edge, which, root; /* root: the first end at the same place */
};

static int by_place(const void *a, const void *b)
{
	const struct end *p = a, *q = b;
	if (p->p.x != q->p.x)
		return p->p.x < q->p.x ? -1 : 1;
	return p->edge != q->edge ? p->edge - q->edge : p->which - q->which;
}

static double apart(struct vec3 a, struct vec3 b)
{
	return vec3_length(vec3_sub(a, b));
}

static int root_of(struct end *e, int i)
{
	while (e[i].root != i)
		i = e[i].root = e[e[i].root].root;
	return i;
}

/* Ends within the tolerance get one vertex: the place of the first edge's. */
static enum status find_vertices(struct mesh_build *b)
{
	const int n = 2 * b->n_edges;
	struct end *e = malloc((size_t)n * sizeof *e);
	b->vertices = malloc((size_t)n * sizeof *b->vertices);
	if (!e || !b->vertices) {
		free(e);
		return ST_RESOURCE;
	}
	for (int i = 0; i < n; i++) {
		struct mesh_edge *edge = &b->edges[i / 2];
		e[i] = (struct end){ mesh_edge_point(b, edge, edge->t[i % 2]), i / 2, i % 2, 0 };
	}
	qsort(e, (size_t)n, sizeof *e, by_place);
	for (int i = 0; i < n; i++) {
		e[i].root = i;
		for (int k = i - 1; k >= 0 && e[i].p.x - e[k].p.x <= b->limits->join; k--)
			if (apart(e[i].p, e[k].p) <= b->limits->join) {
				int p = root_of(e, k), q = root_of(e, i);
				e[p > q ? p : q].root = p > q ? q : p;
			}
	}
	for (int i = 0; i < n; i++) {
		const int root = root_of(e, i);
		struct mesh_edge *edge = &b->edges[e[i].edge];
		if (root == i) {
			edge->vertex[e[i].which] = b->n_vertices;
			b->vertices[b->n_vertices++] = (struct mesh_vertex){ e[i].p, -1 };
		} else { /* roots come before what hangs on them */
			edge->vertex[e[i].which] = b->edges[e[root].edge].vertex[e[root].which];
		}
	}
	free(e);
	return ST_OK;
}

static void find_degenerate(struct mesh_build *b)
{
	for (int k = 0; k < b->n_edges; k++) {
		struct mesh_edge *e = &b->edges[k];
		e->degenerate = e->vertex[0] == e->vertex[1];
		for (int i = 0; i < e->n_samples && e->degenerate; i++)
			e->degenerate = apart(e->samples[i].p, e->samples[0].p) <= b->limits->join;
	}
}

static struct box edge_box(const struct mesh_edge *e, double more)
{
	struct box x = box_empty();
	double step = 0;
	for (int i = 0; i < e->n_samples; i++) {
		box_add_point(&x, e->samples[i].p);
		if (i)
			step = fmax(step, apart(e->samples[i].p, e->samples[i - 1].p));
	}
	more += 0.25 * step; /* the curve between samples */
	x.lo = vec3_sub(x.lo, vec3(more, more, more));
	x.hi = vec3_add(x.hi, vec3(more, more, more));
	return x;
}

struct stop {
	double t;
	int vertex;
};

static int by_parameter(const void *a, const void *b)
{
	const struct stop *p = a, *q = b;
	if (p->t != q->t)
		return p->t < q->t ? -1 : 1;
	return p->vertex - q->vertex;
}

/* First vertex that is not left of x; vertices rise in x. */
static int first_right_of(const struct mesh_build *b, double x)
{
	int lo = 0, hi = b->n_vertices;
	while (lo < hi) {
		const int mid = lo + (hi - lo) / 2;
		if (b->vertices[mid].p.x < x)
			lo = mid + 1;
		else
			hi = mid;
	}
	return lo;
}

/* Part edge k at the vertices of others that lie on it. */
static enum status part_at_vertices(struct mesh_build *b, int k)
{
	const struct mesh_edge *e = &b->edges[k];
	const double join = b->limits->join;
	const struct box x = edge_box(e, join);
	struct stop *stops = NULL;
	int n = 0, room = 0;
	enum status st = ST_OK;
	for (int i = first_right_of(b, x.lo.x);
	     i < b->n_vertices && b->vertices[i].p.x <= x.hi.x && st == ST_OK; i++) {
		const struct vec3 p = b->vertices[i].p;
		double t;
		if (i == e->vertex[0] || i == e->vertex[1] || p.y < x.lo.y || p.y > x.hi.y ||
		    p.z < x.lo.z || p.z > x.hi.z || mesh_edge_nearest(b, e, p, &t) > join ||
		    t <= e->t[0] || t >= e->t[1])
			continue;
		st = mesh_grow((void **)&stops, &room, n + 1, sizeof *stops);
		if (st == ST_OK)
			stops[n++] = (struct stop){ t, i };
	}
	double *t = n ? malloc((size_t)n * sizeof *t) : NULL;
	int *vertex = n ? malloc((size_t)n * sizeof *vertex) : NULL;
	if (n && (!t || !vertex))
		st = ST_RESOURCE;
	if (n && st == ST_OK) {
		int m = 0;
		qsort(stops, (size_t)n, sizeof *stops, by_parameter);
		for (int i = 0; i < n; i++)
			if (!m || stops[i].t > t[m - 1]) {
				t[m] = stops[i].t;
				vertex[m++] = stops[i].vertex;
			}
		st = mesh_edge_part(b, k, t, vertex, m);
	}
	free(t);
	free(vertex);
	free(stops);
	return st;
}

static struct vec3 middle_point(const struct mesh_build *b, const struct mesh_edge *e, double f)
{
	return mesh_edge_point(b, e, e->t[0] + f * (e->t[1] - e->t[0]));
}

/* e runs along m, which ends in the same vertices; then *reversed. */
static bool runs_along(const struct mesh_build *b, const struct mesh_edge *e,
                       const struct mesh_edge *m, bool *reversed)
{
	double t[3], s;
	for (int i = 0; i < 3; i++) {
		if (mesh_edge_nearest(b, m, middle_point(b, e, 0.25 * (i + 1)), &t[i]) >
		    2 * b->limits->join)
			return false;
		/* and back: one may be longer than the other */
		if (mesh_edge_nearest(b, e, middle_point(b, m, 0.25 * (i + 1)), &s) >
		    2 * b->limits->join)
			return false;
	}
	if (m->vertex[0] == m->vertex[1])
		*reversed = t[0] > t[2];
	else
		*reversed = e->vertex[0] != m->vertex[0];
	return true;
}

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

static enum status find_masters(struct mesh_build *b)
{
	struct pair *p = malloc((size_t)b->n_edges * sizeof *p);
	if (!p)
		return ST_RESOURCE;
	for (int k = 0; k < b->n_edges; k++) {
		const int *v = b->edges[k].vertex;
		p[k] = (struct pair){ v[0] < v[1] ? v[0] : v[1], v[0] < v[1] ? v[1] : v[0], k };
	}
	qsort(p, (size_t)b->n_edges, sizeof *p, by_vertices);
	for (int i = 0; i < b->n_edges; i++) {
		struct mesh_edge *e = &b->edges[p[i].edge];
		for (int k = i - 1; k >= 0 && !e->degenerate && e->master == p[i].edge &&
		                    p[k].low == p[i].low && p[k].high == p[i].high;
		     k--) {
			const struct mesh_edge *m = &b->edges[p[k].edge];
			if (m->master == p[k].edge && !m->degenerate &&
			    runs_along(b, e, m, &e->reversed))
				e->master = p[k].edge;
		}
	}
	free(p);
	return ST_OK;
}

enum status mesh_join(struct mesh_build *b)
{
	enum status st = find_vertices(b);
	if (st != ST_OK)
		return st;
	find_degenerate(b);
	const int n = b->n_edges;
	for (int k = 0; k < n && st == ST_OK; k++) {
		if (b->stop && atomic_load_explicit(b->stop, memory_order_relaxed))
			return ST_CANCELLED;
		if (!b->edges[k].degenerate)
			st = part_at_vertices(b, k);
	}
	if (st == ST_OK)
		find_degenerate(b);
	return st == ST_OK ? find_masters(b) : st;
}
