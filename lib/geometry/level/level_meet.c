/* level_meet.c - a cubic against a rational Bezier piece in the plane: boxes, cones of tangents, Newton. */
#include "level_meet.h"

#include <string.h>

enum { DEPTH_MAX = 60, NEWTON_STEPS = 30 };

/* Cones wider than this say too little. */
static const double cone_wide = 0.5;

/* More than an angle in such a cone is larger than its sine. */
static const double cone_margin = 0.03;

/* Parts farther from each other than this share of what is near are parted; parts all nearer than 3/4
 * of it are near, so that small parts are one or the other. */
static const double part_near = 0.5;

/* A crossing so little beyond the end of a part is in it; what the next part has, too, is one. */
static const double end_slack = 1e-9;

/* Parts of both, scaled; the piece's points are x, y, w. */
struct pair {
	double span[4][2], t[2];
	double piece[ORDER_MAX][3];
	int order;
};

struct box2 {
	double lo[2], hi[2];
};

static void box2_add(struct box2 *b, double x, double y)
{
	b->lo[0] = smaller(b->lo[0], x);
	b->hi[0] = larger(b->hi[0], x);
	b->lo[1] = smaller(b->lo[1], y);
	b->hi[1] = larger(b->hi[1], y);
}

static struct box2 span_box(const struct pair *p)
{
	struct box2 b = { { INFINITY, INFINITY }, { -INFINITY, -INFINITY } };
	for (int i = 0; i < 4; i++)
		box2_add(&b, p->span[i][0], p->span[i][1]);
	return b;
}

static struct box2 piece_box(const struct pair *p)
{
	struct box2 b = { { INFINITY, INFINITY }, { -INFINITY, -INFINITY } };
	for (int i = 0; i < p->order; i++)
		box2_add(&b, p->piece[i][0] / p->piece[i][2], p->piece[i][1] / p->piece[i][2]);
	return b;
}

static double box2_size(const struct box2 *b)
{
	return larger(b->hi[0] - b->lo[0], b->hi[1] - b->lo[1]);
}

/* Directions, by the sines of their angles from a first one; false where they may point anywhere. */
struct cone {
	double axis[2], lo, hi;
	bool begun;
};

static bool cone_add(struct cone *c, double x, double y)
{
	const double l = length2(x, y);
	if (!(l > 0))
		return true;
	if (!c->begun) {
		c->axis[0] = x / l;
		c->axis[1] = y / l;
		c->begun = true;
		return true;
	}
	const double sine = (c->axis[0] * y - c->axis[1] * x) / l;
	c->lo = smaller(c->lo, sine);
	c->hi = larger(c->hi, sine);
	return c->axis[0] * x + c->axis[1] * y > 0 && c->hi - c->lo < cone_wide;
}

/*
 * At most one crossing: no direction of the one is one of the other. The derivative of a rational
 * Bezier curve with positive weights is a positive combination of differences of its points.
 * Source: Floater, CAGD 9 (1992), 161-174.
 */
static bool cones_part(const struct pair *p)
{
	struct cone a = { .lo = 0 }, b = { .lo = 0 };
	for (int i = 0; i < 3; i++)
		if (!cone_add(&a, p->span[i + 1][0] - p->span[i][0],
		              p->span[i + 1][1] - p->span[i][1]))
			return false;
	for (int j = 1; j < p->order; j++)
		for (int i = 0; i < j; i++)
			if (!cone_add(&b,
			              p->piece[j][0] / p->piece[j][2] -
			                      p->piece[i][0] / p->piece[i][2],
			              p->piece[j][1] / p->piece[j][2] -
			                      p->piece[i][1] / p->piece[i][2]))
				return false;
	if (!a.begun || !b.begun)
		return false;
	double turn = atan2(a.axis[0] * b.axis[1] - a.axis[1] * b.axis[0],
	                    a.axis[0] * b.axis[0] + a.axis[1] * b.axis[1]);
	/* as lines, from -pi / 2 to pi / 2 */
	turn -= M_PI * nearbyint(turn / M_PI);
	for (int k = -1; k <= 1; k++)
		if (turn + k * M_PI + b.lo <= a.hi + cone_margin &&
		    turn + k * M_PI + b.hi >= a.lo - cone_margin)
			return false;
	return true;
}

