/* ledger.c - the jobs in an SQLite file, in WAL mode. */
#include "ledger.h"

#include <math.h>
#include <sqlite3.h>
#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "ledger_upgrade.h"
#include "record.h"
#include "text.h"

struct book {
	sqlite3 *db;
	sqlite3_stmt *put, *drop, *begin, *commit, *rollback, *find, *text;
	char *path;
	bool full;        /* synchronous=FULL is set */
	sqlite3_vfs near; /* takes names as they are; zName is set while it is registered */
};

/* What to do, by SQLite's code. */
static const char *advice(int code)
{
	static const struct {
		int code;
		const char *text;
	} rows[] = {
		{ SQLITE_FULL, "; make room on its disk" },
		{ SQLITE_IOERR,
		  "; see that its disk is neither full nor failing and the file and its folder are "
		  "writable" },
		{ SQLITE_READONLY, "; make the file and its folder writable" },
		{ SQLITE_CANTOPEN, "; make its folder writable" },
		{ SQLITE_PERM, "; make the file and its folder writable" },
		{ SQLITE_NOTADB,
		  "; it is damaged: put a copy in its place, or move it away to begin "
		  "without its jobs" },
		{ SQLITE_CORRUPT,
		  "; it is damaged: mend it with 'sqlite3 FILE .recover', or move it "
		  "away to begin without its jobs" },
		{ SQLITE_BUSY, "; another program has it open: close that" },
	};
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
		if (rows[i].code == (code & 0xff))
			return rows[i].text;
	return "";
}

static enum status book_error(const struct book *b, const char *what, const struct report *r)
{
	if (!b->db)
		return report_error(r, ST_RESOURCE, "cannot %s the ledger '%s': out of memory",
		                    what, b->path);
	return report_error(r, ST_RESOURCE, "cannot %s the ledger '%s': %s%s", what, b->path,
	                    sqlite3_errmsg(b->db), advice(sqlite3_errcode(b->db)));
}

static bool book_step(sqlite3_stmt *s)
{
	int code = sqlite3_step(s);
	sqlite3_reset(s);
	return code == SQLITE_DONE || code == SQLITE_ROW;
}

static bool change_write(struct book *b, const struct ledger_change *c, struct text *record)
{
	sqlite3_stmt *s = c->stats ? b->put : b->drop;
	sqlite3_bind_int64(s, 1, c->id);
	if (c->stats) {
		text_reset(record);
		stats_write_brief(record, c->stats);
		if (record->failed)
			return false;
		sqlite3_bind_int(s, 2, c->front);
		sqlite3_bind_int(s, 3, c->killed);
		sqlite3_bind_text(s, 4, job_state_table[c->stats->state].word, -1, SQLITE_STATIC);
		sqlite3_bind_text64(s, 5, record->s, record->n, SQLITE_STATIC, SQLITE_UTF8);
		if (job_state_table[c->stats->state].over)
			sqlite3_bind_double(s, 6, fmax(c->stats->ended, 0));
		else
			sqlite3_bind_null(s, 6);
		sqlite3_bind_text(s, 7, c->stats->group, -1, SQLITE_STATIC);
	}
	return book_step(s);
}

/* FULL waits for the disk at each commit, NORMAL leaves that to the next checkpoint. */
static void book_durable(struct book *b, bool full)
{
	if (b->full == full)
		return;
	b->full = full;
	sqlite3_exec(b->db, full ? "PRAGMA synchronous=FULL" : "PRAGMA synchronous=NORMAL", NULL,
	             NULL, NULL);
}

static enum status book_write(void *data, const struct ledger_change *changes, size_t n,
                              bool durable, const struct report *r)
{
	struct book *b = data;
	struct text record = { 0 };
	book_durable(b, durable);
	bool good = book_step(b->begin);
	for (size_t i = 0; i < n && good; i++)
		good = change_write(b, &changes[i], &record);
	enum status st = ST_OK;
	if (!good || !book_step(b->commit)) {
		st = book_error(b, "write", r);
		if (!sqlite3_get_autocommit(b->db))
			book_step(b->rollback);
	}
	text_finish(&record);
	return st;
}

