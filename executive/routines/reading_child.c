/* reading_child.c - `batten import` as a child that hands over a whole model. */
#include "reading_child.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base.h"
#include "file.h"
#include "json.h"
#include "number.h"
#include "path.h"
#include "text.h"

extern char **environ;

enum { LOOK_MS = 50, ANSWER_MAX = 64 << 20, LINE_MAX_BYTES = 64 };
/* descriptors of the child: what it hands over, and how far it is */
enum { FD_MODEL = 3, FD_PROGRESS = 4 };

static const double CHILD_SHARE = 0.9; /* of the whole; the rest is reading what it hands over */

enum { PIPE_ANSWER, PIPE_SAID, PIPE_PROGRESS, N_PIPES };

struct child {
	pid_t pid;
	int ends[N_PIPES][2]; /* -1: closed */
	int model;            /* file without a name */
	int watch;            /* readable when it has exited; -1: it has, or was not started */
	int how;              /* of its exit, as of waitpid */
	struct text answer, said;
	char line[LINE_MAX_BYTES]; /* of progress, the part that has come */
	size_t n_line;
};

/* ------------------------------------------------------------ start */

static void close_end(int *fd)
{
	if (*fd >= 0)
		close(*fd);
	*fd = -1;
}

static void child_finish(struct child *c)
{
	for (int k = 0; k < N_PIPES; k++)
		for (int end = 0; end < 2; end++)
			close_end(&c->ends[k][end]);
	close_end(&c->model);
	close_end(&c->watch);
	text_finish(&c->answer);
	text_finish(&c->said);
}

static int file_without_name(void)
{
	char name[] = "/tmp/batten-reading-XXXXXX";
	int fd = open("/tmp", O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);

	if (fd < 0 && (fd = mkostemp(name, O_CLOEXEC)) >= 0)
		unlink(name);
	return fd;
}

/* Descriptors above those of the child, so that putting one in place closes none of the others. */
static bool raise_fd(int *fd)
{
	const int up = *fd < 0 ? -1 : fcntl(*fd, F_DUPFD_CLOEXEC, FD_PROGRESS + 1);

	close_end(fd);
	*fd = up;
	return up >= 0;
}

static bool open_pipes(struct child *c)
{
	bool good = true;

	for (int k = 0; k < N_PIPES && good; k++)
		good = pipe2(c->ends[k], O_CLOEXEC) == 0 && raise_fd(&c->ends[k][1]);
	c->model = good ? file_without_name() : -1;
	return good && raise_fd(&c->model);
}

static int spawn(struct child *c, const char *program, const char *path)
{
	static const int place[N_PIPES] = { STDOUT_FILENO, STDERR_FILENO, FD_PROGRESS };
	char *const argv[] = { (char *)(size_t) "batten", (char *)(size_t) "import",
		               (char *)(size_t) "--json", (char *)(size_t) "--model-fd",
		               (char *)(size_t) "3",      (char *)(size_t) "--progress-fd",
		               (char *)(size_t) "4",      (char *)(size_t) "--",
		               (char *)(size_t)path,      NULL };
	posix_spawn_file_actions_t actions;
	posix_spawnattr_t how;
	int e = 0;

	posix_spawn_file_actions_init(&actions);
	posix_spawnattr_init(&how);
	/* a group of its own: Ctrl-C is ours to pass on */
	posix_spawnattr_setflags(&how, POSIX_SPAWN_SETPGROUP);
	posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
	for (int k = 0; k < N_PIPES; k++)
		posix_spawn_file_actions_adddup2(&actions, c->ends[k][1], place[k]);
	posix_spawn_file_actions_adddup2(&actions, c->model, FD_MODEL);
	e = posix_spawn(&c->pid, program, &actions, &how, argv, environ);
	posix_spawnattr_destroy(&how);
	posix_spawn_file_actions_destroy(&actions);
	for (int k = 0; k < N_PIPES; k++)
		close_end(&c->ends[k][1]);
	if (!e && (c->watch = (int)syscall(SYS_pidfd_open, c->pid, 0)) < 0) {
		e = errno;
		kill(-c->pid, SIGKILL);
		waitpid(c->pid, &c->how, 0);
	}
	return e;
}

