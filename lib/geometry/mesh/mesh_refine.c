/* mesh_refine.c - points inside a face where its triangles are too coarse. */
#include <stdlib.h>

#include "mesh_face.h"

/* Shorter edges, in the net's coordinates, are left: where a surface breaks no triangle is ever near
 * enough. 2^15 of them make a whole side. */
enum { SHORTEST = 1 << 12, DEPTH_MAX = 20 };

/* A vertex at whole coordinates; its parameters follow from them, or are given. */
static enum status add_vertex(struct mesh_face *f, const int32_t at[2], const double uv[2],
                              int *vertex)
{
	const int before = f->net.n;
	enum status st = net_add(&f->net, at[0], at[1], vertex);
	if (st == ST_OK && *vertex >= before)
		st = mesh_face_place(f, *vertex, uv, -1);
	return st;
}

static void parameters_at(const struct mesh_face *f, const int32_t at[2], double uv[2])
{
	for (int d = 0; d < 2; d++) {
		const double *range = f->range[d];
		uv[d] = range[0] + (range[1] - range[0]) * ((double)at[d] / f->side[d]);
	}
}

/* A sharp line from vertex a to b, both on u = c (d = 0) or v = c: parted until it is fine. */
static enum status crease_between(struct mesh_face *f, int d, double c, int a, int b, int depth)
{
	const int32_t at[2] = { (f->net.at[a][0] + f->net.at[b][0]) / 2,
		                (f->net.at[a][1] + f->net.at[b][1]) / 2 };
	double uv[2], near[2];
	int patch[2], middle;
	parameters_at(f, at, uv);
	uv[d] = c;
	for (int k = 0; k < 2; k++) {
		near[1 - d] = uv[1 - d];
		near[d] = k ? nextafter(c, INFINITY) : nextafter(c, -INFINITY);
		patch[k] = mesh_patch_of(f->creases, near);
	}
	const bool room = abs(f->net.at[a][1 - d] - f->net.at[b][1 - d]) > SHORTEST;
	if (!room || depth >= DEPTH_MAX ||
	    !(mesh_face_coarse(f, a, b, patch[0]) || mesh_face_coarse(f, a, b, patch[1])))
		return net_fix(&f->net, a, b, NET_FIXED);
	enum status st = add_vertex(f, at, uv, &middle);
	if (st == ST_OK && middle < 0)
		return net_fix(&f->net, a, b, NET_FIXED);
	if (st == ST_OK)
		st = crease_between(f, d, c, a, middle, depth + 1);
	return st == ST_OK ? crease_between(f, d, c, middle, b, depth + 1) : st;
}

struct on_line {
	int32_t at;
	int vertex;
};

static int by_coordinate(const void *a, const void *b)
{
	const struct on_line *p = a, *q = b;
	return (p->at > q->at) - (p->at < q->at);
}

/* Where creases of both directions meet inside the face there is a vertex. */
static enum status add_crossings(struct mesh_face *f, double c)
{
	enum status st = ST_OK;
	for (int j = 0; j < f->creases->n[1] && st == ST_OK; j++) {
		const double uv[2] = { c, f->creases->at[1][j] };
		int32_t at[2];
		int vertex;
		if (!(uv[1] > f->range[1][0] && uv[1] < f->range[1][1]))
			continue;
		mesh_face_at(f, uv, at);
		if (f->net.triangles[net_find(&f->net, at[0], at[1])].inside)
			st = add_vertex(f, at, uv, &vertex);
	}
	return st;
}

static enum status add_crease(struct mesh_face *f, int d, double c)
{
	const double uv[2] = { c, c };
	struct on_line *on = NULL;
	int32_t line[2];
	int n = 0, room = 0;
	enum status st = d == 0 ? add_crossings(f, c) : ST_OK;
	mesh_face_at(f, uv, line);
	for (int i = 4; i < f->net.n && st == ST_OK; i++)
		if (f->net.at[i][d] == line[d]) {
			st = mesh_grow((void **)&on, &room, n + 1, sizeof *on);
			if (st == ST_OK)
				on[n++] = (struct on_line){ f->net.at[i][1 - d], i };
		}
	if (n)
		qsort(on, (size_t)n, sizeof *on, by_coordinate);
	for (int i = 0; i + 1 < n && st == ST_OK; i++) {
		int32_t middle[2];
		middle[d] = line[d];
		middle[1 - d] = (on[i].at + on[i + 1].at) / 2;
		if (!net_is_fixed(&f->net, on[i].vertex, on[i + 1].vertex) &&
		    f->net.triangles[net_find(&f->net, middle[0], middle[1])].inside)
			st = crease_between(f, d, c, on[i].vertex, on[i + 1].vertex, 0);
	}
	free(on);
	return st;
}

