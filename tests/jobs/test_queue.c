/* test_queue.c - the queue: order, limits, dependencies, ends, telling; no process, no waiting. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fake.h"
#include "job.h"

static void runs_a_job_to_its_end(void **state)
{
	struct fake *f = *state;
	int64_t id = fake_submit(f, 0, 1, 0);
	assert_int_equal(id, 1);
	assert_int_equal(fake_state(f, id), JOB_STARTING);
	assert_string_equal(fake_log(f), "start 1;");
	fake_hello(f, id);
	assert_string_equal(fake_log(f), "START 1;");
	assert_int_equal(fake_state(f, id), JOB_RUNNING);
	assert_string_equal(fake_row(f, id), "running");
	fake_packet(f, id, MESSAGE_RESULT,
	            json_pack("{s:s, s:s, s:{s:f}}", "path", "/out.txt", "kind", "text", "figures",
	                      "K_max", 0.25));
	fake_packet(f, id, MESSAGE_DONE, NULL);
	fake_exit(f, id, 0, 0);
	assert_int_equal(fake_state(f, id), JOB_RUNNING);
	fake_eof(f, id);
	assert_int_equal(fake_state(f, id), JOB_DONE);
	assert_string_equal(fake_row(f, id), "done");
	const struct Stats *s = queue_find(f->q, id);
	assert_int_equal(s->n_outputs, 1);
	assert_string_equal(s->outputs[0].path, "/out.txt");
	assert_int_equal(s->pid, 0);
	assert_int_equal(s->peak_kib, 1234);
	assert_null(s->reason);
	assert_false(queue_busy(f->q));
}

static void ends_only_when_pipe_and_process_have(void **state)
{
	struct fake *f = *state;
	for (int order = 0; order < 2; order++) {
		int64_t id = fake_submit(f, 0, 1, 0);
		fake_hello(f, id);
		(order ? fake_eof(f, id) : fake_exit(f, id, 0, 0));
		assert_false(job_state_table[fake_state(f, id)].over);
		(order ? fake_exit(f, id, 0, 0) : fake_eof(f, id));
		assert_int_equal(fake_state(f, id), JOB_FAILED);
	}
}

static void waits_for_the_second_end_no_longer_than_allowed(void **state)
{
	struct fake *f = *state;
	int64_t exited = fake_submit(f, 0, 1, 0), closed = fake_submit(f, 0, 1, 0);
	fake_hello(f, exited);
	fake_hello(f, closed);
	fake_packet(f, exited, MESSAGE_RESULT, json_pack("{s:s, s:s}", "path", "/o", "kind", "t"));
	fake_packet(f, exited, MESSAGE_DONE, NULL);
	fake_exit(f, exited, 0, 0);
	fake_eof(f, closed);
	fake_wait(f, 4.9);
	assert_int_equal(fake_state(f, exited), JOB_RUNNING);
	assert_int_equal(fake_state(f, closed), JOB_RUNNING);
	fake_log(f);
	fake_wait(f, 0.2);
	assert_int_equal(fake_state(f, exited), JOB_DONE);
	assert_int_equal(fake_state(f, closed), JOB_ENDING);
	assert_non_null(strstr(fake_log(f), "kill 2;"));
	fake_exit(f, closed, 0, 9);
	assert_int_equal(fake_state(f, closed), JOB_FAILED);
	assert_string_equal(fake_reason(f, closed),
	                    "worker play closed its pipe and did not end within 5 s");
}

static void says_why_a_worker_failed(void **state)
{
	static const struct {
		bool hello, done;
		int status, signal;
		const char *reason;
	} cases[] = {
		{ true, false, 0, 11, "ended by signal 11" },
		{ true, false, 0, 9, "killed from outside" },
		{ true, false, 3, 0, "ended with status 3" },
		{ true, true, 3, 0, "ended with status 3" },
		{ true, false, 0, 0, "without DONE" },
		{ true, true, 0, 0, "DONE without a RESULT" },
		{ false, false, 0, 0, "before HELLO" },
		{ false, false, 126, 0, "could not be started" },
	};
	struct fake *f = *state;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		int64_t id = fake_submit(f, 0, 1, 0);
		if (cases[i].hello)
			fake_hello(f, id);
		if (cases[i].done)
			fake_packet(f, id, MESSAGE_DONE, NULL);
		fake_exit(f, id, cases[i].status, cases[i].signal);
		fake_eof(f, id);
		assert_int_equal(fake_state(f, id), JOB_FAILED);
		assert_non_null(strstr(fake_reason(f, id), cases[i].reason));
	}
}

static void starts_by_priority_then_age_within_its_slots(void **state)
{
	struct fake *f = *state;
	int64_t a = fake_submit(f, 0, 1, 0), b = fake_submit(f, 0, 1, 0);
	int64_t c = fake_submit(f, 0, 1, 0), d = fake_submit(f, 5, 1, 0);
	int64_t e = fake_submit(f, -1, 1, 0);
	assert_string_equal(fake_log(f), "start 1;start 2;");
	assert_string_equal(fake_reason(f, c), "slots full");
	fake_success(f, a);
	assert_int_equal(fake_state(f, d), JOB_STARTING);
	assert_int_equal(fake_state(f, c), JOB_QUEUED);
	assert_int_equal(queue_priority(f->q, e, 9, NULL), ST_OK);
	fake_success(f, b);
	assert_int_equal(fake_state(f, e), JOB_STARTING);
	fake_success(f, d);
	assert_int_equal(fake_state(f, c), JOB_STARTING);
	assert_int_equal(queue_priority(f->q, d, 9, NULL), ST_INPUT);
}

static void keeps_within_threads_and_memory(void **state)
{
	struct fake *f = *state;
	int64_t a = fake_submit(f, 0, 3, 0), wide = fake_submit(f, 0, 2, 0);
	int64_t behind = fake_submit(f, 0, 1, 0);
	assert_int_equal(fake_state(f, a), JOB_STARTING);
	assert_string_equal(fake_reason(f, wide), "threads: 3 of 4 in use, it wants 2");
	assert_string_equal(fake_reason(f, behind), "behind job 2");
	fake_success(f, a);
	assert_int_equal(fake_state(f, wide), JOB_STARTING);
	assert_int_equal(fake_state(f, behind), JOB_STARTING);
	fake_success(f, wide);
	fake_success(f, behind);
	/* wider than all there is: alone */
	int64_t huge = fake_submit(f, 0, 99, 0);
	assert_int_equal(fake_state(f, huge), JOB_STARTING);
	fake_success(f, huge);

	f->limits.job_memory_mib = 600;
	fake_restart(f);
	int64_t m = fake_submit(f, 0, 1, 0), n = fake_submit(f, 0, 1, 0);
	assert_int_equal(fake_state(f, m), JOB_STARTING);
	assert_string_equal(fake_reason(f, n), "memory: 600 of 1000 MiB in use, it wants 600");
	fake_success(f, m);
	assert_int_equal(fake_state(f, n), JOB_STARTING);
}

