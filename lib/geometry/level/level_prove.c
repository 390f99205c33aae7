/* level_prove.c - how far a fitted piece can be from the exact curve: a bound, not a sample.
 *
 * Let c be the piece in u,v, P the one in space, s a change of parameter that takes [0, 1] to itself.
 *   U: f(c(s(t))) is a polynomial. Its interpolant in Chebyshev's nodes is bounded by the sum of its
 *      coefficients, the rest by f's size on an ellipse about [0, 1] in the complex plane. Across the
 *      piece f has a slope that its second derivatives keep from vanishing, so that on either side,
 *      no further away than bound / slope, it has changed its sign: there the exact curve passes.
 *      The curve in u,v is within that of it.
 *   E: Let M be the step in space that changes f by 1 in the middle. To first order the exact curve is f M
 *      away from S(c(s(t))). P(t) - S(c(s(t))) + f(c(s(t))) M is bounded in the same way (times w where S is
 *      rational), and how much steps elsewhere can differ from M by the second derivatives of f and S.
 * Source: Trefethen, Approximation Theory and Approximation Practice, theorems 8.1 and 8.2.
 */
#include "level_private.h"

#include <math.h>
#include <string.h>

typedef double lanes __attribute__((vector_size(32)));

enum { NODES = PROOF_NODES, GROUPS = PROOF_GROUPS };

/* The ellipse's sum of half axes is the larger the shorter the piece, up to this. */
#define RHO_MAX 48.0
#define RHO_MIN 2.0

/* More bent than that proves nothing; else the curve is no further across than so many times f. */
#define BENT_MAX 0.75
#define ASIDE    4.0

/* A piece that uses so many tolerances in some nodes is not looked at in the others. */
#define USED_MAX 1.0

/* Where rounding is more than this part of the bounds in a box, those of the patch are looked at. */
#define ROUNDING_SHARE 0.5

/* A rest below this part of what it is added to is small enough. */
#define REST_SHARE 0.01

