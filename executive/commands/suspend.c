/* suspend.c - stop jobs until they are activated. */
#include "each.h"
#include "verbs.h"

static int suspend_run(const struct invocation *i)
{
	return each_job(i, MESSAGE_SUSPEND, NULL);
}

const struct command command_suspend = {
	.name = "suspend",
	.usage = "ID...|--all|--group G",
	.text = "stop jobs until they are activated",
	.help = "The worker and all it started stop where they are and keep their memory. It returns\n"

	        "when they have stopped and the ledger says so.",
	.options = each_options,
	.first_word = WORD_JOB,
	.words = WORD_JOB,
	.run = suspend_run,
};
