/* desk_search.c - a routine found by name, code or what its help says. */
#include <stdlib.h>

#include "desk_inside.h"

static void changed(struct desk *d)
{
	desk_dirty(d, desk_bit(PART_PAGE) | desk_bit(PART_FOOT));
}

/* Can it be done now? */
static bool can_run(const struct desk *d, const struct Menu_Entry *e)
{
	const struct routine *t = desk_routine(e);

	return !t || desk_leaf_is_own(e->index) || !routine_greyed(t, d->world);
}

/* Among those whose names fit alike what can be done now stands first: Enter runs the first. */
static void take(struct desk *d, const struct help_hit *hits, size_t n)
{
	d->n_found = 0;
	for (size_t from = 0, to; from < n; from = to) {
		for (to = from; to < n && hits[to].score == hits[from].score;)
			to++;
		for (int greyed = 0; greyed < 2; greyed++)
			for (size_t i = from; i < to; i++) {
				const struct Menu_Entry *e = desk_leaf(d, hits[i].text->code);
				if (e && e->parent && can_run(d, e) == !greyed &&
				    d->n_found < FOUND_MAX)
					d->found[d->n_found++] = e;
			}
	}
}

void desk_search_changed(struct desk *d)
{
	struct help_hit *hits = calloc(help_count(d->house.help) + 1, sizeof *hits);
	const struct help *h = d->house.help;
	const bool ask = hits && d->search.n;

	take(d, hits, ask ? help_search(h, d->house.menus, d->search.s, hits, help_count(h)) : 0);
	d->found_near = ask && !d->n_found;
	if (d->found_near)
		take(d, hits, help_nearest(h, d->house.menus, d->search.s, hits, NEAREST_MAX));
	d->found_chosen = d->found_near ? -1 : 0; /* a guess is not run by Enter alone */
	free(hits);
	changed(d);
}

void desk_search_open(struct desk *d)
{
	if (d->page == PAGE_QUESTION)
		return;
	d->under = d->page == PAGE_SEARCH ? d->under : d->page;
	typed_set(&d->search, "");
	desk_set_page(d, PAGE_SEARCH);
	desk_search_changed(d);
}

/* Enter runs it, Tab goes to the menu it is in. */
void desk_search_take(struct desk *d, int k, bool go)
{
	if (k < 0 || k >= d->n_found || k >= RESULTS_MAX)
		return;
	const struct Menu_Entry *e = d->found[k];
	if (desk_busy(d))
		return;
	d->under = PAGE_NONE;
	desk_set_page(d, PAGE_NONE);
	desk_go_to(d, e);
	if (!go)
		desk_choose(d, e);
}

bool desk_search_key(struct desk *d, enum desk_key key)
{
	int n = d->n_found < RESULTS_MAX ? d->n_found : RESULTS_MAX;
	struct typed *t = &d->search;

	switch ((int)key) {
	case KEY_UP:
		d->found_chosen = n ? (d->found_chosen > 0 ? d->found_chosen : n) - 1 : 0;
		break;
	case KEY_DOWN:
		d->found_chosen = n ? (d->found_chosen + 1) % n : 0;
		break;
	case KEY_ENTER:
		desk_search_take(d, d->found_chosen, false);
		return true;
	case KEY_TAB:
		desk_search_take(d, d->found_chosen, true);
		return true;
	case KEY_LEFT:
		typed_left(t);
		break;
	case KEY_RIGHT:
		typed_right(t);
		break;
	case KEY_HOME:
		typed_home(t);
		break;
	case KEY_END:
		typed_end(t);
		break;
	case KEY_BACKSPACE:
		if (typed_backspace(t))
			desk_search_changed(d);
		break;
	case KEY_DELETE:
		if (typed_delete(t))
			desk_search_changed(d);
		break;
	case KEY_CTRL_A + 'U' - 'A':
		if (typed_clear(t))
			desk_search_changed(d);
		break;
	default:
		return false;
	}
	changed(d);
	return true;
}
