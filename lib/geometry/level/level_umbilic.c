/* level_umbilic.c - points of a patch where both principal curvatures are one.
 *
 * With E, F, G and L, M, N, up to positive factors, they are those where
 *   a = E M - F L = 0,  b = E N - G L = 0,  c = F N - G M = 0.
 * G a - F b + E c = 0, so a = b = 0 is enough where E > 0. A cell in which one of the three has a sure sign holds
 * none. In others (a, b) is multiplied by the inverse of its derivative: where its derivatives are then nearer to
 * the identity than theta all over a box of twice the size, there is one zero at most, and there is one if the value in the
 * middle is below (1 - theta) times half the box: Newton's step with that inverse takes the box into itself.
 * The sign of the derivative's determinant tells how principal directions turn about it: half round with or against.
 * At a pole, S = P + v C(u) + .., a, b, c have the factors v^3, v^2, v (v at the side v = 0); if another one is
 * in all three, the pole is an umbilic.
 * Source: Krawczyk, Newton-Algorithmen zur Bestimmung von Nullstellen mit Fehlerschranken. Computing 4 (1969).
 */
#include <math.h>
#include <string.h>

#include "level_second.h"

enum { A, B, C, N_EQUATIONS };

/* Cells are judged from this level on: so the boxes about them go little beyond the patch. */
enum { JUDGE_LEVEL = 4, DEPTH_MAX = 20 };

/* A patch with many cells that stay unsure is not halved so far any more. */
enum { FEW = 64, MANY = 512, DEPTH_AFTER_FEW = 10, DEPTH_AFTER_MANY = 6 };

/* At most so many factors of a pole. */
enum { FACTORS_MAX = 8 };

/* A zero so little outside the patch is on its side. */
#define SIDE_SLACK 1e-9

#define THETA_MAX 0.5

struct search {
	struct tracer *t;
	int m, n;
	size_t count;
	double *c;    /* a, b, c on the patch */
	double *near; /* a, b on the box about a cell */
	double error[N_EQUATIONS], zero[N_EQUATIONS];
	double *rooms[2 * DEPTH_MAX + 2];
};

static void umbilic_add(struct tracer *t, const struct umbilic *x)
{
	struct umbilic *to = list_next(&t->umbilics, sizeof *to);
	if (to)
		*to = *x;
	else
		t->failed = true;
}

static void box_add(struct tracer *t, const double lo[2], const double hi[2], int kind)
{
	struct umbilic x = { .kind = kind };
	for (int d = 0; d < 2; d++) {
		x.lo[d] = lo[d];
		x.hi[d] = hi[d];
		x.at[d] = 0.5 * (lo[d] + hi[d]);
	}
	umbilic_add(t, &x);
}

static void side_add(struct tracer *t, int d, bool upper, int kind)
{
	double lo[2] = { 0, 0 }, hi[2] = { 1, 1 };
	lo[d] = hi[d] = upper;
	box_add(t, lo, hi, kind);
}

/* a b - c d; its size that of the terms. */
static struct form minor(struct tracer *t, struct form a, struct form b, struct form c,
                         struct form d)
{
	struct form out = form_new(t, a.m + b.m, a.n + b.n);
	second_add_product(t, &out, a, b, 1);
	second_add_product(t, &out, c, d, -1);
	return out;
}

static void equations_make(struct tracer *t, struct form out[N_EQUATIONS])
{
	struct second_parts p;
	second_parts_make(t, &p);
	const struct form e = second_dot(t, p.d[DU], p.d[DU]), f = second_dot(t, p.d[DU], p.d[DV]),
	                  g = second_dot(t, p.d[DV], p.d[DV]);
	const struct form l = second_dot(t, p.d[DUU], p.n), m = second_dot(t, p.d[DUV], p.n),
	                  n = second_dot(t, p.d[DVV], p.n);
	out[A] = minor(t, e, m, f, l);
	out[B] = minor(t, e, n, g, l);
	out[C] = minor(t, f, n, g, m);
}

static bool is_pole(const struct tracer *t, int d, bool upper)
{
	const struct level_surface *s = t->level->surface;
	const int line = t->place[d] + upper;
	return s->edges[d][d == 0 ? level_edge(s, 0, line, t->place[1])
	                          : level_edge(s, 1, t->place[0], line)] == EDGE_POLE;
}

