/* iges_place.c - where things are shown: faces of shells and solids, instances of subfigures. */
#include "iges_reader.h"

#include <stdlib.h>
#include <string.h>

enum {
	COPIES_A_LINE = 1000, /* P lines that instances may repeat, on the average */
	COPIES_MORE = 100000,
	STAYS = -1, /* no matrix */
};

enum { UNKNOWN, BEING_LOOKED_AT, SOUND, CIRCULAR };

/* The way to a thing that is shown. */
struct place {
	int matrix, via, depth;
};

static enum status place_one(struct iges *g, int de, struct place at);

bool iges_is_face(const struct iges_entry *e)
{
	return e->type == 143 || e->type == 144 || e->type == 510;
}

bool iges_is_group(const struct iges_entry *e)
{
	return e->type == 402 && (e->form == 1 || e->form == 7 || e->form == 14 || e->form == 15);
}

/* Room for one more in an array that doubles. */
static bool grow(void **p, int n, size_t size)
{
	if (n & (n - 1))
		return true;
	void *q = reallocarray(*p, n ? (size_t)n * 2 : 1, size);
	if (q)
		*p = q;
	return q != NULL;
}

/* What cannot be placed is counted, and the rest goes on. */
static enum status lose(struct iges *g, int de, enum status st)
{
	return st == ST_INPUT ? model_skip(g->m, iges_entry(g, de)->type, de, g->reason) : st;
}

static enum status add_matrix(struct iges *g, double m[3][4], int *matrix)
{
	if (*matrix != STAYS)
		iges_multiply((const double(*)[4])g->matrices[*matrix], m);
	for (int i = 0; i < 12; i++)
		if (!isfinite(m[i / 4][i % 4]))
			return iges_refuse(g, "its place has a number that is not finite");
	if (!grow((void **)&g->matrices, g->n_matrices, sizeof *g->matrices))
		return ST_RESOURCE;
	memcpy(g->matrices[g->n_matrices], m, sizeof *g->matrices);
	*matrix = g->n_matrices++;
	return ST_OK;
}

/* The place of something whose 124 is given. */
static enum status move(struct iges *g, int transform, struct place *at)
{
	double m[3][4];
	bool any;
	enum status st = iges_matrix(g, transform, m, &any);
	return st == ST_OK && any ? add_matrix(g, m, &at->matrix) : st;
}

static enum status add_use(struct iges *g, int shape, int face, int loops, struct place at)
{
	struct iges_entry *e = iges_entry(g, shape);
	if (at.via && (g->copies -= 1 + (e->lines > 0 ? e->lines : 0)) < 0)
		return iges_refuse(g, "subfigures are repeated too many times");
	if (!grow((void **)&g->uses, g->n_uses, sizeof *g->uses))
		return ST_RESOURCE;
	g->uses[g->n_uses] = (struct iges_use){ face, at.via, at.matrix, loops, e->uses };
	e->uses = g->n_uses++;
	return ST_OK;
}

/* ---- faces, shells, solids */

static enum status place_face(struct iges *g, int de, struct place at)
{
	struct iges_cursor c;
	const struct iges_entry *e = iges_entry(g, de);
	int surface, loops;
	enum status st = iges_open(g, de, 0, &c);
	if (st != ST_OK)
		return st;
	if (e->type == 143)
		iges_int(&c);
	surface = iges_int(&c);
	if (e->type == 144) {
		loops = iges_int(&c) != 0;
		loops += iges_count(&c, "number of inner loops", 0, iges_left(&c));
	} else {
		loops = iges_count(&c, "number of loops", 0, iges_left(&c));
	}
	if (c.st != ST_OK)
		return c.st;
	const struct iges_entry *s = iges_entry(g, surface);
	if (!s || !iges_is_surface(s))
		return iges_refuse(g, "its surface D%d %s", surface,
		                   s ? "is of a type that is not read" : "is not there");
	st = move(g, e->transform, &at);
	return st == ST_OK ? add_use(g, surface, de, loops, at) : st;
}

