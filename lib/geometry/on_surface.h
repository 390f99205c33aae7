/* on_surface.h - a curve in the u,v plane of a surface, seen in space. */
#ifndef BATTEN_ON_SURFACE_H
#define BATTEN_ON_SURFACE_H

#include "curve.h"
#include "surface.h"

/* Both borrowed. The curve's x and y are u and v. */
struct on_surface {
	const struct curve *uv;
	const struct surface *surface;
};

/* Point in space and derivatives with respect to t to order d <= 3, by the chain rule. */
void on_surface_derivatives(const struct on_surface *c, double t, int d, struct vec3 *out);

/* Curvature, torsion, normal and geodesic curvature (signed, by the surface's N). Where the curve
 * stands still `limit` is set and all that needs its direction is NaN. */
struct on_surface_shape {
	struct curve_shape space;
	struct vec3 normal;
	double normal_curvature, geodesic_curvature;
};
void on_surface_shape(const struct on_surface *c, double t, struct on_surface_shape *out);

#endif
