/* stats.c - the Stats record: memory, and the one place that knows its JSON. */
#include "stats.h"

#include <math.h>
#include <stdio.h>
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
	s->peak_kib = s->bytes = -1;
	s->umask = -1;
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
	s->bytes = -1;
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
	free(s->after_any);
	free(s->on);
	free(s->partition);
	free(s->account);
	free(s->time);
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
	out->on = duplicate(s->on, &failed);
	out->partition = duplicate(s->partition, &failed);
	out->account = duplicate(s->account, &failed);
	out->time = duplicate(s->time, &failed);
	out->log = duplicate(s->log, &failed);
	out->parameters = json_incref(s->parameters);
	out->inputs = array(s->n_inputs, sizeof *out->inputs, &failed);
	out->outputs = array(s->n_outputs, sizeof *out->outputs, &failed);
	out->after = array(s->n_after, sizeof *out->after, &failed);
	out->n_inputs = out->inputs ? s->n_inputs : 0;
	out->n_outputs = out->outputs ? s->n_outputs : 0;
	out->n_after = out->after ? s->n_after : 0;
	out->after_any = array(s->n_after_any, sizeof *out->after_any, &failed);
	out->n_after_any = out->after_any ? s->n_after_any : 0;
	for (int i = 0; i < out->n_inputs; i++) {
		out->inputs[i].path = duplicate(s->inputs[i].path, &failed);
		out->inputs[i].entity = duplicate(s->inputs[i].entity, &failed);
	}
	for (int i = 0; i < out->n_outputs; i++) {
		out->outputs[i].path = duplicate(s->outputs[i].path, &failed);
		out->outputs[i].kind = duplicate(s->outputs[i].kind, &failed);
		if (s->outputs[i].figures)
			out->outputs[i].figures = json_incref(s->outputs[i].figures);
	}
	if (out->after)
		memcpy(out->after, s->after, (size_t)s->n_after * sizeof *out->after);
	if (out->after_any)
		memcpy(out->after_any, s->after_any,
		       (size_t)s->n_after_any * sizeof *out->after_any);
	if (failed || (s->parameters && !out->parameters)) {
		stats_finish(out);
		return ST_RESOURCE;
	}
	return ST_OK;
}

bool stats_is_local(const struct Stats *s)
{
	return !s->on || !strcmp(s->on, "local");
}

