/* job_file.h - what START names: all that a worker must know of its job. */
#ifndef BATTEN_JOB_FILE_H
#define BATTEN_JOB_FILE_H

#include "project.h"
#include "stats.h"

/* s->id may be a shard's (shard.h). Not synced: after a crash it is made again from the ledger. Errors: ST_RESOURCE. */
enum status job_file_write(const char *path, const struct project *p, const struct Stats *s,
                           const struct report *r);

#endif
