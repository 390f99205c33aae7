/* level_roots.c - real roots in [0, 1] of polynomials in Bernstein form.
 *
 * By Descartes' rule the sign changes of the coefficients bound the number of roots, and halving
 * never adds changes. Zero counts as positive, so that both users of a shared line, who hold the
 * same coefficients, find the same roots whatever the rounding.
 * Source: Lane and Riesenfeld, Bounds on a polynomial, BIT 21 (1981).
 */
#include "level_private.h"

#include <math.h>
#include <string.h>

enum { HALVINGS_MAX = 48 };

/* A smaller step is the last, where the slope hardly changes over it. */
#define SURE_MOVE 2e-6
#define SURE_BEND 1e-4

static int sign_changes(const double *c, int n)
{
	int k = 0;
	for (int i = 0; i < n; i++)
		k += (c[i] < 0) != (c[i + 1] < 0);
	return k;
}

/* Value and derivatives at x by de Casteljau's steps. Inlined for cubics. */
static inline __attribute__((always_inline)) double steps(const double *c, int n, double x,
                                                          double *slope, double *bend)
{
	double d[FIELD_DEGREE_MAX + 1];
	*bend = 0;
	for (int i = 0; i <= n; i++)
		d[i] = c[i];
	for (int r = 1; r < n; r++) {
		if (r == n - 1)
			*bend = n * (n - 1) * (d[0] - 2 * d[1] + d[2]);
		for (int i = 0; i <= n - r; i++)
			d[i] += x * (d[i + 1] - d[i]);
	}
	*slope = n * (d[1] - d[0]);
	return d[0] + x * (d[1] - d[0]);
}

static double evaluate(const double *c, int n, double x, double *slope, double *bend)
{
	return n == 3 ? steps(c, 3, x, slope, bend) : steps(c, n, x, slope, bend);
}

/* Halley's method kept in a bracket. */
bool root_single(const double *c, int n, double *t)
{
	if (n < 1 || (c[0] < 0) == (c[n] < 0))
		return false;
	double lo = 0, hi = 1;
	double x = c[0] / (c[0] - c[n]);
	if (!(x >= 0 && x <= 1))
		x = 0.5;
	for (int step = 0; step < 100; step++) {
		double slope, bend, f = evaluate(c, n, x, &slope, &bend);
		if (f == 0)
			break;
		if ((f < 0) == (c[0] < 0))
			lo = x;
		else
			hi = x;
		double move = -2 * f * slope / (2 * slope * slope - f * bend);
		double next = x + move;
		const bool inside = next >= lo && next <= hi;
		if (!inside)
			next = 0.5 * (lo + hi);
		/* what is left goes with the move's third power */
		bool near = fabs(next - x) < 1e-14 || (inside && fabs(move) < SURE_MOVE &&
		                                       fabs(bend * move) < SURE_BEND * fabs(slope));
		x = next;
		if (near || hi - lo < 1e-16)
			break;
	}
	*t = x;
	return true;
}

static void roots_between(const double *c, int n, double from, double size, int depth, double *t,
                          int *count)
{
	int changes = sign_changes(c, n);
	double x;
	if (changes == 0)
		return;
	if (changes == 1 || depth == HALVINGS_MAX) {
		if (root_single(c, n, &x))
			t[(*count)++] = from + size * x;
		return;
	}
	double lower[FIELD_DEGREE_MAX + 1], upper[FIELD_DEGREE_MAX + 1];
	memcpy(upper, c, sizeof *c * (n + 1));
	lower[0] = upper[0];
	for (int r = 1; r <= n; r++) {
		for (int i = 0; i <= n - r; i++)
			upper[i] = 0.5 * (upper[i] + upper[i + 1]);
		lower[r] = upper[0];
	}
	roots_between(lower, n, from, size / 2, depth + 1, t, count);
	roots_between(upper, n, from + size / 2, size / 2, depth + 1, t, count);
}

int roots_find(const double *c, int n, double *t)
{
	int count = 0;
	roots_between(c, n, 0, 1, 0, t, &count);
	return count;
}
