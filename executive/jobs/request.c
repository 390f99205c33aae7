/* request.c - what clients ask for: the table of requests, and how each is answered. */
#include <stdlib.h>
#include <string.h>

#include "batch.h"
#include "json.h"
#include "selection.h"

/* Of those that have ended WATCH tells so many, without a name; PRUNE forgets so many at once. */
enum { HOUR_S = 3600, WATCH_LAST = 1000, PRUNE_PAGE = 1000 };

/* A row of the table: what it does; the event it stands for; the state a job must come to. */
struct request_row {
	enum message_type type;
	void (*take)(struct request *q, const struct request_row *row, const json_t *body);
	enum job_event event;
	bool (*wanted)(enum job_state state);
};

static const struct request_row *row_find(enum message_type type);

void request_end(struct request *q)
{
	json_t *o = json_object();
	json_set_int(o, "id", q->id);
	if (q->st != ST_OK) {
		json_set_text(o, "class", status_class(q->st));
		json_set_text(o, "text", q->error ? q->error : status_text(q->st));
	}
	session_send(q->session, q->st == ST_OK ? MESSAGE_END : MESSAGE_ERROR, o);
	q->ended = true;
}

void request_destroy(struct request *q)
{
	log_reader_destroy(q->log);
	free(q->jobs);
	free(q->list);
	free(q->group);
	free(q->error);
	free(q);
}

static const struct ledger_choice all_over = { 0 };

static bool pass_event(const struct Stats *s, const void *data)
{
	const enum job_event *event = data;
	/* what somebody killed is tried again only by its name */
	return job_can(s->state, *event) && !(*event == EV_RETRY && s->state == JOB_KILLED);
}

static bool pass_recent(const struct Stats *s, const void *data)
{
	const double *date = data;
	return !job_state_table[s->state].over || s->ended >= *date - HOUR_S;
}

static bool pass_unended(const struct Stats *s, const void *data)
{
	(void)data;
	return !job_state_table[s->state].over;
}

static bool pass_over(const struct Stats *s, const void *data)
{
	(void)data;
	return job_state_table[s->state].over;
}

/* States to come to */

static bool is_over(enum job_state s)
{
	return job_state_table[s].over;
}

static bool is_stopped(enum job_state s)
{
	return s == JOB_SUSPENDED || is_over(s);
}

static bool is_any(enum job_state s)
{
	(void)s;
	return true;
}

/* Requests */

/* Of the jobs named, or selected; but for WATCH they are not wanted any more. */
static void list_begin(struct request *q)
{
	free(q->list);
	if (q->type != MESSAGE_WATCH) {
		q->list = q->jobs;
		q->n_list = q->n;
		q->at_list = q->n = q->at = 0;
		q->jobs = NULL;
		return;
	}
	q->list = calloc((size_t)q->n + 1, sizeof *q->list);
	q->n_list = q->list ? q->n : 0;
	q->at_list = 0;
	if (!q->list)
		request_fail(q, ST_RESOURCE, "out of memory");
	else if (q->n)
		memcpy(q->list, q->jobs, (size_t)q->n * sizeof *q->list);
}

/* As much as the client has room for; true when all is said. */
static bool list_send(struct request *q)
{
	while (q->at_list < q->n_list && session_backlog(q->session) < LIST_AHEAD)
		session_send_record(q->session, q->id, q->list[q->at_list++], q->full);
	return q->at_list == q->n_list;
}

/* What changes jobs wants to be told which. */
static bool somebody_named(struct request *q, const json_t *body)
{
	if (json_is_array(json_object_get(body, "jobs")) || json_text(body, "group", NULL) ||
	    json_flag(body, "all", false))
		return true;
	request_fail(q, ST_PARAMETER, "no job is named; give ids, a group or all");
	return false;
}

/* The whole queue: is what comes later held, too? */
static enum status gate(struct request *q, const struct request_row *row, const json_t *body)
{
	struct report r = request_report(q);
	bool all = json_flag(body, "all", false) && !json_object_get(body, "jobs") &&
	           !json_object_get(body, "group");
	if (all && row->event == EV_HOLD && json_flag(body, "after_current", false))
		return queue_hold(request_queue(q), true, &r);
	if (all && row->event == EV_RELEASE)
		return queue_hold(request_queue(q), false, &r);
	return ST_OK;
}

