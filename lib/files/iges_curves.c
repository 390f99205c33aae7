/* iges_curves.c - curves 100 102 104 106 110 112 126 and points 106 116 as NURBS and lists. */
#include "iges_reader.h"

#include <stdlib.h>

#include "construct.h"
#include "refine.h"

double iges_tolerance(const struct iges *g, double size)
{
	/* what the author calls the smallest distance, as long as it is small for the entity */
	return fmax(1e-6 * size, fmin(g->header.resolution, 1e-4 * size));
}

/* 100: z, centre, start, end; counterclockwise in the plane z. */
static enum status read_arc(struct iges_cursor *c, int depth, struct curve *out)
{
	double p[7];
	(void)depth;
	iges_few(c, p, 7);
	if (c->st != ST_OK)
		return c->st;
	double x0 = p[3] - p[1], y0 = p[4] - p[2], x1 = p[5] - p[1], y1 = p[6] - p[2];
	double a = atan2(y0, x0), b = atan2(y1, x1), r = hypot(x0, y0);
	if (!(r > 0) || !isfinite(r))
		return iges_fail(c, "an arc of radius %g", r);
	if (a < 0)
		a += 2 * M_PI;
	while (b <= a)
		b += 2 * M_PI;
	if (p[3] == p[5] && p[4] == p[6])
		b = a + 2 * M_PI;
	return make_arc(out, vec3(p[1], p[2], p[0]), vec3(1, 0, 0), vec3(0, 1, 0), r, a,
	                fmin(b, a + 2 * M_PI));
}

/* Size of all curves together, for a tolerance. */
static double curves_size(const struct curve *c, int n)
{
	struct box b = box_empty();
	for (int i = 0; i < n; i++)
		for (int k = 0; k < c[i].n; k++)
			box_add_point(&b, curve_get_point(&c[i], k, NULL));
	return box_is_empty(&b) ? 0 : box_diagonal(&b);
}

/* 102: curves one after the other; points between them (116, 132) carry no shape. */
static enum status read_composite(struct iges_cursor *c, int depth, struct curve *out)
{
	struct iges *g = c->g;
	int n = iges_count(c, "number of parts", 1, g->n_entries), have = 0;
	if (c->st != ST_OK)
		return c->st;
	struct curve *parts = calloc((size_t)n, sizeof *parts);
	enum status st = parts ? ST_OK : ST_RESOURCE;
	for (int i = 0; i < n && st == ST_OK; i++) {
		int de;
		if (!iges_part(c, &de))
			st = c->st;
		else if ((st = iges_curve(g, de, depth + 1, &parts[have], NULL)) == ST_OK)
			have++;
	}
	if (st == ST_OK)
		st = iges_pass(g, make_composite(out, parts, have,
		                                 iges_tolerance(g, curves_size(parts, have)),
		                                 &g->store.report));
	for (int i = 0; parts && i < have; i++)
		curve_finish(&parts[i]);
	free(parts);
	return st;
}

/* 104: six coefficients, z, start, end. */
static enum status read_conic(struct iges_cursor *c, int depth, struct curve *out)
{
	double p[11];
	(void)depth;
	iges_few(c, p, 11);
	if (c->st != ST_OK)
		return c->st;
	return iges_pass(c->g, make_conic(out, p, p[6], vec3(p[7], p[8], p[6]),
	                                  vec3(p[9], p[10], p[6]), &c->g->store.report));
}

/* The points of a 106: pairs with one z, triples, or triples with a vector each. Fresh. */
static enum status read_tuples(struct iges_cursor *c, struct vec3 **out, int *n)
{
	static const int width[4] = { 0, 2, 3, 6 };
	int kind = iges_count(c, "kind of its tuples", 1, 3);
	double z = 0, x[6];
	*n = iges_count(c, "number of points", 1, iges_left(c));
	if (kind == 1)
		z = iges_real(c);
	if (c->st != ST_OK)
		return c->st;
	if ((int64_t)*n * width[kind] > iges_left(c) + 1)
		return iges_fail(c, "%d points, more than the file has left", *n);
	*out = calloc((size_t)*n, sizeof **out);
	if (!*out)
		return ST_RESOURCE;
	for (int i = 0; i < *n; i++) {
		iges_reals(c, x, (size_t)width[kind], width[kind], 6);
		(*out)[i] = vec3(x[0], x[1], kind == 1 ? z : x[2]);
	}
	if (c->st != ST_OK)
		free(*out);
	return c->st;
}

/* 106 forms 11 to 13 and 63: a path through points. */
static enum status read_path(struct iges_cursor *c, int depth, struct curve *out)
{
	struct vec3 *p;
	int n;
	(void)depth;
	enum status st = read_tuples(c, &p, &n);
	if (st != ST_OK)
		return st;
	st = n < 2 ? iges_fail(c, "a path of one point") : make_polyline(out, p, n);
	free(p);
	return st;
}

static enum status read_line(struct iges_cursor *c, int depth, struct curve *out)
{
	double p[6];
	(void)depth;
	if (iges_entry(c->g, c->de)->form != 0)
		return iges_fail(c, "a line without ends");
	iges_few(c, p, 6);
	if (c->st != ST_OK)
		return c->st;
	return make_line(out, vec3(p[0], p[1], p[2]), vec3(p[3], p[4], p[5]));
}

