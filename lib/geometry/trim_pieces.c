/* trim_pieces.c - trimming loops cut where they turn in u or in v. */
#include "trim_pieces.h"

#include <stdlib.h>
#include <string.h>

#include "bezier.h"

/* Derivatives below this, in domains per unit parameter, do not turn a piece. */
static const double flat = 1e-14;

/* Curves this near to the border, in domains, run along it. */
static const double near_border = 1e-12;

enum {
	SLOPE_MAX = 2 * ORDER_MAX, /* coefficients of a derivative's numerator */
	TURNS_MAX = 4 * ORDER_MAX,
	ROOT_DEPTH = 45,
};

/* A loop being cut. */
struct cutter {
	struct trim_pieces *out;
	int capacity, loop;
	const double (*domain)[2];
	double first[2], last[2]; /* ends of the pieces that are there */
	bool begun;
	enum status st; /* what has failed stays failed */
};

void trim_pieces_finish(struct trim_pieces *p)
{
	if (!p)
		return;
	for (int i = 0; i < p->n_points; i++)
		free(p->points[i]);
	free(p->points);
	free(p->pieces);
	*p = (struct trim_pieces){ 0 };
}

static void put_piece(struct cutter *c, const double from[2], const double to[2], int order,
                      const double *points)
{
	struct trim_pieces *out = c->out;
	if (out->n == c->capacity) {
		int room = c->capacity ? 2 * c->capacity : 64;
		void *q = reallocarray(out->pieces, room, sizeof *out->pieces);
		if (!q) {
			c->st = ST_RESOURCE;
			return;
		}
		out->pieces = q;
		c->capacity = room;
	}
	out->pieces[out->n++] = (struct trim_piece){
		.u = { from[0], to[0] },
		.v = { from[1], to[1] },
		.lo_u = fmin(from[0], to[0]),
		.hi_u = fmax(from[0], to[0]),
		.loop = c->loop,
		.order = order,
		.points = points,
	};
}

static void put_straight(struct cutter *c, const double to[2])
{
	if (c->last[0] == to[0] && c->last[1] == to[1])
		return;
	if (c->last[1] <= to[1])
		put_piece(c, c->last, to, 2, NULL);
	else
		put_piece(c, to, c->last, 2, NULL);
	memcpy(c->last, to, sizeof c->last);
}

/* Go on from `at`, straight where that is not where the last piece ended. */
static void go_to(struct cutter *c, const double at[2])
{
	if (c->begun) {
		put_straight(c, at);
		return;
	}
	memcpy(c->first, at, sizeof c->first);
	memcpy(c->last, at, sizeof c->last);
	c->begun = true;
}

/* Numerator of the derivative of coordinate k, Bernstein form; returns how many coefficients. */
static int slope_coefficients(const double *p, int order, bool rational, int k, double *out)
{
	const int d = order - 1;
	const double origin = p[k] / p[2];
	double x[ORDER_MAX], b[ORDER_MAX], e[ORDER_MAX];
	for (int i = 0; i < order; i++)
		x[i] = p[3 * i + k] - origin * p[3 * i + 2];
	if (!rational) {
		for (int i = 0; i < d; i++)
			out[i] = d * (x[i + 1] - x[i]) / p[2];
		return d;
	}
	/* x' w - x w', each product of Bernstein polynomials of degrees d - 1 and d */
	b[0] = e[0] = 1;
	for (int i = 1; i <= d; i++)
		b[i] = b[i - 1] * (d - i + 1) / i;
	for (int i = 1; i < d; i++)
		e[i] = e[i - 1] * (d - i) / i;
	double all = 1;
	for (int s = 0; s <= 2 * d - 1; s++) {
		double sum = 0;
		for (int i = s > d ? s - d : 0; i <= d - 1 && i <= s; i++) {
			const double *q = p + 3 * i + 2;
			int j = s - i;
			sum += e[i] * b[j] * d *
			       ((x[i + 1] - x[i]) * p[3 * j + 2] - x[j] * (q[3] - q[0]));
		}
		out[s] = sum / all;
		all = all * (2 * d - 1 - s) / (s + 1);
	}
	return 2 * d;
}

