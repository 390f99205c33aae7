/* local.c - the launcher of workers on this machine: processes, pipes and their ends. */
#include "local.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "job_file.h"
#include "path.h"
#include "roster.h"
#include "process.h"
#include "text.h"

/* bytes of packets taken from one worker in one turn of the loop; milliseconds between looks at the
 * logs; bytes of a log */
enum { READ_AT_ONCE = 65536, LOG_LOOK_MS = 500, LOG_MAX = 16 << 20, MIB = 1 << 20 };

/* What a worker may have beyond the memory of its job: its program, stacks, the allocator. */
enum { MEMORY_SPARE_MIB = 256, MEMORY_THREAD_MIB = 16 };

struct worker {
	struct local *local; /* borrowed */
	struct worker *next;
	int64_t id;
	pid_t pid; /* 0: has been waited for */
	int in, log;
	int out, pidfd; /* -1: closed */
	uv_poll_t out_poll, pid_poll;
	int n_handles; /* still open */
	bool forgotten;
	struct message_reader reader;
	char *job_file; /* owned */
};

struct local {
	uv_loop_t *loop;
	const struct project *project;
	struct launcher launcher;
	struct launcher_sink sink;
	char *stub, *host;
	char *name, *path; /* the worker found last, for the next job of the same */
	int niceness;
	uv_signal_t child;
	uv_timer_t look;
	struct worker *workers; /* those not forgotten */
};

static struct worker *worker_find(const struct local *l, int64_t id)
{
	struct worker *w = l->workers;
	while (w && w->id != id)
		w = w->next;
	return w;
}

static void worker_free(struct worker *w)
{
	if (!w->forgotten || w->n_handles)
		return;
	message_reader_finish(&w->reader);
	free(w->job_file);
	free(w);
}

static void on_closed(uv_handle_t *h)
{
	struct worker *w = h->data;
	w->n_handles--;
	worker_free(w);
}

static void poll_close(uv_poll_t *poll, int *fd)
{
	if (*fd < 0)
		return;
	uv_poll_stop(poll);
	close(*fd);
	*fd = -1;
	uv_close((uv_handle_t *)poll, on_closed);
}

