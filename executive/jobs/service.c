/* service.c - the service: start, the turn of the loop, the end. */
#include "service.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <time.h>
#include <unistd.h>

#include "lock.h"
#include "number.h"
#include "parallel.h"
#include "path.h"
#include "server.h"
#include "tidy.h"

/* jobs at once at least; milliseconds after which an ending service waits no more */
/* jobs of a long ledger, after which the lock is touched; the service's log is looked at each LOG_MS
 * and kept below LOG_MAX */
enum { TOUCH_JOBS = 10000, LOG_MS = 10000, LOG_MAX = 4 << 20, HELLO_MORE_S = 1 };
enum { JOBS_LEAST = 4, LEAVE_MS = 4500, BACKLOG_CONNECTIONS = 128 };

static double clock_elapsed(void *data)
{
	struct timespec t;
	(void)data;
	clock_gettime(CLOCK_MONOTONIC, &t);
	return (double)t.tv_sec + (double)t.tv_nsec * 1e-9;
}

static double clock_date(void *data)
{
	struct timespec t;
	(void)data;
	clock_gettime(CLOCK_REALTIME, &t);
	/* milliseconds: what is listed often is short in digits */
	return (double)(t.tv_sec * 1000 + t.tv_nsec / 1000000) / 1e3;
}

/* The disk of the folder that holds the path; false: not known. */
static bool room_at(const char *path, struct room *out)
{
	struct statvfs v;
	struct stat s;
	char *folder = path_folder(path);
	bool known = folder && !statvfs(folder, &v) && !stat(folder, &s);
	free(folder);
	if (!known || !v.f_blocks) /* one of no blocks is no disk: /proc */
		return false;
	out->disk = s.st_dev;
	out->mib = (int64_t)((double)v.f_bavail * (double)v.f_frsize / (1 << 20));
	return true;
}

/* Outputs go to one place, part files and logs to another. */
static int room_left(void *data, const struct Stats *job, struct room at[ROOMS])
{
	const struct server *s = data;
	int n = job->output && room_at(job->output, &at[0]);
	n += room_at(s->project->hidden, &at[n]);
	return n == 2 && at[0].disk == at[1].disk ? 1 : n;
}

static int64_t output_size(void *data, const struct Stats *job)
{
	int64_t bytes = 0;
	struct stat s;
	(void)data;
	for (int i = 0; i < job->n_outputs; i++) {
		if (stat(job->outputs[i].path, &s))
			return -1;
		bytes += s.st_size;
	}
	return bytes;
}

static void on_tidy(void *data, const struct Stats *job)
{
	(void)data;
	tidy_outputs(job);
}

static void on_loading(void *data, int n)
{
	const struct server *s = data;
	if (n % TOUCH_JOBS == 0)
		lock_touch(s->lock);
}

static void on_upgrading(void *data)
{
	const struct server *s = data;
	lock_touch(s->lock);
}

static void hooks_told(struct server *s, const struct Stats *job)
{
	bool all_done;
	if (!job_state_table[job->state].over || !hooks_wanted(s->hooks))
		return;
	hooks_run(s->hooks, "job", job, job_state_table[job->state].word);
	if (job->group && !queue_unended(s->queue, job->group, &all_done))
		hooks_run(s->hooks, "group", job, all_done ? "done" : "failed");
}

static void on_told(void *data, const struct Stats *job)
{
	struct server *s = data;
	hooks_told(s, job);
	for (struct session *c = s->sessions; c; c = c->next)
		for (struct request *q = c->requests; q; q = q->next)
			request_told(q, job);
}

