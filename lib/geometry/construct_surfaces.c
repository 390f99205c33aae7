/* construct_surfaces.c - surfaces swept by curves: ruled, cylinders, of revolution. */
#include "construct.h"

#include <stdlib.h>
#include <string.h>

#include "circle.h"
#include "refine.h"
#include "report.h"

/* Knots 0 0 1 1 in direction d. */
static void linear_knots(struct surface *s, int d)
{
	s->knots[d][2] = s->knots[d][3] = 1;
	s->domain[d][0] = 0;
	s->domain[d][1] = 1;
}

/* Direction 0 takes knots and domain of c. */
static void knots_of_curve(struct surface *s, const struct curve *c)
{
	memcpy(s->knots[0], c->knots, ((size_t)c->n + (size_t)c->order) * sizeof *c->knots);
	memcpy(s->domain[0], c->domain, sizeof c->domain);
	s->periodic[0] = c->periodic;
}

static bool same_weights(const struct curve *a, const struct curve *b)
{
	for (int i = 0; i < a->n; i++)
		if (fabs(a->points[4 * i + 3] - b->points[4 * i + 3]) > 1e-15)
			return false;
	return true;
}

/* All interior knots of c to order - 1: Bezier pieces that share their end points. */
static enum status split(struct curve *out, const struct curve *c)
{
	int p = c->order - 1, m = 0;
	double *x = malloc((size_t)c->n * (size_t)c->order * sizeof *x);
	if (!x)
		return ST_RESOURCE;
	for (int i = c->order, run; i < c->n; i += run) {
		for (run = 1; i + run < c->n && c->knots[i + run] == c->knots[i]; run++)
			continue;
		for (int k = run; k < p; k++)
			x[m++] = c->knots[i];
	}
	enum status st = curve_insert(out, c, x, m);
	free(x);
	return st;
}

static double choose(int n, int k)
{
	double x = 1;
	for (int i = 1; i <= k; i++)
		x = x * (n - k + i) / i;
	return round(x);
}

/* Points of the Bezier product of piece a by the weights of piece b, all of degree p. */
static void weigh(double *out, const double *a, const double *b, int p)
{
	for (int i = 0; i <= p; i++) {
		for (int j = 0; j <= p; j++) {
			double f =
			        choose(p, i) * choose(p, j) / choose(2 * p, i + j) * b[4 * j + 3];
			for (int k = 0; k < 4; k++)
				out[4 * (i + j) + k] += f * a[4 * i + k];
		}
	}
}

/* Curve a with numerator and denominator multiplied by the denominator of b (same knots). */
static enum status common_denominator(struct curve *out, const struct curve *a,
                                      const struct curve *b)
{
	int p = a->order - 1;
	struct curve x = { 0 }, y = { 0 };
	enum status st = 2 * p + 1 > ORDER_MAX ? ST_PARAMETER : split(&x, a);
	if (st == ST_OK)
		st = split(&y, b);
	int pieces = st == ST_OK ? (x.n - 1) / p : 0;
	if (st == ST_OK)
		st = curve_init(out, 2 * p + 1, 2 * p * pieces + 1);
	if (st == ST_OK) {
		for (int i = 0; i < pieces; i++) {
			double *at = out->points + 8 * (size_t)p * i;
			memset(at, 0, 4 * sizeof *at); /* the neighbour's last point, once more */
			weigh(at, x.points + 4 * (size_t)p * i, y.points + 4 * (size_t)p * i, p);
		}
		out->knots[0] = x.knots[0];
		for (int i = 0; i <= pieces; i++)
			for (int k = 0; k < 2 * p; k++)
				out->knots[1 + 2 * p * i + k] = x.knots[1 + p * i];
		out->knots[2 * p * (pieces + 1) + 1] = x.knots[x.n + p];
		memcpy(out->domain, x.domain, sizeof x.domain);
		out->rational = true;
	}
	curve_finish(&x);
	curve_finish(&y);
	return st;
}

enum status make_ruled(struct surface *out, const struct curve *a, const struct curve *b)
{
	struct curve side[2];
	enum status st = curves_match(&side[0], &side[1], a, b);
	if (st != ST_OK)
		return st;
	if (!same_weights(&side[0], &side[1])) {
		struct curve x = { 0 }, y = { 0 };
		st = common_denominator(&x, &side[0], &side[1]);
		if (st == ST_OK)
			st = common_denominator(&y, &side[1], &side[0]);
		curve_finish(&side[0]);
		curve_finish(&side[1]);
		side[0] = x;
		side[1] = y;
	}
	if (st == ST_OK)
		st = surface_init(out, (int[2]){ side[0].order, 2 }, (int[2]){ side[0].n, 2 });
	if (st == ST_OK) {
		for (int i = 0; i < side[0].n; i++)
			for (int j = 0; j < 2; j++)
				memcpy(out->points + 4 * (2 * (size_t)i + j),
				       side[j].points + 4 * (size_t)i, 4 * sizeof *out->points);
		knots_of_curve(out, &side[0]);
		out->periodic[0] = a->periodic && b->periodic;
		linear_knots(out, 1);
		out->rational = side[0].rational || side[1].rational;
	}
	curve_finish(&side[0]);
	curve_finish(&side[1]);
	return st;
}

