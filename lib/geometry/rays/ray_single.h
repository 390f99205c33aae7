/* ray_single.h - one ray against one leaf. Private; included by ray_packet.c only.
 *
 * In a packet the lanes of a vector are rays; here they are the 16 coefficients of the leaf, and in
 * the finish the coordinates of a point. What a leaf asks beyond one sure root (folds, poles, an
 * iteration that does not settle) is left to the packet's code, with this ray in its first lane.
 */
#ifndef BATTEN_RAY_SINGLE_H
#define BATTEN_RAY_SINGLE_H

#include <math.h>
#include <string.h>

#include "ray_newton.h"
#include "ray_start.h"

typedef float v16 __attribute__((vector_size(64)));
typedef int32_t i16 __attribute__((vector_size(64)));
typedef float v8 __attribute__((vector_size(32)));
typedef double d4 __attribute__((vector_size(32)));

/* A step this short, in half leaves, says already what a leaf cannot have; one that short is the last
 * before the finish. */
#define EARLY_STEP 0.25f
#define LAST_STEP  1e-2f

/* As struct packet, for one ray. */
struct single {
	struct ray_call call;
	float d[3], n1[3], n2[3], k1, k2, kd, near, far;
	double dd[3], nd1[3], nd2[3], kd1, kd2, kdd, neard, shift;
	double o[3];
	struct ray_found found;
};

INLINE double dots(const double *a, d4 b)
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

struct single_point {
	d4 p, pa, pb;
};

INLINE void single_basis(int order, double t, double *b, double *d)
{
	if (order == 4)
		CUBIC_BASIS(t, b, d);
	else
		bernstein(order, t, b, d);
}

INLINE void single_evaluate_(const double *points, int m, int n, bool rational, double a, double b,
                             struct single_point *out)
{
	double ba[ORDER_MAX], da[ORDER_MAX], bb[ORDER_MAX], db[ORDER_MAX];
	d4 h = { 0 }, ha = { 0 }, hb = { 0 };

	single_basis(m, a, ba, da);
	single_basis(n, b, bb, db);
	for (int i = 0; i < m; i++) {
		d4 q = { 0 }, qb = { 0 };

		for (int j = 0; j < n; j++) {
			d4 p;

			memcpy(&p, points + 4 * (i * n + j), sizeof p);
			q += bb[j] * p;
			qb += db[j] * p;
		}
		h += ba[i] * q;
		ha += da[i] * q;
		hb += ba[i] * qb;
	}
	/* all weights of a polynomial patch are one number, not always 1 */
	double w = 1 / (rational ? h[3] : points[3]);

	out->p = h * w;
	out->pa = rational ? (ha - out->p * ha[3]) * w : ha * w;
	out->pb = rational ? (hb - out->p * hb[3]) * w : hb * w;
}

INLINE void single_evaluate(const struct ray_patch *p, double a, double b, struct single_point *out)
{
	if (p->order[0] == 4 && p->order[1] == 4)
		single_evaluate_(p->points, 4, 4, p->rational, a, b, out);
	else
		single_evaluate_(p->points, p->order[0], p->order[1], p->rational, a, b, out);
}

enum single_end { SINGLE_MISS, SINGLE_HIT, SINGLE_UNSURE };

/* As finish_newton; a start that does not settle in a few steps is not for this code. */
static enum single_end single_newton(const struct ray_patch *patch, const struct single *q,
                                     const double reach[2], double *pa, double *pb,
                                     struct single_point *x)
{
	double a = *pa, b = *pb;

	for (int step = 0; step < 4; step++) {
		single_evaluate(patch, a, b, x);

		double f1 = dots(q->nd1, x->p) - q->kd1, f2 = dots(q->nd2, x->p) - q->kd2;
		double a1 = dots(q->nd1, x->pa), a2 = dots(q->nd2, x->pa);
		double b1 = dots(q->nd1, x->pb), b2 = dots(q->nd2, x->pb);
		double det = a1 * b2 - a2 * b1;
		double small = 1e-13 * (fabs(a1) + fabs(a2)) * (fabs(b1) + fabs(b2));
		double inverse = det / (det * det + small * small + 1e-200);
		double da = (b1 * f2 - b2 * f1) * inverse, db = (a2 * f1 - a1 * f2) * inverse;

		if (fabs(da) > reach[0] || fabs(db) > reach[1])
			return SINGLE_UNSURE;
		a += da;
		b += db;
		if (fabs(da) + fabs(db) < 1e-6 && fabs(f1) + fabs(f2) < 1e-7) {
			/* taken in full by the first derivatives: what is left is its square */
			x->p += x->pa * da + x->pb * db;
			*pa = a;
			*pb = b;
			return a >= -BORDER && a <= 1 + BORDER && b >= -BORDER && b <= 1 + BORDER
			               ? SINGLE_HIT
			               : SINGLE_MISS;
		}
	}
	return SINGLE_UNSURE;
}

