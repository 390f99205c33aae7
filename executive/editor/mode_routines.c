/* mode_routines.c - the leaves of the menus as a table or as JSON. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "menu.h"
#include "modes.h"
#include "routine.h"
#include "text.h"

/* "MAIN > GEOMETRY INTERROGATION > SURFACE > CURVATURE > GAUSSIAN"; NULL: in no menu. Fresh. */
static char *path_of(const struct menu_set *menus, const char *code)
{
	enum menu_root root;
	struct Menu_Entry *e = menu_set_find(menus, code, &root);

	return e ? menu_path(root, e) : NULL;
}

static json_t *with_paths(json_t *routines, const struct menu_set *menus)
{
	json_t *list = json_array(), *o;
	size_t k;

	json_array_foreach(routines, k, o)
	{
		char *path = path_of(menus, json_text(o, "code", ""));
		json_t *one = json_object();
		json_object_set(one, "code", json_object_get(o, "code"));
		json_set_text(one, "path", path);
		json_object_update_missing(one, o);
		json_array_append_new(list, one);
		free(path);
	}
	json_decref(routines);
	return list;
}

static int print_json(json_t *routines)
{
	json_t *all = json_pack("{s:i, s:o}", "version", 1, "routines", routines);
	char *text = all ? json_write(all, true) : NULL;
	const bool good = text && puts(text) >= 0 && !fflush(stdout);

	free(text);
	json_decref(all);
	return good ? 0 : status_exit(ST_RESOURCE);
}

static void print_arguments(const json_t *routine)
{
	size_t k;
	json_t *o;

	json_array_foreach(json_object_get(routine, "arguments"), k, o)
	{
		const char *def = json_text(o, "default", NULL), *unit = json_text(o, "unit", NULL);
		const bool optional = json_flag(o, "optional", false);
		printf("  %-16s %-9s %s%s%s", json_text(o, "name", ""), json_text(o, "type", ""),
		       json_text(o, "help", ""), unit ? ", " : "", unit ? unit : "");
		if (def)
			printf(" (default %s)", def);
		puts(def || optional ? "" : " (needed)");
	}
}

static void print_table(const json_t *routines, const char *only)
{
	size_t k;
	json_t *o;

	json_array_foreach(routines, k, o)
	{
		const char *path = json_text(o, "path", "");
		if (only && strcmp(only, json_text(o, "code", "")))
			continue;
		printf("%-5s%-9s%s%s\n", json_text(o, "code", ""), json_text(o, "kind", ""), path,
		       json_flag(o, "available", false) ? "" : "  (later)");
		if (only)
			print_arguments(o);
	}
	if (!only)
		puts("\nbatten routines CODE shows what it asks for.");
}

int mode_routines(int argc, char **argv)
{
	const struct report r = report_stderr("batten routines");
	const char *only = NULL;
	struct project project = { 0 };
	struct menu_set menus = { 0 };
	struct world *world = NULL;
	bool json = false;
	int rc;

	for (int k = 0; k < argc; k++)
		if (!strcmp(argv[k], "--json"))
			json = true;
		else
			only = argv[k];
	if (only && !routine_find(only))
		return status_exit(
		        report_error(&r, ST_PARAMETER,
		                     "there is no routine '%s'; batten routines lists them", only));
	enum status st = project_find(&project, NULL, &r);
	if (st == ST_OK)
		st = world_create(&world, project.folder);
	if (st == ST_OK)
		st = menu_set_load(&menus, project.folder, &r);
	rc = status_exit(st);
	if (st == ST_OK) {
		struct act a = { .world = world, .project = &project, .report = r, .wait = true };
		json_t *routines = with_paths(routines_describe(&a), &menus);
		if (json)
			rc = print_json(routines);
		else {
			print_table(routines, only);
			json_decref(routines);
		}
	}
	menu_set_finish(&menus);
	world_destroy(world);
	project_finish(&project);
	return rc;
}
