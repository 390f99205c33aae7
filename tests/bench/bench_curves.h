/* bench_curves.h - how far curves on the waves are from the exact ones, by an evaluation that is nobody's. */
#ifndef BATTEN_BENCH_CURVES_H
#define BATTEN_BENCH_CURVES_H

#include "level.h"

/* Of many places: the largest distance from the exact curve, and how many had none near. */
struct off {
	const struct surface *s; /* borrowed: a graph over x and y, x of u and y of v alone */
	const struct level_field *field;
	double most;
	int lost;
};

void off_add(const double xyz[3], void *off);

#endif
