/* bad_worker.c - plays the worker that nobody wants, by the role that its name says. */
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "play.h"

static void greet(void)
{
	play_hello("bad");
	json_decref(play_start());
}

static void put(const void *p, size_t n)
{
	if (write(1, p, n) != (ssize_t)n)
		_exit(3);
}

static void silent(void)
{
	play_stay();
}

static void crash(void)
{
	const struct rlimit none = { 0 };
	greet();
	setrlimit(RLIMIT_CORE, &none);
	signal(SIGSEGV, SIG_DFL);
	raise(SIGSEGV);
}

static void early(void)
{
	_exit(9);
}

static void quits(void)
{
	greet();
	_exit(7);
}

static void lazy(void)
{
	greet(); /* no RESULT, no DONE, status 0 */
}

static void undone(void)
{
	greet();
	play_done(); /* DONE without RESULT */
}

static void lies(void)
{
	greet();
	play_result("/nowhere");
	play_done();
	_exit(5); /* DONE, and then a status that says otherwise */
}

static void flood(void)
{
	struct text one = { 0 }, many = { 0 };
	greet();
	message_encode(&one, MESSAGE_PROGRESS, json_pack("{s:i, s:i}", "done", 1, "total", 2));
	while (many.n + one.n < 60000)
		text_add_bytes(&many, one.s, one.n);
	for (;;)
		put(many.s, many.n);
}

static void notes(void)
{
	greet();
	for (;;)
		play_send(MESSAGE_NOTE,
		          json_pack("{s:s, s:s}", "level", "info", "text", "and another thing"));
}

static void garbage(void)
{
	greet();
	put("this is no packet at all", 24);
	play_stay();
}

static void json(void)
{
	static const unsigned char packet[] = {
		2, 0, 0, 0, 6, 0, 0, 0, '{', '"', 'd', '"', ':', '}'
	};
	greet();
	put(packet, sizeof packet);
	play_stay();
}

static void unknown(void)
{
	static const unsigned char packet[8] = { 99, 0, 0, 0, 0, 0, 0, 0 };
	greet();
	put(packet, sizeof packet);
	play_stay();
}

static void huge(void)
{
	static const unsigned char packet[8] = { 2, 0, 0, 0, 0xFF, 0xFF, 0xFF, 0x7F };
	greet();
	put(packet, sizeof packet);
	play_stay();
}

static void half(void)
{
	static const unsigned char packet[] = { 2, 0, 0, 0, 60, 0, 0, 0, '{', '"' };
	greet();
	put(packet, sizeof packet);
}

static void closes(void)
{
	greet();
	close(1);
	play_stay();
}

static void mute(void)
{
	close(1); /* before HELLO */
	play_stay();
}

static void stubborn(void)
{
	signal(SIGTERM, SIG_IGN);
	signal(SIGINT, SIG_IGN);
	greet();
	play_stay();
}

static void older(void)
{
	play_send(MESSAGE_HELLO, json_pack("{s:i}", "protocol", MESSAGE_PROTOCOL + 1));
	play_stay();
}

static void hasty(void)
{
	play_send(MESSAGE_PROGRESS, json_pack("{s:i, s:i}", "done", 1, "total", 2));
	play_stay();
}

static void twice(void)
{
	greet();
	play_hello("bad");
	play_stay();
}

static void error(void)
{
	greet();
	play_send(MESSAGE_ERROR, json_pack("{s:s, s:s}", "class", "input", "text",
	                                   "surface 3 is a point; take it out"));
	_exit(1);
}

static void lingers(void)
{
	greet();
	play_result("/nowhere");
	play_done();
	play_stay();
}

/* Leaves a child in its group that holds the pipe and ignores what it is told. */
static void grandchild(void)
{
	greet();
	int ready[2];
	char byte;
	if (pipe(ready))
		_exit(3);
	if (fork() == 0) {
		signal(SIGTERM, SIG_IGN);
		fprintf(stderr, "child %ld\n", (long)getpid());
		if (write(ready[1], "x", 1) != 1)
			_exit(3);
		play_stay();
	}
	if (read(ready[0], &byte, 1) != 1)
		_exit(3);
	play_result("/nowhere");
	play_done();
}

/* Its child went to a session of its own and holds the pipe beyond all reach. */
static void escapes(void)
{
	greet();
	if (fork() == 0) {
		setsid();
		int fd = open("escaped.fifo", O_RDONLY); /* until the test lets it go */
		_exit(fd < 0);
	}
	play_result("/nowhere");
	play_done();
}

/* It waits in vfork, where no stop reaches it, for a child that a stop reaches. */
static void begets(void)
{
	greet();
	play_send(MESSAGE_PROGRESS, json_pack("{s:i, s:i}", "done", 1, "total", 2));
	pid_t child = vfork();
	if (child == 0) {
		sleep(1);
		execl("/bin/sleep", "sleep", "60", (char *)NULL);
		_exit(127);
	}
	play_stay();
}

static void babbles(void)
{
	static char line[65536];
	greet();
	memset(line, 'b', sizeof line - 1);
	line[sizeof line - 1] = '\n';
	for (int i = 0; i < 400; i++)
		if (write(2, line, sizeof line) < 0)
			_exit(3);
	play_stay();
}

/* What the starter has set. */
static void shows(void)
{
	struct rlimit data, core;
	int n = 0, parent = 0;
	greet();
	getrlimit(RLIMIT_DATA, &data);
	getrlimit(RLIMIT_CORE, &core);
	prctl(PR_GET_PDEATHSIG, &parent);
	for (int fd = 3; fd < 256; fd++)
		n += fcntl(fd, F_GETFD) >= 0;
	fprintf(stderr,
	        "nice %d, data %llu, core %llu, death %d, group %d, open %d, blas %s, here %d\n",
	        getpriority(PRIO_PROCESS, 0), (unsigned long long)data.rlim_cur >> 20,
	        (unsigned long long)core.rlim_cur, parent, getpgrp() == getpid(), n,
	        getenv("OPENBLAS_NUM_THREADS"), !access(".batten", F_OK));
	play_result("/dev/null");
	play_done();
}

static const struct {
	const char *name;
	void (*play)(void);
} roles[] = {
	{ "babbles", babbles },
	{ "begets", begets },
	{ "closes", closes },
	{ "crash", crash },
	{ "early", early },
	{ "error", error },
	{ "escapes", escapes },
	{ "flood", flood },
	{ "garbage", garbage },
	{ "half", half },
	{ "grandchild", grandchild },
	{ "hasty", hasty },
	{ "huge", huge },
	{ "json", json },
	{ "lazy", lazy },
	{ "lies", lies },
	{ "lingers", lingers },
	{ "mute", mute },
	{ "notes", notes },
	{ "older", older },
	{ "quits", quits },
	{ "shows", shows },
	{ "silent", silent },
	{ "stubborn", stubborn },
	{ "twice", twice },
	{ "undone", undone },
	{ "unknown", unknown },
};

int main(int argc, char **argv)
{
	const char *role = play_role(argv[0]);
	if (argc > 1 && !strcmp(argv[1], "--describe")) {
		if (!strcmp(role, "silent"))
			play_stay();
		if (!strcmp(role, "flood"))
			for (;;)
				put("{{{{{{{{{{{{{{{{", 16);
		printf("{\"name\":\"%s\",\"version\":1,\"parameters\":[]}\n",
		       strcmp(role, "lies") ? role : "truth");
		return strcmp(role, "quits") ? 0 : 7;
	}
	for (size_t i = 0; i < sizeof roles / sizeof *roles; i++)
		if (!strcmp(role, roles[i].name))
			roles[i].play();
	return 0;
}
