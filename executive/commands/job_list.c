/* job_list.c - records of jobs as a table and as JSON. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "connection.h"
#include "path.h"
#include "text.h"

static bool make_room(struct job_list *l)
{
	if (l->n < l->cap)
		return true;
	size_t cap = l->cap ? 2 * l->cap : 16;
	struct Stats *jobs = reallocarray(l->jobs, cap, sizeof *jobs);
	if (!jobs) {
		l->failed = true;
		return false;
	}
	l->jobs = jobs;
	l->cap = cap;
	return true;
}

bool job_list_add(void *data, const struct Stats *s)
{
	struct job_list *l = data;

	if (make_room(l)) {
		if (stats_copy(&l->jobs[l->n], s) == ST_OK)
			l->n++;
		else
			l->failed = true;
	}
	return true;
}

void job_list_put(struct job_list *l, const struct Stats *s)
{
	size_t at = l->n;

	while (at && l->jobs[at - 1].id > s->id)
		at--;
	if (at && l->jobs[at - 1].id == s->id) {
		struct Stats copy;
		if (stats_copy(&copy, s) == ST_OK) {
			stats_finish(&l->jobs[at - 1]);
			l->jobs[at - 1] = copy;
		}
		return;
	}
	size_t before = l->n;
	job_list_add(l, s);
	if (l->n == before)
		return;
	struct Stats added = l->jobs[before];
	memmove(&l->jobs[at + 1], &l->jobs[at], (before - at) * sizeof added);
	l->jobs[at] = added;
}

void job_list_finish(struct job_list *l)
{
	for (size_t i = 0; i < l->n; i++)
		stats_finish(&l->jobs[i]);
	free(l->jobs);
	*l = (struct job_list){ 0 };
}

static void job_text_next(struct job_text *t)
{
	text_add(&t->waiting, t->begun ? ",\n" : "{\"version\":1,\"jobs\":[\n");
	t->begun = true;
}

/* That standard output takes nothing is said at the end of the verb. */
static bool job_text_out(struct job_text *t, size_t held)
{
	if (t->waiting.n < held)
		return !t->waiting.failed;
	t->failed |=
	        t->waiting.failed || fwrite(t->waiting.s, 1, t->waiting.n, stdout) != t->waiting.n;
	text_reset(&t->waiting);
	return !t->failed;
}

bool job_text_add(void *data, const char *record, size_t n)
{
	struct job_text *t = data;

	job_text_next(t);
	text_add_bytes(&t->waiting, record, n);
	return job_text_out(t, JOB_TEXT_HELD);
}

bool job_text_put(void *data, const struct Stats *s)
{
	struct job_text *t = data;

	job_text_next(t);
	stats_write(&t->waiting, s);
	return job_text_out(t, JOB_TEXT_HELD);
}

int job_text_end(struct job_text *t)
{
	const struct report terminal = report_stderr("batten");

	text_add(&t->waiting, t->begun ? "]}\n" : "{\"version\":1,\"jobs\":[]}\n");
	const bool failed = t->failed | t->waiting.failed;
	if (t->waiting.failed)
		report_error(&terminal, ST_RESOURCE, "memory ran out");
	else if (!t->failed)
		job_text_out(t, 0);
	job_text_abandon(t);
	return failed ? status_exit(ST_RESOURCE) : 0;
}

void job_text_abandon(struct job_text *t)
{
	text_finish(&t->waiting);
}

int job_list_print_json(const struct job_list *l)
{
	struct job_text t = { .waiting.failed = l->failed };

	for (size_t i = 0; i < l->n; i++)
		job_text_put(&t, &l->jobs[i]);
	return job_text_end(&t);
}

int job_list_exit(const struct job_list *l)
{
	int rc = l->failed ? 1 : 0;

	for (size_t i = 0; i < l->n; i++) {
		enum job_state state = l->jobs[i].state;
		if (state == JOB_KILLED && !rc)
			rc = status_exit(ST_CANCELLED);
		else if (state == JOB_FAILED || state == JOB_LOST)
			rc = 1;
	}
	return rc;
}

void format_seconds(double s, char out[16])
{
	long n = isfinite(s) && s >= 0 && s < 1e9 ? lround(s) : -1;

	if (n < 0)
		out[0] = 0;
	else if (n < 3600)
		snprintf(out, 16, "%d:%02d", (int)(n / 60), (int)(n % 60));
	else
		snprintf(out, 16, "%d h %02d", (int)(n / 3600), (int)(n / 60 % 60));
}

void print_state_color(enum job_state state, bool color, FILE *out)
{
	unsigned rgb;

	if (color && sscanf(job_state_table[state].dark, "#%x", &rgb) == 1)
		fprintf(out, "\033[38;2;%u;%u;%um", rgb >> 16, rgb >> 8 & 255, rgb & 255);
}

void print_plain(bool color, FILE *out)
{
	if (color)
		fputs("\033[0m", out);
}

/* What stands at the end of a line: time left, why it waits, why it failed, or what it made. */
static const char *remark(const struct Stats *s, char out[16])
{
	if (s->state == JOB_RUNNING) {
		format_seconds(s->eta_s, out);
		return out;
	}
	if (s->state == JOB_DONE)
		return s->n_outputs ? path_file_name(s->outputs[0].path) : "";
	return s->reason ? s->reason : "";
}

/* At most `columns` columns of UTF-8, the last one an ellipsis where it is cut. */
static void print_cut(const char *s, int columns, FILE *out)
{
	int n = 0;
	const char *p = s, *cut = s;

	for (; *p; p++) {
		if (((unsigned char)*p & 0xc0) == 0x80)
			continue;
		if (n == columns - 1)
			cut = p;
		n++;
	}
	if (n <= columns)
		fputs(s, out);
	else
		fprintf(out, "%.*s…", (int)(cut - s), s);
}

void job_list_print(const struct job_list *l, bool rows, bool color, FILE *out)
{
	if (!l->n && !rows) {
		fputs("No jobs. Long computations appear here with their progress.\n", out);
		return;
	}
	if (!rows)
		fprintf(out, "%5s  %-11s %-12s %-20s %4s  %s\n", "id", "state", "worker", "file",
		        "%", "");
	for (size_t i = 0; i < l->n; i++) {
		const struct Stats *s = &l->jobs[i];
		double fraction = stats_fraction(s);
		char percent[8] = "", time[16];
		if (isfinite(fraction))
			snprintf(percent, sizeof percent, "%d", (int)(100 * fraction));
		fprintf(out, "%5lld  ", (long long)s->id);
		print_state_color(s->state, color, out);
		fprintf(out, "%s %-9s", job_state_table[s->state].glyph,
		        job_state_table[s->state].word);
		print_plain(color, out);
		fprintf(out, " %-12.12s %-20.20s %4s  ", s->worker ? s->worker : "",
		        s->file_name ? path_file_name(s->file_name) : "", percent);
		print_cut(remark(s, time), 19, out);
		fputc('\n', out);
	}
}
