/* shard.c - numbers and file names of the processes that share the units of one job. */
#include "shard.h"

#include "text.h"

/* Jobs are counted in the low bits, more than any project will see. */
enum { JOB_BITS = 40 };

static const int64_t job_mask = ((int64_t)1 << JOB_BITS) - 1;

int64_t shard_id(int64_t job, int shard)
{
	return job | (int64_t)(shard + 1) << JOB_BITS;
}

int64_t shard_job(int64_t id)
{
	return id & job_mask;
}

int shard_of(int64_t id)
{
	return (int)(id >> JOB_BITS) - 1;
}

char *shard_path(const struct project *p, const char *folder, int64_t id, const char *extension)
{
	long long job = shard_job(id);
	int shard = shard_of(id);
	if (shard < 0)
		return text_print("%s/%s/%lld%s", p->hidden, folder, job, extension);
	return text_print("%s/%s/%lld-%d%s", p->hidden, folder, job, shard, extension);
}
