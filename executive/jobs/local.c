/* local.c - the launcher of workers on this machine: processes, pipes and their ends. */
#include "local.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "child.h"
#include "job_file.h"
#include "path.h"
#include "roster.h"
#include "process.h"
#include "shard.h"
#include "text.h"

/* What a worker may have beyond the memory of its job: its program, stacks, the allocator. */
enum { MIB = 1 << 20, MEMORY_SPARE_MIB = 256, MEMORY_THREAD_MIB = 16 };

static struct worker *worker_find(const struct local *l, int64_t id)
{
	struct worker *w = l->workers;
	while (w && w->id != id)
		w = w->next;
	return w;
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

static void local_bury(void *data, const struct Stats *s)
{
	struct local *l = data;
	enum status st;
	const char *path = s->worker ? worker_path(l, s->worker, &st, NULL) : NULL;
	if (path && s->host && !strcmp(s->host, l->host))
		process_bury(s->pid, path);
}

static int log_open(struct local *l, struct Stats *s)
{
	free(s->log);
	s->log = shard_path(l->project, "logs", shard_job(s->id), ".log");
	return s->log ? open(s->log, O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666) : -1;
}

static enum status worker_start(struct worker *w, struct Stats *s, const struct report *r)
{
	struct local *l = w->local;
	enum status st;
	struct spawn spawn = {
		.starter = l->starter,
		.worker = worker_path(l, s->worker, &st, r),
		.log = w->log,
		.niceness = l->niceness,
		.umask = s->umask,
		.memory_bytes = s->memory_mib
		                        ? (uint64_t)(s->memory_mib + MEMORY_SPARE_MIB +
		                                     (int64_t)MEMORY_THREAD_MIB * s->threads) *
		                                  MIB
		                        : 0,
	};
	char **words = NULL;
	if (!spawn.worker)
		return st;
	st = job_file_write(w->job_file, l->project, s, r);
	if (st == ST_OK && l->words) {
		spawn.memory_bytes = 0;
		st = l->words(l->words_data, s, spawn.worker, &words, r);
		spawn.words = words;
	}
	if (st == ST_OK)
		st = spawn_worker(&spawn, &w->pid, &w->in, &w->out, &w->pidfd, r);
	local_words_free(words);
	return st;
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
	w->job_file = shard_path(l->project, "jobs", s->id, ".json");
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
	child_listen(w);
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
	w->stop_looks = signal == LAUNCHER_STOP && !w->stopped;
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
	child_forget(w);
}

/* Beside the program, in the build tree it lies in, or installed. */
static char *starter_find(void)
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
	l->starter = starter_find();
	if (!l->host || !l->starter) {
		local_destroy(l);
		return report_error(r, ST_RESOURCE,
		                    "cannot find 'batten-launch' beside this program; build or "
		                    "install it again");
	}
	l->launcher = (struct launcher){
		.data = l,
		.check = local_check,
		.bury = local_bury,
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
	uv_signal_start(&l->child, child_on_signal, SIGCHLD);
	*out = l;
	return ST_OK;
}

void local_wrap(struct local *l, local_words *words, void *data)
{
	l->words = words;
	l->words_data = data;
}

void local_hello(struct local *l, double seconds)
{
	l->hello_s = seconds;
}

void local_words_free(char **words)
{
	for (size_t i = 0; words && words[i]; i++)
		free(words[i]);
	free(words);
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
	free(l->starter);
	free(l->host);
	free(l->name);
	free(l->path);
	free(l);
}
