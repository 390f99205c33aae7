/* test_hand.c - workers run by hand: names, options, failures, resumption, what is up to date. */
#include "drive.h"

#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "checked.h"

static char *probe, *scene;

static int enter(void **state)
{
	static struct place place;
	*state = &place;
	place_enter(&place);
	place_models();
	return 0;
}

static int leave(void **state)
{
	place_leave(*state);
	return 0;
}

static void expect_word(const char *text, const char *word)
{
	if (!text || !strstr(text, word))
		fail_msg("'%s' is not in '%s'", word, text ? text : "nothing");
}

/* Run, compare exit status, look for a word in what it printed. */
static void expect(struct ran r, int exit_status, const char *out, const char *err)
{
	if (r.exit_status != exit_status)
		fail_msg("exit status %d, expected %d: %s", r.exit_status, exit_status, r.err);
	expect_word(r.out, out);
	expect_word(r.err, err);
	ran_finish(&r);
}

static void test_names(void **state)
{
	(void)state;
	expect(run_hand(probe, "one.base", NULL), 0, "one.probe.base: units 8", "");
	assert_true(there("one.probe.base"));
	expect(run_hand(probe, "two.base", NULL), 0, "two-3.probe.base", "");
	assert_true(there("two-1.probe.base"));
	assert_true(there("two-3.probe.base"));
	expect(run_hand(probe, "two.base#3", NULL), 0, "two.probe.base", "");
	expect(run_hand(probe, "two.base", "-o", "name", NULL), 0, "name-1.probe.base", "");
	expect(run_hand(probe, "two.base", "-o", "whole.probe.base", NULL), 0, "whole-3.probe.base",
	       "");
	expect(run_hand(probe, "one.base", "-o", "full.probe.base", NULL), 0, "full.probe.base",
	       "");
	expect(run_hand(scene, "two.base", "one.base", NULL), 0, "two.probe.base", "");
	expect(run_hand(probe, "one.base", "one.base", NULL), 2, "", "the name 'one-1'");
	expect(run_hand(probe, "two.base", "--part", "p", NULL), 2, "",
	       "--part is for one surface");
	expect(run_hand(probe, "one.base", "-o", ".probe.base", NULL), 2, "", "names no file");
}

static void test_same_bytes(void **state)
{
	(void)state;
	expect(run_hand(probe, "two.base#1", "-o", "a", "--threads", "1", NULL), 0, "", "");
	expect(run_hand(probe, "one.base", "-o", "b", "--threads", "7", "--memory", "100", NULL), 0,
	       "", "");
	assert_same_file("a.probe.base", "b.probe.base");
	/* 8 units of 100 bytes joined in order; the formula is the probe's */
	size_t n;
	char *text = slurp("a.probe.base", &n);
	assert_non_null(strstr(text, "attribute \"param.bytes\" \"100\""));
	assert_non_null(strstr(text, "attribute \"worker_version\" \"3\""));
	assert_null(strstr(text, "threads"));
	assert_null(strstr(text, "tmp"));
	free(text);
}

