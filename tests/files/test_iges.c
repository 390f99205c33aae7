/* test_iges.c - IGES files: lines, headers, counts, what never ends. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "iges_made.h"

static void headers_and_their_faults(void **state)
{
	static const struct {
		const char *global, *unit;
		double mm, scale;
		const char *warning;
	} rows[] = {
		{ "1H,,1H;,,,,,32,38,6,308,15,,1.,6,1HM;", "m", 1000, 1, NULL },
		{ "1H,,1H;,,,,,,,,,,,,2;", "mm", 1, 1, NULL },
		{ ",,,,,,,,,,,,1.D0,10,2HCM;", "cm", 10, 1, NULL },
		{ "1H,,1H;,,,,,,,,,,,.125,4,2HFT;", "ft", 304.8, 0.125, "scale of 0.125" },
		{ "1H,,1H;,,,,,,,,,,,1.,3,5Hcubit;", "cubit", 0, 1, NULL },
		{ "1H,,1H;,,,,,,,,,,,1.,3,2HMM;", "mm", 1, 1, NULL },
		{ "1H,,1H;,,,,,,,,,,,1.,,4HINCH;", "in", 25.4, 1, NULL },
		{ "1H,,1H;,,,,,,,,,,,1.,2,1HM;", "mm", 1, 1, "flag is taken" },
		{ "1H,,1H;,,,,,,,,,,,1.,77,;", "in", 25.4, 1, "standard's default" },
		{ "1H,,1H;;", "in", 25.4, 1, "standard's default" },
		{ "1H,,1H;,,,,,,,,,,,2,2HMM,1;", "mm", 1, 2, "in the place of the unit flag" },
		{ "1H,,1H;,,5Hx,y;z,,,,,,,,,1.,6,1HM;", "m", 1000, 1, NULL },
		{ "1H,,1H;,,3Hshort,,,,,,,,,1.,2,2HMM;", "mm", 1, 1, "not as long as it says" },
		{ "1H,,1H;,,999999Hlong,,,,,,,,,1.,2,2HMM;", "in", 25.4, 1,
		  "not as long as it says" },
		{ "1H,,1H;,,,,,,,,,,,-3.,2,2HMM;", "mm", 1, 1, "no positive number" },
		{ "1H1,1H,,,,", "in", 25.4, 1, "standard's default" },
		{ "garbage", "in", 25.4, 1, "standard's default" },
		{ "", "in", 25.4, 1, "no header" },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		const struct made_entity entities[MADE_MAX] = { { 128, 0, SQUARE } };
		struct made_file f = { .global = rows[i].global };
		struct model m;
		struct report_store store;
		bool said = !rows[i].warning;
		assert_int_equal(read_made(&m, &f, entities, &store), ST_OK);
		if ((!m.unit || strcmp(m.unit, rows[i].unit) != 0 || m.unit_in_mm != rows[i].mm ||
		     m.scale != rows[i].scale))
			fail_msg("row %zu: %s %g scale %g", i, m.unit ? m.unit : "-", m.unit_in_mm,
			         m.scale);
		for (int k = 0; k < m.n_warnings; k++)
			said |= rows[i].warning && strstr(m.warnings[k], rows[i].warning);
		if (!said || (!rows[i].warning && m.n_warnings))
			fail_msg("row %zu: %s", i, m.n_warnings ? m.warnings[0] : "no warning");
		model_finish(&m);
	}
}

static void files_as_programs_write_them(void **state)
{
	static const struct {
		const char *what;
		struct made_file file;
	} rows[] = {
		{ "plain", { 0 } },
		{ "CRLF", { .line_end = "\r\n" } },
		{ "lone CR", { .line_end = "\r" } },
		{ "lines of 80 without ends", { .line_end = "" } },
		{ "empty lines between", { .line_end = "\n\n" } },
		{ "blanks behind", { .line_end = "  \n" } },
		{ "columns beyond 80", { .line_end = " REV 3\n" } },
		{ "numbers cut at line ends", { .columns = 7 } },
		{ "one character a line", { .columns = 1 } },
		{ "sequence numbers from 100", { .sequence = 100 } },
		{ "no pointers back", { .no_back_pointers = true } },
		{ "wrong pointers to the data", { .bad_data_pointers = true } },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		struct model m;
		struct report_store store;
		if (read_made(&m, &rows[i].file, standard, &store) != ST_OK)
			fail_msg("%s: %s", rows[i].what, store.error);
		assert_standard(&m, rows[i].what);
		model_finish(&m);
	}
}

static void whole_files_refused(void **state)
{
	static const struct {
		struct made_file file;
		struct made_entity entities[MADE_MAX];
		const char *sentence;
	} rows[] = {
		{ { .no_terminate = true }, { { 128, 0, SQUARE } }, "cut short" },
		{ { .letter = 'C' }, { { 128, 0, SQUARE } }, "compressed" },
		{ { .letter = 'B' }, { { 128, 0, SQUARE } }, "binary" },
		{ { 0 }, { { 0 } }, "no entities" },
		{ { 0 }, { { 144, 0, "144,7,1,0,0;" } }, "first thing skipped is D1 of type 144" },
		{ { 0 }, { { 126, 0, "126;" } }, "first thing skipped is D1 of type 126" },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		struct model m;
		struct report_store store;
		assert_int_equal(read_made(&m, &rows[i].file, rows[i].entities, &store), ST_INPUT);
		assert_int_equal(store.n_errors, 1);
		if (!strstr(store.error, rows[i].sentence))
			fail_msg("row %zu: %s", i, store.error);
		model_finish(&m);
	}
	assert_false(iges_recognise("", 0));
	assert_false(iges_recognise("batten base 1\n", 14));
}

/* Curves that others are made of keep their entry but get no number. */
static void parts_are_not_counted(void **state)
{
	static const struct made_entity entities[MADE_MAX] = {
		{ 110, 0, "110,0.,0.,0.,1.,0.,0.;" },
		{ 128, 0, SQUARE },
		{ 142, 0, "142,0,3,9,11,2;" },
		{ 144, 0, "144,3,1,0,5;" },
		{ 126, 0, QUARTER },
		{ 102, 0, "102,1,13;" },
		{ 110, 0, "110,0.,0.,0.,1.,0.,0.;" },
		{ 110, 0, "110,0.,0.,0.,2.,0.,0.;" },
	};
	static const int numbers[] = { 1, 2, 0, 0, 0, 3 };
	const struct made_file f = { 0 };
	struct model m;
	struct report_store store;
	struct entity *e;
	(void)state;
	assert_int_equal(read_made(&m, &f, entities, &store), ST_OK);
	assert_int_equal(m.n, 6);
	for (int i = 0; i < 6; i++)
		assert_int_equal(m.entities[i].number, numbers[i]);
	assert_int_equal(m.entities[1].trims, 1);
	assert_int_equal(model_find(&m, "D13", &e, NULL), ST_OK);
	assert_int_equal(e->number, 0);
	assert_int_equal(model_find(&m, "D7", &e, NULL), ST_OK);
	assert_int_equal(e->number, 2);
	model_finish(&m);
}

