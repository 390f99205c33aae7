/* strip.h - points of any dimension over one knot vector (private to geometry).
 *
 * What a curve and one direction of a surface have in common: a surface is a strip of n[0] points
 * of dimension 4 n[1], and so every refinement is written once.
 */
#ifndef BATTEN_STRIP_H
#define BATTEN_STRIP_H

#include "knots.h"

struct strip {
	int order, n;
	size_t dim;     /* doubles a point */
	double *knots;  /* n + order */
	double *points; /* n x dim */
};

/* Owned arrays, zero. Errors: ST_RESOURCE. */
enum status strip_init(struct strip *s, int order, int n, size_t dim);
void strip_finish(struct strip *s);
enum status strip_copy(struct strip *out, const struct strip *s);

/* As curve_insert, curve_part, curve_elevate; strip_elevate wants clamped ends.
 * Errors: ST_RESOURCE, ST_PARAMETER. */
enum status strip_insert(struct strip *out, const struct strip *s, const double *x, int m);
enum status strip_part(struct strip *out, const struct strip *s, double a, double b);
enum status strip_elevate(struct strip *out, const struct strip *s, int t);

bool strip_clamped(const struct strip *s);

/* Values in sorted knots[0..m): index of the first that is not below x, of the first above x. */
int knots_lower_bound(const double *knots, int m, double x);
int knots_upper_bound(const double *knots, int m, double x);

#endif
