/* test_states.c - what can happen to a job in each state, over crashes and ends of the service too. */
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fake.h"
#include "text.h"

static void a_suspended_job_gives_its_slot_away(void **state)
{
	struct fake *f = *state;
	fake_submit(f, 0, 1, 0);
	fake_submit(f, 0, 1, 0);
	fake_submit(f, 0, 1, 0);
	fake_hello(f, 1);
	fake_log(f);
	assert_int_equal(fake_event(f, 1, EV_SUSPEND), ST_OK);
	assert_string_equal(fake_log(f), "stop 1;");
	assert_int_equal(fake_state(f, 1), JOB_RUNNING); /* not seen yet */
	fake_stopped(f, 1, true);
	assert_int_equal(fake_state(f, 1), JOB_SUSPENDED);
	assert_string_equal(fake_reason(f, 1), "suspended by you");
	assert_string_equal(fake_log(f), "start 3;");
	assert_int_equal(fake_event(f, 1, EV_ACTIVATE), ST_OK);
	assert_string_equal(fake_log(f), "continue 1;");
	assert_int_equal(fake_state(f, 1), JOB_RUNNING);
	fake_stopped(f, 1, false);
	assert_int_equal(fake_state(f, 1), JOB_RUNNING);
}

static void sees_stops_from_outside(void **state)
{
	struct fake *f = *state;
	int64_t id = fake_submit(f, 0, 1, 0);
	fake_hello(f, id);
	fake_stopped(f, id, true);
	assert_int_equal(fake_state(f, id), JOB_SUSPENDED);
	assert_string_equal(fake_reason(f, id), "stopped by a signal from outside");
	fake_stopped(f, id, false);
	assert_int_equal(fake_state(f, id), JOB_RUNNING);
}

/* Slurm does not always take the order: the job goes on, and its limits hold again. */
static void a_stop_that_is_refused_is_forgotten(void **state)
{
	struct fake *f = *state;
	int64_t id = fake_submit(f, 0, 1, 0);
	fake_hello(f, id);
	fake_refused(f, id); /* nobody asked */
	assert_int_equal(fake_event(f, id, EV_SUSPEND), ST_OK);
	assert_true(queue_stopping(f->q, id));
	fake_refused(f, id);
	assert_false(queue_stopping(f->q, id));
	assert_int_equal(fake_state(f, id), JOB_RUNNING);
	assert_string_equal(fake_reason(f, id), "");
	assert_int_equal(fake_event(f, id, EV_SUSPEND), ST_OK);
	fake_stopped(f, id, true);
	assert_int_equal(fake_state(f, id), JOB_SUSPENDED);
	assert_string_equal(fake_reason(f, id), "suspended by you");

	id = fake_submit(f, 0, 1, 0); /* before HELLO, which then has its time again */
	assert_int_equal(fake_event(f, id, EV_SUSPEND), ST_OK);
	fake_wait(f, 100);
	fake_refused(f, id);
	fake_wait(f, 9);
	assert_int_equal(fake_state(f, id), JOB_STARTING);
	fake_wait(f, 2);
	fake_exit(f, id, 0, 9);
	fake_eof(f, id);
	assert_int_equal(fake_state(f, id), JOB_FAILED);
}

/* However long the sentence is and wherever it is cut, the record is JSON. */
static void a_long_reason_ends_with_a_character(void **state)
{
	static const char *const letters[] = { "x", "\xc3\xa9", "\xe2\x82\xac",
		                               "\xf0\x9f\x98\x80" };
	struct fake *f = *state;
	for (size_t k = 0; k < sizeof letters / sizeof *letters; k++)
		for (int more = 0; more < 4; more++) {
			struct text t = { 0 };
			text_add_bytes(&t, "abc", (size_t)more);
			for (int i = 0; i < 1500; i++)
				text_add(&t, letters[k]);
			int64_t id = fake_submit(f, 0, 1, 0);
			fake_hello(f, id);
			fake_packet(f, id, MESSAGE_ERROR,
			            json_pack("{s:s, s:s}", "class", "input", "text", t.s));
			fake_exit(f, id, 1, 0);
			fake_eof(f, id);
			text_finish(&t);
			assert_int_equal(fake_state(f, id), JOB_FAILED);
			assert_true(strlen(fake_reason(f, id)) > 1000);
			json_t *o = stats_to_json(queue_find(f->q, id));
			assert_non_null(o);
			json_decref(o);
		}
}

static void suspends_before_hello(void **state)
{
	struct fake *f = *state;
	int64_t id = fake_submit(f, 0, 1, 0);
	assert_int_equal(fake_event(f, id, EV_SUSPEND), ST_OK);
	fake_stopped(f, id, true);
	fake_wait(f, 100); /* no HELLO can come, none is missed */
	assert_int_equal(fake_state(f, id), JOB_SUSPENDED);
	fake_event(f, id, EV_ACTIVATE);
	assert_int_equal(fake_state(f, id), JOB_STARTING);
	fake_wait(f, 9);
	fake_hello(f, id);
	assert_int_equal(fake_state(f, id), JOB_RUNNING);
}

