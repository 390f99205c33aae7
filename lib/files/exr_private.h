/* exr_private.h - what the files of exr.h know of each other. */
#ifndef BATTEN_EXR_PRIVATE_H
#define BATTEN_EXR_PRIVATE_H

#include "exr.h"

enum { EXR_ZIP_LEVEL = 2 };

/* Channels in the order of their names, as rows have them; bytes of n pixels. */
size_t exr_order(const struct exr_image *im, size_t n, int order[EXR_CHANNELS_MAX]);

void exr_add_u32(struct text *out, uint64_t x);

/* Do n bytes become a tenth smaller? Judged by a slice of each half. */
bool exr_is_worth(const unsigned char *bytes, size_t n);

#endif
