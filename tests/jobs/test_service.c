/* test_service.c - the service with real processes: every verb's request. */
#include <fcntl.h>
#include <poll.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "checked.h"
#include "file.h"
#include "path.h"
#include "place.h"
#include "text.h"

static void runs_a_job(void **state)
{
	struct place *p = *state;
	int64_t id = place_submit(p, "good", 5, NULL);
	const struct Stats *s = place_end(p, id);
	assert_int_equal(s->state, JOB_DONE);
	assert_int_equal(s->n_outputs, 1);
	assert_true(path_has_suffix(s->outputs[0].path, "/result.txt"));
	assert_int_equal(json_integer_value(json_object_get(s->outputs[0].figures, "answer")), 42);
	assert_true(s->wall_s >= 0 && s->cpu_s >= 0 && s->peak_kib > 0);
	assert_string_equal(s->file_name, "hull.igs");
	char *text;
	size_t n;
	assert_int_equal(file_read(s->outputs[0].path, 100, &text, &n, NULL), ST_OK);
	assert_string_equal(text, "uuuuu");
	free(text);
}

static void suspends_the_process_and_activates_it(void **state)
{
	struct place *p = *state;
	char *gate = place_gate(p, "gate");
	int64_t id = place_submit(p, "good", 2, gate);
	place_until(p, id, JOB_RUNNING);
	pid_t pid = place_job(p, id)->pid;
	for (int i = 0; i < 20; i++) {
		assert_int_equal(place_ask(p, MESSAGE_SUSPEND, id), ST_OK);
		assert_int_equal(process_state(pid), 'T');
		assert_int_equal(place_job(p, id)->state, JOB_SUSPENDED);
		assert_int_equal(place_ask(p, MESSAGE_SUSPEND, id), ST_INPUT);
		assert_int_equal(place_ask(p, MESSAGE_ACTIVATE, id), ST_OK);
		assert_true(process_state(pid) != 'T');
		assert_int_equal(place_job(p, id)->state, JOB_RUNNING);
	}
	place_open_gate(p, "gate", 2);
	assert_int_equal(place_end(p, id)->state, JOB_DONE);
	free(gate);
}

static void sees_a_stop_from_outside(void **state)
{
	struct place *p = *state;
	char *gate = place_gate(p, "gate");
	int64_t id = place_submit(p, "good", 1, gate);
	place_until(p, id, JOB_RUNNING);
	pid_t pid = place_job(p, id)->pid;
	kill(pid, SIGSTOP);
	place_until(p, id, JOB_SUSPENDED);
	kill(pid, SIGCONT);
	place_until(p, id, JOB_RUNNING);
	assert_int_equal(place_ask(p, MESSAGE_KILL, id), ST_OK);
	assert_int_equal(place_job(p, id)->state, JOB_KILLED);
	free(gate);
}

static void kill_keeps_the_part_and_retry_goes_on(void **state)
{
	struct place *p = *state;
	char *gate = place_gate(p, "gate");
	place_open_gate(p, "gate", 3);
	int64_t id = place_submit(p, "good", 5, gate);
	place_until_done(p, id, 3);
	assert_int_equal(place_ask(p, MESSAGE_KILL, id), ST_OK);
	assert_int_equal(place_job(p, id)->state, JOB_KILLED);
	assert_int_equal(place_ask(p, MESSAGE_RETRY, id), ST_OK);
	place_until_done(p, id, 3); /* its first word is where it goes on */
	place_open_gate(p, "gate", 2);
	assert_int_equal(place_end(p, id)->state, JOB_DONE);
	free(gate);
}

static bool keep_id(void *data, const struct Stats *s)
{
	int64_t *id = data;
	*id = s->id;
	return true;
}

