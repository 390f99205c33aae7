/* test_settings.c - the table of settings: files, environment, what is refused; and the project. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "file.h"
#include "path.h"
#include "settings.h"
#include "stats.h"
#include "text.h"
#include "tidy.h"

struct here {
	char folder[64];
	struct project project;
	struct report_store store;
};

static int set_up(void **state)
{
	struct here *h = calloc(1, sizeof *h);
	strcpy(h->folder, "/tmp/batten-settings-XXXXXX");
	if (!mkdtemp(h->folder))
		return -1;
	setenv("XDG_RUNTIME_DIR", h->folder, 1);
	setenv("XDG_CONFIG_HOME", h->folder, 1);
	report_store_init(&h->store);
	*state = h;
	return project_find(&h->project, h->folder, NULL) || project_make(&h->project, NULL);
}

static int tear_down(void **state)
{
	struct here *h = *state;
	char *command = text_print("rm -r %s", h->folder);
	int rc = system(command);
	free(command);
	project_finish(&h->project);
	free(h);
	return rc;
}

static void write_file(const struct here *h, const char *name, const char *text)
{
	char *path = path_join(h->folder, name), *folder = path_folder(path);
	assert_int_equal(folder_make(folder, 0777, NULL), ST_OK);
	assert_int_equal(file_write(path, text, strlen(text), NULL), ST_OK);
	free(path);
	free(folder);
}

static void later_ones_win(void **state)
{
	struct here *h = *state;
	struct settings s;
	assert_int_equal(settings_read(&s, &h->project, &h->store.report), ST_OK);
	assert_true(settings_number(&s, SETTING_CANCEL_GRACE) == 2);
	assert_string_equal(s.source[SETTING_JOBS], "default");
	settings_finish(&s);

	write_file(h, "batten/config", "# mine\n jobs = 3 # few\nthreads=2\n\nnice = 1");
	write_file(h, ".batten/config", "threads = 4\n");
	setenv("BATTEN_NICE", "7", 1);
	assert_int_equal(settings_read(&s, &h->project, &h->store.report), ST_OK);
	unsetenv("BATTEN_NICE");
	assert_true(settings_number(&s, SETTING_JOBS) == 3);
	assert_true(settings_number(&s, SETTING_THREADS) == 4);
	assert_true(settings_number(&s, SETTING_NICE) == 7);
	assert_true(path_has_suffix(s.source[SETTING_JOBS], "/batten/config"));
	assert_string_equal(s.source[SETTING_NICE], "environment");
	settings_finish(&s);
	assert_int_equal(settings_read(&s, NULL, &h->store.report), ST_OK);
	assert_true(settings_number(&s, SETTING_THREADS) == 2);
	settings_finish(&s);
}

static void wrong_ones_are_named_with_their_line(void **state)
{
	static const struct {
		const char *line, *says;
	} cases[] = {
		{ "sails = 3", "there is no setting 'sails'" },
		{ "jobs", "expected 'key = value'" },
		{ "= 3", "there is no setting ''" },
		{ "jobs = many", "whole number from 0 to 1024" },
		{ "jobs = 1.5", "whole number" },
		{ "jobs = -1", "whole number" },
		{ "jobs = 1025", "whole number" },
		{ "jobs =", "whole number" },
		{ "idle = 0", "seconds from 0.1" },
		{ "idle = nan", "seconds from" },
		{ "idle = 1e9", "seconds from" },
		{ "color = or", "auto, always or never" },
		{ "color = al", "auto, always or never" },
		{ "color = Always", "auto, always or never" },
	};
	struct here *h = *state;
	struct settings s;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		char *text = text_print("# one\nthreads = 2\n%s\n", cases[i].line);
		write_file(h, ".batten/config", text);
		report_store_init(&h->store);
		assert_int_equal(settings_read(&s, &h->project, &h->store.report), ST_PARAMETER);
		if (!strstr(h->store.error, cases[i].says) || !strstr(h->store.error, "' line 3:"))
			fail_msg("'%s' gives: %s", cases[i].line, h->store.error);
		free(text);
	}
	write_file(h, ".batten/config", "");
	setenv("BATTEN_CANCEL_GRACE", "x", 1);
	assert_int_equal(settings_read(&s, &h->project, &h->store.report), ST_PARAMETER);
	unsetenv("BATTEN_CANCEL_GRACE");
	assert_non_null(strstr(h->store.error, "BATTEN_CANCEL_GRACE"));
}

static void writing_keeps_the_other_lines(void **state)
{
	struct here *h = *state;
	char *path = path_join(h->folder, ".batten/config"), *text;
	size_t n;
	write_file(h, ".batten/config", "# keep me\njobs = 1\nnice = 3\njobs = 2");
	assert_int_equal(settings_write(&h->project, false, "jobs", "8", NULL), ST_OK);
	assert_int_equal(file_read(path, 1000, &text, &n, NULL), ST_OK);
	assert_string_equal(text, "# keep me\njobs = 8\nnice = 3\n");
	free(text);
	assert_int_equal(settings_write(&h->project, false, "color", "never", NULL), ST_OK);
	assert_int_equal(file_read(path, 1000, &text, &n, NULL), ST_OK);
	assert_string_equal(text, "# keep me\njobs = 8\nnice = 3\ncolor = never\n");
	free(text);
	assert_int_equal(settings_write(&h->project, false, "jobs", "x", NULL), ST_PARAMETER);
	assert_int_equal(settings_write(&h->project, false, "sails", "1", NULL), ST_PARAMETER);
	assert_int_equal(settings_write(&h->project, true, "jobs", "5", NULL), ST_OK);
	free(path);
	path = path_join(h->folder, "batten/config");
	assert_true(path_exists(path));
	free(path);
}

static void project_is_the_nearest_above(void **state)
{
	struct here *h = *state;
	struct project p;
	char *deep = path_join(h->folder, "a/b"), *link = path_join(h->folder, "link");
	assert_int_equal(folder_make(deep, 0777, NULL), ST_OK);
	assert_int_equal(project_find(&p, deep, NULL), ST_OK);
	assert_string_equal(p.folder, h->folder);
	assert_string_equal(p.socket, h->project.socket);
	project_finish(&p);
	/* a socket of its own for each folder, the same for each name of it */
	char *own = path_join(deep, ".batten");
	assert_int_equal(folder_make(own, 0777, NULL), ST_OK);
	assert_int_equal(project_find(&p, deep, NULL), ST_OK);
	assert_string_equal(p.folder, deep);
	assert_string_not_equal(p.socket, h->project.socket);
	project_finish(&p);
	assert_int_equal(symlink(h->folder, link), 0);
	char *hidden = path_join(link, ".batten");
	assert_true(path_is_folder(hidden));
	assert_int_equal(project_find(&p, link, NULL), ST_OK);
	assert_string_equal(p.socket, h->project.socket);
	project_finish(&p);
	free(hidden);
	free(own);
	free(deep);
	free(link);
}

