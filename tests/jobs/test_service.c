/* test_service.c - the service with real processes: every verb's request, crashes and restarts. */
#include <fcntl.h>
#include <poll.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/pidfd.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "file.h"
#include "ledger.h"
#include "lock.h"
#include "path.h"
#include "place.h"
#include "text.h"

static int set_up(void **state)
{
	struct place *p = malloc(sizeof *p);
	*state = p;
	if (p)
		place_init(p, "BATTEN_JOBS=2");
	return !p;
}

static int tear_down(void **state)
{
	place_finish(*state);
	free(*state);
	return 0;
}

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

static void a_dead_service_takes_its_workers_and_loses_no_job(void **state)
{
	struct place *p = *state;
	char *gate = place_gate(p, "gate"), *still = place_gate(p, "still");
	place_open_gate(p, "gate", 2);
	int64_t running = place_submit(p, "good", 4, gate);
	place_until_done(p, running, 2);
	int64_t ended = place_submit(p, "good", 0, NULL);
	int64_t stopped = place_submit(p, "good", 1, still);
	assert_int_equal(place_end(p, ended)->state, JOB_DONE);
	place_until(p, stopped, JOB_RUNNING);
	assert_int_equal(place_ask(p, MESSAGE_SUSPEND, stopped), ST_OK);
	int64_t waits = place_submit(p, "good", 1, still);
	int64_t held = place_submit(p, "good", 0, NULL);
	assert_int_equal(place_ask(p, MESSAGE_HOLD, held), ST_OK);
	int fds[2] = { pidfd_open(place_job(p, running)->pid, 0),
		       pidfd_open(place_job(p, stopped)->pid, 0) };
	place_crash(p);
	for (int i = 0; i < 2; i++) {
		assert_true(process_gone(fds[i]));
		close(fds[i]);
	}

	place_connect(p);
	assert_int_equal(place_job(p, ended)->state, JOB_DONE);
	assert_int_equal(place_job(p, stopped)->state, JOB_SUSPENDED);
	assert_int_equal(place_job(p, stopped)->pid, 0);
	assert_int_equal(place_job(p, held)->state, JOB_HELD);
	place_until_done(p, running, 2); /* from its part file */
	place_open_gate(p, "gate", 2);
	assert_int_equal(place_end(p, running)->state, JOB_DONE);
	assert_int_equal(place_ask(p, MESSAGE_ACTIVATE, stopped), ST_OK);
	place_until(p, stopped, JOB_RUNNING);
	place_open_gate(p, "still", 2);
	assert_int_equal(place_end(p, stopped)->state, JOB_DONE);
	assert_int_equal(place_end(p, waits)->state, JOB_DONE);
	assert_int_equal(place_ask(p, MESSAGE_RELEASE, held), ST_OK);
	assert_int_equal(place_end(p, held)->state, JOB_DONE);
	free(gate);
	free(still);
}

