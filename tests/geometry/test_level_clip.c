/* test_level_clip.c - curves on trimmed faces: chords and arcs by formula, lengths by dense samples. */
#include "level_scene.h"
#include "trim_shapes.h"

static const double tolerance = 1e-5;

static void trace(const struct surface *s, const struct level_field *field,
                  struct level_result *out)
{
	struct level *l;
	assert_int_equal(level_create(&l, s, field, tolerance, NULL), ST_OK);
	assert_int_equal(shape_trace_level(l, out, NULL), ST_OK);
	level_destroy(l);
}

static void clip(const struct surface *s, const struct trim *t, struct level_result *x)
{
	const struct level_face face = { s, t };
	struct level_faces *f;
	assert_int_equal(level_faces_create(&f, &face, 1, 1e-4), ST_OK);
	assert_int_equal(level_clip(f, 0, tolerance, x), ST_OK);
	level_faces_destroy(f);
}

/* All that is left is on the face; ends are ends of what was traced, or on the trim. */
static void check_inside(const struct surface *s, const struct trim *t,
                         const struct level_result *x)
{
	struct trim_test *test;
	assert_int_equal(trim_test_create(&test, t, s), ST_OK);
	for (size_t b = 0; b < x->n_branches; b++) {
		const struct level_branch *one = &x->branches[b];
		check_curves(s, one);
		for (int k = 1; k < 100; k++) {
			const struct vec3 uv = curve_point(&one->uv, one->uv.domain[1] * k / 100);
			const double near = 1e-5 * (s->domain[0][1] - s->domain[0][0]);
			const double lo[2] = { uv.x - near, uv.y - near };
			const double hi[2] = { uv.x + near, uv.y + near };
			assert_true(trim_test_box(test, lo, hi) >= 0);
		}
	}
	trim_test_destroy(test);
}

/* Lines y = c on a square of side 1 with a disk, less a hole, and a box. */
static void test_chords(void **state)
{
	(void)state;
	const double r = 0.4, hole = 0.1;
	struct surface s = shape_plane(1, 1);
	struct trim t = { 0 };
	trim_add_ellipse(&t, true, 0.5, 0.5, r, r, 0.3);
	trim_add_ellipse(&t, false, 0.5, 0.55, hole, hole, 1);
	const struct {
		double y;
		size_t branches;
	} cases[] = {
		{ 0.05, 0 }, { 0.1, 0 },  /* a touch from outside leaves nothing */
		{ 0.2, 1 },  { 0.45, 1 }, /* a touch of the hole parts nothing */
		{ 0.5, 2 },  { 0.55, 2 }, { 0.65, 1 }, { 0.7, 1 }, { 0.9, 0 }, { 0.95, 0 },
	};
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		const double y = cases[i].y;
		const struct level_field field = { .kind = LEVEL_PLANE,
			                           .direction = { 0, 1, 0 },
			                           .value = y };
		struct level_result x;
		trace(&s, &field, &x);
		assert_int_equal(x.n_branches, 1);
		clip(&s, &t, &x);
		const double whole = sqrt(fmax(r * r - (y - 0.5) * (y - 0.5), 0));
		const double less = sqrt(fmax(hole * hole - (y - 0.55) * (y - 0.55), 0));
		assert_int_equal(x.n_branches, cases[i].branches);
		if (cases[i].branches > 0)
			assert_true(fabs(x.length - 2 * (whole - less)) < 1e-7);
		check_inside(&s, &t, &x);
		for (size_t b = 0; b < x.n_branches; b++)
			for (int e = 0; e < 2; e++) {
				const struct level_branch *one = &x.branches[b];
				const struct vec3 p = curve_point(&one->uv, one->uv.domain[e]);
				const double off = hypot(p.x - 0.5, p.y - 0.5) - r;
				const double in = hypot(p.x - 0.5, p.y - 0.55) - hole;
				assert_true(fmin(fabs(off), fabs(in)) < 1e-12);
			}
		level_result_finish(&x);
	}
	trim_finish(&t);
	surface_finish(&s);
}

