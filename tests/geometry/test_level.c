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

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_known),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
