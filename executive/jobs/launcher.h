/* launcher.h - what starts workers and carries their packets; the queue knows no processes. */
#ifndef BATTEN_LAUNCHER_H
#define BATTEN_LAUNCHER_H

#include "message.h"
#include "stats.h"

enum launcher_signal { LAUNCHER_STOP, LAUNCHER_CONTINUE, LAUNCHER_TERMINATE, LAUNCHER_KILL };

/* How a worker ended. */
struct launcher_exit {
	int status;       /* exit status, where signal is 0 */
	int signal;       /* that ended it, or 0 */
	double cpu_s;     /* NaN: not known */
	int64_t peak_kib; /* -1: not known */
	bool lost;        /* not by its own doing: its node or its launcher went away */
	char why[256];    /* what its launcher knows better than the worker; "": nothing */
};

/* Where a launcher tells what happens; loop thread, never from inside a call of the launcher. */
struct launcher_sink {
	void *data;
	void (*packet)(void *data, int64_t id, const struct message *m);
	void (*broken)(void *data, int64_t id, const char *reason); /* it sent what is no packet */
	void (*drained)(void *data, int64_t id);                    /* its pipe has ended */
	void (*exited)(void *data, int64_t id, const struct launcher_exit *e);
	void (*stopped)(void *data, int64_t id, bool stopped); /* or goes on */
	/* It was to be stopped, and whoever is asked does not do it: it goes on. */
	void (*refused)(void *data, int64_t id);
	/* It will begin when others let it, and why not yet; NULL: from now on it can say HELLO. */
	void (*waits)(void *data, int64_t id, const char *reason);
};

/* Every signal goes to the worker and all that it started. */
struct launcher {
	void *data;
	/* Could this job be started? Errors: ST_PARAMETER (no such worker), ST_INPUT (an input is
	 * not there). */
	enum status (*check)(void *data, const struct Stats *s, const struct report *r);
	/* See to it that the worker which an earlier service started for s is gone: a dead service's
	 * lock is free a moment before its workers die, and two must not write one part file. */
	void (*bury)(void *data, const struct Stats *s);
	/* Start its worker; pid, host and log of s are filled in. */
	enum status (*start)(void *data, struct Stats *s, const struct report *r);
	/* Never waits; what does not fit in the pipe is not sent. */
	enum status (*send)(void *data, int64_t id, enum message_type type, const json_t *body);
	void (*signal)(void *data, int64_t id, enum launcher_signal signal);
	/* A line into the job's log. */
	void (*note)(void *data, int64_t id, const char *level, const char *text);
	/* The job's record for START. */
	const char *(*job_file)(void *data, int64_t id);
	/* The job is over: let go of what is left of it. */
	void (*forget)(void *data, int64_t id);
};

#endif
