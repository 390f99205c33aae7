/* ray_newton.h - a packet of rays against one leaf in single precision. Private; included by
 * ray_packet.c only.
 *
 * A ray is two planes; the leaf's coefficients dotted with their normals are two bicubics f1, f2 in
 * s, t that vanish together at a hit. Bounds on the terms above the linear ones reject, without
 * losing a hit, and tell where the Jacobian cannot vanish: there is at most one hit then, and
 * Newton's iteration from the linear solution finds it. Elsewhere (silhouettes, poles) the leaf is
 * quartered until it is so, or so small that a miss cannot be seen.
 */
#ifndef BATTEN_RAY_NEWTON_H
#define BATTEN_RAY_NEWTON_H

#include "ray_finish.h"

enum { NEWTON_STEPS = 7, FOLD_STEPS = 12, QUARTERINGS = 6 };

/* Candidates may lie out of the leaf by this much; the finish decides. */
#define SLACK 2e-5f

/* An iteration that ends this far from the middle of a node has lost its way on a leaf that is long
 * and bent, as on the edge of a blade: it says nothing of the node. */
#define ASIDE 6.0f

/* One leaf, or a part of it: s = s0 + half * s', t likewise. */
struct node {
	vf f1[16], f2[16];
	float s0, t0, half;
	int depth;
};

struct leaf_call {
	struct packet *p;
	const struct ray_leaf *l;
	uint32_t number;
	vf dc; /* d . (center - origin) */
};

INLINE vf dotf(const vf *n, const float *a, int step)
{
	return n[0] * a[0] + n[1] * a[step] + n[2] * a[2 * step];
}

/* f and its derivatives at (s, t). */
INLINE void node_evaluate(const vf *f, vf s, vf t, vf *value, vf *ds, vf *dt)
{
	vf g[4], h[4];

	for (int j = 0; j < 4; j++) {
		g[j] = ((f[12 + j] * s + f[8 + j]) * s + f[4 + j]) * s + f[j];
		h[j] = (3 * f[12 + j] * s + 2 * f[8 + j]) * s + f[4 + j];
	}
	*value = ((g[3] * t + g[2]) * t + g[1]) * t + g[0];
	*dt = (3 * g[3] * t + 2 * g[2]) * t + g[1];
	*ds = ((h[3] * t + h[2]) * t + h[1]) * t + h[0];
}

/* What the iteration leaves of a lane. */
struct newton {
	vf s, t;
	vf reach_s, reach_t; /* no solution in the node can send the iteration beyond these */
	vf unsure;           /* how far s and t may still be off, together */
	vi found;            /* in the node, or so near that rounding decides */
	vi stuck;            /* neither found nor gone */
};

/* fold: the Jacobian may vanish; steps are then kept short and there are more of them. */
INLINE void node_newton(const struct node *n, float error, bool fold, vi live, struct newton *x)
{
	vf s = x->s, t = x->t;
	float edge = 1 + SLACK / n->half;
	vf rest = fill(0);

	x->found = x->stuck = live & ~live;
	for (int step = 0; step < (fold ? FOLD_STEPS : NEWTON_STEPS); step++) {
		vf v1, s1, t1, v2, s2, t2;

		node_evaluate(n->f1, s, t, &v1, &s1, &t1);
		node_evaluate(n->f2, s, t, &v2, &s2, &t2);
		vf det = s1 * t2 - s2 * t1;
		vf inverse = det / (det * det + 1e-30f);
		vf ds = (v2 * t1 - v1 * t2) * inverse, dt = (v1 * s2 - v2 * s1) * inverse;
		if (fold) {
			vf cut = 0.7f / larger(larger(size(ds), size(dt)), fill(0.7f));

			ds *= cut;
			dt *= cut;
		}
		/* at a pole the step says nothing once the ray is met */
		rest = size(v1) + size(v2);
		vi there = live & (rest < (fold ? 2 * error : 0.25f * error));
		vi move = live & ~there;

		s = pick(move, s + ds, s);
		t = pick(move, t + dt, t);
		live &= (size(s) < x->reach_s) & (size(t) < x->reach_t);
		vf left = size(ds) + size(dt);
		vi ends = live & ((left < 4e-3f) | there);
		if (any(ends)) {
			/* how far the coefficients' error moves the solution, and what a step
			 * leaves where convergence is slow */
			vf grow = error * size(inverse);
			vf off_s = grow * (size(t1) + size(t2)) + 0.05f * size(ds);
			vf off_t = grow * (size(s1) + size(s2)) + 0.05f * size(dt);
			vi in = ends & (size(s) <= edge + off_s) & (size(t) <= edge + off_t);

			x->found |= in;
			x->stuck |= ends & ~in & ((size(s) > ASIDE) | (size(t) > ASIDE));
			x->s = pick(in, s, x->s);
			x->t = pick(in, t, x->t);
			x->unsure = pick(in, off_s + off_t, x->unsure);
			live &= ~ends;
		}
		if (!any(live))
			break;
	}
	x->stuck |= live;
	if (fold) { /* a double root, nearly: the finish has the digits to tell */
		vi in = live & (rest < 64 * error) & (size(s) < 1.5f) & (size(t) < 1.5f);

		x->found |= in;
		x->s = pick(in, s, x->s);
		x->t = pick(in, t, x->t);
		x->unsure = pick(in, fill(1), x->unsure);
	}
}

