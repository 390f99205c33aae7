/* mesh_edges.c - the edges of the loops around faces. */
#include <stdlib.h>
#include <string.h>

#include "mesh_private.h"

enum status mesh_add_vertex(struct mesh_build *b, struct vec3 p, int *vertex)
{
	enum status st = mesh_grow((void **)&b->vertices, &b->vertices_room, b->n_vertices + 1,
	                           sizeof *b->vertices);
	*vertex = b->n_vertices;
	if (st == ST_OK)
		b->vertices[b->n_vertices++] = (struct mesh_vertex){ p, *vertex, -1 };
	return st;
}

enum status mesh_edge_part(struct mesh_build *b, int k, const double *t, const int *vertex, int m)
{
	enum status st =
	        mesh_grow((void **)&b->edges, &b->edges_room, b->n_edges + m, sizeof *b->edges);
	for (int i = 0; i < m && st == ST_OK; i++) {
		const int fresh = b->n_edges++;
		int at = vertex[i];
		if (at < 0)
			st = mesh_add_vertex(b, mesh_edge_point(b, &b->edges[k], t[i]), &at);
		b->edges[fresh] = b->edges[k];
		b->edges[fresh].samples = NULL;
		b->edges[fresh].nodes = NULL;
		b->edges[fresh].t[0] = t[i];
		b->edges[fresh].vertex[0] = at;
		b->edges[fresh].master = fresh;
		b->edges[k].t[1] = t[i];
		b->edges[k].vertex[1] = at;
		b->edges[k].next = fresh;
		if (st == ST_OK)
			st = mesh_edge_sample(b, &b->edges[k]);
		k = fresh;
	}
	return st == ST_OK ? mesh_edge_sample(b, &b->edges[k]) : st;
}

/* Where the edge goes through u = c (d = 0) or v = c, by its samples. */
static double crossing(const struct mesh_build *b, const struct mesh_edge *e, int d, double c,
                       double lo, double hi)
{
	double uv[2];
	mesh_edge_uv(b, e, lo, uv);
	const bool below = uv[d] < c;
	for (int i = 0; i < 100 && hi > lo; i++) {
		const double t = 0.5 * (lo + hi);
		if (t <= lo || t >= hi)
			break;
		mesh_edge_uv(b, e, t, uv);
		if ((uv[d] < c) == below)
			lo = t;
		else
			hi = t;
	}
	return hi;
}

/* The first of the rising numbers x that is above c. */
static int first_above(const double *x, int n, double c)
{
	int lo = 0, hi = n;
	while (lo < hi) {
		const int mid = lo + (hi - lo) / 2;
		if (x[mid] <= c)
			lo = mid + 1;
		else
			hi = mid;
	}
	return lo;
}

/* Append to *t the parameters at which the edge crosses the creases of direction d. */
static enum status find_crossings(const struct mesh_build *b, const struct mesh_edge *e, int d,
                                  double **t, int *n, int *room)
{
	const struct mesh_creases *c = &b->creases[e->face];
	const double *domain = b->faces[e->face].surface->domain[d];
	const double near = MESH_ON_CREASE * (domain[1] - domain[0]);
	double last = NAN, last_t = 0; /* of the last sample that is on no crease */
	enum status st = ST_OK;
	for (int i = 0; i < e->n_samples && c->n[d] && st == ST_OK; i++) {
		double uv[2];
		mesh_edge_uv(b, e, e->samples[i].t, uv);
		const int above = first_above(c->at[d], c->n[d], uv[d] - near);
		if (above < c->n[d] && c->at[d][above] <= uv[d] + near)
			continue;
		const double lo = fmin(last, uv[d]), hi = fmax(last, uv[d]);
		for (int j = isnan(last) ? c->n[d] : first_above(c->at[d], c->n[d], lo);
		     j < c->n[d] && c->at[d][j] < hi && st == ST_OK; j++) {
			st = mesh_grow((void **)t, room, *n + 1, sizeof **t);
			if (st == ST_OK)
				(*t)[(*n)++] =
				        crossing(b, e, d, c->at[d][j], last_t, e->samples[i].t);
		}
		last = uv[d];
		last_t = e->samples[i].t;
	}
	return st;
}