/* "After the current ones": what has begun goes on to its end, what is held stays so. */
static bool has_begun(const struct Stats *s)
{
	return s->state != JOB_QUEUED && !job_state_table[s->state].over;
}

static void take_event(struct request *q, const struct request_row *row, const json_t *body)
{
	const json_t *ids = json_object_get(body, "jobs");
	const char *group = json_text(body, "group", NULL), *by = json_text(body, "by", "you");
	bool lenient = row->event == EV_HOLD && json_flag(body, "after_current", false);
	const struct ledger_choice bad = { .states = 1U << JOB_FAILED | 1U << JOB_LOST };
	const struct selection which = {
		.pass = lenient ? pass_unended : pass_event,
		.data = &row->event,
		.over = row->event == EV_RETRY ? &bad : NULL,
	};
	struct report r = request_report(q);
	if (!somebody_named(q, body) || gate(q, row, body) != ST_OK) {
		request_end(q);
		return;
	}
	if (json_is_array(ids) ? !selection_named(q, ids) : !selection_where(q, group, &which)) {
		request_end(q);
		return;
	}
	int kept = 0;
	for (int i = 0; i < q->n; i++) {
		const struct Stats *s = queue_find(request_queue(q), q->jobs[i]);
		if ((lenient && has_begun(s)) ||
		    queue_event(request_queue(q), q->jobs[i], row->event, by, &r) == ST_OK)
			q->jobs[kept++] = q->jobs[i];
	}
	q->n = kept;
}

static void take_priority(struct request *q, const struct request_row *row, const json_t *body)
{
	const json_t *ids = json_object_get(body, "jobs");
	struct report r = request_report(q);
	int64_t priority = json_int(body, "priority", 0);
	(void)row;
	if (!somebody_named(q, body))
		return;
	if (priority < -1000000 || priority > 1000000)
		report_error(&r, ST_PARAMETER, "priority is %lld, expected -1000000 to 1000000",
		             (long long)priority);
	else if (json_is_array(ids)
	                 ? selection_named(q, ids)
	                 : selection_where(q, json_text(body, "group", NULL),
	                                   &(struct selection){ .pass = pass_unended })) {
		/* the first of several that are put first is put there last */
		for (int i = 0; i < q->n; i++)
			if (json_flag(body, "top", false))
				queue_top(request_queue(q), q->jobs[q->n - 1 - i], &r);
			else
				queue_priority(request_queue(q), q->jobs[i], (int)priority, &r);
	}
}

static void take_list(struct request *q, const struct request_row *row, const json_t *body)
{
	const json_t *ids = json_object_get(body, "jobs");
	const struct clock *clock = &q->session->server->clock;
	double now = clock->date(clock->data);
	bool all = json_flag(body, "all", false);
	const struct ledger_choice recent = { .since = now - HOUR_S };
	const struct selection which = {
		.pass = all ? NULL : pass_recent,
		.data = &now,
		.over = all ? &all_over : &recent,
	};
	(void)row;
	q->full = json_flag(body, "full", false);
	if (json_is_array(ids))
		selection_named(q, ids);
	else
		selection_where(q, json_text(body, "group", NULL), &which);
}

/* WAIT is answered when all have ended; without a name it is for those there are now. */
static void take_wait(struct request *q, const struct request_row *row, const json_t *body)
{
	const json_t *ids = json_object_get(body, "jobs");
	const char *group = json_text(body, "group", NULL);
	(void)row;
	const struct selection which = {
		.pass = group ? NULL : pass_unended,
		.over = group ? &all_over : NULL,
	};
	if (json_is_array(ids))
		selection_named(q, ids);
	else
		selection_where(q, group, &which);
}

/* Those of the group, or all that have not ended and the last that have. */
static void watch_all(struct request *q)
{
	const struct ledger_choice last = { .newest = WATCH_LAST };
	const struct selection which = { .over = q->group ? &all_over : &last };
	bool named = q->jobs;
	q->behind = false;
	if (named || selection_where(q, q->group, &which))
		list_begin(q);
	if (named)
		return;
	free(q->jobs);
	q->jobs = NULL;
	q->n = 0;
}

