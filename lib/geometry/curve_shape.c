/* curve_shape.c - curvature and torsion along a curve. */
#include <math.h>

#include "curve.h"
#include "extrapolate.h"

/* Below these parts of what the span reaches a derivative has lost too many digits; is zero. */
static const double near_zero = 1e-4, zero = 1e-9;
/* Limits from both sides must agree to this, relative. */
static const double agreement = 1e-5;

struct bend {
	double curvature, torsion;
};

/* The plain formulas; NaN where they fail. */
static struct bend plain_bend(const struct vec3 d[4])
{
	const struct vec3 cross = vec3_cross(d[1], d[2]);
	const double speed = vec3_length(d[1]), area = vec3_length(cross);
	return (struct bend){ area / (speed * speed * speed),
		              vec3_dot(cross, d[3]) / (area * area) };
}

/* Largest speed, and |C' x C''|, at samples of the span that starts at knot s. */
static void span_scale(const struct curve *c, int s, double *speed, double *area)
{
	const double a = c->knots[s], b = c->knots[s + 1];
	struct vec3 d[3];
	*speed = *area = 0;
	for (int i = 0; i < 3; i++) {
		curve_derivatives(c, a + (b - a) * (0.15 + 0.35 * i), 2, d);
		*speed = fmax(*speed, vec3_length(d[1]));
		*area = fmax(*area, vec3_length(vec3_cross(d[1], d[2])));
	}
	/* Rounding makes no plane of a straight line. */
	if (*area * (b - a) < 1e-12 * *speed * *speed)
		*area = 0;
}

static bool agrees(double a, double b, double unit)
{
	return fabs(a - b) <= agreement * fmax(fabs(a), unit);
}

/* Limits from the sides that the domain has at t; NaN where there is none. */
static struct bend bend_limit(const struct curve *c, double t, double length, bool straight)
{
	struct bend found = { NAN, NAN };
	bool first = true;
	for (int side = 0; side < 2; side++) {
		if (side == 0 ? !(t > c->domain[0]) : !(t < c->domain[1]))
			continue;
		const int s = side == 0 ? knots_span_left(c->order, c->n, c->knots, t)
		                        : knots_domain_span(c->order, c->n, c->knots, c->domain, t);
		const double room = (side == 0 ? fmax(c->knots[s], c->domain[0])
		                               : fmin(c->knots[s + 1], c->domain[1])) -
		                    t;
		double f[2][EXTRAPOLATE_NODES], error[2];
		for (int k = 0; k < EXTRAPOLATE_NODES; k++) {
			struct vec3 d[4];
			curve_derivatives(c, t + extrapolate_node(k) * room, 3, d);
			const struct bend b = plain_bend(d);
			f[0][k] = b.curvature;
			f[1][k] = b.torsion;
		}
		struct bend b = { extrapolate(f[0], EXTRAPOLATE_NODES, &error[0]),
			          extrapolate(f[1], EXTRAPOLATE_NODES, &error[1]) };
		if (!(error[0] <= agreement * fmax(fabs(b.curvature), 1 / length)))
			b.curvature = NAN;
		if (straight || !(error[1] <= agreement * fmax(fabs(b.torsion), 1 / length)))
			b.torsion = NAN;
		if (first) {
			found = b;
		} else {
			if (!agrees(found.curvature, b.curvature, 1 / length))
				found.curvature = NAN;
			if (!agrees(found.torsion, b.torsion, 1 / length))
				found.torsion = NAN;
		}
		first = false;
	}
	return found;
}

void curve_shape(const struct curve *c, double t, struct curve_shape *out)
{
	struct vec3 d[4];
	double speed, area;
	const int s = knots_domain_span(c->order, c->n, c->knots, c->domain, t);
	const double h = c->knots[s + 1] - c->knots[s];
	curve_derivatives(c, t, 3, d);
	span_scale(c, s, &speed, &area);
	const double now = vec3_length(d[1]), now_area = vec3_length(vec3_cross(d[1], d[2]));
	struct bend b = plain_bend(d);
	out->limit = !(now > zero * speed);
	const bool slow = !(now > near_zero * speed), flat = !(now_area > near_zero * area);
	if (slow || flat) {
		const struct bend limit = bend_limit(c, t, speed * h, area == 0);
		if (slow && (out->limit || isfinite(limit.curvature)))
			b.curvature = limit.curvature;
		if (area == 0 || !(now_area > zero * area) || isfinite(limit.torsion))
			b.torsion = limit.torsion;
	}
	out->point = d[0];
	out->d1 = d[1];
	out->d2 = d[2];
	out->curvature = b.curvature;
	out->torsion = b.torsion;
}
