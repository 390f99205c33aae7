/* ledger_upgrade.h - what a ledger has beside its records, and how one of before comes to have it. Private
 * to the ledger. */
#ifndef BATTEN_LEDGER_UPGRADE_H
#define BATTEN_LEDGER_UPGRADE_H

#include <sqlite3.h>

#include "ledger.h"

enum { LEDGER_VERSION = 2 };

/* ended and grp (NULL: none) are what the record says; a job that is over has an ended. What is over is
 * many and looked for seldom: nothing but these indices is read to find what is not. */
#define LEDGER_INDICES                                                                             \
	"CREATE INDEX IF NOT EXISTS live ON jobs(id) WHERE ended IS NULL;"                         \
	"CREATE INDEX IF NOT EXISTS over ON jobs(ended, state) WHERE ended IS NOT NULL;"           \
	"CREATE INDEX IF NOT EXISTS grouped ON jobs(grp, state, ended) WHERE grp IS NOT NULL;"     \
	"PRAGMA user_version=2;"

/* From version 1. Stopped at any instant, it is done the next time. False: the reason is the database's. */
bool ledger_upgrade(sqlite3 *db, ledger_busy *busy, void *busy_data);

#endif
