/* export.c - geometry for other programs. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "model_write.h"
#include "number.h"
#include "path.h"
#include "reading.h"
#include "verbs.h"

static const struct option_row export_options[] = {
	{ "--to", NULL, "FILE", "file to write; its extension says in which format" },
	{ "--tolerance", NULL, "T",
	  "largest distance of triangles from the surface, in file units (default: a thousandth of "
	  "the size)" },
	{ "--angle", NULL, "DEG",
	  "largest angle between normals along an edge of a triangle (default: 15)" },
	{ "--join", NULL, "D",
	  "borders of surfaces nearer than this are one (default: a ten-thousandth of the size)" },
	{ 0 },
};

/* Borders listed; of more the longest are. */
enum { BORDERS_MOST = 8 };

/* What is to be written, from all the files named. */
struct collection {
	const struct model_format *format;
	struct model all;
	const char *first; /* file that gave the unit */
	int left_out;      /* entities that the format cannot hold */
};

static enum status same_unit(struct collection *c, const struct model *m, const char *file,
                             const struct report *r)
{
	enum status st = ST_OK;
	if (!c->first) {
		c->first = file;
		c->all.unit_in_mm = m->unit_in_mm;
		c->all.scale = m->scale;
		st = model_set_text(&c->all.unit, m->unit);
	} else if (c->all.unit_in_mm != m->unit_in_mm || c->all.scale != m->scale) {
		return report_error(r, ST_INPUT,
		                    "'%s' is in %s, '%s' in %s; one file has one unit, export them "
		                    "to two",
		                    c->first, c->all.unit ? c->all.unit : "an unknown unit", file,
		                    m->unit ? m->unit : "an unknown unit");
	}
	return st;
}

/*
 * Move the entities meant from one file to the collection: the chosen one, with the surface that a
 * curve lies on, or all that have a number; a .base file gets all that those are made of too.
 */
static enum status collect(struct collection *c, struct model *m, const struct entity *chosen)
{
	int *place = malloc(((size_t)m->n + 1) * sizeof *place);
	enum status st = place ? ST_OK : ST_RESOURCE;
	const int base = chosen && chosen->kind == ENTITY_CURVE_ON_SURFACE ? chosen->surface : -1;
	for (int k = 0; k < m->n && st == ST_OK; k++) {
		struct entity *e = &m->entities[k];
		const bool meant = chosen ? e == chosen : e->number > 0;
		const bool needed = c->format->all && (chosen ? k == base : e->number == 0);
		place[k] = -1;
		if (meant && !c->format->takes(e)) {
			c->left_out++;
			continue;
		}
		if (!meant && !needed)
			continue;
		e->used = !meant;
		place[k] = c->all.n;
		st = model_add(&c->all, e);
	}
	for (int k = 0; k < m->n && st == ST_OK; k++) {
		struct entity *e = place[k] < 0 ? NULL : &c->all.entities[place[k]];
		if (e && e->kind == ENTITY_CURVE_ON_SURFACE && e->surface >= 0)
			e->surface = place[e->surface];
	}
	free(place);
	return st;
}

static enum status collect_name(struct collection *c, const char *name, const struct report *r)
{
	struct model m;
	struct entity *chosen;
	enum status st = reading_open(&m, name, &chosen, r);
	if (st != ST_OK)
		return st;
	for (int k = 0; k < m.n_warnings; k++)
		report_warning(r, "%s: %s", name, m.warnings[k]);
	for (int k = 0; k < m.n_skipped && !chosen; k++)
		report_warning(r, "%s: skipped %d of type %d: %s", name, m.skipped[k].count,
		               m.skipped[k].type, m.skipped[k].reason);
	st = same_unit(c, &m, name, r);
	/* a file written whole keeps what is known of how it was made */
	for (int k = 0; k < m.n_attributes && st == ST_OK && !chosen; k++)
		st = model_set_attribute(&c->all, m.attributes[k].name, m.attributes[k].value);
	if (st == ST_OK)
		st = collect(c, &m, chosen);
	if (st == ST_RESOURCE)
		report_error(r, st, "memory ran out");
	model_finish(&m);
	return st;
}

