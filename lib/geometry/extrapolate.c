/* extrapolate.c - the limit at 0 of a smooth function known only beside it. */
#include "extrapolate.h"

#include <math.h>

double extrapolate_node(int k)
{
	return ldexp(0.25, -k);
}

double extrapolate(const double *f, int n, double *error)
{
	double row[EXTRAPOLATE_NODES] = { 0 }, best = NAN;
	*error = INFINITY;
	for (int k = 0; k < n && isfinite(f[k]); k++) {
		double above = row[0];
		row[0] = f[k];
		double power = 2;
		for (int m = 1; m <= k; m++, power *= 2) {
			const double corner = above;
			above = row[m];
			row[m] = row[m - 1] + (row[m - 1] - corner) / (power - 1);
			if (k < 3)
				continue;
			double change = fmax(fabs(row[m] - row[m - 1]), fabs(row[m] - corner));
			if (change < *error) {
				*error = change;
				best = row[m];
			}
		}
	}
	return best;
}
