/* mesh_edges.c - the edges of the loops around faces. */
#include <stdlib.h>
#include <string.h>

#include "mesh_private.h"

void mesh_edge_finish(struct mesh_edge *e)
{
	free(e->samples);
	free(e->nodes);
	e->samples = NULL;
	e->nodes = NULL;
}

static const struct surface *surface_of(const struct mesh_build *b, const struct mesh_edge *e)
{
	return b->faces[e->face].surface;
}

void mesh_edge_uv(const struct mesh_build *b, const struct mesh_edge *e, double t, double uv[2])
{
	const struct surface *s = surface_of(b, e);
	if (e->uv) {
		struct vec3 p = curve_point(e->uv, t);
		uv[0] = p.x;
		uv[1] = p.y;
	} else {
		for (int k = 0; k < 2; k++)
			uv[k] = t == 1 ? e->b[k] : e->a[k] + (e->b[k] - e->a[k]) * t;
	}
	for (int k = 0; k < 2; k++)
		uv[k] = fmin(fmax(uv[k], s->domain[k][0]), s->domain[k][1]);
}

struct vec3 mesh_edge_point(const struct mesh_build *b, const struct mesh_edge *e, double t)
{
	double uv[2];
	mesh_edge_uv(b, e, t, uv);
	return surface_point(surface_of(b, e), uv[0], uv[1]);
}

/* Point and derivative. */
static struct vec3 edge_tangent(const struct mesh_build *b, const struct mesh_edge *e, double t,
                                struct vec3 *p)
{
	double uv[2], d[2];
	struct vec3 du, dv;
	mesh_edge_uv(b, e, t, uv);
	if (e->uv) {
		struct vec3 c[2];
		curve_derivatives(e->uv, t, 1, c);
		d[0] = c[1].x;
		d[1] = c[1].y;
	} else {
		d[0] = e->b[0] - e->a[0];
		d[1] = e->b[1] - e->a[1];
	}
	surface_tangents(surface_of(b, e), uv[0], uv[1], p, &du, &dv);
	return vec3_add(vec3_scale(du, d[0]), vec3_scale(dv, d[1]));
}

double mesh_edge_nearest(const struct mesh_build *b, const struct mesh_edge *e, struct vec3 p,
                         double *t)
{
	double best = INFINITY, at = e->t[0];
	for (int i = 0; i + 1 < e->n_samples; i++) {
		const struct mesh_sample *x = &e->samples[i];
		const struct vec3 d = vec3_sub(x[1].p, x[0].p), w = vec3_sub(p, x[0].p);
		const double dd = vec3_dot(d, d);
		const double f = dd > 0 ? fmin(fmax(vec3_dot(w, d) / dd, 0), 1) : 0;
		const double far = vec3_length(vec3_along(w, -f, d));
		if (far < best) {
			best = far;
			at = x[0].t + f * (x[1].t - x[0].t);
		}
	}
	struct vec3 q;
	double found = at;
	best = INFINITY;
	for (int i = 0; i < 12; i++) {
		const struct vec3 d = edge_tangent(b, e, at, &q);
		const double far = vec3_length(vec3_sub(p, q)), dd = vec3_dot(d, d);
		if (!(far < best))
			break;
		best = far;
		found = at;
		if (!(dd > 0))
			break;
		at = fmin(fmax(at + vec3_dot(vec3_sub(p, q), d) / dd, e->t[0]), e->t[1]);
	}
	*t = found;
	return best;
}

