/* stats.c - the Stats record: memory, and the one place that knows its JSON. */
#include "stats.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "json.h"
#include "text.h"

#define X(name, word, dark, light, glyph, over) { word, dark, light, glyph, over },
const struct job_state_row job_state_table[N_JOB_STATES] = { JOB_STATE_MAP(X) };
#undef X

enum job_state job_state_from_word(const char *word)
{
	int i = 0;
	while (i < N_JOB_STATES && (!word || strcmp(word, job_state_table[i].word)))
		i++;
	return (enum job_state)i;
}

void stats_init(struct Stats *s)
{
	memset(s, 0, sizeof *s);
	s->eta_s = s->wall_s = s->suspended_s = s->cpu_s = NAN;
	s->peak_kib = -1;
}

void stats_drop_outputs(struct Stats *s)
{
	for (int i = 0; i < s->n_outputs; i++) {
		free(s->outputs[i].path);
		free(s->outputs[i].kind);
		json_decref(s->outputs[i].figures);
	}
	free(s->outputs);
	s->outputs = NULL;
	s->n_outputs = 0;
}

void stats_finish(struct Stats *s)
{
	if (!s)
		return;
	free(s->worker);
	free(s->file_name);
	free(s->path_name);
	free(s->group);
	free(s->host);
	free(s->reason);
	free(s->phase);
	for (int i = 0; i < s->n_inputs; i++) {
		free(s->inputs[i].path);
		free(s->inputs[i].entity);
	}
	free(s->inputs);
	stats_drop_outputs(s);
	json_decref(s->parameters);
	free(s->output);
	free(s->after);
	free(s->log);
	memset(s, 0, sizeof *s);
}

static char *duplicate(const char *s, bool *failed)
{
	if (!s)
		return NULL;
	char *copy = strdup(s);
	if (!copy)
		*failed = true;
	return copy;
}

static void *array(int n, size_t size, bool *failed)
{
	if (n <= 0)
		return NULL;
	void *p = calloc((size_t)n, size);
	if (!p)
		*failed = true;
	return p;
}

enum status stats_copy(struct Stats *out, const struct Stats *s)
{
	bool failed = false;
	*out = *s;
	out->worker = duplicate(s->worker, &failed);
	out->file_name = duplicate(s->file_name, &failed);
	out->path_name = duplicate(s->path_name, &failed);
	out->group = duplicate(s->group, &failed);
	out->host = duplicate(s->host, &failed);
	out->reason = duplicate(s->reason, &failed);
	out->phase = duplicate(s->phase, &failed);
	out->output = duplicate(s->output, &failed);
	out->log = duplicate(s->log, &failed);
	out->parameters = s->parameters ? json_deep_copy(s->parameters) : NULL;
	out->inputs = array(s->n_inputs, sizeof *out->inputs, &failed);
	out->outputs = array(s->n_outputs, sizeof *out->outputs, &failed);
	out->after = array(s->n_after, sizeof *out->after, &failed);
	out->n_inputs = out->inputs ? s->n_inputs : 0;
	out->n_outputs = out->outputs ? s->n_outputs : 0;
	out->n_after = out->after ? s->n_after : 0;
	for (int i = 0; i < out->n_inputs; i++) {
		out->inputs[i].path = duplicate(s->inputs[i].path, &failed);
		out->inputs[i].entity = duplicate(s->inputs[i].entity, &failed);
	}
	for (int i = 0; i < out->n_outputs; i++) {
		out->outputs[i].path = duplicate(s->outputs[i].path, &failed);
		out->outputs[i].kind = duplicate(s->outputs[i].kind, &failed);
		if (s->outputs[i].figures)
			out->outputs[i].figures = json_deep_copy(s->outputs[i].figures);
	}
	if (out->after)
		memcpy(out->after, s->after, (size_t)s->n_after * sizeof *out->after);
	if (failed || (s->parameters && !out->parameters)) {
		stats_finish(out);
		return ST_RESOURCE;
	}
	return ST_OK;
}

double stats_fraction(const struct Stats *s)
{
	if (s->state == JOB_DONE)
		return 1;
	if (s->total <= 0)
		return NAN;
	double f = (double)s->done / (double)s->total;
	return f < 0 ? 0 : f > 1 ? 1 : f;
}

/* Writing: straight to text, for ten thousand jobs are listed at once. */

static void write_string(struct text *t, const char *s)
{
	if (!s) {
		text_add(t, "null");
		return;
	}
	text_add_bytes(t, "\"", 1);
	for (const char *p = s; *p;) {
		size_t plain = 0;
		while ((unsigned char)p[plain] >= 0x20 && p[plain] != '"' && p[plain] != '\\')
			plain++;
		text_add_bytes(t, p, plain);
		p += plain;
		if (*p == '"' || *p == '\\')
			text_addf(t, "\\%c", *p++);
		else if (*p)
			text_addf(t, "\\u%04x", (unsigned char)*p++);
	}
	text_add_bytes(t, "\"", 1);
}

