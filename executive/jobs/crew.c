/* crew.c - each job's processes: on the launcher it names, one alone or a team. */
#include "crew.h"

#include <stdlib.h>
#include <string.h>

#include "shard.h"
#include "team.h"

struct crew {
	struct launcher launcher;
	struct launcher_sink sink;
	struct {
		const char *name;                /* borrowed */
		const struct launcher *launcher; /* borrowed */
	} below[CREW_LAUNCHERS];
	int n_below;
	struct team *teams;
};

static const struct launcher *launcher_of(const struct crew *c, const struct Stats *s)
{
	const char *name = s->on ? s->on : "local";
	for (int i = 0; i < c->n_below; i++)
		if (!strcmp(c->below[i].name, name))
			return c->below[i].launcher;
	return NULL;
}

static struct team *team_of(const struct crew *c, int64_t id)
{
	struct team *t = c->teams;
	while (t && t->stats.id != shard_job(id))
		t = t->next;
	return t;
}

/* ---- from above ---- */

static enum status crew_check(void *data, const struct Stats *s, const struct report *r)
{
	const struct launcher *l = launcher_of(data, s);
	if (!l)
		return report_error(r, ST_PARAMETER,
		                    "there is no launcher '%s'; --on takes local or slurm", s->on);
	if (s->shards < 0 || s->shards > SHARDS_MAX)
		return report_error(r, ST_PARAMETER, "--shards is %d, expected 1 to %d", s->shards,
		                    SHARDS_MAX);
	return l->check(l->data, s, r);
}

static void crew_bury(void *data, const struct Stats *s)
{
	const struct launcher *l = launcher_of(data, s);
	if (l)
		l->bury(l->data, s);
}

static void team_destroy(struct crew *c, struct team *t)
{
	struct team **at = &c->teams;
	while (*at != t)
		at = &(*at)->next;
	*at = t->next;
	team_finish(t);
	free(t);
}

static enum status crew_start(void *data, struct Stats *s, const struct report *r)
{
	struct crew *c = data;
	struct team *t = calloc(1, sizeof *t);
	enum status st = ST_RESOURCE;
	if (!t)
		return report_error(r, st, "out of memory");
	t->launcher = launcher_of(c, s);
	t->above = &c->sink;
	t->next = c->teams;
	c->teams = t;
	if (!t->launcher)
		st = report_error(r, ST_PARAMETER, "there is no launcher '%s'", s->on);
	else if (s->shards > 1)
		st = team_start(t, s, r);
	else
		st = t->launcher->start(t->launcher->data, s, r);
	t->stats.id = s->id;
	if (st != ST_OK)
		team_destroy(c, t);
	return st;
}

static enum status crew_send(void *data, int64_t id, enum message_type type, const json_t *body)
{
	struct team *t = team_of(data, id);
	if (!t)
		return ST_INTERNAL;
	return t->members ? team_send(t, type, body)
	                  : t->launcher->send(t->launcher->data, id, type, body);
}

static void crew_signal(void *data, int64_t id, enum launcher_signal signal)
{
	struct team *t = team_of(data, id);
	if (t && t->members)
		team_signal(t, signal);
	else if (t)
		t->launcher->signal(t->launcher->data, id, signal);
}

static void crew_note(void *data, int64_t id, const char *level, const char *text)
{
	const struct team *t = team_of(data, id);
	int i = 0;
	while (t && t->members && i < t->n_shards && !t->members[i].live)
		i++;
	if (t)
		t->launcher->note(t->launcher->data, t->members ? t->members[i].id : id, level,
		                  text);
}

static const char *crew_job_file(void *data, int64_t id)
{
	const struct team *t = team_of(data, id);
	if (t && t->members)
		return ""; /* each member has its own */
	return t ? t->launcher->job_file(t->launcher->data, id) : NULL;
}

static void crew_forget(void *data, int64_t id)
{
	struct team *t = team_of(data, id);
	if (!t)
		return;
	if (!t->members)
		t->launcher->forget(t->launcher->data, id);
	team_destroy(data, t);
}

/* ---- from below ---- */

static struct member *member_of(const struct crew *c, int64_t id, struct team **team)
{
	*team = team_of(c, id);
	return *team && (*team)->members ? team_member(*team, id) : NULL;
}

static void on_packet(void *data, int64_t id, const struct message *packet)
{
	struct crew *c = data;
	struct team *t;
	struct member *m = member_of(c, id, &t);
	if (m)
		team_packet(t, m, packet);
	else if (t && !t->members)
		c->sink.packet(c->sink.data, id, packet);
}

static void on_broken(void *data, int64_t id, const char *reason)
{
	struct crew *c = data;
	c->sink.broken(c->sink.data, shard_job(id), reason);
}

static void on_drained(void *data, int64_t id)
{
	struct crew *c = data;
	struct team *t;
	struct member *m = member_of(c, id, &t);
	if (m)
		team_drained(t, m);
	else if (t && !t->members)
		c->sink.drained(c->sink.data, id);
}

static void on_exited(void *data, int64_t id, const struct launcher_exit *e)
{
	struct crew *c = data;
	struct team *t;
	struct member *m = member_of(c, id, &t);
	if (m)
		team_exited(t, m, e);
	else if (t && !t->members)
		c->sink.exited(c->sink.data, id, e);
}

static void on_stopped(void *data, int64_t id, bool stopped)
{
	struct crew *c = data;
	struct team *t;
	struct member *m = member_of(c, id, &t);
	if (m)
		team_stopped(t, m, stopped);
	else if (t && !t->members)
		c->sink.stopped(c->sink.data, id, stopped);
}

static void on_refused(void *data, int64_t id)
{
	struct crew *c = data;
	struct team *t;
	if (member_of(c, id, &t))
		team_refused(t);
	else if (t && !t->members)
		c->sink.refused(c->sink.data, id);
}

static void on_waits(void *data, int64_t id, const char *reason)
{
	struct crew *c = data;
	struct team *t;
	struct member *m = member_of(c, id, &t);
	if (m)
		team_waits(t, m, reason);
	else if (t && !t->members)
		c->sink.waits(c->sink.data, id, reason);
}

struct launcher_sink crew_sink(struct crew *c)
{
	return (struct launcher_sink){
		.data = c,
		.packet = on_packet,
		.broken = on_broken,
		.drained = on_drained,
		.exited = on_exited,
		.stopped = on_stopped,
		.refused = on_refused,
		.waits = on_waits,
	};
}

enum status crew_create(struct crew **out)
{
	struct crew *c = calloc(1, sizeof *c);
	if (!c)
		return ST_RESOURCE;
	c->launcher = (struct launcher){
		.data = c,
		.check = crew_check,
		.bury = crew_bury,
		.start = crew_start,
		.send = crew_send,
		.signal = crew_signal,
		.note = crew_note,
		.job_file = crew_job_file,
		.forget = crew_forget,
	};
	*out = c;
	return ST_OK;
}

void crew_destroy(struct crew *c)
{
	while (c && c->teams)
		team_destroy(c, c->teams);
	free(c);
}

void crew_add(struct crew *c, const char *name, const struct launcher *l)
{
	c->below[c->n_below].name = name;
	c->below[c->n_below++].launcher = l;
}

const struct launcher *crew_launcher(struct crew *c)
{
	return &c->launcher;
}

void crew_connect(struct crew *c, struct launcher_sink sink)
{
	c->sink = sink;
}
