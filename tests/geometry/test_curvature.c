/* test_curvature.c - curvatures of known surfaces, and their limits at degenerate points. */
#include <math.h>
#include <string.h>

#include "cmocka_all.h"
#include "curvature.h"
#include "shapes.h"

static bool near(double a, double b, double tolerance)
{
	return fabs(a - b) <= tolerance;
}

static void table_is_as_agreed(void **state)
{
	(void)state;
	assert_string_equal(quantity_table[QUANTITY_GAUSSIAN].channel, "K");
	assert_int_equal(quantity_table[QUANTITY_GAUSSIAN].power, 2);
	assert_string_equal(quantity_table[QUANTITY_NORMAL_V].code, "V86");
	assert_false(quantity_table[QUANTITY_ABSOLUTE].is_signed);
}

static void sphere_is_exact(void **state)
{
	struct surface s = shape_sphere(2.5);
	struct surface_shape p;
	double gauss = 0, mean = 0, principal = 0;
	(void)state;
	for (int i = 0; i <= 200; i++)
		for (int j = 1; j < 200; j++) {
			surface_shape(&s, i / 200.0, j / 200.0, &p);
			assert_false(p.limit);
			assert_true(vec3_dot(p.normal, p.point) > 2.4999);
			gauss = fmax(gauss, fabs(p.value[QUANTITY_GAUSSIAN] - 0.16));
			mean = fmax(mean, fabs(p.value[QUANTITY_MEAN] + 0.4));
			for (int q = QUANTITY_KMAX; q <= QUANTITY_NORMAL_V; q++)
				principal = fmax(principal, fabs(p.value[q] + 0.4));
			assert_true(near(p.value[QUANTITY_ABSOLUTE], 0.8, 1e-11));
		}
	assert_true(gauss < 3e-13 && mean < 3e-13 && principal < 2e-12);
	surface_finish(&s);
}

static void torus_is_exact(void **state)
{
	struct surface s = shape_torus(3, 1);
	struct surface_shape p;
	(void)state;
	for (int i = 0; i <= 200; i++)
		for (int j = 0; j <= 200; j++) {
			surface_shape(&s, i / 200.0, j / 200.0, &p);
			double rho = hypot(p.point.x, p.point.y), along = (rho - 3) / rho;
			assert_true(near(p.value[QUANTITY_GAUSSIAN], along, 1e-14));
			assert_true(near(p.value[QUANTITY_MEAN], -(1 + along) / 2, 1e-14));
			assert_true(near(p.value[QUANTITY_KMIN], -1, 1e-14));
			assert_true(near(p.value[QUANTITY_KMAX], -along, 1e-14));
			assert_true(near(p.value[QUANTITY_NORMAL_U], -along, 1e-14));
			assert_true(near(p.value[QUANTITY_NORMAL_V], -1, 1e-14));
		}
	surface_finish(&s);
}

