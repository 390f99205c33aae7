/* batch_kernel.c - the inner loops of a batch. Compiled once for each vector level, with
 * BATCH_KERNEL and GRID_LEVEL naming the result. */
#include "batch_kernel.h"

#include <string.h>

#include "grid_values.h"

/* As many as a register holds: what is wider, compilers take apart badly. GRID_PAD is a multiple. */
#if defined __AVX512F__
enum { LANES = 8 };
#elif defined __AVX__
enum { LANES = 4 };
#else
enum { LANES = 2 };
#endif
typedef double lanes __attribute__((vector_size(8 * LANES)));

struct basis {
	lanes b[3][ORDER_MAX]; /* by derivative */
};

/*
 * The order functions at t and their derivatives.
 * Source: The NURBS Book, A2.2; a derivative is the difference of those of one order less.
 */
ALWAYS void basis_lanes(const int order, const double *k, const double *inverse, const lanes *t,
                        struct basis *out)
{
	const lanes zero = { 0 };
	lanes lower[ORDER_MAX];
	lanes *const b = out->b[0];
	b[0] = zero + 1;
	lower[0] = zero;
	out->b[2][0] = zero;
	for (int j = 1; j < order; j++) {
		lanes saved = zero, slope = zero, bend = zero;
		for (int i = 0; i < j; i++) {
			const double width = *inverse++;
			const lanes q = b[i] * width;
			b[i] = saved + (k[i + 1] - *t) * q;
			saved = (*t - k[1 - j + i]) * q;
			if (j == order - 1) {
				const lanes q2 = lower[i] * width;
				out->b[1][i] = j * (slope - q);
				out->b[2][i] = j * (bend - q2);
				bend = q2;
			}
			if (j == order - 2)
				lower[i] = j * (slope - q);
			slope = q;
		}
		b[j] = saved;
		if (j == order - 1) {
			out->b[1][j] = j * slope;
			out->b[2][j] = j * bend;
		}
		if (j == order - 2)
			lower[j] = j * slope;
	}
}

/* Sums over the control points, homogeneous derivatives in the order of grid_block.d. */
ALWAYS void contract(const int ku, const int kv, const bool rational, const struct basis *u,
                     const struct basis *v, const double (*p)[4], lanes sum[GRID_DERIVATIVES][4])
{
	const lanes zero = { 0 };
	const int parts = 3 + rational;
	for (int d = 0; d < GRID_DERIVATIVES; d++)
		for (int c = 0; c < parts; c++)
			sum[d][c] = zero;
	for (int i = 0; i < ku; i++, p += kv) {
		lanes row[3][4];
		for (int c = 0; c < parts; c++)
			for (int d = 0; d < 3; d++)
				row[d][c] = v->b[d][0] * p[0][c];
		for (int j = 1; j < kv; j++)
			for (int c = 0; c < parts; c++)
				for (int d = 0; d < 3; d++)
					row[d][c] += v->b[d][j] * p[j][c];
		for (int c = 0; c < parts; c++) {
			sum[S][c] += u->b[0][i] * row[0][c];
			sum[SU][c] += u->b[1][i] * row[0][c];
			sum[SUU][c] += u->b[2][i] * row[0][c];
			sum[SV][c] += u->b[0][i] * row[1][c];
			sum[SUV][c] += u->b[1][i] * row[1][c];
			sum[SVV][c] += u->b[0][i] * row[2][c];
		}
	}
}

ALWAYS void fill(const struct batch_span *s, const int ku, const int kv, const bool rational,
                 const double *u, const double *v, size_t n, struct grid_block *out)
{
	for (size_t i = 0; i < n; i += LANES) {
		lanes at[2], sum[GRID_DERIVATIVES][4];
		struct basis bu, bv;
		memcpy(&at[0], u + i, sizeof at[0]);
		memcpy(&at[1], v + i, sizeof at[1]);
		basis_lanes(ku, s->knots[0], s->inverse[0], &at[0], &bu);
		basis_lanes(kv, s->knots[1], s->inverse[1], &at[1], &bv);
		contract(ku, kv, rational, &bu, &bv, s->points, sum);
		for (int d = 0; d < GRID_DERIVATIVES; d++)
			for (int c = 0; c < 3 + rational; c++)
				memcpy(&out->d[d][c][i], &sum[d][c], sizeof sum[d][c]);
	}
}

