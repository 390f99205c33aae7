/* level_branch.c - the pieces of a branch in order, as two B-splines over the same knots. */
#include "level_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A gap below this part of the tolerance is closed by moving the end. */
static const double gap_share = 0.01;

enum { BRIDGE_DEPTH_MAX = 8 };

/* A piece in the surface's parameters, and whether u or v jumps before it. */
struct span {
	struct piece piece;
	bool cut;
};

static void span_add(struct list *spans, const struct piece *p, bool cut)
{
	struct span *s = list_next(spans, sizeof *s);
	if (s)
		*s = (struct span){ *p, cut };
}

static double distance(const double a[3], const double b[3])
{
	return hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]);
}

/* From the patch's parameters to the surface's. */
static void piece_globalise(const struct level_surface *s, int patch, struct piece *p)
{
	int place[2] = { patch / s->net.spans[1], patch % s->net.spans[1] };
	for (int d = 0; d < 2; d++) {
		const double *b = s->net.breaks[d] + place[d];
		for (int e = 0; e < 2; e++) {
			p->uv[e][d] = level_global(b, p->uv[e][d]);
			p->duv[e][d] *= b[1] - b[0];
		}
	}
}

/* The strand's pieces, entered at `entry`. */
static void spans_add_strand(const struct joint *j, size_t entry, bool cut, struct list *spans)
{
	const struct strand *s = &j->strands[entry / 2];
	for (int i = 0; i < s->n; i++) {
		struct span *x = list_next(spans, sizeof *x);
		if (!x)
			return;
		x->cut = cut && i == 0;
		x->piece = j->pieces[s->first + (entry % 2 ? s->n - 1 - i : i)];
		if (entry % 2)
			piece_reverse(&x->piece);
		piece_globalise(j->level->surface, j->patch[entry / 2], &x->piece);
	}
}

/* A cubic along a straight line in the patch's u,v, its ends and tangents those of the surface. */
static void bridge_piece(const struct tracer *t, const double uv[2][2], struct piece *p)
{
	double du = uv[1][0] - uv[0][0], dv = uv[1][1] - uv[0][1];
	memset(p, 0, sizeof *p);
	for (int e = 0; e < 2; e++) {
		struct field_point x;
		level_field_at(t, uv[e][0], uv[e][1], &x);
		p->duv[e][0] = du;
		p->duv[e][1] = dv;
		p->uv[e][0] = uv[e][0];
		p->uv[e][1] = uv[e][1];
		for (int d = 0; d < 3; d++) {
			p->p[e][d] = x.p[d];
			p->dp[e][d] = du * x.su[d] + dv * x.sv[d];
		}
	}
}

static void bridge_add(const struct tracer *t, const double uv[2][2], int depth, struct list *spans)
{
	struct piece p;
	struct field_point x;
	double middle[2] = { 0.5 * (uv[0][0] + uv[1][0]), 0.5 * (uv[0][1] + uv[1][1]) }, q[3];
	bridge_piece(t, uv, &p);
	level_field_at(t, middle[0], middle[1], &x);
	for (int d = 0; d < 3; d++)
		q[d] = 0.5 * (p.p[0][d] + p.p[1][d]) + (p.dp[0][d] - p.dp[1][d]) / 8;
	p.error = distance(q, x.p);
	if (p.error < gap_share * t->level->tolerance || depth == BRIDGE_DEPTH_MAX) {
		piece_globalise(t->level->surface, t->patch, &p);
		span_add(spans, &p, false);
		return;
	}
	double first[2][2] = { { uv[0][0], uv[0][1] }, { middle[0], middle[1] } };
	double second[2][2] = { { middle[0], middle[1] }, { uv[1][0], uv[1][1] } };
	bridge_add(t, first, depth + 1, spans);
	bridge_add(t, second, depth + 1, spans);
}

/*
 * Between the end `from` of one strand and the end `to` of the next: where they do not meet within
 * the tolerance, along the edge that both lie on (there the normal turns from one side's to the
 * other's), else straight.
 */
