/* part.c - the part file: append records, find them again, trust nothing that is torn. */
#include "part.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include "hash.h"
#include "path.h"
#include "text.h"

enum { MAGIC_SIZE = 8, HEADER_SIZE = 24, CHECKSUM_SIZE = 8, RECORD_SIZE = 32, LAYOUT = 1 };
static const char magic[] = "BATTENPT";

/* Where a unit's bytes lie in the file; at 0: not there. */
struct span {
	uint64_t at, n;
};

struct block {
	char *bytes;
	size_t n;
};

struct part {
	char *path; /* owned */
	int fd;
	struct text header; /* what the file begins with: the key and all */
	size_t n_units, count;
	struct span *spans;   /* owned, n_units */
	uint64_t end;         /* behind the last whole record */
	struct block *blocks; /* owned; older ones stay, their bytes are promised until the close */
	size_t n_blocks;
	pthread_mutex_t lock;
};

static void put_u64(unsigned char *p, uint64_t x)
{
	for (int i = 0; i < 8; i++)
		p[i] = (unsigned char)(x >> (8 * i));
}

static uint64_t get_u64(const char *bytes)
{
	const unsigned char *p = (const unsigned char *)bytes;
	uint64_t x = 0;
	for (int i = 7; i >= 0; i--)
		x = x << 8 | p[i];
	return x;
}

static enum status fail(const struct report *r, const struct part *p, const char *what, int error)
{
	return report_error(r, status_from_errno(error), "cannot %s part file '%s': %s", what,
	                    p->path, strerror(error));
}

static enum status no_memory(const struct report *r, const char *path)
{
	return report_error(r, ST_RESOURCE, "cannot use part file '%s': memory ran out", path);
}

static enum status cut_short(const struct report *r, const struct part *p)
{
	return report_error(r, ST_INPUT,
	                    "cannot read part file '%s': it was cut short meanwhile; start again",
	                    p->path);
}

static enum status not_there(const struct report *r, const struct part *p, size_t unit)
{
	return report_error(r, ST_INPUT, "unit %zu is not in part file '%s'", unit, p->path);
}

static enum status damaged(const struct report *r, const struct part *p, size_t unit)
{
	return report_error(r, ST_INPUT, "unit %zu in part file '%s' is damaged; remove the file",
	                    unit, p->path);
}

/* n bytes from `from` on; read, not mapped: a file that somebody cuts short must not kill us. */
static bool read_at(int fd, char *to, size_t n, uint64_t from)
{
	for (size_t at = 0; at < n;) {
		ssize_t got = pread(fd, to + at, n - at, (off_t)(from + at));
		if (got < 0 && errno == EINTR)
			continue;
		if (got <= 0)
			return false;
		at += (size_t)got;
	}
	return true;
}

/* At least the file's first `need` bytes in memory, n if they must be read; they stay until the
 * close. */
static enum status read_bytes(struct part *p, uint64_t need, uint64_t n, const char **bytes,
                              const struct report *r)
{
	for (size_t i = p->n_blocks; i-- > 0;) {
		if (p->blocks[i].n >= need) {
			*bytes = p->blocks[i].bytes;
			return ST_OK;
		}
	}
	struct block *blocks = realloc(p->blocks, (p->n_blocks + 1) * sizeof *blocks);
	if (!blocks)
		return no_memory(r, p->path);
	p->blocks = blocks;
	char *new = n <= SIZE_MAX ? malloc((size_t)n) : NULL;
	if (!new)
		return report_error(r, ST_RESOURCE,
		                    "cannot read part file '%s': memory ran out; allow more",
		                    p->path);
	if (!read_at(p->fd, new, (size_t)n, 0)) {
		free(new);
		return cut_short(r, p);
	}
	p->blocks[p->n_blocks++] = (struct block){ new, (size_t)n };
	*bytes = new;
	return ST_OK;
}

static void forget_bytes(struct part *p)
{
	for (size_t i = 0; i < p->n_blocks; i++)
		free(p->blocks[i].bytes);
	p->n_blocks = 0;
}

