/* part.c - the part file: append records, find them again, trust nothing that is torn. */
#include "part.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "hash.h"
#include "part_private.h"
#include "path.h"
#include "text.h"

/* Of an image's front: room for what its header has beside the attributes of the key, which take less
 * than thrice the key, and for one place a tile; whole pages. */
enum { FRONT_ROOM = 4096, FRONT_PAGE = 4096 };

static enum status not_there(const struct report *r, const struct part *p, size_t unit)
{
	return report_error(r, ST_INPUT, "unit %zu is not in part file '%s'", unit, p->path);
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
	struct part_block *blocks = realloc(p->blocks, (p->n_blocks + 1) * sizeof *blocks);
	if (!blocks)
		return part_no_memory(r, p->path);
	p->blocks = blocks;
	char *new = n <= SIZE_MAX ? malloc((size_t)n) : NULL;
	if (!new)
		return report_error(r, ST_RESOURCE,
		                    "cannot read part file '%s': memory ran out; allow more",
		                    p->path);
	if (!part_read_at(p->fd, new, (size_t)n, 0)) {
		free(new);
		return part_cut_short(r, p);
	}
	p->blocks[p->n_blocks++] = (struct part_block){ new, (size_t)n };
	*bytes = new;
	return ST_OK;
}

static void forget_bytes(struct part *p)
{
	for (size_t i = 0; i < p->n_blocks; i++)
		free(p->blocks[i].bytes);
	p->n_blocks = 0;
}

/* Open and lock. A file that its owner took away between our open and our lock is opened anew. */
static enum status open_locked(struct part *p, int flags, int lock, const struct report *r)
{
	for (;;) {
		struct stat here, there;
		p->fd = open(p->path, flags | O_CLOEXEC, 0666);
		if (p->fd < 0)
			return part_fail(r, p, "open", errno);
		if (flock(p->fd, lock | LOCK_NB) < 0 && errno == EWOULDBLOCK)
			return report_error(r, ST_INPUT,
			                    "part file '%s' is in use by another process; wait for "
			                    "it, or stop it",
			                    p->path);
		if (fstat(p->fd, &here) < 0)
			return part_fail(r, p, "open", errno);
		if (!S_ISREG(here.st_mode))
			return report_error(r, ST_INPUT, "'%s' is no part file; name another one",
			                    p->path);
		if (stat(p->path, &there) == 0 && here.st_ino == there.st_ino &&
		    here.st_dev == there.st_dev)
			return ST_OK;
		close(p->fd);
	}
}

/* salt and front: of no plain file; 0 for one. */
static enum status create(struct part **out, const char *path, const char *key, size_t n_units,
                          uint64_t front, const struct report *r)
{
	struct part *p = calloc(1, sizeof *p);
	if (!p)
		return part_no_memory(r, path);
	p->fd = -1;
	p->n_units = n_units;
	p->front = front;
	pthread_mutex_init(&p->lock, NULL);
	p->path = strdup(path);
	p->key = strdup(key);
	p->ahead_path = part_ahead_path(path);
	p->spans = calloc(n_units ? n_units : 1, sizeof *p->spans);
	p->order = calloc(n_units ? n_units : 1, sizeof *p->order);
	if (front)
		part_front_make(&p->header, &p->end_of_front, key, n_units, front);
	else
		part_header_make(&p->header, key, n_units);
	if (!p->path || !p->key || !p->ahead_path || !p->spans || !p->order || p->header.failed ||
	    p->end_of_front.failed) {
		part_close(p);
		return part_no_memory(r, path);
	}
	if (front)
		p->salt = checksum_bytes(p->end_of_front.s, p->end_of_front.n);
	*out = p;
	return ST_OK;
}

/* Does the file of that size begin with p's header, or front? One that was about to become the output
 * has an image's magic number already. */
