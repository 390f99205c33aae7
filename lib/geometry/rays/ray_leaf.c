/* ray_leaf.c - one Bezier patch cut into leaves: halves until the net bends little and a bicubic
 * stands for it. */
#include "ray_leaf.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/*
 * A leaf bends at most this much: three times the largest second difference of a row of its net
 * over the row's length. Below it the Newton iteration from the linear solution converges in two or
 * three steps, and more leaves only cost memory.
 */
static const double bend_limit = 0.12;

/* A straight net may still twist: of a hyperbolic paraboloid every row is straight. */
static const double twist_limit = 0.12;

/*
 * Along the edge of a blade leaves are narrow, and one that bends little for its length still moves
 * aside by many of its widths; the iteration ends as far from it and says nothing, and the leaf would
 * be quartered for each ray. Bend times length over width at most; a quarter of it is the way aside.
 */
static const double aside_limit = 8;

/* A bicubic may stand for a leaf of higher degree when it is nearer than this part of its size:
 * the iteration starts there and the finish runs on the true surface. */
static const double fit_limit = 3e-4;

/* Halvings of a patch in each direction; beyond, a leaf is smaller than single precision sees. */
enum { CUT_DEPTH = 12 };

struct cutter {
	struct ray_cut *cut;
	uint32_t patch;
	int order[2];
	/* Bernstein to Chebyshev coefficients on [-1, 1]: to[d][k * order + i] */
	double to[2][ORDER_MAX * ORDER_MAX];
	double *nets;      /* owned; two nets a level */
	double *transform; /* owned; 4 order[0] order[1] */
};

/* A bicubic in powers of s, t and how far the net is from it. */
struct bicubic {
	double a[4][4][4]; /* [i][j][component], homogeneous */
	double off[2];     /* left out because of the degree in u, in v; in scene units */
};

static double length3(const double *p)
{
	return sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
}

static void chebyshev_matrix(int order, double *to)
{
	double b[ORDER_MAX];

	memset(to, 0, sizeof(double) * order * order);
	for (int m = 0; m < order; m++) {
		double angle = M_PI * (m + 0.5) / order;

		bernstein(order, (cos(angle) + 1) / 2, b, NULL);
		for (int k = 0; k < order; k++)
			for (int i = 0; i < order; i++)
				to[k * order + i] +=
				        (k ? 2.0 : 1.0) / order * b[i] * cos(k * angle);
	}
}

/* Chebyshev coefficients to powers, cubic. */
static void power_from_chebyshev(double *c, int stride)
{
	c[0] -= c[2 * stride];
	c[stride] -= 3 * c[3 * stride];
	c[2 * stride] *= 2;
	c[3 * stride] *= 4;
}

/* The bicubic nearest to the net, by leaving out the higher Chebyshev terms. */
static void bicubic_fit(const struct cutter *c, const double *net, struct bicubic *out)
{
	int m = c->order[0], n = c->order[1];
	double *half = c->transform; /* [k][j], transformed in u */
	double middle[3] = { 0 };

	memset(out, 0, sizeof *out);
	for (int k = 0; k < m; k++)
		for (int j = 0; j < n; j++)
			for (int e = 0; e < 4; e++) {
				double sum = 0;

				for (int i = 0; i < m; i++)
					sum += c->to[0][k * m + i] * net[4 * (i * n + j) + e];
				half[4 * (k * n + j) + e] = sum;
			}
	for (int k = 0; k < m; k++)
		for (int l = 0; l < n; l++) {
			double q[4] = { 0 };

			for (int j = 0; j < n; j++)
				for (int e = 0; e < 4; e++)
					q[e] += c->to[1][l * n + j] * half[4 * (k * n + j) + e];
			if (k == 0 && l == 0)
				for (int e = 0; e < 3; e++)
					middle[e] = q[e] / q[3];
			if (k < 4 && l < 4) {
				memcpy(out->a[k][l], q, sizeof q);
				continue;
			}
			for (int e = 0; e < 3; e++)
				q[e] -= middle[e] * q[3];
			out->off[k < 4] += length3(q);
		}
	for (int l = 0; l < 4; l++)
		for (int e = 0; e < 4; e++)
			power_from_chebyshev(&out->a[0][l][e], 16);
	for (int k = 0; k < 4; k++)
		for (int e = 0; e < 4; e++)
			power_from_chebyshev(&out->a[k][0][e], 4);
	for (int d = 0; d < 2; d++)
		out->off[d] /= fabs(out->a[0][0][3]);
}

