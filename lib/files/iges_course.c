/* iges_course.c - how a parameter of the file runs over ours: angles, composites, arc lengths. */
#include "iges_course.h"

#include <stdlib.h>

#include "refine.h"

enum {
	LOOKS_A_STRETCH = 8, /* where courses are compared */
	CELLS_A_SPAN = 4,    /* of a curve, whose lengths are kept */
	STEPS_MAX = 60,      /* to find a length */
};

static const double same_within = 1e-9;    /* of the whole: courses that are the same */
static const double length_within = 1e-12; /* of the whole: a length that is met */

void iges_course_finish(struct iges_course *c)
{
	free(c->stretches);
	free(c->at);
	free(c->length);
	curve_finish(&c->even);
	*c = (struct iges_course){ 0 };
}

/* ---- stretches */

/* `length` of the file's parameters behind what there is, for own from a to b. */
static enum status add_stretch(struct iges_course *c, double from, double length, double a,
                               double b, double half)
{
	if (c->n == c->room) {
		int room = c->room ? 2 * c->room : 4;
		void *p = reallocarray(c->stretches, (size_t)room, sizeof *c->stretches);
		if (!p)
			return ST_RESOURCE;
		c->stretches = p;
		c->room = room;
	}
	c->stretches[c->n++] = (struct iges_stretch){ { from, from + length }, { a, b }, half };
	return ST_OK;
}

enum status iges_course_angle(const double *knots, int n, struct iges_course *out)
{
	enum status st = ST_OK;
	for (int i = 2; i < n && st == ST_OK; i++) {
		double width = knots[i + 1] - knots[i];
		if (width > 0)
			st = add_stretch(out, knots[i], width, knots[i], knots[i + 1], width / 2);
	}
	return st;
}

static double stretch_own(const struct iges_stretch *s, double t, double *rate)
{
	double width = s->own[1] - s->own[0], whole = s->file[1] - s->file[0];
	double f = (t - s->file[0]) / whole, slope = 1;
	if (s->half > 0) {
		/* the middle's angle is 0: tan(angle / 2) runs evenly with the parameter */
		double angle = (2 * f - 1) * s->half, end = tan(s->half / 2), c = cos(angle / 2);
		f = 0.5 * (1 + tan(angle / 2) / end);
		slope = 0.5 * s->half / (c * c * end);
	}
	*rate = slope * width / whole;
	return s->own[0] + f * width;
}

void iges_course_unit(struct iges_course *c, bool turned)
{
	if (c->n == 0)
		return;
	const struct iges_stretch *a = &c->stretches[0], *b = &c->stretches[c->n - 1];
	const double file = a->file[0], own = a->own[0];
	const double by_file = 1 / (b->file[1] - file), by_own = 1 / (b->own[1] - own);
	for (int i = 0; i < c->n; i++)
		for (int k = 0; k < 2; k++) {
			struct iges_stretch *s = &c->stretches[i];
			s->file[k] = (s->file[k] - file) * by_file;
			s->own[k] = (s->own[k] - own) * by_own;
		}
	for (int i = 0, j = c->n - 1; turned && i <= j; i++, j--) {
		struct iges_stretch x = c->stretches[i], y = c->stretches[j];
		c->stretches[i] = (struct iges_stretch){ { 1 - y.file[1], 1 - y.file[0] },
			                                 { 1 - y.own[1], 1 - y.own[0] },
			                                 y.half };
		c->stretches[j] = (struct iges_stretch){ { 1 - x.file[1], 1 - x.file[0] },
			                                 { 1 - x.own[1], 1 - x.own[0] },
			                                 x.half };
	}
}

/* ---- curves of the file */

static enum status course_of(struct iges *g, int de, int depth, struct iges_course *out);

/* Parts keep the lengths of their parameters, one after the other from 0. */
static enum status append(struct iges_course *out, const struct iges_course *part)
{
	enum status st = ST_OK;
	double file = out->n ? out->stretches[out->n - 1].file[1] : 0;
	double own = out->n ? out->stretches[out->n - 1].own[1] : 0;
	for (int i = 0; i < part->n && st == ST_OK; i++) {
		const struct iges_stretch *s = &part->stretches[i], *first = &part->stretches[0];
		double from = s->file[0] - first->file[0] + file;
		st = add_stretch(out, from, s->file[1] - s->file[0],
		                 s->own[0] - first->own[0] + own, s->own[1] - first->own[0] + own,
		                 s->half);
	}
	return st;
}