static void span_at(const struct pair *p, double x, double q[2], double d[2])
{
	const double y = 1 - x;
	for (int k = 0; k < 2; k++) {
		const double a = p->span[0][k], b = p->span[1][k], c = p->span[2][k],
		             e = p->span[3][k];
		q[k] = y * y * (y * a + 3 * x * b) + x * x * (3 * y * c + x * e);
		d[k] = 3 * (y * y * (b - a) + 2 * x * y * (c - b) + x * x * (e - c));
	}
}

static void piece_at(const struct pair *p, double x, double q[2], double d[2])
{
	double b[ORDER_MAX], slope[ORDER_MAX], at[3] = { 0 }, dx[3] = { 0 };
	bernstein(p->order, x, b, slope);
	for (int i = 0; i < p->order; i++)
		for (int k = 0; k < 3; k++) {
			at[k] += b[i] * p->piece[i][k];
			dx[k] += slope[i] * p->piece[i][k];
		}
	for (int k = 0; k < 2; k++) {
		q[k] = at[k] / at[2];
		d[k] = (dx[k] - q[k] * dx[2]) / at[2];
	}
}

/* The one crossing that there may be: 1 found, 0 there is none, -1 not known. */
static int pair_solve(const struct pair *p, double *x)
{
	double s = 0.5, t = 0.5;
	for (int i = 0; i < NEWTON_STEPS; i++) {
		double q[2], dq[2], r[2], dr[2];
		span_at(p, s, q, dq);
		piece_at(p, t, r, dr);
		const double off[2] = { r[0] - q[0], r[1] - q[1] };
		const double det = dq[1] * dr[0] - dq[0] * dr[1];
		if (!(fabs(det) > 0))
			return -1;
		const double ds = (off[1] * dr[0] - off[0] * dr[1]) / det;
		const double dt = (dq[0] * off[1] - dq[1] * off[0]) / det;
		s += ds;
		t += dt;
		if (!(fabs(s - 0.5) < 3 && fabs(t - 0.5) < 3))
			return -1;
		if (fabs(ds) < 1e-13 && fabs(dt) < 1e-13) {
			const bool in = s > -end_slack && s < 1 + end_slack && t > -end_slack &&
			                t < 1 + end_slack;
			*x = smaller(larger(s, 0), 1);
			return in;
		}
	}
	return -1;
}

/* Distance of a point from a straight way. */
static double off_line(const double a[2], const double b[2], double x, double y)
{
	const double d[2] = { b[0] - a[0], b[1] - a[1] };
	const double l = d[0] * d[0] + d[1] * d[1];
	double t = l > 0 ? ((x - a[0]) * d[0] + (y - a[1]) * d[1]) / l : 0;
	t = smaller(larger(t, 0), 1);
	return length2(x - a[0] - t * d[0], y - a[1] - t * d[1]);
}

/* All of the span's part lies near the piece's: a quarter of it for how bent the piece is. */
static bool all_near(const struct pair *p, double near)
{
	const double *first = p->piece[0], *last = p->piece[p->order - 1];
	const double a[2] = { first[0] / first[2], first[1] / first[2] };
	const double b[2] = { last[0] / last[2], last[1] / last[2] };
	for (int i = 1; i + 1 < p->order; i++)
		if (off_line(a, b, p->piece[i][0] / p->piece[i][2],
		             p->piece[i][1] / p->piece[i][2]) > 0.25 * near)
			return false;
	for (int i = 0; i < 4; i++)
		if (off_line(a, b, p->span[i][0], p->span[i][1]) > 0.75 * near)
			return false;
	return true;
}

static void span_halve(struct pair *lower, struct pair *upper)
{
	const double middle = 0.5 * (lower->t[0] + lower->t[1]);
	for (int r = 0; r < 4; r++) {
		memcpy(lower->span[r], upper->span[0], sizeof lower->span[r]);
		for (int i = 0; i < 3 - r; i++)
			for (int k = 0; k < 2; k++)
				upper->span[i][k] =
				        0.5 * (upper->span[i][k] + upper->span[i + 1][k]);
	}
	lower->t[1] = upper->t[0] = middle;
}

