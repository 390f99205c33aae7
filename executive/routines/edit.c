/* edit.c - control points, degrees, knots, parts; curves through points, ruled surfaces. */
#include <stdlib.h>
#include <string.h>

#include "change.h"
#include "construct.h"
#include "fit.h"
#include "number.h"
#include "refine.h"
#include "text.h"

enum { KNOTS_MAX = 4096 };

static enum entity_kind kind_of(const struct act *a)
{
	return (enum entity_kind)a->routine->detail;
}

/* "5" of a curve, "5,2" of a surface. */
static enum status take_index(const struct act *a, const struct arguments *given,
                              const struct entity *e, int *i, int *j)
{
	const char *text = argument_text(given, "index");
	const bool surface = e->kind == ENTITY_SURFACE;
	const int n = surface ? e->geometry.n[0] : e->curve.n, m = surface ? e->geometry.n[1] : 1;
	double x, y = 0;
	const bool read = surface ? argument_pair(text, ',', &x, &y) : number_parse(text, &x);

	if (!read || !(x >= 0 && x < n && y >= 0 && y < m) || x != (int)x || y != (int)y)
		return surface ? report_error(&a->report, ST_PARAMETER,
		                              "index is '%s'; it must be I,J, 0,0 to %d,%d", text,
		                              n - 1, m - 1)
		               : report_error(&a->report, ST_PARAMETER,
		                              "index is '%s'; it must be 0 to %d", text, n - 1);
	*i = (int)x;
	*j = (int)y;
	return ST_OK;
}

enum status edit_point(struct act *a, const struct arguments *given)
{
	const struct Ful *f = act_current_kind(a, kind_of(a));
	struct vec3 to;
	const bool moves = argument_vector(given, "to", &to);
	const char *weight = argument_text(given, "weight");
	struct entity e;
	int i = 0, j = 0;

	if (!f)
		return ST_PARAMETER;
	if (!moves && !weight)
		return report_error(&a->report, ST_PARAMETER, "give to=, or weight=, or both");
	enum status st = take_index(a, given, &f->entity, &i, &j);
	if (st == ST_OK)
		st = change_begin(a, f, &e);
	if (st != ST_OK)
		return st;
	char what[64];
	double w;
	if (e.kind == ENTITY_SURFACE) {
		const struct vec3 at = surface_get_point(&e.geometry, i, j, &w);
		snprintf(what, sizeof what, "move point %d,%d", i, j);
		surface_set_point(&e.geometry, i, j, moves ? to : at,
		                  argument_number(given, "weight", w));
		st = surface_check(&e.geometry, f->name, &a->report);
	} else {
		const struct vec3 at = curve_get_point(&e.curve, i, &w);
		snprintf(what, sizeof what, "move point %d", i);
		to.z = e.kind == ENTITY_CURVE_ON_SURFACE ? 0 : to.z;
		curve_set_point(&e.curve, i, moves ? to : at, argument_number(given, "weight", w));
		st = curve_check(&e.curve, f->name, &a->report);
	}
	if (st == ST_OK)
		return change_end(a, what, f->id, &e, true);
	entity_finish(&e);
	return st;
}

static int direction(const struct arguments *given)
{
	const char *d = argument_text(given, "along");

	return d && !strcmp(d, "v");
}

enum status edit_elevate(struct act *a, const struct arguments *given)
{
	const struct Ful *f = act_current_kind(a, kind_of(a));
	const int order = (int)argument_number(given, "order", 0);
	struct entity e;

	if (!f)
		return ST_PARAMETER;
	const int by = order - (f->entity.kind == ENTITY_SURFACE
	                                ? f->entity.geometry.order[direction(given)]
	                                : f->entity.curve.order);
	if (by <= 0)
		return report_error(&a->report, ST_PARAMETER,
		                    "order is %d; it must be above the present one, %d", order,
		                    order - by);
	enum status st = change_begin(a, f, &e);
	if (st != ST_OK)
		return st;
	if (e.kind == ENTITY_SURFACE) {
		struct surface s;
		st = surface_elevate(&s, &e.geometry, direction(given), by);
		if (st == ST_OK) {
			surface_finish(&e.geometry);
			e.geometry = s;
		}
	} else {
		struct curve c;
		st = curve_elevate(&c, &e.curve, by);
		if (st == ST_OK) {
			curve_finish(&e.curve);
			e.curve = c;
		}
	}
	if (st == ST_OK)
		return change_end(a, "raise the degree", f->id, &e, false);
	entity_finish(&e);
	return change_failed(a, st, "the degree would be above 25, the highest there is");
}

static int compare(const void *x, const void *y)
{
	const double a = *(const double *)x, b = *(const double *)y;

	return (a > b) - (a < b);
}

