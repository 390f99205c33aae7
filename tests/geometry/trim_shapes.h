/* trim_shapes.h - trimming loops that tests share. */
#ifndef BATTEN_TEST_TRIM_SHAPES_H
#define BATTEN_TEST_TRIM_SHAPES_H

#include "refine.h"
#include "shapes.h"
#include "trim.h"

/* A plane over [0, 1] x [0, 1] of u, v, x and y their multiples. */
static inline struct surface shape_plane(double width, double height)
{
	struct surface s;
	if (surface_init(&s, (const int[2]){ 2, 2 }, (const int[2]){ 2, 2 }) != ST_OK)
		abort();
	for (int d = 0; d < 2; d++)
		for (int i = 0; i < 4; i++)
			s.knots[d][i] = i / 2;
	for (int i = 0; i < 4; i++)
		surface_set_point(&s, i / 2, i % 2, vec3(width * (i / 2), height * (i % 2), 0), 1);
	if (surface_check(&s, "plane", NULL) != ST_OK)
		abort();
	return s;
}

static inline struct curve trim_line(double u0, double v0, double u1, double v1)
{
	struct curve c;
	if (curve_init(&c, 2, 2) != ST_OK)
		abort();
	c.knots[2] = c.knots[3] = 1;
	curve_set_point(&c, 0, vec3(u0, v0, 0), 1);
	curve_set_point(&c, 1, vec3(u1, v1, 0), 1);
	if (curve_check(&c, "line", NULL) != ST_OK)
		abort();
	return c;
}

static inline void trim_put(struct trim_loop *l, struct curve c)
{
	if (trim_loop_add(l, &c) != ST_OK)
		abort();
}

static inline void trim_close(struct trim *t, struct trim_loop l)
{
	if (trim_add(t, &l) != ST_OK)
		abort();
}

/* An ellipse in nine points, counter-clockwise, begun at `turn` (radians). */
static inline struct curve trim_ellipse(double u, double v, double a, double b, double turn)
{
	double x[9], y[9], w[9], k[12];
	struct curve c;
	shape_circle(x, y, w, k);
	if (curve_init(&c, 3, 9) != ST_OK)
		abort();
	memcpy(c.knots, k, sizeof k);
	for (int i = 0; i < 9; i++)
		curve_set_point(&c, i,
		                vec3(u + a * (x[i] * cos(turn) - y[i] * sin(turn)),
		                     v + b * (x[i] * sin(turn) + y[i] * cos(turn)), 0),
		                w[i]);
	if (curve_check(&c, "ellipse", NULL) != ST_OK)
		abort();
	return c;
}

static inline void trim_add_ellipse(struct trim *t, bool outer, double u, double v, double a,
                                    double b, double turn)
{
	struct trim_loop l = { .outer = outer };
	trim_put(&l, trim_ellipse(u, v, a, b, turn));
	trim_close(t, l);
}

/* Counter-clockwise round a box. */
static inline void trim_add_box(struct trim *t, bool outer, double u0, double v0, double u1,
                                double v1)
{
	struct trim_loop l = { .outer = outer };
	trim_put(&l, trim_line(u0, v0, u1, v0));
	trim_put(&l, trim_line(u1, v0, u1, v1));
	trim_put(&l, trim_line(u1, v1, u0, v1));
	trim_put(&l, trim_line(u0, v1, u0, v0));
	trim_close(t, l);
}

#endif
