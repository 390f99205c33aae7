/* modes.h - the ways to start batten-editor; each takes the words behind its name and gives the exit
 * status. */
#ifndef BATTEN_MODES_H
#define BATTEN_MODES_H

/* Options by name and value as `batten render` checked them, and files. */
int mode_render(int argc, char **argv);

#endif
