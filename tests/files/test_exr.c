/* test_exr.c - OpenEXR images: packed tiles, whole files, damaged files, full disks. */
#include "exr.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>
#include <signal.h>

#include <cmocka.h>

#include "file.h"
#include "parallel.h"

/* Not in the library's order, so that the mapping counts. */
static const struct exr_channel channels[] = {
	{ "R", true }, { "kmin", false }, { "A", true }, { "K", false }, { "N.X", false },
};
enum { N_CHANNELS = sizeof channels / sizeof *channels };

static const struct exr_attribute attributes[] = {
	{ "program", "batten 0.1.0" },
	{ "a name of more than thirty-one characters", "kept" },
	{ "figures", "{\"K_min\":-1,\"unit\":\"1/m²\"}" },
	{ "empty", "" },
};
enum { N_ATTRIBUTES = sizeof attributes / sizeof *attributes };

struct packed {
	struct exr_image im;
	struct text *tiles; /* owned */
	size_t fail_at;     /* the source fails at this tile */
};

/* Smooth in one half, noise (which does not get smaller) in the other; exact in half for R, A. */
static float value_at(int c, int x, int y)
{
	unsigned n = (unsigned)(x * 7919 + y * 104729 + c * 1299709) * 2654435761u;
	if (channels[c].half)
		return (float)((x * 3 + y * 5 + c) % 2048) / 64;
	return x % 40 < 20 ? (float)x * y + c : (float)(n >> 8) * 1e-3f;
}

static enum status pack_one(void *data, size_t i, int thread)
{
	struct packed *p = data;
	int x, y, w, h;
	(void)thread;
	exr_tile_window(&p->im, i, &x, &y, &w, &h);
	float *values = malloc(sizeof(float) * N_CHANNELS * w * h);
	const float *planes[N_CHANNELS];
	for (int c = 0; c < N_CHANNELS; c++) {
		planes[c] = values + (size_t)c * w * h;
		for (int k = 0; k < w * h; k++)
			values[(size_t)c * w * h + k] = value_at(c, x + k % w, y + k / w);
	}
	enum status st = exr_pack(&p->im, i, planes, &p->tiles[i]);
	free(values);
	return st;
}

static void pack_all(struct packed *p, int width, int height, int tile, int threads)
{
	*p = (struct packed){ .im = { width, height, tile, channels, N_CHANNELS, attributes,
		                      N_ATTRIBUTES },
		              .fail_at = SIZE_MAX };
	p->tiles = calloc(exr_tiles(&p->im), sizeof *p->tiles);
	assert_int_equal(parallel_run(threads, exr_tiles(&p->im), NULL, pack_one, p), ST_OK);
}

static void packed_finish(struct packed *p)
{
	for (size_t i = 0; i < exr_tiles(&p->im); i++)
		text_finish(&p->tiles[i]);
	free(p->tiles);
}

static enum status give(void *data, size_t i, const char **bytes, size_t *n)
{
	struct packed *p = data;
	if (i == p->fail_at)
		return ST_CANCELLED;
	*bytes = p->tiles[i].s;
	*n = p->tiles[i].n;
	return ST_OK;
}

static char *name_in(void **state, const char *name)
{
	return text_print("%s/%s", (char *)*state, name);
}

static void test_tiles(void **state)
{
	static const struct {
		int width, height, tile, across, down;
	} cases[] = {
		{ 1, 1, 64, 1, 1 },    { 64, 64, 64, 1, 1 },   { 65, 64, 64, 2, 1 },
		{ 64, 129, 64, 1, 3 }, { 200, 100, 32, 7, 4 },
	};
	(void)state;
	for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
		struct exr_image im = { .width = cases[k].width,
			                .height = cases[k].height,
			                .tile = cases[k].tile };
		assert_int_equal(exr_tiles_across(&im), cases[k].across);
		assert_int_equal(exr_tiles_down(&im), cases[k].down);
		long pixels = 0;
		for (size_t i = 0; i < exr_tiles(&im); i++) {
			int x, y, w, h;
			exr_tile_window(&im, i, &x, &y, &w, &h);
			assert_true(w > 0 && h > 0 && x + w <= im.width && y + h <= im.height);
			pixels += (long)w * h;
		}
		assert_int_equal(pixels, (long)im.width * im.height);
	}
}

