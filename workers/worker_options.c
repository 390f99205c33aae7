/* worker_options.c - the command line of a worker run by hand. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "number.h"
#include "worker_private.h"

enum status task_init(struct task *t)
{
	size_t n = 1;
	*t = (struct task){ 0 };
	for (int i = 0; worker.params[i].name; i++)
		n++;
	t->values = calloc(n, sizeof *t->values);
	t->given = calloc(n, sizeof *t->given);
	return t->values && t->given ? ST_OK : ST_RESOURCE;
}

void task_finish(struct task *t)
{
	for (int i = 0; i < t->n_inputs; i++) {
		free(t->inputs[i].path);
		free(t->inputs[i].entity);
	}
	for (int i = 0; t->values && worker.params[i].name; i++)
		free(t->values[i]);
	for (int i = 0; i < t->n_parts; i++)
		free(t->parts[i]);
	free(t->inputs);
	free(t->values);
	free(t->given);
	free(t->output);
	free(t->part);
	free(t->parts);
	*t = (struct task){ 0 };
}

enum status task_add_input(struct task *t, const char *path, const char *entity)
{
	struct task_input *inputs = realloc(t->inputs, (size_t)(t->n_inputs + 1) * sizeof *inputs);
	if (!inputs)
		return ST_RESOURCE;
	t->inputs = inputs;
	struct task_input in = { strdup(path), entity ? strdup(entity) : NULL };
	inputs[t->n_inputs++] = in;
	return in.path && (in.entity || !entity) ? ST_OK : ST_RESOURCE;
}

/* The words of a command line, one after the other. */
struct words {
	int argc, at;
	char **argv;
	struct task *task;
	const struct report *report;
	char *job;
	bool about_work; /* something was said that a job file says itself */
	enum mode mode;
};

static enum status set_text(char **to, const char *value)
{
	free(*to);
	*to = strdup(value);
	return *to ? ST_OK : ST_RESOURCE;
}

static enum status set_output(struct words *w, const char *value)
{
	w->about_work = true;
	return set_text(&w->task->output, value);
}

static enum status set_part(struct words *w, const char *value)
{
	w->about_work = true;
	return set_text(&w->task->part, value);
}

static enum status set_job(struct words *w, const char *value)
{
	return set_text(&w->job, value);
}

static enum status set_threads(struct words *w, const char *value)
{
	int64_t n;
	if (!number_parse_integer(value, &n) || n < 1 || n > THREADS_MAX)
		return report_error(w->report, ST_PARAMETER,
		                    "--threads '%s': expected an integer from 1 to %d", value,
		                    THREADS_MAX);
	w->task->threads = (int)n;
	return ST_OK;
}

static enum status set_memory(struct words *w, const char *value)
{
	int64_t n;
	if (!number_parse_integer(value, &n) || n < 0 || n > MEMORY_MAX)
		return report_error(w->report, ST_PARAMETER,
		                    "--memory '%s': expected MiB as an integer from 0 (no limit) "
		                    "to %d",
		                    value, MEMORY_MAX);
	w->task->memory_mib = (size_t)n;
	return ST_OK;
}

static enum status set_force(struct words *w, const char *value)
{
	(void)value;
	w->task->force = true;
	return ST_OK;
}

static enum status set_json(struct words *w, const char *value)
{
	(void)value;
	w->task->json = true;
	return ST_OK;
}

static enum status ask_describe(struct words *w, const char *value)
{
	(void)value;
	w->mode = MODE_DESCRIBE;
	return ST_OK;
}

static enum status ask_help(struct words *w, const char *value)
{
	(void)value;
	w->mode = MODE_HELP;
	return ST_OK;
}

static enum status ask_version(struct words *w, const char *value)
{
	(void)value;
	w->mode = MODE_VERSION;
	return ST_OK;
}

struct option {
	const char *name, *value, *help;
	enum status (*set)(struct words *w, const char *value);
};

static const struct option options[] = {
	{ "-o", "NAME", "basic name of the outputs, or the whole name of the first one",
	  set_output },
	{ "--threads", "N", "threads to use (default: as many as processors)", set_threads },
	{ "--memory", "MIB", "memory allowed, 0 for no limit (default 0)", set_memory },
	{ "--force", NULL, "do it again though the output is up to date", set_force },
	{ "--part", "FILE", "keep finished units there (default: OUTPUT.part)", set_part },
	{ "--job", "FILE", "do what this job file says", set_job },
	{ "--json", NULL, "say what was made as one JSON object", set_json },
	{ "--describe", NULL, "say what this worker takes and makes, as JSON", ask_describe },
	{ "--help", NULL, "this text", ask_help },
	{ "--version", NULL, "the version", ask_version },
	{ NULL, NULL, NULL, NULL },
};

