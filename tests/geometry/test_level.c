/* test_level.c - curves f = 0 on a surface: known answers, laws, failures. */
#include "cmocka_all.h"

#include <string.h>

#include "arbitrary.h"
#include "construct.h"
#include "level_shapes.h"
#include "refine.h"
#include "shapes.h"

static const double pi = 3.14159265358979323846;

static double cosine(double degrees)
{
	return degrees == 90 ? 0 : cos(degrees * pi / 180);
}

/* ---- surfaces ---- */

static struct surface wavy(void)
{
	struct surface s;
	assert_int_equal(shape_make(&s, 4, 30, shape_wavy), ST_OK);
	return s;
}

static struct surface sphere(void)
{
	return shape_sphere(2.5);
}

static struct surface torus(void)
{
	return shape_torus(3, 1);
}

static struct surface cylinder(void)
{
	struct curve c;
	struct surface s;
	assert_int_equal(make_arc(&c, vec3(1, 1, 1), vec3(1, 0, 0), vec3(0, 1, 0), 2, 0, 2 * pi),
	                 ST_OK);
	assert_int_equal(make_cylinder(&s, &c, vec3(0, 0, 5)), ST_OK);
	curve_finish(&c);
	return s;
}

static struct surface flat(void)
{
	struct surface s;
	const struct vec3 corner[4] = { { 0, 0, 1 }, { 4, 0, 1 }, { 0, 3, 1 }, { 4, 3, 1 } };
	assert_int_equal(make_bilinear(&s, corner), ST_OK);
	return s;
}

/* ---- checks that use none of the tracer's own evaluation ---- */

static double field_at(const struct surface *s, enum level_kind kind, struct vec3 d, double value,
                       double u, double v)
{
	struct vec3 p, su, sv;
	surface_tangents(s, u, v, &p, &su, &sv);
	if (kind == LEVEL_PLANE)
		return vec3_dot(p, d) - value;
	return vec3_dot(vec3_unit(vec3_cross(su, sv)), vec3_unit(d)) -
	       (kind == LEVEL_SILHOUETTE ? 0 : value);
}

/* Distance from p to the exact curve near (u, v): Newton for f = 0 and no offset along it. */
static double off_curve(const struct surface *s, enum level_kind kind, struct vec3 d, double value,
                        double u, double v, struct vec3 p)
{
	const double h = 1e-6;
	double range[2] = { s->domain[0][1] - s->domain[0][0], s->domain[1][1] - s->domain[1][0] };
	double hu = h * range[0], hv = h * range[1];
	struct vec3 q, su, sv;
	for (int step = 0; step < 4; step++) {
		double uu = fmin(fmax(u, s->domain[0][0] + hu), s->domain[0][1] - hu);
		double vv = fmin(fmax(v, s->domain[1][0] + hv), s->domain[1][1] - hv);
		double f = field_at(s, kind, d, value, u, v);
		double fu = (field_at(s, kind, d, value, uu + hu, v) -
		             field_at(s, kind, d, value, uu - hu, v)) /
		            (2 * hu);
		double fv = (field_at(s, kind, d, value, u, vv + hv) -
		             field_at(s, kind, d, value, u, vv - hv)) /
		            (2 * hv);
		surface_tangents(s, u, v, &q, &su, &sv);
		struct vec3 t = vec3_unit(vec3_along(vec3_scale(sv, fu), -fv, su));
		double a = vec3_dot(su, t), b = vec3_dot(sv, t), r = vec3_dot(vec3_sub(q, p), t);
		double det = fu * b - fv * a;
		u += (-f * b + fv * r) / det;
		v += (-fu * r + f * a) / det;
	}
	surface_tangents(s, u, v, &q, &su, &sv);
	return vec3_length(vec3_sub(p, q));
}

static void check_curves(const struct surface *s, const struct level_branch *b)
{
	assert_int_equal(curve_check((struct curve *)&b->uv, "uv", NULL), ST_OK);
	assert_int_equal(curve_check((struct curve *)&b->space, "space", NULL), ST_OK);
	assert_int_equal(b->uv.n, b->space.n);
	assert_memory_equal(b->uv.knots, b->space.knots, sizeof(double) * (b->uv.n + 4));
	for (int i = 0; i < b->uv.n; i++) {
		struct vec3 p = curve_get_point(&b->uv, i, NULL);
		for (int d = 0; d < 2; d++) {
			double x = d == 0 ? p.x : p.y, range = s->domain[d][1] - s->domain[d][0];
			assert_true(x > s->domain[d][0] - 1e-2 * range);
			assert_true(x < s->domain[d][1] + 1e-2 * range);
		}
	}
	assert_true(!b->closed || curve_closed(&b->space, 1e-9));
	assert_true(fabs(b->length - curve_length(&b->space, b->space.domain[0], b->space.domain[1],
	                                          1e-9)) < 1e-6 * b->length);
}

