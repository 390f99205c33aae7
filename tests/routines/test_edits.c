/* test_edits.c - edits keep the shape where they say so, and change it where they say so. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "acting.h"
#include "path.h"

enum { SAMPLES = 7 };

static double distance(struct vec3 a, struct vec3 b)
{
	return vec3_length(vec3_sub(a, b));
}

/* Points of a surface over its whole domain. */
static void sample(const struct surface *s, struct vec3 out[SAMPLES * SAMPLES])
{
	for (int k = 0; k < SAMPLES * SAMPLES; k++)
		out[k] = surface_point(s,
		                       s->domain[0][0] + (s->domain[0][1] - s->domain[0][0]) *
		                                                 (k / SAMPLES) / (SAMPLES - 1),
		                       s->domain[1][0] + (s->domain[1][1] - s->domain[1][0]) *
		                                                 (k % SAMPLES) / (SAMPLES - 1));
}

static double largest(const struct vec3 *a, const struct vec3 *b)
{
	double most = 0;

	for (int k = 0; k < SAMPLES * SAMPLES; k++)
		most = fmax(most, distance(a[k], b[k]));
	return most;
}

static const struct surface *ball(struct acting *a)
{
	return &acting_thing(a, "ball")->entity.geometry;
}

static int open_ball(void **state)
{
	acting_setup(state);
	struct acting *a = *state;
	place_spheres(&a->place, "ball.base", 1);
	acting_does(a, "V175 file=ball.base");
	return 0;
}

/* Other descriptions of the same shape. */
static void test_same_shape(void **state)
{
	struct acting *a = *state;
	struct vec3 before[SAMPLES * SAMPLES], after[SAMPLES * SAMPLES];
	static const char *const lines[] = { "V128 along=u order=5", "V128 along=v order=4",
		                             "V129 along=u knots=3,1,2", "V129 along=v knots=0.1" };
	const int order = ball(a)->order[0], n = ball(a)->n[1];

	sample(ball(a), before);
	for (size_t k = 0; k < sizeof lines / sizeof *lines; k++) {
		acting_does(a, lines[k]);
		sample(ball(a), after);
		assert_true(largest(before, after) < 1e-13);
	}
	assert_int_equal(ball(a)->order[0], order + 2);
	assert_true(ball(a)->n[1] > n + 1);
	acting_fails(a, "V128 order=27", ST_PARAMETER, "order is '27'");
	acting_fails(a, "V128 order=5", ST_PARAMETER, "above the present one, 5");
	acting_fails(a, "V129 knots=99", ST_PARAMETER, "outside the domain");
	acting_fails(a, "V129 knots=1,,2", ST_PARAMETER, "numbers by comma");
	for (size_t k = 0; k < sizeof lines / sizeof *lines; k++)
		acting_does(a, "V182");
	assert_int_equal(ball(a)->order[0], order);
	assert_false(world_unsaved(a->place.world));
}

static void test_points(void **state)
{
	struct acting *a = *state;
	double w;

	acting_does(a, "V127 index=2,1 to=5,6,7");
	struct vec3 p = surface_get_point(ball(a), 2, 1, &w);
	assert_true(distance(p, vec3(5, 6, 7)) < 1e-15);
	const double before = w;
	acting_does(a, "V127 index=2,1 weight=3");
	p = surface_get_point(ball(a), 2, 1, &w);
	assert_true(w == 3 && w != before && distance(p, vec3(5, 6, 7)) < 1e-15);
	assert_string_equal(world_undo_name(a->place.world), "move point 2,1");
	acting_fails(a, "V127 index=2 to=0,0,0", ST_PARAMETER, "I,J, 0,0 to");
	acting_fails(a, "V127 index=2,99 to=0,0,0", ST_PARAMETER, "I,J, 0,0 to");
	acting_fails(a, "V127 index=-1,0 to=0,0,0", ST_PARAMETER, "I,J, 0,0 to");
	acting_fails(a, "V127 index=2,1", ST_PARAMETER, "give to=");
	acting_fails(a, "V127 index=2,1 weight=0", ST_PARAMETER, "weight is '0'");
}

/* Two halves are the whole. */
static void test_split(void **state)
{
	struct acting *a = *state;
	struct vec3 before[SAMPLES * SAMPLES];

	sample(ball(a), before);
	struct surface whole;
	assert_int_equal(surface_copy(&whole, ball(a)), ST_OK);
	acting_does(a, "V130 along=u at=2");
	const struct surface *low = ball(a), *high = &acting_thing(a, "ball-2")->entity.geometry;
	assert_true(low->domain[0][1] == 2 && high->domain[0][0] == 2);
	for (int k = 0; k <= 20; k++) {
		const double u =
		        whole.domain[0][0] + (whole.domain[0][1] - whole.domain[0][0]) * k / 20;
		const struct vec3 p = surface_point(u < 2 ? low : high, u, 0.3);
		assert_true(distance(p, surface_point(&whole, u, 0.3)) < 1e-13);
	}
	assert_int_equal(acting_thing(a, "ball-2")->copy_of, acting_thing(a, "ball")->id);
	acting_does(a, "V182");
	assert_int_equal(world_count(a->place.world), 1);
	acting_fails(a, "V130 at=77", ST_PARAMETER, "inside the domain");
	surface_finish(&whole);
}

