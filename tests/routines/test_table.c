/* test_table.c - every leaf of the menus is in the table, and every row is whole. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "acting.h"
#include "menu.h"

enum { LEAVES = 188 };

static void test_rows(void **state)
{
	int n = 0, before = -1;

	(void)state;
	for (const struct routine *t = routine_table; t->code; t++, n++) {
		const int number = atoi(t->code + 1);
		assert_true(t->code[0] == 'V' && number > before);
		before = number;
		assert_ptr_equal(routine_find(t->code), t);
		assert_int_equal(t->kind == ROUTINE_JOB && t->run, t->worker != NULL);
		assert_false(t->worker && t->arguments);
	}
	assert_int_equal(n, LEAVES);
	assert_null(routine_find("V115"));
	assert_null(routine_find(""));
}

/* The menus of the program name all of them, and nothing else. */
static void test_menus(void **state)
{
	bool seen[LEAVES] = { false };
	int n = 0;

	(void)state;
	for (int root = 0; root < N_MENUS; root++) {
		struct menu *m;
		assert_int_equal(menu_read_built_in(&m, (enum menu_root)root, NULL), ST_OK);
		for (struct Menu_Entry *e = menu_next_leaf(m, NULL); e; e = menu_next_leaf(m, e)) {
			const struct routine *t = routine_find(e->index);
			if (!t)
				fail_msg("%s is in no table", e->index);
			n += !seen[t - routine_table];
			seen[t - routine_table] = true;
		}
		menu_destroy(m);
	}
	assert_int_equal(n, LEAVES);
}

/* What is asked for can be shown and has a default that is right. */
static void test_arguments(void **state)
{
	struct acting *a = *state;

	for (const struct routine *t = routine_table; t->code; t++) {
		struct argument_row *rows;
		if (t->worker)
			continue; /* those of its worker: tests/end */
		assert_int_equal(routine_rows(&rows, t, &a->act), ST_OK);
		for (const struct argument_row *row = rows; row->name; row++) {
			assert_non_null(row->help);
			assert_non_null(row->prompt);
			if (row->def &&
			    argument_check(row, row->def, a->place.world, &a->act.report) != ST_OK)
				fail_msg("%s %s: %s", t->code, row->name, a->place.said.error);
			for (const struct argument_row *other = rows; other != row; other++)
				assert_string_not_equal(other->name, row->name);
			assert_true(row->type != ARGUMENT_CHOICE || row->choices);
		}
		routine_rows_free(rows);
	}
}

static void test_greyed(void **state)
{
	struct acting *a = *state;
	static const struct {
		const char *code, *empty, *open; /* reasons; NULL: it can be run */
	} cases[] = {
		{ "V0", "later version", "later version" },
		{ "V175", NULL, NULL },
		{ "V79", "no surface", NULL },
		{ "V106", "no curve in space", "no curve in space" },
		{ "V117", "no curve on a surface", NULL },
		{ "V176", "nothing is open", NULL },
		{ "V182", "nothing to undo", "nothing to undo" },
		{ "V183", "nothing to redo", "nothing to redo" },
	};

	for (int open = 0; open < 2; open++) {
		for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
			const char *why =
			        routine_greyed(routine_find(cases[k].code), a->place.world);
			const char *expected = open ? cases[k].open : cases[k].empty;
			if (!expected)
				assert_null(why);
			else
				assert_string_equal(why, expected);
		}
		place_diagonal(&a->place, "diagonal.base");
		acting_does(a, "V175 file=diagonal.base entity=1");
	}
	acting_fails(a, "V0", ST_PARAMETER, "later version");
}

