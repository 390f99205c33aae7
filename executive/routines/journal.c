/* journal.c - what was done, in the language of scripts, so that it can be done again. */
#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "file.h"
#include "path.h"
#include "private.h"
#include "text.h"

enum { WAIT_ROOM = 4 }; /* for "killed" in the place of "yes" or "no" */

static bool needs_quotes(const char *value)
{
	return !*value || *value == '"' || strpbrk(value, " \t\r\n");
}

static void add_value(struct text *t, const char *value)
{
	if (!needs_quotes(value)) {
		text_add(t, value);
		return;
	}
	text_add(t, "\"");
	for (; *value; value++) {
		if (*value == '"' || *value == '\\')
			text_add(t, "\\");
		text_add_bytes(t, *value == '\n' ? " " : value, 1); /* a line is a line */
	}
	text_add(t, "\"");
}

/* One write, so that lines of several processes do not mix. */
static enum status append(const char *path, const struct text *t, const struct report *r)
{
	const int fd = open(path, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
	ssize_t n = fd < 0 ? -1 : write(fd, t->s, t->n);

	enum status st = n == (ssize_t)t->n
	                         ? ST_OK
	                         : report_error(r, status_from_errno(n < 0 ? errno : ENOSPC),
	                                        "cannot write the journal '%s': %s", path,
	                                        strerror(n < 0 ? errno : ENOSPC));
	if (fd >= 0)
		close(fd);
	return st;
}

/* Behind the line, each with room for the sign of its end. */
static void add_jobs(struct text *line, const struct act *a)
{
	if (!a->n_jobs || a->wait)
		return;
	text_addf(line, "%*s# job", WAIT_ROOM, "");
	for (int k = 0; k < a->n_jobs; k++)
		text_addf(line, " %lld ", (long long)a->jobs[k]);
}

static enum status write_line(const struct act *a, const struct routine *t,
                              const struct arguments *given, const char *before)
{
	struct text line = { 0 };
	char *path = path_join(a->project->hidden, "journal");
	enum status st = path ? folder_make(a->project->hidden, 0777, &a->report) : ST_RESOURCE;

	text_addf(&line, "%s%s", before, t->code);
	for (int k = 0; k < given->n; k++) {
		text_addf(&line, " %s=", given->name[k]);
		add_value(&line, given->value[k]);
	}
	add_jobs(&line, a);
	text_add(&line, "\n");
	if (!path || line.failed)
		st = act_memory(a);
	else if (st == ST_OK)
		st = append(path, &line, &a->report);
	text_finish(&line);
	free(path);
	return st;
}

enum status journal_write(const struct act *a, const struct routine *t,
                          const struct arguments *given)
{
	return write_line(a, t, given, "");
}

enum status journal_remark(const struct act *a, const struct routine *t,
                           const struct arguments *given)
{
	return write_line(a, t, given, "# ");
}
