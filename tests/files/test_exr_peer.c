/* test_exr_peer.c - our image files read by OpenEXR's own library, tile by tile and channel by channel
 * in the file's own types; its files, tiled and in scan lines, read by ours. */
#include <math.h>
#include <openexr.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <unistd.h>

#include <cmocka.h>

#include "exr.h"

enum { WIDTH = 150, HEIGHT = 90, TILE = 64, N_CHANNELS = 5, ROOM = WIDTH * HEIGHT };

/* By name, as files have them. */
static const struct exr_channel channels[N_CHANNELS] = {
	{ "A", true }, { "K", false }, { "N.X", false }, { "R", true }, { "kmin", false },
};

/* Exact as a half where it must be; noise, which zip leaves as it is, in part of N.X. */
static float value_at(int c, int x, int y)
{
	unsigned n = (unsigned)(x * 7919 + y * 104729) * 2654435761u;
	if (channels[c].half)
		return (float)((x * 3 + y * 5 + c) % 2048) / 64;
	if (c == 2)
		return (float)(n >> 8) * 1e-3f;
	return c == 1 && x > 140 ? NAN : (float)x * (float)y + (float)c;
}

static void assert_value(float got, int c, int x, int y)
{
	float want = value_at(c, x, y);
	if (isnan(want))
		assert_true(isnan(got));
	else
		assert_memory_equal(&got, &want, sizeof got);
}

static struct exr_image image(void)
{
	return (struct exr_image){ WIDTH, HEIGHT, TILE, channels, N_CHANNELS, NULL, 0 };
}

static enum status pack_next(void *data, size_t i, const char **bytes, size_t *n)
{
	struct text *t = data;
	const struct exr_image im = image();
	static float values[N_CHANNELS][TILE * TILE];
	const float *planes[N_CHANNELS];
	int x, y, w, h;
	exr_tile_window(&im, i, &x, &y, &w, &h);
	for (int c = 0; c < N_CHANNELS; c++) {
		planes[c] = values[c];
		for (int k = 0; k < w * h; k++)
			values[c][k] = value_at(c, x + k % w, y + k / w);
	}
	text_reset(t);
	enum status st = exr_pack(&im, i, planes, t);
	*bytes = t->s;
	*n = t->n;
	return st;
}

/* Their library's pixels of a chunk as floats. */
static void their_chunk(exr_context_t f, const exr_chunk_info_t *info, float *out)
{
	exr_decode_pipeline_t pipe = EXR_DECODE_PIPELINE_INITIALIZER;
	const size_t n = (size_t)info->width * (size_t)info->height;
	assert_int_equal(exr_decoding_initialize(f, 0, info, &pipe), EXR_ERR_SUCCESS);
	assert_int_equal(pipe.channel_count, N_CHANNELS);
	for (int c = 0; c < N_CHANNELS; c++) {
		exr_coding_channel_info_t *ch = &pipe.channels[c];
		assert_string_equal(ch->channel_name, channels[c].name);
		assert_int_equal(ch->data_type,
		                 channels[c].half ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT);
		ch->decode_to_ptr = (uint8_t *)(out + n * (size_t)c);
		ch->user_data_type = EXR_PIXEL_FLOAT;
		ch->user_bytes_per_element = sizeof(float);
		ch->user_pixel_stride = sizeof(float);
		ch->user_line_stride = info->width * (int)sizeof(float);
	}
	assert_int_equal(exr_decoding_choose_default_routines(f, 0, &pipe), EXR_ERR_SUCCESS);
	assert_int_equal(exr_decoding_run(f, 0, &pipe), EXR_ERR_SUCCESS);
	exr_decoding_destroy(f, &pipe);
}

static void theirs_reads_ours(void **state)
{
	char *path = text_print("%s/ours.exr", (char *)*state);
	const struct exr_image im = image();
	struct text t = { 0 };
	exr_context_t f;
	exr_context_initializer_t init = EXR_DEFAULT_CONTEXT_INITIALIZER;
	float *pixels = malloc(sizeof *pixels * N_CHANNELS * TILE * TILE);
	const int across = exr_tiles_across(&im);
	int32_t chunks;
	assert_non_null(pixels);
	assert_int_equal(exr_write(path, &im, pack_next, &t, NULL), ST_OK);
	assert_int_equal(exr_start_read(&f, path, &init), EXR_ERR_SUCCESS);
	assert_int_equal(exr_get_chunk_count(f, 0, &chunks), EXR_ERR_SUCCESS);
	assert_int_equal(chunks, exr_tiles(&im));
	for (int i = 0; i < chunks; i++) {
		exr_chunk_info_t info;
		int x, y, w, h;
		exr_tile_window(&im, (size_t)i, &x, &y, &w, &h);
		assert_int_equal(
		        exr_read_tile_chunk_info(f, 0, i % across, i / across, 0, 0, &info),
		        EXR_ERR_SUCCESS);
		assert_int_equal(info.width, w);
		assert_int_equal(info.height, h);
		their_chunk(f, &info, pixels);
		for (int c = 0; c < N_CHANNELS; c++)
			for (int k = 0; k < w * h; k++)
				assert_value(pixels[(size_t)c * w * h + k], c, x + k % w,
				             y + k / w);
	}
	exr_finish(&f);
	unlink(path);
	text_finish(&t);
	free(pixels);
	free(path);
}

