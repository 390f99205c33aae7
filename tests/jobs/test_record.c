/* test_record.c - what a record in the ledger may look like to be sent as it is. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "json.h"
#include "record.h"
#include "stats.h"
#include "text.h"

/* One with all that a record can have. */
static json_t *full_job(void)
{
	return json_pack(
	        "{s:i, s:s, s:s, s:s, s:s, s:s, s:s, s:i, s:s, s:f, s:f, s:[{s:s, s:s}, {s:s}],"
	        " s:[{s:s, s:s, s:{s:f, s:[f, f], s:n}}], s:i, s:[i, i], s:[i], s:{s:s}, s:b, s:f}",
	        "id", 17, "worker", "curvature", "state", "failed", "file_name", "h\"u\\ll.igs",
	        "path_name", "/tmp/b\xc3\xa4r/\xe2\x82\xac/\xf0\x9f\x98\x80", "reason",
	        "line\none\x01", "group", "g", "pid", 0, "host", "vm", "wall_s", 0.25, "cpu_s",
	        1e-7, "inputs", "path", "/a", "entity", "3", "path", "/b", "outputs", "path", "/c",
	        "kind", "map", "figures", "K_min", -12.5, "uv", 0.5, 1e20, "none", "total", 9,
	        "after", 3, 4, "after_any", 5, "parameters", "grid", "20x20", "force", 1, "ended",
	        1795345461.328);
}

static char *written(const json_t *o, size_t *n)
{
	struct Stats s;
	struct text t = { 0 };
	assert_int_equal(stats_from_json(&s, o), ST_OK);
	stats_write_brief(&t, &s);
	stats_finish(&s);
	*n = t.n;
	return text_take(&t);
}

/* Is it, for who reads it, job 17 that has failed? */
static bool is_read(const char *text, size_t n)
{
	struct Stats s;
	json_t *o = json_loadb(text, n, 0, NULL);
	const bool good = stats_from_json(&s, o) == ST_OK && s.id == 17 && s.state == JOB_FAILED;
	stats_finish(&s);
	json_decref(o);
	return good;
}

static void what_is_written_is_sound(void **state)
{
	json_t *o = full_job();
	size_t n;
	(void)state;
	char *text = written(o, &n);
	assert_true(record_is_sound(text, n, 17, "failed"));
	assert_false(record_is_sound(text, n, 18, "failed"));
	assert_false(record_is_sound(text, n, 17, "done"));
	assert_false(record_is_sound(text, n - 1, 17, "failed"));
	assert_false(record_is_sound(text, 0, 17, "failed"));
	free(text);
	json_decref(o);
}

/* No number that a worker may state makes its record one that must be taken apart. */
static void any_number_is_sound(void **state)
{
	static const double some[] = {
		0,      -0.0,   1,    0.1,    1.0 / 3,   0.0010666941017323343,
		1e-7,   1e15,   1e16, 1e22,   -12.5e-30, 123456789012345678.0,
		1e-300, 5e-324, 1e99, -1e-99, 2.5e17,    9007199254740993.0
	};
	(void)state;
	for (size_t i = 0; i < sizeof some / sizeof *some; i++) {
		struct Stats s;
		struct text t = { 0 };
		stats_init(&s);
		s.id = 17;
		s.state = JOB_FAILED;
		s.wall_s = some[i];
		stats_write_brief(&t, &s);
		assert_true(record_is_sound(t.s, t.n, 17, "failed"));
		text_finish(&t);
		stats_finish(&s);
	}
}

/* Every bit, every byte that is missing: what is taken for sound is read as that job. */
static void no_damage_that_matters_is_overlooked(void **state)
{
	json_t *o = full_job();
	size_t n, refused = 0;
	(void)state;
	char *text = written(o, &n);
	assert_non_null(text);
	for (size_t i = 0; i < n; i++)
		for (int bit = 0; bit < 8; bit++) {
			text[i] = (char)(text[i] ^ 1 << bit);
			const bool sound = record_is_sound(text, n, 17, "failed");
			assert_true(!sound || is_read(text, n));
			refused += !sound;
			text[i] = (char)(text[i] ^ 1 << bit);
		}
	assert_true(refused > n);
	for (size_t i = 0; i < n; i++) {
		const char c = text[i];
		memmove(text + i, text + i + 1, n - i - 1);
		assert_true(!record_is_sound(text, n - 1, 17, "failed") || is_read(text, n - 1));
		memmove(text + i + 1, text + i, n - i - 1);
		text[i] = c;
	}
	free(text);
	json_decref(o);
}

static void what_others_refuse_is_not_sound(void **state)
{
	static const char *const more[] = {
		"\"x\":\"\\u0000\"",
		"\"x\":\"\\ud800\"",
		"\"x\":\"\xc0\x80\"",
		"\"x\":\"\xed\xa0\x80\"",
		"\"x\":\"\xf5\x80\x80\x80\"",
		"\"x\":\"\xe2\x82\"",
		"\"x\":1e999",
		"\"x\":01",
		"\"x\":-",
		"\"x\":1.",
		"\"x\":1e",
		"\"x\":nul",
		"\"x\":123456789012345678901234567890",
		"\"x\":[1,]",
		"\"x\":{}}",
		"\"x\":[[1]",
		"\"outputs\":[3]",
		"\"outputs\":[{}]",
		"\"inputs\":[{\"path\":3}]",
		"\"after\":[1.5]",
		"\"after\":[\"x\"]",
		"\"x\"",
		"",
	};
	static const char *const good[] = { "\"x\":[1,2]", "\"x\":[]",       "\"outputs\":[]",
		                            "\"x\":[{}]",  "\"x\":-0.5e-12", "\"x\":null" };
	(void)state;
	for (size_t i = 0; i < sizeof more / sizeof *more; i++) {
		char *text = text_print("{\"id\":17,\"state\":\"failed\",%s}", more[i]);
		assert_false(record_is_sound(text, strlen(text), 17, "failed"));
		free(text);
	}
	for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
		char *text = text_print("{\"id\":17,\"state\":\"failed\",%s}", good[i]);
		assert_true(record_is_sound(text, strlen(text), 17, "failed"));
		free(text);
	}
	char deep[200];
	memset(deep, '[', sizeof deep);
	char *text = text_print("{\"id\":17,\"state\":\"failed\",\"x\":%.200s", deep);
	assert_false(record_is_sound(text, strlen(text), 17, "failed"));
	free(text);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(what_is_written_is_sound),
		cmocka_unit_test(any_number_is_sound),
		cmocka_unit_test(no_damage_that_matters_is_overlooked),
		cmocka_unit_test(what_others_refuse_is_not_sound),
	};
	return cmocka_run_group_tests_name("record", tests, NULL, NULL);
}
