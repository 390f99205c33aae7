/* file.c - whole files. */
#include "file.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include "path.h"
#include "text.h"

static enum status fail(const struct report *r, const char *what, const char *path, int error)
{
	return report_error(r, status_from_errno(error), "cannot %s '%s': %s", what, path,
	                    strerror(error));
}

/* What a regular file needs in memory at once, not by doubling; without it text grows by itself. */
static void make_room(struct text *t, int fd, uint64_t max)
{
	struct stat st;
	if (fstat(fd, &st) < 0 || !S_ISREG(st.st_mode) || st.st_size <= 0 ||
	    (uint64_t)st.st_size > max || (size_t)st.st_size < t->cap)
		return;
	char *s = realloc(t->s, (size_t)st.st_size + 1);
	if (!s)
		return;
	t->s = s;
	t->cap = (size_t)st.st_size + 1;
}

/* Append until there are n bytes, or all. Errors: the errno. */
static int read_up_to(int fd, struct text *t, uint64_t n)
{
	char block[1 << 16];
	while (t->n < n && !t->failed) {
		const uint64_t left = n - t->n;
		ssize_t got = read(fd, block, left < sizeof block ? left : sizeof block);
		if (got < 0 && errno == EINTR)
			continue;
		if (got < 0)
			return errno;
		if (got == 0)
			return 0;
		text_add_bytes(t, block, (size_t)got);
	}
	return 0;
}

enum status file_read_open(int fd, struct text *t)
{
	return read_up_to(fd, t, UINT64_MAX) || t->failed ? ST_RESOURCE : ST_OK;
}

bool file_stamp(const char *path, int64_t stamp[3])
{
	struct stat s;
	if (stat(path, &s) < 0)
		return false;
	stamp[0] = (int64_t)s.st_mtim.tv_sec * 1000000000 + s.st_mtim.tv_nsec;
	stamp[1] = (int64_t)s.st_size;
	stamp[2] = (int64_t)s.st_ino;
	return true;
}

enum status file_read_wanted(const char *path, uint64_t max, size_t look, file_wanted *wanted,
                             char **out, size_t *n, const struct report *r)
{
	struct stat st;
	struct text t = { 0 };
	int fd = open(path, O_RDONLY | O_CLOEXEC);

	if (fd < 0)
		return fail(r, "read", path, errno);
	if (fstat(fd, &st) == 0 && S_ISDIR(st.st_mode)) {
		close(fd);
		return fail(r, "read", path, EISDIR);
	}
	int error = read_up_to(fd, &t, look);
	if (!error && !t.failed && (!wanted || wanted(t.s ? t.s : "", t.n))) {
		make_room(&t, fd, max);
		error = read_up_to(fd, &t, max < UINT64_MAX ? max + 1 : max);
	}
	close(fd);
	if (error) {
		text_finish(&t);
		return fail(r, "read", path, error);
	}
	if (t.n > max) {
		text_finish(&t);
		return report_error(r, ST_RESOURCE,
		                    "cannot read '%s': it is larger than %llu bytes", path,
		                    (unsigned long long)max);
	}
	*n = t.n;
	*out = text_take(&t);
	if (!*out)
		return report_error(r, ST_RESOURCE, "cannot read '%s': memory ran out", path);
	return ST_OK;
}

enum status file_read(const char *path, uint64_t max, char **out, size_t *n, const struct report *r)
{
	return file_read_wanted(path, max, 0, NULL, out, n, r);
}

/* Its name is given through /proc. -1: not to be had here. */
static int open_nameless(const char *path)
{
	char *folder = path_folder(path);
	int fd = folder && path_exists("/proc/self/fd")
	                 ? open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0666)
	                 : -1;

	free(folder);
	return fd;
}

/* Beside the file, with that behind its name; a name that leaves no room for it is made brief. */
static char *temp_name(const char *path, const char *end)
{
	const char *name = path_file_name(path);
	char *brief = strlen(name) + strlen(end) > NAME_MAX ? path_brief_name(name) : strdup(name);
	char *temp = brief ? text_print("%.*s%s%s", (int)(name - path), path, brief, end) : NULL;

	free(brief);
	return temp;
}

/* umask() tells it only by setting it, for all threads. */
unsigned file_mask(void)
{
	char text[4096];
	int fd = open("/proc/self/status", O_RDONLY | O_CLOEXEC);
	ssize_t n = fd < 0 ? -1 : read(fd, text, sizeof text - 1);

	if (fd >= 0)
		close(fd);
	text[n > 0 ? n : 0] = '\0';
	const char *line = strstr(text, "\nUmask:");
	if (line)
		return (unsigned)strtoul(line + strlen("\nUmask:"), NULL, 8);
	mode_t mask = umask(077);
	umask(mask);
	return mask;
}

