/* test_panel_text.c - texts of help taken apart, and what is said of a job. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cmocka_all.h"
#include "help_text.h"
#include "job_text.h"
#include "panel.h"

/* Blocks as letters with their texts: "p purpose text|h Head|r a/b/c|..." */
static void blocks(struct text *out, const char *text)
{
	static const char letter[] = ".hprel";
	struct help_reader r;
	enum help_block b;
	help_reader_init(&r, text);
	while ((b = help_reader_next(&r)) != HELP_END) {
		text_addf(out, "%s%c %s", out->n ? "|" : "", letter[b], r.text.s);
		if (b == HELP_ROW || (b == HELP_LINK && r.value.n))
			text_addf(out, "/%s", r.value.s ? r.value.s : "");
		if (b == HELP_ROW && r.meaning.n)
			text_addf(out, "/%s", r.meaning.s);
	}
	help_reader_finish(&r);
}

static void test_blocks(void **state)
{
	static const struct {
		const char *text, *blocks;
	} cases[] = {
		{ NULL, "" },
		{ "", "" },
		{ "\n\n \n", "" },
		{ "One\ntwo\n\nthree", "p One two|p three" },
		{ "purpose\nWhat.\nresult\nA thing.", "p What.|h What comes out|p A thing." },
		{ "Purpose:\nWhat.\n\nResult:\nA thing.", "p What.|h What comes out|p A thing." },
		{ "arguments\na  1 m  the way\nb\t2", "h What it asks for|r a/1 m/the way|r b/2" },
		{ "ARGUMENTS\na  1  the\n   way\n   out\nb",
		  "h What it asks for|r a/1/the way out|r b/" },
		{ "example\n  V80 a=1\n\n  V81  b\nsee also\nV81",
		  "h In a script|e V80 a=1\nV81  b|h See also|l V81" },
		{ "see also\nV81 MEAN, V84 MINIMUM  PRINCIPLE\nV90",
		  "h See also|l V81/MEAN|l V84/MINIMUM  PRINCIPLE|l V90" },
		{ "see also\n,, ,V1,\n", "h See also|l V1" },
		{ "example\nV1 a=b\n:see V1 V2", "h In a script|e V1 a=b|h See also|l V1|l V2" },
		{ "see V1 there", "p see V1 there" },
		{ ":result A thing", "h What comes out|p A thing" },
		{ ":seen V1", "p :seen V1" },
		{ ":see\nV1 N20 V3 NAME V OF V4 V5, V6",
		  "h See also|l V1|l N20|l V3/NAME V OF|l V4|l V5|l V6" },
		{ ":arguments\nfile | a name | what\n| b | c",
		  "h What it asks for|r file/a name/what|r | b/c" },
		{ "arguments\na | b|c | d\ne |", "h What it asks for|r a/b|c/d|r e/" },
		{ "Text.\n\nHow to read it:\n\nSlowly.", "p Text.|h How to read it|p Slowly." },
		{ "It says:\nthis, and so on.", "p It says: this, and so on." },
		{ "purposes\nof it", "p purposes of it" },
		{ "arguments", "h What it asks for" },
	};
	(void)state;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		struct text out = { 0 };
		blocks(&out, cases[i].text);
		assert_string_equal(out.s ? out.s : "", cases[i].blocks);
		text_finish(&out);
	}
}

/* Any beginning and any end of a text is a text. */
static void test_pieces(void **state)
{
	static const char whole[] =
	        "purpose\nA b.\n\narguments\nx  1  y\n  z\nexample\nV1\nsee also\nV2 A, V3 B";
	(void)state;
	for (size_t n = 0; n < sizeof whole; n++) {
		struct text a = { 0 }, b = { 0 };
		char *head = strndup(whole, n);
		blocks(&a, head);
		blocks(&b, whole + n);
		assert_false(a.failed || b.failed);
		assert_true(n < 10 || a.n > 0);
		text_finish(&a);
		text_finish(&b);
		free(head);
	}
}

static void test_links(void **state)
{
	static const char text[] = "What.\n\nsee also\nV81 MEAN, N5\nV174 SEGMENTATION";
	static const char *const codes[] = { "V81", "N5", "V174" };
	char code[8], small[3];
	(void)state;
	for (int i = 0; i < 3; i++) {
		assert_true(panel_help_link(text, i, code, sizeof code));
		assert_string_equal(code, codes[i]);
	}
	assert_false(panel_help_link(text, 3, code, sizeof code));
	assert_false(panel_help_link(text, -1, code, sizeof code));
	assert_false(panel_help_link(text, 0, small, sizeof small));
	assert_false(panel_help_link(NULL, 0, code, sizeof code));
}

static void test_times(void **state)
{
	static const struct {
		double seconds;
		const char *text;
	} cases[] = { { 0, "0:00" },      { 0.9, "0:00" },       { 59.9, "0:59" },
		      { 84, "1:24" },     { 3599, "59:59" },     { 3600, "1 h 00" },
		      { 7810, "2 h 10" }, { 172799, "47 h 59" }, { 172800, "2 days" },
		      { -1, "" },         { NAN, "" },           { INFINITY, "" },
		      { 1e300, "" } };
	(void)state;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		char text[JOB_TEXT];
		job_time(text, cases[i].seconds);
		assert_string_equal(text, cases[i].text);
	}
}

static void test_says(void **state)
{
	static struct job_output output = { "/a/b/lid.shade.exr", "image", NULL };
	static char why[] = "after 21", phase[] = "tile", path[] = "hulls/lid.base";
	static const struct {
		struct Stats s;
		const char *text;
	} cases[] = {
		{ { .state = JOB_QUEUED, .reason = why }, "after 21" },
		{ { .state = JOB_QUEUED, .submitted = 1000 }, "waits since 0:41" },
		{ { .state = JOB_RUNNING, .threads = 8, .phase = phase, .done = 3, .total = 9 },
		  "8 threads, tile 3 of 9" },
		{ { .state = JOB_RUNNING, .threads = 1, .done = 3, .total = 9 },
		  "1 thread, unit 3 of 9" },
		{ { .state = JOB_RUNNING, .threads = 2 }, "2 threads" },
		{ { .state = JOB_RUNNING }, "" },
		{ { .state = JOB_DONE, .outputs = &output, .n_outputs = 1, .wall_s = 41 },
		  "lid.shade.exr, 0:41" },
		{ { .state = JOB_DONE, .wall_s = NAN }, "done" },
		{ { .state = JOB_FAILED, .reason = why, .done = 1, .total = 2 }, "after 21" },
	};
	char text[JOB_TEXT];
	(void)state;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		job_says(text, &cases[i].s, 1041);
		assert_string_equal(text, cases[i].text);
	}
	const struct Stats named = { .file_name = path };
	assert_string_equal(job_file(&named), "lid.base");
	const struct Stats bare = { .state = JOB_QUEUED };
	assert_string_equal(job_file(&bare), "");
	job_clock(text, NAN);
	assert_string_equal(text, "");
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_blocks), cmocka_unit_test(test_pieces),
		cmocka_unit_test(test_links),  cmocka_unit_test(test_times),
		cmocka_unit_test(test_says),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