/* pwritev of everything at `at`; a file cut short by a full disk is cut back. */
static int write_at(int fd, struct iovec *v, int n_v, uint64_t at)
{
	uint64_t begin = at;
	while (n_v > 0) {
		ssize_t wrote = pwritev(fd, v, n_v, (off_t)at);
		if (wrote < 0 && errno == EINTR)
			continue;
		if (wrote <= 0) {
			int error = wrote < 0 ? errno : ENOSPC;
			if (ftruncate(fd, (off_t)begin) < 0)
				return errno;
			return error;
		}
		at += (uint64_t)wrote;
		size_t left = (size_t)wrote;
		while (n_v > 0 && left >= v->iov_len) {
			left -= v->iov_len;
			v++;
			n_v--;
		}
		if (n_v > 0) {
			v->iov_base = (char *)v->iov_base + left;
			v->iov_len -= left;
		}
	}
	return 0;
}

static void make_header(struct text *out, const char *key, size_t n_units)
{
	unsigned char fixed[HEADER_SIZE - MAGIC_SIZE], sum[CHECKSUM_SIZE];
	put_u64(fixed, LAYOUT | (uint64_t)strlen(key) << 32);
	put_u64(fixed + 8, n_units);
	text_add_bytes(out, magic, MAGIC_SIZE);
	text_add_bytes(out, fixed, sizeof fixed);
	text_add(out, key);
	if (!out->failed) {
		put_u64(sum, checksum_bytes(out->s, out->n));
		text_add_bytes(out, sum, sizeof sum);
	}
}

/* Find the whole records behind the header; p->end is where the first torn one begins. */
static void scan(struct part *p, const char *file, uint64_t size, uint64_t at)
{
	while (size - at >= RECORD_SIZE) {
		const char *record = file + at;
		uint64_t unit = get_u64(record), n = get_u64(record + 8);
		if (checksum_bytes(record, RECORD_SIZE - CHECKSUM_SIZE) != get_u64(record + 24) ||
		    unit >= p->n_units || n > size - at - RECORD_SIZE)
			break;
		if (checksum_bytes(record + RECORD_SIZE, (size_t)n) == get_u64(record + 16) &&
		    p->spans[unit].at == 0) {
			p->spans[unit] = (struct span){ at + RECORD_SIZE, n };
			p->count++;
		}
		at += RECORD_SIZE + n;
	}
	p->end = at;
}

/* Open and lock. A file that its owner took away between our open and our lock is opened anew. */
static enum status open_locked(struct part *p, int flags, int lock, const struct report *r)
{
	for (;;) {
		struct stat here, there;
		p->fd = open(p->path, flags | O_CLOEXEC, 0666);
		if (p->fd < 0)
			return fail(r, p, "open", errno);
		if (flock(p->fd, lock | LOCK_NB) < 0 && errno == EWOULDBLOCK)
			return report_error(r, ST_INPUT,
			                    "part file '%s' is in use by another process; wait for "
			                    "it, or stop it",
			                    p->path);
		if (fstat(p->fd, &here) < 0)
			return fail(r, p, "open", errno);
		if (!S_ISREG(here.st_mode))
			return report_error(r, ST_INPUT, "'%s' is no part file; name another one",
			                    p->path);
		if (stat(p->path, &there) == 0 && here.st_ino == there.st_ino &&
		    here.st_dev == there.st_dev)
			return ST_OK;
		close(p->fd);
	}
}

static enum status create(struct part **out, const char *path, size_t n_units,
                          const struct report *r)
{
	struct part *p = calloc(1, sizeof *p);
	if (!p)
		return no_memory(r, path);
	p->fd = -1;
	p->n_units = n_units;
	pthread_mutex_init(&p->lock, NULL);
	p->path = strdup(path);
	p->spans = calloc(n_units ? n_units : 1, sizeof *p->spans);
	if (!p->path || !p->spans) {
		part_close(p);
		return no_memory(r, path);
	}
	*out = p;
	return ST_OK;
}

/* Does a part file begin so? One cut short does, and one whose size reached the disk before a power
 * cut, but not its bytes: it begins with zeros. */
static bool begins_part(const char *bytes, size_t n)
{
	static const char zeros[MAGIC_SIZE];
	n = n < MAGIC_SIZE ? n : MAGIC_SIZE;
	return !memcmp(bytes, magic, n) || !memcmp(bytes, zeros, n);
}

