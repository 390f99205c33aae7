/* desk_results.c - what becomes of jobs: news, the bell, results shown while they come and opened when
 * they are there. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "desk_inside.h"
#include "path.h"

/* Results by the end of their file's name: the leaf that opens them. */
static const struct {
	const char *suffix, *code;
} result_table[] = {
	{ ".map.exr", "V78" },  { ".shade.exr", "V70" }, { ".trace.exr", "V75" },
	{ ".isophote", "V89" }, { ".reflect", "V93" },   { ".contour", "V169" },
	{ ".base", "V175" },
};
enum { N_RESULTS = sizeof result_table / sizeof *result_table };

static int row_of_file(const char *path)
{
	for (int i = 0; i < N_RESULTS; i++)
		if (path_has_suffix(path, result_table[i].suffix))
			return i;
	return -1;
}

void desk_job_open(struct desk *d, const struct Stats *s)
{
	if (!s)
		return;
	for (int i = 0; i < s->n_outputs; i++) {
		int row = row_of_file(s->outputs[i].path);
		if (row < 0)
			continue;
		char *path = strdup(s->outputs[i].path); /* the record may go meanwhile */
		if (d->page == PAGE_JOBS)
			desk_set_page(d, PAGE_NONE);
		if (path)
			desk_run_code(d, result_table[row].code, "file", desk_near_path(d, path));
		free(path);
		return;
	}
	desk_say(d, REPORT_INFO, "Job %lld has no result that can be shown.", (long long)s->id);
}

/* ------------------------------------------------------------ results as they come */

static bool is_shown(const struct desk *d, int64_t id)
{
	for (int k = 0; k < world_overlays(d->world); k++)
		if (world_overlay(d->world, k)->job == id)
			return true;
	return false;
}

/* Tiles of those at work are drawn, what has ended is shown whole. While an errand has the world this
 * waits: desk_errand_over looks again. */
void desk_results(struct desk *d)
{
	if (d->errand)
		return;
	for (int i = 0; i < d->shelf.n; i++) {
		const struct Stats *s = &d->shelf.jobs[i];
		if (!is_shown(d, s->id))
			continue;
		if (job_state_table[s->state].over)
			routine_job_ended(d->world, s);
		desk_dirty(d, DESK_VIEW);
	}
	desk_world_changed(d);
}

/* ------------------------------------------------------------ news */

static void tell(struct desk *d, const struct Stats *s)
{
	const char *file = s->file_name ? path_file_name(s->file_name) : "";
	const char *out = s->n_outputs ? path_file_name(s->outputs[0].path) : "";

	switch (s->state) {
	case JOB_DONE:
		desk_say(d, REPORT_INFO, "Job %lld, %s of %s, is done: %s", (long long)s->id,
		         s->worker, file, out);
		break;
	case JOB_FAILED:
	case JOB_LOST:
		desk_say(d, REPORT_ERROR, "Job %lld, %s, %s: %s", (long long)s->id, s->worker,
		         job_state_table[s->state].word, s->reason ? s->reason : "");
		break;
	case JOB_KILLED:
		desk_say(d, REPORT_INFO, "Job %lld, %s, was killed.", (long long)s->id, s->worker);
		break;
	default:
		return;
	}
	struct message_line *m = &d->messages[d->n_messages - 1];
	m->done = s->state == JOB_DONE;
	snprintf(m->hint, sizeof m->hint, "%s",
	         s->state == JOB_DONE ? "O opens it" : "L shows its log");
	if (d->page != PAGE_JOBS)
		d->job_focus = d->job_log = s->id;
	if (d->ports.bell && !d->errand && world_sight(d->world)->bell)
		d->ports.bell(d->ports.data);
}

/* What jobs came to is said in the lines of the journal that started them, so that doing those again comes
 * to the same. A line is written when its routine returns: its job may be over by then. */
void desk_jobs_settle(struct desk *d, const int64_t *killed, int n_killed)
{
	struct job_end *ends = calloc((size_t)d->shelf.n + 1, sizeof *ends);
	struct report_store store;
	size_t n = 0;

	report_store_init(&store);
	for (int i = 0; ends && i < d->shelf.n; i++) {
		const struct Stats *s = &d->shelf.jobs[i];
		ends[n++] = (struct job_end){ s->id, job_state_table[s->state].over &&
			                                     s->state != JOB_DONE };
		for (int k = 0; k < n_killed; k++)
			ends[n - 1].nothing |= killed[k] == s->id;
	}
	if (ends && journal_settle(d->house.project, ends, n, &store.report) != ST_OK)
		desk_say(d, REPORT_WARNING, "%s", store.error);
	free(ends);
}

/* Both lists go by rising id. */
static void find_news(struct desk *d)
{
	bool ends = false;
	int at = d->n_seen - 1, grown = d->shelf.n - d->n_seen;

	if (d->shelf.n > d->seen_cap) {
		struct state_seen *more =
		        reallocarray(d->seen, (size_t)(2 * d->shelf.n), sizeof *more);
		if (!more)
			return;
		d->seen = more;
		d->seen_cap = 2 * d->shelf.n;
	}
	for (int i = d->shelf.n - 1; i >= 0 && grown >= 0; i--) {
		const struct Stats *s = &d->shelf.jobs[i];
		bool known = at >= 0 && d->seen[at].id == s->id;
		enum job_state was = known ? d->seen[at].state : N_JOB_STATES;
		at -= known;
		d->seen[i] = (struct state_seen){ s->id, s->state };
		ends |= was != s->state &&
		        (job_state_table[s->state].over || (known && job_state_table[was].over));
		if (was != s->state && d->caught_up)
			tell(d, s);
	}
	d->n_seen = d->shelf.n;
	if (ends)
		desk_jobs_settle(d, NULL, 0);
	d->caught_up |= d->link == LINK_UP;
}

void desk_jobs_changed(struct desk *d, enum link_state state, const char *reason)
{
	if (d->link != state)
		desk_dirty(d, desk_bit(PART_OVER));
	d->link = state;
	snprintf(d->link_reason, sizeof d->link_reason, "%s", reason);
	find_news(d);
	desk_dirty(d, desk_bit(PART_TOP) | (d->page == PAGE_JOBS ? desk_bit(PART_PAGE) : 0));
	if (d->in_world)
		desk_dirty(d, desk_bit(PART_MENU));
	desk_results(d);
}

void desk_answer(struct desk *d, const struct link_answer *a)
{
	static const struct {
		enum message_type type;
		const char *word;
	} word[] = { { MESSAGE_SUSPEND, "suspended" }, { MESSAGE_ACTIVATE, "activated" },
		     { MESSAGE_KILL, "killed" },       { MESSAGE_RELEASE, "released" },
		     { MESSAGE_HOLD, "held" },         { MESSAGE_RETRY, "queued again" } };

	if (a->type == MESSAGE_LOG) {
		if (a->job == d->job_log) {
			free(d->log_text);
			d->log_text = strdup(a->text ? a->text : "");
			desk_dirty(d, desk_bit(PART_PAGE));
		}
		return;
	}
	if (a->status != ST_OK) {
		desk_say(d, REPORT_ERROR, "%s", a->text ? a->text : status_text(a->status));
		return;
	}
	for (size_t i = 0; i < sizeof word / sizeof *word; i++)
		if (word[i].type == a->type && a->type != MESSAGE_KILL) {
			if (a->n == 1)
				desk_say(d, REPORT_INFO, "Job %lld is %s.", (long long)a->job,
				         word[i].word);
			else
				desk_say(d, REPORT_INFO, "%d jobs are %s.", a->n, word[i].word);
		}
}
