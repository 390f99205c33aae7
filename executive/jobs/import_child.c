/* import_child.c - `batten import --inputs` as a child. */
#include "import_child.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "file.h"
#include "json.h"
#include "path.h"
#include "text.h"

extern char **environ;

/* The child has said its sentence itself; only its end without one needs ours. */
static enum status status_of_child(int wait_status, const char *argument, const struct report *r)
{
	if (WIFSIGNALED(wait_status)) {
		if (WTERMSIG(wait_status) == SIGINT)
			return ST_CANCELLED;
		return report_error(r, ST_INTERNAL,
		                    "reading '%s' crashed: %s; nothing was submitted", argument,
		                    strsignal(WTERMSIG(wait_status)));
	}
	int rc = WEXITSTATUS(wait_status);
	return rc == 0 ? ST_OK : rc == 2 ? ST_PARAMETER : rc == 130 ? ST_CANCELLED : ST_INPUT;
}

enum status import_child(const char *argument, const struct project *p, json_t **out,
                         const struct report *r)
{
	char *folder = path_of_program(), *program = folder ? path_join(folder, "batten") : NULL;
	char *argv[] = { "batten", "import",  "--inputs", "--json",
		         "--into", p->hidden, "--",       (char *)(size_t)argument,
		         NULL };
	posix_spawn_file_actions_t actions;
	int fds[2] = { -1, -1 }, wait_status = 0;
	struct text said = { 0 };
	enum status st = ST_RESOURCE;
	pid_t pid;

	posix_spawn_file_actions_init(&actions);
	if (program && pipe2(fds, O_CLOEXEC) == 0 &&
	    posix_spawn_file_actions_adddup2(&actions, fds[1], STDOUT_FILENO) == 0 &&
	    posix_spawn(&pid, program, &actions, NULL, argv, environ) == 0) {
		close(fds[1]);
		fds[1] = -1;
		st = file_read_open(fds[0], &said);
		while (waitpid(pid, &wait_status, 0) < 0 && errno == EINTR)
			;
		if (st == ST_OK)
			st = status_of_child(wait_status, argument, r);
		if (st == ST_OK)
			st = json_parse_object(said.s ? said.s : "", said.n,
			                       "answer of batten import", out, r);
	} else
		report_error(r, st, "cannot start batten import: %s", strerror(errno));
	for (int k = 0; k < 2; k++)
		if (fds[k] >= 0)
			close(fds[k]);
	posix_spawn_file_actions_destroy(&actions);
	text_finish(&said);
	free(program);
	free(folder);
	return st;
}
