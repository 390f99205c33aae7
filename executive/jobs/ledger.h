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

/* Some of the jobs that are over. */
struct ledger_choice {
	const char *group; /* of that one; NULL: of any or none */
	double since;      /* ended then or later, seconds since 1970; 0: whenever */
	unsigned states;   /* 1 << JOB_DONE | ...; 0: whatever its end */
	int newest;        /* so many, those that ended last; 0: all */
};

struct ledger {
	void *data;
	/* All of them or none. durable: also after the machine lost its power.
	 * Errors: ST_RESOURCE. */
	enum status (*write)(void *data, const struct ledger_change *changes, size_t n,
	                     bool durable, const struct report *r);
	/* Are jobs that come held? Errors: ST_RESOURCE. */
	enum status (*hold)(void *data, bool held, const struct report *r);
	/* Every record of a job that is not over, by rising id; *last is the highest id ever given,
	 * *held as it was kept. */
	enum status (*load)(void *data, ledger_job *each, void *each_data, int64_t *last,
	                    bool *held, const struct report *r);
	/* One record; each is not called where there is none. Errors: ST_RESOURCE. */
	enum status (*find)(void *data, int64_t id, ledger_job *each, void *each_data,
	                    const struct report *r);
	/* Append its JSON as it was written (stats_write_brief); false: there is none, or it is not certain
	 * that it can be read. */
	bool (*text)(void *data, int64_t id, struct text *out);
	/* Ids by rising number; *ids is the caller's to free. Errors: ST_RESOURCE. */
	enum status (*choose)(void *data, const struct ledger_choice *choice, int64_t **ids,
	                      size_t *n, const struct report *r);
};

/* SQLite in WAL mode. A path that does not begin with / counts from the working folder, which must stay;
 * others are of LEDGER_PATH_MAX bytes at most. Errors: ST_RESOURCE, ST_INPUT (written by a later batten). */
enum status ledger_open(struct ledger *out, const char *path, const struct report *r);
/* Likewise; busy (NULL: nobody listens) is called now and then while a long ledger of an earlier batten is
 * taken over. */
typedef void ledger_busy(void *data);
enum status ledger_open_telling(struct ledger *out, const char *path, ledger_busy *busy,
                                void *busy_data, const struct report *r);
void ledger_close(struct ledger *l); /* zeroed is fine */

#endif
