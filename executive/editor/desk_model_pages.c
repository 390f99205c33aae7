/* desk_model_pages.c - the models of the pages: jobs, search, help, lists. */
#include <stdlib.h>
#include <string.h>

#include "desk_inside.h"
#include "parallel.h"
#include "settings.h"

/* ------------------------------------------------------------ jobs */

static void log_lines(struct desk *d, struct scraps *s)
{
	const char *p = d->log_text ? d->log_text : "";
	size_t n = 0;

	for (const char *q = p; *q; q++)
		n += *q == '\n' || !q[1];
	const char **lines = scraps_array(s, n, sizeof *lines);
	if (!lines)
		return;
	for (size_t i = 0; i < n; i++) {
		size_t length = strcspn(p, "\n");
		lines[i] = scraps_print(s, "%.*s", (int)length, p);
		p += length + (p[length] == '\n');
	}
	d->jobs.log = lines;
	d->jobs.n_log = (int)n;
}

/* The reason of the job in focus stands whole above its log. */
static const char *log_title(struct desk *d, struct scraps *s)
{
	const struct Stats *j = job_shelf_find(&d->shelf, d->job_log);

	if (!j)
		return NULL;
	return scraps_print(s, "Log of job %lld, %s%s%s", (long long)j->id,
	                    j->worker ? j->worker : "", j->reason ? ": " : "",
	                    j->reason ? j->reason : "");
}

static void count_tabs(struct desk *d)
{
	int tab = d->job_tab;

	for (d->job_tab = 0; d->job_tab < 4; d->job_tab++)
		d->jobs.count[d->job_tab] = desk_jobs_count(d);
	d->job_tab = tab;
}

static int count_in_slots(const struct desk *d)
{
	int n = 0;

	for (int i = 0; i < d->shelf.n; i++) {
		const enum job_state state = d->shelf.jobs[i].state;
		n += state == JOB_STARTING || state == JOB_RUNNING || state == JOB_ENDING;
	}
	return n;
}

/* As many as the project's settings allow. */
static int slots_of(const struct settings *s)
{
	const int jobs = (int)settings_number(s, SETTING_JOBS), processors = parallel_processors();

	return jobs > 0 ? jobs : processors > 4 ? processors : 4;
}

static const char *slots_text(struct desk *d, struct scraps *s)
{
	struct settings all = { 0 };

	if (!d->slots && settings_read(&all, d->house.project, &report_none) == ST_OK)
		d->slots = slots_of(&all);
	settings_finish(&all);
	if (d->slots <= 0)
		return scraps_print(s, "%d running", count_in_slots(d));
	return scraps_print(s, "%d of %d job slots in use", count_in_slots(d), d->slots);
}

void desk_fill_jobs(struct desk *d)
{
	static const enum message_type type[5] = { MESSAGE_SUSPEND, MESSAGE_ACTIVATE, MESSAGE_KILL,
		                                   MESSAGE_RETRY, MESSAGE_RESULT };
	struct scraps *s = &d->scraps[PART_PAGE];
	struct jobs_model *m = &d->jobs;
	int max = d->shelf.n;

	scraps_reset(s);
	*m = (struct jobs_model){
		.focus = -1, .tab = d->job_tab, .scroll = d->job_scroll, .now = d->now
	};
	const struct Stats **rows = scraps_array(s, (size_t)max, sizeof *rows);
	bool *picked = scraps_array(s, (size_t)max, sizeof *picked);
	if (!rows || !picked)
		return;
	m->jobs = rows;
	m->picked = picked;
	m->n = desk_jobs_rows(d, rows, max);
	for (int i = 0; i < m->n; i++) {
		picked[i] = desk_picked(d, rows[i]->id);
		if (rows[i]->id == d->job_focus)
			m->focus = i;
		for (int k = 0; k < 5; k++)
			m->can[k] |= (picked[i] || (!d->n_picked && m->focus == i)) &&
			             desk_job_can(rows[i], type[k]);
	}
	count_tabs(d);
	m->slots = slots_text(d, s);
	m->log_title = log_title(d, s);
	log_lines(d, s);
}