static void test_parameters(void **state)
{
	(void)state;
	static const struct {
		const char *option, *value, *sentence;
	} rows[] = {
		{ "--gird", "3", "no parameter 'gird'; probe has units, bytes" },
		{ "--grid", "0x0", "two integers AxB, each from 1 to 65536" },
		{ "--grid", "3x0", "from 1" },
		{ "--grid", "3", "AxB" },
		{ "--grid", "3x4x5", "AxB" },
		{ "--grid", "99999999999x1", "AxB" },
		{ "--units", "x", "an integer from 0 to 10000" },
		{ "--units", "1.5", "an integer" },
		{ "--units", "-1", "from 0" },
		{ "--units", "", "an integer" },
		{ "--tolerance", "-1", "of at least 0" },
		{ "--tolerance", "nan", "a number" },
		{ "--tolerance", "1e999", "a number" },
		{ "--light", "1,2", "X,Y,Z" },
		{ "--light", "0,0,0", "has no direction" },
		{ "--word", "four", "one of one two three" },
		{ "--word", "one two", "one of one two three" },
		{ "--color", "red", "#RRGGBB" },
		{ "--view", "", "not empty" },
		{ "--extra=maybe", "", "yes or no" },
		{ "--threads", "0", "from 1 to 1024" },
		{ "--threads", "many", "from 1 to 1024" },
		{ "--memory", "-1", "MiB" },
		{ "--force=yes", "", "takes no value" },
		{ "-x", "", "no option '-x'" },
	};
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
		expect(run_hand(probe, "one.base", rows[i].option, rows[i].value, NULL), 2, "",
		       rows[i].sentence);
	expect(run_hand(probe, "one.base", "--light", "0,0,1", "--azimuth", "3", NULL), 2, "",
	       "given twice");
	expect(run_hand(probe, "one.base", "--units", NULL), 2, "", "--units needs a value");
	expect(run_hand(probe, "--units", "3", NULL), 2, "", "no input");
	assert_int_equal(count_files(), 2);
}

static void test_canonical(void **state)
{
	(void)state;
	expect(run_hand(probe, "one.base", "--tolerance", "1d-2", "--grid=08X4", "--color",
	                "#abcdef", "--light", "-0,+1,2e0", NULL),
	       0, "", "");
	size_t n;
	char *text = slurp("one.probe.base", &n);
	assert_non_null(strstr(text, "\"param.tolerance\" \"0.01\""));
	assert_non_null(strstr(text, "\"param.grid\" \"8x4\""));
	assert_non_null(strstr(text, "\"param.color\" \"#ABCDEF\""));
	assert_non_null(strstr(text, "\"param.light\" \"0,1,2\""));
	free(text);
}

static void test_inputs(void **state)
{
	(void)state;
	spill("empty.base", "");
	spill("torn.base", "batten base 1\nentities 1\ntype surface\n");
	spill("curve.base", "batten base 1\nscale 1\nentities 1\ntype curve\norder 2\n"
	                    "ncontpts 2\nperiodic no\ndomain 0 1\nknots 0 0 1 1\ncontpts 0 0 0 1 "
	                    "1 1 0 1\nend\n");
	spill("note.txt", "a note\n");
	assert_int_equal(mkdir("folder", 0777), 0);
	static const struct {
		const char *input, *sentence;
	} rows[] = {
		{ "nix.base", "nix.base" },      { "empty.base", "empty" },
		{ "torn.base", "torn.base:" },   { "curve.base", "holds no surface" },
		{ "note.txt", "note.txt" },      { "folder", "folder" },
		{ "two.base#2", "is a curve" },  { "two.base#9", "9" },
		{ "two.base#nobody", "nobody" }, { "nix#1", "nix" },
	};
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++)
		expect(run_hand(probe, rows[i].input, NULL), 1, "", rows[i].sentence);
	assert_int_equal(count_files(), 7);
}

static void test_places(void **state)
{
	(void)state;
	expect(run_hand(probe, "one.base", "-o", "no/such", NULL), 1, "", "no such folder");
	expect(run_hand(probe, "one.base", "-o", "/proc/self/x", NULL), 1, "", "/proc/self");
	expect(run_hand(probe, "one.base", "--part", "two.base", NULL), 1, "", "is no part file");
	expect(run_hand(probe, "one.base", "--part", ".", NULL), 1, "", "part file '.'");
	if (geteuid() != 0) {
		assert_int_equal(mkdir("closed", 0555), 0);
		expect(run_hand(probe, "one.base", "-o", "closed/x", NULL), 1, "", "closed");
		assert_int_equal(rmdir("closed"), 0);
	}
	assert_int_equal(mkdir("one.probe.base", 0777), 0);
	expect(run_hand(probe, "one.base", NULL), 1, "", "one.probe.base");
	assert_int_equal(count_files(), 3); /* the folder; it was seen before a unit was done */
}

