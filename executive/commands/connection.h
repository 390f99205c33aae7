/* connection.h - what the verbs that talk to the service share: the project, the connection, which
 * jobs are meant, the list of jobs that comes back. */
#ifndef BATTEN_CONNECTION_H
#define BATTEN_CONNECTION_H

#include "client.h"
#include "command.h"

struct connection {
	struct project project;
	struct client *client;
};

/* Find and make the project of the current folder, connect (start: start a service if none runs). */
enum status connection_open(struct connection *c, const struct invocation *i, bool start);
void connection_close(struct connection *c);

/* Ring the terminal, where the setting wants that. */
void connection_bell(const struct connection *c);

/*
 * Body of a request about the jobs named: {"jobs":[12,13]}, {"group":G} or {"all":true}.
 * need: at least one must be named. Errors: ST_PARAMETER. New reference.
 */
enum status connection_selection(const struct invocation *i, bool need, json_t **body);

/* Records that came back. */
struct job_list {
	struct Stats *jobs; /* owned */
	size_t n, cap;
	bool failed; /* memory ran out */
};
bool job_list_add(void *data, const struct Stats *s); /* a client_job */
void job_list_put(struct job_list *l,
                  const struct Stats *s); /* replace the one of that id, or add */
void job_list_finish(struct job_list *l);

/* {"version":1,"jobs":[...]}, a job a line, on standard output as they come. Nothing is printed before
 * JOB_TEXT_HELD bytes are there or the end: what fails early prints nothing. */
enum { JOB_TEXT_HELD = 1 << 18 };
struct job_text {
	struct text waiting;
	bool begun; /* with a record */
	bool failed;
};
bool job_text_add(void *data, const char *record, size_t n); /* a client_record */
bool job_text_put(void *data, const struct Stats *s);        /* a client_job */
int job_text_end(struct job_text *t);                        /* exit status */
void job_text_abandon(struct job_text *t);
int job_list_print_json(const struct job_list *l);

/* The table of `batten jobs`, 80 columns. rows: without its head. */
void job_list_print(const struct job_list *l, bool rows, bool color, FILE *out);

/* Worst exit status of ended jobs: 0 all done, 130 some killed and none failed, 1 else. */
int job_list_exit(const struct job_list *l);

/* "1:24", "2 h 10": at most 7 columns. */
void format_seconds(double s, char out[16]);

/* Color of a state in the terminal, and back; empty without color. */
void print_state_color(enum job_state state, bool color, FILE *out);
void print_plain(bool color, FILE *out);

#endif
