/* test_part_ordered.c - part files that become the output: whatever the order, whatever happens between,
 * the bytes are the same. */
#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "exr.h"
#include "file.h"
#include "parallel.h"
#include "part.h"

enum { WIDTH = 150, HEIGHT = 90, TILE = 32, UNITS = 15, BEHIND = 5 };
static const char key[] = "worker=probe\ninput=1234\n";
static const struct exr_channel channels[] = { { "K", false }, { "A", true } };
static const struct exr_attribute attributes[] = { { "worker", "probe" }, { "figures", "{}" } };
static const struct exr_image image = { WIDTH, HEIGHT, TILE, channels, 2, attributes, 2 };
static char folder[40];
static char path[64], ahead[64], other[64], whole[64];

static int enter(void **state)
{
	(void)state;
	/* every whole file is synced: in memory, where that can be had, it takes no time */
	snprintf(folder, sizeof folder, "%s/batten-ordered-XXXXXX",
	         access("/dev/shm", W_OK) ? "/tmp" : "/dev/shm");
	assert_non_null(mkdtemp(folder));
	snprintf(path, sizeof path, "%s/a.part", folder);
	snprintf(ahead, sizeof ahead, "%s/a.part.ahead", folder);
	snprintf(other, sizeof other, "%s/b.part", folder);
	snprintf(whole, sizeof whole, "%s/whole.exr", folder);
	return 0;
}

static int leave(void **state)
{
	(void)state;
	unlink(path);
	unlink(ahead);
	unlink(other);
	unlink(whole);
	return rmdir(folder);
}

static float value(int c, int x, int y)
{
	return c ? (float)((x + y) % 4) : (float)(x * 3 + y * y);
}

static void unit_bytes(size_t unit, struct text *out)
{
	static float room[2][TILE * TILE];
	const float *planes[] = { room[0], room[1] };
	int x, y, w, h;
	exr_tile_window(&image, unit, &x, &y, &w, &h);
	for (int c = 0; c < 2; c++)
		for (int i = 0; i < w * h; i++)
			room[c][i] = value(c, x + i % w, y + i / w);
	assert_int_equal(exr_pack(&image, unit, planes, out), ST_OK);
	text_add_bytes(out, "after", BEHIND);
}

static struct part *open_ordered(void)
{
	struct part *p;
	assert_int_equal(part_open_ordered(&p, path, key, UNITS, NULL), ST_OK);
	return p;
}

static void put(struct part *p, size_t unit)
{
	struct text bytes = { 0 };
	unit_bytes(unit, &bytes);
	assert_int_equal(part_put(p, unit, bytes.s, bytes.n, NULL), ST_OK);
	text_finish(&bytes);
}

static void expect_unit(struct part *p, size_t unit)
{
	struct text bytes = { 0 }, got = { 0 };
	char end[BEHIND];
	unit_bytes(unit, &bytes);
	assert_true(part_has(p, unit));
	assert_int_equal(part_read(p, unit, &got, NULL), ST_OK);
	assert_int_equal(got.n, bytes.n);
	assert_memory_equal(got.s, bytes.s, got.n);
	if (part_place(p, unit)) {
		assert_int_equal(part_read_end(p, unit, end, BEHIND, NULL), ST_OK);
		assert_memory_equal(end, "after", BEHIND);
	}
	text_finish(&bytes);
	text_finish(&got);
}

/* Write the front; what the file holds then. */
static char *become(struct part *p, size_t *n)
{
	uint64_t places[UNITS];
	size_t n_first;
	char *bytes;
	struct text front = { 0 };
	const char *first = part_front_attribute(p, &n_first);
	for (size_t i = 0; i < UNITS; i++)
		assert_true((places[i] = part_place(p, i)) > 0);
	assert_int_equal(exr_front(&image, first, n_first, places, &front), ST_OK);
	assert_true(front.n <= part_front(p));
	assert_int_equal(part_write_front(p, front.s, front.n, NULL), ST_OK);
	text_finish(&front);
	assert_int_equal(file_read(path, UINT64_MAX, &bytes, n, NULL), ST_OK);
	return bytes;
}

/* What one that was never disturbed holds. */
static char *undisturbed(size_t *n)
{
	struct part *p = open_ordered();
	for (size_t unit = 0; unit < UNITS; unit++)
		put(p, unit);
	assert_int_equal(access(ahead, F_OK), -1);
	char *bytes = become(p, n);
	part_remove(p);
	return bytes;
}