/* x turned round, u too: so outside is outside. */
static void test_mirror_image(struct acting *a)
{
	const struct surface *s = ball(a), *m = &acting_thing(a, "ball-mirror")->entity.geometry;
	const double *u = s->domain[0];

	for (int k = 0; k <= 10; k++) {
		const double t = u[0] + (u[1] - u[0]) * k / 10, v = 0.5;
		struct vec3 p, pu, pv, q, qu, qv;
		surface_tangents(s, t, v, &p, &pu, &pv);
		surface_tangents(m, u[0] + u[1] - t, v, &q, &qu, &qv);
		const struct vec3 n = vec3_cross(pu, pv), o = vec3_cross(qu, qv);
		assert_true(distance(vec3(-p.x, p.y, p.z), q) < 1e-14);
		assert_true(distance(vec3(-n.x, n.y, n.z), o) < 1e-12);
	}
}

static void test_transforms(void **state)
{
	struct acting *a = *state;
	struct vec3 before[SAMPLES * SAMPLES], after[SAMPLES * SAMPLES];
	static const struct {
		const char *there, *back;
	} cases[] = {
		{ "V185 by=1,2,3", "V185 by=-1,-2,-3" },
		{ "V186 angle=90 axis=1,0,0 point=0,5,0", "V186 angle=-90 axis=1,0,0 point=0,5,0" },
		{ "V186 angle=33.3 axis=1,2,3", "V186 angle=33.3 axis=-1,-2,-3" },
		{ "V187 factor=2", "V187 factor=0.5" },
		{ "V185 from=1,1,1 to=3,1,0", "V185 from=3,1,0 to=1,1,1" },
		{ "V187 unit=cm", "V187 unit=m" },
		{ "V187 factor=2,4,8 about=1,1,1", "V187 factor=0.5,0.25,0.125 about=1,1,1" },
		{ "V184 normal=0,1,0 point=0,4,0 copy=no",
		  "V184 normal=0,1,0 point=0,4,0 copy=no" },
		{ "V184 normal=1,1,0 point=3,0,0 copy=no",
		  "V184 normal=2,2,0 point=0,3,0 copy=no" },
	};

	for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
		sample(ball(a), before);
		acting_does(a, cases[k].there);
		sample(ball(a), after);
		assert_true(largest(before, after) > 0.5);
		acting_does(a, cases[k].back);
		sample(ball(a), after);
		assert_true(largest(before, after) < 1e-13);
	}
	acting_does(a, "V187 unit=in");
	assert_string_equal(acting_thing(a, "ball")->unit, "in");
	acting_does(a, "V182");
	assert_string_equal(acting_thing(a, "ball")->unit, "m");
	acting_does(a, "V184 plane=x");
	test_mirror_image(a);
	acting_fails(a, "V184 plane=x normal=1,0,0", ST_PARAMETER, "plane=x, y or z, or");
	acting_fails(a, "V184 normal=0,0,0", ST_PARAMETER, "must have a length");
	acting_fails(a, "V187 factor=1,0,1", ST_PARAMETER, "above 0");
	acting_fails(a, "V185 by=1,1,1 name=nobody", ST_PARAMETER, "'nobody' is not open");
}

/* Curves through points, between curves; their edits. */
static void test_curves(void **state)
{
	struct acting *a = *state;

	acting_does(a, "V25 points=0,0,0;1,1,0;2,0,0;3,1,1;4,0,0 name=wire parameters=centripetal");
	const struct curve *c = &acting_thing(a, "wire")->entity.curve;
	assert_true(distance(curve_point(c, 0), vec3(0, 0, 0)) < 1e-14);
	assert_true(distance(curve_point(c, 1), vec3(4, 0, 0)) < 1e-14);
	acting_fails(a, "V25 points=0,0,0;1,1,0", ST_INPUT, "points");
	acting_does(a, "V185 by=0,0,5 copy=yes");
	acting_does(a, "V30 curves=wire,wire-2 name=wall");
	acting_fails(a, "V30 curves=wire", ST_PARAMETER, "two names by comma");
	acting_fails(a, "V30 curves=wire,nobody", ST_PARAMETER, "'nobody' is not open");
	const struct surface *s = &acting_thing(a, "wall")->entity.geometry;
	assert_true(distance(surface_point(s, 1, 0.5), vec3(4, 0, 2.5)) < 1e-14);
	acting_does(a, "V160 curve=wire");
	acting_does(a, "V107 order=6");
	acting_does(a, "V108 knots=0.3,0.3");
	acting_does(a, "V109 at=0.5");
	const struct Ful *low = acting_thing(a, "wire"), *high = acting_thing(a, "wire-3");
	assert_true(distance(curve_point(&low->entity.curve, 0.5),
	                     curve_point(&high->entity.curve, 0.5)) < 1e-14);
	acting_does(a, "V106 index=0 to=9,9,9");
	acting_fails(a, "V117 index=0 to=1,1", ST_PARAMETER, "no curve on a surface");
}

