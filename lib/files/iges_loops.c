/* iges_loops.c - the loops of a face: 142 141 508, in 144 143 510. */
#include "iges_trimmer.h"

#include <stdlib.h>

/* 142: how made, surface, curve in u,v, curve in space, preference. */
static enum status loop_142(struct trimmer *t, int de, struct trim_loop *loop)
{
	struct iges_cursor c;
	enum status st = iges_open(t->g, de, 142, &c);
	if (st != ST_OK)
		return st;
	iges_int(&c), iges_int(&c);
	int uv = iges_int(&c), space = iges_int(&c);
	return c.st == ST_OK ? iges_add_piece(t, &uv, 1, space, false, loop) : c.st;
}

/* Pointers to n curves, with `step` numbers before each. Fresh. */
static enum status read_list(struct iges_cursor *c, int n, int step, int **out)
{
	*out = calloc(n ? (size_t)n : 1, sizeof **out);
	if (!*out)
		return ST_RESOURCE;
	for (int i = 0; i < n && c->st == ST_OK; i++) {
		for (int k = 0; k < step; k++)
			iges_int(c);
		(*out)[i] = iges_int(c);
	}
	return c->st;
}

/* 141: type, preference, surface, then curves in space, their sense, their curves in u,v. */
static enum status loop_141(struct trimmer *t, int de, struct trim_loop *loop)
{
	struct iges_cursor c;
	enum status st = iges_open(t->g, de, 141, &c);
	if (st != ST_OK)
		return st;
	iges_int(&c), iges_int(&c), iges_int(&c);
	int n = iges_count(&c, "number of curves", 0, iges_left(&c));
	for (int i = 0; i < n && st == ST_OK; i++) {
		int *uv = NULL, space = iges_int(&c), sense = iges_int(&c);
		int k = iges_count(&c, "number of curves in u,v", 0, iges_left(&c));
		st = read_list(&c, k, 0, &uv);
		if (st == ST_OK)
			st = iges_add_piece(t, uv, k, space, sense == 2, loop);
		free(uv);
	}
	return st == ST_OK ? c.st : st;
}

/* 508: edge or vertex, list, place in it, sense, curves in u,v with their flags. A vertex without
 * a curve needs none: what it leaves open is closed by a line along the pole. */
static enum status loop_508(struct trimmer *t, int de, struct trim_loop *loop)
{
	struct iges_cursor c;
	enum status st = iges_open(t->g, de, 508, &c);
	if (st != ST_OK)
		return st;
	int n = iges_count(&c, "number of edges", 0, iges_left(&c));
	for (int i = 0; i < n && st == ST_OK; i++) {
		int *uv = NULL, edge = 0;
		int vertex = iges_int(&c), list = iges_int(&c), index = iges_int(&c);
		int sense = iges_int(&c);
		int k = iges_count(&c, "number of curves in u,v", 0, iges_left(&c));
		st = read_list(&c, k, 1, &uv);
		if (st == ST_OK && !vertex)
			st = iges_edge(t->g, list, index, &edge);
		if (st == ST_OK && !vertex && !edge && !k)
			st = iges_refuse(t->g, "edge %d of D%d is not there", index, list);
		if (st == ST_OK && (!vertex || k))
			st = iges_add_piece(t, uv, k, edge, sense == 0, loop);
		free(uv);
	}
	return st == ST_OK ? c.st : st;
}

typedef enum status read_loop(struct trimmer *t, int de, struct trim_loop *loop);

/* Loops of a face that have been read. */
struct taken {
	int *de, n; /* owned */
};

/* Room for n; is `de` one of them, else it becomes one. */
static bool taken_before(struct trimmer *t, struct taken *x, int de)
{
	for (int i = 0; i < x->n; i++)
		if (x->de[i] == de) {
			iges_warn(t->g, WARN_REPEATED, t->g->at);
			return true;
		}
	x->de[x->n++] = de;
	return false;
}

