/* menu.h - the menus as files: a tree of entries, its parser, and the four menus of the program. */
#ifndef BATTEN_MENU_H
#define BATTEN_MENU_H

#include <stdbool.h>
#include <stddef.h>

#include "report.h"

enum {
	MENU_NAME_MAX = 40, /* bytes of UTF-8 in a name or a title */
	MENU_SUB_MAX = 14,  /* entries of one menu: what the panel has room and digits for */
	MENU_DEPTH_MAX = 16,
	MENU_INDEX_SIZE = 8, /* a letter, up to 4 digits, the zero byte; rounded up */
};

/* One line of a menu. A leaf has no entries of its own; its index names a routine (V79). A menu's
 * index (N31) names its help. */
struct Menu_Entry {
	char name[MENU_NAME_MAX + 1];  /* as a line of the menu above */
	char title[MENU_NAME_MAX + 1]; /* as the head of its own menu; "" for a leaf */
	char index[MENU_INDEX_SIZE];
	struct Menu_Entry *parent; /* borrowed; NULL at the top */
	struct Menu_Entry **sub;   /* owned; n_sub of them */
	int n_sub;                 /* 0 for a leaf, else 2 to MENU_SUB_MAX */
	int line;                  /* of its index, in its file */
};

/* The menus of the program; the word is how a path begins. */
#define MENU_ROOTS(X)                                                                              \
	X(MAIN, "main.menu")                                                                       \
	X(UV, "uv.menu")                                                                           \
	X(COSFAIR, "cosfair.menu")                                                                 \
	X(WORLD, "world.menu")

#define X(word, file) MENU_##word,
enum menu_root { MENU_ROOTS(X) N_MENUS };
#undef X

const char *menu_root_word(enum menu_root root); /* "MAIN"; static */
const char *menu_root_file(enum menu_root root); /* "main.menu"; static */

/* One file. */
struct menu {
	struct Menu_Entry *top; /* owned */
	char *source;           /* owned; the file's name, "built in" for ours */
};

/*
 * Take n bytes of a menu file apart. `source` names them in sentences.
 * Owner:  *out is the caller's, ended by menu_destroy.
 * Errors: ST_INPUT (with source, line, what was found and what was expected), ST_RESOURCE.
 */
enum status menu_parse(struct menu **out, const char *text, size_t n, const char *source,
                       const struct report *r);
enum status menu_read(struct menu **out, const char *path, const struct report *r);
/* The copy that the program carries. Errors: ST_RESOURCE. */
enum status menu_read_built_in(struct menu **out, enum menu_root root, const struct report *r);
void menu_destroy(struct menu *m);

/* The file's text again, indented; caller frees. NULL: memory ran out. */
char *menu_write(const struct menu *m);

/* First entry of that index ("V79", "N31"), in the order of the file; NULL where there is none. */
struct Menu_Entry *menu_find(const struct menu *m, const char *index);

/* The entry behind e when the tree is walked from the top, each menu before its entries; NULL at
 * the end. Begin with m->top. */
struct Menu_Entry *menu_next(const struct Menu_Entry *e);
/* Likewise leaves only; NULL begins. */
struct Menu_Entry *menu_next_leaf(const struct menu *m, const struct Menu_Entry *e);

static inline bool menu_is_leaf(const struct Menu_Entry *e)
{
	return !e->n_sub;
}

/* The four menus, each from the first of several folders that has its file. A broken file is told
 * in `complaint` and the built-in copy stands in for it. */
struct menu_set {
	struct menu *menu[N_MENUS];
	char *complaint[N_MENUS]; /* owned; the sentence about a broken file, else NULL */
};

/*
 * Read the menus from the project's .batten/menus, $XDG_CONFIG_HOME/batten/menus, the folder
 * installed or built with the program, or, where none has the file, from what the program carries.
 * `project` is the project folder, NULL for none. A broken file is no failure.
 * Owner:  *set is ended by menu_set_finish, after a failure, too.
 * Errors: ST_RESOURCE.
 */
enum status menu_set_load(struct menu_set *set, const char *project, const struct report *r);

/* Likewise from these folders, first one first. */
enum status menu_set_read(struct menu_set *set, const char *const *folders, size_t n_folders,
                          const struct report *r);
void menu_set_finish(struct menu_set *set);

/* First entry of that index over all menus, and (root may be NULL) which menu it is of. */
struct Menu_Entry *menu_set_find(const struct menu_set *set, const char *index,
                                 enum menu_root *root);

/* "MAIN > GEOMETRY INTERROGATION > SURFACE"; e must be of the menu `root`. Caller frees; NULL:
 * memory ran out. */
char *menu_path(enum menu_root root, const struct Menu_Entry *e);

#endif
