/* test_limits.c - time, room, order and resumption: what a long night of many jobs wants. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "fake.h"

static void a_job_over_its_time_fails_and_says_so(void **state)
{
	struct fake *f = *state;
	f->limits.job_wall_s = 60;
	fake_restart(f);
	int64_t id = fake_submit(f, 0, 1, 0);
	assert_true(queue_find(f->q, id)->wall_limit_s == 60);
	fake_wait(f, 5);
	fake_hello(f, id);
	fake_wait(f, 50);
	/* suspended time does not count */
	fake_event(f, id, EV_SUSPEND);
	fake_stopped(f, id, true);
	fake_wait(f, 1000);
	fake_event(f, id, EV_ACTIVATE);
	fake_wait(f, 9.9);
	assert_int_equal(fake_state(f, id), JOB_RUNNING);
	fake_log(f);
	fake_wait(f, 0.2);
	assert_int_equal(fake_state(f, id), JOB_ENDING);
	assert_string_equal(fake_log(f), "CANCEL 1;continue 1;");
	fake_packet(f, id, MESSAGE_ERROR,
	            json_pack("{s:s, s:s}", "class", "cancelled", "text", "cancelled"));
	fake_eof(f, id);
	fake_exit(f, id, 130, 0);
	assert_int_equal(fake_state(f, id), JOB_FAILED);
	assert_non_null(strstr(fake_reason(f, id), "over its limit of 60 s"));
	/* tried again it has as long again */
	fake_event(f, id, EV_RETRY);
	fake_hello(f, id);
	fake_wait(f, 59);
	assert_int_equal(fake_state(f, id), JOB_RUNNING);
}

static void a_job_that_ends_in_time_is_left_alone(void **state)
{
	struct fake *f = *state;
	f->limits.job_wall_s = 60;
	fake_restart(f);
	int64_t id = fake_submit(f, 0, 1, 0);
	fake_hello(f, id);
	fake_wait(f, 59);
	fake_packet(f, id, MESSAGE_RESULT, json_pack("{s:s, s:s}", "path", "/o", "kind", "t"));
	fake_packet(f, id, MESSAGE_DONE, NULL);
	fake_wait(f, 2);
	fake_eof(f, id);
	fake_exit(f, id, 0, 0);
	assert_int_equal(fake_state(f, id), JOB_DONE);
}

static void no_job_starts_without_room(void **state)
{
	struct fake *f = *state;
	f->limits.disk_floor_mib = 64;
	f->room = 63;
	fake_restart(f);
	int64_t id = fake_submit(f, 0, 1, 0), next = fake_submit(f, 0, 1, 0);
	assert_int_equal(fake_state(f, id), JOB_QUEUED);
	assert_string_equal(fake_reason(f, id),
	                    "disk: 63 MiB left where it writes, 64 wanted; make room");
	assert_string_equal(fake_reason(f, next), "behind job 1");
	fake_wait(f, 10);
	assert_int_equal(fake_state(f, id), JOB_QUEUED);
	f->room = 64;
	fake_wait(f, 1);
	assert_int_equal(fake_state(f, id), JOB_STARTING);
	assert_int_equal(fake_state(f, next), JOB_STARTING);
	assert_true(isinf(queue_deadline(f->q)) || queue_deadline(f->q) > f->now + 1);
}

static void no_job_starts_where_its_like_would_not_fit(void **state)
{
	struct fake *f = *state;
	f->limits.disk_floor_mib = 64;
	f->limits.jobs = 1;
	f->room = 1000;
	f->size = (300 << 20) - 5;
	fake_restart(f);
	int64_t first = fake_submit(f, 0, 1, 0), second = fake_submit(f, 0, 1, 0);
	f->room = 363;
	fake_success(f, first);
	assert_int_equal(queue_find(f->q, first)->bytes, f->size);
	assert_string_equal(fake_reason(f, second),
	                    "disk: 363 MiB left where it writes, 364 wanted by what its like took; "
	                    "make room");
	/* the ledger keeps it */
	fake_restart(f);
	assert_int_equal(fake_state(f, second), JOB_QUEUED);
	f->room = 364;
	fake_wait(f, 1);
	assert_int_equal(fake_state(f, second), JOB_STARTING);
	f->size = 1;
	fake_success(f, second); /* the largest counts */
	f->room = 363;
	int64_t third = fake_submit(f, 0, 1, 0);
	assert_int_equal(fake_state(f, third), JOB_QUEUED);
	f->limits.disk_floor_mib = 0;
	fake_restart(f);
	assert_int_equal(fake_state(f, third), JOB_STARTING);
}

