/* level_form4.c - arithmetic of Bernstein forms whose coefficients are four numbers each.
 *
 * As in level_form.c, numbers of a border do not depend on the patch that they are computed for.
 */
#include "level_form.h"
#include "level_private.h"

typedef double vec4 __attribute__((vector_size(32), aligned(8)));

WIDE void form_scale4(double *c, int m, int n, const double *binomial, bool back)
{
	const double *bm = binomial_row(binomial, m), *bn = binomial_row(binomial, n);
	vec4 *x = (vec4 *)c;
	for (int i = 0; i <= m; i++)
		for (int j = 0; j <= n; j++, x++) {
			double s = bm[i] * bn[j];
			*x = back ? *x / s : *x * s;
		}
}

void form_divide4(double *c, int m, int n, int d, bool upper)
{
	const int count = d == 0 ? m : n, lines = d == 0 ? n : m;
	const size_t step = d == 0 ? (size_t)n + 1 : 1, across = d == 0 ? 1 : (size_t)n + 1;
	for (int l = 0; l <= lines; l++) {
		vec4 *x = (vec4 *)c + across * l;
		/* q[i] of degree count - 1, times (1 - t) + t: q[i] + q[i - 1] */
		vec4 zero = { 0 };
		if (upper) {
			for (int i = count; i > 0; i--)
				x[step * i] = (i < count ? x[step * i] : zero) + x[step * (i - 1)];
		} else {
			for (int i = 0; i < count; i++)
				x[step * i] = x[step * (i + 1)] + (i > 0 ? x[step * i] : zero);
		}
	}
}

/* y z x w. (By address: not every machine passes such a vector.) */
static inline __attribute__((always_inline)) void turn(const vec4 *a, vec4 *out)
{
	*out = (vec4){ (*a)[1], (*a)[2], (*a)[0], (*a)[3] };
}

WIDE void form_cross4(const double *a, int am, int an, const double *b, int bm, int bn, double *out)
{
	const int n = an + bn;
	const vec4 *x = (const vec4 *)a;
	for (int i = 0; i <= am; i++)
		for (int j = 0; j <= an; j++, x++) {
			const vec4 *y = (const vec4 *)b;
			vec4 x1 = { 0 }, y1 = { 0 }, r;
			turn(x, &x1);
			for (int k = 0; k <= bm; k++) {
				vec4 *o = (vec4 *)out + (size_t)(i + k) * (n + 1) + j;
				for (int l = 0; l <= bn; l++, y++) {
					turn(y, &y1);
					r = *x * y1 - x1 * *y;
					turn(&r, &y1);
					o[l] += y1;
				}
			}
		}
}

WIDE void form_weigh4(const double *a, int m, int n, const double *w, int wm, int wn, double sign,
                      double *out)
{
	const int width = n + wn;
	for (int i = 0; i <= m; i++)
		for (int k = 0; k <= wm; k++) {
			vec4 *o = (vec4 *)out + (size_t)(i + k) * (width + 1);
			const vec4 *x = (const vec4 *)a + (size_t)i * (n + 1);
			const double *y = w + (size_t)4 * k * (wn + 1);
			for (int l = 0; l <= wn; l++) {
				const double by = sign * y[4 * l];
				for (int j = 0; j <= n; j++)
					o[j + l] += by * x[j];
			}
		}
}

/* Bernstein polynomials of degree n and their derivatives. Inlined for the common degrees. */
static inline __attribute__((always_inline)) void basis(int n, double t, double *b, double *d)
{
	double c[NORMAL_DEGREE_MAX * 2 + 2];
	if (n == 0) {
		b[0] = 1;
		d[0] = 0;
		return;
	}
	c[0] = 1;
	for (int r = 1; r < n; r++) {
		double left = 0;
		for (int i = 0; i < r; i++) {
			double x = c[i];
			c[i] = left + (1 - t) * x;
			left = t * x;
		}
		c[r] = left;
	}
	b[0] = (1 - t) * c[0];
	d[0] = -n * c[0];
	for (int i = 1; i < n; i++) {
		b[i] = (1 - t) * c[i] + t * c[i - 1];
		d[i] = n * (c[i - 1] - c[i]);
	}
	b[n] = t * c[n - 1];
	d[n] = n * c[n - 1];
}

WIDE void form_evaluate(const double *c, int m, int n, double u, double v, double *f, double *fu,
                        double *fv)
{
	double bu[FIELD_DEGREE_MAX + 1], du[FIELD_DEGREE_MAX + 1];
	double bv[FIELD_DEGREE_MAX + 1], dv[FIELD_DEGREE_MAX + 1];
	basis(m, u, bu, du);
	basis(n, v, bv, dv);
	double s = 0, su = 0, sv = 0;
	for (int i = 0; i <= m; i++, c += n + 1) {
		double x = 0, y = 0;
		for (int j = 0; j <= n; j++) {
			x += bv[j] * c[j];
			y += dv[j] * c[j];
		}
		s += bu[i] * x;
		su += du[i] * x;
		sv += bu[i] * y;
	}
	*f = s;
	*fu = su;
	*fv = sv;
}

static inline __attribute__((always_inline)) void sum4(const double *p, int m, int n, double u,
                                                       double v, double *f, double *fu, double *fv)
{
	double bu[FIELD_DEGREE_MAX + 1], du[FIELD_DEGREE_MAX + 1];
	double bv[FIELD_DEGREE_MAX + 1], dv[FIELD_DEGREE_MAX + 1];
	const vec4 *c = (const vec4 *)p;
	basis(m, u, bu, du);
	basis(n, v, bv, dv);
	vec4 s = { 0 }, su = { 0 }, sv = { 0 };
	for (int i = 0; i <= m; i++, c += n + 1) {
		vec4 x = { 0 }, y = { 0 };
		for (int j = 0; j <= n; j++) {
			x += bv[j] * c[j];
			y += dv[j] * c[j];
		}
		s += bu[i] * x;
		su += du[i] * x;
		sv += bu[i] * y;
	}
	*(vec4 *)f = s;
	*(vec4 *)fu = su;
	*(vec4 *)fv = sv;
}

WIDE void form_evaluate4(const double *c, int m, int n, double u, double v, double f[4],
                         double fu[4], double fv[4])
{
	if (m == 3 && n == 3)
		sum4(c, 3, 3, u, v, f, fu, fv);
	else if (m == 5 && n == 5)
		sum4(c, 5, 5, u, v, f, fu, fv);
	else
		sum4(c, m, n, u, v, f, fu, fv);
}
