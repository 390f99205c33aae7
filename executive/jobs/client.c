/* client.c - a connection to the service. */
#include "client.h"

#include <errno.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/pidfd.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "json.h"
#include "last_words.h"
#include "lock.h"
#include "path.h"
#include "service_start.h"
#include "text.h"

enum { HELLO_MS = 10000, READ_BYTES = 1 << 16, STARTS = 3, SHUTDOWN_MS = 10000 };

static const char went_away[] = "the service went away; the next job verb starts it again";

struct client {
	int fd;
	int64_t last_id;
	bool gone; /* the service closed the connection */
	struct message_reader reader;
};

/* ------------------------------------------------------------ connecting */

static enum status open_socket(int *out, const char *path, const struct report *r)
{
	struct sockaddr_un address = { .sun_family = AF_UNIX };
	struct ucred peer;
	socklen_t size = sizeof peer;

	if (strlen(path) >= sizeof address.sun_path)
		return report_error(r, ST_RESOURCE, "the socket's path '%s' is too long", path);
	strcpy(address.sun_path, path);
	int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
	if (fd < 0)
		return report_error(r, ST_RESOURCE, "cannot make a socket: %s", strerror(errno));
	if (connect(fd, (struct sockaddr *)&address, sizeof address)) {
		close(fd);
		return ST_CANCELLED; /* nobody there: the caller knows what to do */
	}
	if (getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &peer, &size) || peer.uid != getuid()) {
		close(fd);
		return report_error(r, ST_INPUT, "the service at '%s' belongs to another user",
		                    path);
	}
	*out = fd;
	return ST_OK;
}

/* ------------------------------------------------------------ packets */

/* Take in what has come, waiting at most ms for it. 1 something came, 0 the time is out or fd is
 * readable, -1 the service is gone. */
static int take_in(struct client *c, int ms, int fd)
{
	struct pollfd p[2] = { { .fd = c->fd, .events = POLLIN }, { .fd = fd, .events = POLLIN } };
	int n = poll(p, fd >= 0 ? 2 : 1, ms);
	size_t room;

	if (n <= 0 || !p[0].revents)
		return 0;
	char *to = message_reader_room(&c->reader, READ_BYTES, &room);
	if (!to)
		return -1;
	ssize_t got = read(c->fd, to, room);
	if (got < 0 && errno == EINTR)
		return 0;
	if (got <= 0)
		return -1;
	message_reader_filled(&c->reader, (size_t)got);
	return 1;
}

/* The next packet, waiting for it. */
static enum status next_packet(struct client *c, struct message *m, int ms, const struct report *r)
{
	for (;;) {
		int got = message_reader_next(&c->reader, m);
		if (got > 0)
			return ST_OK;
		if (got < 0)
			return report_error(r, ST_INTERNAL, "the service sent no packet: %s",
			                    c->reader.reason);
		int came = take_in(c, ms, -1);
		c->gone |= came < 0;
		if (came < 0)
			return report_error(r, ST_RESOURCE, "%s", went_away);
		if (!came && ms >= 0)
			return report_error(
			        r, ST_RESOURCE,
			        "the service does not answer; see .batten/logs/service.log");
	}
}

/* ST_CANCELLED: it ended before it answered. */
static enum status say_hello(struct client *c, const struct report *r)
{
	struct report_store store;
	struct message m;
	json_t *body = json_pack("{s:i, s:s, s:s, s:i}", "protocol", MESSAGE_PROTOCOL, "program",
	                         "batten", "version", BATTEN_VERSION, "pid", (int)getpid());
	enum status st = message_send(c->fd, MESSAGE_HELLO, body);

	json_decref(body);
	if (st != ST_OK)
		return ST_CANCELLED;
	report_store_init(&store);
	st = next_packet(c, &m, HELLO_MS, &store.report);
	if (st != ST_OK)
		return c->gone ? ST_CANCELLED : report_error(r, st, "%s", store.error);
	if (m.type != MESSAGE_HELLO ||
	    json_int(m.body, "protocol", MESSAGE_PROTOCOL) != MESSAGE_PROTOCOL)
		st = report_error(r, ST_INPUT,
		                  "the service that runs here is of another version (%s); run "
		                  "`batten shutdown`",
		                  json_text(m.body, "version", "unknown"));
	message_finish(&m);
	return st;
}

/* ST_CANCELLED: nobody listens, or who did was just ending. */
static enum status connect_at(struct client **out, const char *path, const struct report *r)
{
	int fd = -1;
	enum status st = open_socket(&fd, path, r);
	if (st != ST_OK)
		return st;
	struct client *c = calloc(1, sizeof *c);
	if (!c) {
		close(fd);
		return report_error(r, ST_RESOURCE, "memory ran out");
	}
	c->fd = fd;
	message_reader_init(&c->reader, FROM_SERVICE);
	st = say_hello(c, r);
	if (st == ST_OK)
		*out = c;
	else
		client_close(c);
	return st;
}

