/* sheet.h - a Cairo surface in memory that becomes a PNG file. */
#ifndef BATTEN_SHEET_H
#define BATTEN_SHEET_H

#include <cairo.h>

#include "report.h"

struct sheet {
	cairo_surface_t *surface; /* owned */
	cairo_t *cr;              /* owned */
	int width, height;
};

/* width and height in px; width 0: nothing to draw on yet, but texts can be measured. `path`, here and below, is
 * the picture's in sentences and where it is written. Errors: ST_RESOURCE (no memory, larger than a
 * picture can be), on writing also ST_INPUT (folder missing, not writable). */
enum status sheet_init(struct sheet *s, const char *path, double width, double height,
                       const struct report *r);
void sheet_finish(struct sheet *s); /* a zeroed one is fine */

/* Pixels as 0xRRGGBB, rows of `stride` numbers; tell by sheet_touched when they were changed. */
unsigned *sheet_pixels(struct sheet *s, int *stride);
void sheet_touched(struct sheet *s);

enum status sheet_write(struct sheet *s, const char *path, const struct report *r);

#endif
