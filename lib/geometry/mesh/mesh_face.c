/* mesh_face.c - the triangles of one face between its borders. */
#include "mesh_face.h"

#include <stdlib.h>
#include <string.h>

void mesh_face_at(const struct mesh_face *f, const double uv[2], int32_t at[2])
{
	for (int d = 0; d < 2; d++) {
		const double *range = f->range[d];
		const double x = (uv[d] - range[0]) / (range[1] - range[0]);
		at[d] = (int32_t)lrint(fmin(fmax(x, 0), 1) * f->side[d]);
	}
}

enum status mesh_face_place(struct mesh_face *f, int vertex, const double uv[2], int point)
{
	enum status st =
	        mesh_grow((void **)&f->places, &f->places_room, vertex + 1, sizeof *f->places);
	if (st != ST_OK)
		return st;
	struct mesh_place *x = &f->places[vertex];
	*x = (struct mesh_place){ .uv = { uv[0], uv[1] }, .point = point, .patch = -1 };
	x->p = surface_point(f->s, uv[0], uv[1]);
	return point >= 0 ? ST_OK : mesh_add_point(f->b, x->p, &x->point);
}

struct vec3 mesh_face_normal(struct mesh_face *f, int vertex, int patch)
{
	struct mesh_place *x = &f->places[vertex];
	if (x->patch == patch)
		return x->normal;
	const struct vec3 n = mesh_patch_normal(f->s, f->creases, patch, x->uv);
	if (x->patch < 0) {
		x->patch = patch;
		x->normal = n;
	}
	return n;
}

bool mesh_face_coarse(struct mesh_face *f, int a, int b, int patch)
{
	const struct tessellate_limits *l = f->b->limits;
	const struct mesh_place p = f->places[a], q = f->places[b];
	const struct vec3 d = vec3_sub(q.p, p.p);
	const double du = q.uv[0] - p.uv[0], dv = q.uv[1] - p.uv[1], dd = vec3_dot(d, d);
	const double wiggles = 0.5 * (fabs(du) / f->span[0] * (f->s->order[0] - 1) +
	                              fabs(dv) / f->span[1] * (f->s->order[1] - 1));
	const int n = (int)fmin(ceil(wiggles), 24) > 1 ? (int)fmin(ceil(wiggles), 24) : 1;
	for (int i = 1; i <= n; i++) {
		const double t = (double)i / (n + 1);
		const struct vec3 w =
		        vec3_sub(surface_point(f->s, p.uv[0] + t * du, p.uv[1] + t * dv), p.p);
		const double at = dd > 0 ? fmin(fmax(vec3_dot(w, d) / dd, 0), 1) : 0;
		if (vec3_length(vec3_along(w, -at, d)) > l->chord)
			return true;
	}
	if (!(dd > l->chord * l->chord))
		return false;
	const struct vec3 m = mesh_face_normal(f, a, patch), k = mesh_face_normal(f, b, patch);
	return atan2(vec3_length(vec3_cross(m, k)), vec3_dot(m, k)) > l->angle; /* NaN: false */
}

/* A normal for a corner where the surface has none, a tip: from a little inside the triangle, as seen
 * between the other two corners. */
static struct vec3 normal_inside(struct mesh_face *f, const int v[3], int k, int patch)
{
	const double *uv = f->places[v[k]].uv, *p = f->places[v[(k + 1) % 3]].uv,
	             *q = f->places[v[(k + 2) % 3]].uv;
	struct vec3 at, du, dv;
	double beside[2];
	surface_tangents(f->s, uv[0], uv[1], &at, &du, &dv);
	/* the parameter in which the surface stands still runs about the tip */
	const int about = vec3_length(du) * f->span[0] < vec3_length(dv) * f->span[1] ? 0 : 1;
	beside[about] = 0.5 * (p[about] + q[about]);
	beside[1 - about] =
	        uv[1 - about] + 1e-3 * (0.5 * (p[1 - about] + q[1 - about]) - uv[1 - about]);
	const struct vec3 n = mesh_patch_normal(f->s, f->creases, patch, beside);
	if (isfinite(n.x))
		return n;
	const struct vec3 a = f->places[v[0]].p;
	return vec3_unit(
	        vec3_cross(vec3_sub(f->places[v[1]].p, a), vec3_sub(f->places[v[2]].p, a)));
}

static enum status emit(struct mesh_face *f, const int v[3])
{
	struct mesh_corner corner[3];
	double center[2], uv[3][2];
	enum status st = ST_OK;
	for (int k = 0; k < 3; k++) {
		corner[k].point = f->places[v[k]].point;
		memcpy(uv[k], f->places[v[k]].uv, sizeof uv[k]);
	}
	/* at a pole two corners are one point */
	if (corner[0].point == corner[1].point || corner[1].point == corner[2].point ||
	    corner[2].point == corner[0].point)
		return ST_OK;
	for (int d = 0; d < 2; d++)
		center[d] =
		        (f->places[v[0]].uv[d] + f->places[v[1]].uv[d] + f->places[v[2]].uv[d]) / 3;
	const int patch = mesh_patch_of(f->creases, center);
	for (int k = 0; k < 3 && st == ST_OK; k++) {
		struct vec3 n = mesh_face_normal(f, v[k], patch);
		if (!isfinite(n.x))
			n = normal_inside(f, v, k, patch);
		st = mesh_add_normal(f->b, corner[k].point, n, &corner[k].normal);
	}
	return st == ST_OK ? mesh_add_triangle(f->b, corner, (const double(*)[2])uv) : st;
}

enum status mesh_face_init(struct mesh_face *f, struct mesh_build *b, int face)
{
	*f = (struct mesh_face){
		.b = b, .face = face, .s = b->faces[face].surface, .creases = &b->creases[face]
	};
	mesh_face_measure(f);
	return net_init(&f->net);
}

void mesh_face_finish(struct mesh_face *f)
{
	net_finish(&f->net);
	free(f->places);
}

enum status mesh_fill(struct mesh_build *b, int face)
{
	struct mesh_face f;
	struct mesh_flaws flaws = { 0 };
	enum status st = mesh_face_init(&f, b, face);
	if (st == ST_OK)
		st = mesh_face_border(&f, &flaws);
	if (st == ST_OK && flaws.crossed)
		st = ST_INPUT;
	if (st == ST_OK)
		st = mesh_face_creases(&f);
	if (st == ST_OK)
		st = mesh_face_refine(&f);
	for (int t = 0; t < f.net.n_triangles && st == ST_OK; t++)
		if (f.net.triangles[t].inside)
			st = emit(&f, f.net.triangles[t].v);
	mesh_flaws_finish(&flaws);
	mesh_face_finish(&f);
	return st;
}
