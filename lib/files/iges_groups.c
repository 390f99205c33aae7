/* iges_groups.c - names of groups (402 forms 1 7 14 15) as an attribute of their members. */
#include "iges_reader.h"

#include <stdlib.h>

/* Members that no group before has. The name is moved into g. */
static enum status add_group(struct iges *g, struct iges_cursor *members, int n, char *name)
{
	if ((g->n_groups & (g->n_groups - 1)) == 0) {
		void *p = reallocarray(g->group_names, g->n_groups ? (size_t)g->n_groups * 2 : 1,
		                       sizeof *g->group_names);
		if (!p) {
			free(name);
			return ST_RESOURCE;
		}
		g->group_names = p;
	}
	g->group_names[g->n_groups] = name;
	for (int i = 0; i < n && members->st == ST_OK; i++) {
		struct iges_entry *e = iges_entry(g, iges_int(members));
		if (e && e->group < 0)
			e->group = g->n_groups;
	}
	g->n_groups++;
	return members->st == ST_INPUT ? ST_OK : members->st;
}

/* Its name stands behind its members. */
static enum status find_group(struct iges *g, int de)
{
	struct iges_cursor c, members;
	struct entity named;
	enum status st = iges_open(g, de, 402, &c);
	int n = st == ST_OK ? iges_count(&c, "count", 0, iges_left(&c)) : 0;
	members = c;
	for (int i = 0; i < n && c.st == ST_OK; i++)
		iges_int(&c);
	if (st == ST_OK)
		st = c.st;
	entity_init(&named, ENTITY_POINTS);
	if (st == ST_OK)
		st = iges_name_behind(&c, &named);
	if (st == ST_OK && named.name) {
		st = add_group(g, &members, n, named.name);
		named.name = NULL;
	}
	entity_finish(&named);
	return st == ST_INPUT ? ST_OK : st; /* a name lost is no geometry lost */
}

enum status iges_find_groups(struct iges *g)
{
	enum status st = ST_OK;
	g->quiet = true;
	for (int i = 0; i < g->n_entries && st == ST_OK; i++)
		if (iges_is_group(iges_entry(g, 2 * i + 1))) {
			g->at = 2 * i + 1;
			st = find_group(g, g->at);
		}
	g->quiet = false;
	return st;
}

enum status iges_group(struct iges *g, int de, struct entity *out)
{
	const struct iges_entry *e = iges_entry(g, de);
	if (e->group < 0 || entity_get_attribute(out, "group"))
		return ST_OK;
	return entity_set_attribute(out, "group", g->group_names[e->group]);
}

void iges_finish_groups(struct iges *g)
{
	for (int i = 0; i < g->n_groups; i++)
		free(g->group_names[i]);
	free(g->group_names);
}
