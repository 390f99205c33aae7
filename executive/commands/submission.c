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
#include "shard.h"
#include "work_order.h"

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

struct submission {
	const struct invocation *i;
	struct work_order order;
	json_t *parameters, *after, *after_any;
	struct work_input *inputs; /* owned, as their texts are */
	size_t n_inputs;
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

/* Of the words themselves too: an input is read for long before it is named to the service. */
static enum status take_parameters(struct submission *s)
{
	const struct invocation *i = s->i;
	enum status st = ST_OK;

	s->order.parameters = s->parameters = json_object();
	for (int k = 1; k < i->n_words && st == ST_OK; k++)
		st = work_text_check("the input", i->words[k], &i->report);
	for (int k = 0; k < i->n_extra && st == ST_OK; k++) {
		const char *name = i->extra[2 * k], *value = i->extra[2 * k + 1];
		st = work_text_check("the parameter", name, &i->report);
		if (st == ST_OK)
			st = work_text_check("the value", value, &i->report);
		if (st == ST_OK)
			json_set_text(s->parameters, name, value);
	}
	return st;
}

/* "12,13:any" */
static enum status take_after(struct submission *s)
{
	const char *after = invocation_value(s->i, "--after");

	s->order.after = s->after = json_array();
	s->order.after_any = s->after_any = json_array();
	for (const char *p = after; p && *p; p += *p == ',') {
		int64_t id;
		const char *end = p + strlen(p);
		bool good = number_read_integer(&p, end, &id) && id > 0;
		bool any = good && !strncmp(p, ":any", 4);
		p += any ? 4 : 0;
		if (!good || (*p && *p != ','))
			return report_error(
			        &s->i->report, ST_PARAMETER,
			        "--after is '%s'; it must be the numbers of jobs, by comma, each with "
			        ":any behind it where any end will do",
			        after);
		json_array_append_new(any ? s->after_any : s->after, json_integer(id));
	}
	return ST_OK;
}

static enum status take_options(struct submission *s)
{
	const struct invocation *i = s->i;
	struct work_order *o = &s->order;
	const char *wall = invocation_value(i, "--wall");
	enum status st = invocation_integer(i, "--priority", -100, 100, 0, &o->priority);

	if (st == ST_OK)
		st = invocation_integer(i, "--threads", 1, 1024, 0, &o->threads);
	if (st == ST_OK)
		st = invocation_integer(i, "--memory", 1, 1L << 30, 0, &o->memory_mib);
	if (st == ST_OK)
		st = invocation_integer(i, "--shards", 1, SHARDS_MAX, 1, &o->shards);
	if (st == ST_OK && wall && (!number_parse(wall, &o->wall_s) || !(o->wall_s > 0)))
		st = report_error(&i->report, ST_PARAMETER,
		                  "--wall is '%s'; it must be seconds, more than 0", wall);
	o->output = invocation_value(i, "--output");
	o->group = invocation_value(i, "--group");
	o->on = invocation_value(i, "--on");
	o->partition = invocation_value(i, "--partition");
	o->account = invocation_value(i, "--account");
	o->time = invocation_value(i, "--time");
	o->force = invocation_flag(i, "--force");
	return st == ST_OK ? take_after(s) : st;
}

/* Add what the import of one argument gave: {"entities":[{"number","kind","path"}]}. */
static enum status add_inputs(struct submission *s, const char *argument, const json_t *imported)
{
	const json_t *entities = json_object_get(imported, "entities");
	size_t k, n = json_array_size(entities);
	json_t *e;
	char *path = NULL, *selector = NULL;

	struct work_input *more = reallocarray(s->inputs, s->n_inputs + n + 1, sizeof *more);
	if (!more || model_split_name(argument, &path, &selector) != ST_OK)
		return report_error(&s->i->report, ST_RESOURCE, "memory ran out");
	s->inputs = more;
	json_array_foreach(entities, k, e)
	{
		s->inputs[s->n_inputs++] = (struct work_input){
			.path = strdup(json_text(e, "path", "")),
			.file_name = strdup(path_file_name(path)),
			.path_name = path_absolute(path, NULL),
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

enum status submission_send(const struct invocation *i, struct connection *c, struct job_list *list)
{
	struct submission s = { .i = i };
	struct project p = { 0 };

	*c = (struct connection){ 0 };
	if (i->n_words < 2)
		return report_error(&i->report, ST_PARAMETER,
		                    "name a worker and at least one input; see batten %s --help",
		                    i->command->name);
	s.order.worker = i->words[0];
	enum status st = take_parameters(&s);
	if (st == ST_OK)
		st = project_find(&p, NULL, &i->report);
	if (st == ST_OK)
		st = take_options(&s);
	if (st == ST_OK)
		st = work_order_check(&s.order, &p, &i->report);
	if (st == ST_OK)
		st = project_make(&p, &i->report);
	if (st == ST_OK)
		st = read_inputs(&s, &p);
	if (st == ST_OK)
		st = connection_open(c, i, true);
	s.order.inputs = s.inputs;
	s.order.n_inputs = s.n_inputs;
	if (st == ST_OK)
		st = work_order_send(&s.order, c->client, job_list_add, list, &i->report);
	for (size_t k = 0; k < s.n_inputs; k++) {
		free((char *)s.inputs[k].path);
		free((char *)s.inputs[k].file_name);
		free((char *)s.inputs[k].path_name);
	}
	free(s.inputs);
	json_decref(s.parameters);
	json_decref(s.after);
	json_decref(s.after_any);
	work_order_finish(&s.order);
	project_finish(&p);
	return st;
}