static enum status row_load(struct book *b, sqlite3_stmt *s, ledger_job *each, void *each_data,
                            const struct report *r)
{
	const char *text = (const char *)sqlite3_column_text(s, 3);
	json_t *o = text ? json_loadb(text, (size_t)sqlite3_column_bytes(s, 3), 0, NULL) : NULL;
	struct Stats stats;
	enum status st = stats_from_json(&stats, o);
	const bool over = !sqlite3_column_int(s, 4);
	json_decref(o);
	if (st == ST_OK && job_state_table[stats.state].over != over)
		st = ST_INPUT;
	if (st == ST_INPUT) {
		/* one record that is damaged costs that job, not the others */
		stats_finish(&stats);
		stats_init(&stats);
		stats.state = JOB_LOST;
		stats.worker = strdup("unknown");
		stats.reason = strdup("its record in the ledger is damaged; submit it again");
		st = ST_OK;
	}
	if (st == ST_OK) {
		stats.id = sqlite3_column_int64(s, 0);
		st = each(each_data, &stats, sqlite3_column_int(s, 1), sqlite3_column_int(s, 2));
	}
	if (st != ST_OK)
		report_error(r, st, "cannot read job %lld in the ledger '%s': %s",
		             (long long)sqlite3_column_int64(s, 0), b->path, status_text(st));
	return st;
}

/* A ledger from before there was such a table has none until something is held. */
static enum status book_hold(void *data, bool held, const struct report *r)
{
	struct book *b = data;
	book_durable(b, true);
	if (sqlite3_exec(b->db,
	                 held ? "BEGIN;CREATE TABLE IF NOT EXISTS held(name TEXT PRIMARY KEY);"
	                        "INSERT OR IGNORE INTO held VALUES('queue');COMMIT"
	                      : "DROP TABLE IF EXISTS held",
	                 NULL, NULL, NULL) == SQLITE_OK)
		return ST_OK;
	enum status st = book_error(b, "write", r);
	if (!sqlite3_get_autocommit(b->db))
		book_step(b->rollback);
	return st;
}

/* The whole number a statement gives; 0 where it gives none. Errors: ST_RESOURCE. */
static enum status book_number(struct book *b, const char *sql, int64_t *out,
                               const struct report *r)
{
	sqlite3_stmt *s;
	*out = 0;
	if (sqlite3_prepare_v2(b->db, sql, -1, &s, NULL) != SQLITE_OK)
		return book_error(b, "read", r);
	if (sqlite3_step(s) == SQLITE_ROW)
		*out = sqlite3_column_int64(s, 0);
	sqlite3_finalize(s);
	return ST_OK;
}

static enum status book_load(void *data, ledger_job *each, void *each_data, int64_t *last,
                             bool *held, const struct report *r)
{
	struct book *b = data;
	sqlite3_stmt *s;
	int64_t marks = 0;
	int code = SQLITE_DONE;
	enum status st =
	        book_number(b, "SELECT seq FROM sqlite_sequence WHERE name='jobs'", last, r);
	if (st == ST_OK)
		st = book_number(b, "SELECT count(*) FROM sqlite_schema WHERE name='held'", &marks,
		                 r);
	if (st != ST_OK)
		return st;
	*held = marks > 0;
	if (sqlite3_prepare_v2(
	            b->db,
	            "SELECT id, front, killed, record, 1 FROM jobs WHERE ended IS NULL ORDER BY id",
	            -1, &s, NULL) != SQLITE_OK)
		return book_error(b, "read", r);
	while (st == ST_OK && (code = sqlite3_step(s)) == SQLITE_ROW)
		st = row_load(b, s, each, each_data, r);
	if (st == ST_OK && code != SQLITE_DONE)
		st = book_error(b, "read", r);
	sqlite3_finalize(s);
	return st;
}

static enum status book_find(void *data, int64_t id, ledger_job *each, void *each_data,
                             const struct report *r)
{
	struct book *b = data;
	sqlite3_bind_int64(b->find, 1, id);
	int code = sqlite3_step(b->find);
	enum status st = ST_OK;
	if (code == SQLITE_ROW)
		st = row_load(b, b->find, each, each_data, r);
	else if (code != SQLITE_DONE)
		st = book_error(b, "read", r);
	sqlite3_reset(b->find);
	return st;
}

static bool book_text(void *data, int64_t id, struct text *out)
{
	struct book *b = data;
	sqlite3_bind_int64(b->text, 1, id);
	bool sound = false;
	if (sqlite3_step(b->text) == SQLITE_ROW) {
		const char *record = (const char *)sqlite3_column_text(b->text, 0);
		const size_t n = (size_t)sqlite3_column_bytes(b->text, 0);
		const char *state = (const char *)sqlite3_column_text(b->text, 1);
		sound = record && state && record_is_sound(record, n, id, state);
		if (sound)
			text_add_bytes(out, record, n);
	}
	sqlite3_reset(b->text);
	return sound;
}

