/* test_bad.c - workers that misbehave, each in its way: their job fails and says why, others go on. */
#include <fcntl.h>
#include <poll.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/inotify.h>
#include <sys/pidfd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "file.h"
#include "path.h"
#include "place.h"
#include "text.h"

static const char quick[] = "BATTEN_CANCEL_GRACE=0.1 BATTEN_TERM_GRACE=0.1 BATTEN_HELLO_GRACE=0.5 "
                            "BATTEN_END_GRACE=0.3 BATTEN_JOBS=40";

static int set_up(void **state)
{
	return place_new(state, quick);
}

static void each_fails_with_its_reason(void **state)
{
	static const struct {
		const char *role, *reason;
	} cases[] = {
		{ "crash", "ended by signal 11" },
		{ "early", "ended with status 9 before HELLO" },
		{ "quits", "ended with status 7" },
		{ "lazy", "ended without DONE" },
		{ "undone", "said DONE without a RESULT" },
		{ "lies", "ended with status 5" },
		{ "silent", "no HELLO" },
		{ "mute", "closed its pipe before HELLO" },
		{ "garbage", "what is no packet" },
		{ "json", "not JSON" },
		{ "unknown", "unknown type 99" },
		{ "huge", "2147483647 bytes" },
		{ "half", "middle of a packet" },
		{ "closes", "closed its pipe and did not end" },
		{ "older", "speaks protocol 2" },
		{ "hasty", "PROGRESS before HELLO" },
		{ "twice", "HELLO twice" },
		{ "error", "surface 3 is a point; take it out" },
		{ "lingers", "said DONE and did not end" },
		{ "flood", "floods its pipe" },
		{ "notes", "floods its log" },
	};
	enum { N = sizeof cases / sizeof *cases };
	struct place *p = *state;
	int64_t ids[N];
	char *gate = place_gate(p, "gate");
	/* one that behaves, beside them all */
	int64_t good = place_submit(p, "good", 3, gate);
	place_until(p, good, JOB_RUNNING);
	for (size_t i = 0; i < N; i++)
		ids[i] = place_submit(p, cases[i].role, 0, NULL);
	for (size_t i = 0; i < N; i++) {
		const struct Stats *s = place_end(p, ids[i]);
		if (s->state != JOB_FAILED || !s->reason || !strstr(s->reason, cases[i].reason))
			fail_msg("%s is %s: %s", cases[i].role, job_state_table[s->state].word,
			         s->reason ? s->reason : "");
	}
	place_open_gate(p, "gate", 3);
	assert_int_equal(place_end(p, good)->state, JOB_DONE);
	free(gate);
}

static void kill_ends_one_that_ignores_all(void **state)
{
	struct place *p = *state;
	int64_t id = place_submit(p, "stubborn", 0, NULL);
	place_until(p, id, JOB_RUNNING);
	pid_t pid = place_job(p, id)->pid;
	assert_int_equal(place_ask(p, MESSAGE_KILL, id), ST_OK);
	assert_int_equal(process_state(pid), 0);
	const struct Stats *s = place_job(p, id);
	assert_int_equal(s->state, JOB_KILLED);
	assert_string_equal(s->reason, "killed by you");
}

static void suspend_reaches_one_that_waits_in_vfork(void **state)
{
	struct place *p = *state;
	int64_t id = place_submit(p, "begets", 0, NULL);
	place_until_done(p, id, 1);
	const pid_t pid = place_job(p, id)->pid;
	while (process_state(pid) != 'D') /* it sends its progress just before */
		assert_true(process_state(pid) != 0);
	assert_int_equal(place_ask(p, MESSAGE_SUSPEND, id), ST_OK);
	assert_int_equal(place_job(p, id)->state, JOB_SUSPENDED);
	assert_int_equal(place_ask(p, MESSAGE_KILL, id), ST_OK);
	assert_int_equal(place_job(p, id)->state, JOB_KILLED);
}

static void kill_reaches_one_that_is_suspended(void **state)
{
	struct place *p = *state;
	int64_t id = place_submit(p, "stubborn", 0, NULL);
	place_until(p, id, JOB_RUNNING);
	assert_int_equal(place_ask(p, MESSAGE_SUSPEND, id), ST_OK);
	assert_int_equal(place_ask(p, MESSAGE_KILL, id), ST_OK);
	assert_int_equal(place_job(p, id)->state, JOB_KILLED);
}

/* The child's number is in the log: "child 123". */
static pid_t child_of(struct place *p, int64_t id)
{
	char *text;
	size_t n;
	assert_int_equal(file_read(place_job(p, id)->log, 1 << 20, &text, &n, NULL), ST_OK);
	const char *at = strstr(text, "child ");
	assert_non_null(at);
	pid_t pid = (pid_t)atol(at + 6);
	free(text);
	return pid;
}

static void what_a_worker_leaves_behind_dies_with_it(void **state)
{
	struct place *p = *state;
	int64_t id = place_submit(p, "grandchild", 0, NULL);
	assert_int_equal(place_end(p, id)->state, JOB_DONE);
	/* it has let go of the pipe; the rest of its end may take a moment more */
	int fd = pidfd_open(child_of(p, id), 0);
	assert_true(fd < 0 || process_gone(fd));
	if (fd >= 0)
		close(fd);
}

static void a_pipe_held_from_far_delays_the_end_only_a_while(void **state)
{
	struct place *p = *state;
	char *fifo = path_join(p->folder, "escaped.fifo");
	assert_int_equal(mkfifo(fifo, 0600), 0);
	int64_t id = place_submit(p, "escapes", 0, NULL);
	assert_int_equal(place_end(p, id)->state, JOB_DONE);
	int fd = open(fifo, O_RDWR); /* let it go */
	assert_true(fd >= 0);
	close(fd);
	free(fifo);
}

static bool log_was_cut(const char *path)
{
	char *text;
	size_t n;
	assert_int_equal(file_read(path, 1 << 30, &text, &n, NULL), ST_OK);
	bool cut = memmem(text, n, "what stood here was cut", 23) != NULL;
	assert_true(!cut || n < 16 << 20);
	free(text);
	return cut;
}

static void a_log_has_its_limits(void **state)
{
	struct place *p = *state;
	int64_t id = place_submit(p, "babbles", 0, NULL); /* 26 MB */
	place_until(p, id, JOB_RUNNING);
	const char *log = place_job(p, id)->log;
	struct pollfd fd = { .fd = inotify_init1(IN_CLOEXEC), .events = POLLIN };
	assert_true(inotify_add_watch(fd.fd, log, IN_MODIFY) >= 0);
	while (!log_was_cut(log)) {
		char events[4096];
		assert_true(poll(&fd, 1, 20000) > 0);
		assert_true(read(fd.fd, events, sizeof events) > 0);
	}
	close(fd.fd);
	assert_int_equal(place_ask(p, MESSAGE_KILL, id), ST_OK);
}

#define T(name) cmocka_unit_test_setup_teardown(name, set_up, place_gone)

int main(void)
{
	signal(SIGPIPE, SIG_IGN);
	const struct CMUnitTest tests[] = {
		T(each_fails_with_its_reason),
		T(kill_ends_one_that_ignores_all),
		T(kill_reaches_one_that_is_suspended),
		T(suspend_reaches_one_that_waits_in_vfork),
		T(what_a_worker_leaves_behind_dies_with_it),
		T(a_pipe_held_from_far_delays_the_end_only_a_while),
		T(a_log_has_its_limits),
	};
	return cmocka_run_group_tests_name("bad", tests, NULL, NULL);
}
