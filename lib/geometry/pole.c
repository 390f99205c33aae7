/* pole.c - limits of normal and curvature where Su x Sv vanishes. */
#include "pole.h"

#include <math.h>

#include "extrapolate.h"
#include "forms.h"
#include "surface_second.h"

const double pole_near = 1e-4, pole_degenerate = 1e-9;

/* Limits and directions must agree to this, relative to the value or to 1 / length of the span. */
static const double agreement = 1e-5;
/* A line is shrunk to a point where it stays within this part of the span's size. */
static const double shrunk = 1e-9;

enum { LINE_SAMPLES = 8, RAYS_MAX = 32, PARTS = 3 + N_POLE_VALUES };

/* A way to approach a point: from (u, v) towards the span's inside, (du, dv) long. */
struct ray_in {
	double u, v, du, dv;
};

struct rays_in {
	int n;
	struct ray_in ray[RAYS_MAX];
};

struct pole_scale pole_scale_of(const struct surface *s, const int span[2])
{
	static const double at[5][2] = {
		{ 0.5, 0.5 }, { 0.2, 0.3 }, { 0.7, 0.2 }, { 0.3, 0.8 }, { 0.8, 0.7 },
	};
	struct pole_scale out = { 0, 0, false };
	double size[2] = { 0, 0 }, lo[2], h[2];
	for (int d = 0; d < 2; d++) {
		lo[d] = s->knots[d][span[d]];
		h[d] = s->knots[d][span[d] + 1] - lo[d];
	}
	for (int i = 0; i < 5; i++) {
		struct vec3 p, du, dv;
		surface_tangents(s, lo[0] + at[i][0] * h[0], lo[1] + at[i][1] * h[1], &p, &du, &dv);
		out.area = fmax(out.area, vec3_length(vec3_cross(du, dv)));
		size[0] = fmax(size[0], vec3_length(du) * h[0]);
		size[1] = fmax(size[1], vec3_length(dv) * h[1]);
	}
	out.length = fmax(size[0], size[1]);
	out.none = !(fmin(size[0], size[1]) > 1e-12 * out.length) ||
	           !(out.area * h[0] * h[1] > 1e-12 * size[0] * size[1]);
	return out;
}

/* Normal and curvatures by the plain formulas, in the order of PARTS; NaN where they fail. */
static void plain_values(const struct surface *s, double u, double v, double out[PARTS])
{
	struct surface_shape p;
	int span[2];
	surface_second(s, u, v, span, &p);
	const struct vec3 cross = vec3_cross(p.du, p.dv);
	const struct forms x = {
		vec3_dot(p.du, p.du),   vec3_dot(p.du, p.dv),   vec3_dot(p.dv, p.dv),
		vec3_dot(cross, p.duu), vec3_dot(cross, p.duv), vec3_dot(cross, p.dvv),
		vec3_dot(cross, cross),
	};
	const struct form_values f = forms_values(&x);
	const double scale = 1 / sqrt(x.area2);
	out[0] = cross.x * scale;
	out[1] = cross.y * scale;
	out[2] = cross.z * scale;
	out[3 + POLE_MEAN] = f.mean;
	out[3 + POLE_GAUSSIAN] = f.gaussian;
	out[3 + POLE_KMAX] = f.kmax;
	out[3 + POLE_KMIN] = f.kmin;
	out[3 + POLE_NORMAL_U] = f.normal_u;
	out[3 + POLE_NORMAL_V] = f.normal_v;
}

static void ray_limits(const struct surface *s, const struct ray_in *ray, double out[PARTS],
                       double error[PARTS])
{
	double f[PARTS][EXTRAPOLATE_NODES], values[PARTS];
	for (int k = 0; k < EXTRAPOLATE_NODES; k++) {
		const double r = extrapolate_node(k);
		plain_values(s, ray->u + r * ray->du, ray->v + r * ray->dv, values);
		for (int i = 0; i < PARTS; i++)
			f[i][k] = values[i];
	}
	for (int i = 0; i < PARTS; i++)
		out[i] = extrapolate(f[i], EXTRAPOLATE_NODES, &error[i]);
}

