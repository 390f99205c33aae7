/* level_part.c - parts of branches: spans taken out, cut, put together again. */
#include "level_part.h"

#include <stdlib.h>
#include <string.h>

/* An end this near to a span's, as a part of the span, is that one. */
static const double snap = 1e-9;

enum { NEWTON_STEPS = 20 };

enum status level_spans(const struct level_branch *b, struct level_span **out, size_t *n)
{
	const double *knots = b->uv.knots;
	int point = 0;
	*n = 0;
	*out = malloc(sizeof **out * ((size_t)b->uv.n / 3 + 1));
	if (!*out)
		return ST_RESOURCE;
	for (int k = 3; k < b->uv.n;) {
		struct level_span *s = &(*out)[*n];
		int next = k + 1;
		while (next < b->uv.n && knots[next + 1] == knots[next])
			next++;
		s->t[0] = knots[k];
		s->t[1] = knots[next];
		s->cut = false;
		/* a fourfold knot has points of its own on both sides */
		if (*n > 0 && k - 3 != point) {
			point = k - 3;
			s->cut = true;
		}
		for (int i = 0; i < 4; i++)
			for (int d = 0; d < 3; d++) {
				const size_t at = (size_t)4 * (point + i) + d;
				if (d < 2)
					s->uv[i][d] = b->uv.points[at];
				s->space[i][d] = b->space.points[at];
			}
		point += 3;
		k = next;
		(*n)++;
	}
	return ST_OK;
}

static void cubic_at(const double *p, int dim, double x, double *out, double *slope)
{
	const double y = 1 - x;
	for (int d = 0; d < dim; d++) {
		const double a = p[d], b = p[dim + d], c = p[2 * dim + d], e = p[3 * dim + d];
		out[d] = y * y * (y * a + 3 * x * b) + x * x * (3 * y * c + x * e);
		slope[d] = 3 * (y * y * (b - a) + 2 * x * y * (c - b) + x * x * (e - c));
	}
}

void level_span_uv(const struct level_span *s, double t, double uv[2], double duv[2])
{
	const double h = s->t[1] - s->t[0];
	cubic_at(s->uv[0], 2, (t - s->t[0]) / h, uv, duv);
	duv[0] /= h;
	duv[1] /= h;
}

/* The part over [a, b] of [0, 1]. */
static void cubic_part(double *p, int dim, double a, double b)
{
	const double at[4][3] = { { a, a, a }, { a, a, b }, { a, b, b }, { b, b, b } };
	double out[12];
	for (int i = 0; i < 4; i++)
		for (int d = 0; d < dim; d++) {
			double q[4] = { p[d], p[dim + d], p[2 * dim + d], p[3 * dim + d] };
			for (int r = 0; r < 3; r++)
				for (int k = 0; k < 3 - r; k++)
					q[k] += at[i][r] * (q[k + 1] - q[k]);
			out[dim * i + d] = q[0];
		}
	memcpy(p, out, sizeof *p * (size_t)(4 * dim));
}

/* Where in the span the curve in space is nearest to what the one in u,v has at x. */
static double space_place(const struct level_span *s, const struct surface *of, double x)
{
	double uv[2], slope[3], p[3];
	cubic_at(s->uv[0], 2, x, uv, slope);
	const struct vec3 q = surface_point(of, uv[0], uv[1]);
	double at = x;
	for (int i = 0; i < NEWTON_STEPS; i++) {
		cubic_at(s->space[0], 3, at, p, slope);
		const struct vec3 d = vec3_of(slope), off = vec3_sub(vec3_of(p), q);
		const double l = vec3_dot(d, d);
		if (!(l > 0))
			break;
		const double next = smaller(larger(at - vec3_dot(off, d) / l, 0), 1);
		if (next == at)
			break;
		at = next;
	}
	/* where it loses its way the parameter itself is near */
	return fabs(at - x) < 0.25 ? at : x;
}

static void span_cut(struct level_span *s, const struct surface *of, double from, double to)
{
	const double h = s->t[1] - s->t[0];
	double a = larger((from - s->t[0]) / h, 0), b = smaller((to - s->t[0]) / h, 1);
	a = a < snap ? 0 : a;
	b = b > 1 - snap ? 1 : b;
	if (a == 0 && b == 1)
		return;
	const double p = a > 0 ? space_place(s, of, a) : 0;
	const double q = b < 1 ? space_place(s, of, b) : 1;
	cubic_part(s->uv[0], 2, a, b);
	cubic_part(s->space[0], 3, p < q ? p : a, p < q ? q : b);
	s->t[1] = s->t[0] + b * h;
	s->t[0] += a * h;
}