/* The second fundamental form again, by differences of the normal. */
static void values_agree_with_differences(void **state)
{
	uint64_t seed = 77;
	(void)state;
	for (int rational = 0; rational < 2; rational++) {
		struct surface s = shape_surface((const int[2]){ 4, 5 }, (const int[2]){ 7, 8 },
		                                 rational, KNOTS_CLAMPED, 2);
		for (int i = 0; i < 200; i++) {
			double u = 0.02 + 0.96 * shape_random(&seed),
			       v = 0.02 + 0.96 * shape_random(&seed);
			const double h = 1e-5;
			struct vec3 a, b, n[2], x[2];
			struct surface_shape p;
			surface_shape(&s, u, v, &p);
			assert_true(surface_normal(&s, u - h, v, &a));
			assert_true(surface_normal(&s, u + h, v, &b));
			n[0] = vec3_scale(vec3_sub(b, a), 0.5 / h);
			assert_true(surface_normal(&s, u, v - h, &a));
			assert_true(surface_normal(&s, u, v + h, &b));
			n[1] = vec3_scale(vec3_sub(b, a), 0.5 / h);
			const double e = vec3_dot(p.du, p.du), f = vec3_dot(p.du, p.dv),
			             g = vec3_dot(p.dv, p.dv);
			const double l = -vec3_dot(n[0], p.du), m = -vec3_dot(n[0], p.dv),
			             o = -vec3_dot(n[1], p.dv);
			const double k = (l * o - m * m) / (e * g - f * f);
			const double mean = (e * o - 2 * f * m + g * l) / (2 * (e * g - f * f));
			const double size = p.value[QUANTITY_ABSOLUTE];
			assert_true(near(p.value[QUANTITY_GAUSSIAN], k, 1e-5 * (1 + size * size)));
			assert_true(near(p.value[QUANTITY_MEAN], mean, 1e-5 * (1 + size)));
			assert_true(near(shape_normal_curvature(&p, 1, 0),
			                 p.value[QUANTITY_NORMAL_U], 1e-10 * (1 + size)));
			assert_true(near(shape_normal_curvature(&p, 0, -2),
			                 p.value[QUANTITY_NORMAL_V], 1e-10 * (1 + size)));
			assert_true(isnan(shape_normal_curvature(&p, 0, 0)));
			/* Euler: the normal curvature along a principal direction is principal */
			assert_true(shape_principal_directions(&p, x));
			for (int d = 0; d < 2; d++) {
				const double xu = vec3_dot(x[d], p.du), xv = vec3_dot(x[d], p.dv);
				const double det = e * g - f * f;
				const double along = shape_normal_curvature(
				        &p, (g * xu - f * xv) / det, (e * xv - f * xu) / det);
				assert_true(near(along, p.value[d ? QUANTITY_KMIN : QUANTITY_KMAX],
				                 1e-9 * (1 + size)));
				assert_true(near(vec3_length(x[d]), 1, 1e-12));
			}
		}
		surface_finish(&s);
	}
}

static double gap(struct vec3 a, struct vec3 b)
{
	return vec3_length(vec3_sub(a, b)) / (1 + vec3_length(b));
}

static void derivatives_are_those_of_the_surface(void **state)
{
	static const int orders[][2] = { { 2, 2 }, { 2, 5 }, { 3, 3 }, { 4, 4 },
		                         { 4, 3 }, { 6, 6 }, { 8, 7 }, { 20, 3 } };
	uint64_t seed = 6;
	(void)state;
	for (size_t o = 0; o < sizeof orders / sizeof *orders; o++)
		for (int how = 0; how < N_SHAPE_KNOTS; how++)
			for (int rational = 0; rational < 2; rational++) {
				const int n[2] = { orders[o][0] + 3, orders[o][1] + 4 };
				struct surface s = shape_surface(orders[o], n, rational, how, 27);
				for (int i = 0; i < 20; i++) {
					double at[2];
					for (int d = 0; d < 2; d++)
						at[d] = s.domain[d][0] +
						        (s.domain[d][1] - s.domain[d][0]) *
						                (i == 0 ? 1 : shape_random(&seed));
					struct vec3 d[9];
					struct surface_shape p;
					surface_derivatives(&s, at[0], at[1], 2, d);
					surface_shape(&s, at[0], at[1], &p);
					assert_true(gap(p.point, d[0]) < 1e-13);
					assert_true(gap(p.du, d[3]) < 1e-12);
					assert_true(gap(p.dv, d[1]) < 1e-12);
					assert_true(gap(p.duu, d[6]) < 1e-11);
					assert_true(gap(p.duv, d[4]) < 1e-11);
					assert_true(gap(p.dvv, d[2]) < 1e-11);
				}
				surface_finish(&s);
			}
}