static void shutdown_stops_at_a_unit_and_the_next_start_goes_on(void **state)
{
	struct place *p = *state;
	char *gate = place_gate(p, "gate");
	place_open_gate(p, "gate", 1);
	int64_t id = place_submit(p, "good", 3, gate);
	place_until_done(p, id, 1);
	int fd = pidfd_open(p->service, 0);
	assert_int_equal(
	        client_request(p->client, MESSAGE_SHUTDOWN, json_object(), NULL, NULL, NULL, NULL),
	        ST_OK);
	place_connect(p); /* at once: the old one is perhaps still closing */
	assert_true(process_gone(fd));
	close(fd);
	place_until_done(p, id, 1);
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

static void a_second_service_is_refused(void **state)
{
	struct place *p = *state;
	struct report_store store;
	int fd;
	report_store_init(&store);
	assert_int_equal(lock_take(&p->project, false, &fd, &store.report), ST_RESOURCE);
	char *who = text_print("process %ld)", (long)p->service);
	assert_non_null(strstr(store.error, "a service runs already"));
	assert_non_null(strstr(store.error, who));
	free(who);
	assert_int_equal(lock_take(&p->project, true, &fd, NULL), ST_RESOURCE);
}

static void many_clients_start_one_service(void **state)
{
	enum { N = 8 };
	struct place *p = *state;
	pid_t children[N];
	place_crash(p);
	for (int i = 0; i < N; i++) {
		children[i] = fork();
		if (children[i] == 0) {
			struct client *c;
			_exit(client_connect(&c, &p->project, true, NULL) != ST_OK);
		}
	}
	for (int i = 0; i < N; i++) {
		int status = -1;
		waitpid(children[i], &status, 0);
		assert_int_equal(status, 0);
	}
	place_connect(p);
}

/* As after a crash: the ledger says it runs, its worker has not died yet. */
static void a_worker_left_behind_is_ended_before_its_job_goes_on(void **state)
{
	struct place *p = *state;
	int in[2];
	char *path = path_join(p->project.hidden, "workers/batten-stubborn");
	char *ledger = path_join(p->project.hidden, "jobs.db"), host[256] = "",
	     worker[] = "stubborn";
	char output[] = "/tmp/none";
	place_crash(p);
	assert_int_equal(pipe2(in, O_CLOEXEC), 0);
	pid_t pid = fork();
	if (pid == 0) {
		setpgid(0, 0);
		dup2(in[0], 0);
		dup2(open("/dev/null", O_WRONLY), 1);
		execl(path, path, NULL);
		_exit(1);
	}
	setpgid(pid, pid);
	struct pollfd gone = { .fd = pidfd_open(pid, 0), .events = POLLIN };
	struct Stats s;
	struct ledger l;
	struct ledger_change c = { .id = 1, .stats = &s };
	gethostname(host, sizeof host - 1);
	stats_init(&s);
	s.id = 1;
	s.worker = worker;
	s.output = output;
	s.host = host;
	s.pid = pid;
	s.state = JOB_RUNNING;
	assert_int_equal(ledger_open(&l, ledger, NULL), ST_OK);
	assert_int_equal(l.write(l.data, &c, 1, true, NULL), ST_OK);
	ledger_close(&l);
	place_connect(p);
	assert_int_equal(poll(&gone, 1, 0), 1); /* before anybody is answered */
	int status = 0;
	waitpid(pid, &status, 0);
	assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
	place_until(p, 1, JOB_RUNNING);
	kill(place_job(p, 1)->pid, SIGKILL);
	assert_int_equal(place_end(p, 1)->state, JOB_FAILED);
	close(gone.fd);
	close(in[0]);
	close(in[1]);
	free(path);
	free(ledger);
}

static void crash_after_crash_every_job_is_done(void **state)
{
	enum { N = 24, CRASHES = 12 };
	struct place *p = *state;
	char *gate = place_gate(p, "gate");
	for (int i = 0; i < N; i++)
		place_submit(p, "good", 5, gate);
	for (int i = 0; i < CRASHES; i++) {
		/* each time at another moment of starting, stepping and ending */
		place_open_gate(p, "gate", 1 + 7 * i % 11);
		if (i % 3)
			place_job(p, 1 + i);
		place_crash(p);
		place_connect(p);
	}
	place_open_gate(p, "gate", 5 * N);
	for (int i = 0; i < N; i++)
		assert_int_equal(place_end(p, 1 + i)->state, JOB_DONE);
	free(gate);
}

static void the_stub_sets_what_a_worker_must_not(void **state)
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
	assert_string_equal(text, "nice 5, data 1288, core 0, death 9, group 1, open 0, blas 1, "
	                          "here 1\n");
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

static int set_up_idle(void **state)
{
	struct place *p = malloc(sizeof *p);
	*state = p;
	if (p)
		place_init(p, "BATTEN_IDLE=0.2");
	return !p;
}

static void an_idle_service_ends_and_the_next_one_knows_all(void **state)
{
	struct place *p = *state;
	int64_t id = place_submit(p, "good", 1, NULL);
	place_end(p, id);
	int fd = pidfd_open(p->service, 0);
	pid_t old = p->service;
	client_close(p->client);
	p->client = NULL;
	assert_true(process_gone(fd));
	close(fd);
	place_connect(p);
	assert_int_not_equal(p->service, old);
	assert_int_equal(place_job(p, id)->state, JOB_DONE);
}

static void a_job_keeps_the_service_alive_without_clients(void **state)
{
	struct place *p = *state;
	char *gate = place_gate(p, "gate");
	int64_t id = place_submit(p, "good", 1, gate);
	place_until(p, id, JOB_RUNNING);
	struct pollfd fd = { .fd = pidfd_open(p->service, 0), .events = POLLIN };
	client_close(p->client);
	p->client = NULL;
	assert_int_equal(poll(&fd, 1, 500), 0); /* more than twice the idle time */
	place_open_gate(p, "gate", 1);
	assert_true(process_gone(fd.fd));
	close(fd.fd);
	place_connect(p);
	assert_int_equal(place_job(p, id)->state, JOB_DONE);
	free(gate);
}

#define T(name)    cmocka_unit_test_setup_teardown(name, set_up, tear_down)
#define IDLE(name) cmocka_unit_test_setup_teardown(name, set_up_idle, tear_down)

int main(void)
{
	signal(SIGPIPE, SIG_IGN);
	const struct CMUnitTest tests[] = {
		T(runs_a_job),
		T(suspends_the_process_and_activates_it),
		T(sees_a_stop_from_outside),
		T(kill_keeps_the_part_and_retry_goes_on),
		T(a_dead_service_takes_its_workers_and_loses_no_job),
		T(shutdown_stops_at_a_unit_and_the_next_start_goes_on),
		T(a_second_service_is_refused),
		T(many_clients_start_one_service),
		T(a_worker_left_behind_is_ended_before_its_job_goes_on),
		T(crash_after_crash_every_job_is_done),
		T(the_stub_sets_what_a_worker_must_not),
		T(groups_are_named_as_one),
		T(bad_submissions_queue_nothing),
		T(bad_packets_end_only_their_own_connection),
		T(gives_the_log_and_follows_it),
		T(prune_takes_what_belongs_to_no_job),
		T(ten_thousand_jobs_come_from_a_file),
		IDLE(an_idle_service_ends_and_the_next_one_knows_all),
		IDLE(a_job_keeps_the_service_alive_without_clients),
	};
	return cmocka_run_group_tests_name("service", tests, NULL, NULL);
}
