/* play.h - what programs that play workers share: a packet out, a packet in. */
#ifndef PLAY_H
#define PLAY_H

#include "json.h"
#include "message.h"

/* The role a worker plays is in its name: batten-ROLE. */
const char *play_role(const char *argv0);
void play_send(enum message_type type, json_t *body); /* body is stolen */
void play_hello(const char *role);
void play_result(const char *path);
void play_done(void);

/* Wait for a packet on standard input; 0: it has ended. m is finished by the caller. */
int play_next(struct message *m);

/* Wait for START and read its job file. New reference; exits where there is none. */
json_t *play_start(void);

/* Wait until a signal ends this process. */
_Noreturn void play_stay(void);

#endif
