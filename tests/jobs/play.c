/* play.c - what programs that play workers share: a packet out, a packet in. */
#include "play.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "file.h"

static struct message_reader reader = { .ways = TO_WORKER };

const char *play_role(const char *argv0)
{
	const char *name = strrchr(argv0, '/');
	name = name ? name + 1 : argv0;
	return strncmp(name, "batten-", 7) ? name : name + 7;
}

void play_send(enum message_type type, json_t *body)
{
	if (message_send(1, type, body) != ST_OK)
		_exit(3);
	json_decref(body);
}

void play_hello(const char *role)
{
	play_send(MESSAGE_HELLO,
	          json_pack("{s:i, s:s, s:i, s:i, s:s}", "protocol", MESSAGE_PROTOCOL, "worker",
	                    role, "worker_version", 1, "pid", (int)getpid(), "host", "here"));
}

void play_result(const char *path)
{
	play_send(MESSAGE_RESULT, json_pack("{s:s, s:s, s:{s:i}}", "path", path, "kind", "text",
	                                    "figures", "answer", 42));
}

void play_done(void)
{
	play_send(MESSAGE_DONE, json_pack("{s:f}", "wall_s", 0.0));
}

int play_next(struct message *m)
{
	int next;
	while (!(next = message_reader_next(&reader, m))) {
		size_t room;
		char *to = message_reader_room(&reader, 4096, &room);
		ssize_t n = to ? read(0, to, room) : -1;
		if (n <= 0)
			return 0;
		message_reader_filled(&reader, (size_t)n);
	}
	return next;
}

json_t *play_start(void)
{
	struct message m;
	char *text;
	size_t n;
	json_t *job;
	if (play_next(&m) <= 0 || m.type != MESSAGE_START ||
	    file_read(json_text(m.body, "job", ""), 1 << 20, &text, &n, NULL) != ST_OK ||
	    json_parse_object(text, n, "job", &job, NULL) != ST_OK)
		_exit(4);
	free(text);
	message_finish(&m);
	return job;
}

_Noreturn void play_stay(void)
{
	for (;;)
		pause();
}
