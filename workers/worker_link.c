/* worker_link.c - a worker under the executive: packets on standard input and output. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

#include "json.h"
#include "message.h"
#include "number.h"
#include "worker_private.h"

/* Longer texts in NOTE and ERROR are cut: a packet has a limit. Bytes. */
enum { TEXT_CUT = 8192 };

struct link {
	struct run run;
	struct front front;
	pthread_mutex_t out;  /* one packet at a time */
	pthread_mutex_t lock; /* guards what follows */
	pthread_cond_t arrived;
	char *job;          /* owned; START's, once it has come */
	char *fault;        /* owned; what came is not packets */
	bool ending;        /* the last packet is on its way: the end of input means nothing now */
	enum status failed; /* what the last packet will say */
	char sentence[1024];
};

static _Noreturn void leave(struct link *l, const char *why)
{
	fprintf(stderr, "batten-%s: %s\n", worker.name, why);
	run_leave(&l->run, status_exit(ST_CANCELLED));
}

/* Whoever listened is gone when a packet cannot be written. Steals body. */
static enum status send_packet(struct link *l, enum message_type type, json_t *body)
{
	pthread_mutex_lock(&l->out);
	enum status st = body ? message_send(STDOUT_FILENO, type, body) : ST_INTERNAL;
	pthread_mutex_unlock(&l->out);
	json_decref(body);
	if (st == ST_RESOURCE)
		leave(l, "standard output is closed: the executive is gone");
	return st;
}

/* File names may be any bytes, JSON is UTF-8: others are shown as '?'. */
static void set_text(json_t *o, const char *key, const char *text)
{
	size_t n = strnlen(text, TEXT_CUT);
	json_t *value = json_stringn(text, n);
	if (!value) {
		char *plain = strndup(text, n);
		for (char *s = plain; s && *s; s++)
			if ((unsigned char)*s >= 0x80)
				*s = '?';
		value = plain ? json_string(plain) : NULL;
		free(plain);
	}
	json_object_set_new(o, key, value ? value : json_null());
}

static void send_progress(void *data, const char *phase, size_t done, size_t total)
{
	json_t *o = json_object();
	json_set_int(o, "done", (int64_t)done);
	json_set_int(o, "total", (int64_t)total);
	json_set_text(o, "phase", phase);
	send_packet(data, MESSAGE_PROGRESS, o);
}

static void send_note(void *data, enum report_level level, const char *text)
{
	const char *word = level == REPORT_WARNING ? "warning" : "info";
	json_t *o = json_object();
	json_set_text(o, "level", word);
	set_text(o, "text", text);
	fprintf(stderr, "%s: %s\n", word, text);
	send_packet(data, MESSAGE_NOTE, o);
}

static void send_unit(void *data, size_t unit)
{
	json_t *o = json_object();
	json_set_int(o, "unit", (int64_t)unit);
	send_packet(data, MESSAGE_UNIT, o);
}

static void send_result(void *data, const struct result *result)
{
	json_t *o = json_object();
	set_text(o, "path", result->path);
	json_set_text(o, "kind", result->kind);
	json_object_set_new(o, "up_to_date", json_boolean(result->up_to_date));
	json_t *bare = json_copy(o);
	json_object_set_new(o, "figures",
	                    result->figures ? json_deep_copy(result->figures) : json_null());
	fprintf(stderr, "%s: %s\n", result->up_to_date ? "up to date" : "made", result->path);
	if (send_packet(data, MESSAGE_RESULT, o) == ST_INTERNAL) {
		send_note(data, REPORT_WARNING,
		          "the figures are too long for a packet; they stand in the file");
		send_packet(data, MESSAGE_RESULT, bare);
	} else {
		json_decref(bare);
	}
}

/* One ERROR ends the job: the first is kept until everything is done. */
static void keep_error(void *data, enum status st, const char *text)
{
	struct link *l = data;
	fprintf(stderr, "error: %s\n", text);
	pthread_mutex_lock(&l->lock);
	if (l->failed == ST_OK || st == ST_CANCELLED) {
		l->failed = st;
		snprintf(l->sentence, sizeof l->sentence, "%s", text);
	}
	pthread_mutex_unlock(&l->lock);
}

static void send_hello(struct link *l)
{
	char host[256] = "";
	const char *node = getenv("SLURMD_NODENAME"), *job = getenv("SLURM_JOB_ID");
	int64_t number;
	json_t *o = json_object();
	gethostname(host, sizeof host - 1);
	json_set_int(o, "protocol", MESSAGE_PROTOCOL);
	json_set_text(o, "worker", worker.name);
	json_set_int(o, "worker_version", worker.version);
	json_set_int(o, "pid", getpid());
	json_set_text(o, "host", node ? node : host);
	if (job && number_parse_integer(job, &number))
		json_set_int(o, "slurm_job", number);
	send_packet(l, MESSAGE_HELLO, o);
}

static double seconds(struct timeval t)
{
	return (double)t.tv_sec + 1e-6 * (double)t.tv_usec;
}

