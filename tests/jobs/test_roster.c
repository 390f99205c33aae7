/* test_roster.c - finding workers, hearing what they say of themselves, checking values by it. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "file.h"
#include "json.h"
#include "path.h"
#include "roster.h"
#include "text.h"

static void link_player(const char *folder, const char *program, const char *role)
{
	char *self = path_of_program();
	char *from = text_print("%s/%s", self, program);
	char *to = text_print("%s/batten-%s", folder, role);
	assert_int_equal(symlink(from, to), 0);
	free(self);
	free(from);
	free(to);
}

static int set_up(void **state)
{
	char *folder = strdup("/tmp/batten-roster-XXXXXX");
	if (!folder || !mkdtemp(folder))
		return -1;
	setenv("BATTEN_WORKER_PATH", folder, 1);
	setenv("XDG_CONFIG_HOME", folder, 1);
	*state = folder;
	return 0;
}

static int tear_down(void **state)
{
	char *command = text_print("rm -r %s", (char *)*state);
	int rc = system(command);
	free(command);
	free(*state);
	return rc;
}

static void broken_ones_are_listed_with_their_fault(void **state)
{
	static const struct {
		const char *program, *role, *fault;
	} cases[] = {
		{ "good-worker", "good", NULL },
		{ "bad-worker", "silent", "no answer" },
		{ "bad-worker", "flood", "more than" },
		{ "bad-worker", "lies", "says: it is 'truth'" },
		{ "bad-worker", "quits", "status 7" },
	};
	struct roster x;
	char *none = text_print("%s/batten-none", (char *)*state);
	assert_int_equal(file_write(none, "x", 1, NULL), ST_OK); /* not executable: not there */
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
		link_player(*state, cases[i].program, cases[i].role);
	link_player(*state, "bad-worker", "launch"); /* a name of ours that is no worker */
	assert_int_equal(roster_read(&x, NULL, NULL, NULL), ST_OK);
	assert_null(roster_find(&x, "none"));
	assert_null(roster_find(&x, "launch"));
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		const struct roster_worker *w = roster_find(&x, cases[i].role);
		assert_non_null(w);
		if (!cases[i].fault) {
			assert_null(w->broken);
			assert_string_equal(json_text(w->description, "title", ""), "steps");
		} else if (!w->broken || !strstr(w->broken, cases[i].fault) || w->description) {
			fail_msg("%s: %s", w->name, w->broken ? w->broken : "not broken");
		}
	}
	for (int i = 1; i < x.n; i++)
		assert_true(strcmp(x.workers[i - 1].name, x.workers[i].name) < 0);
	roster_finish(&x);
	free(none);
}

static void one_is_found_without_being_run(void **state)
{
	struct report_store store;
	char *path;
	report_store_init(&store);
	link_player(*state, "bad-worker", "silent");
	assert_int_equal(roster_locate(&path, NULL, "silent", NULL), ST_OK);
	assert_true(path_has_suffix(path, "/batten-silent"));
	free(path);
	static const char *const none[] = { "nobody",    "",       "../silent",
		                            "silent/..", "Silent", "launch" };
	for (size_t i = 0; i < sizeof none / sizeof *none; i++)
		assert_int_equal(roster_locate(&path, NULL, none[i], &store.report), ST_PARAMETER);
	assert_non_null(strstr(store.error, "there is no worker 'launch'"));
}

static void the_first_of_a_name_wins(void **state)
{
	char *folder = *state, *path = NULL;
	char *first = text_print("%s/first", folder), *list = text_print("%s::%s", first, folder);
	assert_int_equal(mkdir(first, 0777), 0);
	link_player(first, "good-worker", "good");
	link_player(folder, "bad-worker", "good");
	setenv("BATTEN_WORKER_PATH", list, 1);
	struct roster x;
	assert_int_equal(roster_read(&x, NULL, "good", NULL), ST_OK);
	assert_int_equal(x.n, 1);
	assert_non_null(strstr(x.workers[0].path, "/first/"));
	roster_finish(&x);
	assert_int_equal(roster_locate(&path, NULL, "good", NULL), ST_OK);
	assert_non_null(strstr(path, "/first/"));
	free(path);
	free(list);
	free(first);
}

