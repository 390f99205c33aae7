/* child.h - a worker's process: its pipe, its exit, its stops. Private to the local launcher. */
#ifndef BATTEN_CHILD_H
#define BATTEN_CHILD_H

#include <uv.h>

#include "local.h"

struct worker {
	struct local *local; /* borrowed */
	struct worker *next;
	int64_t id;
	pid_t pid; /* 0: has been waited for */
	int in, log;
	int out, pidfd; /* -1: closed */
	uv_poll_t out_poll, pid_poll;
	int n_handles; /* still open */
	bool forgotten;
	bool greeted, stopped, late; /* late: killed, for it said nothing in time */
	int stop_looks;              /* since it was told to stop and has not; 0: it was not */
	uint64_t hello_ms;           /* of the loop: until when it must say something; 0: ever */
	struct message_reader reader;
	char *job_file; /* owned */
};

struct local {
	uv_loop_t *loop;
	const struct project *project;
	struct launcher launcher;
	struct launcher_sink sink;
	char *starter, *host;
	char *name, *path; /* the worker found last, for the next job of the same */
	int niceness;
	double hello_s;     /* that a process has for its first packet, 0: any time */
	local_words *words; /* NULL: the workers themselves */
	void *words_data;
	uv_signal_t child;
	uv_timer_t look;
	struct worker *workers; /* those not forgotten */
};

/* Listen to the pipe and the exit of a process that was started. */
void child_listen(struct worker *w);
/* The job is over: close what is open; freed when the loop has let go of it. */
void child_forget(struct worker *w);
/* For the launcher's SIGCHLD (libuv does not tell of stops) and its timer (looks at the logs). */
void child_on_signal(uv_signal_t *signal, int number);
void child_on_look(uv_timer_t *timer);

enum { LOG_LOOK_MS = 500, STOP_LOOKS = 3 };

#endif
