/* iges_surfaces.c - surfaces 114 120 122 128 140 as NURBS; planes are in iges_planes.c,
 * ruled ones in iges_ruled.c. */
#include "iges_reader.h"

#include <stdlib.h>

#include "construct.h"
#include "curvature.h"
#include "refine.h"

/* 114: types, patches in u and v, breaks, then 48 coefficients a patch. The standard wants a row
 * and a column of patches more than there are, with any values. */
static enum status read_power(struct iges_cursor *c, int depth, struct surface *out)
{
	(void)depth;
	iges_int(c), iges_int(c);
	int nu = iges_count(c, "number of patches in u", 1, iges_left(c) / 48);
	int nv = iges_count(c, "number of patches in v", 1, iges_left(c) / 48);
	if (c->st == ST_OK && (int64_t)nu * nv * 48 > iges_left(c))
		iges_fail(c, "%d x %d patches, more than the file has left", nu, nv);
	if (c->st != ST_OK)
		return c->st;
	double *u = calloc((size_t)nu + nv + 2, sizeof *u), *v = u ? u + nu + 1 : NULL;
	double(*k)[3][16] = calloc((size_t)nu * nv, sizeof *k);
	enum status st = u && k ? ST_OK : ST_RESOURCE;
	struct box b = box_empty();
	if (st == ST_OK)
		iges_reals(c, u, (size_t)nu + nv + 2, 1, 1);
	for (int i = 0; i < nu && st == ST_OK; i++) {
		iges_reals(c, k[(size_t)i * nv][0], (size_t)nv * 48, 48, 48);
		for (int j = 0; j < nv; j++) {
			const double(*p)[16] = (const double(*)[16])k[(size_t)i * nv + j];
			box_add_point(&b, vec3(p[0][0], p[1][0], p[2][0]));
		}
		for (int j = 0; j < 48; j++)
			iges_real(c);
		st = c->st;
	}
	for (int64_t j = 0; j < 48 * ((int64_t)nv + 1) && !c->ended; j++)
		iges_real(c);
	if (st == ST_OK)
		st = make_power_surface(out, u, nu, v, nv, (const double(*)[3][16])k,
		                        iges_tolerance(c->g, box_diagonal(&b)),
		                        &c->g->store.report);
	free(u);
	free(k);
	return st;
}

/* 120: axis (a line), curve, from and to angle. */
static enum status read_revolution(struct iges_cursor *c, int depth, struct surface *out)
{
	struct iges *g = c->g;
	struct curve axis = { 0 }, curve = { 0 };
	int line = iges_int(c), profile = iges_int(c);
	double from = iges_real(c), to = iges_real(c);
	enum status st = c->st;
	if (st == ST_OK)
		st = iges_curve(g, line, depth + 1, &axis, NULL);
	if (st == ST_OK)
		st = iges_curve(g, profile, depth + 1, &curve, NULL);
	if (st == ST_OK) {
		struct vec3 p = curve_point(&axis, axis.domain[0]);
		struct vec3 d = vec3_sub(curve_point(&axis, axis.domain[1]), p);
		while (to <= from && isfinite(from) && fabs(from) < 100)
			to += 2 * M_PI;
		if (!(vec3_length(d) > 0))
			st = iges_refuse(g, "its axis has no length");
		else if (!(to > from) || !isfinite(to))
			st = iges_refuse(g, "it is turned from angle %g to %g", from, to);
		else
			st = make_revolution(out, &curve, p, vec3_unit(d), from,
			                     fmin(to, from + 2 * M_PI));
	}
	curve_finish(&axis);
	curve_finish(&curve);
	return st;
}

/* 122: a curve, and where its start is moved to. */
static enum status read_cylinder(struct iges_cursor *c, int depth, struct surface *out)
{
	struct curve curve = { 0 };
	double p[3];
	int directrix = iges_int(c);
	iges_few(c, p, 3);
	enum status st = c->st;
	if (st == ST_OK)
		st = iges_curve(c->g, directrix, depth + 1, &curve, NULL);
	if (st == ST_OK) {
		curve_reparametrise(&curve, 0, 1);
		st = make_cylinder(out, &curve,
		                   vec3_sub(vec3(p[0], p[1], p[2]), curve_point(&curve, 0)));
	}
	curve_finish(&curve);
	return st;
}

