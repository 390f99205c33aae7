/* session.c - a connection from a client: its packets in and out. */
#include <malloc.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "json.h"
#include "server.h"

enum { READ_BYTES = 65536, TRIM_BYTES = 1 << 16 };

static void on_closed(uv_handle_t *h)
{
	struct session *c = h->data;
	struct server *s = c->server;
	s->stretched |= c->out.cap + c->flying.cap > TRIM_BYTES;
	message_reader_finish(&c->reader);
	text_finish(&c->out);
	text_finish(&c->flying);
	free(c);
	if (s->stretched && !s->sessions) {
		malloc_trim(0); /* or the service stays as large as it once was */
		s->stretched = false;
	}
}

void session_close(struct session *c)
{
	if (c->closing)
		return;
	c->closing = true;
	struct session **at = &c->server->sessions;
	while (*at != c)
		at = &(*at)->next;
	*at = c->next;
	while (c->requests) {
		struct request *q = c->requests;
		c->requests = q->next;
		request_destroy(q);
	}
	uv_close((uv_handle_t *)&c->pipe, on_closed);
}

size_t session_backlog(const struct session *c)
{
	return c->out.n + c->flying.n;
}

void session_send(struct session *c, enum message_type type, json_t *body)
{
	if (message_encode(&c->out, type, body) == ST_INTERNAL) {
		/* only a sentence could be so long */
		json_set_text(body, "text", "the answer is too long for a packet");
		message_encode(&c->out, type, body);
	}
	json_decref(body);
}

/* {"id":ID,"job":{...}} behind its header, straight to what is sent: long lists are. False, and nothing:
 * too long for a packet, or there is no such job. */
static bool packet_end(struct text *t, size_t begin, bool there)
{
	text_add(t, "}");
	size_t n = t->n - begin - MESSAGE_HEADER;
	if (t->failed)
		return true;
	if (!there || n > MESSAGE_TEXT_MAX) {
		t->n = begin;
		t->s[begin] = '\0';
		return false;
	}
	for (int i = 0; i < 4; i++) {
		t->s[begin + (size_t)i] = (char)((uint32_t)MESSAGE_JOB >> 8 * i);
		t->s[begin + 4 + (size_t)i] = (char)((uint32_t)n >> 8 * i);
	}
	return true;
}

static size_t packet_begin(struct text *t, int64_t id)
{
	static const char header[MESSAGE_HEADER];
	size_t begin = t->n;
	text_add_bytes(t, header, sizeof header);
	text_addf(t, "{\"id\":%lld,\"job\":", (long long)id);
	return begin;
}

static bool send_stats(struct session *c, int64_t id, const struct Stats *s)
{
	size_t begin = packet_begin(&c->out, id);
	stats_write_brief(&c->out, s);
	return packet_end(&c->out, begin, true);
}

static const char too_long[] = "its record is too long to be shown; see '.batten/jobs.db'";

/* A record too long for a packet leaves out what the client can do without, last what it has made. */
void session_send_job(struct session *c, int64_t id, const struct Stats *s)
{
	struct Stats brief = *s;
	if (send_stats(c, id, s))
		return;
	brief.n_inputs = brief.n_after = brief.n_after_any = 0;
	brief.parameters = NULL;
	if (send_stats(c, id, &brief))
		return;
	brief.n_outputs = 0;
	if (send_stats(c, id, &brief))
		return;
	/* texts of a client's own making: the job is named, at least */
	const struct Stats least = { .id = s->id,
		                     .state = s->state,
		                     .eta_s = NAN,
		                     .wall_s = NAN,
		                     .suspended_s = NAN,
		                     .cpu_s = NAN,
		                     .peak_kib = -1,
		                     .bytes = -1,
		                     .umask = -1,
		                     .ended = s->ended,
		                     .reason = (char *)(size_t)too_long };
	send_stats(c, id, &least);
}