/* Is what the trim leaves of the patch there? As finish_trim. */
static bool single_untrimmed(const struct ray_scene *s, const struct ray_leaf *l, double a,
                             double b)
{
	const struct ray_patch *patch = &s->cut.patches[l->patch];

	return l->trim == TRIM_NONE || !trim_takes(s->cut.trims[patch->surface], l, patch, a, b);
}

/* The candidate (s, t) of a leaf: is it a hit nearer than the one so far? */
static enum single_end single_finish(struct single *q, uint32_t number, float s, float t)
{
	const struct ray_scene *scene = q->call.scene;
	const struct ray_leaf *l = &scene->cut.leaves[number];
	const struct ray_patch *patch = &scene->cut.patches[l->patch];
	double half[2] = { 0.5 * (double)l->step[0], 0.5 * (double)l->step[1] };
	double middle[2] = { (double)l->from[0] + half[0], (double)l->from[1] + half[1] };
	double a = middle[0] + half[0] * (double)s, b = middle[1] + half[1] * (double)t;
	struct ray_found *f = &q->found;
	struct single_point x;
	enum single_end end = single_newton(patch, q, half, &a, &b, &x);

	if (end != SINGLE_HIT)
		return end;
	double along = dots(q->dd, x.p) - q->kdd;
	bool beside =
	        fabs(a - middle[0]) > half[0] + BORDER || fabs(b - middle[1]) > half[1] + BORDER;
	int64_t claim = (beside ? CLAIM_BESIDE : 0) | number;
	if (!(along > q->neard) ||
	    !(along < f->t - SAME || (along <= f->t + SAME && claim < f->claim)))
		return SINGLE_MISS;
	if (!single_untrimmed(scene, l, a, b))
		return SINGLE_MISS;
	if (!q->call.nearest)
		return SINGLE_HIT;
	f->t = along;
	f->claim = claim;
	f->a = a;
	f->b = b;
	f->point = vec3(x.p[0], x.p[1], x.p[2]);
	struct vec3 pa = vec3(x.pa[0], x.pa[1], x.pa[2]), pb = vec3(x.pb[0], x.pb[1], x.pb[2]);
	f->normal = vec3_cross(pa, pb);
	f->area = vec3_dot(pa, pa) * vec3_dot(pb, pb) + 1e-24;
	q->far = (float)along + 2 * RAY_NOISE;
	return SINGLE_HIT;
}

/* Pairs of neighbours added: of a, then of b, in each quarter. */
INLINE v16 pairs(v16 a, v16 b)
{
	return __builtin_shufflevector(a, b, 0, 2, 16, 18, 4, 6, 20, 22, 8, 10, 24, 26, 12, 14, 28,
	                               30) +
	       __builtin_shufflevector(a, b, 1, 3, 17, 19, 5, 7, 21, 23, 9, 11, 25, 27, 13, 15, 29,
	                               31);
}

/* Four numbers in each quarter. */
#define QUARTERS(a, b, c, d)                                                                       \
	{                                                                                          \
		a, b, c, d, a, b, c, d, a, b, c, d, a, b, c, d                                     \
	}

INLINE v16 single_dot(const float *n, const struct ray_leaf *l)
{
	v16 x, y, z;

	memcpy(&x, l->a[0], sizeof x);
	memcpy(&y, l->a[1], sizeof y);
	memcpy(&z, l->a[2], sizeof z);
	return n[0] * x + n[1] * y + n[2] * z;
}

/*
 * A leaf or a part of it, as struct node. Row i holds the coefficients of s^i of f1, f2, of the
 * distance along the ray (times the weight, from the leaf's centre), and of the weight.
 */
struct single_node {
	v16 row[4];
	float s0, t0, half;
	float bend; /* as the leaf's, of f1 and f2 */
	int depth;
};

/* A value and its derivatives. */
struct single_value {
	float v, s, t;
};

struct single_values {
	struct single_value f1, f2, along, weight;
};

