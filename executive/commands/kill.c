/* kill.c - end jobs. */
#include "each.h"
#include "verbs.h"

static int kill_run(const struct invocation *i)
{
	return each_job(i, MESSAGE_KILL, json_pack("{s:s}", "by", "you"));
}

const struct command command_kill = {
	.name = "kill",
	.usage = "ID...|--all|--group G",
	.text = "end jobs",
	.help = "A running job is asked to stop at its next unit, after 2 s told to, after 3 s more made to\n"
	        "(settings cancel-grace and term-grace). It keeps its part file, so retry goes on from there.\n"
	        "It returns when the jobs have ended.",
	.options = each_options,
	.first_word = WORD_JOB,
	.words = WORD_JOB,
	.run = kill_run,
};
