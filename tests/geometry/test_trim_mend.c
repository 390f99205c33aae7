/* test_trim_mend.c - loops as files give them, and what is made of them. */
#include <stdio.h>

#include "cmocka_all.h"
#include "trim_shapes.h"

static double area_of(const struct trim *t, const struct surface *s)
{
	double area, error;
	assert_int_equal(trim_area(t, s, 1e-10, &area, &error), ST_OK);
	return area;
}

static void mend_loosely(struct trim *t, const struct surface *s, double tolerance)
{
	struct report_store store;
	report_store_init(&store);
	if (trim_mend(t, s, tolerance, "face", &store.report) != ST_OK)
		fail_msg("%s", store.error);
}

/* All must lie in the domain, and curves begin where the last end. */
static void mend(struct trim *t, const struct surface *s, double tolerance)
{
	mend_loosely(t, s, tolerance);
	for (int i = 0; i < t->n; i++)
		for (int j = 0; j < t->loops[i].n; j++) {
			const struct trim_loop *l = &t->loops[i];
			const struct curve *a = &l->curves[j], *b = &l->curves[(j + 1) % l->n];
			struct vec3 end = curve_point(a, a->domain[1]);
			struct vec3 start = curve_point(b, b->domain[0]);
			assert_true(vec3_length(vec3_sub(end, start)) < 1e-14);
			for (int k = 0; k <= 20; k++) {
				struct vec3 p = curve_point(
				        a, a->domain[0] + (a->domain[1] - a->domain[0]) * k / 20.0);
				const double(*d)[2] = s->domain, out = 1e-12;
				assert_true(p.x >= d[0][0] - out && p.x <= d[0][1] + out);
				assert_true(p.y >= d[1][0] - out && p.y <= d[1][1] + out);
			}
		}
}

/* A tube of radius 1 from z = 0 to 3, closed in u. */
static struct surface tube(void)
{
	const double x[2] = { 1, 1 }, z[2] = { 0, 3 }, k[4] = { 0, 0, 1, 1 };
	return shape_turned(2, 2, x, z, NULL, k);
}

static void order_direction_and_gaps(void **state)
{
	struct surface s = shape_plane(3, 2);
	(void)state;
	for (uint64_t seed = 1; seed < 60; seed++) {
		uint64_t random = seed;
		const double x[6] = { 0.2, 0.7, 0.9, 0.6, 0.3, 0.1 };
		const double y[6] = { 0.1, 0.2, 0.7, 0.9, 0.8, 0.5 };
		struct curve c[6];
		struct trim t = { 0 }, exact = { 0 };
		struct trim_loop l = { .outer = seed % 2 }, m = l;
		double gap = seed % 3 ? 1e-4 : 0;
		for (int i = 0; i < 6; i++) {
			int j = (i + 1) % 6;
			trim_put(&m, trim_line(x[i], y[i], x[j], y[j]));
			c[i] = trim_line(x[i] + gap * shape_random(&random),
			                 y[i] + gap * shape_random(&random),
			                 x[j] + gap * shape_random(&random),
			                 y[j] + gap * shape_random(&random));
			if (shape_random(&random) < 0.5)
				curve_reverse(&c[i]);
		}
		for (int i = 5; i >= 0; i--) {
			int j = (int)(shape_random(&random) * (i + 1));
			struct curve one = c[j];
			c[j] = c[i];
			trim_put(&l, one);
		}
		trim_close(&t, l);
		trim_close(&exact, m);
		mend(&t, &s, 1e-3);
		assert_int_equal(t.n, 1);
		assert_int_equal(t.loops[0].n, 6);
		assert_float_equal(area_of(&t, &s), area_of(&exact, &s), 10 * gap + 1e-12);
		trim_finish(&t);
		trim_finish(&exact);
	}
	surface_finish(&s);
}

static void what_is_near_the_border_lies_on_it(void **state)
{
	struct surface s = shape_plane(1, 1);
	struct trim_test *x;
	struct trim t = { 0 };
	const double e = 1e-7;
	(void)state;
	trim_add_box(&t, true, e, -e, 1 - e, 1 + e);
	mend(&t, &s, 1e-6);
	assert_float_equal(area_of(&t, &s), 1, 0);
	assert_int_equal(trim_test_create(&x, &t, &s), ST_OK);
	for (int i = 0; i <= 10; i++)
		for (int j = 0; j <= 10; j++)
			assert_true(trim_test_inside(x, i / 10.0, j / 10.0));
	trim_test_destroy(x);
	trim_finish(&t);
	surface_finish(&s);
}

/* A disc that is a little larger than its square, as circles inscribed in their surface are after
 * rounding: what lies beyond is cut off, and nothing else. */