/* Distance along the ray at (s, t) of the leaf. */
INLINE vf leaf_along(const struct leaf_call *c, vf s, vf t)
{
	const struct ray_leaf *l = c->l;
	vf h[4], w;

	for (int j = 0; j < 4; j++) {
		h[j] = dotf(c->p->d, &l->a[0][12 + j], 16);
		for (int i = 2; i >= 0; i--)
			h[j] = h[j] * s + dotf(c->p->d, &l->a[0][4 * i + j], 16);
	}
	vf along = ((h[3] * t + h[2]) * t + h[1]) * t + h[0];
	if (!l->rational)
		return along + c->dc;
	const float *a = l->a[3];
	for (int j = 0; j < 4; j++)
		h[j] = ((a[12 + j] * s + a[8 + j]) * s + a[4 + j]) * s + a[j];
	w = ((h[3] * t + h[2]) * t + h[1]) * t + h[0];
	return along / w + c->dc;
}

/* Coefficients of one variable's cubic on a half: x = side / 2 + x' / 2, for four of them. */
INLINE void cubic_halve(const vf *in, vf *out, int step, float side)
{
	vf a = in[0], b = in[step], c = in[2 * step], d = in[3 * step];
	float h = 0.5f * side;

	out[0] = ((d * h + c) * h + b) * h + a;
	out[step] = 0.5f * ((3 * d * h + 2 * c) * h + b);
	out[2 * step] = 0.25f * (3 * d * h + c);
	out[3 * step] = 0.125f * d;
}

INLINE void node_halve(const vf *in, vf *out, float side_s, float side_t)
{
	vf half[16];

	for (int j = 0; j < 4; j++)
		cubic_halve(in + j, half + j, 4, side_s);
	for (int i = 0; i < 4; i++)
		cubic_halve(half + 4 * i, out + 4 * i, 1, side_t);
}

/* Sums of the absolute terms i + j >= 2: themselves, times i, times j. */
INLINE void node_rest(const vf *f, vf *rest, vf *rest_s, vf *rest_t)
{
	vf row[4], column[4], mixed = size(f[5]);

	row[0] = size(f[2]) + size(f[3]);
	row[1] = mixed + size(f[6]) + size(f[7]);
	row[2] = size(f[8]) + size(f[9]) + size(f[10]) + size(f[11]);
	row[3] = size(f[12]) + size(f[13]) + size(f[14]) + size(f[15]);
	column[1] = mixed + size(f[9]) + size(f[13]);
	column[2] = size(f[2]) + size(f[6]) + size(f[10]) + size(f[14]);
	column[3] = size(f[3]) + size(f[7]) + size(f[11]) + size(f[15]);
	*rest = row[0] + row[1] + row[2] + row[3];
	*rest_s = row[1] + 2 * row[2] + 3 * row[3];
	*rest_t = column[1] + 2 * column[2] + 3 * column[3];
}