/* "0.2,0.4" in rising order; *out is fresh. */
static enum status take_knots(const struct act *a, const struct arguments *given, double **out,
                              int *n)
{
	const char *p = argument_text(given, "knots"), *end = p + strlen(p);
	bool good = true;

	*n = 0;
	*out = malloc(KNOTS_MAX * sizeof **out);
	if (!*out)
		return act_memory(a);
	while (good && *n < KNOTS_MAX && (good = number_read(&p, end, &(*out)[*n]))) {
		++*n;
		if (p == end)
			break;
		good = *p++ == ',';
	}
	qsort(*out, (size_t)*n, sizeof **out, compare);
	if (good && p == end)
		return ST_OK;
	free(*out);
	*out = NULL;
	return report_error(&a->report, ST_PARAMETER, "knots is '%s'; it must be numbers by comma",
	                    argument_text(given, "knots"));
}

enum status edit_insert(struct act *a, const struct arguments *given)
{
	const struct Ful *f = act_current_kind(a, kind_of(a));
	double *at = NULL;
	struct entity e;
	int n;

	if (!f)
		return ST_PARAMETER;
	enum status st = take_knots(a, given, &at, &n);
	if (st != ST_OK)
		return st;
	st = change_begin(a, f, &e);
	if (st != ST_OK) {
		free(at);
		return st;
	}
	if (e.kind == ENTITY_SURFACE) {
		struct surface s;
		st = surface_insert(&s, &e.geometry, direction(given), at, n);
		if (st == ST_OK) {
			surface_finish(&e.geometry);
			e.geometry = s;
		}
	} else {
		struct curve c;
		st = curve_insert(&c, &e.curve, at, n);
		if (st == ST_OK) {
			curve_finish(&e.curve);
			e.curve = c;
		}
	}
	free(at);
	if (st == ST_OK)
		return change_end(a, n == 1 ? "insert a knot" : "insert knots", f->id, &e, false);
	entity_finish(&e);
	return change_failed(
	        a, st,
	        "a knot would lie outside the domain, or stand there more often than the "
	        "degree");
}

/* The part of e below (0) or above (1) the cut. */
static enum status take_part(struct entity *e, int d, double at, int which)
{
	enum status st;

	if (e->kind == ENTITY_SURFACE) {
		double range[2][2];
		struct surface s;
		memcpy(range, e->geometry.domain, sizeof range);
		range[d][!which] = at;
		st = surface_part(&s, &e->geometry, (const double(*)[2])range);
		if (st == ST_OK) {
			surface_finish(&e->geometry);
			e->geometry = s;
		}
		return st;
	}
	struct curve c;
	const double *domain = e->curve.domain;
	st = curve_part(&c, &e->curve, which ? at : domain[0], which ? domain[1] : at);
	if (st == ST_OK) {
		curve_finish(&e->curve);
		e->curve = c;
		curve_finish(&e->space);
		e->space = (struct curve){ 0 };
	}
	return st;
}

static enum status may_split(const struct act *a, const struct Ful *f, int d, double at)
{
	const double *domain = f->entity.kind == ENTITY_SURFACE ? f->entity.geometry.domain[d]
	                                                        : f->entity.curve.domain;

	if (!(at > domain[0] && at < domain[1]))
		return report_error(&a->report, ST_PARAMETER,
		                    "at is %.9g; it must be inside the domain, %.9g to %.9g", at,
		                    domain[0], domain[1]);
	if (f->entity.kind == ENTITY_SURFACE && f->entity.trim.n)
		return report_error(&a->report, ST_PARAMETER,
		                    "'%s' is trimmed; only surfaces that are not can be split",
		                    f->name);
	for (int k = 0; k < world_count(a->world); k++)
		if (world_at(a->world, k)->on == f->id)
			return report_error(&a->report, ST_PARAMETER,
			                    "the curve '%s' lies on '%s'; close it first",
			                    world_at(a->world, k)->name, f->name);
	return ST_OK;
}

enum status edit_split(struct act *a, const struct arguments *given)
{
	const struct Ful *f = act_current_kind(a, kind_of(a));
	const double at = argument_number(given, "at", 0);
	const int d = direction(given);
	struct entity low, high;

	if (!f)
		return ST_PARAMETER;
	enum status st = may_split(a, f, d, at);
	if (st == ST_OK)
		st = change_begin(a, f, &low);
	if (st != ST_OK)
		return st;
	st = change_begin(a, f, &high);
	if (st != ST_OK) {
		entity_finish(&low);
		return st;
	}
	const int id = f->id;
	const struct origin from = { .copy_of = id, .on = f->on };
	st = take_part(&low, d, at, 0);
	if (st == ST_OK)
		st = take_part(&high, d, at, 1);
	if (st != ST_OK) {
		entity_finish(&low);
		entity_finish(&high);
		return change_failed(a, st, "it cannot be split there");
	}
	world_step_begin(a->world, "split");
	st = world_replace(a->world, "split", id, &low, &a->report);
	if (st == ST_OK)
		st = world_add_from(a->world, "split", NULL, &high, &from, NULL, &a->report);
	else
		entity_finish(&high);
	world_step_end(a->world, st == ST_OK);
	return st;
}

