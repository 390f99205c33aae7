/* info.c - what a geometry file holds. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "print.h"
#include "reading.h"
#include "verbs.h"

static const double closed_within = 1e-9; /* of the size */
static const double area_accuracy = 1e-6; /* relative */

/* Of whole surfaces areas are told where those asked for have this many control points together, at
 * most: half a second or so. */
enum { AREA_POINTS = 4096 };

static json_t *vector(struct vec3 p)
{
	return json_pack("[o,o,o]", json_real_or_null(p.x), json_real_or_null(p.y),
	                 json_real_or_null(p.z));
}

static json_t *interval(const double d[2])
{
	return json_pack("[o,o]", json_real_or_null(d[0]), json_real_or_null(d[1]));
}

static void describe_curve(json_t *o, const struct curve *c, double size)
{
	json_object_set_new(o, "order", json_pack("[i]", c->order));
	json_object_set_new(o, "points", json_pack("[i]", c->n));
	json_object_set_new(o, "rational", json_boolean(c->rational));
	json_object_set_new(o, "domain", json_pack("[o]", interval(c->domain)));
	json_object_set_new(o, "periodic", json_pack("[b]", (int)c->periodic));
	json_object_set_new(o, "closed",
	                    json_pack("[b]", (int)curve_closed(c, closed_within * size)));
}

static void describe_surface(json_t *o, const struct surface *s)
{
	double near = closed_within * surface_size(s);

	json_object_set_new(o, "order", json_pack("[i,i]", s->order[0], s->order[1]));
	json_object_set_new(o, "points", json_pack("[i,i]", s->n[0], s->n[1]));
	json_object_set_new(o, "rational", json_boolean(s->rational));
	json_object_set_new(o, "domain",
	                    json_pack("[o,o]", interval(s->domain[0]), interval(s->domain[1])));
	json_object_set_new(o, "periodic",
	                    json_pack("[b,b]", (int)s->periodic[0], (int)s->periodic[1]));
	json_object_set_new(o, "closed",
	                    json_pack("[b,b]", (int)surface_closed(s, 0, near),
	                              (int)surface_closed(s, 1, near)));
}

static void describe_points(json_t *o, const struct point_list *p)
{
	json_object_set_new(o, "order", json_array());
	json_object_set_new(o, "points", json_pack("[i]", p->n));
	json_object_set_new(o, "rational", json_false());
	json_object_set_new(o, "domain", json_array());
	json_object_set_new(o, "periodic", json_array());
	json_object_set_new(o, "closed", json_array());
}

/* Loops that were not read leave an area that is not known. */
static double area_of(const struct entity *e, bool whole_ones)
{
	double area = NAN, error;

	if (e->kind != ENTITY_SURFACE || (!e->trim.n && (e->trims || !whole_ones)) ||
	    trim_area(&e->trim, &e->geometry, area_accuracy, &area, &error) != ST_OK)
		return NAN;
	return area;
}

static json_t *entity_json(const struct entity *e, bool whole_areas)
{
	json_t *o = json_object();
	struct box box;

	json_set_int(o, "number", e->number);
	json_set_text(o, "name", e->name);
	json_set_text(o, "kind", entity_kind_name(e->kind));
	json_object_set_new(o, "de", e->de ? json_integer(e->de) : json_null());
	bool boxed = entity_box(e, &box) == ST_OK && !box_is_empty(&box);
	if (e->kind == ENTITY_SURFACE)
		describe_surface(o, &e->geometry);
	else if (e->kind == ENTITY_POINTS)
		describe_points(o, &e->points);
	else
		describe_curve(o, &e->curve, boxed ? box_diagonal(&box) : 0);
	json_object_set_new(
	        o, "box", boxed ? json_pack("[o,o]", vector(box.lo), vector(box.hi)) : json_null());
	json_set_int(o, "trims", e->trims);
	json_set_number(o, "area", area_of(e, whole_areas));
	return o;
}

/* What of a file is told. */
struct telling {
	const struct model *m;
	const struct entity *chosen; /* NULL: all that have a number */
	const char *file;
	bool whole_areas;
};

static bool is_told(const struct telling *t, const struct entity *e)
{
	return t->chosen ? e == t->chosen : e->number > 0;
}

/* Few control points: areas do not take long. */
static bool is_small(const struct telling *t)
{
	int64_t points = 0;
	for (int k = 0; k < t->m->n; k++) {
		const struct entity *e = &t->m->entities[k];
		if (e->kind == ENTITY_SURFACE && is_told(t, e))
			points += (int64_t)e->geometry.n[0] * e->geometry.n[1];
	}
	return points <= AREA_POINTS;
}

static json_t *skipped_json(const struct skipped *s)
{
	return json_pack("{s:i, s:i, s:s, s:i}", "type", s->type, "count", s->count, "reason",
	                 s->reason, "first_de", s->first_de);
}

