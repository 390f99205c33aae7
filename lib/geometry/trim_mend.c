/* trim_mend.c - loops as files give them, made closed chains inside the domain. */
#include <stdlib.h>
#include <string.h>

#include "box.h"
#include "refine.h"
#include "trim_mender.h"

/* A loop may leave the domain by this part of it, and is cut there; one that goes farther belongs
 * to something else. */
static const double beyond = 0.01;

static void mender_init(struct mender *m)
{
	enum { SAMPLES = 8 };
	const struct surface *s = m->s;
	for (int i = 0; i <= SAMPLES; i++)
		for (int j = 0; j <= SAMPLES; j++) {
			struct vec3 p, d[2];
			double u = (double)i / SAMPLES, v = (double)j / SAMPLES;
			surface_tangents(s, (1 - u) * s->domain[0][0] + u * s->domain[0][1],
			                 (1 - v) * s->domain[1][0] + v * s->domain[1][1], &p, &d[0],
			                 &d[1]);
			for (int k = 0; k < 2; k++)
				m->speed[k] = fmax(m->speed[k], vec3_length(d[k]));
		}
	for (int k = 0; k < 2; k++) {
		m->length[k] = s->domain[k][1] - s->domain[k][0];
		double near = m->speed[k] > 0 ? m->tolerance / m->speed[k] : INFINITY;
		m->near[k] = fmin(fmax(near, 1e-11 * m->length[k]), 1e-2 * m->length[k]);
		m->closed[k] = surface_closed(s, k, m->tolerance);
	}
}

/* A curve that runs along a border, but for less than the tolerance, comes to lie on it; an end so
 * near, too. */
static void snap(const struct mender *m, struct curve *c)
{
	for (int d = 0; d < 2; d++)
		for (int end = 0; end < 2; end++) {
			const double at = m->s->domain[d][end];
			bool along = true;
			for (int i = 0; i < c->n; i++) {
				const double *p = c->points + 4 * (size_t)i;
				along &= fabs(p[d] / p[3] - at) <= m->near[d];
			}
			for (int i = 0; i < c->n; i++) {
				double *p = c->points + 4 * (size_t)i;
				bool tip = i == 0 || i == c->n - 1;
				if (along || (tip && fabs(p[d] / p[3] - at) <= m->near[d]))
					p[d] = at * p[3];
			}
		}
}

/* By how much it leaves the domain in each direction, in domains; 0 where it is within tolerance. */
static enum status leaves(const struct mender *m, const struct trim_loop *l, double over[2])
{
	over[0] = over[1] = 0;
	for (int i = 0; i < l->n; i++) {
		struct box b;
		enum status st = curve_box(&l->curves[i], 1e-3 * fmin(m->near[0], m->near[1]), &b);
		if (st != ST_OK)
			return st;
		const double lo[2] = { b.lo.x, b.lo.y }, hi[2] = { b.hi.x, b.hi.y };
		for (int d = 0; d < 2; d++) {
			const double *range = m->s->domain[d];
			double by = fmax(range[0] - lo[d], hi[d] - range[1]);
			if (by > 1.01 * m->near[d])
				over[d] = fmax(over[d], by / m->length[d]);
		}
	}
	return ST_OK;
}

/* Cut at the seam, or where it leaves the domain, in one direction, then, each part, in the other. */
static enum status put_in_domain(struct mender *m, struct trim_loop *l, struct trim *out)
{
	struct trim parts = { 0 };
	double over[2];
	enum status st = leaves(m, l, over);
	for (int d = 0; d < 2 && st == ST_OK; d++) {
		if (over[d] == 0)
			continue;
		if (!m->closed[d] && over[d] > beyond)
			return trim_fail(m, "leaves the domain of its surface; expected it inside");
		st = trim_seam_cut(m, l, d, &parts);
		for (int i = 0; i < parts.n && st == ST_OK; i++)
			st = put_in_domain(m, &parts.loops[i], out);
		trim_finish(&parts);
		trim_loop_finish(l);
		return st;
	}
	if (st == ST_OK)
		st = trim_add(out, l);
	return st;
}

