/* iges_names.c - names and colors of entities: labels, properties 406 form 15, 314. */
#include "iges_reader.h"

#include <stdlib.h>
#include <string.h>

/* The name in property `de` if it is one (406 form 15); replaces the one there. */
static enum status take_name(struct iges *g, int de, struct entity *out)
{
	struct iges_cursor c;
	struct text name = { 0 };
	const struct iges_entry *e = iges_entry(g, de);
	if (!e || e->type != 406 || e->form != 15)
		return ST_OK;
	enum status st = iges_open(g, de, 406, &c);
	if (st != ST_OK)
		return st;
	iges_int(&c); /* how many properties: 1 */
	iges_string(&c, &name);
	while (name.n && name.s[name.n - 1] == ' ')
		name.s[--name.n] = '\0';
	st = c.st;
	if (name.failed)
		st = ST_RESOURCE;
	if (st == ST_OK && name.n)
		st = model_set_text(&out->name, name.s);
	text_finish(&name);
	return st;
}

/* Behind the parameters: pointers to associations and texts, then those to properties. */
static enum status read_properties(struct iges_cursor *c, struct entity *out)
{
	enum status st = ST_OK;
	for (int list = 0; list < 2 && !c->ended; list++) {
		int n = iges_count(c, "number of pointers", 0, iges_left(c));
		for (int i = 0; i < n && c->st == ST_OK && st == ST_OK && !c->ended; i++) {
			int de = iges_int(c);
			if (list == 1)
				st = take_name(c->g, de, out);
		}
	}
	if (st == ST_OK && (c->st == ST_CANCELLED || c->st == ST_RESOURCE))
		st = c->st;
	return st == ST_INPUT ? ST_OK : st; /* a name lost is no geometry lost */
}

/* The label of the directory, "HULL" or, with a subscript, "HULL.3". */
static enum status set_label(const struct iges_entry *e, struct entity *out)
{
	if (!e->label[0])
		return ST_OK;
	out->name = e->subscript ? text_print("%.8s.%d", e->label, e->subscript)
	                         : strndup(e->label, sizeof e->label);
	return out->name ? ST_OK : ST_RESOURCE;
}

/* 1 .. 8, or a 314 with red, green, blue in percent. A bad one is no color. */
enum status iges_color(struct iges *g, int de, struct entity *out)
{
	const struct iges_entry *e = iges_entry(g, de);
	static const float standard[9][3] = {
		[1] = { 0, 0, 0 }, [2] = { 1, 0, 0 }, [3] = { 0, 1, 0 }, [4] = { 0, 0, 1 },
		[5] = { 1, 1, 0 }, [6] = { 1, 0, 1 }, [7] = { 0, 1, 1 }, [8] = { 1, 1, 1 },
	};
	struct iges_cursor c;
	if (e->color >= 1 && e->color <= 8) {
		memcpy(out->color, standard[e->color], sizeof out->color);
		out->has_color = true;
	}
	if (e->color >= 0)
		return ST_OK;
	enum status st = iges_open(g, -e->color, 314, &c);
	if (st == ST_OK) {
		for (int i = 0; i < 3; i++)
			out->color[i] = (float)fmin(fmax(iges_real(&c) / 100, 0), 1);
		st = c.st;
	}
	out->has_color = st == ST_OK;
	return st == ST_INPUT ? ST_OK : st;
}

enum status iges_name_behind(struct iges_cursor *c, struct entity *out)
{
	enum status st = set_label(iges_entry(c->g, c->de), out);
	return st == ST_OK ? read_properties(c, out) : st;
}

/* Behind the own parameters of a face or a 142. */
static void skip_face(struct iges_cursor *c, int type)
{
	if (type == 142) {
		for (int i = 0; i < 5; i++)
			iges_int(c);
		return;
	}
	if (type != 510)
		iges_int(c);
	iges_int(c);
	int n = iges_count(c, "count", 0, iges_left(c));
	if (type != 143)
		iges_int(c);
	for (int i = 0; i < n; i++)
		iges_int(c);
}

enum status iges_name(struct iges *g, int de, struct entity *out)
{
	struct iges_cursor c;
	enum status st = iges_open(g, de, 0, &c);
	if (st != ST_OK)
		return st == ST_INPUT ? ST_OK : st;
	skip_face(&c, iges_entry(g, de)->type);
	return iges_name_behind(&c, out);
}
