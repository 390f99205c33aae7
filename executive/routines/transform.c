/* transform.c - mirror, move, rotate, scale. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "change.h"
#include "number.h"
#include "refine.h"
#include "text.h"

/* The thing meant: named, or selected last. */
static const struct Ful *meant(const struct act *a, const struct arguments *given)
{
	const char *name = argument_text(given, "name");
	const struct Ful *f =
	        name ? world_find(a->world, name, &a->report) : world_selected(a->world);

	if (f && f->entity.kind == ENTITY_CURVE_ON_SURFACE) {
		report_error(
		        &a->report, ST_PARAMETER,
		        "'%s' lies on a surface and goes where that goes; transform the surface",
		        f->name);
		return NULL;
	}
	if (f && f->entity.kind == ENTITY_POINTS && f->entity.points.dimension != 3) {
		report_error(&a->report, ST_PARAMETER, "'%s' is a list of u, v", f->name);
		return NULL;
	}
	if (!f && !name)
		report_error(&a->report, ST_PARAMETER, "nothing is open");
	return f;
}

static struct vec3 image(const double m[3][4], struct vec3 p)
{
	return vec3(m[0][0] * p.x + m[0][1] * p.y + m[0][2] * p.z + m[0][3],
	            m[1][0] * p.x + m[1][1] * p.y + m[1][2] * p.z + m[1][3],
	            m[2][0] * p.x + m[2][1] * p.y + m[2][2] * p.z + m[2][3]);
}

static void entity_transform(struct entity *e, const double m[3][4])
{
	if (e->kind == ENTITY_CURVE)
		curve_transform(&e->curve, m);
	if (e->kind == ENTITY_SURFACE)
		surface_transform(&e->geometry, m);
	for (int k = 0; e->kind == ENTITY_POINTS && k < e->points.n; k++) {
		double *p = e->points.values + 3 * (size_t)k;
		const struct vec3 q = image(m, vec3(p[0], p[1], p[2]));
		p[0] = q.x;
		p[1] = q.y;
		p[2] = q.z;
	}
}

/* What is done to a thing, or to a copy of it. */
struct transform {
	const char *what, *name; /* name of the copy, NULL: of the thing, made unique */
	double m[3][4];
	bool mirrored;
	const struct unit *unit; /* it gets, or NULL */
};

static const struct unit {
	const char *name;
	double mm;
} units[] = { { "mm", 1 }, { "cm", 10 }, { "m", 1000 }, { "in", 25.4 }, { "ft", 304.8 } };

/* A mirror turns the normal; u turned round turns it back, so that outside stays outside. */
static void turn_u(struct entity *e)
{
	const double *u = e->geometry.domain[0];
	const double m[3][4] = { { -1, 0, 0, u[0] + u[1] }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } };

	surface_reverse(&e->geometry, 0);
	for (int k = 0; k < e->trim.n; k++) {
		struct trim_loop *l = &e->trim.loops[k];
		for (int j = 0; j < l->n; j++) {
			curve_transform(&l->curves[j], m);
			curve_reverse(&l->curves[j]);
		}
		for (int j = 0; j < l->n / 2; j++) {
			const struct curve c = l->curves[j];
			l->curves[j] = l->curves[l->n - 1 - j];
			l->curves[l->n - 1 - j] = c;
		}
	}
}

static enum status may_mirror(const struct act *a, const struct Ful *f)
{
	for (int k = 0; k < world_count(a->world); k++)
		if (world_at(a->world, k)->on == f->id)
			return report_error(&a->report, ST_PARAMETER,
			                    "the curve '%s' lies on '%s'; mirror a copy",
			                    world_at(a->world, k)->name, f->name);
	return ST_OK;
}

static enum status put(struct act *a, const struct Ful *f, const struct transform *t, bool copy,
                       struct entity *e)
{
	const struct origin from = { .copy_of = f->id };
	int id = f->id;
	enum status st;

	world_step_begin(a->world, t->what);
	if (copy)
		st = world_add_from(a->world, t->what, t->name, e, &from, &id, &a->report);
	else
		st = change_end(a, t->what, id, e, true);
	for (int k = 0; k < world_count(a->world) && st == ST_OK && t->unit; k++)
		if (world_at(a->world, k)->id == id || world_at(a->world, k)->on == id)
			st = world_set_unit(a->world, world_at(a->world, k)->id, t->unit->name,
			                    t->unit->mm, &a->report);
	world_step_end(a->world, st == ST_OK);
	return st;
}

static enum status apply(struct act *a, const struct arguments *given, const struct transform *t)
{
	const struct Ful *f = meant(a, given);
	const bool copy = argument_yes(given, "copy", false);
	struct entity e;

	if (!f)
		return ST_PARAMETER;
	enum status st = t->mirrored && !copy ? may_mirror(a, f) : ST_OK;
	if (st == ST_OK)
		st = change_begin(a, f, &e);
	if (st != ST_OK)
		return st;
	entity_transform(&e, t->m);
	if (t->mirrored && e.kind == ENTITY_SURFACE)
		turn_u(&e);
	return put(a, f, t, copy, &e);
}

/* x -> A (x - c) + c */
static void about(double m[3][4], struct vec3 c)
{
	for (int k = 0; k < 3; k++)
		m[k][3] = 0;
	const struct vec3 moved = image((const double(*)[4])m, c);
	m[0][3] = c.x - moved.x;
	m[1][3] = c.y - moved.y;
	m[2][3] = c.z - moved.z;
}