/* Lines to draw of a disk with a hole: circles about it, chords in it. */
static void test_lines(void **state)
{
	(void)state;
	struct surface s = shape_plane(1, 1);
	struct trim t = { 0 };
	struct level_lines x = { 0 };
	struct level_faces *f;
	trim_add_ellipse(&t, true, 0.5, 0.5, 0.4, 0.4, 0.3);
	trim_add_ellipse(&t, false, 0.5, 0.5, 0.1, 0.1, 1);
	assert_int_equal(level_faces_create(&f, &(struct level_face){ &s, &t }, 1, 1e-4), ST_OK);
	assert_int_equal(level_face_lines(f, 0, 3, 1e-5, &x), ST_OK);
	double borders = 0, wires = 0;
	assert_int_equal(x.n_borders, 2);
	for (size_t i = 0; i < x.n_borders; i++)
		borders += curve_length(&x.borders[i], x.borders[i].domain[0],
		                        x.borders[i].domain[1], 1e-6);
	assert_true(fabs(borders - 2 * M_PI * 0.5) < 1e-3);
	/* the middle ones in two, the others at a quarter of the square from it */
	assert_int_equal(x.n_wires, 8);
	for (size_t i = 0; i < x.n_wires; i++)
		wires +=
		        curve_length(&x.wires[i], x.wires[i].domain[0], x.wires[i].domain[1], 1e-6);
	assert_true(fabs(wires - 2 * (0.6 + 4 * sqrt(0.16 - 0.0625))) < 1e-6);
	level_lines_finish(&x);
	level_faces_destroy(f);
	trim_finish(&t);
	surface_finish(&s);
}

/* Circles about the middle of the square, cut by a box: arcs by formula; closed ones over their start. */
static void test_arcs(void **state)
{
	(void)state;
	struct surface s = shape_plane(1, 1);
	struct trim t = { 0 };
	trim_add_box(&t, true, 0.1, 0.2, 0.9, 0.9);
	trim_add_box(&t, false, 0.5, 0.6, 0.55, 0.95);
	const struct {
		double r, length;
		size_t branches, closed;
	} cases[] = {
		{ 0.05, 2 * M_PI * 0.05, 1, 1 },
		{ 0.1, 2 * M_PI * 0.1, 1, 1 }, /* touches the hole's lower side in its corner */
		{ 0.2, 0.2 * (2 * M_PI - asin(0.25)), 1, 0 },
		{ 0.3, 0.3 * (2 * M_PI - asin(0.05 / 0.3)), 1, 0 }, /* touches the box below */
		{ 0.35, 0.35 * (2 * M_PI - asin(0.05 / 0.35) - 2 * acos(0.3 / 0.35)), 2, 0 },
		{ 0.4, 0.4 * (2 * M_PI - asin(0.05 / 0.4) - 2 * acos(0.3 / 0.4)), 2, 0 },
	};
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		const struct level_field field = { .kind = LEVEL_CYLINDER,
			                           .direction = { 0, 0, 1 },
			                           .point = { 0.5, 0.5, 0 },
			                           .value = cases[i].r };
		struct level_result x;
		trace(&s, &field, &x);
		clip(&s, &t, &x);
		assert_int_equal(x.n_branches, cases[i].branches);
		assert_int_equal(x.n_closed, cases[i].closed);
		assert_true(fabs(x.length - cases[i].length) < 1e-5);
		check_inside(&s, &t, &x);
		level_result_finish(&x);
	}
	trim_finish(&t);
	surface_finish(&s);
}

/* Curves along trimming curves are on the face, also where they are a little beside them. */
static void test_along(void **state)
{
	(void)state;
	const double off[] = { 0, 1e-8, -1e-6, 1e-4, -1e-4 };
	const size_t n_off = sizeof off / sizeof *off;
	struct surface s = shape_plane(1, 1);
	struct trim box = { 0 }, disk = { 0 }, ring = { 0 };
	trim_add_box(&box, true, 0.2, 0.3, 0.8, 0.7);
	trim_add_ellipse(&disk, true, 0.5, 0.5, 0.4, 0.4, 0.3);
	trim_add_ellipse(&ring, false, 0.5, 0.5, 0.4, 0.4, 2);
	for (size_t i = 0; i < n_off; i++) {
		const struct level_field line = { .kind = LEVEL_PLANE,
			                          .direction = { 0, 1, 0 },
			                          .value = 0.3 + off[i] };
		const struct level_field round = { .kind = LEVEL_CYLINDER,
			                           .direction = { 0, 0, 1 },
			                           .point = { 0.5, 0.5, 0 },
			                           .value = 0.4 + off[i] };
		struct level_result x;
		trace(&s, &line, &x);
		clip(&s, &box, &x);
		assert_int_equal(x.n_branches, off[i] >= -1e-5);
		assert_true(x.n_branches == 0 || fabs(x.length - 0.6) < 4 * tolerance);
		level_result_finish(&x);
		trace(&s, &round, &x);
		clip(&s, &disk, &x);
		assert_int_equal(x.n_closed, off[i] <= 1e-5);
		assert_int_equal(x.n_branches, x.n_closed);
		level_result_finish(&x);
		trace(&s, &round, &x);
		clip(&s, &ring, &x);
		assert_int_equal(x.n_closed, off[i] >= -1e-5);
		assert_int_equal(x.n_branches, x.n_closed);
		level_result_finish(&x);
	}
	trim_finish(&box);
	trim_finish(&disk);
	trim_finish(&ring);
	surface_finish(&s);
}

