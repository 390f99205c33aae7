/* refine_insert.c - knots inserted into a strip, and the part of a strip between two values. */
#include "strip.h"

#include <stdlib.h>
#include <string.h>

enum status strip_init(struct strip *s, int order, int n, size_t dim)
{
	*s = (struct strip){ .order = order, .n = n, .dim = dim };
	s->knots = calloc((size_t)n + (size_t)order, sizeof *s->knots);
	s->points = calloc((size_t)n, dim * sizeof *s->points);
	if (s->knots && s->points)
		return ST_OK;
	strip_finish(s);
	return ST_RESOURCE;
}

void strip_finish(struct strip *s)
{
	free(s->knots);
	free(s->points);
	*s = (struct strip){ 0 };
}

enum status strip_copy(struct strip *out, const struct strip *s)
{
	enum status st = strip_init(out, s->order, s->n, s->dim);
	if (st != ST_OK)
		return st;
	memcpy(out->knots, s->knots, ((size_t)s->n + (size_t)s->order) * sizeof *s->knots);
	memcpy(out->points, s->points, (size_t)s->n * s->dim * sizeof *s->points);
	return ST_OK;
}

int knots_lower_bound(const double *knots, int m, double x)
{
	int lo = 0;
	while (lo < m) {
		int mid = lo + (m - lo) / 2;
		if (knots[mid] < x)
			lo = mid + 1;
		else
			m = mid;
	}
	return lo;
}

int knots_upper_bound(const double *knots, int m, double x)
{
	int lo = 0;
	while (lo < m) {
		int mid = lo + (m - lo) / 2;
		if (knots[mid] <= x)
			lo = mid + 1;
		else
			m = mid;
	}
	return lo;
}

bool strip_clamped(const struct strip *s)
{
	const double *t = s->knots;
	return t[0] == t[s->order - 1] && t[s->n] == t[s->n + s->order - 1];
}

/* Rising values inside the knots' domain, no value more than order - 1 times in the end. */
static bool insertable(const struct strip *s, const double *x, int m)
{
	int k = s->order, length = s->n + k;
	for (int i = 0, run = 0; i < m; i++) {
		if (!(x[i] >= s->knots[k - 1] && x[i] <= s->knots[s->n]))
			return false;
		if (i > 0 && x[i] < x[i - 1])
			return false;
		run = i > 0 && x[i] == x[i - 1] ? run + 1 : 1;
		int there = knots_upper_bound(s->knots, length, x[i]) -
		            knots_lower_bound(s->knots, length, x[i]);
		if (there + run > k - 1)
			return false;
	}
	return true;
}

/* q = a q + (1 - a) p; a of 0 and 1 give p and q to the bit. */
static void blend(double *q, const double *p, double a, size_t dim)
{
	if (a == 1)
		return;
	if (a == 0) {
		memcpy(q, p, dim * sizeof *q);
		return;
	}
	for (size_t i = 0; i < dim; i++)
		q[i] = a * q[i] + (1 - a) * p[i];
}

/*
 * Boehm's insertion, values from the right: knots and points above the span of the present value
 * are final and lie at their final place, so each is moved once and the work is linear.
 * A value belongs to the span that ends there, t[j] < x <= t[j+1], which keeps j in range at the
 * upper end of unclamped knots; at the lower end the one point that would be missing has factor 0.
 */
enum status strip_insert(struct strip *out, const struct strip *s, const double *x, int m)
{
	if (!insertable(s, x, m))
		return ST_PARAMETER;
	int p = s->order - 1, n = s->n;
	size_t dim = s->dim;
	enum status st = strip_init(out, s->order, n + m, dim);
	if (st != ST_OK)
		return st;
	double *t = out->knots, *q = out->points;
	memcpy(t, s->knots, ((size_t)n + (size_t)p + 1) * sizeof *t);
	memcpy(q, s->points, (size_t)n * dim * sizeof *q);

	int knots_left = n + p + 1, points_left = n; /* those not at their final place */
	for (int left = m; left > 0; left--) {
		double value = x[left - 1];
		int j = knots_lower_bound(t, knots_left, value) - 1;
		memmove(t + j + 1 + left, t + j + 1, (size_t)(knots_left - j - 1) * sizeof *t);
		memmove(q + (size_t)(j + left) * dim, q + (size_t)j * dim,
		        (size_t)(points_left - j) * dim * sizeof *q);
		for (int i = j; i > j - p && i > 0; i--) {
			/* knots above j stand `left` places higher by now */
			double high = i + p <= j ? t[i + p] : t[i + p + left];
			double a = (value - t[i]) / (high - t[i]);
			blend(q + (size_t)i * dim, q + (size_t)(i - 1) * dim, a, dim);
		}
		t[j + left] = value;
		knots_left = points_left = j + 1;
	}
	return ST_OK;
}

/* How often x must still be inserted to have order - 1 knots there. */
static int missing(const struct strip *s, double x)
{
	int length = s->n + s->order;
	int there = knots_upper_bound(s->knots, length, x) - knots_lower_bound(s->knots, length, x);
	return there < s->order - 1 ? s->order - 1 - there : 0;
}

enum status strip_part(struct strip *out, const struct strip *s, double a, double b)
{
	int p = s->order - 1;
	if (!(a >= s->knots[p] && b <= s->knots[s->n] && a < b))
		return ST_PARAMETER;
	double x[2 * ORDER_MAX];
	int m = 0;
	for (int i = missing(s, a); i > 0; i--)
		x[m++] = a;
	for (int i = missing(s, b); i > 0; i--)
		x[m++] = b;
	struct strip full;
	enum status st = strip_insert(&full, s, x, m);
	if (st != ST_OK)
		return st;

	/* from the right at a, from the left at b: matters where there are `order` knots */
	int length = full.n + full.order;
	int last_a = knots_upper_bound(full.knots, length, a) - 1;
	int first_b = knots_lower_bound(full.knots, length, b);
	int from = last_a - p, n = first_b - from;
	st = strip_init(out, s->order, n, s->dim);
	if (st == ST_OK) {
		memcpy(out->points, full.points + (size_t)from * s->dim,
		       (size_t)n * s->dim * sizeof *out->points);
		memcpy(out->knots, full.knots + from, (size_t)(n + p + 1) * sizeof *out->knots);
		out->knots[0] = a;
		out->knots[n + p] = b;
	}
	strip_finish(&full);
	return st;
}
