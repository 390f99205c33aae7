/* test_project.c - curves brought down to a surface and lifted from it; cubics fitted to functions. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "construct.h"
#include "hermite.h"
#include "project_curve.h"
#include "refine.h"

/* ---- cubics */

/* A plane curve by its function and derivative. */
struct plane_function {
	double (*f)(double t);
	double (*left)(double t), (*right)(double t);
};

static void function_at(void *data, double a, double b, struct vec3 guess, struct hermite_node *n)
{
	const struct plane_function *p = data;
	(void)a, (void)b, (void)guess;
	n->point = vec3(n->t, p->f(n->t), 0);
	n->in = vec3(1, p->left(n->t), 0);
	n->out = vec3(1, p->right(n->t), 0);
}

static double function_off(void *data, const struct hermite_node *n, struct vec3 candidate)
{
	(void)data;
	return vec3_length(vec3_sub(n->point, candidate));
}

static double cube(double t)
{
	return t * t * t - t;
}
static double cube_slope(double t)
{
	return 3 * t * t - 1;
}
static double fabs_left(double t)
{
	return t <= 0 ? -1 : 1;
}
static double fabs_right(double t)
{
	return t < 0 ? -1 : 1;
}
static double jump(double t)
{
	return t < 0.3 ? 0 : 1;
}
static double flat(double t)
{
	(void)t;
	return 0;
}

static void functions_become_cubics(void **state)
{
	static const struct {
		struct plane_function p;
		double breaks[3];
		int n;
		double tolerance, worst; /* that may be said */
		int least, most;         /* pieces */
	} rows[] = {
		{ { cube, cube_slope, cube_slope }, { -1, 2 }, 2, 1e-9, 1e-14, 1, 1 },
		{ { sin, cos, cos }, { 0, 3 }, 2, 1e-6, 1e-6, 8, 32 },
		{ { sin, cos, cos }, { 0, 3 }, 2, 1e-9, 1e-9, 64, 128 },
		/* a kink at a break costs nothing */
		{ { fabs, fabs_left, fabs_right }, { -1, 0, 1 }, 3, 1e-9, 1e-15, 2, 2 },
		/* what no cubic meets ends, and is told */
		{ { jump, flat, flat }, { 0, 1 }, 2, 1e-6, 1, 10, 1024 },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		struct plane_function p = rows[i].p;
		const struct hermite h = { function_at, function_off, &p, rows[i].tolerance };
		struct curve c;
		double said, found = 0;
		assert_int_equal(hermite_fit(&h, rows[i].breaks, rows[i].n,
		                             vec3(rows[i].breaks[0], p.f(rows[i].breaks[0]), 0), &c,
		                             &said),
		                 ST_OK);
		assert_int_equal(curve_check(&c, "the curve", NULL), ST_OK);
		int pieces = (c.n - 1) / 3;
		if (pieces < rows[i].least || pieces > rows[i].most)
			fail_msg("row %zu: %d pieces", i, pieces);
		for (int k = 0; k <= 3000; k++) {
			double t = c.domain[0] + (c.domain[1] - c.domain[0]) * k / 3000;
			struct vec3 q = curve_point(&c, t);
			found = fmax(found, hypot(q.x - t, q.y - p.f(t)));
		}
		if (!(said <= rows[i].worst) || !(found <= 1.1 * said + 1e-14))
			fail_msg("row %zu: %g found, %g said", i, found, said);
		curve_finish(&c);
	}
}

static void breaks_are_parted_where_they_are_few(void **state)
{
	static const struct vec3 p[] = { { 0, 0, 0 }, { 1, 0, 0 }, { 2, 1, 0 }, { 3, 0, 0 } };
	struct curve c;
	double *b;
	int n;
	(void)state;
	assert_int_equal(make_polyline(&c, p, 4), ST_OK);
	assert_int_equal(hermite_breaks(&c, 2, &b, &n), ST_OK);
	assert_int_equal(n, 4);
	free(b);
	assert_int_equal(hermite_breaks(&c, 7, &b, &n), ST_OK);
	assert_int_equal(n, 10);
	assert_true(b[0] == 0 && b[9] == 1);
	for (int i = 1; i < n; i++)
		assert_true(b[i] > b[i - 1]);
	free(b);
	curve_finish(&c);
}

/* ---- projection */

