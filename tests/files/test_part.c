/* test_part.c - part files: what was put is there again, whatever happened to the file between. */
#include "part.h"

#include <fcntl.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "parallel.h"
#include "text.h"

enum { UNITS = 12 };
static const char key[] = "worker=probe\ninput=1234\n";
static char path[64], second[64];

static int enter(void **state)
{
	(void)state;
	char folder[] = "/tmp/batten-part-XXXXXX";
	assert_non_null(mkdtemp(folder));
	snprintf(path, sizeof path, "%s/a.part", folder);
	snprintf(second, sizeof second, "%s/b.part", folder);
	return 0;
}

static int leave(void **state)
{
	(void)state;
	unlink(path);
	unlink(second);
	*strrchr(path, '/') = 0;
	return rmdir(path);
}

/* Unit k: 37 k bytes by formula (unit 0 has none). */
static size_t unit_bytes(size_t unit, char *out)
{
	for (size_t i = 0; i < 37 * unit; i++)
		out[i] = (char)(unit * 7 + i);
	return 37 * unit;
}

static enum status put(struct part *p, size_t unit)
{
	char bytes[37 * UNITS];
	size_t n = unit_bytes(unit, bytes);
	return part_put(p, unit, bytes, n, NULL);
}

static void expect_unit(struct part *p, size_t unit)
{
	char expected[37 * UNITS];
	const char *bytes;
	size_t n, n_expected = unit_bytes(unit, expected);
	assert_int_equal(part_get(p, unit, &bytes, &n, NULL), ST_OK);
	assert_int_equal(n, n_expected);
	assert_memory_equal(bytes, expected, n);
	struct text room = { 0 };
	text_add(&room, "of another unit");
	assert_int_equal(part_read(p, unit, &room, NULL), ST_OK);
	assert_int_equal(room.n, n_expected);
	assert_memory_equal(room.s, expected, n_expected);
	text_finish(&room);
	char end[37];
	assert_int_equal(part_read_end(p, unit, end, sizeof end, NULL), unit ? ST_OK : ST_INPUT);
	if (unit)
		assert_memory_equal(end, expected + n_expected - sizeof end, sizeof end);
}

static struct part *open_part(const char *at)
{
	struct part *p;
	assert_int_equal(part_open(&p, at, key, UNITS, NULL), ST_OK);
	return p;
}

static off_t size_of(const char *at)
{
	struct stat st;
	assert_int_equal(stat(at, &st), 0);
	return st.st_size;
}

/* All units, last first. */
static void fill(const char *at)
{
	struct part *p = open_part(at);
	for (size_t unit = UNITS; unit-- > 0;)
		assert_int_equal(put(p, unit), ST_OK);
	part_close(p);
}

static void test_there_and_back(void **state)
{
	(void)state;
	struct part *p = open_part(path);
	const char *bytes;
	size_t n;
	assert_int_equal(part_count(p), 0);
	assert_int_equal(part_get(p, 3, &bytes, &n, NULL), ST_INPUT);
	assert_int_equal(part_get(p, UNITS, &bytes, &n, NULL), ST_INPUT);
	struct text room = { 0 };
	assert_int_equal(part_read(p, 3, &room, NULL), ST_INPUT);
	assert_int_equal(part_read_end(p, UNITS, &room, 0, NULL), ST_INPUT);
	text_finish(&room);
	assert_int_equal(put(p, 3), ST_OK);
	assert_int_equal(put(p, 3), ST_OK); /* again: left as it is */
	assert_int_equal(part_put(p, UNITS, "x", 1, NULL), ST_INTERNAL);
	assert_int_equal(part_count(p), 1);
	assert_true(part_has(p, 3) && !part_has(p, 4) && !part_has(p, UNITS));
	expect_unit(p, 3);
	/* bytes got stay while more come */
	assert_int_equal(part_get(p, 3, &bytes, &n, NULL), ST_OK);
	for (size_t unit = 0; unit < UNITS; unit++) {
		assert_int_equal(put(p, unit), ST_OK);
		expect_unit(p, unit);
	}
	assert_int_equal(bytes[5], 3 * 7 + 5);
	part_close(p);
	p = open_part(path);
	assert_int_equal(part_count(p), UNITS);
	for (size_t unit = 0; unit < UNITS; unit++)
		expect_unit(p, unit);
	part_remove(p);
	assert_int_equal(access(path, F_OK), -1);
	part_close(NULL);
	part_remove(NULL);
}

static void test_key(void **state)
{
	(void)state;
	struct report_store said;
	struct part *p;
	static const struct {
		const char *key;
		size_t units;
	} rows[] = { { "worker=probe\ninput=1235\n", UNITS },
		     { "worker=prob", UNITS },
		     { "worker=probe\ninput=1234\n\n", UNITS },
		     { "", UNITS },
		     { key, UNITS + 1 },
		     { key, 0 } };
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		fill(path);
		report_store_init(&said);
		assert_int_equal(part_open(&p, path, rows[i].key, rows[i].units, &said.report),
		                 ST_OK);
		assert_int_equal(part_count(p), 0);
		assert_non_null(strstr(said.warning, "is of other work"));
		part_close(p);
		unlink(path);
	}
}

