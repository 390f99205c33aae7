/* desk_jobs.c - the list of jobs: picking, and what is done to those picked. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "desk_inside.h"
#include "path.h"

static void changed(struct desk *d)
{
	desk_dirty(d, desk_bit(PART_PAGE) | desk_bit(PART_FOOT) | desk_bit(PART_MENU) |
	                      desk_bit(PART_MOUSE));
}

/* ------------------------------------------------------------ which jobs */

enum tab { TAB_ALL, TAB_ACTIVE, TAB_WAITING, TAB_ENDED, N_TABS };

static enum tab tab_of(const struct Stats *s)
{
	if (job_state_table[s->state].over)
		return TAB_ENDED;
	return s->state == JOB_QUEUED || s->state == JOB_HELD ? TAB_WAITING : TAB_ACTIVE;
}

int desk_jobs_rows(struct desk *d, const struct Stats **out, int max)
{
	int n = 0;

	for (int i = d->shelf.n - 1; i >= 0; i--) {
		const struct Stats *s = &d->shelf.jobs[i];
		if (d->job_tab != TAB_ALL && (int)tab_of(s) != d->job_tab)
			continue;
		if (n < max)
			out[n] = s;
		n++;
	}
	return n < max ? n : max;
}

int desk_jobs_count(const struct desk *d)
{
	int n = 0;

	for (int i = 0; i < d->shelf.n; i++)
		n += d->job_tab == TAB_ALL || (int)tab_of(&d->shelf.jobs[i]) == d->job_tab;
	return n;
}

int desk_unended(const struct desk *d)
{
	int n = 0;

	for (int i = 0; i < d->shelf.n; i++)
		n += !job_state_table[d->shelf.jobs[i].state].over;
	return n;
}

bool desk_job_can(const struct Stats *s, enum message_type type)
{
	bool over = job_state_table[s->state].over;

	switch ((int)type) {
	case MESSAGE_SUSPEND:
		return s->state == JOB_RUNNING || s->state == JOB_STARTING;
	case MESSAGE_ACTIVATE:
		return s->state == JOB_SUSPENDED || s->state == JOB_HELD;
	case MESSAGE_KILL:
		return !over;
	case MESSAGE_RETRY:
		return s->state == JOB_FAILED || s->state == JOB_KILLED || s->state == JOB_LOST;
	case MESSAGE_LOG:
		return true;
	default:
		return s->state == JOB_DONE && s->n_outputs > 0; /* open */
	}
}

/* ------------------------------------------------------------ picking */

bool desk_picked(const struct desk *d, int64_t id)
{
	for (int i = 0; i < d->n_picked; i++)
		if (d->picked[i] == id)
			return true;
	return false;
}

static void pick(struct desk *d, int64_t id, bool on)
{
	for (int i = 0; i < d->n_picked; i++)
		if (d->picked[i] == id) {
			if (!on)
				d->picked[i] = d->picked[--d->n_picked];
			return;
		}
	if (on && d->n_picked < PICKED_MAX)
		d->picked[d->n_picked++] = id;
}

static void read_log(struct desk *d, int64_t id)
{
	d->job_log = id;
	free(d->log_text);
	d->log_text = NULL;
	if (d->ports.ask_jobs)
		d->ports.ask_jobs(d->ports.data, MESSAGE_LOG, &id, 1);
}

static void focus(struct desk *d, int64_t id)
{
	if (d->job_focus != id)
		read_log(d, id);
	d->job_focus = id;
	changed(d);
}

static void reveal(struct desk *d, int at)
{
	if (at < d->job_scroll)
		d->job_scroll = at;
	else if (d->job_rows > 0 && at >= d->job_scroll + d->job_rows)
		d->job_scroll = at - d->job_rows + 1;
}

static void step_focus(struct desk *d, int step, bool picking)
{
	int n = d->shelf.n, at = -1;
	const struct Stats **row = calloc((size_t)n + 1, sizeof *row);

	n = row ? desk_jobs_rows(d, row, n) : 0;
	for (int i = 0; i < n; i++)
		if (row[i]->id == d->job_focus)
			at = i;
	if (n) {
		at = at < 0 ? 0 : at + step < 0 ? 0 : at + step >= n ? n - 1 : at + step;
		focus(d, row[at]->id);
		if (picking)
			pick(d, row[at]->id, true);
		reveal(d, at);
	}
	free(row);
}

void desk_jobs_begin(struct desk *d)
{
	if (d->page == PAGE_JOBS)
		return;
	desk_set_page(d, PAGE_JOBS);
	d->job_scroll = 0;
	d->job_focus = 0;
	step_focus(d, 0, false);
}