static void values_are_checked_by_their_rows(void **state)
{
	static const char description[] =
	        "{\"parameters\":["
	        "{\"name\":\"angle\",\"type\":\"real\",\"min\":0,\"max\":180,\"unit\":\"deg\"},"
	        "{\"name\":\"count\",\"type\":\"integer\",\"min\":1,\"max\":9},"
	        "{\"name\":\"free\",\"type\":\"real\",\"min\":null,\"max\":null},"
	        "{\"name\":\"size\",\"type\":\"size\",\"min\":1,\"max\":65536},"
	        "{\"name\":\"light\",\"type\":\"vector\"},"
	        "{\"name\":\"png\",\"type\":\"flag\"},"
	        "{\"name\":\"map\",\"type\":\"choice\",\"choices\":[\"K\",\"H\"]},"
	        "{\"name\":\"ground\",\"type\":\"color\"},"
	        "{\"name\":\"title\",\"type\":\"text\"}]}";
	static const struct {
		const char *name, *value;
		const char *says; /* NULL: fine */
	} cases[] = {
		{ "angle", "30", NULL },
		{ "angle", "1.5e1", NULL },
		{ "angle", "181", "--angle is '181', expected 0 to 180 deg" },
		{ "angle", "-0.1", "expected 0 to 180 deg" },
		{ "angle", "thirty", "expected a number" },
		{ "angle", "30x", "expected a number" },
		{ "angle", "nan", "expected a number" },
		{ "angle", "1e999", "expected a number" },
		{ "angle", "", "expected a number" },
		{ "count", "3", NULL },
		{ "count", "3.0", "a whole number" },
		{ "count", "99999999999999999999", "a whole number" },
		{ "count", "0", "expected 1 to 9" },
		{ "free", "-1e300", NULL },
		{ "size", "640x480", NULL },
		{ "size", "640", "640x480" },
		{ "size", "640x", "640x480" },
		{ "size", "0x5", "expected 1 to 65536" },
		{ "size", "640x480x1", "640x480" },
		{ "light", "1,0,-0.5", NULL },
		{ "light", "1,0", "three numbers" },
		{ "light", "1 0 0", "three numbers" },
		{ "png", "yes", NULL },
		{ "png", "no", NULL },
		{ "png", "maybe", "yes or no" },
		{ "map", "H", NULL },
		{ "map", "h", "one of K, H" },
		{ "ground", "#12abEF", NULL },
		{ "ground", "#12abE", "#7CC4F8" },
		{ "ground", "12abEFa", "#7CC4F8" },
		{ "title", "any thing", NULL },
		{ "grid", "1", "has no parameter --grid, it has --angle, --count" },
	};
	(void)state;
	char name[] = "play";
	struct roster_worker w = { .name = name, .description = json_loads(description, 0, NULL) };
	assert_non_null(w.description);
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		struct report_store store;
		report_store_init(&store);
		enum status st = roster_check(&w, cases[i].name, cases[i].value, &store.report);
		if (cases[i].says ? st != ST_PARAMETER || !strstr(store.error, cases[i].says)
		                  : st != ST_OK)
			fail_msg("--%s %s: %s", cases[i].name, cases[i].value, store.error);
	}
	json_decref(w.description);
}

#define T(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void)
{
	const struct CMUnitTest tests[] = {
		T(broken_ones_are_listed_with_their_fault),
		T(one_is_found_without_being_run),
		T(the_first_of_a_name_wins),
		T(values_are_checked_by_their_rows),
	};
	return cmocka_run_group_tests_name("roster", tests, NULL, NULL);
}
