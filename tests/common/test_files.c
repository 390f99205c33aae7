/* test_files.c - paths, and files that appear whole or not at all. */
#include <fcntl.h>
#include <limits.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "file.h"
#include "path.h"
#include "text.h"

static char folder[] = "/tmp/batten-test-XXXXXX";

static int make_folder(void **state)
{
	(void)state;
	return mkdtemp(folder) ? 0 : -1;
}

static int remove_folder(void **state)
{
	char *command = text_print("rm -rf '%s'", folder);
	int rc = system(command);

	(void)state;
	free(command);
	return rc;
}

static void paths(void **state)
{
	static const struct {
		char *(*make)(const char *path);
		const char *in, *out;
	} rows[] = {
		{ path_basic_name, "a/hull.igs", "hull" },
		{ path_basic_name, "a.b/hull", "hull" },
		{ path_basic_name, ".hidden", ".hidden" },
		{ path_basic_name, "hull.map.exr", "hull.map" },
		{ path_folder, "a/b.igs", "a" },
		{ path_folder, "b.igs", "." },
		{ path_folder, "/b", "/" },
	};

	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
		char *got = rows[i].make(rows[i].in);
		assert_string_equal(got, rows[i].out);
		free(got);
	}
}

static void absolute_paths(void **state)
{
	static const struct {
		const char *path, *base, *out;
	} rows[] = {
		{ "/a/./b//../c", NULL, "/a/c" },
		{ "x", "/a/b", "/a/b/x" },
		{ "../x", "/a/b", "/a/x" },
		{ "../../../x", "/a", "/x" },
		{ "/", NULL, "/" },
		{ "..", "/a", "/" },
		{ "a...b/..c", "/", "/a...b/..c" },
	};

	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
		char *got = path_absolute(rows[i].path, rows[i].base);
		assert_string_equal(got, rows[i].out);
		free(got);
	}
}

static void brief_names(void **state)
{
	char longest[NAME_MAX + 1], accents[NAME_MAX];

	(void)state;
	memset(longest, 'x', NAME_MAX);
	longest[NAME_MAX] = 0;
	for (size_t n = 0; n <= NAME_MAX; n++) {
		char *brief = path_brief_name(longest + n), *same = path_brief_name(longest + n);
		assert_string_equal(brief, same);
		if (NAME_MAX - n <= PATH_BRIEF)
			assert_string_equal(brief, longest + n);
		else
			assert_int_equal(strlen(brief), PATH_BRIEF);
		free(brief);
		free(same);
	}
	/* names of one beginning stay apart, and no character is cut */
	char *one = path_brief_name(longest);
	longest[NAME_MAX - 1] = 'y';
	char *other = path_brief_name(longest);
	assert_string_not_equal(one, other);
	for (size_t i = 0; i + 2 < sizeof accents; i += 2)
		memcpy(accents + i, "é", 3);
	char *cut = path_brief_name(accents);
	assert_int_equal(strchr(cut, '~') - cut, PATH_BRIEF - 10);
	free(one);
	free(other);
	free(cut);
}

static void names_of_every_length_can_be_written(void **state)
{
	char name[NAME_MAX + 2];

	(void)state;
	for (size_t n = NAME_MAX - 10; n <= NAME_MAX + 1; n++) {
		memset(name, 'n', n);
		name[n] = 0;
		char *path = path_join(folder, name);
		assert_int_equal(file_write(path, "x", 1, NULL), n > NAME_MAX ? ST_INPUT : ST_OK);
		assert_int_equal(path_exists(path), n <= NAME_MAX);
		free(path);
	}
}

static void a_file_appears_at_its_commit(void **state)
{
	char *path = path_join(folder, "whole"), *got;
	struct whole_file f;
	size_t n;

	(void)state;
	assert_int_equal(whole_file_create(&f, path, NULL), ST_OK);
	fputs("batten", f.stream);
	fflush(f.stream);
	assert_false(path_exists(path));
	assert_int_equal(whole_file_commit(&f, NULL), ST_OK);
	assert_int_equal(file_read(path, 100, &got, &n, NULL), ST_OK);
	assert_string_equal(got, "batten");
	assert_int_equal(n, 6);
	free(got);
	assert_int_equal(file_read(path, 5, &got, &n, NULL), ST_RESOURCE);
	free(path);
}

