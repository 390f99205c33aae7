/* test_level_faces.c - curves over several faces: the same as on the whole surface, however it is cut. */
#include "level_scene.h"

static void test_whole(void **state)
{
	(void)state;
	static struct scene one, many;
	struct surface s;
	const double u[] = { 0, 0.21, 0.5, 0.77, 1 }, v[] = { 0, 0.3, 0.55, 1 };
	assert_int_equal(shape_make(&s, 4, 12, shape_wavy), ST_OK);
	const double all[2] = { 0, 1 };
	scene_cut(&one, &s, all, 1, all, 1, false);
	scene_cut(&many, &s, u, 4, v, 3, true);
	for (int i = 0; i < N_FIELDS; i++) {
		compare(&one, &many, &every_field[i]);
	}
	scene_finish(&one);
	scene_finish(&many);
	surface_finish(&s);
}

/*
 * Curves along shared borders are there once; through corners they are one. The surface is a saddle,
 * z = x y / 10 about (5, 5), cut through the middle.
 */
static void saddle(struct scene *one, struct scene *many, bool change)
{
	static const struct vec3 corner[4] = {
		{ 0, 0, 2.5 }, { 10, 0, -2.5 }, { 0, 10, -2.5 }, { 10, 10, 2.5 }
	};
	const double half[] = { 0, 0.5, 1 }, all[] = { 0, 1 };
	struct surface s;
	assert_int_equal(make_bilinear(&s, corner), ST_OK);
	scene_cut(one, &s, all, 1, all, 1, false);
	scene_cut(many, &s, half, 2, half, 2, change);
	surface_finish(&s);
}

static void test_borders(void **state)
{
	(void)state;
	static struct scene one, many;
	static const struct {
		struct vec3 direction;
		double value, length;
		size_t chains, nodes;
	} cases[] = {
		{ { 1, 0, 0 }, 5, 10, 1, 0 },            /* along two borders */
		{ { 0, 1, 0 }, 5, 10, 1, 0 },            /* the others */
		{ { 0.6, -0.8, 0 }, -1, 13.2139, 1, 0 }, /* through the corner of all four */
		{ { 0.6, 0.8, 0 }, 7, 13.2139, 1, 0 },   /* through it in the others */
		{ { 0, 0, 1 }, 0, 20, 4, 1 },            /* both pairs of borders cross */
	};
	for (int change = 0; change < 2; change++) {
		saddle(&one, &many, change);
		for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
			const struct level_field field = { .kind = LEVEL_PLANE,
				                           .direction = cases[i].direction,
				                           .value = cases[i].value };
			scene_trace(&one, &field, 1e-6, 1e-4);
			scene_trace(&many, &field, 1e-6, 1e-4);
			same_chains(&one, &many);
			assert_int_equal(many.chains.n, cases[i].chains);
			assert_int_equal(many.chains.nodes, cases[i].nodes);
			assert_true(fabs(many.length - cases[i].length) < 1e-3);
			results_finish(&one);
			results_finish(&many);
		}
		scene_finish(&one);
		scene_finish(&many);
	}
}

static const struct level_field round_fields[] = {
	{ .kind = LEVEL_PLANE, .direction = { 0, 0, 1 }, .value = 0.31 },
	{ .kind = LEVEL_PLANE, .direction = { 0, 0, 1 }, .value = 0 },
	{ .kind = LEVEL_PLANE, .direction = { 1, 0, 0 }, .value = 0 },
	{ .kind = LEVEL_PLANE, .direction = { 1, 1, 0 }, .value = 0 },
	{ .kind = LEVEL_PLANE, .direction = { 0.48, 0.6, 0.64 }, .value = 0.2 },
	{ .kind = LEVEL_CYLINDER, .direction = { 0, 0, 1 }, .point = { 0.2, 0.1, 0 }, .value = 1 },
	{ .kind = LEVEL_ISOPHOTE, .direction = { 0, 0, 1 }, .value = 0.3 },
	{ .kind = LEVEL_ISOPHOTE, .direction = { 0.3, 0.2, 1 }, .value = 0.5 },
	{ .kind = LEVEL_SILHOUETTE, .direction = { 0.8, 0.36, 0.48 } },
	{ .kind = LEVEL_SILHOUETTE, .direction = { 0, 1, 0 } },
	{ .kind = LEVEL_EYE, .eye = { 30, 18, 14 } },
	{ .kind = LEVEL_HIGHLIGHT, .direction = { 0.2, 1, 0 }, .point = { 1, 0, 10 } },
	{ .kind = LEVEL_REFLECTION,
	  .direction = { 0, 1, 0.1 },
	  .point = { 1, 0, 20 },
	  .eye = { 30, 18, 14 } },
};

/* A sphere and a torus: through poles, over seams, along borders. */
static void test_round(void **state)
{
	(void)state;
	static struct scene one, many;
	for (int shape = 0; shape < 2; shape++) {
		struct surface s = shape ? torus() : sphere();
		double u[6], v[6];
		for (int i = 0; i < 6; i++) {
			u[i] = s.domain[0][0] +
			       (s.domain[0][1] - s.domain[0][0]) * (i == 3 ? 0.5 : i / 5.0);
			v[i] = s.domain[1][0] + (s.domain[1][1] - s.domain[1][0]) * i / 5.0;
		}
		const double whole[2][2] = { { s.domain[0][0], s.domain[0][1] },
			                     { s.domain[1][0], s.domain[1][1] } };
		scene_cut(&one, &s, whole[0], 1, whole[1], 1, false);
		scene_cut(&many, &s, u, 5, v, 5, true);
		for (size_t i = 0; i < sizeof round_fields / sizeof *round_fields; i++)
			compare(&one, &many, &round_fields[i]);
		scene_finish(&one);
		scene_finish(&many);
		surface_finish(&s);
	}
}

/* Five hundred faces. */
static void test_many(void **state)
{
	(void)state;
	static struct scene one, many;
	struct surface s = wavy();
	const double all[2] = { 0, 1 };
	double u[26], v[21];
	for (int i = 0; i < 26; i++)
		u[i] = i / 25.0;
	for (int i = 0; i < 21; i++)
		v[i] = i / 20.0;
	scene_cut(&one, &s, all, 1, all, 1, false);
	scene_cut(&many, &s, u, 25, v, 20, true);
	const struct level_field zero = { .kind = LEVEL_PLANE, .direction = { 0, 0, 1 } };
	compare(&one, &many, &every_field[0]);
	compare(&one, &many, &every_field[3]);
	/* 25 crossings of four, 20 of three on the border, 4 of two in the corners; all but those two
	 * lie in faces or on their borders */
	compare(&one, &many, &zero);
	scene_finish(&one);
	scene_finish(&many);
	surface_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_whole),
		cmocka_unit_test(test_borders),
		cmocka_unit_test(test_round),
		cmocka_unit_test(test_many),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