/* Read what there is. *same: the file begins with p's header. */
static enum status load(struct part *p, bool *same, const struct report *r)
{
	struct stat st;
	*same = false;
	if (fstat(p->fd, &st) < 0)
		return fail(r, p, "read", errno);
	uint64_t size = (uint64_t)st.st_size;
	if (size == 0)
		return ST_OK;
	const char *file;
	enum status status = read_bytes(p, size, size, &file, r);
	if (status != ST_OK)
		return status;
	if (!begins_part(file, (size_t)size))
		return report_error(r, ST_INPUT, "'%s' is no part file; name another one", p->path);
	*same = size >= p->header.n && memcmp(file, p->header.s, p->header.n) == 0;
	if (*same)
		scan(p, file, size, p->header.n);
	forget_bytes(p); /* the file may be begun anew */
	return ST_OK;
}

/* Make the file one that holds no unit yet. An empty one is not cut: ext4 writes a file that was cut
 * to nothing to the disk when it is closed, though it was removed before. */
static enum status begin_anew(struct part *p, bool empty, const struct report *r)
{
	struct iovec v = { p->header.s, p->header.n };
	int error = !empty && ftruncate(p->fd, 0) < 0 ? errno : 0;
	if (!error)
		error = write_at(p->fd, &v, 1, 0);
	p->end = p->header.n;
	return error ? fail(r, p, "write", error) : ST_OK;
}

enum status part_open(struct part **out, const char *path, const char *key, size_t n_units,
                      const struct report *r)
{
	struct part *p;
	struct stat before;
	bool same = false;
	enum status st = create(&p, path, n_units, r);
	if (st != ST_OK)
		return st;
	make_header(&p->header, key, n_units);
	st = p->header.failed ? no_memory(r, path) : open_locked(p, O_RDWR | O_CREAT, LOCK_EX, r);
	if (st == ST_OK && fstat(p->fd, &before) < 0)
		st = fail(r, p, "read", errno);
	if (st == ST_OK)
		st = load(p, &same, r);
	if (st == ST_OK && !same) {
		if (before.st_size > 0)
			report_warning(r, "part file '%s' is of other work: begun anew", path);
		st = begin_anew(p, before.st_size == 0, r);
	} else if (st == ST_OK && ftruncate(p->fd, (off_t)p->end) < 0) {
		st = fail(r, p, "write", errno);
	}
	if (st != ST_OK) {
		part_close(p);
		return st;
	}
	*out = p;
	return ST_OK;
}

void part_close(struct part *p)
{
	if (!p)
		return;
	forget_bytes(p);
	if (p->fd >= 0)
		close(p->fd);
	pthread_mutex_destroy(&p->lock);
	text_finish(&p->header);
	free(p->blocks);
	free(p->spans);
	free(p->path);
	free(p);
}

void part_remove(struct part *p)
{
	if (p)
		unlink(p->path);
	part_close(p);
}

bool part_has(const struct part *p, size_t unit)
{
	pthread_mutex_t *lock = (pthread_mutex_t *)&p->lock;
	pthread_mutex_lock(lock);
	bool has = unit < p->n_units && p->spans[unit].at != 0;
	pthread_mutex_unlock(lock);
	return has;
}

size_t part_count(const struct part *p)
{
	pthread_mutex_t *lock = (pthread_mutex_t *)&p->lock;
	pthread_mutex_lock(lock);
	size_t count = p->count;
	pthread_mutex_unlock(lock);
	return count;
}

enum status part_put(struct part *p, size_t unit, const void *bytes, size_t n,
                     const struct report *r)
{
	if (unit >= p->n_units)
		return report_error(r, ST_INTERNAL, "unit %zu of %zu in part file '%s'", unit,
		                    p->n_units, p->path);
	unsigned char record[RECORD_SIZE];
	put_u64(record, unit);
	put_u64(record + 8, n);
	put_u64(record + 16, checksum_bytes(bytes, n));
	put_u64(record + 24, checksum_bytes(record, RECORD_SIZE - CHECKSUM_SIZE));
	struct iovec v[2] = { { record, sizeof record }, { (void *)bytes, n } };
	int error = 0;
	pthread_mutex_lock(&p->lock);
	if (p->spans[unit].at == 0) {
		error = write_at(p->fd, v, 2, p->end);
		if (!error) {
			p->spans[unit] = (struct span){ p->end + RECORD_SIZE, n };
			p->count++;
			p->end += RECORD_SIZE + n;
		}
	}
	pthread_mutex_unlock(&p->lock);
	return error ? fail(r, p, "write", error) : ST_OK;
}

