/* slurm.c - the launcher of workers on a cluster: srun carries their packets, scancel their signals. */
#include "slurm.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "json.h"
#include "local.h"
#include "path.h"
#include "shard.h"
#include "slurm_order.h"
#include "slurm_end.h"
#include "slurm_job.h"

enum { BURY_MS = 5000, BURY_LOOKS = 20, BURY_LOOK_MS = 150, WORDS_MAX = 16384, HASH_SHOWN = 12 };

struct slurm_job *slurm_job(const struct slurm *s, int64_t id)
{
	struct slurm_job *j = s->jobs;
	while (j && j->id != id)
		j = j->next;
	return j;
}

/* "batten-HASH-12-3" */
static char *name_of(const struct slurm *s, int64_t id)
{
	int shard = shard_of(id);
	long long job = shard_job(id);
	if (shard < 0)
		return text_print("%s%lld", s->prefix, job);
	return text_print("%s%lld-%d", s->prefix, job, shard);
}

/* ---- the command ---- */

struct words {
	char **list; /* owned */
	size_t n;
	bool failed;
};

/* Takes word over; NULL counts as no memory. */
static void word_add(struct words *w, char *word)
{
	if (!word || w->n >= SPAWN_WORDS) {
		free(word);
		w->failed = true;
		return;
	}
	w->list[w->n++] = word;
}

static void option_add(struct words *w, const char *option, const char *own, const char *setting)
{
	const char *value = own && *own ? own : setting;
	if (value && *value)
		word_add(w, text_print("--%s=%s", option, value));
}

static void options_add(struct words *w, const char *options)
{
	for (const char *p = options + strspn(options, " "); *p; p += strspn(p, " ")) {
		size_t n = strcspn(p, " ");
		word_add(w, strndup(p, n));
		p += n;
	}
}

static enum status slurm_words(void *data, const struct Stats *stats, const char *worker,
                               char ***out, const struct report *r)
{
	const struct slurm *s = data;
	struct words w = { .list = calloc(SPAWN_WORDS + 1, sizeof *w.list) };
	char *name = name_of(s, stats->id);
	if (!w.list || !name) {
		free(name);
		free(w.list);
		return report_error(r, ST_RESOURCE, "out of memory");
	}
	word_add(&w, strdup(s->srun));
	word_add(&w, strdup("--quiet"));
	word_add(&w, strdup("--unbuffered"));
	word_add(&w, strdup("--nodes=1"));
	word_add(&w, strdup("--ntasks=1"));
	word_add(&w, text_print("--job-name=%s", name));
	word_add(&w, text_print("--cpus-per-task=%d", stats->threads > 0 ? stats->threads : 1));
	word_add(&w, text_print("--chdir=%s", s->project->folder));
	if (stats->memory_mib > 0)
		word_add(&w, text_print("--mem=%lldM", (long long)stats->memory_mib));
	option_add(&w, "partition", stats->partition, s->settings->value[SETTING_SLURM_PARTITION]);
	option_add(&w, "account", stats->account, s->settings->value[SETTING_SLURM_ACCOUNT]);
	option_add(&w, "time", stats->time, s->settings->value[SETTING_SLURM_TIME]);
	options_add(&w, s->settings->value[SETTING_SLURM_OPTIONS]);
	word_add(&w, strdup(worker));
	free(name);
	if (w.failed) {
		local_words_free(w.list);
		return report_error(r, ST_RESOURCE,
		                    "cannot put the srun command together: too many "
		                    "slurm-options, or out of memory");
	}
	*out = w.list;
	return ST_OK;
}

/* ---- from above ---- */

static enum status slurm_check(void *data, const struct Stats *stats, const struct report *r)
{
	const struct slurm *s = data;
	if (!s->srun)
		return report_error(r, ST_RESOURCE,
		                    "cannot run on Slurm: there is no 'srun' in PATH; install "
		                    "Slurm's programs or use --on local");
	return s->below->check(s->below->data, stats, r);
}

/* The srun of a dead service is gone; what it asked for may still be in the queue or on a node, and
 * two must not write one part file. */