static void stops_when_told(void **state)
{
	const struct made_file f = { 0 };
	struct text parameters = { 0 }, t = { 0 };
	atomic_bool stop;
	struct progress p = { .stop = &stop };
	struct model m;
	(void)state;
	atomic_init(&stop, true);
	text_add(&parameters, "106,2,100000");
	for (int i = 0; i < 100000; i++)
		text_addf(&parameters, ",%d.,2.,3.", i);
	text_add(&parameters, ";");
	const struct made_entity entities[] = { { 106, 12, parameters.s } };
	make_iges(&t, &f, entities, 1);
	model_init(&m);
	assert_int_equal(iges_parse(&m, t.s, t.n, "x.igs", &p, NULL), ST_CANCELLED);
	model_finish(&m);
	atomic_store(&stop, false);
	model_init(&m);
	assert_int_equal(iges_parse(&m, t.s, t.n, "x.igs", &p, NULL), ST_OK);
	assert_int_equal(m.entities[0].curve.n, 100000);
	model_finish(&m);
	text_finish(&t);
	text_finish(&parameters);
}

static void stop_when_asked_again(void *data, double fraction)
{
	(void)fraction;
	atomic_store((atomic_bool *)data, true);
}

/* One offset of a curved surface takes long by itself. */
static void offsets_stop_when_told(void **state)
{
	const struct made_file f = { 0 };
	const struct made_entity entities[MADE_MAX] = {
		{ 140, 0, "140,1.,1.,0.,.1,3;" },
		{ 122, 0, "122,5,3.,0.,1.;" },
		{ 126, 0,
		  "126,3,3,0,0,1,0,0.,0.,0.,0.,1.,1.,1.,1.,1.,1.,1.,1.,3.,0.,0.,2.,3.,0.,1.,-3.,0.,"
		  "0.,0.,0.,0.,1.;" },
	};
	struct text t = { 0 };
	struct model m;
	struct report_store store;
	struct entity *e;
	atomic_bool stop;
	struct progress p = { .step = stop_when_asked_again, .data = &stop, .stop = &stop };
	(void)state;
	make_iges(&t, &f, entities, 3);
	report_store_init(&store);
	model_init(&m);
	assert_int_equal(iges_parse(&m, t.s, t.n, "x.igs", NULL, &store.report), ST_OK);
	assert_int_equal(model_find(&m, "D1", &e, NULL), ST_OK);
	model_finish(&m);
	atomic_init(&stop, false);
	model_init(&m);
	assert_int_equal(iges_parse(&m, t.s, t.n, "x.igs", &p, &store.report), ST_CANCELLED);
	model_finish(&m);
	text_finish(&t);
}

