/* level_normal.c - the surface normal in Bernstein form on every patch.
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

/* The surface, its derivatives: forms of four numbers a coefficient. */
enum { X, U, V, N_FORMS };

struct maker {
	const struct level_surface *s;
	double center[3];
	const double *points; /* of the patch */
	double *x[N_FORMS];   /* scaled */
	double *cross;        /* U x V, U x X or X x V */
	struct bound normal;  /* its size is that of the terms that it is a sum of */
};

static int degree_of(const struct level_surface *s, int form, int d)
{
	return s->net.order[d] - 1 - (form == U + d);
}

/* The largest number of the first three, and of the fourth, of each coefficient. */
static void most4(const double *c, size_t count, double out[2])
{
	double most[4] = { 0 };
	for (size_t i = 0; i < count; i++)
		for (int d = 0; d < 4; d++)
			most[d] = larger(most[d], fabs(c[4 * i + d]));
	out[0] = larger(larger(most[0], most[1]), most[2]);
	out[1] = most[3];
}

/* Of each component, from the sizes of the surface's forms; hu, hv are what differences were
 * multiplied by. */
static struct bound normal_bound(const struct maker *k, double hu, double hv)
{
	const struct level_surface *s = k->s;
	const double h[N_FORMS] = { 1, 2 * hu, 2 * hv }; /* a difference has two errors */
	/* moved to the centre and turned into the frame: four numbers each */
	const double away = vec3_length(vec3_of(k->center));
	struct bound points, weights;
	level_patch_bounds(s, k->points, &points, &weights);
	double moved = larger(points.size, away * weights.size);
	double error = 2 * (points.error + weights.error * away) + 16 * UNIT_ROUNDOFF * moved;
	double turned = 8 * UNIT_ROUNDOFF;
	if (!s->net.rational) { /* differences are turned, not points, and their size counts */
		error = 2 * points.error;
		turned = 32 * UNIT_ROUNDOFF;
	}
	struct bound x[N_FORMS], w[N_FORMS], sum = { 0 };
	int m = s->degree[0], n = s->degree[1];
	for (int g = 0; g < N_FORMS; g++) {
		double most[2];
		most4(k->x[g], (size_t)(degree_of(s, g, 0) + 1) * (degree_of(s, g, 1) + 1), most);
		x[g] = (struct bound){ most[0], h[g] * error + turned * most[0] };
		w[g] = (struct bound){ most[1],
			               h[g] * weights.error + 8 * UNIT_ROUNDOFF * most[1] };
	}
	if (!s->net.rational) {
		sum = bound_product(x[U], x[V], m, n);
		return bound_sum(sum, 1, sum);
	}
	static const int term[3][3] = { { U, V, X }, { U, X, V }, { X, V, U } };
	for (int i = 0; i < 3; i++) {
		struct bound c = bound_product(x[term[i][0]], x[term[i][1]], m, n);
		c = bound_product(bound_sum(c, 1, c), w[term[i][2]], m, n);
		sum = bound_sum(sum, 1, c);
	}
	return sum;
}

/* Into the frame. */
static void turn(const struct level_surface *s, double x[3])
{
	const double r[3] = { x[0], x[1], x[2] };
	for (int d = 0; d < 3; d++) {
		const double *f = s->frame[d];
		x[d] = f[0] * r[0] + f[1] * r[1] + f[2] * r[2];
	}
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
	double *x = k->x[X], *u = k->x[U], *v = k->x[V];
	memcpy(x, c, sizeof *x * bezier_patch_size(net));
	for (int i = 0; net->rational && i < (p + 1) * (q + 1); i++) {
		for (int d = 0; d < 3; d++)
			x[4 * i + d] -= k->center[d] * x[4 * i + 3];
		turn(s, x + 4 * i);
	}
	const size_t row = (size_t)4 * (q + 1);
	for (size_t i = 0; i < row * p; i++)
		u[i] = hu * (x[i + row] - x[i]);
	for (int i = 0; i <= p; i++, x += 4)
		for (int j = 0; j < 4 * q; j++, x++)
			*v++ = hv * (x[4] - x[0]);
	for (int i = 0; !net->rational && i < p * (q + 1); i++)
		turn(s, k->x[U] + 4 * i);
	for (int i = 0; !net->rational && i < (p + 1) * q; i++)
		turn(s, k->x[V] + 4 * i);
	k->normal = normal_bound(k, hu, hv);
	for (int f = 0; f < N_FORMS; f++)
		form_scale4(k->x[f], degree_of(s, f, 0), degree_of(s, f, 1), s->binomial, false);
}