static double length3(const double *a)
{
	return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

static double power(double x, int n)
{
	double r = 1;
	for (; n > 0; n /= 2, x *= x)
		if (n % 2)
			r *= x;
	return r;
}

/* The middle of what second differences come to, and how far they are from it. */
struct range {
	double lo, hi;
};

static void range_add(struct range *r, double x)
{
	r->lo = smaller(r->lo, x);
	r->hi = larger(r->hi, x);
}

/* Second derivatives of f in a box of these widths, uu, uv, vv; the part of the spread that is rounding. */
static void second_bounds(const double *c, int m, int n, double error, const double width[2],
                          double second[3], double spread[3], double rounding[3])
{
	const double area[3] = { width[0] * width[0], width[0] * width[1], width[1] * width[1] };
	const size_t row = (size_t)n + 1;
	const double number[3] = { m * (m - 1.0), (double)m * n, n * (n - 1.0) };
	struct range r[3];
	for (int g = 0; g < 3; g++)
		r[g] = (struct range){ number[g] > 0 ? INFINITY : 0,
			               number[g] > 0 ? -INFINITY : 0 };
	for (int i = 0; i + 2 <= m; i++)
		for (const double *x = c + row * i; x < c + row * (i + 1); x++)
			range_add(&r[0], x[0] - 2 * x[row] + x[2 * row]);
	for (int i = 0; i + 1 <= m; i++)
		for (const double *x = c + row * i; x < c + row * (i + 1) - 1; x++)
			range_add(&r[1], x[0] - x[1] - x[row] + x[row + 1]);
	for (int i = 0; i <= m; i++)
		for (const double *x = c + row * i; x < c + row * (i + 1) - 2; x++)
			range_add(&r[2], x[0] - 2 * x[1] + x[2]);
	for (int g = 0; g < 3; g++) {
		rounding[g] = 4 * error * number[g] / area[g];
		second[g] = 0.5 * (r[g].lo + r[g].hi) * number[g] / area[g];
		spread[g] = 0.5 * (r[g].hi - r[g].lo) * number[g] / area[g] + rounding[g];
	}
}

/* In a small box rounding may be most of the bounds: those of the whole patch hold there, too. */
static void second_improve(struct prover *p, const double rounding[3])
{
	const struct tracer *t = p->t;
	const int *degree = t->level->degree;
	double second[3], spread[3], others[3];
	bool coarse = false;
	for (int g = 0; g < 3; g++)
		coarse |= rounding[g] > ROUNDING_SHARE * p->spread[g];
	if (!coarse)
		return;
	second_bounds(t->field, degree[0], degree[1], t->field_error, (double[2]){ 1, 1 }, second,
	              spread, others);
	for (int g = 0; g < 3; g++)
		if (spread[g] < p->spread[g]) {
			p->second[g] = second[g];
			p->spread[g] = spread[g];
		}
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
	p->t = t;
	p->box = *box;
	p->shape = s->shapes + t->patch;
	p->rational = s->net.rational;
	const double hu = box->hi[0] - box->lo[0], hv = box->hi[1] - box->lo[1];
	double rounding[3];
	second_bounds(c, degree[0], degree[1], error, (double[2]){ hu, hv }, p->second, p->spread,
	              rounding);
	second_improve(p, rounding);
	for (int d = 0; d < 2; d++) {
		const double *b = s->net.breaks[d] + t->place[d];
		p->width[d] = b[1] - b[0];
	}
	p->diameter = p->shape->first[0] * hu + p->shape->first[1] * hv;
	p->diameter_uv = length2(p->width[0] * hu, p->width[1] * hv);
	p->error = t->bound.error + (degree[0] + degree[1] + 8) * 4 * UNIT_ROUNDOFF * t->bound.size;
}

/* Of the second derivatives, taken along a and b: the largest in the cell, or that far outside. */
static double second_along(const struct prover *p, const double a[2], const double b[2],
                           double more)
{
	const double mixed[3] = { a[0] * b[0], a[0] * b[1] + a[1] * b[0], a[1] * b[1] };
	double middle = 0, spread = 0;
	for (int g = 0; g < 3; g++) {
		middle += mixed[g] * p->second[g];
		spread += fabs(mixed[g]) * p->spread[g];
	}
	return fabs(middle) + more * spread;
}

/*
 * How much the slope across can differ from that in the middle. All places are the middle, and parts of the
 * piece's own direction there and of that across.
 */
static double slope_change(const struct prover *p, const double cubic[2][4],
                           const struct proof_middle *mid, double f, double more)
{
	const double along[2] = { cubic[0][1], cubic[1][1] }, *across = mid->across;
	const double per_area = 1 / (along[0] * across[1] - along[1] * across[0]);
	const double half[4] = { 1, 0.5, 0.25, 0.125 };
	double reach[2] = { 0.5, ASIDE * f };
	for (int k = 0; k < 4; k++) {
		const double x = cubic[0][k] - (k == 0 ? mid->uv[0] : 0);
		const double y = cubic[1][k] - (k == 0 ? mid->uv[1] : 0);
		if (k == 1)
			continue;
		reach[0] += half[k] * fabs((x * across[1] - y * across[0]) * per_area);
		reach[1] += half[k] * fabs((along[0] * y - along[1] * x) * per_area);
	}
	return reach[0] * second_along(p, along, across, more) +
	       reach[1] * second_along(p, across, across, more);
}

/* c in powers of t - 1/2; how far it goes from its middle, from the place of which the slope is known, and
 * out of the box (below 0: it stays so far inside), in parts of that. */
struct course {
	double cubic[2][4], span[2], away[2], outside[2];
};

static void course_set(const struct prover *p, const struct piece *x,
                       const struct proof_middle *mid, struct course *c)
{
	for (int d = 0; d < 2; d++) {
		const double a = x->uv[0][d], b = x->uv[1][d], da = x->duv[0][d], db = x->duv[1][d];
		double *k = c->cubic[d];
		k[0] = 0.5 * (a + b) + 0.125 * (da - db);
		k[1] = 1.5 * (b - a) - 0.25 * (da + db);
		k[2] = 0.5 * (db - da);
		k[3] = da + db - 2 * (b - a);
		c->span[d] = 0.5 * fabs(k[1]) + 0.25 * fabs(k[2]) + 0.125 * fabs(k[3]);
		c->away[d] = c->span[d] + fabs(k[0] - mid->uv[d]);
		const double lo = p->box.lo[d], hi = p->box.hi[d];
		const double over = larger(lo - (k[0] - c->span[d]), k[0] + c->span[d] - hi);
		c->outside[d] = over / (hi - lo);
	}
}

/* What the interpolants leave out, of f and of w (P - S + f M). */
struct rest {
	double f, s;
};

/* From the sizes on the ellipse with that sum of half axes. */
static struct rest rest_at(const struct prover *p, const double cubic[2][4],
                           const struct proof_middle *mid, double across, double rho)
{
	const struct level *l = p->t->level;
	const struct level_surface *surface = l->surface;
	double sigma = 0.5 * (rho + 1 / rho), growth[2], reach;
	const double square = sigma * sigma / 4, *match = mid->match; /* of t (1 - t) */
	reach = 0.5 * sigma +
	        square * (fabs(match[0]) + sigma * fabs(match[1]) + square * fabs(match[2]));
	for (int d = 0; d < 2; d++) {
		double beyond = larger(0, larger(-cubic[d][0], cubic[d][0] - 1));
		growth[d] =
		        1 + 2 * (beyond +
		                 reach * (fabs(cubic[d][1]) +
		                          reach * (fabs(cubic[d][2]) + reach * fabs(cubic[d][3]))));
	}
	double rest = 4 / (power(rho, NODES - 1) * (rho - 1));
	double f =
	        rest * p->t->most * power(growth[0], l->degree[0]) * power(growth[1], l->degree[1]);
	/* P is a cubic, its points no further from the patch's first than the patch */
	double weight = p->shape->weight[1] * power(growth[0], surface->net.order[0] - 1) *
	                power(growth[1], surface->net.order[1] - 1);
	return (struct rest){ f, rest * weight * p->shape->radius *
		                                 (p->rational ? 1 + 2 * power(sigma, 3) : 1) +
		                         f * across * (p->rational ? weight : 1) };
}

/* From the largest ellipse, or a smaller one where that leaves too much: with high degrees the sizes grow
 * faster on it than the rest falls. sum: what the interpolants themselves come to. */
static struct rest rest_least(const struct prover *p, const struct course *c,
                              const struct proof_middle *mid, double step, const double sum[4])
{
	const double span = larger(c->span[0], c->span[1]);
	const double tolerance = p->t->level->tolerance, weight = p->shape->weight[0];
	const double enough_f = REST_SHARE * larger(sum[3], tolerance / step),
	             enough_s = REST_SHARE * larger(length3(sum), tolerance * weight);
	double rho = smaller(4 / larger(2 * span, 1e-3), RHO_MAX);
	struct rest best = rest_at(p, c->cubic, mid, step, rho);
	while ((best.f > enough_f || best.s > enough_s) && (rho /= 1.5) > RHO_MIN) {
		struct rest x = rest_at(p, c->cubic, mid, step, rho);
		best.f = smaller(best.f, x.f);
		best.s = smaller(best.s, x.s);
	}
	return best;
}

/* How much the step across can differ from that in the middle, on the piece and as far across from it as the
 * curve may be: its slope, its length. */
struct change {
	double bent, turned;
};

static struct change change_bounds(const struct prover *p, const struct course *c,
                                   const struct proof_middle *mid, double f)
{
	const struct level *l = p->t->level;
	const double w[2] = { fabs(mid->across[0]), fabs(mid->across[1]) };
	const double *second = p->shape->second;
	double away[2], more = 1;
	for (int d = 0; d < 2; d++) {
		const double aside = ASIDE * f * w[d];
		away[d] = c->away[d] + aside;
		const double out = c->outside[d] + aside / (p->box.hi[d] - p->box.lo[d]);
		more *= power(1 + 2 * larger(0, out), l->degree[d]);
	}
	return (struct change){
		2 * p->error * (w[0] * l->degree[0] + w[1] * l->degree[1]) +
		        slope_change(p, c->cubic, mid, f, more),
		w[0] * (second[0] * away[0] + second[1] * away[1]) +
		        w[1] * (second[1] * away[0] + second[2] * away[1]),
	};
}

/* The largest in a group of nodes, of the tolerances. */
static double used_at(const struct prover *p, double step_uv, const double v[NODES][4], int g)
{
	const struct level *l = p->t->level;
	double most = 0, f = 0;
	for (int j = g; j < NODES; j += GROUPS) {
		most = larger(most, v[j][0] * v[j][0] + v[j][1] * v[j][1] + v[j][2] * v[j][2]);
		f = larger(f, fabs(v[j][3]));
	}
	return larger(sqrt(most) / (p->shape->weight[1] * l->tolerance),
	              f * step_uv / l->tolerance_uv);
}

bool level_prove(const struct prover *p, const struct piece *x, const struct proof_middle *mid,
                 struct proof *out)
{
	const struct level *l = p->t->level;
	const struct level_surface *surface = l->surface;
	const double *q = mid->match;
	double v[NODES][4], sum[4];
	struct course c;
	course_set(p, x, mid, &c);
	const double step = length3(mid->step),
	             step_uv = length2(mid->across[0] * p->width[0], mid->across[1] * p->width[1]);
	out->used = 0;
	out->bent = false;
	/* the parameter stays in [0, 1] */
	if (!(fabs(q[0]) + fabs(q[1]) + fabs(q[2]) / 4 < 0.9))
		return false;
	level_sample(p, x, mid, 0, 1, v);
	out->used = used_at(p, step_uv, v, 0);
	if (out->used > USED_MAX)
		return false;
	level_sample(p, x, mid, 1, GROUPS, v);
	level_sample_sums(&surface->proof, v, sum);
	struct rest rest = rest_least(p, &c, mid, step, sum);
	const double f = sum[3] + rest.f + p->error;
	const double e = (length3(sum) + rest.s) / p->shape->weight[0] +
	                 4 * (surface->of_points.error + 16 * UNIT_ROUNDOFF * surface->reach) +
	                 2 * p->error * step;
	const struct change change = change_bounds(p, &c, mid, f);
	out->bent = !(change.bent < BENT_MAX);
	if (out->bent)
		return false;
	out->space = e + f * (step * change.bent + change.turned) / (1 - change.bent);
	out->uv = f * step_uv / (1 - change.bent);
	out->rounding[0] = p->error * step;
	out->rounding[1] = p->error * step_uv;
	out->used = larger(out->space / l->tolerance, out->uv / l->tolerance_uv);
	return isfinite(out->space) && isfinite(out->uv);
}
