/* box.c - axis-parallel boxes. */
#include "box.h"

#include <stdlib.h>
#include <string.h>

#include "bezier.h"

struct box box_empty(void)
{
	return (struct box){ vec3(INFINITY, INFINITY, INFINITY),
		             vec3(-INFINITY, -INFINITY, -INFINITY) };
}

bool box_is_empty(const struct box *b)
{
	return !(b->lo.x <= b->hi.x && b->lo.y <= b->hi.y && b->lo.z <= b->hi.z);
}

void box_add_point(struct box *b, struct vec3 p)
{
	b->lo = vec3(fmin(b->lo.x, p.x), fmin(b->lo.y, p.y), fmin(b->lo.z, p.z));
	b->hi = vec3(fmax(b->hi.x, p.x), fmax(b->hi.y, p.y), fmax(b->hi.z, p.z));
}

void box_add_box(struct box *b, const struct box *other)
{
	if (box_is_empty(other))
		return;
	box_add_point(b, other->lo);
	box_add_point(b, other->hi);
}

struct vec3 box_center(const struct box *b)
{
	return vec3_scale(vec3_add(b->lo, b->hi), 0.5);
}

double box_diagonal(const struct box *b)
{
	return box_is_empty(b) ? 0 : vec3_length(vec3_sub(b->hi, b->lo));
}

/*
 * The largest value of one coordinate, by halving the Bezier nets of the function: its corners are
 * values that are reached, its points bound it. All parts whose bound is above what is reached are
 * halved once in a round, so the gap closes evenly. Where the extreme is held along a whole line
 * askew to the parameters the parts multiply; from PARTS_MAX on the bound is taken as it is.
 */
enum { PARTS_MAX = 1 << 15, ROUNDS_MAX = 80 };

struct parts {
	int order[2];
	size_t n, cap, size; /* doubles a part: values times weight, and weights, in turn */
	double *nets;        /* owned */
	double *bound;       /* owned: largest value among the points of each */
	double reached;      /* by a corner of any part so far */
	double dropped;      /* largest bound of the parts that were left out */
};

static enum status parts_add(struct parts *p, double **net)
{
	if (p->n == p->cap) {
		size_t cap = p->cap ? 2 * p->cap : 64;
		double *nets = realloc(p->nets, sizeof *nets * p->size * cap);
		if (nets)
			p->nets = nets;
		double *bound = realloc(p->bound, sizeof *bound * cap);
		if (bound)
			p->bound = bound;
		if (!nets || !bound)
			return ST_RESOURCE;
		p->cap = cap;
	}
	*net = p->nets + p->size * p->n++;
	return ST_OK;
}

/* Bound the newest part by its points, and drop it where it cannot matter. */
static void parts_weigh(struct parts *p, double tolerance)
{
	const double *net = p->nets + p->size * (p->n - 1);
	const int a = p->order[0], b = p->order[1];
	double top = -INFINITY;
	for (int i = 0; i < a; i++)
		for (int j = 0; j < b; j++) {
			const double *q = net + 2 * (i * b + j), value = q[0] / q[1];
			top = fmax(top, value);
			if ((i == 0 || i == a - 1) && (j == 0 || j == b - 1))
				p->reached = fmax(p->reached, value);
		}
	p->bound[p->n - 1] = top;
	if (top <= p->reached + tolerance) {
		p->dropped = fmax(p->dropped, top);
		p->n--;
	}
}

/* Direction in which the values of a net bend most. */
static int bent_direction(const double *net, const int order[2])
{
	double bend[2] = { 0, 0 };
	const int step[2] = { 2 * order[1], 2 };
	for (int d = 0; d < 2; d++)
		for (int i = 0; i < order[0]; i++)
			for (int j = 0; j < order[1]; j++) {
				const int at = d == 0 ? i : j;
				const double *q = net + 2 * (i * order[1] + j);
				if (at == 0 || at == order[d] - 1)
					continue;
				/* second difference of the values, straight ones need no halving */
				const double *x = q - step[d], *y = q + step[d];
				bend[d] = fmax(bend[d],
				               fabs(x[0] / x[1] - 2 * q[0] / q[1] + y[0] / y[1]));
			}
	return bend[1] > bend[0] ? 1 : 0;
}

static void net_halve(const double *net, const int order[2], int d, double *left, double *right)
{
	const int k = order[d], other = order[1 - d];
	const size_t step = d == 0 ? (size_t)2 * order[1] : 2,
	             row = d == 0 ? 2 : (size_t)2 * order[1];
	for (int m = 0; m < other; m++) {
		double x[ORDER_MAX][2];
		for (int i = 0; i < k; i++)
			memcpy(x[i], net + m * row + i * step, sizeof x[i]);
		for (int r = 0; r < k; r++) {
			memcpy(left + m * row + r * step, x[0], sizeof x[0]);
			memcpy(right + m * row + (k - 1 - r) * step, x[k - 1 - r], sizeof x[0]);
			for (int i = 0; i + 1 < k - r; i++)
				for (int c = 0; c < 2; c++)
					x[i][c] = 0.5 * (x[i][c] + x[i + 1][c]);
		}
	}
}