static int count_numbered(const struct model *m)
{
	int n = 0;
	for (int k = 0; k < m->n; k++)
		n += m->entities[k].number > 0;
	return n;
}

/* An option's number in (0, most], or 0 where it is not given. */
static enum status positive(const struct invocation *i, const char *option, double most,
                            double *out)
{
	const char *text = invocation_value(i, option);
	*out = 0;
	if (!text)
		return ST_OK;
	if (!number_parse(text, out) || !(*out > 0) || *out > most)
		return report_error(&i->report, ST_PARAMETER, "%s %s: expected a number above 0%s",
		                    option, text, isfinite(most) ? " and at most 180" : "");
	return ST_OK;
}

/* The surface that a part of the mesh was made of. */
static const struct entity *surface_of(const struct collection *c, int part)
{
	for (int k = 0; k < c->all.n; k++)
		if (c->all.entities[k].kind == ENTITY_SURFACE && part-- == 0)
			return &c->all.entities[k];
	return NULL;
}

static void print_surface(const char *before, const struct entity *e)
{
	printf("%s%d", before, e->number);
	if (e->name)
		printf(" (%s)", e->name);
	else if (e->de)
		printf(" (D%d)", e->de);
}

/* A gap where borders disagree is much longer than wide, and not much wider than what is closed. */
static bool is_gap(const struct mesh_border *b, const struct mesh_figures *f)
{
	return b->width < 0.01 * b->length && b->width < 100 * f->join;
}

static void tell_borders(const struct collection *c, const struct mesh_figures *f)
{
	const struct mesh_looks *x = &f->looks;
	for (int k = 0; k < x->n_borders && k < BORDERS_MOST; k++) {
		const struct mesh_border *b = &x->borders[k];
		const struct entity *e[2] = { surface_of(c, b->parts[0]),
			                      b->parts[1] < 0 ? NULL : surface_of(c, b->parts[1]) };
		printf("  %s of %d edges, %.4g long, %.2g wide, at %.6g %.6g %.6g, ",
		       is_gap(b, f) ? "gap" : "border", b->edges, b->length, b->width, b->at.x,
		       b->at.y, b->at.z);
		print_surface("surface ", e[0]);
		if (e[1])
			print_surface(" and ", e[1]);
		putchar('\n');
	}
	if (x->n_borders > BORDERS_MOST)
		printf("  and %d shorter ones\n", x->n_borders - BORDERS_MOST);
}

static void tell(const struct collection *c, const char *to, const struct mesh_figures *f)
{
	printf("%s: %d %s", to, count_numbered(&c->all),
	       count_numbered(&c->all) == 1 ? "entity" : "entities");
	if (!c->format->write_mesh) {
		putchar('\n');
		return;
	}
	const struct mesh_looks *x = &f->looks;
	printf(", %d triangles within %.4g and %g degrees", f->triangles, f->tolerance, f->angle);
	if (x->open)
		printf(", %d edges open in %d %s", x->open, x->n_borders,
		       x->n_borders == 1 ? "border" : "borders");
	else
		printf(", closed");
	if (x->multiple)
		printf(", edges of three triangles or more: %d", x->multiple);
	if (x->turned)
		printf(", edges between sides that disagree: %d", x->turned);
	putchar('\n');
	tell_borders(c, f);
}

static json_t *borders_json(const struct collection *c, const struct mesh_looks *x)
{
	json_t *list = json_array();
	for (int k = 0; k < x->n_borders; k++) {
		const struct mesh_border *b = &x->borders[k];
		json_t *o = json_object(), *at = json_array(), *surfaces = json_array();
		const double p[3] = { b->at.x, b->at.y, b->at.z };
		json_set_int(o, "edges", b->edges);
		json_set_number(o, "length", b->length);
		json_set_number(o, "width", b->width);
		for (int d = 0; d < 3; d++)
			json_array_append_new(at, json_real(p[d]));
		json_object_set_new(o, "at", at);
		for (int i = 0; i < 2 && b->parts[i] >= 0; i++)
			json_array_append_new(surfaces,
			                      json_integer(surface_of(c, b->parts[i])->number));
		json_object_set_new(o, "surfaces", surfaces);
		json_array_append_new(list, o);
	}
	return list;
}

