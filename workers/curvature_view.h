/* curvature_view.h - the curvatures of a surface as seen from a camera. */
#ifndef BATTEN_CURVATURE_VIEW_H
#define BATTEN_CURVATURE_VIEW_H

#include "colormap.h"
#include "curvature.h"
#include "worker.h"

struct curvature_view; /* opaque; read-only after create */

/* From the parameters --view and --size. Errors: ST_PARAMETER, ST_INPUT, ST_RESOURCE. */
enum status curvature_view_create(struct curvature_view **out, struct work *w);
void curvature_view_destroy(struct curvature_view *v); /* NULL is fine */

size_t curvature_view_tiles(const struct curvature_view *v);

/* Packed bytes of a tile. Thread: any. */
enum status curvature_view_tile(const struct curvature_view *v, size_t tile, struct text *out);

/* Write .view.exr and .view.png; tile i is unit first + i. */
enum status curvature_view_finish(const struct curvature_view *v, struct work *w, size_t first,
                                  enum quantity shown, const struct colormap *map);

#endif
