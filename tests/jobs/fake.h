/* fake.h - launcher, ledger, clock and listener for the queue, without a process or a file. */
#ifndef FAKE_H
#define FAKE_H

#include "queue.h"
#include "text.h"

enum { FAKE_ROWS = 64 };

struct fake {
	struct launcher launcher;
	struct ledger ledger;
	struct clock clock;
	struct queue_limits limits;
	struct queue *q;
	struct launcher_sink sink;
	double now;
	/* what was done, in order: "start 1", "START 1", "CANCEL 1", "stop 1", "write 1 running",
	 * "told 1 running", ... each ended by ';' */
	struct text log, seen;
	bool refuse, full, missing; /* no process; no room in the ledger; no input */
	struct {
		json_t *record;
		bool front, killed;
	} rows[FAKE_ROWS]; /* the ledger, by id */
	uint64_t disk;     /* that jobs write to */
	int64_t room;      /* MiB on the disk; -1: not known */
	int64_t size;      /* bytes of what a job made; -1: not known */
	int64_t last;
	bool held;
	int unsynced; /* changes since the last durable write */
};

/* Two jobs at once, graces of 2, 3, 10 and 5 s. The queue is made and loaded. */
void fake_init(struct fake *f);
void fake_finish(struct fake *f);
/* Of cmocka: *state is a fake; gone again. */
int fake_new(void **state);
int fake_gone(void **state);

/* A crash: the queue is gone, the ledger stays, another begins. */
void fake_restart(struct fake *f);

/* Submit one; its id. */
int64_t fake_submit(struct fake *f, int priority, int threads, int64_t after);
/* One that waits for the end of another, whatever end that is. */
int64_t fake_submit_after_any(struct fake *f, int64_t after);

/* A worker's packets and ends, each with the turn that follows. */
void fake_hello(struct fake *f, int64_t id);
void fake_packet(struct fake *f, int64_t id, enum message_type type, json_t *body);
void fake_exit(struct fake *f, int64_t id, int status, int signal);
void fake_eof(struct fake *f, int64_t id);
void fake_refused(struct fake *f, int64_t id);
void fake_stopped(struct fake *f, int64_t id, bool stopped);
/* HELLO, RESULT, DONE, exit 0, end of the pipe. */
void fake_success(struct fake *f, int64_t id);

/* A user's event and the turn that follows. */
enum status fake_event(struct fake *f, int64_t id, enum job_event event);

/* Let time go on to the next deadline not later than s from now; then to that time. */
void fake_wait(struct fake *f, double s);

enum job_state fake_state(struct fake *f, int64_t id);
const char *fake_reason(struct fake *f, int64_t id); /* "" for none */
/* Word of the state in the ledger, "" where there is no record. */
const char *fake_row(struct fake *f, int64_t id);
/* What was done since the last call, without ledger and telling. */
const char *fake_log(struct fake *f);

#endif