/* Moved a thousand sizes away the shape is the same, up to the rounding of the points. */
static void far_from_the_origin(void **state)
{
	struct surface a = shape_rat20(), b = shape_rat20();
	uint64_t seed = 12;
	(void)state;
	for (int i = 0; i < 20; i++)
		for (int j = 0; j < 20; j++) {
			double w;
			struct vec3 p = surface_get_point(&b, i, j, &w);
			surface_set_point(&b, i, j, vec3_add(p, vec3(8192, -4096, 16384)), w);
		}
	for (int i = 0; i < 300; i++) {
		struct surface_shape p, q;
		const double u = shape_random(&seed), v = shape_random(&seed);
		surface_shape(&a, u, v, &p);
		surface_shape(&b, u, v, &q);
		assert_true(gap(q.du, p.du) < 1e-10 && gap(q.duu, p.duu) < 1e-8);
		assert_true(near(p.value[QUANTITY_GAUSSIAN], q.value[QUANTITY_GAUSSIAN], 1e-8));
	}
	surface_finish(&a);
	surface_finish(&b);
}

static void expect_pole(const struct surface *s, double u, double v, struct vec3 normal,
                        double mean, double gaussian, double tolerance)
{
	struct surface_shape p;
	struct vec3 n;
	surface_shape(s, u, v, &p);
	assert_true(p.limit);
	if (isnan(normal.x)) {
		assert_true(isnan(p.normal.x) && !surface_normal(s, u, v, &n) && isnan(n.x));
	} else {
		if (!(vec3_length(vec3_sub(p.normal, normal)) < tolerance))
			fail_msg("at %g,%g: normal %g %g %g", u, v, p.normal.x, p.normal.y,
			         p.normal.z);
		assert_true(surface_normal(s, u, v, &n));
		assert_true(vec3_length(vec3_sub(n, normal)) < tolerance);
	}
	const double got[2] = { p.value[QUANTITY_MEAN], p.value[QUANTITY_GAUSSIAN] };
	const double expected[2] = { mean, gaussian };
	for (int i = 0; i < 2; i++)
		if (isnan(expected[i]) ? !isnan(got[i]) : !near(got[i], expected[i], tolerance))
			fail_msg("at %g,%g: %s %.17g, expected %g", u, v, i ? "K" : "H", got[i],
			         expected[i]);
	if (isnan(mean))
		for (int q = 0; q < N_QUANTITIES; q++)
			assert_true(isnan(p.value[q]));
}

static void sphere_poles_have_limits(void **state)
{
	struct surface s = shape_sphere(2.5);
	struct surface_shape p;
	(void)state;
	for (int i = 0; i <= 16; i++) {
		expect_pole(&s, i / 16.0, 0, vec3(0, 0, -1), -0.4, 0.16, 1e-9);
		expect_pole(&s, i / 16.0, 1, vec3(0, 0, 1), -0.4, 0.16, 1e-9);
		surface_shape(&s, i / 16.0, 1, &p);
		for (int q = QUANTITY_KMAX; q < N_QUANTITIES; q++)
			assert_true(near(p.value[q], -0.4, 1e-8));
		assert_true(near(p.value[QUANTITY_ABSOLUTE], 0.8, 1e-8));
		assert_false(shape_principal_directions(&p, (struct vec3[2]){ { 0 } }));
	}
	/* regular points right beside the pole lose nothing either */
	for (double away = 1e-13; away < 0.1; away *= 3) {
		surface_shape(&s, 0.3, 1 - away, &p);
		assert_true(near(p.value[QUANTITY_GAUSSIAN], 0.16, 1e-7));
		assert_true(near(p.value[QUANTITY_NORMAL_U], -0.4, 1e-7));
		assert_true(p.limit == (away < 1e-9) || (away > 1e-10 && away < 1e-8));
	}
	surface_finish(&s);
}

/* As sphere, but u and v exchanged: the poles are at u's ends; and moved far from the origin. */
static void poles_at_the_ends_of_u(void **state)
{
	struct surface s = shape_sphere(2.5), t;
	(void)state;
	assert_int_equal(surface_init(&t, (const int[2]){ 3, 3 }, (const int[2]){ 5, 9 }), ST_OK);
	memcpy(t.knots[0], s.knots[1], 8 * sizeof(double));
	memcpy(t.knots[1], s.knots[0], 12 * sizeof(double));
	for (int i = 0; i < 9; i++)
		for (int j = 0; j < 5; j++) {
			double w;
			struct vec3 p = surface_get_point(&s, i, j, &w);
			surface_set_point(&t, j, i, vec3_add(p, vec3(1000, -500, 70)), w);
		}
	assert_int_equal(surface_check(&t, "exchanged", NULL), ST_OK);
	for (int i = 0; i <= 8; i++) {
		expect_pole(&t, 0, i / 8.0, vec3(0, 0, 1), 0.4, 0.16, 1e-6);
		expect_pole(&t, 1, i / 8.0, vec3(0, 0, -1), 0.4, 0.16, 1e-6);
	}
	surface_finish(&s);
	surface_finish(&t);
}