static void spans_add_bridge(const struct joint *j, size_t from, size_t to, bool on_edge,
                             struct list *spans)
{
	const struct level_surface *s = j->level->surface;
	struct joint_end a, b;
	joint_end_get(j, from, &a);
	joint_end_get(j, to, &b);
	double gap = distance(a.p, b.p);
	if (gap <= gap_share * j->level->tolerance)
		return;
	if (on_edge) {
		const struct strand_end *x = &j->strands[from / 2].end[from % 2];
		const struct strand_end *y = &j->strands[to / 2].end[to % 2];
		int patch = j->patch[from / 2];
		struct tracer t = { .level = j->level, .patch = patch };
		t.points = bezier_patch(&s->net, patch / s->net.spans[1], patch % s->net.spans[1]);
		if (s->normals)
			t.normals = s->normals + level_normals_size(s) * patch;
		double uv[2][2];
		uv[0][x->d] = uv[1][x->d] = x->upper;
		uv[0][1 - x->d] = x->at;
		uv[1][1 - x->d] = y->at;
		bridge_add(&t, uv, 0, spans);
		return;
	}
	struct piece p = { .error = gap, .error_uv = hypot(a.uv[0] - b.uv[0], a.uv[1] - b.uv[1]) };
	memcpy(p.uv[0], a.uv, sizeof a.uv);
	memcpy(p.uv[1], b.uv, sizeof b.uv);
	memcpy(p.p[0], a.p, sizeof a.p);
	memcpy(p.p[1], b.p, sizeof b.p);
	for (int e = 0; e < 2; e++) {
		for (int d = 0; d < 2; d++)
			p.duv[e][d] = b.uv[d] - a.uv[d];
		for (int d = 0; d < 3; d++)
			p.dp[e][d] = b.p[d] - a.p[d];
	}
	span_add(spans, &p, false);
}

/* Straight between a strand's end and the crossing that it ends in. Both it and the curve are in the
 * mark's box. */
static void spans_add_mark(const struct joint *j, size_t end, bool into, struct list *spans)
{
	int mark = j->links[end].mark;
	struct joint_end a;
	double uv[2], p[3];
	if (mark == 0 || !level_mark_joins(j->marks[mark - 1].kind))
		return;
	joint_end_get(j, end, &a);
	memcpy(uv, j->marks[mark - 1].at, sizeof uv);
	level_point_at(j->level->surface, uv, p);
	/* over a seam it may be the other end's */
	for (int d = 0; d < 2; d++)
		if (fabs(uv[d] - a.uv[d]) > 0.5 * level_range(j->level->surface, d))
			return;
	struct piece x = { .error = 2 * distance(a.p, p),
		           .error_uv = 2 * hypot(a.uv[0] - uv[0], a.uv[1] - uv[1]) };
	if (x.error == 0 || x.error > j->level->tolerance || x.error_uv > j->level->tolerance_uv)
		return;
	for (int e = 0; e < 2; e++) {
		memcpy(x.uv[e], (e == 0) == into ? a.uv : uv, sizeof uv);
		memcpy(x.p[e], (e == 0) == into ? a.p : p, sizeof p);
	}
	for (int e = 0; e < 2; e++) {
		for (int d = 0; d < 2; d++)
			x.duv[e][d] = x.uv[1][d] - x.uv[0][d];
		for (int d = 0; d < 3; d++)
			x.dp[e][d] = x.p[1][d] - x.p[0][d];
	}
	span_add(spans, &x, false);
}

static enum status spans_make(const struct joint *j, const size_t *entries, size_t n, bool closed,
                              struct list *spans)
{
	size_t pieces = 2;
	for (size_t i = 0; i < n; i++)
		pieces += j->strands[entries[i] / 2].n + 1;
	if (!list_reserve(spans, pieces, sizeof(struct span)))
		return ST_RESOURCE;
	if (!closed)
		spans_add_mark(j, entries[0], false, spans);
	for (size_t i = 0; i < n; i++) {
		const struct link *l = &j->links[entries[i]];
		spans_add_strand(j, entries[i], i > 0 && l->cut, spans);
		const struct link *out = &j->links[entries[i] ^ 1];
		bool more = i + 1 < n || closed;
		if (more && out->kind == LINK_STRAND && (out->on_edge || !out->cut))
			spans_add_bridge(j, entries[i] ^ 1, out->other, out->on_edge, spans);
	}
	if (!closed)
		spans_add_mark(j, entries[n - 1] ^ 1, true, spans);
	return spans->failed ? ST_RESOURCE : ST_OK;
}

typedef double lanes __attribute__((vector_size(32)));

/* By Gauss's rule with five points: the middle, and two pairs. */
WIDE static double piece_length(const struct piece *p)
{
	static const double at[4] = { -0.53846931010568309, 0.53846931010568309,
		                      -0.90617984593866399, 0.90617984593866399 };
	lanes x, square = { 0 };
	memcpy(&x, at, sizeof x);
	const lanes t = 0.5 + 0.5 * x, s = 1 - t;
	const lanes chord = 6 * t * s, first = s * (1 - 3 * t), last = t * (3 * t - 2);
	double middle = 0;
	for (int d = 0; d < 3; d++) {
		const double by = p->p[1][d] - p->p[0][d];
		const double m = 1.5 * by - 0.25 * (p->dp[0][d] + p->dp[1][d]);
		const lanes v = chord * by + first * p->dp[0][d] + last * p->dp[1][d];
		square += v * v;
		middle += m * m;
	}
	return 0.28444444444444445 * sqrt(middle) +
	       0.23931433524968324 * (sqrt(square[0]) + sqrt(square[1])) +
	       0.11846344252809454 * (sqrt(square[2]) + sqrt(square[3]));
}