/* Values of a window, one plane a channel, given to their encoder. */
static void their_encode(exr_context_t f, const exr_chunk_info_t *info, int x, int y)
{
	exr_encode_pipeline_t pipe = EXR_ENCODE_PIPELINE_INITIALIZER;
	const int w = info->width, h = info->height;
	float *values = malloc(sizeof *values * N_CHANNELS * (size_t)w * (size_t)h);
	assert_non_null(values);
	assert_int_equal(exr_encoding_initialize(f, 0, info, &pipe), EXR_ERR_SUCCESS);
	for (int c = 0; c < N_CHANNELS; c++) {
		exr_coding_channel_info_t *ch = &pipe.channels[c];
		float *plane = values + (size_t)c * w * h;
		for (int k = 0; k < w * h; k++)
			plane[k] = value_at(c, x + k % w, y + k / w);
		ch->encode_from_ptr = (const uint8_t *)plane;
		ch->user_data_type = EXR_PIXEL_FLOAT;
		ch->user_bytes_per_element = sizeof(float);
		ch->user_pixel_stride = sizeof(float);
		ch->user_line_stride = w * (int)sizeof(float);
	}
	assert_int_equal(exr_encoding_choose_default_routines(f, 0, &pipe), EXR_ERR_SUCCESS);
	assert_int_equal(exr_encoding_run(f, 0, &pipe), EXR_ERR_SUCCESS);
	exr_encoding_destroy(f, &pipe);
	free(values);
}

/* tile 0: scan lines. */
static void their_file(const char *path, exr_compression_t compression, int tile)
{
	exr_context_t f;
	exr_context_initializer_t init = EXR_DEFAULT_CONTEXT_INITIALIZER;
	exr_chunk_info_t info;
	int part, lines;
	assert_int_equal(exr_start_write(&f, path, EXR_WRITE_FILE_DIRECTLY, &init),
	                 EXR_ERR_SUCCESS);
	assert_int_equal(
	        exr_add_part(f, "picture", tile ? EXR_STORAGE_TILED : EXR_STORAGE_SCANLINE, &part),
	        EXR_ERR_SUCCESS);
	assert_int_equal(exr_initialize_required_attr_simple(f, part, WIDTH, HEIGHT, compression),
	                 EXR_ERR_SUCCESS);
	for (int c = 0; c < N_CHANNELS; c++)
		assert_int_equal(
		        exr_add_channel(f, part, channels[c].name,
		                        channels[c].half ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT,
		                        EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1),
		        EXR_ERR_SUCCESS);
	if (tile)
		assert_int_equal(exr_set_tile_descriptor(f, part, (unsigned)tile, (unsigned)tile,
		                                         EXR_TILE_ONE_LEVEL, EXR_TILE_ROUND_DOWN),
		                 EXR_ERR_SUCCESS);
	assert_int_equal(exr_write_header(f), EXR_ERR_SUCCESS);
	if (tile) {
		for (int y = 0; y < HEIGHT; y += tile)
			for (int x = 0; x < WIDTH; x += tile) {
				assert_int_equal(exr_write_tile_chunk_info(f, part, x / tile,
				                                           y / tile, 0, 0, &info),
				                 EXR_ERR_SUCCESS);
				their_encode(f, &info, x, y);
			}
	} else {
		assert_int_equal(exr_get_scanlines_per_chunk(f, part, &lines), EXR_ERR_SUCCESS);
		for (int y = 0; y < HEIGHT; y += lines) {
			assert_int_equal(exr_write_scanline_chunk_info(f, part, y, &info),
			                 EXR_ERR_SUCCESS);
			their_encode(f, &info, 0, y);
		}
	}
	assert_int_equal(exr_finish(&f), EXR_ERR_SUCCESS);
}

static void ours_reads_theirs(void **state)
{
	static const struct {
		exr_compression_t compression;
		int tile;
	} cases[] = {
		{ EXR_COMPRESSION_NONE, 0 },  { EXR_COMPRESSION_ZIPS, 0 },
		{ EXR_COMPRESSION_ZIP, 0 },   { EXR_COMPRESSION_RLE, 0 },
		{ EXR_COMPRESSION_PIZ, 0 },   { EXR_COMPRESSION_NONE, 32 },
		{ EXR_COMPRESSION_ZIP, 32 },  { EXR_COMPRESSION_ZIPS, 64 },
		{ EXR_COMPRESSION_RLE, 128 },
	};
	char *path = text_print("%s/theirs.exr", (char *)*state);
	for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
		struct exr_picture got;
		their_file(path, cases[k].compression, cases[k].tile);
		assert_int_equal(exr_read(&got, path, NULL), ST_OK);
		assert_int_equal(got.width, WIDTH);
		assert_int_equal(got.height, HEIGHT);
		assert_int_equal(got.n_channels, N_CHANNELS);
		for (int c = 0; c < N_CHANNELS; c++) {
			const float *plane = exr_plane(&got, channels[c].name);
			assert_non_null(plane);
			for (int i = 0; i < ROOM; i++)
				assert_value(plane[i], c, i % WIDTH, i / WIDTH);
		}
		exr_picture_finish(&got);
		unlink(path);
	}
	free(path);
}

int main(void)
{
	char folder[] = "/tmp/batten-test-XXXXXX";
	if (!mkdtemp(folder))
		return 1;
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_prestate(theirs_reads_ours, folder),
		cmocka_unit_test_prestate(ours_reads_theirs, folder),
	};
	int failed = cmocka_run_group_tests(tests, NULL, NULL);
	rmdir(folder);
	return failed;
}