static int open_named(struct whole_file *f)
{
	f->temp = temp_name(f->path, ".XXXXXX");
	if (!f->temp) {
		errno = ENOMEM;
		return -1;
	}
	int fd = mkostemp(f->temp, O_CLOEXEC);
	if (fd < 0) {
		int error = errno;
		free(f->temp);
		f->temp = NULL;
		errno = error;
		return -1;
	}
	fchmod(fd, 0666 & ~file_mask());
	return fd;
}

/* Name a file that has none: only a rename can put it in another's place. 0 or errno. */
static int give_name(struct whole_file *f)
{
	enum { TRIES = 100 };
	char from[32], end[16];
	unsigned long random;

	snprintf(from, sizeof from, "/proc/self/fd/%d", fileno(f->stream));
	for (int i = 0; i < TRIES; i++) {
		if (getrandom(&random, sizeof random, 0) != sizeof random)
			return errno;
		free(f->temp);
		snprintf(end, sizeof end, ".%06lx", random & 0xffffff);
		f->temp = temp_name(f->path, end);
		if (!f->temp)
			return ENOMEM;
		if (!linkat(AT_FDCWD, from, AT_FDCWD, f->temp, AT_SYMLINK_FOLLOW))
			return 0;
		if (errno != EEXIST)
			break;
	}
	int error = errno;
	free(f->temp); /* another's, or none */
	f->temp = NULL;
	return error;
}

enum status whole_file_create(struct whole_file *f, const char *path, const struct report *r)
{
	*f = (struct whole_file){ .path = strdup(path) };
	if (!f->path)
		return report_error(r, ST_RESOURCE, "cannot write '%s': memory ran out", path);
	int fd = open_nameless(path);
	if (fd < 0)
		fd = open_named(f);
	if (fd < 0) {
		int error = errno;
		whole_file_abandon(f);
		return fail(r, "write", path, error);
	}
	f->stream = fdopen(fd, "w+");
	if (!f->stream) {
		close(fd);
		whole_file_abandon(f);
		return fail(r, "write", path, ENOMEM);
	}
	return ST_OK;
}

/* The new name itself must survive a power cut. */
static void sync_folder_of(const char *path)
{
	char *folder = path_folder(path);
	int fd = folder ? open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;

	if (fd >= 0) {
		fsync(fd);
		close(fd);
	}
	free(folder);
}

enum status whole_file_commit(struct whole_file *f, const struct report *r)
{
	int error = 0;

	if (ferror(f->stream)) /* an earlier write failed: ask the disk again for the reason */
		error = write(fileno(f->stream), "", 1) < 0 ? errno : ENOSPC;
	else if (fflush(f->stream) || fsync(fileno(f->stream)))
		error = errno;
	if (!error && !f->temp)
		error = give_name(f);
	if (fclose(f->stream) && !error)
		error = errno;
	f->stream = NULL;
	if (!error && rename(f->temp, f->path))
		error = errno;
	if (error) {
		enum status st = fail(r, "write", f->path, error);
		whole_file_abandon(f);
		return st;
	}
	sync_folder_of(f->path);
	free(f->temp);
	f->temp = NULL;
	whole_file_abandon(f);
	return ST_OK;
}

void whole_file_abandon(struct whole_file *f)
{
	if (f->stream)
		fclose(f->stream);
	if (f->temp)
		unlink(f->temp);
	free(f->temp);
	free(f->path);
	*f = (struct whole_file){ 0 };
}

enum status file_write(const char *path, const void *bytes, size_t n, const struct report *r)
{
	struct whole_file f;
	enum status st = whole_file_create(&f, path, r);

	if (st != ST_OK)
		return st;
	fwrite(bytes, 1, n, f.stream);
	return whole_file_commit(&f, r);
}

enum status folder_make(const char *path, unsigned mode, const struct report *r)
{
	char *copy = strdup(path);

	if (!copy)
		return report_error(r, ST_RESOURCE, "cannot make folder '%s': memory ran out",
		                    path);
	for (char *p = copy + 1;; p++) {
		if (*p && *p != '/')
			continue;
		char end = *p;
		*p = 0;
		if (mkdir(copy, mode) && errno != EEXIST && errno != EISDIR) {
			enum status st = fail(r, "make folder", path, errno);
			free(copy);
			return st;
		}
		if (!end)
			break;
		*p = '/';
	}
	bool there = path_is_folder(copy);
	free(copy);
	return there ? ST_OK : fail(r, "make folder", path, ENOTDIR);
}

void file_hold_standard(void)
{
	/* the wrong way round: reading or writing fails, as it does where they are closed */
	for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++)
		if (fcntl(fd, F_GETFD) < 0 &&
		    open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY) < 0)
			return;
}