/* A loop round a surface closed in d: what is on its right side is left out. `lower`, `upper`: it
 * is the lower or the upper of two, whatever its direction. */
static enum status put_round(struct mender *m, struct trim_loop *l, int d, int way, int side,
                             struct trim *out)
{
	struct trim_loop round = { .outer = false };
	double from[2], to[2];
	const int e = 1 - d;
	if (m->closed[e])
		return trim_fail(
		        m, "winds around a surface that is closed in both directions; expected "
		           "it to come back");
	enum status st = trim_seam_open(m, l, d, way, &round);
	if (st != ST_OK)
		goto out;
	int end = side ? side > 0 : (way > 0) == (d == 1);
	trim_curve_end(&round.curves[0], 0, from);
	trim_curve_end(&round.curves[round.n - 1], 1, to);
	double corner[2], other[2];
	corner[d] = to[d];
	other[d] = from[d];
	corner[e] = other[e] = m->s->domain[e][end];
	st = trim_add_line(&round, to, corner);
	if (st == ST_OK)
		st = trim_add_line(&round, corner, other);
	if (st == ST_OK)
		st = trim_add_line(&round, other, from);
	if (st == ST_OK)
		st = trim_add(out, &round);
out:
	trim_loop_finish(&round);
	return st;
}

/* One loop in order, closed; still in periods as it comes. */
static enum status mend_loop(struct mender *m, const struct trim_loop *l, struct trim_loop *out,
                             double winds[2])
{
	struct trim_loop parts = { 0 };
	bool whole = false;
	enum status st = l->n > 0 ? ST_OK : trim_fail(m, "has no curves");
	for (int i = 0; i < l->n && st == ST_OK; i++) {
		struct curve one;
		st = curve_part(&one, &l->curves[i], l->curves[i].domain[0],
		                l->curves[i].domain[1]);
		if (st != ST_OK)
			break;
		snap(m, &one);
		st = trim_loop_add(&parts, &one);
	}
	for (int turn = 0; turn < 2 && st == ST_OK && !whole; turn++) {
		trim_loop_finish(out);
		out->outer = l->outer;
		st = trim_chain(m, parts.curves, parts.n, turn, out, &whole);
	}
	if (st == ST_OK && !whole)
		st = trim_fail(m, "has a gap; expected each curve to start where one ends");
	if (st == ST_OK)
		st = trim_close_gaps(m, out, winds);
	trim_loop_finish(&parts);
	return st;
}

/* Twice the area within, counter-clockwise positive, by chords. */
static double turning(const struct trim_loop *l)
{
	enum { CHORDS = 16 };
	double sum = 0, first[2], last[2];
	trim_curve_end(&l->curves[0], 0, first);
	memcpy(last, first, sizeof last);
	for (int i = 0; i < l->n; i++) {
		const struct curve *c = &l->curves[i];
		const int n = CHORDS * c->n;
		for (int k = 1; k <= n; k++) {
			double t = (double)k / n;
			struct vec3 p = curve_point(c, (1 - t) * c->domain[0] + t * c->domain[1]);
			sum += (last[0] - first[0]) * (p.y - first[1]) -
			       (p.x - first[0]) * (last[1] - first[1]);
			last[0] = p.x;
			last[1] = p.y;
		}
	}
	return sum;
}

/* Outer loops counter-clockwise, inner ones clockwise; ends that meet are the same to the bit. */
static void settle(const struct mender *m, struct trim_loop *l)
{
	for (int i = 0; i < l->n; i++)
		snap(m, &l->curves[i]);
	if ((turning(l) > 0) != l->outer) {
		for (int i = 0; i < l->n; i++)
			curve_reverse(&l->curves[i]);
		for (int i = 0; i < l->n / 2; i++) {
			struct curve c = l->curves[i];
			l->curves[i] = l->curves[l->n - 1 - i];
			l->curves[l->n - 1 - i] = c;
		}
	}
	for (int i = 0; i < l->n; i++) {
		double end[2];
		trim_curve_end(&l->curves[i], 1, end);
		trim_curve_set_end(&l->curves[(i + 1) % l->n], 0, end);
	}
}