/* A curve on a surface goes with it: in u, v it stays, in space it is another one. */
static void test_on_surface(void **state)
{
	struct acting *a = *state;

	place_diagonal(&a->place, "diagonal.base");
	acting_does(a, "V9 name=diagonal.base");
	acting_does(a, "V117 index=1 to=5,0.5");
	const struct curve *c = &acting_thing(a, "diagonal")->entity.curve;
	assert_true(distance(curve_point(c, c->domain[1]), vec3(5, 0.5, 0)) < 1e-15);
	acting_does(a, "V118 knots=0.5");
	acting_does(a, "V119 at=0.25");
	assert_int_equal(acting_thing(a, "diagonal-2")->on, acting_thing(a, "diagonal")->on);
	acting_fails(a, "V185 by=1,1,1 name=diagonal", ST_PARAMETER, "lies on a surface");
	acting_does(a, "V159 surface=diagonal-surface");
	acting_fails(a, "V130 at=2", ST_PARAMETER, "close it first");
}

static void test_files(void **state)
{
	struct acting *a = *state;
	struct world *w = a->place.world;

	acting_does(a, "V127 index=2,1 to=5,6,7");
	acting_fails(a, "V181", ST_PARAMETER, "is not saved");
	acting_fails(a, "V133", ST_PARAMETER, "1 thing is not saved");
	acting_does(a, "V176");
	assert_false(world_unsaved(w));
	acting_does(a, "V177 name=moon");
	acting_fails(a, "V177 name=ball", ST_PARAMETER, "there already");
	acting_fails(a, "V5 name=nothing.base", ST_INPUT, "nothing.base");
	acting_fails(a, "V1 name=ball.base", ST_INPUT, "no entity of that kind");
	acting_does(a, "V5 name=ball.base");
	acting_does(a, "V178 entities=moon,ball to=both.igs");
	acting_does(a, "V6 file=both.igs entity=2");
	acting_does(a, "V178 to=all.stl");
	acting_fails(a, "V178 to=all.xyz", ST_PARAMETER, "extension");
	acting_fails(a, "V178 to=all.csv", ST_PARAMETER, "holds points");
	acting_fails(a, "V179 to=picture.png", ST_RESOURCE, "no view");
	acting_does(a, "V181 name=moon");
	assert_null(world_find(w, "moon", NULL));
	acting_does(a, "V182");
	acting_thing(a, "moon");
	acting_does(a, "V183");
	acting_does(a, "V133");
	assert_true(a->act.quit);
}

/* QUIT with unsaved=save saves all, with discard nothing. */
static void test_quit(void **state)
{
	struct acting *a = *state;
	char *path = place_path(&a->place, "wire.base");

	acting_does(a, "V25 points=0,0,0;1,1,0;2,0,0;3,1,1 name=wire");
	acting_does(a, "V133 unsaved=save");
	assert_true(path_exists(path));
	acting_does(a, "V106 index=0 to=1,2,3");
	acting_does(a, "V25 points=0,0,0;1,1,0;2,0,0;3,1,1 name=other");
	acting_does(a, "V133 unsaved=discard");
	assert_null(world_find(a->place.world, "other", NULL));
	assert_false(world_unsaved(a->place.world));
	free(path);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_same_shape, open_ball, acting_teardown),
		cmocka_unit_test_setup_teardown(test_points, open_ball, acting_teardown),
		cmocka_unit_test_setup_teardown(test_split, open_ball, acting_teardown),
		cmocka_unit_test_setup_teardown(test_transforms, open_ball, acting_teardown),
		cmocka_unit_test_setup_teardown(test_curves, open_ball, acting_teardown),
		cmocka_unit_test_setup_teardown(test_on_surface, open_ball, acting_teardown),
		cmocka_unit_test_setup_teardown(test_files, open_ball, acting_teardown),
		cmocka_unit_test_setup_teardown(test_quit, open_ball, acting_teardown),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