/* Largest distance between c and what its course in u,v becomes. */
static double apart(const struct surface *s, const struct curve *c, const struct curve *uv)
{
	double worst = 0;
	for (int k = 0; k <= 200; k++) {
		double t = c->domain[0] + (c->domain[1] - c->domain[0]) * k / 200, best = INFINITY;
		struct vec3 x = curve_point(c, t), q = curve_point(uv, t);
		for (int d = 0; d < 2; d++) {
			double *w = d ? &q.y : &q.x, width = s->domain[d][1] - s->domain[d][0];
			if (surface_closed(s, d, 1e-9))
				*w -= width * floor((*w - s->domain[d][0]) / width);
			*w = fmin(fmax(*w, s->domain[d][0]), s->domain[d][1]);
		}
		best = vec3_length(vec3_sub(x, surface_point(s, q.x, q.y)));
		worst = fmax(worst, best);
	}
	return worst;
}

enum shape { PARALLELOGRAM, SPHERE, TORUS, N_SHAPES };

static void make_shape(enum shape shape, struct surface *out)
{
	static const struct vec3 corner[4] = { { 1, 1, 0 }, { 4, 1, 0 }, { 2, 3, 1 }, { 5, 3, 1 } };
	enum status st = shape == PARALLELOGRAM ? make_bilinear(out, corner)
	                 : shape == SPHERE      ? make_sphere(out, vec3(0, 0, 0), 2)
	                                        : make_torus(out, vec3(0, 0, 0), 3, 1);
	assert_int_equal(st, ST_OK);
}

static void curves_are_brought_down(void **state)
{
	static const struct vec3 x = { 1, 0, 0 }, y = { 0, 1, 0 }, z = { 0, 0, 1 };
	const double h = sqrt(0.5);
	const struct {
		enum shape shape;
		struct vec3 c, x, y;
		double radius, from, to;
		int points; /* of the curve in u,v, 0: any number */
		double off; /* how far from the surface */
	} rows[] = {
		/* exact: the arc itself, in other coordinates */
		{ PARALLELOGRAM,
		  { 3, 2, 0.5 },
		  x,
		  { 0, 2 / sqrt(5), 1 / sqrt(5) },
		  0.5,
		  0,
		  2 * M_PI,
		  9,
		  0 },
		{ PARALLELOGRAM, { 3, 2, 0.75 }, x, y, 0.1, 0, 1, 3, 0.5 / sqrt(5) },
		/* a latitude and a meridian are lines; over the pole it is not one */
		{ SPHERE, { 0, 0, 1 }, x, y, sqrt(3), 0.2, 4, 2, 0 },
		{ SPHERE, { 0, 0, 0 }, { h, h, 0 }, z, 2, -1, 1.2, 2, 0 },
		/* a great circle askew, and over the seam */
		{ SPHERE, { 0, 0, 0 }, x, { 0, h, h }, 2, 0.3, 2.5, 0, 0 },
		{ SPHERE, { 0, 0, 0 }, x, { 0, h, h }, 2, -1, 1, 0, 0 },
		/* a tenth beside it */
		{ SPHERE, { 0, 0, 0 }, x, { 0, h, h }, 2.1, 0.3, 2.5, 0, 0.1 },
		{ TORUS, { 3, 0, 0 }, x, z, 1, 0.1, 6, 2, 0 },
		{ TORUS, { 0, 0, 1 }, x, y, 3, 0.1, 6, 2, 0 },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		struct surface s;
		struct projector *p;
		struct curve c, uv;
		double distance;
		make_shape(rows[i].shape, &s);
		assert_int_equal(make_arc(&c, rows[i].c, rows[i].x, rows[i].y, rows[i].radius,
		                          rows[i].from, rows[i].to),
		                 ST_OK);
		assert_int_equal(projector_create(&p, &s), ST_OK);
		assert_int_equal(projector_curve(p, &c, 1e-6, 1, &uv, &distance), ST_OK);
		if (rows[i].points && uv.n != rows[i].points)
			fail_msg("row %zu: %d points in u,v", i, uv.n);
		for (int k = 0; k < uv.n; k++)
			assert_true(uv.points[4 * k + 2] == 0);
		if (!(fabs(distance - rows[i].off) <= 2e-3 * rows[i].off + 1.2e-6))
			fail_msg("row %zu: distance %g", i, distance);
		/* lines keep the curve's place, not its pace */
		double found = uv.n == 2 ? 0 : apart(&s, &c, &uv);
		if (!(found <= distance + 2e-6))
			fail_msg("row %zu: %g apart", i, found);
		curve_finish(&uv);
		curve_finish(&c);
		projector_destroy(p);
		surface_finish(&s);
	}
}

