/* level_field.c - f on one patch: its Bernstein form, and its value with the surface's.
 *
 * In the frame whose third axis is the light a silhouette, and an isophote at 90 degrees, is z = 0 for the
 * normal (x, y, z).
 */
#include "level_form.h"
#include "level_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "level_isophote.h"

static const struct level_surface *surface_of(const struct tracer *t)
{
	return t->level->surface;
}

struct bound level_normal_bound(const struct tracer *t)
{
	const struct level_surface *s = surface_of(t);
	struct bound b = { 0, s->normal_error[t->patch] };
	double lo, hi;
	form_range(t->normals, level_normals_size(s), &lo, &hi);
	b.size = larger(-lo, hi);
	return b;
}

static bool silhouette_make(struct tracer *t, double *out)
{
	for (size_t i = 0; i < t->n_field; i++)
		out[i] = t->normals[4 * i + 2];
	t->bound = level_normal_bound(t);
	return true;
}

enum status level_plane_prepare(struct level_surface *s)
{
	const size_t n = bezier_patch_size(&s->net) / 4;
	const size_t patches = (size_t)s->net.spans[0] * s->net.spans[1];
	const double *p = s->net.points, *d = s->frame[2];
	s->heights = malloc(sizeof *s->heights * n * patches);
	s->height_range = malloc(sizeof *s->height_range * patches);
	if (!s->heights || !s->height_range)
		return ST_RESOURCE;
	for (size_t i = 0; i < n * patches; i++, p += 4)
		s->heights[i] = d[0] * p[0] + d[1] * p[1] + d[2] * p[2];
	for (size_t i = 0; i < patches; i++)
		form_range(s->heights + n * i, n, &s->height_range[i][0], &s->height_range[i][1]);
	return ST_OK;
}

void level_plane_bound(struct level *l)
{
	const struct level_surface *s = l->surface;
	const double *n = l->direction;
	/* the points' errors, the sum of four, and what making the direction a unit vector did */
	double size = 0;
	for (int d = 0; d < 3; d++)
		size += fabs(n[d]) * s->extent[d];
	l->plane.size = s->reach + fabs(n[3]) * s->of_weights.size;
	l->plane.error = size * (s->of_points.error / (s->reach + 1e-300) + 12 * UNIT_ROUNDOFF) +
	                 fabs(n[3]) * (s->of_weights.error + 12 * UNIT_ROUNDOFF * s->weight);
}

bool level_plane_misses(const struct level *l, size_t patch)
{
	const struct level_surface *s = l->surface;
	if (s->kind != LEVEL_PLANE || s->net.rational)
		return false;
	/* sums round to the same side: no coefficient of f is beyond these */
	const double lo = s->height_range[patch][0] + l->direction[3];
	const double hi = s->height_range[patch][1] + l->direction[3];
	const double zero = larger(l->plane.error, ZERO_SHARE * l->plane.size);
	return lo > zero || hi < -zero;
}

static bool plane_make(struct tracer *t, double *out)
{
	const struct level_surface *s = surface_of(t);
	const double *heights = s->heights + t->n_field * t->patch, away = t->level->direction[3];
	for (size_t i = 0; i < t->n_field; i++)
		out[i] = heights[i] + (s->net.rational ? away * t->points[4 * i + 3] : away);
	t->bound = t->level->plane;
	return true;
}

/* What f may be and counts as zero. */
static double zero_of(const struct tracer *t)
{
	return larger(ZERO_SHARE * t->bound.size, t->bound.error);
}

/* Coefficients of f on a side of the patch, or `inset` rows inside of it: the first, the step, how
 * many. */
struct row {
	size_t first, step, n;
};

static struct row row_of(const struct tracer *t, int d, bool upper, size_t inset)
{
	size_t m = (size_t)t->level->degree[0], n = (size_t)t->level->degree[1];
	size_t at = d == 0 ? m : n;
	at = !upper ? inset : at > inset ? at - inset : 0;
	return d == 0 ? (struct row){ at * (n + 1), 1, n + 1 } : (struct row){ at, n + 1, m + 1 };
}

static bool row_is_zero(const struct tracer *t, const double *c, struct row r)
{
	for (size_t i = 0; i < r.n; i++)
		if (fabs(c[r.first + r.step * i]) > zero_of(t))
			return false;
	return true;
}

static void row_clear(double *c, struct row r)
{
	for (size_t i = 0; i < r.n; i++)
		c[r.first + r.step * i] = 0;
}

/*
 * The curve runs along the border, whichever sign f has inside: let f change it just inside, where
 * without the border's factor it has the next row's.
 */
static void row_mirror(double *c, struct row side, struct row next)
{
	for (size_t i = 0; i < side.n; i++)
		c[side.first + side.step * i] = -1e-30 * c[next.first + next.step * i];
}

/*
 * f is zero all along a side that is one point: the curve goes through the pole, and f without its
 * factor tells in which directions.
 */
