/* test_link.c - the window's tie to the service: news without waiting, requests, a service that goes and
 * comes back. */
#include <poll.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cmocka.h>

#include "jobs_link.h"
#include "place.h"

enum { PATIENCE_MS = 20000 };

struct tie {
	struct place place;
	struct jobs_link *link;
	struct job_shelf shelf;
	enum link_state state;
	char reason[256];
	int woken; /* eventfd */
};

static void wake(void *data)
{
	uint64_t one = 1;

	assert_int_equal(write(((struct tie *)data)->woken, &one, sizeof one), sizeof one);
}

static int set_up(void **state)
{
	struct tie *t = calloc(1, sizeof *t);

	*state = t;
	place_init(&t->place, "BATTEN_JOBS=2");
	t->woken = eventfd(0, 0);
	return jobs_link_create(&t->link, &t->place.project, wake, t, NULL) != ST_OK;
}

static int tear_down(void **state)
{
	struct tie *t = *state;

	jobs_link_destroy(t->link);
	job_shelf_finish(&t->shelf);
	close(t->woken);
	place_finish(&t->place);
	free(t);
	return 0;
}

/* A job that waits at a gate. */
static int64_t submit_shut(struct tie *t, const char *gate)
{
	char *path = place_gate(&t->place, gate);
	int64_t id = place_submit(&t->place, "good", 4, path);

	free(path);
	return id;
}

/* The next news. */
static void wait_news(struct tie *t)
{
	struct pollfd p = { .fd = t->woken, .events = POLLIN };
	uint64_t rung;

	assert_int_equal(poll(&p, 1, PATIENCE_MS), 1);
	assert_int_equal(read(t->woken, &rung, sizeof rung), sizeof rung);
	jobs_link_take(t->link, &t->shelf, &t->state, t->reason);
}

static const struct Stats *until(struct tie *t, int64_t id, enum job_state state)
{
	for (;;) {
		const struct Stats *s = job_shelf_find(&t->shelf, id);
		if (s && s->state == state)
			return s;
		wait_news(t);
	}
}

static struct link_answer the_answer(struct tie *t)
{
	struct link_answer a;

	while (!jobs_link_answer(t->link, &a))
		wait_news(t);
	return a;
}

static void jobs_are_watched_and_steered(void **state)
{
	struct tie *t = *state;
	int64_t id = submit_shut(t, "gate");

	until(t, id, JOB_RUNNING);
	assert_int_equal(t->state, LINK_UP);
	assert_int_equal(jobs_link_ask(t->link, MESSAGE_SUSPEND, &id, 1), ST_OK);
	struct link_answer a = the_answer(t);
	assert_int_equal(a.type, MESSAGE_SUSPEND);
	assert_int_equal(a.status, ST_OK);
	assert_int_equal(a.job, id);
	link_answer_finish(&a);
	until(t, id, JOB_SUSPENDED);
	assert_int_equal(jobs_link_ask(t->link, MESSAGE_ACTIVATE, &id, 1), ST_OK);
	a = the_answer(t);
	link_answer_finish(&a);
	until(t, id, JOB_RUNNING);
	place_open_gate(&t->place, "gate", 4);
	assert_int_equal(until(t, id, JOB_DONE)->done, 4);
	int64_t none = id + 100;
	assert_int_equal(jobs_link_ask(t->link, MESSAGE_KILL, &none, 1), ST_OK);
	a = the_answer(t);
	assert_int_not_equal(a.status, ST_OK);
	assert_non_null(a.text);
	assert_true(*a.text);
	link_answer_finish(&a);
	assert_int_equal(jobs_link_ask(t->link, MESSAGE_LOG, &id, 1), ST_OK);
	a = the_answer(t);
	assert_int_equal(a.type, MESSAGE_LOG);
	assert_int_equal(a.status, ST_OK);
	link_answer_finish(&a);
}

static void a_kill_holds_nothing_up(void **state)
{
	struct tie *t = *state;
	int64_t ids[2] = { submit_shut(t, "a"), submit_shut(t, "b") };

	until(t, ids[0], JOB_RUNNING);
	until(t, ids[1], JOB_RUNNING);
	assert_int_equal(jobs_link_ask(t->link, MESSAGE_KILL, &ids[0], 1), ST_OK);
	assert_int_equal(jobs_link_ask(t->link, MESSAGE_SUSPEND, &ids[1], 1), ST_OK);
	until(t, ids[1], JOB_SUSPENDED);
	assert_string_equal(until(t, ids[0], JOB_KILLED)->worker, "good");
}

static void a_service_that_dies_is_told_of_and_started_again(void **state)
{
	struct tie *t = *state;
	int64_t id = submit_shut(t, "gate");

	until(t, id, JOB_RUNNING);
	place_crash(&t->place);
	while (t->state != LINK_GONE)
		wait_news(t);
	assert_true(*t->reason);
	jobs_link_restart(t->link);
	while (t->state != LINK_UP)
		wait_news(t);
	until(t, id, JOB_RUNNING);
	assert_int_equal(jobs_link_ask(t->link, MESSAGE_KILL, &id, 1), ST_OK);
	until(t, id, JOB_KILLED);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(jobs_are_watched_and_steered, set_up, tear_down),
		cmocka_unit_test_setup_teardown(a_kill_holds_nothing_up, set_up, tear_down),
		cmocka_unit_test_setup_teardown(a_service_that_dies_is_told_of_and_started_again,
		                                set_up, tear_down),
	};

	return cmocka_run_group_tests(tests, NULL, NULL);
}
