/* test_desk_ask.c - what a leaf asks for: forms, completion, picking, undo. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "desk_stand.h"
#include "path.h"

static void a_form_takes_utf8_and_runs(void **state)
{
	struct stand *s = *state;
	int id = stand_add_plate(s, "plate");
	char *journal = path_join(s->project.hidden, "journal");

	stand_leaf(s, "V180");
	assert_true(stand_field(s, "Name")->focused);
	desk_key(s->desk, KEY_CTRL_A + 'U' - 'A', MOD_CTRL);
	desk_text(s->desk, 'R');
	desk_text(s->desk, 0xFC);
	desk_text(s->desk, 'd');
	desk_text(s->desk, 'e');
	desk_text(s->desk, 'r');
	desk_text(s->desk, 'w'); /* no World menu while it is typed */
	assert_string_equal(stand_field(s, "Name")->value, "R\u00FCderw");
	assert_string_equal(desk_foot_model(s->desk)->typed, "R\u00FCderw");
	assert_int_equal(desk_foot_model(s->desk)->caret, 7);
	stand_key(s, KEY_BACKSPACE);
	stand_key(s, KEY_ENTER);
	assert_string_equal(world_by_id(s->world, id)->name, "R\u00FCder");
	assert_null(desk_menu_model(s->desk)->form_code);
	assert_true(path_exists(journal));
	free(journal);
}

static void a_bad_field_keeps_its_text_and_says_why(void **state)
{
	struct stand *s = *state;

	stand_add_plate(s, "plate");
	stand_leaf(s, "V57");
	stand_click(s, HIT_FIELD, 1);
	desk_key(s->desk, KEY_CTRL_A + 'U' - 'A', MOD_CTRL);
	stand_type(s, "many");
	stand_key(s, KEY_ENTER);
	assert_string_equal(desk_menu_model(s->desk)->form_code, "V57");
	const struct form_field *f = &desk_menu_model(s->desk)->fields[1];
	assert_string_equal(f->value, "many");
	assert_true(f->focused);
	assert_true(f->error && *f->error);
	assert_int_equal(desk_foot_model(s->desk)->level, REPORT_ERROR);
	desk_key(s->desk, KEY_CTRL_A + 'R' - 'A', MOD_CTRL); /* the defaults */
	assert_null(desk_menu_model(s->desk)->fields[1].error);
	stand_key(s, KEY_UP); /* a step of a whole number */
	stand_key(s, KEY_ENTER);
	assert_null(desk_menu_model(s->desk)->form_code);
	assert_int_equal(world_current(s->world, false)->display.lines_v, 8);
}

/* Where the caret goes: the first character that is wrong. */
static void the_caret_goes_to_the_first_wrong_character(void **state)
{
	static const struct {
		const char *code, *typed;
		int field, caret;
	} cases[] = {
		{ "V57", "12x", 0, 2 },    { "V73", "0.5m", 0, 3 },     { "V58", "#12G456", 0, 3 },
		{ "V185", "1,2,x", 0, 4 }, { "V173", "640x48O", 0, 6 },
	};
	struct stand *s = *state;

	stand_add_plate(s, "plate");
	for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
		stand_leaf(s, cases[k].code);
		desk_key(s->desk, KEY_CTRL_A + 'U' - 'A', MOD_CTRL);
		stand_type(s, cases[k].typed);
		stand_key(s, KEY_ENTER);
		if (!desk_menu_model(s->desk)->form_code)
			fail_msg("%s took '%s'", cases[k].code, cases[k].typed);
		const struct form_field *f = &desk_menu_model(s->desk)->fields[cases[k].field];
		assert_true(f->error && f->focused);
		assert_string_equal(f->value, cases[k].typed);
		assert_int_equal(f->caret, cases[k].caret);
		stand_key(s, KEY_ESCAPE);
	}
}

static void names_are_completed_and_values_come_back(void **state)
{
	struct stand *s = *state;

	stand_add_plate(s, "bow");
	stand_add_plate(s, "stern");
	stand_leaf(s, "V159");
	desk_key(s->desk, KEY_CTRL_A + 'U' - 'A', MOD_CTRL);
	stand_type(s, "b");
	const struct foot_model *m = desk_foot_model(s->desk);
	assert_int_equal(m->n_candidates, 1);
	assert_string_equal(m->candidates[0], "bow");
	assert_string_equal(m->rest, "ow");
	stand_key(s, KEY_TAB);
	assert_string_equal(desk_foot_model(s->desk)->typed, "bow");
	stand_key(s, KEY_ENTER);
	assert_string_equal(world_current(s->world, false)->name, "bow");
	stand_leaf(s, "V159");
	desk_key(s->desk, KEY_CTRL_A + 'U' - 'A', MOD_CTRL);
	stand_paint(s);
	stand_click(s, HIT_CANDIDATE, 1);
	assert_string_equal(desk_foot_model(s->desk)->typed, "stern");
	stand_key(s, KEY_ENTER);
	assert_string_equal(world_current(s->world, false)->name, "stern");
	stand_leaf(s, "V159");
	desk_key(s->desk, KEY_CTRL_A + 'P' - 'A', MOD_CTRL);
	desk_key(s->desk, KEY_CTRL_A + 'P' - 'A', MOD_CTRL);
	assert_string_equal(desk_foot_model(s->desk)->typed, "bow");
}

static void a_surface_asked_for_can_be_picked(void **state)
{
	struct stand *s = *state;
	int id = stand_add_plate(s, "bow");

	stand_add_plate(s, "stern");
	stand_leaf(s, "V159");
	assert_string_equal(desk_mouse_words(s->desk).press[0], "PICK SURFACE");
	s->pick = (struct pick){ .thing = id };
	desk_move(s->desk, 400, 300);
	desk_press(s->desk, BUTTON_LEFT, 0);
	desk_release(s->desk, BUTTON_LEFT);
	assert_string_equal(desk_foot_model(s->desk)->typed, "bow");
}

static void edits_are_undone_by_key(void **state)
{
	struct stand *s = *state;
	int id = stand_add_plate(s, "plate");
	double x = surface_get_point(&world_by_id(s->world, id)->entity.geometry, 0, 0, NULL).x;

	stand_leaf(s, "V185");
	stand_type(s, "1,0,0");
	stand_key(s, KEY_ENTER);
	struct vec3 p = surface_get_point(&world_by_id(s->world, id)->entity.geometry, 0, 0, NULL);
	assert_true(fabs(p.x - x - 1) < 1e-12);
	stand_type(s, "z");
	p = surface_get_point(&world_by_id(s->world, id)->entity.geometry, 0, 0, NULL);
	assert_true(p.x == x);
	stand_type(s, "Z");
	p = surface_get_point(&world_by_id(s->world, id)->entity.geometry, 0, 0, NULL);
	assert_true(fabs(p.x - x - 1) < 1e-12);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, stand_set_up, stand_tear_down)

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(a_form_takes_utf8_and_runs),
		TEST(a_bad_field_keeps_its_text_and_says_why),
		TEST(the_caret_goes_to_the_first_wrong_character),
		TEST(names_are_completed_and_values_come_back),
		TEST(a_surface_asked_for_can_be_picked),
		TEST(edits_are_undone_by_key),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
