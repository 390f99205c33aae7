/* jobs_link.c - one thread watches the service; each request has a short one of its own, for KILL
 * answers only when the job has ended. */
#include "jobs_link.h"

#include <errno.h>
#include <poll.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <time.h>
#include <unistd.h>

#include "client.h"
#include "json.h"

enum { PROGRESS_MS = 250, LOOK_MS = 1000, LOG_BYTES = 1 << 18 };

struct asking {
	struct asking *next;
	struct jobs_link *link; /* borrowed: outlives it */
	pthread_t thread;
	struct client *client; /* owned; NULL until it is connected */
	bool over;             /* to be joined */
	enum message_type type;
	int64_t *ids; /* owned */
	int n;
	struct text log;
};

struct answer {
	struct answer *next;
	struct link_answer a;
};

struct jobs_link {
	const struct project *project; /* borrowed */
	void (*wake)(void *data);
	void *data; /* borrowed */
	pthread_t watcher;
	int bell; /* eventfd: look at leaving and restart */

	pthread_mutex_t mutex; /* of all below */
	struct job_shelf shelf;
	int64_t *changed; /* owned; ids */
	int n_changed, changed_cap;
	enum link_state state;
	char reason[256];
	bool leaving, restart;
	struct asking *askings;
	struct answer *first, **last;

	/* of the watcher alone */
	bool due; /* something to be told of */
	bool urgent;
	double told_at;
};