/* A value, and what is said where it is wrong. */
static void test_checks(void **state)
{
	struct acting *a = *state;
	static const struct {
		enum argument_type type;
		const char *choices, *value;
		bool right;
	} cases[] = {
		{ ARGUMENT_NUMBER, NULL, "0.5", true },
		{ ARGUMENT_NUMBER, NULL, "2", false },
		{ ARGUMENT_NUMBER, NULL, "nan", false },
		{ ARGUMENT_NUMBER, NULL, "1e999", false },
		{ ARGUMENT_NUMBER, NULL, "", false },
		{ ARGUMENT_INTEGER, NULL, "1", true },
		{ ARGUMENT_INTEGER, NULL, "0.5", false },
		{ ARGUMENT_INTEGER, NULL, "9", false },
		{ ARGUMENT_CHOICE, "ab|c", "c", true },
		{ ARGUMENT_CHOICE, "ab|c", "a", false },
		{ ARGUMENT_CHOICE, "ab|c", "ab|c", false },
		{ ARGUMENT_CHOICE, "ab|c", "", false },
		{ ARGUMENT_YESNO, NULL, "yes", true },
		{ ARGUMENT_YESNO, NULL, "true", false },
		{ ARGUMENT_VECTOR, NULL, "1,2,3", true },
		{ ARGUMENT_VECTOR, NULL, "1,2", true },
		{ ARGUMENT_VECTOR, NULL, "1", false },
		{ ARGUMENT_VECTOR, NULL, "1,2,3,4", false },
		{ ARGUMENT_VECTOR, NULL, "1,2,", false },
		{ ARGUMENT_POINTS, NULL, "1,2,3;4,5,6", true },
		{ ARGUMENT_POINTS, NULL, "1,2,3;", false },
		{ ARGUMENT_POINTS, NULL, "nobody", false },
		{ ARGUMENT_COLOR, NULL, "#12abEF", true },
		{ ARGUMENT_COLOR, NULL, "12abEF", false },
		{ ARGUMENT_COLOR, NULL, "#12abEF0", false },
		{ ARGUMENT_VIEW, NULL, "front", true },
		{ ARGUMENT_VIEW, NULL, "30,20:perspective", true },
		{ ARGUMENT_VIEW, NULL, "sideways", false },
		{ ARGUMENT_JOBS, NULL, "all", true },
		{ ARGUMENT_JOBS, NULL, "1,22", true },
		{ ARGUMENT_JOBS, NULL, "1,", false },
		{ ARGUMENT_JOBS, NULL, "0", false },
		{ ARGUMENT_SURFACE, NULL, "ball", true },
		{ ARGUMENT_SURFACE, NULL, "none", false },
		{ ARGUMENT_CURVE, NULL, "ball", false },
		{ ARGUMENT_THING, NULL, "ball", true },
	};

	place_spheres(&a->place, "ball.base", 1);
	acting_does(a, "V175 file=ball.base");
	for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
		const struct argument_row row = { .name = "x",
			                          .type = cases[k].type,
			                          .choices = cases[k].choices,
			                          .min = 0,
			                          .max = 1 };
		report_store_init(&a->place.said);
		enum status st =
		        argument_check(&row, cases[k].value, a->place.world, &a->act.report);
		if (st != (cases[k].right ? ST_OK : ST_PARAMETER))
			fail_msg("%s '%s': %s", argument_type_word[row.type], cases[k].value,
			         a->place.said.error);
		assert_int_equal(a->place.said.n_errors, !cases[k].right);
	}
	const struct argument_row size = {
		.name = "x", .type = ARGUMENT_SIZE, .min = 1, .max = 100
	};
	static const char *const wrong[] = { "1",   "1x",    "x1",    "1x200",
		                             "0x5", "1.5x2", "1x2x3", "1X2" };
	assert_int_equal(argument_check(&size, "100x1", a->place.world, NULL), ST_OK);
	for (size_t k = 0; k < sizeof wrong / sizeof *wrong; k++)
		assert_int_equal(argument_check(&size, wrong[k], a->place.world, NULL),
		                 ST_PARAMETER);
}

static void assert_candidates(struct acting *a, const struct argument_row *row, const char *begin,
                              const char *expected)
{
	json_t *list = argument_candidates(row, begin, &a->act);
	char line[256] = "";

	for (size_t k = 0; k < json_array_size(list); k++) {
		strcat(line, k ? " " : "");
		strcat(line, json_string_value(json_array_get(list, k)));
	}
	json_decref(list);
	assert_string_equal(line, expected);
}

static void test_candidates(void **state)
{
	struct acting *a = *state;

	place_spheres(&a->place, "two.base", 2);
	place_spheres(&a->place, "other.base", 1);
	place_diagonal(&a->place, "a.hull.base");
	acting_does(a, "V175 file=two.base");
	const struct argument_row file = { .type = ARGUMENT_FILE, .pattern = "*.igs *.base" };
	assert_candidates(a, &file, "", "a.hull.base other.base two.base");
	assert_candidates(a, &file, "h", "a.hull.base other.base");
	assert_candidates(a, &file, "O", "other.base two.base");
	const struct argument_row surface = { .type = ARGUMENT_SURFACE };
	assert_candidates(a, &surface, "tw", "two-1 two-2");
	assert_candidates(a, &surface, "x", "");
	const struct argument_row curve = { .type = ARGUMENT_CURVE };
	assert_candidates(a, &curve, "", "");
	const struct argument_row choice = { .type = ARGUMENT_CHOICE,
		                             .choices = "linear|arsinh|auto" };
	assert_candidates(a, &choice, "a", "arsinh auto");
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_rows),
		cmocka_unit_test(test_menus),
		cmocka_unit_test_setup_teardown(test_arguments, acting_setup, acting_teardown),
		cmocka_unit_test_setup_teardown(test_greyed, acting_setup, acting_teardown),
		cmocka_unit_test_setup_teardown(test_checks, acting_setup, acting_teardown),
		cmocka_unit_test_setup_teardown(test_candidates, acting_setup, acting_teardown),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
