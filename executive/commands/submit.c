/* submit.c - queue jobs. */
#include "submission.h"
#include "verbs.h"

static int submit_run(const struct invocation *i)
{
	struct connection c;
	struct job_list list = { 0 };
	enum status st = submission_send(i, &c, &list);
	int rc = status_exit(st);

	if (st == ST_OK && i->json)
		rc = job_list_print_json(&list);
	else if (st == ST_OK)
		for (size_t k = 0; k < list.n; k++)
			printf("%lld\n", (long long)list.jobs[k].id);
	job_list_finish(&list);
	connection_close(&c);
	return rc;
}

const struct command command_submit = {
	.name = "submit",
	.usage = "WORKER INPUT... [--PARAMETER VALUE]... [-o NAME]",
	.text = "queue jobs and print their ids",
	.help = submission_help,
	.options = submission_options,
	.first_word = WORD_WORKER,
	.words = WORD_FILE,
	.takes_value = submission_takes_value,
	.run = submit_run,
};
