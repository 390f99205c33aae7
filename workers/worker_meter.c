/* worker_meter.c - progress, told now and then. */
#include <stdio.h>
#include <string.h>

#include "worker_private.h"

/* Least time between two tellings, seconds. */
static const double interval = 0.1;

static double now(void)
{
	struct timespec t;
	clock_gettime(CLOCK_MONOTONIC, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

void meter_init(struct meter *m, const struct front *front)
{
	*m = (struct meter){ .front = front };
	pthread_mutex_init(&m->lock, NULL);
}

static void tell(struct meter *m, double t)
{
	m->told = t;
	m->front->progress(m->front->data, m->phase, m->done, m->total);
}

/* Two phases are one for the clock when only their percentage differs: "reading 3 %". */
static bool same_phase(const char *a, const char *b)
{
	size_t n = strcspn(a, "0123456789");
	return strcspn(b, "0123456789") == n && strncmp(a, b, n) == 0;
}

void meter_set(struct meter *m, const char *phase, size_t done, size_t total)
{
	pthread_mutex_lock(&m->lock);
	bool first = !same_phase(m->phase, phase);
	/* Threads come here in any order; what is done never goes back within a phase. */
	if (first || done >= m->done) {
		bool last = total && done == total && m->done != done;
		snprintf(m->phase, sizeof m->phase, "%s", phase);
		m->done = done;
		m->total = total;
		double t = now();
		if (first || last || t - m->told >= interval)
			tell(m, t);
	}
	pthread_mutex_unlock(&m->lock);
}

void meter_repeat(struct meter *m)
{
	pthread_mutex_lock(&m->lock);
	if (*m->phase)
		tell(m, now());
	pthread_mutex_unlock(&m->lock);
}
