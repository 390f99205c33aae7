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
	if (st == ST_OK && b->parameters) {
		st = mesh_grow((void **)&m->parameters, &b->parameters_room, m->n_triangles + 1,
		               sizeof *m->parameters);
		if (st == ST_OK)
			memcpy(m->parameters[m->n_triangles], uv, sizeof *m->parameters);
	}
	if (st == ST_OK)
		memcpy(m->triangles[m->n_triangles++], corner, sizeof *m->triangles);
	return st;
}

enum status mesh_too_many(struct mesh_build *b)
{
	b->told = true;
	return report_error(b->r, ST_RESOURCE,
	                    "more than %d triangles are needed to come within %g; give a larger "
	                    "tolerance",
	                    TESSELLATE_MOST, b->limits->chord);
}

enum status mesh_step(const struct mesh_build *b, enum mesh_stage stage, int i, int n)
{
	/* of a hundred, by how long each takes where there are many faces */
	static const int starts[N_MESH_STAGES + 1] = { 0, 5, 35, 45, 55, 100 };
	const struct tessellate_watch *w = b->watch;
	if (!w || i % 64)
		return ST_OK;
	if (w->step)
		w->step(w->data, 0.01 * (starts[stage] +
		                         (starts[stage + 1] - starts[stage]) * ((double)i / n)));
	return w->stop && atomic_load_explicit(w->stop, memory_order_relaxed) ? ST_CANCELLED
	                                                                      : ST_OK;
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
		st = mesh_step(b, MESH_FILL, f, b->n_faces);
		if (st == ST_OK)
			st = mesh_fill(b, f);
		if (st == ST_INPUT) {
			report_warning(
			        b->r,
			        "face %d is left out: its trimming loops cross each other; "
			        "mend them, or give a smaller tolerance if they only do when "
			        "cut to this one",
			        f + 1);
			m->n_triangles = m->parts[f].first;
			st = ST_OK;
		}
		m->parts[f].count = m->n_triangles - m->parts[f].first;
	}
	return st;
}

/* What is far too many is said at once, not after minutes. */
static enum status look_ahead(struct mesh_build *b)
{
	static const double sure = 8;
	double sum = 0;
	for (int f = 0; f < b->n_faces; f++)
		sum += mesh_estimate(b, f);
	return sum > sure * TESSELLATE_MOST ? mesh_too_many(b) : ST_OK;
}

enum status tessellate(struct mesh *out, const struct tessellate_face *faces, int n,
                       const struct tessellate_limits *limits, const struct tessellate_watch *watch,
                       const struct report *r)
{
	struct mesh_build b = { .faces = faces,
		                .n_faces = n,
		                .limits = limits,
		                .watch = watch,
		                .r = r,
		                .out = out,
		                .parameters = true };
	*out = (struct mesh){ 0 };
	if (!(limits->chord > 0) || !(limits->angle > 0) || !(limits->join >= 0) || n < 1)
		return report_error(r, ST_PARAMETER,
		                    "triangles need a face, a distance and an angle above 0");
	enum status st = mesh_collect_edges(&b);
	if (st == ST_OK)
		st = look_ahead(&b);
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
	out->gap = b.gap;
	build_finish(&b);
	if (st != ST_OK)
		mesh_finish(out);
	if (st == ST_RESOURCE && !b.told)
		report_error(r, st, "memory ran out making triangles; give a larger tolerance");
	return st;
}