/* The space curve, and the image of the uv curve, against surface and exact curve. */
static void check_exact(const struct surface *s, enum level_kind kind, struct vec3 d, double value,
                        const struct level_branch *b, double tolerance, int samples)
{
	double t0 = b->uv.domain[0], t1 = b->uv.domain[1];
	for (int k = 0; k < samples; k++) {
		double t = t0 + (t1 - t0) * (k + 0.37) / samples;
		struct vec3 uv = curve_point(&b->uv, t), p, su, sv;
		double u = fmin(fmax(uv.x, s->domain[0][0]), s->domain[0][1]);
		double v = fmin(fmax(uv.y, s->domain[1][0]), s->domain[1][1]);
		surface_tangents(s, u, v, &p, &su, &sv);
		/* near a pole differences say nothing */
		if (vec3_length(vec3_cross(su, sv)) < 1e-2 * vec3_length(su) * vec3_length(sv) ||
		    vec3_length(su) < 1e-2 || vec3_length(sv) < 1e-2)
			continue;
		assert_true(off_curve(s, kind, d, value, u, v, p) < tolerance);
		assert_true(off_curve(s, kind, d, value, u, v, curve_point(&b->space, t)) <
		            tolerance);
	}
}

/* ---- known answers ---- */

static const struct known {
	const char *name;
	struct surface (*make)(void);
	enum level_kind kind;
	struct vec3 direction;
	double degrees; /* of a plane: its height */
	size_t branches, closed;
	double length; /* 0: not known */
	int seams;     /* over all branches; -1: not asked */
} knowns[] = {
	{ "waves, plane", wavy, LEVEL_PLANE, { 0, 0, 1 }, 0.4, 18, 18, 0, 0 },
	{ "waves, deep plane", wavy, LEVEL_PLANE, { 0, 0, 2 }, -1.5, 18, 18, 0, 0 },
	{ "waves, silhouette", wavy, LEVEL_SILHOUETTE, { 0.8, 0.36, 0.48 }, 90, 12, 0, 0, 0 },
	{ "waves, isophote", wavy, LEVEL_ISOPHOTE, { 0, 0, 1 }, 35, 85, 61, 0, 0 },
	{ "waves, isophote", wavy, LEVEL_ISOPHOTE, { 0, 0, 7 }, 50, 84, 60, 0, 0 },
	{ "waves, none", wavy, LEVEL_ISOPHOTE, { 0, 0, 1 }, 100, 0, 0, 0, 0 },
	{ "sphere, a circle of latitude",
	  sphere,
	  LEVEL_ISOPHOTE,
	  { 0, 0, 1 },
	  60,
	  1,
	  1,
	  2 * M_PI * 2.5 * 0.86602540378443865,
	  1 },
	{ "sphere, the equator, on knots",
	  sphere,
	  LEVEL_ISOPHOTE,
	  { 0, 0, 1 },
	  90,
	  1,
	  1,
	  2 * M_PI * 2.5,
	  1 },
	{ "sphere, over the seam twice",
	  sphere,
	  LEVEL_ISOPHOTE,
	  { 1, 0, 0 },
	  60,
	  1,
	  1,
	  2 * M_PI * 2.5 * 0.86602540378443865,
	  2 },
	{ "sphere, away from the seam",
	  sphere,
	  LEVEL_ISOPHOTE,
	  { 1, 0, 0 },
	  150,
	  1,
	  1,
	  2 * M_PI * 2.5 * 0.5,
	  0 },
	{ "sphere, through the poles",
	  sphere,
	  LEVEL_ISOPHOTE,
	  { 1, 0.3, 0 },
	  90,
	  1,
	  1,
	  2 * M_PI * 2.5,
	  2 },
	{ "sphere, through the poles, on knots",
	  sphere,
	  LEVEL_ISOPHOTE,
	  { 1, 0, 0 },
	  90,
	  1,
	  1,
	  2 * M_PI * 2.5,
	  2 },
	{ "sphere, along the seam",
	  sphere,
	  LEVEL_SILHOUETTE,
	  { 0, 1, 0 },
	  90,
	  1,
	  1,
	  2 * M_PI * 2.5,
	  -1 },
	{ "sphere, through one pole",
	  sphere,
	  LEVEL_ISOPHOTE,
	  { 0.6, 0, 0.8 },
	  36.869897645844021,
	  1,
	  1,
	  2 * M_PI * 2.5 * 0.6,
	  -1 },
	{ "sphere, plane through the poles",
	  sphere,
	  LEVEL_PLANE,
	  { 1, 0.2, 0 },
	  0,
	  1,
	  1,
	  2 * M_PI * 2.5,
	  2 },
	{ "torus, outside and inside",
	  torus,
	  LEVEL_ISOPHOTE,
	  { 0, 0, 1 },
	  90,
	  2,
	  2,
	  2 * M_PI * 6,
	  2 },
	{ "torus, two parallels", torus, LEVEL_ISOPHOTE, { 0, 0, 1 }, 60, 2, 2, 12 * M_PI, 2 },
	{ "torus, round both seams' crossing", torus, LEVEL_ISOPHOTE, { 1, 0, 0 }, 60, 2, 2, 0, 4 },
	{ "torus, plane through the axis", torus, LEVEL_PLANE, { 1, 2, 0 }, 0, 2, 2, 4 * M_PI, 2 },
	{ "torus, two circles", torus, LEVEL_PLANE, { 0, 0, 1 }, 0.5, 2, 2, 12 * M_PI, 2 },
	{ "cylinder, two lines", cylinder, LEVEL_ISOPHOTE, { 1, 0, 0 }, 60, 2, 0, 10, 0 },
	{ "cylinder, lines on knots", cylinder, LEVEL_ISOPHOTE, { 1, 0, 0 }, 90, 2, 0, 10, 0 },
	{ "cylinder, slanting plane", cylinder, LEVEL_PLANE, { 0.6, 0, 0.8 }, 2.8, 1, 1, 0, 1 },
	{ "flat, no level", flat, LEVEL_ISOPHOTE, { 0, 0, 1 }, 30, 0, 0, 0, 0 },
};