static void piece_halve(struct pair *lower, struct pair *upper)
{
	for (int r = 0; r < lower->order; r++) {
		memcpy(lower->piece[r], upper->piece[0], sizeof lower->piece[r]);
		for (int i = 0; i < lower->order - 1 - r; i++)
			for (int k = 0; k < 3; k++)
				upper->piece[i][k] =
				        0.5 * (upper->piece[i][k] + upper->piece[i + 1][k]);
	}
}

static void meet_add(struct list *out, double a, double b)
{
	struct level_meet *m = list_add(out, sizeof *m);
	if (m)
		*m = (struct level_meet){ { a, b } };
}

static void pair_search(const struct pair *p, double near, int depth, struct list *out)
{
	const struct box2 a = span_box(p), b = piece_box(p);
	struct pair lower, upper;
	double x;
	for (int k = 0; k < 2; k++)
		if (a.hi[k] < b.lo[k] - part_near * near || b.hi[k] < a.lo[k] - part_near * near)
			return;
	const struct level_meet *last =
	        out->n > 0 ? (const struct level_meet *)out->p + out->n - 1 : NULL;
	if (last && last->t[0] <= p->t[0] && last->t[1] >= p->t[1])
		return;
	if (all_near(p, near)) {
		meet_add(out, p->t[0], p->t[1]);
		return;
	}
	if (cones_part(p)) {
		const int found = pair_solve(p, &x);
		if (found > 0)
			meet_add(out, p->t[0] + x * (p->t[1] - p->t[0]),
			         p->t[0] + x * (p->t[1] - p->t[0]));
		if (found >= 0)
			return;
	}
	if (depth == DEPTH_MAX) {
		meet_add(out, p->t[0], p->t[1]);
		return;
	}
	lower = upper = *p;
	if (box2_size(&a) >= box2_size(&b))
		span_halve(&lower, &upper);
	else
		piece_halve(&lower, &upper);
	pair_search(&lower, near, depth + 1, out);
	pair_search(&upper, near, depth + 1, out);
}

void level_meet_piece(const struct level_span *s, const struct trim_piece *p,
                      const struct level_metric *m, struct list *out)
{
	struct pair x = { .t = { s->t[0], s->t[1] }, .order = p->points ? p->order : 2 };
	/* about the span's start, so that nothing cancels */
	for (int i = 0; i < 4; i++)
		for (int k = 0; k < 2; k++)
			x.span[i][k] = (s->uv[i][k] - s->uv[0][k]) * m->scale[k];
	for (int i = 0; i < x.order; i++) {
		const double straight[3] = { p->u[i > 0], p->v[i > 0], 1 };
		const double *q = p->points ? p->points + 3 * i : straight;
		for (int k = 0; k < 2; k++)
			x.piece[i][k] = (q[k] - s->uv[0][k] * q[2]) * m->scale[k];
		x.piece[i][2] = q[2];
	}
	const struct box2 a = span_box(&x);
	const double lo[2] = { (p->lo_u - s->uv[0][0]) * m->scale[0],
		               (p->v[0] - s->uv[0][1]) * m->scale[1] };
	const double hi[2] = { (p->hi_u - s->uv[0][0]) * m->scale[0],
		               (p->v[1] - s->uv[0][1]) * m->scale[1] };
	for (int k = 0; k < 2; k++)
		if (a.hi[k] < lo[k] - m->near || a.lo[k] > hi[k] + m->near)
			return;
	pair_search(&x, m->near, 0, out);
}

double level_meet_distance(const struct trim_pieces *all, const double uv[2],
                           const struct level_metric *m, double most)
{
	enum { HALVES = 60 };
	double best = most;
	for (int i = 0; i < all->n; i++) {
		const struct trim_piece *p = &all->pieces[i];
		if ((p->lo_u - uv[0]) * m->scale[0] > best ||
		    (uv[0] - p->hi_u) * m->scale[0] > best ||
		    (p->v[0] - uv[1]) * m->scale[1] > best ||
		    (uv[1] - p->v[1]) * m->scale[1] > best)
			continue;
		/* no farther than the points with the same u and the same v, and a chord between them */
		double q[2][2], d[2];
		for (int k = 0; k < 2; k++) {
			trim_piece_point(p, trim_piece_find(p, k, uv[k]), q[k], d);
			for (int c = 0; c < 2; c++)
				q[k][c] = (q[k][c] - uv[c]) * m->scale[c];
		}
		best = smaller(best, off_line(q[0], q[1], 0, 0));
	}
	return best;
}
