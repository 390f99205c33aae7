/* message.h - the Message packet: a type and a text, as the thesis has it.
 *
 * On the wire: uint32 type, uint32 length, little-endian, then length bytes of UTF-8: one JSON
 * object, or nothing. Each packet leaves in one write. Numbers of retired types are never used
 * again. docs/packets.md is checked against the table below.
 */
#ifndef BATTEN_MESSAGE_H
#define BATTEN_MESSAGE_H

#include <jansson.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "report.h"
#include "text.h"

enum { MESSAGE_HEADER = 8, MESSAGE_TEXT_MAX = 65536, MESSAGE_PROTOCOL = 1 };

/* Who may send it: a worker, to a worker, a client of the service, the service. */
enum message_way { FROM_WORKER = 1, TO_WORKER = 2, FROM_CLIENT = 4, FROM_SERVICE = 8 };

/* name, number, ways, fields: "NAME:TYPE" by blanks; TYPE s string, i integer, n number, o object,
 * a array, b boolean; a trailing ? may be missing or null. */
#define MESSAGE_MAP(X)                                                                             \
	X(HELLO, 1, FROM_WORKER | FROM_CLIENT | FROM_SERVICE,                                      \
	  "protocol:i worker:s? worker_version:i? pid:i? host:s? program:s? version:s? "           \
	  "slurm_job:i?")                                                                          \
	X(PROGRESS, 2, FROM_WORKER, "done:i total:i phase:s? host:s?")                             \
	X(NOTE, 3, FROM_WORKER, "level:s text:s")                                                  \
	X(UNIT, 4, FROM_WORKER, "unit:i")                                                          \
	X(RESULT, 5, FROM_WORKER, "path:s kind:s figures:o? up_to_date:b?")                        \
	X(ERROR, 6, FROM_WORKER | FROM_SERVICE, "class:s text:s id:i?")                            \
	X(DONE, 7, FROM_WORKER, "wall_s:n? cpu_s:n? peak_kib:i?")                                  \
	X(START, 64, TO_WORKER, "job:s")                                                           \
	X(CANCEL, 65, TO_WORKER, "")                                                               \
	X(SUBMIT, 128, FROM_CLIENT, "id:i jobs:a")                                                 \
	X(LIST, 129, FROM_CLIENT, "id:i jobs:a? group:s? all:b? full:b?")                          \
	X(WATCH, 130, FROM_CLIENT, "id:i jobs:a? group:s? stay:b?")                                \
	X(SUSPEND, 131, FROM_CLIENT, "id:i jobs:a? group:s? all:b?")                               \
	X(ACTIVATE, 132, FROM_CLIENT, "id:i jobs:a? group:s? all:b?")                              \
	X(KILL, 133, FROM_CLIENT, "id:i jobs:a? group:s? all:b? by:s?")                            \
	X(HOLD, 134, FROM_CLIENT, "id:i jobs:a? group:s? all:b? after_current:b?")                 \
	X(RELEASE, 135, FROM_CLIENT, "id:i jobs:a? group:s? all:b?")                               \
	X(RETRY, 136, FROM_CLIENT, "id:i jobs:a? group:s? all:b?")                                 \
	X(PRIORITY, 137, FROM_CLIENT, "id:i jobs:a? group:s? all:b? priority:i top:b?")            \
	X(WAIT, 138, FROM_CLIENT, "id:i jobs:a? group:s? all:b?")                                  \
	X(LOG, 139, FROM_CLIENT, "id:i job:i follow:b?")                                           \
	X(SHUTDOWN, 140, FROM_CLIENT, "id:i")                                                      \
	X(PRUNE, 141, FROM_CLIENT, "id:i")                                                         \
	X(JOB, 192, FROM_SERVICE, "id:i? job:o")                                                   \
	X(END, 193, FROM_SERVICE, "id:i")                                                          \
	X(TEXT, 194, FROM_SERVICE, "id:i text:s")

#define X(name, number, ways, fields) MESSAGE_##name = number,
enum message_type { MESSAGE_MAP(X) };
#undef X

struct message_row {
	const char *name;
	uint32_t number;
	unsigned ways;
	const char *fields;
};
extern const struct message_row message_table[];
extern const size_t message_table_size;
const struct message_row *message_row(uint32_t number); /* NULL if there is none */

/* A decoded packet. */
struct message {
	uint32_t type;
	json_t *body; /* owned; an object */
};
void message_finish(struct message *m);

/* Encode; appended to out. body may be NULL (no text). Errors: ST_RESOURCE, ST_INTERNAL (longer
 * than MESSAGE_TEXT_MAX: the caller splits). */
enum status message_encode(struct text *out, uint32_t type, const json_t *body);

/* Encode and write to a descriptor whole (blocking), one write. Errors: ST_RESOURCE. */
enum status message_send(int fd, uint32_t type, const json_t *body);

/*
 * Bytes come in as they come; packets go out whole. A reader that met something that is not a
 * packet stays failed.
 */
struct message_reader {
	char *bytes; /* owned */
	size_t n, cap, at;
	unsigned ways; /* which types are allowed here */
	bool failed;
	char reason[256]; /* why, once failed */
};
void message_reader_init(struct message_reader *r, unsigned ways);
void message_reader_finish(struct message_reader *r);

/* Room for at least n bytes to be read into; then say how many came. NULL: out of memory. */
char *message_reader_room(struct message_reader *r, size_t n, size_t *room);
void message_reader_filled(struct message_reader *r, size_t n);

/*
 * Next packet: 1 and *out (caller finishes), 0 when more bytes are needed, -1 when failed (wrong
 * length, unknown type, not allowed on this way, bad JSON, missing or mistyped field): see reason.
 */
int message_reader_next(struct message_reader *r, struct message *out);

/*
 * Where a whole packet of that type is next: its text as it came, not looked into, borrowed until more
 * is read. False: nothing is taken, message_reader_next says what there is.
 */
bool message_reader_text(struct message_reader *r, enum message_type type, const char **text,
                         size_t *n);

/* True when bytes of an unfinished packet are left (end of pipe came in the middle of one). */
bool message_reader_partial(const struct message_reader *r);

#endif