/* "key": , with the comma before it where one is needed; the key is one of ours. */
static void write_key(struct text *t, const char *key)
{
	if (t->n && t->s[t->n - 1] != '{' && t->s[t->n - 1] != '[')
		text_add_bytes(t, ",", 1);
	text_add_bytes(t, "\"", 1);
	text_add(t, key);
	text_add_bytes(t, "\":", 2);
}

static void write_text(struct text *t, const char *key, const char *s)
{
	write_key(t, key);
	write_string(t, s);
}

static void write_number(struct text *t, const char *key, double x)
{
	write_key(t, key);
	if (isfinite(x))
		text_add_number(t, x);
	else
		text_add(t, "null");
}

static void write_integer(struct text *t, const char *key, int64_t x, bool known)
{
	write_key(t, key);
	if (known)
		text_addf(t, "%lld", (long long)x);
	else
		text_add(t, "null");
}

static void write_value(struct text *t, const char *key, const json_t *o)
{
	write_key(t, key);
	char *s = o && json_object_size(o) ? json_write(o, false) : NULL;
	text_add(t, s ? s : "{}");
	free(s);
}

static void write_inputs(struct text *t, const struct Stats *s)
{
	write_key(t, "inputs");
	text_add(t, "[");
	for (int i = 0; i < s->n_inputs; i++) {
		text_add(t, i ? ",{" : "{");
		write_text(t, "path", s->inputs[i].path);
		write_text(t, "entity", s->inputs[i].entity);
		text_add(t, "}");
	}
	text_add(t, "]");
}

static void write_outputs(struct text *t, const struct Stats *s)
{
	write_key(t, "outputs");
	text_add(t, "[");
	for (int i = 0; i < s->n_outputs; i++) {
		text_add(t, i ? ",{" : "{");
		write_text(t, "path", s->outputs[i].path);
		write_text(t, "kind", s->outputs[i].kind);
		write_value(t, "figures", s->outputs[i].figures);
		text_add(t, "}");
	}
	text_add(t, "]");
}

void stats_write(struct text *t, const struct Stats *s)
{
	text_add(t, "{");
	write_integer(t, "id", s->id, true);
	write_text(t, "worker", s->worker);
	write_text(t, "state", job_state_table[s->state].word);
	write_text(t, "color", job_state_table[s->state].dark);
	write_number(t, "fraction", stats_fraction(s));
	write_number(t, "eta_s", s->eta_s);
	write_text(t, "file_name", s->file_name);
	write_text(t, "path_name", s->path_name);
	write_integer(t, "pid", s->pid, s->pid > 0);
	write_text(t, "host", s->host);
	write_text(t, "group", s->group);
	write_text(t, "reason", s->reason);
	write_number(t, "wall_s", s->wall_s);
	write_number(t, "suspended_s", s->suspended_s);
	write_number(t, "cpu_s", s->cpu_s);
	write_integer(t, "peak_kib", s->peak_kib, s->peak_kib >= 0);
	write_inputs(t, s);
	write_outputs(t, s);
	write_text(t, "log", s->log);
	write_integer(t, "priority", s->priority, true);
	write_integer(t, "done", s->done, s->total > 0);
	write_integer(t, "total", s->total, s->total > 0);
	write_text(t, "phase", s->phase);
	write_key(t, "after");
	text_add(t, "[");
	for (int i = 0; i < s->n_after; i++)
		text_addf(t, "%s%lld", i ? "," : "", (long long)s->after[i]);
	text_add(t, "]");
	write_value(t, "parameters", s->parameters);
	write_text(t, "output", s->output);
	write_integer(t, "threads", s->threads, s->threads > 0);
	write_integer(t, "memory_mib", s->memory_mib, s->memory_mib > 0);
	write_key(t, "force");
	text_add(t, s->force ? "true" : "false");
	write_number(t, "submitted", s->submitted > 0 ? s->submitted : NAN);
	write_number(t, "started", s->started > 0 ? s->started : NAN);
	write_number(t, "ended", s->ended > 0 ? s->ended : NAN);
	text_add(t, "}");
}

json_t *stats_to_json(const struct Stats *s)
{
	struct text t = { 0 };
	json_t *o = NULL;
	stats_write(&t, s);
	if (!t.failed)
		o = json_loadb(t.s, t.n, JSON_ALLOW_NUL, NULL);
	text_finish(&t);
	return o;
}

/* Reading: what is missing, null or of another type is not known. */

