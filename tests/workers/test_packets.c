/* test_packets.c - workers under an executive: what they say, and what they make of what they hear. */
#include "drive.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

static char *probe;
static const char *document;

static int enter(void **state)
{
	static struct place place;
	*state = &place;
	place_enter(&place);
	place_models();
	write_job("7.json", "probe", "one.base", "out", "7.part", "", "");
	return 0;
}

static int leave(void **state)
{
	place_leave(*state);
	return 0;
}

static const char *last_text(const struct peer *p, const char *key)
{
	const char *text = json_string_value(json_object_get(p->last.body, key));
	return text ? text : "";
}

static long last_integer(const struct peer *p, const char *key)
{
	return (long)json_integer_value(json_object_get(p->last.body, key));
}

/* Start, and the job under way. hang: "PROBE_HANG=3". */
static void start(struct peer *p, const char *hang)
{
	peer_start(p, probe, hang, "PROBE_LOG=log", NULL);
	peer_send(p, MESSAGE_START, "job", "7.json");
}

/* Skip until the worker hangs where it was told to. */
static void until_holding(struct peer *p)
{
	do
		assert_true(peer_until(p, MESSAGE_PROGRESS));
	while (strcmp(last_text(p, "phase"), "holding") != 0);
}

/* The last packet is this error; the process ends with that status. */
static void expect_error(struct peer *p, const char *class, const char *text, int exit_status)
{
	assert_true(peer_until(p, MESSAGE_ERROR));
	assert_string_equal(last_text(p, "class"), class);
	if (!strstr(last_text(p, "text"), text))
		fail_msg("'%s' is not in '%s'", text, last_text(p, "text"));
	assert_false(peer_next(p));
	assert_int_equal(peer_end(p), exit_status);
}

/* The output made by hand, in one go. */
static void expect_output(void)
{
	struct ran r = run_hand(probe, "one.base", "-o", "by-hand", NULL);
	assert_int_equal(r.exit_status, 0);
	ran_finish(&r);
	assert_same_file("out.probe.base", "by-hand.probe.base");
	assert_false(there("7.part"));
}

static void test_whole_job(void **state)
{
	(void)state;
	struct peer p;
	bool first = false, last = false;
	write_job("7.json", "probe", "one.base", "out", "7.part", "\"warn\":\"yes\"", "");
	start(&p, "PROBE_HANG=none");
	assert_true(peer_next(&p));
	assert_int_equal(p.last.type, MESSAGE_HELLO);
	assert_string_equal(last_text(&p, "worker"), "probe");
	assert_int_equal(last_integer(&p, "protocol"), MESSAGE_PROTOCOL);
	assert_int_equal(last_integer(&p, "worker_version"), 3);
	assert_int_equal(last_integer(&p, "pid"), p.pid);
	while (peer_next(&p) && p.last.type != MESSAGE_RESULT) {
		bool computing = strcmp(last_text(&p, "phase"), "computing") == 0;
		first |= computing && last_integer(&p, "done") == 0;
		last |= computing && last_integer(&p, "done") == 8;
		if (p.last.type == MESSAGE_PROGRESS && computing)
			assert_int_equal(last_integer(&p, "total"), 8);
		if (p.last.type == MESSAGE_NOTE)
			assert_string_equal(last_text(&p, "text"), "warned as told");
	}
	assert_true(first && last);
	assert_int_equal(p.n_units, 8);
	assert_string_equal(last_text(&p, "path"), "out.probe.base");
	assert_string_equal(last_text(&p, "kind"), "curves");
	assert_int_equal(json_integer_value(
	                         json_object_get(json_object_get(p.last.body, "figures"), "units")),
	                 8);
	assert_true(json_is_false(json_object_get(p.last.body, "up_to_date")));
	assert_true(peer_next(&p));
	assert_int_equal(p.last.type, MESSAGE_DONE);
	assert_true(json_number_value(json_object_get(p.last.body, "wall_s")) > 0);
	assert_true(json_number_value(json_object_get(p.last.body, "cpu_s")) > 0);
	assert_true(last_integer(&p, "peak_kib") > 1000);
	assert_false(peer_next(&p));
	assert_int_equal(peer_end(&p), 0);
	assert_false(there("7.part"));
}

