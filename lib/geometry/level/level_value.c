/* level_value.c - a field at one point of a surface, as it is defined, without forms and bounds. */
#include "level_border.h"

/* Signed distance of the line through p along a from that through q along l. */
static double line_distance(struct vec3 p, struct vec3 a, struct vec3 q, struct vec3 l)
{
	return vec3_dot(vec3_unit(vec3_cross(a, l)), vec3_sub(q, p));
}

double level_value(const struct level_field *f, const struct surface *s, double u, double v)
{
	struct surface_shape x;
	struct vec3 n = vec3(NAN, NAN, NAN);
	const struct vec3 d = vec3_unit(f->direction), p = surface_point(s, u, v);
	if (level_needs_normals(f->kind) && f->kind != LEVEL_CURVATURE)
		surface_normal(s, u, v, &n);
	const struct vec3 ray = vec3_unit(vec3_sub(p, f->eye));
	switch (f->kind) {
	case LEVEL_PLANE:
		return vec3_dot(p, f->direction) - f->value;
	case LEVEL_CYLINDER:
		return vec3_length(vec3_cross(vec3_sub(p, f->point), d)) - f->value;
	case LEVEL_ISOPHOTE:
		return vec3_dot(n, d) - f->value;
	case LEVEL_SILHOUETTE:
		return vec3_dot(n, d);
	case LEVEL_EYE:
		return vec3_dot(n, ray);
	case LEVEL_HIGHLIGHT:
		return line_distance(p, n, f->point, d) - f->value;
	case LEVEL_REFLECTION:
		return line_distance(p, vec3_along(ray, -2 * vec3_dot(n, ray), n), f->point, d);
	case LEVEL_CURVATURE:
		surface_shape(s, u, v, &x);
		return x.value[f->quantity] - f->value;
	case N_LEVEL_KINDS:
		break;
	}
	return NAN;
}
