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
	/* an image is there once, and gives them back */
	const struct overlay image = { .kind = OVERLAY_IMAGE, .file = (char *)"a.shade.exr" };
	for (int away = 0; away < 2; away++) {
		assert_int_equal(world_show(s->world, &image), ST_OK);
		world_sight(s->world)->no_image = away;
		world_touch(s->world);
		desk_take_dirty(s->desk);
		desk_tiles(s->desk, &n);
		assert_int_equal(n, away ? 7 : 1);
	}
}

static void two_views_of_the_same_turn_by_themselves(void **state)
{
	struct stand *s = *state;
	int n;

	stand_add_plate(s, "plate");
	stand_key(s, KEY_HOME);
	stand_type(s, "t");
	const struct desk_tile *t = desk_tiles(s->desk, &n);
	assert_int_equal(n, 2);
	assert_int_equal(world_sight(s->world)->split, SPLIT_SIDE);
	assert_true(t[1].box.y > t[0].box.y); /* below each other */
	assert_true(t[1].view.camera.ahead.z < -0.999);
	struct vec3 first = t[0].view.camera.ahead, second = t[1].view.camera.ahead;
	desk_move(s->desk, 400, t[1].box.y + 100);
	desk_press(s->desk, BUTTON_LEFT, 0);
	desk_move(s->desk, 480, t[1].box.y + 60);
	desk_release(s->desk, BUTTON_LEFT);
	assert_true(vec3_dot(t[0].view.camera.ahead, first) > 1 - 1e-12);
	assert_true(vec3_dot(t[1].view.camera.ahead, second) < 0.999);
	assert_int_equal(desk_tile_focus(s->desk), 1);
	second = t[1].view.camera.ahead;
	stand_type(s, "y");
	stand_type(s, "f");
	assert_true(vec3_dot(t[0].view.camera.ahead, first) > 1 - 1e-12);
	assert_true(vec3_dot(t[1].view.camera.ahead, second) < 0.999);
	assert_true(world_sight(s->world)->has_beside);
	/* the seven take its place, and give it back */
	world_sight(s->world)->all_curvatures = true;
	world_touch(s->world);
	desk_take_dirty(s->desk);
	desk_tiles(s->desk, &n);
	assert_int_equal(n, 7);
	stand_leaf(s, "V188");
	assert_string_equal(stand_field(s, "Views")->value, "side");
	stand_click_with(s, HIT_CHOICE, 0, 0, 0);
	stand_key(s, KEY_ENTER);
	desk_tiles(s->desk, &n);
	assert_int_equal(n, 1);
}

static void a_child_stands_below_its_parent(void **state)
{
	struct stand *s = *state;
	int parent = stand_add_plate(s, "plate"), n;
	double x;

	stand_key(s, KEY_HOME);
	stand_leaf(s, "V188");
	stand_click_with(s, HIT_CHOICE, 0, 2, 0);
	stand_key(s, KEY_ENTER);
	const struct desk_tile *t = desk_tiles(s->desk, &n);
	assert_int_equal(n, 2);
	assert_int_equal(t[0].view.only, parent);
	assert_int_equal(t[1].view.only, -1); /* none is there */
	x = t[0].view.camera.eye.x;
	stand_leaf(s, "V185");
	stand_type(s, "0,0,1");
	stand_click(s, HIT_CHOICE, 3); /* a copy */
	stand_key(s, KEY_ENTER);
	t = desk_tiles(s->desk, &n);
	int child = world_current(s->world, false)->id;
	assert_int_not_equal(child, parent);
	assert_int_equal(t[0].view.only, parent);
	assert_int_equal(t[1].view.only, child);
	desk_move(s->desk, 400, t[1].box.y + 100); /* both turn, to be compared */
	desk_press(s->desk, BUTTON_LEFT, 0);
	desk_move(s->desk, 480, t[1].box.y + 60);
	desk_release(s->desk, BUTTON_LEFT);
	assert_true(t[0].view.camera.eye.x != x);
	assert_true(t[0].view.camera.eye.x == t[1].view.camera.eye.x);
	world_select(s->world, parent, NULL); /* the child is shown of its parent, too */
	desk_take_dirty(s->desk);
	assert_int_equal(desk_tiles(s->desk, &n)[1].view.only, child);
}

