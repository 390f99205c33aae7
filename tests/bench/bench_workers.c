/* bench_workers.c - workers end to end, driven by packets as the executive does it: how soon the
 * first part is there, how soon one is gone after CANCEL, and what a second thread and a second
 * process bring. The argument names the folder of the workers. */
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "bench.h"
#include "file.h"
#include "iges.h"
#include "message.h"
#include "part.h"
#include "shapes.h"

enum { ROUNDS = 5, LONG_ROUNDS = 3, TEXT = 4096, SHARDS = 2, FIRST_OUTPUT = 4, KILLS = 5 };

/* What a worker is asked for. */
struct task {
	const char *worker, *parameters; /* an object */
	int threads, shard;              /* shard -1: all of it */
};

static const struct task first_tasks[] = {
	{ "curvature", "{\"grid\":\"4000x4000\"}", 1, -1 },
	{ "shading", "{\"size\":\"4000x4000\"}", 1, -1 },
	{ "raytrace", "{\"size\":\"4000x4000\"}", 1, -1 },
	{ "isophotes", "{\"tolerance\":\"1e-8\"}", 1, -1 },
};

/* A run in a folder of its own. */
struct run {
	pid_t pid;
	int in, out; /* its standard input and output */
	struct message_reader reader;
	double started, cpu, peak; /* seconds; peak MiB */
};

static char folder[] = "/tmp/batten-bench-XXXXXX";
static const char *workers;
static int silent; /* what takes the workers' logs */

static void make_hull(const char *path)
{
	struct model m;
	struct entity e;
	model_init(&m);
	entity_init(&e, ENTITY_SURFACE);
	e.geometry = shape_wave10();
	if (model_set_text(&m.unit, "m") != ST_OK || model_add(&m, &e) != ST_OK)
		bench_fail("out of memory");
	m.unit_in_mm = 1000;
	if (iges_write(&m, path, NULL) != ST_OK)
		bench_fail("cannot write the surface");
	model_finish(&m);
}

static void job_write(const char *path, const struct task *t)
{
	char text[TEXT], shard[32] = "null", part[300];
	if (t->shard >= 0)
		snprintf(shard, sizeof shard, "[%d,%d]", t->shard, SHARDS);
	snprintf(part, sizeof part, "%s/job%d.part", folder, t->shard);
	snprintf(text, sizeof text,
	         "{\"version\":1,\"id\":1,\"worker\":\"%s\",\"inputs\":[{\"path\":\"%s/"
	         "hull.igs\",\"entity\":null}],\"parameters\":%s,\"output\":\"%s/out\","
	         "\"part\":\"%s\",\"threads\":%d,\"memory\":null,\"shard\":%s,\"parts\":null,"
	         "\"force\":true}",
	         t->worker, folder, t->parameters, folder, part, t->threads, shard);
	if (file_write(path, text, strlen(text), NULL) != ST_OK)
		bench_fail("cannot write the job file");
}

/* The next packet's type; 0 at the end of the pipe. */
static uint32_t next_packet(struct run *r)
{
	for (;;) {
		struct message m;
		size_t room;
		const int got = message_reader_next(&r->reader, &m);
		if (got < 0)
			bench_fail(r->reader.reason);
		if (got > 0) {
			const uint32_t type = m.type;
			message_finish(&m);
			return type;
		}
		char *to = message_reader_room(&r->reader, 1 << 16, &room);
		const ssize_t n = to ? read(r->out, to, room) : -1;
		if (n < 0 && errno != EINTR)
			bench_fail("cannot read from a worker");
		if (n == 0)
			return 0;
		if (n > 0)
			message_reader_filled(&r->reader, n);
	}
}

static bool wait_for(struct run *r, uint32_t type)
{
	for (uint32_t got; (got = next_packet(r)) != 0;)
		if (got == type)
			return true;
	return false;
}

/* A worker that has been sent START. */
static void run_start(struct run *r, const struct task *t)
{
	char program[TEXT], job[300];
	int in[2], out[2];
	snprintf(program, sizeof program, "%s/batten-%s", workers, t->worker);
	snprintf(job, sizeof job, "%s/job%d.json", folder, t->shard);
	job_write(job, t);
	if (pipe(in) || pipe(out))
		bench_fail("cannot make pipes");
	r->pid = fork();
	if (r->pid == 0) {
		dup2(in[0], STDIN_FILENO);
		dup2(out[1], STDOUT_FILENO);
		dup2(silent, STDERR_FILENO);
		close(in[1]);
		close(out[0]);
		execl(program, program, (char *)NULL);
		_exit(127);
	}
	close(in[0]);
	close(out[1]);
	r->in = in[1];
	r->out = out[0];
	message_reader_init(&r->reader, FROM_WORKER);
	if (r->pid < 0 || !wait_for(r, MESSAGE_HELLO))
		bench_fail("a worker does not say HELLO");
	json_t *start = json_pack("{s:s}", "job", job);
	r->started = bench_wall();
	if (message_send(r->in, MESSAGE_START, start) != ST_OK)
		bench_fail("cannot send START");
	json_decref(start);
}