static void dependents_wait_and_fail_in_chains(void **state)
{
	struct fake *f = *state;
	int64_t a = fake_submit(f, 0, 1, 0), b = fake_submit(f, 0, 1, a);
	int64_t c = fake_submit(f, 0, 1, b);
	assert_string_equal(fake_reason(f, b), "after 1");
	assert_int_equal(fake_submit(f, 0, 1, 99), 0); /* no such job */
	fake_success(f, a);
	assert_int_equal(fake_state(f, b), JOB_STARTING);
	assert_int_equal(fake_state(f, c), JOB_QUEUED);
	fake_event(f, b, EV_KILL);
	fake_exit(f, b, 130, 0);
	fake_eof(f, b);
	assert_int_equal(fake_state(f, c), JOB_FAILED);
	assert_non_null(strstr(fake_reason(f, c), "job 2, which it waits for, is killed"));
	int64_t d = fake_submit(f, 0, 1, c); /* on one that has failed already */
	assert_int_equal(fake_state(f, d), JOB_FAILED);
	assert_int_equal(fake_event(f, b, EV_RETRY), ST_OK);
	assert_int_equal(fake_event(f, c, EV_RETRY), ST_OK);
	assert_int_equal(fake_state(f, c), JOB_QUEUED);
	fake_success(f, b);
	assert_int_equal(fake_state(f, c), JOB_STARTING);
}

