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

/* So many rows are held back, so that what fails early prints nothing; the rest is printed as it comes. */
enum { ROWS_HELD = 1000 };

struct table {
	struct job_list held;
	bool begun, color;
};

static bool table_put(void *data, const struct Stats *s)
{
	struct table *t = data;

	if (t->held.n == ROWS_HELD) {
		job_list_print(&t->held, t->begun, t->color, stdout);
		job_list_finish(&t->held);
		t->begun = true;
	}
	return job_list_add(&t->held, s) && !ferror(stdout);
}

static int list_table(struct connection *c, const struct invocation *i, json_t *body)
{
	struct table t = { .color = i->color };
	enum status st =
	        client_request(c->client, MESSAGE_LIST, body, table_put, NULL, &t, &i->report);

	if (st == ST_OK && t.held.failed)
		st = report_error(&i->report, ST_RESOURCE, "memory ran out");
	if (st == ST_OK)
		job_list_print(&t.held, t.begun, t.color, stdout);
	job_list_finish(&t.held);
	return status_exit(st);
}

static int list_json(struct connection *c, const struct invocation *i, json_t *body)
{
	struct job_text t = { 0 };
	enum status st = client_list(c->client, body, job_text_add, &t, &i->report);

	if (st == ST_OK)
		return job_text_end(&t);
	job_text_abandon(&t);
	return status_exit(st);
}

static int jobs_run(const struct invocation *i)
{
	struct connection c;
	json_t *body = NULL;
	enum status st = connection_selection(i, false, &body);

	if (st == ST_OK)
		st = connection_open(&c, i, true);
	if (st != ST_OK) {
		json_decref(body);
		return status_exit(st);
	}
	int rc;
	if (invocation_flag(i, "--follow"))
		rc = follow(&c, i, body);
	else
		rc = i->json ? list_json(&c, i, body) : list_table(&c, i, body);
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
