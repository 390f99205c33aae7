/* help_routines.h - help of the editor's menus and routines, on a terminal. */
#ifndef BATTEN_HELP_ROUTINES_H
#define BATTEN_HELP_ROUTINES_H

#include <jansson.h>
#include <stdbool.h>

#include "report.h"

/* Is that an index of a menu or a routine: N or V and a number? */
bool is_routine_code(const char *word);

/*
 * Print the text of a code, with the path of its entry. Exit status: 0, else the sentence has been
 * said.
 */
int help_code(const char *code, bool json, const struct report *r);

/*
 * Print the routines and menus in which all the words occur, best first. `worker` is the description
 * of a worker of that name, which is printed with them as JSON; NULL where there is none.
 * *n_found is how many there are; nothing is printed where there are none and no worker is.
 * Exit status.
 */
int help_words(const char *words, json_t *worker, bool json, size_t *n_found,
               const struct report *r);

#endif
