/* batch.h - values at many points of a surface in one call.
 *
 * Points are sorted by span; those of one span share its control points and are lanes of vectors.
 * The kernel is built for several vector levels and chosen at run time (vector_level() in
 * parallel.h).
 */
#ifndef BATTEN_BATCH_H
#define BATTEN_BATCH_H

#include "grid.h"

/*
 * uv: n pairs inside the domain, in any order. out[c] for each channel c in the mask `what`
 * (GRID_BIT of enum grid_channel) receives n doubles; other entries are not touched. Where
 * Su x Sv vanishes the limit, NaN where there is none, as surface_shape() has it.
 * Accuracy: that of surface_shape(), whose values differ in their last digits.
 * Results do not depend on how points are split into calls. Errors: ST_RESOURCE. Thread: any.
 */
enum status surface_shapes(const struct surface *s, const double *uv, size_t n, unsigned what,
                           double *const out[N_GRID_CHANNELS]);

#endif
