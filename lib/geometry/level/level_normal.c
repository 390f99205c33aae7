/* level_normal.c - the surface normal in Bernstein form on every patch, and what lies between
 * patches.
 *
 * N = Su x Sv up to a positive factor; for X = (w S, w) that is w Xu x Xv - wv Xu x X - wu X x Xv,
 * a polynomial. Derivatives are taken in a parameter that runs over [0, 1] on the whole surface, so
 * that they agree over knot lines. A factor that vanishes on a border that is one point (a pole) is
 * taken out there.
 */
#include "level_form.h"
#include "level_private.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { X = 0, U = 4, V = 8, FORMS = 12, EDGE_SAMPLES = 7 };

/* Borders that differ by less, as a part of the size, do meet: what files with seven digits keep of
 * a closed surface. */
#define GAP_SHARE 1e-6

/* Derivatives that differ by less over a knot line are the same. */
#define SLOPE_SHARE 1e-9

struct maker {
	const struct level_surface *s;
	double center[3];
	const double *points; /* of the patch */
	size_t room;          /* doubles a form */
	double *x;            /* FORMS forms of the surface and its derivatives, scaled */
	double *n[3];         /* the normal */
	struct bound normal;  /* its size is that of the terms that it is a sum of */
	double *cross;        /* U x V, U x X or X x V, one component */
};

static int degree_of(const struct level_surface *s, int form, int d)
{
	int p = s->net.order[d] - 1;
	return form >= V ? p - (d == 1) : form >= U ? p - (d == 0) : p;
}

/* Largest number in forms f .. f + n - 1. */
static double forms_most(const struct maker *k, int f, int n)
{
	double most = 0;
	for (int i = 0; i < n; i++) {
		size_t count = (size_t)(degree_of(k->s, f, 0) + 1) * (degree_of(k->s, f, 1) + 1);
		most = larger(most, form_most(k->x + k->room * (f + i), count));
	}
	return most;
}

/* Of each component, from the sizes of the surface's forms; hu, hv are what differences were
 * multiplied by. */
static struct bound normal_bound(const struct maker *k, double hu, double hv)
{
	const struct level_surface *s = k->s;
	const double h[FORMS / 4] = { 1, 2 * hu, 2 * hv }; /* a difference has two errors */
	/* moved to the centre and turned into the frame: four numbers each */
	const double away = vec3_length(vec3_of(k->center));
	struct bound points, weights;
	level_patch_bounds(s, k->points, &points, &weights);
	double moved = larger(points.size, away * weights.size);
	double error = 2 * (points.error + weights.error * away) + 16 * UNIT_ROUNDOFF * moved;
	struct bound x[FORMS / 4], w[FORMS / 4], sum = { 0 };
	int m = s->degree[0], n = s->degree[1];
	for (int g = 0; g < FORMS / 4; g++) {
		x[g].size = forms_most(k, 4 * g, 3);
		x[g].error = h[g] * error + 8 * UNIT_ROUNDOFF * x[g].size;
		w[g].size = forms_most(k, 4 * g + 3, 1);
		w[g].error = h[g] * weights.error + 8 * UNIT_ROUNDOFF * w[g].size;
	}
	if (!s->net.rational) {
		sum = bound_product(x[U / 4], x[V / 4], m, n);
		return bound_sum(sum, 1, sum);
	}
	static const int term[3][3] = { { U, V, X }, { U, X, V }, { X, V, U } };
	for (int i = 0; i < 3; i++) {
		struct bound c = bound_product(x[term[i][0] / 4], x[term[i][1] / 4], m, n);
		c = bound_product(bound_sum(c, 1, c), w[term[i][2] / 4], m, n);
		sum = bound_sum(sum, 1, c);
	}
	return sum;
}

