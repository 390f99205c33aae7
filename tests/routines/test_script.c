/* test_script.c - lines taken apart, scripts run, the journal and its replay. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "acting.h"
#include "file.h"
#include "path.h"

/* A line as "CODE|name=value|name=value", "" for nothing. */
static void test_lines(void **state)
{
	static const struct {
		const char *line, *parts;
	} cases[] = {
		{ "", "" },
		{ "   \t ", "" },
		{ "# V79", "" },
		{ "V79", "V79" },
		{ "  V79 # all", "V79" },
		{ "V79 grid=4x2 wait=no", "V79|grid=4x2|wait=no" },
		{ "V79\tgrid=4x2\r\n", "V79|grid=4x2" },
		{ "V44 color=#7CC4F8 # sky", "V44|color=#7CC4F8" },
		{ "V159 surface=hull.igs#3", "V159|surface=hull.igs#3" },
		{ "V175 file=\"my hull.igs\"", "V175|file=my hull.igs" },
		{ "V175 file=\"a \\\"b\\\" \\\\ c\" entity=1", "V175|file=a \"b\" \\ c|entity=1" },
		{ "V175 file=\"a\n\" #", "V175|file=a\n" },
		{ "V177 name=\"\"", "V177|name=" },
		{ "V177 name=", "V177|name=" },
		{ "V177 name=a=b", "V177|name=a=b" },
		{ "V177 name=a\"b", "V177|name=a\"b" },
	};

	(void)state;
	for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
		struct script_line l;
		struct report_store said;
		char parts[256] = "";
		report_store_init(&said);
		enum status st = script_line_parse(&l, cases[k].line, &said.report);
		assert_int_equal(st, ST_OK);
		if (l.routine)
			strcat(parts, l.routine->code);
		for (int j = 0; j < l.given.n; j++) {
			strcat(parts, "|");
			strcat(parts, l.given.name[j]);
			strcat(parts, "=");
			strcat(parts, l.given.value[j]);
		}
		assert_string_equal(parts, cases[k].parts);
		script_line_finish(&l);
	}
}

static void test_wrong_lines(void **state)
{
	struct acting *a = *state;
	static const struct {
		const char *line, *says;
	} cases[] = {
		{ "X1", "column 1: there is no routine 'X1'" },
		{ "  V115", "column 3: there is no routine 'V115'" },
		{ "V79 grid", "column 5: expected KEY=VALUE" },
		{ "V79 =3", "column 5: expected KEY=VALUE" },
		{ "V175 file=\"a b", "column 11: a quote that does not end" },
		{ "V175 file=\"a b\"c", "column 16: something stands right behind" },
		{ "V175 file=\"a\"#", "column 14: something stands right behind" },
		{ "V175 colour=1", "V175 has no argument colour; it has file, entity" },
		{ "V175 file=a file=b", "V175: file is given twice" },
		{ "V175", "V175 needs file=: geometry file" },
		{ "V57 lines_u=many", "V57 cannot be run: no surface" },
		{ "V166 field=500", "field is '500'; it must be 1 to 150 deg" },
		{ "V133 jobs=stop", "jobs is 'stop'; it must be one of leave|suspend|kill" },
		{ "V60", "V60: give at least one of its values" },
	};

	for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
		acting_fails(a, cases[k].line, ST_PARAMETER, cases[k].says);
}

static char *write_script(struct acting *a, const char *text)
{
	char *path = place_path(&a->place, "a.script");

	assert_int_equal(file_write(path, text, strlen(text), NULL), ST_OK);
	return path;
}

static void test_stops(void **state)
{
	struct acting *a = *state;
	int failed;

	place_spheres(&a->place, "ball.base", 1);
	char *path = write_script(a, "V175 file=ball.base\n\nV57 lines_u=x\nV180 name=moon\n");
	assert_int_equal(script_run(&a->act, path, false, &failed), ST_PARAMETER);
	assert_int_equal(failed, 1);
	assert_non_null(strstr(a->place.said.error, "a.script line 3: lines_u is 'x'"));
	acting_thing(a, "ball");
	assert_int_equal(script_run(&a->act, path, true, &failed), ST_PARAMETER);
	assert_int_equal(failed, 1);
	acting_thing(a, "moon");
	assert_int_equal(script_run(&a->act, "/no/script", true, &failed), ST_INPUT);
	free(path);

	/* nothing of a line with a zero byte, and nothing behind QUIT */
	path = place_path(&a->place, "b.script");
	assert_int_equal(
	        file_write(path, "V60 count=3\0V\nV133 unsaved=discard\nV60 count=x\n", 47, NULL),
	        ST_OK);
	assert_int_equal(script_run(&a->act, path, true, &failed), ST_PARAMETER);
	assert_int_equal(failed, 1);
	assert_true(a->act.quit);
	assert_null(world_default(a->place.world, "planes", "count"));
	free(path);
}

static const char edits[] = "V175 file=\"two balls.base\"\n"
                            "V127 index=2,1 to=0.1,0.2,0.3 weight=2\n"
                            "V128 along=v order=4\n"
                            "V129 along=u knots=0.5,1\n"
                            "V182\n"
                            "V185 by=1,2,3 copy=yes\n"
                            "V180 name=third\n"
                            "V57 lines_u=3\n"
                            "V88 count=5\n"
                            "V88 from=10\n"
                            "V25 points=0,0,0;1,1,0;2,0,0;3,1,1 name=wire\n"
                            "V177 name=wire2\n"
                            "V178 to=all.base entities=all\n";

static char *read_all(struct acting *a, const char *name)
{
	char *path = place_path(&a->place, name), *text;
	size_t n;

	assert_int_equal(file_read(path, 1 << 24, &text, &n, NULL), ST_OK);
	free(path);
	return text;
}

