/* desk.c - the editor without its window: events in, what must be painted out. */
#include "desk.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "desk_inside.h"

enum { CARET_SECONDS = 10, CLICK_PX = 4 };

/* ------------------------------------------------------------ life */

enum status desk_create(struct desk **out, const struct desk_house *h, const struct desk_ports *p)
{
	struct desk *d = calloc(1, sizeof *d);

	if (!d)
		return ST_RESOURCE;
	d->house = *h;
	d->world = h->world;
	if (p)
		d->ports = *p;
	d->theme = h->theme;
	d->scale = 1;
	d->panel_shown = true;
	d->row_focus = -1;
	d->n_tiles = 1;
	d->history = calloc(HISTORY_MAX, sizeof *d->history);
	if (!d->history) {
		desk_destroy(d);
		return ST_RESOURCE;
	}
	d->seen_revision = world_revision(d->world);
	desk_root(d, MENU_MAIN);
	desk_resize(d, 1280, 800, 1);
	for (int i = 0; i < N_MENUS; i++)
		if (h->menus->complaint[i])
			desk_say(d, REPORT_WARNING, "%s", h->menus->complaint[i]);
	d->dirty = DESK_ALL;
	*out = d;
	return ST_OK;
}

void desk_destroy(struct desk *d)
{
	if (!d)
		return;
	errand_destroy(d->errand);
	desk_ask_end(d);
	for (int i = 0; i < d->n_history; i++) {
		free(d->history[i].name);
		free(d->history[i].value);
	}
	free(d->history);
	for (int i = 0; i < d->n_messages; i++)
		free(d->messages[i].text);
	for (int i = 0; i < N_DESK_PARTS; i++) {
		hits_finish(&d->hits[i]);
		scraps_finish(&d->scraps[i]);
	}
	for (int i = d->pending_at; i < d->n_pending; i++)
		free(d->pending[i]);
	free(d->pending);
	desk_question_finish(&d->question);
	job_shelf_finish(&d->shelf);
	free(d->seen);
	free(d->log_text);
	free(d);
}

struct job_shelf *desk_shelf(struct desk *d)
{
	return &d->shelf;
}

const struct hits *desk_hits(const struct desk *d, enum desk_part part)
{
	return &d->hits[part];
}

/* ------------------------------------------------------------ what is dirty */

unsigned desk_bit(enum desk_part part)
{
	return 1u << part;
}

void desk_dirty(struct desk *d, unsigned bits)
{
	d->dirty |= bits;
}

bool desk_world_lent(const struct desk *d)
{
	return d->errand != NULL;
}

void desk_world_changed(struct desk *d)
{
	unsigned revision = d->errand ? d->seen_revision : world_revision(d->world);

	if (revision == d->seen_revision)
		return;
	d->seen_revision = revision;
	desk_views_place(d);
	desk_dirty(d, DESK_VIEW | desk_bit(PART_MENU) | desk_bit(PART_OVER) | desk_bit(PART_TOP) |
	                      desk_bit(PART_CARD) | desk_bit(PART_PROBE));
}

unsigned desk_take_dirty(struct desk *d)
{
	unsigned kept = 0;

	desk_world_changed(d);
	if (d->errand)
		kept = d->dirty & (DESK_VIEW | desk_bit(PART_MENU) | desk_bit(PART_OVER) |
		                   desk_bit(PART_CARD) | desk_bit(PART_PROBE) | desk_bit(PART_TOP));
	unsigned dirty = d->dirty & ~kept;
	d->dirty = kept;
	return dirty;
}

/* ------------------------------------------------------------ layout */

void desk_place(struct desk *d)
{
	const struct Menu_Entry *entry[ENTRIES_MAX];

	layout_place(&d->layout, d->width, d->height, d->panel_shown, desk_entries(d, entry));
	desk_views_place(d);
}

void desk_resize(struct desk *d, double width, double height, double scale)
{
	d->width = width;
	d->height = height;
	d->scale = scale;
	desk_place(d);
	desk_dirty(d, DESK_ALL);
}

static struct box_px join(struct box_px a, struct box_px b)
{
	double x1 = fmax(a.x + a.width, b.x + b.width), y1 = fmax(a.y + a.height, b.y + b.height);

	if (a.width <= 0 || b.width <= 0)
		return a.width <= 0 ? b : a;
	struct box_px out = { fmin(a.x, b.x), fmin(a.y, b.y), 0, 0 };
	out.width = x1 - out.x;
	out.height = y1 - out.y;
	return out;
}

static struct box_px page_box(const struct desk *d)
{
	struct box_px all = { 0, 0, d->width, d->height };

	switch (d->page) {
	case PAGE_NONE:
		return (struct box_px){ 0 };
	case PAGE_QUESTION:
		if (d->question.in_prompt)
			return (struct box_px){ 0 };
		return d->layout.view;
	case PAGE_JOBS:
	case PAGE_MESSAGES:
		return d->layout.view;
	default:
		return all;
	}
}

struct box_px desk_part_box(const struct desk *d, enum desk_part part)
{
	const struct layout *l = &d->layout;
	struct box_px box;

