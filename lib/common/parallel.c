/* parallel.c - the same work on many units by several threads. */
#include "parallel.h"

#include <pthread.h>
#include <sched.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>

struct run {
	size_t n_units;
	const atomic_bool *stop;
	parallel_unit *fn;
	void *data;
	atomic_size_t next;
	atomic_bool over;
	pthread_mutex_t lock; /* guards the two below */
	size_t failed_unit;
	enum status status;
};

struct thread {
	struct run *run;
	int number;
	pthread_t id;
};

static void run_units(struct run *run, int thread)
{
	while (!atomic_load(&run->over) && !(run->stop && atomic_load(run->stop))) {
		size_t unit = atomic_fetch_add(&run->next, 1);
		if (unit >= run->n_units)
			break;
		enum status st = run->fn(run->data, unit, thread);
		if (st == ST_OK)
			continue;
		pthread_mutex_lock(&run->lock);
		if (run->status == ST_OK || unit < run->failed_unit) {
			run->status = st;
			run->failed_unit = unit;
		}
		pthread_mutex_unlock(&run->lock);
		atomic_store(&run->over, true);
	}
}

static void *thread_main(void *data)
{
	struct thread *t = data;

	run_units(t->run, t->number);
	return NULL;
}

enum status parallel_run(int n_threads, size_t n_units, const atomic_bool *stop, parallel_unit *fn,
                         void *data)
{
	struct run run = { .n_units = n_units, .stop = stop, .fn = fn, .data = data };
	int n = 1, n_wanted = n_threads < 1 ? 1 : n_threads;

	if ((size_t)n_wanted > n_units)
		n_wanted = n_units ? (int)n_units : 1;
	struct thread *threads = calloc((size_t)n_wanted, sizeof *threads);
	if (!threads)
		return ST_RESOURCE;
	pthread_mutex_init(&run.lock, NULL);
	for (; n < n_wanted; n++) {
		threads[n] = (struct thread){ .run = &run, .number = n };
		if (pthread_create(&threads[n].id, NULL, thread_main, &threads[n])) {
			run.status = ST_RESOURCE;
			atomic_store(&run.over, true);
			break;
		}
	}
	run_units(&run, 0);
	for (int i = 1; i < n; i++)
		pthread_join(threads[i].id, NULL);
	pthread_mutex_destroy(&run.lock);
	free(threads);
	if (run.status == ST_OK && atomic_load(&run.next) < n_units)
		return ST_CANCELLED;
	return run.status;
}

/* Processors' worth of time that the control group allows, or 0 for no limit. */
static double group_quota(void)
{
	char quota[32] = "";
	double period = 0, share = 0;
	FILE *f = fopen("/sys/fs/cgroup/cpu.max", "re");

	if (!f)
		return 0;
	if (fscanf(f, "%31s %lf", quota, &period) == 2 && strcmp(quota, "max") && period > 0)
		share = strtod(quota, NULL) / period;
	fclose(f);
	return share;
}

int parallel_processors(void)
{
	cpu_set_t set;
	int n = sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
	double quota = group_quota();

	if (quota > 0 && quota < n)
		n = (int)(quota + 0.5);
	return n < 1 ? 1 : n;
}

#if defined(__x86_64__)
static const char *const levels[] = { "x86-64", "x86-64-v3", "x86-64-v4" };

static int level_of_machine(void)
{
	__builtin_cpu_init();
	if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
		return 0;
	return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
	                       __builtin_cpu_supports("avx512vl") &&
	                       __builtin_cpu_supports("avx512bw")
	               ? 2
	               : 1;
}

const char *vector_level(void)
{
	static atomic_int chosen; /* 1 + index */
	int level = atomic_load(&chosen) - 1;

	if (level >= 0)
		return levels[level];
	level = level_of_machine();
	const char *wanted = getenv("BATTEN_VECTOR_LEVEL");
	for (int i = 0; wanted && i < level; i++)
		if (!strcmp(wanted, levels[i]))
			level = i;
	atomic_store(&chosen, level + 1);
	return levels[level];
}
#else
const char *vector_level(void)
{
	static struct utsname name;

	return uname(&name) == 0 ? name.machine : "unknown";
}
#endif
