/* test_csv.c - points in columns: what is read, what is said of faults, back to the bit. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "csv.h"
#include "survive.h"

static enum status parse(struct model *m, const char *text, struct report_store *store)
{
	report_store_init(store);
	model_init(m);
	return csv_parse(m, text, strlen(text), "p.csv", NULL, &store->report);
}

static void columns_are_read(void **state)
{
	(void)state;
	static const struct {
		const char *text;
		int dimension, n;
		double values[6];
	} rows[] = {
		{ "1,2,3\n4,5,6\n", 3, 2, { 1, 2, 3, 4, 5, 6 } },
		{ "1;2\r\n3 ; 4\r\n", 2, 2, { 1, 2, 3, 4 } },
		{ "1\t2\t3", 3, 1, { 1, 2, 3 } },
		{ "  1   -2 +3  \n", 3, 1, { 1, -2, 3 } },
		{ "# two\n\nu,v # names\n0.5,1e-3 # a point\n", 2, 1, { 0.5, 1e-3 } },
		{ "1.5D+01 2d0 .5\n", 3, 1, { 15, 2, 0.5 } },
		{ "X Y Z\n1 2 3\n", 3, 1, { 1, 2, 3 } },
		{ "\"z\",\"id\",\"y\",\"x\"\n3,77,2,1\n", 3, 1, { 1, 2, 3 } },
		{ "length,height\n7,8\n", 2, 1, { 7, 8 } },
	};
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
		struct model m;
		struct report_store store;
		assert_true(csv_recognise(rows[i].text, strlen(rows[i].text)));
		assert_int_equal(parse(&m, rows[i].text, &store), ST_OK);
		assert_int_equal(m.n, 1);
		const struct point_list *l = &m.entities[0].points;
		assert_int_equal(l->dimension, rows[i].dimension);
		assert_int_equal(l->n, rows[i].n);
		for (int k = 0; k < l->n * l->dimension; k++)
			assert_true(l->values[k] == rows[i].values[k]);
		model_finish(&m);
	}
}

static void faults_are_named(void **state)
{
	(void)state;
	static const struct {
		const char *text, *said;
	} rows[] = {
		{ "", "no line of numbers" },
		{ "# nothing\n", "no line of numbers" },
		{ "x,y,z\n", "no line of numbers" },
		{ "1,2,3\n1,2\n", "p.csv:2:1: found 2 columns, expected 3" },
		{ "1,2,3\n1,2,here\n", "p.csv:2:5: found 'here', expected a number" },
		{ "1,2,3\n1,,3\n", "p.csv:2:3: found '', expected a number" },
		{ "1,2,3\n1,2,\n", "p.csv:2:5: found '', expected a number" },
		{ "1,2,nan\n", "expected a number" },
		{ "1\n2\n", "p.csv:1:1: found '1', expected two columns" },
		{ "1 2 3 4\n", "expected two columns" },
		{ "1,5;2,5;3,5\n", "expected two columns" },
		{ "1e999 2 3\n", "expected a number" },
	};
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
		struct model m;
		struct report_store store;
		assert_int_equal(parse(&m, rows[i].text, &store), ST_INPUT);
		if (!strstr(store.error, rows[i].said))
			fail_msg("'%s' in place of '%s'", store.error, rows[i].said);
		assert_int_equal(store.n_errors, 1);
		model_finish(&m);
	}
	assert_false(csv_recognise("batten base 1\n", 14));
	assert_false(csv_recognise("200 1 0 0\n3 0\n", 14));
	assert_false(csv_recognise("hello there\nworld\n", 18));
}

static void written_is_read_to_the_bit(void **state)
{
	(void)state;
	static const double awkward[] = { 0.1, -0.0, 5e-324, 1e300, 1.0 / 3, -123456.7 };
	char folder[] = "/tmp/batten-csv-XXXXXX", path[64], text[256];
	struct model m, again;
	struct report_store store;
	struct entity e;
	assert_non_null(mkdtemp(folder));
	snprintf(path, sizeof path, "%s/a.csv", folder);
	report_store_init(&store);
	model_init(&m);
	assert_int_equal(csv_write(&m, path, &store.report), ST_INPUT);
	for (int k = 0; k < 2; k++) {
		entity_init(&e, ENTITY_POINTS);
		e.points = (struct point_list){ 2, 3, malloc(sizeof awkward) };
		memcpy(e.points.values, awkward, sizeof awkward);
		assert_int_equal(model_add(&m, &e), ST_OK);
	}
	assert_int_equal(model_set_text(&m.unit, "mm"), ST_OK);
	assert_int_equal(csv_write(&m, path, &store.report), ST_OK);
	assert_int_equal(model_read(&again, path, NULL, &store.report), ST_OK);
	assert_int_equal(again.n, 1);
	assert_int_equal(again.entities[0].points.n, 4);
	assert_memory_equal(again.entities[0].points.values, awkward, sizeof awkward);
	assert_memory_equal(again.entities[0].points.values + 6, awkward, sizeof awkward);
	model_finish(&again);
	FILE *f = fopen(path, "r");
	assert_non_null(f);
	size_t n = fread(text, 1, sizeof text - 1, f);
	fclose(f);
	text[n] = 0;
	assert_true(strncmp(text, "# unit mm\nx,y,z\n0.1,", 20) == 0);
	/* points of two kinds have no common columns */
	m.entities[1].points.dimension = 2;
	m.entities[1].points.n = 3;
	assert_int_equal(csv_write(&m, path, &store.report), ST_INPUT);
	model_finish(&m);
	unlink(path);
	rmdir(folder);
}

static enum status read_damaged(struct model *m, const char *bytes, size_t n,
                                const struct report *r)
{
	csv_recognise(bytes, n);
	return csv_parse(m, bytes, n, "p.csv", NULL, r);
}

static void damaged_files_are_survived(void **state)
{
	(void)state;
	static const char text[] =
	        "# points\r\nx;y;z\r\n1.25;2;3\r\n4;5D-3;6\r\n7;8;9\r\n1;2;3\r\n";
	survive(read_damaged, text, sizeof text - 1, 7, 3000, 100, 100);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(columns_are_read),
		cmocka_unit_test(faults_are_named),
		cmocka_unit_test(written_is_read_to_the_bit),
		cmocka_unit_test(damaged_files_are_survived),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
