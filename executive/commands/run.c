/* run.c - submit jobs and follow them to their end. */
#include <errno.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include "board.h"
#include "json.h"
#include "submission.h"
#include "verbs.h"

enum { DRAW_MS = 250 };

/* What the signals that came ask for. */
struct wish {
	bool leave; /* a second Ctrl-C, or the terminal is gone */
	bool kill;  /* the first Ctrl-C */
};

static int open_signals(void)
{
	sigset_t set;

	sigemptyset(&set);
	sigaddset(&set, SIGINT);
	sigaddset(&set, SIGTERM);
	sigaddset(&set, SIGHUP);
	sigprocmask(SIG_BLOCK, &set, NULL);
	return signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK);
}

static void read_signals(int fd, struct wish *w)
{
	struct signalfd_siginfo s;

	while (fd >= 0 && read(fd, &s, sizeof s) == sizeof s) {
		if (s.ssi_signo == SIGHUP || w->kill)
			w->leave = true;
		else
			w->kill = true;
	}
}

static json_t *ids_of(const struct job_list *l)
{
	json_t *ids = json_array();

	for (size_t k = 0; k < l->n; k++)
		json_array_append_new(ids, json_integer(l->jobs[k].id));
	return json_pack("{s:o}", "jobs", ids);
}

/* The kill has a connection of its own: it answers only when the jobs have ended. */
static struct client *start_kill(const struct connection *c, const struct job_list *jobs,
                                 const struct report *r)
{
	struct client *killer = NULL;
	json_t *body = ids_of(jobs);

	json_set_text(body, "by", "you");
	if (client_connect(&killer, &c->project, false, r) == ST_OK)
		client_send(killer, MESSAGE_KILL, body, r);
	else
		json_decref(body);
	return killer;
}

static enum status follow(struct connection *c, const struct invocation *i, struct board *b,
                          const struct job_list *jobs)
{
	int signals = open_signals();
	struct wish wish = { 0 };
	struct client *killer = NULL;
	bool ended = false, gone = false;
	enum status st = client_send(c->client, MESSAGE_WATCH, ids_of(jobs), &i->report);

	while (st == ST_OK && !wish.leave && !ended) {
		board_draw(b);
		st = client_listen(c->client, DRAW_MS, signals, board_put, b, &ended, &gone,
		                   &i->report);
		read_signals(signals, &wish);
		if (wish.kill && !killer)
			killer = start_kill(c, jobs, &i->report);
	}
	board_draw(b);
	if (st == ST_OK && gone && !board_all_over(b))
		st = report_error(
		        &i->report, ST_RESOURCE,
		        "the service went away; batten jobs starts it again and the jobs go on");
	if (wish.leave && !ended)
		st = ST_CANCELLED;
	client_close(killer);
	if (signals >= 0)
		close(signals);
	return st;
}

static void print_results(const struct job_list *l, const struct report *r)
{
	for (size_t k = 0; k < l->n; k++) {
		const struct Stats *s = &l->jobs[k];
		for (int o = 0; o < s->n_outputs; o++)
			puts(s->outputs[o].path);
		if (s->state != JOB_DONE)
			report_error(r, ST_INPUT, "job %lld %s: %s", (long long)s->id,
			             job_state_table[s->state].word,
			             s->reason ? s->reason : "see batten log");
	}
}

static int run_run(const struct invocation *i)
{
	struct connection c;
	struct job_list jobs = { 0 };
	struct board b;
	enum status st = submission_send(i, &c, &jobs);

	board_init(&b, i->color);
	for (size_t k = 0; k < jobs.n; k++)
		board_put(&b, &jobs.jobs[k]);
	if (st == ST_OK)
		st = follow(&c, i, &b, &jobs);
	int rc = status_exit(st);
	if (st == ST_OK) {
		rc = job_list_exit(&b.list);
		connection_bell(&c);
		if (i->json && job_list_print_json(&b.list))
			rc = 1;
		else if (!i->json)
			print_results(&b.list, &i->report);
	}
	board_finish(&b);
	job_list_finish(&jobs);
	connection_close(&c);
	return rc;
}

const struct command command_run = {
	.name = "run",
	.usage = "WORKER INPUT... [--PARAMETER VALUE]... [-o NAME]",
	.text = "submit jobs and follow them on a live board",
	.help = submission_help,
	.options = submission_options,
	.first_word = WORD_WORKER,
	.words = WORD_FILE,
	.takes_value = submission_takes_value,
	.run = run_run,
};
