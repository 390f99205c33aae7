/* entry.h - what the files of this folder share. */
#ifndef BATTEN_ENTRY_H
#define BATTEN_ENTRY_H

#include "menu.h"

/* An entry and all below it. */
void entry_destroy(struct Menu_Entry *e);

/* The menu files' bytes, made from them by embed.c. */
struct built_in {
	const char *text;
	size_t n;
};
extern const struct built_in built_in_menus[N_MENUS];

#endif