/* Profiles turned about z; v from the axis outwards, so that N has +z beside the tip. */
static void turned_profiles(void **state)
{
	const double k3[6] = { 0, 0, 0, 1, 1, 1 }, k2[4] = { 0, 0, 1, 1 };
	struct surface s;
	struct surface_shape p;
	(void)state;
	/* cone: no normal at the tip */
	s = shape_turned(2, 2, (const double[]){ 0, 1 }, (const double[]){ 0, 1 }, NULL, k2);
	for (int i = 0; i <= 8; i++)
		expect_pole(&s, i / 8.0, 0, vec3(NAN, NAN, NAN), NAN, NAN, 0);
	surface_shape(&s, 0.3, 1e-6, &p);
	assert_true(near(p.value[QUANTITY_GAUSSIAN], 0, 1e-3));
	assert_true(near(fabs(p.value[QUANTITY_MEAN]), 0.5e6 * sqrt(0.5), 10));
	surface_finish(&s);
	/* disc */
	s = shape_turned(2, 2, (const double[]){ 0, 1 }, (const double[]){ 0, 0 }, NULL, k2);
	for (int i = 0; i <= 8; i++)
		expect_pole(&s, i / 8.0, 0, vec3(0, 0, -1), 0, 0, 1e-9);
	surface_finish(&s);
	/* paraboloid z = r^2 / 2: both curvatures 1 at the apex, against the outward normal */
	s = shape_turned(3, 3, (const double[]){ 0, 0.5, 1 }, (const double[]){ 0, 0, 0.5 }, NULL,
	                 k3);
	for (int i = 0; i <= 8; i++)
		expect_pole(&s, i / 8.0, 0, vec3(0, 0, -1), -1, 1, 1e-8);
	surface_finish(&s);
	/* z = r^2 / 2 + ..., r = t^2, z = t^3: the curvature grows without bound, a normal is there */
	s = shape_turned(4, 4, (const double[]){ 0, 0, 1 / 3., 1 }, (const double[]){ 0, 0, 0, 1 },
	                 NULL, (const double[]){ 0, 0, 0, 0, 1, 1, 1, 1 });
	expect_pole(&s, 0.3, 0, vec3(0, 0, -1), NAN, NAN, 1e-6);
	surface_finish(&s);
	/* r = t^2, z = t^4 / 2: the paraboloid again, starting from rest */
	s = shape_turned(5, 5, (const double[]){ 0, 0, 1 / 6., 0.5, 1 },
	                 (const double[]){ 0, 0, 0, 0, 0.5 }, NULL,
	                 (const double[]){ 0, 0, 0, 0, 0, 1, 1, 1, 1, 1 });
	expect_pole(&s, 0.3, 0, vec3(0, 0, -1), -1, 1, 1e-6);
	surface_finish(&s);
	/* profile through the axis inside the domain: r = t - 1/2, the normal turns over there */
	s = shape_turned(3, 3, (const double[]){ -0.5, 0, 0.5 },
	                 (const double[]){ 0.25, -0.25, 0.25 }, NULL, k3);
	surface_shape(&s, 0.3, 0.5, &p);
	assert_true(p.limit && isnan(p.normal.x));
	assert_true(near(p.value[QUANTITY_GAUSSIAN], 4, 1e-6) && isnan(p.value[QUANTITY_MEAN]));
	surface_finish(&s);
}