static void test_up_to_date(void **state)
{
	(void)state;
	expect(run_hand(probe, "PROBE_LOG=log", "one.base", NULL), 0, "", "");
	assert_int_equal(count_lines("log"), 8);
	expect(run_hand(probe, "PROBE_LOG=log", "one.base", NULL), 0, "one.probe.base: units 8",
	       "is up to date");
	assert_int_equal(count_lines("log"), 8);
	expect(run_hand(probe, "PROBE_LOG=log", "one.base", "--json", NULL), 0,
	       "\"up_to_date\":true", "");
	assert_int_equal(count_lines("log"), 8);
	expect(run_hand(probe, "PROBE_LOG=log", "one.base", "--force", NULL), 0, "", "");
	assert_int_equal(count_lines("log"), 16);
	/* other parameters, another input, a second output that is not there */
	expect(run_hand(probe, "PROBE_LOG=log", "one.base", "--units", "4", NULL), 0, "", "");
	assert_int_equal(count_lines("log"), 20);
	expect(run_hand(probe, "PROBE_LOG=log", "two.base#3", "-o", "one", "--units", "4", NULL), 0,
	       "", "");
	assert_int_equal(count_lines("log"), 24);
	expect(run_hand(probe, "PROBE_LOG=log", "one.base", "--extra", NULL), 0, "one.probe.txt",
	       "");
	assert_int_equal(count_lines("log"), 32);
	assert_int_equal(unlink("one.probe.txt"), 0);
	expect(run_hand(probe, "PROBE_LOG=log", "one.base", "--extra", NULL), 0, "", "");
	assert_int_equal(count_lines("log"), 40);
	spill("one.probe.base", "something else\n");
	expect(run_hand(probe, "PROBE_LOG=log", "one.base", "--extra", NULL), 0, "", "");
	assert_int_equal(count_lines("log"), 48);
}

static void test_failures(void **state)
{
	(void)state;
	static const struct {
		const char *where, *class;
		int exit_status;
		const char *sentence;
		bool part; /* units were done: they stay */
	} rows[] = {
		{ "PROBE_FAIL=begin", "PROBE_CLASS=input", 1, "failed as told at begin", false },
		{ "PROBE_FAIL=begin", "PROBE_CLASS=parameter", 2, "failed as told", false },
		{ "PROBE_FAIL=0", "PROBE_CLASS=internal", 1, "failed as told at 0", false },
		{ "PROBE_FAIL=5", "PROBE_CLASS=resource", 1, "failed as told at 5", true },
		{ "PROBE_FAIL=5", "PROBE_CLASS=silent", 1, "memory ran out while computing", true },
		{ "PROBE_FAIL=finish", "PROBE_CLASS=silent", 1, "take fewer threads", true },
		{ "PROBE_FAIL=write", "PROBE_CLASS=resource", 1, "failed as told at write", true },
		{ "PROBE_FORGET=unit", "PROBE_CLASS=none", 1, "gave no bytes for unit 0", false },
		{ "PROBE_FORGET=output", "PROBE_CLASS=none", 1, "did not make its output", true },
	};
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		expect(run_hand(probe, rows[i].where, rows[i].class, "one.base", "--threads", "1",
		                "--extra", NULL),
		       rows[i].exit_status, "", rows[i].sentence);
		assert_int_equal(there("one.probe.base.part"), rows[i].part);
		unlink("one.probe.base.part");
		assert_int_equal(count_files(), 2);
	}
	expect(run_hand(probe, "one.base", "--units", "0", NULL), 1, "", "has no units");
	/* one of two fails: the other is made */
	assert_int_equal(mkdir("two-1.probe.base.part", 0777), 0);
	expect(run_hand(probe, "two.base", NULL), 1, "two-3.probe.base", "two-1.probe.base.part");
	assert_true(there("two-3.probe.base"));
}

