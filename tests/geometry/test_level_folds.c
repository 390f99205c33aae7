/* test_level_folds.c - faces that meet in creases, fit badly, are turned about or trimmed. */
#include "level_scene.h"
#include "trim_shapes.h"

static struct surface plate(struct vec3 a, struct vec3 b, struct vec3 c, struct vec3 d)
{
	const struct vec3 corner[4] = { a, b, c, d };
	struct surface s;
	assert_int_equal(make_bilinear(&s, corner), ST_OK);
	return s;
}

/*
 * Two bent plates that meet in a line y = 0 at an angle: z = -|y| k - x^2 / 10 over x in [-2, 2].
 * The plane x = c goes over the fold; isophotes end there on both sides.
 */
static struct surface wing(double side, double slope)
{
	struct surface s;
	assert_int_equal(surface_init(&s, (int[2]){ 3, 2 }, (int[2]){ 3, 2 }), ST_OK);
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 2; j++) {
			const double x = 2.0 * (i - 1), y = side > 0 ? 2 * j : 2 * (j - 1);
			surface_set_point(&s, i, j,
			                  vec3(x, y, (i == 1 ? 0.4 : -0.4) - slope * fabs(y)), 1);
		}
	for (int d = 0; d < 2; d++) {
		for (int i = s.order[d]; i < 2 * s.order[d]; i++)
			s.knots[d][i] = 1;
		s.domain[d][1] = 1;
	}
	return s;
}

static void test_crease(void **state)
{
	(void)state;
	static struct scene x;
	const struct level_field plane = { .kind = LEVEL_PLANE,
		                           .direction = { 1, 0, 0 },
		                           .value = 0.3 };
	const struct level_field tilted = { .kind = LEVEL_ISOPHOTE,
		                            .direction = { 1, 0.3, 1 },
		                            .value = 0.7 };
	/* the same on both sides: ends meet, and yet the normal turns between them */
	const struct level_field even = { .kind = LEVEL_ISOPHOTE,
		                          .direction = { 1, 0, 1 },
		                          .value = 0.7 };
	const double slopes[] = { 0.3, 0.01, 0.0006, 0.0004, 1e-5, 0 };
	for (size_t i = 0; i < sizeof slopes / sizeof *slopes; i++) {
		const bool smooth = 2 * slopes[i] < 1e-3;
		x.faces[0] = wing(-1, slopes[i]);
		x.faces[1] = wing(1, slopes[i]);
		x.n = 2;
		scene_trace(&x, &plane, 1e-6, 1e-4);
		assert_int_equal(x.chains.n, 1);
		assert_int_equal(x.chains.creases, 0);
		results_finish(&x);
		for (int k = 0; k < 2; k++) {
			scene_trace(&x, k ? &even : &tilted, 1e-6, 1e-4);
			assert_int_equal(x.chains.n, smooth ? 1 : 2);
			assert_int_equal(x.chains.creases, smooth ? 0 : 2);
			assert_true(x.chains.step < 1e-2);
			results_finish(&x);
		}
		scene_finish(&x);
	}
}

/* Faces turned about: only curves that the normal's sign matters to end. */
static void test_turned(void **state)
{
	(void)state;
	static struct scene one, many;
	static const struct {
		struct level_field field;
		bool ends;
	} cases[] = {
		{ { .kind = LEVEL_PLANE, .direction = { 0, 1, 0.2 }, .value = 4.1 }, false },
		{ { .kind = LEVEL_ISOPHOTE, .direction = { 0.1, 0.2, 1 }, .value = 0.8 }, true },
		{ { .kind = LEVEL_ISOPHOTE, .direction = { 1, 0.2, 0.1 }, .value = 0 }, false },
		{ { .kind = LEVEL_SILHOUETTE, .direction = { 0.8, 0.36, 0.48 } }, false },
		{ { .kind = LEVEL_EYE, .eye = { 30, 18, 14 } }, false },
		{ { .kind = LEVEL_HIGHLIGHT, .direction = { 0.2, 1, 0 }, .point = { 4, 0, 10 } },
		  false },
		{ { .kind = LEVEL_HIGHLIGHT,
		    .direction = { 0.2, 1, 0 },
		    .point = { 4, 0, 10 },
		    .value = 0.2 },
		  true },
		{ { .kind = LEVEL_REFLECTION,
		    .direction = { 0, 1, 0.1 },
		    .point = { 4, 0, 20 },
		    .eye = { 30, 18, 14 } },
		  false },
		{ { .kind = LEVEL_CURVATURE, .quantity = QUANTITY_MEAN, .value = 0.1 }, true },
		{ { .kind = LEVEL_CURVATURE, .quantity = QUANTITY_GAUSSIAN, .value = 0.1 }, false },
	};
	struct surface s;
	size_t joins = 0;
	const double u[] = { 0, 0.37, 1 }, all[2] = { 0, 1 };
	assert_int_equal(shape_make(&s, 4, 12, shape_wavy), ST_OK);
	scene_cut(&one, &s, all, 1, all, 1, false);
	scene_cut(&many, &s, u, 2, all, 1, false);
	surface_reverse(&many.faces[1], 1);
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		scene_trace(&one, &cases[i].field, 1e-5, 1e-4);
		scene_trace(&many, &cases[i].field, 1e-5, 1e-4);
		if (cases[i].ends) {
			assert_true(many.chains.creases > 0);
			assert_int_equal(many.chains.joins, 0);
		} else {
			same_chains(&one, &many);
			joins += many.chains.joins;
			assert_int_equal(many.chains.creases, 0);
		}
		results_finish(&one);
		results_finish(&many);
	}
	assert_true(joins > 15);
	scene_finish(&one);
	scene_finish(&many);
	surface_finish(&s);
}