static void kills_in_three_steps(void **state)
{
	struct fake *f = *state;
	int64_t id = fake_submit(f, 0, 1, 0);
	fake_hello(f, id);
	fake_log(f);
	assert_int_equal(fake_event(f, id, EV_KILL), ST_OK);
	assert_int_equal(fake_state(f, id), JOB_ENDING);
	assert_string_equal(fake_log(f), "CANCEL 1;continue 1;");
	fake_wait(f, 1.9);
	assert_string_equal(fake_log(f), "");
	fake_wait(f, 0.2);
	assert_string_equal(fake_log(f), "terminate 1;");
	fake_wait(f, 2.8);
	assert_string_equal(fake_log(f), "");
	fake_wait(f, 0.2);
	assert_string_equal(fake_log(f), "kill 1;");
	fake_exit(f, id, 0, 9);
	fake_eof(f, id);
	assert_int_equal(fake_state(f, id), JOB_KILLED);
	assert_string_equal(fake_reason(f, id), "killed by you");
	assert_string_equal(fake_row(f, id), "killed");
}

static void a_suspended_job_hears_its_kill(void **state)
{
	struct fake *f = *state;
	int64_t id = fake_submit(f, 0, 1, 0);
	fake_hello(f, id);
	fake_event(f, id, EV_SUSPEND);
	fake_stopped(f, id, true);
	fake_log(f);
	assert_int_equal(fake_event(f, id, EV_KILL), ST_OK);
	assert_string_equal(fake_log(f), "CANCEL 1;continue 1;");
	fake_packet(f, id, MESSAGE_ERROR,
	            json_pack("{s:s, s:s}", "class", "cancelled", "text", "x"));
	fake_exit(f, id, 130, 0);
	fake_eof(f, id);
	assert_int_equal(fake_state(f, id), JOB_KILLED);
}

static void a_job_that_was_done_before_the_kill_is_done(void **state)
{
	struct fake *f = *state;
	int64_t id = fake_submit(f, 0, 1, 0);
	fake_hello(f, id);
	fake_packet(f, id, MESSAGE_RESULT, json_pack("{s:s, s:s}", "path", "/o", "kind", "t"));
	fake_event(f, id, EV_KILL);
	fake_packet(f, id, MESSAGE_DONE, NULL);
	fake_exit(f, id, 0, 0);
	fake_eof(f, id);
	assert_int_equal(fake_state(f, id), JOB_DONE);
}

static void no_hello_fails_the_job(void **state)
{
	struct fake *f = *state;
	int64_t id = fake_submit(f, 0, 1, 0);
	fake_log(f);
	fake_wait(f, 10.1);
	assert_string_equal(fake_log(f), "kill 1;");
	fake_exit(f, id, 0, 9);
	fake_eof(f, id);
	assert_string_equal(fake_reason(f, id),
	                    "no HELLO from worker play within 10 s; see 'batten log 1'");
}

static void what_cannot_be_is_refused_in_words(void **state)
{
	static const struct {
		enum job_event event;
		const char *text;
	} cases[] = {
		{ EV_HOLD, "job 1 is done and cannot be held" },
		{ EV_RELEASE, "job 1 is done and cannot be released" },
		{ EV_SUSPEND, "job 1 is done and cannot be suspended" },
		{ EV_ACTIVATE, "job 1 is done and cannot be activated" },
		{ EV_KILL, "job 1 is done and cannot be killed" },
		{ EV_RETRY, "job 1 is done and cannot be tried again" },
	};
	struct fake *f = *state;
	struct report_store store;
	fake_submit(f, 0, 1, 0);
	fake_success(f, 1);
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		report_store_init(&store);
		assert_int_equal(queue_event(f->q, 1, cases[i].event, "you", &store.report),
		                 ST_INPUT);
		assert_string_equal(store.error, cases[i].text);
		assert_false(job_can(JOB_DONE, cases[i].event));
	}
	assert_int_equal(queue_event(f->q, 7, EV_KILL, "you", NULL), ST_INPUT);
}

static void every_state_can_be_left_or_is_over(void **state)
{
	(void)state;
	for (int s = 0; s < N_JOB_STATES; s++) {
		int ways = 0;
		for (int e = 0; e < N_JOB_EVENTS; e++)
			ways += job_can((enum job_state)s, (enum job_event)e);
		assert_true(ways > 0 || s == JOB_DONE);
		assert_int_equal(job_can((enum job_state)s, EV_KILL), !job_state_table[s].over);
	}
}

