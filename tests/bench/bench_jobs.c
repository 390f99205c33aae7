/* bench_jobs.c - what the service costs: a thousand jobs that do nothing beside xargs, the way from
 * submit to HELLO, suspending, packets, long lists, rest. Real processes in a throw-away project. */
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "place.h"
#include "bench.h"
#include "file.h"
#include "ledger.h"
#include "path.h"
#include "text.h"

enum { JOBS = 1000, LIST = 10000, RUNS = 31, PACKETS = 400000, WRITES = 1500, CLIENTS = 100 };
enum { ENDED = 100000, ROUNDS = 5, KILLS = 9 };

static void row(const char *what, const char *unit, double value, double target, bool less)
{
	bench_print(&(struct bench_row){ .row = "jobs",
	                                 .what = what,
	                                 .unit = unit,
	                                 .ours = value,
	                                 .target = target,
	                                 .less = less });
}

/* User and system time of a process so far. */
static double cpu_of(pid_t pid)
{
	clockid_t clock;
	struct timespec t = { 0 };
	if (!clock_getcpuclockid(pid, &clock))
		clock_gettime(clock, &t);
	return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void submit_many(struct place *p, const char *worker, int n)
{
	char *path = path_join(p->folder, "jobs.json");
	json_t *jobs = json_array();
	for (int i = 0; i < n; i++)
		json_array_append_new(
		        jobs, json_pack("{s:s, s:s, s:s, s:s, s:s}", "worker", worker, "output",
		                        "/tmp/none", "file_name", "hull.igs", "path_name",
		                        "/home/somebody/hulls/hull.igs", "group", "many"));
	char *text = json_dumps(jobs, 0);
	if (file_write(path, text, strlen(text), NULL) != ST_OK ||
	    client_request(p->client, MESSAGE_SUBMIT, json_pack("{s:[s]}", "jobs", path), NULL,
	                   NULL, NULL, NULL) != ST_OK)
		exit(1);
	json_decref(jobs);
	free(text);
	free(path);
}

static void thousand_jobs(void)
{
	struct place p;
	place_init(&p, "BATTEN_JOBS=2 BATTEN_NICE=0");
	double began = bench_wall();
	submit_many(&p, "nothing", JOBS);
	client_request(p.client, MESSAGE_WAIT, json_pack("{s:s}", "group", "many"), NULL, NULL,
	               NULL, NULL);
	double ours = bench_wall() - began;
	if (place_job(&p, JOBS)->state != JOB_DONE)
		exit(1);
	began = bench_wall();
	int rc = system("seq 1000 | xargs -P2 -n1 true");
	double theirs = bench_wall() - began;
	bench_print(&(struct bench_row){ .row = "jobs",
	                                 .what = "1000 jobs that do nothing, two at a time",
	                                 .unit = "s",
	                                 .ours = ours,
	                                 .target = rc ? 0 : 3 * theirs,
	                                 .less = true,
	                                 .peer = { { rc ? NULL : "xargs -P2", theirs } } });
	place_finish(&p);
}

static void submit_to_hello(void)
{
	struct place p;
	double t[RUNS], start[RUNS];
	place_init(&p, "BATTEN_JOBS=4 BATTEN_NICE=0");
	for (int i = 0; i < RUNS; i++) {
		t[i] = bench_wall();
		int64_t id = place_submit(&p, "stubborn", 0, NULL);
		place_until(&p, id, JOB_RUNNING);
		t[i] = bench_wall() - t[i];
		place_crash(&p);
		start[i] = bench_wall();
		place_connect(&p);
		start[i] = bench_wall() - start[i];
		kill(place_job(&p, id)->pid, SIGKILL);
		place_end(&p, id);
	}
	double up = bench_median(t, RUNS) * 1e3, more = bench_median(start, RUNS) * 1e3;
	row("submit to HELLO", "ms", up, 10, true);
	row("the same where the service must start", "ms", up + more, 60, true);
	place_finish(&p);
}

static void suspend_and_activate(void)
{
	struct place p;
	double t[RUNS], u[RUNS];
	place_init(&p, "");
	int64_t id = place_submit(&p, "stubborn", 0, NULL);
	place_until(&p, id, JOB_RUNNING);
	for (int i = 0; i < RUNS; i++) {
		t[i] = bench_wall();
		place_ask(&p, MESSAGE_SUSPEND, id);
		t[i] = bench_wall() - t[i];
		u[i] = bench_wall();
		place_ask(&p, MESSAGE_ACTIVATE, id);
		u[i] = bench_wall() - u[i];
	}
	row("suspend, from request to answer", "ms", bench_median(t, RUNS) * 1e3, 10, true);
	row("activate, likewise", "ms", bench_median(u, RUNS) * 1e3, 10, true);
	kill(place_job(&p, id)->pid, SIGKILL);
	place_end(&p, id);
	place_finish(&p);
}

/* A worker that takes neither CANCEL nor SIGTERM: what its end takes beyond the graces given. */
static void kill_stubborn(void)
{
	struct place p;
	double t[KILLS];
	const double graces = 0.1 + 0.1;
	place_init(&p, "BATTEN_CANCEL_GRACE=0.1 BATTEN_TERM_GRACE=0.1 BATTEN_NICE=0");
	for (int i = 0; i < KILLS; i++) {
		int64_t id = place_submit(&p, "stubborn", 0, NULL);
		place_until(&p, id, JOB_RUNNING);
		t[i] = bench_wall();
		place_ask(&p, MESSAGE_KILL, id);
		if (place_end(&p, id)->state != JOB_KILLED)
			bench_fail("a job was not killed");
		t[i] = bench_wall() - t[i] - graces;
	}
	row("kill of a worker that ignores everything, beyond the grace", "ms",
	    bench_median(t, KILLS) * 1e3, 10, true);
	place_finish(&p);
}

static void packets(void)
{
	struct place p;
	place_init(&p, "BATTEN_NICE=0");
	double began = bench_wall();
	int64_t id = place_submit(&p, "burst", PACKETS, NULL);
	const struct Stats *s = place_end(&p, id);
	double took = bench_wall() - began;
	if (s->state != JOB_DONE)
		bench_fail("the job of many packets failed");
	row("packets from one worker, a write each", "/s", PACKETS / took, 200000, false);
	place_finish(&p);
}

static void long_list_and_rest(void)
{
	struct place p;
	double t[RUNS];
	place_init(&p, "BATTEN_JOBS=1");
	int64_t id = place_submit(&p, "stubborn", 0, NULL);
	place_until(&p, id, JOB_RUNNING);
	double began = bench_wall();
	submit_many(&p, "nothing", LIST);
	double submit = bench_wall() - began;
	double cpu = cpu_of(p.service), own = cpu_of(getpid());
	for (int i = 0; i < RUNS; i++) {
		t[i] = bench_wall();
		client_request(p.client, MESSAGE_LIST, json_object(), NULL, NULL, NULL, NULL);
		t[i] = bench_wall() - t[i];
	}
	row("10,000 queued jobs listed", "ms", bench_median(t, RUNS) * 1e3, 100, true);
	printf("  submitted in %.0f ms; CPU of a list: service %.1f ms, client %.1f ms\n",
	       submit * 1e3, (cpu_of(p.service) - cpu) / RUNS * 1e3,
	       (cpu_of(getpid()) - own) / RUNS * 1e3);
	double before = cpu_of(p.service);
	sleep(3); /* what is measured is rest */
	row("idle service with one client", "% of a core", (cpu_of(p.service) - before) / 3 * 100,
	    0.1, true);
	client_request(p.client, MESSAGE_KILL, json_pack("{s:s}", "group", "many"), NULL, NULL,
	               NULL, NULL);
	kill(place_job(&p, id)->pid, SIGKILL);
	place_end(&p, id);
	place_finish(&p);
}

static void durable_change(void)
{
	struct place p;
	struct ledger l;
	struct Stats s;
	double t[2][WRITES];
	place_init(&p, "");
	char *path = path_join(p.folder, "bench.db");
	if (ledger_open(&l, path, NULL) != ST_OK)
		exit(1);
	stats_init(&s);
	/* in turns: what else the disk does meets both */
	for (int i = 0; i < 2 * WRITES; i++) {
		s.id = i + 1;
		struct ledger_change c = { .id = s.id, .stats = &s };
		double began = bench_wall();
		l.write(l.data, &c, 1, i % 2, NULL);
		t[i % 2][i / 2] = bench_wall() - began;
	}
	row("state change in the ledger", "us", bench_median(t[0], WRITES) * 1e6, 500, true);
	row("the same through a power cut", "us", bench_median(t[1], WRITES) * 1e6, 500, true);
	printf("  of a power cut's, one in ten took less than %.0f us, one in ten more than %.0f\n",
	       t[1][WRITES / 10] * 1e6, t[1][WRITES - WRITES / 10] * 1e6);
	ledger_close(&l);
	free(path);
	place_finish(&p);
}

/* Resident memory of a process, MiB. */
static double memory_of(pid_t pid)
{
	char path[64];
	long pages = 0;
	snprintf(path, sizeof path, "/proc/%ld/statm", (long)pid);
	FILE *f = fopen(path, "r");
	if (!f || fscanf(f, "%*d %ld", &pages) != 1)
		exit(1);
	fclose(f);
	return (double)pages * (double)sysconf(_SC_PAGESIZE) / (1 << 20);
}

static double list_all(struct client *c)
{
	double began = bench_wall();
	client_request(c, MESSAGE_LIST, json_pack("{s:b}", "all", 1), NULL, NULL, NULL, NULL);
	return bench_wall() - began;
}

/* A hundred clients watch ten thousand jobs and ask, all at once. */
static void hundred_clients(void)
{
	struct place p;
	struct client *c[CLIENTS];
	bool ended = false, gone = false;
	double t[CLIENTS];
	place_init(&p, "BATTEN_JOBS=1");
	int64_t id = place_submit(&p, "stubborn", 0, NULL);
	place_until(&p, id, JOB_RUNNING);
	submit_many(&p, "nothing", LIST);
	double before = memory_of(p.service), began = bench_wall();
	for (int i = 0; i < CLIENTS; i++)
		if (client_connect(&c[i], &p.project, false, NULL) != ST_OK ||
		    client_send(c[i], MESSAGE_LIST, json_object(), NULL) != ST_OK)
			exit(1);
	for (int i = 0; i < CLIENTS; i++, ended = false) {
		while (!ended && !gone)
			client_listen(c[i], 1000, -1, NULL, NULL, &ended, &gone, NULL);
		t[i] = bench_wall() - began;
	}
	double most = memory_of(p.service);
	for (int i = 0; i < CLIENTS; i++)
		client_close(c[i]);
	list_all(p.client);
	row("100 clients list 10,000 jobs at once, all", "s", t[CLIENTS - 1], 0, true);
	printf("  the first in %.0f ms%s; memory of the service %.1f MiB before, %.1f at most, %.1f "
	       "after\n",
	       t[0] * 1e3, gone ? " (some were let go)" : "", before, most, memory_of(p.service));
	client_request(p.client, MESSAGE_KILL, json_pack("{s:s}", "group", "many"), NULL, NULL,
	               NULL, NULL);
	kill(place_job(&p, id)->pid, SIGKILL);
	place_end(&p, id);
	place_finish(&p);
}

/* A ledger as a year leaves it. */
static void ended_write(const struct place *p)
{
	static struct ledger_change c[ENDED];
	static struct Stats s[ENDED];
	struct ledger l;
	char *path = path_join(p->project.hidden, "jobs.db");
	char worker[] = "nothing", name[] = "hull.igs", output[] = "/tmp/none";
	for (int i = 0; i < ENDED; i++) {
		stats_init(&s[i]);
		s[i].id = i + 1;
		s[i].state = JOB_DONE;
		s[i].worker = worker;
		s[i].file_name = name;
		s[i].output = output;
		s[i].ended = 1000;
		c[i] = (struct ledger_change){ .id = i + 1, .stats = &s[i] };
	}
	if (ledger_open(&l, path, NULL) != ST_OK || l.write(l.data, c, ENDED, false, NULL) != ST_OK)
		exit(1);
	ledger_close(&l);
	free(path);
}

static void many_ended(void)
{
	struct place p;
	place_init(&p, "BATTEN_JOBS=2 BATTEN_NICE=0");
	place_crash(&p);
	ended_write(&p);
	double start = bench_wall();
	place_connect(&p);
	start = bench_wall() - start;
	double all = list_all(p.client), first = memory_of(p.service), began = bench_wall();
	client_request(p.client, MESSAGE_LIST, json_object(), NULL, NULL, NULL, NULL);
	double recent = bench_wall() - began;
	began = bench_wall();
	client_request(p.client, MESSAGE_PRUNE, json_object(), NULL, NULL, NULL, NULL);
	row("start over 100,000 ended jobs", "ms", start * 1e3, 0, true);
	row("list of all of them", "ms", all * 1e3, 0, true);
	printf("  those of the last hour in %.1f ms, pruned in %.0f ms; memory %.1f MiB\n",
	       recent * 1e3, (bench_wall() - began) * 1e3, first);
	printf("  memory of the service, after each 1000 jobs run and pruned:");
	for (int i = 0; i < ROUNDS; i++) {
		submit_many(&p, "nothing", JOBS);
		client_request(p.client, MESSAGE_WAIT, json_pack("{s:s}", "group", "many"), NULL,
		               NULL, NULL, NULL);
		client_request(p.client, MESSAGE_PRUNE, json_object(), NULL, NULL, NULL, NULL);
		printf(" %.1f", memory_of(p.service));
	}
	printf(" MiB\n");
	place_finish(&p);
}

int main(void)
{
	signal(SIGPIPE, SIG_IGN);
	thousand_jobs();
	submit_to_hello();
	suspend_and_activate();
	kill_stubborn();
	packets();
	long_list_and_rest();
	durable_change();
	hundred_clients();
	many_ended();
	return 0;
}