void options_help(struct text *out)
{
	for (const struct option *o = options; o->name; o++) {
		char left[32];
		snprintf(left, sizeof left, "%s%s%s", o->name, o->value ? " " : "",
		         o->value ? o->value : "");
		text_addf(out, "  %-20s  %s\n", left, o->help);
	}
}

/* The value of an option: behind '=', or the next word. */
static enum status take_value(struct words *w, const char *name, const char *inlined,
                              const char **value)
{
	if (inlined) {
		*value = inlined;
		return ST_OK;
	}
	if (w->at == w->argc)
		return report_error(w->report, ST_PARAMETER, "%s needs a value", name);
	*value = w->argv[w->at++];
	return ST_OK;
}

static enum status take_flag(struct words *w, const struct param *p, const char *inlined)
{
	const char *value = inlined ? inlined : "yes";
	const char *next = w->at < w->argc ? w->argv[w->at] : "";
	if (!inlined && (strcmp(next, "yes") == 0 || strcmp(next, "no") == 0)) {
		value = next;
		w->at++;
	}
	return values_set(w->task, p->name, value, w->report);
}

static enum status take_option(struct words *w, const char *word)
{
	size_t n = strcspn(word, "=");
	const char *inlined = word[n] ? word + n + 1 : NULL, *value = NULL;
	char name[64];
	int index;
	snprintf(name, sizeof name, "%.*s", (int)(n < sizeof name ? n : sizeof name - 1), word);
	for (const struct option *o = options; o->name; o++) {
		if (strcmp(o->name, name) != 0)
			continue;
		if (!o->value && inlined)
			return report_error(w->report, ST_PARAMETER, "%s takes no value", name);
		enum status st = o->value ? take_value(w, name, inlined, &value) : ST_OK;
		return st == ST_OK ? o->set(w, value) : st;
	}
	if (strcmp(name, "-h") == 0)
		return ask_help(w, NULL);
	if (strncmp(name, "--", 2) != 0)
		return report_error(w->report, ST_PARAMETER,
		                    "there is no option '%s'; batten-%s --help lists them", name,
		                    worker.name);
	w->about_work = true;
	const struct param *p = param_find(name + 2, &index);
	if (!p)
		return values_set(w->task, name + 2, "", w->report); /* says what there is */
	if (p->type == PARAM_FLAG)
		return take_flag(w, p, inlined);
	enum status st = take_value(w, name, inlined, &value);
	return st == ST_OK ? values_set(w->task, p->name, value, w->report) : st;
}

static enum status take_input(struct words *w, const char *word)
{
	char *path = NULL, *entity = NULL;
	w->about_work = true;
	enum status st = model_split_name(word, &path, &entity);
	if (st == ST_OK)
		st = task_add_input(w->task, path, entity);
	free(path);
	free(entity);
	return st;
}

/* A job file with the options that may stand beside it. */
static enum status take_job(struct words *w)
{
	struct task job, *t = w->task;
	if (w->about_work)
		return report_error(w->report, ST_PARAMETER,
		                    "--job says it all: leave inputs, parameters, -o and --part "
		                    "out");
	enum status st = job_read(&job, w->job, w->report);
	if (st != ST_OK)
		return st;
	if (t->threads)
		job.threads = t->threads;
	if (t->memory_mib)
		job.memory_mib = t->memory_mib;
	job.force |= t->force;
	job.json = t->json;
	task_finish(t);
	*t = job;
	return ST_OK;
}

static enum status take_words(struct words *w)
{
	bool only_inputs = false;
	while (w->at < w->argc) {
		const char *word = w->argv[w->at++];
		enum status st = ST_OK;
		if (!only_inputs && strcmp(word, "--") == 0)
			only_inputs = true;
		else if (!only_inputs && word[0] == '-')
			st = take_option(w, word);
		else
			st = take_input(w, word);
		if (st != ST_OK)
			return st;
	}
	if (w->mode != MODE_RUN)
		return ST_OK;
	if (w->job)
		return take_job(w);
	if (w->task->n_inputs == 0)
		return report_error(w->report, ST_PARAMETER,
		                    "no input; name a file, or FILE#ENTITY for one surface of it");
	return values_default(w->task, w->report);
}

enum status options_parse(struct task *t, int argc, char **argv, enum mode *mode,
                          const struct report *r)
{
	struct words w = { .argc = argc, .at = 1, .argv = argv, .task = t, .report = r };
	enum status st = task_init(t);
	w.mode = argc == 1 ? MODE_PACKETS : MODE_RUN;
	if (st == ST_OK && argc > 1)
		st = take_words(&w);
	free(w.job);
	if (st != ST_OK)
		task_finish(t);
	*mode = w.mode;
	return st;
}
