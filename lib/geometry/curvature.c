/* curvature.c - normal and curvatures of a surface at a point. */
#include "curvature.h"

#include "forms.h"
#include "pole.h"
#include "surface_second.h"

#define X(name, channel, json, code, title, is_signed, power)                                      \
	[QUANTITY_##name] = { channel, json, code, title, is_signed, power },
const struct quantity_row quantity_table[N_QUANTITIES] = { QUANTITY_MAP(X) };
#undef X

/*
 * True where Su x Sv is far from zero by the derivatives at hand, so that no look at the whole span
 * is needed: neither tangent would vanish within a fiftieth of the span, nor are they near parallel.
 */
static bool surely_regular(const struct surface_shape *p, const struct forms *x, const double h[2])
{
	const double hu = h[0] * h[0], hv = h[1] * h[1];
	const double uu = vec3_dot(p->duu, p->duu) * hu * hu,
	             vv = vec3_dot(p->dvv, p->dvv) * hv * hv;
	const double uv = vec3_dot(p->duv, p->duv) * hu * hv;
	return x->e * hu > 4e-4 * (uu + uv) && x->g * hv > 4e-4 * (vv + uv) &&
	       x->area2 > 4e-4 * x->e * x->g;
}

static void spans_at(const struct surface *s, double u, double v, int span[2], double h[2])
{
	const double at[2] = { u, v };
	for (int d = 0; d < 2; d++) {
		span[d] = knots_domain_span(s->order[d], s->n[d], s->knots[d], s->domain[d], at[d]);
		h[d] = s->knots[d][span[d] + 1] - s->knots[d][span[d]];
	}
}

static void values_set(struct surface_shape *out, const struct form_values *f)
{
	out->value[QUANTITY_GAUSSIAN] = f->gaussian;
	out->value[QUANTITY_MEAN] = f->mean;
	out->value[QUANTITY_KMAX] = f->kmax;
	out->value[QUANTITY_KMIN] = f->kmin;
	out->value[QUANTITY_ABSOLUTE] = fabs(f->kmax) + fabs(f->kmin);
	out->value[QUANTITY_NORMAL_U] = f->normal_u;
	out->value[QUANTITY_NORMAL_V] = f->normal_v;
}

void shape_from_pole(struct surface_shape *out, const struct pole *p)
{
	struct form_values f = {
		.gaussian = p->value[POLE_GAUSSIAN],
		.mean = p->value[POLE_MEAN],
		.kmax = p->value[POLE_KMAX],
		.kmin = p->value[POLE_KMIN],
		.normal_u = p->value[POLE_NORMAL_U],
		.normal_v = p->value[POLE_NORMAL_V],
	};
	if (isnan(f.mean) || isnan(f.gaussian)) {
		f.kmax = f.kmin = NAN;
	} else if (isnan(f.kmax) || isnan(f.kmin)) {
		const double half = sqrt(fmax(f.mean * f.mean - f.gaussian, 0));
		f.kmax = f.mean + half;
		f.kmin = f.mean - half;
	}
	out->normal = p->normal;
	values_set(out, &f);
}

void surface_shape(const struct surface *s, double u, double v, struct surface_shape *out)
{
	int span[2];
	double h[2];
	surface_second(s, u, v, span, out);
	for (int d = 0; d < 2; d++)
		h[d] = s->knots[d][span[d] + 1] - s->knots[d][span[d]];
	out->limit = false;
	const struct vec3 cross = vec3_cross(out->du, out->dv);
	const struct forms x = {
		vec3_dot(out->du, out->du), vec3_dot(out->du, out->dv), vec3_dot(out->dv, out->dv),
		vec3_dot(cross, out->duu),  vec3_dot(cross, out->duv),  vec3_dot(cross, out->dvv),
		vec3_dot(cross, cross),
	};
	if (!surely_regular(out, &x, h)) {
		const struct pole_scale scale = pole_scale_of(s, span);
		const double area = sqrt(x.area2);
		struct pole p;
		if (scale.none || !(area > pole_degenerate * scale.area)) {
			out->limit = true;
			pole_limits(s, u, v, &scale, &p);
			shape_from_pole(out, &p);
			return;
		}
		if (!(area > pole_near * scale.area) && pole_beside(s, u, v, area, &scale, &p)) {
			shape_from_pole(out, &p);
			return;
		}
	}
	const struct form_values f = forms_values(&x);
	out->normal = vec3_scale(cross, 1 / sqrt(x.area2));
	values_set(out, &f);
}

/* Squared distance from p to the farthest corner of the control points of its spans. */
static double reach2(const struct surface *s, const int span[2], struct vec3 p)
{
	double far = 0;
	for (int k = 0; k < 4; k++) {
		const int i = k & 1 ? span[0] : span[0] - s->order[0] + 1;
		const int j = k & 2 ? span[1] : span[1] - s->order[1] + 1;
		const struct vec3 d = vec3_sub(surface_get_point(s, i, j, NULL), p);
		far = fmax(far, vec3_dot(d, d));
	}
	return far;
}

bool surface_normal(const struct surface *s, double u, double v, struct vec3 *normal)
{
	struct vec3 p, du, dv;
	int span[2];
	double h[2];
	surface_tangents(s, u, v, &p, &du, &dv);
	spans_at(s, u, v, span, h);
	const struct vec3 cross = vec3_cross(du, dv);
	const double e = vec3_dot(du, du), g = vec3_dot(dv, dv), area2 = vec3_dot(cross, cross);
	const double small = 1e-8 * reach2(s, span, p);
	if (area2 > 1e-4 * e * g && e * h[0] * h[0] > small && g * h[1] * h[1] > small) {
		*normal = vec3_scale(cross, 1 / sqrt(area2));
		return true;
	}
	struct surface_shape shape;
	surface_shape(s, u, v, &shape);
	*normal = shape.normal;
	return isfinite(shape.normal.x);
}

double shape_normal_curvature(const struct surface_shape *p, double a, double b)
{
	const struct vec3 t = vec3_along(vec3_scale(p->du, a), b, p->dv);
	const double length2 = vec3_dot(t, t);
	const double most = a * a * vec3_dot(p->du, p->du) + b * b * vec3_dot(p->dv, p->dv);
	const double tangent =
	        (a * a + b * b) * fmax(vec3_dot(p->du, p->du), vec3_dot(p->dv, p->dv));
	/* No direction, or one in which the parameters stand still. */
	if (!(length2 > 1e-24 * most) || !(length2 > 0) ||
	    (p->limit && !(length2 > 1e-18 * tangent)))
		return NAN;
	return (a * a * vec3_dot(p->duu, p->normal) + 2 * a * b * vec3_dot(p->duv, p->normal) +
	        b * b * vec3_dot(p->dvv, p->normal)) /
	       length2;
}

bool shape_principal_directions(const struct surface_shape *p, struct vec3 out[2])
{
	const double kmax = p->value[QUANTITY_KMAX], kmin = p->value[QUANTITY_KMIN];
	if (p->limit || !(kmax - kmin > 1e-10 * (fabs(kmax) + fabs(kmin))))
		return false;
	/* In the frame of Su and the direction square to it the second form is (a b; b c). */
	const struct vec3 x = vec3_unit(p->du), y = vec3_cross(p->normal, x);
	const double e = vec3_length(p->du), f = vec3_dot(p->dv, x), g = vec3_dot(p->dv, y);
	const double l = vec3_dot(p->duu, p->normal), m = vec3_dot(p->duv, p->normal);
	const double a = l / (e * e), b = (m / e - a * f) / g;
	const double c = kmax + kmin - a;
	const double angle = 0.5 * atan2(2 * b, a - c);
	out[0] = vec3_add(vec3_scale(x, cos(angle)), vec3_scale(y, sin(angle)));
	out[1] = vec3_cross(p->normal, out[0]);
	return true;
}
