/* test_source.c - the help source: read, written again, and refused with the line where it breaks. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "source.h"

#define FIRST "@V7 A title\nOne line\nof text.\n\nTwo.\n"
#define REST  ":result\nR.\n:example\nV7\n"

static void a_text_has_parts(void **state)
{
	static const char text[] = "# comment\n" FIRST ":arguments\ngrid | NxM, 1 to 9 | how many\n"
	                           "  of them | and more\nto-end|a file|x\n:result\nIt.\n"
	                           ":example\nV7 grid=2x2\nV7\n:see V1 N2\n@N2 Menu\r\nM.\r\n";
	struct help_source s = { 0 };
	const struct help_text *t;

	(void)state;
	assert_int_equal(help_source_parse(&s, text, strlen(text), "x", NULL), ST_OK);
	assert_int_equal(s.n, 2);
	t = &s.texts[0];
	assert_string_equal(t->code, "V7");
	assert_string_equal(t->title, "A title");
	assert_string_equal(t->purpose, "One line of text.\n\nTwo.");
	assert_int_equal(t->n_arguments, 2);
	assert_string_equal(t->arguments[0].name, "grid");
	assert_string_equal(t->arguments[0].range, "NxM, 1 to 9");
	assert_string_equal(t->arguments[0].meaning, "how many of them | and more");
	assert_string_equal(t->arguments[1].name, "to-end");
	assert_string_equal(t->result, "It.");
	assert_string_equal(t->example, "V7 grid=2x2\nV7");
	assert_string_equal(t->see, "V1 N2");
	assert_int_equal(t->line, 2);
	t = &s.texts[1];
	assert_string_equal(t->title, "Menu");
	assert_string_equal(t->purpose, "M.");
	assert_string_equal(t->see, "");
	help_source_finish(&s);
}

static void canonical_form_reads_the_same(void **state)
{
	static const char text[] = FIRST ":arguments\na | b | c\n" REST ":see V1\n@N1 T\nX\n";
	struct help_source s = { 0 }, again = { 0 };
	struct text once = { 0 }, twice = { 0 };

	(void)state;
	assert_int_equal(help_source_parse(&s, text, strlen(text), "x", NULL), ST_OK);
	for (size_t k = 0; k < s.n; k++)
		help_text_write(&s.texts[k], &once);
	assert_int_equal(help_source_parse(&again, once.s, once.n, "x", NULL), ST_OK);
	for (size_t k = 0; k < again.n; k++)
		help_text_write(&again.texts[k], &twice);
	assert_string_equal(once.s, twice.s);
	text_finish(&once);
	text_finish(&twice);
	help_source_finish(&s);
	help_source_finish(&again);
}

static void broken_sources_are_refused(void **state)
{
	static const struct {
		const char *text;
		int line;
		const char *says;
	} cases[] = {
		{ "words\n", 1, "before the first text" },
		{ ":result\n", 1, "before the first text" },
		{ "@\n", 1, "expected @, an index and a title" },
		{ "@V7\n", 1, "expected @, an index and a title" },
		{ "@V7 \n", 1, "expected @, an index and a title" },
		{ "@X7 Title\n", 1, "expected an index as V79 or N31" },
		{ "@V07 Title\n", 1, "expected an index" },
		{ "@V12345 Title\n", 1, "expected an index" },
		{ "@V7x Title\n", 1, "expected an index" },
		{ "#\n@V7 Title\n" REST, 2, "V7 has no a text" },
		{ FIRST, 1, "V7 has no :result" },
		{ FIRST ":result\n:example\nV7\n", 1, "V7 has no :result" },
		{ FIRST ":result\nR\n", 1, "V7 has no :example" },
		{ FIRST REST "@N1 Title\n", 10, "N1 has no a text" },
		{ "@N1 T\nP\n" REST, 1, "N1 is a menu, which has no :result" },
		{ "@N1 T\nP\n:arguments\na | b | c\n", 1, "which has no :arguments" },
		{ FIRST REST ":result\nR\n", 10, "found :result after a part that comes behind" },
		{ FIRST ":result\nR\n:result\nR\n", 8, "found :result after" },
		{ FIRST ":results\n", 6, "found ':results', expected :arguments" },
		{ FIRST ":\n", 6, "found ':'" },
		{ FIRST ":result now\n", 6, "found more behind :result" },
		{ FIRST REST ":see\n", 10, "found :see without an index" },
		{ FIRST REST ":see V1,V2\n", 10, "found 'V1,V2', expected indices" },
		{ FIRST REST ":see V1  V2\n", 10, "found '', expected indices" },
		{ FIRST REST ":see V1\nmore\n", 11, "found more behind :see" },
		{ FIRST ":arguments\ngrid\n", 7, "found 'grid', expected NAME | RANGE | MEANING" },
		{ FIRST ":arguments\na | b\n", 7, "expected NAME | RANGE | MEANING" },
		{ FIRST ":arguments\n  a | b\n", 7, "expected NAME | RANGE | MEANING" },
		{ FIRST ":arguments\nA | b | c\n", 7, "found the argument 'A'" },
		{ FIRST ":arguments\n | b | c\n", 7, "found the argument ''" },
		{ FIRST ":arguments\na |  | c\n", 7, "'a' has no range or no meaning" },
		{ FIRST ":arguments\na | b |\n", 7, "'a' has no range or no meaning" },
		{ FIRST ":arguments\na | b | c\na | b | c\n", 8, "'a' a second time" },
		{ FIRST REST FIRST REST, 10, "found V7 a second time (the first is in line 1)" },
		{ "@V7 A\ttab\n", 1, "byte 6 is 0x09" },
		{ "@V7 A\nb\x1b[0m\n", 2, "byte 2 is 0x1b" },
	};

	(void)state;
	for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
		struct help_source s = { 0 };
		struct report_store store;
		char at[64];

		report_store_init(&store);
		assert_int_equal(help_source_parse(&s, cases[k].text, strlen(cases[k].text),
		                                   "x.help", &store.report),
		                 ST_INPUT);
		assert_int_equal(store.n_errors, 1);
		snprintf(at, sizeof at, "cannot read help 'x.help' line %d: ", cases[k].line);
		if (strncmp(store.error, at, strlen(at)) || !strstr(store.error, cases[k].says))
			fail_msg("case %zu: '%s', expected line %d and '%s'", k, store.error,
			         cases[k].line, cases[k].says);
		help_source_finish(&s);
	}
}

static void too_many_arguments_are_refused(void **state)
{
	struct help_source s = { 0 };
	struct report_store store;
	struct text t = { 0 };

	(void)state;
	report_store_init(&store);
	text_add(&t, FIRST ":arguments\n");
	for (int k = 0; k <= HELP_ARGUMENTS_MAX; k++)
		text_addf(&t, "a%d | b | c\n", k);
	assert_int_equal(help_source_parse(&s, t.s, t.n, "x", &store.report), ST_INPUT);
	assert_non_null(strstr(store.error, "more than 32 arguments"));
	text_finish(&t);
	help_source_finish(&s);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(a_text_has_parts),
		cmocka_unit_test(canonical_form_reads_the_same),
		cmocka_unit_test(broken_sources_are_refused),
		cmocka_unit_test(too_many_arguments_are_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