/* Read one loop into the trim; a lost one that is not required is counted and leaves the others. */
static enum status add_loop(struct trimmer *t, int de, read_loop *read, bool outer, bool required,
                            struct trim *out)
{
	struct trim_loop loop = { .outer = outer };
	enum status st = read(t, de, &loop);
	if (st == ST_OK && loop.n == 0)
		st = iges_refuse(t->g, "a loop without curves");
	if (st == ST_OK) {
		iges_center_turns(t, &loop);
		return trim_add(out, &loop);
	}
	trim_loop_finish(&loop);
	if (st != ST_INPUT || required)
		return st;
	return model_skip(t->g->m, iges_entry(t->g, de) ? iges_entry(t->g, de)->type : 0, de,
	                  t->g->reason);
}

/* n loops, of which the first is an outer one or not; told: that all others are inner ones. */
static enum status add_loops(struct trimmer *t, struct iges_cursor *c, int n, read_loop *read,
                             bool outer, bool told, struct trim *out)
{
	struct taken x = { calloc(n ? (size_t)n : 1, sizeof(int)), 0 };
	enum status st = x.de ? ST_OK : ST_RESOURCE;
	for (int i = 0; i < n && st == ST_OK; i++) {
		int de = iges_mend_pointer(t->g, iges_int(c));
		if (c->st != ST_OK)
			st = c->st;
		else if (!taken_before(t, &x, de))
			st = add_loop(t, de, read, outer && i == 0, !told || (outer && i == 0),
			              out);
	}
	free(x.de);
	return st;
}

/* 144: surface, has an outer loop, number of inner ones, outer loop, inner ones. Without an outer
 * loop the whole domain is meant. */
static enum status trim_144(struct trimmer *t, struct iges_cursor *c, struct trim *out)
{
	iges_int(c);
	bool outer = iges_int(c) != 0;
	int n = iges_count(c, "number of inner loops", 0, iges_left(c));
	if (!outer)
		iges_int(c);
	enum status st =
	        c->st == ST_OK ? add_loops(t, c, n + outer, loop_142, outer, true, out) : c->st;
	return st == ST_OK && outer ? iges_nest(t, true, false, out) : st;
}

/* 143: type, surface, boundaries; 510: surface, number, whether the first is the outer one. */
static enum status trim_listed(struct trimmer *t, struct iges_cursor *c, bool is_face,
                               struct trim *out)
{
	bool told = false;
	if (!is_face)
		iges_int(c);
	iges_int(c);
	int n = iges_count(c, "number of loops", 0, iges_left(c));
	if (is_face)
		told = iges_int(c) == 1;
	enum status st = c->st;
	if (st == ST_OK)
		st = add_loops(t, c, n, is_face ? loop_508 : loop_141, told, told, out);
	return st == ST_OK ? iges_nest(t, told, is_face, out) : st;
}

enum status iges_trim(struct iges *g, int de, int base, const struct surface *s, struct trim *out)
{
	struct iges_cursor c;
	struct trimmer t;
	*out = (struct trim){ 0 };
	enum status st = iges_trimmer_init(&t, g, de, base, s);
	if (st == ST_OK)
		st = iges_open(g, de, 0, &c);
	if (st == ST_OK && iges_entry(g, de)->type == 144)
		st = trim_144(&t, &c, out);
	else if (st == ST_OK)
		st = trim_listed(&t, &c, iges_entry(g, de)->type == 510, out);
	iges_trimmer_finish(&t);
	if (st != ST_OK)
		trim_finish(out);
	return st;
}

enum status iges_trim_curves(struct iges *g, int de, const struct surface *s, struct trim_loop *uv)
{
	struct trimmer t;
	struct iges_cursor c;
	*uv = (struct trim_loop){ 0 };
	enum status st = iges_open(g, de, 142, &c);
	if (st != ST_OK)
		return st;
	iges_int(&c);
	int base = iges_int(&c);
	st = iges_trimmer_init(&t, g, de, base, s);
	if (st == ST_OK)
		st = loop_142(&t, de, uv);
	iges_trimmer_finish(&t);
	if (st != ST_OK)
		trim_loop_finish(uv);
	return st;
}
