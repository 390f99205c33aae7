/* service_start.c - start a project's service, and wait until it listens. */
#include "service_start.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "lock.h"
#include "path.h"

extern char **environ;

enum { READY_MS = 10000 };

/* Wait until all copies of the pipe's other end are closed, or nothing has happened for READY_MS. */
static bool wait_closed(int fd, const struct project *project, const struct report *r)
{
	struct pollfd p = { .fd = fd, .events = POLLIN };
	int64_t touched = lock_touched(project);
	bool told = false;

	for (;;) {
		int n = poll(&p, 1, READY_MS);
		if (n > 0)
			return true;
		if (n < 0 && errno != EINTR)
			return false;
		int64_t last = touched;
		touched = lock_touched(project);
		if (n == 0 && touched == last)
			return false;
		if (n == 0 && !told)
			report_info(r, "the service reads a ledger of many jobs; 'batten prune' "
			               "forgets those that have ended");
		told |= n == 0;
	}
}

/* The environment with BATTEN_READY_FD. Fresh array; its last string is `ready`. */
static char **environment_with(char *ready)
{
	size_t n = 0, to = 0;

	while (environ[n])
		n++;
	char **all = calloc(n + 2, sizeof *all);
	for (size_t i = 0; all && i < n; i++)
		if (strncmp(environ[i], "BATTEN_READY_FD=", 16))
			all[to++] = environ[i];
	if (all)
		all[to] = ready;
	return all;
}

enum status service_start(const struct project *p, const struct report *r)
{
	enum status st = project_check(p, r);
	if (st != ST_OK)
		return st;
	char *folder = path_of_program(), *program = folder ? path_join(folder, "batten") : NULL;
	char *log = path_join(p->hidden, "logs/service.log"), ready[] = "BATTEN_READY_FD=3";
	char *argv[] = { "batten", "serve", NULL }, **environment = environment_with(ready);
	posix_spawn_file_actions_t actions;
	posix_spawnattr_t attributes;
	int fds[2] = { -1, -1 }, error = ENOMEM;
	pid_t pid;

	posix_spawn_file_actions_init(&actions);
	posix_spawnattr_init(&attributes);
	posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID | POSIX_SPAWN_SETSIGMASK);
	sigset_t none;
	sigemptyset(&none);
	posix_spawnattr_setsigmask(&attributes, &none);
	if (program && log && environment && pipe2(fds, O_CLOEXEC) == 0) {
		posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
		posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
		posix_spawn_file_actions_addopen(&actions, 2, log, O_WRONLY | O_CREAT | O_APPEND,
		                                 0600);
		posix_spawn_file_actions_adddup2(&actions, fds[1], 3);
		/* nobody who waits for the end of a pipe of ours shall wait for the service */
		posix_spawn_file_actions_addclosefrom_np(&actions, 4);
		posix_spawn_file_actions_addchdir_np(&actions, p->folder);
		error = posix_spawn(&pid, program, &actions, &attributes, argv, environment);
	}
	if (fds[1] >= 0)
		close(fds[1]);
	bool answered = !error && wait_closed(fds[0], p, r);
	if (fds[0] >= 0)
		close(fds[0]);
	posix_spawn_file_actions_destroy(&actions);
	posix_spawnattr_destroy(&attributes);
	free(environment);
	if (error)
		st = report_error(r, ST_RESOURCE, "cannot start the service '%s': %s",
		                  program ? program : "batten", strerror(error));
	else if (!answered)
		st = report_error(r, ST_RESOURCE, "the service did not start within %d s; see '%s'",
		                  READY_MS / 1000, log);
	free(log);
	free(program);
	free(folder);
	return st;
}
