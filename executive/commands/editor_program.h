/* editor_program.h - batten-editor, which holds what batten itself does not link: window, OpenGL. */
#ifndef BATTEN_EDITOR_PROGRAM_H
#define BATTEN_EDITOR_PROGRAM_H

#include "report.h"

/*
 * Become batten-editor with these words (words[0] is set here; NULL ends them): found beside this
 * program, in the build folder's editor/, then among the installed programs. Returns only on
 * failure, with the exit status.
 */
int editor_program_become(char **words, const struct report *r);

#endif
