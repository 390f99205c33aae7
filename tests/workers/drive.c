/* drive.c - see drive.h. */
#include "drive.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <ftw.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

void place_enter(struct place *p)
{
	strcpy(p->folder, "/tmp/batten-test-XXXXXX");
	assert_non_null(mkdtemp(p->folder));
	assert_int_equal(chdir(p->folder), 0);
}

static int remove_one(const char *path, const struct stat *st, int flag, struct FTW *ftw)
{
	(void)st;
	(void)flag;
	(void)ftw;
	return remove(path);
}

void place_leave(struct place *p)
{
	assert_int_equal(chdir("/"), 0);
	assert_int_equal(nftw(p->folder, remove_one, 8, FTW_DEPTH | FTW_PHYS), 0);
}

static const char surface_text[] = "\ntype surface\n\torder 2 2\n\tncontpts 2 2\n"
                                   "\tperiodic no no\n\tdomain 0 1 0 1\n\tuknots 0 0 1 1\n"
                                   "\tvknots 0 0 1 1\n\tcontpts\n";

void place_models(void)
{
	struct text t = { 0 };
	const char *points = "0 0 0 1  0 1 0 1  1 0 0 1  1 1 0 1\nend\n";
	text_addf(&t, "batten base 1\nunit \"m\" 1000\nscale 1\nentities 1\n%s%s", surface_text,
	          points);
	spill("one.base", t.s);
	text_reset(&t);
	text_addf(&t, "batten base 1\nunit \"m\" 1000\nscale 1\nentities 3\n%s%s", surface_text,
	          points);
	text_add(&t, "\ntype curve\n\torder 2\n\tncontpts 2\n\tperiodic no\n\tdomain 0 1\n"
	             "\tknots 0 0 1 1\n\tcontpts\n\t0 0 0 1\n\t1 1 0 1\nend\n");
	text_addf(&t, "%s0 0 5 1  0 1 5 1  1 0 5 1  1 1 5 1\nend\n", surface_text);
	spill("two.base", t.s);
	text_finish(&t);
}

bool there(const char *path)
{
	return access(path, F_OK) == 0;
}

int count_files(void)
{
	int n = 0;
	DIR *dir = opendir(".");
	assert_non_null(dir);
	for (struct dirent *e; (e = readdir(dir));)
		n += strcmp(e->d_name, ".") != 0 && strcmp(e->d_name, "..") != 0;
	closedir(dir);
	return n;
}

static char *read_all(int fd, size_t *n)
{
	struct text t = { 0 };
	char block[4096];
	ssize_t got;
	while ((got = read(fd, block, sizeof block)) > 0)
		text_add_bytes(&t, block, (size_t)got);
	text_add_bytes(&t, "", 0);
	*n = t.n;
	return t.s ? text_take(&t) : strdup("");
}

char *slurp(const char *path, size_t *n)
{
	int fd = open(path, O_RDONLY);
	if (fd < 0)
		fail_msg("there is no file %s", path);
	char *bytes = read_all(fd, n);
	close(fd);
	return bytes;
}

void spill(const char *path, const char *text)
{
	FILE *f = fopen(path, "w");
	assert_non_null(f);
	fputs(text, f);
	assert_int_equal(fclose(f), 0);
}

void assert_same_file(const char *a, const char *b)
{
	size_t na, nb;
	char *x = slurp(a, &na), *y = slurp(b, &nb);
	assert_int_equal(na, nb);
	assert_memory_equal(x, y, na);
	free(x);
	free(y);
}

int count_lines(const char *path)
{
	size_t n;
	int lines = 0;
	if (!there(path))
		return 0;
	char *text = slurp(path, &n);
	for (size_t i = 0; i < n; i++)
		lines += text[i] == '\n';
	free(text);
	return lines;
}

/* In the child: environment and arguments of a NULL-ended list, then the program. */
static _Noreturn void become(const char *program, va_list list)
{
	char *argv[ARGS_MAX] = { (char *)program };
	int n = 1;
	bool environment = true;
	for (char *word; (word = va_arg(list, char *)) && n < ARGS_MAX - 1;) {
		environment = environment && strncmp(word, "PROBE_", 6) == 0;
		if (environment)
			putenv(word);
		else
			argv[n++] = word;
	}
	execv(program, argv);
	_exit(127);
}