/* Until it is gone. */
static void run_end(struct run *r)
{
	struct rusage used;
	int status;
	while (next_packet(r))
		;
	if (wait4(r->pid, &status, 0, &used) < 0)
		bench_fail("a worker is lost");
	r->cpu = (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
	         1e-6 * (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
	r->peak = (double)used.ru_maxrss / 1024;
	close(r->in);
	close(r->out);
	message_reader_finish(&r->reader);
}

static void clear(int from)
{
	static const char *const names[] = {
		"hull.igs",       "job-1.json",    "job0.json",        "job1.json",
		"job-1.part",     "job0.part",     "job1.part",        "out.map.exr",
		"out.shade.exr",  "out.trace.exr", "job-1.part.ahead", "job0.part.ahead",
		"job1.part.ahead"
	};
	char path[300];
	for (size_t i = from; i < sizeof names / sizeof *names; i++) {
		snprintf(path, sizeof path, "%s/%s", folder, names[i]);
		unlink(path);
	}
}

static void first_part(const struct task *t)
{
	double first[ROUNDS], gone[ROUNDS], peak = 0;
	char what[80];
	for (int k = 0; k < ROUNDS; k++) {
		struct run r;
		run_start(&r, t);
		if (!wait_for(&r, MESSAGE_UNIT))
			bench_fail("a worker ends without a part");
		const double told = bench_wall();
		first[k] = 1e3 * (told - r.started);
		/* one that has just ended has closed its ears */
		if (message_send(r.in, MESSAGE_CANCEL, NULL) != ST_OK && errno != EPIPE)
			bench_fail("cannot send CANCEL");
		run_end(&r);
		gone[k] = 1e3 * (bench_wall() - told);
		peak = r.peak > peak ? r.peak : peak;
		clear(FIRST_OUTPUT);
	}
	snprintf(what, sizeof what, "START to the first part, %s", t->worker);
	bench_print(&(struct bench_row){ .row = "22",
	                                 .what = what,
	                                 .unit = "ms",
	                                 .ours = bench_median(first, ROUNDS),
	                                 .target = 50,
	                                 .less = true });
	snprintf(what, sizeof what, "CANCEL to the end of the process, %s", t->worker);
	bench_print(&(struct bench_row){ .row = "22",
	                                 .what = what,
	                                 .unit = "ms",
	                                 .ours = bench_median(gone, ROUNDS),
	                                 .target = 100,
	                                 .less = true });
	if (!strcmp(t->worker, "raytrace"))
		bench_print(&(struct bench_row){ .row = "rays",
		                                 .what = "answer to stop, with the part file left",
		                                 .unit = "ms",
		                                 .ours = bench_median(gone, ROUNDS),
		                                 .target = 200,
		                                 .less = true });
	printf("  worst %.1f and %.1f ms; %.0f MiB given back\n", first[ROUNDS - 1],
	       gone[ROUNDS - 1], peak);
}

/* Units that a part file holds. */
static size_t units_in(const char *part)
{
	struct part_glance g;
	size_t n = 0;
	if (part_look(&g, part, NULL) != ST_OK)
		bench_fail("cannot read what a killed worker left");
	bool *seen = calloc(g.n_units, sizeof *seen);
	if (!seen)
		bench_fail("out of memory");
	for (size_t i = 0; i < g.n; i++) {
		n += !seen[g.found[i].unit];
		seen[g.found[i].unit] = true;
	}
	free(seen);
	part_glance_finish(&g);
	return n;
}

/* Kill it once it has told of so many units; how many it has told of in all. */
static size_t run_kill(const struct task *t, size_t after)
{
	struct run r;
	size_t told = 0;
	run_start(&r, t);
	for (uint32_t type; (type = next_packet(&r)) != 0;)
		if (type == MESSAGE_UNIT && ++told == after)
			kill(r.pid, SIGKILL);
	run_end(&r);
	return told;
}

static void run_whole(const struct task *t, char **bytes, size_t *n)
{
	struct run r;
	char path[300];
	run_start(&r, t);
	run_end(&r);
	snprintf(path, sizeof path, "%s/out.trace.exr", folder);
	if (file_read(path, UINT64_MAX, bytes, n, NULL) != ST_OK)
		bench_fail("a worker leaves no image");
}

/* Kill -9 amid the work, and the same work again. */
static void killed(void)
{
	const struct task task = { "raytrace", "{\"size\":\"1000x1000\"}", 2, -1 };
	char *good, *bytes, part[300];
	size_t n_good, n, told = 0, kept = 0, same = 0;
	run_whole(&task, &good, &n_good);
	clear(FIRST_OUTPUT);
	snprintf(part, sizeof part, "%s/job-1.part", folder);
	for (size_t k = 0; k < KILLS; k++) {
		const size_t now = run_kill(&task, 20 + 40 * k), left = units_in(part);
		told += now;
		kept += left < now ? left : now;
		run_whole(&task, &bytes, &n);
		same += n == n_good && !memcmp(bytes, good, n);
		free(bytes);
		clear(FIRST_OUTPUT);
	}
	free(good);
	bench_print(&(struct bench_row){ .row = "rays",
	                                 .what = "finished units that kill -9 leaves",
	                                 .unit = "%",
	                                 .ours = 100 * (double)kept / (double)told,
	                                 .target = 100 });
	bench_print(&(struct bench_row){ .row = "rays",
	                                 .what = "resumed images with the bytes of an undisturbed",
	                                 .unit = "%",
	                                 .ours = 100 * (double)same / KILLS,
	                                 .target = 100 });
}

struct cost {
	double wall, cpu;
};

/* n tasks at once, from the first START to the last end; CPU of the busiest. */
static struct cost run_all(const struct task *tasks, int n)
{
	struct run runs[SHARDS];
	struct cost out = { 0 };
	for (int i = 0; i < n; i++)
		run_start(&runs[i], &tasks[i]);
	for (int i = 0; i < n; i++) {
		run_end(&runs[i]);
		out.cpu = runs[i].cpu > out.cpu ? runs[i].cpu : out.cpu;
	}
	out.wall = bench_wall() - runs[0].started;
	clear(FIRST_OUTPUT);
	return out;
}

/* The gain of the second over the first, by CPU time; by the clock beside it. */
static void gain(const char *row, const char *what, const char *worker, const struct task *one,
                 const struct task *two, int n)
{
	double wall[2][LONG_ROUNDS], cpu[2][LONG_ROUNDS];
	char name[100];
	for (int k = 0; k < LONG_ROUNDS; k++) {
		const struct cost a = run_all(one, 1), b = run_all(two, n);
		wall[0][k] = a.wall;
		wall[1][k] = b.wall;
		cpu[0][k] = a.cpu;
		/* threads share one process: its time is that of both */
		cpu[1][k] = n == 1 ? b.cpu / two->threads : b.cpu;
	}
	for (int i = 0; i < 2; i++) {
		bench_median(wall[i], LONG_ROUNDS);
		bench_median(cpu[i], LONG_ROUNDS);
	}
	const int middle = LONG_ROUNDS / 2;
	snprintf(name, sizeof name, "%s / 1, %s 2000 x 2000, CPU time", what, worker);
	bench_print(&(struct bench_row){ .row = row,
	                                 .what = name,
	                                 .unit = "x",
	                                 .ours = cpu[0][middle] / cpu[1][middle],
	                                 .target = 1.8 });
	printf("  by the clock %.2f; one: %.2f s, CPU %.2f s\n", wall[0][middle] / wall[1][middle],
	       wall[0][middle], cpu[0][middle]);
}

int main(int argc, char **argv)
{
	static const char grid[] = "{\"grid\":\"2000x2000\"}", size[] = "{\"size\":\"2000x2000\"}";
	const struct task curvature[] = { { "curvature", grid, 1, -1 },
		                          { "curvature", grid, 2, -1 } };
	const struct task shards[] = { { "curvature", grid, 1, 0 }, { "curvature", grid, 1, 1 } };
	const struct task shading[] = { { "shading", size, 1, -1 }, { "shading", size, 2, -1 } };
	char path[300];
	signal(SIGPIPE, SIG_IGN);
	if (argc < 2)
		bench_fail("name the folder of the workers");
	workers = argv[1];
	silent = open("/dev/null", O_WRONLY | O_CLOEXEC);
	if (!mkdtemp(folder))
		bench_fail("cannot make a folder");
	snprintf(path, sizeof path, "%s/hull.igs", folder);
	make_hull(path);
	for (size_t i = 0; i < sizeof first_tasks / sizeof *first_tasks; i++)
		first_part(&first_tasks[i]);
	killed();
	gain("3", "2 processes", "curvature", &curvature[0], shards, SHARDS);
	gain("-", "2 threads", "curvature", &curvature[0], &curvature[1], 1);
	gain("-", "2 threads", "shading", &shading[0], &shading[1], 1);
	clear(0);
	rmdir(folder);
	return 0;
}
