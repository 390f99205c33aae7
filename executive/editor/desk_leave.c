/* desk_leave.c - the window is to be closed: what would be lost is asked about first. */
#include <stdlib.h>
#include <string.h>

#include "desk_inside.h"
#include "text.h"

static void ask_all(struct desk *d, enum message_type type)
{
	int64_t ids[PICKED_MAX];
	int n = 0;

	for (int i = 0; i < d->shelf.n && n < PICKED_MAX; i++)
		if (desk_job_can(&d->shelf.jobs[i], type))
			ids[n++] = d->shelf.jobs[i].id;
	if (n && d->ports.ask_jobs)
		d->ports.ask_jobs(d->ports.data, type, ids, n);
	if (type == MESSAGE_KILL) /* nobody will be there to hear of their end */
		desk_jobs_settle(d, ids, n);
}

static int count_unsaved(const struct desk *d, const char **name)
{
	int n = 0;

	for (int i = 0; i < world_count(d->world); i++) {
		const struct Ful *f = world_at(d->world, i);
		if (!f->saved) {
			*name = f->name;
			n++;
		}
	}
	return n;
}

static void leave(struct desk *d)
{
	/* what became of the jobs stands in the lines that started them */
	const char *const pairs[] = { "unsaved", "keep", "jobs", "leave", NULL };

	if (!strcmp(d->leaving_jobs, "suspend"))
		ask_all(d, MESSAGE_SUSPEND);
	if (!strcmp(d->leaving_jobs, "kill"))
		ask_all(d, MESSAGE_KILL);
	desk_journal(d, "V133", pairs);
	if (d->ports.close)
		d->ports.close(d->ports.data);
}

static void lose_answer(struct desk *d, char key)
{
	if (key == 'L')
		leave(d);
}

/* What is not saved is the session's: it must be on the disk before the window goes. */
static void try_to_leave(struct desk *d, const char *jobs)
{
	struct question q = { .answer = lose_answer,
		              .key = { 'L', 'N' },
		              .word = { "Lose it", "Stay" } };
	struct report_store store;
	const char *name;

	d->leaving_jobs = jobs;
	report_store_init(&store);
	if (!count_unsaved(d, &name) || world_keep_session(d->world, &store.report) == ST_OK) {
		leave(d);
		return;
	}
	q.title = strdup("Quit and lose what is not saved?");
	q.line[0] = text_print("The session cannot be kept: %s.", store.error);
	q.line[1] = strdup("Save it elsewhere (V177), or make room first.");
	desk_question(d, &q);
}

static void quit_answer(struct desk *d, char key)
{
	if (key != 'N')
		try_to_leave(d, key == 'S' ? "suspend" : key == 'K' ? "kill" : "leave");
}

/* What becomes of jobs that are left: some go on, some wait for the user. */
static char *left_text(const struct desk *d, int jobs)
{
	int waiting = 0;

	for (int i = 0; i < d->shelf.n; i++)
		waiting += desk_job_can(&d->shelf.jobs[i], MESSAGE_ACTIVATE);
	if (!waiting)
		return text_print("%d %s not ended. Without this window %s on.", jobs,
		                  jobs == 1 ? "job has" : "jobs have",
		                  jobs == 1 ? "it goes" : "they go");
	if (waiting == jobs)
		return text_print("%d %s not ended and %s until activated.", jobs,
		                  jobs == 1 ? "job has" : "jobs have",
		                  jobs == 1 ? "waits" : "wait");
	return text_print("%d jobs have not ended. Without this window %d %s on; %d %s until "
	                  "activated.",
	                  jobs, jobs - waiting, jobs - waiting == 1 ? "goes" : "go", waiting,
	                  waiting == 1 ? "waits" : "wait");
}

static bool any_can(const struct desk *d, enum message_type type)
{
	for (int i = 0; i < d->shelf.n; i++)
		if (desk_job_can(&d->shelf.jobs[i], type))
			return true;
	return false;
}

void desk_quit(struct desk *d)
{
	struct question q = { .answer = quit_answer };
	const char *name = "";
	int jobs = desk_unended(d), n = 0, lines = 0, b = 0;

	if (d->errand) {
		errand_stop(d->errand);
		desk_say(d, REPORT_INFO, "%s is being stopped; then quit again.",
		         errand_routine(d->errand)->code);
		return;
	}
	n = count_unsaved(d, &name);
	if (!jobs && !n) {
		try_to_leave(d, "leave");
		return;
	}
	q.title = strdup(jobs && n ? "Quit with unsaved geometry and unended jobs?"
	                 : n       ? "Quit with unsaved geometry?"
	                           : "Quit with unended jobs?");
	if (n == 1)
		q.line[lines++] = text_print("%s is not saved. The session keeps it for the next "
		                             "start; its file does not have it.",
		                             name);
	else if (n)
		q.line[lines++] = text_print("%d curves and surfaces are not saved. The session "
		                             "keeps them for the next start; their files do not "
		                             "have them.",
		                             n);
	if (jobs)
		q.line[lines++] = left_text(d, jobs);
	q.key[b] = 'L';
	q.word[b++] = !jobs                          ? "Leave"
	              : any_can(d, MESSAGE_ACTIVATE) ? "Leave them so"
	                                             : "Leave them running";
	if (any_can(d, MESSAGE_SUSPEND)) {
		q.key[b] = 'S';
		q.word[b++] = "Suspend them";
	}
	if (jobs) {
		q.key[b] = 'K';
		q.word[b++] = "Kill them";
	}
	q.key[b] = 'N';
	q.word[b++] = "Stay";
	desk_question(d, &q);
}