static void take_out_pole(struct tracer *t, double *c, int d, bool upper)
{
	const struct level_surface *s = surface_of(t);
	int m = t->level->degree[0], n = t->level->degree[1];
	form_scale(c, m, n, s->binomial, false);
	form_divide(c, m, n, d, upper);
	form_scale(c, m, n, s->binomial, true);
	t->bound.error *= (d == 0 ? m : n) + 1;
	t->own_field = true;
}

/*
 * A side on which f is rounding becomes zero, so that both its patches agree that it is. At a pole
 * the curve goes through it, unless the slope is rounding, too: then the level is only touched.
 */
static void clean_sides(struct tracer *t, double *c)
{
	const struct level_surface *s = surface_of(t);
	/* normal curvature: the square of the tangent along the pole's side is in both terms */
	const bool squared = s->kind == LEVEL_CURVATURE && s->quantity >= QUANTITY_NORMAL_U;
	for (int k = 0; k < 4; k++) {
		int d = k / 2, upper = k % 2, at = t->place[d] + upper;
		struct row side = row_of(t, d, upper, 0), next = row_of(t, d, upper, 1);
		if (!row_is_zero(t, c, side))
			continue;
		t->cleaned = true;
		row_clear(c, side);
		size_t edge = d == 0 ? level_edge(s, 0, at, t->place[1])
		                     : level_edge(s, 1, t->place[0], at);
		if (s->edges[d][edge] == EDGE_POLE && (squared || !row_is_zero(t, c, next))) {
			for (int times = squared ? 2 : 1; times > 0 && row_is_zero(t, c, side);
			     times--)
				take_out_pole(t, c, d, upper);
		} else if (s->edges[d][edge] == EDGE_BORDER)
			row_mirror(c, side, next);
	}
}

bool level_field_make(struct tracer *t, double *out)
{
	const struct level *l = t->level;
	t->own_field = t->cleaned = false;
	const enum level_kind kind = surface_of(t)->kind;
	bool there = kind == LEVEL_CURVATURE      ? level_curvature_make(t, out)
	             : level_shapes[kind].several ? level_kind_make(t, out)
	             : kind == LEVEL_PLANE        ? plane_make(t, out)
	             : l->value == 0              ? silhouette_make(t, out)
	                                          : level_isophote_make(t, out);
	if (!there)
		return false;
	clean_sides(t, out);
	memcpy(t->field, out, sizeof *out * t->n_field);
	t->field_error = t->bound.error;
	t->most = form_most(out, t->n_field);
	return true;
}

void level_field_at(const struct tracer *t, double u, double v, struct field_point *out)
{
	const struct level *l = t->level;
	const struct level_surface *s = l->surface;
	double x[4], xu[4], xv[4];
	form_evaluate4(t->points, s->net.order[0] - 1, s->net.order[1] - 1, u, v, x, xu, xv);
	if (t->own_field) {
		form_evaluate(t->field, l->degree[0], l->degree[1], u, v, &out->f, &out->fu,
		              &out->fv);
	} else if (s->kind == LEVEL_CURVATURE) {
		/* without its form only the place is asked for */
		out->f = out->fu = out->fv = 0;
	} else if (level_shapes[s->kind].several) {
		struct field_jets j = { 0 };
		memcpy(j.x[0], x, sizeof x);
		memcpy(j.x[1], xu, sizeof xu);
		memcpy(j.x[2], xv, sizeof xv);
		if (t->normals)
			form_evaluate4(t->normals, s->degree[0], s->degree[1], u, v, j.n[0], j.n[1],
			               j.n[2]);
		level_kind_at(l, &j, out);
	} else if (s->kind == LEVEL_PLANE) {
		const double *n = l->direction;
		out->f = n[0] * x[0] + n[1] * x[1] + n[2] * x[2] + n[3] * x[3];
		out->fu = n[0] * xu[0] + n[1] * xu[1] + n[2] * xu[2] + n[3] * xu[3];
		out->fv = n[0] * xv[0] + n[1] * xv[1] + n[2] * xv[2] + n[3] * xv[3];
	} else {
		double n[4], nu[4], nv[4];
		form_evaluate4(t->normals, s->degree[0], s->degree[1], u, v, n, nu, nv);
		if (l->value == 0) {
			out->f = n[2];
			out->fu = nu[2];
			out->fv = nv[2];
		} else {
			double c2 = l->value * l->value, s2 = l->sine * l->sine;
			double a = -2 * c2 * n[0], b = -2 * c2 * n[1], c = 2 * s2 * n[2];
			out->f = 0.5 * (a * n[0] + b * n[1] + c * n[2]);
			out->fu = a * nu[0] + b * nu[1] + c * nu[2];
			out->fv = a * nv[0] + b * nv[1] + c * nv[2];
		}
	}
	double w = s->net.rational ? 1 / x[3] : 1;
	for (int d = 0; d < 3; d++) {
		out->p[d] = x[d] * w;
		out->su[d] = s->net.rational ? (xu[d] - out->p[d] * xu[3]) * w : xu[d];
		out->sv[d] = s->net.rational ? (xv[d] - out->p[d] * xv[3]) * w : xv[d];
	}
}