static void room_is_promised_to_those_that_run(void **state)
{
	struct fake *f = *state;
	f->limits.disk_floor_mib = 64;
	f->limits.jobs = 3;
	f->room = 1000;
	f->size = 100 << 20;
	fake_restart(f);
	fake_success(f, fake_submit(f, 0, 1, 0));
	/* room for two of its like, not for three */
	f->room = 64 + 2 * 100 + 99;
	int64_t a = fake_submit(f, 0, 1, 0), b = fake_submit(f, 0, 1, 0),
	        c = fake_submit(f, 0, 1, 0);
	assert_int_equal(fake_state(f, a), JOB_STARTING);
	assert_int_equal(fake_state(f, b), JOB_STARTING);
	assert_int_equal(fake_state(f, c), JOB_QUEUED);
	assert_string_equal(fake_reason(f, c),
	                    "disk: 363 MiB left where it writes, 364 wanted by what its like took, "
	                    "200 of these by jobs that run; make room");
	/* a suspended one goes on some day */
	fake_hello(f, a);
	fake_event(f, a, EV_SUSPEND);
	fake_stopped(f, a, true);
	fake_wait(f, 2);
	assert_int_equal(fake_state(f, c), JOB_QUEUED);
	/* what one has written it needs no more */
	f->room -= 100;
	fake_success(f, b);
	fake_wait(f, 2);
	assert_int_equal(fake_state(f, c), JOB_QUEUED);
	f->room += 1;
	fake_wait(f, 1);
	assert_int_equal(fake_state(f, c), JOB_STARTING);
	/* nothing is promised on another disk */
	f->disk = 1;
	int64_t d = fake_submit(f, 0, 1, 0);
	assert_int_equal(fake_state(f, d), JOB_STARTING);
}

static void any_end_is_waited_for(void **state)
{
	struct fake *f = *state;
	int64_t first = fake_submit(f, 0, 1, 0);
	int64_t second = fake_submit_after_any(f, first), strict = fake_submit(f, 0, 1, first);
	assert_string_equal(fake_reason(f, second), "after 1");
	assert_int_equal(fake_submit_after_any(f, 77), 0);
	fake_hello(f, first);
	fake_exit(f, first, 1, 0);
	fake_eof(f, first);
	assert_int_equal(fake_state(f, first), JOB_FAILED);
	assert_int_equal(fake_state(f, second), JOB_STARTING);
	assert_int_equal(fake_state(f, strict), JOB_FAILED);
	/* it outlasts the service */
	int64_t third = fake_submit_after_any(f, second);
	fake_restart(f);
	assert_string_equal(fake_reason(f, third), "after 2");
	fake_event(f, second, EV_KILL);
	fake_eof(f, second);
	fake_exit(f, second, 0, 9);
	assert_int_equal(fake_state(f, third), JOB_STARTING);
}

static void the_top_is_before_all_others(void **state)
{
	struct fake *f = *state;
	f->limits.jobs = 1;
	fake_restart(f);
	int64_t running = fake_submit(f, 0, 1, 0), high = fake_submit(f, 50, 1, 0);
	int64_t low = fake_submit(f, -50, 1, 0), held = fake_submit(f, 0, 1, 0);
	fake_event(f, held, EV_HOLD);
	assert_int_equal(queue_top(f->q, low, NULL), ST_OK);
	assert_int_equal(queue_top(f->q, held, NULL), ST_OK);
	assert_int_equal(queue_top(f->q, running, NULL), ST_INPUT);
	assert_int_equal(queue_top(f->q, 99, NULL), ST_INPUT);
	fake_event(f, held, EV_RELEASE);
	fake_success(f, running);
	assert_int_equal(fake_state(f, held), JOB_STARTING);
	fake_success(f, held);
	assert_int_equal(fake_state(f, low), JOB_STARTING);
	fake_success(f, low);
	assert_int_equal(fake_state(f, high), JOB_STARTING);
}

static void a_held_queue_lets_what_has_begun_end(void **state)
{
	struct fake *f = *state;
	f->limits.jobs = 1;
	fake_restart(f);
	int64_t running = fake_submit(f, 0, 1, 0), waits = fake_submit(f, 0, 1, 0);
	fake_event(f, waits, EV_HOLD);
	assert_int_equal(queue_hold(f->q, true, NULL), ST_OK);
	int64_t fresh = fake_submit(f, 0, 1, 0), later = fake_submit(f, 0, 1, fresh);
	fake_hello(f, running);
	assert_int_equal(fake_state(f, fresh), JOB_HELD);
	assert_non_null(strstr(fake_reason(f, fresh), "batten release --all"));
	/* what ran goes on after a crash, and the queue is held still */
	fake_restart(f);
	assert_int_equal(fake_state(f, running), JOB_STARTING);
	assert_int_equal(fake_state(f, fresh), JOB_HELD);
	assert_int_equal(fake_state(f, fake_submit(f, 0, 1, 0)), JOB_HELD);
	fake_hello(f, running);
	fake_exit(f, running, 1, 0);
	fake_eof(f, running);
	fake_event(f, running, EV_RETRY);
	assert_int_equal(fake_state(f, running), JOB_HELD);
	/* a job named is let go, the queue is not */
	fake_event(f, fresh, EV_RELEASE);
	assert_int_equal(fake_state(f, fresh), JOB_STARTING);
	fake_success(f, fresh);
	assert_int_equal(fake_state(f, later), JOB_HELD);
	f->full = true;
	assert_int_equal(queue_hold(f->q, false, NULL), ST_RESOURCE);
	assert_int_equal(queue_hold(f->q, true, NULL), ST_OK);
	f->full = false;
	assert_int_equal(queue_hold(f->q, false, NULL), ST_OK);
	fake_event(f, later, EV_RELEASE);
	assert_int_equal(fake_state(f, later), JOB_STARTING);
	assert_int_equal(fake_state(f, fake_submit(f, 0, 1, 0)), JOB_QUEUED);
}