/* The statement of a choice; which indices serve it stands at `tables`. */
static sqlite3_stmt *choice_prepare(struct book *b, const struct ledger_choice *c)
{
	struct text sql = { 0 };
	sqlite3_stmt *s = NULL;
	const char *mark = " AND state IN ('";
	text_add(&sql, "SELECT id FROM jobs WHERE ended>=?1");
	if (c->group)
		text_add(&sql, " AND grp=?2");
	for (int state = 0; state < N_JOB_STATES; state++)
		if (c->states & 1U << state) {
			text_addf(&sql, "%s%s", mark, job_state_table[state].word);
			mark = "','";
		}
	if (c->states)
		text_add(&sql, "')");
	if (c->newest)
		text_add(&sql, " ORDER BY ended DESC LIMIT ?3");
	if (sql.failed || sqlite3_prepare_v2(b->db, sql.s, -1, &s, NULL) != SQLITE_OK)
		s = NULL;
	text_finish(&sql);
	sqlite3_bind_double(s, 1, c->since);
	if (c->group)
		sqlite3_bind_text(s, 2, c->group, -1, SQLITE_STATIC);
	if (c->newest)
		sqlite3_bind_int(s, 3, c->newest);
	return s;
}

static int by_id(const void *a, const void *b)
{
	int64_t x = *(const int64_t *)a, y = *(const int64_t *)b;
	return (x > y) - (x < y);
}

static enum status book_choose(void *data, const struct ledger_choice *choice, int64_t **ids,
                               size_t *n, const struct report *r)
{
	struct book *b = data;
	size_t cap = 0;
	int code = SQLITE_DONE;
	*ids = NULL;
	*n = 0;
	sqlite3_stmt *s = choice_prepare(b, choice);
	while (s && (code = sqlite3_step(s)) == SQLITE_ROW) {
		if (*n == cap) {
			cap = cap ? 2 * cap : 64;
			int64_t *more = reallocarray(*ids, cap, sizeof *more);
			if (!more)
				break;
			*ids = more;
		}
		(*ids)[(*n)++] = sqlite3_column_int64(s, 0);
	}
	enum status st = ST_OK;
	if (!s || code != SQLITE_DONE) {
		st = code == SQLITE_ROW ? report_error(r, ST_RESOURCE, "out of memory")
		                        : book_error(b, "read", r);
		free(*ids);
		*ids = NULL;
		*n = 0;
	} else if (*n) {
		qsort(*ids, *n, sizeof **ids, by_id);
	}
	sqlite3_finalize(s);
	return st;
}

static enum status book_version(struct book *b, int *version, const struct report *r)
{
	sqlite3_stmt *s;
	if (sqlite3_prepare_v2(b->db, "PRAGMA user_version", -1, &s, NULL) != SQLITE_OK)
		return book_error(b, "open", r);
	int code = sqlite3_step(s);
	*version = sqlite3_column_int(s, 0);
	sqlite3_finalize(s);
	if (code != SQLITE_ROW)
		return book_error(b, "open", r);
	if (*version > LEDGER_VERSION)
		return report_error(
		        r, ST_INPUT,
		        "the ledger '%s' was written by a later batten (version %d, this "
		        "one knows %d); use that one",
		        b->path, *version, LEDGER_VERSION);
	return ST_OK;
}

enum { BUSY_MS = 2000 };

/* Only the service opens the ledger, so its index may stay in memory. */
static const char settings[] = "PRAGMA locking_mode=EXCLUSIVE;"
                               "PRAGMA journal_mode=WAL;"
                               "PRAGMA synchronous=NORMAL;";
static const char tables[] =
        "BEGIN;"
        "CREATE TABLE IF NOT EXISTS jobs(id INTEGER PRIMARY KEY AUTOINCREMENT,"
        " front INTEGER NOT NULL, killed INTEGER NOT NULL,"
        " state TEXT NOT NULL, record TEXT NOT NULL, ended REAL, grp TEXT);" LEDGER_INDICES
        "COMMIT;";

static bool book_make(struct book *b, int version, ledger_busy *busy, void *busy_data)
{
	if (version >= LEDGER_VERSION)
		return true;
	return version ? ledger_upgrade(b->db, busy, busy_data)
	               : sqlite3_exec(b->db, tables, NULL, NULL, NULL) == SQLITE_OK;
}

