/* log_reader.c - a job's log, sent in pieces; followed while the job lives. */
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "json.h"
#include "server.h"

/* a piece stays a packet even when every byte of it must be escaped */
enum { PIECE = 8192, BACKLOG_PAUSE = 256 << 10 };

struct log_reader {
	uv_fs_event_t event;
	int fd; /* -1: not there yet */
	off_t at;
	bool follow, watching;
};

static void on_closed(uv_handle_t *h)
{
	free(h->data);
}

/* What changes the file wakes the loop; the check at the end of the turn reads it. */
static void on_event(uv_fs_event_t *e, const char *name, int events, int status)
{
	(void)e;
	(void)name;
	(void)events;
	(void)status;
}

enum status log_reader_create(struct request *q, bool follow)
{
	struct log_reader *l = calloc(1, sizeof *l);
	if (!l)
		return ST_RESOURCE;
	l->fd = -1;
	l->follow = follow;
	l->event.data = l;
	uv_fs_event_init(&q->session->server->loop, &l->event);
	q->log = l;
	return ST_OK;
}

void log_reader_destroy(struct log_reader *l)
{
	if (!l)
		return;
	if (l->fd >= 0)
		close(l->fd);
	uv_close((uv_handle_t *)&l->event, on_closed);
}

static void log_open(struct log_reader *l, const char *path)
{
	if (l->fd >= 0 || !path)
		return;
	l->fd = open(path, O_RDONLY | O_CLOEXEC);
	if (l->fd >= 0 && l->follow && !uv_fs_event_start(&l->event, on_event, path, 0))
		l->watching = true;
}

/* Length of the UTF-8 character at p, 0 where there is none, -1 where n bytes may be its beginning. */
static int character(const unsigned char *p, size_t n)
{
	static const unsigned least[] = { 0, 0, 0x80, 0x800, 0x10000 };
	int length = *p < 0x80 ? 1 : *p >= 0xF0 ? 4 : *p >= 0xE0 ? 3 : 2;
	unsigned code = length == 1 ? *p : *p & (0xFFu >> (length + 1));
	if (*p == 0 || (*p >= 0x80 && *p < 0xC2) || *p > 0xF4)
		return 0;
	for (int i = 1; i < length; i++) {
		if ((size_t)i >= n)
			return -1;
		if ((p[i] & 0xC0) != 0x80)
			return 0;
		code = code << 6 | (p[i] & 0x3F);
	}
	if (code < least[length] || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000))
		return 0;
	return length;
}

/* Bytes that are no characters become '?'. Returns how many were taken; the beginning of a character
 * waits for its rest, except at the end of all. */
static size_t piece_text(struct text *out, const char *p, size_t n, bool last)
{
	size_t i = 0;
	while (i < n) {
		int length = character((const unsigned char *)p + i, n - i);
		if (length < 0 && !last)
			break;
		text_add_bytes(out, length > 0 ? p + i : "?", length > 0 ? (size_t)length : 1);
		i += length > 0 ? (size_t)length : 1;
	}
	return i;
}

static bool piece_send(struct request *q, bool over)
{
	struct log_reader *l = q->log;
	char bytes[PIECE];
	struct stat s;
	if (l->fd < 0)
		return false;
	if (!fstat(l->fd, &s) && s.st_size < l->at)
		l->at = 0; /* it was cut */
	ssize_t n = pread(l->fd, bytes, sizeof bytes, l->at);
	if (n <= 0)
		return false;
	struct text t = { 0 };
	size_t used = piece_text(&t, bytes, (size_t)n, over && (size_t)n < sizeof bytes);
	l->at += (off_t)used;
	if (t.n) {
		json_t *o = json_object();
		json_set_int(o, "id", q->id);
		json_set_text(o, "text", t.s);
		session_send(q->session, MESSAGE_TEXT, o);
	}
	text_finish(&t);
	return used > 0;
}

bool log_reader_more(struct request *q)
{
	struct log_reader *l = q->log;
	const struct Stats *s = queue_find(q->session->server->queue, q->jobs[0]);
	bool over = !l->follow || !s || job_state_table[s->state].over;
	if (s)
		log_open(l, s->log);
	while (session_backlog(q->session) < BACKLOG_PAUSE)
		if (!piece_send(q, over))
			return over;
	return false;
}
