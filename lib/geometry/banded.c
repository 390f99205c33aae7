/* banded.c - banded equations without pivots. */
#include "banded.h"

#define ALWAYS static inline __attribute__((always_inline))

/* The widths that come all the time are constants to the compiler. */
enum { CUBIC = 3, QUINTIC = 5, POINT = 4 };

ALWAYS bool factor(double *band, int n, const int width)
{
	const int row = 2 * width + 1;
	for (int k = 0; k < n; k++) {
		double *pivot = band + (size_t)k * row + width;
		if (!(pivot[0] > 0))
			return false;
		/* The diagonal keeps the inverse: solving multiplies. */
		pivot[0] = 1 / pivot[0];
		const int last = n - 1 - k < width ? n - 1 - k : width;
		for (int i = 1; i <= last; i++) {
			double *below = pivot + (size_t)i * (row - 1);
			below[0] *= pivot[0];
			for (int j = 1; j <= width; j++)
				below[j] -= below[0] * pivot[j];
		}
	}
	return true;
}

bool banded_factor(double *band, int n, int width)
{
	return width == CUBIC     ? factor(band, n, CUBIC)
	       : width == QUINTIC ? factor(band, n, QUINTIC)
	                          : factor(band, n, width);
}

/* x -= f y, a row. */
ALWAYS void take(double *restrict x, double f, const double *restrict y, const size_t columns)
{
	for (size_t k = 0; k < columns; k++)
		x[k] -= f * y[k];
}

ALWAYS void solve(const double *band, int n, const int width, double *x, const size_t columns)
{
	const int row = 2 * width + 1;
	for (int i = 1; i < n; i++) {
		const double *f = band + (size_t)i * row + width;
		for (int j = i < width ? i : width; j > 0; j--)
			take(x + i * columns, f[-j], x + (i - j) * columns, columns);
	}
	for (int i = n - 1; i >= 0; i--) {
		const double *f = band + (size_t)i * row + width;
		/* the nearest, which has just been found, comes last */
		for (int j = n - 1 - i < width ? n - 1 - i : width; j > 0; j--)
			take(x + i * columns, f[j], x + (i + j) * columns, columns);
		for (size_t k = 0; k < columns; k++)
			x[i * columns + k] *= f[0];
	}
}

void banded_solve(const double *band, int n, int width, double *x, size_t columns)
{
	if (width == CUBIC && columns == POINT)
		solve(band, n, CUBIC, x, POINT);
	else
		solve(band, n, width, x, columns);
}
