/* tidy.h - what killed workers leave beside their outputs. */
#ifndef BATTEN_TIDY_H
#define BATTEN_TIDY_H

#include "stats.h"

/* Take away the half-written files of a job that has no process. */
void tidy_outputs(const struct Stats *s);

#endif
