/* knots.c - knot vectors: checks, spans, breaks, basis functions. */
#include "knots.h"

#include <math.h>
#include <string.h>

enum status knots_check(int order, int n, const double *knots, const char *what,
                        const struct report *r)
{
	if (order < ORDER_MIN || order > ORDER_MAX)
		return report_error(r, ST_INPUT, "%s: order %d, expected %d to %d; export it again",
		                    what, order, ORDER_MIN, ORDER_MAX);
	if (n < order)
		return report_error(r, ST_INPUT,
		                    "%s: %d control points, expected %d or more for order %d", what,
		                    n, order, order);
	int equal = 1;
	for (int i = 0; i < n + order; i++) {
		if (!isfinite(knots[i]))
			return report_error(r, ST_INPUT, "%s: knot %d is %g, expected a number",
			                    what, i + 1, knots[i]);
		if (i == 0)
			continue;
		if (knots[i] < knots[i - 1])
			return report_error(
			        r, ST_INPUT,
			        "%s: knot %d is %.17g after %.17g, expected knots that do not fall",
			        what, i + 1, knots[i], knots[i - 1]);
		equal = knots[i] == knots[i - 1] ? equal + 1 : 1;
		if (equal > order)
			return report_error(r, ST_INPUT,
			                    "%s: knot %.17g stands more than %d times, expected at "
			                    "most the order",
			                    what, knots[i], order);
	}
	double length = knots[n] - knots[order - 1];
	if (!(length > 0) || !isfinite(length))
		return report_error(r, ST_INPUT,
		                    "%s: the domain from %.17g to %.17g has no usable length", what,
		                    knots[order - 1], knots[n]);
	return ST_OK;
}

/* First index in lo+1 .. hi whose knot is > t (strict) or >= t; hi if there is none before. */
static int upper_index(const double *knots, int lo, int hi, double t, bool strict)
{
	while (hi - lo > 1) {
		int mid = lo + (hi - lo) / 2;
		if (strict ? knots[mid] > t : knots[mid] >= t)
			hi = mid;
		else
			lo = mid;
	}
	return hi;
}

static int last_span(int order, int n, const double *knots)
{
	int s = n - 1;
	while (s > order - 1 && !(knots[s] < knots[n]))
		s--;
	return s;
}

static int first_span(int order, int n, const double *knots)
{
	int s = order - 1;
	while (s < n - 1 && !(knots[s + 1] > knots[order - 1]))
		s++;
	return s;
}

int knots_span(int order, int n, const double *knots, double t)
{
	double a = knots[order - 1], b = knots[n];
	if (!(t < b))
		return last_span(order, n, knots);
	if (!(t > a))
		return first_span(order, n, knots);
	/* Right at once where knots are even, else a start for nothing lost. */
	int guess = order - 1 + (int)((t - a) / (b - a) * (n - order + 1));
	if (guess < n && knots[guess] <= t && t < knots[guess + 1])
		return guess;
	return upper_index(knots, order - 1, n, t, true) - 1;
}

int knots_span_left(int order, int n, const double *knots, double t)
{
	if (!(t < knots[n]))
		return last_span(order, n, knots);
	if (!(t > knots[order - 1]))
		return first_span(order, n, knots);
	return upper_index(knots, order - 1, n, t, false) - 1;
}

int knots_domain_span(int order, int n, const double *knots, const double domain[2], double t)
{
	if (!(t < domain[1]))
		return knots_span_left(order, n, knots, domain[1]);
	return knots_span(order, n, knots, t > domain[0] ? t : domain[0]);
}

void knots_basis(int order, const double *knots, int s, double t, int d, double *out)
{
	const int p = order - 1;
	double ndu[ORDER_MAX][ORDER_MAX], left[ORDER_MAX], right[ORDER_MAX];
	ndu[0][0] = 1;
	for (int j = 1; j <= p; j++) {
		left[j] = t - knots[s + 1 - j];
		right[j] = knots[s + j] - t;
		double saved = 0;
		for (int k = 0; k < j; k++) {
			ndu[j][k] = right[k + 1] + left[j - k];
			double q = ndu[k][j - 1] / ndu[j][k];
			ndu[k][j] = saved + right[k + 1] * q;
			saved = left[j - k] * q;
		}
		ndu[j][j] = saved;
	}
	for (int j = 0; j <= p; j++)
		out[j] = ndu[j][p];
	if (d > p) {
		memset(out + (size_t)order * order, 0, sizeof *out * order * (d - p));
		d = p;
	}
	if (d < 1)
		return;
	for (int k = 0; k <= p; k++) {
		double a[2][ORDER_MAX];
		int now = 0, next = 1;
		a[0][0] = 1;
		for (int i = 1; i <= d; i++) {
			const int rk = k - i, pk = p - i;
			double sum = 0;
			if (rk >= 0) {
				a[next][0] = a[now][0] / ndu[pk + 1][rk];
				sum = a[next][0] * ndu[rk][pk];
			}
			int from = rk >= -1 ? 1 : -rk;
			int to = k - 1 <= pk ? i - 1 : p - k;
			for (int j = from; j <= to; j++) {
				a[next][j] = (a[now][j] - a[now][j - 1]) / ndu[pk + 1][rk + j];
				sum += a[next][j] * ndu[rk + j][pk];
			}
			if (k <= pk) {
				a[next][i] = -a[now][i - 1] / ndu[pk + 1][k];
				sum += a[next][i] * ndu[k][pk];
			}
			out[i * order + k] = sum;
			int swap = now;
			now = next;
			next = swap;
		}
	}
	double factor = p;
	for (int i = 1; i <= d; i++) {
		for (int j = 0; j <= p; j++)
			out[i * order + j] *= factor;
		factor *= p - i;
	}
}

int knots_multiplicity(int order, int n, const double *knots, double t)
{
	const int last = n + order, i = upper_index(knots, -1, last, t, false);
	int count = 0;
	while (i + count < last && knots[i + count] == t)
		count++;
	return count;
}

int knots_breaks(int order, int n, const double *knots, double a, double b, double *out)
{
	int count = 0;
	out[count++] = a;
	for (int i = order - 1; i <= n && knots[i] < b; i++)
		if (knots[i] > out[count - 1])
			out[count++] = knots[i];
	out[count++] = b;
	return count;
}

double knots_greville(int order, const double *knots, int i)
{
	double sum = 0;
	for (int j = 1; j < order; j++)
		sum += knots[i + j];
	return sum / (order - 1);
}
