/* ray_finish.h - candidates of one leaf finished in double on the true patch. Private; included by
 * ray_packet.c only. */
#ifndef BATTEN_RAY_FINISH_H
#define BATTEN_RAY_FINISH_H

#include "ray_packet.h"

enum { FINISH_STEPS = 14 };

/* Parameters may be out of the patch by this much, so that nothing slips between two patches. */
#define BORDER 1e-9

/* Hits nearer to each other than this along a ray are one: that of the lower claim. */
#define SAME 1e-12

/* A claim is the number of the leaf that found a hit, and this if the hit lies beside it, for
 * whether a leaf is asked about what lies beside it depends on what was found before. */
#define CLAIM_BESIDE ((int64_t)1 << 32)

/* The cubic Bernstein polynomials at t, a number or a vector of them, and their derivatives. */
#define CUBIC_BASIS(t, b, d)                                                                       \
	do {                                                                                       \
		__typeof__(t) r_ = 1 - (t), rr_ = r_ * r_, tt_ = (t) * (t), rt_ = r_ * (t);        \
		(b)[0] = rr_ * r_;                                                                 \
		(b)[1] = 3 * rr_ * (t);                                                            \
		(b)[2] = 3 * tt_ * r_;                                                             \
		(b)[3] = tt_ * (t);                                                                \
		(d)[0] = -3 * rr_;                                                                 \
		(d)[1] = 3 * (rr_ - 2 * rt_);                                                      \
		(d)[2] = 3 * (2 * rt_ - tt_);                                                      \
		(d)[3] = 3 * tt_;                                                                  \
	} while (0)

/* Bernstein polynomials of degree order - 1 and their derivatives. */
INLINE void finish_basis(int order, vd t, vd *b, vd *d)
{
	vd r = 1 - t;

	if (order == 4) {
		CUBIC_BASIS(t, b, d);
		return;
	}
	b[0] = filld(1);
	for (int k = 1; k < order; k++) {
		if (k == order - 1) { /* b holds the degree below: differences are the derivative */
			d[0] = -k * b[0];
			for (int i = 1; i < k; i++)
				d[i] = k * (b[i - 1] - b[i]);
			d[k] = k * b[k - 1];
		}
		vd carry = filld(0);
		for (int i = 0; i < k; i++) {
			vd keep = carry + r * b[i];

			carry = t * b[i];
			b[i] = keep;
		}
		b[k] = carry;
	}
}

struct finish_point {
	vd p[3], pa[3], pb[3];
};

INLINE void finish_evaluate_(const double *points, int m, int n, bool rational, vd a, vd b,
                             struct finish_point *out)
{
	vd ba[ORDER_MAX], da[ORDER_MAX], bb[ORDER_MAX], db[ORDER_MAX];
	vd h[4], ha[4], hb[4];
	int components = rational ? 4 : 3;

	finish_basis(m, a, ba, da);
	finish_basis(n, b, bb, db);
	for (int e = 0; e < components; e++)
		h[e] = ha[e] = hb[e] = filld(0);
	for (int i = 0; i < m; i++)
		for (int e = 0; e < components; e++) {
			const double *row = points + 4 * i * n + e;
			vd q = bb[0] * row[0], qb = db[0] * row[0];

			for (int j = 1; j < n; j++) {
				q += bb[j] * row[4 * j];
				qb += db[j] * row[4 * j];
			}
			h[e] += ba[i] * q;
			ha[e] += da[i] * q;
			hb[e] += ba[i] * qb;
		}
	if (!rational) {
		/* all weights are one number, not always 1 */
		double w = 1 / points[3];

		for (int e = 0; e < 3; e++) {
			out->p[e] = h[e] * w;
			out->pa[e] = ha[e] * w;
			out->pb[e] = hb[e] * w;
		}
		return;
	}
	vd w = 1 / h[3];
	for (int e = 0; e < 3; e++) {
		out->p[e] = h[e] * w;
		out->pa[e] = (ha[e] - out->p[e] * ha[3]) * w;
		out->pb[e] = (hb[e] - out->p[e] * hb[3]) * w;
	}
}

