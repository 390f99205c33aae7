/* test_part_look.c - a part file read while it is written, and its tiles unpacked. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "exr.h"
#include "part.h"

enum { WIDTH = 100, HEIGHT = 70, TILE = 64, CHANNELS = 3 };

/* Not in the order of their names; halves that are exact as such. */
static const struct exr_channel channels[CHANNELS] = { { "Z", false },
	                                               { "A", true },
	                                               { "K", false } };
static const struct exr_image image = {
	.width = WIDTH, .height = HEIGHT, .tile = TILE, .channels = channels, .n_channels = CHANNELS
};

/* Smooth, so that it is compressed, or noise, so that it is not. */
static float value(bool noise, int c, int x, int y)
{
	if (c == 1)
		return (float)((x * 7 + y) % 64) / 32 - 1;
	if (noise)
		return (float)rand() / 7919;
	return (float)(x / 8 + c);
}

static void tile_comes_back(bool noise, size_t tile)
{
	static float in[CHANNELS][TILE * TILE], out[CHANNELS][TILE * TILE];
	const float *planes[CHANNELS] = { in[0], in[1], in[2] };
	float *back[CHANNELS] = { out[0], out[1], out[2] };
	static const char figures[] = "\1\2\3\4 figures of the tile";
	struct text bytes = { .s = NULL };
	int x, y, w, h;
	exr_tile_window(&image, tile, &x, &y, &w, &h);
	for (int c = 0; c < CHANNELS; c++)
		for (int i = 0; i < w * h; i++)
			in[c][i] = value(noise, c, x + i % w, y + i / w);
	assert_int_equal(exr_pack(&image, tile, planes, &bytes), ST_OK);
	const size_t packed = bytes.n;
	/* as workers do, figures stand behind */
	text_add_bytes(&bytes, figures, sizeof figures);
	assert_false(bytes.failed);
	assert_int_equal(exr_unpack(&image, tile, bytes.s, bytes.n, back), ST_OK);
	for (int c = 0; c < CHANNELS; c++)
		assert_memory_equal(in[c], out[c], (size_t)w * h * sizeof(float));
	assert_int_equal(exr_unpack(&image, tile, bytes.s, packed / 2, back), ST_INPUT);
	text_finish(&bytes);
}

static void tiles_come_back(void **state)
{
	(void)state;
	for (size_t tile = 0; tile < exr_tiles(&image); tile++) {
		tile_comes_back(false, tile);
		tile_comes_back(true, tile);
	}
}

static void a_file_being_written_is_seen(void **state)
{
	static const char key[] = "worker=curvature\nparam.grid=100x70\n";
	char path[] = "/tmp/batten-look-XXXXXX";
	struct part *p;
	struct part_glance g;
	(void)state;
	int fd = mkstemp(path);
	assert_true(fd >= 0);
	close(fd);
	assert_int_equal(part_look(&g, path, &report_none), ST_INPUT); /* empty */
	assert_int_equal(part_open(&p, path, key, 5, &report_none), ST_OK);
	assert_int_equal(part_put(p, 3, "three", 5, &report_none), ST_OK);
	assert_int_equal(part_put(p, 0, "", 0, &report_none), ST_OK);
	/* while the writer has it open and locked */
	assert_int_equal(part_look(&g, path, &report_none), ST_OK);
	assert_int_equal(g.n_units, 5);
	assert_int_equal(g.n, 2);
	assert_int_equal(g.key_length, sizeof key - 1);
	assert_memory_equal(g.key, key, g.key_length);
	assert_true(g.found[0].unit == 3 && g.found[0].n == 5 && g.found[1].unit == 0);
	assert_memory_equal(g.found[0].bytes, "three", 5);
	part_glance_finish(&g);
	assert_int_equal(part_put(p, 1, "torn", 4, &report_none), ST_OK);
	part_close(p);
	/* cut anywhere, whole records only */
	FILE *f = fopen(path, "rb");
	char bytes[4096];
	size_t n = fread(bytes, 1, sizeof bytes, f);
	fclose(f);
	for (size_t cut = n; cut-- > 0;) {
		assert_int_equal(truncate(path, (off_t)cut), 0);
		enum status st = part_look(&g, path, &report_none);
		assert_true(st == ST_OK ? g.n <= 2 : st == ST_INPUT && !g.found);
		part_glance_finish(&g);
	}
	unlink(path);
	assert_int_equal(part_look(&g, path, &report_none), ST_INPUT);
}

int main(void)
{
	static const struct CMUnitTest tests[] = {
		cmocka_unit_test(tiles_come_back),
		cmocka_unit_test(a_file_being_written_is_seen),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