static enum status start(struct child *c, const struct reading_child *r, const char *path,
                         const struct report *report)
{
	char *folder = r->program ? NULL : path_of_program();
	char *beside = folder ? path_join(folder, "batten") : NULL;
	const char *program = r->program ? r->program : beside;
	int e = ENOMEM;

	if (program)
		e = open_pipes(c) ? spawn(c, program, path) : errno;
	enum status st =
	        e ? report_error(report, ST_RESOURCE, "cannot start batten import: %s", strerror(e))
	          : ST_OK;
	free(beside);
	free(folder);
	return st;
}

/* ------------------------------------------------------------ listen */

static void take_progress(struct child *c, const char *bytes, size_t n, const struct progress *p)
{
	for (size_t i = 0; i < n; i++) {
		double fraction;
		if (bytes[i] != '\n') {
			if (c->n_line + 1 < sizeof c->line)
				c->line[c->n_line++] = bytes[i];
			continue;
		}
		c->line[c->n_line] = 0;
		c->n_line = 0;
		if (p && p->step && number_parse(c->line, &fraction) && fraction >= 0 &&
		    fraction <= 1)
			p->step(p->data, CHILD_SHARE * fraction);
	}
}

/* What one pipe has; its end closes it. */
static void take(struct child *c, int k, const struct progress *p)
{
	struct text *to = k == PIPE_ANSWER ? &c->answer : &c->said;
	char block[1 << 14];
	const ssize_t n = read(c->ends[k][0], block, sizeof block);

	if (n < 0 && errno == EINTR)
		return;
	if (n <= 0)
		close_end(&c->ends[k][0]);
	else if (k == PIPE_PROGRESS)
		take_progress(c, block, (size_t)n, p);
	else if (to->n < ANSWER_MAX)
		text_add_bytes(to, block, (size_t)n);
}

static void bury(struct child *c)
{
	while (waitpid(c->pid, &c->how, 0) < 0 && errno == EINTR)
		;
	close_end(&c->watch);
}

/* Until the child has ended or is to stop. It has ended when it has exited and its answer and its
 * sentences are all there, in either order. */
static enum status listen_to(struct child *c, const struct progress *p)
{
	while (c->watch >= 0 || c->ends[PIPE_ANSWER][0] >= 0 || c->ends[PIPE_SAID][0] >= 0) {
		struct pollfd fds[N_PIPES + 1];
		for (int k = 0; k < N_PIPES; k++)
			fds[k] = (struct pollfd){ .fd = c->ends[k][0], .events = POLLIN };
		fds[N_PIPES] = (struct pollfd){ .fd = c->watch, .events = POLLIN };
		if (p && p->stop && atomic_load(p->stop)) {
			kill(-c->pid, SIGKILL);
			if (c->watch >= 0)
				bury(c);
			return ST_CANCELLED;
		}
		if (poll(fds, N_PIPES + 1, LOOK_MS) <= 0)
			continue;
		for (int k = 0; k < N_PIPES; k++)
			if (fds[k].fd >= 0 && fds[k].revents)
				take(c, k, p);
		if (fds[N_PIPES].revents)
			bury(c);
	}
	return ST_OK;
}

/* ------------------------------------------------------------ judge */

/* Its last sentence, without the name of the program before it. */
static const char *last_sentence(struct text *said)
{
	static const char head[] = "batten import: ";
	char *p = said->s ? said->s : (char *)(size_t) "";

	while (said->n && said->s[said->n - 1] == '\n')
		said->s[--said->n] = 0;
	if (strrchr(p, '\n'))
		p = strrchr(p, '\n') + 1;
	return strncmp(p, head, sizeof head - 1) ? p : p + sizeof head - 1;
}

static enum status judge(struct child *c, const char *path, const struct report *r)
{
	static const enum status by_exit[] = { ST_OK, ST_INPUT, ST_PARAMETER };
	const int how = c->how;
	const int rc = WIFEXITED(how) ? WEXITSTATUS(how) : -1;
	const char *said = last_sentence(&c->said);

