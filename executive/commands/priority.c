/* priority.c - say which queued jobs start first. */
#include "each.h"
#include "verbs.h"

static const struct option_row priority_options[] = {
	{ "--to", NULL, "N", "the new priority, -100 to 100 (default 10); higher starts first" },
	{ "--top", NULL, NULL, "before all others that wait" },
	{ "--all", NULL, NULL, "all jobs that are not over" },
	{ "--group", NULL, "G", "the jobs of a group" },
	{ 0 },
};

static int priority_run(const struct invocation *i)
{
	long n;
	enum status st = invocation_integer(i, "--to", -100, 100, 10, &n);

	if (st != ST_OK)
		return status_exit(st);
	return each_job(
	        i, MESSAGE_PRIORITY,
	        json_pack("{s:i, s:b}", "priority", (int)n, "top", invocation_flag(i, "--top")));
}

const struct command command_priority = {
	.name = "priority",
	.usage = "ID...|--all|--group G [--to N|--top]",
	.text = "say which queued jobs start first",
	.help = "Jobs are submitted with priority 0; among equals the older one starts first.",
	.options = priority_options,
	.first_word = WORD_JOB,
	.words = WORD_JOB,
	.run = priority_run,
};
