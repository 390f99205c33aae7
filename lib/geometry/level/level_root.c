/* level_root.c - the length of the normal as a polynomial s, with a bound of what it is off.
 *
 * s interpolates |N'| in Chebyshev's nodes. r = N'.N' - s^2 is a polynomial again, so that the bound R of
 * its coefficients tells how near s is: for R <= n^2 / 4, n the least |N'|, it is
 * | |N'| - s | <= 0.6 R / n, and the derivatives of both differ by at most
 * R / n (2.5 D + 0.75 S / n), D the degree of s, or half that of r, and S the largest |N'u|. Where s would be off by too much
 * the patches are halved beforehand.
 */
#include "level_root.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "level_isophote.h"
#include "level_term.h"

/* Directions are halved so often at most, while there are fewer patches than so many times those at first, or for
 * isophotes than a few; never more than most. */
enum { ROUNDS_MAX = 8, PATCHES_TIMES = 64, PATCHES_FEW = 1000, PATCHES_MAX = 20000 };

void level_root_tables(struct root_tables *x, int least, const int degree[2],
                       const double *binomial)
{
	const int highest = degree[0] > degree[1] ? degree[0] : degree[1];
	/* a higher one costs more digits on its way from Chebyshev's polynomials to Bernstein's */
	const int n = highest < least             ? least
	              : highest < ROOT_DEGREE_MAX ? highest
	                                          : ROOT_DEGREE_MAX;
	x->degree = n;
	for (int k = 0; k <= n; k++)
		x->node[k] = 0.5 - 0.5 * cos(M_PI * (k + 0.5) / (n + 1));
	for (int j = 0; j <= n; j++)
		for (int k = 0; k <= n; k++)
			x->chebyshev[j][k] = (j == 0 ? 1.0 : 2.0) / (n + 1) *
			                     cos(M_PI * j * (n - k + 0.5) / (n + 1));
	for (int d = 0; d < 2; d++)
		for (int k = 0; k <= n; k++)
			for (int i = 0; i <= degree[d]; i++)
				x->basis[d][k][i] = binomial_row(binomial, degree[d])[i] *
				                    pow(x->node[k], i) *
				                    pow(1 - x->node[k], degree[d] - i);
	/* T_j has Bernstein coefficients (-1)^(j - i) C(2j, 2i) / C(j, i) of degree j, raised to n */
	memset(x->bernstein, 0, sizeof x->bernstein);
	for (int j = 0; j <= n; j++) {
		double t[ROOT_DEGREE_MAX + 1] = { 0 };
		for (int i = 0; i <= j; i++)
			t[i] = ((j - i) % 2 ? -1 : 1) * binomial_row(binomial, 2 * j)[2 * i] /
			       binomial_row(binomial, j)[i];
		for (int raised = j; raised < n; raised++)
			for (int i = raised + 1; i >= 0; i--) {
				double share = (double)i / (raised + 1);
				t[i] = share * (i > 0 ? t[i - 1] : 0) +
				       (1 - share) * (i <= raised ? t[i] : 0);
			}
		for (int i = 0; i <= n; i++)
			for (int k = 0; k <= n; k++)
				x->bernstein[i][k] += t[i] * x->chebyshev[j][k];
	}
}

/* |N'| in all nodes. */
static void lengths(const struct level_surface *s, const double *normals, double *out)
{
	const struct root_tables *x = s->root;
	const int m = s->degree[0], n = s->degree[1];
	for (int i = 0; i <= x->degree; i++) {
		double row[NORMAL_DEGREE_MAX + 1][3];
		for (int b = 0; b <= n; b++)
			for (int d = 0; d < 3; d++) {
				row[b][d] = 0;
				for (int a = 0; a <= m; a++)
					row[b][d] += x->basis[0][i][a] *
					             normals[(size_t)4 * (a * (n + 1) + b) + d];
			}
		for (int k = 0; k <= x->degree; k++) {
			double sum[3] = { 0, 0, 0 };
			for (int b = 0; b <= n; b++)
				for (int d = 0; d < 3; d++)
					sum[d] += x->basis[1][k][b] * row[b][d];
			*out++ = sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]);
		}
	}
}

