/* job_text.c - what is said of a job in a line. */
#include "job_text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

void job_time(char out[JOB_TEXT], double seconds)
{
	out[0] = 0;
	if (!(seconds >= 0) || seconds > 1e9)
		return;
	const long s = (long)seconds;
	if (s < 3600)
		snprintf(out, JOB_TEXT, "%ld:%02ld", s / 60, s % 60);
	else if (s < 48 * 3600L)
		snprintf(out, JOB_TEXT, "%ld h %02ld", s / 3600, s / 60 % 60);
	else
		snprintf(out, JOB_TEXT, "%ld days", s / 86400);
}

void job_clock(char out[JOB_TEXT], double seconds)
{
	struct tm tm;
	out[0] = 0;
	if (!(seconds > 0) || seconds > 1e11)
		return;
	const time_t t = (time_t)seconds;
	if (localtime_r(&t, &tm))
		strftime(out, JOB_TEXT, "%H:%M:%S", &tm);
}

static const char *last_part(const char *path)
{
	const char *slash = path ? strrchr(path, '/') : NULL;
	return slash ? slash + 1 : path ? path : "";
}

const char *job_file(const struct Stats *s)
{
	if (s->file_name)
		return last_part(s->file_name);
	return s->n_inputs > 0 ? last_part(s->inputs[0].path) : "";
}

static void result(char out[JOB_TEXT], const struct Stats *s)
{
	char took[JOB_TEXT];
	job_time(took, s->wall_s);
	snprintf(out, JOB_TEXT, "%.400s%s%.24s",
	         s->n_outputs > 0 ? last_part(s->outputs[0].path) : "done", took[0] ? ", " : "",
	         took);
}

static void progress(char out[JOB_TEXT], const struct Stats *s)
{
	int n = 0;
	out[0] = 0;
	if (s->threads > 0)
		n = snprintf(out, JOB_TEXT, "%d thread%s, ", s->threads,
		             s->threads == 1 ? "" : "s");
	if (s->total > 0)
		snprintf(out + n, JOB_TEXT - (size_t)n, "%.200s %lld of %lld",
		         s->phase && s->phase[0] ? s->phase : "unit", (long long)s->done,
		         (long long)s->total);
	else if (s->phase && s->phase[0])
		snprintf(out + n, JOB_TEXT - (size_t)n, "%.200s", s->phase);
	else if (n)
		out[n - 2] = 0;
}

void job_says(char out[JOB_TEXT], const struct Stats *s, double now)
{
	char since[JOB_TEXT];
	if (s->state == JOB_DONE)
		result(out, s);
	else if (s->reason && s->reason[0])
		snprintf(out, JOB_TEXT, "%.500s", s->reason);
	else if (s->state == JOB_RUNNING)
		progress(out, s);
	else if (s->state == JOB_QUEUED && s->submitted > 0) {
		job_time(since, now - s->submitted);
		snprintf(out, JOB_TEXT, since[0] ? "waits since %.24s" : "waits%.0s", since);
	} else
		out[0] = 0;
}