INLINE struct single_values single_at(const struct single_node *n, float s, float t)
{
	const v16 *r = n->row;
	v16 g = ((r[3] * s + r[2]) * s + r[1]) * s + r[0];
	v16 h = (3 * r[3] * s + 2 * r[2]) * s + r[1];
	float tt = t * t;
	v16 power = QUARTERS(1, t, tt, tt * t);
	v16 slope = QUARTERS(0, 1, 2 * t, 3 * tt);
	v16 hp = h * power;
	v16 sums = pairs(pairs(g * power, g * slope), pairs(hp, hp));

	return (struct single_values){ { sums[0], sums[2], sums[1] },
		                       { sums[4], sums[6], sums[5] },
		                       { sums[8], sums[10], sums[9] },
		                       { sums[12], sums[14], sums[13] } };
}

/* The packet's code for a leaf that is not plain. */
static __attribute__((noinline)) bool single_by_packet(struct single *q, uint32_t number)
{
	struct packet_start start;
	struct packet p;
	struct ray_found *f = &q->found;
	vi act = { -1 };

	for (int i = 0; i < LANES; i++) {
		for (int e = 0; e < 3; e++) {
			start.o[e].x[i] = q->o[e];
			start.d[e].x[i] = q->dd[e];
		}
		start.near.x[i] = q->neard;
		start.far.x[i] = f->t;
	}
	packet_prepare(&p, q->call.scene, &start, q->call.nearest);
	p.claim[0][0] = f->claim;
	if (!any(leaf_trace(&p, number, act)))
		return false;
	if (!q->call.nearest)
		return true;
	packet_found(&p, 0, f);
	q->far = (float)f->t + 2 * RAY_NOISE;
	return true;
}

/*
 * What the iteration from the linear solution comes to: a hit in the node, none, or unsure. What is
 * left after a step is bounded by the bend; often that says after the first that the hit is out of
 * the node, or of what is looked for.
 */
static enum single_end single_solve(struct single *q, uint32_t number, const struct single_node *n,
                                    float s, float t, float reach_s, float reach_t, float dc,
                                    bool *stuck)
{
	const struct ray_leaf *l = &q->call.scene->cut.leaves[number];
	float edge = 1 + SLACK / n->half;

	if (fabsf(s) > 1.2f || fabsf(t) > 1.2f)
		s = t = 0;
	for (int step = 0; step < NEWTON_STEPS; step++) {
		struct single_values x = single_at(n, s, t);
		float det = x.f1.s * x.f2.t - x.f2.s * x.f1.t;
		float inverse = det / (det * det + 1e-30f);
		float ds = (x.f2.v * x.f1.t - x.f1.v * x.f2.t) * inverse;
		float dt = (x.f1.v * x.f2.s - x.f2.v * x.f1.s) * inverse;

		if (fabsf(x.f1.v) + fabsf(x.f2.v) < 0.25f * l->error)
			ds = dt = 0;
		s += ds;
		t += dt;
		if (!(fabsf(s) < reach_s) || !(fabsf(t) < reach_t))
			return SINGLE_MISS;
		float length = fabsf(ds) + fabsf(dt);
		if (!(length < EARLY_STEP))
			continue;

		float left = n->bend * length * length, off = l->error + left;
		float off_s = off * fabsf(inverse) * (fabsf(x.f1.t) + fabsf(x.f2.t));
		float off_t = off * fabsf(inverse) * (fabsf(x.f1.s) + fabsf(x.f2.s));
		if (fabsf(s) > edge + off_s || fabsf(t) > edge + off_t) {
			*stuck = fabsf(s) > ASIDE || fabsf(t) > ASIDE;
			return SINGLE_MISS;
		}
		float along = x.along.v + ds * x.along.s + dt * x.along.t;
		if (l->rational)
			along /= x.weight.v + ds * x.weight.s + dt * x.weight.t;
		along += dc;
		float margin = 4 * RAY_NOISE +
		               2 * (fabsf(x.along.s) * off_s + fabsf(x.along.t) * off_t + left);
		if (!(along > q->near - margin) || !(along < q->far + margin))
			return SINGLE_MISS;
		/* as in node_candidates */
		if (!q->call.nearest && l->trim != TRIM_THROUGH && fabsf(s) + off_s < 1 &&
		    fabsf(t) + off_t < 1 && along > q->near + 2 * margin &&
		    along < q->far - 2 * margin)
			return SINGLE_HIT;
		if (!(length < LAST_STEP))
			continue;
		if (fabsf(s) > 1.5f || fabsf(t) > 1.5f)
			return SINGLE_UNSURE;
		return single_finish(q, number, n->s0 + n->half * s, n->t0 + n->half * t);
	}
	*stuck = true;
	return SINGLE_MISS;
}