static void the_starter_sets_what_a_worker_must_not(void **state)
{
	struct place *p = *state;
	char *text;
	size_t n;
	int64_t id = 0;
	json_t *job = json_pack("{s:s, s:s, s:i, s:i}", "worker", "shows", "output", "/tmp/none",
	                        "memory_mib", 1000, "threads", 2);
	assert_int_equal(client_request(p->client, MESSAGE_SUBMIT,
	                                json_pack("{s:[o]}", "jobs", job), keep_id, NULL, &id,
	                                NULL),
	                 ST_OK);
	assert_int_equal(place_end(p, id)->state, JOB_DONE);
	assert_int_equal(file_read(place_job(p, id)->log, 10000, &text, &n, NULL), ST_OK);
	const char *rest = strstr(text, ", core");
	assert_string_equal(rest, ", core 0, death 9, group 1, open 0, blas 1, here 1\n");
	long long niceness = 0, data = 0;
	assert_int_equal(sscanf(text, "nice %lld, data %lld", &niceness, &data), 2);
	assert_int_equal(niceness, 5);
	/* 1000 MiB, 256 for the program, 16 a thread */
	if (!CHECKED_BUILD) /* it has no limit */
		assert_int_equal(data, 1288);
	free(text);
}

static bool count_jobs(void *data, const struct Stats *s)
{
	int *n = data;
	(void)s;
	++*n;
	return true;
}

static int list_count(struct place *p, json_t *body)
{
	int n = 0;
	assert_int_equal(client_request(p->client, MESSAGE_LIST, body, count_jobs, NULL, &n,
	                                &p->store.report),
	                 ST_OK);
	return n;
}

static void groups_are_named_as_one(void **state)
{
	struct place *p = *state;
	char *gate = place_gate(p, "gate");
	json_t *jobs = json_array();
	int n = 0;
	for (int i = 0; i < 6; i++)
		json_array_append_new(jobs, json_pack("{s:s, s:s, s:s, s:{s:s, s:s}}", "worker",
		                                      "good", "output", "/tmp/none", "group",
		                                      i < 5 ? "hull" : "keel", "parameters",
		                                      "units", "1", "gate", gate));
	assert_int_equal(client_request(p->client, MESSAGE_SUBMIT, json_pack("{s:o}", "jobs", jobs),
	                                count_jobs, NULL, &n, NULL),
	                 ST_OK);
	assert_int_equal(n, 6);
	assert_int_equal(list_count(p, json_pack("{s:s}", "group", "hull")), 5);
	n = 0;
	assert_int_equal(client_request(p->client, MESSAGE_KILL,
	                                json_pack("{s:s}", "group", "hull"), count_jobs, NULL, &n,
	                                NULL),
	                 ST_OK);
	assert_int_equal(n, 5);
	place_until(p, 6, JOB_RUNNING);
	for (int id = 1; id < 6; id++)
		assert_int_equal(place_job(p, id)->state, JOB_KILLED);
	assert_int_equal(client_request(p->client, MESSAGE_KILL,
	                                json_pack("{s:s}", "group", "mast"), NULL, NULL, NULL,
	                                NULL),
	                 ST_INPUT);
	assert_int_equal(client_request(p->client, MESSAGE_KILL, json_pack("{s:b}", "all", 1), NULL,
	                                NULL, NULL, NULL),
	                 ST_OK);
	assert_int_equal(place_job(p, 6)->state, JOB_KILLED);
	free(gate);
}

struct watched {
	int *last, n;
};

static bool keep_state(void *data, const struct Stats *s)
{
	const struct watched *w = data;
	assert_in_range(s->id, 1, w->n);
	w->last[s->id] = s->state;
	return true;
}

/* The id of the job that is done. */
static bool keep_done(void *data, const struct Stats *s)
{
	int *id = data;
	if (s->state == JOB_DONE)
		*id = (int)s->id;
	return true;
}

