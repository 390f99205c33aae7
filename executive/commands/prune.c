/* prune.c - forget ended jobs. */
#include "connection.h"
#include "verbs.h"

static int prune_run(const struct invocation *i)
{
	struct connection c;
	struct job_list list = { 0 };
	enum status st = connection_open(&c, i, true);

	if (st != ST_OK)
		return status_exit(st);
	st = client_request(c.client, MESSAGE_PRUNE, json_object(), job_list_add, NULL, &list,
	                    &i->report);
	int rc = status_exit(st);
	if (st == ST_OK && i->json)
		rc = job_list_print_json(&list);
	else if (st == ST_OK)
		printf("%zu ended jobs forgotten\n", list.n);
	job_list_finish(&list);
	connection_close(&c);
	return rc;
}

const struct command command_prune = {
	.name = "prune",
	.usage = "",
	.text = "forget ended jobs and what only they needed",
	.help = "Records, logs, job files and part files of jobs that are over go, and inputs that no job\n"
	        "left needs. Results stay: they are yours.",
	.run = prune_run,
};