/* Take out the factors of a side without normals; what that side itself is, is told here. */
static void side_divide(struct tracer *t, struct form f[N_EQUATIONS], int d, bool upper)
{
	const int known[N_EQUATIONS] = { d == 1 ? 3 : 1, 2, d == 1 ? 1 : 3 };
	const unsigned char factors = t->level->surface->factors[4 * t->patch + 2 * d + upper];
	bool fewer = factors != 1 || !is_pole(t, d, upper), more = true;
	if (factors == 0)
		return;
	for (int k = 0; k < N_EQUATIONS; k++) {
		int times = 0;
		for (; times < FACTORS_MAX && second_side_zero(t, &f[k], d, upper); times++) {
			form_divide(f[k].c, f[k].m, f[k].n, d, upper);
			f[k].b.error *= (d == 0 ? f[k].m : f[k].n) + 1;
		}
		fewer |= times < known[k];
		more &= times > known[k];
	}
	if (fewer || more)
		side_add(t, d, upper, fewer ? UMBILIC_UNSURE : UMBILIC_POLE);
}

/* All three to the same degrees, as coefficients. False where there is nothing to look for. */
static bool search_init(struct search *s, struct tracer *t)
{
	struct form f[N_EQUATIONS];
	bool flat = true;
	t->n_product = 0;
	equations_make(t, f);
	for (int k = 0; k < N_EQUATIONS; k++) {
		struct form plain = f[k];
		form_tighten(t, &plain);
		s->zero[k] = ZERO_SHARE * f[k].b.size;
		flat &= plain.b.size <= larger(f[k].b.error, s->zero[k]);
	}
	if (t->failed)
		return false;
	if (flat) {
		box_add(t, (double[2]){ 0, 0 }, (double[2]){ 1, 1 }, UMBILIC_FLAT);
		return false;
	}
	for (int side = 0; side < 4; side++)
		side_divide(t, f, side / 2, side % 2);
	s->t = t;
	for (int k = 0; k < N_EQUATIONS; k++) {
		s->m = f[k].m > s->m ? f[k].m : s->m;
		s->n = f[k].n > s->n ? f[k].n : s->n;
	}
	s->count = form_count(s->m, s->n);
	s->c = level_room(t, N_EQUATIONS * s->count);
	s->near = level_room(t, 2 * s->count);
	for (int k = 0; !t->failed && k < N_EQUATIONS; k++) {
		struct form same = form_new(t, s->m, s->n);
		form_add(t, &same, f[k], 1);
		form_scale(same.c, s->m, s->n, t->level->surface->binomial, true);
		memcpy(s->c + k * s->count, same.c, sizeof *same.c * s->count);
		s->error[k] = same.b.error;
	}
	return !t->failed;
}

/* (a, b) over a box, as a map of [0, 1]^2, times a matrix that makes its derivative nearly the identity. */
struct chart {
	const double *c[2];
	int m, n;
	double error[2]; /* of the coefficients */
	double value[2]; /* of a value */
	double by[2][2], det;
};

/* Derivative k of equation e at coefficient i, j; false where there is none. */
static bool slope_at(const struct chart *x, int e, int d, int i, int j, double *out)
{
	const size_t row = (size_t)x->n + 1;
	const double *c = x->c[e] + row * i + j;
	if (d == 0 ? i == x->m : j == x->n)
		return false;
	*out = d == 0 ? x->m * (c[row] - c[0]) : x->n * (c[1] - c[0]);
	return true;
}

static bool chart_set(struct chart *x)
{
	double mean[2][2] = { { 0 } };
	for (int e = 0; e < 2; e++)
		for (int d = 0; d < 2; d++) {
			int number = 0;
			double slope;
			for (int i = 0; i <= x->m; i++)
				for (int j = 0; j <= x->n; j++)
					if (slope_at(x, e, d, i, j, &slope)) {
						mean[e][d] += slope;
						number++;
					}
			mean[e][d] /= number > 0 ? number : 1;
		}
	x->det = mean[0][0] * mean[1][1] - mean[0][1] * mean[1][0];
	if (!(fabs(x->det) > 0))
		return false;
	x->by[0][0] = mean[1][1] / x->det;
	x->by[0][1] = -mean[0][1] / x->det;
	x->by[1][0] = -mean[1][0] / x->det;
	x->by[1][1] = mean[0][0] / x->det;
	return isfinite(x->by[0][0] + x->by[0][1] + x->by[1][0] + x->by[1][1]);
}

