/* construct_curves.c - lines, arcs, and curves put end to end. */
#include "construct.h"

#include <stdlib.h>
#include <string.h>

#include "circle.h"
#include "refine.h"
#include "report.h"

enum status make_line(struct curve *out, struct vec3 a, struct vec3 b)
{
	return make_polyline(out, (struct vec3[]){ a, b }, 2);
}

enum status make_polyline(struct curve *out, const struct vec3 *p, int n)
{
	if (n < 2)
		return ST_PARAMETER;
	enum status st = curve_init(out, 2, n);
	if (st != ST_OK)
		return st;
	for (int i = 0; i < n; i++) {
		curve_set_point(out, i, p[i], 1);
		out->knots[i + 1] = (double)i / (n - 1);
	}
	out->knots[0] = 0;
	out->knots[n + 1] = 1;
	out->domain[1] = 1;
	return ST_OK;
}

/* Sine and cosine, those of whole quarter turns exact: 90 degrees in radians is rounded. */
static void circle_direction(double angle, double *c, double *s)
{
	double quarters = round(angle / (M_PI / 2));
	*c = cos(angle);
	*s = sin(angle);
	if (fabs(angle - quarters * (M_PI / 2)) > 4e-16 * fmax(1, fabs(angle)))
		return;
	int q = (int)fmod(quarters, 4);
	*c = (double[]){ 1, 0, -1, 0 }[(q + 4) % 4];
	*s = (double[]){ 0, 1, 0, -1 }[(q + 4) % 4];
}

bool circle_init(struct circle *c, double a, double b)
{
	double sweep = b - a, turn = 2 * M_PI;
	if (!(sweep > 0 && sweep <= turn * (1 + 1e-12)) || !isfinite(a))
		return false;
	int pieces = (int)ceil(sweep / (M_PI / 2) * (1 - 1e-12));
	c->pieces = pieces < 1 ? 1 : pieces;
	c->n = 2 * c->pieces + 1;
	double half = sweep / (2 * c->pieces), w = cos(half);
	for (int i = 0; i < c->n; i++) {
		circle_direction(a + i * half, &c->x[i], &c->y[i]);
		c->w[i] = i % 2 ? w : 1;
	}
	if (fabs(sweep - turn) <= turn * 1e-12) {
		c->x[c->n - 1] = c->x[0];
		c->y[c->n - 1] = c->y[0];
	}
	for (int i = 0; i < c->n + 3; i++) {
		int at = (i - 1) / 2;
		c->knots[i] = at >= c->pieces ? b : a + 2 * half * at;
	}
	return true;
}

enum status make_arc(struct curve *out, struct vec3 c, struct vec3 x, struct vec3 y, double radius,
                     double a, double b)
{
	struct circle arc;
	if (!(radius > 0) || !isfinite(radius) || !circle_init(&arc, a, b))
		return ST_PARAMETER;
	enum status st = curve_init(out, 3, arc.n);
	if (st != ST_OK)
		return st;
	for (int i = 0; i < arc.n; i++) {
		/* the middle points lie at radius / w: in homogeneous form the w goes out */
		double *q = out->points + 4 * i, w = arc.w[i];
		q[0] = w * c.x + radius * (arc.x[i] * x.x + arc.y[i] * y.x);
		q[1] = w * c.y + radius * (arc.x[i] * x.y + arc.y[i] * y.y);
		q[2] = w * c.z + radius * (arc.x[i] * x.z + arc.y[i] * y.z);
		q[3] = w;
	}
	memcpy(out->knots, arc.knots, (size_t)(arc.n + 3) * sizeof *out->knots);
	out->domain[0] = a;
	out->domain[1] = b;
	out->rational = true;
	return ST_OK;
}

static double gap(const double *p, const double *q)
{
	struct vec3 a = vec3(p[0] / p[3], p[1] / p[3], p[2] / p[3]);
	struct vec3 b = vec3(q[0] / q[3], q[1] / q[3], q[2] / q[3]);
	return vec3_length(vec3_sub(a, b));
}

/* Part i clamped on its domain, of the given order, beginning at `start`. */
static enum status composite_part(struct curve *out, const struct curve *c, int order, double start)
{
	struct curve part;
	enum status st = curve_part(&part, c, c->domain[0], c->domain[1]);
	if (st != ST_OK)
		return st;
	st = curve_elevate(out, &part, order - c->order);
	curve_finish(&part);
	if (st == ST_OK && start != out->domain[0])
		curve_reparametrise(out, start, start + (c->domain[1] - c->domain[0]));
	return st;
}

/* Put `part` behind the n points of `out`; its first point falls on out's last. */
static int composite_append(struct curve *out, int n, const struct curve *part)
{
	int order = part->order, first = 0;
	double scale = 1;
	if (n > 0) {
		double *end = out->points + 4 * (n - 1);
		scale = end[3] / part->points[3];
		/* a gap within the tolerance is closed in its middle */
		for (int k = 0; k < 3; k++)
			if (end[k] != scale * part->points[k])
				end[k] = (end[k] + scale * part->points[k]) / 2;
		first = 1;
	}
	double *q = out->points + 4 * (n > 0 ? n - 1 : 0);
	for (int i = first; i < part->n; i++)
		for (int k = 0; k < 4; k++)
			q[4 * i + k] = scale * part->points[4 * i + k];
	int at = n > 0 ? n + order - 1 : 0; /* the last knot of the end goes: order - 1 stay */
	for (int i = n > 0 ? order : 0; i < part->n + order; i++)
		out->knots[at++] = part->knots[i];
	out->rational |= part->rational || scale != 1;
	out->domain[1] = part->domain[1];
	return n > 0 ? n + part->n - 1 : part->n;
}

enum status make_composite(struct curve *out, const struct curve *c, int n, double tolerance,
                           const struct report *r)
{
	if (n < 1)
		return report_error(r, ST_PARAMETER,
		                    "a composite curve of %d parts, expected 1 or more", n);
	int order = 0, points = 0;
	for (int i = 0; i < n; i++)
		order = c[i].order > order ? c[i].order : order;
	struct curve *parts = calloc((size_t)n, sizeof *parts);
	enum status st = parts ? ST_OK : ST_RESOURCE;
	double start = 0;
	for (int i = 0; i < n && st == ST_OK; i++) {
		st = composite_part(&parts[i], &c[i], order, start);
		if (st != ST_OK)
			break;
		start = parts[i].domain[1];
		points += parts[i].n;
		if (i == 0)
			continue;
		double d = gap(parts[i - 1].points + 4 * (parts[i - 1].n - 1), parts[i].points);
		if (!(d <= tolerance))
			st = report_error(r, ST_PARAMETER,
			                  "part %d of a composite curve begins %g from the end of "
			                  "part %d, expected at most %g",
			                  i + 1, d, i, tolerance);
	}
	if (st == ST_OK)
		st = curve_init(out, order, points - (n - 1));
	if (st == ST_OK) {
		int have = 0;
		for (int i = 0; i < n; i++)
			have = composite_append(out, have, &parts[i]);
	}
	for (int i = 0; parts && i < n; i++)
		curve_finish(&parts[i]);
	free(parts);
	return st;
}
