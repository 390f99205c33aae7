/* starter.c - batten-launch: becomes a worker, after setting what a worker must not set for itself.
 *
 *	batten-launch PARENT NICENESS BYTES UMASK WORKER [WORD...]
 *
 * PARENT is the service's process, BYTES the limit on the worker's private memory (0: none), UMASK
 * octal (-: the service's own): the files are those of who asked for them. The process keeps its
 * number and its group. It stands alone so that it starts at once.
 */
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include "checked.h"

enum { STATUS_USAGE = 125, STATUS_NOT_STARTED = 126 };

static int starter_fails(const char *what)
{
	fprintf(stderr, "batten-launch: cannot %s: %s\n", what, strerror(errno));
	return STATUS_NOT_STARTED;
}

static int limit_set(int which, rlim_t value)
{
	struct rlimit limit;
	if (getrlimit(which, &limit))
		return -1;
	if (limit.rlim_max == RLIM_INFINITY || value < limit.rlim_max)
		limit.rlim_max = value;
	limit.rlim_cur = limit.rlim_max;
	return setrlimit(which, &limit);
}

int main(int argc, char **argv)
{
	if (argc < 6) {
		fprintf(stderr,
		        "usage: batten-launch PARENT NICENESS BYTES UMASK WORKER [WORD...]\n");
		return STATUS_USAGE;
	}
	pid_t parent = (pid_t)atol(argv[1]);
	int niceness = atoi(argv[2]);
	unsigned long long bytes = strtoull(argv[3], NULL, 10);

	if (prctl(PR_SET_PDEATHSIG, SIGKILL))
		return starter_fails("ask for the parent's death");
	/* it may have died before it was asked for */
	if (getppid() != parent)
		raise(SIGKILL);
	close_range(3, ~0U, 0);
	if (limit_set(RLIMIT_CORE, 0) || (bytes && !CHECKED_BUILD && limit_set(RLIMIT_DATA, bytes)))
		return starter_fails("set limits");
	if (niceness)
		setpriority(PRIO_PROCESS, 0, niceness);
	/* batten's own threads are all there are */
	if (setenv("OPENBLAS_NUM_THREADS", "1", 1) || setenv("OMP_NUM_THREADS", "1", 1))
		return starter_fails("set the environment");
	if (*argv[4] != '-')
		umask((mode_t)strtoul(argv[4], NULL, 8) & 0777);
	execv(argv[5], argv + 5);
	starter_fails("start the worker");
	fprintf(stderr, "batten-launch: the worker is '%s'\n", argv[5]);
	return STATUS_NOT_STARTED;
}