static void test_known(void **state)
{
	(void)state;
	const double tolerance = 1e-5;
	for (size_t i = 0; i < sizeof knowns / sizeof *knowns; i++) {
		const struct known *k = &knowns[i];
		struct surface s = k->make();
		struct level_result x;
		double value = k->kind == LEVEL_PLANE ? k->degrees : cosine(k->degrees);
		int seams = 0;
		assert_int_equal(shape_trace(&s, k->kind, k->direction, value, tolerance, &x, NULL),
		                 ST_OK);
		if (x.n_branches != k->branches || x.n_closed != k->closed || x.n_undecided != 0)
			print_error("%s: %zu pieces, %zu closed, %zu undecided\n", k->name,
			            x.n_branches, x.n_closed, x.n_undecided);
		assert_int_equal(x.n_branches, k->branches);
		assert_int_equal(x.n_closed, k->closed);
		assert_int_equal(x.n_undecided, 0);
		if (x.max_error > tolerance) print_error("%s: error %g\n", k->name, x.max_error);
		assert_true(x.max_error <= tolerance);
		if (k->length > 0)
			assert_true(fabs(x.length - k->length) < 1e-4 * k->length);
		for (size_t b = 0; b < x.n_branches; b++) {
			seams += x.branches[b].seams;
			check_curves(&s, &x.branches[b]);
			check_exact(&s, k->kind, k->direction, value, &x.branches[b], tolerance,
			            k->branches > 20 ? 40 : 200);
		}
		if (k->seams >= 0 && seams != k->seams)
			print_error("%s: %d seams\n", k->name, seams);
		assert_true(k->seams < 0 || seams == k->seams);
		level_result_finish(&x);
		surface_finish(&s);
	}
}

/* ---- laws ---- */

struct count {
	size_t branches, closed, undecided;
	double length;
};

static struct count count_of(const struct surface *s, enum level_kind kind, struct vec3 d,
                             double value)
{
	struct level_result x;
	assert_int_equal(shape_trace(s, kind, d, value, 1e-5, &x, NULL), ST_OK);
	struct count c = { x.n_branches, x.n_closed, x.n_undecided, x.length };
	assert_true(x.max_error <= 1.1e-5);
	for (size_t b = 0; b < x.n_branches; b++)
		check_curves(s, &x.branches[b]);
	level_result_finish(&x);
	return c;
}

static void assert_same(struct count a, struct count b)
{
	assert_int_equal(a.branches, b.branches);
	assert_int_equal(a.closed, b.closed);
	assert_int_equal(a.undecided, b.undecided);
	assert_true(fabs(a.length - b.length) < 1e-4 * (1 + a.length));
}

/* The right half (u >= 0.5) with a parameter that runs `factor` times as fast: the curve of the
 * surface stays, derivatives do not agree over the knot line any more. */
static struct surface stretched(const struct surface *s, double factor)
{
	struct surface r;
	const double half[3] = { 0.5, 0.5, 0.5 };
	assert_int_equal(surface_insert(&r, s, 0, half, s->order[0] - 1), ST_OK);
	for (int i = 0; i < r.n[0] + r.order[0]; i++)
		if (r.knots[0][i] > 0.5)
			r.knots[0][i] = 0.5 + factor * (r.knots[0][i] - 0.5);
	r.domain[0][1] = 0.5 + factor * (r.domain[0][1] - 0.5);
	return r;
}

