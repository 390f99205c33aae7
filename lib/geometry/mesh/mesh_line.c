/* mesh_line.c - an edge as a line in space: its points, and the one nearest to a place. */
#include <stdlib.h>

#include "knots.h"
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

/* How far p is from the piece of line p0 .. p0 + d. */
static double from_piece(struct vec3 p, struct vec3 p0, struct vec3 d)
{
	const struct vec3 w = vec3_sub(p, p0);
	const double dd = vec3_dot(d, d);
	const double f = dd > 0 ? fmin(fmax(vec3_dot(w, d) / dd, 0), 1) : 0;
	return vec3_length(vec3_along(w, -f, d));
}

/* The sample before t, or the first. */
static int sample_before(const struct mesh_edge *e, double t)
{
	int lo = 0, hi = e->n_samples - 1;
	while (hi - lo > 1) {
		const int mid = lo + (hi - lo) / 2;
		if (e->samples[mid].t <= t)
			lo = mid;
		else
			hi = mid;
	}
	return lo;
}

double mesh_edge_nearest(const struct mesh_build *b, const struct mesh_edge *e, struct vec3 p,
                         double from, double to, double *t)
{
	double best = INFINITY, at = from;
	for (int i = sample_before(e, from); i + 1 < e->n_samples && e->samples[i].t < to; i++) {
		const struct mesh_sample *x = &e->samples[i];
		const struct vec3 d = vec3_sub(x[1].p, x[0].p), w = vec3_sub(p, x[0].p);
		const double dd = vec3_dot(d, d);
		double f = dd > 0 ? vec3_dot(w, d) / dd : 0;
		const double least = (from - x[0].t) / (x[1].t - x[0].t);
		const double most = (to - x[0].t) / (x[1].t - x[0].t);
		f = fmin(fmax(f, fmax(least, 0)), fmin(most, 1));
		const double far = vec3_length(vec3_along(w, -f, d));
		if (far < best) {
			best = far;
			at = fmin(fmax(x[0].t + f * (x[1].t - x[0].t), from), to);
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
		const double next = fmin(fmax(at + vec3_dot(vec3_sub(p, q), d) / dd, from), to);
		if (next == at)
			break;
		at = next;
	}
	*t = found;
	return best;
}

double mesh_edge_stray(const struct mesh_build *b, const struct mesh_edge *e, double from,
                       double to)
{
	const struct vec3 p = mesh_edge_point(b, e, from),
	                  d = vec3_sub(mesh_edge_point(b, e, to), p);
	double worst = 0;
	for (int i = sample_before(e, from); i < e->n_samples && e->samples[i].t < to; i++)
		if (e->samples[i].t > from)
			worst = fmax(worst, from_piece(e->samples[i].p, p, d));
	for (int i = 1; i < 4; i++)
		worst = fmax(worst,
		             from_piece(mesh_edge_point(b, e, from + (to - from) * i / 4), p, d));
	return worst;
}

double mesh_edge_length(const struct mesh_build *b, const struct mesh_edge *e, double from,
                        double to)
{
	struct vec3 last = mesh_edge_point(b, e, from);
	double sum = 0;
	for (int i = sample_before(e, from); i < e->n_samples && e->samples[i].t < to; i++)
		if (e->samples[i].t > from) {
			sum += vec3_length(vec3_sub(e->samples[i].p, last));
			last = e->samples[i].p;
		}
	return sum + vec3_length(vec3_sub(mesh_edge_point(b, e, to), last));
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
	*out = x;
	*n = 0;
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
	*n = m;
	return ST_OK;
}

/* Spans of the surface that the curve goes through between from and to. */
static int spans_between(const struct mesh_build *b, const struct mesh_edge *e, double from,
                         double to)
{
	enum { LOOKS = 4 };
	const struct surface *s = surface_of(b, e);
	int sum = 0, last[2] = { 0, 0 };
	for (int k = 0; k <= LOOKS; k++) {
		double uv[2];
		mesh_edge_uv(b, e, from + (to - from) * k / LOOKS, uv);
		for (int d = 0; d < 2; d++) {
			const int span = knots_domain_span(s->order[d], s->n[d], s->knots[d],
			                                   s->domain[d], uv[d]);
			sum += k ? abs(span - last[d]) : 0;
			last[d] = span;
		}
	}
	return sum;
}

enum status mesh_edge_sample(struct mesh_build *b, struct mesh_edge *e)
{
	const struct surface *s = surface_of(b, e);
	struct mesh_sample *samples = NULL;
	double *breaks;
	int n, m = 0, room = 0;
	enum status st = edge_breaks(b, e, &breaks, &n);
	const int high = s->order[0] > s->order[1] ? s->order[0] : s->order[1];
	const int each = 2 + high + (e->uv ? 2 * e->uv->order : 0);
	for (int i = 0; i + 1 < n && st == ST_OK; i++) {
		const double from = breaks[i], to = breaks[i + 1];
		const int pieces = each + (e->uv ? high * spans_between(b, e, from, to) : 0);
		st = mesh_grow((void **)&samples, &room, m + pieces + 1, sizeof *samples);
		for (int k = 0; k < pieces && st == ST_OK; k++)
			samples[m++].t = from + (to - from) * k / pieces;
	}
	if (st == ST_OK) {
		samples[m++].t = e->t[1];
		for (int i = 0; i < m; i++)
			samples[i].p = mesh_edge_point(b, e, samples[i].t);
		free(e->samples);
		e->samples = samples;
		e->n_samples = m;
	} else {
		free(samples);
	}
	free(breaks);
	return st;
}
