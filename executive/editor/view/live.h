/* live.h - an image result, whole or, while its job runs, as far as it has come. Private. */
#ifndef BATTEN_VIEW_LIVE_H
#define BATTEN_VIEW_LIVE_H

#include <stdbool.h>

#include "exr.h"

/* Read a .exr file, or a part file of one; *arriving: it is a part file, values that have not come
 * are NaN. Errors: ST_INPUT, ST_RESOURCE. */
enum status live_read(struct exr_picture *out, const char *path, bool *arriving);

#endif
