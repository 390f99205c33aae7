/* part_look.c - a part file read while another process writes it. */
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "hash.h"
#include "part.h"

enum { HEADER_SIZE = 24, CHECKSUM_SIZE = 8, RECORD_SIZE = 32 };
static const uint64_t largest = (uint64_t)1 << 32;

static uint64_t get_u64(const char *bytes)
{
	const unsigned char *p = (const unsigned char *)bytes;
	uint64_t x = 0;
	for (int i = 7; i >= 0; i--)
		x = x << 8 | p[i];
	return x;
}

void part_glance_finish(struct part_glance *g)
{
	free(g->bytes);
	free(g->found);
	*g = (struct part_glance){ .bytes = NULL };
}

/* Records behind the header up to the first that is torn. */
static enum status find(struct part_glance *g, size_t size, size_t at)
{
	size_t room = 0;
	while (size - at >= RECORD_SIZE) {
		const char *record = g->bytes + at;
		const uint64_t unit = get_u64(record), n = get_u64(record + 8);
		if (checksum_bytes(record, RECORD_SIZE - CHECKSUM_SIZE) != get_u64(record + 24) ||
		    unit >= g->n_units || n > size - at - RECORD_SIZE)
			break;
		if (checksum_bytes(record + RECORD_SIZE, (size_t)n) == get_u64(record + 16)) {
			if (g->n == room) {
				room = room ? 2 * room : 64;
				struct part_found *more =
				        reallocarray(g->found, room, sizeof *more);
				if (!more)
					return ST_RESOURCE;
				g->found = more;
			}
			g->found[g->n++] = (struct part_found){ .unit = (size_t)unit,
				                                .n = (size_t)n,
				                                .bytes = record + RECORD_SIZE };
		}
		at += RECORD_SIZE + (size_t)n;
	}
	return ST_OK;
}

enum status part_look(struct part_glance *out, const char *path, const struct report *r)
{
	size_t size = 0;
	*out = (struct part_glance){ .bytes = NULL };
	enum status st = file_read(path, largest, &out->bytes, &size, r);
	if (st != ST_OK)
		return st;
	const size_t key = size >= HEADER_SIZE ? (size_t)(get_u64(out->bytes + 8) >> 32) : 0;
	const size_t header = HEADER_SIZE + key + CHECKSUM_SIZE;
	if (size < header || memcmp(out->bytes, "BATTENPT", 8) != 0 ||
	    checksum_bytes(out->bytes, HEADER_SIZE + key) !=
	            get_u64(out->bytes + HEADER_SIZE + key))
		st = report_error(r, ST_INPUT, "'%s' is no part file; name another one", path);
	if (st == ST_OK) {
		out->key = out->bytes + HEADER_SIZE;
		out->key_length = key;
		out->n_units = (size_t)get_u64(out->bytes + 16);
		st = find(out, size, header);
		if (st != ST_OK)
			report_error(r, st, "cannot read part file '%s': memory ran out", path);
	}
	if (st != ST_OK)
		part_glance_finish(out);
	return st;
}