static bool has_header(const struct part *p, const char *begin, size_t n, uint64_t size)
{
	if (!p->front) {
		struct text header = { 0 };
		char *bytes = size >= p->header.n ? text_add_room(&header, p->header.n) : NULL;
		bool same = bytes && part_read_at(p->fd, bytes, p->header.n, 0) &&
		            !memcmp(bytes, p->header.s, p->header.n);
		text_finish(&header);
		return same;
	}
	struct text end = { 0 };
	size_t length = p->end_of_front.n;
	char *bytes = size >= p->front && part_front_size(begin, n) == p->front
	                      ? text_add_room(&end, length)
	                      : NULL;
	bool same = bytes && part_read_at(p->fd, bytes, length, p->front - length) &&
	            !memcmp(bytes, p->end_of_front.s, length);
	text_finish(&end);
	return same;
}

/* Read what there is. *same: the file is of p's work. */
static enum status load(struct part *p, uint64_t size, bool *same, const struct report *r)
{
	char begin[PART_BEGIN_SIZE];
	size_t n = size < sizeof begin ? (size_t)size : sizeof begin;
	*same = false;
	if (!part_read_at(p->fd, begin, n, 0))
		return part_cut_short(r, p);
	if (!part_begins(begin, n))
		return report_error(r, ST_INPUT, "'%s' is no part file; name another one", p->path);
	*same = has_header(p, begin, n, size);
	return *same ? part_scan(p, size, p->front ? p->front : p->header.n, r) : ST_OK;
}

/* Make the file one that holds no unit yet. An empty one is not cut: ext4 writes a file that was cut
 * to nothing to the disk when it is closed, though it was removed before. */
static enum status begin_anew(struct part *p, bool empty, const struct report *r)
{
	struct iovec begin = { p->header.s, p->header.n };
	struct iovec end = { p->end_of_front.s, p->end_of_front.n };
	int error = !empty && ftruncate(p->fd, 0) < 0 ? errno : 0;
	if (!error)
		error = part_write_at(p->fd, &begin, 1, 0, true);
	if (!error && p->front)
		error = part_write_at(p->fd, &end, 1, p->front - end.iov_len, true);
	p->end = p->front ? p->front : p->header.n;
	if (p->front)
		part_discard(p->ahead_path);
	return error ? part_fail(r, p, "write", error) : ST_OK;
}

/* Cut off what is torn. One that was about to become the output is a part file again. */
static enum status go_on(struct part *p, const struct report *r)
{
	struct iovec magic = { p->header.s, PART_MAGIC_SIZE };
	if (ftruncate(p->fd, (off_t)p->end) < 0)
		return part_fail(r, p, "write", errno);
	if (!p->front)
		return ST_OK;
	int error = part_write_at(p->fd, &magic, 1, 0, false);
	return error ? part_fail(r, p, "write", error) : part_ahead_open(p, r);
}

static enum status open_part(struct part **out, const char *path, const char *key, size_t n_units,
                             uint64_t front, const struct report *r)
{
	struct part *p;
	struct stat before;
	bool same = false;
	enum status st = create(&p, path, key, n_units, front, r);
	if (st != ST_OK)
		return st;
	st = open_locked(p, O_RDWR | O_CREAT, LOCK_EX, r);
	if (st == ST_OK && fstat(p->fd, &before) < 0)
		st = part_fail(r, p, "read", errno);
	if (st == ST_OK)
		st = load(p, (uint64_t)before.st_size, &same, r);
	if (st == ST_OK && same) {
		st = go_on(p, r);
	} else if (st == ST_OK) {
		if (before.st_size > 0)
			report_warning(
			        r, "part file '%s' is of other work or another batten: begun anew",
			        path);
		st = begin_anew(p, before.st_size == 0, r);
	}
	if (st != ST_OK) {
		part_close(p);
		return st;
	}
	*out = p;
	return ST_OK;
}

enum status part_open(struct part **out, const char *path, const char *key, size_t n_units,
                      const struct report *r)
{
	return open_part(out, path, key, n_units, 0, r);
}