static int by_value(const void *a, const void *b)
{
	const double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

/* Parameters of an edge where a span of its curve or, if it is straight, of its surface ends. */
static enum status edge_breaks(const struct mesh_build *b, const struct mesh_edge *e, double **out,
                               int *n)
{
	const struct surface *s = surface_of(b, e);
	const size_t room = 2 + (e->uv ? (size_t)e->uv->n + e->uv->order
	                               : (size_t)s->n[0] + s->order[0] + s->n[1] + s->order[1]);
	double *x = malloc(room * sizeof *x);
	int m = 0;
	if (!x)
		return ST_RESOURCE;
	x[m++] = e->t[0];
	for (int i = 0; e->uv && i < e->uv->n + e->uv->order; i++)
		if (e->uv->knots[i] > x[m - 1] && e->uv->knots[i] < e->t[1])
			x[m++] = e->uv->knots[i];
	for (int d = 0; d < 2 && !e->uv; d++) {
		const double run = e->b[d] - e->a[d];
		for (int i = 1; i < s->n[d] + s->order[d] && run != 0; i++) {
			const double t = (s->knots[d][i] - e->a[d]) / run;
			if (t > e->t[0] && t < e->t[1] && s->knots[d][i] > s->knots[d][i - 1])
				x[m++] = t;
		}
	}
	x[m++] = e->t[1];
	qsort(x, (size_t)m, sizeof *x, by_value);
	*out = x;
	*n = m;
	return ST_OK;
}

enum status mesh_edge_sample(struct mesh_build *b, struct mesh_edge *e)
{
	const struct surface *s = surface_of(b, e);
	double *breaks;
	int n, m = 0;
	enum status st = edge_breaks(b, e, &breaks, &n);
	if (st != ST_OK)
		return st;
	const int high = s->order[0] > s->order[1] ? s->order[0] : s->order[1];
	const int each = 2 + high + (e->uv ? 2 * e->uv->order : 0);
	free(e->samples);
	e->samples = calloc((size_t)each * n, sizeof *e->samples);
	if (e->samples) {
		for (int i = 0; i + 1 < n; i++)
			for (int k = 0; k < each; k++)
				e->samples[m++].t =
				        breaks[i] + (breaks[i + 1] - breaks[i]) * k / each;
		e->samples[m++].t = e->t[1];
		for (int i = 0; i < m; i++)
			e->samples[i].p = mesh_edge_point(b, e, e->samples[i].t);
		e->n_samples = m;
	}
	free(breaks);
	return e->samples ? ST_OK : ST_RESOURCE;
}

enum status mesh_edge_part(struct mesh_build *b, int k, const double *t, const int *vertex, int m)
{
	enum status st =
	        mesh_grow((void **)&b->edges, &b->edges_room, b->n_edges + m, sizeof *b->edges);
	for (int i = 0; i < m && st == ST_OK; i++) {
		const int fresh = b->n_edges++;
		b->edges[fresh] = b->edges[k];
		b->edges[fresh].samples = NULL;
		b->edges[fresh].nodes = NULL;
		b->edges[fresh].t[0] = t[i];
		b->edges[fresh].vertex[0] = vertex[i];
		b->edges[fresh].master = fresh;
		b->edges[k].t[1] = t[i];
		b->edges[k].vertex[1] = vertex[i];
		b->edges[k].next = fresh;
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

static enum status part_at_creases(struct mesh_build *b, int k)
{
	const struct mesh_creases *c = &b->creases[b->edges[k].face];
	const struct mesh_edge *e = &b->edges[k];
	const struct surface *s = surface_of(b, e);
	double *t = NULL;
	int n = 0, room = 0, m = 0;
	enum status st = ST_OK;
	for (int d = 0; d < 2; d++)
		for (int j = 0; j < c->n[d]; j++) {
			const double near = MESH_ON_CREASE * (s->domain[d][1] - s->domain[d][0]);
			double last = 0, at = 0; /* the last sample that is not on the line */
			for (int i = 0; i < e->n_samples && st == ST_OK; i++) {
				double uv[2];
				mesh_edge_uv(b, e, e->samples[i].t, uv);
				const double off = uv[d] - c->at[d][j];
				if (fabs(off) <= near)
					continue;
				if (last * off < 0 &&
				    (st = mesh_grow((void **)&t, &room, n + 1, sizeof *t)) == ST_OK)
					t[n++] =
					        crossing(b, e, d, c->at[d][j], at, e->samples[i].t);
				last = off;
				at = e->samples[i].t;
			}
		}
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
	b->edges[k].vertex[0] = b->edges[k].vertex[1] = -1;
	if (*last >= 0)
		b->edges[*last].next = k;
	st = mesh_edge_sample(b, &b->edges[k]);
	if (st == ST_OK)
		st = part_at_creases(b, k);
	*last = k;
	while (b->edges[*last].next >= 0)
		*last = b->edges[*last].next;
	return st;
}

static enum status add_loop(struct mesh_build *b, int face)
{
	enum status st =
	        mesh_grow((void **)&b->loops, &b->loops_room, b->n_loops + 1, sizeof *b->loops);
	if (st == ST_OK)
		b->loops[b->n_loops++] = (struct mesh_loop){ face, b->n_edges };
	return st;
}

static enum status collect_rectangle(struct mesh_build *b, int face)
{
	const struct surface *s = b->faces[face].surface;
	const double *u = s->domain[0], *v = s->domain[1];
	const double corner[5][2] = {
		{ u[0], v[0] }, { u[1], v[0] }, { u[1], v[1] }, { u[0], v[1] }, { u[0], v[0] }
	};
	int last = -1;
	enum status st = add_loop(b, face);
	for (int k = 0; k < 4 && st == ST_OK; k++) {
		struct mesh_edge e = { .face = face, .t = { 0, 1 } };
		memcpy(e.a, corner[k], sizeof e.a);
		memcpy(e.b, corner[k + 1], sizeof e.b);
		st = add_edge(b, &e, &last);
	}
	return st;
}

static enum status collect_loop(struct mesh_build *b, int face, const struct trim_loop *loop)
{
	int last = -1;
	enum status st = loop->n ? add_loop(b, face) : ST_OK;
	for (int k = 0; k < loop->n && st == ST_OK; k++) {
		const struct curve *c = &loop->curves[k];
		struct mesh_edge e = { .face = face, .uv = c, .t = { c->domain[0], c->domain[1] } };
		st = add_edge(b, &e, &last);
	}
	return st;
}

enum status mesh_collect_edges(struct mesh_build *b)
{
	enum status st = ST_OK;
	b->creases = calloc((size_t)b->n_faces, sizeof *b->creases);
	if (!b->creases)
		return ST_RESOURCE;
	for (int f = 0; f < b->n_faces && st == ST_OK; f++) {
		const struct trim *t = b->faces[f].trim;
		bool outer = false;
		st = mesh_find_creases(&b->creases[f], b->faces[f].surface);
		for (int k = 0; t && k < t->n; k++)
			outer |= t->loops[k].outer;
		if (st == ST_OK && !outer)
			st = collect_rectangle(b, f);
		for (int k = 0; t && k < t->n && st == ST_OK; k++)
			st = collect_loop(b, f, &t->loops[k]);
	}
	return st;
}