void desk_job_show(struct desk *d, int64_t id)
{
	if (!job_shelf_find(&d->shelf, id) || d->page == PAGE_QUESTION)
		return;
	if (d->page != PAGE_JOBS)
		desk_set_page(d, PAGE_JOBS);
	d->job_tab = TAB_ALL;
	d->n_picked = 0;
	pick(d, id, true);
	focus(d, id);
	step_focus(d, 0, false);
}

static void pick_to(struct desk *d, int64_t id)
{
	int n = d->shelf.n;
	bool between = false;
	const struct Stats **row = calloc((size_t)n + 1, sizeof *row);

	n = row ? desk_jobs_rows(d, row, n) : 0;
	for (int i = 0; i < n; i++) {
		bool end = row[i]->id == id || row[i]->id == d->job_focus;
		if (between || end)
			pick(d, row[i]->id, true);
		between ^= end && id != d->job_focus;
	}
	free(row);
}

void desk_jobs_click(struct desk *d, const struct hit *h, unsigned mods)
{
	static const enum message_type button[] = { MESSAGE_SUSPEND, MESSAGE_ACTIVATE, MESSAGE_KILL,
		                                    MESSAGE_RETRY };

	const struct hit at =
	        *h; /* hits and rows are of the last painting, records come meanwhile */
	h = &at;
	desk_fill_jobs(d);
	if (h->kind == HIT_TAB) {
		d->job_tab = h->index;
		d->job_scroll = 0;
		changed(d);
		return;
	}
	if (h->kind == HIT_BUTTON) {
		if (h->index >= 0 && h->index < 4)
			desk_jobs_do(d, button[h->index]);
		else if (d->job_focus)
			desk_job_open(d, job_shelf_find(&d->shelf, d->job_focus));
		return;
	}
	if (h->kind == HIT_JOB_BOX && h->index == -1) { /* all rows of the tab, or none */
		bool on = d->n_picked == 0;
		d->n_picked = 0;
		for (int i = 0; on && i < d->jobs.n; i++)
			pick(d, d->jobs.jobs[i]->id, true);
		changed(d);
		return;
	}
	if (h->index < 0 || h->index >= d->jobs.n)
		return;
	int64_t id = d->jobs.jobs[h->index]->id;
	if (mods & MOD_SHIFT) {
		pick_to(d, id);
	} else if (h->kind == HIT_JOB_BOX || (mods & MOD_CTRL)) {
		pick(d, id, !desk_picked(d, id));
	} else {
		d->n_picked = 0;
		pick(d, id, true);
	}
	focus(d, id);
}

/* ------------------------------------------------------------ doing */

static void send(struct desk *d, enum message_type type, const int64_t *ids, int n)
{
	if (d->ports.ask_jobs)
		d->ports.ask_jobs(d->ports.data, type, ids, n);
}

/* So that the journal has what the jobs were told; in the routine both kinds of waiting go on. */
static void write_down(struct desk *d, enum message_type type, const int64_t *ids, int n)
{
	const char *code = type == MESSAGE_SUSPEND    ? "V163"
	                   : type == MESSAGE_ACTIVATE ? "V164"
	                   : type == MESSAGE_KILL     ? "V165"
	                                              : NULL;
	struct text list = { 0 };

	for (int i = 0; i < n; i++)
		text_addf(&list, "%s%lld", i ? "," : "", (long long)ids[i]);
	const char *const pairs[] = { "jobs", list.s, NULL };
	if (code && n && !list.failed)
		desk_journal(d, code, pairs);
	text_finish(&list);
}

static int those_that_can(struct desk *d, enum message_type type, int64_t ids[PICKED_MAX])
{
	int n = 0;

	if (!d->n_picked && d->job_focus)
		pick(d, d->job_focus, true);
	for (int i = 0; i < d->n_picked; i++) {
		const struct Stats *s = job_shelf_find(&d->shelf, d->picked[i]);
		if (s && desk_job_can(s, type))
			ids[n++] = s->id;
	}
	return n;
}

static void kill_answer(struct desk *d, char key)
{
	int64_t ids[PICKED_MAX];
	int n = key == 'Y' ? those_that_can(d, MESSAGE_KILL, ids) : 0;

	if (n) {
		write_down(d, MESSAGE_KILL, ids, n);
		send(d, MESSAGE_KILL, ids, n);
	}
}

