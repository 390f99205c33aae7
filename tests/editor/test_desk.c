/* test_desk.c - walking the desk: menus, search, help, keys, leaving. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "desk_stand.h"
#include "file.h"
#include "path.h"

/* ------------------------------------------------------------ menus */

static void the_menus_are_walked_by_mouse_and_by_keys(void **state)
{
	struct stand *s = *state;
	char top[48];

	stand_paint(s);
	snprintf(top, sizeof top, "%s", stand_title(s));
	static const char *const way[] = { "GEOMETRY INTERROGATION", "SURFACE", "CURVATURE" };
	for (int by_key = 0; by_key < 2; by_key++) {
		for (int i = 0; i < 3; i++) {
			assert_true(stand_row(s, way[i])->is_menu);
			if (by_key)
				desk_text(s->desk, (unsigned char)stand_row(s, way[i])->key);
			else
				stand_click(s, HIT_MENU_ROW, stand_row_of(s, way[i]));
			stand_paint(s);
		}
		assert_string_equal(stand_row(s, "GAUSSIAN")->name, "GAUSSIAN");
		assert_non_null(strstr(desk_menu_model(s->desk)->crumbs, "›"));
		if (by_key)
			for (int i = 0; i < 3; i++)
				stand_key(s, KEY_ESCAPE);
		else
			stand_click(s, HIT_CRUMB, 0);
		assert_string_equal(stand_title(s), top);
	}
	stand_key(s, KEY_ESCAPE); /* at the top nothing is left */
	assert_string_equal(stand_title(s), top);
	assert_false(s->closed);
	stand_key(s, KEY_TAB);
	stand_key(s, KEY_ENTER);
	assert_string_not_equal(stand_title(s), top);
}

static void the_world_menu_is_a_key_away_and_back(void **state)
{
	struct stand *s = *state;
	char before[48];

	stand_type(s, "1");
	snprintf(before, sizeof before, "%s", stand_title(s));
	stand_type(s, "w");
	assert_true(desk_menu_model(s->desk)->world_open);
	stand_row_of(s, "STATUS ROUTINES");
	stand_type(s, "W");
	assert_string_equal(stand_title(s), before);
	stand_click(s, HIT_WORLD, 0);
	assert_true(desk_menu_model(s->desk)->world_open);
	stand_key(s, KEY_ESCAPE);
	assert_string_equal(stand_title(s), before);
}

/* Whatever is chosen asks, runs, opens something, or says in words why it does not. */
static void every_leaf_does_something_or_says_why(void **state)
{
	struct stand *s = *state;
	int asked = 0, told = 0;

	stand_add_plate(s, "plate");
	for (const struct routine *t = routine_table; t->code; t++) {
		const struct Menu_Entry *e = menu_set_find(&s->menus, t->code, NULL);
		assert_non_null(e);
		const char *greyed = routine_greyed(t, s->world);
		char *why = greyed ? strdup(greyed) : NULL, before[48];
		desk_say(s->desk, REPORT_INFO, "nothing was said");
		stand_leaf(s, t->code);
		snprintf(before, sizeof before, "%s", stand_title(s));
		const struct menu_model *m = desk_menu_model(s->desk);
		bool said = strcmp(stand_message(s), "nothing was said") != 0;
		bool page = desk_jobs_model(s->desk) || desk_list_model(s->desk);
		bool menu = m->n_rows && !strstr(m->crumbs, "›");
		/* of a file of its own: its leaves can be looked at, greyed as they are */
		menu |= !strcmp(m->code, !strcmp(t->code, "V34") ? "N53" : "N54") &&
		        (!strcmp(t->code, "V34") || !strcmp(t->code, "V114"));
		bool form = m->form_code && !strcmp(m->form_code, t->code);
		if (!(said || page || menu || form || s->closed))
			fail_msg("%s %s did nothing", t->code, e->name);
		if (why && !page && !menu && !s->closed && !strstr(stand_message(s), why))
			fail_msg("%s %s is greyed for '%s' and said '%s'", t->code, e->name, why,
			         stand_message(s));
		asked += form;
		told += said;
		free(why);
		s->closed = false;
		for (int i = 0; i < 6; i++)
			stand_key(s, KEY_ESCAPE);
		assert_null(desk_menu_model(s->desk)->form_code);
	}
	assert_true(asked > 40);
	assert_true(told > 60);
}