enum status part_open_ordered(struct part **out, const char *path, const char *key, size_t n_units,
                              const struct report *r)
{
	uint64_t front = FRONT_ROOM + 3 * (uint64_t)strlen(key) + 8 * (uint64_t)n_units;
	front = (front + FRONT_PAGE - 1) / FRONT_PAGE * FRONT_PAGE;
	return open_part(out, path, key, n_units, front, r);
}

void part_close(struct part *p)
{
	if (!p)
		return;
	if (p->ahead && part_count(p->ahead) == 0)
		unlink(p->ahead_path);
	part_close(p->ahead);
	forget_bytes(p);
	if (p->fd >= 0)
		close(p->fd);
	pthread_mutex_destroy(&p->lock);
	text_finish(&p->header);
	text_finish(&p->end_of_front);
	text_finish(&p->moving);
	free(p->blocks);
	free(p->order);
	free(p->spans);
	free(p->ahead_path);
	free(p->key);
	free(p->path);
	free(p);
}

void part_remove(struct part *p)
{
	if (p && p->ahead)
		unlink(p->ahead_path);
	if (p && p->path)
		unlink(p->path);
	part_close(p);
}

static bool is_in_place(const struct part *p, size_t unit)
{
	return p->spans[unit].at != 0 && !p->spans[unit].hole;
}

bool part_has(const struct part *p, size_t unit)
{
	struct part *q = (struct part *)p;
	pthread_mutex_lock(&q->lock);
	bool has = unit < q->n_units && (is_in_place(q, unit) || part_ahead_has(q, unit));
	pthread_mutex_unlock(&q->lock);
	return has;
}

size_t part_count(const struct part *p)
{
	struct part *q = (struct part *)p;
	pthread_mutex_lock(&q->lock);
	size_t count = q->count + (q->ahead ? part_count(q->ahead) : 0);
	pthread_mutex_unlock(&q->lock);
	return count;
}

uint64_t part_bytes(const struct part *p)
{
	struct part *q = (struct part *)p;
	pthread_mutex_lock(&q->lock);
	uint64_t n = q->end - (q->front ? q->front : q->header.n);
	n += q->ahead ? part_bytes(q->ahead) : 0;
	pthread_mutex_unlock(&q->lock);
	return n;
}

static enum status put_behind(struct part *p, const struct part_unit *u, const struct report *r)
{
	if (p->spans[u->unit].at)
		return ST_OK;
	int error = part_write_record(p, u, p->end, true);
	if (error)
		return part_fail(r, p, "write", error);
	p->spans[u->unit] = (struct part_span){ p->end + PART_RECORD_SIZE, u->n, false };
	p->order[p->n_order++] = u->unit;
	p->count++;
	p->end += PART_RECORD_SIZE + u->n;
	return ST_OK;
}

enum status part_put_unit(struct part *p, const struct part_unit *u, const struct report *r)
{
	pthread_mutex_lock(&p->lock);
	enum status st = p->front ? part_put_ordered(p, u, r) : put_behind(p, u, r);
	pthread_mutex_unlock(&p->lock);
	return st;
}

enum status part_put(struct part *p, size_t unit, const void *bytes, size_t n,
                     const struct report *r)
{
	if (unit >= p->n_units)
		return report_error(r, ST_INTERNAL, "unit %zu of %zu in part file '%s'", unit,
		                    p->n_units, p->path);
	return part_put_unit(p, &(struct part_unit){ unit, n, bytes, checksum_bytes(bytes, n) }, r);
}

/* At 0: the unit is not in this file. */
static struct part_span find_span(struct part *p, size_t unit)
{
	struct part_span span = { 0 };
	pthread_mutex_lock(&p->lock);
	if (unit < p->n_units && is_in_place(p, unit))
		span = p->spans[unit];
	pthread_mutex_unlock(&p->lock);
	return span;
}

/* Read a unit that waits for its turn; its bytes stay where they are while p is locked. */
static bool is_ahead(struct part *p, size_t unit, enum status *st, struct text *bytes,
                     const struct report *r)
{
	pthread_mutex_lock(&p->lock);
	bool ahead = unit < p->n_units && part_ahead_has(p, unit);
	if (ahead)
		*st = part_read(p->ahead, unit, bytes, r);
	pthread_mutex_unlock(&p->lock);
	return ahead;
}

