/* fuzz_service.c - bytes from a client to the service: packets, requests, queue. The launcher starts
 * nothing, the ledger keeps nothing, the project is an empty folder.
 *
 * What begins with a digit is lines of a packet's number and text, so that what changes in the text keeps
 * the length in the header right. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "server.h"

static enum status find_none(void *data, int64_t id, ledger_job *each, void *each_data,
                             const struct report *r)
{
	(void)data, (void)id, (void)each, (void)each_data, (void)r;
	return ST_OK;
}

static bool text_none(void *data, int64_t id, struct text *out)
{
	(void)data, (void)id, (void)out;
	return false;
}

static enum status choose_none(void *data, const struct ledger_choice *choice, int64_t **ids,
                               size_t *n, const struct report *r)
{
	(void)data, (void)choice, (void)r;
	*ids = NULL;
	*n = 0;
	return ST_OK;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

static enum status check(void *data, const struct Stats *s, const struct report *r)
{
	(void)data;
	(void)r;
	return s->worker ? ST_OK : ST_PARAMETER;
}

static void bury(void *data, const struct Stats *s)
{
	(void)data;
	(void)s;
}

static enum status start(void *data, struct Stats *s, const struct report *r)
{
	(void)data;
	(void)r;
	return s->force ? ST_RESOURCE : ST_OK;
}

static enum status send_nothing(void *data, int64_t id, enum message_type type, const json_t *body)
{
	(void)data;
	(void)id;
	(void)type;
	(void)body;
	return ST_OK;
}

static void signal_nothing(void *data, int64_t id, enum launcher_signal signal)
{
	(void)data;
	(void)id;
	(void)signal;
}

static void note(void *data, int64_t id, const char *level, const char *text)
{
	(void)data;
	(void)id;
	(void)level;
	(void)text;
}

static const char *job_file(void *data, int64_t id)
{
	(void)data;
	(void)id;
	return "";
}

static void forget(void *data, int64_t id)
{
	(void)data;
	(void)id;
}

static enum status write_nothing(void *data, const struct ledger_change *changes, size_t n,
                                 bool durable, const struct report *r)
{
	struct text t = { 0 };
	(void)data;
	(void)durable;
	(void)r;
	for (size_t i = 0; i < n; i++)
		if (changes[i].stats)
			stats_write_brief(&t, changes[i].stats);
	text_finish(&t);
	return ST_OK;
}

static enum status hold(void *data, bool held, const struct report *r)
{
	(void)data;
	(void)held;
	(void)r;
	return ST_OK;
}

static enum status load(void *data, ledger_job *each, void *each_data, int64_t *last, bool *held,
                        const struct report *r)
{
	(void)data;
	(void)each;
	(void)each_data;
	(void)r;
	*last = 0;
	*held = false;
	return ST_OK;
}

static double clock_now(void *data)
{
	(void)data;
	return 1000;
}

static void told(void *data, const struct Stats *s)
{
	struct server *server = data;
	for (struct request *q = server->sessions->requests; q; q = q->next)
		request_told(q, s);
}

static const struct launcher launcher = {
	.check = check,
	.bury = bury,
	.start = start,
	.send = send_nothing,
	.signal = signal_nothing,
	.note = note,
	.job_file = job_file,
	.forget = forget,
};
static const struct queue_limits limits = { .jobs = 2, .threads = 2, .job_threads = 1 };

/* The client's packets, one after the other; the end of each turn is the service's own. */
static void converse(struct session *c, const uint8_t *data, size_t n)
{
	struct message m;
	int got = 0;
	for (size_t at = 0, room; at < n && got >= 0; at += room) {
		char *to = message_reader_room(&c->reader, n - at, &room);
		room = room < n - at ? room : n - at;
		memcpy(to, data + at, room);
		message_reader_filled(&c->reader, room);
		while ((got = message_reader_next(&c->reader, &m)) > 0) {
			/* files and the end of the service are no matter of bytes: test_service */
			const json_t *jobs = json_object_get(m.body, "jobs");
			bool file = false;
			for (size_t i = 0; i < json_array_size(jobs); i++)
				file |= json_is_string(json_array_get(jobs, i));
			if (!file && m.type != MESSAGE_SHUTDOWN && m.type != MESSAGE_LOG)
				request_take(c, &m);
			message_finish(&m);
			queue_turn(c->server->queue);
			for (struct request *q = c->requests; q; q = q->next)
				request_check(q);
		}
	}
}

/* Lines as packets. */
static void encode_lines(const uint8_t *data, size_t n, struct text *out)
{
	for (size_t at = 0; at < n;) {
		const uint8_t *end = memchr(data + at, '\n', n - at);
		size_t next = end ? (size_t)(end - data) + 1 : n, last = end ? next - 1 : n;
		unsigned char head[MESSAGE_HEADER] = { 0 };
		for (; at < last && data[at] >= '0' && data[at] <= '9'; at++)
			head[0] = (unsigned char)(head[0] * 10 + data[at] - '0');
		head[4] = (unsigned char)(last - at);
		head[5] = (unsigned char)((last - at) >> 8);
		text_add_bytes(out, head, sizeof head);
		text_add_bytes(out, data + at, last - at);
		at = next;
	}
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	static const struct project project = { .folder = "/nonexistent",
		                                .hidden = "/nonexistent/.batten",
		                                .socket = "/nonexistent/socket" };
	struct server s = { .project = &project,
		            .clock = { .elapsed = clock_now, .date = clock_now } };
	struct session c = { .server = &s };
	struct ledger ledger = { .write = write_nothing,
		                 .hold = hold,
		                 .load = load,
		                 .find = find_none,
		                 .text = text_none,
		                 .choose = choose_none };
	struct queue_ports ports = { .launcher = &launcher,
		                     .ledger = &ledger,
		                     .clock = &s.clock,
		                     .told = told,
		                     .told_data = &s };
	s.sessions = &c;
	message_reader_init(&c.reader, FROM_CLIENT);
	if (queue_create(&s.queue, &ports, &limits) != ST_OK)
		return 0;
	struct text packets = { 0 };
	if (n && data[0] >= '0' && data[0] <= '9') {
		encode_lines(data, n, &packets);
		data = (const uint8_t *)packets.s;
		n = packets.n;
	}
	converse(&c, data, n);
	text_finish(&packets);
	while (c.requests) {
		struct request *q = c.requests;
		c.requests = q->next;
		request_destroy(q);
	}
	queue_destroy(s.queue);
	message_reader_finish(&c.reader);
	text_finish(&c.out);
	return 0;
}
