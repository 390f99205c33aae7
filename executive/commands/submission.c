/* submission.c - from the words of `run` and `submit` to jobs the service takes.
 *
 * Each input file is read by a child, `batten import --inputs`, that writes every entity once as
 * .batten/inputs/HASH.base; the jobs name those.
 */
#include "submission.h"

#include <stdlib.h>
#include <string.h>

#include "import_child.h"
#include "json.h"
#include "model.h"
#include "number.h"
#include "path.h"
#include "roster.h"
#include "settings.h"
#include "shard.h"
#include "text.h"

enum { PACKET_ROOM = 48 * 1024 }; /* bytes of jobs in one SUBMIT */

const struct option_row submission_options[] = {
	{ "--output", "-o", "NAME", "basic name of the results, or the whole file name" },
	{ "--after", NULL, "ID",
	  "start when job ID is done, ID:any: however it ends (several: ID,ID)" },
	{ "--group", NULL, "G", "name of the group the jobs belong to" },
	{ "--priority", NULL, "N", "higher starts first (default 0)" },
	{ "--threads", NULL, "N", "threads of each job (default: setting threads)" },
	{ "--memory", NULL, "MIB", "memory of each job (default: setting memory)" },
	{ "--wall", NULL, "S", "seconds each job may run (default: setting wall)" },
	{ "--on", NULL, "WHERE", "local or slurm (default: setting launcher)" },
	{ "--shards", NULL, "N", "cut each job into N processes (up to 1024)" },
	{ "--partition", NULL, "P", "partition of Slurm (default: setting slurm-partition)" },
	{ "--account", NULL, "A", "account of Slurm (default: setting slurm-account)" },
	{ "--time", NULL, "T",
	  "time limit in Slurm, as srun takes it (default: setting slurm-time)" },
	{ "--force", NULL, NULL, "do it again even where the result is up to date" },
	{ 0 },
};

const char submission_help[] =
        "WORKER is one of `batten workers`; its parameters are given as --NAME VALUE and listed by\n"
        "`batten help WORKER`. INPUT is a geometry file, or FILE#ENTITY with an entity's number or name,\n"
        "or D and an IGES Directory Entry number; FILE alone means all its surfaces. Workers that see\n"
        "a scene make one job of all inputs, the others one a surface, as a group.\n"
        "Results are named after the input, in the current folder, or as -o says.";

/* One surface that a job reads. */
struct input {
	char *hash_path; /* owned; .batten/inputs/HASH.base */
	char *name;      /* owned; as the user named the file */
	char *path;      /* owned; absolute */
	int64_t number;
	bool alone; /* the only surface named of its file */
};

struct submission {
	const struct invocation *i;
	struct roster roster;
	const struct roster_worker *worker;
	json_t *parameters;
	struct input *inputs;
	size_t n_inputs;
	json_t *after, *after_any;
	double wall;
	long priority, threads, memory, shards;
	char *on; /* owned */
};

bool submission_takes_value(const struct invocation *i, const char *option)
{
	struct project p;
	struct roster roster = { 0 };
	bool flag = false;

	if (!i->n_words || project_find(&p, NULL, NULL) != ST_OK)
		return true;
	if (roster_read(&roster, &p, i->words[0], NULL) == ST_OK) {
		const struct roster_worker *w = roster_find(&roster, i->words[0]);
		size_t k;
		json_t *row;
		json_array_foreach(w ? json_object_get(w->description, "parameters") : NULL, k,
		                   row) if (!strcmp(json_text(row, "name", ""), option)) flag =
		        !strcmp(json_text(row, "type", ""), "flag");
	}
	roster_finish(&roster);
	project_finish(&p);
	return !flag;
}

static enum status check_worker(struct submission *s, const struct project *p)
{
	const struct report *r = &s->i->report;
	const char *name = s->i->words[0];
	enum status st = roster_read(&s->roster, p, name, r);

	if (st != ST_OK)
		return st;
	s->worker = roster_find(&s->roster, name);
	if (!s->worker)
		return report_error(r, ST_PARAMETER,
		                    "there is no worker '%s'; batten workers lists them", name);
	if (s->worker->broken)
		return report_error(r, ST_INPUT, "worker '%s' cannot be used: %s", name,
		                    s->worker->broken);
	s->parameters = json_object();
	for (int k = 0; k < s->i->n_extra && st == ST_OK; k++) {
		const char *key = s->i->extra[2 * k], *value = s->i->extra[2 * k + 1];
		st = roster_check(s->worker, key, value, r);
		json_set_text(s->parameters, key, value);
	}
	return st;
}

/* Where it is to run; the setting counts where nothing is said. */
static enum status check_place(struct submission *s, const struct project *p)
{
	const struct report *r = &s->i->report;
	const char *on = invocation_value(s->i, "--on");
	struct settings settings = { 0 };

