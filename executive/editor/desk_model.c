/* desk_model.c - the models of the frame: menu with form, foot, top bar. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "desk_inside.h"
#include "path.h"

/* ------------------------------------------------------------ menu */

/* What stands at the right of a row. */
static const char *row_state(struct desk *d, struct scraps *s, const struct routine *t,
                             const char *why)
{
	char state[48] = "";
	int can = 0;
	enum message_type type = !strcmp(t->code, "V163")   ? MESSAGE_SUSPEND
	                         : !strcmp(t->code, "V164") ? MESSAGE_ACTIVATE
	                         : !strcmp(t->code, "V165") ? MESSAGE_KILL
	                                                    : MESSAGE_END;

	if (type != MESSAGE_END) {
		for (int i = 0; i < d->shelf.n; i++)
			can += desk_job_can(&d->shelf.jobs[i], type);
		return scraps_print(s, "%d can", can);
	}
	if (!strcmp(t->code, "V162"))
		return d->page == PAGE_JOBS ? "shown" : scraps_print(s, "%d", d->shelf.n);
	if (why) /* the names of what is not made yet are long */
		return t->run ? scraps_print(s, "%s", why) : "later";
	routine_state(t, d->world, state);
	return *state ? scraps_print(s, "%s", state) : t->kind == ROUTINE_JOB ? "job" : "";
}

static void fill_row(struct desk *d, struct scraps *s, struct menu_row *row, int k,
                     const struct Menu_Entry *e)
{
	const struct routine *t = desk_routine(e);

	*row = (struct menu_row){
		.key = desk_row_key(k), .name = e->name, .state = "", .is_menu = !menu_is_leaf(e)
	};
	row->is_menu |= !strcmp(e->index, "V34") || !strcmp(e->index, "V114"); /* of another file */
	if (row->is_menu)
		return;
	const char *why = t ? routine_greyed(t, d->world) : "no such routine";
	row->greyed = why && !desk_leaf_is_own(e->index);
	row->state = t ? row_state(d, s, t, row->greyed ? why : NULL) : why;
	row->chosen = (d->ask.routine && d->ask.entry == e) ||
	              (d->page == PAGE_JOBS && !strcmp(e->index, "V162")) ||
	              (d->tool == TOOL_VIEW && desk_leaf_tool(e->index) == TOOL_VIEW) ||
	              !strcmp(row->state, "shown");
}

/* Parameters of workers come by their names. */
static const char *label_of(struct scraps *s, const struct argument_row *row)
{
	const char *text = row->prompt ? row->prompt : row->name;

	if (*text < 'a' || *text > 'z')
		return text;
	return scraps_print(s, "%c%s", *text - 'a' + 'A', text + 1);
}

/* "file" is the unit of the file of what it is done to. */
static const char *unit_of(const struct desk *d, const struct argument_row *row)
{
	if (!row->unit || strcmp(row->unit, "file") || d->errand)
		return row->unit;
	const struct Ful *f = world_selected(d->world);
	return f && f->unit ? f->unit : "";
}

static void fill_field(struct desk *d, struct form_field *f, int k)
{
	const struct ask *a = &d->ask;
	const struct argument_row *row = &a->rows[k];

	*f = (struct form_field){ .label = label_of(&d->scraps[PART_MENU], row),
		                  .value = a->field[k].s,
		                  .unit = unit_of(d, row),
		                  .error = a->error[k],
		                  .kind = desk_form_kind(row),
		                  .choices = row->choices,
		                  .empty = row->optional ? "auto" : NULL,
		                  .focused = k == a->focus,
		                  .caret = a->field[k].caret };
}

/* "MAIN › INTERROGATION" without the menu's own name, whose title stands below. */
static const char *crumbs(struct desk *d, struct scraps *s)
{
	const char *out = "";

	for (int i = 0; i + 1 < d->depth; i++)
		out = scraps_print(s, "%s%s%s", out, i ? " › " : "",
		                   desk_short_name(d, d->path[i]));
	return out;
}

static const char *main_word(const struct routine *t)
{
	static const char *const word[] = { [ROUTINE_SETTING] = "Set",
		                            [ROUTINE_SHOW] = "Show",
		                            [ROUTINE_EDIT] = "Do it",
		                            [ROUTINE_JOB] = "Start",
		                            [ROUTINE_MENU] = "Go" };

	return word[t->kind];
}

