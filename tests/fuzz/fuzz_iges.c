/* fuzz_iges.c - libFuzzer target: any bytes are read or refused, the same from memory and from the disk;
 * what is read can be written and read again. */
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base.h"
#include "iges.h"
#include "iges_bytes.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n);

static int shapes(const struct model *m)
{
	int k = 0;
	for (int i = 0; i < m->n; i++)
		k += m->entities[i].kind == ENTITY_CURVE || m->entities[i].kind == ENTITY_SURFACE;
	return k;
}

/* Blank lines before files of an odd size, so that blocks meet in their middle. */
static size_t blank_lines(const char *bytes, size_t n)
{
	size_t half = n / 2 < BYTES_BLOCK / 2 ? BYTES_BLOCK / 2 - n / 2 : 0;
	return n % 2 && memchr(bytes, '\n', n) ? half : 0;
}

static void all_that_is_read(const struct model *m, struct text *t)
{
	base_format(m, t);
	for (int i = 0; i < m->n_skipped; i++)
		text_addf(t, "skipped %d %d %d %s\n", m->skipped[i].type, m->skipped[i].count,
		          m->skipped[i].first_de, m->skipped[i].reason);
	for (int i = 0; i < m->n_warnings; i++)
		text_addf(t, "warning %s\n", m->warnings[i]);
}

static enum status read_from_disk(struct model *m, const char *bytes, size_t n,
                                  const struct report *r)
{
	int fd = memfd_create("file", MFD_CLOEXEC);
	if (fd < 0 || write(fd, bytes, n) != (ssize_t)n)
		abort();
	enum status st = iges_read(m, fd, n, "fuzz", NULL, r);
	close(fd);
	return st;
}

static void write_and_read_again(const struct model *m)
{
	struct model again;
	struct text t = { 0 };
	iges_format(m, &t);
	model_init(&again);
	if (!t.failed)
		iges_parse(&again, t.s, t.n, "again", NULL, NULL);
	model_finish(&again);
	text_finish(&t);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	struct model memory, disk;
	struct report_store said, said_of_disk;
	struct text a = { 0 }, b = { 0 };
	size_t blank = blank_lines((const char *)data, n);
	char *bytes = malloc(blank + n + 1);
	if (!bytes)
		abort();
	memset(bytes, '\n', blank);
	if (n)
		memcpy(bytes + blank, data, n);
	report_store_init(&said);
	report_store_init(&said_of_disk);
	model_init(&memory);
	model_init(&disk);
	enum status st = iges_parse(&memory, bytes, blank + n, "fuzz", NULL, &said.report);
	if (read_from_disk(&disk, bytes, blank + n, &said_of_disk.report) != st ||
	    strcmp(said.error, said_of_disk.error) != 0 || (st == ST_OK) != !*said.error)
		abort();
	all_that_is_read(&memory, &a);
	all_that_is_read(&disk, &b);
	if (a.n != b.n || memcmp(a.s, b.s, a.n) != 0)
		abort();
	if (st == ST_OK && shapes(&memory))
		write_and_read_again(&memory);
	text_finish(&a);
	text_finish(&b);
	model_finish(&memory);
	model_finish(&disk);
	free(bytes);
	return 0;
}
