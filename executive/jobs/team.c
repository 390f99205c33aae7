/* team.c - the processes of one job that is cut, as one worker to the queue. */
#include "team.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "shard.h"

/* times that one member may be begun again */
enum { LOSSES_MAX = 3, HOSTS_MAX = 200 };

static int64_t job_of(const struct team *t)
{
	return t->stats.id;
}

static struct member *joiner(const struct team *t)
{
	return &t->members[t->n_shards];
}

static void tell(const struct team *t, enum message_type type, json_t *body)
{
	struct message m = { .type = type, .body = body ? body : json_object() };
	if (m.body)
		t->above->packet(t->above->data, job_of(t), &m);
	message_finish(&m);
}

static void note(const struct team *t, const struct member *m, const char *text)
{
	char *line = text_print("shard %d of %d: %s", shard_of(m->id) + 1, t->n_shards, text);
	if (line)
		t->launcher->note(t->launcher->data, m->id, "warning", line);
	free(line);
}

/* A fresh process for a member. The record is the launcher's to fill in, so it gets a copy. */
static enum status member_start(struct team *t, struct member *m, struct Stats *filled,
                                const struct report *r)
{
	struct Stats s;
	enum status st = stats_copy(&s, &t->stats);
	if (st != ST_OK)
		return report_error(r, st, "out of memory");
	s.id = m->id;
	st = t->launcher->start(t->launcher->data, &s, r);
	if (st == ST_OK) {
		int losses = m->losses;
		*m = (struct member){ .id = m->id, .live = true, .losses = losses };
	}
	if (st == ST_OK && filled) {
		*filled = s;
		return st;
	}
	stats_finish(&s);
	return st;
}

enum status team_start(struct team *t, struct Stats *s, const struct report *r)
{
	struct Stats first = { 0 };
	enum status st = stats_copy(&t->stats, s);
	t->n_shards = s->shards;
	t->cpu_s = 0;
	t->peak_kib = -1;
	t->members = st == ST_OK ? calloc((size_t)s->shards + 1, sizeof *t->members) : NULL;
	if (!t->members)
		return report_error(r, ST_RESOURCE, "out of memory");
	joiner(t)->id = s->id;
	for (int i = 0; i < t->n_shards; i++)
		t->members[i].id = shard_id(s->id, i);
	for (int i = 0; i < t->n_shards && st == ST_OK; i++)
		st = member_start(t, &t->members[i], i ? NULL : &first, r);
	if (st == ST_OK) {
		s->pid = first.pid;
		free(s->host);
		free(s->log);
		s->host = first.host;
		s->log = first.log;
		first.host = first.log = NULL;
	}
	stats_finish(&first);
	return st;
}

void team_finish(struct team *t)
{
	for (int i = 0; t->members && i <= t->n_shards; i++)
		if (t->members[i].live)
			t->launcher->forget(t->launcher->data, t->members[i].id);
	free(t->members);
	text_finish(&t->hosts);
	stats_finish(&t->stats);
}

struct member *team_member(struct team *t, int64_t id)
{
	int shard = shard_of(id);
	if (shard >= t->n_shards)
		return NULL;
	struct member *m = shard < 0 ? joiner(t) : &t->members[shard];
	return m->live ? m : NULL;
}

/* ---- from above ---- */

/* START goes to each member at its own HELLO. */
enum status team_send(struct team *t, enum message_type type, const json_t *body)
{
	if (type == MESSAGE_START)
		return ST_OK;
	t->ending |= type == MESSAGE_CANCEL;
	for (int i = 0; i <= t->n_shards; i++)
		if (t->members[i].live)
			t->launcher->send(t->launcher->data, t->members[i].id, type, body);
	return ST_OK;
}

void team_signal(struct team *t, enum launcher_signal signal)
{
	t->ending |= signal == LAUNCHER_TERMINATE || signal == LAUNCHER_KILL;
	if (signal == LAUNCHER_CONTINUE)
		t->suspended = false;
	for (int i = 0; i <= t->n_shards; i++) {
		struct member *m = &t->members[i];
		if (m->live)
			t->launcher->signal(t->launcher->data, m->id, signal);
		m->stopped &= signal != LAUNCHER_CONTINUE;
	}
}

