/* server.h - the inside of the service: its sessions and what they asked for. Private. */
#ifndef BATTEN_SERVER_H
#define BATTEN_SERVER_H

#include <uv.h>

#include "crew.h"
#include "hook.h"
#include "local.h"
#include "queue.h"
#include "service.h"
#include "slurm.h"

/* bytes waiting for a client above which it gets no more of what can be told later; above which it
 * is let go */
enum { BACKLOG_FULL = 1 << 20, BACKLOG_MAX = 256 << 20 };

/* Of a list no more is made ready than this: a hundred clients may want one at once. */
enum { LIST_AHEAD = 96 << 10 };

struct server {
	uv_loop_t loop;
	const struct project *project; /* borrowed */
	struct queue *queue;
	struct hooks *hooks;
	struct local *local;
	struct slurm *slurm;
	struct crew *crew;
	struct ledger ledger;
	struct clock clock;
	uv_pipe_t listener;
	uv_prepare_t prepare; /* the end of a turn */
	uv_timer_t deadline, idle, leave;
	uv_timer_t log; /* looks at the size of the service's own */
	uv_signal_t interrupt, terminate;
	struct session *sessions;
	double idle_s;
	int lock;
	bool leaving, closing;
	bool stretched; /* memory was wanted for lists, and may be given back */
};

struct session {
	struct server *server; /* borrowed */
	struct session *next;
	uv_pipe_t pipe;
	uv_write_t write;
	struct message_reader reader;
	struct text out, flying; /* to be written; being written */
	bool greeted, writing, closing;
	struct request *requests;
};

/* A request that is not answered yet. */
struct request {
	struct session *session; /* borrowed */
	struct request *next;
	int64_t id;
	enum message_type type;
	int64_t *jobs; /* owned; sorted; NULL: see group */
	int n, at;     /* all before `at` are as wanted */
	char *group;   /* owned; with jobs NULL: of that group, or NULL: every job */
	int64_t *list; /* owned; whose records are sent, as fast as the client takes them */
	int n_list, at_list;
	bool full;   /* LIST: records with all their fields */
	bool met;    /* all are as wanted: when the list is sent it is answered */
	bool stay;   /* WATCH: goes on when all have ended */
	bool behind; /* WATCH: the client was too slow, it gets all again */
	bool ended;
	enum status st; /* to be said at the end */
	char *error;    /* owned */
	struct log_reader *log;
};

/* session.c */
void session_accept(struct server *s);
void session_close(struct session *c);
void session_send(struct session *c, enum message_type type, json_t *body); /* body is stolen */
void session_send_job(struct session *c, int64_t id, const struct Stats *s);
/* Any job's; nothing where it is gone. full: see queue_write. */
void session_send_record(struct session *c, int64_t id, int64_t job, bool full);
void session_flush(struct session *c);
size_t session_backlog(const struct session *c);

/* request.c */
void request_take(struct session *c, const struct message *m);
/* A job has changed: WATCH tells it. */
void request_told(struct request *q, const struct Stats *s);
/* At the end of a turn: is it answered now? Then it is ended. */
void request_check(struct request *q);
void request_end(struct request *q);
void request_destroy(struct request *q);

/* log_reader.c: a LOG request's file */
enum status log_reader_create(struct request *q, bool follow);
bool log_reader_more(
        struct request *q); /* send what is there; true: it is all, and no more will come */
void log_reader_destroy(struct log_reader *l);

/* prune.c: take away what belongs to no job */
void prune_files(const struct project *p, struct queue *q);

/* service.c */
void server_leave(struct server *s);

#endif