int stats_processes(const struct Stats *s)
{
	return s->shards > 1 ? s->shards : 1;
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

struct writer {
	struct text *t;
	bool brief; /* what is not known is left out */
};

/* A byte that is no UTF-8 (other programs' words in a reason) becomes the character for that: the record is
 * JSON in any case. */
static void write_string(struct text *t, const char *s)
{
	static const char unreadable[] = "\xef\xbf\xbd";
	const char *end = s + strlen(s);
	text_add_bytes(t, "\"", 1);
	for (const char *p = s; *p;) {
		size_t plain = 0;
		size_t n = 1;
		while (n && (unsigned char)p[plain] >= 0x20 && p[plain] != '"' &&
		       p[plain] != '\\') {
			n = text_character(p + plain, (size_t)(end - p) - plain);
			plain += n;
		}
		text_add_bytes(t, p, plain);
		p += plain;
		if (*p == '"' || *p == '\\')
			text_addf(t, "\\%c", *p++);
		else if ((unsigned char)*p >= 0x80) {
			text_add(t, unreadable);
			p++;
		} else if (*p)
			text_addf(t, "\\u%04x", (unsigned char)*p++);
	}
	text_add_bytes(t, "\"", 1);
}

/* "key": , with the comma before it where one is needed; the key is one of ours. False, and nothing
 * or null, for what is not known. */
static bool write_key(const struct writer *w, const char *key, bool known)
{
	enum { KEY_MAX = 32 };
	struct text *t = w->t;
	char b[KEY_MAX + sizeof ",\"\":null"], *p = b;
	size_t n = strlen(key);
	if (!known && w->brief)
		return false;
	if (t->n && t->s[t->n - 1] != '{' && t->s[t->n - 1] != '[')
		*p++ = ',';
	*p++ = '"';
	memcpy(p, key, n < KEY_MAX ? n : KEY_MAX);
	p += n < KEY_MAX ? n : KEY_MAX;
	memcpy(p, "\":null", 6);
	text_add_bytes(t, b, (size_t)(p - b) + (known ? 2 : 6));
	return known;
}

static void write_text(const struct writer *w, const char *key, const char *s)
{
	if (write_key(w, key, s))
		write_string(w->t, s);
}

static void write_number(const struct writer *w, const char *key, double x)
{
	if (write_key(w, key, isfinite(x)))
		text_add_number(w->t, x);
}

static void write_integer(const struct writer *w, const char *key, int64_t x, bool known)
{
	char digits[24];
	if (write_key(w, key, known))
		text_add_bytes(w->t, digits,
		               (size_t)snprintf(digits, sizeof digits, "%lld", (long long)x));
}

static void write_value(const struct writer *w, const char *key, const json_t *o)
{
	if (w->brief && !json_object_size(o))
		return;
	char *s = o && json_object_size(o) ? json_write(o, false) : NULL;
	write_key(w, key, true);
	text_add(w->t, s ? s : "{}");
	free(s);
}

static bool write_list(const struct writer *w, const char *key, int n)
{
	if (!n && w->brief)
		return false;
	write_key(w, key, true);
	text_add_bytes(w->t, "[", 1);
	return true;
}

static void write_inputs(const struct writer *w, const struct Stats *s)
{
	if (!write_list(w, "inputs", s->n_inputs))
		return;
	for (int i = 0; i < s->n_inputs; i++) {
		text_add(w->t, i ? ",{" : "{");
		write_text(w, "path", s->inputs[i].path);
		write_text(w, "entity", s->inputs[i].entity);
		text_add(w->t, "}");
	}
	text_add(w->t, "]");
}

static void write_outputs(const struct writer *w, const struct Stats *s)
{
	if (!write_list(w, "outputs", s->n_outputs))
		return;
	for (int i = 0; i < s->n_outputs; i++) {
		text_add(w->t, i ? ",{" : "{");
		write_text(w, "path", s->outputs[i].path);
		write_text(w, "kind", s->outputs[i].kind);
		write_value(w, "figures", s->outputs[i].figures);
		text_add(w->t, "}");
	}
	text_add(w->t, "]");
}

static void write_ids(const struct writer *w, const char *key, const int64_t *ids, int n)
{
	if (!write_list(w, key, n))
		return;
	for (int i = 0; i < n; i++)
		text_addf(w->t, "%s%lld", i ? "," : "", (long long)ids[i]);
	text_add(w->t, "]");
}

static void write_all(const struct writer *w, const struct Stats *s)
{
	text_add(w->t, "{");
	write_integer(w, "id", s->id, true);
	write_text(w, "worker", s->worker);
	write_text(w, "state", job_state_table[s->state].word);
	write_text(w, "color", w->brief ? NULL : job_state_table[s->state].dark);
	write_number(w, "fraction", w->brief ? NAN : stats_fraction(s));
	write_number(w, "eta_s", s->eta_s);
	write_text(w, "file_name", s->file_name);
	write_text(w, "path_name", s->path_name);
	write_integer(w, "pid", s->pid, s->pid > 0);
	write_text(w, "host", s->host);
	write_text(w, "group", s->group);
	write_text(w, "reason", s->reason);
	write_number(w, "wall_s", s->wall_s);
	write_number(w, "suspended_s", s->suspended_s);
	write_number(w, "cpu_s", s->cpu_s);
	write_integer(w, "peak_kib", s->peak_kib, s->peak_kib >= 0);
	write_inputs(w, s);
	write_outputs(w, s);
	write_integer(w, "bytes", s->bytes, s->bytes >= 0);
	write_text(w, "log", s->log);
	write_text(w, "on", s->on || w->brief ? s->on : "local");
	write_integer(w, "shards", stats_processes(s), s->shards > 1 || !w->brief);
	write_text(w, "partition", s->partition);
	write_text(w, "account", s->account);
	write_text(w, "time", s->time);
	write_integer(w, "priority", s->priority, s->priority || !w->brief);
	write_integer(w, "done", s->done, s->total > 0);
	write_integer(w, "total", s->total, s->total > 0);
	write_text(w, "phase", s->phase);
	write_ids(w, "after", s->after, s->n_after);
	write_ids(w, "after_any", s->after_any, s->n_after_any);
	write_number(w, "wall_limit_s", s->wall_limit_s > 0 ? s->wall_limit_s : NAN);
	write_integer(w, "umask", s->umask, s->umask >= 0);
	write_value(w, "parameters", s->parameters);
	write_text(w, "output", s->output);
	write_integer(w, "threads", s->threads, s->threads > 0);
	write_integer(w, "memory_mib", s->memory_mib, s->memory_mib > 0);
	if (write_key(w, "force", s->force || !w->brief))
		text_add(w->t, s->force ? "true" : "false");
	write_number(w, "submitted", s->submitted > 0 ? s->submitted : NAN);
	write_number(w, "started", s->started > 0 ? s->started : NAN);
	write_number(w, "ended", s->ended > 0 ? s->ended : NAN);
	text_add(w->t, "}");
}

void stats_write(struct text *t, const struct Stats *s)
{
	write_all(&(struct writer){ .t = t }, s);
}

void stats_write_brief(struct text *t, const struct Stats *s)
{
	write_all(&(struct writer){ .t = t, .brief = true }, s);
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
		s->outputs[i].figures =
		        json_is_object(figures) ? json_incref((json_t *)figures) : NULL;
		if (!s->outputs[i].path)
			return ST_INPUT;
	}
	return ST_OK;
}