static void take_watch(struct request *q, const struct request_row *row, const json_t *body)
{
	const json_t *ids = json_object_get(body, "jobs");
	const char *group = json_text(body, "group", NULL);
	(void)row;
	q->stay = json_flag(body, "stay", false);
	if (json_is_array(ids)) {
		if (!selection_named(q, ids) || q->error) {
			request_end(q);
			return;
		}
	} else if (group) {
		q->group = strdup(group);
	}
	watch_all(q);
	if (q->error)
		request_end(q);
}

static void take_log(struct request *q, const struct request_row *row, const json_t *body)
{
	int64_t id = json_int(body, "job", 0);
	const struct Stats *s = queue_find(request_queue(q), id);
	struct report r = request_report(q);
	(void)row;
	if (!s) {
		report_error(&r, ST_INPUT, "there is no job %lld; 'batten jobs --all' lists them",
		             (long long)id);
	} else if (request_room(q, 1)) {
		q->jobs[q->n++] = id;
		if (log_reader_create(q, json_flag(body, "follow", false)) != ST_OK)
			request_fail(q, ST_RESOURCE, "out of memory");
	}
	if (q->error)
		request_end(q);
}

static void take_shutdown(struct request *q, const struct request_row *row, const json_t *body)
{
	(void)row;
	(void)body;
	server_leave(q->session->server);
}

static void take_prune(struct request *q, const struct request_row *row, const json_t *body)
{
	(void)row;
	(void)body;
	if (selection_where(q, NULL, &(struct selection){ .pass = pass_over, .over = &all_over }))
		list_begin(q);
	else
		request_end(q);
}

/* A page: those that were tried again meanwhile stay. */
static bool prune_page(struct request *q, const struct report *r)
{
	struct queue *jobs = request_queue(q);
	int first = q->at_list, n = 0;
	for (; q->at_list < q->n_list && n < PRUNE_PAGE; q->at_list++) {
		int64_t id = q->list[q->at_list];
		if (queue_holds(jobs, id) && !job_state_table[queue_find(jobs, id)->state].over)
			continue;
		session_send_record(q->session, q->id, id, false);
		q->list[first + n++] = id;
	}
	return queue_forget(jobs, q->list + first, n, r) == ST_OK;
}

static void prune_go_on(struct request *q)
{
	struct report r = request_report(q);
	bool good = true;
	while (good && q->at_list < q->n_list && session_backlog(q->session) < LIST_AHEAD)
		good = prune_page(q, &r);
	if (good && q->at_list < q->n_list)
		return;
	prune_files(q->session->server->project, request_queue(q));
	request_end(q);
}

static void take_submit(struct request *q, const struct request_row *row, const json_t *body)
{
	const json_t *jobs = json_object_get(body, "jobs");
	struct report r = request_report(q);
	struct batch b = { 0 };
	int64_t first = 0;
	enum status st = batch_read(&b, jobs, &r);
	(void)row;
	if (st == ST_OK && !b.n)
		st = report_error(&r, ST_PARAMETER, "no job is given");
	if (st == ST_OK)
		st = queue_submit(request_queue(q), b.jobs, b.n, &first, &r);
	if (st == ST_OK && request_room(q, (size_t)b.n))
		for (int i = 0; i < b.n; i++)
			q->jobs[q->n++] = first + i;
	batch_finish(&b);
	if (q->error || st != ST_OK)
		request_end(q);
}

static const struct request_row rows[] = {
	{ MESSAGE_SUBMIT, take_submit, N_JOB_EVENTS, is_any },
	{ MESSAGE_LIST, take_list, N_JOB_EVENTS, is_any },
	{ MESSAGE_WATCH, take_watch, N_JOB_EVENTS, is_over },
	{ MESSAGE_SUSPEND, take_event, EV_SUSPEND, is_stopped },
	{ MESSAGE_ACTIVATE, take_event, EV_ACTIVATE, is_any },
	{ MESSAGE_KILL, take_event, EV_KILL, is_over },
	{ MESSAGE_HOLD, take_event, EV_HOLD, is_any },
	{ MESSAGE_RELEASE, take_event, EV_RELEASE, is_any },
	{ MESSAGE_RETRY, take_event, EV_RETRY, is_any },
	{ MESSAGE_PRIORITY, take_priority, N_JOB_EVENTS, is_any },
	{ MESSAGE_WAIT, take_wait, N_JOB_EVENTS, is_over },
	{ MESSAGE_LOG, take_log, N_JOB_EVENTS, is_over },
	{ MESSAGE_SHUTDOWN, take_shutdown, N_JOB_EVENTS, NULL },
	{ MESSAGE_PRUNE, take_prune, N_JOB_EVENTS, NULL },
};

