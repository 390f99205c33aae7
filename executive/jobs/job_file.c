/* job_file.c - what START names: all that a worker must know of its job. */
#include "job_file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "json.h"
#include "shard.h"

enum { JOB_FILE_VERSION = 1 };

static json_t *inputs_json(const struct Stats *s)
{
	json_t *a = json_array();
	for (int i = 0; i < s->n_inputs; i++) {
		json_t *o = json_object();
		json_set_text(o, "path", s->inputs[i].path);
		json_set_text(o, "entity", s->inputs[i].entity);
		json_array_append_new(a, o);
	}
	return a;
}

/* A shard does some units; the job itself, where it is cut, joins what they did. */
static json_t *shard_json(const struct Stats *s)
{
	int shard = shard_of(s->id);
	return shard < 0 ? json_null() : json_pack("[i, i]", shard, s->shards);
}

static json_t *parts_json(const struct project *p, const struct Stats *s)
{
	if (s->shards < 2 || shard_of(s->id) >= 0)
		return json_null();
	json_t *a = json_array();
	for (int i = 0; i < s->shards; i++) {
		char *path = shard_path(p, "parts", shard_id(s->id, i), ".part");
		json_array_append_new(a, path ? json_string(path) : NULL);
		free(path);
	}
	return a;
}

static char *job_text(const struct project *p, const struct Stats *s)
{
	char *part = shard_path(p, "parts", s->id, ".part");
	json_t *o = json_object();
	json_set_int(o, "version", JOB_FILE_VERSION);
	json_set_int(o, "id", shard_job(s->id));
	json_set_text(o, "worker", s->worker);
	json_object_set_new(o, "inputs", inputs_json(s));
	json_object_set_new(o, "parameters",
	                    s->parameters ? json_deep_copy(s->parameters) : json_object());
	json_set_text(o, "output", s->output);
	json_set_text(o, "part", part);
	json_object_set_new(o, "threads", s->threads ? json_integer(s->threads) : json_null());
	json_object_set_new(o, "memory", s->memory_mib ? json_integer(s->memory_mib) : json_null());
	json_object_set_new(o, "shard", shard_json(s));
	json_object_set_new(o, "parts", parts_json(p, s));
	json_object_set_new(o, "force", json_boolean(s->force));
	char *text = part && o ? json_write(o, true) : NULL;
	json_decref(o);
	free(part);
	return text;
}

enum status job_file_write(const char *path, const struct project *p, const struct Stats *s,
                           const struct report *r)
{
	char *text = job_text(p, s);
	if (!text)
		return report_error(r, ST_RESOURCE, "cannot write '%s': out of memory", path);
	enum status st = ST_OK;
	size_t n = strlen(text);
	int fd = open(path, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
	if (fd >= 0)
		errno = ENOSPC; /* a short write does not say why */
	if (fd < 0 || write(fd, text, n) != (ssize_t)n)
		st = report_error(r, ST_RESOURCE, "cannot write the job file '%s': %s", path,
		                  strerror(errno));
	if (fd >= 0)
		close(fd);
	free(text);
	return st;
}
