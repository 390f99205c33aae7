/* project.c - curves in space brought down to a surface's u,v plane. */
#include "project_curve.h"

#include <stdlib.h>

#include "hermite.h"
#include "nearest.h"
#include "refine.h"

enum { SPANS_LEAST = 8 /* of a curve that is followed */ };

static const double closed_within = 1e-9; /* of the size */
static const double aside = 1e-3;         /* of a span: where a direction at a pole is looked up */

static enum status project_flat(const struct projector *p, const struct curve *c, struct curve *out,
                                double *distance)
{
	enum status st = curve_copy(out, c);
	if (st != ST_OK)
		return st;
	curve_transform(out, p->down);
	for (int i = 0; i < out->n; i++) {
		double *q = out->points + 4 * (size_t)i;
		*distance = fmax(*distance, fabs(q[2] / q[3]));
		q[2] = 0;
	}
	return ST_OK;
}

static void follow(void *data, double a, double b, struct vec3 guess, struct hermite_node *n)
{
	struct projector *p = data;
	struct vec3 x[2];
	double inner = aside * (b - a), t = n->t;
	n->point = guess;
	if (p->farthest > p->reach)
		return;
	p->farthest =
	        fmax(p->farthest, projector_nearest(p, curve_point(p->c, t), guess, &n->point));
	int lost = projector_free_parameter(p, n->point);
	if (lost >= 0) {
		struct vec3 beside;
		t += t - a < b - t ? inner : -inner;
		curve_derivatives(p->c, t, 1, x);
		projector_nearest(p, x[0], guess, &beside);
		n->in = n->out = projector_bring_down(p, beside, x[0], x[1]);
		if (lost == 0)
			n->point.x = beside.x + (n->t - t) * n->in.x;
		else
			n->point.y = beside.y + (n->t - t) * n->in.y;
		return;
	}
	/* at a break the side matters: a hair inside there */
	double in = n->t >= b ? b - 1e-9 * (b - a) : n->t, out = n->t <= a ? a : n->t;
	curve_derivatives(p->c, in, 1, x);
	n->in = projector_bring_down(p, n->point, x[0], x[1]);
	curve_derivatives(p->c, out, 1, x);
	n->out = projector_bring_down(p, n->point, x[0], x[1]);
}

static double off_surface(void *data, const struct hermite_node *n, struct vec3 candidate)
{
	struct projector *p = data;
	return vec3_length(vec3_sub(projector_point(p, n->point), projector_point(p, candidate)));
}

/* A border is taken where that moves the point by no more than the tolerance. */
static void snap(const struct projector *p, struct vec3 *uv, double tolerance)
{
	struct vec3 at = projector_point(p, *uv);
	for (int d = 0; d < 2; d++) {
		const double *domain = p->s->domain[d];
		double *w = d ? &uv->y : &uv->x, was = *w, width = domain[1] - domain[0];
		double border = domain[0] + width * round((was - domain[0]) / width);
		*w = border;
		if (!(vec3_length(vec3_sub(at, projector_point(p, *uv))) <= tolerance) ||
		    fabs(border - was) > 0.01 * width)
			*w = was;
	}
}

/* Does the line from a to b run along the curve within the tolerance? */
static bool along(const struct projector *p, const struct curve *c, struct vec3 a, struct vec3 b,
                  double tolerance)
{
	enum { SAMPLES = 4 };
	struct vec3 d = vec3_sub(b, a);
	const double *u = p->s->domain[0], *v = p->s->domain[1];
	double su = 1 / (u[1] - u[0]), sv = 1 / (v[1] - v[0]), last = 0;
	double l = d.x * d.x * su * su + d.y * d.y * sv * sv;
	if (!(l > 1e-20))
		return false;
	for (int i = 0; i + 1 < c->n; i += 3)
		for (int k = 1; k <= SAMPLES; k++) {
			double from = c->knots[i + 3], to = c->knots[i + 4];
			struct vec3 q = curve_point(c, from + (to - from) * k / SAMPLES);
			double s = ((q.x - a.x) * d.x * su * su + (q.y - a.y) * d.y * sv * sv) / l;
			if (s < last - 1e-6 || s > 1 + 1e-6)
				return false;
			last = s;
			struct vec3 r = vec3_sub(projector_point(p, q),
			                         projector_point(p, vec3_along(a, s, d)));
			if (!(vec3_length(r) <= tolerance))
				return false;
		}
	return true;
}

