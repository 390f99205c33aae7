/* exr_unpack.c - one packed tile back to values: ZIP of OpenEXR, or plain. */
#include <stdlib.h>
#include <string.h>

#include <libdeflate.h>

#include "exr_private.h"

/* Source: IEEE 754-2008, binary16. */
static float from_half(unsigned h)
{
	const unsigned sign = (h & 0x8000U) << 16, e = h >> 10 & 31, m = h & 1023;
	unsigned bits;
	float x;
	if (e == 0) {
		x = (float)m / 16777216.0F;
		return sign ? -x : x;
	}
	bits = sign | (e == 31 ? 255U << 23 : (e + 112) << 23) | m << 13;
	memcpy(&x, &bits, sizeof x);
	return x;
}

/* Differences become sums; the first half are the even bytes, the second the odd ones. */
static void restore(unsigned char *to, unsigned char *from, size_t n)
{
	for (size_t i = 1; i < n; i++)
		from[i] = (unsigned char)(from[i] + from[i - 1] - 128);
	for (size_t i = 0; i < n; i++)
		to[i] = from[i % 2 ? (n + 1) / 2 + i / 2 : i / 2];
}

/* Rows, in each the channels sorted by name. */
static void spread(const struct exr_image *im, const unsigned char *p, int w, int h,
                   const int *order, float *const *planes)
{
	for (int y = 0; y < h; y++)
		for (int k = 0; k < im->n_channels; k++) {
			const int c = order[k], size = im->channels[c].half ? 2 : 4;
			for (int x = 0; x < w; x++, p += size) {
				const unsigned low = p[0] | (unsigned)p[1] << 8;
				float value;
				if (size == 4) {
					const unsigned bits =
					        low | (unsigned)p[2] << 16 | (unsigned)p[3] << 24;
					memcpy(&value, &bits, sizeof value);
				} else {
					value = from_half(low);
				}
				planes[c][(size_t)y * w + x] = value;
			}
		}
}

enum status exr_unpack(const struct exr_image *im, size_t i, const char *bytes, size_t n,
                       float *const *planes)
{
	int x, y, w, h, order[EXR_CHANNELS_MAX];
	size_t size;
	exr_tile_window(im, i, &x, &y, &w, &h);
	size = exr_order(im, (size_t)w * h, order);
	if (n < EXR_CHUNK_HEAD)
		return ST_INPUT;
	bytes += EXR_CHUNK_HEAD;
	n -= EXR_CHUNK_HEAD;
	unsigned char *raw = malloc(2 * size);
	struct libdeflate_decompressor *zip = libdeflate_alloc_decompressor();
	size_t used, made;
	enum status st = raw && zip ? ST_OK : ST_RESOURCE;
	if (st == ST_OK) {
		if (libdeflate_zlib_decompress_ex(zip, bytes, n, raw + size, size, &used, &made) ==
		            LIBDEFLATE_SUCCESS &&
		    made == size)
			restore(raw, raw + size, size);
		else if (n >= size)
			memcpy(raw, bytes, size);
		else
			st = ST_INPUT;
	}
	if (st == ST_OK)
		spread(im, raw, w, h, order, planes);
	libdeflate_free_decompressor(zip);
	free(raw);
	return st;
}
