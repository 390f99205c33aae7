/* level_look.h - curves of single patches, before they are joined: to be shown while others are traced.
 *
 * A block is what level_patch appended for some patches of one field, behind a head that names it.
 */
#ifndef BATTEN_LEVEL_LOOK_H
#define BATTEN_LEVEL_LOOK_H

#include "level.h"

/* Which curve of several a block is part of. */
struct level_head {
	enum level_kind kind;
	double value; /* as its user names it: degrees of an isophote, the number of a line */
};

void level_head_add(struct text *out, const struct level_head *head);

/* Bytes of the head that a block begins with; 0: it has none. */
size_t level_head_size(const char *block, size_t n);

/*
 * Give each strand of a block: a cubic B-spline in space, borrowed for the call, of another parameter than
 * the branch will have. Nothing is given of a block without a head, nor of what is behind damaged bytes.
 * Thread: any. Errors: ST_RESOURCE, and what `take` returns.
 */
typedef enum status level_take(void *data, const struct level_head *head, const struct curve *c);
enum status level_look(const char *block, size_t n, level_take *take, void *data);

#endif
