/* mesh_made.c - triangles of a surface made ready for the graphics memory. */
#include "mesh_made.h"

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
	mesh_finish(&m);
	if (st != ST_OK)
		mesh_made_finish(out);
	return st;
}