static void test_round_trip(void **state)
{
	static const int sizes[][3] = {
		{ 1, 1, 64 }, { 100, 70, 32 }, { 64, 64, 64 }, { 33, 5, 64 }
	};
	char *path = name_in(state, "round.exr");
	for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++) {
		struct packed p;
		struct exr_picture got;
		pack_all(&p, sizes[k][0], sizes[k][1], sizes[k][2], 1);
		assert_int_equal(exr_write(path, &p.im, give, &p, NULL), ST_OK);
		assert_int_equal(exr_read(&got, path, NULL), ST_OK);
		assert_int_equal(got.width, sizes[k][0]);
		assert_int_equal(got.height, sizes[k][1]);
		assert_int_equal(got.n_channels, N_CHANNELS);
		for (int c = 0; c < N_CHANNELS; c++) {
			const float *plane = exr_plane(&got, channels[c].name);
			assert_non_null(plane);
			for (int i = 0; i < got.width * got.height; i++) {
				float want = value_at(c, i % got.width, i / got.width);
				assert_memory_equal(&plane[i], &want, sizeof want);
			}
		}
		assert_null(exr_plane(&got, "Z"));
		for (int i = 0; i < N_ATTRIBUTES; i++)
			assert_string_equal(exr_text(&got, attributes[i].name),
			                    attributes[i].value);
		exr_picture_finish(&got);

		assert_int_equal(exr_read_attributes(&got, path, NULL), ST_OK);
		assert_int_equal(got.width, sizes[k][0]);
		assert_null(exr_plane(&got, "K"));
		assert_string_equal(exr_text(&got, "program"), "batten 0.1.0");
		assert_null(exr_text(&got, "none"));
		exr_picture_finish(&got);
		packed_finish(&p);
	}
	unlink(path);
	free(path);
}

/* Same values, same bytes: however many threads, in whatever order. */
static void test_same_bytes(void **state)
{
	char *first = NULL;
	size_t n_first = 0;
	for (int threads = 1; threads <= 4; threads += 3) {
		char *path = name_in(state, "same.exr"), *bytes;
		size_t n;
		struct packed p;
		pack_all(&p, 150, 90, 16, threads);
		assert_int_equal(exr_write(path, &p.im, give, &p, NULL), ST_OK);
		assert_int_equal(file_read(path, UINT64_MAX, &bytes, &n, NULL), ST_OK);
		if (first) {
			assert_int_equal(n, n_first);
			assert_memory_equal(bytes, first, n);
			free(bytes);
		} else {
			first = bytes;
			n_first = n;
		}
		packed_finish(&p);
		unlink(path);
		free(path);
	}
	free(first);
}

static enum status give_text(void *data, size_t i, const char **bytes, size_t *n)
{
	struct text *t = data;
	(void)i;
	*bytes = t->s;
	*n = t->n;
	return ST_OK;
}