/*
 * Room in direction d from t to both sides, signed, 0 where there is none. Inside a span it is what
 * the span leaves, but a side that is cramped beside the other is not used; at a knot both spans'.
 */
static void room(const struct surface *s, int d, double t, double out[2])
{
	const double *k = s->knots[d], *domain = s->domain[d];
	const int order = s->order[d], n = s->n[d];
	const int right = knots_domain_span(order, n, k, domain, t);
	const double h = k[right + 1] - k[right], snap = 1e-9 * h;
	double knot = t;
	if (t - k[right] <= snap)
		knot = k[right];
	else if (k[right + 1] - t <= snap)
		knot = k[right + 1];
	out[0] = out[1] = 0;
	if (knot > domain[0] + snap) {
		const int left = knots_span_left(order, n, k, knot);
		out[0] = fmax(k[left], domain[0]) - t;
	}
	if (knot < domain[1] - snap) {
		const int next = knots_span(order, n, k, knot);
		out[1] = fmin(k[next + 1], domain[1]) - t;
	}
	const bool at_knot = knot == k[right] || knot == k[right + 1];
	for (int side = 0; side < 2 && !at_knot; side++)
		if (fabs(out[side]) < 0.2 * fabs(out[1 - side]))
			out[side] = 0;
}

static void rays_add(struct rays_in *rays, double u, double v, double du, double dv)
{
	if (rays->n < RAYS_MAX && (du != 0 || dv != 0))
		rays->ray[rays->n++] = (struct ray_in){ u, v, du, dv };
}

/* From one point in all directions that there are. */
static void rays_all_round(struct rays_in *rays, const struct surface *s, double u, double v)
{
	static const double slope[3][2] = { { 0.95, 0.3 }, { 0.7, 0.7 }, { 0.3, 0.95 } };
	double ru[2], rv[2];
	room(s, 0, u, ru);
	room(s, 1, v, rv);
	for (int a = 0; a < 2; a++)
		for (int b = 0; b < 2; b++)
			for (int i = 0; i < 3 && ru[a] != 0 && rv[b] != 0; i++)
				rays_add(rays, u, v, slope[i][0] * ru[a], slope[i][1] * rv[b]);
}

/* Across the line of direction d, from t on it. */
static void rays_across(struct rays_in *rays, const struct surface *s, int d, double t, double at)
{
	double r[2];
	room(s, 1 - d, at, r);
	for (int side = 0; side < 2; side++) {
		if (d == 0)
			rays_add(rays, t, at, 0, r[side]);
		else
			rays_add(rays, at, t, r[side], 0);
	}
}

/* Is the line through (u, v) in direction d shrunk to that point? Then add the ways across it. */
static bool rays_from_line(struct rays_in *rays, const struct surface *s, int d, const double at[2],
                           double size)
{
	const struct vec3 p = surface_point(s, at[0], at[1]);
	const double *domain = s->domain[d];
	int found = 0;
	for (int i = 0; i < LINE_SAMPLES; i++) {
		double q[2] = { at[0], at[1] };
		q[d] = domain[0] + (domain[1] - domain[0]) * (i + 0.5) / LINE_SAMPLES;
		struct vec3 there = surface_point(s, q[0], q[1]);
		if (!(vec3_length(vec3_sub(there, p)) <= shrunk * size))
			continue;
		rays_across(rays, s, d, q[d], at[1 - d]);
		found++;
	}
	return found > 0;
}

/* How far apart two values of part i may be; the normal's parts are of size 1. */
static double allowance(int i, double value, double length, double relative)
{
	if (i < 3)
		return relative;
	const double unit = i == 3 + POLE_GAUSSIAN ? 1 / (length * length) : 1 / length;
	return relative * fmax(fabs(value), unit);
}

/*
 * Mean of the limits along all rays where each has one and all agree, else NaN. Curvatures are
 * only given where the normal is the same up to its sign.
 */
