/* selection.h - which jobs a request is about, and what is wrong with it. Private to the service. */
#ifndef BATTEN_SELECTION_H
#define BATTEN_SELECTION_H

#include "server.h"

struct queue *request_queue(const struct request *q);

/* The first sentence said to it is the request's answer. */
struct report request_report(struct request *q);
void request_fail(struct request *q, enum status st, const char *text);

bool request_room(struct request *q, size_t n); /* for n ids in q->jobs; false: said */

bool selection_in_group(const struct Stats *s, const char *group); /* NULL: any */
bool selection_has(const struct request *q, int64_t id);

/* The jobs of a list of ids; those that are not are said, the others taken. False: out of memory. */
bool selection_named(struct request *q, const json_t *ids);

/* Those in memory that pass, and those of the ledger that are chosen (NULL: none). */
struct selection {
	bool (*pass)(const struct Stats *s, const void *data); /* NULL: all */
	const void *data;
	const struct ledger_choice *over; /* its group is set by selection_where */
};

/* Of a group, NULL: of all. False, and said: there is no such group, or the ledger cannot be read. */
bool selection_where(struct request *q, const char *group, const struct selection *which);

#endif
