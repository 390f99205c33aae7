/* work.c - jobs that routines start: what they read, their parameters, and their end. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base.h"
#include "hash.h"
#include "json.h"
#include "path.h"
#include "private.h"
#include "work_order.h"

enum { SCENE_NAME_MAX = 64 };
enum { LOOK_MS = 200 }; /* how often the wish to stop is looked at */

json_t *work_parameters(const struct arguments *given)
{
	json_t *o = json_object();

	for (int k = 0; k < given->n; k++)
		if (strcmp(given->name[k], "wait") && strcmp(given->name[k], "surfaces"))
			json_set_text(o, given->name[k], given->value[k]);
	return o;
}

/* A thing as a job's input, as text. */
static enum status thing_text(const struct world *w, int id, struct text *t)
{
	struct model m;
	enum status st = world_model(w, &id, 1, &m, NULL);

	if (st != ST_OK)
		return st;
	base_format_entity(&m, &m.entities[0], t);
	model_finish(&m);
	return t->failed ? ST_RESOURCE : ST_OK;
}

enum status work_hash(const struct world *w, const int *ids, int n, char out[33])
{
	struct text all = { 0 };
	enum status st = ST_OK;

	for (int k = 0; k < n && st == ST_OK; k++) {
		struct text one = { 0 };
		st = thing_text(w, ids[k], &one);
		if (st == ST_OK)
			hash_bytes(one.s, one.n, out);
		text_add_bytes(&all, out, HASH_SIZE - 1);
		text_finish(&one);
	}
	if (st == ST_OK && n > 1)
		hash_bytes(all.s, all.n, out);
	if (all.failed)
		st = ST_RESOURCE;
	text_finish(&all);
	return st;
}

/* Of several: their names; of many, whose names would be too long, the first one's, how many there are, and
 * what tells these from others. */
static char *scene_name(const struct world *w, const int *ids, int n)
{
	struct text all = { 0 };
	char hash[HASH_SIZE] = "";

	for (int k = 0; k < n; k++)
		text_addf(&all, "%s%s", k ? "+" : "", world_by_id(w, ids[k])->name);
	if (all.n > SCENE_NAME_MAX) {
		hash_bytes(all.s, all.n, hash);
		text_finish(&all);
		text_addf(&all, "%.*s+%d-%.8s", SCENE_NAME_MAX / 2, world_by_id(w, ids[0])->name,
		          n - 1, hash);
	}
	return text_take(&all);
}

char *work_name(const struct act *a, const int *ids, int n, const char *suffix)
{
	char *base = scene_name(a->world, ids, n);
	char *name = base ? text_print("%s%s", base, suffix ? suffix : "") : NULL;
	char *path = name ? path_join(world_folder(a->world), name) : NULL;
	free(base);
	free(name);
	return path;
}

int work_scene(struct act *a, int **ids)
{
	const struct Ful *current = world_current(a->world, false);
	int n = 0;

	*ids = calloc((size_t)world_count(a->world) + 1, sizeof **ids);
	if (!*ids) {
		act_memory(a);
		return 0;
	}
	for (int k = 0; k < world_count(a->world); k++) {
		const struct Ful *f = world_at(a->world, k);
		if (ful_is_surface(f) && f->display.on)
			(*ids)[n++] = f->id;
	}
	if (!n && current)
		(*ids)[n++] = current->id;
	if (!n)
		act_current(a, false);
	return n;
}

int work_meant(struct act *a, const struct arguments *given, int **ids)
{
	const char *which = argument_text(given, "surfaces");
	const struct Ful *f;

	if (which && !strcmp(which, "shown"))
		return work_scene(a, ids);
	f = act_current(a, false);
	*ids = f ? malloc(sizeof **ids) : NULL;
	if (f && !*ids)
		act_memory(a);
	if (!*ids)
		return 0;
	**ids = f->id;
	return 1;
}

/* Keep each thing as jobs read it. */
static enum status make_inputs(struct act *a, const int *ids, int n, struct work_input *inputs)
{
	enum status st = ST_OK;

	for (int k = 0; k < n && st == ST_OK; k++) {
		const struct Ful *f = world_by_id(a->world, ids[k]);
		struct text t = { 0 };
		char *path = NULL;
		st = thing_text(a->world, ids[k], &t);
		if (st == ST_OK)
			st = work_input_keep(a->project->hidden, &t, &path, &a->report);
		text_finish(&t);
		inputs[k] = (struct work_input){
			.path = path,
			.file_name = f->name,
			.path_name = f->file ? f->file : world_folder(a->world),
			.alone = true,
		};
	}
	return st;
}

/* A job that is being waited for. */
struct waiting {
	struct act *act;
	int64_t id; /* 0: the service has taken none yet */
	struct Stats last;
	bool known, failed;
};

static bool take_new(void *data, const struct Stats *s)
{
	struct waiting *x = data;
	struct act *a = x->act;

	x->id = s->id;
	if (a->n_jobs < (int)(sizeof a->jobs / sizeof *a->jobs))
		a->jobs[a->n_jobs++] = s->id;
	return true;
}

