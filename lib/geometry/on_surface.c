/* on_surface.c - a curve in the u,v plane of a surface, seen in space. */
#include "on_surface.h"

#include "curvature.h"

/* a + s b + t c */
static struct vec3 combine(struct vec3 a, double s, struct vec3 b, double t, struct vec3 c)
{
	return vec3_along(vec3_along(a, s, b), t, c);
}

void on_surface_derivatives(const struct on_surface *c, double t, int d, struct vec3 *out)
{
	struct vec3 p[4], s[16];
	const int row = d + 1;
	curve_derivatives(c->uv, t, d, p);
	surface_derivatives(c->surface, p[0].x, p[0].y, d, s);
	out[0] = s[0];
	if (d < 1)
		return;
	const struct vec3 su = s[row], sv = s[1], none = vec3(0, 0, 0);
	const double u1 = p[1].x, v1 = p[1].y;
	out[1] = combine(none, u1, su, v1, sv);
	if (d < 2)
		return;
	const struct vec3 suu = s[2 * row], suv = s[row + 1], svv = s[2];
	const double u2 = p[2].x, v2 = p[2].y;
	out[2] = combine(combine(none, u2, su, v2, sv), u1 * u1, suu, v1 * v1, svv);
	out[2] = vec3_along(out[2], 2 * u1 * v1, suv);
	if (d < 3)
		return;
	const struct vec3 suuu = s[3 * row], suuv = s[2 * row + 1], suvv = s[row + 2], svvv = s[3];
	out[3] = combine(none, p[3].x, su, p[3].y, sv);
	out[3] = combine(out[3], 3 * u1 * u2, suu, 3 * v1 * v2, svv);
	out[3] = vec3_along(out[3], 3 * (u1 * v2 + u2 * v1), suv);
	out[3] = combine(out[3], u1 * u1 * u1, suuu, v1 * v1 * v1, svvv);
	out[3] = combine(out[3], 3 * u1 * u1 * v1, suuv, 3 * u1 * v1 * v1, suvv);
}

void on_surface_shape(const struct on_surface *c, double t, struct on_surface_shape *out)
{
	struct vec3 d[4];
	on_surface_derivatives(c, t, 3, d);
	const struct vec3 at = curve_point(c->uv, t), cross = vec3_cross(d[1], d[2]);
	const double speed2 = vec3_dot(d[1], d[1]), area2 = vec3_dot(cross, cross);
	const double length = c->uv->domain[1] - c->uv->domain[0];
	struct curve_shape *space = &out->space;
	space->point = d[0];
	space->d1 = d[1];
	space->d2 = d[2];
	/* At rest compared with how it goes on: no direction to speak of. */
	space->limit = !(speed2 > 1e-24 * vec3_dot(d[2], d[2]) * length * length);
	space->curvature = space->limit ? NAN : sqrt(area2) / (speed2 * sqrt(speed2));
	space->torsion = area2 > 0 ? vec3_dot(cross, d[3]) / area2 : NAN;
	surface_normal(c->surface, at.x, at.y, &out->normal);
	out->normal_curvature = out->geodesic_curvature = NAN;
	if (space->limit)
		return;
	const struct vec3 side = vec3_cross(out->normal, vec3_scale(d[1], 1 / sqrt(speed2)));
	out->normal_curvature = vec3_dot(d[2], out->normal) / speed2;
	out->geodesic_curvature = vec3_dot(d[2], side) / speed2;
}
