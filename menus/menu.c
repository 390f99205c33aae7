/* menu.c - the tree of entries: walked, searched, named, written, freed. */
#include "menu.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "entry.h"
#include "text.h"

#define X(word, file) #word,
static const char *const root_words[N_MENUS] = { MENU_ROOTS(X) };
#undef X
#define X(word, file) file,
static const char *const root_files[N_MENUS] = { MENU_ROOTS(X) };
#undef X

const char *menu_root_word(enum menu_root root)
{
	return root_words[root];
}

const char *menu_root_file(enum menu_root root)
{
	return root_files[root];
}

void entry_destroy(struct Menu_Entry *e)
{
	if (!e)
		return;
	for (int k = 0; k < e->n_sub; k++)
		entry_destroy(e->sub[k]);
	free(e->sub);
	free(e);
}

void menu_destroy(struct menu *m)
{
	if (!m)
		return;
	entry_destroy(m->top);
	free(m->source);
	free(m);
}

static int place_in_parent(const struct Menu_Entry *e)
{
	int k = 0;

	while (e->parent->sub[k] != e)
		k++;
	return k;
}

struct Menu_Entry *menu_next(const struct Menu_Entry *e)
{
	if (e->n_sub)
		return e->sub[0];
	for (; e->parent; e = e->parent) {
		int k = place_in_parent(e) + 1;

		if (k < e->parent->n_sub)
			return e->parent->sub[k];
	}
	return NULL;
}

struct Menu_Entry *menu_next_leaf(const struct menu *m, const struct Menu_Entry *e)
{
	struct Menu_Entry *next = e ? menu_next(e) : m->top;

	while (next && !menu_is_leaf(next))
		next = menu_next(next);
	return next;
}

struct Menu_Entry *menu_find(const struct menu *m, const char *index)
{
	struct Menu_Entry *e = m->top;

	while (e && strcmp(e->index, index) != 0)
		e = menu_next(e);
	return e;
}

static void add_path(struct text *t, enum menu_root root, const struct Menu_Entry *e)
{
	if (!e->parent) {
		text_add(t, menu_root_word(root));
		return;
	}
	add_path(t, root, e->parent);
	text_addf(t, " > %s", e->name);
}

char *menu_path(enum menu_root root, const struct Menu_Entry *e)
{
	struct text t = { 0 };

	add_path(&t, root, e);
	return text_take(&t);
}

static void write_line(struct text *t, int depth, const char *s)
{
	text_addf(t, "%*s%s\n", 2 * depth, "", s);
}

char *menu_write(const struct menu *m)
{
	struct text t = { 0 };

	for (const struct Menu_Entry *e = m->top; e; e = menu_next(e)) {
		char count[16];
		int depth = 0;

		for (const struct Menu_Entry *p = e->parent; p; p = p->parent)
			depth++;
		snprintf(count, sizeof count, "%d", menu_is_leaf(e) ? 1 : e->n_sub);
		write_line(&t, depth, count);
		write_line(&t, depth, e->name);
		if (!menu_is_leaf(e))
			write_line(&t, depth, e->title);
		write_line(&t, depth, e->index);
	}
	text_add(&t, "0\nEND MENU\n");
	return text_take(&t);
}
