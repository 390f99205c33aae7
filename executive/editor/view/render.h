/* render.h - what the writers of pictures share. Private to this folder. */
#ifndef BATTEN_VIEW_RENDER_H
#define BATTEN_VIEW_RENDER_H

#include "picture.h"
#include "text.h"
#include "view.h"

/* Title and note of the world's picture, fresh. */
void render_words(const struct world *w, const struct render_options *o, struct text *title,
                  struct text *note);

/* render_lines.c: curves, wire frames and lines of results as .svg or .pdf. */
enum status render_lines(const struct world *w, const char *path, enum picture_format format,
                         const struct camera *camera, const struct render_options *o,
                         const struct report *r);

#endif
