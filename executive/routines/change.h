/* change.h - an edit of one thing, with what lies on it. */
#ifndef BATTEN_CHANGE_H
#define BATTEN_CHANGE_H

#include "private.h"

/* A copy of what a thing is, to be changed. */
enum status change_begin(const struct act *a, const struct Ful *f, struct entity *e);
/* Put it in the thing's place (moved in, also on failure). moved: the shape is another one, not only its
 * description. */
enum status change_end(struct act *a, const char *what, int id, struct entity *e, bool moved);
/* Say why the geometry could not be made. */
enum status change_failed(const struct act *a, enum status st, const char *what);

#endif
