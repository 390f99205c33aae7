/* exr.h - OpenEXR images in tiles: each tile packed (compressed) by itself, in any thread, and the
 * file put together from packed tiles without touching them again, or around them. */
#ifndef BATTEN_EXR_H
#define BATTEN_EXR_H

#include <stdbool.h>
#include <stdint.h>

#include "report.h"
#include "text.h"

enum {
	EXR_CHANNELS_MAX = 64,
	EXR_CHUNK_HEAD =
	        20, /* bytes of a chunk before the packed ones: where the tile lies, size */
};

struct exr_channel {
	const char *name; /* borrowed; "R", "N.X", "K"; each name once */
	bool half;        /* half float in the file; else float */
};

struct exr_attribute {
	const char *name, *value; /* borrowed; a string attribute */
};

struct exr_image {
	int width, height;
	int tile;                           /* tile width and height in pixels */
	const struct exr_channel *channels; /* borrowed */
	int n_channels;
	const struct exr_attribute *attributes; /* borrowed */
	int n_attributes;
};

/* Tiles across, down, and in all. Tile i lies at (i % across, i / across). */
int exr_tiles_across(const struct exr_image *im);
int exr_tiles_down(const struct exr_image *im);
size_t exr_tiles(const struct exr_image *im);

/* Pixels of tile i: x, y of its first, width and height (smaller at the border). */
void exr_tile_window(const struct exr_image *im, size_t i, int *x, int *y, int *w, int *h);

/*
 * Make tile i's chunk, as it stands in a file: planes[c] holds the tile's values of channel c, w x h
 * floats without gaps; half channels are converted to nearest, ties to even. The bytes are appended to *out. Level 2 zip, or
 * as they are where that saves less than a tenth. The bytes depend on nothing but size and values.
 * Thread: any. Errors: ST_RESOURCE.
 */
enum status exr_pack(const struct exr_image *im, size_t i, const float *const *planes,
                     struct text *out);

/*
 * The inverse: planes[c] receives tile i's w x h values of channel c. What stands behind the chunk
 * in its n bytes is left alone. Thread: any. Errors: ST_INPUT (no such tile), ST_RESOURCE.
 */
enum status exr_unpack(const struct exr_image *im, size_t i, const char *bytes, size_t n,
                       float *const *planes);

/*
 * What a file of that image begins with where its chunks lie at `places` already: header with the
 * attribute `first` (n bytes as they stand in a file) before all others, table of places.
 * Errors: ST_RESOURCE.
 */
enum status exr_front(const struct exr_image *im, const void *first, size_t n,
                      const uint64_t *places, struct text *out);

/* Give tile i's chunk, and whatever stands behind it, valid until the next call. */
typedef enum status exr_source(void *data, size_t i, const char **bytes, size_t *n);

/*
 * Write the whole file under `path` (which the caller renames: give a temporary name). Tiles are
 * asked for in rising order. A failure of the source is given back as it is; on any failure
 * nothing is left under `path`. Errors: ST_INPUT (folder missing, not writable), ST_RESOURCE (full disk).
 */
enum status exr_write(const char *path, const struct exr_image *im, exr_source *source, void *data,
                      const struct report *r);

/* A read image: all channels as float. */
struct exr_picture {
	int width, height, n_channels;
	char **names;   /* owned; sorted */
	float **planes; /* owned, width x height each, rows from the top; NULL: attributes only */
	struct exr_pair {
		char *name, *value;
	} * attributes; /* owned; string attributes only */
	int n_attributes;
};

/*
 * Read all channels of the first part, tiled (finest level) or in scan lines, also of other
 * programs. Nothing larger than the file can hold is allocated. *out is empty on failure.
 * Errors: ST_INPUT (missing, not an image, damaged, deep or subsampled), ST_RESOURCE.
 */
enum status exr_read(struct exr_picture *out, const char *path, const struct report *r);

/* Size, names of channels and string attributes, without the pixels. */
enum status exr_read_attributes(struct exr_picture *out, const char *path, const struct report *r);
void exr_picture_finish(struct exr_picture *p);
const float *exr_plane(const struct exr_picture *p, const char *name); /* NULL if none */
const char *exr_text(const struct exr_picture *p, const char *name);   /* attribute; NULL if none */

#endif
