/* fake.c - launcher, ledger, clock and listener for the queue, without a process or a file. */
#include "fake.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "json.h"

static enum status fake_check(void *data, const struct Stats *s, const struct report *r)
{
	struct fake *f = data;
	if (f->missing)
		return report_error(r, ST_INPUT, "input of job %lld is gone", (long long)s->id);
	return ST_OK;
}

static void fake_bury(void *data, const struct Stats *s)
{
	struct fake *f = data;
	text_addf(&f->log, "bury %ld;", (long)s->pid);
}

static enum status fake_start(void *data, struct Stats *s, const struct report *r)
{
	struct fake *f = data;
	if (f->refuse)
		return report_error(r, ST_RESOURCE, "no processes are left");
	text_addf(&f->log, "start %lld;", (long long)s->id);
	s->pid = (pid_t)(1000 + s->id);
	return ST_OK;
}

static enum status fake_send(void *data, int64_t id, enum message_type type, const json_t *body)
{
	struct fake *f = data;
	(void)body;
	text_addf(&f->log, "%s %lld;", message_row(type)->name, (long long)id);
	return ST_OK;
}

static void fake_signal(void *data, int64_t id, enum launcher_signal signal)
{
	static const char *const words[] = { "stop", "continue", "terminate", "kill" };
	struct fake *f = data;
	text_addf(&f->log, "%s %lld;", words[signal], (long long)id);
}

static void fake_note(void *data, int64_t id, const char *level, const char *text)
{
	(void)data;
	(void)id;
	(void)level;
	(void)text;
}

static const char *fake_job_file(void *data, int64_t id)
{
	(void)data;
	(void)id;
	return "job.json";
}

static void fake_forget(void *data, int64_t id)
{
	struct fake *f = data;
	text_addf(&f->log, "forget %lld;", (long long)id);
}

static enum status fake_write(void *data, const struct ledger_change *changes, size_t n,
                              bool durable, const struct report *r)
{
	struct fake *f = data;
	if (f->full)
		return report_error(r, ST_RESOURCE, "the disk is full");
	f->unsynced = durable ? 0 : f->unsynced + (int)n;
	for (size_t i = 0; i < n; i++) {
		int64_t id = changes[i].id;
		assert_in_range(id, 1, FAKE_ROWS - 1);
		json_decref(f->rows[id].record);
		f->rows[id].record = changes[i].stats ? stats_to_json(changes[i].stats) : NULL;
		f->rows[id].front = changes[i].front;
		f->rows[id].killed = changes[i].killed;
		if (id > f->last)
			f->last = id;
	}
	return ST_OK;
}

static enum status fake_hold(void *data, bool held, const struct report *r)
{
	struct fake *f = data;
	if (f->full)
		return report_error(r, ST_RESOURCE, "the disk is full");
	f->held = held;
	return ST_OK;
}

static bool is_over(const struct fake *f, int64_t id)
{
	return job_state_table[job_state_from_word(json_text(f->rows[id].record, "state", NULL))]
	        .over;
}

static enum status fake_find(void *data, int64_t id, ledger_job *each, void *each_data,
                             const struct report *r)
{
	struct fake *f = data;
	struct Stats s;
	(void)r;
	if (id < 1 || id >= FAKE_ROWS || !f->rows[id].record)
		return ST_OK;
	assert_int_equal(stats_from_json(&s, f->rows[id].record), ST_OK);
	assert_int_equal(each(each_data, &s, f->rows[id].front, f->rows[id].killed), ST_OK);
	return ST_OK;
}

static enum status fake_load(void *data, ledger_job *each, void *each_data, int64_t *last,
                             bool *held, const struct report *r)
{
	struct fake *f = data;
	(void)r;
	for (int64_t id = 1; id < FAKE_ROWS; id++)
		if (f->rows[id].record && !is_over(f, id))
			fake_find(f, id, each, each_data, r);
	*last = f->last;
	*held = f->held;
	return ST_OK;
}

static bool fake_text(void *data, int64_t id, struct text *out)
{
	struct fake *f = data;
	if (id < 1 || id >= FAKE_ROWS || !f->rows[id].record)
		return false;
	char *s = json_write(f->rows[id].record, false);
	text_add(out, s);
	free(s);
	return true;
}

