/* construct_offset.c - the surface at a distance along the normal, interpolated and checked.
 *
 * A tensor spline of order 6 through exact points of the offset, at the Greville abscissae of knots
 * that have the continuity the offset has: one less than the surface's at each of its own knots,
 * for the normal takes one derivative. On the line of a Greville abscissa of v the interpolant is
 * that of the line alone, so errors along such lines tell which spans of u are too long, and the
 * other way round. Spans are halved until those errors are small; then the whole is checked.
 */
#include "construct.h"

#include <stdlib.h>
#include <string.h>

#include "curvature.h"
#include "interpolate.h"
#include "report.h"

enum {
	SAMPLES = 4, /* points of a span where errors are looked for, in each direction */
	MAX_ROUNDS = 30,
	MAX_SPANS = 2048,     /* in one direction */
	MAX_POINTS = 1 << 21, /* of the net */
	ASK_EVERY = 2000,
};

/* A crease turns the normal by more than this, radians, over `beside` of a span. */
static const double crease = 1e-4, beside = 1e-7;

/* What an interpolant cannot do better than, relative to the size. */
static const double rounding = 1e-14;

struct offset {
	const struct surface *s;
	double distance, tolerance;
	const struct report *r;
	struct side side[2];
	struct surface out;          /* the present try */
	double error;                /* of the whole, once checked */
	const struct effort *effort; /* NULL: no limits */
	int64_t spent, asked; /* points looked at, and when it was last asked whether to stop */
};

/* n more points are to be looked at. */
static enum status spend(struct offset *o, int n)
{
	o->spent += n;
	if (!o->effort)
		return ST_OK;
	if (o->spent > o->effort->points)
		return report_error(
		        o->r, ST_PARAMETER,
		        "an offset within %g wants more than %lld points looked at; take "
		        "a larger tolerance",
		        o->tolerance, (long long)o->effort->points);
	if (o->effort->stop && o->spent - o->asked >= ASK_EVERY) {
		o->asked = o->spent;
		if (o->effort->stop(o->effort->data))
			return ST_CANCELLED;
	}
	return ST_OK;
}

static double inside(const double breaks[2], double x)
{
	return x == 1 ? breaks[1] : breaks[0] + x * (breaks[1] - breaks[0]);
}

/* Exact point of the offset. Where there is no normal (the tip of a cone) the one beside it, on
 * the same line, stands in. */
static enum status exact_point(const struct offset *o, double u, double v, struct vec3 *out)
{
	struct vec3 normal;
	double at[2] = { u, v };
	for (int try = 0; !surface_normal(o->s, at[0], at[1], &normal); try++) {
		if (try == 2)
			return report_error(o->r, ST_INPUT,
			                    "the surface has no normal at u %g, v %g and so no "
			                    "offset there",
			                    u, v);
		int d = 1 - try;
		const double *range = o->s->domain[d];
		double step = beside * (range[1] - range[0]);
		at[0] = u;
		at[1] = v;
		at[d] += at[d] > (range[0] + range[1]) / 2 ? -step : step;
	}
	*out = vec3_along(surface_point(o->s, u, v), o->distance, normal);
	return ST_OK;
}

/* The offset folds over where 1 - distance k <= 0 for a principal curvature k. */
static enum status check_radius(const struct offset *o, double u, double v)
{
	struct surface_shape shape;
	surface_shape(o->s, u, v, &shape);
	double k = o->distance > 0 ? shape.value[QUANTITY_KMAX] : shape.value[QUANTITY_KMIN];
	if (1 - o->distance * k <= 0)
		return report_error(o->r, ST_INPUT,
		                    "the surface bends with radius %g at u %g, v %g, less than the "
		                    "offset distance %g; take a smaller distance",
		                    fabs(1 / k), u, v, fabs(o->distance));
	return ST_OK;
}

