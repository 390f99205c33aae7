/* banded.h - banded equations whose matrix is totally positive, as those of spline interpolation
 * are: no pivots are needed. Private to this folder.
 *
 * Source: de Boor and Pinkus, Backward error analysis for totally positive linear systems,
 * Numer. Math. 27 (1977), 485-490.
 */
#ifndef BATTEN_BANDED_H
#define BATTEN_BANDED_H

#include <stdbool.h>
#include <stddef.h>

/* n rows of 2 width + 1; entry (i, j), |i - j| <= width, is at i (2 width + 1) + width + j - i. */

/* Triangular factors in place. False where a pivot is not positive: the matrix is singular. */
bool banded_factor(double *band, int n, int width);

/* x: n rows of `columns` right hand sides become the solutions. A row of the unit matrix leaves its
 * values as they are, to the bit. */
void banded_solve(const double *band, int n, int width, double *x, size_t columns);

#endif
