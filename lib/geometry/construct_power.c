/* construct_power.c - B-splines from piecewise power-basis polynomials (IGES 112 and 114). */
#include "construct.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#include "report.h"

/* Jumps of derivatives count from here, relative to the size of the values: rounding. */
static const double smooth = 1e-12;

static const char fault_breaks[] = "break points of a power-basis %s do not rise";

/* Segments of one direction and the knots they want. */
struct pieces {
	const double *breaks;
	int segments, degree;
	int *multiplicity; /* of each break; owned */
	double *knots;     /* owned */
	int n;             /* control points */
};

static void pieces_finish(struct pieces *p)
{
	free(p->multiplicity);
	free(p->knots);
}

static bool rising(const double *breaks, int segments)
{
	for (int i = 0; i <= segments; i++)
		if (!isfinite(breaks[i]) || (i > 0 && !(breaks[i] > breaks[i - 1])))
			return false;
	return true;
}

static enum status pieces_init(struct pieces *p, const double *breaks, int segments, int degree)
{
	*p = (struct pieces){ .breaks = breaks, .segments = segments, .degree = degree };
	p->multiplicity = calloc((size_t)segments + 1, sizeof *p->multiplicity);
	return p->multiplicity ? ST_OK : ST_RESOURCE;
}

/* With the multiplicities set: knots and number of points. */
static enum status pieces_knots(struct pieces *p)
{
	int m = 0;
	p->multiplicity[0] = p->multiplicity[p->segments] = p->degree + 1;
	p->knots = malloc(((size_t)p->segments + 1) * ((size_t)p->degree + 1) * sizeof *p->knots);
	if (!p->knots)
		return ST_RESOURCE;
	for (int i = 0; i <= p->segments; i++)
		for (int k = 0; k < p->multiplicity[i]; k++)
			p->knots[m++] = p->breaks[i];
	p->n = m - p->degree - 1;
	return ST_OK;
}

/* Derivative k of a0 + a1 t + a2 t^2 + a3 t^3 at t, over k!. */
static double taylor(const double a[4], int k, double t)
{
	static const double binomial[4][4] = {
		{ 1, 1, 1, 1 }, { 0, 1, 2, 3 }, { 0, 0, 1, 3 }, { 0, 0, 0, 1 }
	};
	double sum = 0, power = 1;
	for (int i = k; i < 4; i++, power *= t)
		sum += binomial[k][i] * a[i] * power;
	return sum;
}

/*
 * Largest effect that the jump of derivative k between two neighbours has on the shape of either:
 * the jump over k! times the longer one's length to the power k.
 */
static double jump(const double left[4], const double right[4], int k, double length, double next)
{
	double h = fmax(length, next);
	return fabs(taylor(left, k, length) - right[k]) * pow(h, k);
}

/* Blossom of a cubic in power form at p arguments measured from its start. */
static double blossom(const double a[4], int p, const double *t)
{
	switch (p) {
	case 1:
		return a[0] + a[1] * t[0];
	case 2:
		return a[0] + a[1] * (t[0] + t[1]) / 2 + a[2] * t[0] * t[1];
	default:
		return a[0] + a[1] * (t[0] + t[1] + t[2]) / 3 +
		       a[2] * (t[0] * t[1] + t[1] * t[2] + t[2] * t[0]) / 3 +
		       a[3] * t[0] * t[1] * t[2];
	}
}

/* Segments whose blossom gives point i: the one in the middle of its arguments; both neighbours
 * where all arguments are one break, for those may differ within the tolerance. */
static int owners(const struct pieces *p, int i, int out[2])
{
	const double *t = p->knots + i + 1;
	double middle = (t[0] + t[p->degree - 1]) / 2;
	int lo = 0, hi = p->segments;
	while (hi - lo > 1) {
		int mid = (lo + hi) / 2;
		if (p->breaks[mid] <= middle)
			lo = mid;
		else
			hi = mid;
	}
	out[0] = lo;
	if (t[0] == t[p->degree - 1] && lo > 0 && p->breaks[lo] == t[0]) {
		out[1] = lo - 1;
		return 2;
	}
	return 1;
}

static void local_arguments(const struct pieces *p, int i, int segment, double out[3])
{
	for (int k = 0; k < p->degree; k++)
		out[k] = p->knots[i + 1 + k] - p->breaks[segment];
}

static double power_length(const struct pieces *p, int i)
{
	return p->breaks[i + 1] - p->breaks[i];
}