/* A triangle of a paraboloid z = x^2 + y^2 with one side of the square shrunk, not turned. */
static void shrunk_border(void **state)
{
	struct surface s;
	struct surface_shape p;
	(void)state;
	assert_int_equal(surface_init(&s, (const int[2]){ 3, 3 }, (const int[2]){ 3, 3 }), ST_OK);
	for (int d = 0; d < 2; d++)
		shape_fill_knots(s.knots[d], 3, 3, KNOTS_CLAMPED);
	/* x = u, y = u v, z = u^2 (1 + v^2): as products of Bernstein polynomials */
	const double v1[3] = { 0, 0.5, 1 }, v2[3] = { 1, 1, 2 };
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++)
			surface_set_point(&s, i, j,
			                  vec3(0.5 * i, 0.5 * i * v1[j], i == 2 ? v2[j] : 0), 1);
	assert_int_equal(surface_check(&s, "triangle", NULL), ST_OK);
	for (int j = 0; j <= 8; j++)
		expect_pole(&s, 0, j / 8.0, vec3(0, 0, 1), 2, 4, 1e-8);
	/* noise of single precision in the shrunk side: regular, and still right */
	for (int j = 1; j < 3; j++)
		surface_set_point(&s, 0, j, vec3(j * 3e-8, j * j * 1e-8, 0), 1);
	surface_shape(&s, 0, 0.4, &p);
	assert_true(near(p.value[QUANTITY_MEAN], 2, 1e-4) && near(p.normal.z, 1, 1e-5));
	surface_finish(&s);
}

/* A corner where the two borders go on in one line: x = u + v, y = u v. */
static void flat_corner(void **state)
{
	struct surface s;
	(void)state;
	assert_int_equal(surface_init(&s, (const int[2]){ 2, 2 }, (const int[2]){ 2, 2 }), ST_OK);
	for (int d = 0; d < 2; d++)
		shape_fill_knots(s.knots[d], 2, 2, KNOTS_CLAMPED);
	/* N at (0, 0) is that of (1, -1 .. u - v) : turns over on the diagonal, so there is none */
	for (int i = 0; i < 2; i++)
		for (int j = 0; j < 2; j++)
			surface_set_point(&s, i, j, vec3(i + j, i * j, 0), 1);
	assert_int_equal(surface_check(&s, "fold", NULL), ST_OK);
	struct surface_shape p;
	surface_shape(&s, 0, 0, &p);
	assert_true(p.limit && isnan(p.normal.x));
	surface_finish(&s);
	/* x = u^2 - v^2, y = 2 u v (z^2 in the complex plane), z = (x^2 + y^2) / 2 = (u^2 + v^2)^2 / 2 */
	assert_int_equal(surface_init(&s, (const int[2]){ 5, 5 }, (const int[2]){ 5, 5 }), ST_OK);
	for (int d = 0; d < 2; d++)
		shape_fill_knots(s.knots[d], 5, 5, KNOTS_CLAMPED);
	for (int i = 0; i < 5; i++)
		for (int j = 0; j < 5; j++) {
			/* Bernstein coefficients of degree 4: t, t^2, t^4 */
			const double u1 = i / 4.0, v1 = j / 4.0;
			const double u2 = i * (i - 1) / 12.0, v2 = j * (j - 1) / 12.0;
			const double u4 = i == 4, v4 = j == 4;
			surface_set_point(&s, i, j,
			                  vec3(u2 - v2, 2 * u1 * v1, 0.5 * (u4 + v4) + u2 * v2), 1);
		}
	assert_int_equal(surface_check(&s, "square", NULL), ST_OK);
	expect_pole(&s, 0, 0, vec3(0, 0, 1), 1, 1, 1e-6);
	surface_finish(&s);
}