static void test_going_on(void **state)
{
	(void)state;
	expect(run_hand(probe, "one.base", "-o", "whole", NULL), 0, "", "");
	expect(run_hand(probe, "PROBE_FAIL=5", "one.base", "--threads", "1", NULL), 1, "", "");
	expect(run_hand(probe, "PROBE_LOG=log", "one.base", NULL), 0, "", "5 of 8 units are there");
	assert_int_equal(count_lines("log"), 3);
	assert_same_file("one.probe.base", "whole.probe.base");
	assert_false(there("one.probe.base.part"));
	/* another computation's part file is begun anew, and said so */
	expect(run_hand(probe, "PROBE_FAIL=5", "one.base", "--threads", "1", "-o", "x", NULL), 1,
	       "", "");
	expect(run_hand(probe, "PROBE_LOG=log", "one.base", "-o", "x", "--units", "9", NULL), 0, "",
	       "is of other work");
	assert_int_equal(count_lines("log"), 12);
}

/* A full disk, played by a limit on the size of files. */
static void test_full_disk(void **state)
{
	(void)state;
	expect(run_limited(RLIMIT_FSIZE, 20000, probe, "one.base", "--bytes", "8000", NULL), 1, "",
	       "cannot write part file");
	assert_false(there("one.probe.base"));
	expect(run_hand(probe, "one.base", "--bytes", "8000", "-o", "free", NULL), 0, "", "");
	expect(run_hand(probe, "one.base", "--bytes", "8000", NULL), 0, "", "units are there");
	assert_same_file("one.probe.base", "free.probe.base");
	/* the part file fits, the output does not */
	expect(run_limited(RLIMIT_FSIZE, 600, probe, "one.base", "--units", "1", "--bytes", "0",
	                   "-o", "tiny", NULL),
	       1, "", "tiny.probe.base");
	assert_false(there("tiny.probe.base"));
	unlink("tiny.probe.base.part");
	assert_int_equal(count_files(), 4);
}

/* Ctrl-C: it stops at the next unit, says what is kept, and goes on from there. */
static void test_interrupt(void **state)
{
	(void)state;
	struct peer p;
	char line[8] = "";
	assert_int_equal(mkfifo("units", 0600), 0);
	int fd = open("units", O_RDWR);
	assert_true(fd >= 0);
	peer_start(&p, probe, "PROBE_LOG=units", "PROBE_HANG=3", "one.base", "--threads", "1",
	           NULL);
	while (strcmp(line, "2\n") != 0) {
		ssize_t n = read(fd, line, 2);
		assert_int_equal(n, 2);
	}
	kill(p.pid, SIGINT);
	assert_int_equal(peer_end(&p), 130);
	close(fd);
	size_t n;
	char *said = slurp("peer.log", &n);
	expect_word(said, "cancelled; 3 of 8 units are kept in 'one.probe.base.part'");
	assert_null(strchr(said, '\r')); /* no terminal, no bar */
	free(said);
	expect(run_hand(probe, "PROBE_LOG=log", "one.base", NULL), 0, "", "3 of 8 units are there");
	assert_int_equal(count_lines("log"), 5);
}

/* A sanitizer's own shadow would not fit a limit; it has one of its own. */
static void test_memory(void **state)
{
	(void)state;
#if CHECKED_BUILD
	const char *options = getenv("ASAN_OPTIONS");
	char *saved = strdup(options ? options : "");
	int resource = 0, limit = 0;
	setenv("ASAN_OPTIONS", "allocator_may_return_null=1:max_allocation_size_mb=500", 1);
#else
	int resource = RLIMIT_AS, limit = 600 << 20;
#endif
	expect(run_limited(resource, (unsigned long)limit, probe, "one.base", "--bytes",
	                   "1000000000", "--threads", "2", NULL),
	       1, "", "memory ran out while computing");
	assert_int_equal(count_files(), 2);
#if CHECKED_BUILD
	setenv("ASAN_OPTIONS", saved, 1);
	free(saved);
#endif
}