static void ask_kill(struct desk *d, const int64_t *ids, int n)
{
	struct question q = { .in_prompt = true,
		              .answer = kill_answer,
		              .key = { 'Y', 'N' },
		              .word = { "kill", "keep" } };
	struct text names = { 0 };

	for (int i = 0; i < n && i < 6; i++)
		text_addf(&names, "%s%lld",
		          !i           ? ""
		          : i == n - 1 ? " and "
		                       : ", ",
		          (long long)ids[i]);
	if (n > 6)
		text_addf(&names, " and %d more", n - 6);
	char *list = text_take(&names);
	q.title = n == 1 ? text_print("Kill job %s?", list ? list : "")
	                 : text_print("Kill %d jobs, %s?", n, list ? list : "");
	q.line[0] = strdup(n == 1 ? "It keeps its part file." : "They keep their part files.");
	free(list);
	desk_question(d, &q);
}

void desk_jobs_do(struct desk *d, enum message_type type)
{
	static const struct {
		enum message_type type;
		const char *word;
	} word[] = { { MESSAGE_SUSPEND, "suspended" },
		     { MESSAGE_ACTIVATE, "activated" },
		     { MESSAGE_KILL, "killed" },
		     { MESSAGE_RETRY, "retried" } };
	int64_t ids[PICKED_MAX], held[PICKED_MAX];
	int n = those_that_can(d, type, ids), n_held = 0, k = 0;

	while (word[k].type != type)
		k++;
	if (!n) {
		desk_say(d, REPORT_INFO,
		         d->n_picked ? "None of the jobs picked can be %s."
		                     : "Pick jobs that are to be %s.",
		         word[k].word);
		return;
	}
	if (type == MESSAGE_KILL) {
		ask_kill(d, ids, n);
		return;
	}
	write_down(d, type, ids, n);
	if (type == MESSAGE_ACTIVATE) { /* one key lets go on whatever we stopped */
		int rest = 0;
		for (int i = 0; i < n; i++)
			if (job_shelf_find(&d->shelf, ids[i])->state == JOB_HELD)
				held[n_held++] = ids[i];
			else
				ids[rest++] = ids[i];
		n = rest;
	}
	if (n)
		send(d, type, ids, n);
	if (n_held)
		send(d, MESSAGE_RELEASE, held, n_held);
}

/* ------------------------------------------------------------ keys */

bool desk_jobs_text(struct desk *d, uint32_t c)
{
	switch (c) {
	case 's':
	case 'S':
		desk_jobs_do(d, MESSAGE_SUSPEND);
		return true;
	case 'a':
	case 'A':
		desk_jobs_do(d, MESSAGE_ACTIVATE);
		return true;
	case 'k':
	case 'K':
		desk_jobs_do(d, MESSAGE_KILL);
		return true;
	case 'r':
	case 'R':
		desk_jobs_do(d, MESSAGE_RETRY);
		return true;
	case 'o':
	case 'O':
		desk_job_open(d, job_shelf_find(&d->shelf, d->job_focus));
		return true;
	case 'l':
	case 'L':
		if (d->job_focus)
			read_log(d, d->job_focus);
		return true;
	case ' ':
		if (d->job_focus)
			pick(d, d->job_focus, !desk_picked(d, d->job_focus));
		changed(d);
		return true;
	default:
		return false;
	}
}

bool desk_jobs_key(struct desk *d, enum desk_key key, unsigned mods)
{
	const struct Stats *s = job_shelf_find(&d->shelf, d->job_focus);

	switch ((int)key) {
	case KEY_UP:
		step_focus(d, -1, mods & MOD_SHIFT);
		return true;
	case KEY_DOWN:
		step_focus(d, 1, mods & MOD_SHIFT);
		return true;
	case KEY_PAGE_UP:
		step_focus(d, -10, false);
		return true;
	case KEY_PAGE_DOWN:
		step_focus(d, 10, false);
		return true;
	case KEY_HOME:
		step_focus(d, -d->shelf.n, false);
		return true;
	case KEY_END:
		step_focus(d, d->shelf.n, false);
		return true;
	case KEY_LEFT:
	case KEY_RIGHT:
		d->job_tab = (d->job_tab + (key == KEY_LEFT ? N_TABS - 1 : 1)) % N_TABS;
		changed(d);
		return true;
	case KEY_ENTER:
		if (s)
			desk_job_open(d, s);
		return true;
	case KEY_CTRL_A:
		for (int i = 0; i < d->shelf.n; i++)
			pick(d, d->shelf.jobs[i].id, true);
		changed(d);
		return true;
	default:
		return false;
	}
}
