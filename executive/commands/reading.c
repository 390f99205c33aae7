/* reading.c - reading a geometry file in a verb. */
#include "reading.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include "path.h"

static atomic_bool interrupted;

static void on_interrupt(int number)
{
	(void)number;
	atomic_store(&interrupted, true);
}

void interrupt_begin(struct interrupt *x)
{
	const struct sigaction mine = { .sa_handler = on_interrupt };
	sigaction(SIGINT, &mine, &x->before);
}

bool interrupt_noted(void)
{
	return atomic_load(&interrupted);
}

void interrupt_end(const struct interrupt *x)
{
	sigaction(SIGINT, &x->before, NULL);
}

struct meter {
	double began, drawn;
	const char *name;
	bool shown;
	int fd; /* for programs */
};

static double now(void)
{
	struct timespec t;

	clock_gettime(CLOCK_MONOTONIC, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void draw(void *data, double fraction)
{
	struct meter *m = data;
	double t = now();

	if (t - m->began < 0.5 || t - m->drawn < 0.1)
		return;
	fprintf(stderr, "\rreading %s %3.0f %%\033[K", m->name, 100 * fraction);
	m->drawn = t;
	m->shown = true;
}

/* Who listens may be gone: then SIGPIPE ends this process, whose work nobody wants. */
static void tell(void *data, double fraction)
{
	struct meter *m = data;
	double t = now();

	if (t - m->drawn < 0.1)
		return;
	dprintf(m->fd, "%.4f\n", fraction);
	m->drawn = t;
}

enum status reading_open(struct model *m, const char *argument, struct entity **chosen,
                         const struct report *r)
{
	return reading_open_telling(m, argument, -1, chosen, r);
}

enum status reading_open_telling(struct model *m, const char *argument, int fd,
                                 struct entity **chosen, const struct report *r)
{
	char *path = NULL, *selector = NULL;
	enum status st = model_split_name(argument, &path, &selector);

	*chosen = NULL;
	if (st != ST_OK)
		return report_error(r, st, "memory ran out");
	struct meter meter = { .began = now(), .name = path_file_name(path), .fd = fd };
	struct progress p = { .step = fd >= 0                 ? tell
		                      : isatty(STDERR_FILENO) ? draw
		                                              : NULL,
		              .data = &meter,
		              .stop = &interrupted };
	struct interrupt interrupt;
	interrupt_begin(&interrupt);
	st = model_read(m, path, &p, r);
	interrupt_end(&interrupt);
	if (meter.shown)
		fputs("\r\033[K", stderr);
	if (st == ST_OK && selector) {
		st = model_find(m, selector, chosen, r);
		if (st != ST_OK)
			model_finish(m);
	}
	free(path);
	free(selector);
	return st;
}
