/* hash.h - 128-bit content hashes (XXH3) as 32 hexadecimal digits. */
#ifndef BATTEN_HASH_H
#define BATTEN_HASH_H

#include <stddef.h>
#include <stdint.h>

enum { HASH_SIZE = 33 }; /* 32 digits and the zero byte */

void hash_bytes(const void *p, size_t n, char out[HASH_SIZE]);

/* 64-bit checksum of a unit's bytes in a part file. */
uint64_t checksum_bytes(const void *p, size_t n);

#endif
