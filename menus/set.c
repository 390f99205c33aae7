/* set.c - the four menus: from the user's folders, the program's, or what the program carries. */
#include <stdlib.h>
#include <string.h>

#include "menu.h"
#include "path.h"
#include "text.h"

/* The first folder's file that is there; *path is NULL where none is. */
static enum status find_file(const char *const *folders, size_t n, enum menu_root root, char **path,
                             const struct report *r)
{
	*path = NULL;
	for (size_t k = 0; k < n; k++) {
		*path = path_join(folders[k], menu_root_file(root));
		if (!*path)
			return report_error(r, ST_RESOURCE,
			                    "cannot read the menus: memory ran out");
		if (path_exists(*path))
			return ST_OK;
		free(*path);
		*path = NULL;
	}
	return ST_OK;
}

static enum status read_one(struct menu_set *set, enum menu_root root, const char *path,
                            const struct report *r)
{
	struct report_store store;

	report_store_init(&store);
	enum status st = path ? menu_read(&set->menu[root], path, &store.report) : ST_INPUT;
	if (st == ST_OK)
		return ST_OK;
	if (path) {
		set->complaint[root] = text_print("%s; the built-in menu stands in", store.error);
		if (!set->complaint[root])
			return report_error(r, ST_RESOURCE,
			                    "cannot read the menus: memory ran out");
	}
	return menu_read_built_in(&set->menu[root], root, r);
}

enum status menu_set_read(struct menu_set *set, const char *const *folders, size_t n_folders,
                          const struct report *r)
{
	memset(set, 0, sizeof *set);
	for (int k = 0; k < N_MENUS; k++) {
		char *path;
		enum status st = find_file(folders, n_folders, (enum menu_root)k, &path, r);

		if (st == ST_OK)
			st = read_one(set, (enum menu_root)k, path, r);
		free(path);
		if (st != ST_OK)
			return st;
	}
	return ST_OK;
}

static char *config_folder(void)
{
	const char *config = getenv("XDG_CONFIG_HOME"), *home = getenv("HOME");

	if (config && config[0] == '/')
		return path_join(config, "batten/menus");
	return home && *home ? path_join(home, ".config/batten/menus") : NULL;
}

enum status menu_set_load(struct menu_set *set, const char *project, const struct report *r)
{
	char *program = path_of_program();
	char *folders[] = {
		project ? path_join(project, ".batten/menus") : NULL,
		config_folder(),
		program ? path_join(program, "../menus") : NULL, /* the build tree */
		program ? path_join(program, "../share/batten/menus") : NULL,
	};
	const char *there[sizeof folders / sizeof *folders];
	size_t n = 0;

	for (size_t k = 0; k < sizeof folders / sizeof *folders; k++)
		if (folders[k])
			there[n++] = folders[k];
	enum status st = menu_set_read(set, there, n, r);
	for (size_t k = 0; k < sizeof folders / sizeof *folders; k++)
		free(folders[k]);
	free(program);
	return st;
}

void menu_set_finish(struct menu_set *set)
{
	for (int k = 0; k < N_MENUS; k++) {
		menu_destroy(set->menu[k]);
		free(set->complaint[k]);
	}
	memset(set, 0, sizeof *set);
}

struct Menu_Entry *menu_set_find(const struct menu_set *set, const char *index,
                                 enum menu_root *root)
{
	for (int k = 0; k < N_MENUS; k++) {
		struct Menu_Entry *e = set->menu[k] ? menu_find(set->menu[k], index) : NULL;

		if (e) {
			if (root)
				*root = (enum menu_root)k;
			return e;
		}
	}
	return NULL;
}
