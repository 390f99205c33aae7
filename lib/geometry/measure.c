/* measure.c - length of curves and area of surfaces, by Gauss-Legendre quadrature a span, halved
 * until it settles. */
#include <math.h>
#include <stdlib.h>

#include "curve.h"
#include "gauss.h"
#include "surface.h"

enum { LENGTH_DEPTH = 24, AREA_DEPTH = 10 };

static double length_once(const struct curve *c, double a, double b)
{
	double sum = 0;
	struct vec3 d[2];
	for (int i = 0; i < GAUSS; i++) {
		curve_derivatives(c, 0.5 * (a + b) + 0.5 * (b - a) * gauss_node[i], 1, d);
		sum += gauss_weight[i] * vec3_length(d[1]);
	}
	return sum * 0.5 * (b - a);
}

static double length_halved(const struct curve *c, double a, double b, double whole,
                            double tolerance, int depth)
{
	double mid = 0.5 * (a + b);
	double left = length_once(c, a, mid), right = length_once(c, mid, b);
	if (depth == 0 || !(fabs(left + right - whole) > tolerance))
		return left + right;
	return length_halved(c, a, mid, left, 0.5 * tolerance, depth - 1) +
	       length_halved(c, mid, b, right, 0.5 * tolerance, depth - 1);
}

double curve_length(const struct curve *c, double a, double b, double accuracy)
{
	double *breaks = malloc(sizeof *breaks * (c->n + 2));
	if (!breaks)
		return NAN;
	const int spans =
	        knots_breaks(c->order, c->n, c->knots, fmin(a, b), fmax(a, b), breaks) - 1;
	double rough = 0, sum = 0;
	for (int i = 0; i < spans; i++)
		rough += length_once(c, breaks[i], breaks[i + 1]);
	for (int i = 0; i < spans; i++) {
		double whole = spans == 1 ? rough : length_once(c, breaks[i], breaks[i + 1]);
		sum += length_halved(c, breaks[i], breaks[i + 1], whole, accuracy * rough / spans,
		                     LENGTH_DEPTH);
	}
	free(breaks);
	return sum;
}

struct cell {
	double u[2], v[2];
};

static double area_once(const struct surface *s, const struct cell *c)
{
	const double hu = 0.5 * (c->u[1] - c->u[0]), hv = 0.5 * (c->v[1] - c->v[0]);
	double sum = 0;
	struct vec3 p, du, dv;
	for (int i = 0; i < GAUSS; i++)
		for (int j = 0; j < GAUSS; j++) {
			surface_tangents(s, c->u[0] + hu * (1 + gauss_node[i]),
			                 c->v[0] + hv * (1 + gauss_node[j]), &p, &du, &dv);
			sum += gauss_weight[i] * gauss_weight[j] * vec3_length(vec3_cross(du, dv));
		}
	return sum * hu * hv;
}

static double area_halved(const struct surface *s, const struct cell *c, double whole,
                          double tolerance, int depth, double *error)
{
	const double mu = 0.5 * (c->u[0] + c->u[1]), mv = 0.5 * (c->v[0] + c->v[1]);
	const struct cell quarter[4] = {
		{ { c->u[0], mu }, { c->v[0], mv } },
		{ { mu, c->u[1] }, { c->v[0], mv } },
		{ { c->u[0], mu }, { mv, c->v[1] } },
		{ { mu, c->u[1] }, { mv, c->v[1] } },
	};
	double part[4], sum = 0;
	for (int i = 0; i < 4; i++)
		sum += part[i] = area_once(s, &quarter[i]);
	if (depth == 0 || !(fabs(sum - whole) > tolerance)) {
		*error += fabs(sum - whole);
		return sum;
	}
	sum = 0;
	for (int i = 0; i < 4; i++)
		sum += area_halved(s, &quarter[i], part[i], 0.5 * tolerance, depth - 1, error);
	return sum;
}

double surface_area(const struct surface *s, double accuracy, double *error)
{
	double *breaks[2], sum = NAN, rough = 0;
	int spans[2];
	for (int d = 0; d < 2; d++) {
		breaks[d] = malloc(sizeof(double) * (s->n[d] + 2));
		if (breaks[d])
			spans[d] = knots_breaks(s->order[d], s->n[d], s->knots[d], s->domain[d][0],
			                        s->domain[d][1], breaks[d]) -
			           1;
	}
	*error = INFINITY;
	if (!breaks[0] || !breaks[1])
		goto out;
	for (int pass = 0; pass < 2; pass++) {
		const double tolerance = accuracy * rough / spans[0] / spans[1];
		sum = 0;
		*error = 0;
		for (int i = 0; i < spans[0]; i++)
			for (int j = 0; j < spans[1]; j++) {
				const struct cell c = { { breaks[0][i], breaks[0][i + 1] },
					                { breaks[1][j], breaks[1][j + 1] } };
				double whole = area_once(s, &c);
				sum += pass == 0 ? whole
				                 : area_halved(s, &c, whole, tolerance, AREA_DEPTH,
				                               error);
			}
		rough = sum;
	}
out:
	free(breaks[0]);
	free(breaks[1]);
	return sum;
}
