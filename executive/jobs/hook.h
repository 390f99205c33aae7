/* hook.h - a user's command, run at the end of each job and of each group. */
#ifndef BATTEN_HOOK_H
#define BATTEN_HOOK_H

#include <uv.h>

#include "stats.h"

struct hooks; /* opaque */

/* command goes to /bin/sh; "" runs nothing. loop is borrowed. Errors: ST_RESOURCE. */
enum status hooks_create(struct hooks **out, uv_loop_t *loop, const char *command);

/*
 * Run it with BATTEN_EVENT ("job" or "group"), BATTEN_JOB, BATTEN_STATE, BATTEN_WORKER, BATTEN_GROUP and
 * BATTEN_REASON in its environment. Never waits: some run at once, the others after them. state: the
 * job's, or "done" or "failed" of a group.
 */
void hooks_run(struct hooks *h, const char *event, const struct Stats *s, const char *state);
bool hooks_wanted(const struct hooks *h);

/* What has not begun never will; what runs goes on by itself. Free with hooks_destroy after the loop
 * has run out. */
void hooks_close(struct hooks *h);
void hooks_destroy(struct hooks *h);

#endif