/* Largest bend of a row of the Bezier net in direction d, and the longest row. */
static void bicubic_bend(double net[4][4][3], int d, double *bend, double *length)
{
	*bend = *length = 0;
	for (int k = 0; k < 4; k++) {
		double step[3][3], total = 0, worst = 0;

		for (int i = 0; i < 3; i++) {
			const double *p = d ? net[k][i] : net[i][k];
			const double *q = d ? net[k][i + 1] : net[i + 1][k];

			for (int e = 0; e < 3; e++)
				step[i][e] = q[e] - p[e];
			total += length3(step[i]);
		}
		for (int i = 0; i < 2; i++) {
			double second[3];

			for (int e = 0; e < 3; e++)
				second[e] = step[i + 1][e] - step[i][e];
			worst = fmax(worst, length3(second));
		}
		*length = fmax(*length, total);
		if (total > 1e-9)
			*bend = fmax(*bend, 3 * worst / total);
	}
}

/* Largest twist of a cell of the net, in the same measure, against the longer direction. */
static double bicubic_twist(double net[4][4][3], double length)
{
	double worst = 0;

	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++) {
			double d[3];

			for (int e = 0; e < 3; e++)
				d[e] = net[i + 1][j + 1][e] - net[i + 1][j][e] - net[i][j + 1][e] +
				       net[i][j][e];
			worst = fmax(worst, length3(d));
		}
	return length > 0 ? 3 * worst / length : 0;
}

static void power_to_bezier(const double *a, int stride, double *out, int out_stride)
{
	double p0 = a[0], p1 = a[stride], p2 = a[2 * stride], p3 = a[3 * stride];

	out[0] = p0 - p1 + p2 - p3;
	out[out_stride] = p0 - p1 / 3 - p2 / 3 + p3;
	out[2 * out_stride] = p0 + p1 / 3 - p2 / 3 - p3;
	out[3 * out_stride] = p0 + p1 + p2 + p3;
}

/* The bicubic's net, projected. */
static void bicubic_net(const struct bicubic *b, double net[4][4][3])
{
	double half[4][4][4], whole[4][4][4];

	for (int l = 0; l < 4; l++)
		for (int e = 0; e < 4; e++)
			power_to_bezier(&b->a[0][l][e], 16, &half[0][l][e], 16);
	for (int i = 0; i < 4; i++)
		for (int e = 0; e < 4; e++)
			power_to_bezier(&half[i][0][e], 4, &whole[i][0][e], 4);
	for (int i = 0; i < 4; i++)
		for (int j = 0; j < 4; j++)
			for (int e = 0; e < 3; e++)
				net[i][j][e] = whole[i][j][e] / whole[i][j][3];
}

/* 0 or 1: split there; -1: a leaf. */
static int cut_direction(const struct bicubic *b, const int depth[2])
{
	double net[4][4][3], bend[2], length[2];
	bool can[2] = { depth[0] < CUT_DEPTH, depth[1] < CUT_DEPTH };

	bicubic_net(b, net);
	for (int d = 0; d < 2; d++)
		bicubic_bend(net, d, &bend[d], &length[d]);

	double longest = fmax(length[0], length[1]);
	if (longest < 10 * (double)RAY_NOISE)
		return -1;

	double size = fmax(fmin(length[0], length[1]), 0.05 * longest);
	int worse = b->off[1] > b->off[0];
	if (b->off[worse] > fmax(fit_limit * size, (double)RAY_NOISE) && can[worse])
		return worse;

	if (bend[0] <= bend_limit && bend[1] <= bend_limit) {
		int longer = length[1] > length[0];

		if (bicubic_twist(net, longest) > twist_limit && can[longer])
			return longer;
		double width = fmax(length[1 - longer], 10 * (double)RAY_NOISE);
		if (bend[longer] * longest > aside_limit * width && can[longer])
			return longer;
		return -1;
	}
	/* where the bend moves the surface more, unless that direction is straight */
	int d = bend[0] * length[0] >= bend[1] * length[1] ? 0 : 1;
	if (bend[d] <= bend_limit / 4 || !can[d])
		d = 1 - d;
	return can[d] ? d : -1;
}

