/* jobs.c - the table of jobs. */
#include <signal.h>
#include <stdlib.h>

#include "board.h"
#include "verbs.h"

static const struct option_row jobs_options[] = {
	{ "--all", NULL, NULL, "also those that ended more than an hour ago" },
	{ "--group", NULL, "G", "the jobs of a group" },
	{ "--follow", "-f", NULL, "keep the board on the screen until all are over" },
	{ 0 },
};

static int follow(struct connection *c, const struct invocation *i, json_t *body)
{
	struct board b;
	bool ended = false, gone = false;

	board_init(&b, i->color);
	enum status st = client_send(c->client, MESSAGE_WATCH, body, &i->report);
	while (st == ST_OK && !ended) {
		board_draw(&b);
		st = client_listen(c->client, 250, -1, board_put, &b, &ended, &gone, &i->report);
	}
	board_draw(&b);
	int rc = status_exit(st);
	if (st == ST_OK && i->json)
		rc = job_list_print_json(&b.list);
	board_finish(&b);
	return rc;
}

static int jobs_run(const struct invocation *i)
{
	struct connection c;
	struct job_list list = { 0 };
	json_t *body = NULL;
	enum status st = connection_selection(i, false, &body);

	if (st == ST_OK)
		st = connection_open(&c, i, true);
	if (st != ST_OK) {
		json_decref(body);
		return status_exit(st);
	}
	int rc;
	if (invocation_flag(i, "--follow")) {
		rc = follow(&c, i, body);
	} else if (i->json) {
		struct text t = { 0 };
		st = client_list(c.client, body, job_text_between, &t, &i->report);
		rc = st == ST_OK ? job_text_print(&t) : status_exit(st);
		text_finish(&t);
	} else {
		st = client_request(c.client, MESSAGE_LIST, body, job_list_add, NULL, &list,
		                    &i->report);
		rc = status_exit(st);
		if (st == ST_OK)
			job_list_print(&list, i->color, stdout);
	}
	job_list_finish(&list);
	connection_close(&c);
	return rc;
}

const struct command command_jobs = {
	.name = "jobs",
	.usage = "[ID...] [--all] [--group G] [--follow]",
	.text = "show the jobs",
	.help = "All jobs that are not over, and those that ended in the last hour. A job that waits says\n"
	        "why; a job that failed says why and what to do.",
	.options = jobs_options,
	.first_word = WORD_JOB,
	.words = WORD_JOB,
	.run = jobs_run,
};