/* ---- from below ---- */

static void host_add(struct team *t, const char *host)
{
	const char *at = t->hosts.n ? t->hosts.s : "";
	size_t n = host ? strlen(host) : 0;
	if (!n || t->hosts.n + n > HOSTS_MAX)
		return;
	for (; *at; at += strspn(at, ",")) {
		size_t one = strcspn(at, ",");
		if (one == n && !strncmp(at, host, n))
			return;
		at += one;
	}
	text_addf(&t->hosts, "%s%s", t->hosts.n ? "," : "", host);
}

/* HELLO is passed on when all have greeted that could. */
static void greet(struct team *t, const json_t *hello)
{
	for (int i = 0; i < t->n_shards; i++) {
		const struct member *m = &t->members[i];
		if (m->live && !m->greeted && !m->waiting)
			return;
	}
	if (t->greeted)
		return;
	json_t *o = json_copy((json_t *)hello);
	if (t->hosts.n)
		json_set_text(o, "host", t->hosts.s);
	t->greeted = true;
	tell(t, MESSAGE_HELLO, o);
}

static void on_hello(struct team *t, struct member *m, const json_t *body)
{
	m->greeted = true;
	host_add(t, json_text(body, "host", NULL));
	if (json_int(body, "protocol", 0) == MESSAGE_PROTOCOL && !t->ending && !t->failed) {
		json_t *start = json_object();
		json_set_text(start, "job", t->launcher->job_file(t->launcher->data, m->id));
		t->launcher->send(t->launcher->data, m->id, MESSAGE_START, start);
		json_decref(start);
	}
	greet(t, body);
}

/* Shards differ by one unit at most, so those not heard of yet are as long as the longest. */
static void progress(struct team *t, const char *phase)
{
	int64_t done = 0, total = 0, most = 0;
	if (!t->greeted)
		return;
	for (int i = 0; i < t->n_shards; i++)
		most = t->members[i].total > most ? t->members[i].total : most;
	for (int i = 0; i < t->n_shards; i++) {
		const struct member *m = &t->members[i];
		done += m->done;
		total += m->total ? m->total : m->finished ? 0 : most;
	}
	json_t *o = json_object();
	json_set_int(o, "done", done);
	json_set_int(o, "total", total);
	json_set_text(o, "phase", phase);
	json_set_text(o, "host", t->hosts.n ? t->hosts.s : NULL);
	tell(t, MESSAGE_PROGRESS, o);
}

static void on_progress(struct team *t, struct member *m, const json_t *body)
{
	if (t->joining) {
		tell(t, MESSAGE_PROGRESS, json_copy((json_t *)body));
		return;
	}
	m->done = json_int(body, "done", 0);
	m->total = json_int(body, "total", 0);
	progress(t, json_text(body, "phase", NULL));
}

static void on_done(struct team *t, struct member *m, const json_t *body)
{
	double cpu_s = json_number(body, "cpu_s", NAN);
	int64_t peak = json_int(body, "peak_kib", -1);
	m->finished = true;
	t->cpu_s += isfinite(cpu_s) ? cpu_s : 0;
	t->peak_kib = peak > t->peak_kib ? peak : t->peak_kib;
	if (!t->joining)
		return;
	json_t *o = json_copy((json_t *)body);
	json_set_number(o, "cpu_s", t->cpu_s);
	json_set_int(o, "peak_kib", t->peak_kib);
	tell(t, MESSAGE_DONE, o);
}

/* What comes before HELLO was passed on is no packet to the queue. */
static void on_other(struct team *t, struct member *m, const struct message *packet)
{
	if (t->greeted || packet->type == MESSAGE_ERROR)
		t->above->packet(t->above->data, job_of(t), packet);
	else if (packet->type == MESSAGE_NOTE)
		t->launcher->note(t->launcher->data, m->id,
		                  json_text(packet->body, "level", "info"),
		                  json_text(packet->body, "text", ""));
}