static void net_split(const struct cutter *c, const double *net, int d, double *lower,
                      double *upper)
{
	int n = c->order[d], rows = c->order[1 - d];
	int step = d ? 4 : 4 * c->order[1], row = d ? 4 * c->order[1] : 4;
	double p[ORDER_MAX][4];

	for (int k = 0; k < rows; k++) {
		for (int i = 0; i < n; i++)
			memcpy(p[i], &net[k * row + i * step], sizeof p[i]);
		for (int r = 0; r < n; r++) {
			memcpy(&lower[k * row + r * step], p[0], sizeof p[0]);
			memcpy(&upper[k * row + (n - 1 - r) * step], p[n - 1 - r], sizeof p[0]);
			for (int i = 0; i < n - 1 - r; i++)
				for (int e = 0; e < 4; e++)
					p[i][e] = (p[i][e] + p[i + 1][e]) / 2;
		}
	}
}

static enum status cut_room(struct ray_cut *c)
{
	if (c->n_leaves < c->capacity)
		return ST_OK;

	size_t capacity = c->capacity ? c->capacity + c->capacity / 2 : 256;
	if (capacity > UINT32_MAX ||
	    (c->memory && capacity * (sizeof *c->leaves + sizeof *c->bounds) > c->memory))
		return ST_RESOURCE;
	struct ray_leaf *leaves = aligned_alloc(64, capacity * sizeof *leaves);
	if (!leaves)
		return ST_RESOURCE;
	if (c->n_leaves)
		memcpy(leaves, c->leaves, c->n_leaves * sizeof *leaves);
	free(c->leaves);
	c->leaves = leaves;
	struct ray_bounds *bounds = realloc(c->bounds, capacity * sizeof *bounds);
	if (!bounds)
		return ST_RESOURCE;
	c->bounds = bounds;
	c->capacity = capacity;
	return ST_OK;
}

/* Box of the leaf's true net, which holds the surface (weights are positive). */
static void leaf_bounds(const struct cutter *c, const double *net, const struct ray_leaf *leaf,
                        struct ray_bounds *out, float *reach)
{
	double lo[3] = { INFINITY, INFINITY, INFINITY };
	double hi[3] = { -INFINITY, -INFINITY, -INFINITY };
	double far = 0;

	for (int i = 0; i < c->order[0] * c->order[1]; i++) {
		double off[3];

		for (int e = 0; e < 3; e++) {
			double x = net[4 * i + e] / net[4 * i + 3];

			lo[e] = fmin(lo[e], x);
			hi[e] = fmax(hi[e], x);
			off[e] = x - (double)leaf->center[e];
		}
		far = fmax(far, length3(off));
	}
	for (int e = 0; e < 3; e++) {
		out->lo[e] = (float)lo[e] - 2 * RAY_NOISE;
		out->hi[e] = (float)hi[e] + 2 * RAY_NOISE;
	}
	*reach = (float)far * 1.0001f + RAY_NOISE;
}

/* What the trim leaves of a part of the patch: as trim_test_box, with a little about the part. */
static int cut_trim(const struct cutter *c, const double from[2], const double step[2])
{
	const struct ray_patch *p = &c->cut->patches[c->patch];
	const struct trim_test *trim = c->cut->trims[p->surface];
	double lo[2], hi[2];

	if (!trim)
		return 1;
	for (int d = 0; d < 2; d++) {
		const double *range = d ? p->v : p->u, length = range[1] - range[0];

		lo[d] = range[0] + (from[d] - TRIM_BESIDE * step[d]) * length;
		hi[d] = range[0] + (from[d] + (1 + TRIM_BESIDE) * step[d]) * length;
	}
	return trim_test_box(trim, lo, hi);
}

