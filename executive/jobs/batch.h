/* batch.h - the jobs of one SUBMIT. */
#ifndef BATTEN_BATCH_H
#define BATTEN_BATCH_H

#include "stats.h"

struct batch {
	struct Stats *jobs; /* owned */
	int n, cap;
};

/*
 * Read a SUBMIT's list: job objects, or paths of JSON files of one or of a list of them. Added to b,
 * which is finished by the caller, also after a failure. Errors: ST_PARAMETER (no job), ST_INPUT
 * (no such file), ST_RESOURCE.
 */
enum status batch_read(struct batch *b, const json_t *jobs, const struct report *r);
void batch_finish(struct batch *b);

#endif