static __attribute__((noinline)) void finish_evaluate(const struct ray_patch *p, vd a, vd b,
                                                      struct finish_point *out)
{
	if (p->order[0] == 4 && p->order[1] == 4) {
		if (p->rational)
			finish_evaluate_(p->points, 4, 4, true, a, b, out);
		else
			finish_evaluate_(p->points, 4, 4, false, a, b, out);
	} else {
		finish_evaluate_(p->points, p->order[0], p->order[1], p->rational, a, b, out);
	}
}

INLINE vd dotd(const vd *a, const vd *b)
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The part of a half packet's rays that finishing needs, by value. */
struct finish_rays {
	vd d[3], n1[3], n2[3], k1, k2, kd;
};

/*
 * Newton steps for the lanes `live` from (a, b). Comes back with the lanes that reached the surface
 * inside the patch; a, b, x are theirs.
 */
INLINE vl finish_newton(const struct ray_patch *patch, const struct finish_rays *r,
                        const double reach[2], vl live, vd *pa, vd *pb, struct finish_point *x)
{
	vd a = *pa, b = *pb;
	vl done = live & ~live;
	struct finish_point now;

	for (int step = 0; step < FINISH_STEPS; step++) {
		finish_evaluate(patch, a, b, &now);

		vd f1 = dotd(r->n1, now.p) - r->k1, f2 = dotd(r->n2, now.p) - r->k2;
		vd a1 = dotd(r->n1, now.pa), a2 = dotd(r->n2, now.pa);
		vd b1 = dotd(r->n1, now.pb), b2 = dotd(r->n2, now.pb);
		vd det = a1 * b2 - a2 * b1;
		/* at a pole or a tangent point det vanishes: the step does too, the rest decides */
		vd small = 1e-13 * (sized(a1) + sized(a2)) * (sized(b1) + sized(b2));
		vd inverse = det / (det * det + small * small + 1e-200);
		vd da = (b1 * f2 - b2 * f1) * inverse, db = (a2 * f1 - a1 * f2) * inverse;
		vd rest = sized(f1) + sized(f2);
		vd left = sized(da) + sized(db);
		vl late = (vl){ 0 } - (step > 3);
		/* this step is taken in full by the first derivatives: what is left is its square */
		vl sure = live & (left < 1e-6) & (rest < 1e-7);
		/* where the Jacobian vanishes (a pole, a double root) the step says little, or
		 * shrinks by halves only, once the ray is met */
		vl ends = sure | (live & (rest < 1e-13) & ((left > 1e-6) | late));

		if (any_half(ends)) {
			vd ea = pickd(sure, da, filld(0)), eb = pickd(sure, db, filld(0));

			for (int e = 0; e < 3; e++) {
				vd p = now.p[e] + now.pa[e] * ea + now.pb[e] * eb;

				x->p[e] = pickd(ends, p, x->p[e]);
				x->pa[e] = pickd(ends, now.pa[e], x->pa[e]);
				x->pb[e] = pickd(ends, now.pb[e], x->pb[e]);
			}
			*pa = pickd(ends, a + ea, *pa);
			*pb = pickd(ends, b + eb, *pb);
			done |= ends;
			live &= ~ends;
		}
		/* near a tangent point a step may go anywhere: keep it in the leaf's neighbourhood */
		vd over = sized(da) / reach[0], over_b = sized(db) / reach[1];
		over = pickd(over > over_b, over, over_b);
		vd cut = 1 / pickd(over > 1, over, filld(1));

		a += da * cut;
		b += db * cut;
		live &= (sized(a - 0.5) < 2) & (sized(b - 0.5) < 2);
		if (!any_half(live))
			break;
	}
	return done & (*pa >= -BORDER) & (*pa <= 1 + BORDER) & (*pb >= -BORDER) &
	       (*pb <= 1 + BORDER);
}

/* Does the trim take the place (a, b) of a patch, found by leaf l? */
static bool trim_takes(const struct trim_test *trim, const struct ray_leaf *l,
                       const struct ray_patch *patch, double a, double b)
{
	double at[2] = { fmin(fmax(a, 0), 1), fmin(fmax(b, 0), 1) };
	bool beside = l->trim == TRIM_THROUGH;

	for (int d = 0; d < 2; d++) {
		double from = (double)l->from[d], step = (double)l->step[d];

		beside |= at[d] < from - TRIM_BESIDE * step ||
		          at[d] > from + (1 + TRIM_BESIDE) * step;
	}
	return beside && !trim_test_inside(trim, (1 - at[0]) * patch->u[0] + at[0] * patch->u[1],
	                                   (1 - at[1]) * patch->v[0] + at[1] * patch->v[1]);
}

