/* level_arc.c - follow an arc through a certified cell and fit cubics to it, with a check.
 *
 * Between two points of the curve, with its tangents there, one cubic in space and one in u,v are
 * set up. Their tangents have at first the length that suits a circle, then the one with which the
 * middle lies on the curve. Where the bound of level_prove is above the tolerance the arc is halved.
 */
#include "level_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { FIT_DEPTH_MAX = 40, FIT_DEPTH_EASY = 12, CAP_DEPTH = 4, PIECES_MAX = 4000, PARTS_MAX = 8 };

/* A piece so much shorter than the tolerance may be proved by the strip that it is in; one so many times narrower than
 * its strip is not made shorter. */
#define STRIP_SHARE  0.25
#define BAND_LENGTHS 20.0

/* The last step to the curve is below this part of the tolerances. */
#define STEP_SHARE 0.01

/* The error goes with the fifth power of the length; parts are made for one so much larger. */
#define ERROR_ORDER  5
#define ERROR_MARGIN 1.8

/* A box about a piece is worth looking at below this part of the area, and worth its bounds below that part of
 * those before. */
#define NEAR_SHARE 0.25
#define NEAR_GAIN  0.5

/* .. where the piece uses no more of the tolerances. */
#define NEAR_USED 1.0

struct follower {
	struct tracer *t;
	struct strip strip; /* the cell */
	int along;          /* the direction that the arc is a graph over */
	double turn;        /* sign that makes tangents point along the graph's variable */
	size_t first;
	struct prover prover;
	const double *c; /* f in the prover's box, and its error */
	double error;
	double sure; /* a step across that is far below the tolerances */
};