static void test_description(void **state)
{
	(void)state;
	struct ran r = run_hand(probe, "--describe", NULL);
	json_t *o = json_loads(r.out, 0, NULL);
	assert_int_equal(r.exit_status, 0);
	assert_non_null(o);
	assert_string_equal(json_string_value(json_object_get(o, "name")), "probe");
	assert_string_equal(json_string_value(json_object_get(o, "inputs")), "surfaces");
	assert_true(json_is_false(json_object_get(o, "scene")));
	assert_int_equal(json_integer_value(json_object_get(o, "version")), 3);
	json_t *rows = json_object_get(o, "parameters"), *row;
	size_t i;
	bool word = false;
	json_array_foreach(rows, i, row)
	{
		assert_int_equal(json_object_size(row), 8);
		if (strcmp(json_string_value(json_object_get(row, "name")), "word") == 0) {
			word = true;
			assert_int_equal(json_array_size(json_object_get(row, "choices")), 3);
			assert_true(json_is_null(json_object_get(row, "default")));
			assert_true(json_is_null(json_object_get(row, "min")));
		}
		if (strcmp(json_string_value(json_object_get(row, "name")), "tolerance") == 0) {
			assert_true(json_is_null(json_object_get(row, "max")));
			assert_true(json_is_number(json_object_get(row, "min")));
		}
	}
	assert_true(word);
	rows = json_object_get(o, "outputs");
	assert_int_equal(json_array_size(rows), 2);
	assert_string_equal(json_string_value(json_object_get(json_array_get(rows, 1), "when")),
	                    "extra");
	json_decref(o);
	ran_finish(&r);
	expect(run_hand(probe, "--help", NULL), 0, "--tolerance X", "");
	expect(run_hand(probe, "--version", NULL), 0, "batten-probe 3 (batten ", "");
}

static void test_job_file(void **state)
{
	(void)state;
	static const struct {
		const char *text;
		int exit_status;
		const char *sentence;
	} rows[] = {
		{ "", 1, "bad.json" },
		{ "garbage", 1, "bad.json" },
		{ "[]", 1, "bad.json" },
		{ "{}", 1, "\"version\"" },
		{ "{\"version\":2}", 1, "\"version\"" },
		{ "{\"version\":1,\"worker\":\"other\"}", 1, "it is for worker 'other'" },
		{ "{\"version\":1,\"worker\":\"probe\"}", 1, "\"inputs\"" },
		{ "{\"version\":1,\"worker\":\"probe\",\"inputs\":[3]}", 1, "\"inputs\"" },
		{ "{\"version\":1,\"worker\":\"probe\",\"inputs\":[{\"path\":\"one.base\"}],"
		  "\"parameters\":[]}",
		  1, "\"parameters\"" },
		{ "{\"version\":1,\"worker\":\"probe\",\"inputs\":[{\"path\":\"one.base\"}],"
		  "\"parameters\":{\"units\":3}}",
		  1, "\"parameters\"" },
		{ "{\"version\":1,\"worker\":\"probe\",\"inputs\":[{\"path\":\"one.base\"}],"
		  "\"parameters\":{\"grid\":\"0x0\"}}",
		  2, "--grid '0x0'" },
		{ "{\"version\":1,\"worker\":\"probe\",\"inputs\":[{\"path\":\"one.base\"}],"
		  "\"shard\":[2,2]}",
		  1, "\"shard\"" },
		{ "{\"version\":1,\"worker\":\"probe\",\"inputs\":[{\"path\":\"one.base\"}],"
		  "\"threads\":0}",
		  2, "\"threads\"" },
		{ "{\"version\":1,\"worker\":\"probe\",\"inputs\":[{\"path\":\"one.base\"}],"
		  "\"output\":3}",
		  1, "\"output\"" },
		{ "{\"version\":1,\"worker\":\"probe\",\"inputs\":[{\"path\":\"one.base\"}],"
		  "\"parts\":[3]}",
		  1, "\"parts\"" },
		{ "{\"version\":1,\"worker\":\"probe\",\"inputs\":[{\"path\":\"one.base\"}],"
		  "\"force\":1}",
		  1, "\"force\"" },
	};
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		spill("bad.json", rows[i].text);
		expect(run_hand(probe, "--job", "bad.json", NULL), rows[i].exit_status, "",
		       rows[i].sentence);
	}
	assert_int_equal(count_files(), 3);
	write_job("7.json", "probe", "one.base", "by-job", "7.part", "\"units\":\"5\"", "");
	expect(run_hand(probe, "--job", "7.json", NULL), 0, "by-job.probe.base: units 5", "");
	expect(run_hand(probe, "--units", "5", "one.base", NULL), 0, "", "");
	assert_same_file("by-job.probe.base", "one.probe.base");
	expect(run_hand(probe, "--job", "7.json", "--units", "4", NULL), 2, "",
	       "--job says it all");
	expect(run_hand(probe, "--job", "none.json", NULL), 1, "", "none.json");
}

