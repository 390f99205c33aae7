/* slurm.h - the launcher of workers on a cluster: srun carries their packets, scancel their signals.
 *
 * Every process is a Slurm job of its own, named batten-PROJECT-JOB, so that what an earlier service
 * left can be found. The project's folder must be on a disk that the nodes share.
 */
#ifndef BATTEN_SLURM_H
#define BATTEN_SLURM_H

#include <uv.h>

#include "launcher.h"
#include "project.h"
#include "settings.h"

struct slurm; /* opaque */

/* All but out is borrowed. Slurm need not be installed: then no job passes the check.
 * Errors: ST_RESOURCE. Thread: the loop's. */
enum status slurm_create(struct slurm **out, uv_loop_t *loop, const struct project *p,
                         const struct settings *settings, const struct report *r);
const struct launcher *slurm_launcher(struct slurm *s);
void slurm_connect(struct slurm *s, struct launcher_sink sink);
/* End what is left and close every handle; free with slurm_destroy after the loop has run out. */
void slurm_close(struct slurm *s);
void slurm_destroy(struct slurm *s); /* NULL is fine */

#endif