/* Other forms of the same shape have the same curves. */
static void test_forms(void **state)
{
	(void)state;
	const struct vec3 d = { 0.3, 0.2, 0.9 };
	struct surface s, r;
	assert_int_equal(shape_make(&s, 4, 14, shape_wavy), ST_OK);
	for (int k = 0; k < 3; k++) {
		const double value = cosine(25 + 15 * k), knots[] = { 0.31, 0.5, 0.5, 0.77 };
		struct count c = count_of(&s, LEVEL_ISOPHOTE, d, value);
		assert_true(c.branches > 5);
		for (int way = 0; way < 2; way++) {
			assert_int_equal(surface_insert(&r, &s, way, knots, 4), ST_OK);
			assert_same(c, count_of(&r, LEVEL_ISOPHOTE, d, value));
			surface_finish(&r);
			assert_int_equal(surface_elevate(&r, &s, way, 2), ST_OK);
			assert_same(c, count_of(&r, LEVEL_ISOPHOTE, d, value));
			surface_finish(&r);
		}
		assert_int_equal(surface_copy(&r, &s), ST_OK);
		surface_reparametrise(&r, 0, -3, 100);
		assert_same(c, count_of(&r, LEVEL_ISOPHOTE, d, value));
		/* exchanged, the normal is turned */
		assert_int_equal(surface_exchange(&r), ST_OK);
		assert_same(c, count_of(&r, LEVEL_ISOPHOTE, d, -value));
		assert_same(c, count_of(&r, LEVEL_ISOPHOTE, vec3_scale(d, -4), value));
		surface_finish(&r);
		r = stretched(&s, 3.7);
		assert_same(c, count_of(&r, LEVEL_ISOPHOTE, d, value));
		surface_finish(&r);
		r = stretched(&s, 1.0);
		assert_same(c, count_of(&r, LEVEL_ISOPHOTE, d, value));
		surface_finish(&r);
	}
	surface_finish(&s);
}

/* A fold along u = 0.5: planes go over it, isophotes end on it. */
static void test_crease(void **state)
{
	(void)state;
	struct surface s, r;
	struct level_result x;
	int on_crease = 0;
	assert_int_equal(shape_make(&s, 4, 14, shape_wavy), ST_OK);
	r = stretched(&s, 1.0);
	double at = surface_point(&r, 0.5, 0.2).x;
	for (int i = 0; i < r.n[0]; i++)
		for (int j = 0; j < r.n[1]; j++) {
			struct vec3 p = surface_get_point(&r, i, j, NULL);
			if (p.x > at)
				p.z += 0.5 * (p.x - at);
			surface_set_point(&r, i, j, p, 1);
		}
	struct count c = count_of(&r, LEVEL_PLANE, vec3(0, 1, 0), 4.1);
	assert_int_equal(c.branches, 1);
	assert_int_equal(shape_trace(&r, LEVEL_ISOPHOTE, vec3(0, 0, 1), cosine(40), 1e-5, &x, NULL),
	                 ST_OK);
	assert_int_equal(x.n_undecided, 0);
	for (size_t b = 0; b < x.n_branches; b++) {
		const struct curve *uv = &x.branches[b].uv;
		for (int e = 0; e < 2; e++) {
			double u = curve_get_point(uv, e ? uv->n - 1 : 0, NULL).x;
			on_crease += !x.branches[b].closed && u == 0.5;
		}
		/* no piece goes over it */
		double first = curve_point(uv, 0.37 * uv->domain[1]).x;
		for (int k = 0; k < 100; k++)
			assert_true((curve_point(uv, uv->domain[1] * (k + 0.5) / 100).x > 0.5) ==
			            (first > 0.5));
	}
	assert_true(on_crease >= 4);
	level_result_finish(&x);
	surface_finish(&r);
	surface_finish(&s);
}

/* What files do to surfaces: few digits, a span that is nothing but rounding. */
static void test_files(void **state)
{
	(void)state;
	const double sliver[2] = { 0.25 + 1e-13, 0.25 + 1e-13 };
	const struct vec3 d = { 1, 2, 3 };
	struct surface s = torus(), r, q;
	uint64_t seed = 3;
	assert_int_equal(surface_copy(&r, &s), ST_OK);
	for (int i = 0; i < r.n[0]; i++)
		for (int j = 0; j < r.n[1]; j++) {
			double w;
			struct vec3 p = surface_get_point(&r, i, j, &w), off;
			off = vec3(any_number(&seed), any_number(&seed), any_number(&seed));
			surface_set_point(&r, i, j, vec3_along(p, 4e-7, off), w);
		}
	assert_int_equal(surface_insert(&q, &s, 0, sliver, 2), ST_OK);
	for (int degrees = 20; degrees < 170; degrees += 15) {
		struct count c = count_of(&s, LEVEL_ISOPHOTE, d, cosine(degrees));
		assert_int_equal(c.branches, 2);
		assert_int_equal(c.closed, 2);
		assert_same(c, count_of(&r, LEVEL_ISOPHOTE, d, cosine(degrees)));
		assert_same(c, count_of(&q, LEVEL_ISOPHOTE, d, cosine(degrees)));
	}
	surface_finish(&q);
	surface_finish(&r);
	surface_finish(&s);
}

/* A fold whose angle fades out along it: pieces end on it where there is an angle, and go over it
 * where there is none. */