static void load(struct maker *k, int patch)
{
	const struct level_surface *s = k->s;
	const struct bezier_net *net = &s->net;
	int p = net->order[0] - 1, q = net->order[1] - 1;
	int i0 = patch / net->spans[1], j0 = patch % net->spans[1];
	const double *a = net->breaks[0], *b = net->breaks[1];
	double hu = p * (a[net->spans[0]] - a[0]) / (a[i0 + 1] - a[i0]);
	double hv = q * (b[net->spans[1]] - b[0]) / (b[j0 + 1] - b[j0]);
	const double *c = k->points = bezier_patch(net, i0, j0);
	for (int i = 0; i < (p + 1) * (q + 1); i++, c += 4) {
		double r[3];
		for (int d = 0; d < 3; d++)
			r[d] = c[d] - k->center[d] * c[3];
		for (int d = 0; d < 3; d++)
			k->x[k->room * d + i] = s->frame[d][0] * r[0] + s->frame[d][1] * r[1] +
			                        s->frame[d][2] * r[2];
		k->x[k->room * 3 + i] = c[3];
	}
	for (int d = 0; d < 4; d++) {
		double *x = k->x + k->room * d, *du = x + k->room * U, *dv = x + k->room * V;
		for (int i = 0; i < p; i++)
			for (int j = 0; j <= q; j++)
				du[i * (q + 1) + j] =
				        hu * (x[(i + 1) * (q + 1) + j] - x[i * (q + 1) + j]);
		for (int i = 0; i <= p; i++)
			for (int j = 0; j < q; j++)
				dv[i * q + j] = hv * (x[i * (q + 1) + j + 1] - x[i * (q + 1) + j]);
	}
	k->normal = normal_bound(k, hu, hv);
	for (int f = 0; f < FORMS; f++)
		form_scale(k->x + k->room * f, degree_of(s, f, 0), degree_of(s, f, 1), s->binomial,
		           false);
}

/* out += weight (A x B)_i, A and B groups of forms. */
static void cross_add(const struct maker *k, int a, int b, int i, double *out)
{
	const struct level_surface *s = k->s;
	int j = (i + 1) % 3, l = (i + 2) % 3;
	int am = degree_of(s, a, 0), an = degree_of(s, a, 1);
	int bm = degree_of(s, b, 0), bn = degree_of(s, b, 1);
	const double *x = k->x;
	form_product(x + k->room * (a + j), am, an, x + k->room * (b + l), bm, bn, 1, out);
	form_product(x + k->room * (a + l), am, an, x + k->room * (b + j), bm, bn, -1, out);
}

/* out += sign (A x B)_i w, w one of the weights' forms. */
static void term_add(const struct maker *k, int a, int b, int w, double sign, int i, double *out)
{
	const struct level_surface *s = k->s;
	int m = degree_of(s, a, 0) + degree_of(s, b, 0),
	    n = degree_of(s, a, 1) + degree_of(s, b, 1);
	memset(k->cross, 0, sizeof(double) * (m + 1) * (n + 1));
	cross_add(k, a, b, i, k->cross);
	form_product(k->cross, m, n, k->x + k->room * (w + 3), degree_of(s, w, 0),
	             degree_of(s, w, 1), sign, out);
}

/* The normal vanishes on a whole side of the patch: its factor out, at most twice. */
static void take_out_factors(struct maker *k, unsigned char *factors)
{
	int m = k->s->degree[0], n = k->s->degree[1];
	for (int side = 0; side < 8; side++) {
		int d = side / 4, upper = side / 2 % 2;
		double most = 0, most_side = 0;
		for (int c = 0; c < 3; c++)
			for (int i = 0; i <= m; i++)
				for (int j = 0; j <= n; j++) {
					double x = fabs(k->n[c][i * (n + 1) + j]);
					int at = d == 0 ? i : j, end = upper ? (d == 0 ? m : n) : 0;
					most = larger(most, x);
					if (at == end)
						most_side = larger(most_side, x);
				}
		if (most_side > ZERO_SHARE * most || most == 0)
			continue;
		for (int c = 0; c < 3; c++) {
			form_scale(k->n[c], m, n, k->s->binomial, false);
			form_divide(k->n[c], m, n, d, upper);
			form_scale(k->n[c], m, n, k->s->binomial, true);
		}
		factors[2 * d + upper]++;
		/* a coefficient that had the number i of n has now n / i of its error */
		k->normal.error *= (d == 0 ? m : n) + 1;
	}
}

/* A patch without area has no normal, only rounding. */
static void take_out_noise(const struct maker *k, size_t count)
{
	double most = 0;
	for (int i = 0; i < 3; i++)
		for (size_t c = 0; c < count; c++)
			most = larger(most, fabs(k->n[i][c]));
	if (most <= larger(ZERO_SHARE * k->normal.size, k->normal.error))
		for (int i = 0; i < 3; i++)
			memset(k->n[i], 0, sizeof(double) * count);
}

