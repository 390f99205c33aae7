/* crew.h - the processes of each job: on which launcher, and how many share its units.
 *
 * A launcher that stands on others. A job that is not cut is passed through to the launcher it names.
 * One that is cut gets a process for each shard, then one that joins what they left; to the queue
 * that looks like one worker: one HELLO, the sum of the progress, one end. A shard whose process went
 * away is begun again from its part file.
 */
#ifndef BATTEN_CREW_H
#define BATTEN_CREW_H

#include "launcher.h"

struct crew; /* opaque */

/* Errors: ST_RESOURCE. Thread: the loop's. */
enum status crew_create(struct crew **out);
void crew_destroy(struct crew *c);

/* A launcher below, by the name that jobs give; l is borrowed. Give crew_sink() to it. */
enum { CREW_LAUNCHERS = 4 };
void crew_add(struct crew *c, const char *name, const struct launcher *l);
struct launcher_sink crew_sink(struct crew *c);

/* The launcher to give to a queue, then the queue's sink to give back. */
const struct launcher *crew_launcher(struct crew *c);
void crew_connect(struct crew *c, struct launcher_sink sink);

#endif