/* How far the derivatives are from the identity, as a bound of sums of rows. */
static double chart_theta(const struct chart *x)
{
	double most = 0;
	for (int r = 0; r < 2; r++) {
		const double *by = x->by[r];
		double away[2] = { 0 }, sum = 0;
		for (int d = 0; d < 2; d++) {
			for (int i = 0; i <= x->m; i++)
				for (int j = 0; j <= x->n; j++) {
					double a, b;
					if (slope_at(x, 0, d, i, j, &a) &&
					    slope_at(x, 1, d, i, j, &b))
						away[d] =
						        larger(away[d], fabs(by[0] * a + by[1] * b -
						                             (r == d)));
				}
			sum += away[d] +
			       2.0001 * (d == 0 ? x->m : x->n) *
			               (fabs(by[0]) * x->error[0] + fabs(by[1]) * x->error[1]);
		}
		most = larger(most, sum);
	}
	return most;
}

static void chart_value(const struct chart *x, const double at[2], double g[2], double error[2])
{
	double f[2], fu, fv;
	for (int e = 0; e < 2; e++)
		form_evaluate(x->c[e], x->m, x->n, at[0], at[1], &f[e], &fu, &fv);
	for (int r = 0; r < 2; r++) {
		g[r] = x->by[r][0] * f[0] + x->by[r][1] * f[1];
		error[r] = fabs(x->by[r][0]) * x->value[0] + fabs(x->by[r][1]) * x->value[1];
	}
}

static double growth_of(double outside, int degree)
{
	double g = 1;
	for (int i = 0; i < degree; i++)
		g *= 1 + 2 * outside;
	return g;
}

/* a and b on the box about a cell that goes half of it beyond its sides. */
static void chart_make(const struct search *s, const double lo[2], const double hi[2],
                       struct chart *x)
{
	double growth = 1;
	*x = (struct chart){ .m = s->m, .n = s->n };
	for (int d = 0; d < 2; d++)
		growth *= growth_of(larger(0, larger(-lo[d], hi[d] - 1)), d == 0 ? s->m : s->n);
	memcpy(s->near, s->c, sizeof *s->c * 2 * s->count);
	for (int e = 0; e < 2; e++) {
		double *c = s->near + e * s->count;
		const double rounding = form_part_error(c, s->m, s->n);
		for (int d = 0; d < 2; d++) {
			/* the outer side first: what is left is not stretched then */
			form_part(c, s->m, s->n, d, lo[d], 1);
			form_part(c, s->m, s->n, d, 0, (hi[d] - lo[d]) / (1 - lo[d]));
		}
		x->c[e] = c;
		x->error[e] = growth * (s->error[e] + 2 * rounding);
		x->value[e] = x->error[e] + form_part_error(c, s->m, s->n);
	}
}

enum verdict { UNSURE, NONE, ONE };

/* Is there a zero in the cell, or one in the box about it and no other? */
static enum verdict cell_judge(const struct search *s, const double lo[2], const double hi[2],
                               struct umbilic *out)
{
	struct chart x;
	double wide[2][2], at[2] = { 0.5, 0.5 }, g[2], error[2];
	for (int d = 0; d < 2; d++) {
		wide[0][d] = lo[d] - 0.5 * (hi[d] - lo[d]);
		wide[1][d] = hi[d] + 0.5 * (hi[d] - lo[d]);
	}
	chart_make(s, wide[0], wide[1], &x);
	if (!chart_set(&x))
		return UNSURE;
	const double theta = chart_theta(&x);
	if (!(theta < THETA_MAX))
		return UNSURE;
	chart_value(&x, at, g, error);
	for (int r = 0; r < 2; r++)
		if (fabs(g[r]) - error[r] > 0.25 * (1 + theta))
			return NONE;
	if (larger(fabs(g[0]) + error[0], fabs(g[1]) + error[1]) > 0.5 * (1 - theta))
		return UNSURE;
	for (int step = 0; step < 60 && larger(fabs(g[0]), fabs(g[1])) > 1e-15; step++) {
		for (int d = 0; d < 2; d++)
			at[d] = smaller(larger(at[d] - g[d], 0), 1);
		chart_value(&x, at, g, error);
	}
	const double radius = larger(fabs(g[0]) + error[0], fabs(g[1]) + error[1]) / (1 - theta);
	*out = (struct umbilic){ .kind = UMBILIC_ONE, .turn = x.det > 0 ? 1 : -1 };
	for (int d = 0; d < 2; d++) {
		const double width = wide[1][d] - wide[0][d];
		out->at[d] = wide[0][d] + width * at[d];
		out->lo[d] = out->at[d] - width * radius;
		out->hi[d] = out->at[d] + width * radius;
		if (out->hi[d] < -SIDE_SLACK || out->lo[d] > 1 + SIDE_SLACK)
			return NONE;
		out->at[d] = smaller(larger(out->at[d], 0), 1);
		out->lo[d] = smaller(larger(out->lo[d], 0), 1);
		out->hi[d] = smaller(larger(out->hi[d], 0), 1);
	}
	/* one that is there already lies in this box, too */
	const struct umbilic *all = s->t->umbilics.p;
	for (size_t i = 0; i < s->t->umbilics.n; i++) {
		bool same = all[i].kind == UMBILIC_ONE;
		for (int d = 0; same && d < 2; d++)
			same = all[i].at[d] >= wide[0][d] && all[i].at[d] <= wide[1][d];
		if (same)
			return NONE;
	}
	return ONE;
}

