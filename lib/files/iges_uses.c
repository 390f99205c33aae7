/* iges_uses.c - which entities are parts of others, and which curves bound the faces on a plane that
 * has no bounds of its own. */
#include "iges_reader.h"

#include <limits.h>
#include <stdlib.h>

static void use(struct iges *g, int de)
{
	struct iges_entry *e = iges_entry(g, abs(de));
	if (e)
		e->used = true;
}

/* A curve in space bounds a face on `surface`; kept for planes only. */
static enum status add_bound(struct iges *g, int surface, int curve)
{
	struct iges_entry *e = iges_entry(g, surface);
	if (!e || (e->type != 108 && e->type != 190) || !iges_entry(g, curve))
		return ST_OK;
	if ((g->n_bounds & (g->n_bounds - 1)) == 0) {
		void *p = reallocarray(g->bounds, g->n_bounds ? (size_t)g->n_bounds * 2 : 1,
		                       sizeof *g->bounds);
		if (!p)
			return ST_RESOURCE;
		g->bounds = p;
	}
	g->bounds[g->n_bounds] = (struct iges_bound){ curve, e->first_edge };
	e->first_edge = g->n_bounds++;
	return ST_OK;
}

static bool is_plane(struct iges *g, int de)
{
	const struct iges_entry *e = iges_entry(g, de);
	return e && (e->type == 108 || e->type == 190);
}

/* Pointers in parameters from .. to - 1 (from 0, behind the type number). */
static void use_fixed(struct iges_cursor *c, int from, int to)
{
	for (int i = 0; i < to; i++) {
		double x = iges_real(c);
		if (i >= from && fabs(x) < INT_MAX)
			use(c->g, (int)x);
	}
}

static void use_list(struct iges_cursor *c)
{
	int n = iges_count(c, "count", 0, iges_left(c));
	for (int i = 0; i < n && c->st == ST_OK; i++)
		use(c->g, iges_int(c));
}

static enum status uses_subfigure(struct iges_cursor *c)
{
	struct text name = { 0 };
	iges_int(c);
	iges_string(c, &name);
	text_finish(&name);
	use_list(c);
	return ST_OK;
}

/* 228: note, geometry, leaders. */
static enum status uses_symbol(struct iges_cursor *c)
{
	iges_int(c);
	use_list(c);
	use_list(c);
	return ST_OK;
}

/* 230: outer boundary, pattern, point, distance, angle, islands. */
static enum status uses_section(struct iges_cursor *c)
{
	use_fixed(c, 0, 1);
	use_fixed(c, 6, 6);
	use_list(c);
	return ST_OK;
}

/* 141: type, preference, surface, curves with sense and their curves in u, v. */
static enum status uses_boundary(struct iges_cursor *c)
{
	iges_int(c), iges_int(c), iges_int(c);
	int n = iges_count(c, "count", 0, iges_left(c));
	for (int i = 0; i < n && c->st == ST_OK; i++) {
		use(c->g, iges_int(c));
		iges_int(c);
		use_list(c);
	}
	return ST_OK;
}

/* 142: how made, surface, curve in u, v, curve in space. */
static enum status uses_curve_on_surface(struct iges_cursor *c)
{
	use_fixed(c, 2, 4);
	return ST_OK;
}

/* 504: curve, and list and place of its two vertices. */
static enum status uses_edges(struct iges_cursor *c)
{
	int n = iges_count(c, "count", 0, iges_left(c));
	for (int i = 0; i < n && c->st == ST_OK; i++)
		use_fixed(c, 0, 2), use_fixed(c, 1, 2), use_fixed(c, 1, 1);
	return ST_OK;
}

/* 508: edges, each with its list and its curves in u, v. */
static enum status uses_loop(struct iges_cursor *c)
{
	int n = iges_count(c, "count", 0, iges_left(c));
	for (int i = 0; i < n && c->st == ST_OK; i++) {
		use_fixed(c, 1, 2), use_fixed(c, 2, 2);
		int k = iges_count(c, "count", 0, iges_left(c));
		for (int j = 0; j < k && c->st == ST_OK; j++)
			use_fixed(c, 1, 2);
	}
	return ST_OK;
}