static void a_restart_finds_every_job(void **state)
{
	struct fake *f = *state;
	int64_t running = fake_submit(f, 0, 1, 0), suspended = fake_submit(f, 0, 1, 0);
	fake_hello(f, running);
	fake_hello(f, suspended);
	fake_event(f, suspended, EV_SUSPEND);
	fake_stopped(f, suspended, true);
	int64_t starting = fake_submit(f, 0, 1, 0), held = fake_submit(f, 0, 1, 0);
	int64_t queued = fake_submit(f, 9, 1, 0);
	fake_event(f, held, EV_HOLD);
	f->limits.jobs = 1;
	fake_restart(f);
	/* what ran goes on first, whatever the priority of those that wait */
	assert_string_equal(fake_log(f), "bury 1001;bury 1002;bury 1003;start 1;");
	assert_int_equal(fake_state(f, starting), JOB_QUEUED);
	assert_int_equal(fake_state(f, suspended), JOB_SUSPENDED);
	assert_int_equal(fake_state(f, held), JOB_HELD);
	assert_int_equal(fake_state(f, queued), JOB_QUEUED);
	assert_string_equal(fake_row(f, starting), "queued");
	fake_success(f, running);
	assert_int_equal(fake_state(f, starting), JOB_STARTING);
	/* suspended without a process: first in line */
	assert_int_equal(fake_event(f, suspended, EV_ACTIVATE), ST_OK);
	assert_int_equal(fake_state(f, suspended), JOB_QUEUED);
	fake_success(f, starting);
	assert_int_equal(fake_state(f, suspended), JOB_STARTING);
	assert_int_equal(fake_submit(f, 0, 1, 0), 6);
}

static void a_restart_loses_what_cannot_go_on(void **state)
{
	struct fake *f = *state;
	int64_t id = fake_submit(f, 0, 1, 0), killed = fake_submit(f, 0, 1, 0);
	fake_hello(f, id);
	fake_event(f, killed, EV_KILL);
	f->missing = true;
	fake_restart(f);
	assert_int_equal(fake_state(f, id), JOB_LOST);
	assert_non_null(strstr(fake_reason(f, id), "input of job 1 is gone"));
	assert_int_equal(fake_state(f, killed), JOB_KILLED); /* it was to be */
	assert_false(queue_busy(f->q));
}

static void leaving_queues_what_runs(void **state)
{
	struct fake *f = *state;
	int64_t a = fake_submit(f, 0, 1, 0), b = fake_submit(f, 0, 1, 0),
	        c = fake_submit(f, 0, 1, 0);
	fake_hello(f, a);
	fake_hello(f, b);
	fake_event(f, b, EV_SUSPEND);
	fake_stopped(f, b, true); /* c has its slot now */
	fake_hello(f, c);
	fake_log(f);
	queue_leave(f->q);
	queue_turn(f->q);
	assert_int_equal(fake_submit(f, 0, 1, 0), 0);
	fake_packet(f, a, MESSAGE_ERROR,
	            json_pack("{s:s, s:s}", "class", "cancelled", "text", "x"));
	fake_exit(f, a, 130, 0);
	fake_eof(f, a);
	fake_exit(f, b, 0, 9);
	fake_eof(f, b);
	assert_int_equal(queue_processes(f->q), 1);
	fake_wait(f, 4.1); /* one that ignores all is killed in time */
	assert_non_null(strstr(fake_log(f), "kill 3;"));
	fake_exit(f, c, 0, 9);
	fake_eof(f, c);
	assert_int_equal(queue_processes(f->q), 0);
	assert_string_equal(fake_row(f, a), "queued");
	assert_string_equal(fake_row(f, b), "suspended");
	assert_string_equal(fake_row(f, c), "queued");
	fake_restart(f);
	assert_int_equal(fake_state(f, a), JOB_STARTING);
}

static void holds_and_releases(void **state)
{
	struct fake *f = *state;
	fake_submit(f, 0, 1, 0);
	fake_submit(f, 0, 1, 0);
	int64_t id = fake_submit(f, 0, 1, 0);
	assert_int_equal(fake_event(f, id, EV_HOLD), ST_OK);
	assert_string_equal(fake_reason(f, id), "held by you");
	fake_success(f, 1);
	assert_int_equal(fake_state(f, id), JOB_HELD);
	assert_int_equal(fake_event(f, id, EV_RELEASE), ST_OK);
	assert_int_equal(fake_state(f, id), JOB_STARTING);
}

#define T(name) cmocka_unit_test_setup_teardown(name, fake_new, fake_gone)

int main(void)
{
	const struct CMUnitTest tests[] = {
		T(a_suspended_job_gives_its_slot_away),
		T(sees_stops_from_outside),
		T(a_stop_that_is_refused_is_forgotten),
		T(a_long_reason_ends_with_a_character),
		T(suspends_before_hello),
		T(kills_in_three_steps),
		T(a_suspended_job_hears_its_kill),
		T(a_job_that_was_done_before_the_kill_is_done),
		T(no_hello_fails_the_job),
		T(what_cannot_be_is_refused_in_words),
		T(every_state_can_be_left_or_is_over),
		T(a_restart_finds_every_job),
		T(a_restart_loses_what_cannot_go_on),
		T(leaving_queues_what_runs),
		T(holds_and_releases),
	};
	return cmocka_run_group_tests_name("states", tests, NULL, NULL);
}