static int sign_changes(const double *a, int n)
{
	int changes = 0, last = 0;
	for (int i = 0; i < n; i++) {
		int sign = (a[i] > 0) - (a[i] < 0);
		changes += sign && last && sign != last;
		last = sign ? sign : last;
	}
	return changes;
}

/* Coefficients on the two halves; returns the value in the middle. */
static double halve(const double *a, int n, double *lower, double *upper)
{
	double x[SLOPE_MAX];
	memcpy(x, a, n * sizeof *x);
	for (int r = 0; r < n; r++) {
		lower[r] = x[0];
		upper[n - 1 - r] = x[n - 1 - r];
		for (int i = 0; i < n - 1 - r; i++)
			x[i] = (x[i] + x[i + 1]) / 2;
	}
	return lower[n - 1];
}

/* Where a polynomial in Bernstein form changes sign between a and b, rising; from *found on. */
static void turns_between(const double *x, int n, double a, double b, int depth, double *turns,
                          int *found)
{
	double lower[SLOPE_MAX], upper[SLOPE_MAX];
	if (sign_changes(x, n) == 0 || *found == TURNS_MAX)
		return;
	const double middle = (a + b) / 2;
	if (depth == ROOT_DEPTH) {
		turns[(*found)++] = middle;
		return;
	}
	bool root = halve(x, n, lower, upper) == 0;
	turns_between(lower, n, a, middle, depth + 1, turns, found);
	if (root && *found < TURNS_MAX)
		turns[(*found)++] = middle;
	turns_between(upper, n, middle, b, depth + 1, turns, found);
}

static int compare(const void *a, const void *b)
{
	double x = *(const double *)a, y = *(const double *)b;
	return (x > y) - (x < y);
}

/* Parameters where the piece turns in u or v, rising and apart. */
static int find_turns(const struct cutter *c, const double *p, int order, bool rational,
                      double *turns)
{
	int n = 0, kept = 0;
	for (int k = 0; k < 2; k++) {
		double slope[SLOPE_MAX], w = 0;
		int m = slope_coefficients(p, order, rational, k, slope);
		for (int i = 0; i < order; i++)
			w = fmax(w, p[3 * i + 2]);
		double none = flat * (c->domain[k][1] - c->domain[k][0]) * (rational ? w * w : 1);
		for (int i = 0; i < m; i++)
			if (fabs(slope[i]) <= none)
				slope[i] = 0;
		turns_between(slope, m, 0, 1, 0, turns, &n);
	}
	qsort(turns, n, sizeof *turns, compare);
	for (int i = 0; i < n; i++)
		if (turns[i] > (kept ? turns[kept - 1] : 0) + 1e-12 && turns[i] < 1 - 1e-12)
			turns[kept++] = turns[i];
	return kept;
}

/* The part of a net up to t; what is left of it stays in `net`. */
static void split_net(double *net, int order, double t, double *lower)
{
	for (int r = 0; r < order; r++) {
		memcpy(lower + 3 * r, net, 3 * sizeof *net);
		for (int i = 0; i < 3 * (order - 1 - r); i++)
			net[i] = (1 - t) * net[i] + t * net[i + 3];
	}
}

static void reverse_net(double *net, int order)
{
	for (int i = 0; i < order / 2; i++)
		for (int k = 0; k < 3; k++) {
			double x = net[3 * i + k];
			net[3 * i + k] = net[3 * (order - 1 - i) + k];
			net[3 * (order - 1 - i) + k] = x;
		}
}

/* One piece that does not turn, ending at `to`; net is kept and may be turned about. */
static void put_net(struct cutter *c, double *net, int order, const double to[2])
{
	if (c->last[0] == to[0] && c->last[1] == to[1])
		return;
	if (c->last[1] <= to[1]) {
		put_piece(c, c->last, to, order, net);
	} else {
		reverse_net(net, order);
		put_piece(c, to, c->last, order, net);
	}
	memcpy(c->last, to, sizeof c->last);
}