enum status transform_mirror(struct act *a, const struct arguments *given)
{
	const char *plane = argument_text(given, "plane");
	struct vec3 n = vec3(0, 0, 0), c = vec3(0, 0, 0);
	const bool has_normal = argument_vector(given, "normal", &n);

	if (!plane == !has_normal)
		return report_error(&a->report, ST_PARAMETER,
		                    "give plane=x, y or z, or the normal= of another plane");
	argument_vector(given, "point", &c);
	if (plane)
		n = vec3(*plane == 'x', *plane == 'y', *plane == 'z');
	n = vec3_unit(n);
	if (!(vec3_length(n) > 0))
		return report_error(&a->report, ST_PARAMETER, "normal must have a length");
	const double v[3] = { n.x, n.y, n.z };
	const struct Ful *f = meant(a, given);
	if (!f)
		return ST_PARAMETER;
	char *name = text_print("%s-mirror", f->name);
	if (!name)
		return act_memory(a);
	struct transform t = { .what = "mirror", .mirrored = true };
	t.name = world_find(a->world, name, NULL) ? NULL : name;
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++)
			t.m[i][j] = (i == j) - 2 * v[i] * v[j];
	about(t.m, c);
	enum status st = apply(a, given, &t);
	free(name);
	return st;
}

enum status transform_move(struct act *a, const struct arguments *given)
{
	struct vec3 by, from, to;
	const bool has_by = argument_vector(given, "by", &by),
	           has_from = argument_vector(given, "from", &from),
	           has_to = argument_vector(given, "to", &to);

	if (has_from != has_to || has_by == has_to)
		return report_error(&a->report, ST_PARAMETER, "give by=, or from= and to=");
	if (has_to)
		by = vec3_sub(to, from);
	const struct transform t = {
		.what = "move", .m = { { 1, 0, 0, by.x }, { 0, 1, 0, by.y }, { 0, 0, 1, by.z } }
	};
	return apply(a, given, &t);
}

/* Sine and cosine, exact at multiples of 90 degrees. */
static void turn_of(double degrees, double *s, double *c)
{
	static const double sines[] = { 0, 1, 0, -1 };
	const double quarters = degrees / 90;

	if (quarters == floor(quarters)) {
		const int k = (int)(quarters - 4 * floor(quarters / 4));
		*s = sines[k];
		*c = sines[(k + 1) % 4];
		return;
	}
	*s = sin(degrees * M_PI / 180);
	*c = cos(degrees * M_PI / 180);
}

enum status transform_rotate(struct act *a, const struct arguments *given)
{
	struct vec3 axis = vec3(0, 0, 1), at = vec3(0, 0, 0);
	double s, c;

	argument_vector(given, "axis", &axis);
	argument_vector(given, "point", &at);
	axis = vec3_unit(axis);
	if (!(vec3_length(axis) > 0))
		return report_error(&a->report, ST_PARAMETER, "axis must have a length");
	turn_of(argument_number(given, "angle", 0), &s, &c);
	/* Rodrigues */
	const double v[3] = { axis.x, axis.y, axis.z };
	const double cross[3][3] = { { 0, -v[2], v[1] }, { v[2], 0, -v[0] }, { -v[1], v[0], 0 } };
	struct transform t = { .what = "rotate" };
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++)
			t.m[i][j] = (i == j) * c + (1 - c) * v[i] * v[j] + s * cross[i][j];
	about(t.m, at);
	return apply(a, given, &t);
}

/* The factor from the unit of its file to another. */
static enum status take_unit(const struct act *a, const struct arguments *given,
                             struct transform *t, struct vec3 *by)
{
	const struct Ful *f = meant(a, given);
	const char *name = argument_text(given, "unit");

	if (!f)
		return ST_PARAMETER;
	if (!(f->unit_in_mm > 0))
		return report_error(&a->report, ST_PARAMETER,
		                    "the unit of '%s' is not known; give a factor", f->name);
	for (size_t k = 0; k < sizeof units / sizeof *units; k++)
		if (!strcmp(units[k].name, name))
			t->unit = &units[k];
	const double factor = f->unit_in_mm / t->unit->mm;
	*by = vec3(factor, factor, factor);
	return ST_OK;
}

enum status transform_scale(struct act *a, const struct arguments *given)
{
	const char *text = argument_text(given, "factor");
	struct transform t = { .what = "scale" };
	struct vec3 by = vec3(0, 0, 0), at = vec3(0, 0, 0);
	double one;
	enum status st = ST_OK;

	if (!text == !argument_text(given, "unit"))
		return report_error(&a->report, ST_PARAMETER, "give factor=, or unit=");
	if (!text)
		st = take_unit(a, given, &t, &by);
	else if (number_parse(text, &one))
		by = vec3(one, one, one);
	else if (!argument_vector(given, "factor", &by) ||
	         strchr(strchr(text, ',') + 1, ',') == NULL)
		by = vec3(0, 0, 0);
	if (st != ST_OK)
		return st;
	if (!(by.x > 0 && by.y > 0 && by.z > 0))
		return report_error(&a->report, ST_PARAMETER,
		                    "factor is '%s'; it must be a number above 0, or X,Y,Z", text);
	argument_vector(given, "about", &at);
	t.m[0][0] = by.x;
	t.m[1][1] = by.y;
	t.m[2][2] = by.z;
	about(t.m, at);
	return apply(a, given, &t);
}