static int deepest(const struct search *s)
{
	const size_t n = s->t->umbilics.n;
	return n < FEW ? DEPTH_MAX : n < MANY ? DEPTH_AFTER_FEW : DEPTH_AFTER_MANY;
}

/* c: the three on the cell, and what they are off. */
static void cell_look(struct search *s, double *c, const double error[N_EQUATIONS],
                      struct cell cell, int depth)
{
	bool flat = true;
	double more[N_EQUATIONS], lo[2], hi[2];
	const int d = cell.level[0] > cell.level[1];
	if (tracer_ends(s->t))
		return;
	for (int k = 0; k < N_EQUATIONS; k++) {
		double least, most;
		form_range(c + k * s->count, s->count, &least, &most);
		if (least > error[k] || most < -error[k])
			return;
		most = larger(-least, most);
		flat &= most <= larger(error[k], cell.level[0] < JUDGE_LEVEL ? s->zero[k] : 0);
		more[k] = error[k] + (d == 0 ? s->m : s->n) * UNIT_ROUNDOFF * most;
	}
	for (int k = 0; k < 2; k++) {
		lo[k] = ldexp(cell.index[k], -cell.level[k]);
		hi[k] = ldexp(cell.index[k] + 1.0, -cell.level[k]);
	}
	if (flat) {
		box_add(s->t, lo, hi, UMBILIC_FLAT);
		return;
	}
	if (cell.level[0] >= JUDGE_LEVEL && cell.level[1] == cell.level[0]) {
		struct umbilic x;
		const enum verdict v = cell_judge(s, lo, hi, &x);
		if (v == ONE)
			umbilic_add(s->t, &x);
		if (v != UNSURE)
			return;
	}
	if (cell.level[d] >= deepest(s)) {
		box_add(s->t, lo, hi, UMBILIC_UNSURE);
		return;
	}
	if (!s->rooms[depth])
		s->rooms[depth] = level_room(s->t, N_EQUATIONS * s->count);
	double *lower = s->rooms[depth];
	if (!lower)
		return;
	for (int k = 0; k < N_EQUATIONS; k++)
		form_split(c + k * s->count, s->m, s->n, d, lower + k * s->count);
	cell.level[d]++;
	cell.index[d] *= 2;
	cell_look(s, lower, more, cell, depth + 1);
	cell.index[d]++;
	cell_look(s, c, more, cell, depth + 1);
}

void level_umbilics_find(struct tracer *t)
{
	struct search s = { .t = t };
	double *c = NULL;
	/* a patch without area has none */
	if (form_most(t->normals, level_normals_size(t->level->surface)) == 0)
		return;
	if (search_init(&s, t) && (c = level_room(t, N_EQUATIONS * s.count))) {
		memcpy(c, s.c, sizeof *c * N_EQUATIONS * s.count);
		cell_look(&s, c, s.error, (struct cell){ .error = 0 }, 0);
	}
	for (int i = 0; i < 2 * DEPTH_MAX + 2; i++)
		level_room_free(t, s.rooms[i]);
	level_room_free(t, s.c);
	level_room_free(t, s.near);
	level_room_free(t, c);
}