static double dot(const double *a, const double *b)
{
	return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* The curve's tangent fu Sv - fv Su; returns its length (never 0). */
static double tangent_of(const struct field_point *x, double *out)
{
	for (int d = 0; d < 3; d++)
		out[d] = x->fu * x->sv[d] - x->fv * x->su[d];
	return sqrt(dot(out, out)) + 1e-300;
}

static void station_set(const struct follower *w, const struct field_point *x, double u, double v,
                        struct station *out)
{
	double l = w->turn / tangent_of(x, out->dp);
	out->uv[0] = u;
	out->uv[1] = v;
	out->duv[0] = -x->fv * l;
	out->duv[1] = x->fu * l;
	for (int d = 0; d < 3; d++) {
		out->p[d] = x->p[d];
		out->dp[d] *= l;
	}
}

/* The point of the curve at uv[along]; uv[other] is a guess. Newton's method in a bracket. */
static void station_find(const struct follower *w, double uv[2], struct station *out)
{
	int other = 1 - w->along;
	double lo = w->strip.box->lo[other], hi = w->strip.box->hi[other],
	       y = smaller(larger(uv[other], lo), hi);
	struct field_point x;
	double last = INFINITY;
	for (int step = 0; step < 60; step++) {
		uv[other] = y;
		level_field_at(w->t, uv[0], uv[1], &x);
		double move = x.f / (other == 0 ? x.fu : x.fv);
		const bool small = fabs(move) < w->sure && y - move >= lo && y - move <= hi;
		/* so small that it can be made without looking again */
		if (small || fabs(move) < 1e-11 || (fabs(move) < 1e-7 && fabs(move) >= last)) {
			if (small || fabs(move) < 1e-9) {
				uv[other] = y - move;
				for (int d = 0; d < 3; d++)
					x.p[d] -= move * (other == 0 ? x.su[d] : x.sv[d]);
			}
			break;
		}
		last = fabs(move);
		if ((x.f > 0) == w->strip.rising)
			hi = y;
		else
			lo = y;
		y -= move;
		if (!(y >= lo && y <= hi))
			y = 0.5 * (lo + hi);
	}
	station_set(w, &x, uv[0], uv[1], out);
}

/* The piece with tangents of that length. */
static void piece_set(const struct station *a, const struct station *b, double length,
                      struct piece *p)
{
	const struct station *s[2] = { a, b };
	for (int e = 0; e < 2; e++) {
		for (int d = 0; d < 2; d++) {
			p->uv[e][d] = s[e]->uv[d];
			p->duv[e][d] = length * s[e]->duv[d];
		}
		for (int d = 0; d < 3; d++) {
			p->p[e][d] = s[e]->p[d];
			p->dp[e][d] = length * s[e]->dp[d];
		}
	}
}

static void piece_add(const struct follower *w, const struct piece *p)
{
	struct piece *out = list_next(&w->t->pieces, sizeof *out);
	if (out)
		*out = *p;
	else
		w->t->failed = true;
}

/* The point of the curve next to uv. */
static void station_between(const struct follower *w, const struct station *a,
                            const struct station *b, const double uv[2], struct station *out)
{
	double at[2] = { uv[0], uv[1] };
	double from = a->uv[w->along], to = b->uv[w->along];
	double share = (at[w->along] - from) / (to - from);
	if (!(share > 0.02 && share < 0.98))
		at[w->along] = 0.5 * (from + to);
	station_find(w, at, out);
}

/* Shorter pieces keep a tolerance that is so many times what rounding leaves. */
#define ROUNDING_TIMES 8

static bool within(double error, double tolerance, double rounding)
{
	return error <= tolerance ||
	       (ROUNDING_TIMES * rounding > tolerance && error <= tolerance + rounding);
}

/* Good, or as good as rounding allows. */
static bool good(const struct follower *w, const struct proof *p)
{
	const struct level *l = w->t->level;
	return within(p->space, l->tolerance, p->rounding[0]) &&
	       within(p->uv, l->tolerance_uv, p->rounding[1]);
}

static void proof_improve(struct proof *p, const struct proof *by)
{
	p->space = smaller(p->space, by->space);
	p->uv = smaller(p->uv, by->uv);
	for (int k = 0; k < 2; k++)
		p->rounding[k] = by->rounding[k];
}

/* A piece far below the tolerance, whose tangents may be rounding: the bound of a straight one, and
 * how far the cubic can be from that. */
static void tiny_prove(const struct follower *w, const struct station *a, const struct station *b,
                       double size, struct proof *best)
{
	struct proof_middle mid = { .uv = { 0, 0 } };
	struct proof proof;
	double size_uv = 0;
	struct piece x = { .error = 0 };
	for (int d = 0; d < 2; d++) {
		mid.uv[d] = 0.5 * (a->uv[d] + b->uv[d]);
		size_uv = length2(size_uv, w->prover.width[d] * (b->uv[d] - a->uv[d]));
		for (int e = 0; e < 2; e++) {
			x.uv[e][d] = e ? b->uv[d] : a->uv[d];
			x.duv[e][d] = b->uv[d] - a->uv[d];
		}
	}
	for (int d = 0; d < 3; d++)
		for (int e = 0; e < 2; e++) {
			x.p[e][d] = e ? b->p[d] : a->p[d];
			x.dp[e][d] = b->p[d] - a->p[d];
		}
	level_fit_middle(w->t, &mid);
	if (!level_prove(&w->prover, &x, &mid, &proof))
		return;
	proof.space += 3 * size;
	proof.uv += 3 * size_uv;
	proof_improve(best, &proof);
}

/*
 * Between its ends the curve is a graph over one direction, in the other between `lo` and `hi`; the cubics are
 * in their control points' hull, which is near the first end.
 */
static struct proof box_proof(const struct follower *w, int along, const struct station *a,
                              const struct station *b, double size, double length, double lo,
                              double hi)
{
	const struct prover *p = &w->prover;
	const int other = 1 - along;
	const double reach = 1.15 * length / 3; /* lengths are corrected by no more */
	double space = size + reach, extent[2];
	extent[along] = fabs(a->uv[along] - b->uv[along]);
	extent[other] = larger(hi - smaller(a->uv[other], b->uv[other]),
	                       larger(a->uv[other], b->uv[other]) - lo);
	for (int d = 0; d < 2; d++) {
		space += p->shape->first[d] * extent[d];
		extent[d] += fabs(a->uv[d] - b->uv[d]) +
		             reach * larger(fabs(a->duv[d]), fabs(b->duv[d]));
	}
	return (struct proof){
		.space = smaller(2 * p->diameter, space),
		.uv = smaller(2 * p->diameter_uv,
		              length2(p->width[0] * extent[0], p->width[1] * extent[1])),
	};
}

/* Without a look at f: in a patch that is a sliver that is enough. */
static struct proof rough_proof(const struct follower *w, const struct station *a,
                                const struct station *b, double size, double length)
{
	const int other = 1 - w->along;
	return box_proof(w, w->along, a, b, size, length, w->strip.box->lo[other],
	                 w->strip.box->hi[other]);
}

/* From where f has a sure sign on lines along one direction, on both sides of the piece: between them is the curve. If
 * that is much farther away than the piece is long, and it is no cap of a curve that turns round, it is rounding that
 * keeps it there, and no shorter piece does better. False where one side has no such line, and f need not be
 * monotone across. */
static bool strip_along(const struct follower *w, int along, const struct station *a,
                        const struct station *b, double size, double length, bool cap,
                        struct proof *out)
{
	const int other = 1 - along;
	const struct cell_range whole = { { 0, 0 }, { 1, 1 } };
	struct strip s = w->strip;
	double side[2], extent[2];
	if (along != w->along) {
		/* such lines may be in the next cell; where a side condition holds, only in this one */
		if (w->t->n_side == 0) {
			s.box = &whole;
			s.c = w->t->field;
			s.error = w->t->field_error;
		}
		s.along = along;
		s.rising = w->turn * (along == 1 ? a->duv[1] : -a->duv[0]) > 0;
	}
	if (!level_strip_bound(&s, a->uv, b->uv, side) && along != w->along)
		return false;
	*out = box_proof(w, along, a, b, size, length, side[0], side[1]);
	const double *first = w->prover.shape->first;
	for (int d = 0; d < 2; d++)
		extent[d] = fabs(a->uv[d] - b->uv[d]);
	if (!cap && first[other] * (side[1] - side[0] - extent[other]) >
	                    BAND_LENGTHS * (first[0] * extent[0] + first[1] * extent[1])) {
		out->rounding[0] = out->space;
		out->rounding[1] = out->uv;
	}
	return true;
}

/* Lines along the graph's variable, or across where the curve runs that way. */
static struct proof strip_proof(const struct follower *w, const struct station *a,
                                const struct station *b, double size, double length, bool cap)
{
	struct proof p, across;
	strip_along(w, w->along, a, b, size, length, cap, &p);
	const struct level *l = w->t->level;
	if ((p.space > l->tolerance || p.uv > l->tolerance_uv) &&
	    strip_along(w, 1 - w->along, a, b, size, length, cap, &across) &&
	    across.space < p.space)
		proof_improve(&p, &across);
	return p;
}

static void fit(const struct follower *w, const struct station *a, const struct station *b,
                int depth);

/*
 * Where f bends so much that nothing can be proved from bounds over the whole box, take those of a box about
 * the piece, if that is smaller by much.
 */
static bool fit_nearer(const struct follower *w, const struct station *a, const struct station *b,
                       const struct proof_middle *mid, int depth)
{
	const struct cell_range *box = &w->prover.box;
	struct cell_range near = *box;
	double reach = 0, share = 1;
	for (int d = 0; d < 2; d++)
		reach = larger(reach, fabs(a->uv[d] - b->uv[d]));
	for (int d = 0; d < 2; d++) {
		double lo = smaller(a->uv[d], b->uv[d]), hi = larger(a->uv[d], b->uv[d]);
		/* rounding moves the curve by error times across; so far it must not bend f either */
		double margin = reach + 8 * (w->t->level->degree[0] + w->t->level->degree[1]) *
		                                w->prover.error * fabs(mid->across[d]);
		near.lo[d] = larger(box->lo[d], lo - margin);
		near.hi[d] = smaller(box->hi[d], hi + margin);
		share *= (near.hi[d] - near.lo[d]) / (box->hi[d] - box->lo[d]);
	}
	if (!(share > 0 && share < NEAR_SHARE))
		return false;
	const int m = w->t->level->degree[0], n = w->t->level->degree[1];
	double *c = malloc(sizeof *c * w->t->n_field);
	if (!c) {
		w->t->failed = true;
		return true;
	}
	memcpy(c, w->c, sizeof *c * w->t->n_field);
	struct follower inner = *w;
	inner.error += form_part_error(c, m, n);
	for (int d = 0; d < 2; d++) {
		const double width = box->hi[d] - box->lo[d];
		form_part(c, m, n, d, (near.lo[d] - box->lo[d]) / width,
		          (near.hi[d] - box->lo[d]) / width);
	}
	inner.c = c;
	level_prover_init(&inner.prover, w->t, &near, c, inner.error);
	bool better = false;
	for (int k = 0; k < 3; k++)
		better |= inner.prover.spread[k] < NEAR_GAIN * w->prover.spread[k];
	/* the curve between the stations need not be in the smaller box */
	inner.prover.diameter = w->prover.diameter;
	inner.prover.diameter_uv = w->prover.diameter_uv;
	if (better)
		fit(&inner, a, b, depth);
	free(c);
	return better;
}

/* Places between the ends of a piece that is not good enough, and all parts between them. `middle`: a place next to
 * the curve's middle. */
static void fit_parts(const struct follower *w, const struct station *a, const struct station *b,
                      const struct piece *x, const double middle[2], int parts, int depth)
{
	struct station s[PARTS_MAX + 1];
	s[0] = *a;
	for (int i = 1; i < parts; i++) {
		double uv[2], t = (double)i / parts, r = 1 - t;
		for (int d = 0; d < 2; d++)
			uv[d] = parts == 2 ? middle[d]
			                   : r * r * (1 + 2 * t) * x->uv[0][d] +
			                             t * t * (1 + 2 * r) * x->uv[1][d] +
			                             t * r * (r * x->duv[0][d] - t * x->duv[1][d]);
		station_between(w, &s[i - 1], b, uv, &s[i]);
	}
	s[parts] = *b;
	for (int i = 0; i < parts; i++)
		fit(w, &s[i], &s[i + 1], depth + 1);
}

/* In how many parts to cut a piece that uses so much of the tolerances. */
static int parts_of(double used)
{
	int n = 2;
	while (n < PARTS_MAX && pow(n, ERROR_ORDER) < ERROR_MARGIN * used)
		n++;
	return n;
}

static void fit(const struct follower *w, const struct station *a, const struct station *b,
                int depth)
{
	double tolerance = w->t->level->tolerance, chord[3];
	double uv[2] = { 0.5 * (a->uv[0] + b->uv[0]), 0.5 * (a->uv[1] + b->uv[1]) };
	for (int d = 0; d < 3; d++)
		chord[d] = b->p[d] - a->p[d];
	double size = sqrt(dot(chord, chord)), turn = dot(a->dp, b->dp);
	/* a circle's arc of that chord and turn: chord / cos^2 (angle / 4) */
	double first = size * 2 / (1 + sqrt(larger(0, (1 + turn) / 2)));
	struct proof_middle mid;
	struct proof proof, best = { .space = INFINITY, .uv = INFINITY };
	struct piece x;
	const bool small = smaller(size, 2 * w->prover.diameter) <= tolerance;
	if (small) /* else that is not enough */
		best = rough_proof(w, a, b, size, first);
	double used = 0;
	piece_set(a, b, first, &x);
	if (!good(w, &best) && turn > 0.3 && dot(chord, a->dp) > 0 &&
	    level_fit(w->t, a, b, first, &x, &mid, uv)) {
		bool proved = level_prove(&w->prover, &x, &mid, &proof);
		if (proved)
			proof_improve(&best, &proof);
		else if (proof.bent && proof.used < NEAR_USED && fit_nearer(w, a, b, &mid, depth))
			return;
		used = proof.used;
	}
	bool tiny = size < 1e-4 * tolerance;
	if (tiny && !good(w, &best))
		tiny_prove(w, a, b, size, &best);
	bool enough = tiny || depth >= FIT_DEPTH_MAX ||
	              (depth > FIT_DEPTH_EASY && w->t->pieces.n - w->first > PIECES_MAX);
	if ((enough || size < STRIP_SHARE * tolerance) && !good(w, &best)) {
		proof = strip_proof(w, a, b, size, first, turn < 0 && depth < CAP_DEPTH);
		proof_improve(&best, &proof);
	}
	if (good(w, &best) || enough || tracer_ends(w->t)) {
		x.error = best.space;
		x.error_uv = best.uv;
		piece_add(w, &x);
		return;
	}
	fit_parts(w, a, b, &x, uv, parts_of(used), depth);
}

void level_arc_follow(struct tracer *t, const struct cell_range *box, const double *c, double error,
                      int along, bool rising, const double ends[2][2])
{
	/* (-fv, fu) points towards larger v where fu > 0, towards larger u where fv < 0 */
	double turn = (along == 1) == rising ? 1 : -1;
	struct follower w = { .t = t,
		              .strip = { box, c, t->level->degree, error, along, rising },
		              .along = along,
		              .turn = turn,
		              .first = t->pieces.n };
	struct station s[2];
	for (int e = 0; e < 2; e++) {
		struct field_point x;
		level_field_at(t, ends[e][0], ends[e][1], &x);
		station_set(&w, &x, ends[e][0], ends[e][1], &s[e]);
	}
	w.c = c;
	w.error = error;
	level_prover_init(&w.prover, t, box, c, error);
	const double first[2] = { w.prover.shape->first[1 - along], w.prover.width[1 - along] };
	w.sure = STEP_SHARE *
	         smaller(t->level->tolerance / first[0], t->level->tolerance_uv / first[1]);
	fit(&w, &s[0], &s[1], 0);
	struct arc *arc = list_next(&t->arcs, sizeof *arc);
	if (!arc) {
		t->failed = true;
		return;
	}
	arc->first = (int)w.first;
	arc->n = (int)(t->pieces.n - w.first);
}