/* Of the lanes `ok` those whose place (a, b) in the patch the trim leaves. */
static __attribute__((noinline)) vl finish_trim(const struct packet *p, const struct ray_leaf *l,
                                                vl ok, vd a, vd b)
{
	const struct ray_patch *patch = &p->call.scene->cut.patches[l->patch];
	const struct trim_test *trim = p->call.scene->cut.trims[patch->surface];

	for (int i = 0; i < HALF; i++)
		if (ok[i] && trim_takes(trim, l, patch, a[i], b[i]))
			ok[i] = 0;
	return ok;
}

/* Keep what lanes `ok` of half h have found. */
INLINE void finish_keep(struct packet *p, int h, vl ok, vl claim, vd t, vd a, vd b,
                        const struct finish_point *x)
{
	vd area = dotd(x->pa, x->pa) * dotd(x->pb, x->pb) + 1e-24;

	p->fard[h] = pickd(ok, t, p->fard[h]);
	p->area[h] = pickd(ok, area, p->area[h]);
	p->claim[h] = (ok & claim) | (~ok & p->claim[h]);
	p->a[0][h] = pickd(ok, a, p->a[0][h]);
	p->a[1][h] = pickd(ok, b, p->a[1][h]);
	for (int e = 0; e < 3; e++) {
		int f = (e + 1) % 3, g = (e + 2) % 3;
		vd n = x->pa[f] * x->pb[g] - x->pa[g] * x->pb[f];

		p->point[e][h] = pickd(ok, x->p[e], p->point[e][h]);
		p->normal[e][h] = pickd(ok, n, p->normal[e][h]);
	}
}

/*
 * Candidates (s, t) of a leaf, lanes `found`: those that are true hits between near and far.
 * The packet keeps them where the nearest is wanted.
 */
static __attribute__((noinline)) vi finish(struct packet *p, uint32_t number, vf s, vf t, vi found)
{
	const struct ray_leaf *l = &p->call.scene->cut.leaves[number];
	const struct ray_patch *patch = &p->call.scene->cut.patches[l->patch];
	union {
		vf v;
		hf half[2];
	} us = { s }, ut = { t };
	union {
		vi v;
		hi half[2];
	} uf = { found };
	vl out[2] = { { 0 }, { 0 } };

	for (int h = 0; h < 2; h++) {
		vl live = __builtin_convertvector(uf.half[h], vl);
		if (!any_half(live))
			continue;

		struct finish_rays r;
		for (int e = 0; e < 3; e++) {
			r.d[e] = p->dd[e][h];
			r.n1[e] = p->nd1[e][h];
			r.n2[e] = p->nd2[e][h];
		}
		r.k1 = p->kd1[h];
		r.k2 = p->kd2[h];
		r.kd = p->kdd[h];

		double middle[2], half[2];
		for (int d = 0; d < 2; d++) {
			half[d] = 0.5 * (double)l->step[d];
			middle[d] = (double)l->from[d] + half[d];
		}
		vd a = middle[0] + half[0] * __builtin_convertvector(us.half[h], vd);
		vd b = middle[1] + half[1] * __builtin_convertvector(ut.half[h], vd);
		struct finish_point x = { 0 };
		vl ok = finish_newton(patch, &r, half, live, &a, &b, &x);
		vd along = dotd(r.d, x.p) - r.kd;
		vl beside = (sized(a - middle[0]) > half[0] + BORDER) |
		            (sized(b - middle[1]) > half[1] + BORDER);
		vl claim = (beside & CLAIM_BESIDE) | (int64_t)number;

		ok &= along > p->neard[h];
		ok &= (along < p->fard[h] - SAME) |
		      ((along <= p->fard[h] + SAME) & (claim < p->claim[h]));
		if (l->trim != TRIM_NONE && any_half(ok))
			ok = finish_trim(p, l, ok, a, b);
		out[h] = ok;
		if (!p->call.nearest || !any_half(ok))
			continue;
		finish_keep(p, h, ok, claim, along, a, b, &x);
	}
	if (p->call.nearest)
		p->far = to_float(p->fard) + 2 * RAY_NOISE;
	return to_mask(out);
}

#endif
