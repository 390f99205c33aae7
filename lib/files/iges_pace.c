/* iges_pace.c - curves made to run at the file's pace; courses of surfaces, and what lies on them in
 * the file's u, v. */
#include "iges_course.h"

#include <stdlib.h>

#include "hermite.h"
#include "refine.h"

enum { SPANS_LEAST = 4 /* of a curve that is made to run otherwise */ };

/* A hair inside the span that ends there: the side matters at breaks. */
static double inside(double t, double a, double b)
{
	return t >= b ? b - 1e-9 * (b - a) : t;
}

/* ---- a curve at the file's pace */

struct paced {
	const struct iges_course *course;
	const struct curve *c;
};

static struct vec3 pace(const struct paced *p, double t, struct vec3 *point)
{
	struct vec3 x[2];
	double rate, own = iges_course_own(p->course, t, &rate);
	curve_derivatives(p->c, fmin(fmax(own, p->c->domain[0]), p->c->domain[1]), 1, x);
	*point = x[0];
	return vec3_scale(x[1], rate);
}

static void paced_at(void *data, double a, double b, struct vec3 guess, struct hermite_node *n)
{
	struct vec3 beside;
	(void)guess;
	n->in = pace(data, inside(n->t, a, b), &beside);
	n->out = pace(data, n->t, &n->point);
}

static double paced_off(void *data, const struct hermite_node *n, struct vec3 candidate)
{
	(void)data;
	return vec3_length(vec3_sub(n->point, candidate));
}

enum status iges_course_apply(const struct iges_course *course, const struct curve *from,
                              double tolerance, struct curve *out, double *error)
{
	struct paced p = { course, from };
	const struct hermite h = { paced_at, paced_off, &p, tolerance };
	double *breaks;
	int all, n = 0;
	enum status st = hermite_breaks(from, SPANS_LEAST, &breaks, &all);
	if (st != ST_OK)
		return st;
	for (int i = 0; i < all; i++) {
		double at = iges_course_file(course, breaks[i]);
		if (n == 0 || at > breaks[n - 1])
			breaks[n++] = at;
	}
	st = hermite_fit(&h, breaks, n, curve_point(from, from->domain[0]), out, error);
	free(breaks);
	return st;
}

/* ---- surfaces */

/* 120: axis, curve, angles. */
static enum status revolution(struct iges_cursor *c, struct iges_course out[2])
{
	struct surface s;
	iges_int(c);
	int profile = iges_int(c);
	enum status st = c->st;
	if (st == ST_OK)
		st = iges_course_curve(c->g, profile, &out[0]);
	if (st == ST_OK)
		st = iges_surface(c->g, c->de, 0, &s, NULL);
	if (st == ST_OK) {
		st = iges_course_angle(s.knots[1], s.n[1], &out[1]);
		surface_finish(&s);
	}
	return st;
}

static enum status cylinder(struct iges_cursor *c, struct iges_course out[2])
{
	int directrix = iges_int(c);
	enum status st = c->st == ST_OK ? iges_course_curve(c->g, directrix, &out[0]) : c->st;
	if (st == ST_OK)
		iges_course_unit(&out[0], false);
	return st;
}

static enum status courses(struct iges *g, int de, int depth, struct iges_course out[2],
                           bool *known)
{
	struct iges_cursor c;
	double skip[4];
	enum status st = iges_open(g, de, 0, &c);
	if (st != ST_OK)
		return st;
	*known = true;
	switch (iges_entry(g, de)->type) {
	case 114:
	case 128:
		return ST_OK;
	case 118:
		return iges_ruled_course(&c, &out[0]);
	case 120:
		return revolution(&c, out);
	case 122:
		return cylinder(&c, out);
	case 140:
		iges_few(&c, skip, 4);
		de = iges_int(&c);
		if (depth > NESTING_MAX)
			return iges_refuse(g, "surfaces that are made of each other in a circle");
		return c.st == ST_OK ? courses(g, de, depth + 1, out, known) : c.st;
	default:
		*known = iges_entry(g, de)->type == 190 && iges_entry(g, de)->form == 1;
		return ST_OK;
	}
}

enum status iges_surface_courses(struct iges *g, int de, struct iges_course out[2], bool *known)
{
	out[0] = out[1] = (struct iges_course){ 0 };
	enum status st = courses(g, de, 0, out, known);
	for (int d = 0; d < 2; d++)
		if (st != ST_OK || iges_course_equal(&out[d]))
			iges_course_finish(&out[d]);
	return st;
}

/* ---- curves in u,v */

struct brought {
	const struct iges_course *course; /* of u and v */
	const struct surface *s;
	const struct curve *c;
};

static double bring_one(const struct brought *b, int d, double t, double *rate)
{
	return iges_course_own(&b->course[d], t, rate);
}

static struct vec3 bring(const struct brought *b, double t, struct vec3 *point)
{
	struct vec3 x[2];
	double ru, rv;
	curve_derivatives(b->c, t, 1, x);
	*point = vec3(bring_one(b, 0, x[0].x, &ru), bring_one(b, 1, x[0].y, &rv), 0);
	return vec3(ru * x[1].x, rv * x[1].y, 0);
}

static void brought_at(void *data, double a, double b, struct vec3 guess, struct hermite_node *n)
{
	struct vec3 beside;
	(void)guess;
	n->in = bring(data, inside(n->t, a, b), &beside);
	n->out = bring(data, n->t, &n->point);
}

/* In space, to first order. */
static double brought_off(void *data, const struct hermite_node *n, struct vec3 candidate)
{
	const struct brought *b = data;
	const double(*d)[2] = b->s->domain;
	struct vec3 q, du, dv;
	surface_tangents(b->s, fmin(fmax(n->point.x, d[0][0]), d[0][1]),
	                 fmin(fmax(n->point.y, d[1][0]), d[1][1]), &q, &du, &dv);
	return vec3_length(
	        vec3_along(vec3_scale(du, candidate.x - n->point.x), candidate.y - n->point.y, dv));
}

/* A line of one parameter stays one, whatever the other's course. */
static bool bring_line(const struct brought *b, struct curve *c)
{
	struct vec3 end[2], rate;
	if (c->order != 2 || c->n != 2)
		return false;
	for (int i = 0; i < 2; i++)
		end[i] = curve_get_point(c, i, NULL);
	if (end[0].x != end[1].x && end[0].y != end[1].y)
		return false;
	for (int i = 0; i < 2; i++)
		curve_set_point(c, i,
		                vec3(bring_one(b, 0, end[i].x, &rate.x),
		                     bring_one(b, 1, end[i].y, &rate.y), 0),
		                1);
	c->rational = false;
	return true;
}

enum status iges_course_bring(const struct iges_course course[2], const struct surface *s,
                              double tolerance, struct curve *c)
{
	struct brought b = { course, s, c };
	const struct hermite h = { brought_at, brought_off, &b, tolerance };
	double *breaks, error;
	int n;
	struct vec3 first;
	struct curve out;
	if (bring_line(&b, c))
		return ST_OK;
	enum status st = hermite_breaks(c, SPANS_LEAST, &breaks, &n);
	if (st != ST_OK)
		return st;
	bring(&b, breaks[0], &first);
	st = hermite_fit(&h, breaks, n, first, &out, &error);
	free(breaks);
	if (st == ST_OK) {
		curve_finish(c);
		*c = out;
	}
	return st;
}
