/* level_prove.c - how far a fitted piece can be from the exact curve: a bound, not a sample.
 *
 * Let c be the piece in u,v, P the one in space, s a change of parameter that takes [0, 1] to itself.
 *   U: f(c(s(t))) is a polynomial. Its interpolant in Chebyshev's nodes is bounded by the sum of its
 *      coefficients, the rest by f's size on an ellipse about [0, 1] in the complex plane. Across the
 *      piece f has a slope that its second derivatives keep from vanishing, so that on either side,
 *      no further away than bound / slope, it has changed its sign: there the exact curve passes.
 *   E: P(t) - S(c(s(t))) is bounded in the same way (times w where S is rational).
 * The curve in u,v is within U, the curve in space within E + U.
 * Source: Trefethen, Approximation Theory and Approximation Practice, theorems 8.1 and 8.2.
 */
#include "level_private.h"

#include <math.h>
#include <string.h>

typedef double lanes __attribute__((vector_size(32)));

enum { LANES = 4, NODES = PROOF_NODES, HALF = NODES / 2 };

/* The ellipse's sum of half axes is the larger the shorter the piece, up to this. */
#define RHO_MAX 48.0
#define RHO_MIN 2.0

/* A rest below this part of what it is added to is small enough. */
#define REST_SHARE 0.01

void level_proof_tables(struct proof_tables *p)
{
	for (int j = 0; j < NODES; j++) {
		double t = 0.5 - 0.5 * cos(M_PI * (j + 0.5) / NODES), s = 1 - t;
		p->t[j] = t;
		double(*h)[LANES] = p->h[j / LANES];
		h[0][j % LANES] = s * s * (1 + 2 * t);
		h[1][j % LANES] = t * t * (1 + 2 * s);
		h[2][j % LANES] = t * s * s;
		h[3][j % LANES] = -t * t * s;
	}
	for (int k = 0; k < NODES; k++)
		for (int j = 0; j < HALF; j++)
			p->cosine[k][j] =
			        (k == 0 ? 1.0 : 2.0) / NODES * cos(M_PI * k * (j + 0.5) / NODES);
}

static double power(double x, int n)
{
	double r = 1;
	for (; n > 0; n /= 2, x *= x)
		if (n % 2)
			r *= x;
	return r;
}

/* Largest second derivatives of f in the cell: uu, uv, vv, in the patch's parameters. */
static void second_bounds(const double *c, int m, int n, double error, double out[3])
{
	size_t row = (size_t)n + 1;
	double uu = 0, uv = 0, vv = 0;
	for (int i = 0; i <= m; i++)
		for (int j = 0; j <= n; j++) {
			const double *x = c + row * i + j;
			if (i + 2 <= m)
				uu = larger(uu, fabs(x[0] - 2 * x[row] + x[2 * row]));
			if (j + 2 <= n)
				vv = larger(vv, fabs(x[0] - 2 * x[1] + x[2]));
			if (i < m && j < n)
				uv = larger(uv, fabs(x[0] - x[1] - x[row] + x[row + 1]));
		}
	out[0] = (uu + 4 * error) * m * (m - 1);
	out[1] = (uv + 4 * error) * m * n;
	out[2] = (vv + 4 * error) * n * (n - 1);
}

/* Largest derivative of forms y (three components and a weight), i times in u and j times in v, each
 * taken as a sum of four coefficients; [1]: of the weight. */
WIDE static void derivative_most(const lanes *y, int m, int n, int i, int j, double out[2])
{
	size_t row = (size_t)n + 1, du = i > 0 ? row : 0, dv = j > 0 ? 1 : 0;
	bool mixed = i == 1 && j == 1, twice = i == 2 || j == 2;
	size_t step = du + dv, second = mixed ? du : twice ? step : 0;
	size_t third = mixed ? dv : twice ? 2 * step : step;
	double middle = mixed || twice ? -1 : 0;
	size_t last = mixed ? step : twice ? step : 0;
	double first = i + j == 0 ? 0 : i + j == 1 ? -1 : 1, end = mixed ? 1 : twice ? -1 : 0;
	double third_by = mixed ? -1 : 1, most = 0, weight = 0;
	for (int a = 0; a <= m - i; a++)
		for (int b = 0; b <= n - j; b++) {
			const lanes *x = y + row * a + b;
			lanes sum = first * x[0] + middle * x[second] + third_by * x[third] +
			            end * x[last];
			lanes square = sum * sum;
			most = larger(most, square[0] + square[1] + square[2]);
			weight = larger(weight, square[3]);
		}
	double factor =
	        (i > 0 ? m : 1.0) * (i > 1 ? m - 1 : 1) * (j > 0 ? n : 1) * (j > 1 ? n - 1 : 1);
	out[0] = factor * sqrt(most);
	out[1] = factor * sqrt(weight);
}

/*
 * For Y = X - w S0: |Sd| <= (|Yd| + |wd| R) / w and |Sde| <= (|Yde| + |wd| |Se| + |we| |Sd| + |wde| R)
 * / w, R the reach from S0.
 */
