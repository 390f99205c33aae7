/* place.h - a throw-away project with players of workers, and a service in it. */
#ifndef PLACE_H
#define PLACE_H

#include <stdbool.h>

#include "client.h"

struct place {
	char *folder; /* owned; a temporary one */
	struct project project;
	struct client *client; /* NULL: not connected */
	struct report_store store;
	pid_t service;
	int held; /* a descriptor that keeps escaped children; -1 */
};

/* Settings are given as "KEY=VALUE" pairs by blanks: BATTEN_IDLE=1 ... Connects, starting a service. */
void place_init(struct place *p, const char *environment);
void place_finish(struct place *p);
/* Of cmocka: *state is a place with those settings; with two jobs at once; gone again. */
int place_new(void **state, const char *environment);
int place_of_two_jobs(void **state);
int place_gone(void **state);
void place_connect(struct place *p);
/* The service dies at once; its socket stays. */
void place_crash(struct place *p);

/* A gate for good workers: each byte let through is one step. Path, owned by p until the end. */
char *place_gate(struct place *p, const char *name);
void place_open_gate(struct place *p, const char *name, int steps);

/* Submit a job of that role ("good", "crash"); gate may be NULL. Its id. */
int64_t place_submit(struct place *p, const char *role, int units, const char *gate);

/* A request about jobs ids (0 ends). The class of the answer. */
enum status place_ask(struct place *p, enum message_type type, int64_t id);

/* The record as it is now; finished by the next call. */
const struct Stats *place_job(struct place *p, int64_t id);

/* Watch the job until its state is that, or it has made that many units; fails the test when it ends
 * otherwise or nothing comes for 20 s. */
void place_until(struct place *p, int64_t id, enum job_state state);
void place_until_done(struct place *p, int64_t id, int units);

/* Wait until it has ended; its record. */
const struct Stats *place_end(struct place *p, int64_t id);

/* State letter of a process in /proc; 0: there is none. */
char process_state(pid_t pid);
/* Wait until the process is gone (at most 20 s). */
bool process_gone(int pidfd);

#endif