static void a_full_ledger_stops_nothing_that_runs(void **state)
{
	struct fake *f = *state;
	int64_t a = fake_submit(f, 0, 1, 0), b = fake_submit(f, 0, 1, 0),
	        c = fake_submit(f, 0, 1, 0);
	fake_hello(f, a);
	f->full = true;
	assert_int_equal(fake_submit(f, 0, 1, 0), 0); /* refused: it could not be kept */
	fake_log(f);
	fake_success(f, b);
	assert_string_equal(queue_fault(f->q), "the disk is full");
	assert_null(strstr(f->log.s, "told 2 done"));
	assert_string_equal(fake_log(f), "START 2;forget 2;"); /* and c is not started */
	assert_int_equal(fake_state(f, a), JOB_RUNNING);
	f->full = false;
	fake_wait(f, 1.1);
	assert_null(queue_fault(f->q));
	assert_string_equal(fake_row(f, b), "done");
	assert_int_equal(fake_state(f, c), JOB_STARTING);
	assert_int_equal(fake_submit(f, 0, 1, 0), 4);
}

static void submissions_and_ends_outlast_the_power(void **state)
{
	struct fake *f = *state;
	int64_t id = fake_submit(f, 0, 1, 0);
	fake_success(f, id);
	assert_true(f->unsynced > 0);
	fake_wait(f, 0.2);
	assert_int_equal(f->unsynced, 0);
	assert_string_equal(fake_row(f, id), "done");
	fake_wait(f, 100);
	assert_true(isinf(queue_deadline(f->q))); /* and then there is rest */
}

static void a_refused_start_fails_the_job_alone(void **state)
{
	struct fake *f = *state;
	f->refuse = true;
	int64_t id = fake_submit(f, 0, 1, 0), after = fake_submit(f, 0, 1, id);
	assert_int_equal(fake_state(f, id), JOB_FAILED);
	assert_string_equal(fake_reason(f, id), "no processes are left");
	assert_int_equal(fake_state(f, after), JOB_FAILED);
	f->refuse = false;
	assert_int_equal(fake_event(f, id, EV_RETRY), ST_OK);
	assert_int_equal(fake_state(f, id), JOB_STARTING);
}

static void time_left_leaves_suspended_time_out(void **state)
{
	struct fake *f = *state;
	int64_t id = fake_submit(f, 0, 1, 0);
	fake_hello(f, id);
	fake_packet(f, id, MESSAGE_PROGRESS, json_pack("{s:i, s:i}", "done", 10, "total", 100));
	assert_true(isnan(queue_find(f->q, id)->eta_s)); /* no pace yet */
	fake_wait(f, 10);
	fake_packet(f, id, MESSAGE_PROGRESS, json_pack("{s:i, s:i}", "done", 30, "total", 100));
	assert_true(fabs(queue_find(f->q, id)->eta_s - 35) < 1e-9);
	fake_event(f, id, EV_SUSPEND);
	fake_stopped(f, id, true);
	fake_wait(f, 1000);
	const struct Stats *s = queue_find(f->q, id);
	assert_true(fabs(s->eta_s - 35) < 1e-9);
	assert_true(fabs(s->suspended_s - 1000) < 1e-9);
	fake_event(f, id, EV_ACTIVATE);
	fake_wait(f, 10);
	fake_packet(f, id, MESSAGE_PROGRESS, json_pack("{s:i, s:i}", "done", 50, "total", 100));
	s = queue_find(f->q, id);
	assert_true(fabs(s->eta_s - 25) < 1e-9);
	assert_true(fabs(s->wall_s - 1020) < 1e-9);
	assert_true(fabs(stats_fraction(s) - 0.5) < 1e-12);
}

static int count_told(const struct fake *f)
{
	int n = 0;
	for (const char *p = f->log.s; p && (p = strstr(p, "told ")); p++)
		n++;
	return n;
}

