/* curve_samples.h - curvature and torsion along a curve, as numbers, a table, a graph. */
#ifndef BATTEN_CURVE_SAMPLES_H
#define BATTEN_CURVE_SAMPLES_H

#include "world.h"

/* column, name in the table */
#define SAMPLE_MAP(X)                                                                              \
	X(T, "t")                                                                                  \
	X(LENGTH, "length") /* along the chords between the samples */                             \
	X(X_, "x")                                                                                 \
	X(Y, "y")                                                                                  \
	X(Z, "z")                                                                                  \
	X(CURVATURE, "curvature")                                                                  \
	X(TORSION, "torsion")                                                                      \
	X(NORMAL, "normal_curvature") /* this and the next of a curve on a surface only */         \
	X(GEODESIC, "geodesic_curvature")

#define X(name, word) SAMPLE_##name,
enum sample_column { SAMPLE_MAP(X) N_SAMPLE_COLUMNS };
#undef X

struct curve_samples {
	int n;
	double (*row)[N_SAMPLE_COLUMNS]; /* owned; NaN: no value there */
	bool on_surface;
};

/* n >= 2, evenly in the parameter, both ends included. Errors: ST_RESOURCE. */
enum status curve_samples_take(struct curve_samples *out, const struct world *w,
                               const struct Ful *f, int n);
void curve_samples_finish(struct curve_samples *s);
double curve_samples_sharpest(const struct curve_samples *s); /* largest curvature */

enum status curve_samples_write(const struct curve_samples *s, const char *path,
                                const struct report *r);
/* Two graphs over the length, as .svg or .pdf; unit may be NULL. Errors: ST_PARAMETER (extension). */
enum status curve_graph_write(const struct curve_samples *s, const char *name, const char *unit,
                              const char *path, const struct report *r);

#endif
