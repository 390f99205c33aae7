/* arbitrary.h - curves and surfaces of no special shape, and how far two of them are apart. */
#ifndef BATTEN_TEST_ARBITRARY_H
#define BATTEN_TEST_ARBITRARY_H

#include <stdint.h>

#include "curve.h"
#include "surface.h"

/* Next of a fixed sequence in [0, 1). Source: Knuth's MMIX generator. */
static inline double any_number(uint64_t *seed)
{
	*seed = *seed * 6364136223846793005u + 1442695040888963407u;
	return (double)(*seed >> 11) / 9007199254740992.0;
}

/* Uneven knots, some double where the order allows; clamped or not. */
static inline void any_knots(double *t, int order, int n, bool clamped, uint64_t *seed)
{
	double x = -1;
	for (int i = 0; i < n + order; i++) {
		bool inside_end = clamped && (i < order ? i > 0 : i > n);
		bool twice = order > 3 && i > order && i < n && i % 5 == 0;
		if (!inside_end && !twice)
			x += 0.25 + any_number(seed);
		t[i] = x;
	}
}

static inline void any_points(double *q, int n, bool rational, uint64_t *seed)
{
	for (int i = 0; i < n; i++) {
		double w = rational ? 0.5 + any_number(seed) : 1;
		for (int k = 0; k < 3; k++)
			q[4 * i + k] = w * (4 * any_number(seed) - 2);
		q[4 * i + 3] = w;
	}
}

/* domain: the knots' one, or with `inner` a part of it. */
static inline enum status any_curve(struct curve *c, int order, int n, bool rational, bool clamped,
                                    bool inner, uint64_t seed)
{
	enum status st = curve_init(c, order, n);
	if (st != ST_OK)
		return st;
	any_knots(c->knots, order, n, clamped, &seed);
	any_points(c->points, n, rational, &seed);
	double a = c->knots[order - 1], b = c->knots[n];
	c->domain[0] = inner ? a + 0.3 * (b - a) : a;
	c->domain[1] = inner ? b - 0.2 * (b - a) : b;
	c->rational = rational;
	return ST_OK;
}

static inline enum status any_surface(struct surface *s, const int order[2], const int n[2],
                                      bool rational, bool clamped, bool inner, uint64_t seed)
{
	enum status st = surface_init(s, order, n);
	if (st != ST_OK)
		return st;
	any_points(s->points, n[0] * n[1], rational, &seed);
	for (int d = 0; d < 2; d++) {
		any_knots(s->knots[d], order[d], n[d], clamped, &seed);
		double a = s->knots[d][order[d] - 1], b = s->knots[d][n[d]];
		s->domain[d][0] = inner ? a + 0.3 * (b - a) : a;
		s->domain[d][1] = inner ? b - 0.2 * (b - a) : b;
	}
	s->rational = rational;
	return ST_OK;
}

/* x in [0, 1] to the range, its ends exact. */
static inline double in_range(const double range[2], double x)
{
	return x == 1 ? range[1] : range[0] + x * (range[1] - range[0]);
}

static inline double distance(struct vec3 a, struct vec3 b)
{
	return vec3_length(vec3_sub(a, b));
}

/* Largest distance at the same parameters, over the range. */
static inline double curves_apart(const struct curve *a, const struct curve *b,
                                  const double range[2])
{
	double worst = 0;
	for (int i = 0; i <= 400; i++) {
		double t = in_range(range, i / 400.0);
		worst = fmax(worst, distance(curve_point(a, t), curve_point(b, t)));
	}
	return worst;
}

static inline double surfaces_apart(const struct surface *a, const struct surface *b,
                                    const double range[2][2])
{
	double worst = 0;
	for (int i = 0; i <= 40; i++) {
		for (int j = 0; j <= 40; j++) {
			double u = in_range(range[0], i / 40.0), v = in_range(range[1], j / 40.0);
			worst = fmax(worst,
			             distance(surface_point(a, u, v), surface_point(b, u, v)));
		}
	}
	return worst;
}

#endif