static void close_handles(struct server *s)
{
	struct session *next;
	if (s->closing)
		return;
	s->closing = true;
	for (struct session *c = s->sessions; c; c = next) {
		next = c->next;
		/* what was said last must arrive: a socket takes that much at once */
		if (c->out.n && !c->writing) {
			uv_buf_t b = uv_buf_init(c->out.s, (unsigned)c->out.n);
			uv_try_write((uv_stream_t *)&c->pipe, &b, 1);
		}
		session_close(c);
	}
	lock_listening(s->lock, false);
	uv_close((uv_handle_t *)&s->listener, NULL);
	uv_close((uv_handle_t *)&s->prepare, NULL);
	uv_close((uv_handle_t *)&s->deadline, NULL);
	uv_close((uv_handle_t *)&s->idle, NULL);
	uv_close((uv_handle_t *)&s->leave, NULL);
	uv_close((uv_handle_t *)&s->log, NULL);
	uv_close((uv_handle_t *)&s->interrupt, NULL);
	uv_close((uv_handle_t *)&s->terminate, NULL);
	hooks_close(s->hooks);
	local_close(s->local);
	slurm_close(s->slurm);
}

static void leave_end(struct server *s)
{
	for (struct session *c = s->sessions; c; c = c->next)
		for (struct request *q = c->requests; q; q = q->next)
			if (q->type == MESSAGE_SHUTDOWN && !q->ended)
				request_end(q);
	close_handles(s);
}

static void on_leave_late(uv_timer_t *t)
{
	leave_end(t->data);
}

void server_leave(struct server *s)
{
	if (s->leaving)
		return;
	s->leaving = true;
	queue_leave(s->queue);
	uv_timer_start(&s->leave, on_leave_late, LEAVE_MS, 0);
}

static void on_signal(uv_signal_t *h, int number)
{
	(void)number;
	server_leave(h->data);
}

static void on_deadline(uv_timer_t *t)
{
	struct server *s = t->data;
	queue_tick(s->queue);
}

static void on_idle(uv_timer_t *t)
{
	server_leave(t->data);
}

/* What hooks and the service said, where that goes to a file. */
static void on_log_look(uv_timer_t *t)
{
	static const char note[] = "batten: the log grew beyond 4 MiB, what stood here was cut\n";
	struct stat s;
	(void)t;
	if (fstat(STDERR_FILENO, &s) || !S_ISREG(s.st_mode) || s.st_size <= LOG_MAX ||
	    ftruncate(STDERR_FILENO, 0))
		return;
	if (write(STDERR_FILENO, note, sizeof note - 1) < 0)
		return; /* a full disk: what is said next is lost as well */
}

static void on_connection(uv_stream_t *stream, int status)
{
	if (!status)
		session_accept(stream->data);
}

static void session_turn(struct session *c)
{
	for (struct request **at = &c->requests; *at;) {
		struct request *q = *at;
		request_check(q);
		if (!q->ended) {
			at = &q->next;
			continue;
		}
		*at = q->next;
		request_destroy(q);
	}
	session_flush(c);
}

/* Nobody there and nothing to do: the clock of the service's end runs. */
static void idle_turn(struct server *s)
{
	bool idle = !s->sessions && !queue_busy(s->queue);
	bool runs = uv_is_active((uv_handle_t *)&s->idle);
	if (idle && !runs)
		uv_timer_start(&s->idle, on_idle, (uint64_t)(s->idle_s * 1000), 0);
	else if (!idle && runs)
		uv_timer_stop(&s->idle);
}

/* The end of a turn: what happened in it goes into the ledger, then to those who asked. */
static void on_turn(uv_prepare_t *h)
{
	struct server *s = h->data;
	struct session *next;
	queue_turn(s->queue);
	for (struct session *c = s->sessions; c; c = next) {
		next = c->next;
		session_turn(c);
	}
	if (s->leaving && !queue_processes(s->queue)) {
		leave_end(s);
		return;
	}
	idle_turn(s);
	double wait = queue_deadline(s->queue) - clock_elapsed(NULL);
	if (isfinite(wait))
		uv_timer_start(&s->deadline, on_deadline,
		               wait > 0 ? (uint64_t)ceil(wait * 1000) : 0, 0);
	else
		uv_timer_stop(&s->deadline);
}

