/* desk_mouse.c - what the mouse does, where it is. */
#include <math.h>

#include "desk_inside.h"

enum { CLICK_PX = 4 };

static bool in_box(const struct box_px *b, double x, double y)
{
	return b->width > 0 && x >= b->x && y >= b->y && x < b->x + b->width &&
	       y < b->y + b->height;
}

/* The foremost part that has something there; a page hides what lies under it. */
static const struct hit *hit_under(const struct desk *d, double x, double y,
                                   enum desk_part *part_out)
{
	static const enum desk_part order[] = { PART_PAGE, PART_FOOT, PART_MOUSE, PART_MENU,
		                                PART_TOP,  PART_CARD, PART_OVER };

	for (size_t i = 0; i < sizeof order / sizeof *order; i++) {
		struct box_px box = desk_part_box(d, order[i]);
		if (!in_box(&box, x, y))
			continue;
		const struct hit *h = hits_at(&d->hits[order[i]], x, y);
		*part_out = order[i];
		if (h)
			return h;
		bool hides =
		        order[i] == PART_PAGE && (d->page != PAGE_SEARCH && d->page != PAGE_HELP);
		if (hides)
			return NULL;
	}
	*part_out = N_DESK_PARTS;
	return NULL;
}

static void set_hover(struct desk *d, const struct hit *h, enum desk_part part)
{
	struct look *k = &d->look;
	enum hit_kind kind = h ? h->kind : HIT_NONE;
	int index = h ? h->index : 0, at = h ? h->part : 0;

	if (k->hover_kind == kind && k->hover_index == index && k->hover_part == at)
		return;
	/* the part that was left lies anywhere: painting is cheap, but only parts with hits */
	for (int i = 0; i < N_DESK_PARTS; i++)
		if (d->hits[i].n && (i == (int)part || k->hover_kind != HIT_NONE))
			desk_dirty(d, desk_bit((enum desk_part)i));
	k->hover_kind = kind;
	k->hover_index = index;
	k->hover_part = at;
}

void desk_move(struct desk *d, double x, double y)
{
	double dx = x - d->x, dy = y - d->y;
	enum desk_part part;

	d->x = x;
	d->y = y;
	if (d->drag != DRAG_NONE) {
		d->drag_moved |= hypot(x - d->down_x, y - d->down_y) >= CLICK_PX;
		if (d->space)
			d->space_used = true;
		if (d->drag_moved || d->drag == DRAG_PROBE || d->drag >= DRAG_CARD)
			desk_view_move(d, dx, dy);
		desk_world_changed(d);
		return;
	}
	const struct hit *h = hit_under(d, x, y, &part);
	set_hover(d, h, part);
	d->skip = 0;
	if (!h && d->page == PAGE_NONE && !d->errand)
		desk_hover(d);
}

/* Of the card that stands where nothing is open. */
static void click_empty(struct desk *d, const struct hit *h)
{
	const struct Menu_Entry *e = desk_leaf(d, h->index == 0 ? "V175" : "V7");

	if (e) {
		desk_go_to(d, e);
		desk_choose(d, e);
	}
}

static void click_button(struct desk *d, const struct hit *h, enum desk_part part)
{
	if (part == PART_PAGE && d->page == PAGE_QUESTION)
		desk_answer_question(d, h->index);
	else if (part == PART_PAGE && d->page == PAGE_JOBS)
		desk_jobs_click(d, h, 0);
	else if (part == PART_MENU && h->index == 0)
		desk_ask_accept(d);
	else if (part == PART_MENU && (d->tool == TOOL_COLOR || d->tool == TOOL_LIGHT))
		desk_back(d);
	else if (part == PART_MENU)
		desk_ask_defaults(d);
	else if (part == PART_CARD)
		click_empty(d, h);
	else if (part == PART_OVER && h->part == GROUP_KEY)
		desk_key_calculate(d);
}

/* A link of the page, help on this menu, or the page's cross. */
static void click_help(struct desk *d, int index)
{
	char code[8];

	if (d->page == PAGE_HELP)
		desk_fill_help(d);
	if (index == -2)
		desk_leave_page(d);
	else if (index == -1 && desk_shown_menu(d))
		desk_help_for(d, desk_shown_menu(d)->index);
	else if (d->page == PAGE_HELP && panel_help_link(d->help.text, index, code, sizeof code))
		desk_help_for(d, code);
}