	if (on && strcmp(on, "local") && strcmp(on, "slurm"))
		return report_error(r, ST_PARAMETER, "--on is '%s'; it must be local or slurm", on);
	if (s->shards > 1 && !json_flag(s->worker->description, "shards", false))
		return report_error(r, ST_PARAMETER,
		                    "--shards: worker %s does its work as a whole; leave it out",
		                    s->worker->name);
	enum status st = settings_read(&settings, p, r);
	if (st != ST_OK)
		return st;
	s->on = strdup(on ? on : settings.value[SETTING_LAUNCHER]);
	settings_finish(&settings);
	return s->on ? ST_OK : report_error(r, ST_RESOURCE, "memory ran out");
}

static enum status check_options(struct submission *s, const struct project *project)
{
	const struct invocation *i = s->i;
	enum status st = invocation_integer(i, "--priority", -100, 100, 0, &s->priority);
	const char *after = invocation_value(i, "--after");

	if (st == ST_OK)
		st = invocation_integer(i, "--threads", 1, 1024, 0, &s->threads);
	if (st == ST_OK)
		st = invocation_integer(i, "--memory", 1, 1L << 30, 0, &s->memory);
	if (st == ST_OK)
		st = invocation_integer(i, "--shards", 1, SHARDS_MAX, 1, &s->shards);
	if (st == ST_OK)
		st = check_place(s, project);
	const char *wall = invocation_value(i, "--wall");
	if (st == ST_OK && wall && (!number_parse(wall, &s->wall) || !(s->wall > 0)))
		return report_error(&i->report, ST_PARAMETER,
		                    "--wall is '%s'; it must be seconds, more than 0", wall);
	s->after = json_array();
	s->after_any = json_array();
	for (const char *p = after; st == ST_OK && p && *p; p += *p == ',') {
		int64_t id;
		const char *end = p + strlen(p);
		bool good = number_read_integer(&p, end, &id) && id > 0;
		bool any = good && !strncmp(p, ":any", 4);
		p += any ? 4 : 0;
		if (!good || (*p && *p != ','))
			return report_error(
			        &i->report, ST_PARAMETER,
			        "--after is '%s'; it must be the numbers of jobs, by comma, each with "
			        ":any behind it where any end will do",
			        after);
		json_array_append_new(any ? s->after_any : s->after, json_integer(id));
	}
	return st;
}

/* Add what the import of one argument gave: {"entities":[{"number","kind","path"}]}. */
static enum status add_inputs(struct submission *s, const char *argument, const json_t *imported)
{
	const json_t *entities = json_object_get(imported, "entities");
	size_t k, n = json_array_size(entities);
	json_t *e;
	char *path = NULL, *selector = NULL;

	struct input *more = reallocarray(s->inputs, s->n_inputs + n + 1, sizeof *more);
	if (!more || model_split_name(argument, &path, &selector) != ST_OK)
		return report_error(&s->i->report, ST_RESOURCE, "memory ran out");
	s->inputs = more;
	json_array_foreach(entities, k, e)
	{
		s->inputs[s->n_inputs++] = (struct input){
			.hash_path = strdup(json_text(e, "path", "")),
			.name = strdup(path_file_name(path)),
			.path = path_absolute(path, NULL),
			.number = json_int(e, "number", 0),
			.alone = n == 1,
		};
	}
	free(path);
	free(selector);
	return ST_OK;
}

static enum status read_inputs(struct submission *s, const struct project *p)
{
	enum status st = ST_OK;

	for (int k = 1; k < s->i->n_words && st == ST_OK; k++) {
		json_t *imported = NULL;
		st = import_child(s->i->words[k], p, &imported, &s->i->report);
		if (st == ST_OK)
			st = add_inputs(s, s->i->words[k], imported);
		json_decref(imported);
	}
	return st;
}

/* Extension of the worker's own output, ".map.exr". */
static const char *own_extension(const struct submission *s)
{
	const json_t *outputs = json_object_get(s->worker->description, "outputs");

	return json_text(json_array_get(outputs, 0), "extension", "");
}

/* Basic name of the results, absolute: -o or the input's name, with the entity's number. */
static char *output_name(const struct submission *s, const struct input *in, bool numbered)
{
	const char *o = invocation_value(s->i, "--output"), *extension = own_extension(s);
	char *name = o ? strdup(o) : path_basic_name(in->name);

	if (name && o && *extension && path_has_suffix(name, extension) &&
	    strlen(name) > strlen(extension))
		name[strlen(name) - strlen(extension)] = 0;
	char *full = name ? path_absolute(name, NULL) : NULL;
	free(name);
	if (full && numbered) {
		char *with = text_print("%s-%lld", full, (long long)in->number);
		free(full);
		full = with;
	}
	return full;
}

