/* compose.h - pieces of the window as textures, put over each other with OpenGL. */
#ifndef BATTEN_COMPOSE_H
#define BATTEN_COMPOSE_H

#include <cairo.h>
#include <stdbool.h>

#include "report.h"

/* A Cairo surface and the texture it goes to. A zeroed one is empty. Lengths in device px. */
struct sheet_part {
	cairo_surface_t *surface; /* owned */
	unsigned texture;
	int x, y, width, height; /* from the window's upper left corner; width 0: not shown */
};

struct compose; /* opaque; needs the same GL context in every call */

enum status compose_create(struct compose **out, const struct report *r);
void compose_destroy(struct compose *c);

/* Where the views are drawn, kept until they change: bind it, draw, unbind. Errors: ST_RESOURCE. */
enum status compose_view_begin(struct compose *c, int width, int height, const struct report *r);
void compose_view_end(struct compose *c);

/* A context to paint the part with, clear, scaled and moved so that it has window coordinates in
 * logical px; NULL: memory ran out. compose_paint_end uploads it and destroys cr. */
cairo_t *compose_paint_begin(struct compose *c, struct sheet_part *p, int x, int y, int width,
                             int height, double scale);
void compose_paint_end(struct compose *c, struct sheet_part *p, cairo_t *cr);
void compose_part_finish(struct sheet_part *p);

/* All on the window's framebuffer: the views, then the parts in their order. */
void compose_show(struct compose *c, const struct sheet_part *parts, int n, int width, int height);

#endif