/* ------------------------------------------------------------ search */

static void fill_result(struct desk *d, struct scraps *s, struct search_result *r,
                        const struct Menu_Entry *e)
{
	const struct routine *t = desk_routine(e);
	const char *why = t ? routine_greyed(t, d->world) : NULL;

	*r = (struct search_result){ e->name, desk_path_text(d, s, e),
		                     why && !desk_leaf_is_own(e->index) ? why
		                     : t                                ? routine_kind_word[t->kind]
		                                                        : "menu",
		                     e->index, why && !desk_leaf_is_own(e->index) };
}

void desk_fill_search(struct desk *d)
{
	struct scraps *s = &d->scraps[PART_PAGE];
	struct search_model *m = &d->results;

	scraps_reset(s);
	*m = (struct search_model){ .typed = d->search.s,
		                    .caret = d->search.caret,
		                    .found = d->found_near ? 0 : d->n_found,
		                    .chosen = d->found_chosen };
	for (const struct routine *t = routine_table; t->code; t++)
		m->all++;
	for (int i = 0; i < d->n_found && i < RESULTS_MAX; i++, m->n++)
		fill_result(d, s, &m->results[i], d->found[i]);
}

/* ------------------------------------------------------------ help */

static const char *help_words(struct desk *d, struct scraps *s, const struct help_text *t)
{
	char *page = help_page(d->house.help, t);
	const char *out = scraps_print(s, "%s", page ? page : "");

	free(page);
	return out;
}

void desk_fill_help(struct desk *d)
{
	struct scraps *s = &d->scraps[PART_PAGE];
	const struct help_text *t = help_find(d->house.help, d->help_code);
	const struct Menu_Entry *e = desk_leaf(d, d->help_code);
	const struct routine *r = desk_routine(e);

	scraps_reset(s);
	d->help = (struct help_model){ .code = d->help_code,
		                       .title = t ? t->title : "",
		                       .kind = r ? routine_kind_word[r->kind] : "menu",
		                       .path = e ? desk_path_text(d, s, e) : "",
		                       .text = t ? help_words(d, s, t) : "",
		                       .scroll = d->help_scroll };
}

/* ------------------------------------------------------------ lists */

static void fill_question(struct desk *d, struct scraps *s)
{
	const struct question *q = &d->question;
	const char **lines = scraps_array(s, 8, sizeof *lines);
	const char **buttons = scraps_array(s, BUTTONS_MAX, sizeof *buttons);

	if (!lines || !buttons)
		return;
	d->list.title = q->title ? q->title : "";
	while (d->list.n < 8 && q->line[d->list.n]) {
		lines[d->list.n] = q->line[d->list.n];
		d->list.n++;
	}
	while (d->list.n_buttons < BUTTONS_MAX && q->word[d->list.n_buttons]) {
		int b = d->list.n_buttons++;
		buttons[b] = scraps_print(s, "%s  %c", q->word[b], q->key[b]);
	}
	d->list.lines = lines;
	d->list.buttons = buttons;
}

void desk_fill_list(struct desk *d)
{
	struct scraps *s = &d->scraps[PART_PAGE];

	scraps_reset(s);
	d->list = (struct list_model){ .title = "Messages", .scroll = d->page_scroll };
	if (d->page == PAGE_QUESTION) {
		fill_question(d, s);
		return;
	}
	const char **lines = scraps_array(s, (size_t)d->n_messages, sizeof *lines);
	for (int i = 0; lines && i < d->n_messages; i++)
		lines[i] = d->messages[d->n_messages - 1 - i].text;
	d->list.lines = lines;
	d->list.n = lines ? d->n_messages : 0;
}