/* One that watches and never reads gets all in the end, and keeps nobody waiting meanwhile. */
static void a_slow_watcher_hears_the_last_word(void **state)
{
	enum { N = 3000 };
	struct place *p = *state;
	struct client *c;
	char *gate = place_gate(p, "gate");
	json_t *jobs = json_array();
	int over = 0;
	bool ended = false, gone = false;
	for (int i = 0; i < N; i++)
		json_array_append_new(jobs,
		                      json_pack("{s:s, s:s, s:s, s:{s:s, s:s}}", "worker", "good",
		                                "output", "/tmp/none", "group", "many",
		                                "parameters", "gate", gate, "units", "1"));
	char *path = path_join(p->folder, "jobs.json"), *text = json_dumps(jobs, 0);
	assert_int_equal(file_write(path, text, strlen(text), NULL), ST_OK);
	assert_int_equal(client_request(p->client, MESSAGE_SUBMIT,
	                                json_pack("{s:[s]}", "jobs", path), NULL, NULL, NULL, NULL),
	                 ST_OK);
	assert_int_equal(client_connect(&c, &p->project, false, NULL), ST_OK);
	assert_int_equal(client_send(c, MESSAGE_WATCH, json_pack("{s:s}", "group", "many"), NULL),
	                 ST_OK);
	for (int i = 0; i < 5; i++) {
		const enum message_type types[] = { MESSAGE_HOLD, MESSAGE_RELEASE };
		for (int k = 0; k < 2; k++)
			assert_int_equal(client_request(p->client, types[k],
			                                json_pack("{s:s}", "group", "many"), NULL,
			                                NULL, NULL, NULL),
			                 ST_OK);
	}
	assert_int_equal(client_request(p->client, MESSAGE_KILL,
	                                json_pack("{s:s}", "group", "many"), NULL, NULL, NULL,
	                                NULL),
	                 ST_OK);
	int last[N + 1];
	memset(last, 0, sizeof last);
	struct watched w = { last, N };
	while (!ended) {
		struct pollfd fd = { .fd = client_descriptor(c), .events = POLLIN };
		assert_true(poll(&fd, 1, 20000) > 0);
		assert_int_equal(client_listen(c, 0, -1, keep_state, &w, &ended, &gone, NULL),
		                 ST_OK);
	}
	assert_false(gone);
	for (int id = 1; id <= N; id++)
		over += last[id] == JOB_KILLED;
	assert_int_equal(over, N);
	client_close(c);
	json_decref(jobs);
	free(text);
	free(path);
	free(gate);
}

static void a_watch_that_stays_hears_of_later_jobs(void **state)
{
	struct place *p = *state;
	struct client *c;
	int n = 0;
	bool ended = false, gone = false;
	assert_int_equal(client_connect(&c, &p->project, false, NULL), ST_OK);
	assert_int_equal(client_send(c, MESSAGE_WATCH, json_pack("{s:b}", "stay", 1), NULL), ST_OK);
	for (int i = 0; i < 3; i++) {
		int64_t id = place_submit(p, "good", 0, NULL);
		while (n != (int)id) {
			struct pollfd fd = { .fd = client_descriptor(c), .events = POLLIN };
			assert_true(poll(&fd, 1, 20000) > 0);
			assert_int_equal(
			        client_listen(c, 0, -1, keep_done, &n, &ended, &gone, NULL), ST_OK);
			assert_false(ended);
		}
	}
	client_close(c);
}

static void bad_submissions_queue_nothing(void **state)
{
	static const char *const bad[] = {
		"{\"jobs\":[]}",
		"{\"jobs\":[3]}",
		"{\"jobs\":[{}]}",
		"{\"jobs\":[{\"worker\":\"nobody\",\"output\":\"/tmp/x\"}]}",
		"{\"jobs\":[{\"worker\":\"../good\",\"output\":\"/tmp/x\"}]}",
		"{\"jobs\":[{\"worker\":\"good\"}]}",
		"{\"jobs\":[{\"worker\":\"good\",\"output\":\"/tmp/x\",\"after\":[9]}]}",
		"{\"jobs\":[{\"worker\":\"good\",\"output\":\"/tmp/x\",\"inputs\":[{\"path\":\"/no\"}]}]}",
		"{\"jobs\":[{\"worker\":\"good\",\"output\":\"/tmp/x\"},{\"worker\":\"nobody\"}]}",
		"{\"jobs\":[\"/no/such/file.json\"]}",
	};
	struct place *p = *state;
	for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
		report_store_init(&p->store);
		assert_true(client_request(p->client, MESSAGE_SUBMIT, json_loads(bad[i], 0, NULL),
		                           NULL, NULL, NULL, &p->store.report) != ST_OK);
		assert_true(strlen(p->store.error) > 8);
	}
	assert_int_equal(list_count(p, json_pack("{s:b}", "all", 1)), 0);
}