/* A Bezier curve of points w u, w v, w. */
static void cut_bezier(struct cutter *c, double *net, int order, bool rational,
                       const double from[2], const double to[2])
{
	go_to(c, from);
	if (order == 2) {
		put_straight(c, to);
		return;
	}
	double turns[TURNS_MAX], done = 0;
	int n = find_turns(c, net, order, rational, turns);
	const size_t size = (size_t)3 * order;
	double *points = malloc((n + 1) * size * sizeof *points);
	double **all = reallocarray(c->out->points, c->out->n_points + 1, sizeof *all);
	if (all)
		c->out->points = all;
	if (!points || !all) {
		free(points);
		c->st = ST_RESOURCE;
		return;
	}
	all[c->out->n_points++] = points;
	for (int i = 0; i < n; i++, points += size) {
		split_net(net, order, (turns[i] - done) / (1 - done), points);
		done = turns[i];
		const double at[2] = { net[0] / net[2], net[1] / net[2] };
		put_net(c, points, order, at);
	}
	memcpy(points, net, size * sizeof *net);
	put_net(c, points, order, to);
}

/* Which border (2 d + end) all the points lie on, or -1. */
static int on_border(const struct cutter *c, const double *net, int order)
{
	for (int b = 0; b < 4; b++) {
		const double *range = c->domain[b / 2], at = range[b % 2];
		const double near = near_border * (range[1] - range[0]);
		int i = 0;
		while (i < order && fabs(net[3 * i + b / 2] / net[3 * i + 2] - at) <= near)
			i++;
		if (i == order)
			return b;
	}
	return -1;
}

static void cut_piece(struct cutter *c, double *net, int order, bool rational, const double from[2],
                      const double to[2])
{
	int border = on_border(c, net, order);
	if (border < 0) {
		cut_bezier(c, net, order, rational, from, to);
		return;
	}
	const int d = border / 2, end = border % 2;
	const double *range = c->domain[d], length = range[1] - range[0];
	double a[2] = { from[0], from[1] }, b[2] = { to[0], to[1] };
	a[d] = b[d] = range[end] + (end ? length : -length);
	go_to(c, a);
	put_straight(c, b);
}

static void cut_curve(struct cutter *c, const struct curve *curve)
{
	struct bezier_chain chain;
	c->st = bezier_chain_init(&chain, curve);
	if (c->st != ST_OK)
		return;
	const int order = chain.order;
	for (int i = 0; i < chain.spans && c->st == ST_OK; i++) {
		double net[3 * ORDER_MAX];
		const double *p = chain.points + (size_t)4 * order * i;
		for (int j = 0; j < order; j++) {
			net[3 * j] = p[4 * j];
			net[3 * j + 1] = p[4 * j + 1];
			net[3 * j + 2] = p[4 * j + 3];
		}
		const double *q = net + 3 * (order - 1);
		const double from[2] = { net[0] / net[2], net[1] / net[2] };
		const double to[2] = { q[0] / q[2], q[1] / q[2] };
		cut_piece(c, net, order, chain.rational, from, to);
	}
	bezier_chain_finish(&chain);
}

enum status trim_pieces_init(struct trim_pieces *out, const struct trim *t,
                             const double (*domain)[2])
{
	struct cutter c = { .out = out, .domain = domain, .st = ST_OK };
	*out = (struct trim_pieces){ 0 };
	for (int i = 0; i < t->n && c.st == ST_OK; i++) {
		c.loop = i;
		c.begun = false;
		for (int j = 0; j < t->loops[i].n && c.st == ST_OK; j++)
			cut_curve(&c, &t->loops[i].curves[j]);
		if (c.begun && c.st == ST_OK)
			put_straight(&c, c.first);
	}
	if (c.st != ST_OK)
		trim_pieces_finish(out);
	return c.st;
}

