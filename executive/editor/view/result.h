/* result.h - lines of a result file. Private to this folder. */
#ifndef BATTEN_VIEW_RESULT_H
#define BATTEN_VIEW_RESULT_H

#include "model.h"
#include "text.h"

struct result;
void result_finish(struct result *r);

/* The value a line stands for, and its attribute's name; NULL and 0: it has none. */
const char *result_value(const struct entity *e, double *value);

#endif