static void test_up_to_date(void **state)
{
	(void)state;
	for (int round = 0; round < 2; round++) {
		struct peer p;
		start(&p, "PROBE_HANG=none");
		assert_true(peer_until(&p, MESSAGE_RESULT));
		assert_int_equal(json_is_true(json_object_get(p.last.body, "up_to_date")), round);
		assert_int_equal(p.n_units, round ? 0 : 8);
		assert_int_equal(json_integer_value(json_object_get(
		                         json_object_get(p.last.body, "figures"), "units")),
		                 8);
		assert_true(peer_until(&p, MESSAGE_DONE));
		assert_int_equal(peer_end(&p), 0);
	}
	assert_int_equal(count_lines("log"), 8);
}

static void test_cancel(void **state)
{
	(void)state;
	struct peer p;
	start(&p, "PROBE_HANG=3");
	until_holding(&p);
	peer_send(&p, MESSAGE_CANCEL, NULL, NULL);
	expect_error(&p, "cancelled", "3 of 8 units are kept in '7.part'", 130);
	assert_false(there("out.probe.base"));
	start(&p, "PROBE_HANG=none");
	assert_true(peer_until(&p, MESSAGE_DONE));
	assert_int_equal(peer_end(&p), 0);
	assert_int_equal(count_lines("log"), 8);
	expect_output();
	/* before it has begun */
	peer_start(&p, probe, NULL);
	peer_send(&p, MESSAGE_CANCEL, NULL, NULL);
	expect_error(&p, "cancelled", "before it began", 130);
	/* SIGTERM alone asks for the same */
	write_job("7.json", "probe", "one.base", "other", "7.part", "", "");
	start(&p, "PROBE_HANG=0");
	until_holding(&p);
	kill(p.pid, SIGTERM);
	expect_error(&p, "cancelled", "", 130);
}

/* Killed in every unit in turn, then while it writes: only what is missing is done again. */
static void test_kill(void **state)
{
	(void)state;
	struct peer p;
	for (int unit = 0; unit < 8; unit++) {
		char hang[32];
		snprintf(hang, sizeof hang, "PROBE_HANG=%d", unit);
		start(&p, hang);
		until_holding(&p);
		assert_int_equal(p.n_units, unit > 0); /* the one that hung last time */
		kill(p.pid, SIGKILL);
		peer_drain(&p);
		assert_int_equal(peer_end(&p), 128 + SIGKILL);
		assert_int_equal(count_lines("log"), unit);
	}
	static const char *const places[] = { "PROBE_HANG=finish", "PROBE_HANG=write" };
	for (int i = 0; i < 2; i++) {
		start(&p, places[i]);
		until_holding(&p);
		/* the models, job, log, peer.log, part; half an output */
		assert_int_equal(count_files(), 6 + i);
		kill(p.pid, SIGKILL);
		peer_drain(&p);
		assert_int_equal(peer_end(&p), 128 + SIGKILL);
		assert_false(there("out.probe.base"));
	}
	start(&p, "PROBE_HANG=none");
	assert_true(peer_until(&p, MESSAGE_DONE));
	assert_int_equal(p.n_units, 0);
	assert_int_equal(peer_end(&p), 0);
	assert_int_equal(count_lines("log"), 8);
	assert_int_equal(count_files(), 6); /* the models, job, log, peer.log, output */
	expect_output();
}