static void test_no_part_file(void **state)
{
	(void)state;
	struct report_store said;
	struct part *p;
	static const char *const texts[] = { "x", "BATTENPX and more", "batten base 1\n" };
	for (size_t i = 0; i < 3; i++) {
		FILE *f = fopen(path, "w");
		fputs(texts[i], f);
		fclose(f);
		report_store_init(&said);
		assert_int_equal(part_open(&p, path, key, UNITS, &said.report), ST_INPUT);
		assert_non_null(strstr(said.error, "is no part file"));
		assert_int_equal(size_of(path), (off_t)strlen(texts[i]));
		part_discard(path);
		assert_int_equal(size_of(path), (off_t)strlen(texts[i]));
	}
	report_store_init(&said);
	assert_int_equal(part_open(&p, "/nowhere/a.part", key, UNITS, &said.report), ST_INPUT);
	assert_non_null(strstr(said.error, "/nowhere/a.part"));
	assert_int_equal(part_open(&p, "/tmp", key, UNITS, NULL), ST_INPUT);
	assert_int_equal(part_open(&p, "/dev/null", key, UNITS, &said.report), ST_INPUT);
	fill(second);
	part_discard(second);
	assert_int_equal(access(second, F_OK), -1);
	part_discard(second);
}

static void test_lock(void **state)
{
	(void)state;
	struct report_store said;
	struct part *p = open_part(path), *other;
	report_store_init(&said);
	assert_int_equal(part_open(&other, path, key, UNITS, &said.report), ST_INPUT);
	assert_non_null(strstr(said.error, "in use by another process"));
	part_discard(path);
	assert_int_equal(access(path, F_OK), 0);
	part_close(p);
	part_close(open_part(path));
}

static char *read_part(const char *at, size_t *n)
{
	FILE *f = fopen(at, "r");
	*n = (size_t)size_of(at);
	char *bytes = malloc(*n);
	assert_int_equal(fread(bytes, 1, *n, f), *n);
	fclose(f);
	return bytes;
}

static void write_part(const char *at, const char *bytes, size_t n)
{
	FILE *f = fopen(at, "w");
	assert_int_equal(fwrite(bytes, 1, n, f), n);
	fclose(f);
}

/* After a power cut a file may have its length and not its bytes. */
static void test_zeros(void **state)
{
	(void)state;
	static const size_t sizes[] = { 0, 3, 8, 4000 };
	for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
		struct part *p;
		for (int discard = 0; discard < 2; discard++) {
			FILE *f = fopen(path, "w");
			assert_non_null(f);
			assert_int_equal(ftruncate(fileno(f), (off_t)sizes[i]), 0);
			fclose(f);
			if (discard) {
				part_discard(path);
				assert_int_equal(access(path, F_OK), -1);
				continue;
			}
			assert_int_equal(part_open(&p, path, key, UNITS, NULL), ST_OK);
			assert_int_equal(part_count(p), 0);
			assert_int_equal(put(p, 3), ST_OK);
			expect_unit(p, 3);
			part_remove(p);
		}
	}
}

/* Cut after every byte: the whole units before the cut are there, the torn one is cut off. */
static void test_cut(void **state)
{
	(void)state;
	const size_t header = 24 + strlen(key) + 8;
	size_t whole, end = header, count = 0;
	fill(second);
	char *good = read_part(second, &whole);
	for (size_t n = 0; n < whole; n++) {
		write_part(path, good, n);
		struct part *p = open_part(path);
		/* units came last first; the next record ends with unit UNITS - 1 - count */
		if (n == end + 32 + 37 * (UNITS - 1 - count)) {
			end = n;
			count++;
		}
		assert_int_equal(part_count(p), count);
		for (size_t unit = UNITS - count; unit < UNITS; unit++)
			expect_unit(p, unit);
		part_close(p);
		assert_int_equal(size_of(path), end);
	}
	assert_int_equal(count, UNITS - 1);
	free(good);
}

/* One byte damaged anywhere: no unit ever comes out wrong, and all can be put again. */
static void test_damage(void **state)
{
	(void)state;
	size_t n;
	fill(second);
	char *good = read_part(second, &n);
	for (size_t at = 8; at < n; at += 3) {
		struct part *p;
		good[at] ^= 0x20;
		write_part(path, good, n);
		good[at] ^= 0x20;
		assert_int_equal(part_open(&p, path, key, UNITS, NULL), ST_OK);
		assert_true(part_count(p) < UNITS);
		for (size_t unit = 0; unit < UNITS; unit++) {
			assert_int_equal(put(p, unit), ST_OK);
			expect_unit(p, unit);
		}
		part_close(p);
		p = open_part(path);
		assert_int_equal(part_count(p), UNITS);
		part_close(p);
	}
	free(good);
}