/* Composites of composites, each naming the next four times: 4^14 curves if nobody counted. */
static void entities_that_multiply_are_stopped(void **state)
{
	enum { DEPTH = 14 };
	static char parameters[DEPTH][64];
	struct made_entity entities[DEPTH + 1];
	const struct made_file f = { 0 };
	struct model m;
	struct text t = { 0 };
	(void)state;
	for (int i = 0; i < DEPTH; i++) {
		int next = 2 * i + 3;
		snprintf(parameters[i], sizeof parameters[i], "102,4,%d,%d,%d,%d;", next, next,
		         next, next);
		entities[i] = (struct made_entity){ 102, 0, parameters[i] };
	}
	entities[DEPTH] = (struct made_entity){ 110, 0, "110,0.,0.,0.,0.,0.,0.;" };
	make_iges(&t, &f, entities, DEPTH + 1);
	model_init(&m);
	assert_int_equal(iges_parse(&m, t.s, t.n, "x.igs", NULL, NULL), ST_OK);
	assert_true(m.n_skipped > 0);
	assert_non_null(strstr(m.skipped[0].reason, "too many times"));
	model_finish(&m);
	text_finish(&t);
}

/* What is mended or passed over, the sentence about it, and where entity D1 leads at u (and v) 0.25. */
static void traps_are_mended_and_told(void **state)
{
	static const struct {
		struct made_entity entities[3];
		struct vec3 p;
		const char *said; /* NULL: nothing */
	} rows[] = {
		/* the flag of a polynomial with weights that differ; all weights zero */
		{ { { 126, 0,
		      "126,1,1,1,0,1,0," KNOTS4 "1.,3.,0.,0.,0.,1.,0.,0.,0.,1.,0.,0.,1.;" } },
		  { 0.5, 0, 0 },
		  "flag of a polynomial" },
		{ { { 126, 0,
		      "126,1,1,1,0,1,0," KNOTS4 "0.,0.,0.,0.,0.,1.,0.,0.,0.,1.,0.,0.,1.;" } },
		  { 0.25, 0, 0 },
		  "weights of 1 are taken" },
		/* the flag of a rational with weights that do not differ harms nothing */
		{ { { 126, 0,
		      "126,1,1,1,0,0,0," KNOTS4 "2.,2.,0.,0.,0.,1.,0.,0.,0.,1.,0.,0.,1.;" } },
		  { 0.25, 0, 0 },
		  NULL },
		/* the last knot too high, alone and with the range */
		{ { { 126, 0,
		      "126,1,1,1,0,1,0,0.,0.,1.,7.,1.,1.,0.,0.,0.,1.,0.,0.,0.,1.,0.,0.,1.;" } },
		  { 0.25, 0, 0 },
		  NULL },
		{ { { 126, 0,
		      "126,1,1,1,0,1,0,0.,0.,1.,7.,1.,1.,0.,0.,0.,1.,0.,0.,0.,7.,0.,0.,1.;" } },
		  { 0.25, 0, 0 },
		  "beyond the knots" },
		{ { { 128, 0,
		      "128,1,1,1,1,0,0,1,0,0," KNOTS4 "0.,0.,1.,9.,1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,"
		      "0.,1.,0.,1.,1.,0.,0.,1.,0.,9.;" } },
		  { 0.25, 0.25, 0 },
		  "beyond the knots" },
		/* U0 and U1 exchanged; U0 .. V1 left out */
		{ { { 128, 0,
		      "128,1,1,1,1,0,0,1,0,0," KNOTS4 KNOTS4 "1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,"
		      "0.,1.,0.,1.,1.,0.,1.,0.,0.,1.;" } },
		  { 0.25, 0.25, 0 },
		  "makes no sense" },
		{ { { 128, 0,
		      "128,1,1,1,1,0,0,1,0,0," KNOTS4 KNOTS4 "1.,1.,1.,1.,0.,0.,0.,1.,0.,0.,"
		      "0.,1.,0.,1.,1.,0.;" } },
		  { 0.25, 0.25, 0 },
		  "no parameter range" },
		/* pointers to the second line, in the directory and in the data */
		{ { { 128, 0, SQUARE, 4 }, { 124, 0, MOVE } },
		  { 10.25, 20.25, 30 },
		  "(the first is D3): referred to by the number of their second directory line" },
		{ { { 102, 0, "102,1,4;" }, { 110, 0, "110,0.,0.,0.,4.,0.,0.;" } },
		  { 1, 0, 0 },
		  "second directory line" },
		/* no parameters of its own */
		{ { { 128, 0, "" }, { 128, 0, SQUARE } }, { 0.25, 0.25, 0 }, "another's" },
		/* blanked; dependent, but of nothing; a member of what nothing places */
		{ { { 128, 0, SQUARE, 0, 0, "01000000" } }, { 0.25, 0.25, 0 }, "blanked" },
		{ { { 128, 0, SQUARE, 0, 0, "00010000" } }, { 0.25, 0.25, 0 }, NULL },
		{ { { 128, 0, SQUARE }, { 308, 0, "308,0,1HA,1,1;" } },
		  { 0.25, 0.25, 0 },
		  "nothing places" },
		/* the same again is there again */
		{ { { 128, 0, SQUARE }, { 128, 0, SQUARE } }, { 0.25, 0.25, 0 }, NULL },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		struct made_entity entities[MADE_MAX] = { rows[i].entities[0], rows[i].entities[1],
			                                  rows[i].entities[2] };
		const struct made_file f = { 0 };
		struct model m;
		struct report_store store;
		struct entity *e;
		if (read_made(&m, &f, entities, &store) != ST_OK)
			fail_msg("row %zu: %s", i, store.error);
		assert_int_equal(m.n_skipped, 0);
		assert_int_equal(model_find(&m, "D1", &e, NULL), ST_OK);
		assert_point(i,
		             e->kind == ENTITY_CURVE ? curve_point(&e->curve, 0.25)
		                                     : surface_point(&e->geometry, 0.25, 0.25),
		             rows[i].p);
		if (m.n_warnings != (rows[i].said != NULL) ||
		    (rows[i].said && !strstr(m.warnings[0], rows[i].said)))
			fail_msg("row %zu: %d warnings: %s", i, m.n_warnings,
			         m.n_warnings ? m.warnings[0] : "-");
		model_finish(&m);
	}
}

