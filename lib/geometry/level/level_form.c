/* level_form.c - arithmetic of Bernstein forms in two variables.
 *
 * Every function does the same operations in the same order for a coefficient of a border, whichever
 * of the two patches it is computed for: equal borders of the factors give borders of the product
 * that are equal to the bit.
 */
#include "level_form.h"
#include "level_private.h"

#include <math.h>
#include <string.h>

WIDE void form_product(const double *a, int am, int an, const double *b, int bm, int bn,
                       double weight, double *out)
{
	int n = an + bn;
	for (int i = 0; i <= am; i++)
		for (int k = 0; k <= bm; k++) {
			double *o = out + (size_t)(i + k) * (n + 1);
			const double *y = b + (size_t)k * (bn + 1);
			for (int j = 0; j <= an; j++) {
				double x = weight * a[(size_t)i * (an + 1) + j];
				for (int l = 0; l <= bn; l++)
					o[j + l] += x * y[l];
			}
		}
}

WIDE void form_square(const double *a, int m, int n, double weight, double *out)
{
	for (int i = 0; i <= m; i++)
		for (int k = i; k <= m; k++) {
			double *o = out + (size_t)(i + k) * (2 * n + 1);
			const double *x = a + (size_t)i * (n + 1), *y = a + (size_t)k * (n + 1);
			double w = k > i ? 2 * weight : weight;
			for (int j = 0; j <= n; j++) {
				double s = w * x[j];
				for (int l = 0; l <= n; l++)
					o[j + l] += s * y[l];
			}
		}
}

void form_scale(double *c, int m, int n, const double *binomial, bool back)
{
	const double *bm = binomial_row(binomial, m), *bn = binomial_row(binomial, n);
	for (int i = 0; i <= m; i++)
		for (int j = 0; j <= n; j++) {
			double s = bm[i] * bn[j];
			double *x = &c[(size_t)i * (n + 1) + j];
			*x = back ? *x / s : *x * s;
		}
}

void form_divide(double *c, int m, int n, int d, bool upper)
{
	int count = d == 0 ? m : n, lines = d == 0 ? n : m;
	size_t step = d == 0 ? (size_t)n + 1 : 1, across = d == 0 ? 1 : (size_t)n + 1;
	for (int l = 0; l <= lines; l++) {
		double *x = c + across * l;
		/* q[i] of degree count - 1, times (1 - t) + t: q[i] + q[i - 1] */
		if (upper) {
			for (int i = count; i > 0; i--)
				x[step * i] = (i < count ? x[step * i] : 0) + x[step * (i - 1)];
		} else {
			for (int i = 0; i < count; i++)
				x[step * i] = x[step * (i + 1)] + (i > 0 ? x[step * i] : 0);
		}
	}
}

WIDE void form_split(double *c, int m, int n, int d, double *lower)
{
	size_t row = (size_t)n + 1;
	if (d == 0) {
		memcpy(lower, c, sizeof *c * row);
		for (int s = 1; s <= m; s++) {
			for (size_t k = 0; k < row * (size_t)(m + 1 - s); k++)
				c[k] = 0.5 * (c[k] + c[k + row]);
			memcpy(lower + row * s, c, sizeof *c * row);
		}
		return;
	}
	for (int i = 0; i <= m; i++) {
		double *x = c + row * i, *y = lower + row * i;
		y[0] = x[0];
		for (int s = 1; s <= n; s++) {
			for (int j = 0; j <= n - s; j++)
				x[j] = 0.5 * (x[j] + x[j + 1]);
			y[s] = x[0];
		}
	}
}

/* By de Casteljau at x in direction d; the lower or the upper part stays. */
static void part_keep(double *c, int m, int n, int d, double x, bool upper)
{
	const int degree = d == 0 ? m : n, lines = d == 0 ? n : m;
	const size_t step = d == 0 ? (size_t)n + 1 : 1, across = d == 0 ? 1 : (size_t)n + 1;
	for (int l = 0; l <= lines; l++) {
		double *y = c + across * l;
		for (int r = 1; r <= degree; r++) {
			if (upper)
				for (int i = 0; i <= degree - r; i++)
					y[step * i] += x * (y[step * (i + 1)] - y[step * i]);
			else
				for (int i = degree; i >= r; i--)
					y[step * i] = y[step * (i - 1)] +
					              x * (y[step * i] - y[step * (i - 1)]);
		}
	}
}

void form_part(double *c, int m, int n, int d, double lo, double hi)
{
	part_keep(c, m, n, d, hi, false);
	part_keep(c, m, n, d, hi > 0 ? lo / hi : 0, true);
}

double form_part_error(const double *c, int m, int n)
{
	/* four times a degree of means, each of three roundings, and the places' own */
	return 16 * (m + n) * UNIT_ROUNDOFF * form_most(c, (size_t)(m + 1) * (n + 1));
}

WIDE void form_range(const double *c, size_t count, double *lo, double *hi)
{
	double least = c[0], most = c[0];
	for (size_t i = 1; i < count; i++) {
		least = c[i] < least ? c[i] : least;
		most = c[i] > most ? c[i] : most;
	}
	*lo = least;
	*hi = most;
}

double form_most(const double *c, size_t count)
{
	double lo, hi;
	form_range(c, count, &lo, &hi);
	return larger(-lo, hi);
}

struct bound bound_sum(struct bound a, double weight, struct bound b)
{
	double size = a.size + fabs(weight) * b.size;
	return (struct bound){ size, a.error + fabs(weight) * b.error + 8 * UNIT_ROUNDOFF * size };
}

struct bound bound_product_of(struct bound a, struct bound b, double terms, int m, int n)
{
	/* A coefficient is a mean of products, whose numbers are the binomials over each other: it
	 * is not larger than the largest product. Each number was scaled, binomials are sums themselves. */
	double steps = terms + m + n + 10;
	struct bound r = { a.size * b.size, 0 };
	r.error = a.error * b.size + a.size * b.error + a.error * b.error +
	          steps * UNIT_ROUNDOFF * r.size;
	return r;
}

struct bound bound_product(struct bound a, struct bound b, int m, int n)
{
	return bound_product_of(a, b, (m / 2 + 1.0) * (n / 2 + 1.0), m, n);
}
