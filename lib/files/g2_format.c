/* g2_format.c - writer of .g2. */
#include "file.h"
#include "g2.h"
#include "refine.h"

static void add_header(struct text *t, int class, const struct entity *e)
{
	text_addf(t, "%d 1 0 ", class);
	if (e->has_color)
		text_addf(t, "4 %.0f %.0f %.0f 255\n", 255.0 * e->color[0], 255.0 * e->color[1],
		          255.0 * e->color[2]);
	else
		text_add(t, "0\n");
}

static void add_numbers(struct text *t, const double *x, size_t n)
{
	for (size_t i = 0; i < n; i++) {
		if (i)
			text_add(t, " ");
		text_add_number(t, x[i]);
	}
	text_add(t, "\n");
}

/* GoTools takes all that the knots define, and wants them clamped. */
static bool is_whole(int order, int n, const double *knots, const double domain[2])
{
	return knots[0] == domain[0] && knots[n + order - 1] == domain[1] &&
	       knots[order - 1] == domain[0] && knots[n] == domain[1];
}

/* Weights that are all 1 are not written. */
static bool weighted(const double *points, size_t n)
{
	for (size_t i = 0; i < n; i++)
		if (points[4 * i + 3] != 1)
			return true;
	return false;
}

static void add_curve(struct text *t, const struct entity *e, const struct curve *c)
{
	struct curve part = { 0 };
	if (!is_whole(c->order, c->n, c->knots, c->domain)) {
		if (curve_part(&part, c, c->domain[0], c->domain[1]) != ST_OK)
			t->failed = true;
		c = &part;
	}
	bool rational = weighted(c->points, (size_t)c->n);
	add_header(t, 100, e);
	text_addf(t, "3 %d\n%d %d\n", rational, c->n, c->order);
	add_numbers(t, c->knots, (size_t)c->n + c->order);
	for (int i = 0; i < c->n; i++)
		add_numbers(t, c->points + (size_t)4 * i, rational ? 4 : 3);
	text_add(t, "\n");
	curve_finish(&part);
}

static void add_surface(struct text *t, const struct entity *e)
{
	const struct surface *s = &e->geometry;
	struct surface part = { 0 };
	if (!is_whole(s->order[0], s->n[0], s->knots[0], s->domain[0]) ||
	    !is_whole(s->order[1], s->n[1], s->knots[1], s->domain[1])) {
		if (surface_part(&part, s, s->domain) != ST_OK)
			t->failed = true;
		s = &part;
	}
	bool rational = weighted(s->points, (size_t)s->n[0] * s->n[1]);
	add_header(t, 200, e);
	text_addf(t, "3 %d\n", rational);
	for (int d = 0; d < 2; d++) {
		text_addf(t, "%d %d\n", s->n[d], s->order[d]);
		add_numbers(t, s->knots[d], (size_t)s->n[d] + s->order[d]);
	}
	for (int j = 0; j < s->n[1]; j++)
		for (int i = 0; i < s->n[0]; i++)
			add_numbers(t, s->points + 4 * ((size_t)i * s->n[1] + j), rational ? 4 : 3);
	text_add(t, "\n");
	surface_finish(&part);
}

bool g2_holds(const struct entity *e)
{
	return e->kind == ENTITY_CURVE || e->kind == ENTITY_SURFACE ||
	       (e->kind == ENTITY_CURVE_ON_SURFACE && e->space.order > 0) ||
	       (e->kind == ENTITY_POINTS && e->points.dimension == 3 && e->points.n > 0);
}

void g2_format(const struct model *m, struct text *out)
{
	for (int i = 0; i < m->n && !out->failed; i++) {
		const struct entity *e = &m->entities[i];
		if (!g2_holds(e))
			continue;
		if (e->kind == ENTITY_SURFACE) {
			add_surface(out, e);
		} else if (e->kind == ENTITY_POINTS) {
			add_header(out, 400, e);
			text_addf(out, "%d\n", e->points.n);
			for (int k = 0; k < e->points.n; k++)
				add_numbers(out, e->points.values + (size_t)3 * k, 3);
			text_add(out, "\n");
		} else {
			add_curve(out, e, e->kind == ENTITY_CURVE ? &e->curve : &e->space);
		}
	}
}

enum status g2_write(const struct model *m, const char *path, const struct report *r)
{
	struct text t = { 0 };
	int trimmed = 0;
	for (int i = 0; i < m->n; i++)
		trimmed += m->entities[i].kind == ENTITY_SURFACE && m->entities[i].trim.n > 0;
	if (trimmed)
		report_warning(r, "'%s' holds %d trimmed %s whole: trims are not written to .g2",
		               path, trimmed, trimmed == 1 ? "surface" : "surfaces");
	g2_format(m, &t);
	enum status st =
	        t.failed ? report_error(r, ST_RESOURCE, "cannot write '%s': memory ran out", path)
	                 : file_write(path, t.s ? t.s : "", t.n, r);
	text_finish(&t);
	return st;
}