static bool take_news(void *data, const struct Stats *s)
{
	struct waiting *x = data;
	const double fraction = stats_fraction(s);

	if (s->id != x->id)
		return true;
	if (x->known)
		stats_finish(&x->last);
	x->known = stats_copy(&x->last, s) == ST_OK;
	x->failed |= !x->known;
	if (x->act->progress && fraction == fraction)
		x->act->progress(x->act->data, fraction, s->phase ? s->phase : s->worker);
	return true;
}

static json_t *id_json(const struct waiting *x)
{
	return json_pack("{s:[I]}", "jobs", (json_int_t)x->id);
}

enum status work_ask(struct act *a, enum message_type type, json_t *body, client_job *on_job,
                     void *data)
{
	struct client *c = NULL;
	enum status st = project_make(a->project, &a->report);

	if (st == ST_OK)
		st = client_connect(&c, a->project, true, &a->report);
	if (st == ST_OK)
		st = client_request(c, type, body, on_job, NULL, data, &a->report);
	else
		json_decref(body);
	client_close(c);
	return st;
}

/* The user wants it to end: the job is killed, on a connection of its own. */
static enum status give_up(const struct waiting *x)
{
	work_ask(x->act, MESSAGE_KILL, id_json(x), NULL, NULL);
	return report_error(&x->act->report, ST_CANCELLED, "job %lld was stopped",
	                    (long long)x->id);
}

static enum status watch(struct client *c, struct waiting *x)
{
	struct act *a = x->act;
	bool ended = false, gone = false;
	enum status st = client_send(c, MESSAGE_WATCH, id_json(x), &a->report);

	while (st == ST_OK && !ended) {
		if (a->stop && atomic_load(a->stop))
			return give_up(x);
		st = client_listen(c, LOOK_MS, -1, take_news, x, &ended, &gone, &a->report);
	}
	if (st == ST_OK && x->failed)
		st = act_memory(a);
	if (st == ST_OK && (gone || !x->known || !job_state_table[x->last.state].over))
		st = report_error(&a->report, ST_RESOURCE,
		                  "the service went away; batten jobs starts it again and the job "
		                  "goes on");
	return st;
}

/* How it ended, as a status and a sentence. */
static enum status judge(const struct act *a, const struct Stats *s)
{
	if (s->state == JOB_DONE)
		return ST_OK;
	return report_error(&a->report, s->state == JOB_KILLED ? ST_CANCELLED : ST_INPUT,
	                    "job %lld (%s) %s: %s", (long long)s->id, s->worker,
	                    job_state_table[s->state].word,
	                    s->reason ? s->reason : "batten log says more");
}

static enum status send_and_wait(struct act *a, const struct work_order *o, struct work_done *out)
{
	struct client *c = NULL;
	struct waiting x = { .act = a };
	enum status st = client_connect(&c, a->project, true, &a->report);

	if (st == ST_OK)
		st = work_order_send(o, c, take_new, &x, &a->report);
	if (st == ST_OK && !x.id)
		st = report_error(&a->report, ST_INTERNAL, "the service took no job");
	if (st == ST_OK && a->wait)
		st = watch(c, &x);
	if (st == ST_OK && !a->wait) {
		json_t *body = id_json(&x);
		st = client_request(c, MESSAGE_LIST, body, take_news, NULL, &x, &a->report);
		if (st == ST_OK && !x.known)
			st = act_memory(a);
	}
	if (st == ST_OK && a->wait)
		st = judge(a, &x.last);
	client_close(c);
	if (st == ST_OK)
		out->job = x.last;
	else if (x.known)
		stats_finish(&x.last);
	return st;
}

enum status work_run(struct act *a, const char *worker, json_t *parameters, const int *ids, int n,
                     const char *suffix, struct work_done *out)
{
	struct work_input *inputs = calloc((size_t)n + 1, sizeof *inputs);
	char *name = work_name(a, ids, n, suffix);
	struct work_order o = { .worker = worker, .parameters = parameters, .output = name };
	enum status st = inputs && name ? project_make(a->project, &a->report) : act_memory(a);

	if (st == ST_OK)
		st = work_order_check(&o, a->project, &a->report);
	if (st == ST_OK && a->killed) {
		out->job = (struct Stats){ .state = JOB_KILLED };
		act_say(a, "%s: its job is not started, in the session it was killed",
		        a->routine->code);
		n = 0;
	} else if (st == ST_OK)
		st = make_inputs(a, ids, n, inputs);
	o.inputs = inputs;
	o.n_inputs = (size_t)n;
	if (st == ST_OK && !a->killed)
		st = send_and_wait(a, &o, out);
	for (int k = 0; k < n && inputs; k++)
		free((char *)inputs[k].path);
	free(inputs);
	free(name);
	work_order_finish(&o);
	return st;
}

void work_done_finish(struct work_done *d)
{
	stats_finish(&d->job);
}
