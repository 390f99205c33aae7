/* test_desk_jobs.c - jobs at the desk: picked, steered, told of. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "desk_stand.h"
#include "file.h"
#include "path.h"

static void jobs_are_picked_and_steered(void **state)
{
	struct stand *s = *state;

	stand_some_jobs(s);
	stand_type(s, "j");
	const struct jobs_model *m = desk_jobs_model(s->desk);
	assert_int_equal(m->n, 4);
	assert_int_equal(m->jobs[0]->id, 4);
	stand_click(s, HIT_JOB_ROW, 3);
	stand_type(s, "s");
	assert_int_equal(s->asked, MESSAGE_SUSPEND);
	assert_int_equal(s->n_ids, 1);
	assert_int_equal(s->ids[0], 1);
	stand_click(s, HIT_JOB_BOX, 2); /* job 2, too */
	assert_true(desk_jobs_model(s->desk)->can[0]);
	stand_type(s, "a"); /* acts on those it applies to */
	assert_int_equal(s->asked, MESSAGE_ACTIVATE);
	assert_int_equal(s->ids[0], 2);
	s->asked = 0;
	stand_type(s, "k");
	assert_non_null(strstr(desk_foot_model(s->desk)->prompt, "Kill 2 jobs"));
	stand_key(s, KEY_ENTER); /* kills nothing */
	assert_int_equal(s->asked, 0);
	stand_key(s, KEY_ESCAPE);
	assert_int_equal(s->asked, 0);
	assert_non_null(desk_jobs_model(s->desk));
	stand_type(s, "ky");
	assert_int_equal(s->asked, MESSAGE_KILL);
	assert_int_equal(s->n_ids, 2);
	stand_click_with(s, HIT_BUTTON, 0, GROUP_JOBS, 0);
	assert_int_equal(s->asked, MESSAGE_SUSPEND);
	stand_click(s, HIT_TAB, 3);
	assert_int_equal(desk_jobs_model(s->desk)->n, 1);
	stand_click(s, HIT_JOB_ROW, 0);
	assert_non_null(strstr(desk_jobs_model(s->desk)->log_title, "grid of 0"));
	stand_type(s, "r");
	assert_int_equal(s->asked, MESSAGE_RETRY);
	assert_int_equal(s->ids[0], 3);
}

static void the_list_opens_at_its_top(void **state)
{
	struct stand *s = *state;

	stand_some_jobs(s);
	stand_put_job(s, 1, JOB_DONE,
	              NULL); /* what has ended last is at hand for O and L, not in the list */
	desk_jobs_changed(s->desk, LINK_UP, "");
	stand_type(s, "j");
	assert_int_equal(desk_jobs_model(s->desk)->focus, 0);
	stand_key(s, KEY_END);
	assert_int_equal(desk_jobs_model(s->desk)->focus, 3);
	stand_key(s, KEY_HOME);
	assert_int_equal(desk_jobs_model(s->desk)->focus, 0);
	stand_key(s, KEY_END);
	stand_type(s, "jj");
	assert_int_equal(desk_jobs_model(s->desk)->focus, 0);
}

static void slots_are_counted(void **state)
{
	struct stand *s = *state;
	char *path = path_join(s->project.hidden, "config");

	assert_int_equal(file_write(path, "jobs = 7\n", 9, NULL), ST_OK);
	stand_some_jobs(s);
	stand_type(s, "j");
	assert_string_equal(desk_jobs_model(s->desk)->slots, "1 of 7 job slots in use");
	stand_put_job(s, 4, JOB_STARTING, NULL);
	desk_jobs_changed(s->desk, LINK_UP, "");
	assert_string_equal(desk_jobs_model(s->desk)->slots, "2 of 7 job slots in use");
	free(path);
}

static void the_world_menu_steers_jobs(void **state)
{
	struct stand *s = *state;

	stand_some_jobs(s);
	stand_leaf(s, "V163");
	assert_non_null(desk_jobs_model(s->desk));
	stand_click(s, HIT_JOB_ROW, 3);
	stand_click(s, HIT_MENU_ROW, stand_row_of(s, "SUSPEND JOBS"));
	assert_int_equal(s->asked, MESSAGE_SUSPEND);
	assert_int_equal(s->ids[0], 1);
	stand_click(s, HIT_MENU_ROW, stand_row_of(s, "KILL JOBS"));
	stand_type(s, "y");
	assert_int_equal(s->asked, MESSAGE_KILL);
	assert_string_equal(stand_row(s, "KILL JOBS")->state, "3 can");
}

static void news_of_jobs_is_told_once_with_the_bell(void **state)
{
	struct stand *s = *state;

	world_sight(s->world)->bell = true;
	stand_put_job(s, 1, JOB_RUNNING, NULL);
	stand_put_job(s, 2, JOB_DONE, NULL); /* before we came */
	desk_jobs_changed(s->desk, LINK_UP, "");
	assert_int_equal(s->bells, 0);
	assert_int_equal(desk_top_model(s->desk)->n_chips, 2);
	stand_put_job(s, 1, JOB_FAILED, "the disk is full");
	desk_jobs_changed(s->desk, LINK_UP, "");
	desk_jobs_changed(s->desk, LINK_UP, "");
	assert_int_equal(s->bells, 1);
	assert_non_null(strstr(stand_message(s), "the disk is full"));
	stand_type(s, "l"); /* its log, as the hint says */
	assert_non_null(desk_jobs_model(s->desk));
	stand_key(s, KEY_ESCAPE);
	stand_click(s, HIT_CHIP, 0);
	assert_non_null(desk_jobs_model(s->desk));
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, stand_set_up, stand_tear_down)

int main(void)
{
	const struct CMUnitTest tests[] = {
		TEST(jobs_are_picked_and_steered),
		TEST(the_list_opens_at_its_top),
		TEST(slots_are_counted),
		TEST(the_world_menu_steers_jobs),
		TEST(news_of_jobs_is_told_once_with_the_bell),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