static int wait_for(pid_t pid)
{
	int status;
	while (waitpid(pid, &status, 0) < 0)
		assert_int_equal(errno, EINTR);
	return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

static struct ran run_within(int resource, unsigned long limit, const char *program, va_list list)
{
	struct ran r = { 0 };
	char out[] = "/tmp/batten-out-XXXXXX", err[] = "/tmp/batten-err-XXXXXX";
	int out_fd = mkstemp(out), err_fd = mkstemp(err);
	size_t n;
	pid_t pid = fork();
	assert_true(pid >= 0);
	if (pid == 0) {
		struct rlimit most = { limit, limit };
		dup2(out_fd, STDOUT_FILENO);
		dup2(err_fd, STDERR_FILENO);
		if (limit)
			setrlimit((__rlimit_resource_t)resource, &most);
		become(program, list);
	}
	r.exit_status = wait_for(pid);
	close(out_fd);
	close(err_fd);
	r.out = slurp(out, &n);
	r.err = slurp(err, &n);
	unlink(out);
	unlink(err);
	return r;
}

struct ran run_list(const char *program, va_list list)
{
	return run_within(0, 0, program, list);
}

struct ran run_hand(const char *program, ...)
{
	va_list list;
	va_start(list, program);
	struct ran r = run_list(program, list);
	va_end(list);
	return r;
}

struct ran run_limited(int resource, unsigned long limit, const char *program, ...)
{
	va_list list;
	va_start(list, program);
	struct ran r = run_within(resource, limit, program, list);
	va_end(list);
	return r;
}

void ran_finish(struct ran *r)
{
	free(r->out);
	free(r->err);
}

void peer_start(struct peer *p, const char *program, ...)
{
	int to[2], from[2];
	va_list list;
	*p = (struct peer){ 0 };
	assert_int_equal(pipe2(to, O_CLOEXEC), 0);
	assert_int_equal(pipe2(from, O_CLOEXEC), 0);
	va_start(list, program);
	p->pid = fork();
	assert_true(p->pid >= 0);
	if (p->pid == 0) {
		int log = open("peer.log", O_WRONLY | O_CREAT | O_APPEND, 0666);
		dup2(to[0], STDIN_FILENO);
		dup2(from[1], STDOUT_FILENO);
		dup2(log, STDERR_FILENO);
		become(program, list);
	}
	va_end(list);
	close(to[0]);
	close(from[1]);
	p->to = to[1];
	p->from = from[0];
	message_reader_init(&p->reader, FROM_WORKER);
}

void peer_send(struct peer *p, enum message_type type, const char *key, const char *value)
{
	json_t *o = key ? json_pack("{s:s}", key, value) : NULL;
	assert_int_equal(message_send(p->to, type, o), ST_OK);
	json_decref(o);
}

bool peer_next(struct peer *p)
{
	message_finish(&p->last);
	for (;;) {
		int got = message_reader_next(&p->reader, &p->last);
		if (got < 0)
			fail_msg("not a packet: %s", p->reader.reason);
		if (got > 0) {
			p->n_units += p->last.type == MESSAGE_UNIT;
			return true;
		}
		struct pollfd ready = { .fd = p->from, .events = POLLIN };
		if (poll(&ready, 1, 60000) == 0) {
			kill(p->pid, SIGKILL);
			fail_msg("the worker is silent");
		}
		size_t room;
		char *bytes = message_reader_room(&p->reader, 4096, &room);
		ssize_t n = read(p->from, bytes, room);
		if (n <= 0) {
			assert_false(message_reader_partial(&p->reader));
			return false;
		}
		message_reader_filled(&p->reader, (size_t)n);
	}
}

bool peer_until(struct peer *p, enum message_type type)
{
	while (peer_next(p))
		if (p->last.type == type)
			return true;
	return false;
}

void peer_drain(struct peer *p)
{
	while (peer_next(p))
		;
}

int peer_end(struct peer *p)
{
	message_finish(&p->last);
	message_reader_finish(&p->reader);
	if (p->to >= 0)
		close(p->to);
	int exit_status = wait_for(p->pid);
	close(p->from);
	return exit_status;
}

void write_job(const char *path, const char *worker, const char *input, const char *output,
               const char *part, const char *parameters, const char *extra)
{
	struct text t = { 0 };
	text_addf(&t,
	          "{\"version\":1,\"id\":7,\"worker\":\"%s\",\"inputs\":[{\"path\":\"%s\","
	          "\"entity\":null}],\"parameters\":{%s},\"output\":\"%s\",\"part\":\"%s\","
	          "\"threads\":1,\"memory\":null%s}\n",
	          worker, input, parameters, output, part, extra);
	spill(path, t.s);
	text_finish(&t);
}