static int count_shown(const struct desk *d)
{
	int n = 0;

	for (int i = 0; i < world_count(d->world); i++) {
		const struct Ful *f = world_at(d->world, i);
		n += ful_is_surface(f) && f->display.on;
	}
	return n;
}

/* With what it is done to: the current thing, or, of a job that sees the whole scene, how many surfaces. */
static const char *form_title(const struct desk *d, struct scraps *s)
{
	const struct routine *t = d->ask.routine;
	const char *name = d->ask.entry ? d->ask.entry->name : "";
	const char *need = t->needs ? t->needs : "";
	const int which = desk_ask_find(d, "surfaces");
	const bool scene = which >= 0 ? !strcmp(d->ask.field[which].s, "shown")
	                              : t->worker && strcmp(t->worker, "curvature");
	const struct Ful *f = NULL;

	if (scene && count_shown(d) > 1)
		return scraps_print(s, "%s of %d surfaces", name, count_shown(d));
	if (d->errand)
		return name;
	if (!strcmp(need, "surface") || strstr(need, "curve"))
		f = world_current(d->world, strstr(need, "curve") != NULL);
	return f && desk_ask_find(d, "curves") < 0 && desk_ask_find(d, "curve") < 0 &&
	                       desk_ask_find(d, "surface") < 0
	               ? scraps_print(s, "%s of %s", name, f->name)
	               : name;
}

void desk_fill_menu(struct desk *d)
{
	const struct Menu_Entry *entry[ENTRIES_MAX], *menu = desk_shown_menu(d);
	struct scraps *s = &d->scraps[PART_MENU];
	int n = desk_entries(d, entry);

	scraps_reset(s);
	struct menu_row *rows = scraps_array(s, (size_t)n, sizeof *rows);
	for (int i = 0; rows && i < n; i++)
		fill_row(d, s, &rows[i], i, entry[i]);
	d->menu = (struct menu_model){ .crumbs = crumbs(d, s),
		                       .title = menu ? menu->title : "",
		                       .code = menu ? menu->index : "",
		                       .rows = rows,
		                       .n_rows = rows ? n : 0,
		                       .world_open = d->in_world };
	if (!d->ask.routine)
		return;
	struct form_field *fields = scraps_array(s, (size_t)d->ask.n, sizeof *fields);
	for (int i = 0; fields && i < d->ask.n; i++)
		fill_field(d, &fields[i], i);
	d->menu.form_title = form_title(d, s);
	d->menu.form_code = d->ask.routine->code;
	d->menu.fields = fields;
	d->menu.n_fields = fields ? d->ask.n : 0;
	d->menu.scroll = d->ask.scroll;
	d->menu.main_button = main_word(d->ask.routine);
	bool live = d->tool == TOOL_COLOR || d->tool == TOOL_LIGHT;
	d->menu.other_button = live ? "Put back" : "Defaults";
	d->menu.other_key = live ? "Esc" : desk_ask_textual(d) ? "Ctrl R" : "R";
}

/* ------------------------------------------------------------ foot */

static void hint(struct foot_model *m, const char *key, const char *word)
{
	for (int i = 0; i < 4; i++)
		if (!m->hints[i].key) {
			m->hints[i].key = key;
			m->hints[i].word = word;
			return;
		}
}

/* "(0 to 90°)" in words. */
static const char *range_of(const struct desk *d, struct scraps *s, const struct argument_row *row)
{
	const char *unit = row->unit ? unit_of(d, row) : "", *blank = *unit ? " " : "";

	if ((row->type == ARGUMENT_NUMBER || row->type == ARGUMENT_INTEGER) && row->min <= row->max)
		return fabs(row->max) < 1e9
		               ? scraps_print(s, "%g to %g%s%s", row->min, row->max, blank, unit)
		               : scraps_print(s, "%g or more%s%s", row->min, blank, unit);
	if (row->type == ARGUMENT_CHOICE && row->choices)
		return row->choices;
	return unit;
}

