/* test_parse.c - menu files read, written again, and refused with the line where they break. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "menu.h"
#include "text.h"

static const char sample[] = "2\nTOP\nTop Menu\nN1\n"
                             "  1\n  OPEN\n  V1\n"
                             "  3\n  DRAW\n  Draw Menu\n  N2\n"
                             "\t1\n\tCURVE\n\tV2\n"
                             "    1\n    SURFACE\n    V3\n"
                             "    1\n    BÜGE, ÉTRAVE\n    V1\n"
                             "0\nEND MENU\n";

static struct menu *parse(const char *text)
{
	struct menu *m;
	struct report_store store;

	report_store_init(&store);
	enum status st = menu_parse(&m, text, strlen(text), "x.menu", &store.report);
	if (st != ST_OK)
		fail_msg("%s", store.error);
	return m;
}

static void a_menu_becomes_a_tree(void **state)
{
	struct menu *m = parse(sample);

	(void)state;
	assert_string_equal(m->source, "x.menu");
	assert_string_equal(m->top->name, "TOP");
	assert_string_equal(m->top->title, "Top Menu");
	assert_string_equal(m->top->index, "N1");
	assert_null(m->top->parent);
	assert_int_equal(m->top->n_sub, 2);
	const struct Menu_Entry *draw = m->top->sub[1];
	assert_int_equal(draw->n_sub, 3);
	assert_ptr_equal(draw->parent, m->top);
	assert_string_equal(draw->sub[2]->name, "BÜGE, ÉTRAVE");
	assert_int_equal(draw->line, 11);
	assert_true(menu_is_leaf(m->top->sub[0]));
	assert_false(menu_is_leaf(draw));
	menu_destroy(m);
}

static void entries_are_found_and_walked(void **state)
{
	static const char *const order[] = { "N1", "V1", "N2", "V2", "V3", "V1" };
	struct menu *m = parse(sample);
	const struct Menu_Entry *e = m->top;

	(void)state;
	for (size_t k = 0; k < 6; k++, e = menu_next(e))
		assert_string_equal(e->index, order[k]);
	assert_null(e);
	int leaves = 0;
	for (e = menu_next_leaf(m, NULL); e; e = menu_next_leaf(m, e))
		leaves++;
	assert_int_equal(leaves, 4);
	assert_string_equal(menu_find(m, "V1")->name, "OPEN");
	assert_string_equal(menu_find(m, "N2")->title, "Draw Menu");
	assert_null(menu_find(m, "V9"));
	char *path = menu_path(MENU_MAIN, menu_find(m, "V3"));
	assert_string_equal(path, "MAIN > DRAW > SURFACE");
	free(path);
	menu_destroy(m);
}

static void what_is_written_reads_the_same(void **state)
{
	struct menu *m = parse(sample);
	char *once = menu_write(m);
	struct menu *again = parse(once);
	char *twice = menu_write(again);

	(void)state;
	assert_string_equal(once, twice);
	assert_non_null(strstr(once, "\n    BÜGE, ÉTRAVE\n    V1\n"));
	menu_destroy(m);
	menu_destroy(again);
	free(once);
	free(twice);
}

static void ends_of_lines_and_files_do_not_matter(void **state)
{
	(void)state;
	menu_destroy(
	        parse("2\r\nT\r\nT\r\nN1\r\n1\r\nA\r\nV1\r\n1\r\nB\r\nV2\r\n0\r\nEND MENU\r\n"));
	menu_destroy(parse("2\nT\nT\nN1\n1\nA\nV1\n1\nB\nV2\n0\nEND MENU"));
}

#define HEAD   "2\nT\nTitle\nN1\n"
#define A      "1\nA\nV1\n"
#define B      "1\nB\nV2\n"
#define FINISH "0\nEND MENU\n"
#define FORTY  "0123456789012345678901234567890123456789"

static void broken_files_are_refused(void **state)
{
	static const struct {
		const char *text;
		int line;
		const char *says;
	} cases[] = {
		{ "", 1, "found the end of the file, expected the number of entries" },
		{ "\n" HEAD A B FINISH, 1, "blank line" },
		{ "  \t \n", 1, "blank line" },
		{ "zwei\n", 1, "found 'zwei', expected the number of entries" },
		{ "0\nEND MENU\n", 1, "found 0, expected the number of entries" },
		{ "1\nA\nV1\n" FINISH, 1, "found 1, expected the number of entries" },
		{ "15\n", 1, "found '15'" },
		{ "-1\n", 1, "found '-1'" },
		{ "2.0\n", 1, "found '2.0'" },
		{ "99999999999999999999\n", 1, "found '9999" },
		{ "2", 2, "found the end of the file, expected a name" },
		{ "2\n\nTitle\nN1\n", 2, "blank line, expected a name" },
		{ "2\n" FORTY "0\n", 2, "41 bytes, expected a name of at most 40" },
		{ "2\nT\n" FORTY "0\n", 3, "41 bytes, expected a menu title of at most 40" },
		{ "2\nT\n", 3, "expected a menu title" },
		{ "2\nT\nTitle\n", 4, "expected an index of a menu" },
		{ "2\nT\nTitle\nV1\n", 4, "found 'V1' for 'T', expected an index of a menu" },
		{ "2\nT\nTitle\nN\n", 4, "found 'N'" },
		{ "2\nT\nTitle\nN01\n", 4, "found 'N01'" },
		{ "2\nT\nTitle\nN12345\n", 4, "found 'N12345'" },
		{ "2\nT\nTitle\nN1x\n", 4, "found 'N1x'" },
		{ "2\nT\nTitle\nn1\n", 4, "found 'n1'" },
		{ HEAD, 5,
		  "end of the file, expected the number of sub-entries of an entry of 'T'" },
		{ HEAD "A\nV1\n", 5, "found 'A', expected the number of sub-entries" },
		{ HEAD "0\nEND MENU\n", 5, "found 0, expected the number of sub-entries" },
		{ HEAD "1\nA\nN7\n", 7, "found 'N7' for 'A', expected an index of a routine" },
		{ HEAD "1\nA\n49\n", 7, "found '49'" },
		{ HEAD "1\nA\nA title\nV1\n", 7, "found 'A title' for 'A'" },
		{ HEAD A, 8, "end of the file, expected the number of sub-entries" },
		{ HEAD A "\n" B FINISH, 8, "blank line" },
		{ HEAD A FINISH, 8, "found 0" },
		{ HEAD A "1\nA\nV2\n" FINISH, 9, "found 'A' a second time in the menu 'T'" },
		{ HEAD A "2\nS\nSub\nN1\n" A B FINISH, 11,
		  "found N1, which is 'T' of line 4, expected an index of its own" },
		{ HEAD A B, 11, "found the end of the file, expected 0 and END MENU" },
		{ HEAD A B "1\nC\nV3\n" FINISH, 11, "found '1', expected 0 and END MENU" },
		{ HEAD A B "0\n", 12, "found the end of the file, expected END MENU" },
		{ HEAD A B "0\nEND\n", 12, "found 'END', expected END MENU" },
		{ HEAD A B FINISH "\n", 13, "found more behind END MENU" },
		{ HEAD A B FINISH "1\n", 13, "found more behind END MENU" },
		{ HEAD "1\nA\xff\nV1\n" B FINISH, 6, "byte 2 is 0xff, expected text in UTF-8" },
		{ HEAD "1\nA\xc3\nV1\n" B FINISH, 6, "byte 2 is 0xc3" },
		{ HEAD "1\nA\xc0\xaf\nV1\n" B FINISH, 6, "byte 2 is 0xc0" },
		{ HEAD "1\n\xed\xa0\x80\nV1\n" B FINISH, 6, "byte 1 is 0xed" },
		{ HEAD "1\n\xf4\x90\x80\x80\nV1\n" B FINISH, 6, "byte 1 is 0xf4" },
		{ HEAD "1\nA\tB\nV1\n" B FINISH, 6, "byte 2 is 0x09" },
		{ HEAD "1\nA\x1b[1m\nV1\n" B FINISH, 6, "byte 2 is 0x1b" },
	};

	(void)state;
	for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
		struct report_store store;
		struct menu *m;
		char at[64];

		report_store_init(&store);
		assert_int_equal(menu_parse(&m, cases[k].text, strlen(cases[k].text), "x.menu",
		                            &store.report),
		                 ST_INPUT);
		assert_null(m);
		assert_int_equal(store.n_errors, 1);
		snprintf(at, sizeof at, "cannot read menu 'x.menu' line %d: ", cases[k].line);
		if (strncmp(store.error, at, strlen(at)) || !strstr(store.error, cases[k].says))
			fail_msg("case %zu: '%s', expected line %d and '%s'", k, store.error,
			         cases[k].line, cases[k].says);
	}
}

static void a_zero_byte_is_no_text(void **state)
{
	static const char text[] = "2\nT\0T\nTitle\nN1\n";
	struct report_store store;
	struct menu *m;

	(void)state;
	report_store_init(&store);
	assert_int_equal(menu_parse(&m, text, sizeof text - 1, "x", &store.report), ST_INPUT);
	assert_non_null(strstr(store.error, "line 2: byte 2 is 0x00"));
}

/* n menus in each other, each with one leaf beside the next. */
static enum status parse_deep(int n, struct menu **m)
{
	struct text t = { 0 };