static enum status bound_by_141(struct iges *g, int surface, int de)
{
	struct iges_cursor c;
	enum status st = iges_open(g, de, 141, &c);
	if (st != ST_OK)
		return st;
	iges_int(&c), iges_int(&c), iges_int(&c);
	int n = iges_count(&c, "count", 0, iges_left(&c));
	for (int i = 0; i < n && st == ST_OK && c.st == ST_OK; i++) {
		st = add_bound(g, surface, iges_int(&c));
		iges_int(&c);
		int k = iges_count(&c, "count", 0, iges_left(&c));
		for (int j = 0; j < k && c.st == ST_OK; j++)
			iges_int(&c);
	}
	return st;
}

static enum status bound_by_142(struct iges *g, int surface, int de)
{
	struct iges_cursor c;
	enum status st = iges_open(g, de, 142, &c);
	if (st != ST_OK)
		return st;
	iges_int(&c), iges_int(&c), iges_int(&c);
	return add_bound(g, surface, iges_int(&c));
}

/* The curves of an edge list 504 at hand: loops look them up by place. */
static enum status load_edges(struct iges *g, int list)
{
	struct iges_cursor c;
	enum status st = iges_open(g, list, 504, &c);
	if (st != ST_OK)
		return st;
	int n = iges_count(&c, "count", 0, iges_left(&c));
	int *curves = calloc(n ? (size_t)n : 1, sizeof *curves);
	if (!curves)
		return ST_RESOURCE;
	for (int i = 0; i < n && c.st == ST_OK; i++) {
		curves[i] = iges_int(&c);
		for (int k = 0; k < 4; k++)
			iges_int(&c);
	}
	free(g->edges.curves);
	g->edges = (struct iges_edges){ list, n, curves };
	return c.st;
}

enum status iges_edge(struct iges *g, int list, int index, int *curve)
{
	enum status st = g->edges.list == list ? ST_OK : load_edges(g, list);
	*curve = st == ST_OK && index >= 1 && index <= g->edges.n ? g->edges.curves[index - 1] : 0;
	return st;
}

static enum status bound_by_edge(struct iges *g, int surface, int list, int index)
{
	int curve;
	enum status st = iges_edge(g, list, index, &curve);
	return st == ST_OK ? add_bound(g, surface, curve) : st;
}

static enum status bound_by_508(struct iges *g, int surface, int de)
{
	struct iges_cursor c;
	enum status st = iges_open(g, de, 508, &c);
	if (st != ST_OK)
		return st;
	int n = iges_count(&c, "count", 0, iges_left(&c));
	for (int i = 0; i < n && st == ST_OK && c.st == ST_OK; i++) {
		int vertex = iges_int(&c), list = iges_int(&c), index = iges_int(&c);
		iges_int(&c);
		int k = iges_count(&c, "count", 0, iges_left(&c));
		for (int j = 0; j < k && c.st == ST_OK; j++)
			iges_int(&c), iges_int(&c);
		if (!vertex && c.st == ST_OK)
			st = bound_by_edge(g, surface, list, index);
	}
	return st;
}

typedef enum status bound_by(struct iges *g, int surface, int de);

static enum status bounds_list(struct iges_cursor *c, int surface, int n, bound_by *by)
{
	enum status st = ST_OK;
	for (int i = 0; i < n && c->st == ST_OK && st == ST_OK; i++) {
		int de = iges_int(c);
		use(c->g, de);
		if (is_plane(c->g, surface) && c->st == ST_OK)
			st = by(c->g, surface, de);
		if (st == ST_INPUT)
			st = ST_OK; /* a bad loop leaves the others */
	}
	return st;
}

/* 143: type, surface, boundaries 141. */
static enum status uses_bounded(struct iges_cursor *c)
{
	iges_int(c);
	int surface = iges_int(c), n = iges_count(c, "count", 0, iges_left(c));
	return bounds_list(c, surface, n, bound_by_141);
}

/* 144: surface, has an outer boundary, inner ones; 142 each. */
static enum status uses_trimmed(struct iges_cursor *c)
{
	int surface = iges_int(c), outer = iges_int(c);
	int n = iges_count(c, "count", 0, iges_left(c));
	if (!outer)
		iges_int(c);
	return bounds_list(c, surface, n + (outer != 0), bound_by_142);
}