/* Largest value the segment's terms reach: what rounding is relative to. */
static double reach(const double a[4], double h)
{
	return fabs(a[0]) + h * (fabs(a[1]) + h * (fabs(a[2]) + h * fabs(a[3])));
}

/* The larger; infinite where x is no number. */
static double grow(double size, double x)
{
	if (!isfinite(x))
		return INFINITY;
	return x > size ? x : size;
}

/* Multiplicity of a break where derivatives 0 .. join - 1 agree; one knot stays where all do, so
 * that no blossom is taken further away than a neighbour. */
static int break_multiplicity(int degree, int join)
{
	int m = degree + 1 - join;
	return m < 1 ? 1 : m > degree ? degree : m;
}

enum status make_power_curve(struct curve *out, const double *breaks, int segments,
                             const double (*c)[3][4], double tolerance, const struct report *r)
{
	if (segments < 1 || !rising(breaks, segments))
		return report_error(r, ST_PARAMETER, fault_breaks, "curve");
	int degree = 1;
	double size = 0;
	for (int i = 0; i < segments; i++) {
		for (int d = 0; d < 3; d++) {
			size = grow(size, reach(c[i][d], breaks[i + 1] - breaks[i]));
			for (int k = degree + 1; k < 4; k++)
				if (c[i][d][k] != 0)
					degree = k;
		}
	}
	if (!isfinite(size))
		return report_error(r, ST_PARAMETER, "a power-basis curve is not finite");
	struct pieces p;
	enum status st = pieces_init(&p, breaks, segments, degree);
	for (int i = 1; i < segments && st == ST_OK; i++) {
		int join = 0;
		for (bool same = true; same && join <= degree; join += same) {
			double worst = 0;
			for (int d = 0; d < 3; d++)
				worst = fmax(worst,
				             jump(c[i - 1][d], c[i][d], join,
				                  power_length(&p, i - 1), power_length(&p, i)));
			same = worst <= smooth * size;
			if (join == 0 && !same && !(worst <= tolerance))
				st = report_error(
				        r, ST_PARAMETER,
				        "segments %d and %d of a power-basis curve are %g "
				        "apart, expected at most %g",
				        i, i + 1, worst, tolerance);
		}
		p.multiplicity[i] = break_multiplicity(degree, join);
	}
	if (st == ST_OK)
		st = pieces_knots(&p);
	if (st == ST_OK)
		st = curve_init(out, degree + 1, p.n);
	for (int i = 0; i < p.n && st == ST_OK; i++) {
		int own[2], n_own = owners(&p, i, own);
		double x[3] = { 0, 0, 0 };
		for (int o = 0; o < n_own; o++) {
			double t[3];
			local_arguments(&p, i, own[o], t);
			for (int d = 0; d < 3; d++)
				x[d] += blossom(c[own[o]][d], degree, t) / n_own;
		}
		curve_set_point(out, i, vec3(x[0], x[1], x[2]), 1);
	}
	if (st == ST_OK) {
		memcpy(out->knots, p.knots, (size_t)(p.n + degree + 1) * sizeof *p.knots);
		out->domain[0] = breaks[0];
		out->domain[1] = breaks[segments];
	}
	pieces_finish(&p);
	return st;
}

/* A surface's patches: coefficient of u^k v^l is c[i * nv + j][dim][k + 4 l]. */
struct patches {
	struct pieces p[2];
	const double (*c)[3][16];
	double size;
};

/* Coefficients of direction d with the other's power l, of patch (at, across). */
static void patch_line(const struct patches *s, int d, int at, int across, int dim, int l,
                       double out[4])
{
	int i = d == 0 ? at : across, j = d == 0 ? across : at;
	const double *c = s->c[(size_t)i * s->p[1].segments + j][dim];
	for (int k = 0; k < 4; k++)
		out[k] = d == 0 ? c[k + 4 * l] : c[l + 4 * k];
}

/* Largest jump of derivative k over break i of direction d. */
static double patch_jump(const struct patches *s, int d, int i, int k)
{
	const struct pieces *p = &s->p[d], *q = &s->p[1 - d];
	double worst = 0;
	for (int across = 0; across < q->segments; across++) {
		for (int dim = 0; dim < 3; dim++) {
			double sum = 0, h = 1;
			for (int l = 0; l <= q->degree; l++, h *= power_length(q, across)) {
				double left[4], right[4];
				patch_line(s, d, i - 1, across, dim, l, left);
				patch_line(s, d, i, across, dim, l, right);
				sum += h * jump(left, right, k, power_length(p, i - 1),
				                power_length(p, i));
			}
			worst = fmax(worst, sum);
		}
	}
	return worst;
}