static void foot_of_ask(struct desk *d, struct foot_model *m, struct scraps *s)
{
	const struct ask *a = &d->ask;
	const struct argument_row *row = &a->rows[a->focus];
	size_t n = json_array_size(a->candidates);

	m->prompt = label_of(s, row);
	m->typed = a->field[a->focus].s;
	m->caret = a->field[a->focus].caret;
	m->caret_on = desk_ask_textual(d);
	m->range = range_of(d, s, row);
	if (!a->field[a->focus].n && row->def)
		m->rest = row->def;
	n = n > CANDIDATES_MAX ? CANDIDATES_MAX : n;
	const char **list = scraps_array(s, n, sizeof *list);
	const char **notes = scraps_array(s, n, sizeof *notes);
	for (size_t i = 0; list && notes && i < n; i++) {
		list[i] =
		        scraps_print(s, "%s", json_string_value(json_array_get(a->candidates, i)));
		notes[i] = "";
	}
	if (list && notes && n) {
		m->candidates = list;
		m->candidate_notes = notes;
		m->n_candidates = (int)n;
		m->candidate = a->candidate;
		const char *best = list[a->candidate < 0 ? 0 : a->candidate];
		if (a->field[a->focus].n && !strncmp(best, m->typed, strlen(m->typed)))
			m->rest = best + strlen(m->typed);
		hint(m, "Tab",
		     a->field[a->focus].n || a->candidate >= 0 ? "complete" : "next field");
	} else if (a->n > 1) {
		hint(m, "Tab", "next field");
	}
	hint(m, "Enter", "accept");
	if (d->tool == TOOL_POINTS)
		hint(m, "Shift", "drags the weight");
	hint(m, "Esc", "back");
}

static void foot_idle(struct desk *d, struct foot_model *m, struct scraps *s)
{
	const struct Menu_Entry *entry[ENTRIES_MAX];
	int n = desk_entries(d, entry);

	m->prompt = d->tool == TOOL_VIEW ? "Turn the view" : "Choose";
	m->rest = d->tool == TOOL_VIEW ? "arrows turn, F fits, Ctrl 1 to 6 are the sides"
	                               : scraps_print(s, "1 – %c, or / to find a routine",
	                                              desk_row_key(n > 0 ? n - 1 : 0));
	if (!d->errand && world_undo_name(d->world))
		hint(m, "Z", "undo");
	if (d->depth > 1 || d->in_world || d->tool != TOOL_NONE)
		hint(m, "Esc", "back");
	hint(m, "?", "keys");
}

static void foot_of_page(struct desk *d, struct foot_model *m, struct scraps *s)
{
	switch (d->page) {
	case PAGE_JOBS:
		m->prompt = "Jobs";
		m->rest = "arrows and Space pick";
		hint(m, "S", "suspend");
		hint(m, "A", "activate");
		hint(m, "K", "kill");
		break;
	case PAGE_SEARCH:
		m->prompt = "Find";
		m->typed = d->search.s;
		m->caret = d->search.caret;
		hint(m, "Enter", "run");
		break;
	case PAGE_QUESTION:
		m->prompt = d->question.title;
		if (d->question.in_prompt && d->question.line[0])
			m->typed = scraps_print(s, "%s", d->question.line[0]);
		m->rest = "";
		for (int i = 0; i < BUTTONS_MAX && d->question.word[i]; i++)
			hint(m, scraps_print(s, "%c", d->question.key[i]), d->question.word[i]);
		return;
	default:
		m->prompt = d->page == PAGE_HELP   ? "Help"
		            : d->page == PAGE_KEYS ? "Keys"
		                                   : "Messages";
		m->rest = "arrows scroll";
		break;
	}
	if (d->page == PAGE_HELP)
		hint(m, "Tab", "links");
	hint(m, "Esc", "close");
}

static void foot_of_errand(struct desk *d, struct foot_model *m, struct scraps *s)
{
	char what[128];
	double fraction = errand_progress(d->errand, what);

	m->prompt = *what ? scraps_print(s, "%s", what)
	                  : scraps_print(s, "%s", errand_routine(d->errand)->code);
	if (isfinite(fraction))
		m->rest = scraps_print(s, "%.0f %%", 100 * fraction);
	hint(m, "Esc", "stop");
}