static json_t *result_json(const struct collection *c, const char *to, const struct mesh_figures *f)
{
	const bool mesh = c->format->write_mesh;
	const struct mesh_looks *x = &f->looks;
	const struct {
		const char *name;
		int value;
	} counts[] = { { "triangles", f->triangles },
		       { "points", f->points },
		       { "open_edges", x->open },
		       { "multiple_edges", x->multiple },
		       { "turned_edges", x->turned } };
	json_t *o = json_object();
	json_set_text(o, "file", to);
	json_set_text(o, "format", c->format->extension + 1);
	json_set_int(o, "entities", count_numbered(&c->all));
	json_set_int(o, "left_out", c->left_out);
	for (size_t k = 0; k < sizeof counts / sizeof *counts; k++)
		json_object_set_new(o, counts[k].name,
		                    mesh ? json_integer(counts[k].value) : json_null());
	json_object_set_new(o, "borders", mesh ? borders_json(c, x) : json_null());
	json_set_number(o, "tolerance", mesh ? f->tolerance : NAN);
	json_set_number(o, "angle", mesh ? f->angle : NAN);
	json_set_number(o, "join", mesh ? f->join : NAN);
	json_set_number(o, "gap", mesh ? f->gap : NAN);
	return o;
}

static enum status export_all(const struct invocation *i, struct collection *c, const char *to,
                              struct mesh_figures *f)
{
	const struct report *r = &i->report;
	struct mesh_wishes wishes = { 0 };
	struct working working;
	enum status st = positive(i, "--tolerance", INFINITY, &wishes.tolerance);
	if (st == ST_OK)
		st = positive(i, "--angle", 180, &wishes.angle);
	if (st == ST_OK)
		st = positive(i, "--join", INFINITY, &wishes.join);
	for (int k = 0; k < i->n_words && st == ST_OK; k++)
		st = collect_name(c, i->words[k], r);
	if (st != ST_OK)
		return st;
	model_number(&c->all);
	if (!count_numbered(&c->all))
		return report_error(r, ST_INPUT, "'%s' holds %s, and nothing named is that", to,
		                    c->format->holds);
	if (c->left_out)
		report_warning(r, "%d left out: '%s' holds %s", c->left_out, to, c->format->holds);
	working_begin(&working, "making triangles for", to, -1);
	wishes.progress = &working.progress;
	st = model_write(&c->all, c->format, to, &wishes, f, r);
	working_end(&working);
	return st == ST_CANCELLED ? report_error(r, st, "cancelled; '%s' is not written", to) : st;
}

static int export_run(const struct invocation *i)
{
	const char *to = invocation_value(i, "--to");
	struct collection c = { 0 };
	struct mesh_figures figures = { 0 };

	if (!i->n_words || !to)
		return status_exit(report_error(&i->report, ST_PARAMETER,
		                                "name what to export, and the file with --to"));
	c.format = model_format_find(to, &i->report);
	if (!c.format)
		return status_exit(ST_PARAMETER);
	model_init(&c.all);
	enum status st = export_all(i, &c, to, &figures);
	int rc = status_exit(st);
	if (st == ST_OK && i->json)
		rc = print_json(result_json(&c, to, &figures));
	else if (st == ST_OK)
		tell(&c, to, &figures);
	mesh_figures_finish(&figures);
	model_finish(&c.all);
	return rc;
}

const struct command command_export = {
	.name = "export",
	.usage = "FILE[#ENTITY]... --to FILE [--tolerance T] [--angle DEG]",
	.text = "write geometry for other programs",
	.help = "The extension of --to says how: .base, .igs or .iges, .g2 (SINTEF GoTools) hold curves,\n"
	        "surfaces and points, .csv points, .obj, .ply and .stl triangles of the surfaces. Triangles\n"
	        "keep to the tolerance and the angle, leave no gaps where borders meet, and know trims.",
	.options = export_options,
	.first_word = WORD_FILE,
	.words = WORD_FILE,
	.run = export_run,
};
