/* color_image.h - images with a color, depth, normal and point for each pixel, as shading and ray
 * trace make them. */
#ifndef BATTEN_COLOR_IMAGE_H
#define BATTEN_COLOR_IMAGE_H

#include "image.h"

enum color_channel { R, G, B, A, Z, NX, NY, NZ, PX, PY, PZ, N_COLOR_CHANNELS };

extern const struct exr_channel color_channels[N_COLOR_CHANNELS];

/*
 * What ray i of the sample shot last hit: its share in A and, of the centre sample, Z to PZ.
 * False where it hit nothing: then Z is infinite.
 */
bool color_place(struct image_tile *t, size_t i, bool center, float share);

/* A worker's finish: the image under `extension`, the picture under `png` where that is asked for. */
enum status color_finish(const struct image *im, struct work *w, const char *extension,
                         const char *png);

#endif
