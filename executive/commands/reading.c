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

static double now(void)
{
	struct timespec t;

	clock_gettime(CLOCK_MONOTONIC, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void draw(void *data, double fraction)
{
	struct working *m = data;
	double t = now();

	if (t - m->began < 0.5 || t - m->drawn < 0.1)
		return;
	fprintf(stderr, "\r%s %s %3.0f %%\033[K", m->what, m->name, 100 * fraction);
	m->drawn = t;
	m->shown = true;
}

/* Who listens may be gone: then SIGPIPE ends this process, whose work nobody wants. */
static void tell(void *data, double fraction)
{
	struct working *m = data;
	double t = now();

	if (t - m->drawn < 0.1)
		return;
	dprintf(m->fd, "%.4f\n", fraction);
	m->drawn = t;
}

void working_begin(struct working *x, const char *what, const char *name, int fd)
{
	*x = (struct working){ .began = now(), .what = what, .name = name, .fd = fd };
	x->progress = (struct progress){ .step = fd >= 0                 ? tell
		                                 : isatty(STDERR_FILENO) ? draw
		                                                         : NULL,
		                         .data = x,
		                         .stop = &interrupted };
	interrupt_begin(&x->interrupt);
}

void working_end(struct working *x)
{
	interrupt_end(&x->interrupt);
	if (x->shown)
		fputs("\r\033[K", stderr);
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
	struct working working;
	working_begin(&working, "reading", path_file_name(path), fd);
	st = model_read(m, path, &working.progress, r);
	working_end(&working);
	if (st == ST_OK && selector) {
		st = model_find(m, selector, chosen, r);
		if (st != ST_OK)
			model_finish(m);
	}
	free(path);
	free(selector);
	return st;
}
