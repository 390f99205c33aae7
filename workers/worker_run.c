/* worker_run.c - the life of a computation: begin, missing units on all threads, finish. */
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "parallel.h"
#include "path.h"
#include "worker_private.h"

/* Units done before the room is judged: one of so many, so many at most. */
enum { SAMPLE_SHARE = 16, SAMPLE_MAX = 64 };

static void run_say(void *data, enum report_level level, enum status st, const char *text)
{
	struct run *run = data;
	if (level != REPORT_ERROR) {
		run->front->note(run->front->data, level, text);
		return;
	}
	pthread_mutex_lock(&run->lock);
	if (!*run->errors[st])
		snprintf(run->errors[st], sizeof run->errors[st], "%s", text);
	pthread_mutex_unlock(&run->lock);
}

void run_init(struct run *run, const struct front *front)
{
	*run = (struct run){ .front = front, .report = { run_say, run } };
	atomic_init(&run->stop, false);
	pthread_mutex_init(&run->lock, NULL);
	meter_init(&run->meter, front);
}

enum status run_add_temp(struct run *run, const char *path)
{
	enum status st = ST_RESOURCE;
	pthread_mutex_lock(&run->lock);
	char **temps = realloc(run->temps, (run->n_temps + 1) * sizeof *temps);
	if (temps) {
		run->temps = temps;
		temps[run->n_temps] = strdup(path);
		if (temps[run->n_temps]) {
			run->n_temps++;
			st = ST_OK;
		}
	}
	pthread_mutex_unlock(&run->lock);
	return st;
}

void run_drop_temp(struct run *run, const char *path)
{
	pthread_mutex_lock(&run->lock);
	for (size_t i = 0; i < run->n_temps; i++) {
		if (strcmp(run->temps[i], path) == 0) {
			free(run->temps[i]);
			run->temps[i] = run->temps[--run->n_temps];
			break;
		}
	}
	pthread_mutex_unlock(&run->lock);
}

void run_leave(struct run *run, int exit_status)
{
	pthread_mutex_lock(&run->lock);
	for (size_t i = 0; i < run->n_temps; i++)
		unlink(run->temps[i]);
	_exit(exit_status);
}

/* ---- what workers call ---- */

enum status work_put(struct work *w, size_t unit, const void *bytes, size_t n)
{
	enum status st = part_put(w->private->part, unit, bytes, n, &w->report);
	const struct front *front = w->private->run->front;
	if (st == ST_OK)
		front->unit(front->data, unit);
	return st;
}

enum status work_read(struct work *w, size_t unit, struct text *bytes)
{
	return part_read(w->private->part, unit, bytes, &w->report);
}

enum status work_read_end(struct work *w, size_t unit, void *to, size_t n)
{
	return part_read_end(w->private->part, unit, to, n, &w->report);
}

enum status work_get(struct work *w, size_t unit, const char **bytes, size_t *n)
{
	return part_get(w->private->part, unit, bytes, n, &w->report);
}

bool work_cancelled(const struct work *w)
{
	return atomic_load_explicit(&w->private->run->stop, memory_order_relaxed);
}

void work_phase(struct work *w, const char *phase, size_t done, size_t total)
{
	struct work_private *p = w->private;
	char text[sizeof p->run->meter.phase];
	int percent = total ? (int)(100.0 * (double)done / (double)total) : 0;
	if (total)
		snprintf(text, sizeof text, "%s %d %%", phase, percent);
	else
		snprintf(text, sizeof text, "%s", phase);
	meter_set(&p->run->meter, text, atomic_load(&p->n_done), p->n_units);
}

/* ---- units ---- */

struct missing {
	struct work *work;
	size_t *units; /* owned */
	size_t n;
};

static enum status do_unit(void *data, size_t i, int thread)
{
	(void)thread;
	struct missing *m = data;
	struct work *w = m->work;
	struct work_private *p = w->private;
	if (work_cancelled(w))
		return ST_CANCELLED;
	enum status st = worker.unit(w, m->units[i]);
	if (st != ST_OK)
		return st;
	if (!part_has(p->part, m->units[i]))
		return report_error(&w->report, ST_INTERNAL, "worker %s gave no bytes for unit %zu",
		                    worker.name, m->units[i]);
	size_t done = atomic_fetch_add(&p->n_done, 1) + 1;
	meter_set(&p->run->meter, "computing", done, p->n_units);
	return ST_OK;
}