enum status make_cylinder(struct surface *out, const struct curve *c, struct vec3 d)
{
	enum status st = surface_init(out, (int[2]){ c->order, 2 }, (int[2]){ c->n, 2 });
	if (st != ST_OK)
		return st;
	for (int i = 0; i < c->n; i++) {
		const double *q = c->points + 4 * (size_t)i;
		double moved[4] = { q[0] + q[3] * d.x, q[1] + q[3] * d.y, q[2] + q[3] * d.z, q[3] };
		memcpy(out->points + 8 * (size_t)i, q, sizeof moved);
		memcpy(out->points + 8 * (size_t)i + 4, moved, sizeof moved);
	}
	knots_of_curve(out, c);
	linear_knots(out, 1);
	out->rational = c->rational;
	return ST_OK;
}

enum status make_revolution(struct surface *out, const struct curve *c, struct vec3 p,
                            struct vec3 axis, double a, double b)
{
	struct circle arc;
	double l = vec3_length(axis);
	if (!(l > 0) || !isfinite(l) || !circle_init(&arc, a, b))
		return ST_PARAMETER;
	axis = vec3_scale(axis, 1 / l);
	enum status st = surface_init(out, (int[2]){ c->order, 3 }, (int[2]){ c->n, arc.n });
	if (st != ST_OK)
		return st;
	for (int i = 0; i < c->n; i++) {
		const double *q = c->points + 4 * (size_t)i;
		double w = q[3];
		/* all in homogeneous form: foot on the axis, radius and what is square to both */
		struct vec3 from = vec3(q[0] - w * p.x, q[1] - w * p.y, q[2] - w * p.z);
		double along = vec3_dot(from, axis);
		struct vec3 x = vec3_along(from, -along, axis), y = vec3_cross(axis, x);
		struct vec3 foot = vec3(w * p.x + along * axis.x, w * p.y + along * axis.y,
		                        w * p.z + along * axis.z);
		for (int j = 0; j < arc.n; j++) {
			double *h = out->points + 4 * ((size_t)i * arc.n + j);
			h[0] = arc.w[j] * foot.x + arc.x[j] * x.x + arc.y[j] * y.x;
			h[1] = arc.w[j] * foot.y + arc.x[j] * x.y + arc.y[j] * y.y;
			h[2] = arc.w[j] * foot.z + arc.x[j] * x.z + arc.y[j] * y.z;
			h[3] = arc.w[j] * w;
		}
	}
	knots_of_curve(out, c);
	memcpy(out->knots[1], arc.knots, (size_t)(arc.n + 3) * sizeof *arc.knots);
	out->domain[1][0] = a;
	out->domain[1][1] = b;
	out->rational = true;
	return ST_OK;
}

enum status make_bilinear(struct surface *out, const struct vec3 corner[4])
{
	enum status st = surface_init(out, (int[2]){ 2, 2 }, (int[2]){ 2, 2 });
	if (st != ST_OK)
		return st;
	for (int i = 0; i < 2; i++)
		for (int j = 0; j < 2; j++)
			surface_set_point(out, i, j, corner[i + 2 * j], 1);
	linear_knots(out, 0);
	linear_knots(out, 1);
	return ST_OK;
}

/* The profile turned about the z axis through c, u and v exchanged so that u runs about the axis
 * and N points outward. */
static enum status turn(struct surface *out, struct curve *profile, struct vec3 c)
{
	enum status st = make_revolution(out, profile, c, vec3(0, 0, 1), 0, 2 * M_PI);
	if (st == ST_OK)
		st = surface_exchange(out);
	if (st != ST_OK)
		surface_finish(out);
	curve_finish(profile);
	return st;
}

enum status make_sphere(struct surface *out, struct vec3 c, double radius)
{
	struct curve meridian;
	*out = (struct surface){ 0 };
	enum status st =
	        make_arc(&meridian, c, vec3(1, 0, 0), vec3(0, 0, 1), radius, -M_PI / 2, M_PI / 2);
	return st == ST_OK ? turn(out, &meridian, c) : st;
}

enum status make_torus(struct surface *out, struct vec3 c, double major, double minor)
{
	struct curve circle;
	if (!(major > minor))
		return ST_PARAMETER;
	*out = (struct surface){ 0 };
	enum status st = make_arc(&circle, vec3_along(c, major, vec3(1, 0, 0)), vec3(1, 0, 0),
	                          vec3(0, 0, 1), minor, 0, 2 * M_PI);
	return st == ST_OK ? turn(out, &circle, c) : st;
}
