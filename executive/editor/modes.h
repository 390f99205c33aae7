/* modes.h - the ways to start batten-editor; each takes the words behind its name and gives the exit
 * status. */
#ifndef BATTEN_MODES_H
#define BATTEN_MODES_H

#include "world.h"

/* Options by name and value as `batten render` checked them, and files. */
int mode_render(int argc, char **argv);

/* [CODE] [--json] */
int mode_routines(int argc, char **argv);
/* FILE|- [--keep-going] [--journal] */
int mode_script(int argc, char **argv);

/* The `picture` of an act; only where there is a view (BATTEN_VIEW). */
enum status editor_picture(const struct world *w, const char *path, const char *view, int width,
                           int height, const struct report *r);

#endif
