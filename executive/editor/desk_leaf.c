/* desk_leaf.c - leaves that move between menus or open pages, and how all others are run. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "desk_inside.h"
#include "path.h"

/* Leaves during which the mouse does something of its own in the view. */
static const struct {
	const char *code;
	enum tool tool;
} tool_table[] = {
	{ "V45", TOOL_VIEW },    { "V52", TOOL_VIEW },    { "V59", TOOL_VIEW },
	{ "V74", TOOL_VIEW },    { "V87", TOOL_VIEW },    { "V73", TOOL_LIGHT },
	{ "V44", TOOL_COLOR },   { "V58", TOOL_COLOR },   { "V72", TOOL_COLOR },
	{ "V77", TOOL_COLOR },   { "V157", TOOL_COLOR },  { "V106", TOOL_POINTS },
	{ "V117", TOOL_POINTS }, { "V127", TOOL_POINTS },
};

enum tool desk_leaf_tool(const char *code)
{
	for (size_t i = 0; i < sizeof tool_table / sizeof *tool_table; i++)
		if (!strcmp(tool_table[i].code, code))
			return tool_table[i].tool;
	return TOOL_NONE;
}

static void list_jobs(struct desk *d)
{
	static const char *const none[] = { NULL };

	desk_journal(d, "V162", none);
	desk_jobs_begin(d);
}

/* With jobs picked already it is done; else the list opens to pick them. */
static void for_jobs(struct desk *d, enum message_type type, const char *key)
{
	bool can = false;

	for (int i = 0; i < d->n_picked; i++) {
		const struct Stats *s = job_shelf_find(&d->shelf, d->picked[i]);
		can |= s && desk_job_can(s, type);
	}
	if (d->page == PAGE_JOBS && can) {
		desk_jobs_do(d, type);
		return;
	}
	desk_jobs_begin(d);
	desk_say(d, REPORT_INFO, "Pick jobs in the list, then %s.", key);
}

static void suspend_jobs(struct desk *d)
{
	for_jobs(d, MESSAGE_SUSPEND, "S suspends them");
}

static void activate_jobs(struct desk *d)
{
	for_jobs(d, MESSAGE_ACTIVATE, "A activates them");
}

static void kill_jobs(struct desk *d)
{
	for_jobs(d, MESSAGE_KILL, "K kills them");
}

static void open_uv(struct desk *d)
{
	desk_enter(d, d->house.menus->menu[MENU_UV]->top);
}

static void open_cosfair(struct desk *d)
{
	desk_enter(d, d->house.menus->menu[MENU_COSFAIR]->top);
}

static void leave_menu(struct desk *d)
{
	desk_up(d);
}

static const struct {
	const char *code;
	void (*run)(struct desk *d);
	bool greys; /* it may be greyed by its routine */
} own_table[] = {
	{ "V133", desk_quit, false },    { "V162", list_jobs, false },
	{ "V163", suspend_jobs, false }, { "V164", activate_jobs, false },
	{ "V165", kill_jobs, false },    { "V34", open_uv, false },
	{ "V114", open_cosfair, false }, { "V149", leave_menu, false },
	{ "V156", leave_menu, false },
};

bool desk_leaf_is_own(const char *code)
{
	for (size_t i = 0; i < sizeof own_table / sizeof *own_table; i++)
		if (!strcmp(own_table[i].code, code))
			return !own_table[i].greys;
	return false;
}

bool desk_leaf_own(struct desk *d, const struct Menu_Entry *e)
{
	for (size_t i = 0; i < sizeof own_table / sizeof *own_table; i++) {
		if (strcmp(own_table[i].code, e->index))
			continue;
		const char *why = own_table[i].greys
		                          ? routine_greyed(routine_find(e->index), d->world)
		                          : NULL;
		if (why)
			return false;
		own_table[i].run(d);
		return true;
	}
	return false;
}

/* ------------------------------------------------------------ running */

/* What may take long: jobs to be submitted, files to be read or written. */
static bool is_long(const struct routine *t)
{
	if (t->kind == ROUTINE_JOB)
		return true;
	for (const struct argument_row *row = t->arguments; row && row->name; row++)
		if (row->type == ARGUMENT_FILE || row->type == ARGUMENT_OUTPUT)
			return true;
	return false;
}

void desk_run(struct desk *d, const struct routine *t, const struct arguments *given)
{
	struct errand *e;

	if (desk_busy(d))
		return;
	if (errand_create(&e, t, d->world, d->house.project, given, d->ports.picture) != ST_OK) {
		desk_say(d, REPORT_ERROR, "memory ran out");
		return;
	}
	desk_world_changed(d);
	d->undo_before = world_undo_name(d->world);
	d->errand = e;
	if (is_long(t) && d->ports.start && d->ports.start(d->ports.data, e)) {
		desk_dirty(d, desk_bit(PART_FOOT) | desk_bit(PART_MOUSE));
		return;
	}
	errand_run(e);
	desk_errand_over(d);
}