static void expect_whole(struct part *p)
{
	size_t n, n_good;
	char *bytes = become(p, &n);
	part_close(p);
	assert_int_equal(access(ahead, F_OK), -1);
	unlink(path);
	char *good = undisturbed(&n_good);
	assert_int_equal(n, n_good);
	assert_memory_equal(bytes, good, n);
	free(bytes);
	free(good);
}

/* Orders of arrival: unit = (first + i * step) mod UNITS. */
static void test_orders(void **state)
{
	static const size_t rows[][2] = { { 0, 1 },  { 14, 14 }, { 1, 2 }, { 0, 7 },
		                          { 14, 1 }, { 3, 4 },   { 7, 8 } };
	(void)state;
	for (size_t r = 0; r < sizeof rows / sizeof *rows; r++)
		for (size_t close_at = 0; close_at <= UNITS; close_at += 5) {
			struct part *p = open_ordered();
			for (size_t i = 0; i < UNITS; i++) {
				put(p, (rows[r][0] + i * rows[r][1]) % UNITS);
				put(p, (rows[r][0] + i * rows[r][1]) % UNITS); /* left */
				assert_int_equal(part_count(p), i + 1);
				for (size_t k = 0; k <= i; k++)
					expect_unit(p, (rows[r][0] + k * rows[r][1]) % UNITS);
				if (i == close_at) {
					part_close(p);
					p = open_ordered();
					assert_int_equal(part_count(p), i + 1);
				}
			}
			expect_whole(p);
		}
}

static enum status put_unit(void *data, size_t unit, int thread)
{
	(void)thread;
	struct text bytes = { 0 };
	static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
	pthread_mutex_lock(&lock); /* unit_bytes has one room */
	unit_bytes(unit, &bytes);
	pthread_mutex_unlock(&lock);
	enum status st = part_put(data, unit, bytes.s, bytes.n, NULL);
	text_finish(&bytes);
	return st;
}

static void test_threads(void **state)
{
	(void)state;
	struct part *p = open_ordered();
	assert_int_equal(parallel_run(4, UNITS, NULL, put_unit, p), ST_OK);
	expect_whole(p);
}

/* The image can be read as any other, tiles among the part file's own bytes. */
static void test_image(void **state)
{
	(void)state;
	struct exr_picture got;
	struct part *p = open_ordered();
	for (size_t unit = UNITS; unit-- > 0;)
		put(p, unit);
	assert_int_equal(exr_read(&got, path, &report_none), ST_INPUT); /* not yet */
	size_t n;
	free(become(p, &n));
	assert_int_equal(part_become(p, whole), 0);
	part_remove(p);
	assert_int_equal(access(path, F_OK), -1);
	assert_int_equal(exr_read(&got, whole, NULL), ST_OK);
	assert_string_equal(exr_text(&got, "worker"), "probe");
	for (int c = 0; c < 2; c++)
		for (int i = 0; i < WIDTH * HEIGHT; i++)
			assert_true(exr_plane(&got, channels[c].name)[i] ==
			            value(c, i % WIDTH, i / WIDTH));
	exr_picture_finish(&got);
}

/* Killed between front and renaming: it is a part file still, for its own work and for another. */
static void test_killed_at_the_end(void **state)
{
	(void)state;
	struct report_store said;
	struct part *p;
	size_t n;
	for (int way = 0; way < 3; way++) {
		p = open_ordered();
		for (size_t unit = 0; unit < UNITS; unit++)
			put(p, unit);
		free(become(p, &n));
		part_close(p);
		report_store_init(&said);
		if (way == 0) {
			p = open_ordered();
			assert_int_equal(part_count(p), UNITS);
			expect_whole(p);
		} else if (way == 1) {
			assert_int_equal(part_open(&p, path, "other", 3, &said.report), ST_OK);
			assert_non_null(strstr(said.warning, "begun anew"));
			assert_int_equal(part_count(p), 0);
			part_remove(p);
		} else {
			part_discard(path);
			assert_int_equal(access(path, F_OK), -1);
		}
	}
	/* an image of somebody else's is left alone */
	assert_int_equal(file_write(path, "\x76\x2f\x31\x01\2\6\0\0channels\0", 18, NULL), ST_OK);
	assert_int_equal(part_open_ordered(&p, path, key, UNITS, &said.report), ST_INPUT);
	assert_non_null(strstr(said.error, "is no part file"));
}