/* Files have more entities than a tree of all would find room for. */
static int print_info_json(const struct telling *t)
{
	const struct model *m = t->m;
	struct print p;

	print_begin(&p, false);
	print_member(&p, "file", t->file ? json_string(t->file) : json_null());
	print_member(&p, "unit", m->unit ? json_string(m->unit) : json_null());
	print_member(&p, "unit_in_mm", json_real_or_null(m->unit_in_mm > 0 ? m->unit_in_mm : NAN));
	print_member(&p, "scale", json_real_or_null(m->scale));
	print_member(&p, "read", json_integer(m->n));
	print_rows(&p, "skipped");
	for (int k = 0; k < m->n_skipped; k++)
		print_row(&p, skipped_json(&m->skipped[k]));
	print_rows_end(&p);
	print_rows(&p, "entities");
	for (int k = 0; k < m->n; k++)
		if (is_told(t, &m->entities[k]))
			print_row(&p, entity_json(&m->entities[k], t->whole_areas));
	print_rows_end(&p);
	json_t *warnings = json_array();
	for (int k = 0; k < m->n_warnings; k++)
		json_array_append_new(warnings, json_string(m->warnings[k]));
	print_member(&p, "warnings", warnings);
	return print_end(&p);
}

static void print_entity(const json_t *e)
{
	char points[32] = "", orders[16] = "";
	const json_t *p = json_object_get(e, "points"), *o = json_object_get(e, "order");
	const json_t *closed = json_object_get(e, "closed");
	long long de = json_int(e, "de", 0);

	if (json_array_size(p) == 2) {
		snprintf(points, sizeof points, "%lldx%lld",
		         json_integer_value(json_array_get(p, 0)),
		         json_integer_value(json_array_get(p, 1)));
		snprintf(orders, sizeof orders, "%lldx%lld",
		         json_integer_value(json_array_get(o, 0)),
		         json_integer_value(json_array_get(o, 1)));
	} else {
		snprintf(points, sizeof points, "%lld", json_integer_value(json_array_get(p, 0)));
		if (json_array_size(o))
			snprintf(orders, sizeof orders, "%lld",
			         json_integer_value(json_array_get(o, 0)));
	}
	printf("%5lld  %-16s %-14.14s", json_int(e, "number", 0) + 0LL, json_text(e, "kind", ""),
	       json_text(e, "name", ""));
	if (de)
		printf(" D%-5lld", de);
	else
		printf(" %-6s", "");
	printf(" %-6s %s", orders, points);
	const int pad = 9 - (int)strlen(points);
	const char *const remarks[] = {
		json_flag(e, "rational", false) ? " rational" : "",
		!json_is_true(json_array_get(closed, 0)) ? ""
		: json_array_size(closed) == 2           ? " closed in u"
		                                         : " closed",
		json_is_true(json_array_get(closed, 1)) ? " closed in v" : "",
	};
	bool first = true;
	for (size_t k = 0; k < sizeof remarks / sizeof *remarks; k++)
		if (*remarks[k]) {
			printf("%*s%s", first && pad > 0 ? pad : 0, "", remarks[k]);
			first = false;
		}
	if (json_int(e, "trims", 0))
		printf("%*s %lld trims, area %g", first && pad > 0 ? pad : 0, "",
		       (long long)json_int(e, "trims", 0), json_number(e, "area", NAN));
	putchar('\n');
}

static void print_info(const struct telling *t)
{
	const struct model *m = t->m;

	printf("%s: unit %s", t->file, m->unit ? m->unit : "not named");
	if (m->unit_in_mm > 0)
		printf(" (%g mm)", m->unit_in_mm);
	if (m->scale != 1)
		printf(", model space scale %g (coordinates are as in the file)", m->scale);
	printf(", %d entities read\n\n", m->n);
	printf("%5s  %-16s %-14s %-7s%-6s  %s\n", "", "kind", "name", "DE", "order", "points");
	for (int k = 0; k < m->n; k++)
		if (is_told(t, &m->entities[k])) {
			json_t *row = entity_json(&m->entities[k], t->whole_areas);
			print_entity(row);
			json_decref(row);
		}
	for (int k = 0; k < m->n_skipped; k++)
		printf("%sskipped: %d of type %d from D%d: %s\n", k ? "" : "\n",
		       m->skipped[k].count, m->skipped[k].type, m->skipped[k].first_de,
		       m->skipped[k].reason);
}

static int info_run(const struct invocation *i)
{
	struct model m;
	struct entity *chosen;
	int rc = 0;

	if (i->n_words != 1)
		return status_exit(report_error(&i->report, ST_PARAMETER, "name one file"));
	enum status st = reading_open(&m, i->words[0], &chosen, &i->report);
	if (st != ST_OK)
		return status_exit(st);
	struct telling t = { &m, chosen, m.file ? m.file : i->words[0], false };
	t.whole_areas = is_small(&t);
	if (i->json) {
		rc = print_info_json(&t);
	} else {
		print_info(&t);
		for (int k = 0; k < m.n_warnings; k++)
			report_warning(&i->report, "%s", m.warnings[k]);
	}
	model_finish(&m);
	return rc;
}

const struct command command_info = {
	.name = "info",
	.usage = "FILE[#ENTITY]",
	.text = "show what a geometry file holds",
	.help = "Entities read with order, points and where they are closed; entities skipped and why;\n"
	        "unit and scale; of trimmed surfaces the area that is left. --json gives domains, boxes\n"
	        "and, where that does not take long, the areas of whole surfaces too.",
	.first_word = WORD_FILE,
	.run = info_run,
};
