/* hold.c - keep queued jobs from starting. */
#include "each.h"
#include "verbs.h"

static int hold_run(const struct invocation *i)
{
	return each_job(i, MESSAGE_HOLD, NULL);
}

const struct command command_hold = {
	.name = "hold",
	.usage = "ID...|--all|--group G",
	.text = "keep queued jobs from starting",
	.help = "Held jobs stay in the queue until they are released.",
	.options = each_options,
	.first_word = WORD_JOB,
	.words = WORD_JOB,
	.run = hold_run,
};
