/* iges_directory.c - the directory section: two lines an entity, twenty fields of eight columns. */
#include "iges_reader.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "number.h"

enum { FIELD = 8 };

/* Field k (0 .. 8) of a line as text of 8 columns; short lines read as blanks. */
static void field_text(struct iges *g, int line, int k, char out[FIELD + 1])
{
	size_t got, at = iges_lines_at(&g->d_lines, line) + (size_t)k * FIELD;
	const char *s = iges_bytes_at(&g->bytes, at, FIELD, &got);
	for (size_t i = 0; i < FIELD; i++) {
		char c = i < got ? s[i] : ' ';
		out[i] = c == '\t' || c == '\0' ? ' ' : c;
	}
	out[FIELD] = '\0';
}

static int field_int(struct iges *g, int line, int k)
{
	char text[FIELD + 1];
	field_text(g, line, k, text);
	const char *s = text + strspn(text, " ");
	int64_t x;
	return number_read_integer(&s, text + FIELD, &x) ? (int)x : 0;
}

/* Columns 1-2 of the status number: 01 is blanked. */
static bool field_blanked(struct iges *g, int line)
{
	char text[FIELD + 1];
	field_text(g, line, 8, text);
	return text[1] == '1';
}

static void field_label(struct iges *g, int line, char out[FIELD])
{
	char text[FIELD + 1];
	field_text(g, line, 7, text);
	size_t from = strspn(text, " "), to = FIELD;
	while (to > from && text[to - 1] == ' ')
		to--;
	memset(out, 0, FIELD);
	memcpy(out, text + from, to - from);
}

static enum status make_entries(struct iges *g)
{
	g->n_entries = g->n_d / 2;
	size_t blocks = ((size_t)g->n_entries + ENTRIES_BLOCK - 1) / ENTRIES_BLOCK;
	g->entries = calloc(blocks ? blocks : 1, sizeof *g->entries);
	if (!g->entries)
		return ST_RESOURCE;
	for (size_t i = 0; i < blocks; i++) {
		g->entries[i] = calloc(ENTRIES_BLOCK, sizeof **g->entries);
		if (!g->entries[i])
			return ST_RESOURCE;
	}
	return ST_OK;
}

static void want_helpers(struct iges *g, int i)
{
	const struct iges_entry *e = iges_entry(g, 2 * i + 1);
	struct iges_entry *transform = iges_entry(g, e->transform),
	                  *color = e->color < 0 ? iges_entry(g, abs(e->color)) : NULL;
	if (transform)
		transform->wanted = true;
	if (color)
		color->wanted = true;
}

enum status iges_read_directory(struct iges *g)
{
	enum status st = make_entries(g);
	if (st != ST_OK)
		return st;
	for (int i = 0; i < g->n_entries; i++) {
		int a = 2 * i, b = 2 * i + 1;
		struct iges_entry *e = iges_entry(g, 2 * i + 1);
		*e = (struct iges_entry){
			.type = field_int(g, a, 0),
			.data = field_int(g, a, 1),
			.transform = field_int(g, a, 6),
			.blanked = field_blanked(g, a),
			.color = field_int(g, b, 2),
			.lines = field_int(g, b, 3),
			.form = field_int(g, b, 4),
			.subscript = field_int(g, b, 8),
			.group = -1,
			.uses = -1,
			.first_edge = -1,
		};
		field_label(g, b, e->label);
		if (field_int(g, b, 0) != e->type)
			iges_warn(g, WARN_SEQUENCE, 2 * i + 1);
	}
	for (int i = 0; i < g->n_entries; i++)
		want_helpers(g, i);
	iges_lines_finish(&g->d_lines);
	if (g->n_d % 2)
		return model_warn(g->m,
		                  "the directory has an odd number of lines; the last is left out");
	return ST_OK;
}

struct iges_entry *iges_entry(struct iges *g, int de)
{
	int i = (de - 1) / 2;
	if (de < 1 || i >= g->n_entries || !g->entries[i / ENTRIES_BLOCK])
		return NULL;
	return &g->entries[i / ENTRIES_BLOCK][i % ENTRIES_BLOCK];
}

/* Curves and points that stand for themselves; others may be looked at again. */
static bool is_done_with(const struct iges_entry *e, bool points)
{
	return (iges_is_curve(e) || (points && iges_is_points(e))) && !e->used && !e->wanted &&
	       e->uses < 0;
}