/* At 0: the unit is not in the file. */
static struct span find_span(struct part *p, size_t unit)
{
	struct span span = { 0 };
	pthread_mutex_lock(&p->lock);
	if (unit < p->n_units)
		span = p->spans[unit];
	pthread_mutex_unlock(&p->lock);
	return span;
}

enum status part_read(struct part *p, size_t unit, struct text *bytes, const struct report *r)
{
	char sum[CHECKSUM_SIZE];
	struct span span = find_span(p, unit);
	if (!span.at)
		return not_there(r, p, unit);
	text_reset(bytes);
	char *to = text_add_room(bytes, (size_t)span.n);
	if (!to)
		return no_memory(r, p->path);
	if (!read_at(p->fd, sum, sizeof sum, span.at - 2 * CHECKSUM_SIZE) ||
	    !read_at(p->fd, to, (size_t)span.n, span.at))
		return cut_short(r, p);
	return checksum_bytes(to, (size_t)span.n) == get_u64(sum) ? ST_OK : damaged(r, p, unit);
}

enum status part_read_end(struct part *p, size_t unit, void *to, size_t n, const struct report *r)
{
	struct span span = find_span(p, unit);
	if (!span.at)
		return not_there(r, p, unit);
	if (span.n < n)
		return damaged(r, p, unit);
	return read_at(p->fd, to, n, span.at + span.n - n) ? ST_OK : cut_short(r, p);
}

enum status part_get(struct part *p, size_t unit, const char **bytes, size_t *n,
                     const struct report *r)
{
	const char *file = NULL;
	struct span span = find_span(p, unit);
	if (!span.at)
		return not_there(r, p, unit);
	pthread_mutex_lock(&p->lock);
	enum status st = read_bytes(p, span.at + span.n, p->end, &file, r);
	pthread_mutex_unlock(&p->lock);
	if (st != ST_OK)
		return st;
	if (checksum_bytes(file + span.at, (size_t)span.n) != get_u64(file + span.at - 16))
		return damaged(r, p, unit);
	*bytes = file + span.at;
	*n = (size_t)span.n;
	return ST_OK;
}

enum status part_merge(struct part *into, const char *path, const struct report *r)
{
	struct part *from;
	bool same;
	enum status st = create(&from, path, into->n_units, r);
	if (st != ST_OK)
		return st;
	text_add_bytes(&from->header, into->header.s, into->header.n);
	st = from->header.failed ? no_memory(r, path) : open_locked(from, O_RDONLY, LOCK_SH, r);
	if (st == ST_OK)
		st = load(from, &same, r);
	if (st == ST_OK && !same)
		st = report_error(r, ST_INPUT,
		                  "part file '%s' is of other work, another version or another "
		                  "processor level; do that shard again",
		                  path);
	for (size_t unit = 0; st == ST_OK && unit < from->n_units; unit++) {
		const char *bytes;
		size_t n;
		if (!part_has(from, unit) || part_has(into, unit))
			continue;
		st = part_get(from, unit, &bytes, &n, r);
		if (st == ST_OK)
			st = part_put(into, unit, bytes, n, r);
	}
	part_close(from);
	return st;
}

void part_discard(const char *path)
{
	struct part *p;
	char begin[MAGIC_SIZE];
	if (!path_exists(path) || create(&p, path, 0, &report_none) != ST_OK)
		return;
	ssize_t n = open_locked(p, O_RDONLY, LOCK_EX, &report_none) == ST_OK
	                    ? pread(p->fd, begin, sizeof begin, 0)
	                    : -1;
	if (n >= 0 && begins_part(begin, (size_t)n))
		unlink(path);
	part_close(p);
}