void desk_fill_foot(struct desk *d)
{
	struct scraps *s = &d->scraps[PART_FOOT];
	struct foot_model *m = &d->foot;

	scraps_reset(s);
	*m = (struct foot_model){ .message = "",
		                  .message_hint = "",
		                  .prompt = "",
		                  .typed = "",
		                  .rest = "",
		                  .range = "",
		                  .candidate = -1 };
	if (d->n_messages && !d->messages[d->n_messages - 1].past) {
		const struct message_line *last = &d->messages[d->n_messages - 1];
		m->level = last->level;
		m->done = last->done;
		m->message = last->text;
		m->message_hint = last->hint;
	}
	if (d->errand)
		foot_of_errand(d, m, s);
	else if (d->page != PAGE_NONE)
		foot_of_page(d, m, s);
	else if (d->ask.routine)
		foot_of_ask(d, m, s);
	else
		foot_idle(d, m, s);
}

/* ------------------------------------------------------------ top */

static void chip_note(const struct Stats *s, char out[96])
{
	double f = stats_fraction(s);

	if (s->state == JOB_SUSPENDED && isfinite(f))
		snprintf(out, 96, "%.0f %%", 100 * f);
	else if (s->state == JOB_RUNNING && isfinite(s->eta_s))
		desk_duration(s->eta_s, out);
	else if (s->state == JOB_DONE && isfinite(s->wall_s)) {
		char time[96];
		desk_duration(s->wall_s, time);
		snprintf(out, 96, "done in %.80s", time);
	} else if (s->reason && (s->state == JOB_QUEUED || s->state == JOB_FAILED ||
	                         s->state == JOB_LOST || s->state == JOB_KILLED))
		snprintf(out, 96, "%.95s", s->reason);
	else
		snprintf(out, 96, "%s", job_state_table[s->state].word);
}

void desk_duration(double seconds, char out[96])
{
	long t = lround(fmax(seconds, 0));

	if (t >= 3600)
		snprintf(out, 96, "%ld h %02ld", t / 3600, t / 60 % 60);
	else
		snprintf(out, 96, "%ld:%02ld", t / 60, t % 60);
}

/* Active first, then waiting, then ended in the last hour; newest left. */
static int chip_rank(const struct desk *d, const struct Stats *s)
{
	if (!job_state_table[s->state].over)
		return s->state == JOB_QUEUED || s->state == JOB_HELD ? 1 : 0;
	return d->now - s->ended < 3600 ? 2 : 3;
}

static void fill_chips(struct desk *d, struct scraps *s)
{
	int n = 0;
	struct chip *chips = scraps_array(s, (size_t)d->shelf.n, sizeof *chips);

	for (int rank = 0; chips && rank < 3; rank++)
		for (int i = d->shelf.n - 1; i >= 0; i--) {
			const struct Stats *j = &d->shelf.jobs[i];
			char note[96];
			if (chip_rank(d, j) != rank)
				continue;
			chip_note(j, note);
			bool bar = j->state == JOB_RUNNING || j->state == JOB_SUSPENDED;
			chips[n++] = (struct chip){ j->id, j->state,
				                    scraps_print(s, "%s %lld",
				                                 j->worker ? j->worker : "job",
				                                 (long long)j->id),
				                    scraps_print(s, "%s", note),
				                    bar ? stats_fraction(j) : NAN };
		}
	d->top.chips = chips;
	d->top.n_chips = chips ? n : 0;
}

void desk_fill_top(struct desk *d)
{
	struct scraps *s = &d->scraps[PART_TOP];
	int n = world_count(d->world), surfaces = 0;
	const char *file = NULL;

	scraps_reset(s);
	for (int i = 0; i < n; i++) {
		const struct Ful *f = world_at(d->world, i);
		surfaces += f->entity.kind == ENTITY_SURFACE;
		if (!file && f->file)
			file = path_file_name(f->file);
	}
	d->top = (struct top_model){ 0 };
	d->top.project =
	        scraps_print(s, "%s", file ? file : path_file_name(d->house.project->folder));
	if (!n)
		d->top.detail = "nothing is open";
	else if (surfaces < n)
		d->top.detail = scraps_print(s, "%d surface%s, %d curve%s", surfaces,
		                             surfaces == 1 ? "" : "s", n - surfaces,
		                             n - surfaces == 1 ? "" : "s");
	else
		d->top.detail = scraps_print(s, "%d surface%s", surfaces, surfaces == 1 ? "" : "s");
	fill_chips(d, s);
}
