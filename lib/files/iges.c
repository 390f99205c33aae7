/* iges.c - an IGES file as a model: every entity in turn, what is not read counted and named. */
#include "iges_reader.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* P lines an entity may be read again for those that use it, on the average. */
enum { BUDGET_A_LINE = 16, BUDGET_MORE = 100000 };

/* Types that are read on behalf of others: transforms, colors, directions. 0 is no entity. */
static const int helpers[] = { 0, 123, 124, 314 };

/* Why types are not read. The last row is for all others. */
static const struct {
	int from, to;
	const char *reason;
} skips[] = {
	{ 106, 106, "annotation, not geometry" },
	{ 125, 125, "flashes are not read" },
	{ 130, 130, "offset curves are not read" },
	{ 132, 132, "connect points are not read" },
	{ 134, 138, "finite elements are not read" },
	{ 141, 144, "trims are not read yet; the surface under it is read by itself" },
	{ 146, 148, "finite elements are not read" },
	{ 150, 184, "solids made of primitives are not read" },
	{ 186, 186, "solids are not read yet; the surfaces of their faces are read by themselves" },
	{ 192, 198, "surfaces given by formula are not read yet" },
	{ 202, 230, "annotation, not geometry" },
	{ 302, 320, "definitions (fonts, line styles, subfigures) are not read yet" },
	{ 402, 402,
	  "groups and associations are not read yet; their members are read by themselves" },
	{ 404, 404, "drawings are not read" },
	{ 406, 406, "properties other than names are not read" },
	{ 408, 408, "subfigures are not placed yet" },
	{ 410, 410, "views are not read" },
	{ 412, 422, "arrays, references and networks are not read" },
	{ 502, 514, "trims are not read yet; the surfaces of faces are read by themselves" },
	{ 0, 99999, "a type that batten does not know" },
};

static const char *skip_reason(int type)
{
	size_t i = 0;
	while (i < sizeof skips / sizeof skips[0] - 1 &&
	       (type < skips[i].from || type > skips[i].to))
		i++;
	return skips[i].reason;
}

static bool is_helper(const struct iges_entry *e)
{
	for (size_t i = 0; i < sizeof helpers / sizeof helpers[0]; i++)
		if (helpers[i] == e->type)
			return true;
	return e->type == 406 && e->form == 15;
}

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
	out->name = e->subscript ? text_print("%s.%d", e->label, e->subscript) : strdup(e->label);
	return out->name ? ST_OK : ST_RESOURCE;
}

/* 1 .. 8, or a 314 with red, green, blue in percent. A bad one is no color. */
static enum status set_color(struct iges *g, const struct iges_entry *e, struct entity *out)
{
	static const double standard[9][3] = {
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
			out->color[i] = fmin(fmax(iges_real(&c) / 100, 0), 1);
		st = c.st;
	}
	out->has_color = st == ST_OK;
	return st == ST_INPUT ? ST_OK : st;
}

static enum status set_faces(struct iges *g, const struct iges_entry *e, struct entity *out)
{
	enum status st = ST_OK;
	out->trims = e->trims;
	for (int i = e->first_face; i >= 0 && st == ST_OK; i = g->faces[i].next)
		st = entity_add_face(out, g->faces[i].de);
	/* the list runs from the last to the first */
	for (int i = 0, j = out->n_faces - 1; i < j; i++, j--) {
		int de = out->faces[i];
		out->faces[i] = out->faces[j];
		out->faces[j] = de;
	}
	return st;
}

static enum status read_geometry(struct iges *g, int de, struct entity *out)
{
	struct iges_cursor c;
	const struct iges_entry *e = iges_entry(g, de);
	enum status st;
	g->reason[0] = g->store.error[0] = '\0';
	g->at = de;
	if (iges_is_surface(e)) {
		entity_init(out, ENTITY_SURFACE);
		st = iges_surface(g, de, 0, &out->geometry, &c);
	} else if (iges_is_curve(e)) {
		entity_init(out, ENTITY_CURVE);
		st = iges_curve(g, de, 0, &out->curve, &c);
	} else {
		entity_init(out, ENTITY_POINTS);
		st = iges_points(g, de, &out->points, &c);
	}
	if (st == ST_OK)
		st = set_label(e, out);
	if (st == ST_OK)
		st = read_properties(&c, out);
	if (st == ST_OK)
		st = set_color(g, e, out);
	if (st == ST_OK)
		st = set_faces(g, e, out);
	return st;
}