enum status mesh_face_creases(struct mesh_face *f)
{
	enum status st = ST_OK;
	for (int d = 0; d < 2; d++)
		for (int k = 0; k < f->creases->n[d] && st == ST_OK; k++)
			if (f->creases->at[d][k] > f->range[d][0] &&
			    f->creases->at[d][k] < f->range[d][1])
				st = add_crease(f, d, f->creases->at[d][k]);
	return st;
}

/* The surface strays from the plane of a triangle between its corners. */
static bool is_domed(const struct mesh_face *f, const int v[3])
{
	const struct mesh_place *p[3] = { &f->places[v[0]], &f->places[v[1]], &f->places[v[2]] };
	const struct vec3 n =
	        vec3_unit(vec3_cross(vec3_sub(p[1]->p, p[0]->p), vec3_sub(p[2]->p, p[0]->p)));
	double wiggles = 0;
	for (int d = 0; d < 2; d++) {
		const double a = p[0]->uv[d], b = p[1]->uv[d], c = p[2]->uv[d];
		wiggles += 0.5 * (fmax(a, fmax(b, c)) - fmin(a, fmin(b, c))) / f->span[d] *
		           (f->s->order[d] - 1);
	}
	const int m = wiggles > 12 ? 12 : wiggles > 1 ? (int)ceil(wiggles) : 1;
	for (int i = 0; i < m; i++)
		for (int j = 0; i + j < m; j++) {
			const double a = (i + 1.0 / 3) / m, b = (j + 1.0 / 3) / m, c = 1 - a - b;
			const struct vec3 q = surface_point(
			        f->s, a * p[0]->uv[0] + b * p[1]->uv[0] + c * p[2]->uv[0],
			        a * p[0]->uv[1] + b * p[1]->uv[1] + c * p[2]->uv[1]);
			if (fabs(vec3_dot(n, vec3_sub(q, p[0]->p))) > f->b->limits->chord)
				return true;
		}
	return false;
}

/* Put a vertex at that place in triangle t, or across its edge i. *done: it was possible. */
static enum status insert(struct mesh_face *f, int t, int i, const int32_t at[2], bool *done)
{
	int vertex;
	double uv[2];
	enum status st = net_add_in(&f->net, t, at[0], at[1], &vertex);
	if (st == ST_OK && vertex < 0 && i >= 0 && f->net.triangles[t].next[i] >= 0)
		st = net_add_in(&f->net, f->net.triangles[t].next[i], at[0], at[1], &vertex);
	*done = vertex >= 0;
	if (st != ST_OK || vertex < 0)
		return st;
	parameters_at(f, at, uv);
	return mesh_face_place(f, vertex, uv, -1);
}

/* Look at one triangle; part it where it is too coarse. */
static enum status refine_triangle(struct mesh_face *f, int t, bool *parted)
{
	static const int turn[3] = { 1, 2, 0 }, back[3] = { 2, 0, 1 };
	const struct net_triangle x = f->net.triangles[t];
	double length[3], center[2];
	bool bad[3], any = false;
	for (int d = 0; d < 2; d++)
		center[d] = (f->places[x.v[0]].uv[d] + f->places[x.v[1]].uv[d] +
		             f->places[x.v[2]].uv[d]) /
		            3;
	const int patch = mesh_patch_of(f->creases, center);
	for (int i = 0; i < 3; i++) {
		const int32_t *a = f->net.at[x.v[turn[i]]], *b = f->net.at[x.v[back[i]]];
		const bool free_edge = !(x.edge[i] & NET_FIXED);
		length[i] = free_edge ? hypot(a[0] - b[0], a[1] - b[1]) : 0;
		bad[i] = free_edge && mesh_face_coarse(f, x.v[turn[i]], x.v[back[i]], patch);
		any |= bad[i];
	}
	*parted = false;
	if (!any) {
		if (!is_domed(f, x.v))
			return ST_OK;
		for (int i = 0; i < 3; i++)
			bad[i] = length[i] > 0;
	}
	/* the longest first */
	for (int n = 0; n < 3; n++) {
		int i = -1;
		for (int k = 0; k < 3; k++)
			if (bad[k] && (i < 0 || length[k] > length[i]))
				i = k;
		if (i < 0)
			break;
		bad[i] = false;
		const int32_t *a = f->net.at[x.v[turn[i]]], *b = f->net.at[x.v[back[i]]];
		const int32_t at[2] = { (a[0] + b[0]) / 2, (a[1] + b[1]) / 2 };
		enum status st = length[i] > SHORTEST ? insert(f, t, i, at, parted) : ST_OK;
		if (st != ST_OK || *parted)
			return st;
	}
	int32_t at[2];
	for (int d = 0; d < 2; d++)
		at[d] = (int32_t)(((int64_t)f->net.at[x.v[0]][d] + f->net.at[x.v[1]][d] +
		                   f->net.at[x.v[2]][d]) /
		                  3);
	const double most = fmax(length[0], fmax(length[1], length[2]));
	return any || most > 0 ? ST_OK : insert(f, t, -1, at, parted);
}

