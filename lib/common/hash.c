/* hash.c - content hashes. */
#include "hash.h"

#include <inttypes.h>
#include <stdio.h>
#include <xxhash.h>

void hash_bytes(const void *p, size_t n, char out[HASH_SIZE])
{
	XXH128_hash_t h = XXH3_128bits(p, n);

	snprintf(out, HASH_SIZE, "%016" PRIx64 "%016" PRIx64, (uint64_t)h.high64,
	         (uint64_t)h.low64);
}

uint64_t checksum_bytes(const void *p, size_t n)
{
	return XXH3_64bits(p, n);
}