/* out = a v a^T */
static void transform(const double a[][ROOT_DEGREE_MAX + 1], int n, const double *v, double *out)
{
	double row[ROOT_DEGREE_MAX + 1];
	for (int i = 0; i <= n; i++) {
		for (int k = 0; k <= n; k++) {
			row[k] = 0;
			for (int j = 0; j <= n; j++)
				row[k] += a[i][j] * v[j * (n + 1) + k];
		}
		for (int k = 0; k <= n; k++) {
			double sum = 0;
			for (int j = 0; j <= n; j++)
				sum += a[k][j] * row[j];
			out[i * (n + 1) + k] = sum;
		}
	}
}

/* The least length of the normal, and the largest of its derivatives in each direction. */
struct extremes {
	double least, slope[2];
};

static struct extremes extremes_of(const struct level_surface *s, size_t patch)
{
	const int m = s->degree[0], n = s->degree[1];
	const double *normals = s->normals + level_normals_size(s) * patch;
	const double error = s->normal_error[patch];
	struct vec3 sum = vec3(0, 0, 0);
	struct extremes x = { INFINITY, { 0, 0 } };
	for (size_t i = 0; i < form_count(m, n); i++)
		sum = vec3_along(sum, 1, vec3_of(normals + 4 * i));
	sum = vec3_unit(sum);
	for (int i = 0; i <= m; i++)
		for (int k = 0; k <= n; k++) {
			const double *c = normals + (size_t)4 * (i * (n + 1) + k);
			struct vec3 here = vec3_of(c);
			x.least = smaller(x.least, vec3_dot(here, sum) - 3 * error);
			if (i < m) {
				struct vec3 step = vec3_sub(vec3_of(c + 4 * (n + 1)), here);
				x.slope[0] =
				        larger(x.slope[0], m * (vec3_length(step) + 4 * error));
			}
			if (k < n) {
				struct vec3 step = vec3_sub(vec3_of(c + 4), here);
				x.slope[1] =
				        larger(x.slope[1], n * (vec3_length(step) + 4 * error));
			}
		}
	return x;
}

/* All normals are farther from right angles to the light than isophotes that are made of lengths. */
static bool length_unused(const struct level_surface *s, size_t patch)
{
	const double *normals = s->normals + level_normals_size(s) * patch;
	double least = INFINITY, most = -INFINITY, across = 0;
	for (size_t i = 0; i < form_count(s->degree[0], s->degree[1]); i++) {
		const double *c = normals + 4 * i;
		least = smaller(least, c[2]);
		most = larger(most, c[2]);
		across = larger(across, length2(c[0], c[1]));
	}
	return larger(least, -most) > 1.01 * LEVEL_OBLIQUE * across + 3 * s->normal_error[patch];
}

/* How much of |N'| is in the last coefficients in each direction. Isophotes: of the least one, with what the bound
 * of level_root_form makes of that. */
static void tails(const struct level_surface *s, size_t patch, const struct extremes *x,
                  double *room, double tail[2])
{
	const int n = s->root->degree;
	double *c = room + (n + 1) * (n + 1);
	lengths(s, s->normals + level_normals_size(s) * patch, room);
	transform(s->root->chebyshev, n, room, c);
	tail[0] = tail[1] = 0;
	for (int i = 0; i <= n; i++)
		for (int k = 0; k <= n; k++) {
			double y = fabs(c[i * (n + 1) + k]);
			tail[0] += i >= n - 1 ? y : 0;
			tail[1] += k >= n - 1 ? y : 0;
		}
	double share = c[0] > 0 ? 1 / c[0] : 0;
	if (s->kind == LEVEL_ISOPHOTE && x->least > 0)
		share = c[0] / (x->least * x->least) *
		        (1 + larger(x->slope[0], x->slope[1]) / (n * x->least));
	for (int d = 0; d < 2; d++)
		tail[d] *= share;
}

