/* exr_write.c - OpenEXR files made of packed tiles. */
#include "exr_private.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <openexr.h>

enum { MAGIC_SIZE = 8 };

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
	init.zip_level = EXR_ZIP_LEVEL;

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
			exr_add_u32(out, places[i]);
			exr_add_u32(out, places[i] >> 32);
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