static void the_plane_of_parameters_is_a_view(void **state)
{
	struct stand *s = *state;
	int id = stand_add_plate(s, "plate"), n;

	stand_key(s, KEY_HOME);
	stand_type(s, "tt"); /* no child to be shown */
	const struct desk_tile *t = desk_tiles(s->desk, &n);
	assert_int_equal(n, 2);
	assert_true(t[1].is_uv && !t[0].is_uv);
	assert_true(t[1].box.x > t[0].box.x && t[1].box.y == t[0].box.y);
	struct box_px b = panel_uv_square(&t[1].box);
	struct vec3 ahead = t[0].view.camera.ahead;
	/* the middle of the square is that of the domain; above is more v */
	desk_move(s->desk, b.x + b.width / 2, b.y + b.height / 4);
	desk_press(s->desk, BUTTON_RIGHT, 0);
	desk_release(s->desk, BUTTON_RIGHT);
	assert_int_equal(world_marks(s->world), 1);
	assert_int_equal(world_mark(s->world, 0)->thing, id);
	assert_true(fabs(world_mark(s->world, 0)->u - 0.5) < 1e-9);
	double v = world_mark(s->world, 0)->v;
	assert_true(v > 0.7 && v < 0.8);
	/* what is under the mouse stays there while it is zoomed, and moves with it while it is panned */
	for (int i = 0; i < 2; i++) {
		if (i) {
			desk_press(s->desk, BUTTON_LEFT, 0);
			desk_move(s->desk, b.x + b.width / 2 + 50, b.y + b.height / 4 + 30);
			desk_release(s->desk, BUTTON_LEFT);
		} else {
			desk_scroll(s->desk, 3);
		}
		desk_press(s->desk, BUTTON_RIGHT, 0);
		desk_release(s->desk, BUTTON_RIGHT);
		const struct mark *m = world_mark(s->world, world_marks(s->world) - 1);
		assert_true(fabs(m->u - 0.5) < 1e-9 && fabs(m->v - v) < 1e-9);
	}
	assert_true(vec3_dot(desk_tiles(s->desk, &n)[0].view.camera.ahead, ahead) > 1 - 1e-12);
	stand_paint(s);
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
	assert_true(fabs(world_sight(s->world)->light_incidence - 90) < 1.5); /* the horizon */
	assert_string_equal(stand_field(s, "Azimuth")->value, "90");
	desk_move(s->desk, x - quarter, y);
	desk_release(s->desk, BUTTON_LEFT);
	assert_true(fabs(world_sight(s->world)->light_azimuth - 180) < 1);
	desk_move(s->desk, x - 2 * quarter + 1, y);
	desk_press(s->desk, BUTTON_LEFT, 0); /* from below */
	desk_release(s->desk, BUTTON_LEFT);
	assert_true(world_sight(s->world)->light_incidence > 170);
	stand_key(s, KEY_ESCAPE);
	assert_true(world_sight(s->world)->light_azimuth == azimuth);
	stand_leaf(s, "V73");
	desk_move(s->desk, 480, 100); /* in the view, above its middle */
	desk_press(s->desk, BUTTON_LEFT, 0);
	desk_release(s->desk, BUTTON_LEFT);
	stand_key(s, KEY_ENTER);
	assert_true(fabs(world_sight(s->world)->light_azimuth - 90) < 5);
}

/* A surface that is to show values and has none offers to compute them; of an image the heading tells. */
static void what_is_shown_is_told(void **state)
{
	struct stand *s = *state;
	int id = stand_add_plate(s, "plate");
	struct display d = world_by_id(s->world, id)->display;

	stand_key(s, KEY_HOME);
	stand_paint(s);
	assert_null(stand_hit(s, HIT_BUTTON, 0, GROUP_KEY));
	d.look = LOOK_MAP;
	assert_int_equal(world_set_display(s->world, id, &d), ST_OK);
	desk_move(s->desk, 1, 1);
	stand_paint(s);
	assert_non_null(stand_hit(s, HIT_BUTTON, 0, GROUP_KEY));
	s->keep_errands = true;
	stand_click_with(s, HIT_BUTTON, 0, GROUP_KEY,
	                 0); /* V80 shows, and computes what is not there */
	assert_true(desk_world_lent(s->desk) ||
	            desk_foot_model(s->desk)->level ==
	                    REPORT_ERROR); /* no worker beside this test */
	if (s->errand) {
		assert_string_equal(errand_routine(s->errand)->code, "V80");
		desk_key(s->desk, KEY_ESCAPE, 0);
		errand_run(s->errand);
		desk_errand_over(s->desk);
	}
}

static cairo_surface_t *paper(cairo_t **cr)
{
	cairo_surface_t *out = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, 1280, 800);

	*cr = cairo_create(out);
	return out;
}