/* A worker whose executive is gone ends by itself and leaves nothing but the part file. */
static void test_orphan(void **state)
{
	(void)state;
	struct peer p;
	start(&p, "PROBE_HANG=2");
	until_holding(&p);
	close(p.to);
	p.to = -1;
	peer_drain(&p);
	assert_int_equal(peer_end(&p), 130);
	assert_true(there("7.part"));
	start(&p, "PROBE_HANG=write");
	until_holding(&p);
	assert_int_equal(count_files(), 7);
	close(p.to);
	p.to = -1;
	peer_drain(&p);
	assert_int_equal(peer_end(&p), 130);
	assert_int_equal(count_files(), 6);
	/* nobody listens */
	peer_start(&p, probe, NULL);
	assert_true(peer_next(&p));
	close(p.from);
	peer_send(&p, MESSAGE_START, "job", "7.json");
	int status;
	assert_int_equal(waitpid(p.pid, &status, 0), p.pid);
	assert_true(WIFEXITED(status) && WEXITSTATUS(status) == 130);
	close(p.to);
	message_finish(&p.last);
	message_reader_finish(&p.reader);
}

static void test_progress_on_continue(void **state)
{
	(void)state;
	struct peer p;
	start(&p, "PROBE_HANG=3");
	until_holding(&p);
	for (int i = 0; i < 3; i++) {
		kill(p.pid, SIGSTOP);
		kill(p.pid, SIGCONT);
		assert_true(peer_until(&p, MESSAGE_PROGRESS));
		assert_int_equal(last_integer(&p, "done"), 3);
		assert_int_equal(last_integer(&p, "total"), 8);
	}
	peer_send(&p, MESSAGE_CANCEL, NULL, NULL);
	expect_error(&p, "cancelled", "", 130);
}

static void test_bad_packets(void **state)
{
	(void)state;
	static const struct {
		const char *bytes;
		size_t n;
		const char *sentence;
	} rows[] = {
		{ "\1\2\3\4\0\0\0\0", 8, "unknown type" },
		{ "\1\0\0\0\0\0\0\0", 8, "HELLO does not belong here" },
		{ "\100\0\0\0\0\0\1\1", 8, "START of" },
		{ "\100\0\0\0\3\0\0\0{x}", 11, "not JSON" },
		{ "\100\0\0\0\2\0\0\0[]", 10, "not a JSON object" },
		{ "\100\0\0\0\0\0\0\0", 8, "START without 'job'" },
		{ "\100\0\0\0\11\0\0\0{\"job\":3}", 17, "'job' of START is not a string" },
		{ "\101\0\0\0\4\0\0\0{\"a\"", 12, "not JSON" },
	};
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		struct peer p;
		peer_start(&p, probe, NULL);
		assert_int_equal(write(p.to, rows[i].bytes, rows[i].n), (ssize_t)rows[i].n);
		expect_error(&p, "internal", rows[i].sentence, 1);
	}
	/* in the middle of the work: it stops, the units are kept */
	struct peer p;
	start(&p, "PROBE_HANG=2");
	until_holding(&p);
	peer_send(&p, MESSAGE_START, "job", "7.json");
	expect_error(&p, "internal", "second START", 1);
	assert_true(there("7.part"));
	/* half a packet, then the end */
	peer_start(&p, probe, NULL);
	assert_int_equal(write(p.to, "\100\0\0\0\20\0\0\0{\"jo", 12), 12);
	close(p.to);
	p.to = -1;
	peer_drain(&p);
	assert_int_equal(peer_end(&p), 130);
	/* a packet in single bytes is a packet */
	static const char slow[] = "\100\0\0\0\20\0\0\0{\"job\":\"7.json\"}";
	peer_start(&p, probe, NULL);
	for (size_t i = 0; i + 1 < sizeof slow; i++)
		assert_int_equal(write(p.to, slow + i, 1), 1);
	assert_true(peer_until(&p, MESSAGE_DONE));
	assert_int_equal(peer_end(&p), 0);
}

