/* level_root.h - the length of the normal as a polynomial: what is prepared for it. */
#ifndef BATTEN_LEVEL_ROOT_H
#define BATTEN_LEVEL_ROOT_H

#include "level_private.h"

/* The least degree of the polynomial for the normal's length: for curvatures; for isophotes, which need less. */
enum { ROOT_DEGREE = 16, ROOT_DEGREE_LOW = 12, ROOT_DEGREE_MAX = ROOT_DEGREE };

/* Chebyshev's nodes, and what takes values in them to Chebyshev and to Bernstein coefficients. [node] */
struct root_tables {
	int degree;
	double node[ROOT_DEGREE_MAX + 1];
	double basis[2][ROOT_DEGREE_MAX + 1]
	            [NORMAL_DEGREE_MAX + 1]; /* of the normals, in the nodes */
	double chebyshev[ROOT_DEGREE_MAX + 1][ROOT_DEGREE_MAX + 1];
	double bernstein[ROOT_DEGREE_MAX + 1][ROOT_DEGREE_MAX + 1];
};

void level_root_tables(struct root_tables *x, int least, const int degree[2],
                       const double *binomial);

/* Halve spans until the polynomials for the normal's length should be right to `share` of it. The normals
 * are those of the net, before and after. Errors: ST_RESOURCE. */
enum status level_root_refine(struct level_surface *s, double share);

#endif
