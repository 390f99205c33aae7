/* ledger_upgrade.c - a ledger of an earlier batten becomes one of this. */
#include "ledger_upgrade.h"

/* Records in one piece; steps of the database's machine after which it is said that there is more to do. */
enum { PIECE = 20000, STEPS = 100000 };

struct listener {
	ledger_busy *busy;
	void *data;
};

static int on_steps(void *data)
{
	const struct listener *l = data;
	if (l->busy)
		l->busy(l->data);
	return 0;
}

static bool number(sqlite3 *db, const char *sql, int64_t *out)
{
	sqlite3_stmt *s;
	if (sqlite3_prepare_v2(db, sql, -1, &s, NULL) != SQLITE_OK)
		return false;
	bool good = sqlite3_step(s) == SQLITE_ROW;
	*out = sqlite3_column_int64(s, 0);
	sqlite3_finalize(s);
	return good;
}

/* A damaged record says nothing of its group and its end. */
static bool pieces(sqlite3 *db)
{
	static const char sql[] =
	        "UPDATE jobs SET"
	        " grp = CASE WHEN json_valid(record) THEN json_extract(record, '$.group') END,"
	        " ended = CASE WHEN state IN ('done', 'failed', 'killed', 'lost') THEN"
	        " CASE WHEN json_valid(record) THEN coalesce(json_extract(record, '$.ended'), 0)"
	        " ELSE 0 END END"
	        " WHERE id BETWEEN ?1 AND ?2";
	/* there may be any gap between two numbers: what is counted is records */
	static const char end[] = "SELECT max(id) FROM"
	                          " (SELECT id FROM jobs WHERE id > ?1 ORDER BY id LIMIT ?2)";
	sqlite3_stmt *s = NULL, *next = NULL;
	int64_t done = 0;
	bool good = number(db, "SELECT coalesce(min(id), 1) - 1 FROM jobs", &done) &&
	            sqlite3_prepare_v2(db, sql, -1, &s, NULL) == SQLITE_OK &&
	            sqlite3_prepare_v2(db, end, -1, &next, NULL) == SQLITE_OK;
	for (bool more = good; more;) {
		sqlite3_bind_int64(next, 1, done);
		sqlite3_bind_int64(next, 2, PIECE);
		good = sqlite3_step(next) == SQLITE_ROW;
		more = good && sqlite3_column_type(next, 0) != SQLITE_NULL;
		const int64_t last = sqlite3_column_int64(next, 0);
		sqlite3_reset(next);
		if (!more)
			break;
		sqlite3_bind_int64(s, 1, done + 1);
		sqlite3_bind_int64(s, 2, last);
		good = more = sqlite3_step(s) == SQLITE_DONE;
		sqlite3_reset(s);
		done = last;
	}
	sqlite3_finalize(s);
	sqlite3_finalize(next);
	return good;
}

bool ledger_upgrade(sqlite3 *db, ledger_busy *busy, void *busy_data)
{
	struct listener l = { busy, busy_data };
	int64_t there = 0;
	sqlite3_progress_handler(db, STEPS, on_steps, &l);
	bool good = number(db, "SELECT count(*) FROM pragma_table_info('jobs') WHERE name = 'grp'",
	                   &there);
	if (good && !there)
		good = sqlite3_exec(db,
		                    "BEGIN; ALTER TABLE jobs ADD COLUMN ended REAL;"
		                    "ALTER TABLE jobs ADD COLUMN grp TEXT; COMMIT",
		                    NULL, NULL, NULL) == SQLITE_OK;
	good = good && pieces(db) &&
	       sqlite3_exec(db, "BEGIN;" LEDGER_INDICES "COMMIT", NULL, NULL, NULL) == SQLITE_OK;
	sqlite3_progress_handler(db, 0, NULL, NULL);
	return good;
}