static void a_socket_folder_that_others_may_enter_is_refused(void **state)
{
	struct here *h = *state;
	char *folder = path_folder(h->project.socket);
	struct stat s;
	assert_int_equal(stat(folder, &s), 0);
	assert_int_equal(s.st_mode & 0777, 0700);
	assert_int_equal(chmod(folder, 0755), 0);
	assert_int_equal(project_make(&h->project, &h->store.report), ST_INPUT);
	assert_non_null(strstr(h->store.error, "mode to 700"));
	assert_int_equal(rmdir(folder), 0);
	assert_int_equal(symlink("/tmp", folder), 0);
	assert_int_equal(project_make(&h->project, &h->store.report), ST_INPUT);
	free(folder);
}

static void any_line_of_text_is_read_back(void **state)
{
	static const char *const values[] = {
		"echo #1",
		"a#b",
		"#",
		"\"quoted\"",
		"\"my program\" arg",
		"\"half",
		"back\\slash",
		" blanks ",
		"say \"#\"",
		"\\\" # \\",
		"x = y",
		"",
	};
	struct here *h = *state;
	for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
		struct settings s;
		assert_int_equal(settings_write(&h->project, false, "hook", values[i], NULL),
		                 ST_OK);
		assert_int_equal(settings_read(&s, &h->project, NULL), ST_OK);
		assert_string_equal(s.value[SETTING_HOOK], values[i]);
		settings_finish(&s);
	}
	assert_int_equal(settings_write(&h->project, false, "hook", "two\nlines", NULL),
	                 ST_PARAMETER);
}

static void comments_begin_behind_a_blank(void **state)
{
	static const struct {
		const char *line, *value;
	} rows[] = {
		{ "hook = run a#b # c", "run a#b" },     { "hook = # c", "" },
		{ "hook = \"a # b\" # c", "a # b" },     { "hook=\"a\" b # c", "\"a\" b" },
		{ "  # hook = a\nhook = b\t#c\n", "b" }, { "hook = \"a\\\\\" ", "a\\" },
	};
	struct here *h = *state;
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
		struct settings s;
		write_file(h, ".batten/config", rows[i].line);
		assert_int_equal(settings_read(&s, &h->project, NULL), ST_OK);
		assert_string_equal(s.value[SETTING_HOOK], rows[i].value);
		settings_finish(&s);
	}
}

#define T(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

static bool is_there(const struct here *h, const char *name)
{
	char *path = path_join(h->folder, name);
	bool there = path_exists(path);
	free(path);
	return there;
}

/* Those of the job go, of whatever length its name; another job's, and what only looks like them, stay. */
static void what_a_killed_worker_left_is_taken_away(void **state)
{
	static const struct {
		const char *end;
		bool goes;
	} rows[] = {
		{ ".map.exr.7.tmp", true },   { ".png.7.tmp.a1b2c3", true },
		{ ".map.exr.17.tmp", false }, { ".map.exr.8.tmp", false },
		{ ".map.exr", false },        { ".map.exr.7.tmp.more", false },
	};
	struct here *h = *state;
	char name[248] = "hull";
	for (int length = 0; length < 2; length++) {
		char *brief = path_brief_name(name), *output = path_join(h->folder, name);
		struct Stats s = { .id = 7, .output = output };
		for (int made = 0; made < 2; made++) {
			for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
				char *left = text_print(".%s%s", brief, rows[i].end);
				if (!made)
					write_file(h, left, "half");
				else
					assert_int_equal(is_there(h, left), !rows[i].goes);
				free(left);
			}
			tidy_outputs(&s);
		}
		free(output);
		free(brief);
		memset(name, 'n', sizeof name - 1);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		T(later_ones_win),
		T(wrong_ones_are_named_with_their_line),
		T(writing_keeps_the_other_lines),
		T(any_line_of_text_is_read_back),
		T(comments_begin_behind_a_blank),
		T(project_is_the_nearest_above),
		T(a_socket_folder_that_others_may_enter_is_refused),
		T(what_a_killed_worker_left_is_taken_away),
	};
	return cmocka_run_group_tests_name("settings", tests, NULL, NULL);
}
