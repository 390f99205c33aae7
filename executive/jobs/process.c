/* process.c - start one process through the starter, and end one left by a dead service. */
#include "process.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/pidfd.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

void process_apart(posix_spawnattr_t *attributes)
{
	sigset_t none, all;
	sigemptyset(&none);
	sigfillset(&all);
	posix_spawnattr_setsigmask(attributes, &none);
	posix_spawnattr_setsigdefault(attributes, &all);
	posix_spawnattr_setflags(attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK |
	                                             POSIX_SPAWN_SETSIGDEF);
}

static int starter_run(const struct spawn *s, int in, int out, pid_t *pid)
{
	char parent[24], niceness[12], memory[24], mask[12];
	char *alone[] = { (char *)s->worker, NULL };
	char *const *words = s->words ? s->words : alone;
	char *argv[SPAWN_WORDS + 6] = { (char *)s->starter, parent, niceness, memory, mask };
	for (size_t i = 0; words[i] && i < SPAWN_WORDS; i++)
		argv[i + 5] = words[i];
	snprintf(parent, sizeof parent, "%ld", (long)getpid());
	snprintf(niceness, sizeof niceness, "%d", s->niceness);
	snprintf(memory, sizeof memory, "%llu", (unsigned long long)s->memory_bytes);
	snprintf(mask, sizeof mask, s->umask < 0 ? "-" : "%o", (unsigned)s->umask);

	posix_spawn_file_actions_t actions;
	posix_spawnattr_t attributes;
	posix_spawn_file_actions_init(&actions);
	posix_spawnattr_init(&attributes);
	process_apart(&attributes);
	posix_spawn_file_actions_adddup2(&actions, in, 0);
	posix_spawn_file_actions_adddup2(&actions, out, 1);
	posix_spawn_file_actions_adddup2(&actions, s->log, 2);
	int error = posix_spawn(pid, s->starter, &actions, &attributes, argv, environ);
	posix_spawn_file_actions_destroy(&actions);
	posix_spawnattr_destroy(&attributes);
	return error;
}

enum status spawn_worker(const struct spawn *s, pid_t *pid, int *in, int *out, int *pidfd,
                         const struct report *r)
{
	int to[2], from[2], error;
	if (pipe2(to, O_CLOEXEC)) {
		error = errno;
		goto fail;
	}
	if (pipe2(from, O_CLOEXEC)) {
		error = errno;
		goto fail_to;
	}
	error = starter_run(s, to[0], from[1], pid);
	if (error)
		goto fail_from;
	*pidfd = pidfd_open(*pid, 0);
	if (*pidfd < 0) {
		error = errno;
		kill(-*pid, SIGKILL);
		waitpid(*pid, NULL, 0);
		goto fail_from;
	}
	fcntl(*pidfd, F_SETFD, FD_CLOEXEC);
	fcntl(to[1], F_SETFL, O_NONBLOCK);
	fcntl(from[0], F_SETFL, O_NONBLOCK);
	close(to[0]);
	close(from[1]);
	*in = to[1];
	*out = from[0];
	return ST_OK;
fail_from:
	close(from[0]);
	close(from[1]);
fail_to:
	close(to[0]);
	close(to[1]);
fail:
	return report_error(r, ST_RESOURCE, "cannot start worker '%s': %s", s->worker,
	                    strerror(error));
}

enum { BURY_MS = 3000 };

static bool runs_worker(pid_t pid, const char *worker)
{
	char path[64], line[4096];
	snprintf(path, sizeof path, "/proc/%ld/cmdline", (long)pid);
	int fd = open(path, O_RDONLY | O_CLOEXEC);
	ssize_t n = fd < 0 ? -1 : read(fd, line, sizeof line - 1);
	if (fd >= 0)
		close(fd);
	if (n <= 0)
		return false;
	line[n] = '\0';
	/* one of its words, with the zero byte behind it: a script stands behind its interpreter */
	return memmem(line, (size_t)n + 1, worker, strlen(worker) + 1) ||
	       strstr(line, "batten-launch");
}

void process_bury(pid_t pid, const char *worker)
{
	/* opened first: from then on the number cannot come to mean another */
	struct pollfd p = { .fd = pidfd_open(pid, 0), .events = POLLIN };
	if (p.fd < 0)
		return;
	if (getpgid(pid) == pid && runs_worker(pid, worker)) {
		kill(-pid, SIGKILL);
		poll(&p, 1, BURY_MS);
	}
	close(p.fd);
}
