/* exr_pack.c - one tile's values to a chunk: ZIP of OpenEXR, or plain. */
#include <endian.h>
#include <stdlib.h>
#include <string.h>

#include <libdeflate.h>

#include "exr_private.h"

size_t exr_order(const struct exr_image *im, size_t n, int order[EXR_CHANNELS_MAX])
{
	size_t size = 0;
	for (int c = 0; c < im->n_channels; c++) {
		int k = c;
		size += n * (im->channels[c].half ? 2 : 4);
		for (; k > 0 && strcmp(im->channels[order[k - 1]].name, im->channels[c].name) > 0;
		     k--)
			order[k] = order[k - 1];
		order[k] = c;
	}
	return size;
}

void exr_add_u32(struct text *out, uint64_t x)
{
	const unsigned char bytes[4] = { x, x >> 8, x >> 16, x >> 24 };
	text_add_bytes(out, bytes, sizeof bytes);
}

/* To nearest, ties to even, too large ones to infinity. Source: IEEE 754-2008, binary16; what is below
 * its normal numbers is rounded by an addition in float, whose last place is then theirs. */
static uint16_t to_half(float x)
{
	const uint32_t infinity = 255u << 23, large = 143u << 23, normal = 113u << 23;
	const uint32_t magic = 126u << 23;
	uint32_t bits;
	memcpy(&bits, &x, sizeof bits);
	const uint32_t sign = bits & 0x80000000u;
	bits ^= sign;
	if (bits >= large) {
		bits = bits > infinity ? 0x7e00 : 0x7c00;
	} else if (bits < normal) {
		float sum, unit;
		memcpy(&sum, &bits, sizeof sum);
		memcpy(&unit, &magic, sizeof unit);
		sum += unit;
		memcpy(&bits, &sum, sizeof bits);
		bits -= magic;
	} else {
		bits = (bits - (112u << 23) + 0xfff + (bits >> 13 & 1)) >> 13;
	}
	return (uint16_t)(bits | sign >> 16);
}

/* Rows, in each the channels sorted by name. */
static void gather(const struct exr_image *im, const float *const *planes, int w, int h,
                   const int *order, unsigned char *to)
{
	for (int y = 0; y < h; y++)
		for (int k = 0; k < im->n_channels; k++) {
			const float *row = planes[order[k]] + (size_t)y * w;
			if (im->channels[order[k]].half) {
				for (int x = 0; x < w; x++, to += 2) {
					const uint16_t value = htole16(to_half(row[x]));
					memcpy(to, &value, sizeof value);
				}
				continue;
			}
			for (int x = 0; x < w; x++, to += 4) {
				uint32_t value;
				memcpy(&value, &row[x], sizeof value);
				value = htole32(value);
				memcpy(to, &value, sizeof value);
			}
		}
}

/* The differences of every second of n bytes: what is smooth becomes small. The first one is the
 * difference to `before`. */
static void differences(const unsigned char *bytes, size_t n, unsigned char before,
                        unsigned char *out)
{
	out[0] = (unsigned char)(bytes[0] - before + 128);
	for (size_t i = 1; i < n; i++)
		out[i] = (unsigned char)(bytes[2 * i] - bytes[2 * i - 2] + 128);
}

/*
 * ZIP of OpenEXR: even bytes, then odd ones, as differences, deflated. What *size bytes become takes their
 * place, unless it is not smaller. Source: OpenEXR, Technical Introduction, ZIP.
 */
static enum status compress(unsigned char *bytes, size_t *size)
{
	size_t n = *size, even = (n + 1) / 2;
	struct libdeflate_compressor *zip = libdeflate_alloc_compressor(EXR_ZIP_LEVEL);
	unsigned char *small = malloc(2 * n);
	bool can = zip && small;
	if (can) {
		unsigned char *packed = small + n;
		differences(bytes, even, 0, small);
		differences(bytes + 1, n - even, bytes[2 * even - 2], small + even);
		small[0] = bytes[0]; /* the first is itself */
		size_t made = libdeflate_zlib_compress(zip, small, n, packed, n - 1);
		if (made) {
			memcpy(bytes, packed, made);
			*size = made;
		}
	}
	free(small);
	libdeflate_free_compressor(zip);
	return can ? ST_OK : ST_RESOURCE;
}

enum status exr_pack(const struct exr_image *im, size_t i, const float *const *planes,
                     struct text *out)
{
	const size_t across = (size_t)exr_tiles_across(im);
	int x, y, w, h, order[EXR_CHANNELS_MAX];
	exr_tile_window(im, i, &x, &y, &w, &h);
	size_t n = exr_order(im, (size_t)w * h, order);
	exr_add_u32(out, i % across);
	exr_add_u32(out, i / across);
	for (int k = 0; k < 3; k++) /* level in x and y, and the size, which is not known yet */
		exr_add_u32(out, 0);
	const size_t start = out->n;
	unsigned char *bytes = (unsigned char *)text_add_room(out, n);
	if (!bytes)
		return ST_RESOURCE;
	gather(im, planes, w, h, order, bytes);
	enum status st = n >= 2 && exr_is_worth(bytes, n) ? compress(bytes, &n) : ST_OK;
	out->n = start + n;
	for (int k = 0; k < 4; k++)
		out->s[start - 4 + k] = (char)(n >> 8 * k);
	return st;
}
