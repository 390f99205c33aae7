/* test_set.c - which file a menu comes from, and what stands in for a broken one. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "file.h"
#include "menu.h"
#include "path.h"

struct place {
	char root[32];
	char *project, *config;
};

static char *under(const struct place *p, const char *name)
{
	char *path = path_join(p->root, name);

	assert_non_null(path);
	return path;
}

static int begin(void **state)
{
	struct place *p = calloc(1, sizeof *p);

	strcpy(p->root, "/tmp/batten-menus-XXXXXX");
	if (!mkdtemp(p->root))
		return -1;
	p->project = under(p, "project");
	p->config = under(p, "config");
	setenv("XDG_CONFIG_HOME", p->config, 1);
	*state = p;
	return 0;
}

static int end(void **state)
{
	static const char *const files[] = { "project/.batten/menus/world.menu",
		                             "project/.batten/menus/uv.menu",
		                             "config/batten/menus/world.menu" };
	static const char *const folders[] = {
		"project/.batten/menus", "project/.batten", "project", "config/batten/menus",
		"config/batten",         "config",          ""
	};
	struct place *p = *state;

	for (size_t k = 0; k < sizeof files / sizeof *files; k++) {
		char *path = under(p, files[k]);
		unlink(path);
		free(path);
	}
	for (size_t k = 0; k < sizeof folders / sizeof *folders; k++) {
		char *path = under(p, folders[k]);
		rmdir(path);
		free(path);
	}
	free(p->project);
	free(p->config);
	free(p);
	return 0;
}

static void put(const struct place *p, const char *folder, const char *name, const char *text)
{
	char *inside = under(p, folder), *path = path_join(inside, name);

	assert_int_equal(folder_make(inside, 0777, NULL), ST_OK);
	assert_int_equal(file_write(path, text, strlen(text), NULL), ST_OK);
	free(path);
	free(inside);
}

static void without_files_ours_are_used(void **state)
{
	struct menu_set set;

	(void)state;
	assert_int_equal(menu_set_read(&set, NULL, 0, NULL), ST_OK);
	for (int k = 0; k < N_MENUS; k++) {
		assert_string_equal(set.menu[k]->source, "built in");
		assert_null(set.complaint[k]);
	}
	enum menu_root root;
	assert_string_equal(menu_set_find(&set, "V162", &root)->name, "LIST JOBS");
	assert_int_equal(root, MENU_WORLD);
	char *path = menu_path(root, menu_set_find(&set, "V162", NULL));
	assert_string_equal(path, "WORLD > STATUS ROUTINES > LIST JOBS");
	free(path);
	assert_null(menu_set_find(&set, "V9999", NULL));
	menu_set_finish(&set);
}

#define MENU_OF(word) "2\n" word "\nW\nN55\n1\nA\nV157\n1\nB\nV159\n0\nEND MENU\n"

static void the_project_goes_before_the_user(void **state)
{
	const struct place *p = *state;
	struct menu_set set;

	put(p, "config/batten/menus", "world.menu", MENU_OF("OF USER"));
	assert_int_equal(menu_set_load(&set, p->project, NULL), ST_OK);
	assert_string_equal(set.menu[MENU_WORLD]->top->name, "OF USER");
	menu_set_finish(&set);
	put(p, "project/.batten/menus", "world.menu", MENU_OF("OF PROJECT"));
	assert_int_equal(menu_set_load(&set, p->project, NULL), ST_OK);
	assert_string_equal(set.menu[MENU_WORLD]->top->name, "OF PROJECT");
	assert_string_equal(set.menu[MENU_MAIN]->top->name, "MAIN MENU");
	menu_set_finish(&set);
	assert_int_equal(menu_set_load(&set, NULL, NULL), ST_OK);
	assert_string_equal(set.menu[MENU_WORLD]->top->name, "OF USER");
	menu_set_finish(&set);
}

static void ours_stand_in_for_a_broken_file(void **state)
{
	const struct place *p = *state;
	struct menu_set set;

	put(p, "project/.batten/menus", "uv.menu", "2\nUV\n\n");
	assert_int_equal(menu_set_load(&set, p->project, NULL), ST_OK);
	assert_string_equal(set.menu[MENU_UV]->source, "built in");
	assert_non_null(set.complaint[MENU_UV]);
	assert_non_null(strstr(set.complaint[MENU_UV], "uv.menu' line 3: found a blank line"));
	assert_non_null(strstr(set.complaint[MENU_UV], "; the built-in menu stands in"));
	assert_null(set.complaint[MENU_MAIN]);
	assert_non_null(menu_set_find(&set, "V148", NULL));
	menu_set_finish(&set);
}

static void a_folder_of_that_name_is_told(void **state)
{
	const struct place *p = *state;
	struct menu_set set;
	char *folder = under(p, "project/.batten/menus/main.menu");

	assert_int_equal(folder_make(folder, 0777, NULL), ST_OK);
	assert_int_equal(menu_set_load(&set, p->project, NULL), ST_OK);
	assert_non_null(set.complaint[MENU_MAIN]);
	assert_non_null(menu_set_find(&set, "V79", NULL));
	menu_set_finish(&set);
	rmdir(folder);
	free(folder);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(without_files_ours_are_used),
		cmocka_unit_test_setup_teardown(the_project_goes_before_the_user, begin, end),
		cmocka_unit_test_setup_teardown(ours_stand_in_for_a_broken_file, begin, end),
		cmocka_unit_test_setup_teardown(a_folder_of_that_name_is_told, begin, end),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