static void test_bad_jobs(void **state)
{
	(void)state;
	static const struct {
		const char *input, *parameters, *class, *text;
		int exit_status;
	} rows[] = {
		{ "nix.base", "", "input", "nix.base", 1 },
		{ "one.base", "\"grid\":\"0x0\"", "parameter", "--grid '0x0'", 2 },
		{ "one.base", "\"gird\":\"1\"", "parameter", "no parameter 'gird'", 2 },
		{ "one.base", "\"units\":\"0\"", "internal", "no units", 1 },
		{ "two.base#2", "", "input", "two.base#2", 1 },
	};
	struct peer p;
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		write_job("7.json", "probe", rows[i].input, "out", "7.part", rows[i].parameters,
		          "");
		start(&p, "PROBE_HANG=none");
		expect_error(&p, rows[i].class, rows[i].text, rows[i].exit_status);
	}
	spill("7.json", "\1\2\3garbage");
	start(&p, "PROBE_HANG=none");
	expect_error(&p, "input", "7.json", 1);
	peer_start(&p, probe, NULL);
	peer_send(&p, MESSAGE_START, "job", "no\xc3\xa4/such.json");
	expect_error(&p, "input", "no\xc3\xa4/such.json", 1);
}

/* The indented lines behind that heading of docs/packets.md are a worker, and a good one. */
static void test_python_worker(void **state)
{
	(void)state;
	static const char python[] = "/usr/bin/python3";
	struct peer p;
	struct text script = { 0 };
	size_t n;
	if (!there(python))
		return;
	char *page = slurp(document, &n);
	char *line = strstr(page, "## A worker in another language");
	assert_non_null(line);
	while ((line = strchr(line, '\n')) && strncmp(++line, "## ", 3) != 0)
		if (strncmp(line, "    ", 4) == 0)
			text_addf(&script, "%.*s\n", (int)strcspn(line + 4, "\n"), line + 4);
		else
			text_add(&script, "\n");
	spill("count.py", script.s);
	text_finish(&script);
	free(page);

	struct ran r = run_hand(python, "count.py", "--describe", NULL);
	json_t *o = json_loads(r.out, 0, NULL);
	assert_string_equal(json_string_value(json_object_get(o, "name")), "count");
	json_decref(o);
	ran_finish(&r);
	write_job("7.json", "count", "one.base", "out", "7.part", "\"scale\":\"2\"", "");
	peer_start(&p, python, "count.py", NULL);
	peer_send(&p, MESSAGE_START, "job", "7.json");
	assert_true(peer_next(&p));
	assert_int_equal(p.last.type, MESSAGE_HELLO);
	assert_true(peer_next(&p));
	assert_int_equal(p.last.type, MESSAGE_RESULT);
	assert_true(peer_next(&p));
	assert_int_equal(p.last.type, MESSAGE_DONE);
	assert_int_equal(peer_end(&p), 0);
	char *input = slurp("one.base", &n), *count;
	size_t n_input = n;
	count = slurp("out.count.txt", &n);
	assert_int_equal(atol(count), 2 * n_input);
	free(input);
	free(count);
	write_job("7.json", "count", "nix.base", "out", "7.part", "", "");
	peer_start(&p, python, "count.py", NULL);
	peer_send(&p, MESSAGE_START, "job", "7.json");
	expect_error(&p, "input", "nix.base", 1);
}

int main(int argc, char **argv)
{
	if (argc < 4)
		return 1;
	document = argv[3];
	probe = realpath(argv[1], NULL); /* the tests change folders */
	signal(SIGPIPE, SIG_IGN);
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_whole_job, enter, leave),
		cmocka_unit_test_setup_teardown(test_up_to_date, enter, leave),
		cmocka_unit_test_setup_teardown(test_cancel, enter, leave),
		cmocka_unit_test_setup_teardown(test_kill, enter, leave),
		cmocka_unit_test_setup_teardown(test_orphan, enter, leave),
		cmocka_unit_test_setup_teardown(test_progress_on_continue, enter, leave),
		cmocka_unit_test_setup_teardown(test_bad_packets, enter, leave),
		cmocka_unit_test_setup_teardown(test_bad_jobs, enter, leave),
		cmocka_unit_test_setup_teardown(test_python_worker, enter, leave),
	};
	int failed = cmocka_run_group_tests_name("worker and packets", tests, NULL, NULL);
	free(probe);
	return failed;
}
