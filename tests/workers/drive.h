/* drive.h - run workers from a test: by hand with what they print, or as a peer over packets. */
#ifndef BATTEN_TEST_DRIVE_H
#define BATTEN_TEST_DRIVE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/types.h>

#include <cmocka.h>

#include "message.h"

enum { ARGS_MAX = 40 };

/* An empty folder to work in, made the current one; left and removed again at the end. */
struct place {
	char folder[64];
};
void place_enter(struct place *p);
void place_leave(struct place *p);

/* two.base: surface 1, curve 2, surface 3. one.base: surface 1 of it alone. */
void place_models(void);

bool there(const char *path);
int count_files(void); /* hidden ones too */
char *slurp(const char *path, size_t *n);
void spill(const char *path, const char *text);
/* The same bytes; fails the test where not. */
void assert_same_file(const char *a, const char *b);
int count_lines(const char *path); /* 0 if there is no file */

/* A process run to its end. */
struct ran {
	int exit_status; /* 128 + signal where one killed it */
	char *out, *err; /* owned */
};
void ran_finish(struct ran *r);

/* program, "NAME=VALUE"... (environment), then arguments; ended by NULL. */
struct ran run_hand(const char *program, ...);
struct ran run_list(const char *program, va_list list);

/* Like it, with a resource limited: RLIMIT_FSIZE plays a disk that is full. */
struct ran run_limited(int resource, unsigned long limit, const char *program, ...);

/* A worker at the other end of two pipes. */
struct peer {
	pid_t pid;
	int to, from;
	struct message_reader reader;
	struct message last;
	int n_units; /* UNIT packets seen */
};
void peer_start(struct peer *p, const char *program, ...);
void peer_send(struct peer *p, enum message_type type, const char *key, const char *value);
/* The next packet, in p->last; false at the end of the pipe. Fails the test after 60 s. */
bool peer_next(struct peer *p);
/* Skip until such a packet; false where it never came. */
bool peer_until(struct peer *p, enum message_type type);
/* Skip to the end of the pipe. */
void peer_drain(struct peer *p);
/* Close, wait: exit status as above. */
int peer_end(struct peer *p);

/* Write a job file for `worker`; extra: more members, ", \"shard\": [0, 2]", or "". */
void write_job(const char *path, const char *worker, const char *input, const char *output,
               const char *part, const char *parameters, const char *extra);

#endif