static void point_put(struct curve *c, int i, const double *p, int dim)
{
	double *out = c->points + 4 * i;
	out[2] = 0;
	memcpy(out, p, sizeof *p * dim);
	out[3] = 1;
}

/* Bezier points of one span; the first is the one before's last unless a cut parts them. */
static int span_put(struct curve *c, int i, const double p[2][3], const double dp[2][3], int dim,
                    bool begin)
{
	double q[2][3];
	for (int d = 0; d < dim; d++) {
		q[0][d] = p[0][d] + dp[0][d] / 3;
		q[1][d] = p[1][d] - dp[1][d] / 3;
	}
	if (begin)
		point_put(c, i++, p[0], dim);
	point_put(c, i++, q[0], dim);
	point_put(c, i++, q[1], dim);
	point_put(c, i++, p[1], dim);
	return i;
}

static int knots_put(struct curve *c, int i, double t, int times)
{
	while (times-- > 0)
		c->knots[i++] = t;
	return i;
}

/* A cubic that is not cleared: all of it will be put. */
static bool curve_room(struct curve *c, int n)
{
	*c = (struct curve){ .order = 4, .n = n };
	c->knots = malloc(sizeof *c->knots * ((size_t)n + 4));
	c->points = malloc(sizeof(double[4]) * n);
	return c->knots && c->points;
}

/* A closed one ends where it began, to the bit. */
static void end_close(struct curve *c, bool uv_too)
{
	if (uv_too)
		memcpy(c->points + 4 * (c->n - 1), c->points, sizeof(double[4]));
}

/* Over a seam whose sides are a little apart the space curve goes on where it was; returns by how
 * much it is moved. */
static double seam_close(const struct piece *before, struct piece *p)
{
	double gap = distance(before->p[1], p->p[0]);
	memcpy(p->p[0], before->p[1], sizeof p->p[0]);
	return gap;
}

static enum status curves_make(struct span *s, size_t n, double size, bool closed,
                               struct level_branch *out)
{
	int cuts = 0;
	for (size_t i = 1; i < n; i++)
		cuts += s[i].cut;
	if (!curve_room(&out->uv, (int)(3 * n + 1) + cuts) ||
	    !curve_room(&out->space, (int)(3 * n + 1) + cuts))
		return ST_RESOURCE;
	double t = 0;
	int point = 0, knot = knots_put(&out->uv, 0, 0, 4);
	for (size_t i = 0; i < n; i++) {
		struct piece *p = &s[i].piece;
		double uv[2][3], duv[2][3], length = piece_length(p);
		for (int e = 0; e < 2; e++)
			for (int d = 0; d < 2; d++) {
				uv[e][d] = p->uv[e][d];
				duv[e][d] = p->duv[e][d];
			}
		if (i > 0)
			knot = knots_put(&out->uv, knot, t, s[i].cut ? 4 : 3);
		if (s[i].cut)
			out->max_error = larger(out->max_error, seam_close(&s[i - 1].piece, p));
		span_put(&out->uv, point, uv, duv, 2, i == 0 || s[i].cut);
		point = span_put(&out->space, point, p->p, p->dp, 3, i == 0 || s[i].cut);
		/* parameters must rise even where the curve stands still */
		t += larger(length, 1e-12 * size);
		out->length += length;
		out->max_error = larger(out->max_error, p->error);
		out->max_error_uv = larger(out->max_error_uv, p->error_uv);
	}
	knots_put(&out->uv, knot, t, 4);
	memcpy(out->space.knots, out->uv.knots, sizeof(double) * (out->uv.n + 4));
	out->uv.domain[1] = out->space.domain[1] = t;
	out->closed = closed;
	out->seams = cuts;
	return ST_OK;
}

enum status level_branch_make(const struct joint *j, const size_t *entries, size_t n, bool closed,
                              struct level_branch *out)
{
	struct list spans = { 0 };
	enum status st = spans_make(j, entries, n, closed, &spans);
	out->mark[0] = closed ? -1 : j->links[entries[0]].mark - 1;
	out->mark[1] = closed ? -1 : j->links[entries[n - 1] ^ 1].mark - 1;
	if (st == ST_OK)
		st = curves_make(spans.p, spans.n, j->level->surface->net.size, closed, out);
	if (st == ST_OK && closed) {
		bool cut = j->links[entries[0]].cut;
		out->seams += cut;
		end_close(&out->space, true);
		end_close(&out->uv, !cut);
	}
	list_finish(&spans);
	return st;
}