static void test_fading_crease(void **state)
{
	(void)state;
	struct surface s, r;
	int ends = 0, over = 0;
	assert_int_equal(shape_make(&s, 4, 14, shape_wavy), ST_OK);
	r = stretched(&s, 1.0);
	double at = surface_point(&r, 0.5, 0.2).x;
	for (int i = 0; i < r.n[0]; i++)
		for (int j = 0; j < 6; j++) {
			struct vec3 p = surface_get_point(&r, i, j, NULL);
			if (p.x > at)
				p.z += 0.1 * (6 - j) * (p.x - at);
			surface_set_point(&r, i, j, p, 1);
		}
	for (int degrees = 20; degrees < 60; degrees += 5) {
		struct level_result x;
		assert_int_equal(shape_trace(&r, LEVEL_ISOPHOTE, vec3(0, 0, 1), cosine(degrees),
		                             1e-5, &x, NULL),
		                 ST_OK);
		assert_int_equal(x.n_undecided, 0);
		assert_true(x.max_error <= 1e-5);
		for (size_t b = 0; b < x.n_branches; b++) {
			const struct curve *uv = &x.branches[b].uv;
			for (int e = 0; e < 2 && !x.branches[b].closed; e++) {
				struct vec3 p = curve_get_point(uv, e ? uv->n - 1 : 0, NULL);
				if (p.x != 0.5)
					continue;
				ends++;
				assert_true(p.y < 0.55); /* control points from 6 on are at peace */
			}
			for (int k = 0; k + 1 < 100; k++)
				over += (curve_point(uv, uv->domain[1] * k / 100).x > 0.5) !=
				        (curve_point(uv, uv->domain[1] * (k + 1) / 100).x > 0.5);
		}
		level_result_finish(&x);
	}
	assert_true(ends > 5);
	assert_true(over > 5);
	surface_finish(&r);
	surface_finish(&s);
}

/* ---- counted by changes of sign on a grid ---- */

enum { GRID = 400, ROW = GRID + 1, EDGES = 2 * ROW * ROW };

static int edge_root(int *parent, int i)
{
	while (parent[i] != i)
		i = parent[i] = parent[parent[i]];
	return i;
}

/* Connected runs of the grid's edges on which f (ROW x ROW) changes sign; in a cell with four of
 * them the middle decides. Edges: along u, then along v. */
static size_t grid_pieces(const double *f, int *parent)
{
	size_t pieces = 0;
	for (int e = 0; e < EDGES; e++)
		parent[e] = e;
	for (int i = 0; i < GRID; i++)
		for (int j = 0; j < GRID; j++) {
			const double *g = f + i * ROW + j;
			const double corner[4] = { g[0], g[ROW], g[ROW + 1], g[1] };
			const int edge[4] = { i * ROW + j, ROW * ROW + (i + 1) * ROW + j,
				              i * ROW + j + 1, ROW * ROW + i * ROW + j };
			int hit[4], n = 0;
			for (int k = 0; k < 4; k++)
				if ((corner[k] < 0) != (corner[(k + 1) % 4] < 0))
					hit[n++] = edge[k];
			bool middle = g[0] + g[ROW] + g[ROW + 1] + g[1] < 0;
			int turn = n == 4 && middle != (g[0] < 0);
			for (int k = 0; k + 1 < n; k += 2)
				parent[edge_root(parent, hit[k + turn])] =
				        edge_root(parent, hit[(k + turn + 1) % 4]);
		}
	for (int i = 0; i < ROW; i++)
		for (int j = 0; j < ROW; j++) {
			int u = i * ROW + j, v = ROW * ROW + u;
			if (i < GRID && (f[u] < 0) != (f[u + ROW] < 0))
				pieces += edge_root(parent, u) == u;
			if (j < GRID && (f[u] < 0) != (f[u + 1] < 0))
				pieces += edge_root(parent, v) == v;
		}
	return pieces;
}

static const struct {
	int order[2], n[2];
	bool rational;
	enum shape_knots knots;
	uint64_t seed;
	double degrees[2];
} grid_cases[] = {
	{ { 4, 4 }, { 8, 8 }, false, KNOTS_CLAMPED, 1, { 30, 55 } },
	{ { 4, 4 }, { 9, 7 }, true, KNOTS_UNEVEN, 2, { 25, 45 } },
	{ { 3, 5 }, { 8, 8 }, false, KNOTS_OPEN, 3, { 35, 50 } },
	{ { 3, 4 }, { 7, 7 }, true, KNOTS_CLAMPED, 4, { 30, 90 } },
	{ { 6, 6 }, { 9, 9 }, true, KNOTS_CLAMPED, 5, { 20, 35 } },
	{ { 4, 6 }, { 10, 9 }, false, KNOTS_DOUBLE, 6, { 20, 40 } },
	{ { 9, 8 }, { 9, 8 }, true, KNOTS_CLAMPED, 7, { 15, 25 } },
	{ { 2, 4 }, { 2, 8 }, false, KNOTS_CLAMPED, 8, { 30, 45 } },
};

