/* bezier.c - the Bezier pieces of curves and surfaces. */
#include "bezier.h"

#include <stdlib.h>
#include <string.h>

/* Ends this near, relative to the size, are made one. */
static const double closed_tolerance = 1e-9;

/*
 * The spans of one direction: breaks, and for each the order x order matrix that takes the span's
 * control points to its Bezier points. Row j is the blossom at (a, ..., a, b, ..., b), b j times;
 * a and b lie in the span, so that every step is a convex combination.
 */
struct pieces {
	int order, spans;
	double *breaks;     /* owned, spans + 1 */
	int *first;         /* owned: first control point of each span */
	bool *joined;       /* owned: the span's end is the next one's start */
	double *matrix;     /* owned */
	long double *exact; /* owned; the same with more digits, where wanted */
};

static void pieces_finish(struct pieces *p)
{
	free(p->breaks);
	free(p->first);
	free(p->joined);
	free(p->matrix);
	free(p->exact);
}

#define BLOSSOM_ROW(name, real)                                                                    \
	static void name(int order, const double *knots, int s, double a, double b, int j,         \
	                 real *row)                                                                \
	{                                                                                          \
		const int p = order - 1;                                                           \
		real d[ORDER_MAX][ORDER_MAX] = { { 0 } };                                          \
		for (int i = 0; i <= p; i++)                                                       \
			d[i][i] = 1;                                                               \
		for (int r = 1; r <= p; r++) {                                                     \
			const real x = r <= p - j ? a : b;                                         \
			for (int i = p; i >= r; i--) {                                             \
				const real lo = knots[s - p + i], hi = knots[i + 1 + s - r];       \
				const real t = (x - lo) / (hi - lo), rest = (hi - x) / (hi - lo);  \
				for (int m = 0; m <= p; m++)                                       \
					d[i][m] = rest * d[i - 1][m] + t * d[i][m];                \
			}                                                                          \
		}                                                                                  \
		memcpy(row, d[p], sizeof *row *order);                                             \
	}

BLOSSOM_ROW(blossom_row, double)
BLOSSOM_ROW(blossom_row_exact, long double)

static enum status pieces_init(struct pieces *p, int order, int n, const double *knots,
                               const double domain[2])
{
	*p = (struct pieces){ .order = order };
	p->breaks = malloc(sizeof *p->breaks * (n + 2));
	if (!p->breaks)
		return ST_RESOURCE;
	p->spans = knots_breaks(order, n, knots, domain[0], domain[1], p->breaks) - 1;
	p->first = malloc(sizeof *p->first * p->spans);
	p->joined = malloc(sizeof *p->joined * p->spans);
	p->matrix = malloc(sizeof *p->matrix * order * order * p->spans);
	if (!p->first || !p->joined || !p->matrix) {
		pieces_finish(p);
		return ST_RESOURCE;
	}
	for (int i = 0; i < p->spans; i++) {
		const double a = p->breaks[i], b = p->breaks[i + 1];
		const int s = knots_span(order, n, knots, a);
		p->first[i] = s - order + 1;
		p->joined[i] = i + 1 < p->spans && knots_multiplicity(order, n, knots, b) < order;
		for (int j = 0; j < order; j++)
			blossom_row(order, knots, s, a, b, j,
			            p->matrix + ((size_t)i * order + j) * order);
	}
	return ST_OK;
}

/* out (step doubles between its points) = Bezier points of span i from points q, likewise. */
static void pieces_convert(const struct pieces *p, int i, const double *q, size_t q_step,
                           double *out, size_t out_step)
{
	q += p->first[i] * q_step;
	for (int j = 0; j < p->order; j++) {
		const double *row = p->matrix + ((size_t)i * p->order + j) * p->order;
		double sum[4] = { 0 };
		for (int m = 0; m < p->order; m++)
			for (int c = 0; c < 4; c++)
				sum[c] += row[m] * q[m * q_step + c];
		memcpy(out + j * out_step, sum, sizeof sum);
	}
}

