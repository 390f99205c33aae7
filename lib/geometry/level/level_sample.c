/* level_sample.c - f and the surface in Chebyshev's nodes of a piece. */
#include "level_private.h"

#include <math.h>
#include <string.h>

typedef double lanes __attribute__((vector_size(32)));
typedef long long bits __attribute__((vector_size(32)));

enum { LANES = 4, NODES = PROOF_NODES, HALF = NODES / 2, GROUPS = PROOF_GROUPS };

void level_proof_tables(struct proof_tables *p)
{
	for (int j = 0; j < NODES; j++) {
		double t = 0.5 - 0.5 * cos(M_PI * (j + 0.5) / NODES), s = 1 - t;
		double(*h)[LANES] = p->h[j % GROUPS];
		p->t[j % GROUPS][j / GROUPS] = t;
		h[0][j / GROUPS] = s * s * (1 + 2 * t);
		h[1][j / GROUPS] = t * t * (1 + 2 * s);
		h[2][j / GROUPS] = t * s * s;
		h[3][j / GROUPS] = -t * t * s;
	}
	for (int k = 0; k < NODES; k++)
		for (int j = 0; j < HALF; j++)
			p->cosine[k][j] =
			        (k == 0 ? 1.0 : 2.0) / NODES * cos(M_PI * k * (j + 0.5) / NODES);
}

static inline __attribute__((always_inline)) void basis(int n, const lanes *at, lanes *b)
{
	lanes t = *at, s = 1 - t;
	b[0] = (lanes){ 1, 1, 1, 1 };
	for (int r = 1; r <= n; r++) {
		lanes left = { 0 };
		for (int i = 0; i < r; i++) {
			lanes x = b[i];
			b[i] = left + s * x;
			left = t * x;
		}
		b[r] = left;
	}
}

static inline __attribute__((always_inline)) void
sum_field(const double *c, int m, int n, const lanes *bu, const lanes *bv, lanes *out)
{
	lanes f = { 0 };
	for (int i = 0; i <= m; i++, c += n + 1) {
		lanes row = { 0 };
		for (int j = 0; j <= n; j++)
			row += bv[j] * c[j];
		f += bu[i] * row;
	}
	*out = f;
}

static inline __attribute__((always_inline)) void sum_points(const double *c, int m, int n,
                                                             bool rational, const lanes *bu,
                                                             const lanes *bv, lanes out[4])
{
	lanes x = { 0 }, y = { 0 }, z = { 0 }, w = { 0 };
	for (int i = 0; i <= m; i++) {
		lanes rx = { 0 }, ry = { 0 }, rz = { 0 }, rw = { 0 };
		for (int j = 0; j <= n; j++, c += 4) {
			rx += bv[j] * c[0];
			ry += bv[j] * c[1];
			rz += bv[j] * c[2];
			if (rational)
				rw += bv[j] * c[3];
		}
		x += bu[i] * rx;
		y += bu[i] * ry;
		z += bu[i] * rz;
		w += bu[i] * rw;
	}
	out[0] = x;
	out[1] = y;
	out[2] = z;
	out[3] = rational ? w : (lanes){ 1, 1, 1, 1 };
}

WIDE void level_sample(const struct prover *p, const struct piece *x,
                       const struct proof_middle *mid, int from, int to, double out[NODES][4])
{
	const struct level *l = p->t->level;
	const struct level_surface *surface = l->surface;
	const double *match = mid->match, *step = mid->step;
	int m = l->degree[0], n = l->degree[1];
	int pm = surface->net.order[0] - 1, pn = surface->net.order[1] - 1;
	lanes bu[FIELD_DEGREE_MAX + 1], bv[FIELD_DEGREE_MAX + 1];
	for (int g = from; g < to; g++) {
		lanes s, r, uv[2], q[4], f;
		memcpy(&s, surface->proof.t[g], sizeof s);
		r = 1 - s;
		const lanes t = s + s * r * (match[0] + match[1] * (r - s) + match[2] * (s * r));
		r = 1 - t;
		lanes h0 = r * r * (1 + 2 * t), h1 = t * t * (1 + 2 * r), h2 = t * r * r,
		      h3 = t * t * r;
		for (int d = 0; d < 2; d++)
			uv[d] = h0 * x->uv[0][d] + h1 * x->uv[1][d] + h2 * x->duv[0][d] -
			        h3 * x->duv[1][d];
		if (pm == 3 && pn == 3 && !p->rational) {
			basis(3, &uv[0], bu);
			basis(3, &uv[1], bv);
			sum_points(p->t->points, 3, 3, false, bu, bv, q);
		} else {
			basis(pm, &uv[0], bu);
			basis(pn, &uv[1], bv);
			sum_points(p->t->points, pm, pn, p->rational, bu, bv, q);
		}
		if (surface->kind == LEVEL_PLANE && !p->t->own_field) {
			const double *d = l->direction;
			f = d[0] * q[0] + d[1] * q[1] + d[2] * q[2] + d[3] * q[3];
		} else if (m == 5 && n == 5) {
			basis(5, &uv[0], bu);
			basis(5, &uv[1], bv);
			sum_field(p->t->field, 5, 5, bu, bv, &f);
		} else {
			basis(m, &uv[0], bu);
			basis(n, &uv[1], bv);
			sum_field(p->t->field, m, n, bu, bv, &f);
		}
		lanes h[4];
		memcpy(h, surface->proof.h[g], sizeof h);
		for (int d = 0; d < 3; d++) {
			lanes at = h[0] * x->p[0][d] + h[1] * x->p[1][d] + h[2] * x->dp[0][d] +
			           h[3] * x->dp[1][d];
			q[d] = (at + f * step[d]) * q[3] - q[d];
		}
		for (int k = 0; k < LANES; k++) {
			for (int d = 0; d < 3; d++)
				out[GROUPS * k + g][d] = q[d][k];
			out[GROUPS * k + g][3] = f[k];
		}
	}
}

WIDE void level_sample_sums(const struct proof_tables *table, const double v[NODES][4],
                            double out[4])
{
	lanes even[HALF], odd[HALF];
	static const long long no_sign = 0x7fffffffffffffff;
	lanes sum = { 0 };
	for (int j = 0; j < HALF; j++) {
		lanes a, b;
		memcpy(&a, v[j], sizeof a);
		memcpy(&b, v[NODES - 1 - j], sizeof b);
		even[j] = a + b;
		odd[j] = a - b;
	}
	for (int k = 0; k < NODES; k++) {
		const lanes *x = k % 2 ? odd : even;
		lanes a = { 0 };
		for (int j = 0; j < HALF; j++)
			a += x[j] * table->cosine[k][j];
		sum += (lanes)((bits)a & no_sign);
	}
	memcpy(out, &sum, sizeof sum);
}