static enum status composite(struct iges *g, int de, int depth, struct iges_course *out)
{
	struct iges_cursor c;
	enum status st = iges_open(g, de, 102, &c);
	int n = st == ST_OK ? iges_count(&c, "number of parts", 1, g->n_entries) : 0;
	if (st == ST_OK)
		st = c.st;
	for (int i = 0; i < n && st == ST_OK; i++) {
		int part;
		struct iges_course one = { 0 };
		const bool curve = iges_part(&c, &part);
		st = curve ? course_of(g, part, depth + 1, &one) : c.st;
		if (st == ST_OK && curve)
			st = append(out, &one);
		iges_course_finish(&one);
	}
	return st;
}

static enum status course_of(struct iges *g, int de, int depth, struct iges_course *out)
{
	struct curve c;
	const struct iges_entry *e = iges_entry(g, de);
	if (depth > NESTING_MAX)
		return iges_refuse(g, "curves that are made of each other in a circle");
	if (e && e->type == 102)
		return composite(g, de, depth, out);
	enum status st = iges_curve(g, de, depth, &c, NULL);
	if (st != ST_OK)
		return st;
	/* of conics, ellipses and hyperbolas run by an angle, parabolas evenly */
	if (e->type == 100 || (e->type == 104 && c.rational))
		st = iges_course_angle(c.knots, c.n, out);
	else
		st = add_stretch(out, c.domain[0], c.domain[1] - c.domain[0], c.domain[0],
		                 c.domain[1], 0);
	curve_finish(&c);
	return st;
}

enum status iges_course_curve(struct iges *g, int de, struct iges_course *out)
{
	*out = (struct iges_course){ 0 };
	enum status st = course_of(g, de, 0, out);
	if (st == ST_OK && out->n == 0)
		st = iges_refuse(g, "a curve without parts");
	if (st != ST_OK)
		iges_course_finish(out);
	return st;
}

/* ---- arc length */

enum status iges_course_even(const struct curve *c, struct iges_course *out)
{
	*out = (struct iges_course){ 0 };
	enum status st = curve_copy(&out->even, c);
	double *breaks = calloc((size_t)c->n + 2, sizeof *breaks);
	if (st == ST_OK && breaks) {
		int spans =
		        knots_breaks(c->order, c->n, c->knots, c->domain[0], c->domain[1], breaks) -
		        1;
		int each = c->order > 2 ? CELLS_A_SPAN : 1;
		out->n_at = spans * each + 1;
		out->at = calloc((size_t)out->n_at, sizeof *out->at);
		out->length = calloc((size_t)out->n_at, sizeof *out->length);
		for (int i = 0; out->at && i < out->n_at; i++) {
			int k = i / each < spans ? i / each : spans - 1;
			out->at[i] =
			        breaks[k] + (breaks[k + 1] - breaks[k]) * (i - k * each) / each;
		}
	}
	free(breaks);
	if (!out->at || !out->length) {
		iges_course_finish(out);
		return ST_RESOURCE;
	}
	for (int i = 1; i < out->n_at; i++)
		out->length[i] = out->length[i - 1] +
		                 curve_length(c, out->at[i - 1], out->at[i], length_within);
	double whole = out->length[out->n_at - 1];
	if (whole > 0 && isfinite(whole))
		return ST_OK;
	iges_course_finish(out);
	return ST_INPUT;
}

/* Index of the last of n rising values that is not above x, at most n - 2. */
static int cell_of(const double *values, int n, double x)
{
	int lo = 0, hi = n - 1;
	while (hi - lo > 1) {
		int mid = (lo + hi) / 2;
		*(values[mid] <= x ? &lo : &hi) = mid;
	}
	return lo;
}

/* The parameter at a share of the length: the cell by halving, in it Newton's method, halved where
 * that leads out. */
