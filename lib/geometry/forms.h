/* forms.h - curvatures from the first and second derivatives, for one point or a loop over many.
 * Private to this folder. Source: do Carmo (1976), section 3.3. */
#ifndef BATTEN_FORMS_H
#define BATTEN_FORMS_H

#include <math.h>

#include "vec.h"

/* Coefficients of the two fundamental forms; l, m, n not yet divided by |Su x Sv|. */
struct forms {
	double e, f, g, l, m, n;
	double area2; /* |Su x Sv|^2 */
};

struct form_values {
	double gaussian, mean, kmax, kmin, normal_u, normal_v;
};

static inline __attribute__((always_inline)) struct form_values forms_values(const struct forms *x)
{
	/* One division and one root for all. */
	const double r = 1 / (x->e * x->area2);
	const double ia = r * x->e, ie = r * x->area2, is = sqrt(ia);
	const double l = x->l * is, m = x->m * is, n = x->n * is;
	struct form_values out;
	out.gaussian = (l * n - m * m) * ia;
	out.mean = 0.5 * (x->e * n - 2 * x->f * m + x->g * l) * ia;
	/*
	 * Half the difference of the principal curvatures, as a length in the plane of normal
	 * curvature along Su and twist: unlike sqrt(H^2 - K) it loses nothing at an umbilic.
	 */
	const double along = l * ie, twist = (x->e * m - x->f * l) * (ie * is);
	const double half = sqrt((along - out.mean) * (along - out.mean) + twist * twist);
	out.kmax = out.mean + half;
	out.kmin = out.mean - half;
	out.normal_u = along;
	out.normal_v = n / x->g;
	return out;
}

#endif