/* Where it should listen, else where it says it does. */
static enum status connect_once(struct client **out, const struct project *p,
                                const struct report *r)
{
	enum status st = connect_at(out, p->socket, r);
	char *other = st == ST_CANCELLED ? lock_socket(p) : NULL;

	if (other && strcmp(other, p->socket))
		st = connect_at(out, other, r);
	free(other);
	return st;
}

enum status client_connect(struct client **out, const struct project *p, bool start,
                           const struct report *r)
{
	enum status st = connect_once(out, p, r);
	char *log = st == ST_CANCELLED && start ? path_join(p->hidden, "logs/service.log") : NULL;
	int64_t mark = log ? last_words_mark(log) : 0;

	for (int tries = 0; st == ST_CANCELLED && start && tries < STARTS; tries++) {
		st = service_start(p, r);
		if (st == ST_OK)
			st = connect_once(out, p, r);
	}
	char *words = st == ST_CANCELLED && log ? last_words(log, mark) : NULL;
	free(log);
	if (words)
		st = report_error(r, ST_RESOURCE, "the service cannot begin: %s", words);
	free(words);
	if (st == ST_CANCELLED && start)
		return report_error(r, ST_RESOURCE,
		                    "the service ended at once; see '%s/logs/service.log'",
		                    p->hidden);
	if (st == ST_CANCELLED)
		return report_error(r, ST_RESOURCE, "no service runs in '%s'", p->folder);
	return st;
}

/* A descriptor that becomes readable when the process at the other end is gone; -1: not to be had. */
static int peer_open(int fd)
{
	struct ucred peer;
	socklen_t size = sizeof peer;

	if (getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &peer, &size) || peer.pid < 1)
		return -1;
	return pidfd_open(peer.pid, 0);
}

/* Wait until the connection ends, then until the process has: only then the ledger is closed. */
static bool wait_gone(int fd, int peer)
{
	struct pollfd there = { .fd = fd, .events = POLLIN };
	struct pollfd process = { .fd = peer, .events = POLLIN };
	char bytes[4096];
	bool open = true;

	while (open && poll(&there, 1, SHUTDOWN_MS) > 0)
		open = read(fd, bytes, sizeof bytes) > 0;
	return !open && (peer < 0 || poll(&process, 1, SHUTDOWN_MS) > 0);
}

/* Where it should listen, else where it says it does. */
static enum status open_listening(int *fd, const struct project *p, const struct report *r)
{
	enum status st = open_socket(fd, p->socket, r);
	char *other = st == ST_CANCELLED ? lock_socket(p) : NULL;

	if (other && strcmp(other, p->socket))
		st = open_socket(fd, other, r);
	free(other);
	return st;
}

/* SHUTDOWN is the one request that is understood before HELLO, and its number never changes. */
enum status client_shutdown(const struct project *p, bool *ran, const struct report *r)
{
	int fd = -1;
	enum status st = open_listening(&fd, p, r);

	/* one that is just beginning will listen, one that is just ending will be gone */
	if (st == ST_CANCELLED && lock_is_deaf(p, SHUTDOWN_MS))
		st = open_listening(&fd, p, r);
	*ran = st == ST_OK;
	if (st != ST_OK)
		return st == ST_CANCELLED ? ST_OK : st;
	int peer = peer_open(fd);
	json_t *body = json_pack("{s:i}", "id", 1);
	message_send(fd, MESSAGE_SHUTDOWN, body); /* not taken by one that is ending already */
	json_decref(body);
	bool gone = wait_gone(fd, peer);
	close(fd);
	if (peer >= 0)
		close(peer);
	if (!gone)
		return report_error(
		        r, ST_RESOURCE,
		        "the service did not end within %d s; see '%s/logs/service.log'",
		        SHUTDOWN_MS / 1000, p->hidden);
	return ST_OK;
}

void client_close(struct client *c)
{
	if (!c)
		return;
	close(c->fd);
	message_reader_finish(&c->reader);
	free(c);
}

int client_descriptor(const struct client *c)
{
	return c->fd;
}

/* ------------------------------------------------------------ requests */

enum status client_send(struct client *c, enum message_type type, json_t *body,
                        const struct report *r)
{
	json_set_int(body, "id", ++c->last_id);
	enum status st = message_send(c->fd, type, body);

	json_decref(body);
	if (st == ST_INTERNAL)
		return report_error(r, ST_PARAMETER, "the request is too long; name fewer jobs");
	return st == ST_OK ? ST_OK : report_error(r, st, "the service went away; try again");
}