static double even_own(const struct iges_course *c, double share, double *rate)
{
	double whole = c->length[c->n_at - 1], aim = share * whole;
	int lo = cell_of(c->length, c->n_at, aim);
	double a = c->at[lo], b = c->at[lo + 1], cell = c->length[lo + 1] - c->length[lo];
	double t = cell > 0 ? a + (b - a) * (aim - c->length[lo]) / cell : a, speed = 0;
	/* lengths within the cell need no more digits of their own than the whole has */
	double accuracy = cell > 0 ? fmin(length_within * whole / cell, 1e-6) : length_within;
	for (int i = 0; i < STEPS_MAX; i++) {
		struct vec3 x[2];
		curve_derivatives(&c->even, t, 1, x);
		speed = vec3_length(x[1]);
		double off = c->length[lo] + curve_length(&c->even, c->at[lo], t, accuracy) - aim;
		if (fabs(off) <= length_within * whole)
			break;
		*(off < 0 ? &a : &b) = t;
		double next = t - off / speed;
		t = next > a && next < b ? next : 0.5 * (a + b);
	}
	*rate = speed > 0 ? whole / speed : 0;
	return t;
}

/* ---- all courses */

double iges_course_own(const struct iges_course *c, double t, double *rate)
{
	*rate = 1;
	if (c->even.order > 0)
		return even_own(c, fmin(fmax(t, 0), 1), rate);
	if (c->n == 0)
		return t;
	const struct iges_stretch *first = &c->stretches[0], *last = &c->stretches[c->n - 1];
	double turns = floor((t - first->file[0]) / (last->file[1] - first->file[0]));
	t -= turns * (last->file[1] - first->file[0]);
	int lo = 0, hi = c->n;
	while (hi - lo > 1) {
		int mid = (lo + hi) / 2;
		*(c->stretches[mid].file[0] <= t ? &lo : &hi) = mid;
	}
	return stretch_own(&c->stretches[lo], t, rate) + turns * (last->own[1] - first->own[0]);
}

double iges_course_file(const struct iges_course *c, double own)
{
	if (c->even.order > 0) {
		int i = cell_of(c->at, c->n_at, own);
		return (c->length[i] + curve_length(&c->even, c->at[i], own, length_within)) /
		       c->length[c->n_at - 1];
	}
	int lo = 0, hi = c->n;
	if (c->n == 0)
		return own;
	while (hi - lo > 1) {
		int mid = (lo + hi) / 2;
		*(c->stretches[mid].own[0] <= own ? &lo : &hi) = mid;
	}
	const struct iges_stretch *s = &c->stretches[lo];
	double f = (own - s->own[0]) / (s->own[1] - s->own[0]);
	if (s->half > 0)
		f = 0.5 * (1 + 2 * atan((2 * f - 1) * tan(s->half / 2)) / s->half);
	return s->file[0] + f * (s->file[1] - s->file[0]);
}

static void ends(const struct iges_course *c, double out[2])
{
	out[0] = c->n ? c->stretches[0].file[0] : 0;
	out[1] = c->n ? c->stretches[c->n - 1].file[1] : 1;
}

/* Of a, within what the whole of it may be off. */
static bool same_at(const struct iges_course *a, const struct iges_course *b, double t,
                    double whole)
{
	double rate;
	return fabs(iges_course_own(a, t, &rate) - iges_course_own(b, t, &rate)) <=
	       same_within * whole;
}

/* Where the stretches of `a`, or cells of its arc length, begin and in between. */
static bool same_along(const struct iges_course *a, const struct iges_course *b)
{
	double range[2], rate;
	ends(a, range);
	double whole =
	        fabs(iges_course_own(a, range[1], &rate) - iges_course_own(a, range[0], &rate));
	int n = a->even.order > 0 ? a->n_at - 1 : a->n;
	for (int i = 0; i < n; i++) {
		double from = range[0], to = range[1];
		if (a->even.order > 0) {
			from = a->length[i] / a->length[n];
			to = a->length[i + 1] / a->length[n];
		} else {
			from = a->stretches[i].file[0];
			to = a->stretches[i].file[1];
		}
		for (int k = 0; k < LOOKS_A_STRETCH; k++)
			if (!same_at(a, b, from + (to - from) * (k + 0.5) / LOOKS_A_STRETCH, whole))
				return false;
	}
	return true;
}

bool iges_course_same(const struct iges_course *a, const struct iges_course *b)
{
	return same_along(a, b) && same_along(b, a);
}

bool iges_course_equal(const struct iges_course *c)
{
	const struct iges_course equal = { 0 };
	return same_along(c, &equal);
}
