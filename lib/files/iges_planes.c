/* iges_planes.c - planes 108 and 190 as bilinear patches over what bounds them. */
#include "iges_reader.h"

#include "refine.h"

/* Parameters are lengths along x and y from o. */
struct frame {
	struct vec3 o, x, y, n;
};

/* x: the first coordinate axis that is not near the normal, laid into the plane. */
static void frame_init(struct frame *f, struct vec3 o, struct vec3 n, const struct vec3 *x)
{
	struct vec3 axis = fabs(n.x) < 0.9 ? vec3(1, 0, 0) : vec3(0, 1, 0);
	if (x)
		axis = *x;
	f->o = o;
	f->n = n;
	f->x = vec3_unit(vec3_along(axis, -vec3_dot(axis, n), n));
	f->y = vec3_cross(n, f->x);
}

/* 108: A x + B y + C z = D. *curve is the one that bounds it, 0 if none. */
static enum status read_equation(struct iges_cursor *c, struct frame *f, int *curve)
{
	double k[4];
	iges_few(c, k, 4);
	*curve = iges_int(c);
	for (int i = 0; i < 4; i++)
		iges_real(c); /* where and how large its symbol is shown */
	double l = vec3_length(vec3(k[0], k[1], k[2]));
	if (c->st == ST_OK && !(l > 0 && isfinite(l) && isfinite(k[3])))
		return iges_fail(c, "its equation is no plane's");
	struct vec3 n = vec3(k[0] / l, k[1] / l, k[2] / l);
	frame_init(f, vec3_scale(n, k[3] / l), n, NULL);
	return c->st;
}

/* 190: point, normal, and in form 1 a direction, which is that of u. */
static enum status read_location(struct iges_cursor *c, struct frame *f)
{
	struct iges *g = c->g;
	int point = iges_int(c), normal = iges_int(c), along = 0;
	struct vec3 o, n, x;
	if (iges_entry(g, c->de)->form == 1)
		along = iges_int(c);
	enum status st = c->st;
	if (st == ST_OK)
		st = iges_point_at(g, point, &o);
	if (st == ST_OK)
		st = iges_direction_at(g, normal, &n);
	if (st == ST_OK && along)
		st = iges_direction_at(g, along, &x);
	if (st != ST_OK)
		return st;
	if (!(vec3_length(n) > 0) || (along && !(vec3_length(vec3_cross(n, x)) > 0)))
		return iges_fail(c, "its directions span no plane");
	frame_init(f, o, vec3_unit(n), along ? &x : NULL);
	return ST_OK;
}

/* Add the box, in the plane's parameters, of a curve. */
static enum status add_curve(struct iges *g, const struct frame *f, int de, int depth,
                             struct box *box)
{
	const struct vec3 axes[3] = { f->x, f->y, f->n };
	struct curve curve;
	struct box own = box_empty();
	double m[3][4];
	enum status st = iges_curve(g, de, depth + 1, &curve, NULL);
	if (st != ST_OK)
		return st;
	for (int i = 0; i < 3; i++) {
		const double row[4] = { axes[i].x, axes[i].y, axes[i].z, -vec3_dot(axes[i], f->o) };
		for (int k = 0; k < 4; k++)
			m[i][k] = row[k];
	}
	curve_transform(&curve, (const double(*)[4])m);
	st = curve_box(&curve, 0, &own);
	if (st == ST_OK)
		box_add_box(box, &own);
	curve_finish(&curve);
	return st;
}

static enum status make_patch(struct surface *out, const struct frame *f, const struct box *b)
{
	const int two[2] = { 2, 2 };
	const double range[2][2] = { { b->lo.x, b->hi.x }, { b->lo.y, b->hi.y } };
	enum status st = surface_init(out, two, two);
	if (st != ST_OK)
		return st;
	for (int d = 0; d < 2; d++)
		for (int i = 0; i < 4; i++)
			out->knots[d][i] = out->domain[d][i / 2] = range[d][i / 2];
	for (int i = 0; i < 2; i++)
		for (int j = 0; j < 2; j++)
			surface_set_point(
			        out, i, j,
			        vec3_along(vec3_along(f->o, range[0][i], f->x), range[1][j], f->y),
			        1);
	return ST_OK;
}

enum status iges_plane(struct iges_cursor *c, int depth, struct surface *out)
{
	struct iges *g = c->g;
	const struct iges_entry *e = iges_entry(g, c->de);
	struct frame f;
	struct box b = box_empty();
	int curve = 0;
	if (e->type == 108 && e->form < 0)
		return iges_fail(c, "a hole in a plane");
	enum status st = e->type == 108 ? read_equation(c, &f, &curve) : read_location(c, &f);
	if (st == ST_OK && curve)
		st = add_curve(g, &f, curve, depth, &b);
	for (int i = e->first_edge; i >= 0 && st == ST_OK; i = g->bounds[i].next)
		st = add_curve(g, &f, g->bounds[i].de, depth, &b);
	if (st != ST_OK)
		return st;
	if (box_is_empty(&b))
		return iges_refuse(g, "a plane without bounds, and no face on it that bounds it");
	double least = 1e-9 * box_diagonal(&b);
	if (!(b.hi.x - b.lo.x > least && b.hi.y - b.lo.y > least))
		return iges_refuse(g, "a plane whose bounds hold no area");
	return make_patch(out, &f, &b);
}