void trim_piece_point(const struct trim_piece *p, double t, double uv[2], double d[2])
{
	if (!p->points) {
		d[0] = p->u[1] - p->u[0];
		d[1] = p->v[1] - p->v[0];
		uv[0] = p->u[0] + t * d[0];
		uv[1] = p->v[0] + t * d[1];
		return;
	}
	double b[ORDER_MAX], slope[ORDER_MAX], x[3] = { 0 }, dx[3] = { 0 };
	bernstein(p->order, t, b, slope);
	for (int i = 0; i < p->order; i++)
		for (int k = 0; k < 3; k++) {
			x[k] += b[i] * p->points[3 * i + k];
			dx[k] += slope[i] * p->points[3 * i + k];
		}
	for (int k = 0; k < 2; k++) {
		uv[k] = x[k] / x[2];
		d[k] = (dx[k] - uv[k] * dx[2]) / x[2];
	}
}

double trim_piece_find(const struct trim_piece *p, int c, double value)
{
	const double *ends = c ? p->v : p->u;
	const double rise = ends[1] - ends[0];
	if (rise == 0 || (value - ends[0]) * rise <= 0)
		return 0;
	if ((value - ends[1]) * rise >= 0)
		return 1;
	double t = (value - ends[0]) / rise, lo = 0, hi = 1;
	for (int i = 0; p->points && i < 100; i++) {
		double uv[2], d[2];
		trim_piece_point(p, t, uv, d);
		double off = uv[c] - value;
		if (off == 0)
			break;
		if (off * rise < 0)
			lo = t;
		else
			hi = t;
		double next = t - off / d[c];
		/* every third step halves at least, whatever the slope says */
		if (!(next > lo && next < hi) || i % 3 == 2)
			next = (lo + hi) / 2;
		if (fabs(next - t) <= 1e-16 || hi - lo <= 1e-16)
			break;
		t = next;
	}
	return t;
}

/* Crossings of one Bezier span with one line, from *found on. */
static void span_crossings(const double *p, int order, int d, double line, double a, double b,
                           double *turns, int *found)
{
	double off[ORDER_MAX], rise = 0;
	for (int i = 0; i < order; i++) {
		off[i] = p[4 * i + d] - line * p[4 * i + 3];
		rise = fmax(rise, fabs(off[i]));
	}
	for (int i = 0; i < order; i++)
		if (fabs(off[i]) <= flat * rise)
			off[i] = 0;
	turns_between(off, order, a, b, 0, turns, found);
	/* perhaps it crosses at the joint with the next span */
	if (off[order - 1] == 0 && *found < TURNS_MAX)
		turns[(*found)++] = b;
}

enum status trim_curve_crossings(const struct curve *c, int d, double base, double step,
                                 double **at, int *n)
{
	struct bezier_chain chain;
	*at = NULL;
	*n = 0;
	if (bezier_chain_init(&chain, c) != ST_OK)
		return ST_RESOURCE;
	enum status st = ST_OK;
	for (int i = 0; i < chain.spans && st == ST_OK; i++) {
		const double *p = chain.points + (size_t)4 * chain.order * i;
		double lo = INFINITY, hi = -INFINITY;
		for (int j = 0; j < chain.order; j++) {
			lo = fmin(lo, (p[4 * j + d] / p[4 * j + 3] - base) / step);
			hi = fmax(hi, (p[4 * j + d] / p[4 * j + 3] - base) / step);
		}
		/* beyond some periods it is no loop of this surface */
		for (double k = fmax(ceil(lo), -8); k <= fmin(floor(hi), 8); k++) {
			double *more = reallocarray(*at, (size_t)*n + TURNS_MAX, sizeof *more);
			if (!more) {
				st = ST_RESOURCE;
				break;
			}
			*at = more;
			int found = 0;
			span_crossings(p, chain.order, d, base + k * step, chain.breaks[i],
			               chain.breaks[i + 1], more + *n, &found);
			*n += found;
		}
	}
	bezier_chain_finish(&chain);
	if (st == ST_OK && *n)
		qsort(*at, *n, sizeof **at, compare);
	return st;
}