/* What lies over the view is that heading, and nothing else. */
static bool is_headed(struct stand *s, const char *title, const char *note)
{
	const struct look look = { .theme = THEME_DARK, .scale = 1 };
	cairo_t *cr[2];
	cairo_surface_t *p[2] = { paper(&cr[0]), paper(&cr[1]) };
	int n;

	stand_paint(s);
	desk_paint(s->desk, PART_OVER, cr[0]);
	panel_heading(cr[1], &desk_tiles(s->desk, &n)[0].box, title, note, true, &look);
	for (int k = 0; k < 2; k++) {
		cairo_destroy(cr[k]);
		cairo_surface_flush(p[k]);
	}
	const size_t size = (size_t)cairo_image_surface_get_stride(p[0]) * 800;
	const bool same = !memcmp(cairo_image_surface_get_data(p[0]),
	                          cairo_image_surface_get_data(p[1]), size);
	for (int k = 0; k < 2; k++)
		cairo_surface_destroy(p[k]);
	return same;
}

/* Opened on what the last session left, with no file to be read. */
static void a_session_is_seen_at_once(void **state)
{
	struct stand *s = *state;
	int n;

	stand_add_plate(s, "plate");
	desk_open(s->desk, NULL, 0);
	assert_true(desk_tiles(s->desk, &n)[0].view.camera.half > 0);
}

