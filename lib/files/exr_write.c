/* exr_write.c - tiles of OpenEXR images packed one by one, and files made of packed tiles. */
#include "exr.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <libdeflate.h>
#include <openexr.h>

enum { ZIP_LEVEL = 2, SLICE = 4096, MAGIC_SIZE = 8 };

/* What a sample must shrink to for a tile to be compressed at all. */
static const double worth = 0.9;

int exr_tiles_across(const struct exr_image *im)
{
	return (im->width - 1) / im->tile + 1;
}

int exr_tiles_down(const struct exr_image *im)
{
	return (im->height - 1) / im->tile + 1;
}

size_t exr_tiles(const struct exr_image *im)
{
	return (size_t)exr_tiles_across(im) * exr_tiles_down(im);
}

static int min_int(int a, int b)
{
	return a < b ? a : b;
}

void exr_tile_window(const struct exr_image *im, size_t i, int *x, int *y, int *w, int *h)
{
	size_t across = exr_tiles_across(im);
	*x = (int)(i % across) * im->tile;
	*y = (int)(i / across) * im->tile;
	*w = min_int(im->tile, im->width - *x);
	*h = min_int(im->tile, im->height - *y);
}

/* Where a context's bytes go, and what went wrong. */
struct sink {
	int fd;          /* -1: nowhere */
	struct text *to; /* borrowed; takes what is written one after the other; NULL: nothing */
	bool whole;      /* attributes, too */
	int error;       /* errno of the first failed write */
	char message[256];
};

static void keep_message(exr_const_context_t f, exr_result_t code, const char *message)
{
	void *data = NULL;
	(void)code;
	if (exr_get_user_data(f, &data) != EXR_ERR_SUCCESS || !data)
		return;
	struct sink *sink = data;
	strncpy(sink->message, message, sizeof sink->message - 1);
}

static int64_t sink_write(exr_const_context_t f, void *data, const void *bytes, uint64_t n,
                          uint64_t offset, exr_stream_error_func_ptr_t error)
{
	struct sink *sink = data;
	uint64_t done = 0;
	(void)f, (void)error;
	if (sink->to && offset == sink->to->n)
		text_add_bytes(sink->to, bytes, n);
	while (sink->fd >= 0 && done < n) {
		ssize_t k = pwrite(sink->fd, (const char *)bytes + done, n - done, offset + done);
		if (k < 0 && errno == EINTR)
			continue;
		if (k <= 0) {
			if (!sink->error)
				sink->error = k < 0 ? errno : ENOSPC;
			return -1;
		}
		done += k;
	}
	return n;
}

/* A context with the header of a width x height image written. */
static exr_result_t begin(exr_context_t *out, const char *name, struct sink *sink,
                          const struct exr_image *im, int width, int height)
{
	exr_context_initializer_t init = EXR_DEFAULT_CONTEXT_INITIALIZER;
	init.error_handler_fn = keep_message;
	init.user_data = sink;
	init.write_fn = sink_write;
	init.zip_level = ZIP_LEVEL;

	exr_context_t f;
	exr_result_t e = exr_start_write(&f, name, EXR_WRITE_FILE_DIRECTLY, &init);
	if (e)
		return e;
	int part = 0;
	e = exr_set_longname_support(f, 1);
	if (!e)
		e = exr_add_part(f, NULL, EXR_STORAGE_TILED, &part);
	if (!e)
		e = exr_initialize_required_attr_simple(f, part, width, height,
		                                        EXR_COMPRESSION_ZIP);
	if (!e)
		e = exr_set_tile_descriptor(f, part, im->tile, im->tile, EXR_TILE_ONE_LEVEL,
		                            EXR_TILE_ROUND_DOWN);
	for (int c = 0; c < im->n_channels && !e; c++)
		e = exr_add_channel(f, part, im->channels[c].name,
		                    im->channels[c].half ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT,
		                    EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1);
	for (int i = 0; i < im->n_attributes && sink->whole && !e; i++)
		e = exr_attr_set_string(f, part, im->attributes[i].name, im->attributes[i].value);
	if (!e)
		e = exr_write_header(f);
	if (e)
		exr_finish(&f);
	else
		*out = f;
	return e;
}

/* Where a chunk goes, and what compresses it. */
struct chunk {
	struct text *out;
	struct libdeflate_compressor *zip;
};

/* The differences of every second of n bytes, as the format's zip works on them: what is smooth
 * becomes small. The first one is the difference to `before`. */
static void differences(const uint8_t *bytes, size_t n, uint8_t before, uint8_t *out)
{
	out[0] = (uint8_t)(bytes[0] - before + 128);
	for (size_t i = 1; i < n; i++)
		out[i] = (uint8_t)(bytes[2 * i] - bytes[2 * i - 2] + 128);
}