/* No name of a row is cut, whatever stands beside it. */
static int uncut(struct stand *s)
{
	const struct menu_model *m = desk_menu_model(s->desk);

	for (int i = 0; i < N_DESK_PARTS; i++) {
		const struct hits *h = desk_hits(s->desk, (enum desk_part)i);
		for (int k = 0; k < h->n; k++)
			for (int row = 0; row < m->n_rows && h->hit[k].kind == HIT_TIP; row++)
				if (!strcmp(h->hit[k].tip, m->rows[row].name))
					fail_msg("%s of %s is cut beside '%s'", m->rows[row].name,
					         m->title, m->rows[row].state);
	}
	return m->n_rows;
}

/* All levels below the one that is shown; how many rows. */
static int walk_uncut(struct stand *s)
{
	int n = uncut(s);

	for (int i = 0; i < desk_menu_model(s->desk)->n_rows; i++) {
		if (!desk_menu_model(s->desk)->rows[i].is_menu)
			continue;
		stand_click(s, HIT_MENU_ROW, i);
		n += walk_uncut(s);
		stand_key(s, KEY_ESCAPE);
	}
	return n;
}

static void every_name_fits_the_smallest_window(void **state)
{
	struct stand *s = *state;

	for (int open = 0; open < 2; open++) {
		if (open)
			stand_add_plate(s, "plate");
		desk_resize(s->desk, 1024, 700, 1);
		stand_paint(s);
		assert_true(walk_uncut(s) > 180);
		stand_type(s, "w");
		assert_true(walk_uncut(s) > 10);
		stand_key(s, KEY_ESCAPE);
	}
}

static void greyed_rows_say_why(void **state)
{
	struct stand *s = *state;

	stand_leaf(s, "V80");
	assert_non_null(strstr(stand_message(s), routine_greyed(routine_find("V80"), s->world)));
	const struct menu_model *m = desk_menu_model(s->desk);
	for (int i = 0; i < m->n_rows; i++)
		if (m->rows[i].greyed)
			assert_true(*m->rows[i].state);
	assert_true(stand_row(s, "GAUSSIAN")->greyed);
	stand_add_plate(s, "plate");
	assert_false(stand_row(s, "GAUSSIAN")->greyed);
}

/* ------------------------------------------------------------ search, help, keys */

static void routines_are_found_by_name_code_and_help(void **state)
{
	struct stand *s = *state;
	bool found = false;

	stand_type(s, "/isophote");
	const struct search_model *m = desk_search_model(s->desk);
	for (int i = 0; i < m->n; i++)
		found |= !strcmp(m->results[i].code, "V90");
	assert_true(found);
	assert_true(m->all > 180);
	stand_key(s, KEY_DOWN);
	assert_int_equal(desk_search_model(s->desk)->chosen, 1);
	stand_key(s, KEY_TAB); /* to its menu, not running it */
	assert_null(desk_search_model(s->desk));
	assert_null(desk_menu_model(s->desk)->form_code);
	desk_key(s->desk, KEY_CTRL_A + 'K' - 'A', MOD_CTRL);
	stand_type(s, "zzzzqq");
	assert_int_equal(desk_search_model(s->desk)->found, 0);
	stand_key(s, KEY_ENTER);
	stand_key(s, KEY_ESCAPE);
	assert_null(desk_search_model(s->desk));
}