static enum status pieces_refine(struct pieces *p, const double *knots)
{
	p->exact = malloc(sizeof *p->exact * p->order * p->order * p->spans);
	if (!p->exact)
		return ST_RESOURCE;
	for (int i = 0; i < p->spans; i++)
		for (int j = 0; j < p->order; j++)
			blossom_row_exact(p->order, knots, p->first[i] + p->order - 1, p->breaks[i],
			                  p->breaks[i + 1], j,
			                  p->exact + ((size_t)i * p->order + j) * p->order);
	return ST_OK;
}

static bool points_meet(const double *a, const double *b, double size)
{
	for (int c = 0; c < 3; c++)
		if (!(fabs(a[c] - b[c]) <= closed_tolerance * size * a[3]))
			return false;
	return fabs(a[3] - b[3]) <= closed_tolerance * a[3];
}

static double *net_point(const struct bezier_net *b, int i, int j, int k, int l)
{
	return b->points + bezier_patch_size(b) * ((size_t)i * b->spans[1] + j) +
	       4 * ((size_t)k * b->order[1] + l);
}

/* Point m along the border at end `end` of direction d, in patch (d: at, other: j). */
static double *border_at(const struct bezier_net *b, int d, int at, int j, int end, int m)
{
	const int last = end ? b->order[d] - 1 : 0;
	return d == 0 ? net_point(b, at, j, last, m) : net_point(b, j, at, m, last);
}

/* Put the start of patches `next` over the end of patches `at`, all along direction d's border. */
static void border_share(struct bezier_net *b, int d, int at, int next)
{
	for (int j = 0; j < b->spans[1 - d]; j++)
		for (int m = 0; m < b->order[1 - d]; m++)
			memcpy(border_at(b, d, at, j, 1, m), border_at(b, d, next, j, 0, m),
			       4 * sizeof(double));
}

static bool border_meets(const struct bezier_net *b, int d)
{
	for (int j = 0; j < b->spans[1 - d]; j++)
		for (int m = 0; m < b->order[1 - d]; m++)
			if (!points_meet(border_at(b, d, b->spans[d] - 1, j, 1, m),
			                 border_at(b, d, 0, j, 0, m), b->size))
				return false;
	return true;
}

/* Patch i, j from sums with more digits, each of its numbers rounded once. */
static void patch_exact(const struct pieces p[2], const struct surface *s, int i, int j,
                        double *out)
{
	const int m = p[0].order, n = p[1].order;
	const long double *u = p[0].exact + (size_t)i * m * m, *v = p[1].exact + (size_t)j * n * n;
	const double *q = s->points + 4 * ((size_t)p[0].first[i] * s->n[1] + p[1].first[j]);
	for (int k = 0; k < m; k++) {
		long double row[ORDER_MAX][4] = { { 0 } };
		for (int a = 0; a < m; a++)
			for (int b = 0; b < n; b++)
				for (int c = 0; c < 4; c++)
					row[b][c] +=
					        u[k * m + a] * q[4 * ((size_t)a * s->n[1] + b) + c];
		for (int l = 0; l < n; l++, out += 4) {
			long double sum[4] = { 0 };
			for (int b = 0; b < n; b++)
				for (int c = 0; c < 4; c++)
					sum[c] += v[l * n + b] * row[b][c];
			for (int c = 0; c < 4; c++)
				out[c] = (double)sum[c];
		}
	}
}