/* Either file cut or damaged anywhere: no unit comes out wrong, and the end is the same. */
static void test_damage(void **state)
{
	(void)state;
	char *good[2];
	size_t n[2];
	struct part *p = open_ordered();
	static const size_t there[] = { 0, 1, 2, 3, 9, 7, 12 };
	for (size_t i = 0; i < sizeof there / sizeof *there; i++)
		put(p, there[i]);
	part_close(p);
	assert_int_equal(file_read(path, UINT64_MAX, &good[0], &n[0], NULL), ST_OK);
	assert_int_equal(file_read(ahead, UINT64_MAX, &good[1], &n[1], NULL), ST_OK);
	for (int file = 0; file < 2; file++)
		for (int way = 0; way < 2; way++)
			for (size_t at = 8; at < n[file]; at += n[file] / 29) {
				char *bytes = good[file];
				size_t length = way ? at : n[file];
				assert_int_equal(file_write(path, good[0], n[0], NULL), ST_OK);
				assert_int_equal(file_write(ahead, good[1], n[1], NULL), ST_OK);
				bytes[at] ^= 0x20;
				assert_int_equal(
				        file_write(file ? ahead : path, bytes, length, NULL),
				        ST_OK);
				bytes[at] ^= 0x20;
				p = open_ordered();
				for (size_t unit = 0; unit < UNITS; unit++)
					if (part_has(p, unit))
						expect_unit(p, unit);
				for (size_t unit = 0; unit < UNITS; unit++)
					put(p, unit);
				assert_int_equal(part_count(p), UNITS);
				expect_whole(p);
			}
	free(good[0]);
	free(good[1]);
}

/* Of other work, or as batten wrote them before: begun anew, and so is what waited beside it. */
static void test_other_work(void **state)
{
	(void)state;
	struct report_store said;
	struct part *p;
	for (int way = 0; way < 3; way++) {
		p = open_ordered();
		put(p, 0);
		put(p, 5);
		part_close(p);
		assert_int_equal(access(ahead, F_OK), 0);
		if (way == 2) {
			unlink(path);
			assert_int_equal(part_open(&p, path, key, UNITS, NULL), ST_OK);
			part_close(p);
		}
		report_store_init(&said);
		assert_int_equal(part_open_ordered(&p, path, way ? key : "other",
		                                   UNITS + (way == 1), &said.report),
		                 ST_OK);
		assert_non_null(strstr(said.warning, "begun anew"));
		assert_int_equal(part_count(p), 0);
		part_remove(p);
		assert_int_equal(access(ahead, F_OK), -1);
	}
}

/* Shards are plain; what comes of them is what one process makes. */
static void test_shards(void **state)
{
	(void)state;
	struct part *p, *into = open_ordered();
	for (size_t shard = 0; shard < 3; shard++) {
		assert_int_equal(part_open(&p, other, key, UNITS, NULL), ST_OK);
		for (size_t unit = shard; unit < UNITS; unit += 3)
			put(p, unit);
		part_close(p);
		assert_int_equal(part_merge(into, other, NULL), ST_OK);
		part_discard(other);
	}
	expect_whole(into);
}

/* Seen by another process: what is in place and what waits. */
static void test_look(void **state)
{
	(void)state;
	struct part_glance g;
	struct part *p = open_ordered();
	assert_int_equal(part_look(&g, path, &report_none), ST_OK);
	assert_int_equal(g.n, 0);
	assert_int_equal(g.n_units, UNITS);
	assert_int_equal(g.key_length, sizeof key - 1);
	assert_memory_equal(g.key, key, g.key_length);
	part_glance_finish(&g);
	put(p, 0);
	put(p, 1);
	put(p, 4);
	assert_int_equal(part_look(&g, path, &report_none), ST_OK);
	bool seen[UNITS] = { false };
	for (size_t i = 0; i < g.n; i++) {
		struct text bytes = { 0 };
		unit_bytes(g.found[i].unit, &bytes);
		assert_int_equal(g.found[i].n, bytes.n);
		assert_memory_equal(g.found[i].bytes, bytes.s, bytes.n);
		seen[g.found[i].unit] = true;
		text_finish(&bytes);
	}
	assert_true(g.n == 3 && seen[0] && seen[1] && seen[4]);
	part_glance_finish(&g);
	part_remove(p);
	assert_int_equal(access(ahead, F_OK), -1);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_orders, enter, leave),
		cmocka_unit_test_setup_teardown(test_threads, enter, leave),
		cmocka_unit_test_setup_teardown(test_image, enter, leave),
		cmocka_unit_test_setup_teardown(test_killed_at_the_end, enter, leave),
		cmocka_unit_test_setup_teardown(test_damage, enter, leave),
		cmocka_unit_test_setup_teardown(test_other_work, enter, leave),
		cmocka_unit_test_setup_teardown(test_shards, enter, leave),
		cmocka_unit_test_setup_teardown(test_look, enter, leave),
	};
	return cmocka_run_group_tests_name("part_ordered", tests, NULL, NULL);
}