static bool mine(const struct task *t, size_t unit)
{
	return t->n_shards == 0 || unit % t->n_shards == t->shard;
}

/* Some from all over come first: what they take tells what all will. */
static size_t spread_first(struct missing *m)
{
	size_t n = m->n / SAMPLE_SHARE;
	if (n > SAMPLE_MAX)
		n = SAMPLE_MAX;
	for (size_t i = 0; i < n; i++) {
		size_t from = i * (m->n / n), unit = m->units[from];
		memmove(m->units + i + 1, m->units + i, (from - i) * sizeof *m->units);
		m->units[i] = unit;
	}
	return n;
}

static enum status do_missing(struct work *w, const struct missing *m, size_t from, size_t n)
{
	struct missing some = { .work = w, .units = m->units + from, .n = n };
	return n ? parallel_run(w->threads, n, &w->private->run->stop, do_unit, &some) : ST_OK;
}

static enum status do_units(struct work *w, const char *part)
{
	struct work_private *p = w->private;
	size_t n_mine = 0;
	struct missing m = { .work = w, .units = calloc(p->n_units, sizeof *m.units) };
	if (!m.units)
		return ST_RESOURCE;
	for (size_t unit = 0; unit < p->n_units; unit++) {
		if (!mine(p->task, unit))
			continue;
		n_mine++;
		if (!part_has(p->part, unit))
			m.units[m.n++] = unit;
	}
	if (n_mine > m.n)
		report_info(&w->report, "going on: %zu of %zu units are there", n_mine - m.n,
		            n_mine);
	p->n_units = n_mine;
	atomic_store(&p->n_done, n_mine - m.n);
	meter_set(&p->run->meter, "computing", n_mine - m.n, n_mine);
	size_t first = room_is_ample(w, part) ? 0 : spread_first(&m);
	enum status st = do_missing(w, &m, 0, first);
	if (st == ST_OK)
		st = room_check(w, part, m.n - first);
	if (st == ST_OK)
		st = do_missing(w, &m, first, m.n - first);
	free(m.units);
	return st;
}

static enum status open_part(struct work *w, const char *path)
{
	struct work_private *p = w->private;
	char *key = attributes_key(w);
	if (!key)
		return ST_RESOURCE;
	p->in_place = p->in_place && p->task->n_shards == 0;
	enum status st = (p->in_place ? part_open_ordered : part_open)(&p->part, path, key,
	                                                               p->n_units, &w->report);
	free(key);
	/* a shard without units left no file; what one should have left and did not is done here */
	for (int i = 0; st == ST_OK && i < p->task->n_parts; i++)
		if (path_exists(p->task->parts[i]))
			st = part_merge(p->part, p->task->parts[i], &w->report);
	return st;
}

static void discard_parts(const struct task *t)
{
	for (int i = 0; i < t->n_parts; i++)
		part_discard(t->parts[i]);
}

/* ---- one computation ---- */

static void tell_results(struct work *w)
{
	struct work_private *p = w->private;
	const struct front *front = p->run->front;
	for (int i = 0; i < p->n_pending; i++) {
		const struct pending *made = &p->pending[i];
		const struct result result = { made->path, made->row->kind, p->figures, false };
		front->result(front->data, &result);
	}
}

static enum status tell_up_to_date(struct work *w, const json_t *figures)
{
	const struct front *front = w->private->run->front;
	for (const struct worker_output *row = worker.outputs; row->extension; row++) {
		if (!output_wanted(w, row))
			continue;
		char *path = output_path(w, row);
		if (!path)
			return ST_RESOURCE;
		if (row == worker.outputs)
			report_info(&w->report, "'%s' is up to date; --force makes it again", path);
		front->result(front->data, &(struct result){ path, row->kind, figures, true });
		free(path);
	}
	return ST_OK;
}

static enum status finish(struct work *w)
{
	struct work_private *p = w->private;
	meter_set(&p->run->meter, "writing", p->n_units, p->n_units);
	enum status st = worker.finish(w);
	if (st == ST_OK && work_cancelled(w))
		st = ST_CANCELLED;
	if (st == ST_OK)
		st = outputs_commit(w);
	if (st != ST_OK)
		return st;
	tell_results(w);
	part_remove(p->part);
	p->part = NULL;
	discard_parts(p->task);
	return ST_OK;
}

