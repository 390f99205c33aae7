/* submission.h - from the words of `run` and `submit` to jobs the service takes. */
#ifndef BATTEN_SUBMISSION_H
#define BATTEN_SUBMISSION_H

#include "connection.h"

extern const struct option_row submission_options[];
extern const char submission_help[];

/* Does an option that is passed on to the worker take a value? (flags need none) */
bool submission_takes_value(const struct invocation *i, const char *option);

/*
 * Check worker and parameters, import the inputs, submit. The new jobs are put in list.
 * Errors: ST_PARAMETER, ST_INPUT, ST_RESOURCE.
 */
enum status submission_send(const struct invocation *i, struct connection *c,
                            struct job_list *list);

#endif