static void send_end(struct link *l, double wall)
{
	struct rusage used;
	json_t *o = json_object();
	if (l->failed != ST_OK) {
		json_set_text(o, "class", status_class(l->failed));
		set_text(o, "text", l->sentence);
		send_packet(l, MESSAGE_ERROR, o);
		return;
	}
	getrusage(RUSAGE_SELF, &used);
	json_set_number(o, "wall_s", wall);
	json_set_number(o, "cpu_s", seconds(used.ru_utime) + seconds(used.ru_stime));
	json_set_int(o, "peak_kib", used.ru_maxrss);
	send_packet(l, MESSAGE_DONE, o);
}

/* ---- the reader thread ---- */

static void set_fault(struct link *l, const char *reason)
{
	pthread_mutex_lock(&l->lock);
	if (!l->fault)
		l->fault = text_print("what came on standard input cannot be used: %s", reason);
	if (!l->fault)
		leave(l, "memory ran out");
	pthread_cond_signal(&l->arrived);
	pthread_mutex_unlock(&l->lock);
	atomic_store(&l->run.stop, true);
}

static void take(struct link *l, const struct message *m)
{
	if (m->type == MESSAGE_CANCEL) {
		atomic_store(&l->run.stop, true);
		pthread_mutex_lock(&l->lock);
		pthread_cond_signal(&l->arrived);
		pthread_mutex_unlock(&l->lock);
		return;
	}
	pthread_mutex_lock(&l->lock);
	bool again = l->job != NULL;
	if (!again)
		l->job = strdup(json_text(m->body, "job", ""));
	pthread_cond_signal(&l->arrived);
	pthread_mutex_unlock(&l->lock);
	if (again)
		set_fault(l, "a second START; a worker does one job");
}

static void end_of_input(struct link *l)
{
	pthread_mutex_lock(&l->lock);
	bool ending = l->ending;
	pthread_mutex_unlock(&l->lock);
	if (!ending)
		leave(l, "standard input is closed: the executive is gone");
}

static void *read_packets(void *data)
{
	struct link *l = data;
	struct message_reader reader;
	struct message m;
	int got = 0;
	message_reader_init(&reader, TO_WORKER);
	while (got >= 0) {
		size_t room;
		char *bytes = message_reader_room(&reader, 4096, &room);
		ssize_t n = bytes ? read(STDIN_FILENO, bytes, room) : -1;
		if (!bytes)
			leave(l, "memory ran out");
		if (n <= 0) {
			end_of_input(l);
			break;
		}
		message_reader_filled(&reader, (size_t)n);
		while ((got = message_reader_next(&reader, &m)) > 0) {
			take(l, &m);
			message_finish(&m);
		}
	}
	if (reader.failed)
		set_fault(l, reader.reason);
	message_reader_finish(&reader);
	return NULL;
}

/* Wait for START; false when there will be none. */
static bool wait_start(struct link *l)
{
	pthread_mutex_lock(&l->lock);
	while (!l->job && !l->fault && !atomic_load(&l->run.stop))
		pthread_cond_wait(&l->arrived, &l->lock);
	bool start = l->job && !l->fault;
	bool cancelled = !l->job && !l->fault;
	pthread_mutex_unlock(&l->lock);
	if (cancelled)
		keep_error(l, ST_CANCELLED, "cancelled before it began");
	return start;
}

static void link_say(void *data, enum report_level level, enum status st, const char *text)
{
	if (level == REPORT_ERROR)
		keep_error(data, st, text);
	else
		send_note(data, level, text);
}

static void do_job(struct link *l)
{
	const struct report report = { link_say, l };
	struct task t;
	enum status st = job_read(&t, l->job, &report);
	if (st != ST_OK) {
		if (l->failed == ST_OK)
			keep_error(l, st, status_text(st));
		return;
	}
	run_task(&l->run, &t);
	task_finish(&t);
}

int link_main(void)
{
	struct link *l = calloc(1, sizeof *l);
	struct timespec begin, end;
	pthread_t reader;
	if (!l)
		return status_exit(ST_RESOURCE);
	clock_gettime(CLOCK_MONOTONIC, &begin);
	l->front = (struct front){ .progress = send_progress,
		                   .note = send_note,
		                   .unit = send_unit,
		                   .result = send_result,
		                   .error = keep_error,
		                   .data = l };
	pthread_mutex_init(&l->out, NULL);
	pthread_mutex_init(&l->lock, NULL);
	pthread_cond_init(&l->arrived, NULL);
	run_init(&l->run, &l->front);
	send_hello(l);
	if (signals_watch(&l->run) != ST_OK || pthread_create(&reader, NULL, read_packets, l))
		keep_error(l, ST_RESOURCE, "cannot start a thread: memory ran out");
	else if (pthread_detach(reader) == 0 && wait_start(l))
		do_job(l);
	clock_gettime(CLOCK_MONOTONIC, &end);
	pthread_mutex_lock(&l->lock);
	l->ending = true;
	if (l->fault) {
		l->failed = ST_INTERNAL;
		snprintf(l->sentence, sizeof l->sentence, "%s", l->fault);
	}
	pthread_mutex_unlock(&l->lock);
	send_end(l, (double)(end.tv_sec - begin.tv_sec) +
	                    1e-9 * (double)(end.tv_nsec - begin.tv_nsec));
	return status_exit(l->failed);
}
