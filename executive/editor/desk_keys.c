/* desk_keys.c - what every key does now. */
#include "desk_inside.h"

void desk_toggle_page(struct desk *d, enum page page)
{
	if (d->page == page) {
		desk_leave_page(d);
		return;
	}
	if (d->page == PAGE_QUESTION)
		return;
	d->under = page == PAGE_HELP || page == PAGE_SEARCH ? d->page : PAGE_NONE;
	if (page == PAGE_JOBS)
		desk_jobs_begin(d);
	else
		desk_set_page(d, page);
}

static void undo(struct desk *d, bool again)
{
	if (!desk_busy(d))
		desk_run_code(d, again ? "V183" : "V182", NULL, NULL);
}

/* Keys that mean the same whatever is asked. */
static bool everywhere(struct desk *d, enum desk_key key, unsigned mods)
{
	switch ((int)key) {
	case KEY_ESCAPE:
		desk_back(d);
		return true;
	case KEY_F1:
		if (d->page == PAGE_HELP)
			desk_leave_page(d);
		else
			desk_help_here(d);
		return true;
	case KEY_F4:
		desk_toggle_page(d, PAGE_MESSAGES);
		return true;
	case KEY_F9:
		d->panel_shown = !d->panel_shown;
		desk_place(d);
		desk_dirty(d, DESK_ALL);
		return true;
	case KEY_F10:
		d->theme = d->theme == THEME_DARK ? THEME_LIGHT : THEME_DARK;
		for (int i = 0; i < d->n_tiles; i++)
			d->tiles[i].view.theme = d->theme;
		desk_dirty(d, DESK_ALL);
		return true;
	case KEY_CTRL_A + 'K' - 'A':
		desk_search_open(d);
		return true;
	case KEY_CTRL_A + 'W' - 'A':
		desk_world_menu(d);
		return true;
	case KEY_CTRL_A + 'J' - 'A':
		desk_toggle_page(d, PAGE_JOBS);
		return true;
	case KEY_CTRL_A + 'T' - 'A':
		desk_split_next(d);
		return true;
	case KEY_CTRL_A + 'Z' - 'A':
		undo(d, mods & MOD_SHIFT);
		return true;
	case KEY_CTRL_A + 'Y' - 'A':
		undo(d, true);
		return true;
	case KEY_CTRL_A + 'Q' - 'A':
		desk_quit(d);
		return true;
	default:
		return false;
	}
}

static void hover_row(struct desk *d, int step)
{
	const struct Menu_Entry *entry[ENTRIES_MAX];
	int n = desk_entries(d, entry);

	if (n)
		d->row_focus =
		        d->row_focus < 0 ? (step > 0 ? 0 : n - 1) : (d->row_focus + step + n) % n;
	desk_dirty(d, desk_bit(PART_MENU));
}

/* The menu's rows by Tab and Enter; arrows are the view's. */
static bool menu_key(struct desk *d, enum desk_key key, unsigned mods)
{
	const struct Menu_Entry *entry[ENTRIES_MAX];
	int n = desk_entries(d, entry);

	switch ((int)key) {
	case KEY_TAB:
		if (d->pick.thing && desk_tile_at(d, d->x, d->y) >= 0) {
			d->skip++;
			desk_hover(d);
			return true;
		}
		hover_row(d, mods & MOD_SHIFT ? -1 : 1);
		return true;
	case KEY_ENTER:
		if (d->row_focus >= 0 && d->row_focus < n)
			desk_choose(d, entry[d->row_focus]);
		return true;
	case KEY_BACKSPACE:
		desk_back(d);
		return true;
	default:
		return false;
	}
}

void desk_key(struct desk *d, enum desk_key key, unsigned mods)
{
	d->look.focus_kind = HIT_NONE;
	if (d->drag != DRAG_NONE && key != KEY_ESCAPE && key != KEY_SPACE)
		return; /* one thing at a time: what is dragged is not there yet */
	if (key == KEY_SPACE) {
		if (!d->space && desk_tile_at(d, d->x, d->y) >= 0 && d->page == PAGE_NONE) {
			d->space = true;
			d->space_used = false;
			desk_dirty(d, desk_bit(PART_MOUSE));
		}
		return;
	}
	if (everywhere(d, key, mods) || (d->page != PAGE_NONE && desk_page_key(d, key, mods)))
		return;
	bool done = false;
	if (d->page == PAGE_SEARCH)
		done = desk_search_key(d, key);
	else if (d->page == PAGE_JOBS)
		done = desk_jobs_key(d, key, mods);
	else if (d->page == PAGE_NONE && d->ask.routine)
		done = desk_ask_key(d, key, mods);
	if (!done && d->page == PAGE_NONE && !d->errand)
		done = menu_key(d, key, mods) || desk_view_key(d, key, mods);
	desk_world_changed(d);
}

void desk_space_up(struct desk *d)
{
	if (!d->space)
		return;
	d->space = false;
	desk_dirty(d, desk_bit(PART_MOUSE));
	if (!d->space_used && desk_takes_text(d))
		desk_text(d, ' ');
}

void desk_command(struct desk *d, uint32_t c)
{
	switch (c) {
	case '/':
		desk_search_open(d);
		return;
	case '?':
		desk_toggle_page(d, PAGE_KEYS);
		return;
	case 'w':
	case 'W':
		desk_world_menu(d);
		return;
	case 'j':
	case 'J':
		desk_toggle_page(d, PAGE_JOBS);
		return;
	case 't':
	case 'T':
		desk_split_next(d);
		return;
	case 'i':
	case 'I':
		if (!desk_busy(d))
			desk_run_code(d, "V189", NULL, NULL);
		return;
	case 'z':
	case 'Z':
		undo(d, c == 'Z');
		return;
	case 'r':
	case 'R':
		desk_ask_defaults(d);
		return;
	case 'o':
	case 'O':
		if (d->job_log)
			desk_job_open(d, job_shelf_find(&d->shelf, d->job_log));
		return;
	case 'l':
	case 'L':
		if (d->job_log)
			desk_job_show(d, d->job_log);
		return;
	default:
		if (!desk_choose_key(d, c))
			desk_view_text(d, c);
	}
}

void desk_text(struct desk *d, uint32_t c)
{
	if (d->drag != DRAG_NONE)
		return;
	if (c == ' ' && d->space) /* said when the bar goes up, unless it moved the view */
		return;
	if (d->page == PAGE_QUESTION) {
		desk_question_text(d, c);
	} else if (d->page == PAGE_SEARCH) {
		if (typed_insert(&d->search, c))
			desk_search_changed(d);
	} else if (d->page == PAGE_JOBS && desk_jobs_text(d, c)) {
		/* taken */
	} else if (d->page == PAGE_NONE && desk_ask_text(d, c)) {
		/* taken */
	} else {
		desk_command(d, c);
	}
	desk_world_changed(d);
}
