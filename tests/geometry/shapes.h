/* shapes.h - curves and surfaces that the geometry tests share, made from formulas. */
#ifndef BATTEN_TEST_SHAPES_H
#define BATTEN_TEST_SHAPES_H

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "curve.h"
#include "surface.h"

static inline double shape_random(uint64_t *state) /* SplitMix64, in [0, 1) */
{
	uint64_t z = (*state += 0x9e3779b97f4a7c15u);
	z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
	z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
	return (double)((z ^ (z >> 31)) >> 11) / 9007199254740992.0;
}

enum shape_knots { KNOTS_CLAMPED, KNOTS_OPEN, KNOTS_UNEVEN, KNOTS_DOUBLE, N_SHAPE_KNOTS };

/* Fill n + order knots: clamped even, unclamped even, clamped uneven, clamped with double knots. */
static inline void shape_fill_knots(double *k, int order, int n, enum shape_knots how)
{
	uint64_t seed = 7 + order;
	double last = 0;
	for (int i = 0; i < n + order; i++) {
		const int inner = i - order + 1, spans = n - order + 1;
		if (how == KNOTS_OPEN) {
			k[i] = -3 + 0.25 * i;
			continue;
		}
		if (inner <= 0)
			k[i] = 0;
		else if (inner >= spans)
			k[i] = 1;
		else if (how == KNOTS_UNEVEN)
			k[i] = (inner - 0.9 * shape_random(&seed)) / spans;
		else if (how == KNOTS_DOUBLE && inner % 2 == 0 && order > 2)
			k[i] = last;
		else
			k[i] = (double)inner / spans;
		last = k[i];
	}
}

static inline struct curve shape_curve(int order, int n, bool rational, enum shape_knots how,
                                       uint64_t seed)
{
	struct curve c;
	if (curve_init(&c, order, n) != ST_OK)
		abort();
	shape_fill_knots(c.knots, order, n, how);
	for (int i = 0; i < n; i++) {
		/* one after the other: compilers differ in the order of arguments */
		const double w = rational ? 0.5 + shape_random(&seed) : 1;
		const double z = 2 * shape_random(&seed) - 1, y = 3 * shape_random(&seed);
		curve_set_point(&c, i, vec3(i, y, z), w);
	}
	if (curve_check(&c, "curve", NULL) != ST_OK)
		abort();
	return c;
}

static inline struct surface shape_surface(const int order[2], const int n[2], bool rational,
                                           enum shape_knots how, uint64_t seed)
{
	struct surface s;
	if (surface_init(&s, order, n) != ST_OK)
		abort();
	for (int d = 0; d < 2; d++)
		shape_fill_knots(s.knots[d], order[d], n[d], how);
	for (int i = 0; i < n[0]; i++)
		for (int j = 0; j < n[1]; j++) {
			const double w = rational ? 0.5 + shape_random(&seed) : 1;
			const double z = 2 * shape_random(&seed) - 1;
			const double y = j + 0.3 * shape_random(&seed);
			const double x = i + 0.3 * shape_random(&seed);
			surface_set_point(&s, i, j, vec3(x, y, z), w);
		}
	if (surface_check(&s, "surface", NULL) != ST_OK)
		abort();
	return s;
}

/* Points and weights of a circle of radius 1 in nine points, double knots. */
static inline void shape_circle(double x[9], double y[9], double w[9], double knots[12])
{
	static const double cx[9] = { 1, 1, 0, -1, -1, -1, 0, 1, 1 };
	static const double cy[9] = { 0, 1, 1, 1, 0, -1, -1, -1, 0 };
	for (int i = 0; i < 9; i++) {
		x[i] = cx[i];
		y[i] = cy[i];
		w[i] = i % 2 ? sqrt(0.5) : 1;
	}
	for (int i = 0; i < 12; i++)
		knots[i] = i < 3 ? 0 : i > 8 ? 1 : 0.25 * ((i - 1) / 2);
}

/*
 * Turn a profile (n points px > = 0, pz, weights, order, knots) about z: u is the angle, v runs
 * along the profile. N points outward where the profile rises on the right of the axis.
 */
static inline struct surface shape_turned(int order, int n, const double *px, const double *pz,
                                          const double *pw, const double *knots)
{
	double x[9], y[9], w[9], k[12];
	struct surface s;
	shape_circle(x, y, w, k);
	if (surface_init(&s, (const int[2]){ 3, order }, (const int[2]){ 9, n }) != ST_OK)
		abort();
	memcpy(s.knots[0], k, sizeof k);
	memcpy(s.knots[1], knots, sizeof *knots * (n + order));
	for (int i = 0; i < 9; i++)
		for (int j = 0; j < n; j++)
			surface_set_point(&s, i, j, vec3(px[j] * x[i], px[j] * y[i], pz[j]),
			                  w[i] * (pw ? pw[j] : 1));
	if (surface_check(&s, "turned", NULL) != ST_OK)
		abort();
	return s;
}

static inline struct surface shape_sphere(double radius)
{
	double x[5] = { 0, 1, 1, 1, 0 }, z[5] = { -1, -1, 0, 1, 1 };
	const double w[5] = { 1, sqrt(0.5), 1, sqrt(0.5), 1 };
	const double k[8] = { 0, 0, 0, 0.5, 0.5, 1, 1, 1 };
	for (int i = 0; i < 5; i++) {
		x[i] *= radius;
		z[i] *= radius;
	}
	return shape_turned(3, 5, x, z, w, k);
}

static inline struct surface shape_torus(double major, double minor)
{
	double x[9], z[9], w[9], k[12];
	shape_circle(x, z, w, k);
	for (int i = 0; i < 9; i++) {
		x[i] = major + minor * x[i];
		z[i] *= minor;
	}
	return shape_turned(3, 9, x, z, w, k);
}

/* The two surfaces that the kernel is timed on. */
static inline struct surface shape_wave10(void)
{
	struct surface s;
	if (surface_init(&s, (const int[2]){ 4, 4 }, (const int[2]){ 10, 10 }) != ST_OK)
		abort();
	for (int d = 0; d < 2; d++)
		shape_fill_knots(s.knots[d], 4, 10, KNOTS_CLAMPED);
	for (int i = 0; i < 10; i++)
		for (int j = 0; j < 10; j++)
			surface_set_point(&s, i, j,
			                  vec3(10.0 * i / 9, 10.0 * j / 9,
			                       1.5 * sin(2 * M_PI * 1.5 * i / 9) *
			                               cos(2 * M_PI * 1.5 * j / 9)),
			                  1);
	if (surface_check(&s, "wave10", NULL) != ST_OK)
		abort();
	return s;
}

static inline struct surface shape_rat20(void)
{
	struct surface s;
	if (surface_init(&s, (const int[2]){ 6, 6 }, (const int[2]){ 20, 20 }) != ST_OK)
		abort();
	for (int d = 0; d < 2; d++)
		shape_fill_knots(s.knots[d], 6, 20, KNOTS_CLAMPED);
	for (int i = 0; i < 20; i++)
		for (int j = 0; j < 20; j++)
			surface_set_point(
			        &s, i, j,
			        vec3(10.0 * i / 19, 10.0 * j / 19, sin(0.9 * i) * cos(0.7 * j)),
			        1 + 0.5 * sin(1.3 * i + 0.7 * j));
	if (surface_check(&s, "rat20", NULL) != ST_OK)
		abort();
	return s;
}

#endif