void session_send_record(struct session *c, int64_t id, int64_t job, bool full)
{
	struct queue *q = c->server->queue;
	size_t begin = packet_begin(&c->out, id);
	bool there = queue_write(q, job, full, &c->out);
	if (packet_end(&c->out, begin, there) || !there)
		return;
	const struct Stats *s = queue_find(q, job);
	if (s)
		session_send_job(c, id, s);
}

static void on_written(uv_write_t *w, int status)
{
	struct session *c = w->data;
	c->writing = false;
	text_reset(&c->flying);
	if (status < 0)
		session_close(c);
}

/* One write a turn for all that the turn said; the rest waits for that write. */
void session_flush(struct session *c)
{
	if (c->out.failed || session_backlog(c) > BACKLOG_MAX) {
		session_close(c);
		return;
	}
	if (c->closing || c->writing || !c->out.n)
		return;
	struct text t = c->flying;
	c->flying = c->out;
	c->out = t;
	uv_buf_t b = uv_buf_init(c->flying.s, (unsigned)c->flying.n);
	c->write.data = c;
	c->writing = true;
	if (uv_write(&c->write, (uv_stream_t *)&c->pipe, &b, 1, on_written))
		session_close(c);
}

static void greet(struct session *c, const struct message *m)
{
	int64_t protocol = json_int(m->body, "protocol", 0);
	json_t *o = json_object();
	json_set_int(o, "protocol", MESSAGE_PROTOCOL);
	json_set_text(o, "program", "batten");
	json_set_text(o, "version", BATTEN_VERSION);
	json_set_int(o, "pid", getpid());
	session_send(c, MESSAGE_HELLO, o);
	c->greeted = m->type == MESSAGE_HELLO && protocol == MESSAGE_PROTOCOL;
	if (c->greeted)
		return;
	o = json_object();
	json_set_text(o, "class", status_class(ST_INPUT));
	json_set_text(o, "text",
	              "the service that runs here speaks another protocol; run 'batten shutdown'");
	session_send(c, MESSAGE_ERROR, o);
}

static void take(struct session *c, const struct message *m)
{
	/* SHUTDOWN is understood from every version, so that it can be followed */
	if (!c->greeted && m->type != MESSAGE_SHUTDOWN)
		greet(c, m);
	else
		request_take(c, m);
}

static void on_room(uv_handle_t *h, size_t suggested, uv_buf_t *b)
{
	struct session *c = h->data;
	size_t room = 0;
	(void)suggested;
	char *to = message_reader_room(&c->reader, READ_BYTES, &room);
	*b = uv_buf_init(to, (unsigned)(room < READ_BYTES ? room : READ_BYTES));
}

static void on_read(uv_stream_t *stream, ssize_t n, const uv_buf_t *b)
{
	struct session *c = stream->data;
	struct message m;
	int next = 0;
	(void)b;
	if (n < 0) {
		session_close(c);
		return;
	}
	message_reader_filled(&c->reader, (size_t)n);
	while (!c->closing && (next = message_reader_next(&c->reader, &m)) > 0) {
		take(c, &m);
		message_finish(&m);
	}
	if (next < 0)
		session_close(c);
}

/* The folder keeps others out; this keeps out those whom the folder's owner let in. */
static bool is_ours(const struct session *c)
{
	struct ucred peer;
	socklen_t size = sizeof peer;
	int fd;
	return !uv_fileno((const uv_handle_t *)&c->pipe, &fd) &&
	       !getsockopt(fd, SOL_SOCKET, SO_PEERCRED, &peer, &size) && peer.uid == geteuid();
}

void session_accept(struct server *s)
{
	struct session *c = calloc(1, sizeof *c);
	if (!c)
		return;
	c->server = s;
	uv_pipe_init(&s->loop, &c->pipe, 0);
	c->pipe.data = c;
	message_reader_init(&c->reader, FROM_CLIENT);
	c->next = s->sessions;
	s->sessions = c;
	if (uv_accept((uv_stream_t *)&s->listener, (uv_stream_t *)&c->pipe) || !is_ours(c) ||
	    uv_read_start((uv_stream_t *)&c->pipe, on_room, on_read))
		session_close(c);
}
