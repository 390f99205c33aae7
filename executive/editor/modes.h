/* modes.h - the ways to start batten-editor; each takes the words behind its name and gives the exit
 * status. */
#ifndef BATTEN_MODES_H
#define BATTEN_MODES_H

#include "routine.h"

/* Options by name and value as `batten render` checked them, and files. */
int mode_render(int argc, char **argv);

/* [CODE] [--json] */
int mode_routines(int argc, char **argv);
/* FILE|- [--keep-going] [--journal] */
int mode_script(int argc, char **argv);

/* The `picture` of an act; only where there is a view (BATTEN_VIEW). */
enum status editor_picture(const struct world *w, const struct picture_wish *wish,
                           const struct report *r);

/* Files: the window on the project of the current folder, with these beside what its session kept. Returns
 * when it is closed. Exit status: 0; 1 where there is no display, no OpenGL 3.3, or the display went
 * away. Only where there is a window system (BATTEN_WINDOW). */
int mode_window(int argc, char **argv);

#endif
