/* release.c - let held jobs start. */
#include "each.h"
#include "verbs.h"

static int release_run(const struct invocation *i)
{
	return each_job(i, MESSAGE_RELEASE, NULL);
}

const struct command command_release = {
	.name = "release",
	.usage = "ID...|--all|--group G",
	.text = "let held jobs start",
	.help = "With --all also a queue that 'batten hold --after-current' holds: what is submitted starts again.",
	.options = each_options,
	.first_word = WORD_JOB,
	.words = WORD_JOB,
	.run = release_run,
};
