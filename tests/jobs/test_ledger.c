/* test_ledger.c - what is written is there, whole, after any end; what cannot be read is said. */
#include <setjmp.h>
#include <linux/capability.h>
#include <signal.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>
#include <sqlite3.h>

#include "file.h"
#include "ledger.h"
#include "path.h"
#include "text.h"

static int set_up(void **state)
{
	char *folder = strdup("/tmp/batten-ledger-XXXXXX");
	*state = folder && mkdtemp(folder) ? folder : NULL;
	return !*state;
}

static int tear_down(void **state)
{
	char *command = text_print("rm -r %s", (char *)*state);
	int rc = system(command);
	free(command);
	free(*state);
	return rc;
}

struct found {
	int64_t last; /* number given */
	bool held;
	int n;
	int64_t ids[1000];
	enum job_state states[1000];
	bool front[1000], killed[1000];
};

static enum status find(void *data, struct Stats *s, bool front, bool killed)
{
	struct found *f = data;
	f->ids[f->n] = s->id;
	f->states[f->n] = s->state;
	f->front[f->n] = front;
	f->killed[f->n++] = killed;
	stats_finish(s);
	return ST_OK;
}

static void load(struct ledger *l, struct found *f)
{
	f->n = 0;
	assert_int_equal(l->load(l->data, find, f, &f->last, &f->held, NULL), ST_OK);
}

static enum status put(struct ledger *l, int64_t id, enum job_state state, bool durable)
{
	struct Stats s;
	stats_init(&s);
	s.id = id;
	s.state = state;
	struct ledger_change c = { .id = id, .stats = &s, .front = id == 2, .killed = id == 3 };
	return l->write(l->data, &c, 1, durable, NULL);
}

static void keeps_records_and_numbers(void **state)
{
	char *path = path_join(*state, "jobs.db");
	struct ledger l;
	struct found f = { 0 };
	assert_int_equal(ledger_open(&l, path, NULL), ST_OK);
	load(&l, &f);
	assert_int_equal(f.n, 0);
	assert_int_equal(f.last, 0);
	for (int64_t id = 1; id <= 4; id++)
		assert_int_equal(put(&l, id, JOB_QUEUED, id % 2), ST_OK);
	assert_int_equal(put(&l, 2, JOB_RUNNING, false), ST_OK);
	struct ledger_change drop = { .id = 4 };
	assert_int_equal(l.write(l.data, &drop, 1, false, NULL), ST_OK);
	ledger_close(&l);

	assert_int_equal(ledger_open(&l, path, NULL), ST_OK);
	load(&l, &f);
	assert_int_equal(f.n, 3);
	assert_int_equal(f.last, 4);
	assert_int_equal(f.states[0], JOB_QUEUED);
	assert_int_equal(f.states[1], JOB_RUNNING);
	assert_true(f.front[1] && !f.front[0] && f.killed[2] && !f.killed[1]);
	ledger_close(&l);
	free(path);
}

/* A child writes record after record and tells each that is acknowledged, until it is killed. */
static void a_crash_loses_nothing_acknowledged(void **state)
{
	char *path = path_join(*state, "jobs.db");
	struct ledger l;
	struct found f = { 0 };
	int64_t told = 0, id;
	int p[2];
	assert_int_equal(pipe(p), 0);
	pid_t child = fork();
	if (child == 0) {
		if (ledger_open(&l, path, NULL) != ST_OK)
			_exit(1);
		for (id = 1; id < 900; id++)
			if (put(&l, id, JOB_QUEUED, false) != ST_OK ||
			    write(p[1], &id, sizeof id) != sizeof id)
				_exit(1);
		pause();
	}
	close(p[1]);
	while (told < 300 && read(p[0], &id, sizeof id) == sizeof id)
		told = id;
	kill(child, SIGKILL);
	waitpid(child, NULL, 0);
	while (read(p[0], &id, sizeof id) == sizeof id)
		told = id;
	close(p[0]);
	assert_true(told >= 300);
	assert_int_equal(ledger_open(&l, path, NULL), ST_OK);
	load(&l, &f);
	assert_true(f.last >= told);
	assert_true(f.n >= told);
	ledger_close(&l);
	free(path);
}