/* 510: surface, loops 508. */
static enum status uses_face(struct iges_cursor *c)
{
	int surface = iges_int(c), n = iges_count(c, "count", 0, iges_left(c));
	iges_int(c);
	return bounds_list(c, surface, n, bound_by_508);
}

/* 186: outer shell, its sense, inner ones; 514: faces with their sense. */
static void use_pairs(struct iges_cursor *c)
{
	int n = iges_count(c, "count", 0, iges_left(c));
	for (int i = 0; i < n && c->st == ST_OK; i++)
		use_fixed(c, 0, 1), use_fixed(c, 1, 1);
}

static enum status uses_solid(struct iges_cursor *c)
{
	use_fixed(c, 0, 1), use_fixed(c, 1, 1);
	use_pairs(c);
	return ST_OK;
}

static enum status uses_shell(struct iges_cursor *c)
{
	use_pairs(c);
	return ST_OK;
}

/* Entities with pointers: to a list that stands first, to parameters from .. to - 1, or by `find`. */
static const struct {
	int type;
	bool list;
	int from, to;
	enum status (*find)(struct iges_cursor *c);
} users[] = {
	{ 102, true, 0, 0, NULL },           { 108, false, 4, 5, NULL },
	{ 118, false, 0, 2, NULL },          { 120, false, 0, 2, NULL },
	{ 122, false, 0, 1, NULL },          { 130, false, 0, 1, NULL },
	{ 141, false, 0, 0, uses_boundary }, { 142, false, 0, 0, uses_curve_on_surface },
	{ 143, false, 0, 0, uses_bounded },  { 144, false, 0, 0, uses_trimmed },
	{ 162, false, 0, 1, NULL },          { 164, false, 0, 1, NULL },
	{ 186, false, 0, 0, uses_solid },    { 190, false, 0, 3, NULL },
	{ 192, false, 0, 2, NULL },          { 194, false, 0, 2, NULL },
	{ 196, false, 0, 1, NULL },          { 198, false, 0, 2, NULL },
	{ 220, false, 2, 3, NULL },          { 228, false, 0, 0, uses_symbol },
	{ 230, false, 0, 0, uses_section },  { 308, false, 0, 0, uses_subfigure },
	{ 504, false, 0, 0, uses_edges },    { 508, false, 0, 0, uses_loop },
	{ 510, false, 0, 0, uses_face },     { 514, false, 0, 0, uses_shell },
};

static enum status find_of(struct iges *g, int de, size_t row)
{
	struct iges_cursor c;
	g->at = de;
	enum status st = iges_open(g, de, 0, &c);
	if (st == ST_OK && users[row].find)
		st = users[row].find(&c);
	else if (st == ST_OK && users[row].list)
		use_list(&c);
	else if (st == ST_OK)
		use_fixed(&c, users[row].from, users[row].to);
	if (st == ST_OK)
		st = c.st;
	return st == ST_INPUT ? ST_OK : st; /* the entity itself will say what is wrong with it */
}

/* Members of a group that a subfigure is made of are used by that, too. */
static void use_members(struct iges *g, int de, int depth)
{
	struct iges_cursor c;
	g->at = de;
	int n = iges_open(g, de, 402, &c) == ST_OK ? iges_count(&c, "count", 0, iges_left(&c)) : 0;
	for (int i = 0; i < n && c.st == ST_OK; i++) {
		int member = iges_int(&c);
		const struct iges_entry *e = iges_entry(g, member);
		if (e && !e->used && iges_is_group(e) && depth < NESTING_MAX)
			use_members(g, member, depth + 1);
		use(g, member);
	}
}

enum status iges_find_uses(struct iges *g)
{
	g->quiet = true;
	for (int i = 0; i < g->n_entries; i++) {
		const struct iges_entry *e = iges_entry(g, 2 * i + 1);
		size_t row = 0;
		while (row < sizeof users / sizeof users[0] && users[row].type != e->type)
			row++;
		if (row == sizeof users / sizeof users[0])
			continue;
		enum status st = find_of(g, 2 * i + 1, row);
		if (st != ST_OK)
			return st;
	}
	for (int i = 0; i < g->n_entries; i++) {
		const struct iges_entry *e = iges_entry(g, 2 * i + 1);
		if (iges_is_group(e) && e->used)
			use_members(g, 2 * i + 1, 0);
	}
	g->quiet = false;
	return ST_OK;
}
