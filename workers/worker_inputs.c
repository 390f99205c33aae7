/* worker_inputs.c - from the files named to computations: read, find the surfaces, name outputs. */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base.h"
#include "path.h"
#include "worker_private.h"

/* One surface that was asked for. */
struct choice {
	const struct model *model;
	const struct entity *entity;
	const char *path;
};

struct choices {
	struct choice *list; /* owned */
	int n;
};

static void read_step(void *data, double fraction)
{
	struct run *run = data;
	char phase[32];
	snprintf(phase, sizeof phase, "reading %d %%", (int)(100 * fraction));
	meter_set(&run->meter, phase, 0, 0);
}

/* A file is read once, however often it is named. */
static enum status find_model(struct inputs *in, struct run *run, const char *path,
                              const struct model **out)
{
	const struct progress progress = { read_step, run, &run->stop };
	for (int i = 0; i < in->n_models; i++) {
		if (strcmp(in->paths[i], path) == 0) {
			*out = &in->models[i];
			return ST_OK;
		}
	}
	struct model *m = &in->models[in->n_models];
	enum status st = model_read(m, path, &progress, &run->report);
	if (st != ST_OK)
		return st;
	for (int i = 0; i < m->n_warnings; i++)
		report_warning(&run->report, "%s: %s", path, m->warnings[i]);
	in->paths[in->n_models++] = path;
	*out = m;
	return ST_OK;
}

static enum status choose(struct choices *c, struct choice one)
{
	struct choice *list = realloc(c->list, (size_t)(c->n + 1) * sizeof *list);
	if (!list)
		return ST_RESOURCE;
	c->list = list;
	list[c->n++] = one;
	return ST_OK;
}

static enum status choose_input(struct choices *c, const struct model *m,
                                const struct task_input *in, const struct report *r)
{
	struct entity *found;
	int before = c->n;
	if (in->entity) {
		enum status st = model_find(m, in->entity, &found, r);
		if (st != ST_OK)
			return st;
		if (found->kind != ENTITY_SURFACE)
			return report_error(
			        r, ST_INPUT,
			        "'%s#%s' is a %s, expected a surface; batten info lists "
			        "what the file holds",
			        in->path, in->entity, entity_kind_name(found->kind));
		return choose(c, (struct choice){ m, found, in->path });
	}
	for (int i = 0; i < m->n; i++) {
		const struct entity *e = &m->entities[i];
		if (e->kind != ENTITY_SURFACE || e->number < 1)
			continue;
		enum status st = choose(c, (struct choice){ m, e, in->path });
		if (st != ST_OK)
			return st;
	}
	if (c->n == before)
		return report_error(r, ST_INPUT,
		                    "'%s' holds no surface; batten info lists what the file holds",
		                    in->path);
	return ST_OK;
}

/* Basic name of a computation's outputs: `suffix` where several surfaces are done one by one. */
static enum status name_output(struct computation *c, const struct task *t, const struct choice *of,
                               bool suffix, const struct report *r)
{
	const char *extension = worker.outputs[0].extension;
	char *base = t->output ? strdup(t->output) : path_basic_name(of->path);
	if (!base)
		return ST_RESOURCE;
	if (t->output && path_has_suffix(base, extension))
		base[strlen(base) - strlen(extension)] = 0;
	const char *name = path_file_name(base);
	if (!*name || !strcmp(name, ".") || !strcmp(name, "..")) {
		enum status st =
		        report_error(r, ST_PARAMETER, "-o '%s' names no file; give a basic name",
		                     t->output ? t->output : of->path);
		free(base);
		return st;
	}
	if (!suffix)
		c->base = strdup(base);
	else if (of->entity->number > 0)
		c->base = text_print("%s-%d", base, of->entity->number);
	else
		c->base = text_print("%s-D%d", base, of->entity->de);
	free(base);
	return c->base ? ST_OK : ST_RESOURCE;
}

/* Known before hours are spent: the folder is there and takes files. */
static enum status check_folder(const char *base, const struct report *r)
{
	char *folder = path_folder(base);
	enum status st = ST_OK;
	if (!folder)
		return ST_RESOURCE;
	if (!path_is_folder(folder))
		st = report_error(r, ST_INPUT,
		                  "cannot write to folder '%s': there is no such folder", folder);
	else if (access(folder, W_OK | X_OK) != 0)
		st = report_error(
		        r, ST_INPUT,
		        "cannot write to folder '%s': it may not be written; name another "
		        "with -o",
		        folder);
	free(folder);
	return st;
}

