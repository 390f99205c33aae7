/* work_order.c - a worker, its parameters and inputs, as jobs for the service. */
#include "work_order.h"

#include <limits.h>
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "json.h"
#include "path.h"
#include "settings.h"

enum { PACKET_ROOM = 48 * 1024 }; /* bytes of jobs in one SUBMIT */

static enum status check_worker(struct work_order *o, const struct project *p,
                                const struct report *r)
{
	enum status st = roster_read(&o->roster, p, o->worker, r);
	const char *key;
	json_t *value;

	if (st != ST_OK)
		return st;
	o->found = roster_find(&o->roster, o->worker);
	if (!o->found)
		return report_error(r, ST_PARAMETER,
		                    "there is no worker '%s'; batten workers lists them",
		                    o->worker);
	if (o->found->broken)
		return report_error(r, ST_INPUT, "worker '%s' cannot be used: %s", o->worker,
		                    o->found->broken);
	json_object_foreach(o->parameters, key, value) if (st == ST_OK) st =
	        roster_check(o->found, key, json_string_value(value), r);
	return st;
}

/* Where it is to run; the setting counts where nothing is said. */
static enum status check_place(struct work_order *o, const struct project *p,
                               const struct report *r)
{
	struct settings settings = { 0 };

	if (o->on && strcmp(o->on, "local") && strcmp(o->on, "slurm"))
		return report_error(r, ST_PARAMETER, "--on is '%s'; it must be local or slurm",
		                    o->on);
	if (o->shards > 1 && !json_flag(o->found->description, "shards", false))
		return report_error(r, ST_PARAMETER,
		                    "--shards: worker %s does its work as a whole; leave it out",
		                    o->worker);
	enum status st = settings_read(&settings, p, r);
	if (st != ST_OK)
		return st;
	o->place = strdup(o->on ? o->on : settings.value[SETTING_LAUNCHER]);
	settings_finish(&settings);
	return o->place ? ST_OK : report_error(r, ST_RESOURCE, "memory ran out");
}

enum status work_text_check(const char *what, const char *text, const struct report *r)
{
	if (!text || text_is_utf8(text))
		return ST_OK;
	return report_error(
	        r, ST_PARAMETER,
	        "%s '%s' is not UTF-8, and no record of a job can hold it; give another", what,
	        text);
}

static enum status check_texts(const struct work_order *o, const struct report *r)
{
	const struct {
		const char *what, *text;
	} rows[] = {
		{ "the worker", o->worker },     { "-o", o->output },
		{ "the folder", o->folder },     { "--group", o->group },
		{ "--partition", o->partition }, { "--account", o->account },
		{ "--time", o->time },
	};
	enum status st = ST_OK;

	for (size_t k = 0; k < sizeof rows / sizeof *rows && st == ST_OK; k++)
		st = work_text_check(rows[k].what, rows[k].text, r);
	return st;
}

enum status work_order_check(struct work_order *o, const struct project *p, const struct report *r)
{
	enum status st = project_check(p, r);

	if (st == ST_OK)
		st = check_texts(o, r);
	if (st == ST_OK)
		st = check_worker(o, p, r);
	return st == ST_OK ? check_place(o, p, r) : st;
}

void work_order_finish(struct work_order *o)
{
	roster_finish(&o->roster);
	free(o->place);
	o->found = NULL;
	o->place = NULL;
}

/* Extension of the worker's own output, ".map.exr". */
static const char *own_extension(const struct work_order *o)
{
	const json_t *outputs = json_object_get(o->found->description, "outputs");

	return json_text(json_array_get(outputs, 0), "extension", "");
}

/* Basic name of the results, absolute: as said or the input's name, with the entity's number. */
static char *output_name(const struct work_order *o, const struct work_input *in, bool numbered)
{
	const char *extension = own_extension(o);
	char *name = o->output ? strdup(o->output) : path_basic_name(in->file_name);

	if (name && o->output && *extension && path_has_suffix(name, extension) &&
	    strlen(name) > strlen(extension))
		name[strlen(name) - strlen(extension)] = 0;
	char *full = name ? path_absolute(name, o->folder) : NULL;
	free(name);
	if (full && numbered) {
		char *with = text_print("%s-%lld", full, (long long)in->number);
		free(full);
		full = with;
	}
	return full;
}

/* Before the job waits for hours: is there a name, and is it one that a file can have? */
static enum status check_output(const struct work_order *o, const char *output,
                                const struct report *r)
{
	const char *said = o->output ? path_file_name(o->output) : "results";

	if (!*said || !strcmp(said, ".") || !strcmp(said, ".."))
		return report_error(r, ST_PARAMETER, "-o '%s' names no file; give a basic name",
		                    o->output);
	enum status st = work_text_check("the result", output, r);
	if (st != ST_OK)
		return st;
	const size_t n = strlen(path_file_name(output)) + strlen(own_extension(o));
	if (n > NAME_MAX)
		return report_error(r, ST_PARAMETER,
		                    "the result of '%s' would have a name of %zu bytes, %d are "
		                    "the most; give a shorter one with -o",
		                    output, n, NAME_MAX);
	return ST_OK;
}

