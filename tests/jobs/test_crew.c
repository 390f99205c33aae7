/* test_crew.c - a job that is cut looks like one worker; what is not cut is passed through. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "crew.h"
#include "json.h"
#include "shard.h"
#include "text.h"

enum { JOB = 7 };

/* A launcher below and a queue above that write down what they are told. */
struct here {
	struct crew *crew;
	struct launcher below;
	struct launcher_sink sink; /* the crew's */
	struct text log, seen;
	int refuse; /* starts from that one on fail; 0: none */
	int started;
};

/* "7" the job, "7/0" its shard. */
static void name(struct text *t, const char *what, int64_t id)
{
	text_addf(t, "%s %lld", what, (long long)shard_job(id));
	if (shard_of(id) >= 0)
		text_addf(t, "/%d", shard_of(id));
	text_add(t, ";");
}

static enum status below_start(void *data, struct Stats *s, const struct report *r)
{
	struct here *h = data;
	if (h->refuse && ++h->started >= h->refuse)
		return report_error(r, ST_RESOURCE, "no processes are left");
	name(&h->log, "start", s->id);
	s->pid = 100;
	free(s->host);
	s->host = strdup("here");
	return ST_OK;
}

static enum status below_send(void *data, int64_t id, enum message_type type, const json_t *body)
{
	struct here *h = data;
	(void)body;
	name(&h->log, message_row(type)->name, id);
	return ST_OK;
}

static void below_signal(void *data, int64_t id, enum launcher_signal signal)
{
	static const char *const words[] = { "stop", "continue", "terminate", "kill" };
	struct here *h = data;
	name(&h->log, words[signal], id);
}

static void below_note(void *data, int64_t id, const char *level, const char *text)
{
	struct here *h = data;
	(void)level;
	(void)text;
	name(&h->log, "note", id);
}

static const char *below_file(void *data, int64_t id)
{
	(void)data;
	(void)id;
	return "job.json";
}

static void below_forget(void *data, int64_t id)
{
	struct here *h = data;
	name(&h->log, "forget", id);
}

static void above_packet(void *data, int64_t id, const struct message *m)
{
	struct here *h = data;
	text_addf(&h->log, "up %s", message_row(m->type)->name);
	if (m->type == MESSAGE_PROGRESS)
		text_addf(&h->log, " %lld/%lld", (long long)json_int(m->body, "done", -1),
		          (long long)json_int(m->body, "total", -1));
	if (m->type == MESSAGE_DONE)
		text_addf(&h->log, " cpu %g", json_number(m->body, "cpu_s", NAN));
	name(&h->log, "", id);
}

static void above_broken(void *data, int64_t id, const char *reason)
{
	struct here *h = data;
	text_addf(&h->log, "broken: %s", reason);
	name(&h->log, "", id);
}

static void above_drained(void *data, int64_t id)
{
	struct here *h = data;
	name(&h->log, "drained", id);
}

static void above_exited(void *data, int64_t id, const struct launcher_exit *e)
{
	struct here *h = data;
	text_addf(&h->log, "exited %d %d", e->status, e->signal);
	name(&h->log, "", id);
}

static void above_stopped(void *data, int64_t id, bool stopped)
{
	struct here *h = data;
	name(&h->log, stopped ? "stopped" : "goes on", id);
}

static void above_refused(void *data, int64_t id)
{
	struct here *h = data;
	name(&h->log, "refused", id);
}

static void above_waits(void *data, int64_t id, const char *reason)
{
	struct here *h = data;
	name(&h->log, reason ? "waits" : "waits no more", id);
}

static int set_up(void **state)
{
	struct here *h = calloc(1, sizeof *h);
	*state = h;
	if (!h || crew_create(&h->crew) != ST_OK)
		return -1;
	h->below = (struct launcher){ .data = h,
		                      .start = below_start,
		                      .send = below_send,
		                      .signal = below_signal,
		                      .note = below_note,
		                      .job_file = below_file,
		                      .forget = below_forget };
	crew_add(h->crew, "local", &h->below);
	crew_connect(h->crew, (struct launcher_sink){ .data = h,
	                                              .packet = above_packet,
	                                              .broken = above_broken,
	                                              .drained = above_drained,
	                                              .exited = above_exited,
	                                              .stopped = above_stopped,
	                                              .refused = above_refused,
	                                              .waits = above_waits });
	h->sink = crew_sink(h->crew);
	return 0;
}