/* 514: faces, each with its sense, which is of no concern here. */
static enum status place_pairs(struct iges_cursor *c, struct place at, const int *types)
{
	int n = iges_count(c, "count", 0, iges_left(c));
	enum status st = c->st;
	for (int i = 0; i < n && st == ST_OK; i++) {
		int de = iges_int(c);
		iges_int(c);
		const struct iges_entry *e = iges_entry(c->g, de);
		if (c->st != ST_OK)
			return c->st;
		if (e && (e->type == types[0] || e->type == types[1] || e->type == types[2]))
			st = place_one(c->g, de, at);
		else
			st = iges_refuse(c->g, "it refers to D%d, which is no %s", de,
			                 types[0] == 514 ? "shell" : "face");
	}
	return st;
}

static enum status place_shell(struct iges *g, int de, struct place at)
{
	static const int faces[] = { 510, 144, 143 };
	struct iges_cursor c;
	enum status st = iges_open(g, de, 0, &c);
	if (st == ST_OK)
		st = move(g, iges_entry(g, de)->transform, &at);
	return st == ST_OK ? place_pairs(&c, at, faces) : st;
}

/* 186: the outer shell and its sense, then inner ones. */
static enum status place_solid(struct iges *g, int de, struct place at)
{
	static const int shells[] = { 514, 514, 514 };
	struct iges_cursor c;
	enum status st = iges_open(g, de, 0, &c);
	if (st == ST_OK)
		st = move(g, iges_entry(g, de)->transform, &at);
	int shell = st == ST_OK ? iges_int(&c) : 0;
	if (st == ST_OK)
		iges_int(&c);
	if (st == ST_OK && c.st != ST_OK)
		st = c.st;
	if (st != ST_OK)
		return st;
	const struct iges_entry *e = iges_entry(g, shell);
	if (!e || e->type != 514)
		return iges_refuse(g, "it refers to D%d, which is no shell", shell);
	st = place_one(g, shell, at);
	return st == ST_OK ? place_pairs(&c, at, shells) : st;
}

/* ---- subfigures and groups */

/* Stand before the count of members of a 308 or 402. */
static enum status open_members(struct iges *g, int de, struct iges_cursor *c)
{
	enum status st = iges_open(g, de, 0, c);
	if (st == ST_OK && iges_entry(g, de)->type == 308) {
		struct text name = { 0 };
		iges_int(c);
		iges_string(c, &name);
		text_finish(&name);
		st = c->st;
	}
	return st;
}

/* Definitions that a 308, 402 or 408 leads to, directly or not, must not lead back to it. */
static bool is_sound(struct iges *g, int de, int depth)
{
	struct iges_cursor c;
	struct iges_entry *e = iges_entry(g, de);
	if (!e || (e->type != 308 && e->type != 408 && !iges_is_group(e)))
		return true;
	if (e->state == SOUND)
		return true;
	if (e->state != UNKNOWN || depth > 2 * NESTING_MAX)
		return false;
	e->state = BEING_LOOKED_AT;
	bool sound = true;
	if (e->type == 408) {
		if (iges_open(g, de, 0, &c) == ST_OK) {
			int definition = iges_int(&c);
			sound = is_sound(g, definition, depth + 1);
		}
	} else if (open_members(g, de, &c) == ST_OK) {
		int n = iges_count(&c, "count", 0, iges_left(&c));
		for (int i = 0; i < n && c.st == ST_OK && sound; i++) {
			int member = iges_int(&c);
			sound = is_sound(g, member, depth + 1);
		}
	}
	e->state = sound ? SOUND : CIRCULAR;
	return sound;
}