static enum status fake_choose(void *data, const struct ledger_choice *c, int64_t **ids, size_t *n,
                               const struct report *r)
{
	struct fake *f = data;
	(void)r;
	*n = 0;
	*ids = calloc(FAKE_ROWS, sizeof **ids);
	assert_non_null(*ids);
	/* ids rise as their ends do */
	for (int64_t id = FAKE_ROWS - 1; id > 0; id--) {
		const json_t *o = f->rows[id].record;
		const char *group = json_text(o, "group", NULL);
		unsigned state = 1U << job_state_from_word(json_text(o, "state", NULL));
		if (o && is_over(f, id) && json_number(o, "ended", 0) >= c->since &&
		    (!c->states || c->states & state) &&
		    (!c->group || (group && !strcmp(group, c->group))) &&
		    (!c->newest || *n < (size_t)c->newest))
			(*ids)[(*n)++] = id;
	}
	for (size_t i = 0; i < *n / 2; i++) {
		int64_t id = (*ids)[i];
		(*ids)[i] = (*ids)[*n - 1 - i];
		(*ids)[*n - 1 - i] = id;
	}
	return ST_OK;
}

static double fake_elapsed(void *data)
{
	struct fake *f = data;
	return f->now;
}

static double fake_date(void *data)
{
	struct fake *f = data;
	return 1e9 + f->now;
}

/* What is told stands in the ledger with the same state, whatever else happens. */
static void fake_told(void *data, const struct Stats *s)
{
	struct fake *f = data;
	const char *row = fake_row(f, s->id);
	if (!f->full)
		assert_string_equal(row, job_state_table[s->state].word);
	text_addf(&f->log, "told %lld %s;", (long long)s->id, job_state_table[s->state].word);
}

static int fake_room(void *data, const struct Stats *s, struct room at[ROOMS])
{
	struct fake *f = data;
	(void)s;
	at[0] = (struct room){ .disk = f->disk, .mib = f->room };
	return f->room >= 0;
}

static int64_t fake_size(void *data, const struct Stats *s)
{
	struct fake *f = data;
	(void)s;
	return f->size;
}

static void fake_begin(struct fake *f)
{
	struct queue_ports ports = {
		.launcher = &f->launcher,
		.ledger = &f->ledger,
		.clock = &f->clock,
		.told = fake_told,
		.told_data = f,
		.room = fake_room,
		.size = fake_size,
		.room_data = f,
	};
	assert_int_equal(queue_create(&f->q, &ports, &f->limits), ST_OK);
	f->sink = queue_sink(f->q);
	assert_int_equal(queue_load(f->q, NULL), ST_OK);
	queue_turn(f->q);
}

void fake_init(struct fake *f)
{
	*f = (struct fake){
		.launcher = { .data = f,
		              .check = fake_check,
		              .bury = fake_bury,
		              .start = fake_start,
		              .send = fake_send,
		              .signal = fake_signal,
		              .note = fake_note,
		              .job_file = fake_job_file,
		              .forget = fake_forget },
		.ledger = { .data = f,
		            .write = fake_write,
		            .hold = fake_hold,
		            .load = fake_load,
		            .find = fake_find,
		            .text = fake_text,
		            .choose = fake_choose },
		.clock = { .data = f, .elapsed = fake_elapsed, .date = fake_date },
		.limits = { .jobs = 2,
		            .threads = 4,
		            .memory_mib = 1000,
		            .job_threads = 1,
		            .over_kept = 1,
		            .cancel_grace = 2,
		            .term_grace = 3,
		            .hello_grace = 10,
		            .end_grace = 5 },
		.now = 100,
		.room = -1,
		.size = -1,
	};
	fake_begin(f);
}

void fake_finish(struct fake *f)
{
	queue_destroy(f->q);
	for (int i = 0; i < FAKE_ROWS; i++)
		json_decref(f->rows[i].record);
	text_finish(&f->log);
	text_finish(&f->seen);
}

int fake_new(void **state)
{
	struct fake *f = malloc(sizeof *f);
	*state = f;
	if (f)
		fake_init(f);
	return !f;
}