static enum status read_ids(int64_t **ids, int *n, const json_t *a, bool *failed)
{
	*ids = array((int)json_array_size(a), sizeof **ids, failed);
	*n = *ids ? (int)json_array_size(a) : 0;
	for (int i = 0; i < *n; i++) {
		const json_t *id = json_array_get(a, (size_t)i);
		if (!json_is_integer(id))
			return ST_INPUT;
		(*ids)[i] = json_integer_value(id);
	}
	return ST_OK;
}

static enum status read_lists(struct Stats *s, const json_t *o, bool *failed)
{
	enum status st = read_inputs(s, json_object_get(o, "inputs"), failed);
	if (st == ST_OK)
		st = read_outputs(s, json_object_get(o, "outputs"), failed);
	if (st == ST_OK)
		st = read_ids(&s->after, &s->n_after, json_object_get(o, "after"), failed);
	if (st == ST_OK)
		st = read_ids(&s->after_any, &s->n_after_any, json_object_get(o, "after_any"),
		              failed);
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
	s->on = duplicate(json_text(o, "on", NULL), &failed);
	s->shards = (int)json_int(o, "shards", 0);
	s->partition = duplicate(json_text(o, "partition", NULL), &failed);
	s->account = duplicate(json_text(o, "account", NULL), &failed);
	s->time = duplicate(json_text(o, "time", NULL), &failed);
	s->wall_limit_s = json_number(o, "wall_limit_s", 0);
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
	s->bytes = json_int(o, "bytes", -1);
	s->threads = (int)json_int(o, "threads", 0);
	s->memory_mib = json_int(o, "memory_mib", 0);
	s->umask = (int)json_int(o, "umask", -1);
	s->force = json_flag(o, "force", false);
	const json_t *parameters = json_object_get(o, "parameters");
	s->parameters =
	        json_is_object(parameters) ? json_incref((json_t *)parameters) : json_object();
	enum status st = read_lists(s, o, &failed);
	if (failed || !s->parameters)
		st = ST_RESOURCE;
	else if (s->state == N_JOB_STATES)
		st = ST_INPUT;
	if (st != ST_OK)
		stats_finish(s);
	return st;
}