static void normal_make(struct maker *k, int patch)
{
	const struct level_surface *s = k->s;
	size_t count = (size_t)(s->degree[0] + 1) * (s->degree[1] + 1);
	double *out = s->normals + level_normals_size(s) * patch;
	load(k, patch);
	for (int i = 0; i < 3; i++) {
		memset(k->n[i], 0, sizeof(double) * count);
		if (!s->net.rational) {
			cross_add(k, U, V, i, k->n[i]);
			continue;
		}
		term_add(k, U, V, X, 1, i, k->n[i]);
		term_add(k, U, X, V, -1, i, k->n[i]);
		term_add(k, X, V, U, -1, i, k->n[i]);
	}
	for (int i = 0; i < 3; i++)
		form_scale(k->n[i], s->degree[0], s->degree[1], s->binomial, true);
	take_out_noise(k, count);
	take_out_factors(k, s->factors + (size_t)4 * patch);
	for (int i = 0; i < 3; i++) {
		for (size_t c = 0; c < count; c++)
			out[4 * c + i] = k->n[i][c];
	}
	s->normal_error[patch] = k->normal.error;
}

enum status level_normals(struct level_surface *s)
{
	const struct bezier_net *net = &s->net;
	int patches = net->spans[0] * net->spans[1];
	struct maker k = { .s = s };
	size_t points = (size_t)patches * net->order[0] * net->order[1];
	struct vec3 lo = vec3(INFINITY, INFINITY, INFINITY), hi = vec3_scale(lo, -1);
	for (size_t i = 0; i < points; i++) {
		const double *p = net->points + 4 * i;
		lo = vec3(smaller(lo.x, p[0] / p[3]), smaller(lo.y, p[1] / p[3]),
		          smaller(lo.z, p[2] / p[3]));
		hi = vec3(larger(hi.x, p[0] / p[3]), larger(hi.y, p[1] / p[3]),
		          larger(hi.z, p[2] / p[3]));
	}
	k.center[0] = 0.5 * (lo.x + hi.x);
	k.center[1] = 0.5 * (lo.y + hi.y);
	k.center[2] = 0.5 * (lo.z + hi.z);
	k.room = (size_t)(s->degree[0] + 1) * (s->degree[1] + 1);
	free(s->normals);
	free(s->normal_error);
	free(s->factors);
	s->normals = calloc((size_t)patches, sizeof(double) * level_normals_size(s));
	s->factors = calloc((size_t)patches, 4);
	k.x = calloc((FORMS + 4) * k.room, sizeof(double));
	s->normal_error = calloc((size_t)patches, sizeof(double));
	if (!s->normals || !s->normal_error || !s->factors || !k.x) {
		free(k.x);
		return ST_RESOURCE;
	}
	for (int i = 0; i < 3; i++)
		k.n[i] = k.x + k.room * (FORMS + i);
	k.cross = k.x + k.room * (FORMS + 3);
	for (int patch = 0; patch < patches; patch++)
		normal_make(&k, patch);
	free(k.x);
	return ST_OK;
}

size_t level_edge(const struct level_surface *s, int d, int i, int j)
{
	return d == 0 ? (size_t)i * s->net.spans[1] + j : (size_t)i * (s->net.spans[1] + 1) + j;
}

/* Coefficients on one side of a patch: first, step between them. */
struct side {
	double *c;
	size_t step;
	int degree;
};

static struct side side_of(double *patch, const int degree[2], int d, bool upper)
{
	size_t row = (size_t)4 * (degree[1] + 1);
	if (d == 0)
		return (struct side){ patch + (upper ? row * degree[0] : 0), 4, degree[1] };
	return (struct side){ patch + (upper ? (size_t)4 * degree[1] : 0), row, degree[0] };
}

static struct vec3 side_at(const struct side *s, const double *b)
{
	struct vec3 r = { 0 };
	for (int i = 0; i <= s->degree; i++) {
		const double *c = s->c + s->step * i;
		r = vec3_along(r, b[i], vec3(c[0], c[1], c[2]));
	}
	return r;
}

/* Largest difference of two sides, and in *size their largest number. */
static double side_difference(const struct side *a, const struct side *b, double *size)
{
	double most = 0;
	*size = 0;
	for (int i = 0; i <= a->degree; i++)
		for (int c = 0; c < 4; c++) {
			double x = a->c[a->step * i + c], y = b->c[b->step * i + c];
			most = larger(most, fabs(x - y));
			*size = larger(*size, larger(fabs(x), fabs(y)));
		}
	return most;
}