/* Two directory lines of different types; a last line that counts more than there is. */
static void lines_that_disagree_are_told(void **state)
{
	static const struct {
		const char *find, *replace, *said;
	} rows[] = {
		{ "     128       0       0       2", "     126       0       0       2",
		  "name different types" },
		{ "D      2P      2", "D      4P      9", "lines are missing" },
	};
	const struct made_entity entities[] = { { 128, 0, SQUARE } };
	const struct made_file f = { 0 };
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		struct text t = { 0 };
		struct model m;
		make_iges(&t, &f, entities, 1);
		char *at = strstr(t.s, rows[i].find);
		assert_non_null(at);
		memcpy(at, rows[i].replace, strlen(rows[i].replace));
		model_init(&m);
		assert_int_equal(iges_parse(&m, t.s, t.n, "x.igs", NULL, NULL), ST_OK);
		assert_int_equal(m.n_warnings, 1);
		assert_non_null(strstr(m.warnings[0], rows[i].said));
		model_finish(&m);
		text_finish(&t);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(headers_and_their_faults),
		cmocka_unit_test(files_as_programs_write_them),
		cmocka_unit_test(traps_are_mended_and_told),
		cmocka_unit_test(lines_that_disagree_are_told),
		cmocka_unit_test(whole_files_refused),
		cmocka_unit_test(parts_are_not_counted),
		cmocka_unit_test(stops_when_told),
		cmocka_unit_test(offsets_stop_when_told),
		cmocka_unit_test(entities_that_multiply_are_stopped),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
