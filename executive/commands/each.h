/* each.h - the verbs that do one thing to each job named: suspend, activate, kill, ... */
#ifndef BATTEN_EACH_H
#define BATTEN_EACH_H

#include "command.h"
#include "message.h"

/* Options --all and --group. */
extern const struct option_row each_options[];

/* Send the request for the jobs named and show what they are now. more: members added (stolen), or
 * NULL; with "all" no job need be named. Exit status. */
int each_job(const struct invocation *i, enum message_type type, json_t *more);

#endif
