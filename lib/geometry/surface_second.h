/* surface_second.h - point, first and second derivatives at once. Private to this folder. */
#ifndef BATTEN_SURFACE_SECOND_H
#define BATTEN_SURFACE_SECOND_H

#include "curvature.h"

/* Fill point and derivatives of *out, and the spans of u and v. As surface_derivatives, faster. */
void surface_second(const struct surface *s, double u, double v, int span[2],
                    struct surface_shape *out);

#endif
