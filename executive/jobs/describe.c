/* describe.c - run executables with --describe, all at once, and check what they say. */
#include "describe.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/pidfd.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "description.h"
#include "json.h"
#include "process.h"
#include "text.h"

extern char **environ;

/* One worker being asked. */
struct asked {
	struct roster_worker *worker; /* borrowed */
	pid_t pid;                    /* 0: not running */
	int fd;                       /* -1: closed */
	struct text answer;
};

static int64_t now_ms(void)
{
	struct timespec t;
	clock_gettime(CLOCK_MONOTONIC, &t);
	return (int64_t)t.tv_sec * 1000 + t.tv_nsec / 1000000;
}

static void asked_broken(struct asked *a, char *reason)
{
	if (a->worker->broken)
		free(reason);
	else
		a->worker->broken = reason ? reason : strdup("out of memory");
}

static void asked_start(struct asked *a)
{
	int p[2];
	posix_spawn_file_actions_t actions;
	posix_spawnattr_t attributes;
	if (pipe2(p, O_CLOEXEC)) {
		asked_broken(a, text_print("cannot run it: %s", strerror(errno)));
		return;
	}
	posix_spawn_file_actions_init(&actions);
	posix_spawnattr_init(&attributes);
	process_apart(&attributes);
	posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
	posix_spawn_file_actions_adddup2(&actions, p[1], 1);
	posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
	char describe[] = "--describe";
	char *argv[] = { a->worker->path, describe, NULL };
	int error = posix_spawn(&a->pid, a->worker->path, &actions, &attributes, argv, environ);
	posix_spawn_file_actions_destroy(&actions);
	posix_spawnattr_destroy(&attributes);
	close(p[1]);
	if (error) {
		a->pid = 0;
		close(p[0]);
		asked_broken(a, text_print("cannot run it: %s", strerror(error)));
		return;
	}
	a->fd = p[0];
}

/* Read what is there; at the end, or when it is too much, close. */
static void asked_read(struct asked *a)
{
	char bytes[16384];
	ssize_t n = read(a->fd, bytes, sizeof bytes);
	if (n < 0 && errno == EINTR)
		return;
	if (n > 0) {
		text_add_bytes(&a->answer, bytes, (size_t)n);
		if (a->answer.n <= DESCRIBE_MAX && !a->answer.failed)
			return;
		asked_broken(a, text_print("--describe says more than %d bytes", DESCRIBE_MAX));
	}
	close(a->fd);
	a->fd = -1;
}

static void asked_check(struct asked *a)
{
	struct report_store store;
	report_store_init(&store);
	if (json_parse_object(a->answer.s ? a->answer.s : "", a->answer.n, "--describe",
	                      &a->worker->description, &store.report) != ST_OK) {
		a->worker->description = NULL;
		asked_broken(a, strdup(store.error));
		return;
	}
	char *fault = description_fault(a->worker);
	if (fault) {
		asked_broken(a, fault);
		json_decref(a->worker->description);
		a->worker->description = NULL;
	}
}

/* Its pipe has ended or its time is over: end the process and judge the answer. */
static void asked_end(struct asked *a, bool late)
{
	int status = 0;
	if (a->fd >= 0)
		close(a->fd);
	a->fd = -1;
	if (a->pid) {
		/* WNOWAIT keeps the number ours while the group is signalled. */
		siginfo_t si = { 0 };
		if (late || a->worker->broken)
			kill(-a->pid, SIGKILL);
		waitid(P_PID, (id_t)a->pid, &si, WEXITED | WNOWAIT);
		kill(-a->pid, SIGKILL);
		waitpid(a->pid, &status, 0);
	}
	if (late)
		asked_broken(a,
		             text_print("no answer to --describe within %d s", DESCRIBE_MS / 1000));
	if (a->worker->broken)
		return;
	if (status)
		asked_broken(a, text_print("--describe ends with status %d",
		                           WIFEXITED(status) ? WEXITSTATUS(status)
		                                             : 128 + WTERMSIG(status)));
	else
		asked_check(a);
}

/* A worker that closed its pipe must also exit in the time left. */
static bool asked_exits(const struct asked *a, int64_t deadline)
{
	int fd = a->pid ? pidfd_open(a->pid, 0) : -1;
	if (fd < 0)
		return true;
	struct pollfd p = { .fd = fd, .events = POLLIN };
	int64_t left = deadline - now_ms();
	int n = poll(&p, 1, left > 0 ? (int)left : 0);
	close(fd);
	return n > 0;
}

enum status describe_all(struct roster_worker *workers, int n)
{
	struct asked *a = calloc((size_t)n, sizeof *a);
	struct pollfd *p = calloc((size_t)n, sizeof *p);
	int64_t deadline = now_ms() + DESCRIBE_MS, left;
	enum status st = ST_RESOURCE;
	if (!a || !p)
		goto end;
	for (int i = 0; i < n; i++) {
		a[i].worker = &workers[i];
		a[i].fd = -1;
		asked_start(&a[i]);
	}
	for (int open = 1; open && (left = deadline - now_ms()) > 0;) {
		open = 0;
		for (int i = 0; i < n; i++) {
			p[i] = (struct pollfd){ .fd = a[i].fd, .events = POLLIN };
			open += a[i].fd >= 0;
		}
		if (open && poll(p, (nfds_t)n, (int)left) > 0)
			for (int i = 0; i < n; i++)
				if (p[i].revents)
					asked_read(&a[i]);
	}
	st = ST_OK;
	for (int i = 0; i < n; i++) {
		bool late = a[i].fd >= 0 || !asked_exits(&a[i], deadline);
		asked_end(&a[i], late);
		if (a[i].answer.failed || (!workers[i].description && !workers[i].broken))
			st = ST_RESOURCE;
		text_finish(&a[i].answer);
	}
end:
	free(a);
	free(p);
	return st;
}