static void test_grid(void **state)
{
	(void)state;
	const struct vec3 light = { 0.1, 0.2, 1 };
	struct vec3 *normal = malloc(sizeof *normal * ROW * ROW);
	double *f = malloc(sizeof *f * ROW * ROW);
	int *parent = malloc(sizeof *parent * EDGES);
	assert_true(normal && f && parent);
	for (size_t c = 0; c < sizeof grid_cases / sizeof *grid_cases; c++) {
		struct surface s =
		        shape_surface(grid_cases[c].order, grid_cases[c].n, grid_cases[c].rational,
		                      grid_cases[c].knots, grid_cases[c].seed);
		for (int i = 0; i < ROW * ROW; i++) {
			struct vec3 p, su, sv;
			surface_tangents(&s, in_range(s.domain[0], (double)(i / ROW) / GRID),
			                 in_range(s.domain[1], (double)(i % ROW) / GRID), &p, &su,
			                 &sv);
			normal[i] = vec3_unit(vec3_cross(su, sv));
		}
		for (int k = 0; k < 2; k++) {
			double value = cosine(grid_cases[c].degrees[k]);
			for (int i = 0; i < ROW * ROW; i++)
				f[i] = vec3_dot(normal[i], vec3_unit(light)) - value;
			size_t expected = grid_pieces(f, parent);
			struct count got = count_of(&s, LEVEL_ISOPHOTE, light, value);
			if (got.branches != expected)
				print_error("case %zu, %g degrees: %zu pieces, on the grid %zu\n",
				            c, grid_cases[c].degrees[k], got.branches, expected);
			assert_int_equal(got.branches, expected);
			assert_int_equal(got.undecided, 0);
		}
		surface_finish(&s);
	}
	free(normal);
	free(f);
	free(parent);
}

/* ---- degenerate, extreme, wrong ---- */

static const struct {
	const char *name;
	struct surface (*make)(void);
	enum level_kind kind;
	struct vec3 direction;
	double degrees;
	size_t undecided;
	bool flat;
	enum level_mark mark; /* N_LEVEL_MARKS: point or region, as the pole's rounding has it */
} touches[] = {
	{ "a plateau", flat, LEVEL_ISOPHOTE, { 0, 0, 1 }, 0, 1, true, LEVEL_REGION },
	{ "a plateau, slanting",
	  flat,
	  LEVEL_ISOPHOTE,
	  { 0, 0.6, 0.8 },
	  36.869897645844021,
	  1,
	  true,
	  LEVEL_REGION },
	{ "a plane in the plane", flat, LEVEL_PLANE, { 0, 0, 1 }, 1, 1, true, LEVEL_REGION },
	{ "a point of a sphere",
	  sphere,
	  LEVEL_ISOPHOTE,
	  { 0.3, 0.4, 0.8 },
	  0,
	  1,
	  false,
	  LEVEL_POINT },
	{ "its pole", sphere, LEVEL_ISOPHOTE, { 0, 0, 1 }, 0, 1, false, N_LEVEL_MARKS },
	{ "the other pole", sphere, LEVEL_ISOPHOTE, { 0, 0, 1 }, 180, 1, false, N_LEVEL_MARKS },
	{ "the top of a torus", torus, LEVEL_ISOPHOTE, { 0, 0, 1 }, 0, 1, false, LEVEL_REGION },
	{ "a line of a cylinder",
	  cylinder,
	  LEVEL_ISOPHOTE,
	  { 0.6, 0.8, 0 },
	  0,
	  1,
	  false,
	  LEVEL_REGION },
	{ "a plane on a torus", torus, LEVEL_PLANE, { 0, 0, 1 }, 1, 1, false, LEVEL_REGION },
	{ "a plane on a sphere", sphere, LEVEL_PLANE, { 0, 0.6, 0.8 }, 2.5, 1, false, LEVEL_POINT },
};

/* What the level only touches is told as one box, without a curve. */
static void test_touch(void **state)
{
	(void)state;
	for (size_t i = 0; i < sizeof touches / sizeof *touches; i++) {
		struct surface s = touches[i].make();
		struct level_result x;
		double value = touches[i].kind == LEVEL_PLANE ? touches[i].degrees
		                                              : cosine(touches[i].degrees);
		assert_int_equal(shape_trace(&s, touches[i].kind, touches[i].direction, value, 1e-5,
		                             &x, NULL),
		                 ST_OK);
		if (x.n_undecided != touches[i].undecided || x.n_branches != 0)
			print_error("%s: %zu undecided, %zu pieces\n", touches[i].name,
			            x.n_undecided, x.n_branches);
		assert_int_equal(x.n_branches, 0);
		assert_int_equal(x.n_undecided, touches[i].undecided);
		assert_true(!touches[i].flat || x.undecided[0].flat);
		enum level_mark kind = x.undecided[0].kind;
		if (touches[i].mark == N_LEVEL_MARKS)
			assert_true(kind == LEVEL_POINT || kind == LEVEL_REGION);
		else
			assert_int_equal(kind, touches[i].mark);
		assert_int_equal(x.undecided[0].ends, 0);
		level_result_finish(&x);
		surface_finish(&s);
	}
}