void level_shape_of_patch(const double *c, int m, int n, struct patch_shape *out)
{
	double y[2], first[2][2], second[2];
	static const int by[3][2] = { { 2, 0 }, { 1, 1 }, { 0, 2 } };
	size_t points = (size_t)(m + 1) * (n + 1);
	out->weight[0] = out->weight[1] = c[3];
	for (size_t i = 0; i < points; i++) {
		out->weight[0] = smaller(out->weight[0], c[4 * i + 3]);
		out->weight[1] = larger(out->weight[1], c[4 * i + 3]);
	}
	double w = out->weight[0];
	lanes from[ORDER_MAX * ORDER_MAX];
	for (size_t i = 0; i < points; i++) {
		const double *p = c + 4 * i, r = p[3] / c[3];
		from[i] = (lanes){ p[0] - c[0] * r, p[1] - c[1] * r, p[2] - c[2] * r, p[3] };
	}
	derivative_most(from, m, n, 0, 0, y);
	out->radius = y[0] / w;
	for (int d = 0; d < 2; d++) {
		derivative_most(from, m, n, d == 0, d == 1, first[d]);
		out->first[d] = (first[d][0] + first[d][1] * out->radius) / w;
	}
	for (int g = 0; g < 3; g++) {
		int a = g == 2, b = g > 0;
		derivative_most(from, m, n, by[g][0], by[g][1], second);
		out->second[g] = (second[0] + first[a][1] * out->first[b] +
		                  first[b][1] * out->first[a] + second[1] * out->radius) /
		                 w;
	}
}

void level_prover_init(struct prover *p, const struct tracer *t, const struct cell_range *box,
                       const double *c, double error)
{
	const struct level_surface *s = t->level->surface;
	const int *degree = t->level->degree;
	double second[3];
	p->t = t;
	p->box = *box;
	p->shape = s->shapes + t->patch;
	p->rational = s->net.rational;
	second_bounds(c, degree[0], degree[1], error, second);
	double hu = box->hi[0] - box->lo[0], hv = box->hi[1] - box->lo[1];
	p->second[0] = second[0] / (hu * hu);
	p->second[1] = second[1] / (hu * hv);
	p->second[2] = second[2] / (hv * hv);
	for (int d = 0; d < 2; d++) {
		const double *b = s->net.breaks[d] + t->place[d];
		p->width[d] = b[1] - b[0];
	}
	p->diameter = p->shape->first[0] * hu + p->shape->first[1] * hv;
	p->diameter_uv = length2(p->width[0] * hu, p->width[1] * hv);
	p->error = t->bound.error + (degree[0] + degree[1] + 8) * 4 * UNIT_ROUNDOFF * t->bound.size;
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

/* w (P - S) and f in the nodes. s: the places of c that belong to them. */
WIDE static void sample(const struct prover *p, const struct piece *x, const double *s,
                        double out[NODES][4])
{
	const struct level *l = p->t->level;
	const struct level_surface *surface = l->surface;
	int m = l->degree[0], n = l->degree[1];
	int pm = surface->net.order[0] - 1, pn = surface->net.order[1] - 1;
	lanes bu[FIELD_DEGREE_MAX + 1], bv[FIELD_DEGREE_MAX + 1];
	for (int g = 0; g < NODES; g += LANES) {
		lanes t, r, uv[2], q[4], f;
		memcpy(&t, s + g, sizeof t);
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
		memcpy(h, surface->proof.h[g / LANES], sizeof h);
		for (int d = 0; d < 3; d++) {
			lanes at = h[0] * x->p[0][d] + h[1] * x->p[1][d] + h[2] * x->dp[0][d] +
			           h[3] * x->dp[1][d];
			q[d] = at * q[3] - q[d];
		}
		for (int k = 0; k < LANES; k++) {
			for (int d = 0; d < 3; d++)
				out[g + k][d] = q[d][k];
			out[g + k][3] = f[k];
		}
	}
}

/* Sums of the Chebyshev coefficients' sizes. */
WIDE static void coefficient_sums(const struct proof_tables *table, const double v[NODES][4],
                                  double out[4])
{
	lanes even[HALF], odd[HALF];
	double coefficient[LANES];
	memset(out, 0, sizeof coefficient);
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
		memcpy(coefficient, &a, sizeof a);
		for (int d = 0; d < LANES; d++)
			out[d] += fabs(coefficient[d]);
	}
}

/* What the interpolants leave out, of f and of w (P - S). */
struct rest {
	double f, s;
};

