/* plan_stroke.c - curves cut by planes, then drawn. */
#include "plan_stroke.h"

#include <stdlib.h>

#include "refine.h"
#include "section.h"

enum status plan_stroke(struct stroke *s, const struct camera *camera, const struct curve *c,
                        const struct plan_side *sides, int n)
{
	if (n == 0)
		return stroke_add(s, camera, c, false);
	const struct plan_side *side = &sides[n - 1];
	double *t;
	int m;
	enum status st = curve_crossings(c, side->normal, side->value, &t, &m);
	for (int i = 0; st == ST_OK && i <= m; i++) {
		const double a = i > 0 ? t[i - 1] : c->domain[0];
		const double b = i < m ? t[i] : c->domain[1];
		if (!(a < b) || vec3_dot(curve_point(c, 0.5 * (a + b)), side->normal) < side->value)
			continue;
		struct curve part;
		st = curve_part(&part, c, a, b);
		if (st != ST_OK)
			break;
		st = plan_stroke(s, camera, &part, sides, n - 1);
		curve_finish(&part);
	}
	free(t);
	return st;
}

enum status plan_border(struct stroke *s, const struct camera *camera,
                        const struct surface *surface, int d, int end,
                        const struct plan_side *sides, int n)
{
	struct curve line;
	enum status st = surface_isoparametric(&line, surface, d, surface->domain[d][end]);
	if (st != ST_OK)
		return st;
	st = plan_stroke(s, camera, &line, sides, n);
	curve_finish(&line);
	return st;
}

enum status plan_line(struct stroke *s, double x0, double y0, double x1, double y1)
{
	if (s->n == s->cap) {
		const size_t cap = s->cap ? 2 * s->cap : 16;
		struct stroke_piece *more = realloc(s->pieces, sizeof *more * cap);
		if (!more)
			return ST_RESOURCE;
		s->pieces = more;
		s->cap = cap;
	}
	struct stroke_piece *p = &s->pieces[s->n++];
	p->begins = true;
	for (int k = 0; k < 4; k++) {
		p->p[k][0] = x0 + (x1 - x0) * k / 3;
		p->p[k][1] = y0 + (y1 - y0) * k / 3;
	}
	return ST_OK;
}
