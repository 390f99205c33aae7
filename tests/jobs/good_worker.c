/* good_worker.c - a worker as it should be, that takes a step when it is told to.
 *
 * Parameters: units (how many steps; default 0), gate (a FIFO; each byte in it is leave for one step;
 * without it every step is free). Each step done is a byte in the part file. The output is the name
 * given, with ".txt", holding as many bytes as there were steps.
 *
 * As batten-nothing it does nothing at all; as batten-burst it makes `units` packets as fast as it can.
 */
#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "file.h"
#include "number.h"
#include "play.h"
#include "text.h"

static const char description[] =
        "{\"name\":\"%s\",\"title\":\"steps\",\"version\":1,\"inputs\":{},\"parameters\":["
        "{\"name\":\"units\",\"type\":\"integer\",\"default\":\"0\",\"min\":0,\"max\":1000},"
        "{\"name\":\"gate\",\"type\":\"text\"}],\"outputs\":[{\"extension\":\".txt\",\"kind\":\"text\"}]}\n";

static void progress(int64_t done, int64_t units)
{
	play_send(MESSAGE_PROGRESS, json_pack("{s:I, s:I, s:s}", "done", (json_int_t)done, "total",
	                                      (json_int_t)units, "phase", "steps"));
}

/* Leave for a step, or false: it is to stop. */
static bool may_step(int gate)
{
	struct pollfd p[2] = { { .fd = 0, .events = POLLIN }, { .fd = gate, .events = POLLIN } };
	char byte;
	for (;;) {
		if (poll(p, gate < 0 ? 1 : 2, gate < 0 ? 0 : -1) < 0 && errno != EINTR)
			return false;
		if (p[0].revents)
			return false; /* CANCEL, or nobody there any more */
		if (gate < 0 || (p[1].revents & POLLIN && read(gate, &byte, 1) == 1))
			return true;
	}
}

static int work(const json_t *job)
{
	const json_t *parameters = json_object_get(job, "parameters");
	const char *part = json_text(job, "part", "");
	const char *gate_path = json_text(parameters, "gate", NULL);
	int64_t units = 0;
	struct stat s = { 0 };
	number_parse_integer(json_text(parameters, "units", "0"), &units);
	int gate = gate_path ? open(gate_path, O_RDWR | O_CLOEXEC) : -1;
	int fd = open(part, O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
	if (fd < 0 || fstat(fd, &s))
		return 1;
	for (int64_t done = s.st_size; done < units; done++) {
		progress(done, units);
		if (!may_step(gate)) {
			play_send(MESSAGE_ERROR, json_pack("{s:s, s:s}", "class", "cancelled",
			                                   "text", "stopped at a unit"));
			return 130;
		}
		if (write(fd, "u", 1) != 1)
			return 1;
	}
	progress(units, units);
	char *bytes, *path = text_print("%s.txt", json_text(job, "output", ""));
	size_t n;
	if (!path || file_read(part, 1 << 20, &bytes, &n, NULL) != ST_OK ||
	    file_write(path, bytes, n, NULL) != ST_OK)
		return 1;
	unlink(part);
	play_result(path);
	play_done();
	free(bytes);
	free(path);
	return 0;
}

static void burst(const json_t *job)
{
	const char *units = json_text(json_object_get(job, "parameters"), "units", "0");
	int64_t n = 0;
	number_parse_integer(units, &n);
	for (int64_t i = 0; i < n; i++)
		progress(i, n);
}

int main(int argc, char **argv)
{
	if (argc > 1 && !strcmp(argv[1], "--describe")) {
		printf(description, play_role(argv[0]));
		return 0;
	}
	play_hello(play_role(argv[0]));
	json_t *job = play_start();
	bool works = !strcmp(play_role(argv[0]), "good");
	int rc = works ? work(job) : 0;
	if (!works) {
		burst(job);
		play_result("/dev/null");
		play_done();
	}
	json_decref(job);
	return rc;
}