/* float -> half: nearest, ties to even, subnormals, overflow, infinities, NaN. */
static void test_half(void **state)
{
	static const struct {
		float in, out;
	} cases[] = {
		{ 0, 0 },
		{ -0.0f, -0.0f },
		{ 1, 1 },
		{ 0x1.002p0f, 0x1.0p0f },    /* tie, down to even */
		{ 0x1.006p0f, 0x1.008p0f },  /* tie, up to even */
		{ 0x1.0021p0f, 0x1.004p0f }, /* a little above the tie */
		{ 0x1.ffep0f, 0x1.0p1f },    /* tie that goes up to the next power */
		{ 65504, 65504 },
		{ 65519, 65504 },
		{ 65520, INFINITY },
		{ -1e30f, -INFINITY },
		{ INFINITY, INFINITY },
		{ 0x1p-24f, 0x1p-24f },   /* smallest subnormal */
		{ 0x1p-25f, 0 },          /* tie, down to even */
		{ 0x1.8p-24f, 0x1p-23f }, /* tie, up to even */
		{ 0x1.004p-14f, 0x1.004p-14f },
		{ 1e-12f, 0 },
		{ NAN, NAN },
	};
	enum { N = sizeof cases / sizeof *cases };
	static const struct exr_channel half[] = { { "R", true } };
	struct exr_image im = { N, 1, 64, half, 1, NULL, 0 };
	float values[N];
	for (int i = 0; i < N; i++)
		values[i] = cases[i].in;
	struct text tile = { 0 };
	assert_int_equal(exr_pack(&im, 0, &(const float *){ values }, &tile), ST_OK);
	char *path = name_in(state, "half.exr");
	assert_int_equal(exr_write(path, &im, give_text, &tile, NULL), ST_OK);
	struct exr_picture got;
	assert_int_equal(exr_read(&got, path, NULL), ST_OK);
	for (int i = 0; i < N; i++) {
		if (isnan(cases[i].out)) {
			assert_true(isnan(got.planes[0][i]));
			continue;
		}
		assert_true(got.planes[0][i] == cases[i].out);
		assert_int_equal(signbit(got.planes[0][i]), signbit(cases[i].out));
	}
	exr_picture_finish(&got);
	text_finish(&tile);
	unlink(path);
	free(path);
}

struct one_tile {
	float values[2][100 * 100];
	struct text bytes; /* owned */
};

static enum status give_one(void *data, size_t i, const char **bytes, size_t *n)
{
	struct one_tile *t = data;
	assert_int_equal(i, 0);
	*bytes = t->bytes.s;
	*n = t->bytes.n;
	return ST_OK;
}

/* What zip hardly shrinks stays as it is; repeated rows of noise and smooth values do not. */
static void test_worth(void **state)
{
	enum { SIDE = 100 };
	static const struct exr_channel two[] = { { "K", false }, { "H", false } };
	const struct exr_image im = { SIDE, SIDE, 128, two, 2, NULL, 0 };
	char *path = name_in(state, "worth.exr");
	for (int kind = 0; kind < 3; kind++) {
		static struct one_tile t;
		struct exr_picture read;
		unsigned seed = 7;
		for (int c = 0; c < 2; c++)
			for (int k = 0; k < SIDE * SIDE; k++) {
				seed = seed * 1664525u + 1013904223u;
				t.values[c][k] = kind == 0   ? (float)(seed >> 8) * 1e-3f
				                 : kind == 1 ? (float)(k % SIDE)
				                 : k < SIDE  ? (float)(seed >> 8) * 1e-3f
				                             : t.values[c][k - SIDE];
			}
		assert_int_equal(
		        exr_pack(&im, 0, (const float *[]){ t.values[0], t.values[1] }, &t.bytes),
		        ST_OK);
		if (kind == 0)
			assert_int_equal(t.bytes.n,
			                 EXR_CHUNK_HEAD + 2 * SIDE * SIDE * sizeof(float));
		else
			assert_true(t.bytes.n < SIDE * SIDE);
		assert_int_equal(exr_write(path, &im, give_one, &t, NULL), ST_OK);
		assert_int_equal(exr_read(&read, path, NULL), ST_OK);
		for (int c = 0; c < 2; c++)
			assert_memory_equal(exr_plane(&read, two[c].name), t.values[c],
			                    sizeof t.values[c]);
		exr_picture_finish(&read);
		text_finish(&t.bytes);
	}
	unlink(path);
	free(path);
}

