/* bytes_out.h - numbers as bytes, the lowest first. Private to this folder. */
#ifndef BATTEN_BYTES_OUT_H
#define BATTEN_BYTES_OUT_H

#include <stdint.h>
#include <stdio.h>
#include <string.h>

static inline void put_u64(FILE *f, uint64_t x, int n)
{
	unsigned char b[8];
	for (int i = 0; i < n; i++)
		b[i] = (unsigned char)(x >> 8 * i);
	fwrite(b, 1, (size_t)n, f);
}

static inline void put_float(FILE *f, double x)
{
	const float y = (float)x;
	uint32_t bits;
	memcpy(&bits, &y, sizeof bits);
	put_u64(f, bits, 4);
}

static inline void put_double(FILE *f, double x)
{
	uint64_t bits;
	memcpy(&bits, &x, sizeof bits);
	put_u64(f, bits, 8);
}

#endif
