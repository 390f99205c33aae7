/* process.h - start one process through the starter, and end one left by a dead service. */
#ifndef BATTEN_PROCESS_H
#define BATTEN_PROCESS_H

#include <spawn.h>
#include <stdint.h>
#include <sys/types.h>

#include "report.h"

enum { SPAWN_WORDS = 64 };

struct spawn {
	const char *starter, *worker;
	char *const *words;    /* of the command, NULL at the end; NULL: the worker alone */
	int log;               /* becomes standard error */
	int niceness, umask;   /* umask -1: ours */
	uint64_t memory_bytes; /* 0: no limit */
};

/* A process in its own group. in, out: our ends of its standard input and output, not blocking;
 * pidfd becomes readable when it ends. Errors: ST_RESOURCE. */
enum status spawn_worker(const struct spawn *s, pid_t *pid, int *in, int *out, int *pidfd,
                         const struct report *r);

/* Of a child in a group of its own that is to hear every signal, whatever we block or ignore. */
void process_apart(posix_spawnattr_t *attributes);

/* If process pid leads its group and runs that worker (others may have got its number since), kill the
 * group and wait for its end, a few seconds at most. It need not be a child. */
void process_bury(pid_t pid, const char *worker);

#endif