/* 112: type, continuity, dimension, segments, breaks, coefficients, values at the end. */
static enum status read_power(struct iges_cursor *c, int depth, struct curve *out)
{
	(void)depth;
	iges_int(c), iges_int(c), iges_int(c);
	int n = iges_count(c, "number of segments", 1, iges_left(c) / 13);
	if (c->st != ST_OK)
		return c->st;
	double *t = calloc((size_t)n + 1, sizeof *t);
	double(*k)[3][4] = calloc((size_t)n, sizeof *k);
	enum status st = t && k ? ST_OK : ST_RESOURCE;
	if (st == ST_OK) {
		iges_reals(c, t, (size_t)n + 1, 1, 1);
		iges_reals(c, k[0][0], (size_t)n * 12, 12, 12);
		st = c->st;
	}
	for (int i = 0; i < 12; i++)
		iges_real(c);
	if (st == ST_OK) {
		struct box b = box_empty();
		for (int i = 0; i < n; i++)
			box_add_point(&b, vec3(k[i][0][0], k[i][1][0], k[i][2][0]));
		st = iges_pass(c->g, make_power_curve(out, t, n, (const double(*)[3][4])k,
		                                      iges_tolerance(c->g, box_diagonal(&b)),
		                                      &c->g->store.report));
	}
	free(t);
	free(k);
	return st;
}

static enum status read_spline(struct iges_cursor *c, int depth, struct curve *out)
{
	(void)depth;
	return iges_spline_curve(c, out);
}

static const struct {
	int type;
	enum status (*read)(struct iges_cursor *c, int depth, struct curve *out);
} curves[] = {
	{ 100, read_arc },  { 102, read_composite }, { 104, read_conic },  { 106, read_path },
	{ 110, read_line }, { 112, read_power },     { 126, read_spline },
};
enum { N_CURVES = sizeof curves / sizeof curves[0] };

bool iges_is_curve(const struct iges_entry *e)
{
	int i = 0;
	while (i < N_CURVES && curves[i].type != e->type)
		i++;
	return i < N_CURVES &&
	       (e->type != 106 || (e->form >= 11 && e->form <= 13) || e->form == 63);
}

bool iges_is_points(const struct iges_entry *e)
{
	return e->type == 116 || (e->type == 106 && e->form >= 1 && e->form <= 3);
}

enum status iges_curve(struct iges *g, int de, int depth, struct curve *out, struct iges_cursor *c)
{
	struct iges_cursor own;
	double m[3][4];
	bool any;
	*out = (struct curve){ 0 };
	if (!c)
		c = &own;
	enum status st = iges_open_nested(g, de, depth, c);
	if (st != ST_OK)
		return st;
	const struct iges_entry *e = iges_entry(g, de);
	if (!iges_is_curve(e))
		return iges_refuse(g, "D%d of type %d where a curve is expected", de, e->type);
	for (int i = 0; i < N_CURVES; i++)
		if (curves[i].type == e->type)
			st = iges_pass(g, curves[i].read(c, depth, out));
	if (st == ST_OK)
		st = iges_matrix(g, e->transform, m, &any);
	if (st == ST_OK && any)
		curve_transform(out, (const double(*)[4])m);
	if (st == ST_OK)
		st = iges_pass(g, curve_check(out, "the curve", &g->store.report));
	if (st != ST_OK)
		curve_finish(out);
	return st;
}

enum status iges_points(struct iges *g, int de, struct point_list *out, struct iges_cursor *c)
{
	const struct iges_entry *e = iges_entry(g, de);
	double m[3][4];
	bool any;
	struct vec3 *p = NULL;
	int n = 1;
	*out = (struct point_list){ .dimension = 3 };
	enum status st = iges_open(g, de, 0, c);
	if (st == ST_OK && e->type == 106)
		st = read_tuples(c, &p, &n);
	else if (st == ST_OK && !(p = calloc(1, sizeof *p)))
		st = ST_RESOURCE;
	if (st != ST_OK)
		return st;
	if (e->type == 116) {
		double x[3];
		iges_few(c, x, 3);
		p[0] = vec3(x[0], x[1], x[2]);
		iges_int(c); /* a symbol for it */
		st = c->st;
	}
	if (st == ST_OK)
		st = iges_matrix(g, e->transform, m, &any);
	for (int i = 0; i < n && st == ST_OK; i++) {
		const double w[4] = { p[i].x, p[i].y, p[i].z, 1 };
		double q[3] = { 0, 0, 0 };
		for (int r = 0; r < 3; r++)
			for (int k = 0; k < 4; k++)
				q[r] += m[r][k] * w[k];
		p[i] = vec3(q[0], q[1], q[2]);
		if (!isfinite(q[0] + q[1] + q[2]))
			st = iges_refuse(g, "a point that is not finite");
	}
	if (st != ST_OK) {
		free(p);
		return st;
	}
	out->n = n;
	out->values = (double *)p; /* three doubles each, as the list has them */
	return ST_OK;
}
