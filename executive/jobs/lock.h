/* lock.h - one service a project folder. */
#ifndef BATTEN_LOCK_H
#define BATTEN_LOCK_H

#include <stdbool.h>
#include <stdint.h>

#include "project.h"

/*
 * Take the project's lock; it is let go when fd is closed, and by the process's end. A second part
 * of it is held while the service does not listen: while it starts, and while it ends.
 * wait: where another service has it, wait until that one listens (then that is an error), or is
 * gone (then it is taken).
 * Errors: ST_RESOURCE (another has it: host and process are named; or it cannot be made).
 */
enum status lock_take(const struct project *p, bool wait, int *fd, const struct report *r);
void lock_listening(int fd, bool listening);

/* Is there a service that does not listen, since it begins or ends? Then wait until it listens or is
 * gone, for so many milliseconds at most. */
bool lock_is_deaf(const struct project *p, int ms);

/* A service that takes long to begin says now and then that it does begin: its lock's time changes.
 * Nanoseconds of that time, 0 where there is no lock. */
void lock_touch(int fd);
int64_t lock_touched(const struct project *p);

/* Where the service that took the lock last listens: another environment may have given it another
 * place than p->socket. Fresh; NULL: not known. */
char *lock_socket(const struct project *p);

#endif
