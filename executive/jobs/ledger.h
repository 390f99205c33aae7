/* ledger.h - where the jobs are written down. */
#ifndef BATTEN_LEDGER_H
#define BATTEN_LEDGER_H

#include "stats.h"

enum { LEDGER_PATH_MAX = 480 }; /* bytes of an absolute path */

struct ledger_change {
	int64_t id;
	const struct Stats *stats; /* borrowed; NULL: take the record out */
	bool front;                /* first in line */
	bool killed;               /* its worker is being ended because somebody said so */
};

typedef enum status ledger_job(void *data, struct Stats *s, bool front,
                               bool killed); /* takes s over */

struct ledger {
	void *data;
	/* All of them or none. durable: also after the machine lost its power.
	 * Errors: ST_RESOURCE. */
	enum status (*write)(void *data, const struct ledger_change *changes, size_t n,
	                     bool durable, const struct report *r);
	/* Are jobs that come held? Errors: ST_RESOURCE. */
	enum status (*hold)(void *data, bool held, const struct report *r);
	/* Every record by rising id; *last is the highest id ever given, *held as it was kept. */
	enum status (*load)(void *data, ledger_job *each, void *each_data, int64_t *last,
	                    bool *held, const struct report *r);
};

/* SQLite in WAL mode. A path that does not begin with / counts from the working folder, which must stay;
 * others are of LEDGER_PATH_MAX bytes at most. Errors: ST_RESOURCE, ST_INPUT (written by a later batten). */
enum status ledger_open(struct ledger *out, const char *path, const struct report *r);
void ledger_close(struct ledger *l); /* zeroed is fine */

#endif
