/* test_iges_disk.c - IGES files read from the disk as they are needed: blocks, damage, files that change
 * while they are read, what is no plain file. */
#include <errno.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "iges_bytes.h"
#include "iges_made.h"
#include "survive.h"

/* Bytes read from a file as they are needed give what they give in memory. */
static void assert_same_from_disk(const char *bytes, size_t n, enum status st,
                                  const struct model *m)
{
	FILE *f = tmpfile();
	struct model again;

	assert_non_null(f);
	assert_int_equal(fwrite(bytes, 1, n, f), n);
	assert_int_equal(fflush(f), 0);
	model_init(&again);
	assert_int_equal(iges_read(&again, fileno(f), n, "x.igs", NULL, NULL), st);
	if (st == ST_OK) {
		struct text a = { 0 }, b = { 0 };

		assert_int_equal(again.n, m->n);
		assert_int_equal(again.n_skipped, m->n_skipped);
		iges_format(m, &a);
		iges_format(&again, &b);
		assert_int_equal(a.n, b.n);
		assert_memory_equal(a.s, b.s, a.n);
		text_finish(&a);
		text_finish(&b);
	}
	model_finish(&again);
	fclose(f);
}

/* An IGES file of n lines in space, larger than all blocks together. */
static void make_lines(struct text *t, int n)
{
	struct model m;
	model_init(&m);
	for (int i = 0; i < n; i++) {
		struct entity e;

		entity_init(&e, ENTITY_CURVE);
		assert_int_equal(curve_init(&e.curve, 2, 2), ST_OK);
		e.curve.knots[2] = e.curve.knots[3] = 1;
		curve_set_point(&e.curve, 0, vec3(i, 0.1 * i, 0), 1);
		curve_set_point(&e.curve, 1, vec3(0, 1.0 / (i + 1), i), 1);
		assert_int_equal(curve_check(&e.curve, "line", NULL), ST_OK);
		assert_int_equal(model_add(&m, &e), ST_OK);
	}
	iges_format(&m, t);
	model_finish(&m);
	assert_false(t->failed);
	assert_true(t->n > 8 * BYTES_BLOCK);
}

enum { LINES = 6000 };

/* Behind the first line another one, with a megabyte of rubbish behind it. */
static void add_rubbish(struct text *t, const char *line, size_t n)
{
	text_add_bytes(t, line, n - 1);
	for (int i = 0; i < 1 << 17; i++)
		text_add(t, "   rest ");
	text_add(t, "\n");
}

/* Lines of the parameters as some programs write them: no blanks before the letter's columns are lost, but
 * the numbers behind it. */
static void add_uneven(struct text *t, const char *line, size_t n)
{
	text_add_bytes(t, line, line[72] == 'P' && n % 3 != (size_t)line[5] % 3 ? 73 : n - 1);
	text_add(t, "\n");
}

/* Lines and entities that lie across the blocks a file is read in; a line longer than any block; lines that
 * are not all of one length. */
static void large_files_are_read_in_blocks(void **state)
{
	enum { PLAIN, LONGER, UNEVEN, N_WAYS };
	struct text t = { 0 }, plain = { 0 };

	(void)state;
	make_lines(&t, LINES);
	for (int way = PLAIN; way < N_WAYS; way++) {
		struct text all = { 0 }, again = { 0 };
		struct model m;
		size_t lines = 0;

		for (const char *s = t.s, *next; *s; s = next, lines++) {
			next = strchr(s, '\n') + 1;
			if (way == UNEVEN)
				add_uneven(&all, s, (size_t)(next - s));
			else
				text_add_bytes(&all, s, (size_t)(next - s));
			if (way == LONGER && lines == 0)
				add_rubbish(&all, s, (size_t)(next - s));
		}
		model_init(&m);
		enum status st = iges_parse(&m, all.s, all.n, "x.igs", NULL, NULL);
		assert_int_equal(st, ST_OK);
		assert_int_equal(m.n, LINES);
		assert_same_from_disk(all.s, all.n, st, &m);
		iges_format(&m, way == PLAIN ? &plain : &again);
		if (way != PLAIN) {
			assert_int_equal(again.n, plain.n);
			assert_memory_equal(again.s, plain.s, plain.n);
		}
		model_finish(&m);
		text_finish(&all);
		text_finish(&again);
	}
	text_finish(&plain);
	text_finish(&t);
}