/* Hash of what is computed from: the text of each entity, whatever file it came from. */
static enum status hash_inputs(struct computation *c, const struct choice *list)
{
	struct text all = { 0 }, one = { 0 };
	for (int i = 0; i < c->n; i++) {
		text_reset(&one);
		base_format_entity(list[i].model, list[i].entity, &one);
		if (one.failed)
			break;
		hash_bytes(one.s, one.n, c->input_hash);
		text_add_bytes(&all, c->input_hash, HASH_SIZE - 1);
	}
	bool failed = all.failed || one.failed;
	if (!failed && c->n > 1)
		hash_bytes(all.s, all.n, c->input_hash);
	text_finish(&all);
	text_finish(&one);
	return failed ? ST_RESOURCE : ST_OK;
}

static enum status make_computation(struct computation *c, const struct task *t,
                                    const struct choice *list, int n, bool suffix,
                                    const struct report *r)
{
	c->surfaces = calloc((size_t)n, sizeof *c->surfaces);
	c->entities = calloc((size_t)n, sizeof *c->entities);
	if (!c->surfaces || !c->entities)
		return ST_RESOURCE;
	for (int i = 0; i < n; i++) {
		c->entities[i] = list[i].entity;
		c->surfaces[i] = &list[i].entity->geometry;
		const char *unit = list[i].model->unit, *first = list[0].model->unit;
		bool new_file = i > 0 && list[i].model != list[i - 1].model;
		if (new_file && strcmp(unit ? unit : "", first ? first : "") != 0)
			report_warning(
			        r, "'%s' is in %s, '%s' in %s: coordinates are taken as they are",
			        list[i].path, unit ? unit : "no unit", list[0].path,
			        first ? first : "no unit");
	}
	c->n = n;
	c->unit = list[0].model->unit;
	enum status st = hash_inputs(c, list);
	if (st == ST_OK)
		st = name_output(c, t, &list[0], suffix, r);
	return st == ST_OK ? check_folder(c->base, r) : st;
}

static enum status check_names(const struct inputs *in, const struct task *t,
                               const struct report *r)
{
	if (in->n > 1 && t->part)
		return report_error(
		        r, ST_PARAMETER,
		        "--part is for one surface, %d were named; leave it out, or name "
		        "one as FILE#ENTITY",
		        in->n);
	for (int i = 1; i < in->n; i++)
		for (int j = 0; j < i; j++)
			if (strcmp(in->list[i].base, in->list[j].base) == 0)
				return report_error(
				        r, ST_PARAMETER,
				        "two results would have the name '%s'; run them "
				        "one by one with -o",
				        in->list[i].base);
	return ST_OK;
}

static enum status make_computations(struct inputs *in, const struct task *t,
                                     const struct choices *c, const struct report *r)
{
	int n = worker.scene ? 1 : c->n;
	in->list = calloc((size_t)n, sizeof *in->list);
	if (!in->list)
		return ST_RESOURCE;
	for (int i = 0; i < n; i++) {
		in->n = i + 1;
		enum status st = make_computation(&in->list[i], t, &c->list[i],
		                                  worker.scene ? c->n : 1, n > 1, r);
		if (st != ST_OK)
			return st;
	}
	return check_names(in, t, r);
}

enum status inputs_read(struct inputs *in, struct run *run, const struct task *t)
{
	struct choices c = { 0 };
	enum status st = ST_OK;
	*in = (struct inputs){ 0 };
	in->models = calloc((size_t)t->n_inputs, sizeof *in->models);
	in->paths = calloc((size_t)t->n_inputs, sizeof *in->paths);
	if (!in->models || !in->paths)
		st = ST_RESOURCE;
	meter_set(&run->meter, "reading", 0, 0);
	for (int i = 0; st == ST_OK && i < t->n_inputs; i++) {
		const struct model *m;
		st = find_model(in, run, t->inputs[i].path, &m);
		if (st == ST_OK)
			st = choose_input(&c, m, &t->inputs[i], &run->report);
	}
	if (st == ST_OK)
		st = make_computations(in, t, &c, &run->report);
	free(c.list);
	if (st != ST_OK)
		inputs_finish(in);
	return st;
}

void inputs_finish(struct inputs *in)
{
	for (int i = 0; i < in->n; i++) {
		free(in->list[i].surfaces);
		free(in->list[i].entities);
		free(in->list[i].base);
	}
	for (int i = 0; i < in->n_models; i++)
		model_finish(&in->models[i]);
	free(in->list);
	free(in->models);
	free(in->paths);
	*in = (struct inputs){ 0 };
}