static void bad_packets_end_only_their_own_connection(void **state)
{
	static const char *const junk[] = { "GET / HTTP/1.1\r\n\r\n",
		                            "\xFF\xFF\xFF\xFF\xFF\xFF\xFF\xFF",
		                            "\x80\0\0\0\x02\0\0\0[]", "" };
	static const size_t sizes[] = { 18, 8, 10, 0 };
	struct place *p = *state;
	for (size_t i = 0; i < 4; i++) {
		struct client *c;
		assert_int_equal(client_connect(&c, &p->project, false, NULL), ST_OK);
		int fd = client_descriptor(c);
		char byte;
		assert_int_equal(write(fd, junk[i], sizes[i]), (ssize_t)sizes[i]);
		if (sizes[i])
			assert_true(read(fd, &byte, 1) <= 0);
		client_close(c);
	}
	assert_int_equal(list_count(p, json_object()), 0);
}

static void add_text(void *data, const char *text)
{
	text_add(data, text);
}

static void priority_changes_the_order(void **state)
{
	struct place *p = *state;
	char *gate = place_gate(p, "gate");
	int64_t ids[5];
	for (int i = 0; i < 5; i++)
		ids[i] = place_submit(p, "good", 1, gate);
	place_until(p, ids[1], JOB_RUNNING);
	assert_string_equal(place_job(p, ids[4])->reason, "slots full");
	assert_int_equal(
	        client_request(p->client, MESSAGE_PRIORITY,
	                       json_pack("{s:[I], s:i}", "jobs", (json_int_t)ids[4], "priority", 7),
	                       NULL, NULL, NULL, NULL),
	        ST_OK);
	assert_int_equal(place_job(p, ids[4])->priority, 7);
	assert_int_equal(place_ask(p, MESSAGE_KILL, ids[0]), ST_OK);
	place_until(p, ids[4], JOB_RUNNING);
	assert_int_equal(place_job(p, ids[2])->state, JOB_QUEUED);
	assert_int_equal(client_request(p->client, MESSAGE_PRIORITY,
	                                json_pack("{s:i}", "priority", 1), NULL, NULL, NULL, NULL),
	                 ST_PARAMETER);
	free(gate);
}

static void gives_the_log_and_follows_it(void **state)
{
	struct place *p = *state;
	struct text log = { 0 };
	int64_t id = place_submit(p, "grandchild", 0, NULL);
	assert_int_equal(client_request(p->client, MESSAGE_LOG,
	                                json_pack("{s:I, s:b}", "job", (json_int_t)id, "follow", 1),
	                                NULL, add_text, &log, NULL),
	                 ST_OK);
	assert_non_null(strstr(log.s, "child "));
	text_reset(&log);
	/* bytes that are no characters, and more than one piece */
	place_end(p, id);
	FILE *f = fopen(place_job(p, id)->log, "w");
	assert_non_null(f);
	for (int i = 0; i < 9000; i++)
		fputs("\xC3\xA9", f);
	fputs("\xFF\xC3", f);
	fclose(f);
	assert_int_equal(client_request(p->client, MESSAGE_LOG,
	                                json_pack("{s:I}", "job", (json_int_t)id), NULL, add_text,
	                                &log, NULL),
	                 ST_OK);
	assert_int_equal(log.n, 18002);
	assert_string_equal(log.s + 17998, "\xC3\xA9??");
	text_finish(&log);
	assert_int_equal(client_request(p->client, MESSAGE_LOG, json_pack("{s:i}", "job", 99), NULL,
	                                NULL, NULL, NULL),
	                 ST_INPUT);
}

