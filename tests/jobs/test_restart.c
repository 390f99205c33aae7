/* test_restart.c - services that die, end and start: no job is lost, none runs twice. */
#include <fcntl.h>
#include <poll.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/pidfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "ledger.h"
#include "lock.h"
#include "path.h"
#include "place.h"
#include "text.h"

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

static int next_type(int fd, struct message_reader *reader)
{
	struct message m;
	int next;
	while (!(next = message_reader_next(reader, &m))) {
		size_t room;
		char *to = message_reader_room(reader, 4096, &room);
		ssize_t n = read(fd, to, room);
		if (n <= 0)
			return 0;
		message_reader_filled(reader, (size_t)n);
	}
	int type = next > 0 ? (int)m.type : -1;
	message_finish(&m);
	return type;
}

/* What a client of another version meets, and what such a service does. */
static void another_protocol_is_refused_but_may_shut_down(void **state)
{
	struct place *p = *state;
	struct sockaddr_un address = { .sun_family = AF_UNIX };
	struct message_reader reader;
	int service = pidfd_open(p->service, 0), fd = socket(AF_UNIX, SOCK_STREAM, 0);
	json_t *hello = json_pack("{s:i}", "protocol", MESSAGE_PROTOCOL + 1);
	json_t *list = json_pack("{s:i}", "id", 5);
	bool ran = false;
	strcpy(address.sun_path, p->project.socket);
	assert_int_equal(connect(fd, (struct sockaddr *)&address, sizeof address), 0);
	message_reader_init(&reader, FROM_SERVICE);
	assert_int_equal(message_send(fd, MESSAGE_HELLO, hello), ST_OK);
	assert_int_equal(next_type(fd, &reader), MESSAGE_HELLO);
	assert_int_equal(next_type(fd, &reader), MESSAGE_ERROR);
	assert_int_equal(message_send(fd, MESSAGE_LIST, list), ST_OK); /* no word but that */
	assert_int_equal(next_type(fd, &reader), MESSAGE_HELLO);
	assert_int_equal(next_type(fd, &reader), MESSAGE_ERROR);
	message_reader_finish(&reader);
	close(fd);
	json_decref(hello);
	json_decref(list);
	assert_int_equal(client_shutdown(&p->project, &ran, NULL), ST_OK);
	assert_true(ran);
	assert_true(process_gone(service));
	close(service);
	assert_int_equal(client_shutdown(&p->project, &ran, NULL), ST_OK);
	assert_false(ran);
	place_connect(p);
}

/* A client with another environment would look for the socket elsewhere. */
static void a_service_is_found_wherever_it_listens(void **state)
{
	struct place *p = *state;
	struct project other;
	struct client *c = NULL;
	struct ucred peer;
	socklen_t size = sizeof peer;
	char *elsewhere = path_join(p->folder, "elsewhere");
	assert_int_equal(mkdir(elsewhere, 0700), 0);
	setenv("XDG_RUNTIME_DIR", elsewhere, 1);
	assert_int_equal(project_find(&other, p->folder, NULL), ST_OK);
	assert_string_not_equal(other.socket, p->project.socket);
	assert_int_equal(project_make(&other, NULL), ST_OK);
	assert_int_equal(client_connect(&c, &other, true, NULL), ST_OK);
	assert_int_equal(getsockopt(client_descriptor(c), SOL_SOCKET, SO_PEERCRED, &peer, &size),
	                 0);
	assert_int_equal(peer.pid, p->service);
	client_close(c);
	project_finish(&other);
	free(elsewhere);
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

static int set_up_idle(void **state)
{
	return place_new(state, "BATTEN_IDLE=0.2");
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

#define T(name)    cmocka_unit_test_setup_teardown(name, place_of_two_jobs, place_gone)
#define IDLE(name) cmocka_unit_test_setup_teardown(name, set_up_idle, place_gone)

int main(void)
{
	signal(SIGPIPE, SIG_IGN);
	const struct CMUnitTest tests[] = {
		T(a_dead_service_takes_its_workers_and_loses_no_job),
		T(shutdown_stops_at_a_unit_and_the_next_start_goes_on),
		T(a_second_service_is_refused),
		T(many_clients_start_one_service),
		T(another_protocol_is_refused_but_may_shut_down),
		T(a_service_is_found_wherever_it_listens),
		T(a_worker_left_behind_is_ended_before_its_job_goes_on),
		T(crash_after_crash_every_job_is_done),
		IDLE(an_idle_service_ends_and_the_next_one_knows_all),
		IDLE(a_job_keeps_the_service_alive_without_clients),
	};
	return cmocka_run_group_tests_name("restart", tests, NULL, NULL);
}
