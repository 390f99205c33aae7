/* slurm_order.c - run a program of Slurm without waiting for it, and hear what it says. */
#include "slurm_order.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/pidfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include "text.h"

extern char **environ;

struct order {
	struct orders *all; /* borrowed */
	struct order *next;
	uv_process_t process;
	uv_pipe_t pipe;
	uv_timer_t limit;
	int n_handles; /* still open */
	int status;
	bool late; /* its time is over */
	struct text output;
	order_done *done;
	void *data;
	int64_t tag;
};

struct orders {
	uv_loop_t *loop;
	struct order *first;
	bool closing;
};

enum status orders_create(struct orders **out, uv_loop_t *loop)
{
	struct orders *c = calloc(1, sizeof *c);
	if (!c)
		return ST_RESOURCE;
	c->loop = loop;
	*out = c;
	return ST_OK;
}

static void order_free(struct order *k)
{
	text_finish(&k->output);
	free(k);
}

/* Both the process and its pipe have ended. */
static void on_closed(uv_handle_t *h)
{
	struct order *k = h->data;
	struct orders *c = k->all;
	if (--k->n_handles)
		return;
	struct order **at = &c->first;
	while (*at != k)
		at = &(*at)->next;
	*at = k->next;
	if (!c->closing)
		k->done(k->data, k->tag, k->output.failed ? -1 : k->status,
		        k->output.n ? k->output.s : "");
	order_free(k);
}

static void handle_close(uv_handle_t *h)
{
	if (!uv_is_closing(h))
		uv_close(h, on_closed);
}

static void on_exit_seen(uv_process_t *p, int64_t status, int signal)
{
	struct order *k = p->data;
	k->status = signal || k->late ? -1 : (int)status;
	handle_close((uv_handle_t *)p);
	/* what it left behind may hold its pipe */
	if (k->late)
		handle_close((uv_handle_t *)&k->pipe);
	if (uv_is_closing((uv_handle_t *)&k->pipe))
		handle_close((uv_handle_t *)&k->limit);
}

/* A program that waits for a controller that is gone is as one that was refused. */
static void on_limit(uv_timer_t *t)
{
	struct order *k = t->data;
	k->late = true;
	if (uv_is_closing((uv_handle_t *)&k->process)) {
		handle_close((uv_handle_t *)&k->pipe);
		handle_close((uv_handle_t *)t);
	} else {
		uv_process_kill(&k->process, SIGKILL);
	}
}

static void on_room(uv_handle_t *h, size_t wanted, uv_buf_t *b)
{
	(void)h;
	*b = uv_buf_init(malloc(wanted), (unsigned)wanted);
}

static void on_read(uv_stream_t *s, ssize_t n, const uv_buf_t *b)
{
	struct order *k = s->data;
	if (n > 0)
		text_add_bytes(&k->output, b->base, (size_t)n);
	free(b->base);
	if (n < 0 || k->output.failed || k->output.n > ORDER_OUTPUT_MAX) {
		handle_close((uv_handle_t *)s);
		if (uv_is_closing((uv_handle_t *)&k->process))
			handle_close((uv_handle_t *)&k->limit);
	}
}

bool order_run(struct orders *c, char *const argv[], order_done *done, void *data, int64_t tag)
{
	struct order *k = calloc(1, sizeof *k);
	if (!k)
		return false;
	k->all = c;
	k->done = done;
	k->data = data;
	k->tag = tag;
	k->process.data = k->pipe.data = k->limit.data = k;
	k->n_handles = 3;
	uv_pipe_init(c->loop, &k->pipe, 0);
	uv_timer_init(c->loop, &k->limit);
	uv_stdio_container_t io[3] = {
		{ .flags = UV_IGNORE },
		{ .flags = UV_CREATE_PIPE | UV_WRITABLE_PIPE,
		  .data.stream = (uv_stream_t *)&k->pipe },
		{ .flags = UV_IGNORE },
	};
	uv_process_options_t options = {
		.file = argv[0],
		.args = (char **)argv,
		.stdio = io,
		.stdio_count = 3,
		.exit_cb = on_exit_seen,
	};
	k->next = c->first;
	c->first = k;
	k->status = -1;
	/* where it could not be started its done is called with -1, as after any failure */
	if (uv_spawn(c->loop, &k->process, &options)) {
		handle_close((uv_handle_t *)&k->process);
		handle_close((uv_handle_t *)&k->pipe);
		handle_close((uv_handle_t *)&k->limit);
		return true;
	}
	uv_timer_start(&k->limit, on_limit, ORDER_MS, 0);
	uv_read_start((uv_stream_t *)&k->pipe, on_room, on_read);
	return true;
}

void orders_close(struct orders *c)
{
	c->closing = true;
	for (struct order *k = c->first; k; k = k->next) {
		handle_close((uv_handle_t *)&k->process);
		handle_close((uv_handle_t *)&k->pipe);
		handle_close((uv_handle_t *)&k->limit);
	}
}

void orders_destroy(struct orders *c)
{
	free(c);
}

bool order_wait(char *const argv[], int ms, bool *said)
{
	posix_spawn_file_actions_t actions;
	pid_t pid;
	int status = -1, out[2];
	char byte;
	if (pipe2(out, O_CLOEXEC))
		return false;
	posix_spawn_file_actions_init(&actions);
	posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDWR, 0);
	posix_spawn_file_actions_adddup2(&actions, out[1], 1);
	posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_RDWR, 0);
	int error = posix_spawnp(&pid, argv[0], &actions, NULL, argv, environ);
	posix_spawn_file_actions_destroy(&actions);
	close(out[1]);
	struct pollfd p = { .fd = error ? -1 : pidfd_open(pid, 0), .events = POLLIN };
	if (!error) {
		if (p.fd < 0 || poll(&p, 1, ms) < 1)
			kill(pid, SIGKILL);
		waitpid(pid, &status, 0);
	}
	if (p.fd >= 0)
		close(p.fd);
	if (said)
		*said = read(out[0], &byte, 1) == 1;
	close(out[0]);
	return !error && WIFEXITED(status) && !WEXITSTATUS(status);
}
