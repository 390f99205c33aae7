/* client.h - a connection to the service, for the verbs and the editor. Blocking; one thread. */
#ifndef BATTEN_CLIENT_H
#define BATTEN_CLIENT_H

#include "message.h"
#include "project.h"
#include "stats.h"

struct client; /* opaque */

/*
 * Connect to the project's service; where none runs and `start` is set, start one (`batten serve`
 * beside this program) and wait until it answers.
 * Errors: ST_RESOURCE (no service and not started), ST_INPUT (another protocol: run
 * `batten shutdown`; a socket that is not ours).
 */
enum status client_connect(struct client **out, const struct project *p, bool start,
                           const struct report *r);
void client_close(struct client *c); /* NULL is fine */

/* A JOB packet's record; s is borrowed for the call. Return false to stop listening. */
typedef bool client_job(void *data, const struct Stats *s);

/*
 * Send a request (its "id" is set here) and take the replies until END: each JOB goes to on_job (may
 * be NULL), each TEXT to on_text. An ERROR is reported and ends the request with its class.
 * WATCH and LOG with follow do not end by themselves: see client_wait.
 */
enum status client_request(struct client *c, enum message_type type, json_t *body,
                           client_job *on_job, void (*on_text)(void *data, const char *text),
                           void *data, const struct report *r);

/* For WATCH: take what comes for at most timeout_ms (-1: for ever), or until fd (or -1) is readable
 * (keys, a signal's pipe). *ended is set when the service went away. */
enum status client_listen(struct client *c, int timeout_ms, int fd, client_job *on_job, void *data,
                          bool *ended, const struct report *r);
int client_descriptor(const struct client *c);

#endif