/* The process is gone but not waited for, so its number is still ours: end its group first. */
static void on_exit_seen(uv_poll_t *poll, int status, int events)
{
	struct worker *w = poll->data;
	struct local *l = w->local;
	siginfo_t si = { 0 };
	struct rusage usage;
	int code = 0;
	(void)status;
	(void)events;
	if (waitid(P_PID, (id_t)w->pid, &si, WEXITED | WNOHANG | WNOWAIT) || !si.si_pid)
		return;
	kill(-w->pid, SIGKILL);
	while (wait4(w->pid, &code, 0, &usage) < 0 && errno == EINTR)
		;
	w->pid = 0;
	poll_close(&w->pid_poll, &w->pidfd);
	struct launcher_exit e = {
		.status = WIFEXITED(code) ? WEXITSTATUS(code) : 0,
		.signal = WIFSIGNALED(code) ? WTERMSIG(code) : 0,
		.cpu_s = (double)(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
		         (double)(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec) * 1e-6,
		.peak_kib = usage.ru_maxrss,
	};
	l->sink.exited(l->sink.data, w->id, &e);
}

static void worker_broken(struct worker *w, const char *reason)
{
	struct launcher_sink *sink = &w->local->sink;
	poll_close(&w->out_poll, &w->out);
	sink->broken(sink->data, w->id, reason);
	sink->drained(sink->data, w->id);
}

/* So much a turn, so that no worker keeps the loop from the others. */
static void on_readable(uv_poll_t *poll, int status, int events)
{
	struct worker *w = poll->data;
	struct launcher_sink *sink = &w->local->sink;
	struct message m;
	size_t room;
	int next = 0;
	(void)status;
	(void)events;
	char *to = message_reader_room(&w->reader, READ_AT_ONCE, &room);
	if (!to) {
		worker_broken(w, "out of memory");
		return;
	}
	ssize_t n = read(w->out, to, room < READ_AT_ONCE ? room : READ_AT_ONCE);
	if (n < 0 && (errno == EAGAIN || errno == EINTR))
		return;
	if (n > 0)
		message_reader_filled(&w->reader, (size_t)n);
	while (w->out >= 0 && (next = message_reader_next(&w->reader, &m)) > 0) {
		sink->packet(sink->data, w->id, &m);
		message_finish(&m);
	}
	if (next < 0) {
		worker_broken(w, w->reader.reason);
	} else if (n <= 0 && w->out >= 0) {
		if (message_reader_partial(&w->reader)) {
			worker_broken(w, "the pipe ended in the middle of a packet");
			return;
		}
		poll_close(&w->out_poll, &w->out);
		sink->drained(sink->data, w->id);
	}
}

/* libuv does not tell of stops. */
static void on_child(uv_signal_t *signal, int number)
{
	struct local *l = signal->data;
	(void)number;
	for (struct worker *w = l->workers, *next; w; w = next) {
		siginfo_t si = { 0 };
		next = w->next;
		while (w->pid &&
		       !waitid(P_PID, (id_t)w->pid, &si, WSTOPPED | WCONTINUED | WNOHANG) &&
		       si.si_pid) {
			l->sink.stopped(l->sink.data, w->id, si.si_code == CLD_STOPPED);
			si = (siginfo_t){ 0 };
		}
	}
}

/* A worker writes its log itself; one that writes too much loses what it wrote. */
static void on_look(uv_timer_t *timer)
{
	static const char note[] = "batten: the log grew beyond 16 MiB, what stood here was cut\n";
	struct local *l = timer->data;
	struct stat s;
	for (struct worker *w = l->workers; w; w = w->next) {
		if (fstat(w->log, &s) || s.st_size <= LOG_MAX || ftruncate(w->log, 0))
			continue;
		if (write(w->log, note, sizeof note - 1) < 0)
			continue; /* a full disk: the worker's own lines are lost as well */
	}
	if (!l->workers)
		uv_timer_stop(timer);
}

/* The path of a worker; NULL: there is none, and the report knows. */
static const char *worker_path(struct local *l, const char *name, enum status *st,
                               const struct report *r)
{
	*st = ST_OK;
	if (l->name && !strcmp(l->name, name) && !access(l->path, X_OK))
		return l->path;
	free(l->name);
	free(l->path);
	l->path = NULL;
	l->name = strdup(name);
	*st = l->name ? roster_locate(&l->path, l->project, name, r) : ST_RESOURCE;
	if (*st != ST_OK) {
		free(l->name);
		l->name = NULL;
	}
	return l->path;
}

static enum status local_check(void *data, const struct Stats *s, const struct report *r)
{
	struct local *l = data;
	enum status st = ST_OK;
	if (!s->worker || !s->output)
		return report_error(r, ST_PARAMETER, "a job needs a worker and an output name");
	if (!worker_path(l, s->worker, &st, r))
		return st;
	for (int i = 0; i < s->n_inputs; i++)
		if (access(s->inputs[i].path, R_OK))
			return report_error(r, ST_INPUT, "cannot read the input '%s': %s",
			                    s->inputs[i].path, strerror(errno));
	return ST_OK;
}

static int log_open(struct local *l, struct Stats *s)
{
	free(s->log);
	s->log = text_print("%s/logs/%lld.log", l->project->hidden, (long long)s->id);
	return s->log ? open(s->log, O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666) : -1;
}

static enum status worker_start(struct worker *w, struct Stats *s, const struct report *r)
{
	struct local *l = w->local;
	enum status st;
	struct spawn spawn = {
		.stub = l->stub,
		.worker = worker_path(l, s->worker, &st, r),
		.log = w->log,
		.niceness = l->niceness,
		.memory_bytes = s->memory_mib
		                        ? (uint64_t)(s->memory_mib + MEMORY_SPARE_MIB +
		                                     (int64_t)MEMORY_THREAD_MIB * s->threads) *
		                                  MIB
		                        : 0,
	};
	if (!spawn.worker)
		return st;
	st = job_file_write(w->job_file, l->project, s, r);
	if (st == ST_OK)
		st = spawn_worker(&spawn, &w->pid, &w->in, &w->out, &w->pidfd, r);
	return st;
}

static void worker_listen(struct worker *w)
{
	struct local *l = w->local;
	uv_poll_init(l->loop, &w->out_poll, w->out);
	uv_poll_init(l->loop, &w->pid_poll, w->pidfd);
	w->out_poll.data = w->pid_poll.data = w;
	w->n_handles = 2;
	uv_poll_start(&w->out_poll, UV_READABLE, on_readable);
	uv_poll_start(&w->pid_poll, UV_READABLE, on_exit_seen);
	w->next = l->workers;
	l->workers = w;
	if (!uv_is_active((uv_handle_t *)&l->look))
		uv_timer_start(&l->look, on_look, LOG_LOOK_MS, LOG_LOOK_MS);
}

static enum status local_start(void *data, struct Stats *s, const struct report *r)
{
	struct local *l = data;
	struct worker *w = calloc(1, sizeof *w);
	char *host = strdup(l->host);
	enum status st = ST_RESOURCE;
	if (!w || !host)
		goto fail;
	w->local = l;
	w->id = s->id;
	w->out = w->pidfd = -1;
	w->job_file = text_print("%s/jobs/%lld.json", l->project->hidden, (long long)s->id);
	if (!w->job_file)
		goto fail;
	w->log = log_open(l, s);
	if (w->log < 0) {
		st = report_error(r, ST_RESOURCE, "cannot write the log '%s': %s",
		                  s->log ? s->log : "", strerror(errno));
		goto fail;
	}
	st = worker_start(w, s, r);
	if (st != ST_OK) {
		close(w->log);
		goto fail;
	}
	message_reader_init(&w->reader, FROM_WORKER);
	worker_listen(w);
	free(s->host);
	s->host = host;
	s->pid = w->pid;
	return ST_OK;
fail:
	if (w)
		free(w->job_file);
	free(w);
	free(host);
	return st;
}

/* Packets to a worker are smaller than what a pipe takes whole. */
static enum status local_send(void *data, int64_t id, enum message_type type, const json_t *body)
{
	struct worker *w = worker_find(data, id);
	struct text t = { 0 };
	enum status st = w ? message_encode(&t, type, body) : ST_INTERNAL;
	if (st == ST_OK && write(w->in, t.s, t.n) != (ssize_t)t.n)
		st = ST_RESOURCE;
	text_finish(&t);
	return st;
}

static void local_signal(void *data, int64_t id, enum launcher_signal signal)
{
	static const int numbers[] = {
		[LAUNCHER_STOP] = SIGSTOP,
		[LAUNCHER_CONTINUE] = SIGCONT,
		[LAUNCHER_TERMINATE] = SIGTERM,
		[LAUNCHER_KILL] = SIGKILL,
	};
	struct worker *w = worker_find(data, id);
	if (!w || !w->pid)
		return;
	kill(-w->pid, numbers[signal]);
	if (signal == LAUNCHER_TERMINATE)
		kill(-w->pid, SIGCONT); /* a stopped process would hear it only then */
}

static void local_note(void *data, int64_t id, const char *level, const char *text)
{
	const struct worker *w = worker_find(data, id);
	char *line = w ? text_print("%s: %s\n", level, text) : NULL;
	if (line && write(w->log, line, strlen(line)) < 0) {
		free(line); /* a full disk loses the note, not the job */
		return;
	}
	free(line);
}

static const char *local_job_file(void *data, int64_t id)
{
	const struct worker *w = worker_find(data, id);
	return w ? w->job_file : NULL;
}

static void local_forget(void *data, int64_t id)
{
	struct local *l = data;
	struct worker **at = &l->workers;
	while (*at && (*at)->id != id)
		at = &(*at)->next;
	struct worker *w = *at;
	if (!w)
		return;
	*at = w->next;
	poll_close(&w->out_poll, &w->out);
	if (w->pid) {
		kill(-w->pid, SIGKILL);
		poll_close(&w->pid_poll, &w->pidfd);
	}
	close(w->in);
	close(w->log);
	w->forgotten = true;
	worker_free(w);
}

/* Beside the program, in the build tree it lies in, or installed. */
static char *stub_find(void)
{
	static const char *const places[] = { "batten-launch", "jobs/batten-launch",
		                              "../../executive/jobs/batten-launch",
		                              "../libexec/batten/batten-launch" };
	char *folder = path_of_program(), *found = NULL;
	for (size_t i = 0; folder && !found && i < sizeof places / sizeof *places; i++) {
		found = path_join(folder, places[i]);
		if (found && access(found, X_OK)) {
			free(found);
			found = NULL;
		}
	}
	free(folder);
	return found;
}

enum status local_create(struct local **out, uv_loop_t *loop, const struct project *p, int niceness,
                         const struct report *r)
{
	char host[256] = "";
	struct local *l = calloc(1, sizeof *l);
	if (!l)
		return report_error(r, ST_RESOURCE, "out of memory");
	gethostname(host, sizeof host - 1);
	l->loop = loop;
	l->project = p;
	l->niceness = niceness;
	l->host = strdup(host);
	l->stub = stub_find();
	if (!l->host || !l->stub) {
		local_destroy(l);
		return report_error(r, ST_RESOURCE,
		                    "cannot find 'batten-launch' beside this program; build or "
		                    "install it again");
	}
	l->launcher = (struct launcher){
		.data = l,
		.check = local_check,
		.start = local_start,
		.send = local_send,
		.signal = local_signal,
		.note = local_note,
		.job_file = local_job_file,
		.forget = local_forget,
	};
	uv_signal_init(loop, &l->child);
	uv_timer_init(loop, &l->look);
	l->child.data = l->look.data = l;
	uv_signal_start(&l->child, on_child, SIGCHLD);
	*out = l;
	return ST_OK;
}

const struct launcher *local_launcher(struct local *l)
{
	return &l->launcher;
}

void local_connect(struct local *l, struct launcher_sink sink)
{
	l->sink = sink;
}

void local_close(struct local *l)
{
	while (l->workers)
		local_forget(l, l->workers->id);
	uv_close((uv_handle_t *)&l->child, NULL);
	uv_close((uv_handle_t *)&l->look, NULL);
}

void local_destroy(struct local *l)
{
	if (!l)
		return;
	free(l->stub);
	free(l->host);
	free(l->name);
	free(l->path);
	free(l);
}
