/* slurm_end.h - how a process in Slurm ended, from srun's exit and its last words. */
#ifndef BATTEN_SLURM_END_H
#define BATTEN_SLURM_END_H

#include "launcher.h"

/*
 * e is srun's own exit; it becomes the worker's, with why where Slurm knows that. words: what srun
 * and the worker wrote to the log.
 */
void slurm_end(struct launcher_exit *e, const char *words);

/* What squeue gives as a reason for waiting, in words; borrowed. */
const char *slurm_reason(const char *reason);

#endif