/* A surface that is only a line has no normal, and nothing is known of it. */
static void test_no_area(void **state)
{
	(void)state;
	for (int rational = 0; rational < 2; rational++) {
		struct surface s = shape_surface((const int[2]){ 4, 4 }, (const int[2]){ 8, 8 },
		                                 rational, KNOTS_CLAMPED, 3);
		struct level_result x;
		for (int i = 0; i < 8; i++)
			for (int j = 0; j < 8; j++) {
				double w, t;
				t = surface_get_point(&s, i, j, &w).z;
				surface_set_point(&s, i, j, vec3(0.37 * t, 1.21 * t, 0.777 * t), w);
			}
		assert_int_equal(
		        shape_trace(&s, LEVEL_ISOPHOTE, vec3(0, 0, 1), 0.5, 1e-5, &x, NULL), ST_OK);
		assert_int_equal(x.n_branches, 0);
		assert_int_equal(x.n_undecided, 1);
		assert_true(x.undecided[0].flat);
		level_result_finish(&x);
		surface_finish(&s);
	}
}

/* Where curves cross, the crossing is told and the curves end there. */
static void test_crossing(void **state)
{
	(void)state;
	struct surface s = torus();
	struct level_result x;
	assert_int_equal(shape_trace(&s, LEVEL_ISOPHOTE, vec3(1, 0, 0), 0, 1e-5, &x, NULL), ST_OK);
	/* u = 90, 270 degrees cross v = 90, 270 degrees: on the corners of patches */
	assert_true(fabs(x.length - (2 * 2 * pi + 2 * 2 * pi * 3)) < 1e-3);
	level_result_finish(&x);
	surface_finish(&s);
	s = wavy();
	assert_int_equal(shape_trace(&s, LEVEL_PLANE, vec3(0, 0, 1), 0, 1e-5, &x, NULL), ST_OK);
	/* seven lines each way, the border's four among them */
	int found[5] = { 0 };
	assert_int_equal(x.n_branches, 2 * 7 * 6);
	assert_int_equal(x.n_undecided, 49);
	for (size_t i = 0; i < x.n_undecided; i++) {
		const struct level_box *b = &x.undecided[i];
		assert_int_equal(b->kind, LEVEL_CROSSING);
		assert_in_range(b->ends, 2, 4);
		found[b->ends]++;
	}
	assert_int_equal(found[4], 25);
	assert_int_equal(found[3], 20);
	assert_int_equal(found[2], 4);
	/* branches of a crossing end in one point */
	for (size_t b = 0; b < x.n_branches; b++)
		for (int e = 0; e < 2; e++) {
			const struct curve *c = &x.branches[b].uv;
			struct vec3 p = curve_get_point(c, e ? c->n - 1 : 0, NULL);
			assert_in_range(x.branches[b].mark[e], 0, 48);
			const struct level_box *m = &x.undecided[x.branches[b].mark[e]];
			assert_true(p.x == 0.5 * (m->lo[0] + m->hi[0]));
			assert_true(p.y == 0.5 * (m->lo[1] + m->hi[1]));
		}
	assert_true(x.max_error <= 1e-5);
	level_result_finish(&x);
	surface_finish(&s);
}

/* The same shape at the highest orders: the degree of f is 98, rational 88. */
static void test_high_order(void **state)
{
	(void)state;
	const int order[2] = { 4, 4 }, n[2] = { 4, 4 };
	for (int rational = 0; rational < 2; rational++) {
		struct surface s = shape_surface(order, n, rational, KNOTS_CLAMPED, 11), r, q;
		struct count c = count_of(&s, LEVEL_ISOPHOTE, vec3(0, 0, 1), cosine(30));
		int raise = rational ? 12 : 22;
		assert_true(c.branches > 0);
		assert_int_equal(surface_elevate(&r, &s, 0, raise), ST_OK);
		assert_int_equal(surface_elevate(&q, &r, 1, raise), ST_OK);
		assert_same(c, count_of(&q, LEVEL_ISOPHOTE, vec3(0, 0, 1), cosine(30)));
		surface_finish(&q);
		surface_finish(&r);
		surface_finish(&s);
	}
}

