/* worker_image.h - outputs that are images made of units: the part file becomes the image. */
#ifndef BATTEN_WORKER_IMAGE_H
#define BATTEN_WORKER_IMAGE_H

#include "exr.h"
#include "worker.h"

/*
 * In begin: all units are, in rising order, the tiles of that image, the worker's own output, each a
 * chunk of exr_pack with a little behind it. They are kept in that order then, and nothing is written
 * twice.
 */
void work_units_are_tiles(struct work *w, const struct exr_image *image);

/*
 * In finish, once the figures are stated, in place of work_output: the image with the work's
 * attributes whose tile i is unit first + i.
 */
enum status work_image(struct work *w, const char *extension, const struct exr_image *image,
                       size_t first);

/* In finish: where an output that was made lies until all are renamed. Borrowed; NULL: it was not. */
const char *work_made(const struct work *w, const char *extension);

#endif
