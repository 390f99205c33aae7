/* fuzz_menu.c - libFuzzer target: any bytes are a menu or are refused with one sentence, and what is a
 * menu is written and read again the same. */
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "menu.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

static void check_tree(const struct menu *m)
{
	for (const struct Menu_Entry *e = m->top; e; e = menu_next(e)) {
		if (strlen(e->name) > MENU_NAME_MAX || strlen(e->title) > MENU_NAME_MAX)
			abort();
		if (e->n_sub == 1 || e->n_sub > MENU_SUB_MAX || !menu_find(m, e->index))
			abort();
		if (e->index[0] != (menu_is_leaf(e) ? 'V' : 'N'))
			abort();
		for (int k = 0; k < e->n_sub; k++)
			if (e->sub[k]->parent != e)
				abort();
	}
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	const char *text = n ? (const char *)data : ""; /* no bytes come as NULL */
	struct report_store store;
	struct menu *m, *again;

	report_store_init(&store);
	if (menu_parse(&m, text, n, "fuzz", &store.report) != ST_OK) {
		if (m || store.n_errors != 1)
			abort();
		return 0;
	}
	check_tree(m);
	char *once = menu_write(m);
	if (!once || menu_parse(&again, once, strlen(once), "again", NULL) != ST_OK)
		abort();
	char *twice = menu_write(again);
	if (!twice || strcmp(once, twice) != 0)
		abort();
	free(once);
	free(twice);
	menu_destroy(m);
	menu_destroy(again);
	return 0;
}
