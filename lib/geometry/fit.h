/* fit.h - B-splines through points. */
#ifndef BATTEN_FIT_H
#define BATTEN_FIT_H

#include "curve.h"
#include "surface.h"

enum fit_parameters { FIT_UNIFORM, FIT_CHORD, FIT_CENTRIPETAL };

/*
 * Curve of the given order through n points, knots by averaging (de Boor), domain [0, 1].
 * Errors: ST_PARAMETER (an order that there is not), ST_INPUT (fewer points than the order, neighbours that
 * coincide), ST_RESOURCE.
 * Source: The NURBS Book, 9.2.1, A9.1.
 */
enum status fit_curve(struct curve *out, const struct vec3 *p, int n, int order,
                      enum fit_parameters how, const struct report *r);

/* Surface through a grid of nu x nv points, p[i * nv + j], over [0, 1] x [0, 1]. Errors: as fit_curve, of
 * rows and columns. Source: The NURBS Book, 9.2.5, A9.4. */
enum status fit_surface(struct surface *out, const struct vec3 *p, int nu, int nv,
                        const int order[2], enum fit_parameters how, const struct report *r);

/* Surface through n curves that have the same order and knots (skinning), v across the curves, [0, 1].
 * Errors: as fit_curve; ST_PARAMETER (orders or knots differ). Source: The NURBS Book, section 10.3. */
enum status fit_loft(struct surface *out, const struct curve *sections, int n, int order_v,
                     enum fit_parameters how, const struct report *r);

#endif