static enum status place_members(struct iges *g, int de, struct place at)
{
	struct iges_cursor c;
	enum status st = open_members(g, de, &c);
	if (st != ST_OK)
		return st;
	int n = iges_count(&c, "count", 0, iges_left(&c));
	for (int i = 0; i < n && st == ST_OK; i++) {
		int member = iges_int(&c);
		st = c.st == ST_OK ? place_one(g, member, at) : c.st;
	}
	return st == ST_OK ? c.st : st;
}

/* 408: definition, where its origin comes, scale (1 where it is left out); then the 124. */
static enum status place_instance(struct iges *g, int de, struct place at)
{
	struct iges_cursor c;
	double x[4];
	if (!is_sound(g, de, 0))
		return iges_refuse(g, "a subfigure that contains itself, or is nested too deep");
	enum status st = iges_open(g, de, 0, &c);
	if (st != ST_OK)
		return st;
	int definition = iges_int(&c);
	for (int i = 0; i < 3; i++)
		x[i] = iges_real(&c);
	size_t missing = c.missing;
	x[3] = iges_real(&c);
	if (c.missing != missing)
		x[3] = 1;
	if (c.st != ST_OK)
		return c.st;
	const struct iges_entry *d = iges_entry(g, definition);
	if (!d || d->type != 308)
		return iges_refuse(g, "it refers to D%d, which defines no subfigure", definition);
	if (x[3] == 0)
		return iges_refuse(g, "it is scaled by 0");
	st = move(g, iges_entry(g, de)->transform, &at);
	double m[3][4] = { { x[3], 0, 0, x[0] }, { 0, x[3], 0, x[1] }, { 0, 0, x[3], x[2] } };
	if (st == ST_OK)
		st = add_matrix(g, m, &at.matrix);
	if (!at.via)
		at.via = de;
	iges_entry(g, definition)->reached = true;
	return st == ST_OK ? place_members(g, definition, at) : st;
}

/* Anything that can be shown; other things are passed over. */
static enum status place_one(struct iges *g, int de, struct place at)
{
	de = iges_mend_pointer(g, de);
	struct iges_entry *e = iges_entry(g, de);
	enum status st = ST_OK;
	if (!e || at.depth > 3 * NESTING_MAX)
		return ST_OK; /* bad pointers are told where they stand */
	at.depth++;
	e->reached = true;
	if (iges_is_face(e))
		st = place_face(g, de, at);
	else if (e->type == 514)
		st = place_shell(g, de, at);
	else if (e->type == 186)
		st = place_solid(g, de, at);
	else if (e->type == 408)
		st = place_instance(g, de, at);
	else if (iges_is_group(e) && at.via)
		st = place_members(g, de, at);
	else if (at.via && (iges_is_surface(e) || iges_is_curve(e) || iges_is_points(e)))
		st = add_use(g, de, 0, 0, at);
	return lose(g, de, st);
}

static bool is_placed_by_itself(const struct iges_entry *e)
{
	return e->type == 408 || e->type == 186 || e->type == 514 || iges_is_face(e);
}

/* First what nothing refers to, then what has not been reached from there, faces last: parts of what
 * cannot be read, and members of subfigures that nothing places. */
enum status iges_place(struct iges *g)
{
	enum status st = ST_OK;
	g->budget = g->copies = (int64_t)COPIES_A_LINE * g->n_p + COPIES_MORE;
	for (int again = 0; again < 3; again++)
		for (int i = 0; i < g->n_entries && st == ST_OK; i++) {
			const struct iges_entry *e = iges_entry(g, 2 * i + 1);
			g->at = 2 * i + 1;
			bool due = again == 0 ? !e->used : again == 2 || !iges_is_face(e);
			if (is_placed_by_itself(e) && !e->reached && due)
				st = place_one(g, g->at, (struct place){ STAYS, 0, 0 });
		}
	for (int i = 0; i < g->n_entries && st == ST_OK; i++) {
		g->at = 2 * i + 1;
		const struct iges_entry *e = iges_entry(g, g->at);
		if (e->type == 308 && !e->reached)
			iges_warn(g, WARN_UNPLACED, g->at);
	}
	return st;
}
