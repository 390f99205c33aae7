/* worker_job.c - the job file: what START and --job name. Members: docs/packets.md. */
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "json.h"
#include "number.h"
#include "worker_private.h"

enum { JOB_VERSION = 1 };

/* Larger job files are refused. Bytes. */
static const uint64_t job_size_max = 64 << 20;

struct source {
	const char *path;
	const json_t *job;
	const struct report *report;
};

static enum status wrong(const struct source *s, const char *member, const char *expected)
{
	return report_error(s->report, ST_INPUT, "cannot use job file '%s': \"%s\" is not %s",
	                    s->path, member, expected);
}

/* A member, NULL where it is missing or null. */
static const json_t *member(const struct source *s, const char *name)
{
	const json_t *value = json_object_get(s->job, name);
	return json_is_null(value) ? NULL : value;
}

static enum status read_text(const struct source *s, const char *name, char **out)
{
	const json_t *value = member(s, name);
	if (!value)
		return ST_OK;
	if (!json_is_string(value) || !*json_string_value(value))
		return wrong(s, name, "a text or null");
	*out = strdup(json_string_value(value));
	return *out ? ST_OK : ST_RESOURCE;
}

static enum status read_integer(const struct source *s, const char *name, int64_t min, int64_t max,
                                int64_t *out)
{
	const json_t *value = member(s, name);
	if (!value)
		return ST_OK;
	*out = json_integer_value(value);
	if (!json_is_integer(value) || *out < min || *out > max)
		return report_error(s->report, ST_PARAMETER,
		                    "cannot use job file '%s': \"%s\" is not an integer from %lld "
		                    "to %lld",
		                    s->path, name, (long long)min, (long long)max);
	return ST_OK;
}

static enum status read_input(const struct source *s, struct task *t, const json_t *input)
{
	const json_t *entity = json_object_get(input, "entity");
	const char *path = json_text(input, "path", NULL);
	char number[24];
	if (!path || !*path ||
	    (entity && !json_is_null(entity) && !json_is_string(entity) &&
	     !json_is_integer(entity)))
		return wrong(s, "inputs", "a list of {\"path\", \"entity\"}");
	if (!json_is_integer(entity))
		return task_add_input(t, path, json_string_value(entity));
	snprintf(number, sizeof number, "%lld", (long long)json_integer_value(entity));
	return task_add_input(t, path, number);
}

static enum status read_inputs(const struct source *s, struct task *t)
{
	const json_t *list = member(s, "inputs");
	enum status st = ST_OK;
	if (json_array_size(list) == 0)
		return wrong(s, "inputs", "a list of {\"path\", \"entity\"}");
	for (size_t i = 0; st == ST_OK && i < json_array_size(list); i++)
		st = read_input(s, t, json_array_get(list, i));
	return st;
}

static enum status read_parameters(const struct source *s, struct task *t)
{
	json_t *list = json_object_get(s->job, "parameters");
	const char *name;
	json_t *value;
	enum status st = ST_OK;
	if (list && !json_is_null(list) && !json_is_object(list))
		return wrong(s, "parameters", "an object of texts");
	json_object_foreach(list, name, value)
	{
		if (json_is_null(value))
			continue;
		if (!json_is_string(value))
			return wrong(s, "parameters", "an object of texts");
		st = values_set(t, name, json_string_value(value), s->report);
		if (st != ST_OK)
			return st;
	}
	return values_default(t, s->report);
}

static enum status read_parts(const struct source *s, struct task *t)
{
	const json_t *list = member(s, "parts");
	if (!list)
		return ST_OK;
	t->parts = calloc(json_array_size(list) + 1, sizeof *t->parts);
	if (!t->parts)
		return ST_RESOURCE;
	if (!json_is_array(list))
		return wrong(s, "parts", "a list of texts or null");
	for (size_t i = 0; i < json_array_size(list); i++) {
		const char *path = json_string_value(json_array_get(list, i));
		if (!path || !*path)
			return wrong(s, "parts", "a list of texts or null");
		t->parts[i] = strdup(path);
		if (!t->parts[i])
			return ST_RESOURCE;
		t->n_parts++;
	}
	return ST_OK;
}

static enum status read_shard(const struct source *s, struct task *t)
{
	const json_t *pair = member(s, "shard");
	if (!pair)
		return ST_OK;
	const json_t *i = json_array_get(pair, 0), *n = json_array_get(pair, 1);
	if (json_array_size(pair) != 2 || !json_is_integer(i) || !json_is_integer(n) ||
	    json_integer_value(i) < 0 || json_integer_value(i) >= json_integer_value(n))
		return wrong(s, "shard", "[i, n] with 0 <= i < n, or null");
	t->shard = (uint64_t)json_integer_value(i);
	t->n_shards = (uint64_t)json_integer_value(n);
	return ST_OK;
}

static enum status read_members(const struct source *s, struct task *t)
{
	int64_t threads = 0, memory = 0;
	const json_t *force = member(s, "force");
	const char *name = json_text(s->job, "worker", NULL);
	if (json_int(s->job, "version", -1) != JOB_VERSION)
		return report_error(s->report, ST_INPUT,
		                    "cannot use job file '%s': \"version\" is not %d, the one this "
		                    "worker knows",
		                    s->path, JOB_VERSION);
	if (!name || strcmp(name, worker.name) != 0)
		return report_error(s->report, ST_INPUT,
		                    "cannot use job file '%s': it is for worker '%s', this one is "
		                    "'%s'",
		                    s->path, name ? name : "", worker.name);
	if (force && !json_is_boolean(force))
		return wrong(s, "force", "true, false or null");
	t->force = json_is_true(force);
	enum status st = read_inputs(s, t);
	if (st == ST_OK)
		st = read_parameters(s, t);
	if (st == ST_OK)
		st = read_text(s, "output", &t->output);
	if (st == ST_OK)
		st = read_text(s, "part", &t->part);
	if (st == ST_OK)
		st = read_parts(s, t);
	if (st == ST_OK)
		st = read_shard(s, t);
	if (st == ST_OK)
		st = read_integer(s, "threads", 1, THREADS_MAX, &threads);
	if (st == ST_OK)
		st = read_integer(s, "memory", 0, MEMORY_MAX, &memory);
	t->threads = (int)threads;
	t->memory_mib = (size_t)memory;
	return st;
}

enum status job_parse(struct task *t, const char *text, size_t n, const char *path,
                      const struct report *r)
{
	json_t *job = NULL;
	enum status st = task_init(t);
	if (st == ST_OK)
		st = json_parse_object(text, n, path, &job, r);
	if (st == ST_OK)
		st = read_members(&(struct source){ path, job, r }, t);
	json_decref(job);
	if (st != ST_OK)
		task_finish(t);
	return st;
}

enum status job_read(struct task *t, const char *path, const struct report *r)
{
	char *text;
	size_t n;
	enum status st = file_read(path, job_size_max, &text, &n, r);
	if (st != ST_OK)
		return st;
	st = job_parse(t, text, n, path, r);
	free(text);
	return st;
}
