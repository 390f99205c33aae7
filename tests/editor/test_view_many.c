/* test_view_many.c - many small surfaces: drawn at once while dragged, each where it is, in its color. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "view_place.h"

enum { ACROSS = 12 };

static unsigned rest[SIDE * SIDE], moving[SIDE * SIDE];

/* A field of squares, each tilted a little, every third red. */
static struct world *make_field(void)
{
	struct world *w = place_world();
	for (int k = 0; k < ACROSS * ACROSS; k++) {
		const int i = k % ACROSS, j = k / ACROSS;
		struct surface s = { 0 };
		struct trim trim = { 0 };
		assert_int_equal(surface_init(&s, (int[]){ 2, 2 }, (int[]){ 2, 2 }), ST_OK);
		for (int d = 0; d < 2; d++) {
			for (int e = 0; e < 4; e++)
				s.knots[d][e] = e >= 2;
			s.domain[d][1] = 1;
		}
		for (int e = 0; e < 4; e++)
			surface_set_point(
			        &s, e & 1, e >> 1,
			        vec3(i + 0.8 * (e & 1), j + 0.8 * (e >> 1), 0.1 * (e & 1)), 1);
		const int id = place_surface(w, &s, &trim, LOOK_SHADED);
		struct display d = world_by_id(w, id)->display;
		d.lines_u = d.lines_v = 0;
		d.has_color = true;
		d.color = k % 3 ? (struct rgb){ 0.5, 0.6, 0.7 } : (struct rgb){ 0.9, 0.2, 0.2 };
		world_set_display(w, id, &d);
	}
	return w;
}

static int differing(void)
{
	int n = 0;
	for (int i = 0; i < SIDE * SIDE; i++)
		n += color_apart(rest[i], moving[i]) > 60;
	return n;
}

static void a_field_looks_the_same_while_dragged(void **state)
{
	struct world *w = make_field();
	struct view_state s = place_state(w, "35,25");
	(void)state;
	place_draw(w, &s, rest);
	s.moving = true;
	place_draw(w, &s, moving);
	/* lines are left out of what is small, borders have no samples */
	assert_in_range(differing(), 0, SIDE * SIDE / 10);
	assert_in_range(view_triangles(place_view()), 2 * ACROSS * ACROSS, 100000);
	/* one of another color is another picture */
	struct display d = world_at(w, 70)->display;
	d.color = (struct rgb){ 0, 1, 0 };
	world_set_display(w, world_at(w, 70)->id, &d);
	place_draw(w, &s, moving);
	int green = 0;
	for (int i = 0; i < SIDE * SIDE; i++) {
		const int r = moving[i] >> 16 & 255, g = moving[i] >> 8 & 255;
		green += g > r + 60;
	}
	assert_in_range(green, 20, 400);
	world_destroy(w);
}

/* One that is taken away, and one that is turned off, are not seen any more. */
static void what_is_gone_is_not_drawn(void **state)
{
	struct world *w = make_field();
	struct view_state s = place_state(w, "35,25");
	(void)state;
	s.moving = true;
	place_draw(w, &s, moving);
	const int before = view_triangles(place_view());
	struct display d = world_at(w, 5)->display;
	d.on = false;
	world_set_display(w, world_at(w, 5)->id, &d);
	place_draw(w, &s, moving);
	assert_true(view_triangles(place_view()) < before);
	world_destroy(w);
}

static void a_surface_among_many_is_picked(void **state)
{
	struct world *w = make_field();
	struct view_state s = place_state(w, "35,25");
	struct pick pick;
	(void)state;
	for (int k = 0; k < ACROSS * ACROSS; k += 17) {
		const struct Ful *f = world_at(w, k);
		const struct vec3 p = surface_point(&f->entity.geometry, 0.5, 0.5);
		double x, y, depth;
		assert_true(camera_project(&s.camera, p, &x, &y, &depth));
		assert_int_equal(view_pick(place_view(), w, &s, x, y, false, 0, &pick), ST_OK);
		assert_int_equal(pick.thing, f->id);
	}
	world_destroy(w);
}

static int all_tests(void)
{
	static const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_field_looks_the_same_while_dragged),
		cmocka_unit_test(what_is_gone_is_not_drawn),
		cmocka_unit_test(a_surface_among_many_is_picked),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}

int main(void)
{
	return place_tests(all_tests);
}
