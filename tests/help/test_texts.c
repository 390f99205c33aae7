/* test_texts.c - the texts of the program: found, searched, replaced by the user's, printed. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "file.h"
#include "help.h"
#include "path.h"

static struct help *read_help(const char *const *own, size_t n)
{
	struct help *h;
	struct report_store store;

	report_store_init(&store);
	if (help_read(&h, getenv("BATTEN_HELP"), own, n, &store.report) != ST_OK)
		fail_msg("%s", store.error);
	return h;
}

static void every_entry_has_its_text(void **state)
{
	struct help *h = read_help(NULL, 0);
	struct menu_set set;
	size_t n = 0;

	(void)state;
	assert_int_equal(menu_set_read(&set, NULL, 0, NULL), ST_OK);
	for (int k = 0; k < N_MENUS; k++)
		for (const struct Menu_Entry *e = set.menu[k]->top; e; e = menu_next(e), n++) {
			const struct help_text *t = help_find(h, e->index);

			assert_non_null(t);
			assert_string_equal(t->code, e->index);
			assert_true(strlen(t->purpose) > 30);
			assert_int_equal(*t->example != 0, menu_is_leaf(e));
		}
	assert_int_equal(help_count(h), n);
	assert_string_equal(help_at(h, 0)->code, "N0");
	assert_string_equal(help_at(h, n - 1)->code, "V189");
	assert_null(help_find(h, "V9999"));
	assert_string_equal(help_find(h, "v79")->code, "V79");
	assert_null(help_complaint(h));
	menu_set_finish(&set);
	help_destroy(h);
}

static void what_is_looked_for_comes_first(void **state)
{
	static const struct {
		const char *words, *first;
	} cases[] = {
		{ "V90", "V90" },
		{ "n31", "N31" },
		{ "undo", "V182" },
		{ "list jobs", "V162" },
		{ "gaussian", "V80" },
		{ "isophote calculate", "V90" },
		{ "mirror", "V184" },
		{ "light source", "V73" },
		{ "bell", "V167" },
		{ "all curvatures", "V79" },
		{ "CURVATURE", "N31" },
		{ "quit fairing", "V156" },
		{ "degree raise surface", "V128" },
	};
	struct help *h = read_help(NULL, 0);
	struct menu_set set;

	(void)state;
	assert_int_equal(menu_set_read(&set, NULL, 0, NULL), ST_OK);
	for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
		struct help_hit hits[8];
		size_t n = help_search(h, &set, cases[k].words, hits, 8);

		if (!n || strcmp(hits[0].text->code, cases[k].first) != 0)
			fail_msg("'%s': %s, expected %s", cases[k].words,
			         n ? hits[0].text->code : "nothing", cases[k].first);
		for (size_t i = 1; i < n && i < 8; i++)
			assert_true(hits[i].score <= hits[i - 1].score);
	}
	menu_set_finish(&set);
	help_destroy(h);
}

static void all_words_must_occur(void **state)
{
	struct help *h = read_help(NULL, 0);
	struct help_hit hits[4];

	(void)state;
	assert_int_equal(help_search(h, NULL, "porcupine xyzzy", hits, 4), 0);
	assert_int_equal(help_search(h, NULL, "", hits, 4), 0);
	assert_int_equal(help_search(h, NULL, "  \t ", hits, 4), 0);
	assert_true(help_search(h, NULL, "porcupine", hits, 4) >
	            help_search(h, NULL, "porcupine scale", hits, 4));
	/* more found than there is room for, and none written without room */
	assert_true(help_search(h, NULL, "curve", NULL, 0) > 4);
	help_destroy(h);
}

/* Of the name or the title; other letters, letters left out, put in and swapped, other words behind. */
static void the_nearest_are_near(void **state)
{
	static const struct {
		const char *typed;
		int changes; /* of letters */
		const char *word;
	} cases[] = {
		{ "gausian", 1, "GAUSSIAN" },       { "Isofotes", 2, "ISOPHOTES" },
		{ "reflektion", 1, "REFLECT" },     { "segmnetation", 2, "SEGMENTATION" },
		{ "  porcupyne ", 1, "PORCUPINE" }, { "GAUSSIAN", 0, "GAUSSIAN" },
	};
	struct help *h = read_help(NULL, 0);
	struct menu_set set;
	struct help_hit hits[2];

	(void)state;
	assert_int_equal(menu_set_read(&set, NULL, 0, NULL), ST_OK);
	for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
		assert_int_equal(help_nearest(h, &set, cases[k].typed, hits, 2), 2);
		const char *code = hits[0].text->code;
		if (hits[0].score != -cases[k].changes ||
		    (!strcasestr(hits[0].text->title, cases[k].word) &&
		     !strcasestr(menu_set_find(&set, code, NULL)->name, cases[k].word)))
			fail_msg("'%s': %s %s, %d", cases[k].typed, code, hits[0].text->title,
			         hits[0].score);
		assert_true(hits[1].score <= hits[0].score);
		assert_string_not_equal(hits[1].text->code, code);
	}
	char long_one[501] = { 0 };
	memset(long_one, 'x', 500);
	assert_int_equal(help_nearest(h, &set, long_one, hits, 2), 2);
	assert_int_equal(help_nearest(h, NULL, "zzzzqq", hits, 2), 2);
	assert_int_equal(help_nearest(h, NULL, "zzzzqq", NULL, 0), 0);
	assert_int_equal(help_nearest(h, NULL, "", hits, 2), 0);
	assert_int_equal(help_nearest(h, NULL, " \t ", hits, 2), 0);
	menu_set_finish(&set);
	help_destroy(h);
}