/* From the sizes on the ellipse with that sum of half axes. */
static struct rest rest_at(const struct prover *p, const double cubic[2][4],
                           const struct proof_middle *mid, double rho)
{
	const struct level *l = p->t->level;
	const struct level_surface *surface = l->surface;
	double sigma = 0.5 * (rho + 1 / rho), growth[2], reach;
	reach = 0.5 * sigma + 0.25 * sigma * sigma * sigma * fabs(mid->first) +
	        0.0625 * sigma * sigma * sigma * sigma * fabs(mid->second);
	for (int d = 0; d < 2; d++) {
		double beyond = larger(0, larger(-cubic[d][0], cubic[d][0] - 1));
		growth[d] =
		        1 + 2 * (beyond +
		                 reach * (fabs(cubic[d][1]) +
		                          reach * (fabs(cubic[d][2]) + reach * fabs(cubic[d][3]))));
	}
	double rest = 4 / (power(rho, NODES - 1) * (rho - 1));
	/* P is a cubic, its points no further from the patch's first than the patch */
	return (struct rest){ rest * p->t->most * power(growth[0], l->degree[0]) *
		                      power(growth[1], l->degree[1]),
		              rest * p->shape->weight[1] * p->shape->radius *
		                      (p->rational ? 1 + 2 * power(sigma, 3) : 1) *
		                      power(growth[0], surface->net.order[0] - 1) *
		                      power(growth[1], surface->net.order[1] - 1) };
}

/* From the largest ellipse, or a smaller one where that leaves too much: with high degrees the sizes grow
 * faster on it than the rest falls. sum: what the interpolants themselves come to. */
static struct rest rest_least(const struct prover *p, const double cubic[2][4],
                              const struct proof_middle *mid, double span, const double sum[4])
{
	double rho = smaller(4 / larger(2 * span, 1e-3), RHO_MAX);
	struct rest best = rest_at(p, cubic, mid, rho);
	while ((best.f > REST_SHARE * sum[3] || best.s > REST_SHARE * (sum[0] + sum[1] + sum[2])) &&
	       (rho /= 1.5) > RHO_MIN) {
		struct rest x = rest_at(p, cubic, mid, rho);
		best.f = smaller(best.f, x.f);
		best.s = smaller(best.s, x.s);
	}
	return best;
}

bool level_prove(const struct prover *p, const struct piece *x, const struct proof_middle *mid,
                 struct proof *out)
{
	const struct level *l = p->t->level;
	const struct level_surface *surface = l->surface;
	const struct proof_tables *table = &surface->proof;
	double s[NODES], v[NODES][4], sum[4], span[2], away[2], outside = 0;
	/* c in powers of t - 1/2: how far it goes from its middle, really and on the ellipse */
	double cubic[2][4];
	for (int d = 0; d < 2; d++) {
		double a = x->uv[0][d], b = x->uv[1][d], da = x->duv[0][d], db = x->duv[1][d];
		cubic[d][0] = 0.5 * (a + b) + 0.125 * (da - db);
		cubic[d][1] = 1.5 * (b - a) - 0.25 * (da + db);
		cubic[d][2] = 0.5 * (db - da);
		cubic[d][3] = da + db - 2 * (b - a);
		span[d] = 0.5 * fabs(cubic[d][1]) + 0.25 * fabs(cubic[d][2]) +
		          0.125 * fabs(cubic[d][3]);
		away[d] = span[d] + fabs(cubic[d][0] - mid->uv[d]);
		double lo = p->box.lo[d], hi = p->box.hi[d];
		double over = larger(lo - (cubic[d][0] - span[d]), cubic[d][0] + span[d] - hi);
		outside = larger(outside, over / (hi - lo));
	}
	for (int j = 0; j < NODES; j++) {
		double t = table->t[j], r = 1 - t;
		s[j] = t + t * r * (mid->first * (1 - 2 * t) + mid->second * t * r);
	}
	if (fabs(mid->first) + fabs(mid->second) > 0.5)
		return false;
	sample(p, x, s, v);
	coefficient_sums(table, v, sum);

	struct rest rest = rest_least(p, cubic, mid, larger(span[0], span[1]), sum);
	double f = sum[3] + rest.f + p->error;
	double e = (sqrt(sum[0] * sum[0] + sum[1] * sum[1] + sum[2] * sum[2]) + rest.s) /
	                   p->shape->weight[0] +
	           4 * (surface->of_points.error + 16 * UNIT_ROUNDOFF * surface->reach);

	/* f's slope across, 1 in the middle, and the length of a step across */
	double w[2] = { fabs(mid->across[0]), fabs(mid->across[1]) };
	double slope_error = 2 * p->error * (w[0] * l->degree[0] + w[1] * l->degree[1]);
	for (int d = 0; d < 2; d++) {
		away[d] += 2 * f * w[d];
		outside = larger(outside, 0) + 2 * f * w[d] / (p->box.hi[d] - p->box.lo[d]);
	}
	const double *b = p->second, *c = p->shape->second;
	double more = power(1 + 2 * outside, l->degree[0] + l->degree[1]);
	double bent = slope_error + more * (w[0] * (b[0] * away[0] + b[1] * away[1]) +
	                                    w[1] * (b[1] * away[0] + b[2] * away[1]));
	double turned =
	        w[0] * (c[0] * away[0] + c[1] * away[1]) + w[1] * (c[1] * away[0] + c[2] * away[1]);
	if (!(bent < 0.5))
		return false;
	double step = (mid->step + turned) / (1 - bent);
	double step_uv = length2(w[0] * p->width[0], w[1] * p->width[1]);
	*out = (struct proof){ e + f * step,
		               f * step_uv / (1 - bent),
		               { p->error * mid->step, p->error * step_uv } };
	return isfinite(out->space) && isfinite(out->uv);
}
