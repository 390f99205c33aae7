/* test_leaves.c - our menus are whole: every leaf once, 188 of them. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "menu.h"

static int begin(void **state)
{
	const char *folder = getenv("BATTEN_MENUS");
	struct menu_set *set = calloc(1, sizeof *set);

	if (!folder || !set || menu_set_read(set, &folder, 1, NULL) != ST_OK)
		return -1;
	*state = set;
	return 0;
}

static int end(void **state)
{
	menu_set_finish(*state);
	free(*state);
	return 0;
}

static void every_menu_is_counted(void **state)
{
	static const int leaves[N_MENUS] = { 153, 13, 12, 10 }, menus[N_MENUS] = { 52, 1, 1, 2 };
	const struct menu_set *set = *state;

	for (int k = 0; k < N_MENUS; k++) {
		int n_leaves = 0, n_menus = 0;

		assert_null(set->complaint[k]);
		for (const struct Menu_Entry *e = set->menu[k]->top; e; e = menu_next(e))
			*(menu_is_leaf(e) ? &n_leaves : &n_menus) += 1;
		assert_int_equal(n_leaves, leaves[k]);
		assert_int_equal(n_menus, menus[k]);
	}
}

/* Help is found by the index, and a script names a routine by it. */
static void no_index_stands_twice(void **state)
{
	const struct menu_set *set = *state;

	for (int k = 0; k < N_MENUS; k++)
		for (const struct Menu_Entry *e = set->menu[k]->top; e; e = menu_next(e))
			assert_ptr_equal(menu_set_find(set, e->index, NULL), e);
}

static void what_the_program_carries_is_the_same(void **state)
{
	const struct menu_set *set = *state;

	for (int k = 0; k < N_MENUS; k++) {
		struct menu *m;
		assert_int_equal(menu_read_built_in(&m, (enum menu_root)k, NULL), ST_OK);
		char *here = menu_write(m), *there = menu_write(set->menu[k]);
		assert_string_equal(here, there);
		free(here);
		free(there);
		menu_destroy(m);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_menu_is_counted),
		cmocka_unit_test(no_index_stands_twice),
		cmocka_unit_test(what_the_program_carries_is_the_same),
	};
	return cmocka_run_group_tests(tests, begin, end);
}
