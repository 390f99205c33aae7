/* iges.c - an IGES file as a model: every entity in turn, what is not read counted and named. */
#include "iges_reader.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* P lines an entity may be read again for those that use it, on the average. */
enum { BUDGET_A_LINE = 16, BUDGET_MORE = 100000 };

/* Types that are read on behalf of others, or say themselves what is wrong with them: directions,
 * transforms, colors, faces and what they make up, subfigures. 0 is no entity. */
static const int helpers[] = { 0, 123, 124, 143, 144, 186, 308, 314, 408, 510, 514 };

/* Parts of trims, read where a face uses them. */
static const int trim_parts[] = { 141, 142, 502, 504, 508 };

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
	{ 141, 141, "a boundary that no face uses" },
	{ 146, 148, "finite elements are not read" },
	{ 150, 184, "solids made of primitives are not read" },
	{ 192, 198, "surfaces given by formula are not read yet" },
	{ 202, 230, "annotation, not geometry" },
	{ 302, 320, "definitions (fonts, line styles, networks) are not read" },
	{ 402, 402, "associations other than groups are not read" },
	{ 404, 404, "drawings are not read" },
	{ 406, 406, "properties other than names are not read" },
	{ 410, 410, "views are not read" },
	{ 412, 422, "arrays, references and networks are not read" },
	{ 502, 508, "vertices, edges and loops that no face uses" },
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

static bool is_in(const int *types, size_t n, int type)
{
	for (size_t i = 0; i < n; i++)
		if (types[i] == type)
			return true;
	return false;
}

static bool is_helper(const struct iges_entry *e)
{
	return is_in(helpers, sizeof helpers / sizeof helpers[0], e->type) ||
	       (e->used && is_in(trim_parts, sizeof trim_parts / sizeof trim_parts[0], e->type)) ||
	       (e->type == 406 && e->form == 15) || iges_is_group(e);
}

static bool is_lone_curve(const struct iges_entry *e)
{
	return e->type == 142 && !e->used;
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
		st = iges_name_behind(&c, out);
	if (st == ST_OK)
		st = iges_color(g, de, out);
	return st == ST_OK ? iges_group(g, de, out) : st;
}

/* Faces on a surface that cannot be read are lost with it. */
static enum status lose_faces(struct iges *g, int de)
{
	char reason[64];
	enum status st = ST_OK;
	snprintf(reason, sizeof reason, "its surface D%d cannot be read", de);
	for (int i = iges_entry(g, de)->uses; i >= 0 && st == ST_OK; i = g->uses[i].next)
		if (g->uses[i].face)
			st = model_skip(g->m, iges_entry(g, g->uses[i].face)->type, g->uses[i].face,
			                reason);
	return st;
}

static enum status read_entity(struct iges *g, int de)
{
	struct entity out;
	struct iges_entry *e = iges_entry(g, de);
	enum status st = read_geometry(g, de, &out);
	out.de = de;
	out.source_type = e->type;
	out.used = e->used && out.kind != ENTITY_SURFACE;
	if (st == ST_INPUT) {
		entity_finish(&out);
		st = model_skip(g->m, e->type, de, g->reason);
		return st == ST_OK ? lose_faces(g, de) : st;
	}
	if (st == ST_OK)
		st = iges_show(g, de, &out);
	if (st == ST_OK && e->blanked)
		iges_warn(g, WARN_BLANKED, de);
	if (st == ST_OK) {
		st = model_add(g->m, &out);
		e->place = g->m->n;
		return st;
	}
	entity_finish(&out);
	return st;
}

static enum status read_curve_on_surface(struct iges *g, int de)
{
	struct entity out;
	const struct iges_entry *e = iges_entry(g, de);
	g->reason[0] = g->store.error[0] = '\0';
	g->at = de;
	enum status st = iges_curve_on_surface(g, de, &out);
	out.de = de;
	out.source_type = e->type;
	if (st == ST_OK)
		st = iges_name(g, de, &out);
	if (st == ST_OK)
		st = iges_color(g, de, &out);
	if (st == ST_OK)
		st = iges_group(g, de, &out);
	if (st == ST_OK)
		return model_add(g->m, &out);
	entity_finish(&out);
	return st == ST_INPUT ? model_skip(g->m, e->type, de, g->reason) : st;
}

