/* batch.c - the jobs of one SUBMIT. */
#include "batch.h"

#include <stdlib.h>
#include <sys/stat.h>

#include "file.h"

enum { JOBS_FILE_MAX = 256 << 20 };

static enum status batch_add(struct batch *b, const json_t *o, const struct report *r)
{
	if (b->n == b->cap) {
		int cap = b->cap ? 2 * b->cap : 16;
		struct Stats *p = realloc(b->jobs, (size_t)cap * sizeof *p);
		if (!p)
			return report_error(r, ST_RESOURCE, "cannot submit: out of memory");
		b->jobs = p;
		b->cap = cap;
	}
	enum status st = stats_from_json(&b->jobs[b->n], o);
	if (st != ST_OK)
		return report_error(r, st == ST_INPUT ? ST_PARAMETER : st,
		                    "cannot submit job %d of the request: %s", b->n + 1,
		                    st == ST_INPUT ? "it is no job" : "out of memory");
	b->n++;
	return ST_OK;
}

static enum status batch_add_file(struct batch *b, const char *path, const struct report *r)
{
	char *text;
	size_t n;
	struct stat s;
	/* the loop must not wait for what is no file */
	if (!stat(path, &s) && !S_ISREG(s.st_mode))
		return report_error(r, ST_INPUT, "cannot read jobs from '%s': it is no file", path);
	enum status st = file_read(path, JOBS_FILE_MAX, &text, &n, r);
	if (st != ST_OK)
		return st;
	json_t *o = json_loadb(text, n, 0, NULL);
	free(text);
	if (json_is_array(o))
		for (size_t i = 0; i < json_array_size(o) && st == ST_OK; i++)
			st = batch_add(b, json_array_get(o, i), r);
	else if (o)
		st = batch_add(b, o, r);
	else
		st = report_error(r, ST_INPUT, "cannot read jobs from '%s': it is no JSON", path);
	json_decref(o);
	return st;
}

enum status batch_read(struct batch *b, const json_t *jobs, const struct report *r)
{
	enum status st = ST_OK;
	for (size_t i = 0; i < json_array_size(jobs) && st == ST_OK; i++) {
		const json_t *o = json_array_get(jobs, i);
		st = json_is_string(o) ? batch_add_file(b, json_string_value(o), r)
		                       : batch_add(b, o, r);
	}
	return st;
}

void batch_finish(struct batch *b)
{
	for (int i = 0; i < b->n; i++)
		stats_finish(&b->jobs[i]);
	free(b->jobs);
}