static const struct request_row *row_find(enum message_type type)
{
	for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
		if (rows[i].type == type)
			return &rows[i];
	return NULL;
}

/* The queue takes its turn first, so that an answer holds only what is in the ledger. */
void request_take(struct session *c, const struct message *m)
{
	const struct request_row *row = row_find(m->type);
	struct request *q = row ? calloc(1, sizeof *q) : NULL;
	if (!q)
		return;
	q->session = c;
	q->type = m->type;
	q->id = json_int(m->body, "id", 0);
	q->next = c->requests;
	c->requests = q;
	queue_turn(c->server->queue);
	row->take(q, row, m->body);
}

static bool request_names(const struct request *q, const struct Stats *s)
{
	if (!q->jobs)
		return selection_in_group(s, q->group);
	return selection_has(q, s->id);
}

void request_told(struct request *q, const struct Stats *s)
{
	if (q->ended || q->type != MESSAGE_WATCH || !request_names(q, s))
		return;
	if (session_backlog(q->session) > BACKLOG_FULL)
		q->behind = true;
	else
		session_send_job(q->session, q->id, s);
}

/* Have all jobs come to the state that is wanted? What was passed once is not looked at again. */
static bool request_met(struct request *q, const struct request_row *row)
{
	struct queue *jobs = request_queue(q);
	if (q->type == MESSAGE_WATCH && q->stay)
		return false;
	for (; q->jobs && q->at < q->n; q->at++) {
		/* one that is not in memory has ended, and more than that nobody waits for */
		if (!queue_holds(jobs, q->jobs[q->at]))
			continue;
		if (row->wanted(queue_find(jobs, q->jobs[q->at])->state))
			continue;
		if (q->type != MESSAGE_SUSPEND || queue_stopping(jobs, q->jobs[q->at]))
			return false;
		struct report r = request_report(q);
		report_error(&r, ST_RESOURCE,
		             "job %lld goes on: what runs it does not take the order to stop; see "
		             "'batten log %lld'",
		             (long long)q->jobs[q->at], (long long)q->jobs[q->at]);
	}
	for (int i = 0; !q->jobs && i < queue_count(jobs); i++) {
		const struct Stats *s = queue_at(jobs, i);
		if (selection_in_group(s, q->group) && !row->wanted(s->state))
			return false;
	}
	return true;
}

/* Its list was sent, as far as it goes: is there nothing more to say? */
static bool request_met_now(struct request *q, const struct request_row *row)
{
	const char *fault = queue_fault(request_queue(q));
	if (fault && row->event != N_JOB_EVENTS) {
		struct report r = request_report(q);
		report_error(&r, ST_RESOURCE,
		             "it is done or under way, but not kept: %s; make room, the "
		             "service tries again each second",
		             fault);
		return true;
	}
	return !q->behind && request_met(q, row);
}

void request_check(struct request *q)
{
	const struct request_row *row = row_find(q->type);
	if (q->type == MESSAGE_PRUNE && !q->ended)
		prune_go_on(q);
	if (q->ended || !row->wanted)
		return;
	if (q->type == MESSAGE_WATCH && q->behind && session_backlog(q->session) < BACKLOG_FULL / 2)
		watch_all(q);
	if (q->log) {
		if (log_reader_more(q))
			request_end(q);
		return;
	}
	if (!q->met) {
		q->met = request_met_now(q, row);
		if (q->met && q->type != MESSAGE_WATCH)
			list_begin(q);
	}
	if (list_send(q) && q->met)
		request_end(q);
}
