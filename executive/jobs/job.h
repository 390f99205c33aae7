/* job.h - a job inside the queue. Private to the files of the queue. */
#ifndef BATTEN_JOB_H
#define BATTEN_JOB_H

#include "queue.h"

/* Of a job that came while the whole queue was held. */
extern const char job_held_text[];

/* Why a job is being ended by us. */
enum job_cause { CAUSE_NONE, CAUSE_KILL, CAUSE_FAULT, CAUSE_LEAVE };

/* How far the ending of a worker has gone. */
enum ending { STEP_BEGIN, STEP_CANCEL, STEP_TERMINATE, STEP_KILL };

/* Where jobs run, each with a line of its own: they do not wait for each other. */
enum { POOL_HERE, POOL_ELSEWHERE, N_POOLS };

struct pool {
	struct job *first, *tail;  /* the line */
	const struct job *blocked; /* first in line that finds no threads or memory */
	int active;                /* starting, running or ending */
	int threads;               /* of those */
	int64_t memory_mib;        /* of jobs with a process */
	int64_t room_mib;          /* that blocked found on its disk and were too few; -1 */
	int64_t wanted_mib;        /* instead of those */
	int64_t promised_mib;      /* in that: to jobs that run */
};

/* What the jobs of a worker took, for those of which no progress is known yet. */
struct history {
	char *worker;          /* owned */
	double seconds, units; /* of all of them; seconds of one thread */
	int jobs;
};

/* What the outputs of a job took, for those like it: same worker, same parameters. */
struct likeness {
	char *worker;       /* owned */
	json_t *parameters; /* owned */
	int64_t bytes;      /* the largest */
};

enum { LIKENESSES = 64 };

/* So many at once, then so many a second. */
struct bucket {
	double level, at;
};

struct job {
	struct queue *q;         /* borrowed: outlives every job */
	struct Stats stats;      /* state: changed only by job_enter() */
	struct job *prev, *next; /* in the line, while queued */
	bool in_line;
	bool front; /* first in line */
	bool forgotten;
	bool needed;   /* by one that has not ended; as of the last archive_let_go */
	int unsettled; /* jobs it waits for */
	int losses;    /* of processes that were not its own doing */

	/* this run */
	bool process;           /* it has one, or its pipe is open */
	bool exited, drained;   /* both true: the job has ended */
	bool greeted, finished; /* HELLO came, DONE came */
	bool stopping;          /* SIGSTOP sent, not seen yet */
	uint64_t disks[ROOMS];  /* that it writes to */
	int n_disks;
	int64_t promised_mib; /* on each of them; 0: not known what it will write */
	struct launcher_exit exit;
	enum job_cause cause;
	enum ending step;
	char *fault;       /* owned; what went wrong, in words */
	enum status error; /* class of its ERROR packet, ST_OK: none */
	double deadline;   /* of the clock; INFINITY: none */
	double began, stopped_at, stopped_s;
	double greeted_s; /* running seconds at HELLO */
	double pace_at;   /* running seconds at the first PROGRESS of the phase, NaN: none */
	int64_t pace_done;
	struct bucket packets, notes;

	/* telling */
	bool dirty; /* to be written into the ledger, then told */
	bool news;  /* progress: told when told_at allows */
	double told_at;
};

struct queue {
	struct queue_ports ports; /* borrowed */
	struct queue_limits limits;
	struct job **jobs; /* owned; by rising id */
	int n, cap;
	int64_t last; /* highest id ever given */
	struct pool pools[N_POOLS];
	struct job **active; /* owned array of borrowed: jobs with a process */
	int n_active, active_cap;
	int count[N_JOB_STATES];
	struct job **changed; /* owned array of borrowed */
	int n_changed, changed_cap;
	int dependents; /* jobs that wait, or waited, for others */
	bool leaving, unsettled;
	bool held;   /* jobs that come wait until they are released */
	char *fault; /* owned; why the ledger takes nothing */
	double retry_at;
	double look_at;          /* when to look for room on a disk again */
	struct history *history; /* owned */
	int n_history;
	struct likeness likenesses[LIKENESSES]; /* a ring */
	int next_likeness;
	struct Stats visitor; /* owned; of queue_find, for one that is not in memory */
	double sync_at;       /* when the ends of jobs must be on the disk */
	int64_t sync_id;      /* one of those jobs */
};

double queue_now(const struct queue *q);
struct job *queue_job(const struct queue *q, int64_t id);
struct pool *job_pool(const struct job *job);
int job_threads(const struct job *job);        /* of all its processes */
int64_t job_memory_mib(const struct job *job); /* likewise */

/* queue.c */
void job_destroy(struct job *job);
void queue_insert(struct queue *q, struct job *job);
/* A job with that record, which is taken over; NULL: no memory. */
struct job *queue_take(struct queue *q, struct Stats *s, bool front);
void queue_admit(struct job *job); /* into the line, or to wait for others */
/* Take those that are marked as forgotten out of memory. */
void queue_drop_forgotten(struct queue *q);

/* archive.c */
struct job *archive_fetch(struct queue *q, int64_t id); /* into memory; NULL: there is none */
void archive_fetch_awaited(struct job *job);            /* what it waits for */
void archive_fetch_last(struct queue *q);               /* to learn what they took */
void archive_let_go(struct queue *q);                   /* of what ended long ago */

/* state.c */
/* Let it happen; ST_INPUT where the table has no such cell. */
enum status job_step(struct job *job, enum job_event event, const char *by);
void job_enter(struct job *job, enum job_state state);
/* Set a reason; NULL clears. Text is copied. */
void job_reason(struct job *job, const char *format, ...) __attribute__((format(printf, 2, 3)));
void job_fault(struct job *job, const char *format, ...) __attribute__((format(printf, 2, 3)));
void job_changed(struct job *job, bool urgent);

/* ending.c */
void job_signal(struct job *job, enum launcher_signal signal);
void job_end(struct job *job, enum job_cause cause, enum ending step);
void job_escalate(struct job *job);
void job_gone(struct job *job); /* its final state, or queued again */
void job_tidy(struct job *job); /* its process is gone before its time */

/* history.c */
void history_add(struct job *job);             /* it is done */
double history_seconds(const struct job *job); /* that it will run, NaN: not known */
int64_t history_bytes(const struct job *job);  /* that it will write, 0: not known */
void history_finish(struct queue *q);

/* packets.c */
void job_packet(struct job *job, const struct message *m);
double job_running_s(const struct job *job); /* seconds of this run, suspended ones left out */
double job_wall_end(const struct job *job);  /* of the clock, INFINITY: no limit */
void job_times(struct job *job);             /* wall_s, suspended_s, eta_s as of now */

/* line.c */
void line_add(struct job *job);
void line_remove(struct job *job);
void line_start(struct queue *q);  /* start what may start */
void line_settle(struct queue *q); /* look at the jobs that wait for others */
int line_unsettled(const struct job *job);
bool line_depends(const struct job *job); /* on others */
void line_reason(struct job *job);        /* why it waits */

#endif
