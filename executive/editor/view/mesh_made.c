/* mesh_made.c - triangles of a surface made ready for the graphics memory. */
#include "mesh_made.h"

#include <stdint.h>
#include <stdlib.h>

#include "tessellate.h"

void mesh_made_finish(struct mesh_made *m)
{
	free(m->vertices);
	free(m->indices);
	*m = (struct mesh_made){ 0 };
}

/* A vertex for each normal (each belongs to one point) and u, v there: a seam has two. */
struct gathering {
	const struct mesh *mesh;
	const struct surface *surface;
	struct vec3 origin;
	struct mesh_made *out;
	int *first; /* of each normal its first vertex, -1: none; then next */
	int *next;  /* room for one a corner */
};

static unsigned vertex_of(struct gathering *g, struct mesh_corner corner, const double uv[2])
{
	struct mesh_vertex_made v;
	struct vec3 p = vec3_sub(g->mesh->points[corner.point], g->origin);
	struct vec3 n = g->mesh->normals[corner.normal];
	for (int d = 0; d < 2; d++) {
		const double *range = g->surface->domain[d];
		v.uv[d] = (float)((uv[d] - range[0]) / (range[1] - range[0]));
	}
	for (int k = g->first[corner.normal]; k >= 0; k = g->next[k]) {
		const struct mesh_vertex_made *old = &g->out->vertices[k];
		if (old->uv[0] == v.uv[0] && old->uv[1] == v.uv[1])
			return (unsigned)k;
	}
	v.position[0] = (float)p.x, v.position[1] = (float)p.y, v.position[2] = (float)p.z;
	v.normal[0] = (float)n.x, v.normal[1] = (float)n.y, v.normal[2] = (float)n.z;
	int k = g->out->n_vertices++;
	g->out->vertices[k] = v;
	g->next[k] = g->first[corner.normal];
	g->first[corner.normal] = k;
	return (unsigned)k;
}

static enum status gather(struct mesh_made *out, const struct mesh *m, const struct surface *s,
                          struct vec3 origin)
{
	const size_t corners = 3 * (size_t)m->n_triangles;
	struct gathering g = { .mesh = m, .surface = s, .origin = origin, .out = out };
	g.first = malloc(((size_t)m->n_normals + 1) * sizeof *g.first);
	g.next = malloc((corners + 1) * sizeof *g.next);
	out->vertices = malloc((corners + 1) * sizeof *out->vertices);
	out->indices = malloc((corners + 1) * sizeof *out->indices);
	enum status st = g.first && g.next && out->vertices && out->indices ? ST_OK : ST_RESOURCE;
	for (int i = 0; i < m->n_normals && st == ST_OK; i++)
		g.first[i] = -1;
	for (int i = 0; i < m->n_triangles && st == ST_OK; i++)
		for (int k = 0; k < 3; k++)
			out->indices[out->n_indices++] =
			        vertex_of(&g, m->triangles[i][k], m->parameters[i][k]);
	free(g.first);
	free(g.next);
	return st;
}

/* An edge between points a < b of the mesh, and its vertices. */
struct edge {
	int a, b;
	unsigned vertex[2];
};

static int by_points(const void *x, const void *y)
{
	const struct edge *p = x, *q = y;
	return p->a != q->a ? p->a - q->a : p->b - q->b;
}

static uint64_t mixed(int point)
{
	uint64_t x = (uint64_t)point + 1;
	x = (x ^ x >> 31) * 0x9E3779B97F4A7C15U;
	return x ^ x >> 29;
}

/*
 * Which points lie on a border: an edge inside is run through both ways, and the neighbours that a point
 * is left to cancel those that it is come to from.
 */
static uint64_t *border_points(const struct mesh *m)
{
	uint64_t *sum = calloc((size_t)m->n_points + 1, sizeof *sum);
	for (int i = 0; i < m->n_triangles && sum; i++)
		for (int k = 0; k < 3; k++) {
			const int a = m->triangles[i][k].point;
			const int b = m->triangles[i][(k + 1) % 3].point;
			sum[a] += mixed(b);
			sum[b] -= mixed(a);
		}
	return sum;
}

/* Edges of one triangle only, behind the triangles. */
static enum status add_border(struct mesh_made *out, const struct mesh *m)
{
	uint64_t *at_border = border_points(m);
	struct edge *edges = NULL;
	unsigned *indices = NULL;
	int n = 0, room = 0;
	enum status st = at_border ? ST_OK : ST_RESOURCE;
	for (int i = 0; i < 3 * m->n_triangles && st == ST_OK; i++) {
		const int j = i % 3 == 2 ? i - 2 : i + 1;
		int a = m->triangles[i / 3][i % 3].point, b = m->triangles[j / 3][j % 3].point;
		if (!at_border[a] || !at_border[b])
			continue;
		if (n == room) {
			room = room ? 2 * room : 256;
			struct edge *more = reallocarray(edges, (size_t)room, sizeof *edges);
			if (!more) {
				st = ST_RESOURCE;
				break;
			}
			edges = more;
		}
		edges[n++] = (struct edge){ a < b ? a : b,
			                    a < b ? b : a,
			                    { out->indices[i], out->indices[j] } };
	}
	if (n)
		qsort(edges, (size_t)n, sizeof *edges, by_points);
	if (st == ST_OK)
		indices = reallocarray(out->indices, (size_t)out->n_indices + 2 * (size_t)n + 1,
		                       sizeof *indices);
	if (indices)
		out->indices = indices;
	else
		st = ST_RESOURCE;
	for (int i = 0, next; i < n && st == ST_OK; i = next) {
		for (next = i + 1; next < n && !by_points(&edges[i], &edges[next]);)
			next++;
		for (int k = 0; k < 2 && next == i + 1; k++)
			out->indices[out->n_indices + out->n_border++] = edges[i].vertex[k];
	}
	free(edges);
	free(at_border);
	return st;
}

enum status mesh_made_init(struct mesh_made *out, const struct surface *s, const struct trim *trim,
                           struct vec3 origin, double chord, double angle)
{
	const struct tessellate_face face = { .surface = s, .trim = trim };
	const struct tessellate_limits limits = {
		.chord = chord, .angle = angle, .join = 1e-6 * chord, .parameters = true
	};
	struct mesh m = { 0 };
	*out = (struct mesh_made){ 0 };
	enum status st = tessellate(&m, &face, 1, &limits, NULL, &report_none);
	if (st == ST_OK)
		st = gather(out, &m, s, origin);
	if (st == ST_OK)
		st = add_border(out, &m);
	mesh_finish(&m);
	if (st != ST_OK)
		mesh_made_finish(out);
	return st;
}
