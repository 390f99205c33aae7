/* part_look.c - a part file read while another process writes it. */
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "hash.h"
#include "part_private.h"
#include "path.h"

static const uint64_t largest = (uint64_t)1 << 32;

void part_glance_finish(struct part_glance *g)
{
	free(g->bytes);
	free(g->ahead);
	free(g->found);
	*g = (struct part_glance){ .bytes = NULL };
}

static enum status take(struct part_glance *g, const struct part_record *record, const char *bytes,
                        size_t *room)
{
	if (g->n == *room) {
		*room = *room ? 2 * *room : 64;
		struct part_found *more = reallocarray(g->found, *room, sizeof *more);
		if (!more)
			return ST_RESOURCE;
		g->found = more;
	}
	g->found[g->n++] = (struct part_found){ .unit = (size_t)record->unit,
		                                .n = (size_t)record->n,
		                                .bytes = bytes };
	return ST_OK;
}

/* Records from `at` up to the first that is torn. */
static enum status find(struct part_glance *g, const char *file, size_t size, size_t at,
                        uint64_t salt, size_t *room)
{
	struct part_record record;
	enum status st = ST_OK;
	while (st == ST_OK && size >= at && size - at >= PART_RECORD_SIZE &&
	       part_record_read(&record, file + at, salt, g->n_units) &&
	       record.n <= size - at - PART_RECORD_SIZE) {
		const char *bytes = file + at + PART_RECORD_SIZE;
		if (checksum_bytes(bytes, (size_t)record.n) == record.sum)
			st = take(g, &record, bytes, room);
		at += PART_RECORD_SIZE + (size_t)record.n;
	}
	return st;
}

/* Key and number of units of a plain file; where its records begin, 0 for another file. */
static size_t read_header(struct part_glance *g, const char *file, size_t size)
{
	const size_t key = size >= PART_HEADER_SIZE ? (size_t)(part_get_u64(file + 8) >> 32) : 0;
	const size_t header = PART_HEADER_SIZE + key + PART_CHECKSUM_SIZE;
	if (size < header || memcmp(file, part_magic, PART_MAGIC_SIZE) != 0 ||
	    checksum_bytes(file, PART_HEADER_SIZE + key) !=
	            part_get_u64(file + PART_HEADER_SIZE + key))
		return 0;
	g->key = file + PART_HEADER_SIZE;
	g->key_length = key;
	g->n_units = (size_t)part_get_u64(file + 16);
	return header;
}

/* The same of one with a front. */
static size_t read_front(struct part_glance *g, size_t size, uint64_t *salt)
{
	const uint64_t front = part_front_size(g->bytes, size);
	if (front < PART_END_SIZE || front > size)
		return 0;
	const char *fixed = g->bytes + front - PART_END_SIZE;
	const uint64_t key = part_get_u64(fixed);
	if (key > front - PART_END_SIZE)
		return 0;
	const char *begin = fixed - key;
	if (checksum_bytes(begin, key + PART_END_SIZE - PART_CHECKSUM_SIZE) !=
	    part_get_u64(fixed + PART_END_SIZE - PART_CHECKSUM_SIZE))
		return 0;
	*salt = checksum_bytes(begin, key + PART_END_SIZE);
	g->key = begin;
	g->key_length = key;
	g->n_units = (size_t)part_get_u64(fixed + 8);
	return front;
}

/* What waits beside it for its turn; nothing where it is of other work. */
static enum status look_ahead(struct part_glance *g, const char *path, size_t *room)
{
	struct part_glance beside = { .bytes = NULL };
	size_t size = 0, at = 0;
	char *name = part_ahead_path(path);
	if (!name)
		return ST_RESOURCE;
	if (path_exists(name) &&
	    file_read(name, largest, &beside.bytes, &size, &report_none) == ST_OK)
		at = read_header(&beside, beside.bytes, size);
	free(name);
	if (!at || beside.n_units != g->n_units || beside.key_length != g->key_length ||
	    memcmp(beside.key, g->key, g->key_length) != 0) {
		part_glance_finish(&beside);
		return ST_OK;
	}
	g->ahead = beside.bytes;
	return find(g, g->ahead, size, at, 0, room);
}

enum status part_look(struct part_glance *out, const char *path, const struct report *r)
{
	size_t size = 0, room = 0;
	uint64_t salt = 0;
	*out = (struct part_glance){ .bytes = NULL };
	enum status st = file_read(path, largest, &out->bytes, &size, r);
	if (st != ST_OK)
		return st;
	const size_t front = read_front(out, size, &salt);
	const size_t at = front ? front : read_header(out, out->bytes, size);
	if (!at) {
		st = report_error(r, ST_INPUT, "'%s' is no part file; name another one", path);
	} else {
		if (front)
			st = look_ahead(out, path, &room);
		if (st == ST_OK)
			st = find(out, out->bytes, size, at, salt, &room);
		if (st != ST_OK)
			report_error(r, st, "cannot read part file '%s': memory ran out", path);
	}
	if (st != ST_OK)
		part_glance_finish(out);
	return st;
}
