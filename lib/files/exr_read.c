/* exr_read.c - OpenEXR images read into planes of float; what the header claims is not trusted. */
#include "exr.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <openexr.h>

/* Deflate makes at most 1032 bytes of one (zlib technical notes); no other method here does more
 * on images, so pixels beyond this many times the file's size are a lie of the header. */
enum { EXPANSION_MAX = 1100, CHANNELS_READ_MAX = 1024 };

struct source {
	int fd;
	int64_t size;
	char message[256];
};

/* One file being read: its context, and what failed. */
struct reading {
	const char *path; /* borrowed */
	const struct report *report;
	struct source source;
	exr_context_t f;
	struct exr_picture *out;
};

static void keep_message(exr_const_context_t f, exr_result_t code, const char *message)
{
	void *data = NULL;
	(void)code;
	if (exr_get_user_data(f, &data) != EXR_ERR_SUCCESS || !data)
		return;
	struct source *source = data;
	strncpy(source->message, message, sizeof source->message - 1);
}

static int64_t source_size(exr_const_context_t f, void *data)
{
	(void)f;
	return ((struct source *)data)->size;
}

static int64_t source_read(exr_const_context_t f, void *data, void *bytes, uint64_t n,
                           uint64_t offset, exr_stream_error_func_ptr_t error)
{
	struct source *source = data;
	uint64_t done = 0;
	(void)f, (void)error;
	while (done < n && offset + done < (uint64_t)source->size) {
		ssize_t k = pread(source->fd, (char *)bytes + done, n - done, offset + done);
		if (k < 0 && errno == EINTR)
			continue;
		if (k < 0)
			return -1;
		if (k == 0)
			break;
		done += k;
	}
	return done;
}

static enum status damaged(const struct reading *x, const char *what)
{
	return report_error(x->report, ST_INPUT, "cannot read '%s': %s; make the image again",
	                    x->path, what);
}

static enum status failed(const struct reading *x, exr_result_t e)
{
	if (e == EXR_ERR_OUT_OF_MEMORY)
		return report_error(x->report, ST_RESOURCE, "cannot read '%s': no memory", x->path);
	return damaged(x,
	               x->source.message[0] ? x->source.message : exr_get_default_error_message(e));
}

static enum status no_memory(const struct reading *x)
{
	return failed(x, EXR_ERR_OUT_OF_MEMORY);
}

static enum status open_image(struct reading *x)
{
	struct stat info;
	x->source.fd = open(x->path, O_RDONLY | O_CLOEXEC);
	if (x->source.fd < 0 || fstat(x->source.fd, &info) < 0)
		return report_error(x->report, status_from_errno(errno), "cannot read '%s': %s",
		                    x->path, strerror(errno));
	if (!S_ISREG(info.st_mode))
		return report_error(x->report, ST_INPUT,
		                    "cannot read '%s': expected a file; name an image", x->path);
	x->source.size = info.st_size;
	exr_context_initializer_t init = EXR_DEFAULT_CONTEXT_INITIALIZER;
	init.error_handler_fn = keep_message;
	init.user_data = &x->source;
	init.read_fn = source_read;
	init.size_fn = source_size;
	init.flags = EXR_CONTEXT_FLAG_DISABLE_CHUNK_RECONSTRUCTION;
	exr_result_t e = exr_start_read(&x->f, x->path, &init);
	if (e == EXR_ERR_FILE_BAD_HEADER)
		return damaged(x, "found no OpenEXR header, expected an .exr image");
	return e ? failed(x, e) : ST_OK;
}

static enum status read_size(struct reading *x, const exr_attr_chlist_t **channels)
{
	exr_attr_box2i_t window;
	exr_storage_t storage;
	exr_result_t e = exr_get_data_window(x->f, 0, &window);
	if (!e)
		e = exr_get_storage(x->f, 0, &storage);
	if (!e)
		e = exr_get_channels(x->f, 0, channels);
	if (e)
		return failed(x, e);
	if (storage != EXR_STORAGE_TILED && storage != EXR_STORAGE_SCANLINE)
		return damaged(x, "found deep data, expected a flat image");
	int64_t w = (int64_t)window.max.x - window.min.x + 1;
	int64_t h = (int64_t)window.max.y - window.min.y + 1;
	int n = (*channels)->num_channels;
	if (w < 1 || h < 1 || w > INT_MAX / 4 || h > INT_MAX / 4 || n < 1 || n > CHANNELS_READ_MAX)
		return damaged(x, "size or number of channels out of bounds");
	uint64_t pixel = 0;
	for (int c = 0; c < n; c++) {
		const exr_attr_chlist_entry_t *ch = &(*channels)->entries[c];
		if (ch->x_sampling != 1 || ch->y_sampling != 1)
			return damaged(x, "found a subsampled channel, expected one value a pixel");
		pixel += ch->pixel_type == EXR_PIXEL_HALF ? 2 : 4;
	}
	/* w h < 2^58, and pixel < 2^12, so the product is made in floating point */
	if ((double)w * (double)h * (double)pixel > (double)EXPANSION_MAX * (double)x->source.size)
		return damaged(x, "the file is too short for the size that it names");
	x->out->width = (int)w;
	x->out->height = (int)h;
	return ST_OK;
}