static void curve_put(struct curve *c, int *point, const double *p, int dim, int from)
{
	for (int i = from; i < 4; i++) {
		double *q = c->points + (size_t)4 * (*point)++;
		memset(q, 0, sizeof(double[4]));
		memcpy(q, p + (size_t)i * dim, sizeof *p * (size_t)dim);
		q[3] = 1;
	}
}

enum status level_branch_of(struct level_branch *out, const struct level_span *s, size_t n)
{
	int cuts = 0;
	for (size_t i = 1; i < n; i++)
		cuts += s[i].cut;
	out->uv = out->space = (struct curve){ .n = 0 };
	enum status st = curve_init(&out->uv, 4, (int)(3 * n + 1) + cuts);
	if (st == ST_OK)
		st = curve_init(&out->space, 4, (int)(3 * n + 1) + cuts);
	if (st != ST_OK)
		goto fail;
	double t = 0;
	int knot = 4, at[2] = { 0, 0 };
	for (size_t i = 0; i < n; i++) {
		const bool whole = i == 0 || s[i].cut;
		for (int k = 0; i > 0 && k < (s[i].cut ? 4 : 3); k++)
			out->uv.knots[knot++] = t;
		curve_put(&out->uv, &at[0], s[i].uv[0], 2, !whole);
		curve_put(&out->space, &at[1], s[i].space[0], 3, !whole);
		t += s[i].t[1] - s[i].t[0];
	}
	for (int k = 0; k < 4; k++)
		out->uv.knots[knot++] = t;
	memcpy(out->space.knots, out->uv.knots, sizeof *out->uv.knots * (size_t)knot);
	out->uv.domain[1] = out->space.domain[1] = t;
	out->seams = cuts;
	out->length = curve_length(&out->space, 0, t, 1e-9);
	if (!isnan(out->length))
		return ST_OK;
	st = ST_RESOURCE;
fail:
	curve_finish(&out->uv);
	curve_finish(&out->space);
	return st;
}

/* Does it have something of [from, to], but for rounding? */
static bool span_meets(const struct level_span *s, double from, double to)
{
	const double near = snap * (s->t[1] - s->t[0]);
	return s->t[1] > from + near && s->t[0] < to - near;
}

enum status level_branch_part(struct level_branch *out, const struct level_branch *b,
                              const struct surface *s, double from, double to)
{
	const double end = b->uv.domain[1];
	struct level_span *spans, *kept;
	size_t n, m = 0;
	*out = (struct level_branch){ .mark = { from <= 0 ? b->mark[0] : -1,
		                                to >= end ? b->mark[1] : -1 },
		                      .max_error = b->max_error,
		                      .max_error_uv = b->max_error_uv };
	enum status st = level_spans(b, &spans, &n);
	if (st != ST_OK)
		return st;
	kept = malloc(sizeof *kept * (2 * n + 1));
	/* over the start of a closed one u or v jumps, or not */
	const bool jump = n > 0 && (fabs(spans[0].uv[0][0] - spans[n - 1].uv[3][0]) +
	                                    fabs(spans[0].uv[0][1] - spans[n - 1].uv[3][1]) >
	                            0);
	for (int turn = 0; kept && turn < 2; turn++)
		for (size_t i = 0; i < n; i++) {
			struct level_span one = spans[i];
			one.t[0] += turn * end;
			one.t[1] += turn * end;
			one.cut |= turn == 1 && i == 0 && jump;
			if ((turn == 1 && !b->closed) || !span_meets(&one, from, to))
				continue;
			span_cut(&one, s, from, to);
			kept[m++] = one;
		}
	st = kept ? level_branch_of(out, kept, m) : ST_RESOURCE;
	free(kept);
	free(spans);
	return st;
}

void level_result_replace(struct level_result *x, struct list *branches)
{
	free(x->branches);
	x->branches = branches->p;
	x->n_branches = branches->n;
	x->n_closed = 0;
	x->length = x->max_error = x->max_error_uv = 0;
	for (size_t i = 0; i < x->n_branches; i++) {
		const struct level_branch *b = &x->branches[i];
		x->n_closed += b->closed;
		x->length += b->length;
		x->max_error = larger(x->max_error, b->max_error);
		x->max_error_uv = larger(x->max_error_uv, b->max_error_uv);
	}
	*branches = (struct list){ 0 };
}
