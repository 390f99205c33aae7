/* journal_settle.c - the ends of jobs, said in the lines that started them. */
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "file.h"
#include "number.h"
#include "path.h"
#include "private.h"

enum { JOURNAL_MAX = 64 << 20, ROOM = 6 };
static const char COMES_TO_NOTHING = 'x', GOES_ON = ' ';

static int by_id(const void *a, const void *b)
{
	const struct job_end *x = a, *y = b;

	return (x->id > y->id) - (x->id < y->id);
}

/* A journal in memory, and where it lies. */
struct pages {
	int fd;
	char *bytes;
	bool failed;
};

/* Others append meanwhile; what is there keeps its place. */
static void put(struct pages *p, char *at, const char *what, size_t n)
{
	if (!memcmp(at, what, n))
		return;
	memcpy(at, what, n);
	p->failed |= pwrite(p->fd, what, n, at - p->bytes) != (ssize_t)n;
}

/* Signs behind the jobs of a line; true: none of them came to anything. */
static bool put_signs(struct pages *p, char *at, char *end, const struct job_end *ends, size_t n)
{
	bool nothing = true;

	while (at < end && *at == ' ') {
		const char *number = at + 1;
		struct job_end one = { 0 };
		if (!number_read_integer(&number, end, &one.id) || number >= end)
			break;
		at += number - at;
		const struct job_end *e = bsearch(&one, ends, n, sizeof *ends, by_id);
		if (e)
			put(p, at, e->nothing ? &COMES_TO_NOTHING : &GOES_ON, 1);
		nothing = nothing && *at == COMES_TO_NOTHING;
		at++;
	}
	return nothing;
}

static void settle_line(struct pages *p, char *line, char *end, const struct job_end *ends,
                        size_t n)
{
	static const char mark[] = "# job", wait[] = " wait=";
	char *jobs = memmem(line, (size_t)(end - line), mark, sizeof mark - 1);
	char *value = jobs ? memmem(line, (size_t)(jobs - line), wait, sizeof wait - 1) : NULL;

	if (*line == '#' || !value || jobs - (value + sizeof wait - 1) < ROOM)
		return;
	char before[ROOM], *at = value + sizeof wait - 1;
	memcpy(before, at, ROOM);
	const bool was = !memcmp(before, "killed", ROOM);
	const bool is = put_signs(p, jobs + sizeof mark - 1, end, ends, n);
	if (was != is)
		put(p, at, is ? "killed" : "yes   ", ROOM);
}

enum status journal_settle(const struct project *p, struct job_end *ends, size_t n,
                           const struct report *r)
{
	char *path = path_join(p->hidden, "journal");
	struct pages pages = { .fd = -1 };
	size_t size = 0;
	enum status st = path ? ST_OK : report_error(r, ST_RESOURCE, "memory ran out");

	if (st == ST_OK && n && path_exists(path))
		st = file_read(path, JOURNAL_MAX, &pages.bytes, &size, r);
	if (st == ST_OK && size) {
		qsort(ends, n, sizeof *ends, by_id);
		pages.fd = open(path, O_WRONLY | O_CLOEXEC);
		pages.failed = pages.fd < 0;
		for (char *line = pages.bytes, *end; !pages.failed; line = end + 1) {
			end = memchr(line, '\n', size - (size_t)(line - pages.bytes));
			if (!end)
				break;
			settle_line(&pages, line, end, ends, n);
		}
		if (pages.failed)
			st = report_error(r, status_from_errno(errno),
			                  "cannot write the journal '%s': %s", path,
			                  strerror(errno));
	}
	if (pages.fd >= 0)
		close(pages.fd);
	free(pages.bytes);
	free(path);
	return st;
}
