/* place.c - a throw-away project with players of workers, and a service in it. */
#include "place.h"

#include <fcntl.h>
#include <ftw.h>
#include <poll.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/pidfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "file.h"
#include "path.h"
#include "text.h"

enum { GUARD_MS = 20000 };

static struct Stats last; /* the record that place_job gave */

static void player_add(const struct place *p, const char *folder, const char *role,
                       const char *program)
{
	char *self = path_of_program();
	char *from = text_print("%s/%s", self, program);
	char *to = text_print("%s/batten-%s", folder, role);
	(void)p;
	assert_int_equal(symlink(from, to), 0);
	free(self);
	free(from);
	free(to);
}

static void players_add(const struct place *p)
{
	static const char *const bad[] = {
		"babbles", "begets",  "closes",   "crash",      "early",  "error",   "escapes",
		"flood",   "garbage", "half",     "grandchild", "hasty",  "huge",    "json",
		"lazy",    "lies",    "lingers",  "mute",       "notes",  "older",   "quits",
		"shows",   "silent",  "stubborn", "twice",      "undone", "unknown",
	};
	char *folder = path_join(p->project.hidden, "workers");
	assert_int_equal(folder_make(folder, 0777, NULL), ST_OK);
	player_add(p, folder, "good", "good-worker");
	player_add(p, folder, "nothing", "good-worker");
	player_add(p, folder, "burst", "good-worker");
	for (size_t i = 0; i < sizeof bad / sizeof *bad; i++)
		player_add(p, folder, bad[i], "bad-worker");
	free(folder);
}

static void environment_set(const char *environment)
{
	char *copy = strdup(environment), *rest = NULL;
	setenv("BATTEN_CANCEL_GRACE", "2", 1);
	setenv("BATTEN_TERM_GRACE", "3", 1);
	setenv("BATTEN_HELLO_GRACE", "10", 1);
	setenv("BATTEN_END_GRACE", "5", 1);
	setenv("BATTEN_IDLE", "60", 1);
	setenv("BATTEN_JOBS", "4", 1);
	for (char *w = strtok_r(copy, " ", &rest); w; w = strtok_r(NULL, " ", &rest)) {
		char *value = strchr(w, '=');
		assert_non_null(value);
		*value++ = '\0';
		setenv(w, value, 1);
	}
	free(copy);
}

void place_init(struct place *p, const char *environment)
{
	char folder[] = "/tmp/batten-place-XXXXXX";
	memset(p, 0, sizeof *p);
	p->held = -1;
	assert_non_null(mkdtemp(folder));
	p->folder = strdup(folder);
	setenv("XDG_RUNTIME_DIR", folder, 1);
	setenv("XDG_CONFIG_HOME", folder, 1);
	unsetenv("BATTEN_WORKER_PATH");
	environment_set(environment);
	report_store_init(&p->store);
	assert_int_equal(project_find(&p->project, folder, &p->store.report), ST_OK);
	assert_int_equal(project_make(&p->project, &p->store.report), ST_OK);
	players_add(p);
	place_connect(p);
}

int place_new(void **state, const char *environment)
{
	struct place *p = malloc(sizeof *p);
	*state = p;
	if (p)
		place_init(p, environment);
	return !p;
}

int place_of_two_jobs(void **state)
{
	return place_new(state, "BATTEN_JOBS=2");
}

int place_gone(void **state)
{
	place_finish(*state);
	free(*state);
	return 0;
}

void place_connect(struct place *p)
{
	struct ucred peer;
	socklen_t size = sizeof peer;
	client_close(p->client);
	p->client = NULL;
	if (client_connect(&p->client, &p->project, true, &p->store.report) != ST_OK)
		fail_msg("cannot connect: %s", p->store.error);
	assert_int_equal(
	        getsockopt(client_descriptor(p->client), SOL_SOCKET, SO_PEERCRED, &peer, &size), 0);
	p->service = peer.pid;
}

void place_crash(struct place *p)
{
	int fd = pidfd_open(p->service, 0);
	assert_true(fd >= 0);
	assert_int_equal(kill(p->service, SIGKILL), 0);
	assert_true(process_gone(fd));
	close(fd);
	client_close(p->client);
	p->client = NULL;
}

static int take_away(const char *path, const struct stat *s, int type, struct FTW *ftw)
{
	(void)s;
	(void)type;
	(void)ftw;
	return remove(path);
}

/* A service that this process started ends well: no leak, no fault that a checked build would find. */
static void service_check(const struct place *p)
{
	char *path = path_join(p->project.hidden, "logs/service.log"), *text = NULL;
	size_t n = 0;
	int status = 0;
	if (waitpid(p->service, &status, 0) == p->service && status) {
		file_read(path, 1 << 20, &text, &n, NULL);
		fail_msg("the service ends with %x: %s", (unsigned)status, text ? text : "");
	}
	free(path);
}

void place_finish(struct place *p)
{
	if (p->client) {
		int fd = pidfd_open(p->service, 0);
		client_request(p->client, MESSAGE_SHUTDOWN, json_object(), NULL, NULL, NULL, NULL);
		client_close(p->client);
		assert_true(fd < 0 || process_gone(fd));
		if (fd >= 0)
			close(fd);
		service_check(p);
	}
	if (p->held >= 0)
		close(p->held);
	stats_finish(&last);
	nftw(p->folder, take_away, 16, FTW_DEPTH | FTW_PHYS);
	project_finish(&p->project);
	free(p->folder);
}

