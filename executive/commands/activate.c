/* activate.c - let suspended jobs go on. */
#include "each.h"
#include "verbs.h"

static int activate_run(const struct invocation *i)
{
	return each_job(i, MESSAGE_ACTIVATE, NULL);
}

const struct command command_activate = {
	.name = "activate",
	.usage = "ID...|--all|--group G",
	.text = "let suspended jobs go on",
	.help = "A job that was suspended when the service ended has no process any more: it is queued, first\n"

	        "in line, and goes on from its part file.",
	.options = each_options,
	.first_word = WORD_JOB,
	.words = WORD_JOB,
	.run = activate_run,
};