static enum status read_spline(struct iges_cursor *c, int depth, struct surface *out)
{
	(void)depth;
	return iges_spline_surface(c, out);
}

/* Points looked at for an offset: damaged surfaces would want any number. */
enum { OFFSET_POINTS = 50000, OFFSET_POINTS_EACH = 2000 /* point of the net */ };

static bool told_to_stop(void *data)
{
	const struct iges *g = data;
	return progress_step(g->progress, g->n_p ? (double)g->far / g->n_p : 0) != ST_OK;
}

/* 140: a vector that says on which side, the distance, the surface. */
static enum status read_offset(struct iges_cursor *c, int depth, struct surface *out)
{
	struct iges *g = c->g;
	struct surface s = { 0 };
	struct vec3 normal;
	double p[4], error = 0;
	iges_few(c, p, 4);
	int base = iges_int(c);
	enum status st = c->st;
	if (st == ST_OK)
		st = iges_surface(g, base, depth + 1, &s, NULL);
	if (st != ST_OK)
		return st;
	double u = 0.5 * (s.domain[0][0] + s.domain[0][1]);
	double v = 0.5 * (s.domain[1][0] + s.domain[1][1]);
	if (!surface_normal(&s, u, v, &normal)) {
		st = iges_refuse(g,
		                 "the surface that it is an offset of has no normal in its middle");
	} else {
		double side = vec3_dot(normal, vec3(p[0], p[1], p[2])) < 0 ? -1 : 1;
		const struct effort effort = {
			OFFSET_POINTS + (int64_t)OFFSET_POINTS_EACH * s.n[0] * s.n[1],
			told_to_stop,
			g,
		};
		st = make_offset_within(out, &s, side * p[3], iges_tolerance(g, surface_size(&s)),
		                        &effort, &error, &g->store.report);
		if (st == ST_OK)
			iges_warn_error(g, WARN_OFFSET, c->de, error);
	}
	surface_finish(&s);
	return st;
}

static const struct {
	int type;
	enum status (*read)(struct iges_cursor *c, int depth, struct surface *out);
} surfaces[] = {
	{ 108, iges_plane },      { 114, read_power },    { 118, iges_ruled },
	{ 120, read_revolution }, { 122, read_cylinder }, { 128, read_spline },
	{ 140, read_offset },     { 190, iges_plane },
};
enum { N_SURFACES = sizeof surfaces / sizeof surfaces[0] };

bool iges_is_surface(const struct iges_entry *e)
{
	int i = 0;
	while (i < N_SURFACES && surfaces[i].type != e->type)
		i++;
	return i < N_SURFACES;
}

enum status iges_surface(struct iges *g, int de, int depth, struct surface *out,
                         struct iges_cursor *c)
{
	struct iges_cursor own;
	double m[3][4];
	bool any;
	*out = (struct surface){ 0 };
	if (!c)
		c = &own;
	enum status st = iges_open_nested(g, de, depth, c);
	if (st != ST_OK)
		return st;
	const struct iges_entry *e = iges_entry(g, de);
	if (!iges_is_surface(e))
		return iges_refuse(g, "D%d of type %d where a surface is expected", de, e->type);
	for (int i = 0; i < N_SURFACES; i++)
		if (surfaces[i].type == e->type)
			st = surfaces[i].read(c, depth, out);
	st = iges_pass(g, st);
	if (st == ST_OK)
		st = iges_matrix(g, e->transform, m, &any);
	if (st == ST_OK && any)
		surface_transform(out, (const double(*)[4])m);
	if (st == ST_OK)
		st = iges_pass(g, surface_check(out, "the surface", &g->store.report));
	if (st != ST_OK)
		surface_finish(out);
	return st;
}
