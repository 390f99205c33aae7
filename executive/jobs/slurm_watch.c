/* slurm_watch.c - Slurm's queue looked at, its jobs stopped, let go on and cancelled. */
#include <stdlib.h>
#include <string.h>

#include "number.h"
#include "slurm_order.h"
#include "slurm_end.h"
#include "slurm_job.h"
#include "text.h"

/* A look at Slurm's queue costs its controller a message: often at first, then rarely. */
enum {
	LOOK_FIRST_MS = 250,
	LOOK_LAST_MS = 10000,
	HELLO_MS = 30000,
	SWEEP_MS = 150,
	SWEEPS_MAX = 20,
	AGAIN_FIRST_MS = 100,
	AGAIN_LAST_MS = 1600,
	AGAIN_MAX = 12,
	AGAIN_MS = 60000 /* no longer than that, whatever each try takes */
};

static void on_sweep(uv_timer_t *t);

/* ---- looking ---- */

static bool is_waiting(const struct slurm_job *j)
{
	return !j->greeted;
}

static bool anybody_waits(const struct slurm *s)
{
	for (const struct slurm_job *j = s->jobs; j; j = j->next)
		if (is_waiting(j))
			return true;
	return false;
}

static struct slurm_job *job_named(const struct slurm *s, const char *name, size_t n)
{
	for (struct slurm_job *j = s->jobs; j; j = j->next)
		if (strlen(j->name) == n && !strncmp(j->name, name, n))
			return j;
	return NULL;
}

/* Cut "a|b|c" at the bars; the number of fields. */
static int fields_cut(char *line, char **fields, int max)
{
	int n = 0;
	for (char *p = line; p && n < max;) {
		fields[n++] = p;
		p = strchr(p, '|');
		if (p)
			*p++ = '\0';
	}
	return n;
}

/* On a node and silent: a worker that says no HELLO is broken here as anywhere. */
static void job_runs(struct slurm *s, struct slurm_job *j)
{
	if (!j->running) {
		j->running = true;
		s->sink.waits(s->sink.data, j->id, NULL);
		return;
	}
	if ((uint64_t)++j->hello_looks * s->look_ms > HELLO_MS && j->want == WANT_GO)
		s->sink.broken(s->sink.data, j->id, "nothing, though it is on its node");
}

static void line_take(struct slurm *s, char *line)
{
	char *f[4] = { 0 };
	int64_t number;
	if (fields_cut(line, f, 4) < 4)
		return;
	struct slurm_job *j = job_named(s, f[0], strlen(f[0]));
	if (!j || j->greeted)
		return;
	if (number_parse_integer(f[1], &number))
		j->number = number;
	if (strcmp(f[2], "PENDING")) {
		job_runs(s, j);
		return;
	}
	char *reason = text_print("Slurm job %s waits: %s", f[1], slurm_reason(f[3]));
	if (reason)
		s->sink.waits(s->sink.data, j->id, reason);
	free(reason);
}

static void look_again(struct slurm *s);

static void on_queue(void *data, int64_t tag, int status, const char *output)
{
	struct slurm *s = data;
	char *text = status ? NULL : strdup(output);
	(void)tag;
	s->looking = false;
	for (char *line = text, *next; line && *line; line = next) {
		next = strchr(line, '\n');
		if (next)
			*next++ = '\0';
		line_take(s, line);
	}
	free(text);
	look_again(s);
}

static void on_look(uv_timer_t *t)
{
	struct slurm *s = t->data;
	char program[] = "squeue", bare[] = "--noheader", mine[] = "--me", option[] = "-o",
	     format[] = "%j|%i|%T|%r";
	char *argv[] = { program, bare, mine, option, format, NULL };
	for (const struct slurm_job *j = s->jobs; j && s->look_ms == LOOK_FIRST_MS; j = j->next)
		if (is_waiting(j) && !j->number)
			s->sink.waits(s->sink.data, j->id, "waits for Slurm");
	s->looking = !s->looking && order_run(s->orders, argv, on_queue, s, 0);
	if (!s->looking)
		look_again(s);
}

static void look_again(struct slurm *s)
{
	if (!anybody_waits(s) || s->looking)
		return;
	s->look_ms = s->look_ms * 2 > LOOK_LAST_MS ? LOOK_LAST_MS : s->look_ms * 2;
	uv_timer_start(&s->look, on_look, s->look_ms, 0);
}

void slurm_look_soon(struct slurm *s)
{
	s->look_ms = LOOK_FIRST_MS;
	if (!s->looking && !uv_is_active((uv_handle_t *)&s->look))
		uv_timer_start(&s->look, on_look, LOOK_FIRST_MS, 0);
}

/* ---- stopping, going on, ending ---- */

static void job_work(struct slurm *s, struct slurm_job *j);

static void on_again(uv_timer_t *t)
{
	struct slurm *s = t->data;
	for (struct slurm_job *j = s->jobs; j; j = j->next)
		job_work(s, j);
}

/* Slurm takes no signal while the one before is on its way to the node, and none at all while its
 * controller starts: the order is given again. False: often enough. */
static bool job_works_again(struct slurm *s, struct slurm_job *j)
{
	const uint64_t now = uv_now(s->again.loop);
	if (!j->refusals)
		j->refused_ms = now;
	if (j->refusals >= AGAIN_MAX || now - j->refused_ms >= AGAIN_MS)
		return false;
	uint64_t ms = (uint64_t)AGAIN_FIRST_MS << j->refusals++;
	if (!uv_is_active((uv_handle_t *)&s->again))
		uv_timer_start(&s->again, on_again, ms < AGAIN_LAST_MS ? ms : AGAIN_LAST_MS, 0);
	return true;
}