static void curves_that_lie_elsewhere_are_given_up(void **state)
{
	struct surface s;
	struct projector *p;
	struct curve c, uv;
	double distance;
	(void)state;
	make_shape(SPHERE, &s);
	assert_int_equal(make_line(&c, vec3(2, 0, 0), vec3(9, 9, 9)), ST_OK);
	assert_int_equal(projector_create(&p, &s), ST_OK);
	assert_int_equal(projector_curve(p, &c, 1e-6, 0.1, &uv, &distance), ST_OK);
	assert_true(distance > 0.1);
	curve_finish(&uv);
	curve_finish(&c);
	projector_destroy(p);
	surface_finish(&s);
}

static void periods_are_those_of_closed_directions(void **state)
{
	static const double expected[N_SHAPES][2] = { { 0, 0 },
		                                      { 2 * M_PI, 0 },
		                                      { 2 * M_PI, 2 * M_PI } };
	(void)state;
	for (int i = 0; i < N_SHAPES; i++) {
		struct surface s;
		struct projector *p;
		make_shape(i, &s);
		assert_int_equal(projector_create(&p, &s), ST_OK);
		for (int d = 0; d < 2; d++)
			assert_true(fabs(projector_period(p, d) - expected[i][d]) < 1e-12);
		projector_destroy(p);
		surface_finish(&s);
	}
}

/* Lines of one parameter are exact, others cubics within the tolerance; down again they are back. */
static void curves_are_lifted(void **state)
{
	static const struct {
		enum shape shape;
		struct vec3 a, b;
		bool exact;
	} rows[] = {
		{ PARALLELOGRAM, { 0.1, 0.2, 0 }, { 0.7, 0.9, 0 }, true },
		{ SPHERE, { 0.5, 0.3, 0 }, { 3.5, 0.3, 0 }, true },
		{ SPHERE, { 0.5, 1, 0 }, { 0.5, -1, 0 }, true },
		{ SPHERE, { 0.5, -0.5, 0 }, { 3, 0.9, 0 }, false },
		{ TORUS, { 1, 1, 0 }, { 5, 4, 0 }, false },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		struct surface s;
		struct projector *p;
		struct curve uv, c, again;
		double distance;
		make_shape(rows[i].shape, &s);
		assert_int_equal(make_line(&uv, rows[i].a, rows[i].b), ST_OK);
		assert_int_equal(project_lift(&s, &uv, 1e-7, &c), ST_OK);
		assert_int_equal(curve_check(&c, "the curve", NULL), ST_OK);
		assert_true(c.domain[0] == uv.domain[0] && c.domain[1] == uv.domain[1]);
		double found = 0;
		for (int k = 0; k <= 200; k++) {
			double t = k / 200.0;
			struct vec3 q = curve_point(&uv, t);
			found = fmax(found, vec3_length(vec3_sub(curve_point(&c, t),
			                                         surface_point(&s, q.x, q.y))));
		}
		if (!(found <= (rows[i].exact ? 1e-14 : 1.1e-7)))
			fail_msg("row %zu: %g off", i, found);
		assert_int_equal(projector_create(&p, &s), ST_OK);
		assert_int_equal(projector_curve(p, &c, 1e-6, 1, &again, &distance), ST_OK);
		for (int end = 0; end < 2; end++) {
			struct vec3 q = curve_point(&again, again.domain[end]);
			assert_true(vec3_length(vec3_sub(q, end ? rows[i].b : rows[i].a)) < 1e-6);
		}
		curve_finish(&again);
		curve_finish(&uv);
		curve_finish(&c);
		projector_destroy(p);
		surface_finish(&s);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(functions_become_cubics),
		cmocka_unit_test(breaks_are_parted_where_they_are_few),
		cmocka_unit_test(curves_are_brought_down),
		cmocka_unit_test(curves_that_lie_elsewhere_are_given_up),
		cmocka_unit_test(periods_are_those_of_closed_directions),
		cmocka_unit_test(curves_are_lifted),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