static void say(const struct mender *m)
{
	if (m->gaps)
		report_info(m->r, "%s: %d gaps of its trimming loops closed, the largest %g",
		            m->what, m->gaps, m->largest);
	if (m->turned || m->moved)
		report_info(m->r,
		            "%s: %d curves of its trimming loops turned about, %d put in order",
		            m->what, m->turned, m->moved);
	if (m->cut && m->beyond > 0)
		report_info(m->r,
		            "%s: %d trimming loops cut at the seam or the border, which they leave "
		            "by up to %.3g",
		            m->what, m->cut, m->beyond);
	else if (m->cut)
		report_info(m->r, "%s: %d trimming loops cut at the seam or the border", m->what,
		            m->cut);
	if (m->doubled)
		report_info(m->r, "%s: %d trimming loops left out that are there twice", m->what,
		            m->doubled);
}

/* Loops that wind around, until all are known. */
struct round {
	struct trim_loop loop;
	int d, way, number;
	double level;
};

/* All loops into `out`; those that wind around after the others. */
static enum status mend_loops(struct mender *m, const struct trim *t, struct trim *out,
                              struct round *round)
{
	enum status st = ST_OK;
	int n = 0;
	for (int i = 0; i < t->n && st == ST_OK; i++) {
		struct trim_loop l = { 0 };
		double winds[2] = { 0, 0 };
		m->loop = i + 1;
		st = mend_loop(m, &t->loops[i], &l, winds);
		if (st == ST_OK && winds[0] == 0 && winds[1] == 0)
			st = put_in_domain(m, &l, out);
		else if (st == ST_OK && fabs(winds[0]) + fabs(winds[1]) != 1)
			st = trim_fail(
			        m,
			        "winds around its surface more than once; expected once at most");
		else if (st == ST_OK) {
			int d = winds[0] == 0;
			double from[2];
			trim_curve_end(&l.curves[0], 0, from);
			round[n++] =
			        (struct round){ l, d, winds[d] > 0 ? 1 : -1, i + 1, from[1 - d] };
			l = (struct trim_loop){ 0 };
		}
		trim_loop_finish(&l);
	}
	for (int i = 0; i < n && st == ST_OK; i++) {
		struct round *a = &round[i];
		/* of two, what lies between is left, whatever their directions say */
		int side = n != 2 ? 0 : a->level > round[1 - i].level ? 1 : -1;
		m->loop = a->number;
		st = put_round(m, &a->loop, a->d, a->way, side, out);
	}
	for (int i = 0; i < n; i++)
		trim_loop_finish(&round[i].loop);
	return st;
}

enum status trim_mend(struct trim *t, const struct surface *s, double tolerance, const char *what,
                      const struct report *r)
{
	struct mender m = { .s = s, .tolerance = tolerance, .what = what, .r = r };
	struct trim out = { 0 };
	struct round *round = calloc((size_t)t->n + 1, sizeof *round);
	mender_init(&m);
	enum status st = round ? mend_loops(&m, t, &out, round) : ST_RESOURCE;
	free(round);
	for (int i = 0; i < out.n && st == ST_OK; i++)
		settle(&m, &out.loops[i]);
	if (st == ST_OK)
		st = trim_drop_doubled(&m, &out);
	if (st != ST_OK) {
		if (st == ST_RESOURCE)
			report_error(r, st, "%s: no memory for its trimming loops", what);
		trim_finish(&out);
		return st;
	}
	say(&m);
	trim_finish(t);
	*t = out;
	return ST_OK;
}
