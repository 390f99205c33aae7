/* pole.h - points of a surface where Su x Sv vanishes, or nearly so. Private to this folder. */
#ifndef BATTEN_POLE_H
#define BATTEN_POLE_H

#include <stdbool.h>

#include "curvature.h"

enum {
	POLE_MEAN,
	POLE_GAUSSIAN,
	POLE_KMAX,
	POLE_KMIN,
	POLE_NORMAL_U,
	POLE_NORMAL_V,
	N_POLE_VALUES,
};

/* Normal and curvatures found from beside a point; NaN where there is no limit. */
struct pole {
	struct vec3 normal;
	double value[N_POLE_VALUES];
};

/* What a span of the surface is like, to tell small from vanishing. */
struct pole_scale {
	double area;   /* largest |Su x Sv| among samples */
	double length; /* size of the span in space */
	bool none;     /* Su x Sv vanishes all over the span: there is no surface */
};
struct pole_scale pole_scale_of(const struct surface *s, const int span[2]);

/*
 * Below pole_near * area the plain formulas have lost half their digits or more; below
 * pole_degenerate * area Su x Sv counts as zero.
 */
extern const double pole_near, pole_degenerate;

/*
 * Limits at a degenerate point: from inside the domain, over all of the isoparametric line that is
 * shrunk to the point if there is one, else from all directions. Values must agree to 1e-5
 * relative. The normal curvatures in u and v are limits at this u, v alone, since their
 * directions turn along such a line.
 * Method: values at shrinking distances along a ray, extrapolated to its start.
 * Accuracy: 1e-6 relative where the surface is smooth there; 1e-9 on a sphere.
 */
void pole_limits(const struct surface *s, double u, double v, const struct pole_scale *scale,
                 struct pole *out);

/*
 * Near a degenerate point: the same from this point, which is regular with |Su x Sv| = area. False,
 * and *out of no use, where the plain formulas do better.
 */
bool pole_beside(const struct surface *s, double u, double v, double area,
                 const struct pole_scale *scale, struct pole *out);

/* Normal and all quantities of *out from limits. */
void shape_from_pole(struct surface_shape *out, const struct pole *p);

#endif