static enum status patch_joins(struct patches *s, int d, double tolerance, const struct report *r)
{
	struct pieces *p = &s->p[d];
	for (int i = 1; i < p->segments; i++) {
		int join = 0;
		for (bool same = true; same && join <= p->degree; join += same) {
			double worst = patch_jump(s, d, i, join);
			same = worst <= smooth * s->size;
			if (join == 0 && !same && !(worst <= tolerance))
				return report_error(r, ST_PARAMETER,
				                    "patches %d and %d in %c of a power-basis "
				                    "surface are %g apart, expected at most %g",
				                    i, i + 1, "uv"[d], worst, tolerance);
		}
		p->multiplicity[i] = break_multiplicity(p->degree, join);
	}
	return ST_OK;
}

static struct vec3 patch_point(const struct patches *s, int i, int j)
{
	int own_u[2], own_v[2];
	int mu = owners(&s->p[0], i, own_u), mv = owners(&s->p[1], j, own_v);
	double x[3] = { 0, 0, 0 };
	for (int a = 0; a < mu; a++) {
		for (int b = 0; b < mv; b++) {
			double tu[3], tv[3];
			local_arguments(&s->p[0], i, own_u[a], tu);
			local_arguments(&s->p[1], j, own_v[b], tv);
			for (int dim = 0; dim < 3; dim++) {
				double in_v[4] = { 0, 0, 0, 0 };
				for (int l = 0; l <= s->p[1].degree; l++) {
					double line[4];
					patch_line(s, 0, own_u[a], own_v[b], dim, l, line);
					in_v[l] = blossom(line, s->p[0].degree, tu);
				}
				x[dim] += blossom(in_v, s->p[1].degree, tv) / (mu * mv);
			}
		}
	}
	return vec3(x[0], x[1], x[2]);
}

/* Degrees in u and v, and the size of all values. */
static void measure(struct patches *s, const double *u, int nu, const double *v, int nv,
                    int degree[2])
{
	degree[0] = degree[1] = 1;
	s->size = 0;
	for (int i = 0; i < nu * nv; i++) {
		for (int dim = 0; dim < 3; dim++) {
			double sum = 0, hu = u[i / nv + 1] - u[i / nv],
			       hv = v[i % nv + 1] - v[i % nv];
			for (int l = 0; l < 4; l++)
				sum += pow(hv, l) * reach(s->c[i][dim] + 4 * l, hu);
			s->size = grow(s->size, sum);
			for (int k = 0; k < 16; k++) {
				if (s->c[i][dim][k] == 0)
					continue;
				degree[0] = k % 4 > degree[0] ? k % 4 : degree[0];
				degree[1] = k / 4 > degree[1] ? k / 4 : degree[1];
			}
		}
	}
}

enum status make_power_surface(struct surface *out, const double *u, int nu, const double *v,
                               int nv, const double (*c)[3][16], double tolerance,
                               const struct report *r)
{
	if (nu < 1 || nv < 1 || !rising(u, nu) || !rising(v, nv))
		return report_error(r, ST_PARAMETER, fault_breaks, "surface");
	struct patches s = { .c = c };
	int degree[2];
	measure(&s, u, nu, v, nv, degree);
	if (!isfinite(s.size))
		return report_error(r, ST_PARAMETER, "a power-basis surface is not finite");
	enum status st = pieces_init(&s.p[0], u, nu, degree[0]);
	if (st == ST_OK)
		st = pieces_init(&s.p[1], v, nv, degree[1]);
	for (int d = 0; d < 2 && st == ST_OK; d++)
		st = patch_joins(&s, d, tolerance, r);
	for (int d = 0; d < 2 && st == ST_OK; d++)
		st = pieces_knots(&s.p[d]);
	if (st == ST_OK)
		st = surface_init(out, (int[2]){ degree[0] + 1, degree[1] + 1 },
		                  (int[2]){ s.p[0].n, s.p[1].n });
	for (int i = 0; i < s.p[0].n && st == ST_OK; i++)
		for (int j = 0; j < s.p[1].n; j++)
			surface_set_point(out, i, j, patch_point(&s, i, j), 1);
	for (int d = 0; d < 2 && st == ST_OK; d++) {
		const struct pieces *p = &s.p[d];
		memcpy(out->knots[d], p->knots, (size_t)(p->n + p->degree + 1) * sizeof *p->knots);
		out->domain[d][0] = p->breaks[0];
		out->domain[d][1] = p->breaks[p->segments];
	}
	pieces_finish(&s.p[0]);
	pieces_finish(&s.p[1]);
	return st;
}
