/* refine_elevate.c - the degree of a strip raised. */
#include "strip.h"

#include <stdlib.h>
#include <string.h>

/* Knots of the next degree: every distinct one once more. Returns how many. */
static int raised_knots(const struct strip *s, double *y)
{
	int m = 0, length = s->n + s->order;
	for (int i = 0; i < length; i++) {
		if (i == 0 || s->knots[i] != s->knots[i - 1])
			y[m++] = s->knots[i];
		y[m++] = s->knots[i];
	}
	return m;
}

/*
 * Add weight times the blossom of s at the p rising arguments to sum. All knots of s strictly
 * between the arguments are among them, with their multiplicity, so the value is a control point
 * after the arguments that are no knots yet are inserted: convex combinations only. Where all are
 * one value that stands order times, `right` says which of the two points is meant.
 */
static enum status add_blossom(const struct strip *s, const double *arguments, bool right,
                               double weight, double *sum)
{
	int p = s->order - 1, length = s->n + s->order;
	int lo = knots_lower_bound(s->knots, length, arguments[0]) - p - 1;
	int hi = knots_upper_bound(s->knots, length, arguments[p - 1]) + p + 1;
	lo = lo < 0 ? 0 : lo;
	hi = hi > length ? length : hi;
	struct strip window = { .order = s->order,
		                .n = hi - lo - s->order,
		                .dim = s->dim,
		                .knots = s->knots + lo,
		                .points = s->points + (size_t)lo * s->dim };
	struct strip fine = { 0 };
	const struct strip *have = &window;

	double missing[ORDER_MAX];
	int n_missing = 0;
	for (int i = 0, run = 0; i < p; i++) {
		run = i > 0 && arguments[i] == arguments[i - 1] ? run + 1 : 1;
		int there = knots_upper_bound(window.knots, hi - lo, arguments[i]) -
		            knots_lower_bound(window.knots, hi - lo, arguments[i]);
		if (run > there)
			missing[n_missing++] = arguments[i];
	}
	if (n_missing > 0) {
		enum status st = strip_insert(&fine, &window, missing, n_missing);
		if (st != ST_OK)
			return st;
		have = &fine;
	}

	int m = have->n + have->order, first = 1; /* the first argument's place in the knots */
	while (first < p && arguments[first] == arguments[0])
		first++;
	if (first < p || right)
		first = knots_upper_bound(have->knots, m, arguments[0]) - first;
	else
		first = knots_lower_bound(have->knots, m, arguments[0]);
	const double *point = have->points + (size_t)(first - 1) * s->dim;
	for (size_t i = 0; i < s->dim; i++)
		sum[i] += weight * point[i];
	strip_finish(&fine);
	return ST_OK;
}

/*
 * By one degree. The blossom F of the raised curve is the mean of the old one's over all ways to
 * leave one argument out; control point i is F(y[i+1] .. y[i+p+1]).
 * Source: Ramshaw, Blossoms are polar forms (1989); Prautzsch, CAGD 1 (1984), 193-198.
 */
static enum status elevate_once(struct strip *out, const struct strip *s)
{
	int p = s->order - 1;
	struct strip raised;
	enum status st = strip_init(&raised, s->order + 1, 2 * (s->n + s->order), s->dim);
	if (st != ST_OK)
		return st;
	raised.n = raised_knots(s, raised.knots) - raised.order;
	for (int i = 0; i < raised.n && st == ST_OK; i++) {
		const double *y = raised.knots + i + 1; /* the p + 1 arguments */
		double *sum = raised.points + (size_t)i * s->dim;
		for (int j = 0, run; j <= p && st == ST_OK; j += run) {
			for (run = 1; j + run <= p && y[j + run] == y[j]; run++)
				continue;
			double rest[ORDER_MAX];
			memcpy(rest, y, (size_t)j * sizeof *rest);
			memcpy(rest + j, y + j + 1, (size_t)(p - j) * sizeof *rest);
			bool right = raised.knots[i] == rest[0];
			st = add_blossom(s, rest, right, run, sum);
		}
		/* divided last, so that weights of 1 stay 1 */
		for (size_t k = 0; k < s->dim; k++)
			sum[k] /= p + 1;
	}
	if (st != ST_OK) {
		strip_finish(&raised);
		return st;
	}
	*out = raised;
	return ST_OK;
}

enum status strip_elevate(struct strip *out, const struct strip *s, int t)
{
	if (t < 0 || t > ORDER_MAX - s->order)
		return ST_PARAMETER;
	struct strip now;
	enum status st = strip_copy(&now, s);
	for (; t > 0 && st == ST_OK; t--) {
		struct strip next;
		st = elevate_once(&next, &now);
		strip_finish(&now);
		if (st == ST_OK)
			now = next;
	}
	if (st == ST_OK)
		*out = now;
	return st;
}