/* No crease over the inner breaks, and no fold, seen at the samples of the surface's own spans. */
static enum status check_surface(struct offset *o)
{
	const struct side *a = &o->side[0], *b = &o->side[1];
	enum status st = ST_OK;
	for (int i = 0; i < a->spans * SAMPLES && st == ST_OK; i++) {
		st = spend(o, b->spans * SAMPLES);
		for (int j = 0; j < b->spans * SAMPLES && st == ST_OK; j++) {
			double x = (i % SAMPLES + 0.5) / SAMPLES, y = (j % SAMPLES + 0.5) / SAMPLES;
			st = check_radius(o, inside(a->breaks + i / SAMPLES, x),
			                  inside(b->breaks + j / SAMPLES, y));
		}
	}
	for (int d = 0; d < 2; d++) {
		const struct side *over = &o->side[d], *along = &o->side[1 - d];
		for (int i = 1; i < over->spans && st == ST_OK; i++) {
			double at = over->breaks[i];
			double left = at - beside * (at - over->breaks[i - 1]);
			for (int j = 0; j < along->spans * SAMPLES; j++) {
				double w = inside(along->breaks + j / SAMPLES,
				                  (j % SAMPLES + 0.5) / SAMPLES);
				struct vec3 n0, n1;
				bool both = d == 0 ? surface_normal(o->s, left, w, &n0) &&
				                             surface_normal(o->s, at, w, &n1)
				                   : surface_normal(o->s, w, left, &n0) &&
				                             surface_normal(o->s, w, at, &n1);
				if (both && vec3_length(vec3_sub(n0, n1)) > crease)
					return report_error(
					        o->r, ST_INPUT,
					        "the surface has a crease at %c %g and so no offset in "
					        "one piece; split it there",
					        "uv"[d], at);
			}
		}
	}
	return st;
}

/* Interpolate on the present spans. */
static enum status interpolate(struct offset *o)
{
	surface_finish(&o->out);
	const int n[2] = { o->side[0].n, o->side[1].n };
	if ((long long)n[0] * n[1] > MAX_POINTS)
		return report_error(o->r, ST_PARAMETER,
		                    "an offset within %g wants more than %d points; take a larger "
		                    "tolerance",
		                    o->tolerance, MAX_POINTS);
	enum status st = surface_init(&o->out, (int[2]){ SIDE_ORDER, SIDE_ORDER }, n);
	double *x = st == ST_OK ? malloc((size_t)n[0] * (size_t)n[1] * 3 * sizeof *x) : NULL;
	if (st == ST_OK && !x)
		st = ST_RESOURCE;
	for (int i = 0; i < n[0] && st == ST_OK; i++) {
		st = spend(o, n[1]);
		for (int j = 0; j < n[1] && st == ST_OK; j++) {
			struct vec3 p;
			st = exact_point(o, o->side[0].at[i], o->side[1].at[j], &p);
			double *q = x + 3 * ((size_t)i * n[1] + j);
			q[0] = p.x;
			q[1] = p.y;
			q[2] = p.z;
		}
	}
	if (st == ST_OK) {
		side_solve(&o->side[0], x, (size_t)3 * n[1]);
		for (int i = 0; i < n[0]; i++)
			side_solve(&o->side[1], x + (size_t)3 * i * n[1], 3);
		for (int i = 0; i < n[0]; i++)
			for (int j = 0; j < n[1]; j++) {
				const double *q = x + 3 * ((size_t)i * n[1] + j);
				surface_set_point(&o->out, i, j, vec3(q[0], q[1], q[2]), 1);
			}
		for (int d = 0; d < 2; d++) {
			memcpy(o->out.knots[d], o->side[d].knots,
			       (size_t)(n[d] + SIDE_ORDER) * sizeof *o->out.knots[d]);
			memcpy(o->out.domain[d], o->s->domain[d], sizeof o->out.domain[d]);
		}
	}
	free(x);
	return st;
}

static enum status error_at(const struct offset *o, double u, double v, double *error)
{
	struct vec3 p;
	enum status st = exact_point(o, u, v, &p);
	if (st == ST_OK)
		*error = vec3_length(vec3_sub(p, surface_point(&o->out, u, v)));
	return st;
}

/* Errors of the spans of direction d, along the lines where the other direction interpolates. */
static enum status line_errors(struct offset *o, int d)
{
	struct side *s = &o->side[d];
	const struct side *other = &o->side[1 - d];
	for (int i = 0; i < s->spans; i++) {
		s->error[i] = 0;
		for (int k = 0; k < SAMPLES; k++) {
			double t = inside(s->breaks + i, (k + 0.5) / SAMPLES);
			enum status st = spend(o, other->n);
			if (st != ST_OK)
				return st;
			for (int j = 0; j < other->n; j++) {
				double e, w = other->at[j];
				st = error_at(o, d == 0 ? t : w, d == 0 ? w : t, &e);
				if (st != ST_OK)
					return st;
				s->error[i] = fmax(s->error[i], e);
			}
		}
	}
	return ST_OK;
}

