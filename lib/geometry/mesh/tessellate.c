/* tessellate.c - triangles of surfaces: the steps, and the mesh that grows. */
#include "tessellate.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "mesh_private.h"

/* Normals at one point that differ less are one. */
static const double same_normal = 1e-7;

void mesh_finish(struct mesh *m)
{
	if (!m)
		return;
	free(m->points);
	free(m->normals);
	free(m->triangles);
	free(m->parameters);
	free(m->parts);
	*m = (struct mesh){ 0 };
}

enum status mesh_grow(void **p, int *room, int n, size_t size)
{
	if (n <= *room)
		return ST_OK;
	const int64_t twice = (int64_t)*room * 2;
	const int more = twice > INT32_MAX ? INT32_MAX : twice > n ? (int)twice : n;
	void *q = reallocarray(*p, (size_t)more, size);
	if (!q)
		return ST_RESOURCE;
	*p = q;
	*room = more;
	return ST_OK;
}

enum status mesh_add_point(struct mesh_build *b, struct vec3 p, int *point)
{
	struct mesh *m = b->out;
	enum status st =
	        mesh_grow((void **)&m->points, &b->points_room, m->n_points + 1, sizeof *m->points);
	if (st == ST_OK)
		st = mesh_grow((void **)&b->heads, &b->heads_room, m->n_points + 1,
		               sizeof *b->heads);
	if (st == ST_OK)
		st = mesh_grow((void **)&b->same, &b->same_room, m->n_points + 1, sizeof *b->same);
	if (st != ST_OK)
		return st;
	m->points[m->n_points] = p;
	b->same[m->n_points] = m->n_points;
	b->heads[m->n_points] = -1;
	*point = m->n_points++;
	return ST_OK;
}

int mesh_point_root(struct mesh_build *b, int point)
{
	while (b->same[point] != point)
		point = b->same[point] = b->same[b->same[point]];
	return point;
}

void mesh_point_unite(struct mesh_build *b, int point, int other)
{
	const int p = mesh_point_root(b, point), q = mesh_point_root(b, other);
	b->same[p > q ? p : q] = p > q ? q : p;
}

enum status mesh_add_normal(struct mesh_build *b, int point, struct vec3 normal, int *out)
{
	struct mesh *m = b->out;
	for (int k = b->heads[point]; k >= 0; k = b->next_normal[k])
		if (vec3_length(vec3_sub(m->normals[k], normal)) <= same_normal) {
			*out = k;
			return ST_OK;
		}
	enum status st = mesh_grow((void **)&m->normals, &b->normals_room, m->n_normals + 1,
	                           sizeof *m->normals);
	if (st == ST_OK)
		st = mesh_grow((void **)&b->next_normal, &b->next_room, m->n_normals + 1,
		               sizeof *b->next_normal);
	if (st != ST_OK)
		return st;
	*out = m->n_normals++;
	m->normals[*out] = normal;
	b->next_normal[*out] = b->heads[point];
	b->heads[point] = *out;
	return ST_OK;
}

enum status mesh_add_triangle(struct mesh_build *b, const struct mesh_corner corner[3],
                              const double uv[3][2])
{
	struct mesh *m = b->out;
	enum status st = mesh_grow((void **)&m->triangles, &b->triangles_room, m->n_triangles + 1,
	                           sizeof *m->triangles);
	if (st == ST_OK && b->limits->parameters) {
		st = mesh_grow((void **)&m->parameters, &b->parameters_room, m->n_triangles + 1,
		               sizeof *m->parameters);
		if (st == ST_OK)
			memcpy(m->parameters[m->n_triangles], uv, sizeof *m->parameters);
	}
	if (st == ST_OK)
		memcpy(m->triangles[m->n_triangles++], corner, sizeof *m->triangles);
	return st;
}

static void build_finish(struct mesh_build *b)
{
	for (int k = 0; k < b->n_edges; k++)
		mesh_edge_finish(&b->edges[k]);
	for (int f = 0; b->creases && f < b->n_faces; f++) {
		free(b->creases[f].at[0]);
		free(b->creases[f].at[1]);
	}
	free(b->edges);
	free(b->loops);
	free(b->creases);
	free(b->vertices);
	free(b->groups);
	free(b->first_loop);
	free(b->turned);
	free(b->same);
	free(b->members);
	free(b->heads);
	free(b->next_normal);
}

/* All faces; one whose loops cannot be cut is left out, said so. */
static enum status fill_all(struct mesh_build *b)
{
	struct mesh *m = b->out;
	enum status st = ST_OK;
	m->parts = calloc((size_t)b->n_faces, sizeof *m->parts);
	if (!m->parts)
		return ST_RESOURCE;
	m->n_parts = b->n_faces;
	for (int f = 0; f < b->n_faces && st == ST_OK; f++) {
		m->parts[f].first = m->n_triangles;
		st = mesh_fill(b, f);
		if (st == ST_INPUT) {
			report_warning(
			        b->r,
			        "face %d is left out: its loops cross each other when cut to "
			        "the tolerance; give a smaller one",
			        f + 1);
			m->n_triangles = m->parts[f].first;
			st = ST_OK;
		}
		m->parts[f].count = m->n_triangles - m->parts[f].first;
	}
	return st;
}

enum status tessellate(struct mesh *out, const struct tessellate_face *faces, int n,
                       const struct tessellate_limits *limits, const atomic_bool *stop,
                       const struct report *r)
{
	struct mesh_build b = {
		.faces = faces, .n_faces = n, .limits = limits, .stop = stop, .r = r, .out = out
	};
	*out = (struct mesh){ 0 };
	if (!(limits->chord > 0) || !(limits->angle > 0) || !(limits->join >= 0) || n < 1)
		return report_error(r, ST_PARAMETER,
		                    "triangles need a face, a distance and an angle above 0");
	enum status st = mesh_collect_edges(&b);
	if (st == ST_OK)
		st = mesh_join(&b);
	if (st == ST_OK)
		st = mesh_cut(&b);
	if (st == ST_OK)
		st = mesh_uncross(&b);
	if (st == ST_OK)
		st = fill_all(&b);
	if (st == ST_OK && limits->orient)
		st = mesh_orient(&b);
	if (st == ST_OK)
		st = mesh_settle(&b);
	build_finish(&b);
	if (st != ST_OK)
		mesh_finish(out);
	return st;
}

static int by_ends(const void *a, const void *b)
{
	const int *p = a, *q = b;
	return p[0] != q[0] ? (p[0] > q[0]) - (p[0] < q[0]) : (p[1] > q[1]) - (p[1] < q[1]);
}

enum status mesh_open_edges(const struct mesh *m, int *out)
{
	const size_t n = 3 * (size_t)m->n_triangles;
	int(*e)[2] = malloc((n ? n : 1) * sizeof *e);
	if (!e)
		return ST_RESOURCE;
	for (size_t i = 0; i < n; i++) {
		const int p = m->triangles[i / 3][i % 3].point;
		const int q = m->triangles[i / 3][(i + 1) % 3].point;
		e[i][0] = p < q ? p : q;
		e[i][1] = p < q ? q : p;
	}
	qsort(e, n, sizeof *e, by_ends);
	*out = 0;
	for (size_t i = 0; i < n;) {
		size_t k = i + 1;
		while (k < n && by_ends(e[k], e[i]) == 0)
			k++;
		*out += k - i != 2;
		i = k;
	}
	free(e);
	return ST_OK;
}
