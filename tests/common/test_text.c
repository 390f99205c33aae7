/* test_text.c - texts, reports, the status map, JSON, threads. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "hash.h"
#include "json.h"
#include "parallel.h"
#include "report.h"
#include "text.h"

static void text_grows(void **state)
{
	struct text t = { 0 };

	(void)state;
	for (int i = 0; i < 1000; i++)
		text_addf(&t, "%d,", i);
	text_add_number(&t, 0.1);
	assert_int_equal(t.n, strlen(t.s));
	assert_string_equal(t.s + t.n - 7, "999,0.1");
	char *s = text_take(&t);
	assert_non_null(s);
	assert_null(t.s);
	free(s);
}

static void an_empty_text_is_a_string(void **state)
{
	struct text t = { 0 };
	char *s = text_take(&t);

	(void)state;
	assert_string_equal(s, "");
	free(s);
}

static void what_is_utf8(void **state)
{
	static const struct {
		const char *text;
		bool good;
	} rows[] = {
		{ "", true },
		{ "a\n\x7f", true },
		{ "\xc3\xa9\xe2\x82\xac\xf0\x9f\x9a\xa2", true },
		{ "\xed\x9f\xbf\xee\x80\x80\xf4\x8f\xbf\xbf", true },
		{ "a\xff", false },
		{ "\x80", false },
		{ "\xc3", false },
		{ "\xc3z", false },
		{ "\xe2\x82", false },
		{ "\xf0\x9f\x9a", false },
		{ "\xc0\xaf", false }, /* too long forms */
		{ "\xe0\x9f\xbf", false },
		{ "\xf0\x8f\xbf\xbf", false },
		{ "\xed\xa0\x80", false },     /* a surrogate */
		{ "\xf4\x90\x80\x80", false }, /* beyond the last one */
	};

	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
		json_t *judge = json_string(rows[i].text);
		assert_int_equal(text_is_utf8(rows[i].text), rows[i].good);
		assert_int_equal(judge != NULL, rows[i].good);
		json_decref(judge);
	}
	assert_int_equal(text_character("\xc3\xa9", 1), 0);
	assert_int_equal(text_character("a", 0), 0);
}

static void classes_and_back(void **state)
{
	(void)state;
	for (int i = 0; i < N_STATUS; i++)
		assert_int_equal(status_from_class(status_class((enum status)i)), i);
	assert_int_equal(status_from_class("nonsense"), ST_INTERNAL);
	assert_int_equal(status_exit(ST_PARAMETER), 2);
	assert_int_equal(status_exit(ST_CANCELLED), 130);
}

static void a_store_keeps_the_last_sentence(void **state)
{
	struct report_store store;

	(void)state;
	report_store_init(&store);
	assert_int_equal(report_error(&store.report, ST_INPUT, "a %d", 1), ST_INPUT);
	report_warning(&store.report, "b");
	assert_int_equal(report_error(NULL, ST_RESOURCE, "nobody"), ST_RESOURCE);
	assert_string_equal(store.error, "a 1");
	assert_string_equal(store.warning, "b");
	assert_int_equal(store.n_errors, 1);
}

static void json_is_never_trusted(void **state)
{
	json_t *o;
	const char *s = "{\"a\": 1, \"b\": \"x\", \"c\": null, \"d\": 0.5}";

	(void)state;
	assert_int_equal(json_parse_object(s, strlen(s), "test", &o, NULL), ST_OK);
	assert_string_equal(json_text(o, "b", "-"), "x");
	assert_string_equal(json_text(o, "a", "-"), "-");
	assert_int_equal(json_int(o, "a", 7), 1);
	assert_int_equal(json_int(o, "d", 7), 7);
	assert_int_equal(json_int(o, "missing", 7), 7);
	assert_true(json_number(o, "d", 0) == 0.5);
	json_set_number(o, "d", NAN);
	assert_true(json_is_null(json_object_get(o, "d")));
	json_decref(o);
}

static void json_refuses(void **state)
{
	static const char *const rows[] = {
		"", "[]", "1", "{", "{\"a\":1,\"a\":2}", "{}x", "\xff"
	};
	json_t *o;

	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
		assert_int_equal(json_parse_object(rows[i], strlen(rows[i]), "test", &o, NULL),
		                 ST_INPUT);
}

static void json_writes_what_it_reads(void **state)
{
	const char *s = "{\"a\":[0.1,1.0,-3],\"b\":\"\\\"\\u0001\",\"c\":{},\"d\":[]}";
	json_t *o;

	(void)state;
	assert_int_equal(json_parse_object(s, strlen(s), "test", &o, NULL), ST_OK);
	char *again = json_write(o, false);
	assert_string_equal(again, s);
	free(again);
	json_decref(o);
}

struct counts {
	atomic_int done[1000];
	size_t fail_at;
};

static enum status count_unit(void *data, size_t unit, int thread)
{
	struct counts *c = data;

	assert_true(thread >= 0 && thread < 4);
	atomic_fetch_add(&c->done[unit], 1);
	return unit == c->fail_at ? ST_INPUT : ST_OK;
}

static void every_unit_once(void **state)
{
	struct counts c = { .fail_at = SIZE_MAX };

	(void)state;
	assert_int_equal(parallel_run(4, 1000, NULL, count_unit, &c), ST_OK);
	for (int i = 0; i < 1000; i++)
		assert_int_equal(c.done[i], 1);
	assert_int_equal(parallel_run(4, 0, NULL, count_unit, &c), ST_OK);
}

static void a_failed_unit_ends_the_run(void **state)
{
	struct counts c = { .fail_at = 0 };
	atomic_bool stop = true;

	(void)state;
	assert_int_equal(parallel_run(1, 1000, NULL, count_unit, &c), ST_INPUT);
	assert_int_equal(c.done[1], 0);
	assert_int_equal(parallel_run(4, 1000, &stop, count_unit, &c), ST_CANCELLED);
}

static void hashes(void **state)
{
	char a[HASH_SIZE], b[HASH_SIZE];

	(void)state;
	hash_bytes("hull", 4, a);
	hash_bytes("hulk", 4, b);
	assert_int_equal(strlen(a), 32);
	assert_string_not_equal(a, b);
	assert_true(checksum_bytes("hull", 4) != checksum_bytes("hulk", 4));
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(text_grows),
		cmocka_unit_test(an_empty_text_is_a_string),
		cmocka_unit_test(what_is_utf8),
		cmocka_unit_test(classes_and_back),
		cmocka_unit_test(a_store_keeps_the_last_sentence),
		cmocka_unit_test(json_is_never_trusted),
		cmocka_unit_test(json_refuses),
		cmocka_unit_test(json_writes_what_it_reads),
		cmocka_unit_test(every_unit_once),
		cmocka_unit_test(a_failed_unit_ends_the_run),
		cmocka_unit_test(hashes),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