static enum status cut_leaf(struct cutter *c, const struct bicubic *b, const double *net,
                            const double from[2], const double step[2], int left)
{
	struct ray_cut *cut = c->cut;
	enum status st = cut_room(cut);
	if (st != ST_OK)
		return st;

	struct ray_leaf *leaf = &cut->leaves[cut->n_leaves];
	double w = b->a[0][0][3], rest = 0, rest_s = 0, rest_t = 0, bend = 0, rest_w = 0;
	bool rational = false;

	memset(leaf, 0, sizeof *leaf);
	for (int e = 0; e < 3; e++)
		leaf->center[e] = (float)(b->a[0][0][e] / w);
	for (int i = 0; i < 4; i++)
		for (int j = 0; j < 4; j++) {
			double weight = b->a[i][j][3] / w, q[3];

			for (int e = 0; e < 3; e++) {
				q[e] = b->a[i][j][e] / w - (double)leaf->center[e] * weight;
				leaf->a[e][4 * i + j] = (float)q[e];
			}
			leaf->a[3][4 * i + j] = (float)weight;
			if (i + j && fabs(weight) > 1e-9)
				rational = true;
			if (i + j >= 2) {
				double size = length3(q);

				rest += size;
				rest_s += i * size;
				rest_t += j * size;
				bend += size * fmax(i * j, fmax(i * (i - 1), j * (j - 1)));
				rest_w += fabs(weight);
			}
		}
	leaf->error = (float)((b->off[0] + b->off[1]) * 1.01) + RAY_NOISE;
	leaf->rest = (float)rest * 1.0001f + leaf->error;
	leaf->rest_s = (float)rest_s * 1.0001f;
	leaf->rest_t = (float)rest_t * 1.0001f;
	leaf->bend = (float)bend * 1.0001f;
	leaf->rest_w = rational ? (float)rest_w * 1.0001f : 0;
	for (int d = 0; d < 2; d++) {
		leaf->from[d] = (float)from[d];
		leaf->step[d] = (float)step[d];
	}
	leaf->patch = c->patch;
	leaf->rational = rational;
	if (cut->trims[cut->patches[c->patch].surface])
		leaf->trim = left ? TRIM_INSIDE : TRIM_THROUGH;
	leaf_bounds(c, net, leaf, &cut->bounds[cut->n_leaves], &leaf->reach);
	cut->n_leaves++;
	return ST_OK;
}

/* left: as cut_trim says of what this is a part of. */
static enum status cut_net(struct cutter *c, const double *net, const double from[2],
                           const double step[2], const int depth[2], int left)
{
	struct bicubic b;

	if (left == 0)
		left = cut_trim(c, from, step);
	if (left < 0)
		return ST_OK;
	bicubic_fit(c, net, &b);
	int d = cut_direction(&b, depth);
	if (d < 0)
		return cut_leaf(c, &b, net, from, step, left);

	size_t size = (size_t)4 * c->order[0] * c->order[1];
	double *child = c->nets + 2 * size * (depth[0] + depth[1]);
	net_split(c, net, d, child, child + size);
	for (int half = 0; half < 2; half++) {
		double child_from[2] = { from[0], from[1] }, child_step[2] = { step[0], step[1] };
		int child_depth[2] = { depth[0], depth[1] };

		child_step[d] /= 2;
		child_from[d] += half * child_step[d];
		child_depth[d]++;
		enum status st =
		        cut_net(c, child + half * size, child_from, child_step, child_depth, left);
		if (st != ST_OK)
			return st;
	}
	return ST_OK;
}

enum status ray_cut_patch(struct ray_cut *cut, uint32_t patch)
{
	const struct ray_patch *p = &cut->patches[patch];
	size_t size = (size_t)4 * p->order[0] * p->order[1];
	struct cutter *c = calloc(1, sizeof *c);
	if (!c)
		return ST_RESOURCE;

	enum status st = ST_RESOURCE;
	c->cut = cut;
	c->patch = patch;
	for (int d = 0; d < 2; d++) {
		c->order[d] = p->order[d];
		chebyshev_matrix(c->order[d], c->to[d]);
	}
	c->nets = malloc(sizeof(double) * size * 2 * 2 * CUT_DEPTH);
	c->transform = malloc(sizeof(double) * size);
	if (c->nets && c->transform)
		st = cut_net(c, p->points, (const double[2]){ 0, 0 }, (const double[2]){ 1, 1 },
		             (const int[2]){ 0, 0 }, 0);
	free(c->transform);
	free(c->nets);
	free(c);
	return st;
}