static void what_ran_goes_on_as_the_setting_says(void **state)
{
	static const struct {
		enum resume resume;
		enum job_state state;
		const char *reason;
	} rows[] = {
		{ RESUME_AUTO, JOB_STARTING, "" },
		{ RESUME_ASK, JOB_HELD, "batten release" },
		{ RESUME_NEVER, JOB_LOST, "batten retry" },
	};
	struct fake *f = *state;
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
		int64_t running = fake_submit(f, 0, 1, 0), waits = fake_submit(f, -9, 4, 0);
		fake_hello(f, running);
		f->limits.resume = rows[i].resume;
		fake_restart(f);
		assert_int_equal(fake_state(f, running), rows[i].state);
		assert_non_null(strstr(fake_reason(f, running), rows[i].reason));
		/* one that had not begun is no matter of that setting */
		assert_int_equal(fake_state(f, waits),
		                 rows[i].state == JOB_STARTING ? JOB_QUEUED : JOB_STARTING);
		/* stopped at a unit by the end of the service: the same */
		fake_event(f, running, i == 1 ? EV_RELEASE : EV_RETRY);
		fake_event(f, waits, EV_KILL);
		if (fake_state(f, waits) == JOB_ENDING) {
			fake_eof(f, waits);
			fake_exit(f, waits, 0, 9);
		}
		assert_int_equal(fake_state(f, running), JOB_STARTING);
		fake_hello(f, running);
		queue_leave(f->q);
		fake_eof(f, running);
		fake_exit(f, running, 0, 15);
		assert_int_equal(fake_state(f, running), JOB_QUEUED);
		fake_restart(f);
		assert_int_equal(fake_state(f, running), rows[i].state);
		fake_event(f, running, i == 1 ? EV_RELEASE : EV_RETRY);
		fake_success(f, running);
	}
}

static void earlier_jobs_say_how_long_it_takes(void **state)
{
	struct fake *f = *state;
	int64_t id = fake_submit(f, 0, 2, 0);
	fake_hello(f, id);
	assert_true(isnan(queue_find(f->q, id)->eta_s));
	fake_wait(f, 40);
	fake_packet(f, id, MESSAGE_PROGRESS, json_pack("{s:i, s:i}", "done", 10, "total", 10));
	fake_packet(f, id, MESSAGE_RESULT, json_pack("{s:s, s:s}", "path", "/o", "kind", "t"));
	fake_packet(f, id, MESSAGE_DONE, NULL);
	fake_eof(f, id);
	fake_exit(f, id, 0, 0);
	assert_int_equal(fake_state(f, id), JOB_DONE);
	for (int again = 0; again < 2; again++) {
		/* 80 seconds of one thread; after a restart the ledger knows */
		id = fake_submit(f, 0, 1, 0);
		fake_hello(f, id);
		fake_wait(f, 5);
		assert_true(fabs(queue_find(f->q, id)->eta_s - 75) < 1e-6);
		/* and 8 a unit, once it says how many */
		fake_packet(f, id, MESSAGE_PROGRESS,
		            json_pack("{s:i, s:i}", "done", 0, "total", 5));
		assert_true(fabs(queue_find(f->q, id)->eta_s - 35) < 1e-6);
		fake_wait(f, 100);
		assert_true(queue_find(f->q, id)->eta_s == 0);
		fake_event(f, id, EV_KILL);
		fake_eof(f, id);
		fake_exit(f, id, 0, 9);
		fake_restart(f);
	}
}

#define T(name) cmocka_unit_test_setup_teardown(name, fake_new, fake_gone)

int main(void)
{
	const struct CMUnitTest tests[] = {
		T(a_job_over_its_time_fails_and_says_so),
		T(a_job_that_ends_in_time_is_left_alone),
		T(no_job_starts_without_room),
		T(no_job_starts_where_its_like_would_not_fit),
		T(room_is_promised_to_those_that_run),
		T(any_end_is_waited_for),
		T(the_top_is_before_all_others),
		T(a_held_queue_lets_what_has_begun_end),
		T(what_ran_goes_on_as_the_setting_says),
		T(earlier_jobs_say_how_long_it_takes),
	};
	return cmocka_run_group_tests_name("limits", tests, NULL, NULL);
}