static bool book_prepare(struct book *b)
{
	const struct {
		sqlite3_stmt **s;
		const char *sql;
	} statements[] = {
		{ &b->put, "INSERT INTO jobs(id, front, killed, state, record, ended, grp)"
		           " VALUES(?,?,?,?,?,?,?)"
		           " ON CONFLICT(id) DO UPDATE SET front=excluded.front,"
		           " killed=excluded.killed, state=excluded.state, record=excluded.record,"
		           " ended=excluded.ended, grp=excluded.grp" },
		{ &b->find,
		  "SELECT id, front, killed, record, ended IS NULL FROM jobs WHERE id=?" },
		{ &b->text, "SELECT record, state FROM jobs WHERE id=?" },
		{ &b->drop, "DELETE FROM jobs WHERE id=?" },
		{ &b->begin, "BEGIN IMMEDIATE" },
		{ &b->commit, "COMMIT" },
		{ &b->rollback, "ROLLBACK" },
	};
	for (size_t i = 0; i < sizeof statements / sizeof *statements; i++)
		if (sqlite3_prepare_v3(b->db, statements[i].sql, -1, SQLITE_PREPARE_PERSISTENT,
		                       statements[i].s, NULL) != SQLITE_OK)
			return false;
	return true;
}

/* SQLite makes names absolute, and then takes no more than 512 bytes of them: those that are relative
 * stay so here. */
static int near_full_name(sqlite3_vfs *vfs, const char *name, int size, char *out)
{
	(void)vfs;
	sqlite3_snprintf(size, out, "%s", name);
	return SQLITE_OK;
}

static int book_open(struct book *b)
{
	const sqlite3_vfs *usual = sqlite3_vfs_find(NULL);
	if (b->path[0] == '/' || !usual)
		return sqlite3_open(b->path, &b->db);
	b->near = *usual;
	b->near.pNext = NULL;
	b->near.zName = "batten-near";
	b->near.xFullPathname = near_full_name;
	sqlite3_vfs_register(&b->near, 0);
	return sqlite3_open_v2(b->path, &b->db, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE,
	                       b->near.zName);
}

static void book_close(struct book *b)
{
	sqlite3_finalize(b->put);
	sqlite3_finalize(b->drop);
	sqlite3_finalize(b->begin);
	sqlite3_finalize(b->commit);
	sqlite3_finalize(b->rollback);
	sqlite3_finalize(b->find);
	sqlite3_finalize(b->text);
	sqlite3_close(b->db);
	if (b->near.zName)
		sqlite3_vfs_unregister(&b->near);
	free(b->path);
	free(b);
}

enum status ledger_open(struct ledger *out, const char *path, const struct report *r)
{
	return ledger_open_telling(out, path, NULL, NULL, r);
}

enum status ledger_open_telling(struct ledger *out, const char *path, ledger_busy *busy,
                                void *busy_data, const struct report *r)
{
	int version = 0;
	enum status st = ST_OK;
	memset(out, 0, sizeof *out);
	struct book *b = calloc(1, sizeof *b);
	if (!b || !(b->path = strdup(path))) {
		free(b);
		return report_error(r, ST_RESOURCE, "cannot open the ledger: out of memory");
	}
	/* who has it open for a moment, to copy it, is waited for from the first statement on */
	if (book_open(b) != SQLITE_OK || sqlite3_busy_timeout(b->db, BUSY_MS) != SQLITE_OK ||
	    sqlite3_exec(b->db, settings, NULL, NULL, NULL) != SQLITE_OK)
		st = book_error(b, "open", r);
	if (st == ST_OK)
		st = book_version(b, &version, r);
	if (st == ST_OK && !book_make(b, version, busy, busy_data))
		st = book_error(b, "open", r);
	if (st == ST_OK && !book_prepare(b))
		st = book_error(b, "open", r);
	if (st != ST_OK) {
		book_close(b);
		return st;
	}
	*out = (struct ledger){
		.data = b,
		.write = book_write,
		.hold = book_hold,
		.load = book_load,
		.find = book_find,
		.text = book_text,
		.choose = book_choose,
	};
	return ST_OK;
}

void ledger_close(struct ledger *l)
{
	if (l->data)
		book_close(l->data);
	memset(l, 0, sizeof *l);
}