/* Rows by semicolon, or a point list that is open; *out is fresh. */
static enum status take_points(const struct act *a, const char *text, struct vec3 **out, int *n)
{
	const struct Ful *f = world_find(a->world, text, NULL);
	const struct point_list *l = f ? &f->entity.points : NULL;
	size_t room = 1;

	*out = NULL;
	*n = 0;
	if (f && (f->entity.kind != ENTITY_POINTS || l->dimension != 3))
		return report_error(&a->report, ST_PARAMETER, "'%s' is no list of points in space",
		                    text);
	for (const char *p = text; *p; p++)
		room += *p == ';';
	*out = malloc((l ? (size_t)l->n + 1 : room) * sizeof **out);
	if (!*out)
		return act_memory(a);
	for (int k = 0; l && k < l->n; k++)
		(*out)[(*n)++] = vec3(l->values[3 * k], l->values[3 * k + 1], l->values[3 * k + 2]);
	for (const char *p = text, *end = text + strlen(text); !l && p < end; p += p < end) {
		double v[3] = { 0 };
		for (int c = 0; c < 3 && number_read(&p, end, &v[c]) && *p == ',' && c < 2; c++)
			p++;
		(*out)[(*n)++] = vec3(v[0], v[1], v[2]);
	}
	return ST_OK;
}

enum status edit_fit(struct act *a, const struct arguments *given)
{
	static const char *const words[] = { "uniform", "chord", "centripetal" };
	static const enum fit_parameters ways[] = { FIT_UNIFORM, FIT_CHORD, FIT_CENTRIPETAL };
	const char *how = argument_text(given, "parameters");
	enum fit_parameters way = FIT_CHORD;
	struct vec3 *points;
	struct entity e;
	int n;

	for (int k = 0; k < 3; k++)
		if (!strcmp(how, words[k]))
			way = ways[k];
	enum status st = take_points(a, argument_text(given, "points"), &points, &n);
	if (st != ST_OK)
		return st;
	entity_init(&e, ENTITY_CURVE);
	st = fit_curve(&e.curve, points, n, (int)argument_number(given, "order", 4), way,
	               &a->report);
	free(points);
	if (st != ST_OK)
		return st;
	return world_add(a->world, "fit points", argument_text(given, "name"), &e, NULL,
	                 &a->report);
}

/* A curve as it is in space. NULL, and a sentence, of one that is known in u, v only. */
static const struct curve *in_space(const struct act *a, const char *name)
{
	const struct Ful *f = world_find(a->world, name, &a->report);

	if (!f || f->entity.kind == ENTITY_CURVE)
		return f ? &f->entity.curve : NULL;
	if (f->entity.kind == ENTITY_CURVE_ON_SURFACE && f->entity.space.order)
		return &f->entity.space;
	report_error(
	        &a->report, ST_PARAMETER,
	        "'%s' is known in the parameters of its surface only; a curve in space is needed",
	        name);
	return NULL;
}

/* The two curves named; the second a copy, turned round where that is asked for. */
static enum status take_edges(const struct act *a, const struct arguments *given,
                              const struct curve **from, struct curve *to)
{
	char *names = strdup(argument_text(given, "curves")),
	     *comma = names ? strchr(names, ',') : NULL;
	const struct curve *second = NULL;
	enum status st = ST_PARAMETER;

	if (!names)
		return act_memory(a);
	if (comma)
		*comma = 0;
	if (!comma)
		report_error(&a->report, st, "curves is '%s'; it must be two names by comma",
		             names);
	else if ((*from = in_space(a, names)))
		second = in_space(a, comma + 1);
	free(names);
	if (!second)
		return st;
	st = curve_copy(to, second);
	if (st == ST_OK && argument_yes(given, "reverse", false))
		curve_reverse(to);
	return st == ST_OK ? st : act_memory(a);
}

enum status edit_ruled(struct act *a, const struct arguments *given)
{
	const struct curve *from = NULL;
	struct curve to;
	struct entity e;
	enum status st = take_edges(a, given, &from, &to);

	if (st != ST_OK)
		return st;
	entity_init(&e, ENTITY_SURFACE);
	st = make_ruled(&e.geometry, from, &to);
	curve_finish(&to);
	if (st != ST_OK)
		return change_failed(a, st, "the degree would be above 25, the highest there is");
	return world_add(a->world, "ruled surface", argument_text(given, "name"), &e, NULL,
	                 &a->report);
}