static void an_abandoned_file_leaves_nothing(void **state)
{
	char *sub = path_join(folder, "empty"), *path = path_join(sub, "f");
	struct whole_file f;

	(void)state;
	assert_int_equal(folder_make(sub, 0700, NULL), ST_OK);
	assert_int_equal(whole_file_create(&f, path, NULL), ST_OK);
	fputs("half", f.stream);
	whole_file_abandon(&f);
	assert_int_equal(rmdir(sub), 0);
	free(path);
	free(sub);
}

static void a_killed_writer_leaves_nothing(void **state)
{
	char *sub = path_join(folder, "killed"), *path = path_join(sub, "f");
	int status;

	(void)state;
	assert_int_equal(folder_make(sub, 0700, NULL), ST_OK);
	int fd = open(sub, O_TMPFILE | O_WRONLY, 0600);
	pid_t child = fork();
	if (child == 0) {
		struct whole_file f;
		if (whole_file_create(&f, path, NULL) == ST_OK && fputs("half", f.stream) >= 0 &&
		    fflush(f.stream) == 0)
			raise(SIGKILL);
		_exit(1);
	}
	assert_int_equal(waitpid(child, &status, 0), child);
	assert_true(WIFSIGNALED(status));
	if (fd >= 0) { /* a disk that can have files without a name */
		close(fd);
		assert_int_equal(rmdir(sub), 0);
	}
	free(path);
	free(sub);
}

static void the_mode_is_as_for_any_file(void **state)
{
	char *path = path_join(folder, "mode");
	struct stat st;

	(void)state;
	static const mode_t masks[] = { 027, 0, 077, 022, 0777 };
	for (size_t i = 0; i < sizeof masks / sizeof *masks; i++) {
		mode_t old = umask(masks[i]);
		assert_int_equal(file_mask(), masks[i]);
		assert_int_equal(file_write(path, "x", 1, NULL), ST_OK);
		umask(old);
		assert_int_equal(stat(path, &st), 0);
		assert_int_equal(st.st_mode & 0777, 0666 & ~masks[i]);
		assert_int_equal(st.st_nlink, 1);
	}
	free(path);
}

static void a_failed_write_is_told(void **state)
{
	char *path = path_join(folder, "kept"), *got;
	struct report_store store;
	struct whole_file f;
	size_t n;

	(void)state;
	assert_int_equal(file_write(path, "old", 3, NULL), ST_OK);
	report_store_init(&store);
	assert_int_equal(whole_file_create(&f, path, &store.report), ST_OK);
	int full = open("/dev/full", O_WRONLY);
	assert_true(full >= 0);
	assert_true(dup2(full, fileno(f.stream)) >= 0);
	close(full);
	fputs("new", f.stream);
	assert_int_equal(whole_file_commit(&f, &store.report), ST_RESOURCE);
	assert_non_null(strstr(store.error, "No space left"));
	assert_int_equal(file_read(path, 100, &got, &n, NULL), ST_OK);
	assert_string_equal(got, "old");
	free(got);
	free(path);
}

static void what_cannot_be_read(void **state)
{
	struct report_store store;
	char *got;
	size_t n;

	(void)state;
	report_store_init(&store);
	assert_int_equal(file_read("/nowhere/x", 100, &got, &n, &store.report), ST_INPUT);
	assert_non_null(strstr(store.error, "/nowhere/x"));
	assert_int_equal(file_read(folder, 100, &got, &n, &store.report), ST_INPUT);
	assert_int_equal(file_write("/nowhere/x", "", 0, &store.report), ST_INPUT);
}

static void folders_are_made_with_those_above(void **state)
{
	char *path = path_join(folder, "a/b/c"), *up;

	(void)state;
	assert_int_equal(folder_make(path, 0700, NULL), ST_OK);
	assert_int_equal(folder_make(path, 0700, NULL), ST_OK);
	assert_true(path_is_folder(path));
	up = path_find_upward(path, "a");
	assert_string_equal(up, folder);
	free(up);
	free(path);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(paths),
		cmocka_unit_test(absolute_paths),
		cmocka_unit_test(brief_names),
		cmocka_unit_test(names_of_every_length_can_be_written),
		cmocka_unit_test(a_file_appears_at_its_commit),
		cmocka_unit_test(an_abandoned_file_leaves_nothing),
		cmocka_unit_test(a_killed_writer_leaves_nothing),
		cmocka_unit_test(the_mode_is_as_for_any_file),
		cmocka_unit_test(a_failed_write_is_told),
		cmocka_unit_test(what_cannot_be_read),
		cmocka_unit_test(folders_are_made_with_those_above),
	};

	return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
