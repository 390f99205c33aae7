/* iges_format_trims.c - trimmed surfaces for the IGES writer: 144, 142, and 102 and 126 in u,v and in
 * space. */
#include "iges_writer.h"

#include <stdlib.h>

#include "project_curve.h"

/* How far the curves in space may leave the surface, in its sizes. */
static const double space_within = 1e-7;

/* Status numbers: parts of something; and those in a plane of parameters. */
static const char part[] = "00010000", in_parameters[] = "00010500";

/* One curve, or a composite of all. */
static int put_chain(struct iges_writer *w, const int *curves, int n, const char *status)
{
	if (n == 1)
		return curves[0];
	int de = iges_begin(w, 102);
	iges_put_int(w, n, ',');
	for (int i = 0; i < n; i++)
		iges_put_int(w, curves[i], ',');
	iges_end(w, 102, 0, 0, status);
	return de;
}

/* Of no known origin; the curve in u,v is the one that counts. */
int iges_put_curve_on_surface(struct iges_writer *w, int base, int uv, int space, int color,
                              int name, const char *status)
{
	int de = iges_begin(w, 142);
	iges_put_int(w, 0, ',');
	iges_put_int(w, base, ',');
	iges_put_int(w, uv, ',');
	iges_put_int(w, space, ',');
	iges_put_int(w, 1, ',');
	iges_end(w, 142, color, name, status);
	return de;
}

static enum status put_loop(struct iges_writer *w, const struct trim_loop *l,
                            const struct surface *s, int base, int *de)
{
	double tolerance = space_within * surface_size(s);
	int *curves = calloc((size_t)l->n, sizeof *curves);
	enum status st = curves ? ST_OK : ST_RESOURCE;
	for (int i = 0; i < l->n && st == ST_OK; i++)
		curves[i] = iges_put_curve(w, &l->curves[i], in_parameters);
	int uv = st == ST_OK ? put_chain(w, curves, l->n, in_parameters) : 0;
	for (int i = 0; i < l->n && st == ST_OK; i++) {
		struct curve c = { 0 };
		st = project_lift(s, &l->curves[i], tolerance, &c);
		if (st == ST_OK)
			curves[i] = iges_put_curve(w, &c, part);
		curve_finish(&c);
	}
	if (st == ST_OK) {
		int space = put_chain(w, curves, l->n, part);
		*de = iges_put_curve_on_surface(w, base, uv, space, 0, 0, part);
	}
	free(curves);
	return st;
}

/* Does the loop lie inside another? By one of its points. */
static enum status lies_in(const struct trim_loop *inner, struct trim_loop *outer,
                           const struct surface *s, bool *inside)
{
	struct trim one = { outer, 1 };
	struct trim_test *test;
	const struct curve *c = &inner->curves[0];
	struct vec3 p = curve_point(c, 0.5 * (c->domain[0] + c->domain[1]));
	enum status st = trim_test_create(&test, &one, s);
	if (st == ST_OK) {
		*inside = trim_test_inside(test, p.x, p.y);
		trim_test_destroy(test);
	}
	return st;
}

/* One 144: an outer loop (-1: the whole domain) and the inner ones in it. */
static enum status put_face(struct iges_writer *w, const struct entity *e, const int *loops,
                            int outer, int n_outer, int base, int color, int name)
{
	const struct trim *t = &e->trim;
	int *inner = calloc((size_t)t->n, sizeof *inner), n = 0;
	enum status st = inner ? ST_OK : ST_RESOURCE;
	for (int i = 0; i < t->n && st == ST_OK; i++) {
		bool inside = true;
		if (!t->loops[i].outer && n_outer > 1)
			st = lies_in(&t->loops[i], &t->loops[outer], &e->geometry, &inside);
		if (!t->loops[i].outer && inside)
			inner[n++] = loops[i];
	}
	if (st == ST_OK) {
		iges_join_group(w, e, iges_begin(w, 144));
		iges_put_int(w, base, ',');
		iges_put_int(w, outer >= 0, ',');
		iges_put_int(w, n, ',');
		iges_put_int(w, outer >= 0 ? loops[outer] : 0, ',');
		for (int i = 0; i < n; i++)
			iges_put_int(w, inner[i], ',');
		iges_end(w, 144, color, name, "00000000");
	}
	free(inner);
	return st;
}

enum status iges_put_trims(struct iges_writer *w, const struct entity *e, int base, int color,
                           int name)
{
	const struct trim *t = &e->trim;
	int n_outer = 0;
	int *loops = calloc((size_t)t->n, sizeof *loops);
	enum status st = loops ? ST_OK : ST_RESOURCE;
	for (int i = 0; i < t->n && st == ST_OK; i++) {
		n_outer += t->loops[i].outer;
		st = put_loop(w, &t->loops[i], &e->geometry, base, &loops[i]);
	}
	if (st == ST_OK && n_outer == 0)
		st = put_face(w, e, loops, -1, 0, base, color, name);
	for (int i = 0; i < t->n && st == ST_OK; i++)
		if (t->loops[i].outer)
			st = put_face(w, e, loops, i, n_outer, base, color, name);
	free(loops);
	return st;
}