/* Largest of sign * coordinate at the corners of nets of homogeneous points. */
static double corners_reach(const double *points, size_t n, const int order[2], int coordinate,
                            double sign)
{
	const size_t count = (size_t)order[0] * order[1];
	const size_t corner[4] = { 0, order[1] - 1, count - order[1], count - 1 };
	double reached = -INFINITY;
	for (size_t i = 0; i < n; i++)
		for (int k = 0; k < 4; k++) {
			const double *p = points + 4 * (count * i + corner[k]);
			reached = fmax(reached, sign * p[coordinate] / p[3]);
		}
	return reached;
}

static enum status parts_fill(struct parts *p, const double *points, size_t n, int coordinate,
                              double sign, double tolerance)
{
	const size_t count = p->size / 2;
	for (size_t i = 0; i < n; i++) {
		double *net;
		enum status st = parts_add(p, &net);
		if (st != ST_OK)
			return st;
		for (size_t k = 0; k < count; k++) {
			const double *q = points + 4 * (count * i + k);
			net[2 * k] = sign * q[coordinate];
			net[2 * k + 1] = q[3];
		}
		parts_weigh(p, tolerance);
	}
	return ST_OK;
}

/* The halves of all parts of `now` that still matter. */
static enum status parts_halve(struct parts *next, const struct parts *now, double tolerance)
{
	double half[2][2 * ORDER_MAX * ORDER_MAX];
	next->n = 0;
	next->reached = now->reached;
	next->dropped = now->dropped;
	for (size_t i = 0; i < now->n; i++) {
		if (now->bound[i] <= next->reached + tolerance) {
			next->dropped = fmax(next->dropped, now->bound[i]);
			continue;
		}
		const double *from = now->nets + now->size * i;
		net_halve(from, now->order, bent_direction(from, now->order), half[0], half[1]);
		for (int h = 0; h < 2; h++) {
			double *net;
			enum status st = parts_add(next, &net);
			if (st != ST_OK)
				return st;
			memcpy(net, half[h], sizeof *net * now->size);
			parts_weigh(next, tolerance);
		}
	}
	return ST_OK;
}

/* Largest of sign * coordinate over nets of homogeneous points, at most tolerance too large. */
static enum status extreme(const double *points, size_t n, const int order[2], int coordinate,
                           double sign, double tolerance, double *out)
{
	struct parts now = { .order = { order[0], order[1] },
		             .size = (size_t)2 * order[0] * order[1],
		             .reached = corners_reach(points, n, order, coordinate, sign),
		             .dropped = -INFINITY };
	struct parts next = now;
	enum status st = parts_fill(&now, points, n, coordinate, sign, tolerance);
	for (int i = 0; st == ST_OK && now.n > 0 && now.n < PARTS_MAX && i < ROUNDS_MAX; i++) {
		st = parts_halve(&next, &now, tolerance);
		struct parts swap = now;
		now = next;
		next = swap;
	}
	*out = fmax(now.reached, now.dropped);
	for (size_t i = 0; i < now.n; i++)
		*out = fmax(*out, now.bound[i]);
	free(now.nets);
	free(now.bound);
	free(next.nets);
	free(next.bound);
	return st;
}

static enum status nets_box(const double *points, size_t n, const int order[2], double size,
                            double tolerance, struct box *out)
{
	double value[2][3];
	tolerance = fmax(tolerance, 1e-13 * size);
	for (int c = 0; c < 3; c++)
		for (int end = 0; end < 2; end++) {
			enum status st = extreme(points, n, order, c, end ? 1 : -1, tolerance,
			                         &value[end][c]);
			if (st != ST_OK)
				return st;
		}
	*out = (struct box){ vec3(-value[0][0], -value[0][1], -value[0][2]),
		             vec3(value[1][0], value[1][1], value[1][2]) };
	return ST_OK;
}

enum status curve_box(const struct curve *c, double tolerance, struct box *out)
{
	struct bezier_chain b;
	enum status st = bezier_chain_init(&b, c);
	if (st != ST_OK)
		return st;
	const int order[2] = { b.order, 1 };
	struct box net = box_empty();
	for (int i = 0; i < c->n; i++)
		box_add_point(&net, curve_get_point(c, i, NULL));
	st = nets_box(b.points, b.spans, order, box_diagonal(&net), tolerance, out);
	bezier_chain_finish(&b);
	return st;
}

enum status surface_box(const struct surface *s, double tolerance, struct box *out)
{
	struct bezier_net b;
	enum status st = bezier_net_init(&b, s);
	if (st != ST_OK)
		return st;
	st = nets_box(b.points, (size_t)b.spans[0] * b.spans[1], b.order, b.size, tolerance, out);
	bezier_net_finish(&b);
	return st;
}
