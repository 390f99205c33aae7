/* jobs_log.h - below the list of jobs: the end of a log. */
#ifndef BATTEN_JOBS_LOG_H
#define BATTEN_JOBS_LOG_H

#include "paint.h"

void paint_log(const struct paint *p, const struct box_px *b, const struct jobs_model *m);

#endif