/* Candidates of a node that are in reach go to the finish. */
INLINE vi node_candidates(const struct leaf_call *c, const struct node *n, const struct newton *x)
{
	vf s = n->s0 + n->half * x->s, t = n->t0 + n->half * x->t;
	vf along = leaf_along(c, s, t);
	vf margin = 4 * RAY_NOISE + 2 * n->half * c->l->reach * x->unsure;
	vi found = x->found & (along > c->p->near - margin) & (along < c->p->far + margin);

	if (!any(found))
		return found;
	vi sure = found & ~found;
	if (!c->p->call.nearest && c->l->trim != TRIM_THROUGH) {
		/* well inside in every way: no more digits are needed to say that there is a hit */
		sure = found & (size(x->s) + x->unsure < 1) & (size(x->t) + x->unsure < 1) &
		       (along > c->p->near + 2 * margin) & (along < c->p->far - 2 * margin);
		found &= ~sure;
		if (!any(found))
			return sure;
	}
	/* where the place is quite unsure, the middle of the node is as good a start */
	vf limit = fill(1.5f);
	s = pick(size(s) < limit, s, fill(n->s0));
	t = pick(size(t) < limit, t, fill(n->t0));
	return sure | finish(c->p, c->number, s, t, found);
}

/*
 * The smallest node where the surface still may fold as seen along the ray: two hits lie on the two
 * sides of the fold, so start on both, along the direction that the ray sees end on.
 */
static __attribute__((noinline)) vi node_fold(const struct leaf_call *c, const struct node *n,
                                              vi act)
{
	vf s1 = n->f1[4], t1 = n->f1[1], s2 = n->f2[4], t2 = n->f2[1];
	vi second = size(s2) + size(t2) > size(s1) + size(t1);
	vf s = pick(second, t2, t1), t = -pick(second, s2, s1);
	vf scale = 1 / (larger(size(s), size(t)) + 1e-30f);
	vi hit = act & ~act;

	for (int k = 0; k < 6; k++) {
		/* then the corners: the fold may be curved */
		float side = k % 2 ? 0.8f : -0.8f;
		struct newton x = { .reach_s = fill(3), .reach_t = fill(3) };

		x.s = k < 2 ? side * scale * s : fill(side);
		x.t = k < 2 ? side * scale * t : fill(k < 4 ? side : -side);

		node_newton(n, c->l->error, true, act, &x);
		if (any(x.found))
			hit |= node_candidates(c, n, &x);
	}
	return hit;
}

static __attribute__((noinline)) vi node_trace(const struct leaf_call *c, const struct node *n,
                                               vi act)
{
	const vf *f1 = n->f1, *f2 = n->f2;
	vf v1 = f1[0], s1 = f1[4], t1 = f1[1], v2 = f2[0], s2 = f2[4], t2 = f2[1];
	vf det = s1 * t2 - s2 * t1, ns = v2 * t1 - v1 * t2, nt = v1 * s2 - v2 * s1;
	vf ad = size(det), rest1, rest2, z1s, z1t, z2s, z2t;
	float error = c->l->error, edge = 1 + SLACK / n->half;
	vi none = act & ~act;

	node_rest(f1, &rest1, &z1s, &z1t);
	node_rest(f2, &rest2, &z2s, &z2t);
	rest1 = (rest1 + error) * 1.00001f;
	rest2 = (rest2 + error) * 1.00001f;
	act &= size(v1) <= (size(s1) + size(t1)) * edge + rest1;
	act &= size(v2) <= (size(s2) + size(t2)) * edge + rest2;
	act &= size(ns) <= ad * edge + size(t2) * rest1 + size(t1) * rest2;
	act &= size(nt) <= ad * edge + size(s2) * rest1 + size(s1) * rest2;
	if (!any(act))
		return none;

	vi solve = act;
	if (n->depth < QUARTERINGS)
		solve &= ad > size(s1) * z2t + size(t2) * z1s + size(s2) * z1t + size(t1) * z2s +
		                      z1s * z2t + z1t * z2s;
	vi open = act & ~solve, hit = none;

	if (any(solve)) {
		vf inverse = det / (det * det + 1e-30f), s = ns * inverse, t = nt * inverse;
		vi far = (size(s) > 1.2f) | (size(t) > 1.2f);
		/* thin curved leaves: the first step may go many widths aside and come back */
		struct newton x = {
			.s = pick(far, fill(0), s),
			.t = pick(far, fill(0), t),
			.reach_s = 3 + 2 * (size(t2) * rest1 + size(t1) * rest2) * size(inverse),
			.reach_t = 3 + 2 * (size(s2) * rest1 + size(s1) * rest2) * size(inverse),
		};

		if (n->depth < QUARTERINGS) {
			node_newton(n, error, false, solve, &x);
			open |= x.stuck;
			if (any(x.found))
				hit = node_candidates(c, n, &x);
		} else {
			hit = node_fold(c, n, solve);
		}
	}
	if (n->depth == QUARTERINGS || !any(open))
		return hit;

	struct node child = { .half = n->half / 2, .depth = n->depth + 1 };
	for (int k = 0; k < 4; k++) {
		float side_s = k & 1 ? 1 : -1, side_t = k & 2 ? 1 : -1;

		if (!c->p->call.nearest)
			open &= ~hit;
		child.s0 = n->s0 + side_s * child.half;
		child.t0 = n->t0 + side_t * child.half;
		node_halve(f1, child.f1, side_s, side_t);
		node_halve(f2, child.f2, side_s, side_t);
		hit |= node_trace(c, &child, open);
	}
	return hit;
}