/* A loop like a flower about the middle: a cubic spline through nothing, n leaves. */
static void trim_add_flower(struct trim *t, bool outer, double u, double v, double r, double wave,
                            int n)
{
	struct trim_loop l = { .outer = outer };
	struct curve c;
	const int points = 4 * n;
	assert_int_equal(curve_init(&c, 4, points + 3), ST_OK);
	for (int i = 0; i < points + 7; i++)
		c.knots[i] = i;
	for (int i = 0; i < points + 3; i++) {
		const double a = 2 * M_PI * (i % points) / points;
		const double q = r + (i % 4 == 0 ? wave : i % 4 == 2 ? -wave : 0);
		curve_set_point(&c, i, vec3(u + q * cos(a), v + q * sin(a), 0), 1);
	}
	c.domain[0] = 3;
	c.domain[1] = points + 3;
	assert_int_equal(curve_check(&c, "flower", NULL), ST_OK);
	trim_put(&l, c);
	trim_close(t, l);
}

/* As long as what dense samples of the whole curves have inside; in as many parts. */
static void test_samples(void **state)
{
	(void)state;
	enum { EACH = 4000 };
	struct surface s;
	struct trim t = { 0 };
	struct trim_test *test;
	assert_int_equal(shape_make(&s, 4, 12, shape_wavy), ST_OK);
	trim_add_flower(&t, true, 0.5, 0.5, 0.4, 0.08, 9);
	trim_add_flower(&t, false, 0.4, 0.45, 0.12, 0.03, 5);
	trim_add_ellipse(&t, false, 0.7, 0.6, 0.1, 0.05, 0.4);
	assert_int_equal(trim_test_create(&test, &t, &s), ST_OK);
	for (int i = 0; i < N_FIELDS; i++) {
		struct level_result x;
		double length = 0;
		size_t parts = 0, closed = 0;
		trace(&s, &every_field[i], &x);
		for (size_t b = 0; b < x.n_branches; b++) {
			const struct level_branch *one = &x.branches[b];
			bool last = false, first = false;
			size_t turns = 0;
			for (int k = 0; k < EACH; k++) {
				const double t0 = one->uv.domain[1] * k / EACH;
				const double t1 = one->uv.domain[1] * (k + 1) / EACH;
				const struct vec3 uv = curve_point(&one->uv, 0.5 * (t0 + t1));
				const bool in = trim_test_inside(test, uv.x, uv.y);
				if (in)
					length +=
					        vec3_length(vec3_sub(curve_point(&one->space, t1),
					                             curve_point(&one->space, t0)));
				turns += k > 0 && in && !last;
				first |= k == 0 && in;
				last = in;
			}
			if (one->closed && turns == 0 && first && last)
				closed++;
			parts += turns + (first && !(one->closed && last && turns > 0));
		}
		clip(&s, &t, &x);
		check_inside(&s, &t, &x);
		assert_int_equal(x.n_branches, parts);
		assert_int_equal(x.n_closed, closed);
		assert_true(fabs(x.length - length) < 1e-3 * length);
		level_result_finish(&x);
	}
	trim_test_destroy(test);
	trim_finish(&t);
	surface_finish(&s);
}

