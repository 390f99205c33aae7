/* level_shapes.h - surfaces with known answers, and the whole way of the tracer in one call. */
#ifndef BATTEN_LEVEL_SHAPES_H
#define BATTEN_LEVEL_SHAPES_H

#include <math.h>
#include <stdlib.h>

#include "level.h"
#include "surface.h"

/* Clamped uniform B-spline of n x n points over [0, 10]^2 with heights z(i, j, n). */
static inline enum status shape_make(struct surface *s, int order, int n,
                                     double height(int i, int j, int n))
{
	enum status st = surface_init(s, (int[2]){ order, order }, (int[2]){ n, n });
	if (st != ST_OK)
		return st;
	for (int d = 0; d < 2; d++)
		for (int i = 0; i < n + order; i++) {
			double k = (double)(i - order + 1) / (n - order + 1);
			s->knots[d][i] = fmin(fmax(k, 0), 1);
		}
	for (int i = 0; i < n; i++)
		for (int j = 0; j < n; j++)
			surface_set_point(
			        s, i, j,
			        vec3(10.0 * i / (n - 1), 10.0 * j / (n - 1), height(i, j, n)), 1);
	return surface_check(s, "shape", NULL);
}

/* Three waves each way. Counted elsewhere by changes of sign on a 3001 x 3001 grid:
 * planes z = c, 0 < |c| < 0.8: 18 closed loops each; isophote at 35 degrees from z: 85 pieces, at
 * 50 degrees: 84, 24 of them open; silhouette from (0.8, 0.36, 0.48): 12 open. */
static inline double shape_wavy(int i, int j, int n)
{
	double a = 2 * M_PI * 3 / (n - 1);
	return sin(a * i) * sin(a * j);
}

/* All patches in turn, then joined. */
static inline enum status shape_trace_level(const struct level *l, struct level_result *out,
                                            const struct report *r)
{
	struct text bytes = { 0 };
	enum status st = ST_OK;
	for (size_t i = 0; st == ST_OK && i < level_patches(l); i++)
		st = level_patch(l, i, NULL, &bytes);
	if (st == ST_OK)
		st = level_join(l, &(const char *){ bytes.s }, &bytes.n, 1, out, r);
	text_finish(&bytes);
	return st;
}

static inline enum status shape_trace(const struct surface *s, enum level_kind kind,
                                      struct vec3 direction, double value, double tolerance,
                                      struct level_result *out, const struct report *r)
{
	struct level_field field = { .kind = kind, .direction = direction, .value = value };
	struct level *l = NULL;
	enum status st = level_create(&l, s, &field, tolerance, r);
	if (st == ST_OK)
		st = shape_trace_level(l, out, r);
	level_destroy(l);
	return st;
}

#endif