/* The quarter of a node on those sides (-1, 1): s = side / 2 + s' / 2, t likewise. */
static void single_quarter(const struct single_node *in, float side_s, float side_t,
                           struct single_node *out)
{
	const v16 *r = in->row;
	float h = 0.5f * side_s, g = 0.5f * side_t;
	v16 half[4] = {
		((r[3] * h + r[2]) * h + r[1]) * h + r[0],
		0.5f * ((3 * r[3] * h + 2 * r[2]) * h + r[1]),
		0.25f * (3 * r[3] * h + r[2]),
		0.125f * r[3],
	};
	/* t^k of the whole in powers of the half */
	const v16 part[4] = {
		QUARTERS(1, 0, 0, 0),
		QUARTERS(g, 0.5f, 0, 0),
		QUARTERS(g * g, g, 0.25f, 0),
		QUARTERS(g * g * g, 1.5f * g * g, 0.75f * g, 0.125f),
	};
	for (int i = 0; i < 4; i++) {
		v16 a = half[i];

		out->row[i] = __builtin_shufflevector(a, a, 0, 0, 0, 0, 4, 4, 4, 4, 8, 8, 8, 8, 12,
		                                      12, 12, 12) *
		                      part[0] +
		              __builtin_shufflevector(a, a, 1, 1, 1, 1, 5, 5, 5, 5, 9, 9, 9, 9, 13,
		                                      13, 13, 13) *
		                      part[1] +
		              __builtin_shufflevector(a, a, 2, 2, 2, 2, 6, 6, 6, 6, 10, 10, 10, 10,
		                                      14, 14, 14, 14) *
		                      part[2] +
		              __builtin_shufflevector(a, a, 3, 3, 3, 3, 7, 7, 7, 7, 11, 11, 11, 11,
		                                      15, 15, 15, 15) *
		                      part[3];
	}
	out->half = in->half / 2;
	out->s0 = in->s0 + side_s * out->half;
	out->t0 = in->t0 + side_t * out->half;
	out->bend = in->bend / 4;
	out->depth = in->depth + 1;
}

/* As node_trace. Unsure: the leaf is the packet's. */
static enum single_end single_node_trace(struct single *q, uint32_t number,
                                         const struct single_node *n, float dc)
{
	const struct ray_leaf *l = &q->call.scene->cut.leaves[number];
	const v16 *r = n->row;
	float v1 = r[0][0], t1 = r[0][1], s1 = r[1][0], v2 = r[0][4], t2 = r[0][5], s2 = r[1][4];
	float det = s1 * t2 - s2 * t1, ns = v2 * t1 - v1 * t2, nt = v1 * s2 - v2 * s1;
	float ad = fabsf(det), edge = 1 + SLACK / n->half;
	const v16 from1 = QUARTERS(0, 1, 1, 1), from2 = QUARTERS(0, 0, 1, 1);
	const v16 times = QUARTERS(0, 1, 2, 3), times2 = QUARTERS(0, 0, 2, 3);
	v16 size[4];

	for (int i = 0; i < 4; i++)
		size[i] = (v16)((i16)r[i] & 0x7fffffff);
	v16 rest = size[0] * from2 + size[1] * from1 + (size[2] + size[3]);
	v16 zs = size[1] * from1 + (2 * size[2] + 3 * size[3]);
	v16 zt = size[0] * times2 + (size[1] + size[2] + size[3]) * times;
	v16 sums = pairs(pairs(rest, zs), pairs(zt, zt));
	float rest1 = (sums[0] + l->error) * 1.00001f, rest2 = (sums[4] + l->error) * 1.00001f;
	float z1s = sums[1], z1t = sums[2], z2s = sums[5], z2t = sums[6];
	float over_s = fabsf(t2) * rest1 + fabsf(t1) * rest2;
	float over_t = fabsf(s2) * rest1 + fabsf(s1) * rest2;

	if (fabsf(v1) > (fabsf(s1) + fabsf(t1)) * edge + rest1 ||
	    fabsf(v2) > (fabsf(s2) + fabsf(t2)) * edge + rest2 || fabsf(ns) > ad * edge + over_s ||
	    fabsf(nt) > ad * edge + over_t)
		return SINGLE_MISS;
	if (n->depth == QUARTERINGS)
		return SINGLE_UNSURE;

	if (ad > fabsf(s1) * z2t + fabsf(t2) * z1s + fabsf(s2) * z1t + fabsf(t1) * z2s + z1s * z2t +
	                 z1t * z2s) {
		float inverse = det / (det * det + 1e-30f);
		bool stuck = false;
		enum single_end end = single_solve(q, number, n, ns * inverse, nt * inverse,
		                                   3 + 2 * over_s * fabsf(inverse),
		                                   3 + 2 * over_t * fabsf(inverse), dc, &stuck);

		if (!stuck)
			return end;
	}
	enum single_end hit = SINGLE_MISS;
	for (int k = 0; k < 4; k++) {
		struct single_node child;

		single_quarter(n, k & 1 ? 1 : -1, k & 2 ? 1 : -1, &child);
		enum single_end end = single_node_trace(q, number, &child, dc);
		if (end == SINGLE_UNSURE || (end == SINGLE_HIT && !q->call.nearest))
			return end;
		if (end == SINGLE_HIT)
			hit = end;
	}
	return hit;
}