enum status part_read_checked(struct part *p, size_t unit, struct text *bytes, uint64_t *checked,
                              const struct report *r)
{
	char sum[PART_CHECKSUM_SIZE];
	struct part_span span = find_span(p, unit);
	if (!span.at)
		return not_there(r, p, unit);
	text_reset(bytes);
	char *to = text_add_room(bytes, (size_t)span.n);
	if (!to)
		return part_no_memory(r, p->path);
	if (!part_read_at(p->fd, sum, sizeof sum, span.at - 2 * PART_CHECKSUM_SIZE) ||
	    !part_read_at(p->fd, to, (size_t)span.n, span.at))
		return part_cut_short(r, p);
	*checked = part_get_u64(sum);
	return checksum_bytes(to, (size_t)span.n) == *checked ? ST_OK : part_damaged(r, p, unit);
}

enum status part_read(struct part *p, size_t unit, struct text *bytes, const struct report *r)
{
	uint64_t sum;
	enum status st = ST_OK;
	if (is_ahead(p, unit, &st, bytes, r))
		return st;
	return part_read_checked(p, unit, bytes, &sum, r);
}

enum status part_read_end(struct part *p, size_t unit, void *to, size_t n, const struct report *r)
{
	struct part_span span = find_span(p, unit);
	if (!span.at)
		return not_there(r, p, unit);
	if (span.n < n)
		return part_damaged(r, p, unit);
	return part_read_at(p->fd, to, n, span.at + span.n - n) ? ST_OK : part_cut_short(r, p);
}

enum status part_get(struct part *p, size_t unit, const char **bytes, size_t *n,
                     const struct report *r)
{
	const char *file = NULL;
	struct part_span span = find_span(p, unit);
	if (!span.at)
		return not_there(r, p, unit);
	pthread_mutex_lock(&p->lock);
	enum status st = read_bytes(p, span.at + span.n, p->end, &file, r);
	pthread_mutex_unlock(&p->lock);
	if (st != ST_OK)
		return st;
	if (checksum_bytes(file + span.at, (size_t)span.n) != part_get_u64(file + span.at - 16))
		return part_damaged(r, p, unit);
	*bytes = file + span.at;
	*n = (size_t)span.n;
	return ST_OK;
}

enum status part_merge(struct part *into, const char *path, const struct report *r)
{
	struct part *from;
	bool same = false;
	struct stat now;
	struct text room = { 0 };
	enum status st = create(&from, path, into->key, into->n_units, 0, r);
	if (st != ST_OK)
		return st;
	st = open_locked(from, O_RDONLY, LOCK_SH, r);
	if (st == ST_OK && fstat(from->fd, &now) < 0)
		st = part_fail(r, from, "read", errno);
	if (st == ST_OK)
		st = load(from, (uint64_t)now.st_size, &same, r);
	if (st == ST_OK && !same)
		st = report_error(r, ST_INPUT,
		                  "part file '%s' is of other work, another version or another "
		                  "processor level; do that shard again",
		                  path);
	for (size_t unit = 0; st == ST_OK && unit < from->n_units; unit++) {
		if (!part_has(from, unit) || part_has(into, unit))
			continue;
		st = part_read(from, unit, &room, r);
		if (st == ST_OK)
			st = part_put(into, unit, room.s, room.n, r);
	}
	text_finish(&room);
	part_close(from);
	return st;
}

void part_discard(const char *path)
{
	struct part *p;
	char begin[PART_BEGIN_SIZE];
	if (!path_exists(path) || create(&p, path, "", 0, 0, &report_none) != ST_OK)
		return;
	ssize_t n = open_locked(p, O_RDONLY, LOCK_EX, &report_none) == ST_OK
	                    ? pread(p->fd, begin, sizeof begin, 0)
	                    : -1;
	if (n >= 0 && part_begins(begin, (size_t)n)) {
		part_discard(p->ahead_path);
		unlink(path);
	}
	part_close(p);
}