/* Squared length of a second derivative with all its parts; x and y: those once derived. */
ALWAYS double bend2(const struct grid_block *b, int which, size_t i, const bool rational, double w,
                    int x, int y, struct vec3 p, struct vec3 dx, struct vec3 dy)
{
	struct vec3 d = at(b, which, i);
	if (rational) {
		d = vec3_along(d, -b->d[which][3][i], p);
		d = vec3_along(d, -b->d[x][3][i], dy);
		d = vec3_scale(vec3_along(d, -b->d[y][3][i], dx), w);
	}
	return vec3_dot(d, d);
}

/*
 * Mark lanes in area2 that are not far from Su x Sv = 0 by the derivatives at hand: a tangent would
 * vanish within a fiftieth of the span, or they are near parallel.
 */
ALWAYS void mark_doubtful(const struct batch_span *s, size_t n, struct grid_block *b,
                          const bool rational)
{
	const double hu = s->knots[0][1] - s->knots[0][0], hv = s->knots[1][1] - s->knots[1][0];
	n &= ~(size_t)(GRID_PAD - 1);
	for (size_t i = 0; i < n; i++) {
		struct vec3 p, du, dv;
		const double w = rational ? 1 / b->d[S][3][i] : 1;
		tangents(b, i, rational, w, &p, &du, &dv);
		const double uu = bend2(b, SUU, i, rational, w, SU, SU, p, du, du) * hu * hu,
		             uv = bend2(b, SUV, i, rational, w, SU, SV, p, du, dv),
		             vv = bend2(b, SVV, i, rational, w, SV, SV, p, dv, dv) * hv * hv;
		const double e = vec3_dot(du, du), g = vec3_dot(dv, dv);
		const bool regular = (e > 4e-4 * (uu + uv * (hv * hv))) &
		                     (g > 4e-4 * (vv + uv * (hu * hu))) &
		                     (b->area2[i] > 4e-4 * e * g);
		b->area2[i] = regular ? b->area2[i] : 0;
	}
}

ALWAYS size_t values(const struct batch_span *s, unsigned what, size_t n, struct grid_block *b,
                     const bool rational)
{
	block_values(s->center, 0, what, n, b, rational);
	if (!(what & grid_first))
		return 0;
	mark_doubtful(s, n, b, rational);
	return count_low(b->area2, n, 0);
}

static size_t block(const struct batch_span *s, unsigned what, const double *u, const double *v,
                    size_t n, struct grid_block *out)
{
	const int ku = s->order[0], kv = s->order[1];
	/* The commonest orders get code of their own, unrolled. */
	if (s->rational) {
		if (ku == 3 && kv == 3)
			fill(s, 3, 3, true, u, v, n, out);
		else if (ku == 4 && kv == 4)
			fill(s, 4, 4, true, u, v, n, out);
		else if (ku == 6 && kv == 6)
			fill(s, 6, 6, true, u, v, n, out);
		else
			fill(s, ku, kv, true, u, v, n, out);
		return values(s, what, n, out, true);
	}
	if (ku == 3 && kv == 3)
		fill(s, 3, 3, false, u, v, n, out);
	else if (ku == 4 && kv == 4)
		fill(s, 4, 4, false, u, v, n, out);
	else if (ku == 6 && kv == 6)
		fill(s, 6, 6, false, u, v, n, out);
	else
		fill(s, ku, kv, false, u, v, n, out);
	return values(s, what, n, out, false);
}

const struct batch_kernel BATCH_KERNEL = { .level = GRID_LEVEL, .block = block };