/* What happens to a file while it is read. */
struct change {
	const char *path;
	off_t size; /* it gets, from the step on that comes after that many */
	int steps;
};

static void change_file(void *data, double fraction)
{
	struct change *c = data;
	(void)fraction;
	if (c->steps-- == 0)
		assert_int_equal(truncate(c->path, c->size), 0);
}

static void temporary_file(char path[], const char *bytes, size_t n)
{
	int fd = mkstemp(path);
	assert_true(fd >= 0);
	assert_int_equal(write(fd, bytes, n), n);
	assert_int_equal(close(fd), 0);
}

static void files_that_change_are_refused(void **state)
{
	static const struct {
		double size; /* times the one before */
		int steps;
		const char *said;
	} rows[] = {
		{ 0.5, 0, "cut short" },
		{ 0.5, 4, "cut short while it was read" },
		{ 0, 8, "cut short while it was read" },
		{ 1.5, 0, "written to meanwhile" },
		{ 2, 4, "written to meanwhile" },
	};
	struct text t = { 0 };
	(void)state;
	make_lines(&t, 70000);
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		char path[] = "/tmp/batten-disk-XXXXXX";
		struct model m;
		struct report_store store;
		temporary_file(path, t.s, t.n);
		struct change change = { path, (off_t)(rows[i].size * (double)t.n), rows[i].steps };
		const struct progress p = { .step = change_file, .data = &change };
		report_store_init(&store);
		assert_int_equal(model_read(&m, path, &p, &store.report), ST_INPUT);
		assert_true(change.steps < 0);
		assert_int_equal(store.n_errors, 1);
		if (!strstr(store.error, rows[i].said))
			fail_msg("row %zu: %s", i, store.error);
		unlink(path);
	}
	text_finish(&t);
}

/* What stands before the lines of zeros that a file with a hole reads as. */
static void sizes_and_kinds_of_files(void **state)
{
	static const struct {
		const char *bytes; /* NULL: a whole file */
		double size;       /* bytes that the file is drawn to, 0: as they are */
		const char *said;  /* NULL: it is read */
	} rows[] = {
		{ "", 0, "the file is empty" },
		{ "start                                                                   S      1\n",
		  0, "it is cut short" },
		{ "", 5e9, "neither a batten base file" },
		{ "200 1 0 0\n3 0\n2 2\n0 0", 0, "found the end" },
		{ NULL, 0, NULL },
		{ NULL, 5e9, NULL }, /* nothing behind the last line counts */
	};
	const struct made_file f = { 0 };
	struct text t = { 0 };
	(void)state;
	make_iges(&t, &f, standard, 7);
	for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
		char path[] = "/tmp/batten-disk-XXXXXX";
		struct model m;
		struct report_store store;
		const char *bytes = rows[i].bytes ? rows[i].bytes : t.s;
		temporary_file(path, bytes, strlen(bytes));
		if (rows[i].size > 0)
			assert_int_equal(truncate(path, (off_t)rows[i].size), 0);
		report_store_init(&store);
		enum status st = model_read(&m, path, NULL, &store.report);
		unlink(path);
		if (!rows[i].said) {
			assert_int_equal(st, ST_OK);
			assert_standard(&m, "drawn out");
			model_finish(&m);
			continue;
		}
		assert_int_equal(st, ST_INPUT);
		assert_int_equal(store.n_errors, 1);
		if (!strstr(store.error, rows[i].said))
			fail_msg("row %zu: %s", i, store.error);
	}
	text_finish(&t);
}