static void slurm_bury(void *data, const struct Stats *stats)
{
	const struct slurm *s = data;
	struct text names = { 0 };
	int64_t id = shard_job(stats->id);
	for (int i = -1; i < (stats->shards > 1 ? stats->shards : 0); i++) {
		char *name = name_of(s, i < 0 ? id : shard_id(id, i));
		text_addf(&names, "%s%s", names.n ? "," : "--name=", name ? name : "");
		free(name);
	}
	char cancel[] = "scancel", quiet[] = "--quiet", queue[] = "squeue", bare[] = "--noheader",
	     option[] = "-o", format[] = "%i";
	char *cancels[] = { cancel, quiet, names.s, NULL };
	char *looks[] = { queue, bare, option, format, names.s, NULL };
	bool left = s->srun && !names.failed && order_wait(cancels, BURY_MS, NULL);
	for (int i = 0; i < BURY_LOOKS && left; i++) {
		if (i)
			poll(NULL, 0, BURY_LOOK_MS);
		left = order_wait(looks, BURY_MS, &left) && left;
	}
	text_finish(&names);
}

static enum status slurm_start(void *data, struct Stats *stats, const struct report *r)
{
	struct slurm *s = data;
	struct slurm_job *j = calloc(1, sizeof *j);
	struct stat log;
	enum status st = ST_RESOURCE;
	if (j) {
		j->name = name_of(s, stats->id);
		j->log = shard_path(s->project, "logs", shard_job(stats->id), ".log");
	}
	if (j && j->name && j->log) {
		/* before it starts: srun may have said its last words when start returns */
		j->log_from = stat(j->log, &log) ? 0 : log.st_size;
		st = s->below->start(s->below->data, stats, r);
	} else {
		report_error(r, st, "out of memory");
	}
	if (st != ST_OK) {
		if (j) {
			free(j->name);
			free(j->log);
		}
		free(j);
		return st;
	}
	j->id = stats->id;
	j->next = s->jobs;
	s->jobs = j;
	slurm_look_soon(s);
	return ST_OK;
}

/* One that has no process on a node yet hears nothing: it is taken out of Slurm's queue. */
static enum status slurm_send(void *data, int64_t id, enum message_type type, const json_t *body)
{
	struct slurm *s = data;
	struct slurm_job *j = slurm_job(s, id);
	if (type == MESSAGE_CANCEL && j && !j->greeted) {
		slurm_want(s, j, WANT_END);
		return ST_OK;
	}
	return s->below->send(s->below->data, id, type, body);
}

static void slurm_signal(void *data, int64_t id, enum launcher_signal signal)
{
	static const enum slurm_want wants[] = {
		[LAUNCHER_STOP] = WANT_STOP,
		[LAUNCHER_CONTINUE] = WANT_GO,
		[LAUNCHER_TERMINATE] = WANT_END,
		[LAUNCHER_KILL] = WANT_END,
	};
	struct slurm *s = data;
	struct slurm_job *j = slurm_job(s, id);
	if (!j)
		return;
	slurm_want(s, j, wants[signal]);
	if (signal == LAUNCHER_KILL) {
		j->killed = true;
		s->below->signal(s->below->data, id, signal); /* srun takes the worker along */
	}
}

static void slurm_note(void *data, int64_t id, const char *level, const char *text)
{
	struct slurm *s = data;
	s->below->note(s->below->data, id, level, text);
}

static const char *slurm_job_file(void *data, int64_t id)
{
	struct slurm *s = data;
	return s->below->job_file(s->below->data, id);
}

static void slurm_forget(void *data, int64_t id)
{
	struct slurm *s = data;
	struct slurm_job **at = &s->jobs;
	s->below->forget(s->below->data, id);
	while (*at && (*at)->id != id)
		at = &(*at)->next;
	struct slurm_job *j = *at;
	if (!j)
		return;
	*at = j->next;
	free(j->name);
	free(j->log);
	free(j);
}

/* ---- from below: what srun carried, and srun's own end ---- */

static void on_packet(void *data, int64_t id, const struct message *m)
{
	struct slurm *s = data;
	struct slurm_job *j = slurm_job(s, id);
	if (j && m->type == MESSAGE_HELLO) {
		j->greeted = j->running = true;
		j->number = json_int(m->body, "slurm_job", j->number);
	}
	if (j && m->type == MESSAGE_DONE)
		j->finished = true;
	s->sink.packet(s->sink.data, id, m);
}

static void on_broken(void *data, int64_t id, const char *reason)
{
	struct slurm *s = data;
	s->sink.broken(s->sink.data, id, reason);
}

static void on_drained(void *data, int64_t id)
{
	struct slurm *s = data;
	s->sink.drained(s->sink.data, id);
}

/* The end of what the log got in this run. Fresh. */
static char *last_words(const struct slurm_job *j)
{
	char *text = calloc(WORDS_MAX + 1, 1);
	struct stat log;
	int fd = text ? open(j->log, O_RDONLY | O_CLOEXEC) : -1;
	off_t from = j->log_from;
	if (fd >= 0 && !fstat(fd, &log)) {
		from = log.st_size < from ? 0 : from; /* it was cut */
		from = log.st_size - from > WORDS_MAX ? log.st_size - WORDS_MAX : from;
		ssize_t n = pread(fd, text, WORDS_MAX, from);
		text[n > 0 ? n : 0] = '\0';
	}
	if (fd >= 0)
		close(fd);
	return text;
}

