/* level_lines.c - borders and isoparametric lines of faces, to be drawn. */
#include <stdlib.h>
#include <string.h>

#include "level_border.h"
#include "level_part.h"

enum { DEPTH_MAX = 10, STEPS = 4 };

/* A way in u,v: an edge of a face, or, where that is negative, the line d = at. */
struct way {
	const struct level_faces *faces;
	const struct surface *surface;
	int edge, d;
	double at, tolerance;
};

void level_lines_finish(struct level_lines *x)
{
	for (size_t i = 0; i < x->n_wires; i++)
		curve_finish(&x->wires[i]);
	for (size_t i = 0; i < x->n_borders; i++)
		curve_finish(&x->borders[i]);
	free(x->wires);
	free(x->borders);
	*x = (struct level_lines){ .n_wires = 0 };
}

static void way_at(const struct way *w, double t, double uv[2], double duv[2], struct vec3 p[2])
{
	struct vec3 su, sv;
	if (w->edge >= 0) {
		border_edge_uv(w->faces, w->edge, t, uv, duv);
	} else {
		uv[w->d] = w->at;
		uv[1 - w->d] = t;
		duv[w->d] = 0;
		duv[1 - w->d] = 1;
	}
	surface_tangents(w->surface, uv[0], uv[1], &p[0], &su, &sv);
	p[1] = vec3_along(vec3_scale(su, duv[0]), duv[1], sv);
}

static void point_put(double out[3], struct vec3 p)
{
	out[0] = p.x;
	out[1] = p.y;
	out[2] = p.z;
}

/* Cubics from a to b with the way's ends and tangents, halved until their middle is on it. */
static void way_fit(const struct way *w, double a, double b, int depth, struct list *spans)
{
	const double h = (b - a) / 3, middle = 0.5 * (a + b);
	struct level_span s = { .t = { a, b } };
	double uv[2][2], duv[2][2], mid_uv[2], mid_duv[2];
	struct vec3 p[2][2], m[2];
	way_at(w, a, uv[0], duv[0], p[0]);
	way_at(w, b, uv[1], duv[1], p[1]);
	way_at(w, middle, mid_uv, mid_duv, m);
	const struct vec3 q[4] = { p[0][0], vec3_along(p[0][0], h, p[0][1]),
		                   vec3_along(p[1][0], -h, p[1][1]), p[1][0] };
	for (int k = 0; k < 4; k++)
		point_put(s.space[k], q[k]);
	for (int d = 0; d < 2; d++) {
		s.uv[0][d] = uv[0][d];
		s.uv[1][d] = uv[0][d] + h * duv[0][d];
		s.uv[2][d] = uv[1][d] - h * duv[1][d];
		s.uv[3][d] = uv[1][d];
	}
	const struct vec3 on = vec3_scale(
	        vec3_add(vec3_add(q[0], q[3]), vec3_scale(vec3_add(q[1], q[2]), 3)), 0.125);
	if (vec3_length(vec3_sub(on, m[0])) > w->tolerance && depth < DEPTH_MAX) {
		way_fit(w, a, middle, depth + 1, spans);
		way_fit(w, middle, b, depth + 1, spans);
		return;
	}
	struct level_span *out = list_add(spans, sizeof *out);
	if (out)
		*out = s;
}

/* A way over [a, b], of these knots, as a branch. */
static enum status way_branch(const struct way *w, double a, double b, const double *knots, int n,
                              struct level_branch *out)
{
	struct list spans = { 0 };
	for (int i = 0; i + 1 < n; i++) {
		const double lo = larger(knots[i], a), hi = smaller(knots[i + 1], b);
		for (int k = 0; lo < hi && k < STEPS; k++)
			way_fit(w, lo + (hi - lo) * k / STEPS, lo + (hi - lo) * (k + 1) / STEPS, 0,
			        &spans);
	}
	*out = (struct level_branch){ .mark = { -1, -1 }, .max_error = w->tolerance };
	enum status st = spans.failed ? ST_RESOURCE : level_branch_of(out, spans.p, spans.n);
	free(spans.p);
	return st;
}

/* The curve in space of a branch, put behind a list that doubles. */
static enum status curve_take(struct level_branch *b, struct curve **list, size_t *n)
{
	struct curve *more = *list;
	if ((*n & (*n - 1)) == 0)
		more = realloc(*list, sizeof *more * (*n ? 2 * *n : 1));
	curve_finish(&b->uv);
	if (!more) {
		curve_finish(&b->space);
		return ST_RESOURCE;
	}
	*list = more;
	more[(*n)++] = b->space;
	return ST_OK;
}

static enum status border_add(const struct level_faces *f, int edge, double tolerance,
                              struct level_lines *out)
{
	const struct border_edge *e = (const struct border_edge *)f->edges.p + edge;
	const struct surface *s = f->faces[e->face].surface;
	const struct way w = { f, s, edge, 0, 0, tolerance };
	struct level_branch b;
	enum status st =
	        e->uv ? way_branch(&w, e->t[0], e->t[1], e->uv->knots, e->uv->n + e->uv->order, &b)
	              : way_branch(&w, e->t[0], e->t[1], s->knots[1 - e->d],
	                           s->n[1 - e->d] + s->order[1 - e->d], &b);
	return st == ST_OK ? curve_take(&b, &out->borders, &out->n_borders) : st;
}

static enum status wire_add(const struct level_faces *f, int i, int d, double at, double tolerance,
                            struct level_lines *out)
{
	const struct surface *s = f->faces[i].surface;
	const struct way w = { f, s, -1, d, at, tolerance };
	struct level_result x = { .branches = calloc(1, sizeof *x.branches) };
	if (!x.branches)
		return ST_RESOURCE;
	enum status st = way_branch(&w, s->domain[1 - d][0], s->domain[1 - d][1], s->knots[1 - d],
	                            s->n[1 - d] + s->order[1 - d], &x.branches[0]);
	x.n_branches = st == ST_OK;
	if (st == ST_OK)
		st = level_clip(f, i, tolerance, &x);
	for (size_t b = 0; st == ST_OK && b < x.n_branches; b++) {
		st = curve_take(&x.branches[b], &out->wires, &out->n_wires);
		x.branches[b] = (struct level_branch){ .length = 0 };
	}
	level_result_finish(&x);
	return st;
}

enum status level_face_lines(const struct level_faces *f, int i, int wires, double tolerance,
                             struct level_lines *out)
{
	const struct border_edge *e = f->edges.p;
	enum status st = ST_OK;
	for (size_t k = 0; st == ST_OK && k < f->edges.n; k++)
		if (e[k].face == i)
			st = border_add(f, (int)k, tolerance, out);
	for (int d = 0; d < 2; d++) {
		const double *range = f->faces[i].surface->domain[d];
		for (int k = 1; st == ST_OK && k <= wires; k++)
			st = wire_add(f, i, d, range[0] + (range[1] - range[0]) * k / (wires + 1),
			              tolerance, out);
	}
	return st;
}
