/* construct_conic.c - conic arcs from their implicit equation. */
#include "construct.h"

#include <stdbool.h>
#include <string.h>

#include "circle.h"
#include "report.h"

/* x' C x = 0 for x = (x, y, 1); C symmetric. */
struct conic {
	double m[3][3];
};

static struct vec3 conic_times(const struct conic *c, struct vec3 p)
{
	return vec3(c->m[0][0] * p.x + c->m[0][1] * p.y + c->m[0][2] * p.z,
	            c->m[1][0] * p.x + c->m[1][1] * p.y + c->m[1][2] * p.z,
	            c->m[2][0] * p.x + c->m[2][1] * p.y + c->m[2][2] * p.z);
}

/* Distance of p from the conic to first order. */
static double distance(const struct conic *c, struct vec3 p)
{
	struct vec3 g = conic_times(c, p);
	double f = fabs(vec3_dot(g, p)), slope = 2 * hypot(g.x, g.y);
	return f == 0 ? 0 : f / slope;
}

/* Centre and axes of an ellipse or hyperbola, with the squares of the half axes, which are negative where
 * the conic does not meet the axis; false where the equation has no real points or is of two lines. */
static bool conic_axes(const struct conic *c, struct vec3 *center, struct vec3 axis[2],
                       double square[2])
{
	double a = c->m[0][0], b = c->m[0][1], d = c->m[1][1];
	double det = a * d - b * b;
	struct vec3 at = vec3((b * c->m[1][2] - d * c->m[0][2]) / det,
	                      (b * c->m[0][2] - a * c->m[1][2]) / det, 1);
	double level = -vec3_dot(conic_times(c, at), at); /* q(x - at) = level */
	double angle = b == 0 ? 0 : 0.5 * atan2(2 * b, a - d), co = cos(angle), si = sin(angle);
	square[0] = level / (a * co * co + 2 * b * co * si + d * si * si);
	square[1] = level / (a * si * si - 2 * b * co * si + d * co * co);
	double r0 = sqrt(fabs(square[0])), r1 = sqrt(fabs(square[1]));
	if (!(r0 > 0 && r1 > 0 && isfinite(r0) && isfinite(r1)) || (square[0] < 0 && square[1] < 0))
		return false;
	*center = at;
	axis[0] = vec3(r0 * co, r0 * si, 0);
	axis[1] = vec3(-r1 * si, r1 * co, 0);
	return true;
}

/* p in the frame of the half axes. */
static double along(struct vec3 p, struct vec3 center, struct vec3 axis)
{
	return ((p.x - center.x) * axis.x + (p.y - center.y) * axis.y) / vec3_dot(axis, axis);
}

/* Its angle in that frame, from 0 to 2 pi. */
static double ellipse_angle(struct vec3 p, struct vec3 center, const struct vec3 axis[2])
{
	double angle = atan2(along(p, center, axis[1]), along(p, center, axis[0]));
	return angle < 0 ? angle + 2 * M_PI : angle;
}

/* Counterclockwise from p to q, the whole ellipse where they are one point. */
static enum status make_ellipse(struct curve *out, const struct conic *c, double zt, struct vec3 p,
                                struct vec3 q, const struct report *r)
{
	struct vec3 center, axis[2];
	double square[2];
	if (!conic_axes(c, &center, axis, square) || square[0] < 0 || square[1] < 0)
		return report_error(r, ST_PARAMETER, "the conic's equation has no real points");
	double a = ellipse_angle(p, center, axis), b = ellipse_angle(q, center, axis);
	double size = fmax(vec3_length(axis[0]), vec3_length(axis[1]));
	if (vec3_length(vec3_sub(p, q)) <= 1e-9 * size)
		b = a + 2 * M_PI;
	else if (b <= a)
		b += 2 * M_PI;
	struct circle arc;
	if (!circle_init(&arc, a, b))
		return report_error(r, ST_PARAMETER, "the conic's arc is too short");
	enum status st = curve_init(out, 3, arc.n);
	if (st != ST_OK)
		return st;
	for (int i = 0; i < arc.n; i++) {
		double *h = out->points + 4 * i, w = arc.w[i];
		h[0] = w * center.x + arc.x[i] * axis[0].x + arc.y[i] * axis[1].x;
		h[1] = w * center.y + arc.x[i] * axis[0].y + arc.y[i] * axis[1].y;
		h[2] = w * zt;
		h[3] = w;
	}
	memcpy(out->knots, arc.knots, (size_t)(arc.n + 3) * sizeof *out->knots);
	out->domain[0] = a;
	out->domain[1] = b;
	out->rational = true;
	return ST_OK;
}

static enum status no_ends(const struct report *r)
{
	return report_error(r, ST_PARAMETER,
	                    "the conic's ends are one point or lie on two branches");
}

/*
 * Parabola: one piece with the pole of the chord as middle point. The parameter is the coordinate across
 * its axis, which both it and the NURBS run evenly in; turned about where it falls.
 */
