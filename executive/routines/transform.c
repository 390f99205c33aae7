/* transform.c - mirror, move, rotate, scale. */
#include <math.h>
#include <string.h>

#include "change.h"
#include "number.h"
#include "refine.h"

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
	for (int k = 0; k < e->points.n && e->kind == ENTITY_POINTS; k++) {
		double *p = e->points.values + 3 * (size_t)k;
		const struct vec3 q = image(m, vec3(p[0], p[1], p[2]));
		p[0] = q.x;
		p[1] = q.y;
		p[2] = q.z;
	}
}

static enum status apply(struct act *a, const struct arguments *given, const char *what,
                         const double m[3][4])
{
	const struct Ful *f = meant(a, given);
	struct entity e;

	if (!f)
		return ST_PARAMETER;
	enum status st = change_begin(a, f, &e);
	if (st != ST_OK)
		return st;
	entity_transform(&e, m);
	if (!argument_yes(given, "copy", false))
		return change_end(a, what, f->id, &e, true);
	const struct origin from = { .copy_of = f->id };
	return world_add_from(a->world, what, NULL, &e, &from, NULL, &a->report);
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
	double m[3][4];
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++)
			m[i][j] = (i == j) - 2 * v[i] * v[j];
	about(m, c);
	return apply(a, given, "mirror", (const double(*)[4])m);
}

enum status transform_move(struct act *a, const struct arguments *given)
{
	struct vec3 by = vec3(0, 0, 0);

	argument_vector(given, "by", &by);
	const double m[3][4] = { { 1, 0, 0, by.x }, { 0, 1, 0, by.y }, { 0, 0, 1, by.z } };
	return apply(a, given, "move", m);
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
	double m[3][4];
	for (int i = 0; i < 3; i++)
		for (int j = 0; j < 3; j++)
			m[i][j] = (i == j) * c + (1 - c) * v[i] * v[j] + s * cross[i][j];
	about(m, at);
	return apply(a, given, "rotate", (const double(*)[4])m);
}

enum status transform_scale(struct act *a, const struct arguments *given)
{
	const char *text = argument_text(given, "by");
	struct vec3 by, at = vec3(0, 0, 0);
	double one;

	if (number_parse(text, &one))
		by = vec3(one, one, one);
	else if (!argument_vector(given, "by", &by))
		by = vec3(0, 0, 0);
	if (!(fabs(by.x) > 0 && fabs(by.y) > 0 && fabs(by.z) > 0))
		return report_error(&a->report, ST_PARAMETER,
		                    "by is '%s'; it must be a factor, or X,Y,Z, none of them 0",
		                    text);
	argument_vector(given, "point", &at);
	double m[3][4] = { { by.x, 0, 0, 0 }, { 0, by.y, 0, 0 }, { 0, 0, by.z, 0 } };
	about(m, at);
	return apply(a, given, "scale", (const double(*)[4])m);
}