static int by_value(const void *a, const void *b)
{
	const double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

static enum status part_at_creases(struct mesh_build *b, int k)
{
	const struct mesh_edge *e = &b->edges[k];
	double *t = NULL;
	int n = 0, room = 0, m = 0;
	enum status st = find_crossings(b, e, 0, &t, &n, &room);
	if (st == ST_OK)
		st = find_crossings(b, e, 1, &t, &n, &room);
	if (n)
		qsort(t, (size_t)n, sizeof *t, by_value);
	const double near = MESH_ON_CREASE * (e->t[1] - e->t[0]);
	for (int i = 0; i < n; i++)
		if (t[i] > (m ? t[m - 1] : e->t[0]) + near && t[i] < e->t[1] - near)
			t[m++] = t[i];
	int *none = m ? malloc((size_t)m * sizeof *none) : NULL;
	if (m && !none)
		st = ST_RESOURCE;
	for (int i = 0; i < m && none; i++)
		none[i] = -1;
	if (st == ST_OK && m)
		st = mesh_edge_part(b, k, t, none, m);
	free(none);
	free(t);
	return st;
}

static enum status add_edge(struct mesh_build *b, const struct mesh_edge *edge, int *last)
{
	enum status st =
	        mesh_grow((void **)&b->edges, &b->edges_room, b->n_edges + 1, sizeof *b->edges);
	if (st != ST_OK)
		return st;
	const int k = b->n_edges++;
	b->edges[k] = *edge;
	b->edges[k].next = -1;
	b->edges[k].master = k;
	st = mesh_add_vertex(b, mesh_edge_point(b, edge, edge->t[0]), &b->edges[k].vertex[0]);
	if (*last >= 0) {
		b->edges[*last].next = k;
		b->edges[*last].vertex[1] = b->edges[k].vertex[0];
	}
	if (st == ST_OK)
		st = mesh_edge_sample(b, &b->edges[k]);
	if (st == ST_OK)
		st = part_at_creases(b, k);
	*last = k;
	while (b->edges[*last].next >= 0)
		*last = b->edges[*last].next;
	return st;
}

static enum status add_loop(struct mesh_build *b, int face, bool outer)
{
	enum status st =
	        mesh_grow((void **)&b->loops, &b->loops_room, b->n_loops + 1, sizeof *b->loops);
	if (st == ST_OK)
		b->loops[b->n_loops++] = (struct mesh_loop){ face, b->n_edges, outer };
	return st;
}

/* The loop that ends with that edge. */
static void close_loop(struct mesh_build *b, int last)
{
	if (last >= 0)
		b->edges[last].vertex[1] = b->edges[b->loops[b->n_loops - 1].first].vertex[0];
}

static enum status collect_rectangle(struct mesh_build *b, int face)
{
	const struct surface *s = b->faces[face].surface;
	const double *u = s->domain[0], *v = s->domain[1];
	const double corner[5][2] = {
		{ u[0], v[0] }, { u[1], v[0] }, { u[1], v[1] }, { u[0], v[1] }, { u[0], v[0] }
	};
	int last = -1;
	enum status st = add_loop(b, face, true);
	for (int k = 0; k < 4 && st == ST_OK; k++) {
		struct mesh_edge e = { .face = face, .t = { 0, 1 } };
		memcpy(e.a, corner[k], sizeof e.a);
		memcpy(e.b, corner[k + 1], sizeof e.b);
		st = add_edge(b, &e, &last);
	}
	close_loop(b, last);
	return st;
}

static enum status collect_loop(struct mesh_build *b, int face, const struct trim_loop *loop)
{
	int last = -1;
	enum status st = loop->n ? add_loop(b, face, loop->outer) : ST_OK;
	for (int k = 0; k < loop->n && st == ST_OK; k++) {
		const struct curve *c = &loop->curves[k];
		struct mesh_edge e = { .face = face, .uv = c, .t = { c->domain[0], c->domain[1] } };
		st = add_edge(b, &e, &last);
	}
	close_loop(b, last);
	return st;
}

enum status mesh_collect_edges(struct mesh_build *b)
{
	enum status st = ST_OK;
	b->creases = calloc((size_t)b->n_faces, sizeof *b->creases);
	b->first_loop = calloc((size_t)b->n_faces + 1, sizeof *b->first_loop);
	if (!b->creases || !b->first_loop)
		return ST_RESOURCE;
	for (int f = 0; f < b->n_faces && st == ST_OK; f++) {
		const struct trim *t = b->faces[f].trim;
		bool outer = false;
		st = mesh_step(b, MESH_COLLECT, f, b->n_faces);
		if (st != ST_OK)
			break;
		st = mesh_find_creases(&b->creases[f], b->faces[f].surface);
		for (int k = 0; t && k < t->n; k++)
			outer |= t->loops[k].outer;
		if (st == ST_OK && !outer)
			st = collect_rectangle(b, f);
		for (int k = 0; t && k < t->n && st == ST_OK; k++)
			st = collect_loop(b, f, &t->loops[k]);
		b->first_loop[f + 1] = b->n_loops;
	}
	return st;
}