/* Entities in the order of their numbers: what one depends on stands before. */
enum pass { SHAPES, POINTS, CURVES_ON_SURFACES, N_PASSES };

static enum pass pass_of(const struct iges_entry *e)
{
	return iges_is_points(e) ? POINTS : is_lone_curve(e) ? CURVES_ON_SURFACES : SHAPES;
}

static enum status read_next(struct iges *g, enum pass pass, int de)
{
	const struct iges_entry *e = iges_entry(g, de);
	if (!e || pass_of(e) != pass)
		return ST_OK;
	if (pass == CURVES_ON_SURFACES)
		return read_curve_on_surface(g, de);
	if (pass == POINTS || iges_is_curve(e) || iges_is_surface(e))
		return read_entity(g, de);
	return is_helper(e) ? ST_OK : model_skip(g->m, e->type, de, skip_reason(e->type));
}

/* What came up on the way follows: surfaces once more, instances. */
static enum status append_more(struct iges *g)
{
	enum status st = ST_OK;
	for (int i = 0; i < g->more.n && st == ST_OK; i++)
		st = model_add(g->m, &g->more.entities[i]);
	model_finish(&g->more);
	return st;
}

/* Curves and surfaces first, so that their numbers do not depend on the others. */
static enum status read_entities(struct iges *g)
{
	enum status st = ST_OK;
	for (enum pass pass = 0; pass < N_PASSES && st == ST_OK; pass++) {
		for (int i = 0; i < g->n_entries && st == ST_OK; i++) {
			st = read_next(g, pass, 2 * i + 1);
			iges_leave_entries(g, i, pass >= POINTS);
			if (st == ST_OK && (i & 0xff) == 0xff)
				st = progress_step(g->progress,
				                   g->n_p ? (double)g->far / g->n_p : 0);
		}
		if (st == ST_OK)
			st = append_more(g);
	}
	return st;
}

static enum status say_mended(struct iges *g)
{
	if (!g->mended.count)
		return ST_OK;
	return model_warn(g->m, "%d %s on the mending of trims: %s%s", g->mended.count,
	                  g->mended.count == 1 ? "note" : "notes",
	                  g->mended.count == 1 ? "" : "the first is ", g->mended.first);
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
	if (st == ST_OK)
		st = iges_find_groups(g);
	if (st == ST_OK)
		st = iges_place(g);
	g->budget = (int64_t)BUDGET_A_LINE * g->n_p + BUDGET_MORE;
	if (st == ST_OK)
		st = read_entities(g);
	if (st == ST_OK)
		st = say_mended(g);
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

static enum status parse(struct model *m, const struct iges_bytes *bytes, const char *name,
                         const struct progress *p, const struct report *r)
{
	struct iges g = { .bytes = *bytes, .name = name, .m = m, .progress = p, .r = r };
	report_store_init(&g.store);
	model_init(&g.more);
	enum status st = iges_index(&g);
	if (st == ST_OK) {
		st = read_all(&g);
		if (st == ST_RESOURCE)
			report_error(r, st, "cannot read '%s': no memory", name);
	}
	if (g.bytes.failed && st != ST_CANCELLED)
		st = report_error(r, ST_RESOURCE,
		                  "cannot read '%s': its disk or the memory gave out; try again",
		                  name);
	if (st == ST_OK && g.bytes.shorter)
		st = report_error(r, ST_INPUT,
		                  "cannot read '%s': it was cut short while it was read; copy it "
		                  "again",
		                  name);
	if (st == ST_OK && m->n == 0)
		st = say_nothing_read(&g);
	if (st == ST_OK)
		model_number(m);
	text_finish(&g.global);
	iges_finish_directory(&g);
	iges_lines_finish(&g.p_lines);
	free(g.first_lines);
	free(g.uses);
	free(g.matrices);
	model_finish(&g.more);
	free(g.bounds);
	iges_finish_groups(&g);
	free(g.edges.curves);
	iges_bytes_finish(&g.bytes);
	return st;
}

enum status iges_parse(struct model *m, const char *bytes, size_t n, const char *name,
                       const struct progress *p, const struct report *r)
{
	return parse(m, &(struct iges_bytes){ .all = bytes, .n = n }, name, p, r);
}

enum status iges_read(struct model *m, int fd, size_t n, const char *name, const struct progress *p,
                      const struct report *r)
{
	return parse(m, &(struct iges_bytes){ .fd = fd, .n = n }, name, p, r);
}