static enum status net_make(struct bezier_net *out, const struct surface *s, bool exact)
{
	struct bezier_net b = { .order = { s->order[0], s->order[1] },
		                .rational = s->rational,
		                .size = surface_size(s) };
	struct pieces p[2] = { { 0 }, { 0 } };
	double *strip = NULL;
	enum status st = ST_OK;
	for (int d = 0; d < 2 && st == ST_OK; d++)
		st = pieces_init(&p[d], s->order[d], s->n[d], s->knots[d], s->domain[d]);
	for (int d = 0; d < 2 && exact && st == ST_OK; d++)
		st = pieces_refine(&p[d], s->knots[d]);
	if (st != ST_OK)
		goto out;
	b.spans[0] = p[0].spans;
	b.spans[1] = p[1].spans;
	st = ST_RESOURCE;
	strip = malloc(sizeof *strip * 4 * b.order[0] * s->n[1]);
	b.points = malloc(sizeof *b.points * bezier_patch_size(&b) * b.spans[0] * b.spans[1]);
	if (!strip || !b.points)
		goto out;
	for (int i = 0; exact && i < b.spans[0]; i++)
		for (int j = 0; j < b.spans[1]; j++)
			patch_exact(p, s, i, j, net_point(&b, i, j, 0, 0));
	for (int i = 0; !exact && i < b.spans[0]; i++) {
		for (int c = 0; c < s->n[1]; c++)
			pieces_convert(&p[0], i, s->points + (size_t)4 * c, (size_t)4 * s->n[1],
			               strip + (size_t)4 * c, (size_t)4 * s->n[1]);
		for (int j = 0; j < b.spans[1]; j++)
			for (int k = 0; k < b.order[0]; k++)
				pieces_convert(&p[1], j, strip + (size_t)4 * k * s->n[1], 4,
				               net_point(&b, i, j, k, 0), 4);
	}
	for (int d = 0; d < 2; d++) {
		for (int i = 0; i < b.spans[d]; i++)
			if (p[d].joined[i])
				border_share(&b, d, i, i + 1);
		b.breaks[d] = p[d].breaks;
		p[d].breaks = NULL;
	}
	for (int d = 0; d < 2; d++) {
		b.closed[d] = border_meets(&b, d);
		if (b.closed[d])
			border_share(&b, d, b.spans[d] - 1, 0);
	}
	*out = b;
	b.points = NULL;
	st = ST_OK;
out:
	free(b.points);
	free(strip);
	pieces_finish(&p[0]);
	pieces_finish(&p[1]);
	return st;
}

enum status bezier_net_init(struct bezier_net *out, const struct surface *s)
{
	return net_make(out, s, false);
}

enum status bezier_net_init_exact(struct bezier_net *out, const struct surface *s)
{
	return net_make(out, s, true);
}

void bezier_net_finish(struct bezier_net *b)
{
	if (!b)
		return;
	free(b->breaks[0]);
	free(b->breaks[1]);
	free(b->points);
	*b = (struct bezier_net){ 0 };
}

enum status bezier_chain_init(struct bezier_chain *out, const struct curve *c)
{
	struct pieces p;
	enum status st = pieces_init(&p, c->order, c->n, c->knots, c->domain);
	if (st != ST_OK)
		return st;
	const size_t piece = (size_t)4 * c->order;
	double *points = malloc(sizeof *points * piece * p.spans);
	if (!points) {
		pieces_finish(&p);
		return ST_RESOURCE;
	}
	for (int i = 0; i < p.spans; i++)
		pieces_convert(&p, i, c->points, 4, points + piece * i, 4);
	for (int i = 0; i < p.spans; i++)
		if (p.joined[i])
			memcpy(points + piece * (i + 1) - 4, points + piece * (i + 1),
			       4 * sizeof *points);
	*out = (struct bezier_chain){ c->order, p.spans, c->rational, p.breaks, points };
	p.breaks = NULL;
	pieces_finish(&p);
	return ST_OK;
}

void bezier_chain_finish(struct bezier_chain *b)
{
	if (!b)
		return;
	free(b->breaks);
	free(b->points);
	*b = (struct bezier_chain){ 0 };
}

void bernstein(int order, double t, double *b, double *d)
{
	b[0] = 1;
	for (int k = 1; k < order; k++) {
		if (d && k == order - 1) {
			d[0] = -k * b[0];
			for (int i = 1; i < k; i++)
				d[i] = k * (b[i - 1] - b[i]);
			d[k] = k * b[k - 1];
		}
		b[k] = t * b[k - 1];
		for (int i = k - 1; i > 0; i--)
			b[i] = t * b[i - 1] + (1 - t) * b[i];
		b[0] *= 1 - t;
	}
	if (d && order == 1)
		d[0] = 0;
}