/*
 * Whether zip saves a tenth, from a slice of either half of what it would work on. The mantissas of
 * smooth values in float are noise: of a map of curvatures zip saved 8 % and took three quarters of
 * the whole job's time.
 */
static bool is_worth(struct libdeflate_compressor *zip, const uint8_t *bytes, size_t n)
{
	uint8_t sample[2 * SLICE], packed[2 * SLICE];
	if (n < 4 * sizeof sample)
		return true;
	for (int half = 0; half < 2; half++) {
		const uint8_t *p = bytes + (n / 4 - SLICE / 2) * 2 + half;
		differences(p, SLICE, p[-2], sample + (size_t)half * SLICE);
	}
	return libdeflate_zlib_compress(zip, sample, sizeof sample, packed,
	                                (size_t)(worth * sizeof packed)) > 0;
}

/*
 * ZIP of OpenEXR: even bytes, then odd ones, as differences, deflated; what does not become smaller
 * stays as it is. libdeflate takes a third of the library's own time.
 * Source: OpenEXR, Technical Introduction, ZIP.
 */
static exr_result_t compress_chunk(exr_encode_pipeline_t *e)
{
	struct chunk *chunk = e->encoding_user_data;
	const uint8_t *bytes = e->packed_buffer;
	size_t n = e->packed_bytes, even = (n + 1) / 2, size = 0;
	exr_result_t result = EXR_ERR_OUT_OF_MEMORY;

	if (n < 2 || !is_worth(chunk->zip, bytes, n)) {
		text_add_bytes(chunk->out, bytes, n);
		return chunk->out->failed ? EXR_ERR_OUT_OF_MEMORY : EXR_ERR_SUCCESS;
	}
	uint8_t *small = malloc(n), *packed = malloc(n);
	if (small && packed) {
		differences(bytes, even, 0, small);
		differences(bytes + 1, n - even, bytes[2 * even - 2], small + even);
		small[0] = bytes[0]; /* the first is itself */
		size = libdeflate_zlib_compress(chunk->zip, small, n, packed, n - 1);
		text_add_bytes(chunk->out, size ? packed : bytes, size ? size : n);
		if (!chunk->out->failed)
			result = EXR_ERR_SUCCESS;
	}
	free(packed);
	free(small);
	return result;
}

/* Its bytes have gone where they belong. */
static exr_result_t take_chunk(exr_encode_pipeline_t *e)
{
	(void)e;
	return EXR_ERR_SUCCESS;
}

/* The library keeps channels sorted by name; planes come in the image's order. */
static const float *plane_of(const struct exr_image *im, const float *const *planes,
                             const char *name)
{
	for (int c = 0; c < im->n_channels; c++)
		if (!strcmp(im->channels[c].name, name))
			return planes[c];
	return NULL;
}

static void add_u32(struct text *out, uint64_t x)
{
	const unsigned char bytes[4] = { x, x >> 8, x >> 16, x >> 24 };
	text_add_bytes(out, bytes, sizeof bytes);
}

/*
 * A tile's chunk does not depend on where it lies, so it is packed as the only tile of an image of
 * its own size: a context costs microseconds, and threads share nothing.
 */
enum status exr_pack(const struct exr_image *im, size_t i, const float *const *planes,
                     struct text *out)
{
	int x, y, w, h;
	exr_tile_window(im, i, &x, &y, &w, &h);

	const size_t head = out->n + EXR_CHUNK_HEAD - 4, across = (size_t)exr_tiles_across(im);
	struct sink nowhere = { .fd = -1 };
	exr_context_t f;
	add_u32(out, i % across);
	add_u32(out, i / across);
	for (int k = 0; k < 3; k++) /* level in x and y, and the size, which is not known yet */
		add_u32(out, 0);
	if (begin(&f, "tile", &nowhere, im, w, h))
		return ST_RESOURCE;
	exr_encode_pipeline_t pipe = EXR_ENCODE_PIPELINE_INITIALIZER;
	exr_chunk_info_t info;
	exr_result_t e = exr_write_tile_chunk_info(f, 0, 0, 0, 0, 0, &info);
	if (!e)
		e = exr_encoding_initialize(f, 0, &info, &pipe);
	for (int c = 0; c < pipe.channel_count && !e; c++) {
		exr_coding_channel_info_t *ch = &pipe.channels[c];
		ch->encode_from_ptr = (const uint8_t *)plane_of(im, planes, ch->channel_name);
		ch->user_data_type = EXR_PIXEL_FLOAT;
		ch->user_bytes_per_element = sizeof(float);
		ch->user_pixel_stride = sizeof(float);
		ch->user_line_stride = w * (int)sizeof(float);
	}
	if (!e)
		e = exr_encoding_choose_default_routines(f, 0, &pipe);
	struct chunk chunk = { .out = out, .zip = libdeflate_alloc_compressor(ZIP_LEVEL) };
	if (!chunk.zip)
		e = EXR_ERR_OUT_OF_MEMORY;
	pipe.encoding_user_data = &chunk;
	pipe.compress_fn = compress_chunk;
	pipe.write_fn = take_chunk;
	if (!e)
		e = exr_encoding_run(f, 0, &pipe);
	libdeflate_free_compressor(chunk.zip);
	exr_encoding_destroy(f, &pipe);
	exr_finish(&f);
	if (e || out->failed)
		return ST_RESOURCE;
	const size_t size = out->n - head - 4;
	for (int k = 0; k < 4; k++)
		out->s[head + k] = (char)(size >> 8 * k);
	return ST_OK;
}

