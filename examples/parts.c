/* parts.c - what several examples are made with. */
#include <stdlib.h>
#include <string.h>

#include "example.h"
#include "fit.h"
#include "refine.h"

enum status example_add(struct model *m, struct surface *s, const char *name, unsigned color)
{
	struct entity e;
	entity_init(&e, ENTITY_SURFACE);
	e.has_color = true;
	for (int k = 0; k < 3; k++)
		e.color[k] = (color >> (16 - 8 * k) & 0xff) / 255.f;
	e.name = strdup(name);
	e.geometry = *s;
	*s = (struct surface){ 0 };
	enum status st = e.name ? model_add(m, &e) : ST_RESOURCE;
	if (st != ST_OK)
		entity_finish(&e);
	return st;
}

void example_mirror(struct surface *s)
{
	static const double mirror[3][4] = { { 1, 0, 0, 0 }, { 0, -1, 0, 0 }, { 0, 0, 1, 0 } };
	surface_transform(s, mirror);
	surface_reverse(s, 0);
}

enum status example_add_mirrored(struct model *m, struct surface *s, const char *name,
                                 const char *mirrored, unsigned color)
{
	struct surface other;
	enum status st = surface_copy(&other, s);
	if (st != ST_OK) {
		surface_finish(s);
		return st;
	}
	example_mirror(&other);
	st = example_add(m, s, name, color);
	if (st == ST_OK)
		st = example_add(m, &other, mirrored, color);
	surface_finish(&other);
	return st;
}

enum status table_init(struct table *t, const double (*xy)[2], int n, const struct report *r)
{
	struct vec3 *p = malloc((size_t)n * sizeof *p);
	if (!p)
		return ST_RESOURCE;
	for (int i = 0; i < n; i++)
		p[i] = vec3(xy[i][0], xy[i][1], 0);
	enum status st = fit_curve(&t->through, p, n, 4, FIT_CHORD, r);
	free(p);
	return st;
}

void table_finish(struct table *t)
{
	curve_finish(&t->through);
}

double table_value(const struct table *t, double x)
{
	double lo = 0, hi = 1; /* x(parameter) rises: halve until no double lies between */
	for (;;) {
		double mid = (lo + hi) / 2;
		struct vec3 p = curve_point(&t->through, mid);
		if (p.x == x || mid <= lo || mid >= hi)
			return p.y;
		if (p.x < x)
			lo = mid;
		else
			hi = mid;
	}
}