/* Twice the area over the square of the longest edge; 0 for a triangle that is a line. */
static double shape_of(const struct mesh_face *f, int a, int b, int c)
{
	const struct vec3 *at = f->b->out->points;
	const struct vec3 p = at[f->places[a].point], q = at[f->places[b].point],
	                  r = at[f->places[c].point];
	const struct vec3 x = vec3_sub(q, p), y = vec3_sub(r, p), z = vec3_sub(r, q);
	const double most = fmax(vec3_dot(x, x), fmax(vec3_dot(y, y), vec3_dot(z, z)));
	return most > 0 ? vec3_length(vec3_cross(x, y)) / most : 0;
}

/*
 * Triangles that are lines in space, as two points of one ray and the pole: the edge that covers
 * the other two is turned, so that none is left and no gap made.
 */
static void turn_slivers(struct mesh_face *f)
{
	static const int turn[3] = { 1, 2, 0 }, back[3] = { 2, 0, 1 };
	static const double sliver = 1e-6;
	bool changed = true;
	for (int pass = 0; pass < 8 && changed; pass++) {
		changed = false;
		for (int t = 0; t < f->net.n_triangles; t++) {
			const struct net_triangle x = f->net.triangles[t];
			const struct mesh_place *p[3];
			int i = 0;
			for (int k = 0; k < 3; k++)
				p[k] = &f->places[x.v[k]];
			if (!x.inside || p[0]->point == p[1]->point || p[1]->point == p[2]->point ||
			    p[2]->point == p[0]->point ||
			    shape_of(f, x.v[0], x.v[1], x.v[2]) > sliver)
				continue;
			double longest = 0;
			for (int k = 0; k < 3; k++) {
				const struct vec3 *at = f->b->out->points;
				const struct vec3 e =
				        vec3_sub(at[p[turn[k]]->point], at[p[back[k]]->point]);
				if (vec3_dot(e, e) > longest) {
					longest = vec3_dot(e, e);
					i = k;
				}
			}
			const int beyond = net_beyond(&f->net, t, i);
			if (beyond < 0 || !(shape_of(f, x.v[i], x.v[turn[i]], beyond) > sliver) ||
			    !(shape_of(f, x.v[i], beyond, x.v[back[i]]) > sliver))
				continue;
			net_turn(&f->net, t, i);
			changed = true;
		}
	}
}

static enum status refine_all(struct mesh_face *f)
{
	for (bool changed = true; changed;) {
		changed = false;
		for (int t = 0; t < f->net.n_triangles; t++) {
			bool parted;
			if (!f->net.triangles[t].inside || f->net.triangles[t].done)
				continue;
			if (f->net.n_triangles > TESSELLATE_MOST - f->b->out->n_triangles)
				return mesh_too_many(f->b);
			enum status st = t % 1024 ? ST_OK
			                          : mesh_step(f->b, MESH_FILL, 64 * f->face,
			                                      64 * f->b->n_faces);
			if (st != ST_OK)
				return st;
			st = refine_triangle(f, t, &parted);
			if (st != ST_OK)
				return st;
			if (!parted)
				f->net.triangles[t].done = true;
			changed |= parted;
		}
	}
	return ST_OK;
}

enum status mesh_face_refine(struct mesh_face *f)
{
	enum status st = refine_all(f);
	if (st == ST_OK)
		turn_slivers(f);
	return st;
}