static double now_s(void)
{
	struct timespec t;

	clock_gettime(CLOCK_MONOTONIC, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ------------------------------------------------------------ watching */

/* The mutex is held. A record that cannot be kept for want of memory comes with its next change. */
static void note_change(struct jobs_link *l, int64_t id)
{
	for (int i = 0; i < l->n_changed; i++)
		if (l->changed[i] == id)
			return;
	if (l->n_changed == l->changed_cap) {
		int cap = l->changed_cap ? 2 * l->changed_cap : 64;
		int64_t *more = reallocarray(l->changed, (size_t)cap, sizeof *more);
		if (!more)
			return;
		l->changed = more;
		l->changed_cap = cap;
	}
	l->changed[l->n_changed++] = id;
}

static bool take_job(void *data, const struct Stats *s)
{
	struct jobs_link *l = data;

	pthread_mutex_lock(&l->mutex);
	const struct Stats *old = job_shelf_find(&l->shelf, s->id);
	l->due = true;
	l->urgent |= !old || old->state != s->state || old->n_outputs != s->n_outputs;
	if (job_shelf_put(&l->shelf, s) == ST_OK)
		note_change(l, s->id);
	bool stay = !l->leaving;
	pthread_mutex_unlock(&l->mutex);
	return stay;
}

static void set_state(struct jobs_link *l, enum link_state state, const char *reason)
{
	pthread_mutex_lock(&l->mutex);
	l->state = state;
	snprintf(l->reason, sizeof l->reason, "%.255s", reason);
	pthread_mutex_unlock(&l->mutex);
	l->wake(l->data);
}

static bool is_leaving(struct jobs_link *l)
{
	pthread_mutex_lock(&l->mutex);
	bool leaving = l->leaving;
	pthread_mutex_unlock(&l->mutex);
	return leaving;
}

/* Tell the window, unless it was told a moment ago; ms until it is due, -1: nothing is. */
static int tell(struct jobs_link *l)
{
	if (!l->due)
		return -1;
	double wait = l->told_at + PROGRESS_MS / 1000. - now_s();
	if (!l->urgent && wait > 0)
		return (int)(1000 * wait) + 1;
	l->due = l->urgent = false;
	l->told_at = now_s();
	l->wake(l->data);
	return -1;
}

static void watch(struct jobs_link *l, struct client *c)
{
	struct report_store store;
	bool ended = false, gone = false;
	json_t *body = json_pack("{s:b}", "stay", 1);

	report_store_init(&store);
	enum status st = client_send(c, MESSAGE_WATCH, body, &store.report);
	set_state(l, LINK_UP, "");
	while (st == ST_OK && !ended && !gone && !is_leaving(l)) {
		int ms = tell(l);
		st = client_listen(c, ms, l->bell, take_job, l, &ended, &gone, &store.report);
		uint64_t rung;
		if (!is_leaving(l) && read(l->bell, &rung, sizeof rung) < 0 && errno != EAGAIN)
			break;
	}
}

/* Wait a while, or until somebody rings. */
static void rest(struct jobs_link *l, int ms)
{
	struct pollfd p = { .fd = l->bell, .events = POLLIN };
	uint64_t rung;

	if (poll(&p, 1, ms) > 0 && read(l->bell, &rung, sizeof rung) < 0)
		return; /* nobody else reads it */
}

static void *watcher_main(void *data)
{
	struct jobs_link *l = data;
	struct report_store store;
	bool start = true;

	while (!is_leaving(l)) {
		struct client *c = NULL;
		report_store_init(&store);
		enum status st = client_connect(&c, l->project, start, &store.report);
		if (st == ST_OK) {
			watch(l, c);
			client_close(c);
			if (!is_leaving(l))
				set_state(l, LINK_GONE, "the job service has ended");
		} else if (start) {
			set_state(l, LINK_GONE, store.error);
		}
		pthread_mutex_lock(&l->mutex);
		start = l->restart;
		l->restart = false;
		pthread_mutex_unlock(&l->mutex);
		if (!start)
			rest(l, LOOK_MS);
		pthread_mutex_lock(&l->mutex);
		start |= l->restart;
		l->restart = false;
		pthread_mutex_unlock(&l->mutex);
	}
	return NULL;
}

/* ------------------------------------------------------------ asking */

static void keep_log(void *data, const char *text)
{
	struct asking *a = data;

	text_add(&a->log, text);
	if (a->log.n > 2 * LOG_BYTES) { /* the end is what is read */
		size_t n = LOG_BYTES;
		memmove(a->log.s, a->log.s + a->log.n - n, n + 1);
		a->log.n = n;
	}
}

static json_t *body_of(const struct asking *a)
{
	if (a->type == MESSAGE_LOG)
		return json_pack("{s:I}", "job", (json_int_t)a->ids[0]);
	json_t *body = json_object(), *ids = json_array();
	for (int i = 0; i < a->n; i++)
		json_array_append_new(ids, json_integer(a->ids[i]));
	json_object_set_new(body, "jobs", ids);
	if (a->type == MESSAGE_KILL)
		json_set_text(body, "by", "you");
	return body;
}

static void answer(struct asking *a, enum status st, const char *error)
{
	struct jobs_link *l = a->link;
	struct answer *n = calloc(1, sizeof *n);

	if (n) {
		n->a = (struct link_answer){ a->type, a->ids[0], a->n, st, NULL };
		n->a.text = st == ST_OK ? text_take(&a->log) : strdup(error);
	}
	pthread_mutex_lock(&l->mutex);
	a->over = true;
	if (n) {
		*l->last = n;
		l->last = &n->next;
	}
	pthread_mutex_unlock(&l->mutex);
	l->wake(l->data);
}

static void *asking_main(void *data)
{
	struct asking *a = data;
	struct jobs_link *l = a->link;
	struct report_store store;
	struct client *c = NULL;

	report_store_init(&store);
	enum status st = client_connect(&c, l->project, false, &store.report);
	pthread_mutex_lock(&l->mutex);
	bool leaving = l->leaving;
	a->client = c;
	pthread_mutex_unlock(&l->mutex);
	/* asked even when leaving: the service does it without anybody who listens */
	if (st == ST_OK && leaving)
		st = client_send(c, a->type, body_of(a), &store.report);
	else if (st == ST_OK)
		st = client_request(c, a->type, body_of(a), NULL, keep_log, a, &store.report);
	answer(a, st, store.error);
	return NULL;
}

/* The mutex is held by nobody else any more, or by the caller. */
static void asking_destroy(struct asking *a)
{
	pthread_join(a->thread, NULL);
	client_close(a->client);
	text_finish(&a->log);
	free(a->ids);
	free(a);
}

static void reap(struct jobs_link *l)
{
	struct asking *over = NULL;

	pthread_mutex_lock(&l->mutex);
	for (struct asking **p = &l->askings; *p;) {
		struct asking *a = *p;
		if (!a->over) {
			p = &a->next;
			continue;
		}
		*p = a->next;
		a->next = over;
		over = a;
	}
	pthread_mutex_unlock(&l->mutex);
	while (over) {
		struct asking *next = over->next;
		asking_destroy(over);
		over = next;
	}
}

enum status jobs_link_ask(struct jobs_link *l, enum message_type type, const int64_t *ids, int n)
{
	if (n < 1)
		return ST_PARAMETER;
	struct asking *a = calloc(1, sizeof *a);
	if (a)
		a->ids = calloc((size_t)n, sizeof *a->ids);
	if (!a || !a->ids) {
		free(a);
		return ST_RESOURCE;
	}
	memcpy(a->ids, ids, (size_t)n * sizeof *ids);
	a->n = n;
	a->type = type;
	a->link = l;
	pthread_mutex_lock(&l->mutex);
	bool begun = pthread_create(&a->thread, NULL, asking_main, a) == 0;
	if (begun) {
		a->next = l->askings;
		l->askings = a;
	}
	pthread_mutex_unlock(&l->mutex);
	if (!begun) {
		free(a->ids);
		free(a);
	}
	return begun ? ST_OK : ST_RESOURCE;
}

bool jobs_link_answer(struct jobs_link *l, struct link_answer *out)
{
	reap(l);
	pthread_mutex_lock(&l->mutex);
	struct answer *a = l->first;
	if (a) {
		l->first = a->next;
		if (!l->first)
			l->last = &l->first;
	}
	pthread_mutex_unlock(&l->mutex);
	if (!a)
		return false;
	*out = a->a;
	free(a);
	return true;
}

void link_answer_finish(struct link_answer *a)
{
	free(a->text);
	a->text = NULL;
}

/* ------------------------------------------------------------ the link */

static void ring(struct jobs_link *l)
{
	uint64_t one = 1;

	if (write(l->bell, &one, sizeof one) != sizeof one)
		return; /* it rings already */
}

enum status jobs_link_create(struct jobs_link **out, const struct project *p,
                             void (*wake)(void *data), void *data, const struct report *r)
{
	struct jobs_link *l = calloc(1, sizeof *l);

	if (!l)
		return report_error(r, ST_RESOURCE, "memory ran out");
	l->project = p;
	l->wake = wake;
	l->data = data;
	l->last = &l->first;
	pthread_mutex_init(&l->mutex, NULL);
	l->bell = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
	if (l->bell < 0 || pthread_create(&l->watcher, NULL, watcher_main, l)) {
		if (l->bell >= 0)
			close(l->bell);
		pthread_mutex_destroy(&l->mutex);
		free(l);
		return report_error(r, ST_RESOURCE, "cannot start a thread to watch the jobs");
	}
	*out = l;
	return ST_OK;
}

void jobs_link_destroy(struct jobs_link *l)
{
	struct link_answer a;

	if (!l)
		return;
	pthread_mutex_lock(&l->mutex);
	l->leaving = true;
	for (struct asking *q = l->askings; q; q = q->next)
		if (q->client && !q->over)
			shutdown(client_descriptor(q->client), SHUT_RD);
	pthread_mutex_unlock(&l->mutex);
	ring(l);
	pthread_join(l->watcher, NULL);
	while (l->askings) {
		struct asking *next = l->askings->next;
		asking_destroy(l->askings);
		l->askings = next;
	}
	while (jobs_link_answer(l, &a))
		link_answer_finish(&a);
	close(l->bell);
	pthread_mutex_destroy(&l->mutex);
	job_shelf_finish(&l->shelf);
	free(l->changed);
	free(l);
}

int jobs_link_take(struct jobs_link *l, struct job_shelf *shelf, enum link_state *state,
                   char reason[256])
{
	int n = 0;

	pthread_mutex_lock(&l->mutex);
	for (int i = 0; i < l->n_changed; i++) {
		const struct Stats *s = job_shelf_find(&l->shelf, l->changed[i]);
		n += s && job_shelf_put(shelf, s) == ST_OK;
	}
	l->n_changed = 0;
	*state = l->state;
	memcpy(reason, l->reason, sizeof l->reason);
	pthread_mutex_unlock(&l->mutex);
	return n;
}

void jobs_link_restart(struct jobs_link *l)
{
	pthread_mutex_lock(&l->mutex);
	l->restart = true;
	pthread_mutex_unlock(&l->mutex);
	ring(l);
}
