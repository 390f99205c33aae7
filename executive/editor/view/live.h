/* live.h - results, whole or, while their job runs, as far as they have come. Private. */
#ifndef BATTEN_VIEW_LIVE_H
#define BATTEN_VIEW_LIVE_H

#include "exr.h"
#include "level_look.h"

/* Read a .exr file, or a part file of one: values that have not come are NaN.
 * Errors: ST_INPUT, ST_RESOURCE. */
enum status live_read(struct exr_picture *out, const char *path);

/* Give the lines of a part file, as level_look does. Errors: ST_INPUT (no part file), ST_RESOURCE. */
enum status live_lines(const char *path, level_take *take, void *data);

#endif
