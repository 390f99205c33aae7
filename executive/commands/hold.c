/* hold.c - keep queued jobs from starting. */
#include "each.h"
#include "verbs.h"

static const struct option_row hold_options[] = {
	{ "--after-current", NULL, NULL,
	  "leave those that have begun alone; without names: hold all that comes, too" },
	{ "--all", NULL, NULL, "all jobs it can be done to" },
	{ "--group", NULL, "G", "the jobs of a group" },
	{ 0 },
};

static int hold_run(const struct invocation *i)
{
	bool named = i->n_words || invocation_flag(i, "--all") || invocation_flag(i, "--group");

	if (!invocation_flag(i, "--after-current"))
		return each_job(i, MESSAGE_HOLD, NULL);
	if (named)
		return each_job(i, MESSAGE_HOLD, json_pack("{s:b}", "after_current", 1));
	return each_job(i, MESSAGE_HOLD, json_pack("{s:b, s:b}", "after_current", 1, "all", 1));
}

const struct command command_hold = {
	.name = "hold",
	.usage = "ID...|--all|--group G|--after-current [ID...|--all|--group G]",
	.text = "keep queued jobs from starting",
	.help = "Held jobs stay in the queue until they are released. A job that has begun cannot be held.\n"
	        "\n"
	        "With --after-current those that have begun go on to their end, and nothing more of what is named\n"
	        "starts. With --all, or without names, that is the whole queue: jobs submitted or retried later\n"
	        "are held, too, also after the service has ended and begun again, until 'batten release --all'.",
	.options = hold_options,
	.first_word = WORD_JOB,
	.words = WORD_JOB,
	.run = hold_run,
};
