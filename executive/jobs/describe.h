/* describe.h - run executables with --describe, all at once, and check what they say. */
#ifndef BATTEN_DESCRIBE_H
#define BATTEN_DESCRIBE_H

#include "roster.h"

enum { DESCRIBE_MS = 2000, DESCRIBE_MAX = 1 << 20 };

/* Fill in description, or broken with the reason. Takes DESCRIBE_MS at most for all of them.
 * Errors: ST_RESOURCE (no memory). */
enum status describe_all(struct roster_worker *workers, int n);

#endif