static enum status read_inputs(struct Stats *s, const json_t *a, bool *failed)
{
	s->inputs = array((int)json_array_size(a), sizeof *s->inputs, failed);
	s->n_inputs = s->inputs ? (int)json_array_size(a) : 0;
	for (int i = 0; i < s->n_inputs; i++) {
		const json_t *o = json_array_get(a, (size_t)i);
		const json_t *entity = json_object_get(o, "entity");
		s->inputs[i].path = duplicate(json_text(o, "path", NULL), failed);
		s->inputs[i].entity = duplicate(json_string_value(entity), failed);
		if (json_is_integer(entity)) {
			s->inputs[i].entity =
			        text_print("%lld", (long long)json_integer_value(entity));
			*failed |= !s->inputs[i].entity;
		}
		if (!s->inputs[i].path)
			return ST_INPUT;
	}
	return ST_OK;
}

static enum status read_outputs(struct Stats *s, const json_t *a, bool *failed)
{
	s->outputs = array((int)json_array_size(a), sizeof *s->outputs, failed);
	s->n_outputs = s->outputs ? (int)json_array_size(a) : 0;
	for (int i = 0; i < s->n_outputs; i++) {
		const json_t *o = json_array_get(a, (size_t)i);
		const json_t *figures = json_object_get(o, "figures");
		s->outputs[i].path = duplicate(json_text(o, "path", NULL), failed);
		s->outputs[i].kind = duplicate(json_text(o, "kind", NULL), failed);
		s->outputs[i].figures = json_is_object(figures) ? json_deep_copy(figures) : NULL;
		if (!s->outputs[i].path)
			return ST_INPUT;
	}
	return ST_OK;
}

static enum status read_lists(struct Stats *s, const json_t *o, bool *failed)
{
	enum status st = read_inputs(s, json_object_get(o, "inputs"), failed);
	if (st == ST_OK)
		st = read_outputs(s, json_object_get(o, "outputs"), failed);
	const json_t *after = json_object_get(o, "after");
	s->after = array((int)json_array_size(after), sizeof *s->after, failed);
	s->n_after = s->after ? (int)json_array_size(after) : 0;
	for (int i = 0; i < s->n_after && st == ST_OK; i++) {
		const json_t *id = json_array_get(after, (size_t)i);
		if (!json_is_integer(id))
			st = ST_INPUT;
		s->after[i] = json_integer_value(id);
	}
	return st;
}

enum status stats_from_json(struct Stats *s, const json_t *o)
{
	bool failed = false;
	stats_init(s);
	if (!json_is_object(o))
		return ST_INPUT;
	s->id = json_int(o, "id", 0);
	s->worker = duplicate(json_text(o, "worker", NULL), &failed);
	s->state = job_state_from_word(json_text(o, "state", job_state_table[JOB_QUEUED].word));
	s->file_name = duplicate(json_text(o, "file_name", NULL), &failed);
	s->path_name = duplicate(json_text(o, "path_name", NULL), &failed);
	s->group = duplicate(json_text(o, "group", NULL), &failed);
	s->host = duplicate(json_text(o, "host", NULL), &failed);
	s->reason = duplicate(json_text(o, "reason", NULL), &failed);
	s->phase = duplicate(json_text(o, "phase", NULL), &failed);
	s->output = duplicate(json_text(o, "output", NULL), &failed);
	s->log = duplicate(json_text(o, "log", NULL), &failed);
	s->priority = (int)json_int(o, "priority", 0);
	s->done = json_int(o, "done", 0);
	s->total = json_int(o, "total", 0);
	s->eta_s = json_number(o, "eta_s", NAN);
	s->pid = (pid_t)json_int(o, "pid", 0);
	s->submitted = json_number(o, "submitted", 0);
	s->started = json_number(o, "started", 0);
	s->ended = json_number(o, "ended", 0);
	s->wall_s = json_number(o, "wall_s", NAN);
	s->suspended_s = json_number(o, "suspended_s", NAN);
	s->cpu_s = json_number(o, "cpu_s", NAN);
	s->peak_kib = json_int(o, "peak_kib", -1);
	s->threads = (int)json_int(o, "threads", 0);
	s->memory_mib = json_int(o, "memory_mib", 0);
	s->force = json_flag(o, "force", false);
	const json_t *parameters = json_object_get(o, "parameters");
	s->parameters = json_is_object(parameters) ? json_deep_copy(parameters) : json_object();
	enum status st = read_lists(s, o, &failed);
	if (failed || !s->parameters)
		st = ST_RESOURCE;
	else if (s->state == N_JOB_STATES)
		st = ST_INPUT;
	if (st != ST_OK)
		stats_finish(s);
	return st;
}