/* The job over inputs first .. first + n - 1. New reference. */
static json_t *make_job(const struct submission *s, const char *group, size_t first, size_t n,
                        bool numbered)
{
	const struct input *in = &s->inputs[first];
	json_t *o = json_object(), *inputs = json_array();
	char *output = output_name(s, in, numbered);

	for (size_t k = first; k < first + n; k++)
		json_array_append_new(
		        inputs, json_pack("{s:s, s:n}", "path", s->inputs[k].hash_path, "entity"));
	json_set_text(o, "worker", s->worker->name);
	json_set_text(o, "file_name", in->name);
	json_set_text(o, "path_name", in->path);
	json_set_text(o, "group", group);
	json_set_text(o, "output", output);
	json_set_int(o, "priority", s->priority);
	json_set_int(o, "threads", s->threads);
	json_set_int(o, "memory_mib", s->memory);
	json_set_text(o, "on", s->on);
	json_set_int(o, "shards", s->shards);
	json_set_text(o, "partition", invocation_value(s->i, "--partition"));
	json_set_text(o, "account", invocation_value(s->i, "--account"));
	json_set_text(o, "time", invocation_value(s->i, "--time"));
	json_object_set_new(o, "inputs", inputs);
	json_object_set(o, "parameters", s->parameters);
	json_object_set(o, "after", s->after);
	json_object_set(o, "after_any", s->after_any);
	if (s->wall > 0)
		json_object_set_new(o, "wall_limit_s", json_real(s->wall));
	json_object_set_new(o, "force", json_boolean(invocation_flag(s->i, "--force")));
	free(output);
	return o;
}

static enum status send_jobs(const struct submission *s, struct connection *c, json_t *jobs,
                             struct job_list *list)
{
	json_t *body = json_pack("{s:o}", "jobs", jobs);

	if (!body)
		return report_error(&s->i->report, ST_RESOURCE, "memory ran out");
	return client_request(c->client, MESSAGE_SUBMIT, body, job_list_add, NULL, list,
	                      &s->i->report);
}

static bool is_scene(const struct submission *s)
{
	return json_flag(s->worker->description, "scene", false);
}

/* Results of files of one name in different folders would overwrite each other. */
static enum status check_names(const struct submission *s, size_t each)
{
	for (size_t a = 0; a < s->n_inputs && each < s->n_inputs; a++)
		for (size_t b = 0; b < a; b++)
			if (strcmp(s->inputs[a].path, s->inputs[b].path) &&
			    !strcmp(s->inputs[a].name, s->inputs[b].name))
				return report_error(
				        &s->i->report, ST_PARAMETER,
				        "results of '%s' and '%s' would have the same names; submit "
				        "them one by one with -o",
				        s->inputs[b].path, s->inputs[a].path);
	return ST_OK;
}

static enum status make_jobs(const struct submission *s, struct connection *c,
                             struct job_list *list)
{
	const char *given = invocation_value(s->i, "--group");
	size_t each = is_scene(s) ? s->n_inputs : 1, room = 0;
	char *own = NULL;
	enum status st = ST_OK;
	json_t *jobs = json_array();

	if (!given && each < s->n_inputs) {
		char *base = path_basic_name(s->inputs[0].name);
		own = base ? text_print("%s-%s", base, s->worker->name) : NULL;
		free(base);
	}
	st = check_names(s, each);
	for (size_t k = 0; k < s->n_inputs && st == ST_OK; k += each) {
		bool given_name = invocation_value(s->i, "--output") != NULL;
		bool numbered = each < s->n_inputs && (given_name || !s->inputs[k].alone);
		json_t *job = make_job(s, given ? given : own, k, each, numbered);
		char *text = job ? json_write(job, false) : NULL;
		size_t size = text ? strlen(text) : 0;
		free(text);
		if (room + size > PACKET_ROOM && json_array_size(jobs)) {
			st = send_jobs(s, c, jobs, list);
			jobs = json_array();
			room = 0;
		}
		json_array_append_new(jobs, job);
		room += size;
	}
	if (st == ST_OK)
		st = send_jobs(s, c, jobs, list);
	else
		json_decref(jobs);
	free(own);
	return st;
}

enum status submission_send(const struct invocation *i, struct connection *c, struct job_list *list)
{
	struct submission s = { .i = i };
	struct project p = { 0 };

	*c = (struct connection){ 0 };
	if (i->n_words < 2)
		return report_error(&i->report, ST_PARAMETER,
		                    "name a worker and at least one input; see batten %s --help",
		                    i->command->name);
	enum status st = project_find(&p, NULL, &i->report);
	if (st == ST_OK)
		st = check_worker(&s, &p);
	if (st == ST_OK)
		st = check_options(&s, &p);
	if (st == ST_OK)
		st = project_make(&p, &i->report);
	if (st == ST_OK)
		st = read_inputs(&s, &p);
	if (st == ST_OK)
		st = connection_open(c, i, true);
	if (st == ST_OK)
		st = make_jobs(&s, c, list);
	for (size_t k = 0; k < s.n_inputs; k++) {
		free(s.inputs[k].hash_path);
		free(s.inputs[k].name);
		free(s.inputs[k].path);
	}
	free(s.inputs);
	free(s.on);
	json_decref(s.parameters);
	json_decref(s.after);
	json_decref(s.after_any);
	roster_finish(&s.roster);
	project_finish(&p);
	return st;
}