static void prune_takes_what_belongs_to_no_job(void **state)
{
	struct place *p = *state;
	char *gate = place_gate(p, "gate");
	char *orphan = path_join(p->project.hidden, "parts/77.part");
	char *input = path_join(p->project.hidden, "inputs/old.base");
	char *young = path_join(p->project.hidden, "inputs/young.base");
	const struct timespec long_ago[2] = { { .tv_sec = 1000 }, { .tv_sec = 1000 } };
	assert_int_equal(file_write(orphan, "x", 1, NULL), ST_OK);
	assert_int_equal(file_write(input, "x", 1, NULL), ST_OK);
	assert_int_equal(file_write(young, "x", 1, NULL), ST_OK);
	assert_int_equal(utimensat(AT_FDCWD, input, long_ago, 0), 0);
	int64_t over = place_submit(p, "good", 1, NULL), lives = place_submit(p, "good", 1, gate);
	char *log = strdup(place_end(p, over)->log);
	place_until(p, lives, JOB_RUNNING);
	char *kept = strdup(place_job(p, lives)->log);
	int n = 0;
	assert_int_equal(
	        client_request(p->client, MESSAGE_PRUNE, json_object(), count_jobs, NULL, &n, NULL),
	        ST_OK);
	assert_int_equal(n, 1);
	assert_int_equal(list_count(p, json_pack("{s:b}", "all", 1)), 1);
	assert_false(path_exists(log));
	assert_false(path_exists(orphan));
	assert_false(path_exists(input));
	assert_true(path_exists(young));
	assert_true(path_exists(kept));
	place_open_gate(p, "gate", 1);
	assert_int_equal(place_end(p, lives)->state, JOB_DONE);
	free(gate);
	free(orphan);
	free(input);
	free(young);
	free(log);
	free(kept);
}

static void ten_thousand_jobs_come_from_a_file(void **state)
{
	struct place *p = *state;
	char *gate = place_gate(p, "gate"), *path = path_join(p->folder, "jobs.json");
	int64_t first = place_submit(p, "good", 1, gate), second = place_submit(p, "good", 1, gate);
	json_t *jobs = json_array();
	int n = 0;
	for (int i = 0; i < 10000; i++)
		json_array_append_new(jobs, json_pack("{s:s, s:s, s:s}", "worker", "good", "output",
		                                      "/tmp/none", "group", "many"));
	char *text = json_dumps(jobs, 0);
	assert_int_equal(file_write(path, text, strlen(text), NULL), ST_OK);
	assert_int_equal(client_request(p->client, MESSAGE_SUBMIT,
	                                json_pack("{s:[s]}", "jobs", path), count_jobs, NULL, &n,
	                                &p->store.report),
	                 ST_OK);
	assert_int_equal(n, 10000);
	assert_int_equal(list_count(p, json_object()), 10002);
	assert_string_equal(place_job(p, 5000)->reason, "slots full");
	assert_int_equal(client_request(p->client, MESSAGE_KILL,
	                                json_pack("{s:s}", "group", "many"), NULL, NULL, NULL,
	                                NULL),
	                 ST_OK);
	assert_int_equal(
	        client_request(p->client, MESSAGE_PRUNE, json_object(), NULL, NULL, NULL, NULL),
	        ST_OK);
	assert_int_equal(list_count(p, json_pack("{s:b}", "all", 1)), 2);
	place_open_gate(p, "gate", 2);
	assert_int_equal(place_end(p, first)->state, JOB_DONE);
	assert_int_equal(place_end(p, second)->state, JOB_DONE);
	json_decref(jobs);
	free(text);
	free(gate);
	free(path);
}

#define T(name) cmocka_unit_test_setup_teardown(name, place_of_two_jobs, place_gone)

int main(void)
{
	signal(SIGPIPE, SIG_IGN);
	const struct CMUnitTest tests[] = {
		T(runs_a_job),
		T(suspends_the_process_and_activates_it),
		T(sees_a_stop_from_outside),
		T(kill_keeps_the_part_and_retry_goes_on),
		T(the_starter_sets_what_a_worker_must_not),
		T(groups_are_named_as_one),
		T(a_slow_watcher_hears_the_last_word),
		T(a_watch_that_stays_hears_of_later_jobs),
		T(bad_submissions_queue_nothing),
		T(bad_packets_end_only_their_own_connection),
		T(priority_changes_the_order),
		T(gives_the_log_and_follows_it),
		T(prune_takes_what_belongs_to_no_job),
		T(ten_thousand_jobs_come_from_a_file),
	};
	return cmocka_run_group_tests_name("service", tests, NULL, NULL);
}
