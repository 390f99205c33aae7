/* desk_menu.c - the walk through the menus. */
#include <stdio.h>
#include <string.h>

#include "desk_inside.h"

static const char row_keys[] = "1234567890ABCD";

char desk_row_key(int row)
{
	return row >= 0 && row < ENTRIES_MAX ? row_keys[row] : ' ';
}

const struct Menu_Entry *desk_shown_menu(const struct desk *d)
{
	return d->depth ? d->path[d->depth - 1] : NULL;
}

int desk_entries(const struct desk *d, const struct Menu_Entry *out[ENTRIES_MAX])
{
	const struct Menu_Entry *menu = desk_shown_menu(d);
	int n = 0;

	for (; menu && n < menu->n_sub && n < ENTRIES_MAX; n++)
		out[n] = menu->sub[n];
	return n;
}

const struct routine *desk_routine(const struct Menu_Entry *e)
{
	return e && menu_is_leaf(e) ? routine_find(e->index) : NULL;
}

static void shown(struct desk *d)
{
	d->row_focus = -1;
	desk_place(d);
	desk_dirty(d, desk_bit(PART_MENU) | desk_bit(PART_FOOT) | desk_bit(PART_MOUSE));
}

/* What is asked belongs to the menu one leaves. */
static void leave_form(struct desk *d)
{
	desk_tool_end(d);
	desk_ask_end(d);
}

void desk_enter(struct desk *d, const struct Menu_Entry *menu)
{
	if (!menu || d->depth == PATH_MAX_DEPTH)
		return;
	leave_form(d);
	d->path[d->depth++] = menu;
	shown(d);
}

/* MAIN and WORLD are left by their keys, UV and COSFAIR back to the menu that opened them. */
bool desk_up(struct desk *d)
{
	if (d->depth > 1) {
		leave_form(d);
		d->depth--;
		shown(d);
		return true;
	}
	if (d->in_world) {
		desk_world_menu(d);
		return true;
	}
	return false;
}

void desk_root(struct desk *d, enum menu_root which)
{
	d->depth = 0;
	desk_enter(d, d->house.menus->menu[which]->top);
}

void desk_world_menu(struct desk *d)
{
	leave_form(d);
	if (d->in_world) {
		d->depth = d->left_depth;
		memcpy(d->path, d->left, sizeof d->path);
	} else {
		d->left_depth = d->depth;
		memcpy(d->left, d->path, sizeof d->left);
		d->depth = 1;
		d->path[0] = d->house.menus->menu[MENU_WORLD]->top;
	}
	d->in_world = !d->in_world;
	shown(d);
	desk_dirty(d, desk_bit(PART_TOP));
}

/* Heads of the menu that an entry is in, the root first. */
static int heads_of(const struct Menu_Entry *e, const struct Menu_Entry *out[PATH_MAX_DEPTH])
{
	int n = 0;

	for (const struct Menu_Entry *h = e->parent; h && n < PATH_MAX_DEPTH; h = h->parent)
		n++;
	int at = n;
	for (const struct Menu_Entry *h = e->parent; h && at > 0; h = h->parent)
		out[--at] = h;
	return n;
}

void desk_go_to(struct desk *d, const struct Menu_Entry *e)
{
	const struct Menu_Entry *heads[PATH_MAX_DEPTH];
	int n = heads_of(e, heads);

	if (!n)
		return;
	bool world = heads[0] == d->house.menus->menu[MENU_WORLD]->top;
	leave_form(d);
	if (world != d->in_world)
		desk_world_menu(d);
	memcpy(d->path, heads, (size_t)n * sizeof *heads);
	d->depth = n;
	shown(d);
	const struct Menu_Entry *entry[ENTRIES_MAX];
	int rows = desk_entries(d, entry);
	for (int i = 0; i < rows; i++)
		if (entry[i] == e)
			d->row_focus = i;
}

/* A name in a path: of a menu file its word, of others without what all in the main menu begin with. */
const char *desk_short_name(const struct desk *d, const struct Menu_Entry *e)
{
	static const char common[] = "GEOMETRY ";

	for (int i = 0; i < N_MENUS; i++)
		if (d->house.menus->menu[i]->top == e)
			return menu_root_word((enum menu_root)i);
	return strncmp(e->name, common, sizeof common - 1) ? e->name : e->name + sizeof common - 1;
}

const char *desk_path_text(struct desk *d, struct scraps *s, const struct Menu_Entry *e)
{
	const struct Menu_Entry *heads[PATH_MAX_DEPTH];
	int n = heads_of(e, heads);
	const char *out = "";

	for (int i = 0; i < n; i++)
		out = scraps_print(s, "%s%s%s", out, i ? " › " : "", desk_short_name(d, heads[i]));
	return out;
}

const struct Menu_Entry *desk_leaf(const struct desk *d, const char *code)
{
	return menu_set_find(d->house.menus, code, NULL);
}

/* A sub-menu is entered, a leaf asks for what it needs or runs. */
void desk_choose(struct desk *d, const struct Menu_Entry *e)
{
	if (desk_busy(d))
		return;
	if (d->page == PAGE_HELP || d->page == PAGE_KEYS || d->page == PAGE_MESSAGES)
		desk_set_page(d, PAGE_NONE);
	if (e->n_sub) {
		desk_enter(d, e);
		return;
	}
	const struct routine *t = desk_routine(e);
	if (!t) {
		desk_say(d, REPORT_ERROR, "%s names %s, and there is no such routine.", e->name,
		         e->index);
		return;
	}
	if (desk_leaf_own(d, e))
		return;
	const char *why = routine_greyed(t, d->world);
	if (why) {
		desk_say(d, REPORT_INFO, "%s: %s.", e->name, why);
		return;
	}
	leave_form(d);
	desk_ask(d, t, e);
}

bool desk_choose_key(struct desk *d, uint32_t c)
{
	const struct Menu_Entry *entry[ENTRIES_MAX];
	int n = desk_entries(d, entry);

	if (c >= 'a' && c <= 'd')
		c -= 'a' - 'A';
	for (int i = 0; i < n; i++)
		if ((uint32_t)row_keys[i] == c) {
			desk_choose(d, entry[i]);
			return true;
		}
	return false;
}