/* The order was refused often enough: as if it had not been given. */
static void job_stays(struct slurm *s, struct slurm_job *j)
{
	const enum slurm_want wanted = j->want;
	j->refusals = 0;
	if (wanted == WANT_END) {
		j->is = WANT_END; /* its end will be seen */
		return;
	}
	j->want = j->is;
	if (wanted == WANT_STOP)
		s->sink.refused(s->sink.data, j->id);
	else
		s->sink.stopped(s->sink.data, j->id, true);
}

static void on_worked(void *data, int64_t tag, int status, const char *output)
{
	struct slurm *s = data;
	int64_t id = tag >> 3;
	struct slurm_job *j = slurm_job(s, id);
	enum slurm_want did = tag & 3;
	bool hold = tag & 4;
	(void)output;
	if (!j)
		return;
	j->busy = false;
	if (status && did != WANT_END && hold) {
		j->running = true; /* it began meanwhile: it is stopped where it is */
	} else if (status && j->want == did) {
		if (job_works_again(s, j))
			return;
		s->below->note(s->below->data, id, "warning", "Slurm does not take the order");
		job_stays(s, j);
		return;
	} else if (status && j->want == j->is) {
		s->sink.stopped(s->sink.data, id, j->is == WANT_STOP); /* as if never asked */
	} else if (!status) {
		j->refusals = 0;
		j->held = hold && did == WANT_STOP;
		j->is = did;
		if (did != WANT_END)
			s->sink.stopped(s->sink.data, id, did == WANT_STOP);
	}
	j = slurm_job(s, id);
	if (j)
		job_work(s, j);
}

/* By number where it is known; a name lets the controller look at every job. */
static void job_work(struct slurm *s, struct slurm_job *j)
{
	char cancel[] = "scancel", control[] = "scontrol", hold[] = "hold", release[] = "release",
	     quiet[] = "--quiet", stop[] = "--signal=STOP", go[] = "--signal=CONT";
	if (j->busy || j->want == j->is || j->is == WANT_END)
		return;
	char *name = text_print("--name=%s", j->name), *jobname = text_print("jobname=%s", j->name);
	char *number = text_print("%lld", (long long)j->number);
	char *who = j->number ? number : name, *whom = j->number ? number : jobname;
	bool held = j->want == WANT_STOP ? !j->running : j->held;
	char *by_hold[] = { control, j->want == WANT_STOP ? hold : release, whom, NULL };
	char *by_signal[] = { cancel, quiet, j->want == WANT_STOP ? stop : go, who, NULL };
	char *by_cancel[] = { cancel, quiet, who, NULL };
	char **argv = j->want == WANT_END ? by_cancel : held ? by_hold : by_signal;
	held &= j->want != WANT_END;
	if (name && jobname && number)
		j->busy = order_run(s->orders, argv, on_worked, s,
		                    j->id << 3 | (held ? 4 : 0) | (int64_t)j->want);
	free(number);
	free(name);
	free(jobname);
}

void slurm_want(struct slurm *s, struct slurm_job *j, enum slurm_want want)
{
	if (j->want == WANT_END)
		return;
	if (j->want != want)
		j->refusals = 0;
	j->want = want;
	job_work(s, j);
}

/* ---- what a lost srun leaves ---- */

static void on_cancelled(void *data, int64_t tag, int status, const char *output)
{
	(void)data;
	(void)tag;
	(void)status;
	(void)output;
}

void slurm_cancel(struct slurm *s, const struct slurm_job *j)
{
	char program[] = "scancel", quiet[] = "--quiet";
	char *name = text_print("--name=%s", j->name);
	char *argv[] = { program, quiet, name, NULL };
	if (name)
		order_run(s->orders, argv, on_cancelled, s, 0);
	free(name);
}

static void on_left(void *data, int64_t id, int status, const char *output)
{
	struct slurm *s = data;
	struct slurm_job *j = slurm_job(s, id);
	if (!j || !j->sweeping)
		return;
	if (!status && *output && ++j->sweeps < SWEEPS_MAX) {
		if (!uv_is_active((uv_handle_t *)&s->sweep))
			uv_timer_start(&s->sweep, on_sweep, SWEEP_MS, 0);
		j->busy = false;
		return;
	}
	j->sweeping = false;
	s->sink.exited(s->sink.data, id, &j->exit);
}

static void on_sweep(uv_timer_t *t)
{
	struct slurm *s = t->data;
	char program[] = "squeue", bare[] = "--noheader";
	for (struct slurm_job *j = s->jobs; j; j = j->next) {
		char *name = j->sweeping && !j->busy ? text_print("--name=%s", j->name) : NULL;
		char *argv[] = { program, bare, name, NULL };
		if (name)
			j->busy = order_run(s->orders, argv, on_left, s, j->id);
		free(name);
	}
}

void slurm_sweep(struct slurm *s, struct slurm_job *j, const struct launcher_exit *e)
{
	j->exit = *e;
	j->sweeping = true;
	j->busy = false;
	j->want = j->is = WANT_END;
	slurm_cancel(s, j);
	uv_timer_start(&s->sweep, on_sweep, SWEEP_MS, 0);
}
