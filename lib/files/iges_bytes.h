/* iges_bytes.h - the bytes of a file, in memory or read as they are needed. */
#ifndef BATTEN_IGES_BYTES_H
#define BATTEN_IGES_BYTES_H

#include <stdbool.h>
#include <stddef.h>

enum {
	BYTES_BLOCK = 128 << 10, /* blocks begin at multiples of half of it */
	BYTES_BLOCKS = 8,
	BYTES_MOST = BYTES_BLOCK / 2, /* that can be asked for at once */
};

struct iges_bytes {
	const char *all; /* borrowed: the whole file in memory; NULL: from fd */
	int fd;          /* borrowed */
	size_t n;        /* bytes of the file when it was opened */
	struct {
		char *data; /* owned */
		size_t at, n;
		unsigned long used;
	} block[BYTES_BLOCKS];
	int last; /* the block last given, which no other has been used after */
	unsigned long tick;
	bool shorter; /* than when it was opened */
	bool failed;  /* the disk or memory gave out: what was asked for read as nothing */
};

void iges_bytes_finish(struct iges_bytes *b);

/* The bytes from `at` on, `want` (at most BYTES_MOST) or as many as there are; *got is how many. Valid until
 * BYTES_BLOCKS further calls. A file that has become shorter ends there. */
const char *iges_bytes_find(struct iges_bytes *b, size_t at, size_t want, size_t *got);
static inline const char *iges_bytes_at(struct iges_bytes *b, size_t at, size_t want, size_t *got)
{
	const size_t from = at - b->block[b->last].at;
	if (b->all || from > b->block[b->last].n || want > b->block[b->last].n - from)
		return iges_bytes_find(b, at, want, got);
	*got = want;
	return b->block[b->last].data + from;
}

#endif