/* Errors inside every cell, counted for its spans in both directions; radii once more. */
static enum status cell_errors(struct offset *o)
{
	struct side *a = &o->side[0], *b = &o->side[1];
	o->error = 0;
	memset(a->error, 0, (size_t)a->spans * sizeof *a->error);
	memset(b->error, 0, (size_t)b->spans * sizeof *b->error);
	for (int i = 0; i < a->spans * SAMPLES; i++) {
		double u = inside(a->breaks + i / SAMPLES, (i % SAMPLES + 0.37) / SAMPLES);
		enum status st = spend(o, b->spans * SAMPLES);
		if (st != ST_OK)
			return st;
		for (int j = 0; j < b->spans * SAMPLES; j++) {
			double v = inside(b->breaks + j / SAMPLES, (j % SAMPLES + 0.63) / SAMPLES);
			double e;
			st = error_at(o, u, v, &e);
			if (st == ST_OK && i % SAMPLES == 1 && j % SAMPLES == 2)
				st = check_radius(o, u, v);
			if (st != ST_OK)
				return st;
			a->error[i / SAMPLES] = fmax(a->error[i / SAMPLES], e);
			b->error[j / SAMPLES] = fmax(b->error[j / SAMPLES], e);
			o->error = fmax(o->error, e);
		}
	}
	return ST_OK;
}

/* Halve the spans whose error is above the limit; *changed where there were any. */
static enum status halve(struct offset *o, double limit, bool *changed)
{
	*changed = false;
	for (int d = 0; d < 2; d++) {
		int more = 0;
		for (int i = 0; i < o->side[d].spans; i++)
			more += o->side[d].error[i] > limit;
		if (more == 0)
			continue;
		if (o->side[d].spans + more > MAX_SPANS)
			return report_error(o->r, ST_PARAMETER,
			                    "an offset within %g wants more than %d spans in %c; "
			                    "take a larger tolerance",
			                    o->tolerance, MAX_SPANS, "uv"[d]);
		enum status st = side_halve(&o->side[d], limit);
		if (st != ST_OK)
			return st;
		*changed = true;
	}
	return ST_OK;
}

static enum status approach(struct offset *o)
{
	for (int round = 0; round < MAX_ROUNDS; round++) {
		bool changed;
		enum status st = interpolate(o);
		for (int d = 0; d < 2 && st == ST_OK; d++)
			st = line_errors(o, d);
		if (st == ST_OK)
			st = halve(o, o->tolerance / 3, &changed);
		if (st != ST_OK)
			return st;
		if (changed)
			continue;
		st = cell_errors(o);
		if (st == ST_OK)
			st = halve(o, o->tolerance, &changed);
		if (st != ST_OK || !changed)
			return st;
	}
	return report_error(o->r, ST_PARAMETER,
	                    "an offset within %g is not reached by halving %d times; take a larger "
	                    "tolerance",
	                    o->tolerance, MAX_ROUNDS);
}

enum status make_offset(struct surface *out, const struct surface *s, double distance,
                        double tolerance, double *error, const struct report *r)
{
	return make_offset_within(out, s, distance, tolerance, NULL, error, r);
}

enum status make_offset_within(struct surface *out, const struct surface *s, double distance,
                               double tolerance, const struct effort *effort, double *error,
                               const struct report *r)
{
	if (!isfinite(distance) || !(tolerance > 0))
		return report_error(
		        r, ST_PARAMETER,
		        "offset distance %g, tolerance %g; expected a finite distance and "
		        "a tolerance above 0",
		        distance, tolerance);
	double size = surface_size(s) + fabs(distance);
	if (tolerance < rounding * size)
		return report_error(r, ST_PARAMETER,
		                    "offset tolerance %g is below rounding, %g; take a larger one",
		                    tolerance, rounding * size);
	struct offset o = {
		.s = s, .distance = distance, .tolerance = tolerance, .r = r, .effort = effort
	};
	enum status st = ST_OK;
	for (int d = 0; d < 2 && st == ST_OK; d++)
		st = side_init(&o.side[d], s, d);
	if (st == ST_OK)
		st = check_surface(&o);
	if (st == ST_OK)
		st = approach(&o);
	side_finish(&o.side[0]);
	side_finish(&o.side[1]);
	if (st != ST_OK) {
		surface_finish(&o.out);
		return st;
	}
	*out = o.out;
	*error = o.error;
	return ST_OK;
}