void desk_run_code(struct desk *d, const char *code, const char *name, const char *value)
{
	const struct routine *t = routine_find(code);
	struct arguments given = { &name, &value, name ? 1 : 0 };
	const char *why = t ? routine_greyed(t, d->world) : "there is no such routine";

	if (why)
		desk_say(d, REPORT_INFO, "%s: %s.", code, why);
	else
		desk_run(d, t, &given);
}

void desk_journal(struct desk *d, const char *code, const char *const *pairs)
{
	const char *name[FIELDS_MAX], *value[FIELDS_MAX];
	struct arguments given = { name, value, 0 };
	struct report_store store;

	report_store_init(&store);
	const struct act a = { .world = d->world,
		               .project = d->house.project,
		               .report = store.report };
	for (; pairs[2 * given.n]; given.n++) {
		name[given.n] = pairs[2 * given.n];
		value[given.n] = pairs[2 * given.n + 1];
	}
	const struct routine *t = routine_find(code);
	const enum status st = t->run == routine_find("V165")->run ? journal_remark(&a, t, &given)
	                                                           : journal_write(&a, t, &given);
	if (st != ST_OK)
		desk_say(d, REPORT_WARNING, "%s", store.error);
}

static void say_lines(struct desk *d, enum report_level level, const char *lines)
{
	while (*lines) {
		size_t n = strcspn(lines, "\n");
		desk_say(d, level, "%.*s", (int)n, lines);
		if (level == REPORT_INFO)
			d->messages[d->n_messages - 1].done = true;
		lines += n + (lines[n] == '\n');
	}
}

/* An edit that can be taken back, said so where its routine said nothing. */
static void tell_edit(struct desk *d, const struct routine *t, bool said)
{
	const char *what = world_undo_name(d->world);

	if (!what || what == d->undo_before || !strcmp(t->code, "V182") || !strcmp(t->code, "V183"))
		return;
	if (!said) {
		const bool small = *what >= 'a' && *what <= 'z';
		desk_say(d, REPORT_INFO, "%c%s: done.", small ? *what - 'a' + 'A' : *what,
		         what + 1);
		d->messages[d->n_messages - 1].done = true;
	}
	snprintf(d->messages[d->n_messages - 1].hint, sizeof d->messages[0].hint, "Z undoes: %.36s",
	         what);
}

void desk_errand_over(struct desk *d)
{
	struct errand *e = d->errand;

	if (!e || !errand_over(e))
		return;
	const struct routine *t = errand_routine(e);
	enum status st = errand_status(e);
	const bool started = errand_jobs(e) > 0;
	d->errand = NULL;
	desk_world_changed(d);
	if (st == ST_OK) {
		say_lines(d, REPORT_WARNING, errand_warning(e));
		say_lines(d, REPORT_INFO, errand_said(e));
		tell_edit(d, t, *errand_said(e));
	} else if (st == ST_CANCELLED) {
		desk_say(d, REPORT_INFO, "%s was stopped.", t->code);
	} else {
		const char *error = errand_error(e);
		desk_say(d, REPORT_ERROR, "%s", *error ? error : status_text(st));
		d->messages[d->n_messages - 1].of = t;
	}
	errand_destroy(e);
	if (d->fitted)
		desk_views_adopt(d);
	else if (world_count(d->world))
		desk_views_fit(d, NULL);
	desk_dirty(d, DESK_ALL);
	desk_results(d);
	if (started)
		desk_jobs_settle(d, NULL, 0);
	desk_open_next(d);
}

void desk_errand_progress(struct desk *d)
{
	if (d->errand)
		desk_dirty(d, desk_bit(PART_FOOT));
}

/* What lies in the project is named from there, so that the journal is right wherever the folder is. */
const char *desk_near_path(const struct desk *d, const char *path)
{
	const char *folder = world_folder(d->world);
	const size_t n = strlen(folder);

	return !strncmp(path, folder, n) && path[n] == '/' ? path + n + 1 : path;
}

/* Something of that file is there, as the file has it. */
static bool is_open(const struct desk *d, const char *path)
{
	for (int k = 0; k < world_count(d->world); k++) {
		const struct Ful *f = world_at(d->world, k);
		struct stat now;
		if (f->file && !strcmp(f->file, path) && !stat(path, &now) &&
		    now.st_mtim.tv_sec == f->stamp[0] && now.st_mtim.tv_nsec == f->stamp[1] &&
		    now.st_size == f->stamp[2])
			return true;
	}
	return false;
}

/* The project's folder is where relative names are looked for; these are the caller's. */
void desk_open_next(struct desk *d)
{
	if (d->errand || d->drag != DRAG_NONE || d->pending_at >= d->n_pending)
		return;
	char *file = d->pending[d->pending_at++];
	char *path = path_absolute(file, NULL);
	if (path && is_open(d, path)) {
		desk_say(d, REPORT_INFO, "%s is open already; V175 reads it anew.",
		         path_file_name(path));
		free(path);
		free(file);
		desk_open_next(d);
		return;
	}
	desk_run_code(d, "V175", "file", path ? desk_near_path(d, path) : file);
	free(path);
	free(file);
}