/* Replace c by a line if it is one, one of equal u or v if it is that. */
static enum status recognise_line(const struct projector *p, double tolerance, struct curve *c)
{
	struct vec3 a = curve_get_point(c, 0, NULL), b = curve_get_point(c, c->n - 1, NULL);
	const struct vec3 straight[2] = { a, b };
	snap(p, &a, tolerance);
	snap(p, &b, tolerance);
	const struct vec3 tries[][2] = {
		{ a, vec3(a.x, b.y, 0) },
		{ vec3(b.x, a.y, 0), b },
		{ a, vec3(b.x, a.y, 0) },
		{ vec3(a.x, b.y, 0), b },
		{ a, b },
		{ straight[0], straight[1] },
	};
	for (size_t i = 0; i < sizeof tries / sizeof tries[0]; i++)
		if (along(p, c, tries[i][0], tries[i][1], tolerance)) {
			double from = c->domain[0], to = c->domain[1];
			curve_finish(c);
			enum status st = curve_init(c, 2, 2);
			if (st != ST_OK)
				return st;
			c->knots[0] = c->knots[1] = c->domain[0] = from;
			c->knots[2] = c->knots[3] = c->domain[1] = to;
			curve_set_point(c, 0, tries[i][0], 1);
			curve_set_point(c, 1, tries[i][1], 1);
			return ST_OK;
		}
	return ST_OK;
}

/* Largest distance between points of equal parameter of c and what was made of it. */
static double measure(const struct projector *p, const struct curve *c, const struct curve *uv)
{
	enum { SAMPLES = 4 };
	double worst = 0;
	for (int i = 0; i + 1 < uv->n; i += 3)
		for (int k = 0; k <= SAMPLES; k++) {
			double t = uv->knots[i + 3] +
			           (uv->knots[i + 4] - uv->knots[i + 3]) * k / SAMPLES;
			struct vec3 q = projector_point(p, curve_point(uv, t));
			worst = fmax(worst, vec3_length(vec3_sub(q, curve_point(c, t))));
		}
	return worst;
}

enum status projector_curve(struct projector *p, const struct curve *c, double tolerance,
                            double reach, struct curve *out, double *distance)
{
	double *breaks, worst;
	int n;
	struct vec3 first = { 0 };
	*distance = 0;
	if (p->flat)
		return project_flat(p, c, out, distance);
	enum status st = hermite_breaks(c, SPANS_LEAST, &breaks, &n);
	if (st != ST_OK)
		return st;
	const struct hermite h = { follow, off_surface, p, tolerance };
	p->c = c;
	p->reach = reach;
	p->farthest = projector_search(p, curve_point(c, c->domain[0]), tolerance, &first);
	p->near = fmax(tolerance, 2 * p->farthest);
	st = p->failed ? ST_RESOURCE : hermite_fit(&h, breaks, n, first, out, &worst);
	free(breaks);
	p->c = NULL;
	if (st == ST_OK && p->failed) {
		curve_finish(out);
		st = ST_RESOURCE;
	}
	if (st != ST_OK)
		return st;
	*distance = p->farthest > reach ? p->farthest : measure(p, c, out);
	if (*distance > reach)
		return ST_OK;
	return recognise_line(p, tolerance, out);
}

double projector_period(const struct projector *p, int d)
{
	return p->period[d];
}

enum status projector_create(struct projector **out, const struct surface *s)
{
	struct projector *p = calloc(1, sizeof *p);
	if (!p)
		return ST_RESOURCE;
	p->s = s;
	p->size = surface_size(s);
	projector_find_flat(p);
	for (int d = 0; d < 2; d++)
		if (!p->flat && surface_closed(s, d, closed_within * p->size))
			p->period[d] = s->domain[d][1] - s->domain[d][0];
	*out = p;
	return ST_OK;
}

void projector_destroy(struct projector *p)
{
	if (!p)
		return;
	free(p->at[0]);
	free(p->at[1]);
	free(p->points);
	free(p);
}
