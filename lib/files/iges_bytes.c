/* iges_bytes.c - a file's bytes by a few blocks, the longest unused given up for a new one: files of any
 * size take a megabyte. */
#include "iges_bytes.h"

#include <errno.h>
#include <stdlib.h>
#include <unistd.h>

void iges_bytes_finish(struct iges_bytes *b)
{
	for (int i = 0; i < BYTES_BLOCKS; i++)
		free(b->block[i].data);
}

static bool load(struct iges_bytes *b, int i, size_t at)
{
	if (!b->block[i].data && !(b->block[i].data = malloc(BYTES_BLOCK)))
		return false;
	size_t want = b->n - at < BYTES_BLOCK ? b->n - at : BYTES_BLOCK, n = 0;
	while (n < want) {
		ssize_t k = pread(b->fd, b->block[i].data + n, want - n, (off_t)(at + n));
		if (k < 0 && errno == EINTR)
			continue;
		if (k < 0)
			return false;
		if (k == 0)
			break;
		n += (size_t)k;
	}
	b->shorter |= n < want;
	b->block[i].at = at;
	b->block[i].n = n;
	return true;
}

const char *iges_bytes_find(struct iges_bytes *b, size_t at, size_t want, size_t *got)
{
	*got = 0;
	if (at >= b->n)
		return "";
	if (want > b->n - at)
		want = b->n - at;
	if (b->all) {
		*got = want;
		return b->all + at;
	}
	size_t start = at - at % (BYTES_BLOCK / 2);
	int oldest = 0, found = -1;
	for (int i = 0; i < BYTES_BLOCKS && found < 0; i++) {
		if (b->block[i].used && b->block[i].at <= at &&
		    at + want <= b->block[i].at + BYTES_BLOCK)
			found = i;
		if (b->block[i].used < b->block[oldest].used)
			oldest = i;
	}
	if (found < 0) {
		found = oldest;
		if (!load(b, found, start)) {
			b->failed = true;
			b->block[found].used = b->block[found].n = 0;
			return "";
		}
	}
	b->block[found].used = ++b->tick;
	b->last = found;
	size_t end = b->block[found].at + b->block[found].n;
	*got = end <= at ? 0 : end - at < want ? end - at : want;
	return b->block[found].data + (at - b->block[found].at);
}
