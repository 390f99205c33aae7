/* test_stats.c - the record, its JSON there and back, states. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "json.h"
#include "stats.h"

static const char full[] =
        "{\"id\":7,\"worker\":\"shading\",\"state\":\"running\",\"color\":\"#7CC4F8\","
        "\"fraction\":0.25,\"eta_s\":12.5,\"file_name\":\"a \\\"b\\\"\\\\.igs\","
        "\"path_name\":\"/x/\\u0001\\u00e9.igs\",\"pid\":42,\"host\":\"h\",\"group\":\"g\","
        "\"reason\":\"line\\nline\",\"wall_s\":1.5,\"suspended_s\":0.5,\"cpu_s\":null,"
        "\"peak_kib\":100,\"inputs\":[{\"path\":\"/i/1.base\",\"entity\":null},"
        "{\"path\":\"/i/2.base\",\"entity\":\"D15\"}],"
        "\"outputs\":[{\"path\":\"/o.exr\",\"kind\":\"image\",\"figures\":{\"K_max\":0.1}}],"
        "\"bytes\":1234,\"log\":\"/l\",\"on\":\"slurm\",\"shards\":4,\"partition\":\"p\",\"account\":\"a\","
        "\"time\":\"1:00\",\"priority\":-3,\"done\":1,\"total\":4,\"phase\":\"units\",\"after\":[3,5],"
        "\"after_any\":[4],\"wall_limit_s\":60.5,\"umask\":23,"
        "\"parameters\":{\"grid\":\"4x4\"},\"output\":\"/o\",\"threads\":2,\"memory_mib\":64,"
        "\"force\":true,\"submitted\":1000.25,\"started\":1001.5,\"ended\":null}";

static void record_survives_json(void **state)
{
	(void)state;
	struct Stats s, copy;
	json_t *o = json_loads(full, 0, NULL);
	assert_non_null(o);
	assert_int_equal(stats_from_json(&s, o), ST_OK);
	assert_int_equal(stats_copy(&copy, &s), ST_OK);
	stats_finish(&s);
	assert_int_equal(copy.state, JOB_RUNNING);
	assert_string_equal(copy.inputs[1].entity, "D15");
	assert_int_equal(copy.after[1], 5);
	assert_true(isnan(copy.cpu_s));
	json_t *again = stats_to_json(&copy);
	assert_true(json_equal(o, again));
	json_decref(o);
	json_decref(again);
	stats_finish(&copy);
}

static void brief_records_read_back_the_same(void **state)
{
	static const char *const records[] = { full, "{}",
		                               "{\"id\":3,\"priority\":2,\"force\":true}" };
	(void)state;
	for (size_t i = 0; i < sizeof records / sizeof *records; i++) {
		struct Stats s, again;
		struct text t = { 0 };
		json_t *o = json_loads(records[i], 0, NULL);
		assert_int_equal(stats_from_json(&s, o), ST_OK);
		stats_write_brief(&t, &s);
		json_t *brief = json_loads(t.s, 0, NULL);
		assert_non_null(brief);
		const char *key;
		json_t *value;
		json_object_foreach(brief, key, value) assert_false(json_is_null(value));
		assert_int_equal(stats_from_json(&again, brief), ST_OK);
		json_t *a = stats_to_json(&s), *b = stats_to_json(&again);
		assert_true(json_equal(a, b));
		json_decref(a);
		json_decref(b);
		json_decref(o);
		json_decref(brief);
		text_finish(&t);
		stats_finish(&s);
		stats_finish(&again);
	}
}

static void what_is_not_known_is_null_and_never_left_out(void **state)
{
	static const char *const unknown[] = {
		"worker", "fraction", "eta_s",     "file_name",   "path_name", "pid",      "host",
		"group",  "reason",   "wall_s",    "suspended_s", "cpu_s",     "peak_kib", "log",
		"phase",  "output",   "submitted", "started",     "ended",
	};
	struct Stats s;
	(void)state;
	stats_init(&s);
	json_t *o = stats_to_json(&s);
	for (size_t i = 0; i < sizeof unknown / sizeof *unknown; i++)
		if (!json_is_null(json_object_get(o, unknown[i])))
			fail_msg("%s is not null", unknown[i]);
	assert_true(json_is_array(json_object_get(o, "inputs")));
	assert_true(json_is_array(json_object_get(o, "outputs")));
	assert_true(json_is_object(json_object_get(o, "parameters")));
	json_decref(o);
	stats_finish(&s);
}

static void wrong_records_are_refused(void **state)
{
	static const char *const wrong[] = { "[]",
		                             "{\"state\":\"asleep\"}",
		                             "{\"inputs\":[{}]}",
		                             "{\"inputs\":[5]}",
		                             "{\"outputs\":[{}]}",
		                             "{\"after\":[\"x\"]}" };
	struct Stats s;
	(void)state;
	for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
		json_t *o = json_loads(wrong[i], 0, NULL);
		assert_non_null(o);
		assert_int_equal(stats_from_json(&s, o), ST_INPUT);
		json_decref(o);
	}
}

static void wrong_types_are_not_known(void **state)
{
	struct Stats s;
	(void)state;
	json_t *o = json_loads(
	        "{\"id\":\"x\",\"worker\":5,\"pid\":[],\"inputs\":{},\"eta_s\":\"\"}", 0, NULL);
	assert_int_equal(stats_from_json(&s, o), ST_OK);
	assert_null(s.worker);
	assert_int_equal(s.n_inputs, 0);
	assert_true(isnan(s.eta_s));
	stats_finish(&s);
	json_decref(o);
}

static void states_have_words(void **state)
{
	(void)state;
	for (int i = 0; i < N_JOB_STATES; i++)
		assert_int_equal(job_state_from_word(job_state_table[i].word), i);
	assert_int_equal(job_state_from_word("asleep"), N_JOB_STATES);
	assert_int_equal(job_state_from_word(NULL), N_JOB_STATES);
}

static void a_record_is_utf8_whatever_was_said(void **state)
{
	static const char *const rows[][2] = {
		{ "a\xff z", "a\xef\xbf\xbd z" },
		{ "\xc3\xa9\"a\xc3\xa9z\n", "\xc3\xa9\"a\xc3\xa9z\n" },
		{ "\xc3\xa9\xc3", "\xc3\xa9\xef\xbf\xbd" },
		{ "\xe2\x82\"\n\\", "\xef\xbf\xbd\xef\xbf\xbd\"\n\\" },
	};
	(void)state;
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
		struct Stats s;
		struct text t = { 0 };
		stats_init(&s);
		s.reason = strdup(rows[i][0]);
		stats_write_brief(&t, &s);
		json_t *o = json_loads(t.s, 0, NULL);
		assert_non_null(o);
		assert_string_equal(json_text(o, "reason", ""), rows[i][1]);
		json_decref(o);
		text_finish(&t);
		stats_finish(&s);
	}
}

static void fraction_is_between_0_and_1(void **state)
{
	struct Stats s;
	(void)state;
	stats_init(&s);
	assert_true(isnan(stats_fraction(&s)));
	s.total = 4;
	s.done = 9;
	assert_true(stats_fraction(&s) == 1);
	s.done = -9;
	assert_true(stats_fraction(&s) == 0);
	s.state = JOB_DONE;
	assert_true(stats_fraction(&s) == 1);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(record_survives_json),
		cmocka_unit_test(brief_records_read_back_the_same),
		cmocka_unit_test(what_is_not_known_is_null_and_never_left_out),
		cmocka_unit_test(wrong_records_are_refused),
		cmocka_unit_test(wrong_types_are_not_known),
		cmocka_unit_test(states_have_words),
		cmocka_unit_test(a_record_is_utf8_whatever_was_said),
		cmocka_unit_test(fraction_is_between_0_and_1),
	};
	return cmocka_run_group_tests_name("stats", tests, NULL, NULL);
}
