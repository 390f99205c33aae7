/* worker_hand.c - a worker run by hand: a bar and sentences on standard error, what was made on
 * standard output. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "json.h"
#include "path.h"
#include "worker_private.h"

enum { BAR_WIDTH = 30, FIGURES_WIDTH = 100 };

struct hand {
	struct run run;
	struct front front;
	pthread_mutex_t lock;
	bool terminal, bar; /* standard error is one; a bar stands on its line */
	bool json;
	json_t *outputs; /* owned; what --json says */
	char name[64];
};

static void clear_bar(struct hand *h)
{
	if (h->bar)
		fputs("\r\033[K", stderr);
	h->bar = false;
}

static void show_progress(void *data, const char *phase, size_t done, size_t total)
{
	struct hand *h = data;
	pthread_mutex_lock(&h->lock);
	if (!h->terminal) {
		pthread_mutex_unlock(&h->lock);
		return;
	}
	int full = total ? (int)((double)BAR_WIDTH * (double)done / (double)total) : 0;
	int percent = total ? (int)(100.0 * (double)done / (double)total) : 0;
	fprintf(stderr, "\r\033[K%s [", worker.name);
	for (int i = 0; i < BAR_WIDTH; i++)
		fputc(i < full ? '#' : '.', stderr);
	fprintf(stderr, "] %d %% %s", percent, phase);
	fflush(stderr);
	h->bar = true;
	pthread_mutex_unlock(&h->lock);
}

static void show_note(void *data, enum report_level level, const char *text)
{
	struct hand *h = data;
	pthread_mutex_lock(&h->lock);
	clear_bar(h);
	fprintf(stderr, "%s: %s%s\n", h->name, level == REPORT_WARNING ? "warning: " : "", text);
	pthread_mutex_unlock(&h->lock);
}

static void show_unit(void *data, size_t unit)
{
	(void)data;
	(void)unit;
}

/* "branches 4, closed 1": the figures that are single values, as far as a line takes them. */
static void figures_line(struct text *out, const json_t *figures)
{
	const char *key;
	json_t *value;
	json_object_foreach((json_t *)figures, key, value)
	{
		if (out->n > FIGURES_WIDTH) {
			text_add(out, ", ...");
			return;
		}
		if (!json_is_number(value) && !json_is_string(value))
			continue;
		text_addf(out, "%s%s ", out->n ? ", " : "", key);
		if (json_is_string(value))
			text_add(out, json_string_value(value));
		else
			text_addf(out, "%.6g", json_number_value(value));
	}
}

static void keep_result(struct hand *h, const struct result *result)
{
	json_t *o = json_object();
	json_set_text(o, "path", result->path);
	json_set_text(o, "kind", result->kind);
	json_object_set_new(o, "figures",
	                    result->figures ? json_deep_copy(result->figures) : json_null());
	json_object_set_new(o, "up_to_date", json_boolean(result->up_to_date));
	json_array_append_new(h->outputs, o);
}

static void show_result(void *data, const struct result *result)
{
	struct hand *h = data;
	struct text line = { 0 };
	pthread_mutex_lock(&h->lock);
	clear_bar(h);
	if (h->json) {
		keep_result(h, result);
	} else {
		if (path_has_suffix(result->path, worker.outputs[0].extension))
			figures_line(&line, result->figures);
		printf("%s%s%s\n", result->path, line.n && !line.failed ? ": " : "",
		       line.n && !line.failed ? line.s : "");
		fflush(stdout);
	}
	pthread_mutex_unlock(&h->lock);
	text_finish(&line);
}

static void show_error(void *data, enum status st, const char *text)
{
	struct hand *h = data;
	(void)st;
	pthread_mutex_lock(&h->lock);
	clear_bar(h);
	fprintf(stderr, "%s: %s\n", h->name, text);
	pthread_mutex_unlock(&h->lock);
}

static void print_json(const struct hand *h)
{
	json_t *o = json_object();
	json_set_int(o, "version", 1);
	json_object_set(o, "outputs", h->outputs);
	char *text = json_write(o, false);
	if (text)
		puts(text);
	free(text);
	json_decref(o);
}

int hand_main(const struct task *t)
{
	struct hand *h = calloc(1, sizeof *h);
	if (!h)
		return status_exit(ST_RESOURCE);
	h->terminal = isatty(STDERR_FILENO);
	h->json = t->json;
	h->outputs = json_array();
	h->front = (struct front){ .progress = show_progress,
		                   .note = show_note,
		                   .unit = show_unit,
		                   .result = show_result,
		                   .error = show_error,
		                   .data = h };
	snprintf(h->name, sizeof h->name, "batten-%s", worker.name);
	pthread_mutex_init(&h->lock, NULL);
	run_init(&h->run, &h->front);
	enum status st = signals_watch(&h->run);
	if (st == ST_OK)
		st = run_task(&h->run, t);
	else
		show_error(h, st, "cannot start a thread: memory ran out");
	pthread_mutex_lock(&h->lock);
	clear_bar(h);
	h->terminal = false; /* no bar comes after this */
	if (h->json)
		print_json(h);
	pthread_mutex_unlock(&h->lock);
	return status_exit(st);
}