static void on_exited(void *data, int64_t id, const struct launcher_exit *srun)
{
	struct slurm *s = data;
	struct slurm_job *j = slurm_job(s, id);
	struct launcher_exit e = *srun;
	bool good = j && j->finished && !e.status && !e.signal;
	bool ours = j && (j->killed || j->want == WANT_END);
	bool heard = !j || j->want != WANT_END || j->is == WANT_END;
	char *words = j && !good && !ours ? last_words(j) : NULL;
	slurm_end(&e, words ? words : "");
	free(words);
	if (good || ours) {
		e.lost = false;
		e.why[0] = '\0';
	}
	if (j && (e.lost || (!heard && !good)))
		slurm_sweep(s, j, &e);
	else
		s->sink.exited(s->sink.data, id, &e);
}

/* srun itself was stopped or goes on: the worker was not. */
static void on_stopped(void *data, int64_t id, bool stopped)
{
	(void)data;
	(void)id;
	(void)stopped;
}

static void on_waits(void *data, int64_t id, const char *reason)
{
	struct slurm *s = data;
	s->sink.waits(s->sink.data, id, reason);
}

/* ---- life ---- */

static char *srun_find(void)
{
	const char *path = getenv("PATH");
	char *found = NULL;
	for (const char *p = path ? path : ""; *p && !found; p += strspn(p, ":")) {
		size_t n = strcspn(p, ":");
		found = text_print("%.*s/srun", (int)n, p);
		if (found && access(found, X_OK)) {
			free(found);
			found = NULL;
		}
		p += n;
	}
	return found;
}

enum status slurm_create(struct slurm **out, uv_loop_t *loop, const struct project *p,
                         const struct settings *settings, const struct report *r)
{
	struct slurm *s = calloc(1, sizeof *s);
	if (!s)
		return report_error(r, ST_RESOURCE, "out of memory");
	s->project = p;
	s->settings = settings;
	s->srun = srun_find();
	s->prefix = text_print("batten-%.*s-", HASH_SHOWN, path_file_name(p->socket));
	enum status st = s->prefix ? orders_create(&s->orders, loop) : ST_RESOURCE;
	if (st == ST_OK)
		st = local_create(&s->local, loop, p, 0, r);
	if (st != ST_OK) {
		slurm_destroy(s);
		return st;
	}
	/* a service within an allocation starts jobs of their own, no steps of that one */
	unsetenv("SLURM_JOB_ID");
	unsetenv("SLURM_JOBID");
	local_wrap(s->local, slurm_words, s);
	local_connect(s->local, (struct launcher_sink){ .data = s,
	                                                .packet = on_packet,
	                                                .broken = on_broken,
	                                                .drained = on_drained,
	                                                .exited = on_exited,
	                                                .stopped = on_stopped,
	                                                .waits = on_waits });
	s->below = local_launcher(s->local);
	s->launcher = (struct launcher){
		.data = s,
		.check = slurm_check,
		.bury = slurm_bury,
		.start = slurm_start,
		.send = slurm_send,
		.signal = slurm_signal,
		.note = slurm_note,
		.job_file = slurm_job_file,
		.forget = slurm_forget,
	};
	uv_timer_init(loop, &s->look);
	uv_timer_init(loop, &s->sweep);
	uv_timer_init(loop, &s->again);
	s->look.data = s->sweep.data = s->again.data = s;
	*out = s;
	return ST_OK;
}

const struct launcher *slurm_launcher(struct slurm *s)
{
	return &s->launcher;
}

void slurm_connect(struct slurm *s, struct launcher_sink sink)
{
	s->sink = sink;
}

void slurm_close(struct slurm *s)
{
	while (s->jobs) {
		slurm_cancel(s,
		             s->jobs); /* an srun killed while it waits leaves a ghost in Slurm */
		slurm_forget(s, s->jobs->id);
	}
	uv_close((uv_handle_t *)&s->look, NULL);
	uv_close((uv_handle_t *)&s->sweep, NULL);
	uv_close((uv_handle_t *)&s->again, NULL);
	orders_close(s->orders);
	local_close(s->local);
}

void slurm_destroy(struct slurm *s)
{
	if (!s)
		return;
	orders_destroy(s->orders);
	local_destroy(s->local);
	free(s->srun);
	free(s->prefix);
	free(s);
}
