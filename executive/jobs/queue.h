/* queue.h - every job of the project, which of them run, and what happens to each.
 *
 * The queue stands on four things it is given: a launcher, a ledger, a clock and a listener. So its
 * whole conduct is tested without a process and without waiting. Thread: the loop's.
 */
#ifndef BATTEN_QUEUE_H
#define BATTEN_QUEUE_H

#include "launcher.h"
#include "ledger.h"
#include "state.h"

struct clock {
	void *data;
	double (*elapsed)(void *data); /* seconds, only ever rising */
	double (*date)(void *data);    /* seconds since 1970 */
};

/* What becomes of a job that ran when the service or the machine died, at the next start: it goes on;
 * it is held; it is lost. */
enum resume { RESUME_AUTO, RESUME_ASK, RESUME_NEVER };

struct queue_limits {
	int jobs, threads;  /* at once on this machine; a single job of more threads runs alone */
	int jobs_elsewhere; /* at once, of jobs that have other limits than this machine's */
	int64_t memory_mib; /* at once, of jobs that state it; 0: no limit */
	int job_threads;    /* of a job that does not say */
	int64_t job_memory_mib;
	double job_wall_s; /* 0: no limit */
	int over_kept;     /* that are over, in memory: so many, up to twice as many for a while */
	int64_t disk_floor_mib; /* no job starts where less is free */
	enum resume resume;
	double cancel_grace, term_grace, hello_grace, end_grace; /* seconds */
};

/* A disk that a job writes to, and the MiB free on it. Output and part file may lie on two. */
enum { ROOMS = 2 };
struct room {
	uint64_t disk;
	int64_t mib;
};

struct queue_ports {
	const struct launcher *launcher;
	const struct ledger *ledger;
	const struct clock *clock;
	/* So many jobs have been taken out of the ledger. NULL: nobody listens. */
	void (*loading)(void *data, int n);
	void *loading_data;
	/* A job has changed, and the change is in the ledger; s is borrowed. */
	void (*told)(void *data, const struct Stats *s);
	void *told_data;
	/* The disks a job writes to, how many: 0 where it is not known. NULL: nobody looks. */
	int (*room)(void *data, const struct Stats *s, struct room at[ROOMS]);
	/* Bytes of the files it made, -1: not known. NULL: nobody looks. */
	int64_t (*size)(void *data, const struct Stats *s);
	/* A job's process is gone before its time: take away what it left half written. NULL: nobody
	 * does. */
	void (*tidy)(void *data, const struct Stats *s);
	void *room_data; /* of these three */
};

struct queue; /* opaque */

/* Ports are borrowed. Errors: ST_RESOURCE. */
enum status queue_create(struct queue **out, const struct queue_ports *ports,
                         const struct queue_limits *limits);
void queue_destroy(struct queue *q);

/* What the launcher of this queue tells. */
struct launcher_sink queue_sink(struct queue *q);

/* Take the jobs that have not ended out of the ledger; what had a worker is queued again, or lost. Of
 * those that have, only what those wait for, and the last ones for what they took. */
enum status queue_load(struct queue *q, const struct report *r);

/*
 * Queue n jobs, all or none; in the ledger on return. Their worker, inputs, parameters and such are
 * taken from s (which stay the caller's); an id in after that is -1 - i means job i of s.
 * *first: their ids are first, first + 1, ... Errors: ST_PARAMETER, ST_INPUT, ST_RESOURCE.
 */
enum status queue_submit(struct queue *q, const struct Stats *s, int n, int64_t *first,
                         const struct report *r);

/*
 * A user's event. by: who asks, for the reason ("you"). Done in part only on return: see the state.
 * Errors: ST_INPUT (no such job, not possible in its state).
 */
enum status queue_event(struct queue *q, int64_t id, enum job_event event, const char *by,
                        const struct report *r);
enum status queue_priority(struct queue *q, int64_t id, int priority, const struct report *r);
/* Before all others of its line. Errors: ST_INPUT (it does not wait). */
enum status queue_top(struct queue *q, int64_t id, const struct report *r);

/* From now on jobs that are submitted or tried again are held, or no longer; what has begun goes on.
 * In the ledger on return. Errors: ST_RESOURCE. */
enum status queue_hold(struct queue *q, bool held, const struct report *r);

/* Forget jobs that have ended. Errors: ST_RESOURCE, ST_INPUT. */
enum status queue_forget(struct queue *q, const int64_t *ids, int n, const struct report *r);

/* End running jobs at a unit, to be queued for the next start; start none. */
void queue_leave(struct queue *q);

/* Start what may start, write the ledger, tell. At the end of each turn of the loop. */
void queue_turn(struct queue *q);

/* Call queue_tick at that time of the clock (INFINITY: never). */
double queue_deadline(const struct queue *q);
void queue_tick(struct queue *q);

/* The jobs in memory by rising id: all that have not ended, and some that have. Borrowed until the next
 * call that changes the queue; times and what is waited for are those told last. */
int queue_count(const struct queue *q);
const struct Stats *queue_at(const struct queue *q, int i);

/* Any job, also one that is only in the ledger; borrowed until the next call. NULL: there is none. */
const struct Stats *queue_find(struct queue *q, int64_t id);
bool queue_has(struct queue *q, int64_t id);
/* Suspended, or ended, but not yet: the answer to who asked for it is still to come. */
bool queue_stopping(const struct queue *q, int64_t id);
bool queue_holds(const struct queue *q, int64_t id); /* in memory */

/* Its record as JSON, appended: stats_write_brief, or where it is in memory and full is asked for
 * stats_write. False: there is no such job. */
bool queue_write(struct queue *q, int64_t id, bool full, struct text *out);

/* Ids of jobs that are over and not in memory, by rising number; *ids is the caller's to free. */
enum status queue_over(const struct queue *q, const struct ledger_choice *choice, int64_t **ids,
                       size_t *n, const struct report *r);

int queue_unended(const struct queue *q, const char *group,
                  bool *all_done);              /* jobs of that group */
bool queue_busy(const struct queue *q);         /* any queued, starting, running, ending */
int queue_processes(const struct queue *q);     /* jobs that have one, suspended ones too */
int queue_active(const struct queue *q);        /* starting, running or ending */
const char *queue_fault(const struct queue *q); /* why the ledger takes nothing, or NULL */

#endif
