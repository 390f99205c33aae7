/* crossing.c - where a curve passes through a plane, by the signs of Bernstein coefficients. */
#include <stdlib.h>
#include <string.h>

#include "bezier.h"
#include "section.h"

/* A span halved this often is narrower than rounding. */
enum { DEPTH = 52 };

struct crossings {
	double *t; /* owned */
	int n, cap;
	int order;
};

static enum status found(struct crossings *x, double t)
{
	if (x->n == x->cap) {
		int cap = x->cap ? 2 * x->cap : 8;
		double *more = realloc(x->t, sizeof *more * cap);
		if (!more)
			return ST_RESOURCE;
		x->t = more;
		x->cap = cap;
	}
	x->t[x->n++] = t;
	return ST_OK;
}

static int changes(const double *b, int n)
{
	int count = 0;
	for (int i = 1; i < n; i++)
		count += (b[i] < 0) != (b[i - 1] < 0);
	return count;
}

/* De Casteljau at the middle: b becomes the left half. */
static void halve(double *b, double *right, int n)
{
	for (int k = 0; k < n; k++) {
		right[n - 1 - k] = b[n - 1];
		for (int i = n - 1; i > k; i--)
			b[i] = 0.5 * (b[i - 1] + b[i]);
	}
}

/*
 * A polynomial has no more zeros than its coefficients have changes of sign, and as many but for
 * pairs: none, or an odd one that halving closes in on, or parts to look at apart.
 */
static enum status span_search(struct crossings *x, const double *b, double from, double to,
                               int depth)
{
	double left[ORDER_MAX], right[ORDER_MAX];
	int n = x->order, count = changes(b, n);
	if (count == 0)
		return ST_OK;
	if (depth == 0)
		return (b[0] < 0) != (b[n - 1] < 0) ? found(x, to) : ST_OK;
	memcpy(left, b, sizeof *b * n);
	halve(left, right, n);
	double mid = 0.5 * (from + to);
	enum status st = span_search(x, left, from, mid, depth - 1);
	return st == ST_OK ? span_search(x, right, mid, to, depth - 1) : st;
}

enum status curve_crossings(const struct curve *c, struct vec3 normal, double value, double **t,
                            int *n)
{
	struct crossings x = { .order = c->order };
	struct bezier_chain chain;
	*t = NULL;
	*n = 0;
	enum status st = bezier_chain_init(&chain, c);
	if (st != ST_OK)
		return st;
	bool below = false;
	for (int s = 0; st == ST_OK && s < chain.spans; s++) {
		const double *p = chain.points + (size_t)4 * c->order * s;
		double b[ORDER_MAX];
		for (int i = 0; i < c->order; i++, p += 4)
			b[i] = p[0] * normal.x + p[1] * normal.y + p[2] * normal.z - value * p[3];
		/* where the curve breaks it may change sides without a zero */
		if (s > 0 && (b[0] < 0) != below)
			st = found(&x, chain.breaks[s]);
		if (st == ST_OK)
			st = span_search(&x, b, chain.breaks[s], chain.breaks[s + 1], DEPTH);
		below = b[c->order - 1] < 0;
	}
	bezier_chain_finish(&chain);
	if (st != ST_OK) {
		free(x.t);
		return st;
	}
	*t = x.t;
	*n = x.n;
	return ST_OK;
}