int fake_gone(void **state)
{
	fake_finish(*state);
	free(*state);
	return 0;
}

void fake_restart(struct fake *f)
{
	queue_destroy(f->q);
	text_reset(&f->log);
	fake_begin(f);
}

static int64_t submit(struct fake *f, struct Stats *s)
{
	struct report_store store;
	char worker[] = "play", output[] = "/out";
	int64_t first = 0;
	report_store_init(&store);
	s->worker = worker;
	s->output = output;
	s->parameters = json_object();
	enum status st = queue_submit(f->q, s, 1, &first, &store.report);
	queue_turn(f->q);
	json_decref(s->parameters);
	return st == ST_OK ? first : 0;
}

int64_t fake_submit(struct fake *f, int priority, int threads, int64_t after)
{
	struct Stats s;
	stats_init(&s);
	s.priority = priority;
	s.threads = threads;
	s.after = &after;
	s.n_after = after != 0;
	return submit(f, &s);
}

int64_t fake_submit_after_any(struct fake *f, int64_t after)
{
	struct Stats s;
	stats_init(&s);
	s.after_any = &after;
	s.n_after_any = 1;
	return submit(f, &s);
}

void fake_packet(struct fake *f, int64_t id, enum message_type type, json_t *body)
{
	struct message m = { .type = type, .body = body ? body : json_object() };
	f->sink.packet(f->sink.data, id, &m);
	message_finish(&m);
	queue_turn(f->q);
}

void fake_hello(struct fake *f, int64_t id)
{
	fake_packet(f, id, MESSAGE_HELLO, json_pack("{s:i}", "protocol", MESSAGE_PROTOCOL));
}

void fake_exit(struct fake *f, int64_t id, int status, int signal)
{
	struct launcher_exit e = {
		.status = status, .signal = signal, .cpu_s = 0.5, .peak_kib = 1234
	};
	f->sink.exited(f->sink.data, id, &e);
	queue_turn(f->q);
}

void fake_eof(struct fake *f, int64_t id)
{
	f->sink.drained(f->sink.data, id);
	queue_turn(f->q);
}

void fake_refused(struct fake *f, int64_t id)
{
	f->sink.refused(f->sink.data, id);
}

void fake_stopped(struct fake *f, int64_t id, bool stopped)
{
	f->sink.stopped(f->sink.data, id, stopped);
	queue_turn(f->q);
}

void fake_success(struct fake *f, int64_t id)
{
	fake_hello(f, id);
	fake_packet(f, id, MESSAGE_RESULT,
	            json_pack("{s:s, s:s}", "path", "/out.txt", "kind", "text"));
	fake_packet(f, id, MESSAGE_DONE, NULL);
	fake_eof(f, id);
	fake_exit(f, id, 0, 0);
}

enum status fake_event(struct fake *f, int64_t id, enum job_event event)
{
	enum status st = queue_event(f->q, id, event, "you", NULL);
	queue_turn(f->q);
	return st;
}

void fake_wait(struct fake *f, double s)
{
	double end = f->now + s, next;
	while ((next = queue_deadline(f->q)) <= end) {
		f->now = fmax(f->now, next);
		queue_tick(f->q);
		queue_turn(f->q);
	}
	f->now = end;
}

enum job_state fake_state(struct fake *f, int64_t id)
{
	const struct Stats *s = queue_find(f->q, id);
	assert_non_null(s);
	return s->state;
}

const char *fake_reason(struct fake *f, int64_t id)
{
	const struct Stats *s = queue_find(f->q, id);
	assert_non_null(s);
	return s->reason ? s->reason : "";
}

const char *fake_row(struct fake *f, int64_t id)
{
	return json_text(f->rows[id].record, "state", "");
}

const char *fake_log(struct fake *f)
{
	static const char quiet[] = "told ";
	text_reset(&f->seen);
	for (const char *p = f->log.n ? f->log.s : ""; *p;) {
		size_t n = strcspn(p, ";") + 1;
		if (strncmp(p, quiet, sizeof quiet - 1))
			text_add_bytes(&f->seen, p, n);
		p += n;
	}
	text_reset(&f->log);
	return f->seen.n ? f->seen.s : "";
}