/* A surface with its trims in other parameters. */
static void reparametrise(struct surface *s, struct trim *t)
{
	const double to[2][2] = { { 10, 14 }, { -1, 0.5 } };
	for (int i = 0; i < t->n; i++)
		for (int k = 0; k < t->loops[i].n; k++) {
			struct curve *c = &t->loops[i].curves[k];
			for (int p = 0; p < c->n; p++)
				for (int d = 0; d < 2; d++) {
					const double *from = s->domain[d];
					const double scale =
					        (to[d][1] - to[d][0]) / (from[1] - from[0]);
					double *x = &c->points[4 * p + d];
					*x = to[d][0] * c->points[4 * p + 3] +
					     (*x - from[0] * c->points[4 * p + 3]) * scale;
				}
		}
	for (int d = 0; d < 2; d++)
		surface_reparametrise(s, d, to[d][0], to[d][1]);
}

/* Cut by loops in two faces that fit: joined they have the curves of the whole. */
static void test_fitting(void **state)
{
	(void)state;
	static struct scene one, two;
	struct surface s;
	assert_int_equal(shape_make(&s, 4, 12, shape_wavy), ST_OK);
	one.n = 1;
	two.n = 2;
	assert_int_equal(surface_copy(&one.faces[0], &s), ST_OK);
	for (int i = 0; i < 2; i++) {
		assert_int_equal(surface_copy(&two.faces[i], &s), ST_OK);
		trim_add_flower(&two.trims[i], i == 0, 0.5, 0.5, 0.35, 0.1, 7);
	}
	reparametrise(&two.faces[1], &two.trims[1]);
	for (int i = 0; i < N_FIELDS; i++) {
		scene_trace(&one, &every_field[i], tolerance, 1e-4);
		scene_trace(&two, &every_field[i], tolerance, 1e-4);
		same_chains(&one, &two);
		assert_true(two.chains.joins > 0);
		assert_int_equal(two.chains.creases, 0);
		assert_true(two.chains.step < 4 * tolerance);
		results_finish(&one);
		results_finish(&two);
	}
	scene_finish(&one);
	scene_finish(&two);
	surface_finish(&s);
}

/* A torus in two halves, each trimmed to it: one along the seam, the other over it. */
static void test_seam(void **state)
{
	(void)state;
	static struct scene one, two;
	struct surface s = torus();
	const double(*d)[2] = (const double(*)[2])s.domain;
	const double at[] = { d[0][0] + 0.3 * (d[0][1] - d[0][0]),
		              d[0][0] + 0.7 * (d[0][1] - d[0][0]) };
	one.n = 1;
	two.n = 2;
	assert_int_equal(surface_copy(&one.faces[0], &s), ST_OK);
	for (int i = 0; i < 2; i++)
		assert_int_equal(surface_copy(&two.faces[i], &s), ST_OK);
	trim_add_box(&two.trims[0], true, at[0], d[1][0], at[1], d[1][1]);
	trim_add_box(&two.trims[1], true, d[0][0], d[1][0], at[0], d[1][1]);
	trim_add_box(&two.trims[1], true, at[1], d[1][0], d[0][1], d[1][1]);
	const struct level_field round[] = {
		{ .kind = LEVEL_PLANE, .direction = { 0, 0, 1 }, .value = 0.31 },
		{ .kind = LEVEL_PLANE, .direction = { 0.1, 1, 0.2 }, .value = 0.1 },
		{ .kind = LEVEL_ISOPHOTE, .direction = { 0.3, 0.2, 1 }, .value = 0.5 },
		{ .kind = LEVEL_SILHOUETTE, .direction = { 0.8, 0.36, 0.48 } },
		{ .kind = LEVEL_CURVATURE, .quantity = QUANTITY_GAUSSIAN, .value = 0.05 },
	};
	for (size_t i = 0; i < sizeof round / sizeof *round; i++) {
		scene_trace(&one, &round[i], tolerance, 1e-4);
		scene_trace(&two, &round[i], tolerance, 1e-4);
		same_chains(&one, &two);
		assert_int_equal(two.chains.creases, 0);
		assert_true(two.chains.step < 1e-9);
		results_finish(&one);
		results_finish(&two);
	}
	scene_finish(&one);
	scene_finish(&two);
	surface_finish(&s);
}

int main(void)
{

	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_chords),  cmocka_unit_test(test_arcs),
		cmocka_unit_test(test_lines),   cmocka_unit_test(test_along),
		cmocka_unit_test(test_samples), cmocka_unit_test(test_fitting),
		cmocka_unit_test(test_seam),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
