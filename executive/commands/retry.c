/* retry.c - queue failed, killed or lost jobs again. */
#include "each.h"
#include "verbs.h"

static int retry_run(const struct invocation *i)
{
	return each_job(i, MESSAGE_RETRY, NULL);
}

const struct command command_retry = {
	.name = "retry",
	.usage = "ID...|--all|--group G",
	.text = "queue failed, killed or lost jobs again",
	.help = "They go on from their part files: what was done is not done again. --all and --group leave out\n"
	        "jobs that were killed: name those.",
	.options = each_options,
	.first_word = WORD_JOB,
	.words = WORD_JOB,
	.run = retry_run,
};