/* What the journal of a script does is what the script did. */
static void test_replay(void **state)
{
	struct acting *a = *state;
	struct acting *b = calloc(1, sizeof *b);
	int failed;

	place_spheres(&a->place, "two balls.base", 2);
	char *path = write_script(a, edits);
	a->act.journal = true;
	assert_int_equal(script_run(&a->act, path, false, &failed), ST_OK);
	free(path);
	char *journal = read_all(a, ".batten/journal");
	assert_non_null(strstr(journal, "V175 file=\"two balls.base\"\n"));
	assert_non_null(strstr(journal, "V57 lines_u=3 lines_v=7 segments=0 surfaces=current\n"));
	assert_non_null(strstr(journal, "V88 count=5 from=10\n"));

	acting_init(b);
	place_spheres(&b->place, "two balls.base", 2);
	path = write_script(b, journal);
	b->act.journal = true;
	assert_int_equal(script_run(&b->act, path, false, &failed), ST_OK);
	static const char *const files[] = { "all.base", "wire2.base", ".batten/journal" };
	for (size_t k = 0; k < sizeof files / sizeof *files; k++) {
		char *one = read_all(a, files[k]), *two = read_all(b, files[k]);
		assert_string_equal(one, two);
		free(one);
		free(two);
	}
	free(path);
	free(journal);
	acting_finish(b);
	free(b);
}

static void settle(struct acting *a, int64_t id, bool nothing)
{
	struct job_end end = { id, nothing };

	assert_int_equal(journal_settle(a->act.project, &end, 1, NULL), ST_OK);
}

static void journal_is(struct acting *a, const char *expected)
{
	char *text = read_all(a, ".batten/journal");

	assert_string_equal(text, expected);
	free(text);
}

/* The line that started a job says what came of it; others stay as they are. */
static void test_ends_of_jobs(void **state)
{
	struct acting *a = *state;
	static const char text[] = "V60 count=3\n"
	                           "V76 samples=1 wait=yes    # job 4 \n"
	                           "V80 surfaces=shown wait=yes    # job 5  12  6 \n"
	                           "# V165 jobs=4\n"
	                           "V90 wait=yes # job 7\n" /* no room: not ours */
	                           "V90 wait=yes    # job 40";
	char *path = place_path(&a->place, ".batten/journal");

	settle(a, 4, true); /* there is none yet */
	assert_int_equal(folder_make(a->act.project->hidden, 0777, NULL), ST_OK);
	assert_int_equal(file_write(path, text, sizeof text - 1, NULL), ST_OK);
	settle(a, 99, true);
	journal_is(a, text);
	settle(a, 7, true);
	settle(a, 40, true); /* the line is not whole yet */
	settle(a, 1, true);
	journal_is(a, text);
	settle(a, 4, true);
	settle(a, 12, true);
	journal_is(a, "V60 count=3\n"
	              "V76 samples=1 wait=killed # job 4x\n"
	              "V80 surfaces=shown wait=yes    # job 5  12x 6 \n"
	              "# V165 jobs=4\n"
	              "V90 wait=yes # job 7\n"
	              "V90 wait=yes    # job 40");
	struct job_end ends[] = { { 6, true }, { 5, true }, { 4, false } };
	assert_int_equal(journal_settle(a->act.project, ends, 3, NULL), ST_OK);
	journal_is(a, "V60 count=3\n"
	              "V76 samples=1 wait=yes    # job 4 \n"
	              "V80 surfaces=shown wait=killed # job 5x 12x 6x\n"
	              "# V165 jobs=4\n"
	              "V90 wait=yes # job 7\n"
	              "V90 wait=yes    # job 40");
	free(path);
}

/* A killed job is not started, and leaves what there was; all else of its line is done. */
static void test_killed(void **state)
{
	struct acting *a = *state;

	place_spheres(&a->place, "balls.base", 2);
	acting_does(a, "V175 file=balls.base");
	a->act.journal = true;
	acting_does(a, "V80 wait=killed");
	acting_does(a, "V90 surfaces=shown wait=killed");
	assert_int_equal(world_overlays(a->place.world), 0);
	assert_int_equal(world_current(a->place.world, false)->display.look, LOOK_MAP);
	char *socket = place_path(&a->place, ".batten/ledger.db");
	assert_false(path_exists(socket));
	free(socket);
	char *text = read_all(a, ".batten/journal");
	assert_non_null(strstr(text, "surfaces=shown wait=killed\n"));
	free(text);
	acting_fails(a, "V80 wait=kill", ST_PARAMETER, "wait is 'kill'");
}

/* A journal that cannot be written is told. */
static void test_journal_fails(void **state)
{
	struct acting *a = *state;
	char *path = place_path(&a->place, ".batten");

	assert_int_equal(file_write(path, "x", 1, NULL), ST_OK);
	a->act.journal = true;
	assert_int_equal(acting_run(a, "V60 count=3"), ST_INPUT);
	free(path);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_lines),
		cmocka_unit_test_setup_teardown(test_wrong_lines, acting_setup, acting_teardown),
		cmocka_unit_test_setup_teardown(test_stops, acting_setup, acting_teardown),
		cmocka_unit_test_setup_teardown(test_replay, acting_setup, acting_teardown),
		cmocka_unit_test_setup_teardown(test_ends_of_jobs, acting_setup, acting_teardown),
		cmocka_unit_test_setup_teardown(test_killed, acting_setup, acting_teardown),
		cmocka_unit_test_setup_teardown(test_journal_fails, acting_setup, acting_teardown),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