/* In which directions to halve. A bound of the length that is not above 0 is no use: then where the normal turns more. */
static void halving_wanted(const struct level_surface *s, size_t patch, double share, double *room,
                           bool want[2])
{
	double tail[2];
	want[0] = want[1] = false;
	if (s->kind == LEVEL_ISOPHOTE && length_unused(s, patch))
		return;
	const struct extremes x = extremes_of(s, patch);
	tails(s, patch, &x, room, tail);
	for (int d = 0; d < 2; d++)
		want[d] = tail[d] > share || (!(x.least > 0) && x.slope[d] >= x.slope[1 - d]);
}

enum status level_root_refine(struct level_surface *s, double share)
{
	const int n = s->root->degree;
	const size_t before = (size_t)s->net.spans[0] * s->net.spans[1];
	const bool isophote = s->kind == LEVEL_ISOPHOTE; /* others count halving beforehand */
	const size_t few = isophote ? PATCHES_FEW : 0;
	double *room = malloc(sizeof *room * 2 * (n + 1) * (n + 1));
	enum status st = room ? ST_OK : ST_RESOURCE;
	for (int round = 0; st == ST_OK && round < ROUNDS_MAX; round++) {
		const int *spans = s->net.spans;
		const size_t patches = (size_t)spans[0] * spans[1];
		bool *halve = calloc((size_t)spans[0] + spans[1], sizeof *halve), any[2] = { 0 };
		if (!halve) {
			st = ST_RESOURCE;
			break;
		}
		for (size_t i = 0; i < patches; i++) {
			const size_t at[2] = { i / spans[1], spans[0] + i % spans[1] };
			bool want[2];
			halving_wanted(s, i, share, room, want);
			for (int d = 0; d < 2; d++)
				if (want[d])
					any[d] = halve[at[d]] = true;
		}
		const bool many = (patches > PATCHES_TIMES * before && patches > few) ||
		                  patches > PATCHES_MAX;
		for (int d = 1; st == ST_OK && d >= 0 && !many; d--)
			if (any[d]) {
				st = level_net_halve(&s->net, d, halve + (d == 0 ? 0 : spans[0]));
				s->steps += isophote ? (s->net.order[d] - 1) * UNIT_ROUNDOFF : 0;
			}
		free(halve);
		if (many || !(any[0] || any[1]))
			break;
		if (st == ST_OK)
			st = level_normals(s);
	}
	free(room);
	return st;
}

bool level_root_form(struct tracer *t, const struct form *square, struct form *out)
{
	const struct level_surface *s = t->level->surface;
	const int n = s->root->degree;
	const int m[2] = { square->m > 2 * n ? square->m : 2 * n,
		           square->n > 2 * n ? square->n : 2 * n };
	/* the degree of the rest's derivatives, over that of s */
	const double higher = 0.5 * (m[0] > m[1] ? m[0] : m[1]) / n;
	struct form values = form_new(t, n, n), rest = form_new(t, m[0], m[1]);
	const struct extremes x = extremes_of(s, t->patch);
	const double slope = larger(x.slope[0], x.slope[1]);
	*out = form_new(t, n, n);
	if (!(x.least > 0))
		return false;
	lengths(s, t->normals, values.c);
	transform(s->root->bernstein, n, values.c, out->c);
	out->b.size = form_most(out->c, form_count(n, n));
	form_scale(out->c, n, n, s->binomial, false);
	form_add(t, &rest, *square, 1);
	if (m[0] == 2 * n && m[1] == 2 * n) {
		form_add_square(&rest, *out, -1);
	} else {
		struct form own = form_new(t, 2 * n, 2 * n);
		form_add_square(&own, *out, 1);
		form_add(t, &rest, own, -1);
	}
	form_tighten(t, &rest);
	const double off = rest.b.size + rest.b.error;
	if (!(off <= 0.25 * x.least * x.least))
		return false;
	out->b.error = off / x.least * (1.25 * higher + 0.4 * slope / (n * x.least));
	return true;
}