static void a_batch_is_written_whole_or_not_at_all(void **state)
{
	char *path = path_join(*state, "jobs.db");
	struct ledger l;
	struct found f = { 0 };
	struct report_store store;
	report_store_init(&store);
	assert_int_equal(ledger_open(&l, path, NULL), ST_OK);
	assert_int_equal(put(&l, 1, JOB_QUEUED, true), ST_OK);
	/* no file may grow any more: as on a full disk */
	struct Stats s[500];
	struct ledger_change c[500];
	for (int i = 0; i < 500; i++) {
		stats_init(&s[i]);
		s[i].id = 2 + i;
		c[i] = (struct ledger_change){ .id = 2 + i, .stats = &s[i] };
	}
	struct rlimit old, none;
	getrlimit(RLIMIT_FSIZE, &old);
	none = old;
	none.rlim_cur = 32768;
	signal(SIGXFSZ, SIG_IGN);
	setrlimit(RLIMIT_FSIZE, &none);
	enum status st = l.write(l.data, c, 500, true, &store.report);
	setrlimit(RLIMIT_FSIZE, &old);
	assert_int_equal(st, ST_RESOURCE);
	assert_non_null(strstr(store.error, "cannot write the ledger"));
	load(&l, &f);
	assert_int_equal(f.n, 1);
	/* and when there is room again, it goes on */
	assert_int_equal(l.write(l.data, c, 500, true, NULL), ST_OK);
	ledger_close(&l);
	free(path);
}

/* What another program does to a ledger that is closed. */
static void change(const char *path, const char *sql)
{
	sqlite3 *db;
	assert_int_equal(sqlite3_open(path, &db), SQLITE_OK);
	assert_int_equal(sqlite3_exec(db, sql, NULL, NULL, NULL), SQLITE_OK);
	sqlite3_close(db);
}

static void what_is_no_ledger_is_refused(void **state)
{
	char *path = path_join(*state, "jobs.db"), junk[5000];
	struct ledger l;
	struct report_store store;
	memset(junk, 'j', sizeof junk);
	assert_int_equal(file_write(path, junk, sizeof junk, NULL), ST_OK);
	report_store_init(&store);
	assert_int_equal(ledger_open(&l, path, &store.report), ST_RESOURCE);
	assert_non_null(strstr(store.error, "jobs.db"));
	assert_null(l.data);
	assert_int_equal(unlink(path), 0);

	change(path, "PRAGMA user_version=9");
	report_store_init(&store);
	assert_int_equal(ledger_open(&l, path, &store.report), ST_INPUT);
	assert_non_null(strstr(store.error, "later batten"));
	free(path);
}

/* One record, then a page of the file, is overwritten. */
static void damage_costs_no_more_than_it_must(void **state)
{
	char *path = path_join(*state, "jobs.db");
	struct ledger l;
	struct found f = { 0 };
	struct report_store store;
	assert_int_equal(ledger_open(&l, path, NULL), ST_OK);
	for (int64_t id = 1; id <= 400; id++)
		assert_int_equal(put(&l, id, JOB_HELD, false), ST_OK);
	ledger_close(&l);
	change(path, "UPDATE jobs SET record='{' WHERE id=7");
	assert_int_equal(ledger_open(&l, path, NULL), ST_OK);
	load(&l, &f);
	assert_int_equal(f.n, 400);
	assert_int_equal(f.ids[6], 7);
	assert_int_equal(f.states[6], JOB_LOST);
	assert_int_equal(f.states[7], JOB_HELD);
	ledger_close(&l);

	FILE *file = fopen(path, "r+");
	assert_non_null(file);
	for (long at = 4096; at < 40000; at += 4096) {
		fseek(file, at, SEEK_SET);
		for (int i = 0; i < 200; i++)
			fputc('x', file);
	}
	fclose(file);
	report_store_init(&store);
	f.n = 0;
	enum status st = ledger_open(&l, path, &store.report);
	if (st == ST_OK) {
		st = l.load(l.data, find, &f, &f.last, &f.held, &store.report);
		ledger_close(&l);
	}
	assert_int_equal(st, ST_RESOURCE);
	assert_non_null(strstr(store.error, "move it away"));
	free(path);
}

