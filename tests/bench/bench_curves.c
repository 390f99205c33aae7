/* bench_curves.c - how far curves on the waves are from the exact ones. */
#include "bench_curves.h"

#include <math.h>

#include "level_border.h"

enum { STEPS = 5, HALVINGS = 40 };

/* The parameter where the surface has that x (d 0) or y (d 1). */
static double parameter_at(const struct surface *s, int d, double x)
{
	double lo = s->domain[d][0], hi = s->domain[d][1];
	for (int i = 0; i < HALVINGS; i++) {
		const double middle = 0.5 * (lo + hi);
		const struct vec3 p = surface_point(s, d == 0 ? middle : s->domain[0][0],
		                                    d == 1 ? middle : s->domain[1][0]);
		if ((d == 0 ? p.x : p.y) < x)
			lo = middle;
		else
			hi = middle;
	}
	return 0.5 * (lo + hi);
}

/* By differences, central where there is room. */
static double slope(const struct off *o, int d, const double uv[2])
{
	const double *range = o->s->domain[d], h = 1e-6 * (range[1] - range[0]);
	double lo[2] = { uv[0], uv[1] }, hi[2] = { uv[0], uv[1] };
	lo[d] = fmax(lo[d] - h, range[0]);
	hi[d] = fmin(hi[d] + h, range[1]);
	return (level_value(o->field, o->s, hi[0], hi[1]) -
	        level_value(o->field, o->s, lo[0], lo[1])) /
	       (hi[d] - lo[d]);
}

/* Newton's method for f = 0 and no difference along the curve. */
void off_add(const double xyz[3], void *data)
{
	struct off *o = data;
	const struct surface *s = o->s;
	const struct vec3 p = vec3(xyz[0], xyz[1], xyz[2]);
	double uv[2] = { parameter_at(s, 0, p.x), parameter_at(s, 1, p.y) };
	struct vec3 q, su, sv;
	for (int step = 0; step < STEPS; step++) {
		const double f = level_value(o->field, s, uv[0], uv[1]);
		const double fu = slope(o, 0, uv), fv = slope(o, 1, uv);
		surface_tangents(s, uv[0], uv[1], &q, &su, &sv);
		const struct vec3 t = vec3_unit(vec3_along(vec3_scale(sv, fu), -fv, su));
		const double a = vec3_dot(su, t), b = vec3_dot(sv, t),
		             r = vec3_dot(vec3_sub(q, p), t);
		const double det = fu * b - fv * a;
		uv[0] = fmin(fmax(uv[0] + (-f * b + fv * r) / det, s->domain[0][0]),
		             s->domain[0][1]);
		uv[1] = fmin(fmax(uv[1] + (-fu * r + f * a) / det, s->domain[1][0]),
		             s->domain[1][1]);
	}
	q = surface_point(s, uv[0], uv[1]);
	const double off = vec3_length(vec3_sub(p, q));
	if (isfinite(off))
		o->most = fmax(o->most, off);
	else
		o->lost++;
}