/* The job over inputs first .. first + n - 1. New reference. */
static json_t *make_job(const struct work_order *o, const char *group, size_t first, size_t n,
                        const char *output)
{
	const struct work_input *in = &o->inputs[first];
	json_t *job = json_object(), *inputs = json_array();

	for (size_t k = first; k < first + n; k++)
		json_array_append_new(inputs,
		                      json_pack("{s:s, s:n}", "path", o->inputs[k].path, "entity"));
	json_set_text(job, "worker", o->worker);
	json_set_text(job, "file_name", in->file_name);
	json_set_text(job, "path_name", in->path_name);
	json_set_text(job, "group", group);
	json_set_text(job, "output", output);
	json_set_int(job, "priority", o->priority);
	json_set_int(job, "threads", o->threads);
	json_set_int(job, "memory_mib", o->memory_mib);
	json_set_text(job, "on", o->place);
	json_set_int(job, "shards", o->shards ? o->shards : 1);
	json_set_int(job, "umask", file_mask());
	json_set_text(job, "partition", o->partition);
	json_set_text(job, "account", o->account);
	json_set_text(job, "time", o->time);
	json_object_set_new(job, "inputs", inputs);
	if (o->parameters)
		json_object_set(job, "parameters", o->parameters);
	if (o->after)
		json_object_set(job, "after", o->after);
	if (o->after_any)
		json_object_set(job, "after_any", o->after_any);
	if (o->wall_s > 0)
		json_object_set_new(job, "wall_limit_s", json_real(o->wall_s));
	json_object_set_new(job, "force", json_boolean(o->force));
	return job;
}

/* Results of files of one name in different folders would overwrite each other. */
static enum status check_names(const struct work_order *o, size_t each, const struct report *r)
{
	for (size_t a = 0; a < o->n_inputs && each < o->n_inputs; a++)
		for (size_t b = 0; b < a; b++)
			if (strcmp(o->inputs[a].path_name, o->inputs[b].path_name) &&
			    !strcmp(o->inputs[a].file_name, o->inputs[b].file_name))
				return report_error(
				        r, ST_PARAMETER,
				        "results of '%s' and '%s' would have the same names; submit "
				        "them one by one with -o",
				        o->inputs[b].path_name, o->inputs[a].path_name);
	return ST_OK;
}

/* Jobs on their way: as many as one packet holds. */
struct batch_out {
	struct client *client;
	json_t *jobs;
	size_t bytes;
	client_job *on_job;
	void *data;
};

static enum status batch_send(struct batch_out *b, const struct report *r)
{
	json_t *body = json_pack("{s:o}", "jobs", b->jobs);

	b->jobs = json_array();
	b->bytes = 0;
	if (!body)
		return report_error(r, ST_RESOURCE, "memory ran out");
	return client_request(b->client, MESSAGE_SUBMIT, body, b->on_job, NULL, b->data, r);
}

static enum status batch_add(struct batch_out *b, json_t *job, const struct report *r)
{
	char *text = job ? json_write(job, false) : NULL;
	const size_t size = text ? strlen(text) : 0;
	enum status st = ST_OK;

	free(text);
	if (b->bytes + size > PACKET_ROOM && json_array_size(b->jobs))
		st = batch_send(b, r);
	json_array_append_new(b->jobs, job);
	b->bytes += size;
	return st;
}

enum status work_order_send(const struct work_order *o, struct client *c, client_job *on_job,
                            void *data, const struct report *r)
{
	const bool scene = json_flag(o->found->description, "scene", false);
	const size_t each = scene ? o->n_inputs : 1;
	struct batch_out b = { c, json_array(), 0, on_job, data };
	char *own = NULL;
	enum status st = check_names(o, each, r);

	if (!o->group && each < o->n_inputs) {
		char *base = path_basic_name(o->inputs[0].file_name);
		own = base ? text_print("%s-%s", base, o->worker) : NULL;
		free(base);
	}
	for (size_t k = 0; k < o->n_inputs && st == ST_OK; k++)
		st = work_text_check("the input", o->inputs[k].path_name, r);
	for (size_t k = 0; k < o->n_inputs && st == ST_OK; k += each) {
		const bool numbered = each < o->n_inputs && (o->output || !o->inputs[k].alone);
		char *output = output_name(o, &o->inputs[k], numbered);
		st = output ? check_output(o, output, r) : ST_RESOURCE;
		if (st == ST_OK)
			st = batch_add(&b, make_job(o, o->group ? o->group : own, k, each, output),
			               r);
		free(output);
	}
	if (st == ST_OK)
		st = batch_send(&b, r);
	json_decref(b.jobs);
	free(own);
	return st;
}