static void whether_the_queue_is_held_is_kept(void **state)
{
	static const bool steps[] = { false, true, true, false, false, true };
	char *path = path_join(*state, "jobs.db");
	struct ledger l;
	struct found f = { 0 };
	for (size_t i = 0; i < sizeof steps / sizeof *steps; i++) {
		f.held = !steps[i];
		assert_int_equal(ledger_open(&l, path, NULL), ST_OK);
		assert_int_equal(l.hold(l.data, steps[i], NULL), ST_OK);
		ledger_close(&l);
		assert_int_equal(ledger_open(&l, path, NULL), ST_OK);
		load(&l, &f);
		assert_int_equal(f.held, steps[i]);
		ledger_close(&l);
	}
	free(path);
}

/* In a child that permissions hold, whoever runs the test. */
static void a_ledger_that_may_not_be_written_says_so(void **state)
{
	char *path = path_join(*state, "jobs.db");
	struct ledger l;
	int status;
	assert_int_equal(ledger_open(&l, path, NULL), ST_OK);
	ledger_close(&l);
	assert_int_equal(chmod(path, 0400), 0);
	assert_int_equal(chmod(*state, 0500), 0);
	pid_t child = fork();
	if (child == 0) {
		struct __user_cap_header_struct head = { .version = _LINUX_CAPABILITY_VERSION_3 };
		struct __user_cap_data_struct none[2] = { 0 };
		struct report_store store;
		report_store_init(&store);
		syscall(SYS_capset, &head, none);
		enum status st = ledger_open(&l, path, &store.report);
		struct ledger_change drop = { .id = 1 };
		if (st == ST_OK) /* what is there can still be read */
			st = l.write(l.data, &drop, 1, false, &store.report);
		_exit(st != ST_RESOURCE || !strstr(store.error, "writable"));
	}
	assert_int_equal(waitpid(child, &status, 0), child);
	assert_int_equal(chmod(*state, 0700), 0);
	assert_int_equal(status, 0);
	free(path);
}

/* Records of four groups and of every end, a tenth of a second apart. */
static void fill(struct ledger *l, int n)
{
	static const enum job_state states[] = { JOB_DONE, JOB_FAILED, JOB_KILLED, JOB_LOST,
		                                 JOB_QUEUED };
	for (int i = 0; i < n; i++) {
		char group[] = "g0";
		struct Stats s;
		stats_init(&s);
		s.id = i + 1;
		s.state = states[i % 5];
		s.ended = s.state == JOB_QUEUED ? 0 : 1000 + i / 10.0;
		group[1] = (char)('0' + i % 4);
		s.group = i % 4 ? group : NULL;
		struct ledger_change c = { .id = s.id, .stats = &s };
		assert_int_equal(l->write(l->data, &c, 1, false, NULL), ST_OK);
	}
}

static void check_choices(struct ledger *l, int n)
{
	static const struct ledger_choice choices[] = {
		{ 0 },
		{ .since = 1010 },
		{ .states = 1U << JOB_FAILED | 1U << JOB_LOST },
		{ .group = "g3" },
		{ .group = "g0" },
		{ .group = "it's none" },
		{ .group = "g1", .since = 1010, .states = 1U << JOB_DONE },
		{ .newest = 7 },
		{ .group = "g2", .newest = 3, .states = 1U << JOB_KILLED },
	};
	for (size_t k = 0; k < sizeof choices / sizeof *choices; k++) {
		const struct ledger_choice *c = &choices[k];
		int64_t *ids = NULL, want[1000];
		size_t n_ids, n_want = 0;
		for (int i = n - 1; i >= 0; i--) {
			static const enum job_state states[] = { JOB_DONE, JOB_FAILED, JOB_KILLED,
				                                 JOB_LOST };
			bool over = i % 5 < 4;
			if (!over || 1000 + i / 10.0 < c->since ||
			    (c->states && !(c->states & 1U << states[i % 5])) ||
			    (c->group && (!(i % 4) || c->group[1] != '0' + i % 4)) ||
			    (c->newest && n_want == (size_t)c->newest))
				continue;
			want[n_want++] = i + 1;
		}
		assert_int_equal(l->choose(l->data, c, &ids, &n_ids, NULL), ST_OK);
		assert_int_equal(n_ids, n_want);
		for (size_t i = 0; i < n_ids; i++)
			assert_int_equal(ids[i], want[n_want - 1 - i]);
		free(ids);
	}
}

