/* roster.h - the workers there are: executables that describe themselves. */
#ifndef BATTEN_ROSTER_H
#define BATTEN_ROSTER_H

#include <jansson.h>

#include "project.h"

/* One executable batten-NAME. */
struct roster_worker {
	char *name, *path;   /* owned */
	json_t *description; /* owned; as --describe prints it; NULL where broken */
	char *broken;        /* owned; why, or NULL */
};

struct roster {
	struct roster_worker *workers; /* owned, by name */
	int n;
};

/*
 * Look for batten-* beside the program, in its build tree (../workers), in the installed folder, in
 * $BATTEN_WORKER_PATH, the project's .batten/workers and $XDG_CONFIG_HOME/batten/workers; the first
 * of a name wins. Each is run with --describe (2 s at most, 1 MiB at most) and its answer checked.
 * only: just this one (NULL: all).
 */
enum status roster_read(struct roster *out, const struct project *p, const char *only,
                        const struct report *r);

/* Path of one worker, fresh, without running it. Errors: ST_PARAMETER (there is none), ST_RESOURCE. */
enum status roster_locate(char **out, const struct project *p, const char *name,
                          const struct report *r);
void roster_finish(struct roster *x);
const struct roster_worker *roster_find(const struct roster *x, const char *name);

/* Check a value in command-line form against a parameter's row of the description.
 * Errors: ST_PARAMETER: what it is, what is allowed. */
enum status roster_check(const struct roster_worker *w, const char *parameter, const char *value,
                         const struct report *r);

#endif
