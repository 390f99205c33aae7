/* desk_pages.c - help, the sheet of keys, messages, and questions before loss of work. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "desk_inside.h"

const struct key_row desk_key_table[] = {
	{ "1-9  0  A-D", "the menu's entries 1 to 14", false },
	{ "Enter", "the main button", false },
	{ "Esc", "one step back; work is never lost unasked", false },
	{ "/  Ctrl K", "find a routine by name, code or help text", false },
	{ "W  Ctrl W", "the World menu, and back", false },
	{ "J  Ctrl J", "the jobs", false },
	{ "T  Ctrl T", "two views: another side, the child, u and v; and back", false },
	{ "I", "the image that is shown, or what it is of", false },
	{ "S  A  K  R  O  L", "in the jobs: suspend, activate, kill, retry, open, log", false },
	{ "F1", "help for the entry under the mouse, or of what is asked", false },
	{ "?", "this sheet", false },
	{ "F4", "the last 200 messages", false },
	{ "Z  Ctrl Z", "undo", false },
	{ "Shift Z  Ctrl Y", "redo", false },
	{ "Tab", "complete, the next field, the next link", false },
	{ "Shift Tab", "the field before", false },
	{ "Up  Down", "candidates, steps of a value, earlier values", false },
	{ "R  Ctrl R", "the defaults of what is asked", false },
	{ "Arrows", "turn the view 5°, with Shift pan, with Ctrl zoom", false },
	{ "F", "fit what is shown into the view", false },
	{ "Home", "the standard view", false },
	{ "X  Y  Shift X  Shift Y", "look along an axis", false },
	{ "Ctrl 1-6", "front, back, left, right, top, bottom", false },
	{ "Space held", "the mouse turns the view, whatever is asked", false },
	{ "F9", "hide and show the panel", false },
	{ "F10", "dark or light", false },
	{ "Ctrl Q", "quit", false },
	{ NULL, NULL, false },
};

/* ------------------------------------------------------------ help */

void desk_help_for(struct desk *d, const char *code)
{
	if (!code || !help_find(d->house.help, code)) {
		desk_say(d, REPORT_INFO, "There is no help for %s.", code ? code : "this");
		return;
	}
	snprintf(d->help_code, sizeof d->help_code, "%.7s", code);
	if (d->page != PAGE_HELP)
		d->under = d->page == PAGE_SEARCH ? PAGE_NONE : d->page;
	desk_set_page(d, PAGE_HELP);
}

/* Of the entry under the mouse, else with the focus, else of what is asked, else of the menu. */
void desk_help_here(struct desk *d)
{
	const struct Menu_Entry *entry[ENTRIES_MAX];
	int n = desk_entries(d, entry), at = d->look.hover_index;

	if (d->page == PAGE_SEARCH && d->found_chosen < d->n_found)
		desk_help_for(d, d->found[d->found_chosen]->index);
	else if (d->look.hover_kind == HIT_MENU_ROW && at >= 0 && at < n)
		desk_help_for(d, entry[at]->index);
	else if (d->row_focus >= 0 && d->row_focus < n)
		desk_help_for(d, entry[d->row_focus]->index);
	else if (d->ask.routine)
		desk_help_for(d, d->ask.routine->code);
	else if (desk_shown_menu(d))
		desk_help_for(d, desk_shown_menu(d)->index);
}

/* ------------------------------------------------------------ questions */

void desk_question_finish(struct question *q)
{
	free(q->title);
	for (int i = 0; i < 8; i++)
		free(q->line[i]);
	*q = (struct question){ 0 };
}

void desk_question(struct desk *d, const struct question *q)
{
	desk_question_finish(&d->question);
	d->question = *q;
	d->under = d->page == PAGE_QUESTION ? d->under : d->page;
	desk_set_page(d, PAGE_QUESTION);
}

void desk_answer_question(struct desk *d, int button)
{
	if (button < 0 || button >= BUTTONS_MAX || !d->question.word[button])
		return;
	struct question q = d->question;
	d->question = (struct question){ 0 };
	enum page under = d->under;
	d->under = PAGE_NONE;
	desk_set_page(d, under);
	q.answer(d, q.key[button]);
	desk_question_finish(&q);
}

bool desk_question_text(struct desk *d, uint32_t c)
{
	if (c >= 'a' && c <= 'z')
		c -= 'a' - 'A';
	for (int i = 0; i < BUTTONS_MAX && d->question.word[i]; i++)
		if ((uint32_t)d->question.key[i] == c) {
			desk_answer_question(d, i);
			break;
		}
	return true;
}

/* ------------------------------------------------------------ keys of the pages */

int desk_page_last(struct desk *d)
{
	if (d->page != PAGE_KEYS)
		return d->n_messages - 1;
	const struct keys_model *m = desk_keys_model(d);
	const struct box_px all = { 0, 0, d->width, d->height };
	const int room = panel_keys_rows(&all, m);

	return m->n > room ? m->n - room : 0;
}

/* Tab goes from one link of the page to the next, Enter follows it. */
static bool link_key(struct desk *d, enum desk_key key, bool back)
{
	char code[8];
	int n = 0;

	desk_fill_help(d); /* what was painted last may have been another page */
	while (panel_help_link(d->help.text, n, code, sizeof code))
		n++;
	if (key == KEY_ENTER && d->help_link >= 0 &&
	    panel_help_link(d->help.text, d->help_link, code, sizeof code)) {
		desk_help_for(d, code);
		return true;
	}
	if (key != KEY_TAB || !n)
		return false;
	d->help_link =
	        d->help_link < 0 ? (back ? n - 1 : 0) : (d->help_link + (back ? n - 1 : 1)) % n;
	d->look.focus_kind = HIT_HELP_LINK;
	d->look.focus_index = d->help_link;
	d->look.focus_part = 0;
	d->help_scroll = 1e9; /* they stand at the end; as far as there is something */
	return true;
}

static void scroll_list(struct desk *d, int step)
{
	const int last = desk_page_last(d);

	d->page_scroll += step;
	d->page_scroll = d->page_scroll > last ? last : d->page_scroll;
	d->page_scroll = d->page_scroll < 0 ? 0 : d->page_scroll;
}

bool desk_page_key(struct desk *d, enum desk_key key, unsigned mods)
{
	int step = key == KEY_UP          ? -1
	           : key == KEY_DOWN      ? 1
	           : key == KEY_PAGE_UP   ? -10
	           : key == KEY_PAGE_DOWN ? 10
	                                  : 0;

	if (d->page == PAGE_QUESTION)
		return true; /* by its letters alone, so that no Enter kills */
	if (d->page == PAGE_HELP && step) {
		d->help_scroll = fmax(0, d->help_scroll + 32 * step);
	} else if ((d->page == PAGE_MESSAGES || d->page == PAGE_KEYS) && step) {
		scroll_list(d, step);
	} else if (d->page != PAGE_HELP || !link_key(d, key, mods & MOD_SHIFT)) {
		return false;
	}
	desk_dirty(d, desk_bit(PART_PAGE));
	return true;
}