/* Hand one packet on. *end: the request is over. Packets of other requests are passed over. */
static enum status deliver(struct client *c, const struct message *m, client_job *on_job,
                           void (*on_text)(void *data, const char *text), void *data, bool *end,
                           const struct report *r)
{
	struct Stats s;

	if (json_int(m->body, "id", c->last_id) != c->last_id)
		return ST_OK;
	switch (m->type) {
	case MESSAGE_END:
		*end = true;
		return ST_OK;
	case MESSAGE_ERROR:
		*end = true;
		return report_error(r, status_from_class(json_text(m->body, "class", "")), "%s",
		                    json_text(m->body, "text", "no reason was given"));
	case MESSAGE_TEXT:
		if (on_text)
			on_text(data, json_text(m->body, "text", ""));
		return ST_OK;
	case MESSAGE_JOB:
		if (!on_job)
			return ST_OK;
		if (stats_from_json(&s, json_object_get(m->body, "job")) != ST_OK)
			return report_error(r, ST_INTERNAL, "the service sent a job that is none");
		*end = !on_job(data, &s);
		stats_finish(&s);
		return ST_OK;
	default:
		return ST_OK;
	}
}

enum status client_request(struct client *c, enum message_type type, json_t *body,
                           client_job *on_job, void (*on_text)(void *data, const char *text),
                           void *data, const struct report *r)
{
	enum status st = client_send(c, type, body, r);
	bool end = false;

	while (st == ST_OK && !end) {
		struct message m;
		st = next_packet(c, &m, -1, r);
		if (st != ST_OK)
			break;
		st = deliver(c, &m, on_job, on_text, data, &end, r);
		message_finish(&m);
	}
	return st;
}

/* The record in {"id":ID,"job":RECORD} as it is, where it is one with all its fields. */
static bool record_whole(const char *text, size_t n, const char **record, size_t *length)
{
	static const char key[] = "\"job\":", full[] = "\"color\":\"#";
	const char *begin = memmem(text, n < 64 ? n : 64, key, sizeof key - 1);
	if (!begin || n < sizeof key || text[n - 1] != '}')
		return false;
	*record = begin + sizeof key - 1;
	*length = (size_t)(text + n - 1 - *record);
	return memmem(*record, *length, full, sizeof full - 1);
}

/* One without: as it lies in the ledger, or from a service of before. */
static bool record_write(const char *text, size_t n, struct text *out)
{
	struct Stats s;
	json_t *o = json_loadb(text, n, 0, NULL);
	bool good = stats_from_json(&s, json_object_get(o, "job")) == ST_OK;
	if (good)
		stats_write(out, &s);
	stats_finish(&s);
	json_decref(o);
	return good;
}

struct listing {
	client_record *on_record;
	void *data;
	struct text made; /* a record that came without all its fields */
};

/* What is there of the list; what is missing is waited for. */
static enum status list_on(struct client *c, struct listing *l, bool *end, const struct report *r)
{
	const char *text, *record;
	struct message m;
	size_t n, length;

	while (!*end && message_reader_text(&c->reader, MESSAGE_JOB, &text, &n)) {
		if (!record_whole(text, n, &record, &length)) {
			text_reset(&l->made);
			if (!record_write(text, n, &l->made) || l->made.failed)
				return report_error(r, ST_INTERNAL,
				                    "the service sent a job that is none");
			record = l->made.s;
			length = l->made.n;
		}
		*end = !l->on_record(l->data, record, length);
	}
	if (*end)
		return ST_OK;
	int got = message_reader_next(&c->reader, &m);
	if (got < 0)
		return report_error(r, ST_INTERNAL, "the service sent no packet: %s",
		                    c->reader.reason);
	if (!got)
		return take_in(c, -1, -1) < 0 ? report_error(r, ST_RESOURCE, "%s", went_away)
		                              : ST_OK;
	enum status st = deliver(c, &m, NULL, NULL, NULL, end, r);
	message_finish(&m);
	return st;
}

enum status client_list(struct client *c, json_t *body, client_record *on_record, void *data,
                        const struct report *r)
{
	struct listing l = { .on_record = on_record, .data = data };
	bool end = false;

	json_object_set_new(body, "full", json_true());
	enum status st = client_send(c, MESSAGE_LIST, body, r);
	while (st == ST_OK && !end)
		st = list_on(c, &l, &end, r);
	text_finish(&l.made);
	return st;
}

enum status client_listen(struct client *c, int timeout_ms, int fd, client_job *on_job, void *data,
                          bool *ended, bool *gone, const struct report *r)
{
	enum status st = ST_OK;
	struct message m;
	int got;

	if (take_in(c, timeout_ms, fd) < 0)
		*ended = *gone = true;
	while (st == ST_OK && (got = message_reader_next(&c->reader, &m)) != 0) {
		if (got < 0)
			return report_error(r, ST_INTERNAL, "the service sent no packet: %s",
			                    c->reader.reason);
		st = deliver(c, &m, on_job, NULL, data, ended, r);
		message_finish(&m);
	}
	return st;
}