static int tear_down(void **state)
{
	struct here *h = *state;
	crew_destroy(h->crew);
	text_finish(&h->log);
	text_finish(&h->seen);
	free(h);
	return 0;
}

/* What was done since the last call. */
static void expect(struct here *h, const char *log)
{
	struct text t = h->seen;
	text_reset(&t);
	h->seen = h->log;
	h->log = t;
	assert_string_equal(h->seen.n ? h->seen.s : "", log);
}

static enum status begin(struct here *h, int shards)
{
	const struct launcher *l = crew_launcher(h->crew);
	struct Stats s;
	stats_init(&s);
	s.id = JOB;
	s.shards = shards;
	enum status st = l->start(l->data, &s, NULL);
	if (st == ST_OK)
		assert_int_equal(s.pid, 100);
	stats_finish(&s);
	return st;
}

static void packet(struct here *h, int64_t id, enum message_type type, json_t *body)
{
	struct message m = { .type = type, .body = body ? body : json_object() };
	h->sink.packet(h->sink.data, id, &m);
	message_finish(&m);
}

static void hello(struct here *h, int64_t id)
{
	packet(h, id, MESSAGE_HELLO, json_pack("{s:i}", "protocol", MESSAGE_PROTOCOL));
}

/* Both shards of JOB are there and wait. */
static void begin_two(struct here *h)
{
	assert_int_equal(begin(h, 2), ST_OK);
	hello(h, shard_id(JOB, 0));
	hello(h, shard_id(JOB, 1));
}

static void end(struct here *h, int64_t id, int status, int signal)
{
	struct launcher_exit e = { .status = status, .signal = signal, .cpu_s = NAN };
	h->sink.drained(h->sink.data, id);
	h->sink.exited(h->sink.data, id, &e);
}

static void done(struct here *h, int64_t id)
{
	packet(h, id, MESSAGE_DONE, json_pack("{s:f, s:i}", "cpu_s", 1.5, "peak_kib", 10));
	end(h, id, 0, 0);
}

static void what_is_not_cut_is_passed_through(void **state)
{
	struct here *h = *state;
	assert_int_equal(begin(h, 1), ST_OK);
	hello(h, JOB);
	packet(h, JOB, MESSAGE_DONE, NULL);
	end(h, JOB, 3, 0);
	const struct launcher *l = crew_launcher(h->crew);
	l->forget(l->data, JOB);
	expect(h, "start 7;up HELLO 7;up DONE cpu nan 7;drained 7;exited 3 0 7;forget 7;");
	hello(h, JOB); /* of nobody */
	expect(h, "");
}

static void shards_are_one_worker_and_are_joined(void **state)
{
	struct here *h = *state;
	int64_t a = shard_id(JOB, 0), b = shard_id(JOB, 1);
	assert_int_equal(begin(h, 2), ST_OK);
	expect(h, "start 7/0;start 7/1;");
	hello(h, a);
	expect(h, "START 7/0;");
	hello(h, b);
	expect(h, "START 7/1;up HELLO 7;");
	/* one not heard of yet is as long as the longest */
	packet(h, a, MESSAGE_PROGRESS, json_pack("{s:i, s:i}", "done", 2, "total", 5));
	packet(h, b, MESSAGE_PROGRESS, json_pack("{s:i, s:i}", "done", 1, "total", 4));
	expect(h, "up PROGRESS 2/10 7;up PROGRESS 3/9 7;");
	done(h, a);
	expect(h, "forget 7/0;");
	done(h, b);
	expect(h, "forget 7/1;up PROGRESS 3/9 7;start 7;");
	hello(h, JOB);
	packet(h, JOB, MESSAGE_RESULT, json_pack("{s:s, s:s}", "path", "/o", "kind", "t"));
	done(h, JOB);
	expect(h, "START 7;up RESULT 7;up DONE cpu 4.5 7;forget 7;drained 7;exited 0 0 7;");
}

