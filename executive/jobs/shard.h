/* shard.h - numbers and file names of the processes that share the units of one job. */
#ifndef BATTEN_SHARD_H
#define BATTEN_SHARD_H

#include <stdint.h>

#include "project.h"

enum { SHARDS_MAX = 1024 };

/*
 * To its launcher each process is a number: the job's own for the one that does the whole or joins
 * what the others did, one made of the job's and the shard's for those.
 */
int64_t shard_id(int64_t job, int shard);
int64_t shard_job(int64_t id);
int shard_of(int64_t id); /* -1: no shard */

/* .batten/FOLDER/12.EXTENSION, of a shard 12-3.EXTENSION. Fresh; NULL for want of memory. */
char *shard_path(const struct project *p, const char *folder, int64_t id, const char *extension);

#endif