static void test_write_failures(void **state)
{
	struct report_store said;
	struct packed p;
	pack_all(&p, 200, 200, 32, 1);

	report_store_init(&said);
	char *path = name_in(state, "no/such/folder.exr");
	assert_int_equal(exr_write(path, &p.im, give, &p, &said.report), ST_INPUT);
	assert_non_null(strstr(said.error, "folder.exr"));
	free(path);

	/* a source that stops: its status, and no file */
	report_store_init(&said);
	path = name_in(state, "stopped.exr");
	p.fail_at = 20;
	assert_int_equal(exr_write(path, &p.im, give, &p, &said.report), ST_CANCELLED);
	assert_int_equal(access(path, F_OK), -1);
	assert_int_equal(said.n_errors, 0);
	p.fail_at = SIZE_MAX;

	/* a disk that is full at every stage: the header, a tile */
	assert_int_equal(exr_write(path, &p.im, give, &p, NULL), ST_OK);
	struct exr_picture whole;
	assert_int_equal(exr_read(&whole, path, NULL), ST_OK);
	exr_picture_finish(&whole);
	struct rlimit old;
	getrlimit(RLIMIT_FSIZE, &old);
	void (*handler)(int) = signal(SIGXFSZ, SIG_IGN);
	static const rlim_t rooms[] = { 0, 100, 1000, 5000 };
	for (size_t k = 0; k < sizeof rooms / sizeof *rooms; k++) {
		report_store_init(&said);
		struct rlimit small = { rooms[k], old.rlim_max };
		setrlimit(RLIMIT_FSIZE, &small);
		enum status st = exr_write(path, &p.im, give, &p, &said.report);
		setrlimit(RLIMIT_FSIZE, &old);
		assert_int_equal(st, ST_RESOURCE);
		assert_int_equal(said.n_errors, 1);
		assert_non_null(strstr(said.error, "make room"));
		assert_int_equal(access(path, F_OK), -1);
	}
	signal(SIGXFSZ, handler);
	packed_finish(&p);
	free(path);
}

static void must_fail(const char *path, const char *bytes, size_t n)
{
	struct report_store said;
	struct exr_picture got;
	report_store_init(&said);
	assert_int_equal(file_write(path, bytes, n, NULL), ST_OK);
	assert_int_equal(exr_read(&got, path, &said.report), ST_INPUT);
	assert_int_equal(said.n_errors, 1);
	assert_non_null(strstr(said.error, path));
	assert_null(got.planes);
	exr_picture_finish(&got);
}

static void test_bad_files(void **state)
{
	struct report_store said;
	struct exr_picture got;
	report_store_init(&said);
	assert_int_equal(exr_read(&got, "/no/such/file.exr", &said.report), ST_INPUT);
	assert_non_null(strstr(said.error, "/no/such/file.exr"));
	report_store_init(&said);
	assert_int_equal(exr_read(&got, *state, &said.report), ST_INPUT);
	assert_int_equal(said.n_errors, 1);

	char *path = name_in(state, "bad.exr"), *bytes;
	size_t n;
	must_fail(path, "", 0);
	must_fail(path, "solid teapot\n", 13);

	struct packed p;
	pack_all(&p, 100, 70, 32, 1);
	assert_int_equal(exr_write(path, &p.im, give, &p, NULL), ST_OK);
	assert_int_equal(file_read(path, UINT64_MAX, &bytes, &n, NULL), ST_OK);
	/* cut short anywhere */
	for (size_t cut = 4; cut < n; cut += n / 37)
		must_fail(path, bytes, cut);
	/* a header that promises 2^28 x 2^28 pixels */
	static const char window[] = "dataWindow\0box2i\0\20\0\0";
	char *at = memmem(bytes, n, window, sizeof window);
	assert_non_null(at);
	memcpy(at + sizeof window + 8, "\377\377\377\17\377\377\377\17", 8);
	must_fail(path, bytes, n);
	free(bytes);
	packed_finish(&p);
	unlink(path);
	free(path);
}

static int make_folder(void **state)
{
	char folder[] = "/tmp/test-exr-XXXXXX";
	*state = mkdtemp(folder) ? strdup(folder) : NULL;
	return *state ? 0 : -1;
}

static int remove_folder(void **state)
{
	int rc = rmdir(*state);
	free(*state);
	return rc;
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(test_tiles),      cmocka_unit_test(test_round_trip),
		cmocka_unit_test(test_same_bytes), cmocka_unit_test(test_half),
		cmocka_unit_test(test_worth),      cmocka_unit_test(test_write_failures),
		cmocka_unit_test(test_bad_files),
	};
	return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