static void a_lost_shard_is_begun_again_but_not_for_ever(void **state)
{
	struct here *h = *state;
	int64_t a = shard_id(JOB, 0), b = shard_id(JOB, 1);
	begin_two(h);
	expect(h, "start 7/0;start 7/1;START 7/0;START 7/1;up HELLO 7;");
	for (int i = 0; i < 3; i++) {
		end(h, a, 0, 9);
		expect(h, "forget 7/0;start 7/0;note 7/0;");
	}
	end(h, a, 0, 9);
	expect(h, "forget 7/0;kill 7/1;");
	end(h, b, 0, 9);
	expect(h, "forget 7/1;drained 7;exited 0 9 7;");
}

static void a_shard_that_fails_ends_all(void **state)
{
	struct here *h = *state;
	int64_t a = shard_id(JOB, 0), b = shard_id(JOB, 1);
	begin_two(h);
	packet(h, b, MESSAGE_ERROR, json_pack("{s:s, s:s}", "class", "input", "text", "no"));
	end(h, b, 1, 0);
	end(h, a, 0, 9);
	expect(h, "start 7/0;start 7/1;START 7/0;START 7/1;up HELLO 7;up ERROR 7;forget 7/1;"
	          "kill 7/0;forget 7/0;drained 7;exited 1 0 7;");
	/* a result is for the one that joins */
	const struct launcher *l = crew_launcher(h->crew);
	l->forget(l->data, JOB);
	begin_two(h);
	expect(h, "start 7/0;start 7/1;START 7/0;START 7/1;up HELLO 7;");
	packet(h, a, MESSAGE_RESULT, json_pack("{s:s, s:s}", "path", "/o", "kind", "t"));
	expect(h, "broken: a RESULT from a shard 7;");
}

/* One that cannot be stopped: the others do not wait for it, stopped. */
static void all_go_on_where_one_refuses(void **state)
{
	struct here *h = *state;
	const struct launcher *l = crew_launcher(h->crew);
	int64_t a = shard_id(JOB, 0), b = shard_id(JOB, 1);
	begin_two(h);
	l->signal(l->data, JOB, LAUNCHER_STOP);
	h->sink.stopped(h->sink.data, a, true);
	expect(h, "start 7/0;start 7/1;START 7/0;START 7/1;up HELLO 7;stop 7/0;stop 7/1;");
	h->sink.refused(h->sink.data, b);
	expect(h, "continue 7/0;continue 7/1;refused 7;");
	h->sink.stopped(h->sink.data, a, false);
	expect(h, "");
}

static void it_is_stopped_when_all_are(void **state)
{
	struct here *h = *state;
	const struct launcher *l = crew_launcher(h->crew);
	int64_t a = shard_id(JOB, 0), b = shard_id(JOB, 1);
	begin_two(h);
	expect(h, "start 7/0;start 7/1;START 7/0;START 7/1;up HELLO 7;");
	l->signal(l->data, JOB, LAUNCHER_STOP);
	h->sink.stopped(h->sink.data, a, true);
	expect(h, "stop 7/0;stop 7/1;");
	h->sink.stopped(h->sink.data, b, true);
	expect(h, "stopped 7;");
	h->sink.stopped(h->sink.data, a, false);
	expect(h, "goes on 7;");
	/* asked to end: what goes away is not begun again */
	l->send(l->data, JOB, MESSAGE_CANCEL, NULL);
	end(h, a, 130, 0);
	end(h, b, 130, 0);
	expect(h,
	       "CANCEL 7/0;CANCEL 7/1;forget 7/0;stopped 7;forget 7/1;drained 7;exited 130 0 7;");
}

static void none_is_left_where_one_cannot_start(void **state)
{
	struct here *h = *state;
	h->refuse = 3;
	assert_int_equal(begin(h, 4), ST_RESOURCE);
	expect(h, "start 7/0;start 7/1;forget 7/0;forget 7/1;");
	hello(h, shard_id(JOB, 0));
	expect(h, "");
}

#define T(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void)
{
	const struct CMUnitTest tests[] = {
		T(what_is_not_cut_is_passed_through),
		T(shards_are_one_worker_and_are_joined),
		T(a_lost_shard_is_begun_again_but_not_for_ever),
		T(a_shard_that_fails_ends_all),
		T(it_is_stopped_when_all_are),
		T(all_go_on_where_one_refuses),
		T(none_is_left_where_one_cannot_start),
	};
	return cmocka_run_group_tests_name("crew", tests, NULL, NULL);
}