static enum status make_parabola(struct curve *out, const struct conic *c, double zt, struct vec3 p,
                                 struct vec3 q, const struct report *r)
{
	struct vec3 m = vec3_cross(conic_times(c, p), conic_times(c, q));
	struct vec3 across = fabs(c->m[0][0]) >= fabs(c->m[1][1]) ? vec3(c->m[0][0], c->m[0][1], 0)
	                                                          : vec3(c->m[0][1], c->m[1][1], 0);
	across = vec3_scale(across, (across.x + across.y < 0 ? -1 : 1) / vec3_length(across));
	double a = vec3_dot(p, across), b = vec3_dot(q, across);
	m = vec3(m.x / m.z, m.y / m.z, 1);
	if (!isfinite(m.x) || !isfinite(m.y) || a == b)
		return no_ends(r);
	enum status st = curve_init(out, 3, 3);
	if (st != ST_OK)
		return st;
	curve_set_point(out, 0, vec3(p.x, p.y, zt), 1);
	curve_set_point(out, 1, vec3(m.x, m.y, zt), 1);
	curve_set_point(out, 2, vec3(q.x, q.y, zt), 1);
	for (int i = 0; i < 6; i++)
		out->knots[i] = (b < a ? -1 : 1) * (i < 3 ? a : b);
	out->domain[0] = out->knots[0];
	out->domain[1] = out->knots[5];
	return ST_OK;
}

/*
 * A branch of a hyperbola: centre + S / cos t + T tan t, of which the homogeneous points are those of a
 * circle's arc with the weight and cos t exchanged, so that t is met as an arc's angle is. t is between
 * -pi/2 and pi/2 on the branch that S points to, between pi/2 and 3 pi/2 on the other, and -t where it falls.
 * Source: IGES 5.3, 4.5.
 */
static enum status make_hyperbola(struct curve *out, const struct conic *c, double zt,
                                  struct vec3 p, struct vec3 q, const struct report *r)
{
	struct vec3 center, axis[2];
	double square[2];
	if (!conic_axes(c, &center, axis, square))
		return no_ends(r);
	struct vec3 s = axis[square[0] < 0], t = axis[square[0] > 0];
	bool other = along(p, center, s) < 0;
	double a = atan(along(p, center, t)) + (other ? M_PI : 0),
	       b = atan(along(q, center, t)) + (other ? M_PI : 0);
	double turned = b < a ? -1 : 1;
	struct circle arc;
	if ((along(q, center, s) < 0) != other || !circle_init(&arc, turned * a, turned * b))
		return no_ends(r);
	enum status st = curve_init(out, 3, arc.n);
	if (st != ST_OK)
		return st;
	for (int i = 0; i < arc.n; i++) {
		double sign = other ? -1 : 1, w = sign * arc.x[i], e = sign * arc.w[i],
		       f = sign * turned * arc.y[i];
		curve_set_point(out, i,
		                vec3(center.x + (e * s.x + f * t.x) / w,
		                     center.y + (e * s.y + f * t.y) / w, zt),
		                w);
	}
	curve_set_point(out, 0, vec3(p.x, p.y, zt), fabs(arc.x[0]));
	curve_set_point(out, arc.n - 1, vec3(q.x, q.y, zt), fabs(arc.x[arc.n - 1]));
	memcpy(out->knots, arc.knots, (size_t)(arc.n + 3) * sizeof *out->knots);
	out->domain[0] = turned * a;
	out->domain[1] = turned * b;
	out->rational = true;
	return ST_OK;
}

enum status make_conic(struct curve *out, const double coefficients[6], double zt, struct vec3 p,
                       struct vec3 q, const struct report *r)
{
	const double *k = coefficients;
	struct conic c = { { { k[0], k[1] / 2, k[3] / 2 },
		             { k[1] / 2, k[2], k[4] / 2 },
		             { k[3] / 2, k[4] / 2, k[5] } } };
	double quadratic = fmax(fmax(fabs(k[0]), fabs(k[1])), fabs(k[2]));
	for (int i = 0; i < 6; i++)
		if (!isfinite(k[i]))
			return report_error(r, ST_PARAMETER, "a conic's coefficient is not finite");
	if (quadratic == 0)
		return report_error(r, ST_PARAMETER, "the conic's equation has no quadratic term");
	p.z = q.z = 1;
	double size = fmax(vec3_length(vec3_sub(p, q)), fmax(hypot(p.x, p.y), hypot(q.x, q.y)));
	double off = fmax(distance(&c, p), distance(&c, q));
	if (!(off <= 1e-3 * size))
		return report_error(r, ST_PARAMETER, "the conic's ends lie %g from it", off);

	/* B^2 - 4 A C to rounding; a parabola's is rarely zero to the bit */
	double discriminant = k[1] * k[1] - 4 * k[0] * k[2];
	if (fabs(discriminant) <= 1e-14 * quadratic * quadratic)
		return make_parabola(out, &c, zt, p, q, r);
	if (discriminant > 0)
		return make_hyperbola(out, &c, zt, p, q, r);
	return make_ellipse(out, &c, zt, p, q, r);
}