/* Newell's teapot's lid, upper quarter: its knob's top is a shrunk border with a normal. */
static void teapot_lid(void **state)
{
	static const double p[16][3] = {
		{ 0, 0, 3 }, { 0.8, 0, 3 },     { 0, 0, 2.7 }, { 0.2, 0, 2.55 },
		{ 0, 0, 3 }, { 0.8, -0.45, 3 }, { 0, 0, 2.7 }, { 0.2, -0.112, 2.55 },
		{ 0, 0, 3 }, { 0.45, -0.8, 3 }, { 0, 0, 2.7 }, { 0.112, -0.2, 2.55 },
		{ 0, 0, 3 }, { 0, -0.8, 3 },    { 0, 0, 2.7 }, { 0, -0.2, 2.55 },
	};
	struct surface s;
	struct surface_shape shape;
	(void)state;
	assert_int_equal(surface_init(&s, (const int[2]){ 4, 4 }, (const int[2]){ 4, 4 }), ST_OK);
	for (int d = 0; d < 2; d++)
		shape_fill_knots(s.knots[d], 4, 4, KNOTS_CLAMPED);
	for (int i = 0; i < 16; i++)
		surface_set_point(&s, i / 4, i % 4, vec3(p[i][0], p[i][1], p[i][2]), 1);
	assert_int_equal(surface_check(&s, "lid", NULL), ST_OK);
	for (int i = 0; i <= 8; i++) {
		surface_shape(&s, i / 8.0, 0, &shape);
		assert_true(shape.limit && near(fabs(shape.normal.z), 1, 1e-9));
		for (int q = 0; q < QUANTITY_NORMAL_U; q++) /* not round: differs by direction */
			assert_true(isnan(shape.value[q]));
		assert_true(isfinite(shape.value[QUANTITY_NORMAL_V]));
	}
	surface_finish(&s);
}

/* All points on one line: a surface for surface_check, but nowhere a normal. */
static void no_surface_at_all(void **state)
{
	struct surface s = shape_surface((const int[2]){ 4, 3 }, (const int[2]){ 6, 5 }, true,
	                                 KNOTS_CLAMPED, 3);
	struct surface_shape p;
	(void)state;
	for (int i = 0; i < 30; i++)
		surface_set_point(&s, i / 5, i % 5, vec3(0.1 * i, 0.2 * i, 0.3 * i), 1 + i % 3);
	for (int i = 0; i <= 10; i++)
		for (int j = 0; j <= 10; j++) {
			surface_shape(&s, i / 10.0, j / 10.0, &p);
			assert_true(p.limit && isnan(p.normal.x) &&
			            isnan(p.value[QUANTITY_GAUSSIAN]));
		}
	surface_finish(&s);
}

/* Points that are regular, if only just, must not be taken for poles. */
static void thin_but_regular(void **state)
{
	static const double stretch[] = { 1e-3, 1e-6, 1e-9 };
	(void)state;
	for (int k = 0; k < 3; k++) {
		struct surface a = shape_wave10(), b = shape_wave10();
		struct surface_shape p, q;
		/* the same surface, its parameter u run through at a stretched pace */
		for (int i = 0; i < 14; i++)
			b.knots[0][i] *= stretch[k];
		b.domain[0][1] *= stretch[k];
		for (int i = 0; i <= 20; i++) {
			surface_shape(&a, i / 20.0, 0.3, &p);
			surface_shape(&b, i / 20.0 * stretch[k], 0.3, &q);
			assert_false(q.limit);
			for (int v = 0; v < N_QUANTITIES; v++)
				assert_true(near(p.value[v], q.value[v], 1e-11));
		}
		surface_finish(&a);
		surface_finish(&b);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(table_is_as_agreed),
		cmocka_unit_test(sphere_is_exact),
		cmocka_unit_test(torus_is_exact),
		cmocka_unit_test(values_agree_with_differences),
		cmocka_unit_test(derivatives_are_those_of_the_surface),
		cmocka_unit_test(far_from_the_origin),
		cmocka_unit_test(sphere_poles_have_limits),
		cmocka_unit_test(poles_at_the_ends_of_u),
		cmocka_unit_test(turned_profiles),
		cmocka_unit_test(shrunk_border),
		cmocka_unit_test(flat_corner),
		cmocka_unit_test(teapot_lid),
		cmocka_unit_test(no_surface_at_all),
		cmocka_unit_test(thin_but_regular),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