/* out += sign (A x B) w, w the weights of a form. */
static void term_add(const struct maker *k, int a, int b, int w, double sign, double *out)
{
	const struct level_surface *s = k->s;
	int m = degree_of(s, a, 0) + degree_of(s, b, 0),
	    n = degree_of(s, a, 1) + degree_of(s, b, 1);
	memset(k->cross, 0, sizeof(double[4]) * (m + 1) * (n + 1));
	form_cross4(k->x[a], degree_of(s, a, 0), degree_of(s, a, 1), k->x[b], degree_of(s, b, 0),
	            degree_of(s, b, 1), k->cross);
	form_weigh4(k->cross, m, n, k->x[w] + 3, degree_of(s, w, 0), degree_of(s, w, 1), sign, out);
}

/* The largest component: on the sides (2 d + upper), of all. */
enum { SIDES = 4 };
static double sides_most(const double *c, int m, int n, double side[SIDES])
{
	double most = 0;
	memset(side, 0, sizeof *side * SIDES);
	for (int i = 0; i <= m; i++)
		for (int j = 0; j <= n; j++, c += 4) {
			double x = larger(larger(fabs(c[0]), fabs(c[1])), fabs(c[2]));
			const bool on[SIDES] = { i == 0, i == m, j == 0, j == n };
			most = larger(most, x);
			for (int k = 0; k < SIDES; k++)
				if (on[k])
					side[k] = larger(side[k], x);
		}
	return most;
}

/* The normal vanishes on a whole side of the patch: its factor out, at most twice. A patch without area has
 * no normal, only rounding. */
static void clean(struct maker *k, double *c, unsigned char *factors)
{
	const int m = k->s->degree[0], n = k->s->degree[1];
	double side[SIDES], most = sides_most(c, m, n, side);
	if (most <= larger(ZERO_SHARE * k->normal.size, k->normal.error)) {
		memset(c, 0, sizeof(double[4]) * (m + 1) * (n + 1));
		return;
	}
	for (int i = 0; i < 2 * SIDES; i++) {
		const int at = i / 2, d = at / 2, upper = at % 2;
		if (side[at] > ZERO_SHARE * most)
			continue;
		form_scale4(c, m, n, k->s->binomial, false);
		form_divide4(c, m, n, d, upper);
		form_scale4(c, m, n, k->s->binomial, true);
		most = sides_most(c, m, n, side);
		factors[at]++;
		/* a coefficient that had the number i of n has now n / i of its error */
		k->normal.error *= (d == 0 ? m : n) + 1;
	}
}

static void normal_make(struct maker *k, int patch)
{
	const struct level_surface *s = k->s;
	double *out = s->normals + level_normals_size(s) * patch;
	load(k, patch);
	if (s->net.rational) {
		term_add(k, U, V, X, 1, out);
		term_add(k, U, X, V, -1, out);
		term_add(k, X, V, U, -1, out);
	} else {
		form_cross4(k->x[U], degree_of(s, U, 0), degree_of(s, U, 1), k->x[V],
		            degree_of(s, V, 0), degree_of(s, V, 1), out);
	}
	form_scale4(out, s->degree[0], s->degree[1], s->binomial, true);
	clean(k, out, s->factors + (size_t)SIDES * patch);
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
	const size_t room = level_normals_size(s);
	free(s->normals);
	free(s->normal_error);
	free(s->factors);
	s->normals = calloc((size_t)patches, sizeof(double) * room);
	s->factors = calloc((size_t)patches, SIDES);
	s->normal_error = calloc((size_t)patches, sizeof(double));
	double *forms = calloc((N_FORMS + 1) * room, sizeof *forms);
	if (!s->normals || !s->normal_error || !s->factors || !forms) {
		free(forms);
		return ST_RESOURCE;
	}
	for (int i = 0; i < N_FORMS; i++)
		k.x[i] = forms + room * i;
	k.cross = forms + room * N_FORMS;
	for (int patch = 0; patch < patches; patch++)
		normal_make(&k, patch);
	free(forms);
	return ST_OK;
}
