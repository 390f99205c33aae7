/* test_invocation.c - a command line is taken apart by its verb's rows. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "command.h"

static const struct option_row rows[] = {
	{ "--into", "-i", "DIR", "" },
	{ "--all", NULL, NULL, "" },
	{ 0 },
};

static bool takes_value(const struct invocation *i, const char *option)
{
	(void)i;
	return strcmp(option, "png") != 0;
}

static const struct command strict = { .name = "strict", .options = rows };
static const struct command open_one = { .name = "open",
	                                 .options = rows,
	                                 .takes_value = takes_value };

/* A row: the words given, and what is to come of them. */
struct row {
	const struct command *command;
	const char *given[8];
	enum status status;
	const char *into;
	bool all;
	const char *words[4];
	const char *extra[5];
};

static const struct row table[] = {
	{ &strict, { 0 }, ST_OK, NULL, false, { 0 }, { 0 } },
	{ &strict, { "a", "--into", "d", "b" }, ST_OK, "d", false, { "a", "b" }, { 0 } },
	{ &strict, { "--into=d", "--all" }, ST_OK, "d", true, { 0 }, { 0 } },
	{ &strict, { "-i", "-1.5" }, ST_OK, "-1.5", false, { 0 }, { 0 } },
	{ &strict, { "-1.5", "-.5", "-" }, ST_OK, NULL, false, { "-1.5", "-.5", "-" }, { 0 } },
	{ &strict, { "--", "--all", "-x" }, ST_OK, NULL, false, { "--all", "-x" }, { 0 } },
	{ &strict, { "--into" }, ST_PARAMETER, NULL, false, { 0 }, { 0 } },
	{ &strict, { "--all=yes" }, ST_PARAMETER, NULL, false, { 0 }, { 0 } },
	{ &strict, { "--grid", "1x1" }, ST_PARAMETER, NULL, false, { 0 }, { 0 } },
	{ &strict, { "--color", "blue" }, ST_PARAMETER, NULL, false, { 0 }, { 0 } },
	{ &open_one, { "--grid", "1x1" }, ST_OK, NULL, false, { 0 }, { "grid", "1x1" } },
	{ &open_one, { "--png", "a" }, ST_OK, NULL, false, { "a" }, { "png", "yes" } },
	{ &open_one, { "--png=no" }, ST_OK, NULL, false, { 0 }, { "png", "no" } },
	{ &open_one,
	  { "--grid=1x1", "--png" },
	  ST_OK,
	  NULL,
	  false,
	  { 0 },
	  { "grid", "1x1", "png", "yes" } },
	{ &open_one, { "--grid" }, ST_PARAMETER, NULL, false, { 0 }, { 0 } },
	{ &open_one,
	  { "--color", "#102030", "--color=never" },
	  ST_OK,
	  NULL,
	  false,
	  { 0 },
	  { "color", "#102030" } },
	{ &strict, { "--color", "#102030" }, ST_PARAMETER, NULL, false, { 0 }, { 0 } },
	{ &open_one, { "-x" }, ST_PARAMETER, NULL, false, { 0 }, { 0 } },
};

static void check(const struct row *row)
{
	struct report_store store;
	struct invocation i = { 0 };
	int n = 0;

	while (row->given[n])
		n++;
	report_store_init(&store);
	i.report = store.report;
	assert_int_equal(invocation_parse(&i, row->command, n, (char **)(uintptr_t)row->given),
	                 row->status);
	assert_int_equal(store.n_errors, row->status != ST_OK);
	if (row->status == ST_OK) {
		const char *into = invocation_value(&i, "--into");
		assert_true(into ? row->into && !strcmp(into, row->into) : !row->into);
		assert_int_equal(invocation_flag(&i, "--all"), row->all);
		for (n = 0; row->words[n]; n++)
			assert_string_equal(i.words[n], row->words[n]);
		assert_int_equal(i.n_words, n);
		for (n = 0; row->extra[n]; n++)
			assert_string_equal(i.extra[n], row->extra[n]);
		assert_int_equal(2 * i.n_extra, n);
	}
	invocation_finish(&i);
}

static void lines_are_taken_apart(void **state)
{
	(void)state;
	for (size_t k = 0; k < sizeof table / sizeof *table; k++)
		check(&table[k]);
}

static void whole_numbers(void **state)
{
	static const struct option_row number_rows[] = { { "--to", NULL, "N", "" }, { 0 } };
	static const struct command c = { .name = "number", .options = number_rows };
	static const struct {
		const char *text;
		enum status status;
		long value;
	} cases[] = { { "5", ST_OK, 5 },          { "-5", ST_OK, -5 },
		      { "6", ST_PARAMETER, 0 },   { "x", ST_PARAMETER, 0 },
		      { "1.0", ST_PARAMETER, 0 }, { "", ST_PARAMETER, 0 } };

	(void)state;
	for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
		const char *given[] = { "--to", cases[k].text };
		struct invocation i = { 0 };
		long got = 0;
		assert_int_equal(invocation_parse(&i, &c, 2, (char **)(uintptr_t)given), ST_OK);
		assert_int_equal(invocation_integer(&i, "--to", -5, 5, 1, &got), cases[k].status);
		assert_int_equal(got, cases[k].value);
		invocation_finish(&i);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(lines_are_taken_apart),
		cmocka_unit_test(whole_numbers),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
