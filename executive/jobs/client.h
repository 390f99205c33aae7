/* client.h - a connection to the service, for the verbs and the editor. Blocking; one thread. */
#ifndef BATTEN_CLIENT_H
#define BATTEN_CLIENT_H

#include "message.h"
#include "project.h"
#include "stats.h"

struct client; /* opaque */

/*
 * Connect to the project's service; where none runs and `start` is set, start one (`batten serve`
 * beside this program, in a session of its own, its log in .batten/logs/service.log) and wait until
 * it listens: it closes the descriptor that the environment names in BATTEN_READY_FD.
 * Errors: ST_RESOURCE (no service and not started), ST_INPUT (another protocol: run
 * `batten shutdown`; a socket that is not ours).
 */
enum status client_connect(struct client **out, const struct project *p, bool start,
                           const struct report *r);
void client_close(struct client *c); /* NULL is fine */

/* End the project's service, of whatever protocol it is, and wait until its process is
 * gone. *ran: there was one. Errors: ST_RESOURCE (it does not end), ST_INPUT (not ours). */
enum status client_shutdown(const struct project *p, bool *ran, const struct report *r);

/* A record as `jobs --json` shows it; text is borrowed for the call. Return false to stop listening. */
typedef bool client_record(void *data, const char *text, size_t n);

/*
 * LIST, its answer as text, record by record as they come. Nearly nothing is taken apart, so it is several
 * times quicker than client_request. body is stolen. Errors: as client_request.
 */
enum status client_list(struct client *c, json_t *body, client_record *on_record, void *data,
                        const struct report *r);

/* A JOB packet's record; s is borrowed for the call. Return false to stop listening. */
typedef bool client_job(void *data, const struct Stats *s);

/* Send a request (its "id" is set here; body is stolen) and do not wait. Replies come to
 * client_listen. */
enum status client_send(struct client *c, enum message_type type, json_t *body,
                        const struct report *r);

/*
 * Send a request and take the replies until END: each JOB goes to on_job (may be NULL), each TEXT to
 * on_text. An ERROR is reported and ends the request with its class.
 */
enum status client_request(struct client *c, enum message_type type, json_t *body,
                           client_job *on_job, void (*on_text)(void *data, const char *text),
                           void *data, const struct report *r);

/* After client_send of a WATCH: take what comes for at most timeout_ms (-1: for ever); returns
 * after each batch, or when fd (or -1) is readable (keys, a signal's descriptor). *ended is set at the
 * request's END and when the service went away (*gone too). */
enum status client_listen(struct client *c, int timeout_ms, int fd, client_job *on_job, void *data,
                          bool *ended, bool *gone, const struct report *r);
int client_descriptor(const struct client *c);

#endif