	for (int k = 0; k < n; k++)
		text_addf(&t, "2\nM\nM\nN%d\n1\nA\nV1\n", k);
	text_addf(&t, "1\nB\nV2\n0\nEND MENU\n");
	enum status st = menu_parse(m, t.s, t.n, "deep", NULL);
	text_finish(&t);
	return st;
}

static void depth_and_width_have_limits(void **state)
{
	struct menu *m;
	struct text t = { 0 };

	(void)state;
	assert_int_equal(parse_deep(MENU_DEPTH_MAX, &m), ST_OK);
	menu_destroy(m);
	assert_int_equal(parse_deep(MENU_DEPTH_MAX + 2, &m), ST_INPUT);
	assert_null(m);
	text_add(&t, "14\nT\nTitle\nN1\n");
	for (int k = 0; k < MENU_SUB_MAX; k++)
		text_addf(&t, "1\n%d\nV%d\n", k, k);
	text_add(&t, "0\nEND MENU\n");
	assert_int_equal(menu_parse(&m, t.s, t.n, "wide", NULL), ST_OK);
	assert_int_equal(m->top->n_sub, MENU_SUB_MAX);
	menu_destroy(m);
	text_finish(&t);
}

static void a_file_cut_anywhere_is_refused(void **state)
{
	(void)state;
	/* up to the last letter of END MENU every beginning is too short */
	for (size_t n = 0; n < sizeof sample - 2; n++) {
		struct menu *m;

		assert_int_equal(menu_parse(&m, sample, n, "cut", NULL), ST_INPUT);
		assert_null(m);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_menu_becomes_a_tree),
		cmocka_unit_test(entries_are_found_and_walked),
		cmocka_unit_test(what_is_written_reads_the_same),
		cmocka_unit_test(ends_of_lines_and_files_do_not_matter),
		cmocka_unit_test(broken_files_are_refused),
		cmocka_unit_test(a_zero_byte_is_no_text),
		cmocka_unit_test(depth_and_width_have_limits),
		cmocka_unit_test(a_file_cut_anywhere_is_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