static void an_image_is_headed_by_its_file(void **state)
{
	struct stand *s = *state;
	struct overlay o = { .kind = OVERLAY_IMAGE, .file = (char *)"/hulls/lid.shade.exr" };

	stand_add_plate(s, "plate");
	stand_key(s, KEY_HOME);
	assert_true(is_headed(s, "plate", ""));
	assert_int_equal(world_show(s->world, &o), ST_OK);
	assert_true(is_headed(s, "Image", "lid.shade.exr; I shows the things again"));
	assert_false(is_headed(s, "plate", ""));
	stand_type(s, "i");
	assert_true(is_headed(s, "plate", ""));
	assert_int_equal(world_overlays(s->world), 1);
	stand_type(s, "i");
	o.job = 5;
	assert_int_equal(world_show(s->world, &o), ST_OK);
	assert_true(is_headed(s, "Image", "arriving from job 5; I shows the things again"));
	world_hide(s->world, OVERLAY_IMAGE, 0);
	assert_true(is_headed(s, "plate", ""));
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

/* A curve of order 3 on the plate, through its middle; its id. */
static int add_curve_on(struct stand *s, int surface)
{
	static const double uv[3][2] = { { 0.1, 0.1 }, { 0.5, 0.9 }, { 0.9, 0.1 } };
	const struct origin from = { .on = surface };
	struct entity e;
	int id = 0;

	entity_init(&e, ENTITY_CURVE_ON_SURFACE);
	assert_int_equal(curve_init(&e.curve, 3, 3), ST_OK);
	for (int i = 0; i < 3; i++)
		curve_set_point(&e.curve, i, vec3(uv[i][0], uv[i][1], 0), 1);
	for (int k = 3; k < 6; k++)
		e.curve.knots[k] = 1;
	e.curve.domain[1] = 1;
	assert_int_equal(world_add_from(s->world, "curve", "keel", &e, &from, &id, NULL), ST_OK);
	desk_resize(s->desk, 1280, 800, 1);
	return id;
}

static struct vec3 point_of(struct stand *s, int id, int i, double *weight)
{
	return curve_get_point(&world_by_id(s->world, id)->entity.curve, i, weight);
}

static void points_of_a_curve_on_a_surface_are_dragged_in_both_views(void **state)
{
	struct stand *s = *state;
	int plate = stand_add_plate(s, "plate"), id = add_curve_on(s, plate), n;

	stand_key(s, KEY_HOME);
	stand_leaf(s, "V188");
	stand_click_with(s, HIT_CHOICE, 0, 3, 0);
	stand_key(s, KEY_ENTER);
	stand_leaf(s, "V117");
	assert_string_equal(desk_menu_model(s->desk)->form_code, "V117");
	struct box_px b = panel_uv_square(&desk_tiles(s->desk, &n)[1].box);
	/* the range seen has a margin of 4 % */
	double side = b.width / 1.08, left = b.x + 0.04 * side, low = b.y + 1.04 * side;
	desk_move(s->desk, left + 0.5 * side, low - 0.9 * side);
	desk_press(s->desk, BUTTON_LEFT, 0);
	assert_string_equal(desk_menu_model(s->desk)->fields[0].value, "1");
	desk_move(s->desk, left + 0.6 * side, low - 0.8 * side);
	desk_move(s->desk, left + 0.75 * side, low - 0.25 * side);
	struct vec3 p = point_of(s, id, 1, NULL);
	assert_true(fabs(p.x - 0.75) < 1e-6 && fabs(p.y - 0.25) < 1e-6);
	stand_key(s, KEY_ESCAPE); /* taken back */
	p = point_of(s, id, 1, NULL);
	assert_true(p.x == 0.5 && p.y == 0.9);
	assert_string_equal(desk_menu_model(s->desk)->form_code, "V117");
	/* beside the domain it stays at the border's last place inside */
	desk_move(s->desk, left + 0.5 * side, low - 0.9 * side);
	desk_press(s->desk, BUTTON_LEFT, 0);
	desk_move(s->desk, left + 0.5 * side, low - 0.95 * side);
	desk_move(s->desk, left + 0.5 * side, b.y - 30);
	desk_release(s->desk, BUTTON_LEFT);
	p = point_of(s, id, 1, NULL);
	assert_true(fabs(p.y - 0.95) < 1e-6);
	assert_int_equal(world_current(s->world, true)->id, id);
	assert_string_equal(world_undo_name(s->world), "move point 1");
	stand_paint(s);
	/* in the other view: where the eye sees the surface */
	s->pick = (struct pick){ .thing = id, .is_point = true, .index = 1 };
	desk_move(s->desk, 200, 300);
	desk_press(s->desk, BUTTON_LEFT, 0);
	s->pick = (struct pick){ .thing = plate, .u = 0.3, .v = 0.2 };
	desk_move(s->desk, 260, 320);
	desk_release(s->desk, BUTTON_LEFT);
	p = point_of(s, id, 1, NULL);
	assert_true(p.x == 0.3 && p.y == 0.2);
	stand_key(s, KEY_ESCAPE);
	stand_type(s, "zz");
	p = point_of(s, id, 1, NULL);
	assert_true(p.x == 0.5 && p.y == 0.9);
}

static void weights_are_dragged_with_shift(void **state)
{
	struct stand *s = *state;
	int plate = stand_add_plate(s, "plate"), id = add_curve_on(s, plate);
	double w;

	stand_key(s, KEY_HOME);
	stand_leaf(s, "V117");
	s->pick = (struct pick){ .thing = id, .is_point = true, .index = 1 };
	desk_move(s->desk, 400, 400);
	desk_press(s->desk, BUTTON_LEFT, MOD_SHIFT);
	desk_move(s->desk, 410, 360);
	desk_move(s->desk, 420, 320); /* 80 px up: twice as heavy */
	point_of(s, id, 1, &w);
	assert_true(fabs(w - 2) < 1e-9);
	assert_true(world_by_id(s->world, id)->entity.curve.rational);
	assert_string_equal(stand_field(s, "To")->value, "");
	stand_type(s, "z"); /* nothing is undone while it is held */
	desk_release(s->desk, BUTTON_LEFT);
	struct vec3 p = point_of(s, id, 1, &w);
	assert_true(fabs(w - 2) < 1e-9 && fabs(p.x - 0.5) < 1e-12);
	stand_key(s, KEY_ESCAPE);
	stand_type(s, "z");
	point_of(s, id, 1, &w);
	assert_true(w == 1);
	stand_leaf(s, "V127"); /* of a surface, and typed */
	stand_type(s, "1,2");
	stand_click(s, HIT_FIELD, 2);
	stand_type(s, "0.5");
	stand_key(s, KEY_ENTER);
	surface_get_point(&world_by_id(s->world, plate)->entity.geometry, 1, 2, &w);
	assert_true(w == 0.5);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, stand_set_up, stand_tear_down)

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(the_mouse_turns_and_words_tell),
		TEST(two_views_of_the_same_turn_by_themselves),
		TEST(a_child_stands_below_its_parent),
		TEST(the_plane_of_parameters_is_a_view),
		TEST(the_probe_is_kept_as_a_mark),
		TEST(the_light_is_dragged_live_and_taken_back),
		TEST(a_session_is_seen_at_once),
		TEST(an_image_is_headed_by_its_file),
		TEST(what_is_shown_is_told),
		TEST(a_color_is_seen_while_it_is_chosen),
		TEST(a_drag_of_a_point_is_one_step),
		TEST(points_of_a_curve_on_a_surface_are_dragged_in_both_views),
		TEST(weights_are_dragged_with_shift),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