	switch (part) {
	case PART_OVER:
		return join(l->view, l->key);
	case PART_PROBE:
		return d->probe_shown ? l->view : (struct box_px){ 0 };
	case PART_TOP:
		return l->top;
	case PART_MENU:
		return d->panel_shown ? join(join(l->panel_top, l->menu), l->form)
		                      : (struct box_px){ 0 };
	case PART_MOUSE:
		return d->panel_shown ? l->mouse : (struct box_px){ 0 };
	case PART_FOOT:
		box = join(l->message, l->prompt);
		if (d->foot.n_candidates) { /* they stand above the message line */
			double up = fmin(28. * CANDIDATES_MAX + 24, box.y - l->view.y);
			box.y -= up;
			box.height += up;
		}
		return box;
	case PART_CARD:
		if (d->tool == TOOL_LIGHT || d->tool == TOOL_COLOR || !world_count(d->world))
			return l->view;
		return (struct box_px){ 0 };
	case PART_PAGE:
		return page_box(d);
	default:
		return (struct box_px){ 0 };
	}
}

/* ------------------------------------------------------------ saying */

void desk_say(struct desk *d, enum report_level level, const char *format, ...)
{
	struct message_line *m;
	va_list list;
	char *text = NULL;

	va_start(list, format);
	if (vasprintf(&text, format, list) < 0)
		text = NULL;
	va_end(list);
	if (!text)
		return;
	if (d->n_messages == MESSAGES_MAX) {
		free(d->messages[0].text);
		memmove(d->messages, d->messages + 1, (MESSAGES_MAX - 1) * sizeof *d->messages);
		d->n_messages--;
	}
	m = &d->messages[d->n_messages++];
	*m = (struct message_line){ .level = level, .text = text };
	desk_dirty(d, desk_bit(PART_FOOT));
	if (d->page == PAGE_MESSAGES)
		desk_dirty(d, desk_bit(PART_PAGE));
}

bool desk_busy(struct desk *d)
{
	if (!d->errand)
		return false;
	desk_say(d, REPORT_INFO, "%s is still at work. Esc stops it.",
	         errand_routine(d->errand)->code);
	return true;
}

/* ------------------------------------------------------------ pages and steps back */

void desk_set_page(struct desk *d, enum page page)
{
	d->page = page;
	d->page_scroll = 0;
	d->help_scroll = 0;
	d->help_link = -1;
	if (page == PAGE_JOBS)
		d->slots = 0; /* looked up anew */
	desk_dirty(d, desk_bit(PART_PAGE) | desk_bit(PART_FOOT) | desk_bit(PART_MOUSE) |
	                      desk_bit(PART_MENU) | desk_bit(PART_TOP));
}

/* What stood under the page comes back. */
void desk_leave_page(struct desk *d)
{
	enum page under = d->under == d->page ? PAGE_NONE : d->under;

	d->under = PAGE_NONE;
	desk_set_page(d, under);
}

bool desk_back(struct desk *d)
{
	if (d->errand) {
		errand_stop(d->errand);
		return true;
	}
	if (d->drag != DRAG_NONE) {
		desk_drag_cancel(d);
		return true;
	}
	if (d->page == PAGE_QUESTION) {
		int last = 0;
		while (last + 1 < BUTTONS_MAX && d->question.word[last + 1])
			last++;
		desk_answer_question(d, last);
		return true;
	}
	if (d->page != PAGE_NONE) {
		desk_leave_page(d);
		return true;
	}
	if (d->ask.routine) {
		desk_tool_end(d);
		desk_ask_end(d);
		return true;
	}
	if (d->tool != TOOL_NONE) {
		desk_tool_end(d);
		return true;
	}
	if (d->probe_shown) {
		desk_probe_hide(d);
		return true;
	}
	return desk_up(d);
}

bool desk_takes_text(const struct desk *d)
{
	return d->page == PAGE_SEARCH || (d->page == PAGE_NONE && desk_ask_textual(d));
}

/* ------------------------------------------------------------ time, files, errands */

void desk_tick(struct desk *d, double now)
{
	d->now = now;
	for (int i = 0; i < d->shelf.n; i++)
		if (!job_state_table[d->shelf.jobs[i].state].over) {
			desk_dirty(d, desk_bit(PART_TOP) |
			                      (d->page == PAGE_JOBS ? desk_bit(PART_PAGE) : 0));
			break;
		}
}

double desk_next_tick(const struct desk *d)
{
	for (int i = 0; i < d->shelf.n; i++)
		if (d->shelf.jobs[i].state == JOB_RUNNING)
			return d->now + 1;
	return INFINITY;
}

void desk_close(struct desk *d)
{
	if (d->drag != DRAG_NONE)
		desk_drag_cancel(d);
	desk_quit(d);
}

void desk_open(struct desk *d, const char *const *files, int n)
{
	char **more = reallocarray(d->pending, (size_t)(d->n_pending + n) + 1, sizeof *more);

	if (!more)
		return;
	d->pending = more;
	for (int i = 0; i < n; i++) {
		char *copy = strdup(files[i]);
		if (copy)
			d->pending[d->n_pending++] = copy;
	}
	desk_open_next(d);
	if (!d->errand && !d->fitted) /* nothing is read: what the session had is looked at */
		desk_views_fit(d, NULL);
}
