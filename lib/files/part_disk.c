/* part_disk.c - the bytes of part files: headers, fronts, records, and what is trusted of them. */
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "hash.h"
#include "part_private.h"
#include "text.h"

const char part_magic[] = "BATTENPT";

/* Source: OpenEXR, File Layout. */
const char part_exr_magic[PART_EXR_MAGIC_SIZE] = { 0x76, 0x2f, 0x31, 0x01 };
const char part_mark[PART_MARK_SIZE] = "batten_part\0string\0\20\0\0";

void part_put_u64(unsigned char *p, uint64_t x)
{
	for (int i = 0; i < 8; i++)
		p[i] = (unsigned char)(x >> (8 * i));
}

uint64_t part_get_u64(const char *bytes)
{
	const unsigned char *p = (const unsigned char *)bytes;
	uint64_t x = 0;
	for (int i = 7; i >= 0; i--)
		x = x << 8 | p[i];
	return x;
}

enum status part_fail(const struct report *r, const struct part *p, const char *what, int error)
{
	return report_error(r, status_from_errno(error), "cannot %s part file '%s': %s", what,
	                    p->path, strerror(error));
}

enum status part_no_memory(const struct report *r, const char *path)
{
	return report_error(r, ST_RESOURCE, "cannot use part file '%s': memory ran out", path);
}

enum status part_cut_short(const struct report *r, const struct part *p)
{
	return report_error(r, ST_INPUT,
	                    "cannot read part file '%s': it was cut short meanwhile; start again",
	                    p->path);
}

enum status part_damaged(const struct report *r, const struct part *p, size_t unit)
{
	return report_error(r, ST_INPUT, "unit %zu in part file '%s' is damaged; remove the file",
	                    unit, p->path);
}

bool part_read_at(int fd, char *to, size_t n, uint64_t from)
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

int part_write_at(int fd, struct iovec *v, int n_v, uint64_t at, bool cut)
{
	uint64_t begin = at;
	while (n_v > 0) {
		ssize_t wrote = pwritev(fd, v, n_v, (off_t)at);
		if (wrote < 0 && errno == EINTR)
			continue;
		if (wrote <= 0) {
			int error = wrote < 0 ? errno : ENOSPC;
			if (cut && ftruncate(fd, (off_t)begin) < 0)
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

int part_write_record(const struct part *p, const struct part_unit *u, uint64_t at, bool cut)
{
	unsigned char record[PART_RECORD_SIZE];
	part_put_u64(record, u->unit);
	part_put_u64(record + 8, u->n);
	part_put_u64(record + 16, u->sum);
	part_put_u64(record + 24,
	             checksum_bytes(record, PART_RECORD_SIZE - PART_CHECKSUM_SIZE) ^ p->salt);
	struct iovec v[2] = { { record, sizeof record }, { (void *)u->bytes, u->n } };
	return part_write_at(p->fd, v, 2, at, cut);
}

bool part_record_read(struct part_record *out, const char *bytes, uint64_t salt, uint64_t n_units)
{
	out->unit = part_get_u64(bytes);
	out->n = part_get_u64(bytes + 8);
	out->sum = part_get_u64(bytes + 16);
	uint64_t sum = checksum_bytes(bytes, PART_RECORD_SIZE - PART_CHECKSUM_SIZE) ^ salt;
	return sum == part_get_u64(bytes + 24) && out->unit < n_units;
}

static bool has_mark(const char *bytes, size_t n)
{
	return n >= PART_BEGIN_SIZE &&
	       !memcmp(bytes + PART_MAGIC_SIZE, part_mark, sizeof part_mark);
}

bool part_begins(const char *bytes, size_t n)
{
	static const char zeros[PART_MAGIC_SIZE];
	size_t m = n < PART_MAGIC_SIZE ? n : PART_MAGIC_SIZE;
	return !memcmp(bytes, part_magic, m) || !memcmp(bytes, zeros, m) ||
	       (has_mark(bytes, n) && !memcmp(bytes, part_exr_magic, sizeof part_exr_magic));
}

uint64_t part_front_size(const char *bytes, size_t n)
{
	uint64_t front = 0;
	if (!has_mark(bytes, n))
		return 0;
	for (int i = 0; i < PART_DIGITS; i++) {
		int digit = bytes[PART_MAGIC_SIZE + PART_MARK_SIZE + i] - '0';
		if (digit < 0 || digit > 9)
			return 0;
		front = 10 * front + (unsigned)digit;
	}
	return front;
}

void part_header_make(struct text *out, const char *key, size_t n_units)
{
	unsigned char fixed[PART_HEADER_SIZE - PART_MAGIC_SIZE], sum[PART_CHECKSUM_SIZE];
	part_put_u64(fixed, PART_LAYOUT | (uint64_t)strlen(key) << 32);
	part_put_u64(fixed + 8, n_units);
	text_add_bytes(out, part_magic, PART_MAGIC_SIZE);
	text_add_bytes(out, fixed, sizeof fixed);
	text_add(out, key);
	if (!out->failed) {
		part_put_u64(sum, checksum_bytes(out->s, out->n));
		text_add_bytes(out, sum, sizeof sum);
	}
}

void part_front_make(struct text *begin, struct text *end, const char *key, size_t n_units,
                     uint64_t front)
{
	unsigned char fixed[PART_END_SIZE];
	text_add_bytes(begin, part_magic, PART_MAGIC_SIZE);
	text_add_bytes(begin, part_mark, sizeof part_mark);
	text_addf(begin, "%0*llu", PART_DIGITS, (unsigned long long)front);
	text_add(end, key);
	part_put_u64(fixed, strlen(key));
	part_put_u64(fixed + 8, n_units);
	text_add_bytes(end, fixed, 16);
	if (!end->failed) {
		part_put_u64(fixed, checksum_bytes(end->s, end->n));
		text_add_bytes(end, fixed, PART_CHECKSUM_SIZE);
	}
}

char *part_ahead_path(const char *path)
{
	return text_print("%s.ahead", path);
}

/* One record found; false: here the whole ones end. */
static bool take_record(struct part *p, const struct part_record *record, uint64_t at, bool good)
{
	if (p->front) {
		if (record->unit != p->next)
			return false;
		p->spans[p->next++] = (struct part_span){ at, record->n, !good };
		p->count += good;
	} else if (good && p->spans[record->unit].at == 0) {
		p->spans[record->unit] = (struct part_span){ at, record->n, false };
		p->order[p->n_order++] = record->unit;
		p->count++;
	}
	return true;
}

enum status part_scan(struct part *p, uint64_t size, uint64_t at, const struct report *r)
{
	struct text room = { 0 };
	enum status st = ST_OK;
	while (size >= at && size - at >= PART_RECORD_SIZE) {
		char head[PART_RECORD_SIZE];
		struct part_record record;
		if (!part_read_at(p->fd, head, sizeof head, at) ||
		    !part_record_read(&record, head, p->salt, p->n_units) ||
		    record.n > size - at - PART_RECORD_SIZE)
			break;
		at += PART_RECORD_SIZE;
		text_reset(&room);
		char *bytes = text_add_room(&room, (size_t)record.n);
		if (!bytes) {
			st = part_no_memory(r, p->path);
			break;
		}
		bool good = part_read_at(p->fd, bytes, (size_t)record.n, at) &&
		            checksum_bytes(bytes, (size_t)record.n) == record.sum;
		if (!take_record(p, &record, at, good)) {
			at -= PART_RECORD_SIZE;
			break;
		}
		at += record.n;
	}
	text_finish(&room);
	p->end = at;
	return st;
}
