/* render.h - what the writers of pictures share. Private to this folder. */
#ifndef BATTEN_VIEW_RENDER_H
#define BATTEN_VIEW_RENDER_H

#include "picture.h"
#include "text.h"
#include "view.h"

/* A view of a picture of one or several. */
struct render_tile {
	struct view_state state;
	int x, y, width, height; /* px, from the upper left corner */
	int seen;                /* of its width what the view takes; its key stands in the rest */
	bool is_plane;           /* the plane of a surface's parameters */
	bool is_empty;           /* has nothing but its heading */
	bool has_key;            /* its key stands in it, where it has one */
	struct text title, note;
};
struct render_tiles {
	struct render_tile tile[N_QUANTITIES + 1];
	int n;
};

/* render_tiles.c. lines: of a picture of lines, in which maps cannot be told. Errors: as view_fit. */
enum status render_tiles_init(struct render_tiles *tiles, const struct world *w,
                              const struct render_options *o, bool lines, const struct report *r);
void render_tiles_finish(struct render_tiles *tiles);

/* render_words.c: which quantity the picture shows, as the surfaces that are on have it, -1: none; its title
 * and note, appended to those. */
int render_quantity(const struct world *w, const struct render_options *o);
void render_words(const struct world *w, const struct render_options *o, struct text *title,
                  struct text *note);
void render_add_quantity(struct text *title, int quantity);
void render_add_names(struct text *t, const struct world *w); /* of the things that are on */
/* What the lines are of; named: and of which things. */
void render_add_note(struct text *note, const struct world *w, bool named);

/* render_lines.c: curves, wire frames and lines of results as .svg or .pdf. */
enum status render_lines(const struct world *w, const char *path, enum picture_format format,
                         const struct render_tiles *tiles, const struct render_options *o,
                         const struct report *r);

/* render_plane.c: the plane of the parameters of a surface as lines of a picture; it begins at the origin.
 * view_plane_surface says of which. Errors: ST_RESOURCE. */
struct plane_lines {
	struct picture_lines lines;
	struct camera camera;
	struct curve *curves;         /* owned, and each */
	struct picture_curve *styled; /* owned */
	struct picture_text *texts;   /* owned, and each text */
	int n_curves, n_texts;
	bool failed;
};
enum status plane_lines_init(struct plane_lines *p, const struct world *w,
                             const struct render_tile *tile, enum theme theme);
void plane_lines_finish(struct plane_lines *p);

#endif
