/* test_desk_view.c - views and tools: the mouse in the view, light, color, control points. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "desk_stand.h"

static void the_mouse_turns_and_words_tell(void **state)
{
	struct stand *s = *state;
	int n;

	assert_string_equal(desk_mouse_words(s->desk).press[2], "");
	stand_add_plate(s, "plate");
	stand_leaf(s, "V99"); /* anything that runs: the view is fitted */
	stand_key(s, KEY_ENTER);
	stand_key(s, KEY_HOME);
	assert_string_equal(desk_mouse_words(s->desk).press[0], "ROTATE VIEW");
	struct camera before = desk_tiles(s->desk, &n)[0].view.camera;
	desk_move(s->desk, 400, 300);
	desk_press(s->desk, BUTTON_LEFT, 0);
	desk_move(s->desk, 460, 330);
	assert_true(desk_moving(s->desk));
	struct camera turned = desk_tiles(s->desk, &n)[0].view.camera;
	assert_true(vec3_dot(before.ahead, turned.ahead) < 0.999);
	stand_key(s, KEY_ESCAPE); /* as before */
	assert_true(vec3_dot(before.ahead, desk_tiles(s->desk, &n)[0].view.camera.ahead) >
	            1 - 1e-12);
	desk_move(s->desk, 400, 300);
	desk_scroll(s->desk, 1);
	assert_true(desk_tiles(s->desk, &n)[0].view.camera.half < before.half);
	desk_key(s->desk, KEY_LEFT, 0);
	assert_true(vec3_dot(before.ahead, desk_tiles(s->desk, &n)[0].view.camera.ahead) < 0.9999);
	world_sight(s->world)->all_curvatures = true;
	world_touch(s->world);
	desk_take_dirty(s->desk);
	desk_tiles(s->desk, &n);
	assert_int_equal(n, 7);
}

static void the_probe_is_kept_as_a_mark(void **state)
{
	struct stand *s = *state;
	int id = stand_add_plate(s, "plate");

	s->pick = (struct pick){ .thing = id, .u = 0.25, .v = 0.5 };
	desk_move(s->desk, 400, 300);
	desk_press(s->desk, BUTTON_RIGHT, 0);
	assert_true(desk_part_box(s->desk, PART_PROBE).width > 0);
	assert_int_equal(world_marks(s->world), 0);
	desk_release(s->desk, BUTTON_RIGHT);
	assert_int_equal(world_marks(s->world), 1);
	assert_true(world_mark(s->world, 0)->u == 0.25);
	stand_key(s, KEY_ESCAPE);
	assert_true(desk_part_box(s->desk, PART_PROBE).width == 0);
}

static void the_light_is_dragged_live_and_taken_back(void **state)
{
	struct stand *s = *state;

	stand_add_plate(s, "plate");
	stand_leaf(s, "V73");
	assert_string_equal(desk_mouse_words(s->desk).press[0], "MOVE LIGHT");
	double azimuth = world_sight(s->world)->light_azimuth;
	stand_paint(s);
	const struct hit *h = stand_hit(s, HIT_LIGHT, 0, -1);
	assert_non_null(h);
	double x = h->x + h->width / 2, y = h->y + h->height / 2, quarter = h->width / 4;
	desk_move(s->desk, x, y - quarter);
	desk_press(s->desk, BUTTON_LEFT, 0);
	assert_true(fabs(world_sight(s->world)->light_azimuth - 90) < 1);
	assert_true(fabs(world_sight(s->world)->light_incidence - 45) < 1.5);
	assert_string_equal(stand_field(s, "Azimuth")->value, "90");
	desk_move(s->desk, x - quarter, y);
	desk_release(s->desk, BUTTON_LEFT);
	assert_true(fabs(world_sight(s->world)->light_azimuth - 180) < 1);
	stand_key(s, KEY_ESCAPE);
	assert_true(world_sight(s->world)->light_azimuth == azimuth);
	stand_leaf(s, "V73");
	desk_move(s->desk, 480, 100); /* in the view, above its middle */
	desk_press(s->desk, BUTTON_LEFT, 0);
	desk_release(s->desk, BUTTON_LEFT);
	stand_key(s, KEY_ENTER);
	assert_true(fabs(world_sight(s->world)->light_azimuth - 90) < 5);
}

static void a_color_is_seen_while_it_is_chosen(void **state)
{
	struct stand *s = *state;

	stand_add_plate(s, "plate");
	stand_leaf(s, "V157");
	stand_paint(s);
	const struct hit *h = stand_hit(s, HIT_COLOR_WHEEL, 0, -1);
	assert_non_null(h);
	desk_move(s->desk, h->x + h->width - 1, h->y + 1); /* full saturation, full value */
	desk_press(s->desk, BUTTON_LEFT, 0);
	desk_release(s->desk, BUTTON_LEFT);
	assert_true(world_sight(s->world)->has_background);
	struct rgb c = world_sight(s->world)->background;
	assert_true(fmax(c.r, fmax(c.g, c.b)) > 0.95);
	assert_true(fmin(c.r, fmin(c.g, c.b)) < 0.05);
	stand_key(s, KEY_ESCAPE);
	assert_false(world_sight(s->world)->has_background);
}

static void a_drag_of_a_point_is_one_step(void **state)
{
	struct stand *s = *state;
	int id = stand_add_plate(s, "plate");

	stand_key(s, KEY_HOME);
	stand_leaf(s, "V127");
	assert_string_equal(desk_mouse_words(s->desk).press[0], "PICK POINT");
	s->pick = (struct pick){ .thing = id, .is_point = true, .index = 5 };
	struct vec3 before =
	        surface_get_point(&world_by_id(s->world, id)->entity.geometry, 1, 1, NULL);
	desk_move(s->desk, 480, 390);
	desk_press(s->desk, BUTTON_LEFT, 0);
	assert_string_equal(desk_menu_model(s->desk)->fields[0].value, "1,1");
	for (int i = 1; i < 20; i++)
		desk_move(s->desk, 480 + 10 * i, 390 - 5 * i);
	struct vec3 meanwhile =
	        surface_get_point(&world_by_id(s->world, id)->entity.geometry, 1, 1, NULL);
	assert_true(vec3_length(vec3_sub(meanwhile, before)) > 0.1);
	desk_release(s->desk, BUTTON_LEFT);
	struct vec3 after =
	        surface_get_point(&world_by_id(s->world, id)->entity.geometry, 1, 1, NULL);
	assert_true(vec3_length(vec3_sub(after, meanwhile)) < 1e-6);
	assert_string_equal(desk_menu_model(s->desk)->form_code, "V127"); /* for the next point */
	stand_key(s, KEY_ESCAPE);
	stand_type(s, "z");
	after = surface_get_point(&world_by_id(s->world, id)->entity.geometry, 1, 1, NULL);
	assert_true(vec3_length(vec3_sub(after, before)) == 0);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, stand_set_up, stand_tear_down)

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(the_mouse_turns_and_words_tell),
		TEST(the_probe_is_kept_as_a_mark),
		TEST(the_light_is_dragged_live_and_taken_back),
		TEST(a_color_is_seen_while_it_is_chosen),
		TEST(a_drag_of_a_point_is_one_step),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