static struct queue_limits limits_from(const struct settings *s)
{
	enum { OVER_KEPT = 1000 };
	int processors = parallel_processors();
	int jobs = (int)settings_number(s, SETTING_JOBS);
	const char *resume = s->value[SETTING_RESUME];
	struct queue_limits l = {
		.job_threads = (int)settings_number(s, SETTING_THREADS),
		.job_memory_mib = (int64_t)settings_number(s, SETTING_MEMORY),
		.cancel_grace = settings_number(s, SETTING_CANCEL_GRACE),
		.term_grace = settings_number(s, SETTING_TERM_GRACE),
		.hello_grace = settings_number(s, SETTING_HELLO_GRACE),
		.end_grace = settings_number(s, SETTING_END_GRACE),
		.job_wall_s = settings_number(s, SETTING_WALL),
		.disk_floor_mib = (int64_t)settings_number(s, SETTING_DISK_FLOOR),
		.resume = !strcmp(resume, "ask")     ? RESUME_ASK
		          : !strcmp(resume, "never") ? RESUME_NEVER
		                                     : RESUME_AUTO,
		.over_kept = OVER_KEPT,
		.jobs_elsewhere = (int)settings_number(s, SETTING_SLURM_JOBS),
	};
	l.jobs = jobs ? jobs : processors > JOBS_LEAST ? processors : JOBS_LEAST;
	l.threads = l.jobs * l.job_threads > processors ? l.jobs * l.job_threads : processors;
	l.memory_mib =
	        (int64_t)sysconf(_SC_PHYS_PAGES) * (int64_t)sysconf(_SC_PAGESIZE) / (1 << 20);
	return l;
}

/* The lock is ours, so a socket that lies there is a dead service's. */
static enum status listen_on(struct server *s, const struct report *r)
{
	const char *path = s->project->socket;
	mode_t old = umask(077);
	unlink(path);
	int error = uv_pipe_bind(&s->listener, path);
	if (!error)
		error = uv_listen((uv_stream_t *)&s->listener, BACKLOG_CONNECTIONS, on_connection);
	umask(old);
	if (error)
		return report_error(r, ST_RESOURCE, "cannot listen on the socket '%s': %s", path,
		                    uv_strerror(error));
	return ST_OK;
}

static void handles_init(struct server *s)
{
	uv_pipe_init(&s->loop, &s->listener, 0);
	uv_prepare_init(&s->loop, &s->prepare);
	uv_timer_init(&s->loop, &s->deadline);
	uv_timer_init(&s->loop, &s->idle);
	uv_timer_init(&s->loop, &s->leave);
	uv_timer_init(&s->loop, &s->log);
	uv_timer_start(&s->log, on_log_look, 0, LOG_MS);
	uv_signal_init(&s->loop, &s->interrupt);
	uv_signal_init(&s->loop, &s->terminate);
	s->listener.data = s->prepare.data = s->deadline.data = s->idle.data = s->leave.data =
	        s->interrupt.data = s->terminate.data = s;
	uv_prepare_start(&s->prepare, on_turn);
	uv_signal_start(&s->interrupt, on_signal, SIGINT);
	uv_signal_start(&s->terminate, on_signal, SIGTERM);
}

/* Tell who started us that we listen, or that we never will: its end of the pipe sees the close. */
static int ready_take(void)
{
	const char *text = getenv("BATTEN_READY_FD");
	int64_t fd = -1;
	if (!text || !number_parse_integer(text, &fd) || fd < 3 ||
	    fcntl((int)fd, F_SETFD, FD_CLOEXEC))
		fd = -1;
	unsetenv("BATTEN_READY_FD");
	return (int)fd;
}

static enum status server_open(struct server *s, const struct settings *settings,
                               const struct report *r)
{
	struct queue_limits limits = limits_from(settings);
	struct queue_ports ports = {
		.launcher = crew_launcher(s->crew),
		.ledger = &s->ledger,
		.clock = &s->clock,
		.told = on_told,
		.told_data = s,
		.loading = on_loading,
		.loading_data = s,
		.room = room_left,
		.size = output_size,
		.tidy = on_tidy,
		.room_data = s,
	};
	/* the working folder is the project's */
	const char *hidden =
	        strlen(s->project->hidden) < LEDGER_PATH_MAX ? s->project->hidden : ".batten";
	char *path = path_join(hidden, "jobs.db");
	enum status st =
	        path ? ledger_open_telling(&s->ledger, path, on_upgrading, s, r) : ST_RESOURCE;
	free(path);
	if (st == ST_OK)
		st = queue_create(&s->queue, &ports, &limits);
	if (st == ST_OK) {
		crew_connect(s->crew, queue_sink(s->queue));
		st = queue_load(s->queue, r);
	}
	return st;
}