static enum status read_names(struct reading *x, const exr_attr_chlist_t *channels)
{
	struct exr_picture *p = x->out;
	p->names = calloc(channels->num_channels, sizeof *p->names);
	if (!p->names)
		return no_memory(x);
	p->n_channels = channels->num_channels;
	for (int c = 0; c < p->n_channels; c++) {
		const exr_attr_string_t *name = &channels->entries[c].name;
		p->names[c] = strndup(name->str, name->length);
		if (!p->names[c])
			return no_memory(x);
	}
	return ST_OK;
}

static enum status read_attributes(struct reading *x)
{
	struct exr_picture *p = x->out;
	int32_t n = 0;
	exr_result_t e = exr_get_attribute_count(x->f, 0, &n);
	if (e)
		return failed(x, e);
	p->attributes = calloc(n + 1, sizeof *p->attributes);
	if (!p->attributes)
		return no_memory(x);
	for (int32_t i = 0; i < n; i++) {
		const exr_attribute_t *a;
		e = exr_get_attribute_by_index(x->f, 0, EXR_ATTR_LIST_FILE_ORDER, i, &a);
		if (e)
			return failed(x, e);
		if (a->type != EXR_ATTR_STRING)
			continue;
		struct exr_pair *pair = &p->attributes[p->n_attributes++];
		pair->name = strdup(a->name);
		pair->value = strndup(a->string->str, a->string->length);
		if (!pair->name || !pair->value)
			return no_memory(x);
	}
	return ST_OK;
}

/* Chunks are decoded into a buffer of their own and copied, so that one that reaches over the
 * image's border is cut. */
struct decoder {
	exr_decode_pipeline_t pipe;
	float *buffer; /* owned; channel after channel */
	size_t room;   /* in floats */
	bool started;
};

static exr_result_t decode(struct reading *x, struct decoder *d, const exr_chunk_info_t *chunk)
{
	exr_decode_pipeline_t *p = &d->pipe;
	size_t pixels = (size_t)chunk->width * chunk->height;
	exr_result_t e = d->started ? exr_decoding_update(x->f, 0, chunk, p)
	                            : exr_decoding_initialize(x->f, 0, chunk, p);
	if (e)
		return e;
	if (pixels * p->channel_count > d->room) {
		free(d->buffer);
		d->room = pixels * p->channel_count;
		d->buffer = malloc(d->room * sizeof(float));
		if (!d->buffer) {
			d->room = 0;
			return EXR_ERR_OUT_OF_MEMORY;
		}
	}
	for (int c = 0; c < p->channel_count; c++) {
		exr_coding_channel_info_t *ch = &p->channels[c];
		ch->decode_to_ptr = (uint8_t *)(d->buffer + pixels * c);
		ch->user_data_type = EXR_PIXEL_FLOAT;
		ch->user_bytes_per_element = sizeof(float);
		ch->user_pixel_stride = sizeof(float);
		ch->user_line_stride = chunk->width * (int)sizeof(float);
	}
	if (!d->started)
		e = exr_decoding_choose_default_routines(x->f, 0, p);
	d->started = true;
	return e ? e : exr_decoding_run(x->f, 0, p);
}

/* Copy the decoded chunk to (x0, y0) of the picture. */
static void place(struct exr_picture *p, const struct decoder *d, const exr_chunk_info_t *chunk,
                  int x0, int y0)
{
	size_t pixels = (size_t)chunk->width * chunk->height;
	int w = chunk->width < p->width - x0 ? chunk->width : p->width - x0;
	for (int c = 0; c < p->n_channels; c++)
		for (int row = 0; row < chunk->height && y0 + row < p->height; row++)
			memcpy(p->planes[c] + (size_t)(y0 + row) * p->width + x0,
			       d->buffer + pixels * c + (size_t)row * chunk->width,
			       w * sizeof(float));
}