static void test_wrong(void **state)
{
	(void)state;
	static const struct {
		enum level_kind kind;
		struct vec3 direction;
		double value, tolerance;
	} wrong[] = {
		{ LEVEL_ISOPHOTE, { 0, 0, 0 }, 0.5, 1e-5 },
		{ LEVEL_ISOPHOTE, { 0, NAN, 1 }, 0.5, 1e-5 },
		{ LEVEL_ISOPHOTE, { 0, 0, 1 }, 1.01, 1e-5 },
		{ LEVEL_ISOPHOTE, { 0, 0, 1 }, -2, 1e-5 },
		{ LEVEL_PLANE, { 0, 0, 1 }, NAN, 1e-5 },
		{ LEVEL_PLANE, { 0, 0, 1 }, 0.5, 0 },
		{ LEVEL_PLANE, { 0, 0, 1 }, 0.5, -1 },
		{ LEVEL_PLANE, { 0, 0, 1 }, 0.5, NAN },
		{ LEVEL_CYLINDER, { 0, 0, 1 }, 0, 1e-5 },
		{ LEVEL_CYLINDER, { 0, 0, 0 }, 1, 1e-5 },
		{ LEVEL_HIGHLIGHT, { 0, 0, 1 }, NAN, 1e-5 },
		{ LEVEL_REFLECTION, { 0, 0, 0 }, 0, 1e-5 },
	};
	struct surface s = sphere();
	for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
		struct report_store store;
		struct level *l = NULL;
		report_store_init(&store);
		struct level_field field = { .kind = wrong[i].kind,
			                     .direction = wrong[i].direction,
			                     .value = wrong[i].value };
		assert_int_equal(level_create(&l, &s, &field, wrong[i].tolerance, &store.report),
		                 ST_PARAMETER);
		assert_null(l);
		assert_int_equal(store.n_errors, 1);
	}
	surface_finish(&s);
}

/* Blocks may be cut anywhere between patches; damaged ones are refused. */
static void test_blocks(void **state)
{
	(void)state;
	enum { BLOCKS = 729 };
	struct surface s = wavy();
	struct level_field field = { .kind = LEVEL_ISOPHOTE,
		                     .direction = { 0, 0, 1 },
		                     .value = cosine(35) };
	struct level *l;
	struct text bytes[BLOCKS] = { { 0 } }, whole = { 0 };
	const char *blocks[BLOCKS];
	size_t sizes[BLOCKS];
	struct level_result x, y;
	assert_int_equal(level_create(&l, &s, &field, 1e-5, NULL), ST_OK);
	assert_int_equal(level_patches(l), BLOCKS);
	for (int i = BLOCKS; i-- > 0;)
		assert_int_equal(level_patch(l, i, &bytes[i]), ST_OK);
	for (int i = 0; i < BLOCKS; i++) {
		blocks[i] = bytes[i].s ? bytes[i].s : "";
		sizes[i] = bytes[i].n;
		assert_int_equal(level_patch(l, i, &whole), ST_OK);
	}
	assert_int_equal(level_join(l, blocks, sizes, BLOCKS, &x, NULL), ST_OK);
	assert_int_equal(level_join(l, &(const char *){ whole.s }, &whole.n, 1, &y, NULL), ST_OK);
	assert_int_equal(x.n_branches, y.n_branches);
	for (size_t b = 0; b < x.n_branches; b++) {
		const struct curve *p = &x.branches[b].space, *q = &y.branches[b].space;
		assert_int_equal(p->n, q->n);
		assert_memory_equal(p->points, q->points, sizeof(double) * 4 * p->n);
		assert_memory_equal(x.branches[b].uv.points, y.branches[b].uv.points,
		                    sizeof(double) * 4 * p->n);
		assert_memory_equal(p->knots, q->knots, sizeof(double) * (p->n + 4));
	}
	level_result_finish(&x);
	level_result_finish(&y);

	struct report_store store;
	report_store_init(&store);
	size_t cut = whole.n - 8;
	assert_int_equal(level_join(l, &(const char *){ whole.s }, &cut, 1, &x, &store.report),
	                 ST_INTERNAL);
	assert_int_equal(store.n_errors, 1);
	/* every early byte damaged in turn: refused or read, never followed out of bounds */
	for (size_t i = 0; i < 160; i++) {
		whole.s[i] ^= 0x55;
		enum status st = level_join(l, &(const char *){ whole.s }, &whole.n, 1, &x, NULL);
		assert_true(st == ST_OK || st == ST_INTERNAL);
		assert_true(i >= 8 || st == ST_INTERNAL);
		if (st == ST_OK)
			level_result_finish(&x);
		whole.s[i] ^= 0x55;
	}
	for (int i = 0; i < BLOCKS; i++)
		text_finish(&bytes[i]);
	text_finish(&whole);
	level_destroy(l);
	surface_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_known),         cmocka_unit_test(test_forms),
		cmocka_unit_test(test_crease),        cmocka_unit_test(test_files),
		cmocka_unit_test(test_fading_crease), cmocka_unit_test(test_grid),
		cmocka_unit_test(test_touch),         cmocka_unit_test(test_no_area),
		cmocka_unit_test(test_crossing),      cmocka_unit_test(test_high_order),
		cmocka_unit_test(test_wrong),         cmocka_unit_test(test_blocks),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