static void what_is_over_is_found_when_it_is_looked_for(void **state)
{
	char *path = path_join(*state, "jobs.db");
	struct ledger l;
	struct found f = { 0 };
	struct text t = { 0 };
	assert_int_equal(ledger_open(&l, path, NULL), ST_OK);
	fill(&l, 500);
	check_choices(&l, 500);
	load(&l, &f);
	assert_int_equal(f.n, 100);
	assert_int_equal(f.last, 500);
	f.n = 0;
	assert_int_equal(l.find(l.data, 2, find, &f, NULL), ST_OK);
	assert_int_equal(l.find(l.data, 501, find, &f, NULL), ST_OK);
	assert_int_equal(f.n, 1);
	assert_int_equal(f.states[0], JOB_FAILED);
	assert_true(l.text(l.data, 2, &t));
	json_t *o = json_loads(t.s, 0, NULL);
	assert_string_equal(json_string_value(json_object_get(o, "state")), "failed");
	assert_false(l.text(l.data, 501, &t));
	json_decref(o);
	text_finish(&t);
	ledger_close(&l);
	free(path);
}

/* As version 1 wrote it; one record is damaged. */
static void a_ledger_of_before_is_taken_over(void **state)
{
	char *path = path_join(*state, "jobs.db");
	struct ledger l;
	struct found f = { 0 };
	struct text t = { 0 };
	int64_t *ids;
	size_t n;
	assert_int_equal(ledger_open(&l, path, NULL), ST_OK);
	fill(&l, 500);
	ledger_close(&l);
	change(path, "DROP INDEX live; DROP INDEX over; DROP INDEX grouped;"
	             "ALTER TABLE jobs DROP COLUMN ended;"
	             "ALTER TABLE jobs DROP COLUMN grp;"
	             "PRAGMA user_version=1");
	/* the second time it was stopped half way, the third time it is done */
	for (int turn = 0; turn < 3; turn++) {
		if (turn == 1)
			change(path, "DROP INDEX live; DROP INDEX over;"
			             "UPDATE jobs SET ended=NULL, grp=NULL"
			             " WHERE id > 200; PRAGMA user_version=1");
		assert_int_equal(ledger_open(&l, path, NULL), ST_OK);
		check_choices(&l, 500);
		ledger_close(&l);
	}
	change(path, "UPDATE jobs SET record='{\"id\":' WHERE id=6");
	assert_int_equal(ledger_open(&l, path, NULL), ST_OK);
	assert_int_equal(l.choose(l.data, &(struct ledger_choice){ 0 }, &ids, &n, NULL), ST_OK);
	assert_int_equal(n, 400);
	assert_false(l.text(l.data, 6, &t));
	assert_int_equal(l.find(l.data, 6, find, &f, NULL), ST_OK);
	assert_int_equal(f.states[0], JOB_LOST);
	load(&l, &f);
	assert_int_equal(f.n, 100);
	free(ids);
	text_finish(&t);
	ledger_close(&l);
	free(path);
}