static void what_leaves_a_little_is_cut_off(void **state)
{
	struct surface s = shape_plane(1, 1);
	(void)state;
	for (int k = 0; k < 6; k++) {
		struct trim t = { 0 };
		double r = 0.5 + pow(10, -2.2 - k);
		double half = acos(0.5 / r), segment = r * r * (half - sin(half) * cos(half));
		trim_add_ellipse(&t, true, 0.5, 0.5, r, r, 0.2 * k);
		mend_loosely(&t, &s, 1e-6);
		assert_float_equal(area_of(&t, &s), M_PI * r * r - 4 * segment, 1e-9);
		trim_finish(&t);
	}
	surface_finish(&s);
}

static void keep_info(void *data, enum report_level level, enum status st, const char *text)
{
	(void)st;
	if (level == REPORT_INFO)
		snprintf(data, 256, "%s", text);
}

/* By how much a loop leaves an open border is told, in space. */
static void what_leaves_is_told(void **state)
{
	struct surface s = shape_plane(3, 3);
	(void)state;
	for (int k = 0; k < 6; k++) {
		static const char before[] =
		        "cut at the seam or the border, which they leave by up to ";
		char said[256] = "";
		const struct report r = { keep_info, said };
		struct trim t = { 0 };
		const double out = pow(10, -2 - 0.5 * k);
		trim_add_ellipse(&t, true, 0.5, 0.5, 0.5 + out / 3, 0.45, 0);
		assert_int_equal(trim_mend(&t, &s, 1e-7, "face", &r), ST_OK);
		const char *found = strstr(said, before);
		if (!found || fabs(atof(found + sizeof before - 1) / out - 1) > 0.02)
			fail_msg("%g: %s", out, said);
		trim_finish(&t);
	}
	surface_finish(&s);
}

/* A hole anywhere on a tube, and on a torus, as one loop in u, v that knows no seam: the rest is the
 * same wherever it lies. */
static void holes_over_seams(void **state)
{
	(void)state;
	for (int torus = 0; torus < 2; torus++) {
		struct surface s = torus ? shape_torus(3, 1) : tube();
		for (int k = 0; k < 24; k++) {
			struct trim t = { 0 };
			struct trim_test *x;
			double u = -1 + k / 8.0, v = torus ? 1.5 - k / 12.0 : 0.5;
			double a = 0.11, b = 0.3;
			trim_add_ellipse(&t, k % 3 == 0, u, v, a, b, 0.1 * k);
			mend(&t, &s, 1e-6);
			assert_int_equal(trim_test_create(&x, &t, &s), ST_OK);
			for (int i = 0; i < 40; i++)
				for (int j = 0; j < 40; j++) {
					double p = (i + 0.5) / 40, q = (j + 0.5) / 40, du = p - u,
					       dv = q - v;
					du -= round(du);
					if (torus)
						dv -= round(dv);
					double turn = 0.1 * k;
					/* undo the turn of the unit circle */
					double cx = du / a, cy = dv / b;
					double r = hypot(cx * cos(turn) + cy * sin(turn),
					                 cy * cos(turn) - cx * sin(turn));
					if (fabs(r - 1) > 1e-6)
						assert_int_equal(trim_test_inside(x, p, q),
						                 (r < 1) == (k % 3 == 0));
				}
			trim_test_destroy(x);
			if (!torus) {
				/* u is not the angle, but nearly; v is a third of the height */
				double whole = 6 * M_PI, area = area_of(&t, &s);
				double hole = k % 3 == 0 ? area : whole - area;
				double about = M_PI * a * b * 6 * M_PI;
				assert_true(hole > 0.9 * about && hole < 1.1 * about);
			}
			trim_finish(&t);
		}
		surface_finish(&s);
	}
}

/* Loops that wind around a tube leave what is between them, given as it may be. */
static void loops_round_a_tube(void **state)
{
	struct surface s = tube();
	(void)state;
	for (int k = 0; k < 8; k++) {
		struct trim t = { 0 };
		for (int i = 0; i < 2; i++) {
			struct trim_loop l = { .outer = k & 4 || i == 0 };
			double v = i ? 0.75 : 0.25, from = 0.1 * k;
			struct curve c = trim_line(from, v, from + 1, v);
			if (k >> i & 1)
				curve_reverse(&c);
			trim_put(&l, c);
			trim_close(&t, l);
		}
		mend(&t, &s, 1e-6);
		assert_float_equal(area_of(&t, &s), 3 * M_PI, 1e-8);
		trim_finish(&t);
	}
	/* one alone keeps its left side */
	for (int way = 0; way < 2; way++) {
		struct trim t = { 0 };
		struct trim_loop l = { .outer = true };
		trim_put(&l, way ? trim_line(1.3, 0.25, 0.3, 0.25) : trim_line(0, 0.25, 1, 0.25));
		trim_close(&t, l);
		mend(&t, &s, 1e-6);
		assert_float_equal(area_of(&t, &s), way ? 1.5 * M_PI : 4.5 * M_PI, 1e-8);
		trim_finish(&t);
	}
	surface_finish(&s);
}