	if (rc == 0)
		return ST_OK;
	if (rc < 0)
		return report_error(r, ST_INPUT,
		                    "reading '%s' crashed: %s; nothing else was harmed", path,
		                    strsignal(WTERMSIG(how)));
	const enum status st = rc < 3 ? by_exit[rc] : ST_INPUT;
	return *said ? report_error(r, st, "%s", said)
	             : report_error(r, st, "reading '%s' failed, exit status %d", path, rc);
}

/* ------------------------------------------------------------ take over */

/* What could not be read, and what was wrong, is not in the file. */
static enum status take_complaints(struct model *m, const struct text *answer,
                                   const struct report *r)
{
	json_t *o = NULL, *x;
	size_t k;
	enum status st = json_parse_object(answer->s ? answer->s : "", answer->n,
	                                   "answer of batten import", &o, r);

	json_array_foreach(json_object_get(o, "skipped"), k, x)
	{
		if (st != ST_OK)
			break;
		st = model_skip(m, (int)json_int(x, "type", 0), (int)json_int(x, "first_de", 0),
		                json_text(x, "reason", ""));
		if (st == ST_OK)
			m->skipped[m->n_skipped - 1].count = (int)json_int(x, "count", 1);
	}
	json_array_foreach(json_object_get(o, "warnings"), k, x) if (st == ST_OK) st =
	        model_warn(m, "%s", json_string_value(x) ? json_string_value(x) : "");
	json_decref(o);
	return st;
}

/* The second part of the progress. */
static void step_after(void *data, double fraction)
{
	const struct progress *p = data;

	if (p->step)
		p->step(p->data, CHILD_SHARE + (1 - CHILD_SHARE) * fraction);
}

static enum status take_over(struct child *c, struct model *out, const char *path,
                             const struct progress *p, const struct report *r)
{
	const struct progress after = { p ? step_after : NULL, (void *)(size_t)p,
		                        p ? p->stop : NULL };
	struct text t = { 0 };
	enum status st =
	        lseek(c->model, 0, SEEK_SET) < 0 ? ST_RESOURCE : file_read_open(c->model, &t);

	if (st != ST_OK)
		report_error(r, st, "cannot take over what was read of '%s'", path);
	else
		st = base_parse(out, t.s ? t.s : "", t.n, path, &after, r);
	text_finish(&t);
	if (st == ST_OK)
		st = take_complaints(out, &c->answer, r);
	if (st == ST_OK && (st = model_set_text(&out->file, path)) != ST_OK)
		report_error(r, st, "memory ran out");
	return st;
}

/* ------------------------------------------------------------ all of it */

/* Ours, or no file at all: nothing that a child would be needed for. */
static bool is_ours(const char *path)
{
	char head[4096];
	struct stat file;
	const int fd = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK); /* a pipe without a writer */
	ssize_t n = 0;
	bool plain = fd >= 0 && !fstat(fd, &file) && S_ISREG(file.st_mode);

	if (plain)
		n = pread(fd, head, sizeof head, 0);
	if (fd >= 0)
		close(fd);
	return fd < 0 || (plain && (n <= 0 || base_recognise(head, (size_t)n)));
}

enum status reading_child(void *data, struct model *out, const char *path, const struct progress *p,
                          const struct report *r)
{
	struct child c = { .ends = { { -1, -1 }, { -1, -1 }, { -1, -1 } },
		           .model = -1,
		           .watch = -1 };

	model_init(out);
	if (is_ours(path))
		return model_read(out, path, p, r);
	enum status st = start(&c, data, path, r);
	if (st == ST_OK) {
		st = listen_to(&c, p);
		if (st == ST_OK)
			st = judge(&c, path, r);
		else
			report_error(r, st, "reading '%s' was stopped", path);
	}
	if (st == ST_OK)
		st = take_over(&c, out, path, p, r);
	if (st != ST_OK)
		model_finish(out);
	child_finish(&c);
	return st;
}