/* Workers by others may ask this program: they find it in BATTEN_PROGRAM. */
static enum status program_tell(const struct report *r)
{
	char *folder = path_of_program(), *path = folder ? path_join(folder, "batten") : NULL;
	bool told = path && !setenv("BATTEN_PROGRAM", path, 1);
	free(folder);
	free(path);
	return told ? ST_OK : report_error(r, ST_RESOURCE, "cannot serve: out of memory");
}

static enum status launchers_create(struct server *s, const struct settings *settings,
                                    const struct report *r)
{
	enum status st = local_create(&s->local, &s->loop, s->project,
	                              (int)settings_number(settings, SETTING_NICE), r);
	if (st == ST_OK)
		st = hooks_create(&s->hooks, &s->loop, settings->value[SETTING_HOOK]);
	if (st == ST_OK)
		st = slurm_create(&s->slurm, &s->loop, s->project, settings, r);
	if (st != ST_OK)
		return st;
	/* later than the queue's own limit, which says more */
	local_hello(s->local, settings_number(settings, SETTING_HELLO_GRACE) + HELLO_MORE_S);
	crew_add(s->crew, "local", local_launcher(s->local));
	crew_add(s->crew, "slurm", slurm_launcher(s->slurm));
	local_connect(s->local, crew_sink(s->crew));
	slurm_connect(s->slurm, crew_sink(s->crew));
	return st;
}

static enum status server_run(struct server *s, const struct settings *settings, int *ready,
                              const struct report *r)
{
	enum status st = crew_create(&s->crew);
	if (st == ST_OK)
		st = program_tell(r);
	if (st == ST_OK)
		st = launchers_create(s, settings, r);
	if (st != ST_OK)
		return st;
	handles_init(s);
	st = server_open(s, settings, r);
	if (st == ST_OK)
		st = listen_on(s, r);
	if (st == ST_OK) {
		lock_listening(s->lock, true);
		if (*ready >= 0)
			close(*ready);
		*ready = -1;
	} else {
		close_handles(s);
	}
	uv_run(&s->loop, UV_RUN_DEFAULT);
	if (st == ST_OK)
		unlink(s->project->socket);
	return st;
}

enum status service_run(const struct project *p, const struct settings *settings,
                        const struct report *r)
{
	int ready = ready_take(), error;
	struct server *s = calloc(1, sizeof *s);
	if (!s)
		return report_error(r, ST_RESOURCE, "cannot serve: out of memory");
	enum status st = lock_take(p, ready >= 0, &s->lock, r);
	if (st == ST_OK) {
		signal(SIGPIPE, SIG_IGN);
		signal(SIGXFSZ, SIG_IGN); /* a file grown too large is a write that fails */
		s->project = p;
		s->idle_s = settings_number(settings, SETTING_IDLE);
		s->clock = (struct clock){ .elapsed = clock_elapsed, .date = clock_date };
		if (chdir(p->folder))
			st = report_error(r, ST_RESOURCE, "cannot enter '%s': %s", p->folder,
			                  strerror(errno));
		else if ((error = uv_loop_init(&s->loop)))
			st = report_error(r, ST_RESOURCE, "cannot make an event loop: %s",
			                  uv_strerror(error));
		if (st == ST_OK) {
			st = server_run(s, settings, &ready, r);
			uv_loop_close(&s->loop);
		}
		queue_destroy(s->queue);
		crew_destroy(s->crew);
		slurm_destroy(s->slurm);
		hooks_destroy(s->hooks);
		local_destroy(s->local);
		ledger_close(&s->ledger);
		close(s->lock);
	}
	if (ready >= 0)
		close(ready);
	free(s);
	return st;
}
