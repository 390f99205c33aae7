/* iges_splines.c - 126 and 128, rational B-splines: what most files consist of. */
#include "iges_reader.h"

/* Properties: planar or closed ones, polynomial, periodic. Only the last ones matter. */
enum { CURVE_PROPERTIES = 4, SURFACE_PROPERTIES = 5 };

/* Parameters of an array must be left for `n` numbers. */
static bool room_for(struct iges_cursor *c, int64_t n)
{
	if (c->ended)
		iges_fail(c, "it ends too early");
	else if (n > iges_left(c))
		iges_fail(c, "it needs %lld numbers, more than the file has left", (long long)n);
	return c->st == ST_OK;
}

/*
 * What the file says is meant, within what the knots define. Ranges that miss the knots or turn
 * back are of no use; sloppy ones that reach beyond are cut.
 */
static void set_domain(struct iges_cursor *c, bool missing, const double range[2], double lo,
                       double hi, double out[2])
{
	double a = fmax(range[0], lo), b = fmin(range[1], hi), slack = 1e-9 * (hi - lo);
	out[0] = lo;
	out[1] = hi;
	if (!(hi > lo))
		return; /* the check of the knots says it */
	if (missing) {
		iges_warn(c->g, WARN_RANGE_MISSING, c->de);
	} else if (!(b - a > 1e-12 * (hi - lo))) {
		iges_warn(c->g, WARN_RANGE_IGNORED, c->de);
	} else {
		if (range[0] < lo - slack || range[1] > hi + slack)
			iges_warn(c->g, WARN_RANGE_CUT, c->de);
		out[0] = a;
		out[1] = b;
	}
}

/* Weights that are all the same are as good as 1, and 1 is exact. All 0 with the polynomial flag
 * is a fault of some writers that has one meaning only. */
static void mend_weights(struct iges_cursor *c, double *points, size_t n, bool polynomial)
{
	double w = points[3];
	for (size_t i = 1; i < n; i++)
		if (points[4 * i + 3] != w) {
			if (polynomial)
				iges_warn(c->g, WARN_FLAG, c->de);
			return;
		}
	if (w == 0 && polynomial)
		iges_warn(c->g, WARN_WEIGHTS, c->de);
	else if (!(w > 0) || !isfinite(w))
		return;
	for (size_t i = 0; i < n; i++)
		points[4 * i + 3] = 1;
}

static void make_homogeneous(double *points, size_t n)
{
	for (size_t i = 0; i < n; i++) {
		double w = points[4 * i + 3];
		if (w != 1)
			for (int k = 0; k < 3; k++)
				points[4 * i + k] *= w;
	}
}

enum status iges_spline_curve(struct iges_cursor *c, struct curve *out)
{
	int prop[CURVE_PROPERTIES];
	double range[2];
	int n = iges_count(c, "upper index", 1, iges_left(c)) + 1;
	int order = iges_count(c, "degree", ORDER_MIN - 1, ORDER_MAX - 1) + 1;
	for (int i = 0; i < CURVE_PROPERTIES; i++)
		prop[i] = iges_int(c);
	if (n < order)
		iges_fail(c, "%d control points for order %d", n, order);
	if (!room_for(c, (int64_t)n * 5 + order))
		return c->st;
	enum status st = curve_init(out, order, n);
	if (st != ST_OK)
		return st;
	iges_reals(c, out->knots, (size_t)n + order, 1, 1);
	iges_reals(c, out->points + 3, (size_t)n, 1, 4);
	iges_reals(c, out->points, (size_t)3 * n, 3, 4);
	size_t missing = c->missing;
	range[0] = iges_real(c);
	range[1] = iges_real(c);
	if (c->st != ST_OK)
		return c->st;
	mend_weights(c, out->points, (size_t)n, prop[2]);
	make_homogeneous(out->points, (size_t)n);
	out->periodic = prop[3] != 0;
	set_domain(c, c->missing != missing, range, out->knots[order - 1], out->knots[n],
	           out->domain);
	for (int i = 0; i < 3; i++)
		iges_real(c); /* normal of a planar curve; often left out */
	return c->st;
}

/* The file has u (the first index) inner, we have it outer. */
static void read_net(struct iges_cursor *c, struct surface *s, int at, int group)
{
	for (int j = 0; j < s->n[1]; j++)
		iges_reals(c, s->points + 4 * (size_t)j + at, (size_t)group * s->n[0], group,
		           (size_t)4 * s->n[1]);
}

enum status iges_spline_surface(struct iges_cursor *c, struct surface *out)
{
	static const char *const index[2] = { "upper index in u", "upper index in v" };
	static const char *const degree[2] = { "degree in u", "degree in v" };
	int n[2], order[2], prop[SURFACE_PROPERTIES];
	double range[2][2];
	for (int d = 0; d < 2; d++)
		n[d] = iges_count(c, index[d], 1, iges_left(c)) + 1;
	for (int d = 0; d < 2; d++)
		order[d] = iges_count(c, degree[d], ORDER_MIN - 1, ORDER_MAX - 1) + 1;
	for (int i = 0; i < SURFACE_PROPERTIES; i++)
		prop[i] = iges_int(c);
	for (int d = 0; d < 2; d++)
		if (n[d] < order[d])
			iges_fail(c, "%d control points in %c for order %d", n[d], "uv"[d],
			          order[d]);
	if (!room_for(c, (int64_t)n[0] * n[1] * 4 + n[0] + n[1] + order[0] + order[1]))
		return c->st;
	enum status st = surface_init(out, order, n);
	if (st != ST_OK)
		return st;
	for (int d = 0; d < 2; d++)
		iges_reals(c, out->knots[d], (size_t)n[d] + order[d], 1, 1);
	read_net(c, out, 3, 1);
	read_net(c, out, 0, 3);
	size_t missing = c->missing, net = (size_t)n[0] * n[1];
	for (int i = 0; i < 4; i++)
		range[i / 2][i % 2] = iges_real(c);
	if (c->st != ST_OK)
		return c->st;
	mend_weights(c, out->points, net, prop[2]);
	make_homogeneous(out->points, net);
	for (int d = 0; d < 2; d++) {
		out->periodic[d] = prop[3 + d] != 0;
		set_domain(c, c->missing != missing, range[d], out->knots[d][order[d] - 1],
		           out->knots[d][n[d]], out->domain[d]);
	}
	return c->st;
}
