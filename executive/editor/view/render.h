/* render.h - what the writers of pictures share. Private to this folder. */
#ifndef BATTEN_VIEW_RENDER_H
#define BATTEN_VIEW_RENDER_H

#include "picture.h"
#include "text.h"
#include "view.h"

/* render_words.c: which quantity the picture shows, -1: none; its title and note, added to those. */
int render_quantity(const struct world *w, const struct render_options *o);
void render_words(const struct world *w, const struct render_options *o, struct text *title,
                  struct text *note);

/* render_lines.c: curves, wire frames and lines of results as .svg or .pdf. */
enum status render_lines(const struct world *w, const char *path, enum picture_format format,
                         const struct camera *camera, const struct render_options *o,
                         const struct report *r);

#endif