static void a_page_fits_its_width(void **state)
{
	struct help *h = read_help(NULL, 0);

	(void)state;
	for (size_t k = 0; k < help_count(h); k++) {
		char *page = help_print(h, help_at(h, k), 72), *rest;

		assert_non_null(page);
		assert_null(strstr(page, "\n\n\n"));
		bool script = false;
		for (char *line = strtok_r(page, "\n", &rest); line;
		     line = strtok_r(NULL, "\n", &rest)) {
			size_t columns = 0;
			for (const char *p = line; *p; p++)
				columns += (*p & 0xc0) != 0x80;
			script = strcmp(line, "In a script") ? script && line[0] == ' ' : true;
			if (columns > 72 && !script)
				fail_msg("%s: '%s'", help_at(h, k)->code, line);
		}
		free(page);
	}
	help_destroy(h);
}

static void a_page_of_the_window_has_sections(void **state)
{
	struct help *h = read_help(NULL, 0);
	char *page = help_page(h, help_find(h, "V99"));

	(void)state;
	assert_non_null(strstr(page, "\n\nArguments\non\tyes or no\tdraw it or not; "));
	assert_non_null(strstr(page, "\n\nResult\nThe surface is in the view or out of it.\n"));
	assert_non_null(
	        strstr(page, "\n\nExample\nV99 on=no\n\nSee also\nV48 Draw the curve\nV159 "));
	free(page);
	page = help_page(h, help_find(h, "N31"));
	assert_null(strstr(page, "Arguments\n"));
	assert_null(strstr(page, "Result\n"));
	assert_non_null(strstr(page, "\n\nSee also\nV79 "));
	free(page);
	/* a comma would end a link in the window, a tab a cell */
	for (size_t k = 0; k < help_count(h); k++)
		assert_null(strpbrk(help_at(h, k)->title, ",\t"));
	help_destroy(h);
}

static char *put(const char *folder, const char *name, const char *text, size_t n)
{
	char *path = path_join(folder, name);

	assert_int_equal(file_write(path, text, n, NULL), ST_OK);
	return path;
}

static void own_texts_replace_and_add(void **state)
{
	static const char good[] =
	        "@V79 Ours\nOurs.\n:result\nR.\n:example\nV79\n@N900 Yard\nOur menu.\n";
	static const char bad[] = "@V80 Half\n";
	char folder[] = "/tmp/batten-help-XXXXXX";

	(void)state;
	assert_non_null(mkdtemp(folder));
	char *first = put(folder, "good", good, strlen(good)),
	     *second = put(folder, "bad", bad, strlen(bad));
	const char *own[] = { "/nonexistent/own.help", first, second };
	struct help *plain = read_help(NULL, 0), *h = read_help(own, 3);

	assert_int_equal(help_count(h), help_count(plain) + 1);
	assert_string_equal(help_find(h, "V79")->title, "Ours");
	assert_string_equal(help_find(h, "N900")->purpose, "Our menu.");
	assert_string_equal(help_find(h, "V80")->title, help_find(plain, "V80")->title);
	assert_non_null(strstr(help_complaint(h), "bad' line 1: V80 has no a text"));
	for (size_t k = 1; k < help_count(h); k++)
		assert_string_not_equal(help_at(h, k - 1)->code, help_at(h, k)->code);
	help_destroy(h);
	help_destroy(plain);
	unlink(first);
	unlink(second);
	rmdir(folder);
	free(first);
	free(second);
}

/* A program and help files that are not of one make. */
static void files_of_another_version_are_refused(void **state)
{
	static const char *const names[] = { "batten.msg", "batten.ptr" };
	char folder[] = "/tmp/batten-help-XXXXXX", *text[2], *path[2];
	size_t n[2];

	(void)state;
	assert_non_null(mkdtemp(folder));
	for (int k = 0; k < 2; k++) {
		char *from = path_join(getenv("BATTEN_HELP"), names[k]);
		assert_int_equal(file_read(from, 1 << 24, &text[k], &n[k], NULL), ST_OK);
		free(from);
		path[k] = put(folder, names[k], text[k], n[k]);
	}
	for (int what = 0; what < 4; what++) {
		struct report_store store;
		struct help *h;
		size_t n_m = n[0], n_p = n[1];
		char *p = memcpy(malloc(n[1] + 1), text[1], n[1] + 1);

		report_store_init(&store);
		if (what == 1)
			n_m /= 2; /* texts cut short */
		if (what == 2)
			n_p /= 2; /* pointers cut short */
		if (what == 3)
			*strstr(p, "\nV79 ") = ' '; /* a text that is not there */
		free(put(folder, names[0], text[0], n_m));
		free(put(folder, names[1], p, n_p));
		assert_int_equal(help_read(&h, folder, NULL, 0, &store.report),
		                 what ? ST_INPUT : ST_OK);
		if (what)
			assert_non_null(strstr(store.error, "install it again"));
		help_destroy(h);
		free(p);
	}
	for (int k = 0; k < 2; k++) {
		unlink(path[k]);
		free(path[k]);
		free(text[k]);
	}
	struct help *h;
	assert_int_equal(help_read(&h, folder, NULL, 0, NULL), ST_INPUT);
	rmdir(folder);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(every_entry_has_its_text),
		cmocka_unit_test(what_is_looked_for_comes_first),
		cmocka_unit_test(all_words_must_occur),
		cmocka_unit_test(the_nearest_are_near),
		cmocka_unit_test(a_page_fits_its_width),
		cmocka_unit_test(a_page_of_the_window_has_sections),
		cmocka_unit_test(own_texts_replace_and_add),
		cmocka_unit_test(files_of_another_version_are_refused),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
