/* wait.c - wait for the end of jobs. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "connection.h"
#include "number.h"
#include "verbs.h"

enum { EXIT_TIMEOUT = 124 };

static const struct option_row wait_options[] = {
	{ "--timeout", NULL, "S", "seconds after which to give up (exit status 124)" },
	{ "--all", NULL, NULL, "all jobs that are not over (the default)" },
	{ "--group", NULL, "G", "the jobs of a group" },
	{ 0 },
};

static double now(void)
{
	struct timespec t;

	clock_gettime(CLOCK_MONOTONIC, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static bool put_job(void *data, const struct Stats *s)
{
	job_list_put(data, s);
	return true;
}

/* Follow the jobs until all are over or the time is out. */
static enum status listen_to_the_end(struct connection *c, const struct invocation *i,
                                     struct job_list *list, double until, bool *out_of_time)
{
	enum status st = ST_OK;
	bool ended = false, gone = false;

	*out_of_time = false;
	while (st == ST_OK && !ended && !*out_of_time) {
		double left = until - now();
		*out_of_time = left <= 0;
		if (!*out_of_time)
			st = client_listen(c->client,
			                   left > 3600 ? 3600000 : (int)ceil(1000 * left), -1,
			                   put_job, list, &ended, &gone, &i->report);
	}
	if (st == ST_OK && gone)
		st = report_error(&i->report, ST_RESOURCE,
		                  "the service went away; batten wait again starts it and waits");
	return st;
}

static int wait_run(const struct invocation *i)
{
	struct connection c;
	struct job_list list = { 0 };
	json_t *body = NULL;
	double timeout = INFINITY;
	const char *text = invocation_value(i, "--timeout");
	bool out_of_time = false;

	if (text && (!number_parse(text, &timeout) || timeout < 0))
		return status_exit(report_error(&i->report, ST_PARAMETER,
		                                "--timeout is '%s'; it must be seconds, 0 or more",
		                                text));
	double until = now() + timeout;
	enum status st = connection_selection(i, false, &body);
	if (st == ST_OK && !json_object_size(body))
		json_object_set_new(body, "all", json_true());
	if (st == ST_OK)
		st = connection_open(&c, i, true);
	if (st != ST_OK) {
		json_decref(body);
		return status_exit(st);
	}
	st = client_send(c.client, MESSAGE_WAIT, body, &i->report);
	if (st == ST_OK)
		st = listen_to_the_end(&c, i, &list, until, &out_of_time);
	int rc = status_exit(st);
	if (st == ST_OK) {
		rc = out_of_time ? EXIT_TIMEOUT : job_list_exit(&list) ? 1 : 0;
		connection_bell(&c);
		if (i->json && job_list_print_json(&list))
			rc = 1;
	}
	job_list_finish(&list);
	connection_close(&c);
	return rc;
}

const struct command command_wait = {
	.name = "wait",
	.usage = "[ID...] [--timeout S]",
	.text = "wait until jobs are over",
	.help = "Without ids: all jobs that are not over. Exit status: 0 all done; 1 any failed, killed or\n"
	        "lost; 124 the time ran out.",
	.options = wait_options,
	.first_word = WORD_JOB,
	.words = WORD_JOB,
	.run = wait_run,
};