static enum status read_entity(struct iges *g, int de)
{
	struct entity out;
	const struct iges_entry *e = iges_entry(g, de);
	enum status st = read_geometry(g, de, &out);
	if (st == ST_OK) {
		out.de = de;
		out.source_type = e->type;
		out.used = e->used && out.kind != ENTITY_SURFACE;
		if (e->blanked)
			iges_warn(g, WARN_BLANKED, de);
		return model_add(g->m, &out);
	}
	entity_finish(&out);
	if (st != ST_INPUT)
		return st;
	return model_skip(g->m, e->type, de, g->reason);
}

/* Points come last, so that the numbers of curves and surfaces do not depend on them. */
static enum status read_entities(struct iges *g)
{
	enum status st = ST_OK;
	for (int points = 0; points < 2; points++)
		for (int i = 0; i < g->n_entries && st == ST_OK; i++) {
			const struct iges_entry *e = &g->entries[i];
			bool shape = iges_is_curve(e) || iges_is_surface(e);
			if (points ? iges_is_points(e) : shape)
				st = read_entity(g, 2 * i + 1);
			else if (!points && !iges_is_points(e) && !is_helper(e))
				st = model_skip(g->m, e->type, 2 * i + 1, skip_reason(e->type));
			if (st == ST_OK && (i & 0xff) == 0xff)
				st = progress_step(g->progress,
				                   g->n_p ? (double)g->far / g->n_p : 0);
		}
	return st;
}

/* The T line counts the lines of each section: fewer here means that some are lost. */
static enum status check_counts(struct iges *g)
{
	int d = 0, p = 0;
	const char *at_d = strchr(g->terminate, 'D'), *at_p = strchr(g->terminate, 'P');
	if (!at_d || !at_p || sscanf(at_d, "D%7d", &d) != 1 || sscanf(at_p, "P%7d", &p) != 1)
		return ST_OK;
	if (d <= g->n_d && p <= g->n_p)
		return ST_OK;
	return model_warn(g->m,
	                  "lines are missing: the last line counts %d in the directory and %d of "
	                  "parameters, there are %d and %d",
	                  d, p, g->n_d, g->n_p);
}

static enum status read_all(struct iges *g)
{
	enum status st = iges_read_header(g);
	if (st == ST_OK)
		st = check_counts(g);
	if (st == ST_OK)
		st = iges_read_directory(g);
	g->budget = (int64_t)BUDGET_A_LINE * g->n_p + BUDGET_MORE;
	if (st == ST_OK)
		st = iges_find_uses(g);
	g->budget = (int64_t)BUDGET_A_LINE * g->n_p + BUDGET_MORE;
	if (st == ST_OK)
		st = read_entities(g);
	if (st == ST_OK)
		st = iges_say_warnings(g);
	return st;
}

static enum status say_nothing_read(const struct iges *g)
{
	const struct skipped *s = g->m->skipped;
	if (g->m->n_skipped == 0)
		return report_error(g->r, ST_INPUT, "cannot read '%s': it holds no entities",
		                    g->name);
	return report_error(g->r, ST_INPUT,
	                    "cannot read '%s': no curve, surface or point in it could be read; the "
	                    "first thing skipped is D%d of type %d: %s",
	                    g->name, s->first_de, s->type, s->reason);
}

enum status iges_parse(struct model *m, const char *bytes, size_t n, const char *name,
                       const struct progress *p, const struct report *r)
{
	struct iges g = { .bytes = bytes, .n = n, .name = name, .m = m, .progress = p, .r = r };
	report_store_init(&g.store);
	enum status st = iges_index(&g);
	if (st == ST_OK) {
		st = read_all(&g);
		if (st == ST_RESOURCE)
			report_error(r, st, "cannot read '%s': no memory", name);
	}
	if (st == ST_OK && m->n == 0)
		st = say_nothing_read(&g);
	if (st == ST_OK)
		model_number(m);
	text_finish(&g.global);
	free(g.d_lines);
	free(g.p_lines);
	free(g.entries);
	free(g.first_lines);
	free(g.faces);
	free(g.bounds);
	free(g.edges.curves);
	return st;
}