/* Row i of a node from f1, f2, fd and w as leaves have them, k = 4 i. */
#define SINGLE_ROW(k)                                                                              \
	JOIN_QUARTERS(__builtin_shufflevector(f1, f2, k, k + 1, k + 2, k + 3, k + 16, k + 17,      \
	                                      k + 18, k + 19),                                     \
	              __builtin_shufflevector(fd, w, k, k + 1, k + 2, k + 3, k + 16, k + 17,       \
	                                      k + 18, k + 19))
#define JOIN_QUARTERS(a, b)                                                                        \
	__builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)

/* A hit on the leaf, nearer than the one so far? Kept where the nearest is wanted. */
static bool single_trace(struct single *q, uint32_t number)
{
	const struct ray_leaf *l = &q->call.scene->cut.leaves[number];
	float e1 = -q->k1, e2 = -q->k2, dc = -q->kd;

	for (int e = 0; e < 3; e++) {
		e1 += q->n1[e] * l->center[e];
		e2 += q->n2[e] * l->center[e];
		dc += q->d[e] * l->center[e];
	}
	if (!(dc - l->reach < q->far) || !(dc + l->reach > q->near))
		return false;

	v16 f1 = single_dot(q->n1, l), f2 = single_dot(q->n2, l), w;
	float rest = l->rest, rest_s = l->rest_s, rest_t = l->rest_t, bend = l->bend;

	memcpy(&w, l->a[3], sizeof w);
	if (l->rational) {
		float aside = fmaxf(fabsf(e1), fabsf(e2)) * l->rest_w;

		f1 += e1 * w;
		f2 += e2 * w;
		rest += aside;
		rest_s += 3 * aside;
		rest_t += 3 * aside;
		bend += 9 * aside;
	} else {
		f1[0] += e1;
		f2[0] += e2;
	}

	/* the middle's value and slopes alone reject most */
	float v1 = f1[0], t1 = f1[1], s1 = f1[4], v2 = f2[0], t2 = f2[1], s2 = f2[4];
	float det = s1 * t2 - s2 * t1, ns = v2 * t1 - v1 * t2, nt = v1 * s2 - v2 * s1;
	float ad = fabsf(det), ts = fabsf(t1) + fabsf(t2), ss = fabsf(s1) + fabsf(s2);
	if (fabsf(ns) > ad * (1 + SLACK) + ts * rest || fabsf(nt) > ad * (1 + SLACK) + ss * rest)
		return false;

	v16 fd = single_dot(q->d, l);
	const struct single_node n = {
		.row = { SINGLE_ROW(0), SINGLE_ROW(4), SINGLE_ROW(8), SINGLE_ROW(12) },
		.half = 1,
		.bend = bend,
	};
	enum single_end end;
	bool stuck = true;

	/* as in single_node_trace, with the leaf's own bounds */
	if (ad > ss * rest_t + ts * rest_s + 2 * rest_s * rest_t) {
		float inverse = 1 / det;

		stuck = false;
		end = single_solve(q, number, &n, ns * inverse, nt * inverse,
		                   3 + 2 * ts * rest * fabsf(inverse),
		                   3 + 2 * ss * rest * fabsf(inverse), dc, &stuck);
	}
	if (stuck)
		end = single_node_trace(q, number, &n, dc);
	return end == SINGLE_UNSURE ? single_by_packet(q, number) : end == SINGLE_HIT;
}

#endif