void iges_leave_entries(struct iges *g, int i, bool points)
{
	struct iges_entry **block = &g->entries[i / ENTRIES_BLOCK];
	if (i % ENTRIES_BLOCK != ENTRIES_BLOCK - 1 || !*block)
		return;
	for (int k = 0; k < ENTRIES_BLOCK; k++)
		if (!is_done_with(&(*block)[k], points))
			return;
	free(*block);
	*block = NULL;
}

void iges_finish_directory(struct iges *g)
{
	size_t blocks = ((size_t)g->n_entries + ENTRIES_BLOCK - 1) / ENTRIES_BLOCK;
	for (size_t i = 0; g->entries && i < blocks; i++)
		free(g->entries[i]);
	free(g->entries);
	iges_lines_finish(&g->d_lines);
}

void iges_warn(struct iges *g, enum iges_warning w, int de)
{
	if (g->quiet || (g->at && de != g->at))
		return; /* a part is looked at again for those made of it */
	if (g->warned[w].last == de)
		return;
	g->warned[w].last = de;
	if (g->warned[w].count++ == 0)
		g->warned[w].first = de;
}

int iges_mend_pointer(struct iges *g, int de)
{
	struct iges_entry *e = iges_entry(g, de);
	if (!e || de % 2 == 1)
		return de;
	if (!e->pointed_even && g->warned[WARN_EVEN].count++ == 0)
		g->warned[WARN_EVEN].first = de - 1;
	e->pointed_even = true;
	return de - 1;
}

void iges_warn_error(struct iges *g, enum iges_warning w, int de, double error)
{
	int count = g->warned[w].count;
	iges_warn(g, w, de);
	if (g->warned[w].count > count)
		g->warned[w].error = fmax(g->warned[w].error, error);
}

enum status iges_say_warnings(struct iges *g)
{
	static const char *const text[N_IGES_WARNINGS] = {
		[WARN_RANGE_IGNORED] = "a parameter range that makes no sense; "
		                       "the whole range of the knots is taken",
		[WARN_RANGE_CUT] = "a parameter range that reaches beyond the knots; cut to them",
		[WARN_RANGE_MISSING] = "no parameter range; the whole range of the knots is taken",
		[WARN_BLANKED] = "blanked (hidden by the author); read like the others",
		[WARN_BACK_POINTER] = "a wrong pointer to the parameter data; "
		                      "found by the data's own pointers back",
		[WARN_WEIGHTS] = "weights that are all zero and the flag of a polynomial; "
		                 "weights of 1 are taken",
		[WARN_RULED] = "ruled by curves that do not run alike; approximated",
		[WARN_OFFSET] = "an offset surface; approximated",
		[WARN_SEQUENCE] = "two directory lines that name different types",
		[WARN_TWO_COURSES] = "loops whose curves in u,v and in space disagree; those in "
		                     "space are taken",
		[WARN_PARAMETERS] = "loops given only in the parameters of a plane, which the "
		                    "standard leaves open; lengths along its edges are taken",
		[WARN_FAR] = "trimmed by curves that do not lie on it; they are brought down to it",
		[WARN_EVEN] = "referred to by the number of their second directory line; the first "
		              "is taken",
		[WARN_LENT] = "no parameter data of their own, and a pointer to another's; read "
		              "from there",
		[WARN_FLAG] =
		        "the flag of a polynomial, and weights that differ; the weights count",
		[WARN_REPEATED] = "loops that a face names twice; each is taken once",
		[WARN_NESTING] = "loops whose outer one lies within another; taken by which holds "
		                 "which",
		[WARN_OUTSIDE] = "inner loops outside the outer one; they cut nothing",
		[WARN_ISLAND] = "loops within holes, which a trimmed surface cannot have; left out",
		[WARN_UNPLACED] = "a subfigure that nothing places; its members are read as they "
		                  "stand",
	};
	for (int w = 0; w < N_IGES_WARNINGS; w++) {
		int n = g->warned[w].count;
		if (!n)
			continue;
		char within[48] = "";
		if (g->warned[w].error > 0)
			snprintf(within, sizeof within, " to within %.1e", g->warned[w].error);
		enum status st = model_warn(g->m, "%d %s (the first is D%d): %s%s", n,
		                            n == 1 ? "entity" : "entities", g->warned[w].first,
		                            text[w], within);
		if (st != ST_OK)
			return st;
	}
	return ST_OK;
}