char *place_gate(struct place *p, const char *name)
{
	char *path = path_join(p->folder, name);
	assert_int_equal(mkfifo(path, 0600), 0);
	return path;
}

void place_open_gate(struct place *p, const char *name, int steps)
{
	char *path = path_join(p->folder, name);
	/* read and write: a FIFO so opened waits for nobody and forgets nothing while it is open */
	int fd = open(path, O_RDWR);
	assert_true(fd >= 0);
	for (int i = 0; i < steps; i++)
		assert_int_equal(write(fd, "s", 1), 1);
	free(path);
	if (p->held >= 0)
		close(p->held);
	p->held = fd;
}

static bool keep_id(void *data, const struct Stats *s)
{
	int64_t *id = data;
	*id = s->id;
	return true;
}

int64_t place_submit(struct place *p, const char *role, int units, const char *gate)
{
	int64_t id = 0;
	char *output = path_join(p->folder, "result"), *n = text_print("%d", units);
	json_t *parameters = json_pack("{s:s}", "units", n);
	if (gate)
		json_object_set_new(parameters, "gate", json_string(gate));
	json_t *job = json_pack("{s:s, s:s, s:s, s:o}", "worker", role, "output", output,
	                        "file_name", "hull.igs", "parameters", parameters);
	enum status st =
	        client_request(p->client, MESSAGE_SUBMIT, json_pack("{s:[o]}", "jobs", job),
	                       keep_id, NULL, &id, &p->store.report);
	if (st != ST_OK)
		fail_msg("cannot submit: %s", p->store.error);
	free(output);
	free(n);
	return id;
}

static json_t *named(int64_t id)
{
	return json_pack("{s:[I]}", "jobs", (json_int_t)id);
}

enum status place_ask(struct place *p, enum message_type type, int64_t id)
{
	report_store_init(&p->store);
	return client_request(p->client, type, named(id), NULL, NULL, NULL, &p->store.report);
}

static bool keep_record(void *data, const struct Stats *s)
{
	(void)data;
	stats_finish(&last);
	assert_int_equal(stats_copy(&last, s), ST_OK);
	return true;
}

const struct Stats *place_job(struct place *p, int64_t id)
{
	assert_int_equal(client_request(p->client, MESSAGE_LIST, named(id), keep_record, NULL, NULL,
	                                &p->store.report),
	                 ST_OK);
	assert_int_equal(last.id, id);
	return &last;
}

/* A connection of its own, or what is still told would meet the next request. */
static void watch(struct place *p, int64_t id, enum job_state state, int units)
{
	struct client *c;
	bool ended = false, gone = false;
	assert_int_equal(client_connect(&c, &p->project, false, &p->store.report), ST_OK);
	assert_int_equal(client_send(c, MESSAGE_WATCH, named(id), NULL), ST_OK);
	last.id = 0;
	while (!ended && (last.id != id || last.state != state || last.done < units)) {
		struct pollfd fd = { .fd = client_descriptor(c), .events = POLLIN };
		if (poll(&fd, 1, GUARD_MS) <= 0)
			fail_msg("nothing was told of job %lld: it is %s, %lld of %lld",
			         (long long)id, job_state_table[last.state].word,
			         (long long)last.done, (long long)last.total);
		assert_int_equal(
		        client_listen(c, 0, -1, keep_record, NULL, &ended, &gone, &p->store.report),
		        ST_OK);
	}
	client_close(c);
	if (last.state != state || last.done < units)
		fail_msg("job %lld is %s (%s), expected %s", (long long)id,
		         job_state_table[last.state].word, last.reason ? last.reason : "",
		         job_state_table[state].word);
}

void place_until(struct place *p, int64_t id, enum job_state state)
{
	watch(p, id, state, 0);
}

void place_until_done(struct place *p, int64_t id, int units)
{
	watch(p, id, JOB_RUNNING, units);
}

const struct Stats *place_end(struct place *p, int64_t id)
{
	assert_int_equal(client_send(p->client, MESSAGE_WAIT, named(id), NULL), ST_OK);
	for (bool ended = false, gone = false; !ended;) {
		struct pollfd fd = { .fd = client_descriptor(p->client), .events = POLLIN };
		if (poll(&fd, 1, GUARD_MS) <= 0)
			fail_msg("job %lld does not end", (long long)id);
		assert_int_equal(client_listen(p->client, 0, -1, NULL, NULL, &ended, &gone,
		                               &p->store.report),
		                 ST_OK);
		assert_false(gone);
	}
	return place_job(p, id);
}

char process_state(pid_t pid)
{
	char path[64], text[512] = "";
	snprintf(path, sizeof path, "/proc/%ld/stat", (long)pid);
	FILE *f = fopen(path, "r");
	if (!f)
		return 0;
	size_t n = fread(text, 1, sizeof text - 1, f);
	fclose(f);
	text[n] = '\0';
	const char *name_end = strrchr(text, ')');
	return name_end && name_end[1] ? name_end[2] : 0;
}

bool process_gone(int pidfd)
{
	struct pollfd fd = { .fd = pidfd, .events = POLLIN };
	return poll(&fd, 1, GUARD_MS) > 0;
}