static void click(struct desk *d, const struct hit *h, enum desk_part part, unsigned mods)
{
	const struct Menu_Entry *entry[ENTRIES_MAX];

	switch (h->kind) {
	case HIT_MENU_ROW:
		if (h->index < desk_entries(d, entry))
			desk_choose(d, entry[h->index]);
		break;
	case HIT_FIELD:
		desk_ask_focus(d, h->index);
		break;
	case HIT_CHOICE:
		desk_ask_choice(d, h->index, h->part);
		break;
	case HIT_BUTTON:
		click_button(d, h, part);
		break;
	case HIT_CHIP:
		if (h->index < 0 || h->index >= d->top.n_chips)
			desk_toggle_page(d, PAGE_JOBS);
		else
			desk_job_show(d, d->top.chips[h->index].id);
		break;
	case HIT_JOB_ROW:
	case HIT_JOB_BOX:
	case HIT_TAB:
		desk_jobs_click(d, h, mods);
		break;
	case HIT_SEARCH:
		desk_search_open(d);
		break;
	case HIT_WORLD:
		desk_world_menu(d);
		break;
	case HIT_CANDIDATE:
		desk_ask_candidate(d, h->index);
		break;
	case HIT_RESULT:
		desk_search_take(d, h->index, false);
		break;
	case HIT_BAR:
		if (d->ports.restart_jobs)
			d->ports.restart_jobs(d->ports.data);
		break;
	case HIT_CRUMB: /* back to that menu */
		while (d->depth > h->index + 1 && desk_up(d))
			;
		break;
	case HIT_HELP_LINK:
		click_help(d, h->index);
		break;
	default:
		break;
	}
}

void desk_press(struct desk *d, enum desk_button button, unsigned mods)
{
	enum desk_part part;

	if (d->drag != DRAG_NONE)
		return;
	const struct hit *h = hit_under(d, d->x, d->y, &part);
	d->down_x = d->x;
	d->down_y = d->y;
	d->drag_moved = false;
	d->drag_button = button;
	if (h && button == BUTTON_LEFT && !desk_tool_press(d, h))
		click(d, h, part, mods);
	else if (h && button == BUTTON_RIGHT && h->kind == HIT_CHIP)
		click(d, h, part, mods);
	else if (!h && part == PART_PAGE)
		; /* beside the rows of a page */
	else if (!h && (d->page == PAGE_SEARCH || d->page == PAGE_HELP))
		desk_leave_page(d);
	else if (!h && d->page == PAGE_NONE && !d->errand)
		desk_view_press(d, button, mods);
	desk_world_changed(d);
}

void desk_release(struct desk *d, enum desk_button button)
{
	if (d->drag == DRAG_NONE || button != d->drag_button)
		return;
	desk_view_release(d);
	desk_open_next(d); /* files that were dropped meanwhile */
	desk_dirty(d, DESK_VIEW | desk_bit(PART_MOUSE));
	desk_world_changed(d);
}

static int clamp(int x, int lo, int hi)
{
	return x < lo ? lo : x > hi ? (hi < lo ? lo : hi) : x;
}

void desk_scroll(struct desk *d, double dy)
{
	struct box_px menu = desk_part_box(d, PART_MENU);

	if (d->page == PAGE_JOBS && in_box(&d->layout.view, d->x, d->y)) {
		d->job_scroll = clamp(d->job_scroll - (int)(3 * dy), 0,
		                      desk_jobs_count(d) - d->job_rows);
	} else if (d->page == PAGE_HELP) {
		d->help_scroll = fmax(0, d->help_scroll - 48 * dy);
	} else if (d->page != PAGE_NONE) {
		d->page_scroll = clamp(d->page_scroll - (int)(3 * dy), 0, desk_page_last(d));
	} else if (in_box(&menu, d->x, d->y)) {
		d->ask.scroll = clamp(d->ask.scroll - (dy > 0 ? 1 : -1), 0, d->ask.n - 1);
		desk_dirty(d, desk_bit(PART_MENU));
		return;
	} else {
		if (!d->errand)
			desk_view_scroll(d, dy);
		return;
	}
	desk_dirty(d, desk_bit(PART_PAGE));
}