static void where_nothing_is_found_the_nearest_two_are_offered(void **state)
{
	struct stand *s = *state;
	const struct search_model *m;

	stand_type(s, "/");
	assert_int_equal(desk_search_model(s->desk)->n, 0);
	stand_type(s, "gausian");
	m = desk_search_model(s->desk);
	assert_int_equal(m->found, 0);
	assert_int_equal(m->n, 2);
	assert_int_equal(m->chosen, -1);
	assert_string_equal(m->results[0].name, "GAUSSIAN");
	assert_non_null(stand_hit(s, HIT_RESULT, 1, -1));
	assert_null(stand_hit(s, HIT_RESULT, 2, -1));
	stand_key(s, KEY_ENTER); /* a guess is taken only where it was chosen */
	assert_non_null(desk_search_model(s->desk));
	stand_key(s, KEY_UP);
	assert_int_equal(desk_search_model(s->desk)->chosen, 1);
	stand_key(s, KEY_DOWN);
	assert_int_equal(desk_search_model(s->desk)->chosen, 0);
	stand_key(s, KEY_TAB);
	assert_null(desk_search_model(s->desk));
	stand_row_of(s, "GAUSSIAN");
	stand_type(s, "/gausian");
	for (int i = 0; i < 4; i++)
		stand_key(s, KEY_BACKSPACE);
	m = desk_search_model(s->desk);
	assert_true(m->found > 0);
	assert_int_equal(m->chosen, 0);
}

static void help_is_of_what_is_under_the_mouse(void **state)
{
	struct stand *s = *state;

	stand_leaf(s, "V162");
	stand_key(s, KEY_ESCAPE);
	stand_paint(s);
	const struct hit *h = stand_hit(s, HIT_MENU_ROW, stand_row_of(s, "KILL JOBS"), -1);
	assert_non_null(h);
	desk_move(s->desk, h->x + 5, h->y + 5);
	stand_key(s, KEY_F1);
	assert_string_equal(desk_help_model(s->desk)->code, "V165");
	assert_true(strlen(desk_help_model(s->desk)->text) > 100);
	stand_key(s, KEY_F1);
	assert_null(desk_help_model(s->desk));
	stand_type(s, "?");
	assert_true(desk_keys_model(s->desk)->n > 15);
	stand_key(s, KEY_ESCAPE);
	desk_say(s->desk, REPORT_INFO, "first");
	desk_say(s->desk, REPORT_INFO, "second");
	stand_key(s, KEY_F4);
	assert_string_equal(desk_list_model(s->desk)->lines[0], "second");
	for (int i = 0; i < 300; i++)
		desk_say(s->desk, REPORT_INFO, "line %d", i);
	assert_int_equal(desk_list_model(s->desk)->n, 200);
}

static void links_of_help_are_followed_by_keys_and_mouse(void **state)
{
	struct stand *s = *state;

	stand_type(s, "1");
	stand_key(s, KEY_TAB);
	stand_key(s, KEY_F1);
	assert_string_equal(desk_help_model(s->desk)->code, "V175");
	stand_key(s, KEY_ENTER); /* no link has the focus */
	assert_string_equal(desk_help_model(s->desk)->code, "V175");
	stand_key(s, KEY_TAB);
	stand_key(s, KEY_ENTER);
	char first[8];
	snprintf(first, sizeof first, "%s", desk_help_model(s->desk)->code);
	assert_string_not_equal(first, "V175");
	stand_key(s, KEY_ESCAPE);
	stand_key(s, KEY_F1);
	stand_key(s, KEY_TAB); /* they stand below: now they are seen */
	assert_non_null(stand_hit(s, HIT_HELP_LINK, 0, -1));
	stand_click(s, HIT_HELP_LINK, 0);
	assert_string_equal(desk_help_model(s->desk)->code, first);
}

static void the_sheet_of_keys_scrolls_where_it_is_cut(void **state)
{
	struct stand *s = *state;

	desk_resize(s->desk, 640, 400, 1);
	stand_type(s, "?");
	const struct keys_model *m = desk_keys_model(s->desk);
	const struct box_px b = desk_part_box(s->desk, PART_PAGE);
	int room = panel_keys_rows(&b, m);
	assert_true(room < m->n);
	for (int k = 0; k < 100; k++)
		stand_key(s, KEY_DOWN);
	assert_int_equal(desk_keys_model(s->desk)->scroll, m->n - room);
	desk_move(s->desk, 100, 200);
	desk_scroll(s->desk, 50);
	assert_int_equal(desk_keys_model(s->desk)->scroll, 0);
	desk_resize(s->desk, 1280, 800, 1); /* all of it has room */
	stand_key(s, KEY_PAGE_DOWN);
	assert_int_equal(desk_keys_model(s->desk)->scroll, 0);
}

