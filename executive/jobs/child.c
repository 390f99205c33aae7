/* child.c - a worker's process: its pipe, its exit, its stops. */
#include "child.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

/* bytes of packets taken from one worker in one turn of the loop; bytes of a log */
enum { READ_AT_ONCE = 65536, LOG_MAX = 16 << 20 };

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
	if (w->late)
		snprintf(e.why, sizeof e.why, "no HELLO within %g s", l->hello_s);
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
		w->greeted = true;
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

/* The time stopped does not count. */
static void hello_begin(struct worker *w)
{
	const struct local *l = w->local;
	w->hello_ms = l->hello_s > 0 ? uv_now(l->loop) + (uint64_t)(l->hello_s * 1000) : 0;
}

static void hello_look(struct worker *w)
{
	if (w->greeted || w->stopped || w->late || !w->pid || !w->hello_ms ||
	    uv_now(w->local->loop) < w->hello_ms)
		return;
	w->late = true;
	kill(-w->pid, SIGKILL);
}

/* A process that waits in vfork hears a stop only when its child has become another program, which
 * a child stopped before that never does: all go on for a moment, and are stopped again. */
static void stop_look(struct worker *w)
{
	if (!w->stop_looks || !w->pid || ++w->stop_looks < STOP_LOOKS)
		return;
	kill(-w->pid, w->stop_looks % 2 ? SIGCONT : SIGSTOP);
}

/* libuv does not tell of stops. */
void child_on_signal(uv_signal_t *signal, int number)
{
	struct local *l = signal->data;
	(void)number;
	for (struct worker *w = l->workers, *next; w; w = next) {
		siginfo_t si = { 0 };
		next = w->next;
		while (w->pid &&
		       !waitid(P_PID, (id_t)w->pid, &si, WSTOPPED | WCONTINUED | WNOHANG) &&
		       si.si_pid) {
			w->stopped = si.si_code == CLD_STOPPED;
			w->stop_looks = w->stopped ? 0 : w->stop_looks;
			hello_begin(w);
			l->sink.stopped(l->sink.data, w->id, w->stopped);
			si = (siginfo_t){ 0 };
		}
	}
}

/* A worker writes its log itself; one that writes too much loses what it wrote. */
void child_on_look(uv_timer_t *timer)
{
	static const char note[] = "batten: the log grew beyond 16 MiB, what stood here was cut\n";
	struct local *l = timer->data;
	struct stat s;
	for (struct worker *w = l->workers; w; w = w->next) {
		hello_look(w);
		stop_look(w);
		if (fstat(w->log, &s) || s.st_size <= LOG_MAX || ftruncate(w->log, 0))
			continue;
		if (write(w->log, note, sizeof note - 1) < 0)
			continue; /* a full disk: the worker's own lines are lost as well */
	}
	if (!l->workers)
		uv_timer_stop(timer);
}

void child_listen(struct worker *w)
{
	struct local *l = w->local;
	uv_poll_init(l->loop, &w->out_poll, w->out);
	uv_poll_init(l->loop, &w->pid_poll, w->pidfd);
	w->out_poll.data = w->pid_poll.data = w;
	w->n_handles = 2;
	uv_poll_start(&w->out_poll, UV_READABLE, on_readable);
	uv_poll_start(&w->pid_poll, UV_READABLE, on_exit_seen);
	hello_begin(w);
	w->next = l->workers;
	l->workers = w;
	if (!uv_is_active((uv_handle_t *)&l->look))
		uv_timer_start(&l->look, child_on_look, LOG_LOOK_MS, LOG_LOOK_MS);
}

void child_forget(struct worker *w)
{
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