static enum status compute(struct work *w, const char *part)
{
	struct work_private *p = w->private;
	meter_set(&p->run->meter, "preparing", 0, 0);
	enum status st = worker.begin(w);
	if (st == ST_OK)
		p->n_units = worker.units(w);
	if (st == ST_OK && p->n_units == 0)
		st = report_error(&w->report, ST_INTERNAL, "worker %s has no units", worker.name);
	if (st == ST_OK)
		st = open_part(w, part);
	if (st == ST_OK)
		st = do_units(w, part);
	if (st == ST_OK && p->task->n_shards == 0)
		st = room_check(w, part, 0);
	if (st == ST_OK && p->task->n_shards == 0)
		st = finish(w);
	if (st == ST_CANCELLED && p->part && part_count(p->part) > 0)
		report_error(&w->report, st, "cancelled; %zu of %zu units are kept in '%s'",
		             part_count(p->part), p->n_units, part);
	outputs_abandon(w);
	if (p->part && part_count(p->part) == 0)
		part_remove(p->part); /* nothing to go on from */
	else
		part_close(p->part);
	if (worker.end)
		worker.end(w);
	return st;
}

/* Where no one names a part file it stands beside the output; its lock keeps two runs apart. */
static char *part_path(const struct work *w)
{
	const struct work_private *p = w->private;
	if (p->task->part)
		return strdup(p->task->part);
	const char *base = p->computation->base, *name = path_file_name(base);
	char end[64];
	snprintf(end, sizeof end, "%s.part", worker.outputs[0].extension);
	/* what comes before its turn has a longer name */
	size_t longest = NAME_MAX - strlen(".ahead");
	char *brief = strlen(name) + strlen(end) > longest ? path_brief_name(name) : strdup(name);
	char *part = brief ? text_print("%.*s%s%s", (int)(name - base), base, brief, end) : NULL;
	free(brief);
	return part;
}

static enum status do_computation(struct run *run, const struct task *t,
                                  const struct computation *c)
{
	struct work_private private = { .run = run, .task = t, .computation = c };
	struct work w = { .worker = &worker,
		          .surfaces = c->surfaces,
		          .entities = c->entities,
		          .n_surfaces = c->n,
		          .file_unit = c->unit,
		          .threads = t->threads ? t->threads : parallel_processors(),
		          .memory = t->memory_mib << 20,
		          .report = run->report,
		          .private = &private };
	json_t *figures = NULL;
	char *part = part_path(&w);
	enum status st = part ? attributes_make(&w) : ST_RESOURCE;
	if (st == ST_OK && !t->force && outputs_up_to_date(&w, &figures)) {
		part_discard(part);
		discard_parts(t);
		if (t->n_shards == 0)
			st = tell_up_to_date(&w, figures);
	} else if (st == ST_OK) {
		st = outputs_check(&w);
		if (st == ST_OK)
			st = compute(&w, part);
	}
	json_decref(figures);
	json_decref(private.figures);
	attributes_finish(&private);
	free(part);
	return st;
}

/* Say why it failed: the sentence of where it happened, or one for its class. */
static void tell_error(struct run *run, enum status st)
{
	char text[1024];
	pthread_mutex_lock(&run->lock);
	if (*run->errors[st])
		snprintf(text, sizeof text, "%s", run->errors[st]);
	else if (st == ST_RESOURCE)
		snprintf(text, sizeof text,
		         "memory ran out while %s; take fewer threads (--threads), allow more "
		         "(--memory), or ask for less",
		         *run->meter.phase ? run->meter.phase : "beginning");
	else
		snprintf(text, sizeof text, "%s", status_text(st));
	memset(run->errors, 0, sizeof run->errors);
	pthread_mutex_unlock(&run->lock);
	run->front->error(run->front->data, st, text);
}

enum status run_task(struct run *run, const struct task *t)
{
	struct inputs in;
	enum status first = inputs_read(&in, run, t);
	if (first != ST_OK) {
		tell_error(run, first);
		return first;
	}
	for (int i = 0; i < in.n && first != ST_CANCELLED; i++) {
		enum status st = do_computation(run, t, &in.list[i]);
		if (st == ST_OK)
			continue;
		tell_error(run, st);
		if (first == ST_OK || st == ST_CANCELLED)
			first = st;
	}
	inputs_finish(&in);
	return first;
}