static exr_result_t read_tiles(struct reading *x, struct decoder *d)
{
	uint32_t tw, th;
	exr_tile_level_mode_t levels;
	exr_tile_round_mode_t rounding;
	exr_result_t e = exr_get_tile_descriptor(x->f, 0, &tw, &th, &levels, &rounding);
	if (!e && (tw < 1 || th < 1 || tw > INT_MAX / 2 || th > INT_MAX / 2))
		e = EXR_ERR_INVALID_ATTR;
	for (int64_t y = 0; !e && y < x->out->height; y += th)
		for (int64_t left = 0; !e && left < x->out->width; left += tw) {
			exr_chunk_info_t chunk;
			e = exr_read_tile_chunk_info(x->f, 0, (int)(left / tw), (int)(y / th), 0, 0,
			                             &chunk);
			if (!e)
				e = decode(x, d, &chunk);
			if (!e)
				place(x->out, d, &chunk, (int)left, (int)y);
		}
	return e;
}

static exr_result_t read_scanlines(struct reading *x, struct decoder *d)
{
	exr_attr_box2i_t window;
	int32_t lines = 0;
	exr_result_t e = exr_get_data_window(x->f, 0, &window);
	if (!e)
		e = exr_get_scanlines_per_chunk(x->f, 0, &lines);
	if (!e && lines < 1)
		e = EXR_ERR_INVALID_ATTR;
	for (int64_t y = 0; !e && y < x->out->height; y += lines) {
		exr_chunk_info_t chunk;
		e = exr_read_scanline_chunk_info(x->f, 0, (int)(window.min.y + y), &chunk);
		if (!e)
			e = decode(x, d, &chunk);
		if (!e)
			place(x->out, d, &chunk, 0, (int)y);
	}
	return e;
}

static enum status read_pixels(struct reading *x)
{
	struct exr_picture *p = x->out;
	p->planes = calloc(p->n_channels, sizeof *p->planes);
	if (!p->planes)
		return no_memory(x);
	for (int c = 0; c < p->n_channels; c++) {
		p->planes[c] = calloc((size_t)p->width * p->height, sizeof(float));
		if (!p->planes[c])
			return no_memory(x);
	}
	exr_storage_t storage;
	struct decoder d = { .started = false };
	exr_result_t e = exr_get_storage(x->f, 0, &storage);
	if (!e)
		e = storage == EXR_STORAGE_TILED ? read_tiles(x, &d) : read_scanlines(x, &d);
	exr_decoding_destroy(x->f, &d.pipe);
	free(d.buffer);
	return e ? failed(x, e) : ST_OK;
}

static enum status read_image(struct exr_picture *out, const char *path, bool pixels,
                              const struct report *r)
{
	struct reading x = { .path = path, .report = r, .source.fd = -1, .out = out };
	const exr_attr_chlist_t *channels = NULL;
	memset(out, 0, sizeof *out);
	enum status st = open_image(&x);
	if (!st)
		st = read_size(&x, &channels);
	if (!st)
		st = read_names(&x, channels);
	if (!st)
		st = read_attributes(&x);
	if (!st && pixels)
		st = read_pixels(&x);
	if (x.f)
		exr_finish(&x.f);
	if (x.source.fd >= 0)
		close(x.source.fd);
	if (st)
		exr_picture_finish(out);
	return st;
}

enum status exr_read(struct exr_picture *out, const char *path, const struct report *r)
{
	return read_image(out, path, true, r);
}

enum status exr_read_attributes(struct exr_picture *out, const char *path, const struct report *r)
{
	return read_image(out, path, false, r);
}

void exr_picture_finish(struct exr_picture *p)
{
	for (int c = 0; p->names && c < p->n_channels; c++)
		free(p->names[c]);
	for (int c = 0; p->planes && c < p->n_channels; c++)
		free(p->planes[c]);
	for (int i = 0; i < p->n_attributes; i++) {
		free(p->attributes[i].name);
		free(p->attributes[i].value);
	}
	free(p->names);
	free(p->planes);
	free(p->attributes);
	memset(p, 0, sizeof *p);
}

const float *exr_plane(const struct exr_picture *p, const char *name)
{
	for (int c = 0; p->planes && c < p->n_channels; c++)
		if (!strcmp(p->names[c], name))
			return p->planes[c];
	return NULL;
}

const char *exr_text(const struct exr_picture *p, const char *name)
{
	for (int i = 0; i < p->n_attributes; i++)
		if (!strcmp(p->attributes[i].name, name))
			return p->attributes[i].value;
	return NULL;
}