/* Numbers far apart, as of a ledger of which much was pruned, and the last that there can be. */
static void gaps_between_numbers_cost_nothing(void **state)
{
	char *path = path_join(*state, "jobs.db");
	struct ledger l;
	int64_t *ids;
	size_t n;
	assert_int_equal(ledger_open(&l, path, NULL), ST_OK);
	fill(&l, 50);
	ledger_close(&l);
	change(path, "UPDATE jobs SET id=9223372036854775807 WHERE id=49;"
	             "UPDATE jobs SET id=1000000000000000 WHERE id=48;"
	             "UPDATE jobs SET ended=NULL, grp=NULL;"
	             "PRAGMA user_version=1");
	assert_int_equal(ledger_open(&l, path, NULL), ST_OK);
	assert_int_equal(l.choose(l.data, &(struct ledger_choice){ 0 }, &ids, &n, NULL), ST_OK);
	assert_int_equal(n, 40);
	assert_true(ids[n - 1] == INT64_MAX && ids[n - 2] == 1000000000000000);
	free(ids);
	ledger_close(&l);
	free(path);
}

/* A record and the row it lies in do not agree on whether the job is over. */
static void a_state_that_cannot_be_is_damage(void **state)
{
	char *path = path_join(*state, "jobs.db");
	struct ledger l;
	struct found f = { 0 };
	int64_t last;
	bool held;
	assert_int_equal(ledger_open(&l, path, NULL), ST_OK);
	assert_int_equal(put(&l, 1, JOB_DONE, false), ST_OK);
	assert_int_equal(put(&l, 2, JOB_HELD, false), ST_OK);
	ledger_close(&l);
	change(path, "UPDATE jobs SET record='{\"id\":1,\"stat\":\"done\"}' WHERE id=1;"
	             "UPDATE jobs SET record='{\"id\":2,\"state\":\"done\"}' WHERE id=2");
	assert_int_equal(ledger_open(&l, path, NULL), ST_OK);
	assert_int_equal(l.find(l.data, 1, find, &f, NULL), ST_OK);
	assert_int_equal(l.load(l.data, find, &f, &last, &held, NULL), ST_OK);
	assert_int_equal(f.n, 2);
	assert_int_equal(f.states[0], JOB_LOST);
	assert_int_equal(f.states[1], JOB_LOST);
	ledger_close(&l);
	free(path);
}

/* Somebody copies it. */
static void who_has_it_open_for_a_moment_is_waited_for(void **state)
{
	char *path = path_join(*state, "jobs.db"), byte;
	struct ledger l;
	sqlite3 *db;
	int ready[2], status;
	assert_int_equal(ledger_open(&l, path, NULL), ST_OK);
	ledger_close(&l);
	assert_int_equal(pipe(ready), 0);
	pid_t child = fork();
	if (child == 0) {
		if (sqlite3_open(path, &db) != SQLITE_OK ||
		    sqlite3_exec(db, "BEGIN IMMEDIATE; SELECT * FROM jobs", NULL, NULL, NULL) !=
		            SQLITE_OK ||
		    write(ready[1], "", 1) != 1)
			_exit(1);
		usleep(200000); /* as long as a copy takes: what is waited for, no wait of the test */
		sqlite3_close(db);
		_exit(0);
	}
	assert_int_equal(read(ready[0], &byte, 1), 1);
	assert_int_equal(ledger_open(&l, path, NULL), ST_OK);
	ledger_close(&l);
	assert_int_equal(waitpid(child, &status, 0), child);
	assert_int_equal(status, 0);
	close(ready[0]);
	close(ready[1]);
	free(path);
}

#define T(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void)
{
	const struct CMUnitTest tests[] = {
		T(keeps_records_and_numbers),
		T(a_crash_loses_nothing_acknowledged),
		T(a_batch_is_written_whole_or_not_at_all),
		T(what_is_no_ledger_is_refused),
		T(damage_costs_no_more_than_it_must),
		T(what_is_over_is_found_when_it_is_looked_for),
		T(a_ledger_of_before_is_taken_over),
		T(whether_the_queue_is_held_is_kept),
		T(gaps_between_numbers_cost_nothing),
		T(a_state_that_cannot_be_is_damage),
		T(who_has_it_open_for_a_moment_is_waited_for),
		T(a_ledger_that_may_not_be_written_says_so),
	};
	return cmocka_run_group_tests_name("ledger", tests, NULL, NULL);
}