/* ------------------------------------------------------------ loss of work */

static void quitting_asks_only_where_something_is_lost(void **state)
{
	struct stand *s = *state;

	desk_close(s->desk);
	assert_true(s->closed);
	s->closed = false;
	stand_add_plate(s, "plate");
	stand_leaf(s, "V133");
	assert_false(s->closed);
	assert_non_null(desk_list_model(s->desk));
	stand_key(s, KEY_ESCAPE);
	assert_false(s->closed);
	stand_some_jobs(s);
	desk_close(s->desk);
	assert_int_equal(desk_list_model(s->desk)->n_buttons, 4);
	assert_string_equal(desk_list_model(s->desk)->lines[1],
	                    "3 jobs have not ended. Without this window 2 go on; 1 waits until "
	                    "activated.");
	stand_click_with(s, HIT_BUTTON, 1, GROUP_LIST, 0);
	assert_int_equal(s->asked, MESSAGE_SUSPEND);
	assert_int_equal(s->ids[0], 1);
	assert_true(s->closed);
	s->closed = false;
	desk_close(s->desk);
	stand_type(s, "n");
	assert_false(s->closed);
	desk_close(s->desk);
	stand_type(s, "l");
	assert_true(s->closed);
}

/* A suspended job does not go on by itself, and cannot be suspended again. */
static void quitting_says_what_becomes_of_jobs(void **state)
{
	struct stand *s = *state;

	stand_put_job(s, 1, JOB_RUNNING, NULL);
	desk_close(s->desk);
	assert_string_equal(desk_list_model(s->desk)->lines[0],
	                    "1 job has not ended. Without this window it goes on.");
	assert_int_equal(desk_list_model(s->desk)->n_buttons, 4);
	stand_type(s, "n");
	stand_put_job(s, 1, JOB_SUSPENDED, NULL);
	desk_close(s->desk);
	assert_string_equal(desk_list_model(s->desk)->lines[0],
	                    "1 job has not ended and waits until activated.");
	assert_int_equal(desk_list_model(s->desk)->n_buttons, 3);
	stand_type(s, "s");
	assert_false(s->closed);
	stand_type(s, "l");
	assert_true(s->closed);
}

/* What went wrong stands until something else is asked for. */
static void an_old_error_goes_with_another_form(void **state)
{
	struct stand *s = *state;

	stand_add_plate(s, "plate");
	stand_leaf(s, "V43");
	assert_non_null(strstr(stand_message(s), "no curve"));
	stand_leaf(s, "V57");
	assert_string_equal(stand_message(s), "");
	stand_key(s, KEY_ESCAPE);
	stand_leaf(s, "V175");
	stand_type(s, "missing.igs");
	stand_key(s, KEY_ENTER);
	assert_non_null(strstr(stand_message(s), "missing.igs"));
	stand_leaf(s, "V175");
	assert_non_null(strstr(stand_message(s), "missing.igs"));
	stand_key(s, KEY_ESCAPE);
	stand_leaf(s, "V57");
	assert_string_equal(stand_message(s), "");
}

/* Unsaved work that the session cannot keep is not lost unasked. */
static void a_session_that_cannot_be_kept_is_asked_about(void **state)
{
	struct stand *s = *state;
	char *path = path_join(s->project.hidden, "session");

	stand_add_plate(s, "plate");
	assert_int_equal(file_write(path, "in the way", 10, NULL), ST_OK);
	for (int lose = 0; lose < 2; lose++) {
		desk_close(s->desk);
		stand_type(s, "l");
		assert_false(s->closed);
		assert_non_null(strstr(desk_list_model(s->desk)->title, "lose"));
		assert_non_null(strstr(desk_list_model(s->desk)->lines[0], "session"));
		stand_type(s, lose ? "l" : "n");
		assert_int_equal(s->closed, lose);
	}
	assert_int_equal(unlink(path), 0);
	s->closed = false;
	desk_close(s->desk);
	stand_type(s, "l");
	assert_true(s->closed);
	assert_true(path_exists(path));
	free(path);
}

