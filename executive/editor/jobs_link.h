/* jobs_link.h - the window's tie to the project's service: what every job does now, and requests to
 * it, without the window ever waiting. Threads of its own do the talking. */
#ifndef BATTEN_JOBS_LINK_H
#define BATTEN_JOBS_LINK_H

#include "message.h"
#include "project.h"
#include "stats.h"

struct jobs_link; /* opaque */

/* Copies of the records for one thread, by rising id. A zeroed one is empty. */
struct job_shelf {
	struct Stats *jobs; /* owned */
	int n, cap;
};
const struct Stats *job_shelf_find(const struct job_shelf *s, int64_t id); /* NULL: none */
enum status job_shelf_put(struct job_shelf *s, const struct Stats *job);
void job_shelf_finish(struct job_shelf *s);

/* How the tie stands. */
enum link_state { LINK_CONNECTING, LINK_UP, LINK_GONE };

/*
 * Start watching; where no service runs one is started. wake is called on threads of the link when
 * there is something to take: at once when a job's state changes, four times a second at most for
 * progress. Errors: ST_RESOURCE.
 */
enum status jobs_link_create(struct jobs_link **out, const struct project *p,
                             void (*wake)(void *data), void *data, const struct report *r);
/* Ends the threads; requests under way are left to the service. NULL is fine. */
void jobs_link_destroy(struct jobs_link *l);

/* Bring the shelf up to date; the number of records that changed. Says how the tie stands, and why
 * it is gone. */
int jobs_link_take(struct jobs_link *l, struct job_shelf *shelf, enum link_state *state,
                   char reason[256]);

/* Send SUSPEND, ACTIVATE, KILL, HOLD, RELEASE, RETRY about these jobs, or LOG about one. Answers come to
 * jobs_link_answer. Errors: ST_RESOURCE. */
enum status jobs_link_ask(struct jobs_link *l, enum message_type type, const int64_t *ids, int n);
/* Start the service again where it is gone. */
void jobs_link_restart(struct jobs_link *l);

/* What came of a request. */
struct link_answer {
	enum message_type type;
	int64_t job; /* the first one */
	int n;       /* how many */
	enum status status;
	char *text; /* owned; a log's text, or why it failed */
};
bool jobs_link_answer(struct jobs_link *l, struct link_answer *out); /* false: none is there */
void link_answer_finish(struct link_answer *a);

#endif