void team_packet(struct team *t, struct member *m, const struct message *packet)
{
	switch (packet->type) {
	case MESSAGE_HELLO:
		on_hello(t, m, packet->body);
		break;
	case MESSAGE_PROGRESS:
		on_progress(t, m, packet->body);
		break;
	case MESSAGE_DONE:
		on_done(t, m, packet->body);
		break;
	case MESSAGE_RESULT:
		if (!t->joining) {
			t->above->broken(t->above->data, job_of(t), "a RESULT from a shard");
			break;
		}
		__attribute__((fallthrough));
	default:
		on_other(t, m, packet);
	}
}

static int count_live(const struct team *t)
{
	int n = 0;
	for (int i = 0; i <= t->n_shards; i++)
		n += t->members[i].live;
	return n;
}

/* Told above when all that live are stopped, and when one of them goes on. */
static void stops_check(struct team *t)
{
	int live = count_live(t), stopped = 0;
	for (int i = 0; i <= t->n_shards; i++)
		stopped += t->members[i].live && t->members[i].stopped;
	bool all = live && stopped == live;
	if (all == t->suspended)
		return;
	t->suspended = all;
	t->above->stopped(t->above->data, job_of(t), all);
}

/* The whole has ended, with the exit of the one that failed or joined. */
static void team_end(struct team *t)
{
	struct launcher_exit e = t->exit;
	e.cpu_s = NAN; /* DONE says it */
	e.peak_kib = -1;
	t->above->drained(t->above->data, job_of(t));
	t->above->exited(t->above->data, job_of(t), &e);
}

static void team_fail(struct team *t, const struct launcher_exit *e)
{
	if (!t->failed)
		t->exit = *e;
	if (!t->failed && !t->ending)
		team_signal(t, LAUNCHER_KILL);
	t->failed = true;
}

static void join_begin(struct team *t)
{
	struct report_store store;
	report_store_init(&store);
	t->joining = true;
	progress(t, "joining the shards");
	if (member_start(t, joiner(t), NULL, &store.report) == ST_OK)
		return;
	json_t *o = json_object();
	json_set_text(o, "class", "resource");
	json_set_text(o, "text", store.error);
	tell(t, MESSAGE_ERROR, o);
	team_fail(t, &(struct launcher_exit){ .status = 1 });
	team_end(t);
}

/* Its process went away and nothing says that the next would fare likewise. */
static bool member_again(struct team *t, struct member *m)
{
	struct launcher_exit e = m->exit;
	if (t->ending || t->failed || (!e.lost && !e.signal) || m->losses >= LOSSES_MAX)
		return false;
	m->losses++;
	if (member_start(t, m, NULL, NULL) != ST_OK)
		return false;
	note(t, m, "its process went away; begun again from its part file");
	return true;
}

static void member_ended(struct team *t, struct member *m)
{
	bool clean = m->finished && !m->exit.status && !m->exit.signal;
	m->live = m->stopped = false;
	t->launcher->forget(t->launcher->data, m->id);
	if (!clean && member_again(t, m))
		return;
	if (!clean)
		team_fail(t, &m->exit);
	if (count_live(t)) {
		stops_check(t);
	} else if (t->joining || t->failed || t->ending) {
		team_end(t);
	} else {
		join_begin(t);
	}
}

/* A pipe that something escaped holds open keeps no member that has said DONE. */
static void ended_check(struct team *t, struct member *m)
{
	if (m->exited && (m->drained || m->finished))
		member_ended(t, m);
}

void team_exited(struct team *t, struct member *m, const struct launcher_exit *e)
{
	m->exited = true;
	m->exit = *e;
	ended_check(t, m);
}

void team_drained(struct team *t, struct member *m)
{
	m->drained = true;
	ended_check(t, m);
}

void team_stopped(struct team *t, struct member *m, bool stopped)
{
	m->stopped = stopped;
	stops_check(t);
}

void team_refused(struct team *t)
{
	team_signal(t, LAUNCHER_CONTINUE);
	t->above->refused(t->above->data, job_of(t));
}

void team_waits(struct team *t, struct member *m, const char *reason)
{
	m->waiting = reason != NULL;
	if (!t->greeted)
		t->above->waits(t->above->data, job_of(t), reason);
}