/* Control points of faces off by less than the gap: as many curves, with a step between. */
static void test_noise(void **state)
{
	(void)state;
	static struct scene one, many;
	static const struct level_field fields[] = {
		{ .kind = LEVEL_PLANE, .direction = { 0, 0, 1 }, .value = 0.31 },
		{ .kind = LEVEL_PLANE, .direction = { 0.48, 0.6, 0.64 }, .value = 5.1 },
		{ .kind = LEVEL_ISOPHOTE, .direction = { 0.1, 0.2, 1 }, .value = 0.8 },
		{ .kind = LEVEL_SILHOUETTE, .direction = { 0.8, 0.36, 0.48 } },
		{ .kind = LEVEL_HIGHLIGHT, .direction = { 0.2, 1, 0 }, .point = { 4, 0, 10 } },
	};
	struct surface s;
	const double u[] = { 0, 0.21, 0.5, 0.77, 1 }, v[] = { 0, 0.3, 0.55, 1 }, all[2] = { 0, 1 };
	uint64_t seed = 5;
	assert_int_equal(shape_make(&s, 4, 12, shape_wavy), ST_OK);
	scene_cut(&one, &s, all, 1, all, 1, false);
	scene_cut(&many, &s, u, 4, v, 3, true);
	for (int i = 0; i < many.n; i++)
		for (int k = 0; k < many.faces[i].n[0] * many.faces[i].n[1] * 4; k++)
			if (k % 4 != 3)
				many.faces[i].points[k] += 2e-5 * (any_number(&seed) - 0.5);
	for (size_t i = 0; i < sizeof fields / sizeof *fields; i++) {
		scene_trace(&one, &fields[i], 1e-5, 1e-4);
		scene_trace(&many, &fields[i], 1e-5, 1e-4);
		same_chains(&one, &many);
		assert_int_equal(many.chains.creases, 0);
		assert_true(many.chains.step > 1e-7 && many.chains.step < 1e-2);
		results_finish(&one);
		results_finish(&many);
	}
	scene_finish(&one);
	scene_finish(&many);
	surface_finish(&s);
}

/* A side shared with two others, and a curve along it: once. */
static void test_tee(void **state)
{
	(void)state;
	static struct scene x;
	const struct level_field along = { .kind = LEVEL_PLANE, .direction = { 0, 1, 0 } };
	const struct level_field across = { .kind = LEVEL_PLANE,
		                            .direction = { 1, 0.1, 0 },
		                            .value = 2 };
	for (int turn = 0; turn < 3; turn++) {
		const int a = turn, b = (turn + 1) % 3, c = (turn + 2) % 3;
		x.n = 3;
		x.faces[a] = plate(vec3(0, 0, 0), vec3(4, 0, 0), vec3(0, 2, 1), vec3(4, 2, 1));
		x.faces[b] = plate(vec3(-1, -2, 1), vec3(2, -2, 1), vec3(-1, 0, 0), vec3(2, 0, 0));
		x.faces[c] = plate(vec3(5, 0, 0), vec3(2, 0, 0), vec3(5, -2, 1), vec3(2, -2, 1));
		scene_trace(&x, &along, 1e-6, 1e-4);
		assert_int_equal(x.chains.n, 1);
		assert_true(fabs(x.length - 6) < 1e-9);
		results_finish(&x);
		scene_trace(&x, &across, 1e-6, 1e-4);
		assert_int_equal(x.chains.n, 1);
		assert_true(fabs(x.length - 2 * 2.24499) < 1e-4);
		for (int i = 0; i < 3; i++)
			assert_int_equal(x.results[i].n_branches, i != b);
		results_finish(&x);
		scene_finish(&x);
	}
}

/* A plateau over four faces: four regions, no curve. */
static void test_plateau(void **state)
{
	(void)state;
	static struct scene x;
	const double half[] = { 0, 0.5, 1 };
	const struct level_field level = { .kind = LEVEL_PLANE,
		                           .direction = { 0, 0, 1 },
		                           .value = 1 };
	const struct level_field angle = { .kind = LEVEL_ISOPHOTE,
		                           .direction = { 0, 0, 1 },
		                           .value = 1 };
	struct surface s = flat();
	scene_cut(&x, &s, half, 2, half, 2, true);
	for (int k = 0; k < 2; k++) {
		scene_trace(&x, k ? &angle : &level, 1e-6, 1e-4);
		size_t regions = 0;
		for (int i = 0; i < x.n; i++)
			for (size_t b = 0; b < x.results[i].n_undecided; b++)
				regions += x.results[i].undecided[b].kind == LEVEL_REGION;
		assert_int_equal(x.chains.n, 0);
		assert_int_equal(regions, 4);
		results_finish(&x);
	}
	scene_finish(&x);
	surface_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_crease),  cmocka_unit_test(test_turned),
		cmocka_unit_test(test_noise),   cmocka_unit_test(test_tee),
		cmocka_unit_test(test_plateau),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