enum status exr_front(const struct exr_image *im, const void *first, size_t n,
                      const uint64_t *places, struct text *out)
{
	struct text header = { 0 };
	struct sink sink = { .fd = -1, .to = &header, .whole = true };
	exr_context_t f;
	exr_result_t e = begin(&f, "image", &sink, im, im->width, im->height);
	sink.to = NULL;
	if (!e)
		exr_finish(&f);
	if (!e && !header.failed) {
		text_add_bytes(out, header.s, MAGIC_SIZE);
		text_add_bytes(out, first, n);
		text_add_bytes(out, header.s + MAGIC_SIZE, header.n - MAGIC_SIZE);
		for (size_t i = 0; i < exr_tiles(im); i++) {
			add_u32(out, places[i]);
			add_u32(out, places[i] >> 32);
		}
	}
	text_finish(&header);
	return e || out->failed || !out->n ? ST_RESOURCE : ST_OK;
}

static enum status write_failed(const char *path, const struct sink *sink, exr_result_t e,
                                const struct report *r)
{
	if (sink->error)
		return report_error(r, ST_RESOURCE,
		                    "cannot write '%s': %s; make room and try again", path,
		                    strerror(sink->error));
	if (e == EXR_ERR_OUT_OF_MEMORY)
		return report_error(r, ST_RESOURCE, "cannot write '%s': no memory", path);
	return report_error(r, ST_INTERNAL, "cannot write '%s': %s", path,
	                    sink->message[0] ? sink->message : exr_get_default_error_message(e));
}

static enum status write_tiles(exr_context_t f, const char *path, const struct exr_image *im,
                               const struct sink *sink, exr_source *source, void *data,
                               const struct report *r)
{
	int across = exr_tiles_across(im);
	size_t n = exr_tiles(im);
	for (size_t i = 0; i < n; i++) {
		const char *bytes;
		size_t size;
		enum status st = source(data, i, &bytes, &size);
		if (st)
			return st;
		const unsigned char *head = (const unsigned char *)bytes + EXR_CHUNK_HEAD - 4;
		const size_t packed = size < EXR_CHUNK_HEAD
		                              ? SIZE_MAX
		                              : (size_t)head[3] << 24 | (size_t)head[2] << 16 |
		                                        (size_t)head[1] << 8 | head[0];
		if (packed > size - EXR_CHUNK_HEAD)
			return report_error(r, ST_INTERNAL,
			                    "cannot write '%s': tile %zu is no chunk", path, i);
		exr_result_t e = exr_write_tile_chunk(f, 0, (int)(i % across), (int)(i / across), 0,
		                                      0, bytes + EXR_CHUNK_HEAD, packed);
		if (e)
			return write_failed(path, sink, e, r);
	}
	return ST_OK;
}

enum status exr_write(const char *path, const struct exr_image *im, exr_source *source, void *data,
                      const struct report *r)
{
	struct sink sink = { .fd = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666),
		             .whole = true };
	if (sink.fd < 0)
		return report_error(r, status_from_errno(errno), "cannot write '%s': %s", path,
		                    strerror(errno));
	exr_context_t f;
	enum status st = ST_OK;
	exr_result_t e = begin(&f, path, &sink, im, im->width, im->height);
	if (e) {
		st = write_failed(path, &sink, e, r);
	} else {
		st = write_tiles(f, path, im, &sink, source, data, r);
		/* the table of tile offsets is written here */
		e = exr_finish(&f);
		if (!st && (e || sink.error))
			st = write_failed(path, &sink, e, r);
	}
	if (close(sink.fd) < 0 && !st) {
		sink.error = errno;
		st = write_failed(path, &sink, EXR_ERR_SUCCESS, r);
	}
	if (st)
		unlink(path);
	return st;
}
