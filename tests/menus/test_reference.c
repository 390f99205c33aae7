/* test_reference.c - each leaf of the reference table is in our menus at its place, and no other but
 * those named here. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "file.h"
#include "menu.h"
#include "path.h"

/* Leaves that came after the table, so that scripts have what the window does, too. */
static const struct {
	const char *code, *path;
} later[] = { { "V188", "WORLD > SPLIT VIEW" },
	      { "V189", "MAIN > GEOMETRY INTERROGATION > SURFACE > IMAGE ON/OFF" } };

static void expect_leaf(const struct menu_set *set, const char *code, const char *path)
{
	enum menu_root root;
	const struct Menu_Entry *e = menu_set_find(set, code, &root);
	if (!e)
		fail_msg("%s is in no menu", code);
	char *is = menu_path(root, e);
	assert_string_equal(is, path);
	free(is);
}

/* The reference's rows are code, kind, path, what, with tabs between. */
static void leaves_and_paths_are_those_of_the_reference(void **state)
{
	const char *folder = getenv("BATTEN_MENUS");
	struct menu_set set;
	char *text = *state, *rest;
	int rows = 0, leaves = 0;

	assert_int_equal(menu_set_read(&set, &folder, 1, NULL), ST_OK);
	for (char *line = strtok_r(text, "\n", &rest); line; line = strtok_r(NULL, "\n", &rest)) {
		char code[8] = "V", want[256];

		if (sscanf(line, "V%5[0-9]\t%*[^\t]\t%255[^\t]", code + 1, want) != 2)
			continue;
		expect_leaf(&set, code, want);
		rows++;
	}
	for (size_t i = 0; i < sizeof later / sizeof *later; i++, rows++)
		expect_leaf(&set, later[i].code, later[i].path);
	for (int k = 0; k < N_MENUS; k++)
		for (const struct Menu_Entry *e = NULL; (e = menu_next_leaf(set.menu[k], e));)
			leaves++;
	assert_int_equal(rows, leaves);
	menu_set_finish(&set);
}

int main(void)
{
	const char *data = getenv("BATTEN_DATA");
	char *path = data ? path_join(data, "../routines.tsv") : NULL, *text;
	size_t n;

	if (!path || !path_exists(path)) {
		puts("1..0 # SKIP BATTEN_DATA does not name the reference files");
		free(path);
		return 0;
	}
	if (file_read(path, 1 << 20, &text, &n, NULL) != ST_OK)
		return 1;
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_prestate(leaves_and_paths_are_those_of_the_reference, text),
	};
	int failed = cmocka_run_group_tests(tests, NULL, NULL);
	free(text);
	free(path);
	return failed;
}
