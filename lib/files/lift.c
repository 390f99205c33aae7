/* lift.c - curves in a surface's u,v plane lifted into space. */
#include "project_curve.h"

#include <stdlib.h>

#include "hermite.h"
#include "nearest.h"
#include "on_surface.h"
#include "refine.h"

enum { SPANS_LEAST = 8 /* of a curve that is lifted */ };

struct lift {
	struct on_surface c;
};

static void lift_at(void *data, double a, double b, struct vec3 guess, struct hermite_node *n)
{
	const struct lift *l = data;
	struct vec3 x[2];
	(void)guess;
	double in = n->t >= b ? b - 1e-9 * (b - a) : n->t;
	on_surface_derivatives(&l->c, in, 1, x);
	n->in = x[1];
	on_surface_derivatives(&l->c, n->t, 1, x);
	n->out = x[1];
	n->point = x[0];
}

static double lift_off(void *data, const struct hermite_node *n, struct vec3 candidate)
{
	(void)data;
	return vec3_length(vec3_sub(n->point, candidate));
}

/* A line of one parameter, as the surface has it. False where uv is something else. */
static bool lift_line(const struct surface *s, const struct curve *uv, struct curve *out,
                      enum status *st)
{
	if (uv->order != 2 || uv->n != 2)
		return false;
	struct vec3 a = curve_point(uv, uv->domain[0]), b = curve_point(uv, uv->domain[1]);
	int d = a.x == b.x ? 0 : 1;
	double at = d ? a.y : a.x, from = d ? a.x : a.y, to = d ? b.x : b.y;
	const double *domain = s->domain[!d];
	if ((d && a.y != b.y) || from == to || fmin(from, to) < domain[0] ||
	    fmax(from, to) > domain[1] || at < s->domain[d][0] || at > s->domain[d][1])
		return false;
	struct curve whole;
	*st = surface_isoparametric(&whole, s, d, at);
	if (*st == ST_OK) {
		*st = curve_part(out, &whole, fmin(from, to), fmax(from, to));
		curve_finish(&whole);
	}
	if (*st == ST_OK) {
		if (from > to)
			curve_reverse(out);
		curve_reparametrise(out, uv->domain[0], uv->domain[1]);
	}
	return true;
}

enum status project_lift(const struct surface *s, const struct curve *uv, double tolerance,
                         struct curve *out)
{
	struct projector p = { .s = s, .size = surface_size(s) };
	enum status st;
	double *breaks, worst;
	int n;
	projector_find_flat(&p);
	if (p.flat) {
		st = curve_copy(out, uv);
		if (st == ST_OK)
			curve_transform(out, p.up);
		return st;
	}
	if (lift_line(s, uv, out, &st))
		return st;
	st = hermite_breaks(uv, SPANS_LEAST, &breaks, &n);
	if (st != ST_OK)
		return st;
	struct lift l = { { uv, s } };
	const struct hermite h = { lift_at, lift_off, &l, tolerance };
	st = hermite_fit(&h, breaks, n, vec3(0, 0, 0), out, &worst);
	free(breaks);
	return st;
}