static void progress_is_told_ten_times_a_second(void **state)
{
	struct fake *f = *state;
	int64_t id = fake_submit(f, 0, 1, 0);
	fake_hello(f, id);
	fake_log(f);
	for (int i = 0; i < 1000; i++) {
		fake_packet(f, id, MESSAGE_PROGRESS,
		            json_pack("{s:i, s:i}", "done", i, "total", 1000));
		fake_wait(f, 0.001);
	}
	assert_in_range(count_told(f), 9, 11);
	fake_wait(f, 1); /* the last one is not forgotten */
	assert_int_equal(queue_find(f->q, id)->done, 999);
	assert_in_range(count_told(f), 10, 11);
}

static void floods_break_only_their_own_job(void **state)
{
	struct fake *f = *state;
	int64_t packets = fake_submit(f, 0, 1, 0), notes = fake_submit(f, 0, 1, 0);
	fake_hello(f, packets);
	fake_hello(f, notes);
	struct message m = { .type = MESSAGE_PROGRESS,
		             .body = json_pack("{s:i, s:i}", "done", 1, "total", 2) };
	for (int i = 0; i < 400000; i++)
		f->sink.packet(f->sink.data, packets, &m);
	assert_int_equal(fake_state(f, packets), JOB_RUNNING); /* a burst is no flood */
	for (int i = 0; i < 200000; i++)
		f->sink.packet(f->sink.data, packets, &m);
	message_finish(&m);
	assert_int_equal(fake_state(f, packets), JOB_ENDING);
	assert_int_equal(fake_state(f, notes), JOB_RUNNING);
	for (int i = 0; i < 1001; i++)
		fake_packet(f, notes, MESSAGE_NOTE,
		            json_pack("{s:s, s:s}", "level", "info", "text", "x"));
	assert_int_equal(fake_state(f, notes), JOB_ENDING);
	fake_exit(f, packets, 0, 9);
	fake_eof(f, packets);
	assert_non_null(strstr(fake_reason(f, packets), "floods its pipe"));
}

static void forgets_only_what_has_ended(void **state)
{
	struct fake *f = *state;
	int64_t ids[] = { 1, 2 };
	fake_submit(f, 0, 1, 0);
	fake_submit(f, 0, 1, 0);
	fake_success(f, 1);
	assert_int_equal(queue_forget(f->q, ids, 2, NULL), ST_INPUT);
	assert_int_equal(queue_count(f->q), 2);
	assert_int_equal(queue_forget(f->q, ids, 1, NULL), ST_OK);
	assert_int_equal(queue_count(f->q), 1);
	assert_null(queue_find(f->q, 1));
	assert_string_equal(fake_row(f, 1), "");
	fake_success(f, 2);
	assert_int_equal(queue_forget(f->q, ids + 1, 1, NULL), ST_OK);
	fake_restart(f);
	assert_int_equal(fake_submit(f, 0, 1, 0), 3); /* numbers are never used again */
}

static void a_batch_is_queued_whole_or_not_at_all(void **state)
{
	struct fake *f = *state;
	char worker[] = "play", output[] = "/out";
	int64_t after[] = { -1, 77 }, first;
	struct Stats s[2];
	for (int i = 0; i < 2; i++) {
		stats_init(&s[i]);
		s[i].worker = worker;
		s[i].output = output;
	}
	s[1].after = after;
	s[1].n_after = 2;
	assert_int_equal(queue_submit(f->q, s, 2, &first, NULL), ST_PARAMETER);
	assert_int_equal(queue_count(f->q), 0);
	s[1].n_after = 1; /* the first of the batch */
	assert_int_equal(queue_submit(f->q, s, 2, &first, NULL), ST_OK);
	assert_int_equal(first, 1);
	queue_turn(f->q);
	assert_string_equal(fake_reason(f, 2), "after 1");
}

/* The list of changes has room for each job once: progress that waits to be told is in it already. */
static void a_job_is_among_the_changed_once(void **state)
{
	struct fake *f = *state;
	for (int i = 0; i < 40; i++) {
		int64_t id = fake_submit(f, 0, 1, 0);
		fake_hello(f, id);
		for (int done = 0; done < 2; done++)
			fake_packet(f, id, MESSAGE_PROGRESS,
			            json_pack("{s:i, s:i}", "done", done, "total", 2));
		assert_int_equal(f->q->n_changed, 1);
		fake_exit(f, id, 1, 0);
		fake_eof(f, id);
		assert_int_equal(f->q->n_changed, 0);
	}
}