/* ------------------------------------------------------------ errands */

static void a_long_errand_holds_the_world_and_can_be_stopped(void **state)
{
	struct stand *s = *state;

	stand_add_plate(s, "plate");
	stand_paint(s);
	s->keep_errands = true;
	stand_leaf(s, "V175");
	stand_type(s, "nothing.igs");
	desk_key(s->desk, KEY_ESCAPE, 0);
	stand_leaf(s, "V178");
	stand_type(s, "plate.igs");
	desk_key(s->desk, KEY_ESCAPE, 0);
	const char *files[] = { "missing.igs" };
	desk_open(s->desk, files, 1);
	assert_non_null(s->errand);
	assert_true(desk_world_lent(s->desk));
	assert_string_equal(desk_mouse_words(s->desk).press[0], "");
	unsigned dirty = desk_take_dirty(s->desk);
	assert_false(dirty & (DESK_VIEW | 1u << PART_MENU | 1u << PART_OVER));
	assert_true(dirty & 1u << PART_FOOT);
	stand_type(s, "z"); /* no undo meanwhile: says so */
	assert_non_null(strstr(stand_message(s), "Esc"));
	stand_key(s, KEY_ESCAPE);
	errand_run(s->errand);
	desk_errand_over(s->desk);
	assert_false(desk_world_lent(s->desk));
	assert_true(stand_paint(s) & DESK_VIEW);
	assert_int_equal(desk_foot_model(s->desk)->level, REPORT_ERROR);
}

static void keys_of_the_window_paint_what_they_change(void **state)
{
	struct stand *s = *state;

	stand_add_plate(s, "plate");
	stand_paint(s);
	assert_int_equal(desk_take_dirty(s->desk), 0);
	desk_move(s->desk, 500, 400);
	assert_int_equal(desk_take_dirty(s->desk) & DESK_VIEW, 0); /* hovering draws no view */
	double width = desk_part_box(s->desk, PART_TOP).width;
	desk_key(s->desk, KEY_F9, 0);
	assert_true(desk_part_box(s->desk, PART_TOP).width > width);
	assert_true(desk_part_box(s->desk, PART_MENU).width == 0);
	desk_key(s->desk, KEY_F9, 0);
	int n;
	enum theme theme = desk_tiles(s->desk, &n)[0].view.theme;
	desk_key(s->desk, KEY_F10, 0);
	assert_int_not_equal(desk_tiles(s->desk, &n)[0].view.theme, theme);
	assert_true(desk_take_dirty(s->desk) & DESK_VIEW);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, stand_set_up, stand_tear_down)

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(the_menus_are_walked_by_mouse_and_by_keys),
		TEST(the_world_menu_is_a_key_away_and_back),
		TEST(every_leaf_does_something_or_says_why),
		TEST(greyed_rows_say_why),
		TEST(every_name_fits_the_smallest_window),
		TEST(routines_are_found_by_name_code_and_help),
		TEST(where_nothing_is_found_the_nearest_two_are_offered),
		TEST(help_is_of_what_is_under_the_mouse),
		TEST(links_of_help_are_followed_by_keys_and_mouse),
		TEST(the_sheet_of_keys_scrolls_where_it_is_cut),
		TEST(quitting_asks_only_where_something_is_lost),
		TEST(quitting_says_what_becomes_of_jobs),
		TEST(an_old_error_goes_with_another_form),
		TEST(a_session_that_cannot_be_kept_is_asked_about),
		TEST(a_long_errand_holds_the_world_and_can_be_stopped),
		TEST(keys_of_the_window_paint_what_they_change),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
