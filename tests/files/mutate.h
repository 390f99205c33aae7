/* mutate.h - texts damaged in repeatable ways, for readers that must survive them. */
#ifndef BATTEN_TEST_MUTATE_H
#define BATTEN_TEST_MUTATE_H

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* Source: Vigna, splitmix64 (public domain, 2015). */
static inline uint64_t mutate_next(uint64_t *state)
{
	uint64_t z = *state += UINT64_C(0x9e3779b97f4a7c15);
	z = (z ^ z >> 30) * UINT64_C(0xbf58476d1ce4e5b9);
	z = (z ^ z >> 27) * UINT64_C(0x94d049bb133111eb);
	return z ^ z >> 31;
}

/* A damaged copy of n bytes, in a block of exactly its size so that reading beyond it is seen.
 * One to four of: a byte changed, a digit changed, a piece cut out, a piece doubled, the end lost. */
static inline char *mutate(const char *bytes, size_t n, uint64_t *state, size_t *out_n)
{
	static const char nasty[] = "0123456789-+.,;/ #\"\nEDHP\xff";
	char *work = malloc(2 * n + 1), *out;
	if (!work)
		return NULL;
	memcpy(work, bytes, n);
	size_t room = 2 * n;
	for (int times = 1 + (int)(mutate_next(state) % 4); times > 0 && n > 0; times--) {
		size_t at = mutate_next(state) % n, len = 1 + mutate_next(state) % 80;
		if (len > n - at)
			len = n - at;
		switch (mutate_next(state) % 5) {
		case 0:
			work[at] = (char)mutate_next(state);
			break;
		case 1:
			work[at] = nasty[mutate_next(state) % (sizeof nasty - 1)];
			break;
		case 2:
			memmove(work + at, work + at + len, n - at - len);
			n -= len;
			break;
		case 3:
			if (n + len <= room) {
				memmove(work + at + len, work + at, n - at);
				n += len;
			}
			break;
		case 4:
			n = at;
			break;
		}
	}
	out = malloc(n ? n : 1);
	if (out)
		memcpy(out, work, n);
	free(work);
	*out_n = n;
	return out;
}

#endif