static bool smooth_at(const struct side *a, const struct side *b, double t)
{
	double w[NORMAL_DEGREE_MAX + 1];
	bernstein(a->degree + 1, t, w, NULL);
	struct vec3 x = vec3_unit(side_at(a, w)), y = vec3_unit(side_at(b, w));
	return vec3_length(vec3_sub(x, y)) <= SMOOTH_ANGLE;
}

static bool side_smooth(const struct side *a, const struct side *b)
{
	for (int i = 0; i < EDGE_SAMPLES; i++)
		if (!smooth_at(a, b, (i + 0.5) / EDGE_SAMPLES))
			return false;
	return true;
}

/* The patches below and above a line, the two ends of a seam being one line. */
static void patches_at(const struct level_surface *s, int d, int line, int along, int patch[2])
{
	int lines = s->net.spans[d], across = s->net.spans[1 - d];
	int at[2] = { line > 0 ? line - 1 : lines - 1, line < lines ? line : 0 };
	for (int k = 0; k < 2; k++)
		patch[k] = d == 0 ? at[k] * across + along : along * lines + at[k];
}

bool level_smooth_at(const struct level_surface *s, int d, int line, int along, double at)
{
	int patch[2];
	patches_at(s, d, line, along, patch);
	struct side a = side_of(s->normals + level_normals_size(s) * patch[0], s->degree, d, true);
	struct side b = side_of(s->normals + level_normals_size(s) * patch[1], s->degree, d, false);
	bool smooth = smooth_at(&a, &b, at);
	/* for want of memory it is one */
	if (smooth && s->kind == LEVEL_CURVATURE &&
	    level_curvature_agrees(s, patch, d, &at, 1, &smooth) != ST_OK)
		return false;
	return smooth;
}

static enum edge_kind edge_between(struct level_surface *s, int lower, int upper, int d)
{
	const struct bezier_net *net = &s->net;
	int degree[2] = { net->order[0] - 1, net->order[1] - 1 };
	size_t size = bezier_patch_size(net);
	double most;
	struct side a = side_of(net->points + size * lower, degree, d, true);
	struct side b = side_of(net->points + size * upper, degree, d, false);
	double gap = side_difference(&a, &b, &most);
	if (gap > GAP_SHARE * larger(net->size, most))
		return EDGE_GAP;
	if (!level_needs_normals(s->kind))
		return gap == 0 ? EDGE_SHARED : EDGE_SMOOTH;
	a = side_of(s->normals + level_normals_size(s) * lower, s->degree, d, true);
	b = side_of(s->normals + level_normals_size(s) * upper, s->degree, d, false);
	gap = side_difference(&a, &b, &most);
	if (gap <= 1e-10 * most) {
		/* a surface whose normals do agree is not further off than this */
		s->normal_error[upper] += gap;
		for (int i = 0; i <= a.degree; i++)
			memcpy(b.c + b.step * i, a.c + a.step * i, sizeof(double[4]));
		return EDGE_SHARED;
	}
	return side_smooth(&a, &b) ? EDGE_SMOOTH : EDGE_CREASE;
}

/* The first difference across a side, as a derivative by the surface's parameter, is the same on
 * the other side: `row` doubles of each coefficient, `width` those of the two spans. */
static bool slopes_agree(const struct side *a, const struct side *b, ptrdiff_t inwards,
                         const double width[2])
{
	double off = 0, most = 0;
	for (int i = 0; i <= a->degree; i++)
		for (int c = 0; c < 4; c++) {
			const double *x = a->c + a->step * i + c, *y = b->c + b->step * i + c;
			double below = (x[0] - *(x - inwards)) / width[0];
			double above = (y[inwards] - y[0]) / width[1];
			off = larger(off, fabs(below - above));
			most = larger(most, larger(fabs(below), fabs(above)));
		}
	return off <= SLOPE_SHARE * most;
}

