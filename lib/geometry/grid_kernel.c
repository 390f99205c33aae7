/* grid_kernel.c - the inner loops of a grid. Compiled once for each vector level, with
 * GRID_KERNEL and GRID_LEVEL naming the result. */
#include <string.h>

#include "grid_values.h"

typedef double point4 __attribute__((vector_size(32)));

static void net(struct grid_strip *strip, const double *points, size_t row_step, int order_v,
                const double *basis_v)
{
	const point4 center = { strip->center[0], strip->center[1], strip->center[2], 0 };
	for (int i = 0; i < strip->order; i++) {
		const double *p = points + row_step * i;
		point4 sum[3] = { { 0 }, { 0 }, { 0 } };
		for (int j = 0; j < order_v; j++) {
			point4 x;
			memcpy(&x, p + 4 * j, sizeof x);
			x -= x[3] * center;
			for (int d = 0; d < 3; d++)
				sum[d] += basis_v[d * order_v + j] * x;
		}
		for (int d = 0; d < 3; d++)
			memcpy(strip->net[d][i], &sum[d], sizeof sum[d]);
	}
}

/* One sum over the functions of a lane, for a constant number of them. */
#define SUM_2(t, c) (t(0, c) + t(1, c))
#define SUM_3(t, c) (SUM_2(t, c) + t(2, c))
#define SUM_4(t, c) (SUM_3(t, c) + t(3, c))
#define SUM_5(t, c) (SUM_4(t, c) + t(4, c))
#define SUM_6(t, c) (SUM_5(t, c) + t(5, c))
#define TERM(a, c)  (b[(a)*stride + i] * r[a][c])

/* out[component][lane] = sum of basis functions times points; the loops differ by order only. */
#define CONTRACT(order)                                                                            \
	static void contract_##order(const double *restrict b, size_t stride,                      \
	                             const double(*restrict points)[4], bool weight, size_t n,     \
	                             double(*restrict out)[GRID_BLOCK])                            \
	{                                                                                          \
		double r[order][4];                                                                \
		memcpy(r, points, sizeof r);                                                       \
		n &= ~(size_t)(GRID_PAD - 1);                                                      \
		for (size_t i = 0; i < n; i++) {                                                   \
			out[0][i] = SUM_##order(TERM, 0);                                          \
			out[1][i] = SUM_##order(TERM, 1);                                          \
			out[2][i] = SUM_##order(TERM, 2);                                          \
		}                                                                                  \
		for (size_t i = 0; i < n && weight; i++)                                           \
			out[3][i] = SUM_##order(TERM, 3);                                          \
	}
CONTRACT(2)
CONTRACT(3)
CONTRACT(4)
CONTRACT(5)
CONTRACT(6)

static void contract_any(int order, const double *restrict b, size_t stride,
                         const double (*restrict points)[4], bool weight, size_t n,
                         double (*restrict out)[GRID_BLOCK])
{
	n &= ~(size_t)(GRID_PAD - 1);
	for (int c = 0; c < 3 + weight; c++) {
		for (size_t i = 0; i < n; i++)
			out[c][i] = b[i] * points[0][c];
		for (int a = 1; a < order; a++)
			for (size_t i = 0; i < n; i++)
				out[c][i] += b[a * stride + i] * points[a][c];
	}
}

static void contract(const struct grid_strip *s, size_t lane, size_t n, int du, int dv,
                     double (*out)[GRID_BLOCK])
{
	const double *b = s->basis[du] + lane;
	const double(*points)[4] = (const double(*)[4])s->net[dv];
	switch (s->order) {
	case 2:
		contract_2(b, s->stride, points, s->rational, n, out);
		break;
	case 3:
		contract_3(b, s->stride, points, s->rational, n, out);
		break;
	case 4:
		contract_4(b, s->stride, points, s->rational, n, out);
		break;
	case 5:
		contract_5(b, s->stride, points, s->rational, n, out);
		break;
	case 6:
		contract_6(b, s->stride, points, s->rational, n, out);
		break;
	default:
		contract_any(s->order, b, s->stride, points, s->rational, n, out);
	}
}

static size_t block(const struct grid_strip *s, unsigned what, size_t lane, size_t n,
                    struct grid_block *b)
{
	static const int order_of[GRID_DERIVATIVES][2] = {
		{ 0, 0 }, { 1, 0 }, { 0, 1 }, { 2, 0 }, { 1, 1 }, { 0, 2 },
	};
	const int end = what & grid_second ? GRID_DERIVATIVES : what & grid_first ? 3 : 1;
	for (int d = s->rational || what & grid_points ? 0 : 1; d < end; d++)
		contract(s, lane, n, order_of[d][0], order_of[d][1], b->d[d]);
	return s->rational ? block_values(s->center, s->floor, what, n, b, true)
	                   : block_values(s->center, s->floor, what, n, b, false);
}

const struct grid_kernel GRID_KERNEL = { .level = GRID_LEVEL, .net = net, .block = block };
