/* grid_kernel.c - the inner loops of a grid. Compiled once for each vector level, with
 * GRID_KERNEL and GRID_LEVEL naming the result. */
#include <string.h>

#include "forms.h"
#include "grid_kernel.h"

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

enum { S, SU, SV, SUU, SUV, SVV };

#define ALWAYS static inline __attribute__((always_inline))

ALWAYS struct vec3 at(const struct grid_block *b, int derivative, size_t i)
{
	return vec3(b->d[derivative][0][i], b->d[derivative][1][i], b->d[derivative][2][i]);
}

ALWAYS void points(struct grid_block *b, const double center[3], size_t n, const bool rational)
{
	const double x = center[0], y = center[1], z = center[2];
	n &= ~(size_t)(GRID_PAD - 1);
	for (size_t i = 0; i < n; i++) {
		const double w = rational ? 1 / b->d[S][3][i] : 1;
		b->channel[GRID_POINT_X][i] = b->d[S][0][i] * w + x;
		b->channel[GRID_POINT_Y][i] = b->d[S][1][i] * w + y;
		b->channel[GRID_POINT_Z][i] = b->d[S][2][i] * w + z;
	}
}

/* First derivatives of lane i; of a rational form up to the factor w, which a normal has no use for. */
ALWAYS void tangents(const struct grid_block *b, size_t i, const bool rational, const double w,
                     struct vec3 *p, struct vec3 *du, struct vec3 *dv)
{
	*p = vec3(0, 0, 0);
	*du = at(b, SU, i);
	*dv = at(b, SV, i);
	if (rational) {
		*p = vec3_scale(at(b, S, i), w);
		*du = vec3_scale(vec3_along(*du, -b->d[SU][3][i], *p), w);
		*dv = vec3_scale(vec3_along(*dv, -b->d[SV][3][i], *p), w);
	}
}

ALWAYS void normals(struct grid_block *b, size_t n, const bool rational)
{
	n &= ~(size_t)(GRID_PAD - 1);
	for (size_t i = 0; i < n; i++) {
		struct vec3 p, du, dv;
		tangents(b, i, rational, rational ? 1 / b->d[S][3][i] : 1, &p, &du, &dv);
		const struct vec3 cross = vec3_cross(du, dv);
		const double area2 = vec3_dot(cross, cross), scale = 1 / sqrt(area2);
		b->area2[i] = area2;
		b->channel[GRID_NORMAL_X][i] = cross.x * scale;
		b->channel[GRID_NORMAL_Y][i] = cross.y * scale;
		b->channel[GRID_NORMAL_Z][i] = cross.z * scale;
	}
}

/* All quantities, whichever are asked for: with fewer, sums would fuse otherwise and values differ. */
ALWAYS void curvatures(struct grid_block *b, size_t n, const bool rational)
{
	n &= ~(size_t)(GRID_PAD - 1);
	for (size_t i = 0; i < n; i++) {
		struct vec3 p, du, dv;
		const double w = rational ? 1 / b->d[S][3][i] : 1;
		tangents(b, i, rational, w, &p, &du, &dv);
		struct vec3 uu = at(b, SUU, i), uv = at(b, SUV, i), vv = at(b, SVV, i);
		if (rational) {
			/* The parts along Su and Sv are square to the normal: they may go. */
			uu = vec3_scale(vec3_along(uu, -b->d[SUU][3][i], p), w);
			uv = vec3_scale(vec3_along(uv, -b->d[SUV][3][i], p), w);
			vv = vec3_scale(vec3_along(vv, -b->d[SVV][3][i], p), w);
		}
		const struct vec3 cross = vec3_cross(du, dv);
		const struct forms x = {
			vec3_dot(du, du),       vec3_dot(du, dv),    vec3_dot(dv, dv),
			vec3_dot(cross, uu),    vec3_dot(cross, uv), vec3_dot(cross, vv),
			vec3_dot(cross, cross),
		};
		const struct form_values f = forms_values(&x);
		b->area2[i] = x.area2;
		b->channel[QUANTITY_GAUSSIAN][i] = f.gaussian;
		b->channel[QUANTITY_MEAN][i] = f.mean;
		b->channel[QUANTITY_KMAX][i] = f.kmax;
		b->channel[QUANTITY_KMIN][i] = f.kmin;
		b->channel[QUANTITY_ABSOLUTE][i] = fabs(f.kmax) + fabs(f.kmin);
		b->channel[QUANTITY_NORMAL_U][i] = f.normal_u;
		b->channel[QUANTITY_NORMAL_V][i] = f.normal_v;
	}
}

static size_t count_low(const double *area2, size_t n, double floor)
{
	size_t count = 0;
	n &= ~(size_t)(GRID_PAD - 1);
	for (size_t i = 0; i < n; i++)
		count += !(area2[i] > floor);
	return count;
}

ALWAYS size_t block_of(const struct grid_strip *s, unsigned what, size_t n, struct grid_block *b,
                       const bool rational)
{
	if (what & (GRID_BIT(GRID_POINT_X) | GRID_BIT(GRID_POINT_Y) | GRID_BIT(GRID_POINT_Z)))
		points(b, s->center, n, rational);
	if (!(what & grid_first))
		return 0;
	if (what & grid_first & ~grid_second)
		normals(b, n, rational);
	if (what & grid_second)
		curvatures(b, n, rational);
	return count_low(b->area2, n, s->floor);
}

static size_t block(const struct grid_strip *s, unsigned what, size_t lane, size_t n,
                    struct grid_block *b)
{
	static const int order_of[GRID_DERIVATIVES][2] = {
		{ 0, 0 }, { 1, 0 }, { 0, 1 }, { 2, 0 }, { 1, 1 }, { 0, 2 },
	};
	const bool wants_points =
	        what & (GRID_BIT(GRID_POINT_X) | GRID_BIT(GRID_POINT_Y) | GRID_BIT(GRID_POINT_Z));
	const int end = what & grid_second ? GRID_DERIVATIVES : what & grid_first ? 3 : 1;
	for (int d = s->rational || wants_points ? 0 : 1; d < end; d++)
		contract(s, lane, n, order_of[d][0], order_of[d][1], b->d[d]);
	return s->rational ? block_of(s, what, n, b, true) : block_of(s, what, n, b, false);
}

const struct grid_kernel GRID_KERNEL = { .level = GRID_LEVEL, .net = net, .block = block };