/* The derivatives of f may jump: a curve that touches the line need not go on as it came. */
static bool edge_bent(const struct level_surface *s, int lower, int upper, int d)
{
	const struct bezier_net *net = &s->net;
	int degree[2] = { net->order[0] - 1, net->order[1] - 1 }, at[2] = { lower, upper };
	size_t size = bezier_patch_size(net), row = d == 0 ? (size_t)4 * net->order[1] : 4;
	double width[2];
	for (int k = 0; k < 2; k++) {
		int place = d == 0 ? at[k] / net->spans[1] : at[k] % net->spans[1];
		width[k] = net->breaks[d][place + 1] - net->breaks[d][place];
	}
	struct side a = side_of(net->points + size * lower, degree, d, true);
	struct side b = side_of(net->points + size * upper, degree, d, false);
	if (!slopes_agree(&a, &b, (ptrdiff_t)row, width))
		return true;
	if (!level_needs_normals(s->kind))
		return false;
	row = d == 0 ? (size_t)4 * (s->degree[1] + 1) : 4;
	a = side_of(s->normals + level_normals_size(s) * lower, s->degree, d, true);
	b = side_of(s->normals + level_normals_size(s) * upper, s->degree, d, false);
	return !slopes_agree(&a, &b, (ptrdiff_t)row, width);
}

/* The points on one side of a patch are one point. */
static enum edge_kind edge_outside(const struct level_surface *s, int patch, int d, bool upper)
{
	const struct bezier_net *net = &s->net;
	int degree[2] = { net->order[0] - 1, net->order[1] - 1 };
	struct side a = side_of(net->points + bezier_patch_size(net) * patch, degree, d, upper);
	for (int i = 1; i <= a.degree; i++)
		for (int c = 0; c < 3; c++) {
			const double *p = a.c + a.step * i;
			if (fabs(p[c] / p[3] - a.c[c] / a.c[3]) > 1e-9 * net->size)
				return EDGE_BORDER;
		}
	return EDGE_POLE;
}

/* The two ends of direction d meet, if not as nearly as the net asks for. */
static bool ends_meet(const struct level_surface *s, int d)
{
	const struct bezier_net *net = &s->net;
	int degree[2] = { net->order[0] - 1, net->order[1] - 1 };
	size_t size = bezier_patch_size(net);
	double most;
	for (int a = 0; a < net->spans[1 - d]; a++) {
		int patch[2];
		patches_at(s, d, 0, a, patch);
		struct side x = side_of(net->points + size * patch[0], degree, d, true);
		struct side y = side_of(net->points + size * patch[1], degree, d, false);
		if (side_difference(&x, &y, &most) > GAP_SHARE * larger(net->size, most))
			return false;
	}
	return true;
}

/* Curvatures may jump where normals do not. */
static enum status edge_curved(const struct level_surface *s, const int patch[2], int d,
                               enum edge_kind *kind)
{
	double at[EDGE_SAMPLES];
	bool agrees;
	if (s->kind != LEVEL_CURVATURE || (*kind != EDGE_SHARED && *kind != EDGE_SMOOTH))
		return ST_OK;
	for (int i = 0; i < EDGE_SAMPLES; i++)
		at[i] = (i + 0.5) / EDGE_SAMPLES;
	enum status st = level_curvature_agrees(s, patch, d, at, EDGE_SAMPLES, &agrees);
	*kind = agrees ? EDGE_SMOOTH : EDGE_CREASE;
	return st;
}

/*
 * Say what every edge is, and make shared sides equal: first over all lines of u, then of v, each
 * from the lower patch to the upper, so that all patches round a corner have the same number there.
 */
enum status level_edges(struct level_surface *s)
{
	const struct bezier_net *net = &s->net;
	for (int d = 0; d < 2; d++) {
		int lines = net->spans[d], across = net->spans[1 - d];
		s->net.closed[d] = net->closed[d] || ends_meet(s, d);
		for (int line = 0; line <= lines; line++)
			for (int a = 0; a < across; a++) {
				int patch[2];
				patches_at(s, d, line, a, patch);
				bool inside = (line > 0 && line < lines) || net->closed[d];
				enum edge_kind k = inside ? edge_between(s, patch[0], patch[1], d)
				                   : line == 0 ? edge_outside(s, patch[1], d, false)
				                               : edge_outside(s, patch[0], d, true);
				enum status st = inside ? edge_curved(s, patch, d, &k) : ST_OK;
				if (st != ST_OK)
					return st;
				size_t at = d == 0 ? level_edge(s, 0, line, a)
				                   : level_edge(s, 1, a, line);
				s->edges[d][at] = k;
				s->bent[d][at] = !inside || s->kind == LEVEL_CURVATURE ||
				                 edge_bent(s, patch[0], patch[1], d);
			}
	}
	return ST_OK;
}