static void test_shards(void **state)
{
	(void)state;
	const char *units = "\"units\":\"7\"";
	write_job("0.json", "probe", "one.base", "cut", "0.part", units, ",\"shard\":[0,2]");
	write_job("1.json", "probe", "one.base", "cut", "1.part", units, ",\"shard\":[1,2]");
	write_job("all.json", "probe", "one.base", "cut", "all.part", units,
	          ",\"parts\":[\"0.part\",\"1.part\"]");
	expect(run_hand(probe, "PROBE_LOG=log0", "--job", "0.json", NULL), 0, "", "");
	assert_int_equal(count_lines("log0"), 4);
	assert_false(there("cut.probe.base"));
	/* a shard is of other work */
	write_job("other.json", "probe", "one.base", "cut", "1.part", "\"units\":\"8\"",
	          ",\"shard\":[1,2]");
	expect(run_hand(probe, "--job", "other.json", NULL), 0, "", "");
	expect(run_hand(probe, "--job", "all.json", NULL), 1, "", "is of other work");
	expect(run_hand(probe, "PROBE_LOG=log1", "--job", "1.json", NULL), 0, "", "other work");
	assert_int_equal(count_lines("log1"), 3);
	expect(run_hand(probe, "PROBE_LOG=log", "--job", "all.json", NULL), 0, "cut.probe.base",
	       "");
	assert_int_equal(count_lines("log"), 0);
	expect(run_hand(probe, "one.base", "--units", "7", NULL), 0, "", "");
	assert_same_file("cut.probe.base", "one.probe.base");
	assert_false(there("0.part"));
	assert_false(there("1.part"));
	assert_false(there("all.part"));
}

int main(int argc, char **argv)
{
	if (argc < 3)
		return 1;
	probe = realpath(argv[1], NULL); /* the tests change folders */
	scene = realpath(argv[2], NULL);
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_names, enter, leave),
		cmocka_unit_test_setup_teardown(test_same_bytes, enter, leave),
		cmocka_unit_test_setup_teardown(test_parameters, enter, leave),
		cmocka_unit_test_setup_teardown(test_canonical, enter, leave),
		cmocka_unit_test_setup_teardown(test_inputs, enter, leave),
		cmocka_unit_test_setup_teardown(test_places, enter, leave),
		cmocka_unit_test_setup_teardown(test_up_to_date, enter, leave),
		cmocka_unit_test_setup_teardown(test_failures, enter, leave),
		cmocka_unit_test_setup_teardown(test_going_on, enter, leave),
		cmocka_unit_test_setup_teardown(test_full_disk, enter, leave),
		cmocka_unit_test_setup_teardown(test_interrupt, enter, leave),
		cmocka_unit_test_setup_teardown(test_memory, enter, leave),
		cmocka_unit_test_setup_teardown(test_description, enter, leave),
		cmocka_unit_test_setup_teardown(test_job_file, enter, leave),
		cmocka_unit_test_setup_teardown(test_shards, enter, leave),
	};
	int failed = cmocka_run_group_tests_name("worker by hand", tests, NULL, NULL);
	free(probe);
	free(scene);
	return failed;
}