static void rays_agree(const struct surface *s, const struct rays_in *rays, double length,
                       double relative, double out[PARTS])
{
	double sum[PARTS] = { 0 }, first[PARTS], value[PARTS], error[PARTS];
	bool agree[PARTS], tangent = rays->n > 0;
	for (int i = 0; i < PARTS; i++)
		agree[i] = rays->n > 0;
	for (int k = 0; k < rays->n && tangent; k++) {
		ray_limits(s, &rays->ray[k], value, error);
		if (k == 0)
			for (int i = 0; i < PARTS; i++)
				first[i] = value[i];
		double turned = 0, cosine = 0;
		for (int i = 0; i < 3; i++)
			cosine += value[i] * first[i];
		for (int i = 0; i < PARTS; i++) {
			const double allowed = allowance(i, first[i], length, relative);
			agree[i] &= error[i] <= allowed && fabs(value[i] - first[i]) <= allowed;
			sum[i] += value[i];
			if (i < 3)
				turned = fmax(turned,
				              fmax(error[i], fabs(value[i] -
				                                  copysign(1, cosine) * first[i])));
		}
		tangent = turned <= relative;
	}
	const bool normal = agree[0] && agree[1] && agree[2] && tangent;
	for (int i = 0; i < PARTS; i++)
		out[i] = (i < 3 ? normal : agree[i] && tangent) ? sum[i] / rays->n : NAN;
}

static void pole_set(struct pole *out, const double value[PARTS])
{
	out->normal = vec3_unit(vec3(value[0], value[1], value[2]));
	for (int i = 0; i < N_POLE_VALUES; i++)
		out->value[i] = value[3 + i];
}

void pole_limits(const struct surface *s, double u, double v, const struct pole_scale *scale,
                 struct pole *out)
{
	struct rays_in rays = { 0 }, here = { 0 };
	const double at[2] = { u, v };
	double value[PARTS], local[PARTS];
	for (int i = 0; i < PARTS; i++)
		value[i] = local[i] = NAN;
	if (!scale->none) {
		for (int d = 0; d < 2; d++)
			if (rays_from_line(&rays, s, d, at, scale->length))
				rays_across(&here, s, d, at[d], at[1 - d]);
		if (rays.n == 0) {
			rays_all_round(&rays, s, u, v);
			rays_agree(s, &rays, scale->length, agreement, value);
			pole_set(out, value);
			return;
		}
		rays_agree(s, &rays, scale->length, agreement, value);
		if (isfinite(value[3 + POLE_GAUSSIAN]) || isfinite(value[0])) {
			rays_agree(s, &here, scale->length, agreement, local);
			value[3 + POLE_NORMAL_U] = local[3 + POLE_NORMAL_U];
			value[3 + POLE_NORMAL_V] = local[3 + POLE_NORMAL_V];
		}
	}
	pole_set(out, value);
}

bool pole_beside(const struct surface *s, double u, double v, double area,
                 const struct pole_scale *scale, struct pole *out)
{
	/* What the plain formulas lose: two derivatives divided by what is left of the area. */
	const double left = area / scale->area, lost = fmin(1e-16 / (left * left), 1e-2);
	double ru[2], rv[2], value[PARTS];
	struct rays_in rays = { 0 };
	if (scale->none)
		return false;
	room(s, 0, u, ru);
	room(s, 1, v, rv);
	const double du = ru[1] >= -ru[0] || ru[0] == 0 ? ru[1] : ru[0];
	const double dv = rv[1] >= -rv[0] || rv[0] == 0 ? rv[1] : rv[0];
	rays_add(&rays, u, v, 0.7 * du, 0.7 * dv);
	rays_add(&rays, u, v, 0.3 * du, 0.95 * dv);
	rays_agree(s, &rays, scale->length, fmax(agreement, lost), value);
	pole_set(out, value);
	for (int i = 0; i < PARTS; i++)
		if (!isfinite(value[i]))
			return false;
	return true;
}