INLINE vi leaf_trace_(struct packet *p, uint32_t number, vi act, bool rational)
{
	const struct ray_leaf *l = &p->call.scene->cut.leaves[number];
	struct leaf_call c = { .p = p, .l = l, .number = number };
	vf e1 = dotf(p->n1, l->center, 1) - p->k1, e2 = dotf(p->n2, l->center, 1) - p->k2;
	vi none = act & ~act;
	struct node n;

	c.dc = dotf(p->d, l->center, 1) - p->kd;
	act &= (c.dc - l->reach < p->far) & (c.dc + l->reach > p->near);

	/* the middle's value and slopes alone reject most */
	const int first[3] = { 0, 4, 1 };
	for (int k = 0; k < 3; k++) {
		int at = first[k];

		n.f1[at] = dotf(p->n1, &l->a[0][at], 16);
		n.f2[at] = dotf(p->n2, &l->a[0][at], 16);
		if (rational) {
			n.f1[at] += e1 * l->a[3][at];
			n.f2[at] += e2 * l->a[3][at];
		} else if (at == 0) {
			n.f1[0] += e1;
			n.f2[0] += e2;
		}
	}
	vf v1 = n.f1[0], s1 = n.f1[4], t1 = n.f1[1], v2 = n.f2[0], s2 = n.f2[4], t2 = n.f2[1];
	vf ad = size(s1 * t2 - s2 * t1) * (1 + SLACK), rest = fill(l->rest);
	if (rational)
		rest += larger(size(e1), size(e2)) * l->rest_w;
	act &= size(v2 * t1 - v1 * t2) <= ad + (size(t1) + size(t2)) * rest;
	act &= size(v1 * s2 - v2 * s1) <= ad + (size(s1) + size(s2)) * rest;
	if (!any(act))
		return none;

	for (int k = 2; k < 16; k++) {
		if (k == 4)
			continue;
		n.f1[k] = dotf(p->n1, &l->a[0][k], 16);
		n.f2[k] = dotf(p->n2, &l->a[0][k], 16);
		if (rational) {
			n.f1[k] += e1 * l->a[3][k];
			n.f2[k] += e2 * l->a[3][k];
		}
	}
	n.s0 = n.t0 = 0;
	n.half = 1;
	n.depth = 0;
	return node_trace(&c, &n, act);
}

static vi leaf_trace(struct packet *p, uint32_t number, vi act)
{
	if (p->call.scene->cut.leaves[number].rational)
		return leaf_trace_(p, number, act, true);
	return leaf_trace_(p, number, act, false);
}

#endif
