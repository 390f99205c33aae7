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

/* Centre and two conjugate half axes of an ellipse; false where the equation has no real points. */
static bool ellipse_axes(const struct conic *c, struct vec3 *center, struct vec3 axis[2])
{
	double a = c->m[0][0], b = c->m[0][1], d = c->m[1][1];
	double det = a * d - b * b;
	struct vec3 at = vec3((b * c->m[1][2] - d * c->m[0][2]) / det,
	                      (b * c->m[0][2] - a * c->m[1][2]) / det, 1);
	double level = -vec3_dot(conic_times(c, at), at); /* q(x - at) = level */
	double angle = b == 0 ? 0 : 0.5 * atan2(2 * b, a - d), co = cos(angle), si = sin(angle);
	double q0 = a * co * co + 2 * b * co * si + d * si * si;
	double q1 = a * si * si - 2 * b * co * si + d * co * co;
	double r0 = level / q0, r1 = level / q1;
	if (!(r0 > 0 && r1 > 0 && isfinite(r0) && isfinite(r1)))
		return false;
	*center = at;
	axis[0] = vec3(sqrt(r0) * co, sqrt(r0) * si, 0);
	axis[1] = vec3(-sqrt(r1) * si, sqrt(r1) * co, 0);
	return true;
}

/* Angle of p in the frame of the half axes. */
static double ellipse_angle(struct vec3 p, struct vec3 center, const struct vec3 axis[2])
{
	struct vec3 d = vec3_sub(p, center);
	double x = (d.x * axis[0].x + d.y * axis[0].y) / vec3_dot(axis[0], axis[0]);
	double y = (d.x * axis[1].x + d.y * axis[1].y) / vec3_dot(axis[1], axis[1]);
	return atan2(y, x);
}

/* Counterclockwise from p to q, the whole ellipse where they are one point. */
static enum status make_ellipse(struct curve *out, const struct conic *c, double zt, struct vec3 p,
                                struct vec3 q, const struct report *r)
{
	struct vec3 center, axis[2];
	if (!ellipse_axes(c, &center, axis))
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

/*
 * Parabola and hyperbola: one piece, with the pole of the chord as middle point and the weight that
 * puts w p q-type points on the conic, w^2 = -(p C q) / (2 m C m).
 */
static enum status make_open_conic(struct curve *out, const struct conic *c, bool parabola,
                                   double zt, struct vec3 p, struct vec3 q, const struct report *r)
{
	struct vec3 m = vec3_cross(conic_times(c, p), conic_times(c, q));
	double pq = vec3_dot(p, conic_times(c, q));
	m = vec3(m.x / m.z, m.y / m.z, 1);
	double w2 = -pq / (2 * vec3_dot(m, conic_times(c, m)));
	if (!isfinite(m.x) || !isfinite(m.y) || !(w2 > 0) || !isfinite(w2))
		return report_error(r, ST_PARAMETER,
		                    "the conic's ends are one point or lie on two branches");
	double w = parabola ? 1 : sqrt(w2);
	enum status st = curve_init(out, 3, 3);
	if (st != ST_OK)
		return st;
	curve_set_point(out, 0, vec3(p.x, p.y, zt), 1);
	curve_set_point(out, 1, vec3(m.x, m.y, zt), w);
	curve_set_point(out, 2, vec3(q.x, q.y, zt), 1);
	for (int i = 3; i < 6; i++)
		out->knots[i] = 1;
	out->domain[1] = 1;
	out->rational = w != 1;
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
		return make_open_conic(out, &c, true, zt, p, q, r);
	if (discriminant > 0)
		return make_open_conic(out, &c, false, zt, p, q, r);
	return make_ellipse(out, &c, zt, p, q, r);
}