/* The seam as two curves of the loop, told once on its wrong side; and a pole left out. */
static void seams_and_poles_in_loops(void **state)
{
	struct surface s = tube(), ball = shape_sphere(1);
	(void)state;
	for (int wrong = 0; wrong < 2; wrong++) {
		struct trim t = { 0 };
		struct trim_loop l = { .outer = true };
		trim_put(&l, trim_line(0, 0.25, 1, 0.25));
		trim_put(&l, trim_line(!wrong, 0.25, !wrong, 0.5));
		trim_put(&l, trim_line(1, 0.5, 0, 0.5));
		trim_put(&l, trim_line(0, 0.5, 0, 0.25));
		trim_close(&t, l);
		mend(&t, &s, 1e-6);
		assert_float_equal(area_of(&t, &s), 1.5 * M_PI, 1e-8);
		trim_finish(&t);
	}
	struct trim t = { 0 };
	struct trim_loop l = { .outer = true };
	trim_put(&l, trim_line(0.25, 0.5, 0.5, 0.5));
	trim_put(&l, trim_line(0.5, 0.5, 0.5, 1));
	trim_put(&l, trim_line(0.25, 1, 0.25, 0.5));
	trim_close(&t, l);
	mend(&t, &ball, 1e-6);
	assert_float_equal(area_of(&t, &ball), M_PI / 2, 1e-8);
	trim_finish(&t);
	surface_finish(&s);
	surface_finish(&ball);
}

static void faults_leave_it_as_it_was(void **state)
{
	struct surface plane = shape_plane(1, 1), torus = shape_torus(3, 1), s = tube();
	const struct {
		const struct surface *s;
		double line[4][4];
		int n;
		const char *fault;
	} cases[] = {
		{ &plane, { { 0.1, 0.1, 0.5, 0.1 }, { 0.5, 0.2, 0.2, 0.1 } }, 2, "has a gap" },
		{ &plane, { { 0.1, 0.1, 0.5, 0.1 }, { 0.5, 0.1, 0.2, 0.4 } }, 2, "does not close" },
		{ &plane, { { 0 } }, 0, "has no curves" },
		{ &plane,
		  { { 0.5, 0.5, 1.5, 0.5 }, { 1.5, 0.5, 0.5, 0.8 }, { 0.5, 0.8, 0.5, 0.5 } },
		  3,
		  "leaves the domain" },
		{ &s,
		  { { 0.5, 0.5, 0.7, 1.5 }, { 0.7, 1.5, 0.8, 0.8 }, { 0.8, 0.8, 0.5, 0.5 } },
		  3,
		  "leaves the domain" },
		{ &torus, { { 0, 0.5, 1, 0.5 } }, 1, "closed in both directions" },
		{ &s, { { 0, 0.5, 2, 0.5 } }, 1, "more than once" },
	};
	(void)state;
	for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
		struct trim t = { 0 };
		struct trim_loop l = { .outer = true };
		struct report_store store;
		trim_add_ellipse(&t, true, 0.5, 0.5, 0.1, 0.1, 0);
		for (int i = 0; i < cases[k].n; i++) {
			const double *x = cases[k].line[i];
			trim_put(&l, trim_line(x[0], x[1], x[2], x[3]));
		}
		trim_close(&t, l);
		const struct trim before = t;
		report_store_init(&store);
		assert_int_equal(trim_mend(&t, cases[k].s, 1e-3, "face 7", &store.report),
		                 ST_INPUT);
		assert_non_null(strstr(store.error, "face 7: trimming loop 2"));
		if (!strstr(store.error, cases[k].fault))
			fail_msg("'%s' says nothing of '%s'", store.error, cases[k].fault);
		assert_memory_equal(&before, &t, sizeof t);
		assert_int_equal(store.n_errors, 1);
		trim_finish(&t);
	}
	surface_finish(&plane);
	surface_finish(&torus);
	surface_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(order_direction_and_gaps),
		cmocka_unit_test(what_is_near_the_border_lies_on_it),
		cmocka_unit_test(what_leaves_a_little_is_cut_off),
		cmocka_unit_test(what_leaves_is_told),
		cmocka_unit_test(holes_over_seams),
		cmocka_unit_test(loops_round_a_tube),
		cmocka_unit_test(seams_and_poles_in_loops),
		cmocka_unit_test(faults_leave_it_as_it_was),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