/* From a pipe with a name, as another program writes it. */
static void pipes_are_read(void **state)
{
	char folder[] = "/tmp/batten-disk-XXXXXX", path[64];
	const struct made_file f = { 0 };
	struct text t = { 0 };
	struct model m;
	struct report_store store;
	int ended;
	(void)state;
	make_iges(&t, &f, standard, 7);
	assert_non_null(mkdtemp(folder));
	snprintf(path, sizeof path, "%s/pipe", folder);
	assert_int_equal(mkfifo(path, 0600), 0);
	pid_t writer = fork();
	assert_true(writer >= 0);
	if (writer == 0) {
		FILE *out = fopen(path, "w");
		_exit(!out || fwrite(t.s, 1, t.n, out) != t.n || fclose(out) != 0);
	}
	report_store_init(&store);
	assert_int_equal(model_read(&m, path, NULL, &store.report), ST_OK);
	assert_standard(&m, "pipe");
	model_finish(&m);
	assert_int_equal(waitpid(writer, &ended, 0), writer);
	assert_int_equal(ended, 0);
	unlink(path);
	assert_int_equal(model_read(&m, folder, NULL, &store.report), ST_INPUT);
	assert_non_null(strstr(store.error, strerror(EISDIR)));
	assert_int_equal(model_read(&m, "/dev/zero", NULL, &store.report), ST_INPUT);
	assert_non_null(strstr(store.error, "neither a batten base file"));
	rmdir(folder);
	text_finish(&t);
}

/* From memory as from a disk. */
static enum status read_damaged(struct model *m, const char *bytes, size_t n,
                                const struct report *r)
{
	if (!iges_recognise(bytes, n))
		return report_error(r, ST_INPUT, "'x.igs' is no longer an IGES file");
	const enum status st = iges_parse(m, bytes, n, "x.igs", NULL, r);
	assert_same_from_disk(bytes, n, st, m);
	return st;
}

static void damaged_files_are_survived(void **state)
{
	struct text t = { 0 };
	const struct made_file f = { 0 };
	const struct made_entity more[] = {
		standard[0],
		standard[1],
		standard[2],
		standard[3],
		standard[4],
		standard[5],
		standard[6],
		{ 102, 0, "102,2,17,19;" },
		{ 110, 0, "110,0.,0.,0.,1.,0.,0.;" },
		{ 100, 0, "100,0.,1.,1.,1.,0.,2.,1.;" },
		{ 120, 0, "120,17,19,0.,1.5;" },
		{ 118, 1, "118,17,19,0,0;" },
		{ 144, 0, "144,5,1,0,27;" },
		{ 142, 0, "142,0,5,17,19,2;" },
		{ 108, 0, "108,0.,0.,1.,0.,0;" },
		{ 143, 0, "143,0,29,1,33;" },
		{ 141, 0, "141,0,0,29,2,17,1,0,19,1,0;" },
		{ 112, 0, "112,3,2,3,1,0.,1.,0.,1.,0.,0.,0.,0.,1.,0.,2.,0.,0.,0.,0.,0.,0.,0.;" },
		{ 140, 0, "140,0.,0.,1.,.1,5;" },
		{ 510, 0, "510,5,1,1,41;" },
		{ 508, 0, "508,1,0,43,1,1,1,0,47;" },
		{ 504, 0, "504,1,47,0,0,0,0;" },
		{ 514, 0, "514,1,39,1;", 3 },
		{ 100, 0, DISK },
		{ 308, 0, "308,0,1Ha,2,5,45;" },
		{ 408, 0, "408,49,1.,2.,3.,2.;", 3 },
	};
	(void)state;
	make_iges(&t, &f, more, sizeof more / sizeof more[0]);
	survive(read_damaged, t.s, t.n, 11, 400, 50, 20);
	text_finish(&t);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(large_files_are_read_in_blocks),
		cmocka_unit_test(files_that_change_are_refused),
		cmocka_unit_test(sizes_and_kinds_of_files),
		cmocka_unit_test(pipes_are_read),
		cmocka_unit_test(damaged_files_are_survived),
	};
	return cmocka_run_group_tests(tests, NULL, NULL);
}
