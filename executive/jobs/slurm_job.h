/* slurm_job.h - what the files of the Slurm launcher know of each other. Private. */
#ifndef BATTEN_SLURM_JOB_H
#define BATTEN_SLURM_JOB_H

#include <sys/types.h>

#include "local.h"
#include "process.h"
#include "slurm.h"

enum slurm_want { WANT_GO, WANT_STOP, WANT_END };

/* One srun and what it stands for. */
struct slurm_job {
	struct slurm_job *next;
	int64_t id;
	int64_t number; /* Slurm's own, 0: not known */
	char *name;     /* owned; Slurm knows it by this */
	char *log;      /* owned */
	off_t log_from; /* where this run's part begins */
	bool running;   /* on a node */
	bool greeted, finished, killed;
	int hello_looks; /* looks since it is on a node and says nothing */
	bool busy;       /* a program of Slurm is at work on it */
	bool held;       /* stopped while it waited: Slurm does not start it */
	enum slurm_want want, is;
	int refusals;        /* of the order to get from is to want */
	uint64_t refused_ms; /* the loop's time of the first of those */
	bool sweeping;       /* srun is gone, what it started is being ended */
	int sweeps;          /* looks so far whether that is gone */
	struct launcher_exit exit;
};

struct slurm {
	const struct project *project;   /* borrowed */
	const struct settings *settings; /* borrowed */
	struct local *local;             /* carries the sruns */
	const struct launcher *below;    /* its port */
	struct launcher launcher;
	struct launcher_sink sink;
	struct orders *orders;
	struct slurm_job *jobs;
	char *srun;   /* owned; NULL: not installed */
	char *prefix; /* owned; of the names of this project's jobs */
	uv_timer_t look, sweep, again;
	uint64_t look_ms;
	bool looking;
};

struct slurm_job *slurm_job(const struct slurm *s, int64_t id);

/* slurm_watch.c */
/* Look at Slurm's queue while there are jobs that have not begun: soon, then ever more rarely. */
void slurm_look_soon(struct slurm *s);
/* Stop it, let it go on, end it: by a program of Slurm, one at a time for each job. */
void slurm_want(struct slurm *s, struct slurm_job *j, enum slurm_want want);
/* Cancel whatever Slurm has under its name. */
void slurm_cancel(struct slurm *s, const struct slurm_job *j);
/* Likewise, then tell its exit when nothing is left of it: the next must not find its part file held. */
void slurm_sweep(struct slurm *s, struct slurm_job *j, const struct launcher_exit *e);

#endif
