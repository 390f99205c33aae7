/* prune.c - forget ended jobs. */
#include "connection.h"
#include "verbs.h"

struct forgotten {
	size_t n;
	bool json;
	struct job_text text;
};

static bool forgotten_put(void *data, const struct Stats *s)
{
	struct forgotten *f = data;

	f->n++;
	if (f->json)
		job_text_put(&f->text, s);
	return true; /* all of it, also where nobody reads what is printed */
}

static int prune_run(const struct invocation *i)
{
	struct connection c;
	struct forgotten f = { .json = i->json };
	enum status st = connection_open(&c, i, true);

	if (st != ST_OK)
		return status_exit(st);
	st = client_request(c.client, MESSAGE_PRUNE, json_object(), forgotten_put, NULL, &f,
	                    &i->report);
	int rc = status_exit(st);
	if (st == ST_OK && i->json)
		rc = job_text_end(&f.text);
	else if (st == ST_OK)
		printf("%zu ended jobs forgotten\n", f.n);
	else
		job_text_abandon(&f.text);
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