#define T(name) cmocka_unit_test_setup_teardown(name, fake_new, fake_gone)

static void one_that_was_stopped_from_outside_is_killed(void **state)
{
	struct fake *f = *state;
	for (int said = 0; said < 2; said++) {
		int64_t id = fake_submit(f, 0, 1, 0);
		fake_hello(f, id);
		if (said)
			fake_packet(
			        f, id, MESSAGE_ERROR,
			        json_pack("{s:s, s:s}", "class", "cancelled", "text", "cancelled"));
		fake_exit(f, id, 130, 0);
		fake_eof(f, id);
		assert_int_equal(fake_state(f, id), JOB_KILLED);
		assert_non_null(strstr(fake_reason(f, id), "stopped from outside"));
	}
}

/* fake_init lets one or two stay in memory. */
static void what_is_over_leaves_memory_but_not_what_is_waited_for(void **state)
{
	struct fake *f = *state;
	int64_t bad = fake_submit(f, 0, 1, 0), good = fake_submit(f, 0, 1, 0);
	assert_int_equal(fake_event(f, bad, EV_KILL), ST_OK);
	fake_exit(f, bad, 0, 15);
	fake_eof(f, bad);
	fake_success(f, good);
	assert_int_equal(queue_hold(f->q, true, NULL), ST_OK);
	int64_t waits = fake_submit_after_any(f, bad), last = 0;
	assert_int_equal(queue_hold(f->q, false, NULL), ST_OK);
	for (int i = 0; i < 10; i++) {
		last = fake_submit(f, 0, 1, 0);
		fake_success(f, last);
		assert_in_range(queue_count(f->q), 1, 4);
	}
	assert_true(queue_holds(f->q, bad) && queue_holds(f->q, waits));
	assert_false(queue_holds(f->q, good));
	for (int64_t id = 1; id <= last; id++)
		assert_int_equal(queue_find(f->q, id)->id, id);
	assert_int_equal(fake_state(f, good), JOB_DONE);
	/* comes back when it is waited for, or tried again */
	int64_t after = fake_submit(f, 0, 1, good);
	assert_int_equal(fake_state(f, after), JOB_STARTING);
	fake_success(f, after);
	fake_restart(f);
	assert_true(queue_holds(f->q, bad) && queue_holds(f->q, waits));
	assert_int_equal(fake_event(f, bad, EV_RETRY), ST_OK);
	assert_int_equal(fake_state(f, bad), JOB_STARTING);
	fake_success(f, bad);
	/* the ledger forgets what is only there, too */
	assert_false(queue_holds(f->q, good));
	assert_int_equal(queue_forget(f->q, &good, 1, NULL), ST_OK);
	assert_false(queue_has(f->q, good));
	assert_string_equal(fake_row(f, good), "");
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		T(runs_a_job_to_its_end),
		T(ends_only_when_pipe_and_process_have),
		T(waits_for_the_second_end_no_longer_than_allowed),
		T(says_why_a_worker_failed),
		T(starts_by_priority_then_age_within_its_slots),
		T(keeps_within_threads_and_memory),
		T(dependents_wait_and_fail_in_chains),
		T(a_full_ledger_stops_nothing_that_runs),
		T(submissions_and_ends_outlast_the_power),
		T(a_refused_start_fails_the_job_alone),
		T(time_left_leaves_suspended_time_out),
		T(progress_is_told_ten_times_a_second),
		T(floods_break_only_their_own_job),
		T(forgets_only_what_has_ended),
		T(a_batch_is_queued_whole_or_not_at_all),
		T(a_job_is_among_the_changed_once),
		T(one_that_was_stopped_from_outside_is_killed),
		T(what_is_over_leaves_memory_but_not_what_is_waited_for),
	};
	return cmocka_run_group_tests_name("queue", tests, NULL, NULL);
}
