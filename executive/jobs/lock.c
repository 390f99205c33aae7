/* lock.c - one service a project folder. */
#include "lock.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <time.h>
#include <unistd.h>

#include "path.h"

/* bytes of the file that are locked, far beyond its text; how often a service is met that neither
 * listens nor ends */
enum { LOCK_SERVICE = 1 << 20, LOCK_DEAF, TRIES = 100 };

static int lock_byte(int fd, int how, short type, off_t at)
{
	struct flock l = { .l_type = type, .l_whence = SEEK_SET, .l_start = at, .l_len = 1 };
	int n;
	while ((n = fcntl(fd, how, &l)) < 0 && errno == EINTR)
		;
	return n;
}

/* The lock's text: "host NAME, process NUMBER", then the socket's path, a line each. */
char *lock_socket(const struct project *p)
{
	char *path = path_join(p->hidden, "lock"), text[1024] = "", *found = NULL;
	int fd = path ? open(path, O_RDONLY | O_CLOEXEC) : -1;
	ssize_t n = fd < 0 ? -1 : read(fd, text, sizeof text - 1);
	if (fd >= 0)
		close(fd);
	free(path);
	char *line = n > 0 ? strchr(text, '\n') : NULL;
	if (line && line[1] == '/') {
		line++;
		line[strcspn(line, "\n")] = '\0';
		found = strdup(line);
	}
	return found;
}

static bool somebody_listens(const struct project *p)
{
	struct sockaddr_un address = { .sun_family = AF_UNIX };
	int fd = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
	char *path = lock_socket(p);
	bool there = false;
	if (fd >= 0 && path && strlen(path) < sizeof address.sun_path) {
		strcpy(address.sun_path, path);
		there = !connect(fd, (struct sockaddr *)&address, sizeof address);
	}
	if (fd >= 0)
		close(fd);
	free(path);
	return there;
}

static bool lock_try(const struct project *p, int fd, bool wait)
{
	bool taken = !lock_byte(fd, F_OFD_SETLK, F_WRLCK, LOCK_SERVICE);
	for (int i = 0; i < TRIES && wait && !taken && !somebody_listens(p); i++) {
		lock_byte(fd, F_OFD_SETLKW, F_RDLCK, LOCK_DEAF);
		lock_byte(fd, F_OFD_SETLK, F_UNLCK, LOCK_DEAF);
		taken = !lock_byte(fd, F_OFD_SETLK, F_WRLCK, LOCK_SERVICE);
	}
	return taken;
}

static enum status lock_held(const struct project *p, int fd, const struct report *r)
{
	char who[300] = "";
	ssize_t n = pread(fd, who, sizeof who - 1, 0);
	who[n > 0 ? strcspn(who, "\n") : 0] = '\0';
	return report_error(r, ST_RESOURCE, "a service runs already in '%s' (%s)", p->folder,
	                    *who ? who : "it is just starting");
}

enum status lock_take(const struct project *p, bool wait, int *fd, const struct report *r)
{
	char *path = path_join(p->hidden, "lock"), host[256] = "", who[512];
	enum status st = ST_OK;
	*fd = path ? open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0600) : -1;
	if (*fd < 0) {
		st = report_error(r, ST_RESOURCE, "cannot make the lock '%s': %s",
		                  path ? path : "lock", strerror(errno));
	} else if (!lock_try(p, *fd, wait)) {
		st = lock_held(p, *fd, r);
	} else {
		lock_listening(*fd, false);
		gethostname(host, sizeof host - 1);
		int n = snprintf(who, sizeof who, "host %s, process %ld\n%s\n", host,
		                 (long)getpid(), p->socket);
		errno = ENOSPC; /* a short write does not say why */
		if (ftruncate(*fd, 0) || pwrite(*fd, who, (size_t)n, 0) != n)
			st = report_error(r, ST_RESOURCE, "cannot write '%s': %s", path,
			                  strerror(errno));
	}
	if (st != ST_OK && *fd >= 0)
		close(*fd);
	free(path);
	return st;
}

/* Locks of files cannot be waited for with a limit but by looking again. */
bool lock_is_deaf(const struct project *p, int ms)
{
	enum { LOOK_MS = 5 };
	const struct timespec pause = { .tv_nsec = LOOK_MS * 1000000 };
	char *path = path_join(p->hidden, "lock");
	int fd = path ? open(path, O_RDONLY | O_CLOEXEC) : -1;
	bool met = false, deaf = fd >= 0;
	for (int waited = 0; deaf && waited <= ms; waited += LOOK_MS) {
		struct flock l = { .l_type = F_WRLCK, .l_start = LOCK_DEAF, .l_len = 1 };
		deaf = !fcntl(fd, F_OFD_GETLK, &l) && l.l_type != F_UNLCK;
		met |= deaf;
		if (deaf)
			nanosleep(&pause, NULL);
	}
	if (fd >= 0)
		close(fd);
	free(path);
	return met;
}

void lock_touch(int fd)
{
	futimens(fd, NULL);
}

int64_t lock_touched(const struct project *p)
{
	char *path = path_join(p->hidden, "lock");
	struct stat s;
	bool there = path && !stat(path, &s);
	free(path);
	return there ? (int64_t)s.st_mtim.tv_sec * 1000000000 + s.st_mtim.tv_nsec : 0;
}

void lock_listening(int fd, bool listening)
{
	if (listening)
		lock_byte(fd, F_OFD_SETLK, F_UNLCK, LOCK_DEAF);
	else
		lock_byte(fd, F_OFD_SETLKW, F_WRLCK, LOCK_DEAF);
}
