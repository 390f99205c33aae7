/* umbilic_points.h - where kmax = kmin on a worker's surfaces, as figures and in its file. */
#ifndef BATTEN_UMBILIC_POINTS_H
#define BATTEN_UMBILIC_POINTS_H

#include <jansson.h>

#include "level_work.h"
#include "model.h"

/* Surface by surface the points in u, v, then boxes of regions and of what is undecided as pairs of corners.
 * Errors: ST_RESOURCE. */
enum status umbilic_points_add(const struct level_work *l, struct model *m);

/* umbilics, how many points; umbilic_points, the first thousand of them; umbilic_regions and umbilic_undecided,
 * how many boxes. */
void umbilic_points_set(const struct level_work *l, json_t *figures);

#endif