/* Damage that comes while the file is open is found, too. */
static void test_damage_while_open(void **state)
{
	(void)state;
	struct report_store said;
	const char *bytes;
	size_t n;
	struct part *p = open_part(path);
	put(p, 5);
	int fd = open(path, O_WRONLY);
	assert_int_equal(pwrite(fd, "\377\377", 2, size_of(path) - 2), 2);
	close(fd);
	report_store_init(&said);
	struct text room = { 0 };
	assert_int_equal(part_read(p, 5, &room, &report_none), ST_INPUT);
	text_finish(&room);
	assert_int_equal(part_get(p, 5, &bytes, &n, &said.report), ST_INPUT);
	assert_non_null(strstr(said.error, "damaged"));
	part_close(p);
}

static void test_merge(void **state)
{
	(void)state;
	struct report_store said;
	struct part *p = open_part(second), *into;
	for (size_t unit = 0; unit < UNITS; unit += 2)
		put(p, unit);
	into = open_part(path);
	report_store_init(&said);
	assert_int_equal(part_merge(into, second, &said.report), ST_INPUT); /* still in use */
	part_close(p);
	off_t before = size_of(second);
	put(into, 3);
	put(into, 4);
	assert_int_equal(part_merge(into, second, NULL), ST_OK);
	assert_int_equal(part_count(into), UNITS / 2 + 1);
	assert_int_equal(size_of(second), before);
	for (size_t unit = 0; unit < UNITS; unit++)
		if (part_has(into, unit))
			expect_unit(into, unit);
	assert_int_equal(part_merge(into, "/nowhere/x.part", &said.report), ST_INPUT);
	unlink(second);
	assert_int_equal(part_open(&p, second, "other", UNITS, NULL), ST_OK);
	part_close(p);
	assert_int_equal(part_merge(into, second, &said.report), ST_INPUT);
	assert_non_null(strstr(said.error, "is of other work"));
	part_close(into);
}

static enum status put_unit(void *data, size_t unit, int thread)
{
	(void)thread;
	enum status st = put(data, unit);
	if (st == ST_OK)
		expect_unit(data, unit);
	return st;
}

static void test_threads(void **state)
{
	(void)state;
	struct part *p = open_part(path);
	assert_int_equal(parallel_run(4, UNITS, NULL, put_unit, p), ST_OK);
	assert_int_equal(part_count(p), UNITS);
	part_close(p);
	p = open_part(path);
	for (size_t unit = 0; unit < UNITS; unit++)
		expect_unit(p, unit);
	part_close(p);
}

/* A full disk, played by a limit: the failed unit leaves no trace, the others stay. */
static void test_full(void **state)
{
	(void)state;
	pid_t pid = fork();
	assert_true(pid >= 0);
	if (pid == 0) {
		struct part *p;
		struct report_store said;
		struct rlimit limit = { 700, 700 };
		report_store_init(&said);
		signal(SIGXFSZ, SIG_IGN);
		setrlimit(RLIMIT_FSIZE, &limit);
		bool ok = part_open(&p, path, key, UNITS, &said.report) == ST_OK;
		ok = ok && put(p, 2) == ST_OK && put(p, 3) == ST_OK;
		char bytes[37 * UNITS];
		size_t n = unit_bytes(11, bytes);
		ok = ok && part_put(p, 11, bytes, n, &said.report) != ST_OK;
		ok = ok && strstr(said.error, path) && !part_has(p, 11) && put(p, 1) == ST_OK;
		_exit(ok ? 0 : 1);
	}
	int status;
	assert_int_equal(waitpid(pid, &status, 0), pid);
	assert_true(WIFEXITED(status));
	assert_int_equal(WEXITSTATUS(status), 0);
	struct part *p = open_part(path);
	assert_int_equal(part_count(p), 3);
	expect_unit(p, 1);
	expect_unit(p, 2);
	expect_unit(p, 3);
	part_close(p);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test_setup_teardown(test_there_and_back, enter, leave),
		cmocka_unit_test_setup_teardown(test_key, enter, leave),
		cmocka_unit_test_setup_teardown(test_no_part_file, enter, leave),
		cmocka_unit_test_setup_teardown(test_lock, enter, leave),
		cmocka_unit_test_setup_teardown(test_zeros, enter, leave),
		cmocka_unit_test_setup_teardown(test_cut, enter, leave),
		cmocka_unit_test_setup_teardown(test_damage, enter, leave),
		cmocka_unit_test_setup_teardown(test_damage_while_open, enter, leave),
		cmocka_unit_test_setup_teardown(test_merge, enter, leave),
		cmocka_unit_test_setup_teardown(test_threads, enter, leave),
		cmocka_unit_test_setup_teardown(test_full, enter, leave),
	};
	return cmocka_run_group_tests_name("part", tests, NULL, NULL);
}
