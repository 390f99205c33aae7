/* part_ordered.c - part files whose units lie in rising order, so that the file becomes the output;
 * units that come before their turn wait in a file beside it. */
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "part_private.h"
#include "path.h"
#include "text.h"

bool part_ahead_has(struct part *p, size_t unit)
{
	return p->ahead && p->ahead->spans[unit].at != 0;
}

static void ahead_forget(struct part *p, size_t unit)
{
	struct part *a = p->ahead;
	pthread_mutex_lock(&a->lock);
	if (a->spans[unit].at) {
		a->spans[unit] = (struct part_span){ .at = 0 };
		a->count--;
	}
	/* what lies last and is not wanted is written over by the next: pages that are there cost less
	 * than new ones */
	while (a->n_order > 0 && a->spans[a->order[a->n_order - 1]].at == 0)
		a->n_order--;
	const struct part_span *last = a->n_order > 0 ? &a->spans[a->order[a->n_order - 1]] : NULL;
	a->end = last ? last->at + last->n : a->header.n;
	pthread_mutex_unlock(&a->lock);
}

static enum status append(struct part *p, const struct part_unit *u, const struct report *r)
{
	int error = part_write_record(p, u, p->end, true);
	if (error)
		return part_fail(r, p, "write", error);
	p->spans[p->next++] = (struct part_span){ p->end + PART_RECORD_SIZE, u->n, false };
	p->count++;
	p->end += PART_RECORD_SIZE + u->n;
	return ST_OK;
}

/* Those whose turn has come. */
static enum status move_in(struct part *p, const struct report *r)
{
	enum status st = ST_OK;
	while (st == ST_OK && p->next < p->n_units && part_ahead_has(p, p->next)) {
		struct part_unit u = { .unit = p->next };
		st = part_read_checked(p->ahead, u.unit, &p->moving, &u.sum, r);
		u.bytes = p->moving.s;
		u.n = p->moving.n;
		if (st == ST_OK)
			st = append(p, &u, r);
		if (st == ST_OK)
			ahead_forget(p, u.unit);
	}
	return st;
}

static enum status fill_hole(struct part *p, const struct part_unit *u, const struct report *r)
{
	struct part_span *span = &p->spans[u->unit];
	if (span->n != u->n)
		return part_damaged(r, p, u->unit);
	int error = part_write_record(p, u, span->at - PART_RECORD_SIZE, false);
	if (error)
		return part_fail(r, p, "write", error);
	span->hole = false;
	p->count++;
	return ST_OK;
}

enum status part_put_ordered(struct part *p, const struct part_unit *u, const struct report *r)
{
	if (p->spans[u->unit].hole)
		return fill_hole(p, u, r);
	if (p->spans[u->unit].at || part_ahead_has(p, u->unit))
		return ST_OK;
	if (u->unit == p->next) {
		enum status st = append(p, u, r);
		return st == ST_OK ? move_in(p, r) : st;
	}
	enum status st = ST_OK;
	if (!p->ahead)
		st = part_open(&p->ahead, p->ahead_path, p->key, p->n_units, r);
	return st == ST_OK ? part_put_unit(p->ahead, u, r) : st;
}

enum status part_ahead_open(struct part *p, const struct report *r)
{
	if (!path_exists(p->ahead_path))
		return ST_OK;
	enum status st = part_open(&p->ahead, p->ahead_path, p->key, p->n_units, r);
	for (size_t unit = 0; st == ST_OK && unit < p->next; unit++)
		ahead_forget(p, unit);
	return st == ST_OK ? move_in(p, r) : st;
}

uint64_t part_front(const struct part *p)
{
	return p->front ? p->front - p->end_of_front.n : 0;
}

uint64_t part_place(const struct part *p, size_t unit)
{
	return unit < p->n_units ? p->spans[unit].at : 0;
}

const char *part_front_attribute(const struct part *p, size_t *n)
{
	*n = PART_BEGIN_SIZE - PART_MAGIC_SIZE;
	return p->header.s + PART_MAGIC_SIZE;
}

enum status part_write_front(struct part *p, const void *bytes, size_t n, const struct report *r)
{
	struct text front = { 0 };
	if (p->count != p->n_units || p->next != p->n_units || n > part_front(p))
		return report_error(r, ST_INTERNAL, "part file '%s' is not whole", p->path);
	/* with all that stands between header and key, whatever has become of that */
	text_add_bytes(&front, bytes, n);
	char *rest = text_add_room(&front, part_front(p) - n);
	if (!rest) {
		text_finish(&front);
		return part_no_memory(r, p->path);
	}
	memset(rest, 0, part_front(p) - n);
	struct iovec v = { front.s, front.n };
	int error = part_write_at(p->fd, &v, 1, 0, false);
	if (!error && fsync(p->fd) < 0)
		error = errno;
	text_finish(&front);
	return error ? part_fail(r, p, "write", error) : ST_OK;
}

int part_become(struct part *p, const char *to)
{
	if (rename(p->path, to) < 0)
		return errno;
	free(p->path);
	p->path = NULL;
	return 0;
}

int part_copy(const struct part *p, const char *to)
{
	enum { BLOCK = 1 << 20 };
	struct text block = { 0 };
	char *bytes = text_add_room(&block, BLOCK);
	int fd = bytes ? open(to, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666) : -1;
	int error = !bytes ? ENOMEM : fd < 0 ? errno : 0;
	for (uint64_t at = 0; !error && at < p->end; at += BLOCK) {
		struct iovec v = { bytes, p->end - at < BLOCK ? (size_t)(p->end - at) : BLOCK };
		error = part_read_at(p->fd, bytes, v.iov_len, at)
		                ? part_write_at(fd, &v, 1, at, false)
		                : EIO;
	}
	if (fd >= 0 && close(fd) < 0 && !error)
		error = errno;
	text_finish(&block);
	return error;
}

const char *part_file(const struct part *p)
{
	return p->path;
}
